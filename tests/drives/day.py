"""A day of simulated bus: nothing that goes out by itself may store in a drive's EEPROM."""

from collections import Counter

from tests.drives.bench import Bench, Frame
from tests.drives.rules import Meaning

from driveblocks.simulator.habits import Habits
from structured_text.engines.engine import Library

HOUR_MS = 3_600_000


def day(kind: str, ms: int, *, every: int = 20, stations: Library | None = None) -> Counter[int]:
    """So long a working day of a drive, a scan taking `every` ms; how often each register was written.

    Raises AssertionError if the drive has stored anything, or if a write reaches a parameter.
    """
    habits = Habits(ramp=50, coast_ramp=50)
    bench = Bench(kind, habits=habits, ms=every, stations=stations).line(MaxScanMs=every + 20)
    meaning, written = Meaning(bench.maps[0]), Counter[int]()
    turn = 0
    while bench.now < 1000 * ms:
        _turn(bench, turn)
        turn += 1
        for frame in bench.frames:
            _look(bench, meaning, frame)
        written.update(frame.address for frame in bench.frames if not frame.read)
        bench.frames.clear()
        bench.acknowledged.clear()
    assert bench.drives[0].stores == 0
    return written


def _look(bench: Bench, meaning: Meaning, frame: Frame) -> None:
    if not frame.read:
        assert meaning.does(frame) or frame.address == meaning.reference, f"{frame} is no command"
        assert not bench.drives[0].memory.parameter(frame.address), f"{frame} reaches a parameter"


def _turn(bench: Bench, turn: int) -> None:
    """Runs, at other and other speeds, a fault with its reset, a dip of the supply, a restart of the PLC."""
    drive = bench.drives[0]
    bench.put(FaultReset=False, RunForward=False, SpeedReferenceHz=float(5 + turn % 45)).scan()
    bench.running()
    for step in range(30):
        bench.put(SpeedReferenceHz=float(5 + (turn + 7 * step) % 45)).run(3000)
    if turn % 5 == 1:
        drive.trip(3)
        drive.clear_cause()
        bench.put(RunForward=False).run(4000)
        bench.put(FaultReset=True).run(3000)
        drive.reset()
    elif turn % 5 == 2:
        drive.power(on=False)
        bench.run(2000)
        drive.power(on=True)
    elif turn % 5 == 3:
        bench.restart()
    elif turn % 5 == 4:
        bench.deaf = {1}
        bench.run(9000)
        bench.deaf = set()
    bench.run(1000)
