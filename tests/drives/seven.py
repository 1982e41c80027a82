"""Drives of each family at its best bit rate: refresh, stops, share of the wire.

`python -m tests.drives.seven` writes the tables of `docs/measured/drives.md` and `docs/stop.md`, in half a minute
per family; `python -m tests.drives.seven V20 PF4` writes the rows of these, and leaves the others.
"""

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from random import Random

from tests import measured
from tests.blocks.library import sources
from tests.line.vline import Config, Sent
from tests.shipped import drives
from tests.simulator.bench import DriveBench

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.maps.form import is_bit, wire
from driveblocks.maps.model import Drive
from driveblocks.maps.revision import checked
from driveblocks.meaning.polls import polls
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Source

DOCS = Path(__file__).parents[2] / "docs"
COUNT = 7
OF_BITS = (1, 2, 5, 15)
"""Functions that read or write single bits."""
ASSUMED = 19200
"""Bit rate where a manual gives none."""
PINS = ("BitRate : UDINT", "CharacterBits : UINT", "ElapsedMs : UINT", "MaxScanMs : UINT", "Ascii : BOOL",
        "Restart : BOOL")  # fmt: skip
SETTINGS = "Enable := TRUE, SpeedReferenceHz := 25.0, MaximumHz := 50.0, FullScaleHz := 50.0, StopWithinMs := 20000"


def station(prefix: str, count: int = COUNT) -> Source:
    """A program with a line and this many drives, as a block."""
    places, number = range(count), checked(drives()[prefix])
    calls = "".join(
        f"  Drive{at}(RunForward := Run{at}, {SETTINGS}, Settings := Setting,"
        f" Address := {at + 1}, ManualChecked := {number}, Slot := Slots[{at}]);\n"
        for at in places
    )
    pins = ", ".join(f"{name} := {name}" for name in (pin.partition(" ")[0] for pin in PINS))
    inputs = "".join(f"  {pin};\n" for pin in (*PINS, *(f"Run{at} : BOOL" for at in places)))
    blocks = "".join(f"  Drive{at} : {prefix}_Drive;\n" for at in places)
    return Source(
        "seven.st",
        f"FUNCTION_BLOCK Seven\nVAR_INPUT\n{inputs}END_VAR\nVAR\n  Port : MB_Port;\n  Slots : MB_Slots8;\n"
        f"  TheLine : MB_Line8;\n  Setting : VFD_Settings;\n{blocks}END_VAR\n"
        f"  Setting.ReferenceScale := 100.0;\n  Setting.TurnRoundMs := 20;\n"
        f"{calls}  TheLine({pins}, Port := Port, Slots := Slots);\n"
        "END_FUNCTION_BLOCK\n",
    )


@dataclass(frozen=True)
class Measured:
    """Figures of a line with seven drives that run: ms, and percent of the wire."""

    refresh: float
    stop_mean: float
    stop_most: float
    alone: int
    worst: int
    load: int
    timeouts: int


def measure(drive: Drive, rate: int, *, keeps: bool, seconds: int = 20, stops: int = 40) -> Measured:
    """Let seven drives run, stop one at a time at random moments, and measure."""
    chance = Random(7)
    config = Config(rate=rate, keeps=keeps, turn_ms=20, max_scan=20)
    bench = _standing(drive, config, COUNT)
    block = bench.block
    command = {one.does: one for one in drive.operation.commands}["stop"]
    for at in range(COUNT):
        bench.set(**{f"Run{at}": True})
    bench.run(8000)
    assert all(block[f"Drive{at}.Running"] for at in range(COUNT))
    asked = (_asked(each, 1, polls(drive)[0].address) for each in bench.run(1000 * seconds))
    reads = [each for each in asked if each is not None]
    gaps = [later - before for before, later in pairwise(reads)]
    load = bench["TheLine.LoadPercent"]
    late = list(_stops(bench, command.register, stops, chance))
    return Measured(
        sum(gaps) / len(gaps), sum(late) / len(late), max(late), bench["TheLine.StopAloneMs"],
        bench["TheLine.WorstStopMs"], load, bench["TheLine.Timeouts"],
    )  # fmt: skip


