"""No command can be taken for another: every exchange and every other value is refused, in words, fields and bits."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest
from tests import families

from driveblocks.maps import check, load
from driveblocks.maps.form import Span
from driveblocks.maps.model import Bit, Command, Drive, Register
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import word

pytestmark = pytest.mark.every_family

ROOT = Path(__file__).parents[2]
PATHS = [
    *sorted((ROOT / "vendor_maps").glob("*.yaml")),
    *sorted((ROOT / "tests/blocks/fourth_drive").glob("*.yaml")),
    ROOT / "tests/maps/example.yaml",
]
RIGHT = families.said("ALIKE") | {
    "NW7": {
        ("run_forward", "Turn"), ("jog_forward", "Creep"), ("stop", "Ramp down"), ("coast_stop", "Let go"),
        ("quick_stop", "Emergency ramp"), ("fault_reset", "Clear"), ("jog_stop", "End of creep"),
    },
    "BH": {
        ("run_forward", "Forward"), ("run_reverse", "Backward"), ("quick_stop", "Fast stop"), ("coast_stop", "Free"),
        ("fault_reset", "Reset"), ("stop", "Lamp"),
    },
    "EX100": {
        ("run_forward", "Run forward"), ("run_reverse", "Run reverse"), ("fault_reset", "Fault reset"),
        ("coast_stop", "Output blocked"), *(("stop", f"Ramp {number}") for number in (1, 2, 3)),
    },
}  # fmt: skip
"""By prefix, the commands that are what the manual calls so: typed from the tables."""


def _as_field(drive: Drive) -> Drive:
    """The same drive with each command word as a field of bits beside a bit that no command touches."""
    used = {one.register for one in drive.operation.commands}
    sections = tuple(
        replace(part, registers=tuple(_field(row) if row.address.first in used else row for row in part.registers))
        for part in drive.sections
    )
    words = [row.address.first for _, row in drive.registers() if row.values]
    commands = tuple(_bitwise(one) if one.register in words else one for one in drive.operation.commands)
    return replace(drive, sections=sections, operation=replace(drive.operation, commands=commands))


def _field(row: Register) -> Register:
    if not row.values:
        return row
    field = Bit(bit=Span(4, 11), name="Order", zh="命令", values=row.values)
    return replace(row, values=(), bits=(field, Bit(bit=Span(0, 0), name="Lamp", zh="指示灯", does=("nothing",))))


def _bitwise(one: Command, field: Span = Span(4, 11)) -> Command:  # noqa: B008 - a frozen span
    """A value as bits set and cleared in a field."""
    places = [(place, (one.value or 0) >> place - field.first & 1) for place in field]
    ones, zeros = (tuple(Span(place, place) for place, bit in places if bit == on) for on in (1, 0))
    return replace(one, value=None, set=ones, clear=zeros)


WORDS = [load.load(path) for path in PATHS]
DRIVES = [*WORDS, *(_as_field(one) for one in WORDS if one.prefix in ("CHF", "JSCC", "NW7"))]
NAMES = [f"{one.prefix}{'_field' * (index >= len(WORDS))}" for index, one in enumerate(DRIVES)]
drives = pytest.mark.parametrize("drive", DRIVES, ids=NAMES)


def _judged(drive: Drive, *commands: Command) -> list[str]:
    """What all rules say when these commands stand in the place of the map's own of their kind."""
    report = Report("")
    check.check(_with(drive, *commands), report)
    return [problem.wrong for problem in report.problems]


def _with(drive: Drive, *commands: Command) -> Drive:
    """A drive with these commands in the place of its own of their kind."""
    new = {one.does: one for one in commands}
    all_ = tuple(new.get(one.does, one) for one in drive.operation.commands)
    return replace(drive, operation=replace(drive.operation, commands=all_))


@drives
def test_the_maps_are_good_as_they_are(drive: Drive) -> None:
    assert _judged(drive) == []


@drives
def test_no_two_commands_can_be_exchanged(drive: Drive) -> None:
    for one, other in combinations(drive.operation.commands, 2):
        assert _judged(drive, replace(one, does=other.does), replace(other, does=one.does)), (one.does, other.does)


@drives
def test_only_the_value_that_the_table_calls_so_fits_a_command(drive: Drive) -> None:
    fits = set()
    for command in drive.operation.commands:
        for name, other in _everything(drive, command):
            report = Report("")
            word.check(_with(drive, other), {other.does}, report)
            if not report.problems:
                fits.add((command.does, name))
    assert fits == RIGHT[drive.prefix]


def _everything(drive: Drive, command: Command) -> Iterator[tuple[str, Command]]:
    """A command with each value, each value of a field and each single bit of the command registers in its place."""
    for address in {one.register for one in drive.operation.commands}:
        row = drive.register_at(address)
        assert row is not None
        plain = replace(command, register=address, value=None, set=(), clear=(), because=None)
        for value in row.values:
            yield value.name, replace(plain, value=value.value)
        for bit in row.bits:
            for value in bit.values:
                yield value.name, _bitwise(replace(plain, value=value.value), bit.bit)
            if not bit.values and not bit.unused:
                rest = tuple(one.bit for one in row.bits if one is not bit and not one.unused and not one.values)
                yield bit.name or "", replace(plain, set=(bit.bit,), clear=rest)
        if not row.values and not row.bits:
            yield row.name or "", replace(plain, value=1)
