"""A drive that refuses its stops: how such a stop ends, after a restart and later."""

from functools import cache

import pytest
from tests.second.line import Bench
from tests.second.station import built, maps

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.render import context
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library

FAMILIES = ("ATV312", "CHF", "GD200A", "JSCC", "PF4", "SN300G5")
KNOWING = tuple(kind for kind in FAMILIES if maps()[kind].operation.commanded_by)
"""Those that show who commands them."""
MODES = ("SpeedOnly", "MonitorOnly")
WRITES = (5, 6, 16)
REASON = 2
BUSY = {"CHF": 8, "JSCC": 6, "SN300G5": 36}
"""The refusal of a busy drive."""


@cache
def stations() -> Library:
    return built(EmbeddedEngine(), [(kind,) for kind in FAMILIES])


class Refusing(SimulatedDrive):
    """It refuses whatever is written, and does nothing of it."""

    refuses = False
    reason = REASON

    def __init__(self, kind: str) -> None:
        super().__init__(maps()[kind], 1, Habits())
        self.form = context.refusal(maps()[kind])

    def reply(self, request: bytes) -> bytes | None:
        if not (self.refuses and request[1] in WRITES):
            return super().reply(request)
        form = self.form
        if form.add:
            return bytes([request[0], request[1] + form.add, self.reason])
        return bytes([request[0], form.function, form.address >> 8, form.address & 0xFF, 0, self.reason])


def bench_of(kind: str) -> Bench:
    bench = Bench(kind, stations=stations(), start=False)
    bench.drives = [Refusing(kind)]
    return bench.restart()


@pytest.fixture(autouse=True)
def _willing() -> None:
    Refusing.refuses, Refusing.reason = False, REASON


@pytest.mark.parametrize("begins", ["restart", "power-up"])
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("kind", FAMILIES)
def test_a_refused_stop_of_a_motor_that_the_bus_runs_is_overdue(kind: str, mode: str, begins: str) -> None:
    """Nobody knows whether this PLC has started it: the contact has to open."""
    bench = bench_of(kind).running()
    Refusing.refuses = True
    if begins == "power-up":
        after = Bench(kind, stations=stations(), start=False)
        after.drives, bench = bench.drives, after
    bench.put(**{mode: True, "RunForward": False}).restart()
    bench.until(lambda: bench.shows("StopOverdue"), 14_000)
    bench.run(20_000)
    assert bench.drives[0].hertz > 24.0
    assert bench.shows("StopOverdue")


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("kind", FAMILIES)
@pytest.mark.parametrize("ms", [20, 60])
def test_a_refused_stop_of_a_motor_at_rest_ends_once_that_is_read_after_it(kind: str, mode: str, ms: int) -> None:
    bench = bench_of(kind).stopped()
    Refusing.refuses = True
    assert_never_overdue(bench, mode, ms)


@pytest.mark.parametrize("kind", BUSY)
def test_so_does_one_that_a_busy_drive_refuses(kind: str) -> None:
    bench = bench_of(kind).stopped()
    Refusing.refuses, Refusing.reason = True, BUSY[kind]
    assert_never_overdue(bench, "MonitorOnly", 20)


def assert_never_overdue(bench: Bench, mode: str, ms: int) -> None:
    """After a restart with that much time between two scans."""
    bench.ms = ms
    bench.line(MaxScanMs=ms)
    bench.put(**{mode: True}).restart()
    overdue: list[bool] = []
    bench.watch.append(lambda one: overdue.append(one.shows("StopOverdue")))
    bench.run(20_000)
    assert not any(overdue)


@pytest.mark.parametrize("kind", KNOWING)
def test_a_stop_pin_that_a_motor_of_its_terminals_refuses_opens_no_contact(kind: str) -> None:
    """The map shows who is in command, and it is not the bus."""
    bench = bench_of(kind).stopped()
    bench.put(SpeedOnly=True).run(2000)
    bus = maps()[kind].operation.commanded_by
    for each in bus.all if bus else ():
        bench.drives[0].set(each.register, 0)
    bench.drives[0].keypad_run(20.0)
    Refusing.refuses = True
    bench.put(Enable=False).restart()
    overdue: list[bool] = []
    bench.watch.append(lambda one: overdue.append(one.shows("StopOverdue")))
    bench.run(20_000)
    assert bench.drives[0].hertz > 19.0
    assert not any(overdue)
