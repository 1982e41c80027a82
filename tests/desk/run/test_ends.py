"""How a run ends on a bad line: every motor whose line comes back stands before, and nothing hangs beyond it."""

from collections import deque
from dataclasses import dataclass
from random import Random

import pytest
from tests.desk.run.desk import EXAMPLE, ONE, Desk
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.bus import Bus
from driveblocks.desk.port import WirePort
from driveblocks.desk.run.session import Result
from driveblocks.desk.script import Setting

SECOND = 1_000_000
SLOW = ONE.replace("(ReferenceScale", "(StaleMs := 20000, ReferenceScale")
"""For a line whose gateway makes a status older than its usual StaleMs, which bars a start."""
WITHIN_S = {ONE: 15, SLOW: 15, EXAMPLE.read_text("utf-8"): 60}
"""The longest StopWithinMs of a program."""
BOUND_S = 62
GIVEN_UP_US = 300 * SECOND
"""When a person asks a second time: too late for any of these."""


@dataclass(frozen=True, kw_only=True)
class End:
    """How a run ends, and what its line does from then on."""

    how: str = "Ctrl-C"
    alone: bool = False
    """Nobody is there."""
    out_s: float = 0
    """How long the cable is out."""
    unplugged: bool = False
    """... together with the adapter."""
    noise: float = 0
    """Share of frames that is damaged, in each direction."""
    way_ms: int = 0
    """What a gateway keeps back each way, all the time."""
    echo: bool = False
    """The adapter hears itself, all the time."""
    dead: int | None = None
    """Three drives are there, and this one has no power."""
    seed: int = 0

    @property
    def at_us(self) -> int:
        """When the end is asked for."""
        return (40 if self.way_ms else 5) * SECOND


class Rough(Bus):
    """The port of a simulated line that does so."""

    def __init__(self, drives: list[SimulatedDrive], desk: Desk, end: End) -> None:
        """Good before the end."""
        super().__init__(drives, 19200, 10, ascii_mode=False)
        self.clock, self.ending, self.end, self.loss.chance = desk.clock, desk.ending, end, Random(end.seed)
        self.late_ms = 2 * end.way_ms + 100 if end.way_ms else 0
        self._to, self._fro = deque[tuple[int, bytes]](), deque[tuple[int, bytes]]()

    @property
    def error(self) -> str:
        """Why it does not work."""
        return "unplugged" if self.end.unplugged and self._out(self.clock.now_us()) else ""

    def _out(self, us: int) -> bool:
        return self.end.at_us <= us < self.end.at_us + self.end.out_s * SECOND

    def put(self, data: bytes) -> None:
        """Onto the line, or nowhere."""
        now, way = self.clock.now_us(), 1000 * self.end.way_ms
        if now > self.end.at_us + GIVEN_UP_US:
            self.ending.ask("no more", insists=True)
        if self.error:
            return
        if self.end.echo:
            self._fro.append((now + 2 * way, data))
        self.loss.damage = self.end.noise if now >= self.end.at_us else 0
        self._to.append((now + way, data))
        self._move(now)

    def take(self) -> bytes:
        """What has come."""
        now, found = self.clock.now_us(), b""
        self._move(now)
        while self._fro and self._fro[0][0] <= now:
            found += self._fro.popleft()[1]
        return b"" if self.error else found

    def _move(self, now: int) -> None:
        while self._to and self._to[0][0] <= now:
            at, data = self._to.popleft()
            if not self._out(at):
                self.send(data, at)
        said = self.receive(now)
        if said and not self._out(now):
            self._fro.append((now + 1000 * self.end.way_ms, said))


class Door(WirePort):
    """`Rough` as a port."""

    def __init__(self, line: Rough) -> None:
        """Around it."""
        self._line, self.late_ms = line, line.late_ms

    @property
    def error(self) -> str:  # type: ignore[override]  # here it changes
        """Why it does not work."""
        return self._line.error

    def send(self, data: bytes) -> None:
        """Bytes onto the line."""
        self._line.put(data)

    def receive(self) -> bytes:
        """Bytes that have come."""
        return self._line.take()


