"""The registers of a drive that may be read, in the order of its manual, and what their words mean."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive, Register
from driveblocks.maps.pair import is_first, number_of, whole
from driveblocks.maps.plan import group
from driveblocks.meaning.quantity import of_row
from driveblocks.meaning.setting import settings


@dataclass(frozen=True)
class Row:
    """A register; the id is that of the keypad, empty where it has none."""

    address: int
    id: str
    name: str
    set: bool
    """A person sets it: it has an id or is in an area of parameters, and may be written."""
    default: str = ""
    """Factory setting as the manual prints it."""
    register: Register | None = None


def rows(drive: Drive) -> list[Row]:
    """Every readable register: those of the tables, then areas by number, but none of an area with forbidden ids."""
    defaults = {each.register: each.default for each in settings(drive) if each.register is not None}
    found: dict[int, Row] = {}
    for section, one in drive.registers():
        access = one.access or section.access
        if "r" not in access or one.unused:
            continue
        for place, address in enumerate(one.address):
            settable = bool(one.id) and "w" in access
            row = Row(address, _id(one, place), one.name or "", settable, defaults.get(address, ""), one)
            found.setdefault(address, row)
    for area in drive.areas:
        if "r" in area.access and not area.excluded:
            for address in area.addresses:
                number = str(address - area.addresses.first)
                row = Row(address, number, area.name, "w" in area.access, defaults.get(address, ""))
                found.setdefault(address, row)
    return list(found.values())


def _id(one: Register, place: int) -> str:
    """The id of one register of a row that may have several: A2-02 of A2-01..A2-32."""
    first, several, _ = (one.id or "").partition("..")
    number = re.search("[0-9]+$", first)
    if not several or number is None:
        return first
    return f"{first[: number.start()]}{int(number[0]) + place:0{len(number[0])}}"


def unread(drive: Drive) -> Iterator[str]:
    """What is left out, and why."""
    for area in drive.areas:
        if area.excluded:
            ids = ", ".join(each.ids for each in area.excluded)
            span = f"{address_text(area.addresses.first)} to {address_text(area.addresses.last)}"
            yield f"{span} are not read: {ids}, among them, must not be, and the manual does not say where"


def spans(drive: Drive, wanted: list[int], most: int) -> list[Span]:
    """The addresses as runs of `most` at most, none in two groups of the drive, by address."""
    found: list[Span] = []
    for address in sorted(wanted):
        same = bool(found) and group(drive, address) == group(drive, found[-1].last)
        begun = whole(drive, address)[0] < address  # the second word of a value, which no run leaves alone
        room = begun or sum(map(len, found[-1:])) + len(whole(drive, address)) <= most
        if same and address == found[-1].last + 1 and room:
            found[-1] = Span(found[-1].first, address)
        else:
            found.append(Span(address, address))
    return found


def value(row: Row, word: int, words: Mapping[int, int]) -> tuple[str, str]:
    """A word as a person reads it, and its unit; `words` are all that are known, for scales that depend on others."""
    one = row.register
    if one is None:
        return str(word), ""
    if one.bits or one.masks:
        return f"{word:04X}H", ""
    rest = range(row.address + 1, row.address + one.size)
    if not is_first(one, row.address) or any(each not in words for each in rest):
        return str(word), ""  # half a value
    number = number_of(one, [word, *(words[each] for each in rest)])
    named = next((each.name for each in one.values if each.value == number), None)
    if named is not None:
        return f"{number} {named}", ""
    for factor in of_row(one, row.address).factors:
        when = factor.when
        if when is None or (when.register in words and when.holds(words[when.register])):
            return f"{number * factor.value:f}", one.unit or ""
    return str(number), f"{one.unit} ?" if one.unit else ""
