"""How much a map holds, per section and per kind; computed from the model, so that no figure is ever typed."""

from collections.abc import Iterable
from dataclasses import dataclass

from driveblocks.maps.model import Drive, Register, Section
from driveblocks.maps.view import named_bits


@dataclass(frozen=True)
class Tally:
    """What a part of a map lists."""

    registers: int = 0
    """Addresses in use; a range counts each of its addresses."""
    bits: int = 0
    """Named bits and fields; of a mask register, the bit of each value."""
    enums: int = 0
    """Lists of values: of registers, of bit fields, of keypad settings."""
    enum_values: int = 0
    """Entries of those lists."""

    def __add__(self, other: "Tally") -> "Tally":
        return Tally(
            self.registers + other.registers,
            self.bits + other.bits,
            self.enums + other.enums,
            self.enum_values + other.enum_values,
        )


@dataclass(frozen=True)
class Counts:
    """What a map holds."""

    sections: dict[str, Tally]
    """By id of the section, in the manual's order."""
    settings: int
    setting_values: Tally
    faults: int
    errors: int
    frames: int
    errata: int
    absent: int
    notices: int

    @property
    def total(self) -> Tally:
        return sum(self.sections.values(), self.setting_values)


def of_drive(drive: Drive) -> Counts:
    return Counts(
        sections={section.id: of_section(section) for section in drive.sections},
        settings=len(drive.settings),
        setting_values=_lists(setting.values for setting in drive.settings),
        faults=len(drive.faults.codes),
        errors=len(drive.errors.codes),
        frames=len(drive.frames),
        errata=len(drive.errata),
        absent=len(drive.absent),
        notices=len(drive.notices),
    )


def of_section(section: Section) -> Tally:
    return sum((_row(row) for row in section.registers if not row.unused), Tally())


def _row(row: Register) -> Tally:
    one = Tally(registers=1, bits=len(named_bits(row))) + _lists((row.values, *(bit.values for bit in row.bits)))
    return sum((one for _ in row.address), Tally())


def _lists(lists: Iterable[tuple[object, ...]]) -> Tally:
    used = [len(values) for values in lists if values]
    return Tally(enums=len(used), enum_values=sum(used))


def plain(counts: Counts) -> dict[str, object]:
    """The counts for JSON: totals by kind, and `sections` by id."""
    return {
        **vars(counts.total),
        **{key: value for key, value in vars(counts).items() if isinstance(value, int)},
        "sections": {id_: vars(tally) for id_, tally in counts.sections.items()},
    }