def run(end: End) -> tuple[Desk, Result, float]:
    """Run, with every motor that has power at speed when the end is asked for; how long that then took, in s."""
    three, moved = end.dead is not None, list[bool]()
    names = ("SN300G5", "JSCC", "CHF") if three else ("JSCC",)
    drives = [SimulatedDrive(MAPS[name], unit) for unit, name in enumerate(names, 1 if three else 7)]
    alive = [each for at, each in enumerate(drives) if at != end.dead]
    for each in drives:
        each.powered = each in alive
    desk = Desk(EXAMPLE.read_text("utf-8") if three else SLOW if end.way_ms else ONE, drives)
    desk.session.connect(Door(Rough(drives, desk, end)), None)
    desk.session.script = () if three else [Setting("Start", True, end.at_us * 2 // 5)]

    def step(at_us: int) -> None:
        if at_us < end.at_us or moved:
            return
        for each in alive if three else ():
            each.keypad_run(20)
        moved.extend(each.mode != "standstill" for each in alive)
        desk.ending.alone = end.alone
        if end.how == "crash":
            desk.controller.scan = None  # type: ignore[assignment,method-assign]  # calling it fails
        elif end.how != "time":
            desk.ending.ask(end.how, alone=end.alone)

    desk.session.steps.append(step)
    result = desk.session.run(end.at_us + 100_000)
    assert moved
    assert all(moved)
    return desk, result, (desk.clock.now_us() - end.at_us) / SECOND


def judged(end: End) -> None:
    """Run, and see that all is as it must be."""
    desk, result, took = run(end)
    within = WITHIN_S[desk.text]
    alone = end.alone or end.how == "time"
    back = not alone or end.out_s <= BOUND_S - 2
    moving = [each.unit for at, each in enumerate(desk.drives) if at != end.dead and each.mode != "standstill"]
    said = [*result.unconfirmed.values(), *desk.told()]
    assert not (back and moving), f"{moving} run on after {took:.0f} s: {said}"
    unproved = end.noise > 0 and end.way_ms > 0  # it stands, and hardly a read comes through that could prove it
    assert (
        took <= within + BOUND_S + end.way_ms / 300 + 2 * (end.noise > 0)
        if alone
        else unproved or not desk.ending.hurry
    ), (
        took,
        said,
    )
    named = {
        f"(unit {each.unit})" for at, each in enumerate(desk.drives) if at == end.dead or each.mode != "standstill"
    }
    assert all(any(unit in text for text in result.unconfirmed) for unit in named), result
    assert not (end.echo and end.out_s > BOUND_S + within and alone and "acknowledged" in " ".join(said)), said


ENDS = (
    End(), End(how="SIGTERM", alone=True, out_s=8), End(how="crash", alone=True, noise=0.6),
    End(how="time", alone=True, way_ms=250), End(how="SIGHUP", alone=True, dead=1),
    *(
        pytest.param(each, marks=pytest.mark.thorough)
        for each in (End(out_s=100), End(how="SIGTERM", alone=True, out_s=120, echo=True))
    ),
)  # fmt: skip


@pytest.mark.parametrize("end", ENDS)
def test_every_motor_whose_line_comes_back_stands_before_the_run_ends(end: End) -> None:
    judged(end)


def any_end(number: int) -> End:
    """One of many."""
    chance = Random(number)
    how = chance.choice(("Ctrl-C", "SIGTERM", "SIGHUP", "time", "crash", "crash"))
    alone = how in ("SIGTERM", "SIGHUP", "time") or (how == "crash" and number % 2 == 0)
    three = chance.random() < 0.3
    return End(
        how=how, alone=alone, out_s=chance.choice((0, 0, 0.3, 2, 8, 20, 40, 59, 75, 120)), seed=number,
        unplugged=chance.random() < 0.3, noise=chance.choice((0, 0, 0.3, 0.6)), way_ms=chance.choice((0, 0, 200, 300)),
        echo=chance.random() < 0.25, dead=chance.randrange(3) if three else None,
    )  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("number", range(300))
def test_every_motor_stands_before_any_run_ends(number: int) -> None:
    judged(any_end(number))