def promised(drive: Drive, rate: int, count: int, *, keeps: bool) -> tuple[int, int]:
    """`StopAloneMs` and `WorstStopMs` of a line with this many drives."""
    bench = _standing(drive, Config(rate=rate, keeps=keeps, turn_ms=20, max_scan=20), count)
    return bench["TheLine.StopAloneMs"], bench["TheLine.WorstStopMs"]


def _standing(drive: Drive, config: Config, count: int) -> DriveBench:
    """A line that was restarted, with all drives at standstill."""
    block = EmbeddedEngine().build([*sources(), station(drive.prefix, count)]).instance("Seven")
    bench = DriveBench([SimulatedDrive(drive, at + 1) for at in range(count)], config, block=block)
    bench.attended = set()
    bench.set(Restart=True)
    bench.scan()
    bench.set(Restart=False)
    bench.run(8000)
    return bench


def _each() -> Iterator[tuple[Drive, int, bool, str]]:
    """Every family at the fastest rate that its map lists, 8N1, with either keeper of the silence; its row's name."""
    for drive in drives().values():
        rate = max(code.baud for code in drive.serial.baud.codes) if drive.serial.baud else ASSUMED
        for keeps in (True, False):
            who = "port" if keeps else "line"
            yield drive, rate, keeps, f"{drive.prefix}, {rate} bit/s 8N1, the {who} keeps the silence"


def _asked(sent: Sent, unit: int, register: int) -> float | None:
    """When a request for a register or coil of a drive began, if it is one."""
    there = sent.unit == unit and sent.pdu[2:4] == wire(register).to_bytes(2, "big")
    return sent.ms if there and (sent.pdu[1] in OF_BITS) == is_bit(register) else None


def _stops(bench: DriveBench, register: int, stops: int, chance: Random) -> Iterator[float]:
    """From the pin to the first stop on the wire, one drive after the other."""
    for _ in range(stops):
        bench.run(chance.randrange(20, 400))
        at = chance.randrange(COUNT)
        bench.set(**{f"Run{at}": False})
        pressed = bench.now / 1000 + bench.config.scan / 1000
        asked = (_asked(each, at + 1, register) for each in bench.run(2000))
        sent = next(each for each in asked if each is not None)
        yield sent - pressed
        _until(bench, f"Drive{at}.StopConfirmed")
        bench.set(**{f"Run{at}": True})
        _until(bench, f"Drive{at}.Running")


def _until(bench: DriveBench, pin: str, most_ms: int = 15_000) -> None:
    """Let time pass until a pin is TRUE, and a second more."""
    for _ in range(0, most_ms, 100):
        if bench.block[pin] is True:
            bench.run(1000)
            return
        bench.run(100)
    raise AssertionError(f"{pin} has not come")


def _row(drive: Drive, rate: int, keeps: bool, name: str) -> str:
    got = measure(drive, rate, keeps=keeps)
    return (
        f"| {name} | {got.refresh:.0f} ms | {got.stop_mean:.0f}, {got.stop_most:.0f} ms | {got.alone} ms |"
        f" {got.worst} ms | {got.load} % |"
    )


COUNTS = (1, 2, 4, 6, 8)


def _stop_row(drive: Drive, rate: int, keeps: bool, name: str) -> str:
    worst = [promised(drive, rate, count, keeps=keeps)[1] for count in COUNTS]
    return f"| {name} | {' | '.join(f'{each} ms' for each in worst)} |"


def write(page: Path, row: Callable[[Drive, int, bool, str], str], head: list[str], only: list[str]) -> None:
    """Measure the rows of these families, all if there are none, and leave those of the others as they are."""
    had = measured.rows(page)
    lines = [
        row(drive, rate, keeps, name) if not only or drive.prefix in only else had.get(name, "")
        for drive, rate, keeps, name in _each()
    ]
    measured.put(page, [*head, *filter(None, lines)])


if __name__ == "__main__":
    each_count = " | ".join(f"{count} drive{'s' * (count > 1)}" for count in COUNTS)
    head = [f"| one family on the line | {each_count} |", f"|---|{'---:|' * len(COUNTS)}"]
    write(DOCS / "stop.md", _stop_row, head, sys.argv[1:])
    head = [
        "| seven drives | refresh | one stop, mean and most | `StopAloneMs` | `WorstStopMs` | wire in use |",
        "|---|---:|---:|---:|---:|---:|",
    ]
    write(DOCS / "measured" / "drives.md", _row, head, sys.argv[1:])
