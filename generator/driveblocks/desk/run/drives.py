"""Drives that are to be simulated, as the command line names them: `jscc@2:50:ReferenceScale=100`.

Nothing of it is taken from a program: what its settings believe of a drive may be wrong, and has to show.
"""

import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.wiring import DriveBlock
from driveblocks.maps.collection import Source
from driveblocks.maps.form import Span, span_text
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.meaning.measure import PINS, measures
from driveblocks.meaning.reference import reference

HIGHEST_UNIT = 247
FACTORY_HZ, HIGHEST_HZ = 50, 600
REFERENCE = "ReferenceScale"
"""Counts per Hz; every other scale is Hz, A, V or kW per count."""
COUNTS_PER_HERTZ, PER_COUNT = "100", "0.01"
"""What a scale is that the manual does not give, unless its user sets it."""
LEAST, MOST = Decimal("0.1"), Decimal(1000)
FINEST, COARSEST = Decimal("0.01"), Decimal(10)
WIDTH = 68
_WORD = re.compile(r"(?P<name>.+?)(@(?P<unit>[^:]*))?(?P<facts>(:[^:@\\/]*)*)")
_NUMBER = re.compile(r"[0-9]{1,6}(\.[0-9]{1,3})?")


@dataclass(frozen=True)
class Word:
    """A drive in the words of the command line; `unit` and `facts` may be empty."""

    name: str
    unit: str
    facts: tuple[str, ...]


@dataclass(frozen=True)
class Named:
    """A drive to be simulated: its map, its unit address, and what no manual says of it."""

    path: Path
    drive: Drive
    unit: int
    maximum_hz: int = FACTORY_HZ
    """The drive's own maximum: 100 % of a reference that is a percentage."""
    scales: tuple[tuple[str, str], ...] = ()
    """Scales that its user has set: their names as in VFD_Settings, and numbers."""

    def made(self, *, ascii_mode: bool) -> SimulatedDrive:
        places = open_scales(self.drive)
        counts = {name: Decimal(number) for name, number in self.scales}
        scales = {places[name]: 1 / each if name == REFERENCE else each for name, each in counts.items()}
        return SimulatedDrive(
            self.drive, self.unit, Habits(maximum_hz=self.maximum_hz, scales=scales), ascii_mode=ascii_mode
        )

    @property
    def zeros(self) -> tuple[Span, ...]:
        """Its registers that read 0 until somebody writes them."""
        return self.made(ascii_mode=False).table.zeros

    def told(self) -> list[str]:
        """What it is set to, in lines."""
        full = " (100 %)" if reference(self.drive).percent else ""
        given = dict(self.scales)
        scales = [f"{name}={given.get(name, _usual(name))}" for name in open_scales(self.drive)]
        text = ", ".join((f"{self.drive.prefix} at unit {self.unit}: maximum {self.maximum_hz} Hz{full}", *scales))
        return textwrap.wrap(text, WIDTH, subsequent_indent="  ")

    def unwritten(self) -> list[str]:
        """The registers that read 0, in lines."""
        spans = ", ".join(map(span_text, self.zeros))
        return textwrap.wrap(f"  reads 0 until written: {spans}", WIDTH, subsequent_indent="  ") if spans else []


def open_scales(drive: Drive) -> dict[str, int]:
    """The scales that a drive's manual does not give, by their names in VFD_Settings, each with its register."""
    speed = reference(drive)
    found = {} if speed.scaled or speed.part else {REFERENCE: speed.register}
    unscaled = {each.name: each.register for each in measures(drive) if not each.quantity.factors}
    return found | {name: unscaled[shows] for shows, (_, _, name) in PINS.items() if shows in unscaled}


def words(named: Sequence[str]) -> list[Word]:
    """The drives of texts with commas or spaces between them."""
    found = [_WORD.fullmatch(word) for each in named for word in each.replace(",", " ").split()]
    return [Word(one["name"], one["unit"] or "", tuple(one["facts"].split(":")[1:])) for one in found if one]


def named(drives: Sequence[Word], find: Callable[[str], tuple[Path, Drive]], option: str = "") -> list[Named]:
    """The drives that are named, in their order; `find` gives a name's map. Raises Refused, and what `find` raises."""
    made: list[Named] = []
    for one in drives:
        taken = {each.unit for each in made}
        free = next((each for each in range(1, HIGHEST_UNIT + 1) if each not in taken), HIGHEST_UNIT)
        unit = int(one.unit) if re.fullmatch("[0-9]{1,3}", one.unit) else 0 if one.unit else free
        if not 1 <= unit <= HIGHEST_UNIT or unit in taken:
            why = f"units are 1 to {HIGHEST_UNIT}, one drive each; write {one.name}@{free}"
            raise Refused(f"{option}{one.name}@{one.unit}: {why}")
        path, drive = find(one.name)
        hertz, scales = _facts(drive, one, option)
        made.append(Named(path, drive, unit, hertz, tuple(scales.items())))
    return made


def of_program(
    program: Controller, maps: Sequence[Source], drives: Sequence[DriveBlock] | None = None
) -> Iterator[Named]:
    """The drives of a program, or some of them, each at the unit address of its block, set as they left the factory."""
    known = {each.drive.prefix.upper(): each for each in maps}
    for block in program.wiring.drives if drives is None else drives:
        if unit := program.unit(block):
            yield Named(known[block.prefix].path, known[block.prefix].drive, unit)


def told(drives: Sequence[Named]) -> Iterator[str]:
    """What some drives are set to, and how many of their registers read 0, in lines."""
    for one in drives:
        yield from one.told()
    if count := sum(len(range(each.first, each.last + 1)) for one in drives for each in one.zeros):
        yield f"{count} registers read 0 until written: see driveblocks simulate DRIVE"


def _facts(drive: Drive, one: Word, option: str) -> tuple[int, dict[str, str]]:
    """The maximum in Hz, and the scales that are set. Raises Refused."""
    given: dict[str, str] = {}
    for fact in one.facts:
        name, is_scale, number = fact.rpartition("=")
        wrong = f"{option}{one.name}: `{fact}`"
        if name in given:
            raise Refused(f"{wrong} comes after another one; write one of them")
        if is_scale:
            _judge_scale(drive, name, number, wrong)
        elif not re.fullmatch("[0-9]{1,3}", number) or not 1 <= int(number) <= HIGHEST_HZ:
            raise Refused(f"{wrong} is no maximum; write whole Hz, 1 to {HIGHEST_HZ}, such as :{FACTORY_HZ}")
        given[name] = number
    return int(given.pop("", FACTORY_HZ)), given


def _judge_scale(drive: Drive, name: str, number: str, wrong: str) -> None:
    """Raises Refused where the manual gives the scale or the drive has none such, and for a number that is none."""
    scales = open_scales(drive)
    if name not in scales:
        left = ", ".join(scales) or "no scale"
        raise Refused(f"{wrong} cannot be set; the manual of {drive.prefix} does not give: {left}")
    least, most = (LEAST, MOST) if name == REFERENCE else (FINEST, COARSEST)
    if not _NUMBER.fullmatch(number) or not least <= Decimal(number) <= most:
        unit = "counts per Hz" if name == REFERENCE else "per count"
        raise Refused(f"{wrong} is no scale; write {least} to {most} {unit}, such as {name}={_usual(name)}")


def _usual(name: str) -> str:
    return COUNTS_PER_HERTZ if name == REFERENCE else PER_COUNT
