"""The programs of the plants turn motors of drives that others have typed from manuals, over real ports.

The second models of tests/second are served in real time at the units and rates of a plant, over pseudo-terminals and
over TCP. No clock judges: what has to come is waited for, generously.
"""

import os
import select
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from decimal import Decimal

import pytest
from tests.desk.peers import Named
from tests.plant.bench import PLANTS, example, loaded
from tests.second.bench import KIND
from tests.second.drive import Drive
from tests.second.frames import opened
from tests.second.kinds import drive as model

from driveblocks.desk import port
from driveblocks.desk.clock import RealClock
from driveblocks.desk.run import probe
from driveblocks.plant import play, program
from driveblocks.plant.model import Motor, Plant

pytestmark = [
    pytest.mark.thorough,
    pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here"),
]
WITHIN_US = 120_000_000
SHARE = 0.5
"""Of the range of each analog input."""
BY_HAND_HZ = 30.0
"""What a panel asks for."""
QUICK_HZ_S = 25.0
"""Motors for which nobody has to wait."""
BROKEN_US = 50_000
"""After so long, characters that are no frame are forgotten."""
RUNNING = {"pumps": 4, "conveyor": 8, "small": 3}
"""How many motors turn at once: of each three pumps two."""


def far(motor: Motor, char_us: int) -> Drive:
    """The second model of a drive, as its plant says that it is set."""
    given: dict[str, object] = {"maximum_hz": float(motor.full_scale_hz or motor.maximum_hz), "char_us": char_us}
    given |= {"up_hz_s": QUICK_HZ_S, "down_hz_s": QUICK_HZ_S}
    if motor.watchdog_ms:
        given["comm_us"] = 1000 * motor.watchdog_ms
    if scale := motor.values.get("ReferenceScale"):
        given["reference_milli_hz"] = int(1000 / scale)
    return model(KIND[motor.map.prefix], motor.unit, **given)


@dataclass
class Far:
    """A line of second models at the far end of a descriptor, in real time."""

    clock: RealClock
    char_us: int
    units: list[Drive | Named]
    over: threading.Event = field(default_factory=threading.Event)
    lock: threading.Lock = field(default_factory=threading.Lock)
    broken: int = 0
    """Characters that were no frame."""

    def serve(self, handle: int) -> None:
        """Answer until it is over."""
        heard, since = b"", 0
        while not self.over.is_set():
            if select.select([handle], [], [], 0.002)[0]:
                heard, since = heard + os.read(handle, 4096), self.clock.now_us()
            if opened(heard) is not None:
                self._answer(handle, heard)
                heard = b""
            elif heard and self.clock.now_us() - since > BROKEN_US:
                self.broken, heard = self.broken + len(heard), b""

    def _answer(self, handle: int, frame: bytes) -> None:
        """Replies come when their last character would; the other units hear them, too."""
        end = self.clock.now_us() + len(frame) * self.char_us
        with self.lock:
            replies = [(each, reply) for each in self.units for reply in each.receive(frame, end)]
        for one, (at, text) in replies:
            self.clock.sleep_until(at + len(text) * self.char_us)
            os.write(handle, text)
            with self.lock:
                for each in self.units:
                    if each is not one:
                        each.receive(text, at + len(text) * self.char_us)

    def hz(self, unit: int) -> float:
        """The true speed of a shaft."""
        with self.lock:
            return next(each.shaft_hz(self.clock.now_us()) for each in self.units if each.unit == unit)  # type: ignore[union-attr]


@contextmanager
def served(line: Far, way: str, rate: int) -> Iterator[port.Port]:
    """A port with such a line at its other end."""
    with ExitStack() as stack:
        if way == "tcp":
            door = stack.enter_context(socket.create_server(("127.0.0.1", 0)))
            near: port.Port = port.tcp("127.0.0.1", door.getsockname()[1], line.clock)
            come = stack.enter_context(door.accept()[0])
            handle = come.fileno()
        else:
            handle, other = os.openpty()
            stack.callback(os.close, handle)
            stack.callback(os.close, other)
            near = port.serial_port(os.ttyname(other), rate, "8N1", line.clock)  # a pseudo-terminal has no parity
        thread = threading.Thread(target=line.serve, args=(handle,), daemon=True)
        thread.start()
        try:
            yield near
        finally:
            line.over.set()
            thread.join()
            near.close()


