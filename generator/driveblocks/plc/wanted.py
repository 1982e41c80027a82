"""Drives that are to be simulated."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from driveblocks.maps import catalog
from driveblocks.maps.collection import Source as Map
from driveblocks.maps.load import load
from driveblocks.plc.controller import Controller
from driveblocks.plc.options import Refused
from driveblocks.plc.wiring import DriveBlock
from driveblocks.simulator.drive import SimulatedDrive
from driveblocks.simulator.habits import Habits

HIGHEST_UNIT = 247
SCALES = {
    "output_frequency": "FrequencyScale", "output_current": "CurrentScale", "output_voltage": "VoltageScale",
    "dc_bus_voltage": "DcVoltageScale", "output_power": "PowerScale",
}  # fmt: skip
"""The pin of a drive block that says what the manual does not."""


@dataclass(frozen=True)
class Wanted:
    """A drive to be simulated: its map, its unit address, and what no manual says of it."""

    path: Path
    unit: int
    maximum_hz: int = 50
    scales: tuple[tuple[int, str], ...] = ()

    @property
    def habits(self) -> Habits:
        """What no manual says of it."""
        scales = {register: Decimal(factor) for register, factor in self.scales}
        return Habits(maximum_hz=self.maximum_hz, scales=scales)

    def made(self, *, ascii_mode: bool) -> SimulatedDrive:
        """The drive. Raises MapError."""
        return SimulatedDrive(load(self.path), self.unit, self.habits, ascii_mode=ascii_mode)


def words(simulate: Sequence[str]) -> list[tuple[str, str]]:
    """Drive and unit of each word of `--simulate`; the unit may be empty."""
    found = [word for each in simulate for word in each.replace(",", " ").split()]
    return [(name, unit) for name, _, unit in (word.partition("@") for word in found)]


def chosen(simulate: Sequence[str], program: Controller, maps: Sequence[Map]) -> list[Wanted]:
    """The drives that are named, else those of the program. Raises Refused."""
    if not simulate:
        blocks = [block for block in program.wiring.drives if program.unit(block)]
        known = {each.drive.prefix.upper(): each for each in maps}
        return [_set(known[block.prefix], program.unit(block), program) for block in blocks]
    made: list[Wanted] = []
    for name, number in words(simulate):
        taken = {one.unit for one in made}
        unit = _unit(number, taken)
        if unit is None:
            free = f"{name}@{next(each for each in range(1, HIGHEST_UNIT + 2) if each not in taken)}"
            raise Refused(f"--simulate {name}@{number}: units are 1 to {HIGHEST_UNIT}, one drive each; write {free}")
        path = catalog.resolve(name).resolve()
        made.append(_set(next(each for each in maps if each.path.resolve() == path), unit, program))
    return made


def _unit(number: str, taken: set[int]) -> int | None:
    """A unit address that no other drive has: the one that is named, or the next free one."""
    if not number:
        return next((each for each in range(1, HIGHEST_UNIT + 1) if each not in taken), None)
    unit = int(number) if number.isdecimal() else 0
    return unit if 1 <= unit <= HIGHEST_UNIT and unit not in taken else None


def _set(known: Map, unit: int, program: Controller) -> Wanted:
    """A drive at a unit, set as the program says where the manual is silent."""
    blocks = [each for each in program.wiring.drives if program.unit(each) == unit]
    mine = [block for block in blocks if program.drive(block) is known.drive]
    if not mine:
        return Wanted(known.path, unit)
    most = _real(program, mine[0], "MaximumHz")
    return Wanted(known.path, unit, round(most) if 1 <= most <= 1000 else 50, tuple(_scales(known, mine[0], program)))


def _scales(known: Map, block: DriveBlock, program: Controller) -> Iterator[tuple[int, str]]:
    operation = known.drive.operation
    counts = _real(program, block, "ReferenceScale")
    if operation.reference.means == "frequency" and counts > 0:
        yield operation.reference.register, f"{1 / counts:.6f}"
    for measure in operation.measures:
        factor = _real(program, block, SCALES[measure.shows])
        if factor > 0:
            yield measure.register, f"{factor:.6f}"


def _real(program: Controller, block: DriveBlock, pin: str) -> float:
    value = program.instance[f"{block.path}.{pin}"]
    return value if isinstance(value, float) else 0.0
