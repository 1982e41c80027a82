"""A run: scans in time, what is set meanwhile, what is seen of it, and its end."""

import queue
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from driveblocks.host.engine import ScanError
from driveblocks.plc.clock import Clock
from driveblocks.plc.controller import Controller
from driveblocks.plc.ending import Ending, Stopper
from driveblocks.plc.pace import Pace
from driveblocks.plc.port import Port
from driveblocks.plc.record import Timing, Trace
from driveblocks.plc.script import Setting
from driveblocks.plc.view import View, look

LOOK_US = 200_000
"""Between two looks for the screen."""

Step = Callable[[int], None]
"""What happens besides before each scan, at the time since the start."""


@dataclass
class Result:
    """How a run has ended."""

    reason: str
    crashed: bool = False
    unconfirmed: dict[str, str] = field(default_factory=dict)
    """Drives whose standstill could not be proved, and why."""
    stopped: tuple[str, ...] = ()


class Session:
    """One run of a program at a port."""

    def __init__(self, controller: Controller, clock: Clock, ending: Ending, scan_us: int) -> None:
        """Prepare; `connect` gives it a port, `run` runs."""
        self.controller = controller
        self.ending = ending
        self.pace = Pace(scan_us)
        self.settings: queue.SimpleQueue[Setting] = queue.SimpleQueue()
        """What a person sets, from another thread."""
        self.script: Sequence[Setting] = ()
        self.shown: tuple[str, ...] = ()
        self.records: list[Trace | Timing] = []
        self.recorded: tuple[str, ...] = ()
        self.step: Step = lambda _: None
        self.view: View | None = None
        self.told: queue.SimpleQueue[str] = queue.SimpleQueue()
        """What is to be said, each in a line."""
        self.result: Result | None = None
        self._clock = clock
        self._port: Port
        self._done = 0
        self._begun_us = 0
        self._looked_us = -LOOK_US
        self._seen_drops: set[str] = set()
        self._port_error = ""

    def connect(self, port: Port, free: frozenset[tuple[int, str]] | None) -> None:
        """Take a port; see `Controller.connect`."""
        self._port = port
        self.controller.connect(port, free)

    def run(self, for_us: int | None = None) -> Result:
        """Scan until the end, then stop every drive. No exception of the program comes out of here."""
        crash = ""
        self._begun_us = self._clock.now_us()
        try:
            self._loop(for_us)
        except ScanError as error:
            crash = str(error)
        except Exception as error:  # whatever happens, the drives are stopped
            crash = f"{type(error).__name__}: {error}"
        if crash:
            self.ending.reason = self.ending.reason or f"the program has failed: {crash}"
        self.result = self._end(crashed=bool(crash))
        return self.result

    def _loop(self, for_us: int | None) -> None:
        scan_us = self.pace.scan_us
        due = self._begun_us
        while not self.ending.reason:
            start = self._clock.now_us()
            if for_us is not None and start - self._begun_us >= for_us:
                self.ending.ask(f"{for_us / 1e6:g} s are over")
                break
            self._scan(start)
            done = self._clock.now_us()
            due += scan_us
            due += scan_us * self.pace.add(done - start, done - due)
            self._clock.sleep_until(due)

    def _scan(self, now_us: int) -> None:
        since = now_us - self._begun_us
        instance = self.controller.instance
        while self._done < len(self.script) and self.script[self._done].at_us <= since:
            setting = self.script[self._done]
            instance[setting.name] = setting.value
            self._done += 1
        while not self.settings.empty():
            setting = self.settings.get()
            instance[setting.name] = setting.value
        self.step(since)
        self.controller.scan(now_us)
        self._record(since)
        if since - self._looked_us >= LOOK_US:
            self._looked_us = since
            self.view = look(self.controller, self.shown, since, self._port.error)
            self._tell()

    def _record(self, since: int) -> None:
        if self.records:
            values = {name: self.controller.instance[name] for name in self.recorded}
            for each in self.records:
                each.add(since, values)

    def _tell(self) -> None:
        for what in self.controller.dropped.keys() - self._seen_drops:
            self._seen_drops.add(what)
            self.told.put(f"not sent: {what} (needs --allow-run)")
        if self._port.error != self._port_error:
            self._port_error = self._port.error
            self.told.put(f"the port does not work: {self._port_error}" if self._port_error else "the port works again")

    def _end(self, *, crashed: bool) -> Result:
        controller = self.controller
        names: dict[int, list[str]] = {}
        for block in controller.wiring.drives:
            names.setdefault(controller.unit(block), []).append(block.path)
        units = controller.units()
        ascii_mode = bool(controller.number(f"{controller.wiring.line}.Ascii"))
        self.told.put(f"{self.ending.reason}: stopping every drive")
        told = Stopper(self._port, self._clock, self.ending, ascii_mode=ascii_mode).stop(units)
        told |= dict.fromkeys(
            names.keys() - units.keys(), "no stop sent: its unit address is not its own, or not known"
        )
        unconfirmed = {f"{', '.join(names[unit])} (unit {unit})": why for unit, why in told.items() if why}
        stopped = tuple(", ".join(names[unit]) for unit, why in told.items() if not why)
        return Result(self.ending.reason, crashed, unconfirmed, stopped)