class Site:
    """A program in real time, and what is at the other end of its lines."""

    def __init__(self, plant: Plant, way: str, stack: ExitStack) -> None:
        self.plant, self.clock, self.given = plant, RealClock(), play.given(plant)
        self.scan_us = self.due = 1000 * plant.scan_ms
        self.controller = probe.controller(loaded(program.text(plant)), self.scan_us)
        self.lines: dict[str, Far] = {}
        ports = []
        for each in self.controller.lines:
            name = each.wiring.line
            bus = program.bus(plant, name)
            char_us = 1_000_000 * bus.character.bits // bus.rate
            meters = [Named(one.unit, given={0: 0x1234, 1: 0x5678}) for one in plant.meters_on(name)]
            line = Far(self.clock, char_us, [*(far(one, char_us) for one in plant.on(name)), *meters])
            self.lines[name] = line
            ports.append(stack.enter_context(served(line, way, bus.rate)))
        self.controller.connect(ports[0], None, *ports[1:])
        self.program = self.controller.instance
        for path, value in self.given.inputs.items():
            self.program[path] = value
        for one in plant.inputs.values():
            self.program[one.name] = int(one.raw[0] + SHARE * (one.raw[1] - one.raw[0]))
        for motor in plant.drives.values():
            if motor.speed is None:
                self.program[f"{motor.name}_Hertz"] = BY_HAND_HZ
        self.due = self.clock.now_us()

    def until(self, holds: Callable[[], bool], what: str) -> None:
        """Scan until something is so."""
        end = self.clock.now_us() + WITHIN_US
        while not holds():
            assert self.clock.now_us() < end, (what, {name: self.shown(name) for name in self.plant.drives})
            self.given.around(self.program)
            self.controller.receive()
            self.controller.scan(self.clock.now_us())
            self.due = max(self.due + self.scan_us, self.clock.now_us())
            self.clock.sleep_until(self.due)

    def press(self, name: str) -> None:
        """Press a button or a key of the panel that is open, for a quarter of a second."""
        self.program[name] = True
        end = self.clock.now_us() + 250_000
        self.until(lambda: self.clock.now_us() > end, name)
        self.program[name] = False

    def hz(self, name: str) -> float:
        """How fast a shaft turns, as its drive knows."""
        motor = self.plant.drives[name]
        return self.lines[motor.line].hz(motor.unit)

    def wanted(self, name: str) -> float:
        """What its reference comes to."""
        speed = self.plant.drives[name].speed
        if isinstance(speed, Decimal):
            return float(speed)
        low, high = map(float, self.plant.inputs[speed].range) if speed else (BY_HAND_HZ, BY_HAND_HZ)
        return low + SHARE * (high - low)

    def all(self, pin: str) -> bool:
        return all(self.program[f"{each}.{pin}"] for each in self.plant.drives)

    def shown(self, name: str) -> tuple[object, ...]:
        pins = ("CommOk", "Ready", "Running", "StopConfirmed", "Fault", "Reason", "OutputFrequencyHz")
        return (self.hz(name), *(self.program[f"{name}.{pin}"] for pin in pins))

    def turning(self) -> set[str]:
        """Drives at their reference, as they know and as their blocks say."""
        at = {each for each in self.plant.drives if abs(self.hz(each) - self.wanted(each)) < 0.1}
        return {each for each in at if self.program[f"{each}.Running"]}


@pytest.mark.parametrize("way", ["pty", "tcp"])
@pytest.mark.parametrize("name", PLANTS)
def test_the_motors_turn_at_their_references_and_stop(name: str, way: str) -> None:
    plant = example(name)
    with ExitStack() as stack:
        site = Site(plant, way, stack)
        site.until(lambda: site.all("CommOk") and site.all("StopConfirmed"), "all answer and stand")
        site.press("Hmi_Reset")
        site.until(lambda: all(site.program[f"{each}_Ok"] for each in plant.hard_stops), "the hard stops close")
        assert not [each for each in plant.drives if site.hz(each)]
        site.until(lambda: site.all("Ready"), "all are ready")
        for each in (one.name for one in plant.buttons.values() if one.does == "start"):
            site.press(each)
        site.until(lambda: len(site.turning()) == RUNNING[name], "they turn at their references")
        assert {each for each in plant.drives if site.hz(each)} == site.turning()
        for each in (one.name for one in plant.buttons.values() if one.does == "stop"):
            site.program[each] = False
        site.until(lambda: not any(map(site.hz, plant.drives)) and site.all("StopConfirmed"), "they stand")
        for line in site.lines.values():
            assert not line.broken
            assert not [each.stores for each in line.units if isinstance(each, Drive) and each.stores]
