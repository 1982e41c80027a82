"""Registers that say again what others say, such as the reference among the monitors, known by how maps name them."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from decimal import Decimal

from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive, Register
from driveblocks.maps.plan import merged
from driveblocks.meaning.measure import measures
from driveblocks.meaning.quantity import of_row
from driveblocks.meaning.reference import reference
from driveblocks.meaning.words import words

_NAMES = {
    "asked": r"set frequency|frequency (reference|command|setting)|commanded frequency",
    "output_frequency": r"(output|running) frequency( after soft start)?",
    "speed": r"(running|motor|actual|output) speed",
    "fault": r"(present|current|active) fault( code)?",
    "last_fault": r"(last|previous|latest) fault( code)?",
    "output_current": r"(output|motor) current",
    "output_voltage": r"output voltage( reference)?",
    "dc_bus_voltage": r"dc[ -]bus voltage|bus voltage",
    "output_power": r"output power",
}
_AT_FAULT = " at fault"
RPM_OF_ONE_PAIR = 60
"""In a hertz, of a motor with one pole pair without slip."""


@dataclass(frozen=True)
class Copy:
    """A register, what it shows, and thousandths of its unit in a count; of a fault, its code is shown."""

    register: int
    shows: str
    milli: int
    signed: bool
    at_fault: bool = False
    """It shows how things were at the last fault."""
    same: int | None = None
    """The register whose word it shows."""


def copies(drive: Drive, habits: Habits, known: Iterable[int]) -> tuple[Copy, ...]:
    """Those of a map whose registers are not known already."""
    hertz = next((each for each in measures(drive) if each.name == "output_frequency"), None)
    usual = (hertz and hertz.quantity.factor) or habits.scales.get(hertz.register if hertz else -1, habits.scale)
    found, taken = [], set(known)
    unscaled = {"asked": usual, "output_frequency": usual, "speed": Decimal(1)}
    told = [row for _, row in drive.registers() if row.bits and drive.is_read(row)]
    words = {_bits(row): row.address.first for row in told if row.address.first in taken}
    for section, row in drive.registers():
        at_fault = (row.name or "").endswith(_AT_FAULT)
        shows, address, same = _shows(row), row.address.first, words.get(_bits(row)) if row.bits else None
        if (shows or same is not None) and (row.access or section.access) == "r" and address not in taken:
            factor = of_row(row, address).factor or unscaled.get(shows or "", habits.scale)
            milli = max(1, int(1000 * habits.scales.get(address, factor)))
            found.append(Copy(address, shows or "word", milli, row.signed, at_fault, same))
    return tuple(found)


def _shows(row: Register) -> str | None:
    """What a row shows; None where its name does not say it, or where it is a word of bits or a choice of values."""
    if row.bits or row.name is None or row.address.first != row.address.last:
        return None
    if row.values and not re.fullmatch(_NAMES["fault"], row.name, re.IGNORECASE):
        return None
    name = row.name.removesuffix(_AT_FAULT)
    return next((shows for shows, names in _NAMES.items() if re.fullmatch(names, name, re.IGNORECASE)), None)


def _bits(row: Register) -> tuple[tuple[int, str], ...]:
    """What the bits of a row mean: two rows with the same show the same."""
    return tuple((each.bit.first, each.name) for each in row.bits if each.name)


def zeros(drive: Drive, known: Iterable[int]) -> tuple[Span, ...]:
    """The registers of a map that read 0 until somebody writes them."""
    told = {one.last.register for one in words(drive).commands} | {reference(drive).register}
    taken, free = {*known, *told}, list[int]()
    for section, row in drive.registers():
        if "r" in (row.access or section.access) and not row.unused:
            free += (each for each in row.address if each not in taken)
    return tuple(merged(Span(each, each) for each in free))
