"""Each fault of the wire in each state of the block: nothing breaks a rule, and all goes on when the fault has gone."""

from collections.abc import Callable

from tests.drives.bench import Bench, Faults
from tests.drives.rules import watched

from driveblocks.simulator.habits import Habits
from structured_text.engines.engine import Library

Doing = Callable[[Bench], object]


def starting(state: int) -> Doing:
    """An edge, until the block is in this state."""

    def begin(bench: Bench) -> None:
        bench.stopped().put(RunForward=True)
        bench.until(lambda: bench.out("Control.State") == state)

    return begin


def tripped(bench: Bench) -> None:
    bench.running()
    bench.drives[0].trip(3)
    bench.drives[0].clear_cause()
    bench.put(RunForward=False).until(lambda: bench.shows("Fault"))


def resetting(bench: Bench) -> None:
    tripped(bench)
    bench.run(1500)
    bench.put(FaultReset=True).run(40)


def lost(bench: Bench) -> None:
    bench.running().deaf = {1}
    bench.until(lambda: not bench.shows("CommOk"), 9000).deaf = set()


def writing(bench: Bench) -> None:
    bench.stopped().block["Writer.AllowUnknown"] = True
    bench.block["Writer.Address"] = 0x0100
    bench.block["Writer.Execute"] = True
    bench.run(40)


STATES: dict[str, Doing] = {
    "power-up": lambda _: None,
    "stopping": lambda bench: bench.running().put(RunForward=False).run(60),
    "stopped": Bench.stopped,
    "reference sent": starting(2),
    "command sent": starting(3),
    "running": Bench.running,
    "only reads": lambda bench: bench.stopped().put(MonitorOnly=True).run(200),
    "only speed": lambda bench: bench.stopped().put(SpeedOnly=True).run(200),
    "fault": tripped,
    "resetting": resetting,
    "offline": lost,
    "a parameter waits": writing,
}


def wire(**faults: int) -> Doing:
    """Frames that go wrong for a while."""

    def happens(bench: Bench) -> None:
        bench.faults = Faults(**faults)
        bench.run(2500)

    return happens


def deaf(ms: int) -> Doing:
    """A drive that hears nothing."""

    def happens(bench: Bench) -> None:
        bench.deaf = {1}
        bench.run(ms)
        bench.deaf = set()
        bench.run(500)

    return happens


def dip(ms: int) -> Doing:
    """The drive's supply."""

    def happens(bench: Bench) -> None:
        bench.drives[0].power(on=False)
        bench.run(ms)
        bench.drives[0].power(on=True)
        bench.run(500)

    return happens


def noise(frame: bytes) -> Doing:
    """Somebody sends, again and again."""

    def happens(bench: Bench) -> None:
        for _ in range(25):
            bench.foreign(frame)
            bench.run(60)

    return happens


def late(ms: int) -> Doing:
    """A scan."""

    def happens(bench: Bench) -> None:
        bench.scan(ms)
        bench.run(500)

    return happens


def left(what: str) -> Doing:
    """A block that is not called."""

    def happens(bench: Bench) -> None:
        bench.leave(what).run(2500)

    return happens


FAULTS: dict[str, Doing] = {
    "every request lost": wire(lost=1000),
    "some requests lost": wire(lost=300),
    "no reply": wire(unanswered=1000),
    "some replies lost": wire(unanswered=300),
    "every reply garbled": wire(garbled=1000),
    "some replies garbled": wire(garbled=300),
    "replies cut short": wire(truncated=400),
    "replies late": wire(late=400),
    "replies twice": wire(twice=1000),
    "all at once": wire(lost=100, unanswered=100, garbled=100, truncated=100, late=100, twice=100),
    "deaf for a moment": deaf(300),
    "deaf for long": deaf(7000),
    "a dip of the supply": dip(250),
    "the supply gone": dip(3000),
    "another master": noise(bytes([9, 6, 0x10, 0, 0, 1])),
    "a reply that nobody asked for": noise(bytes([1, 3, 2, 0, 3])),
    "a late scan": late(300),
    "a scan beyond the limit": late(1600),
    "the line not called": left("SkipLine"),
    "the block not called": left("Skip0"),
}


def cell(kind: str, state: str, fault: str, *, seed: int = 0, stations: Library | None = None) -> None:
    """One field of the matrix. Raises AssertionError."""
    habits = Habits(ramp=50, coast_ramp=50, auto_restart=seed % 2 == 1, runs_while_stopping=seed % 4 < 2)
    bench = watched(kind, seed=seed, habits=habits, stations=stations)
    try:
        STATES[state](bench)
        FAULTS[fault](bench)
        bench.heal()
    except AssertionError as error:
        raise AssertionError(f"{kind}, {state}, {fault}, seed {seed}: {error}") from error
