"""Which addresses of a drive may be read and written, and how many words a frame may carry."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Drive, Register, Section

MOST_READ, MOST_WRITTEN = 125, 123
"""MODBUS Application Protocol V1.1b3, 6.3 and 6.12."""

LAST = 0xFFFF
"""The last holding register; addresses of other tables lie beyond."""

READ_HEAD, WRITE_HEAD = 1, 5
"""Data bytes that are no words: the byte count of a read reply; address, quantity and byte count of a 10H request."""


def readable(drive: Drive) -> frozenset[int]:
    """Every holding register that may be read: readable rows, those not in use included, and readable areas."""
    rows = [row.address for section, row in _rows(drive) if "r" in (row.access or section.access)]
    areas = [area.addresses for area in drive.areas if "r" in area.access]
    return frozenset(address for span in (*rows, *areas) for address in span)


def writable(drive: Drive) -> frozenset[int]:
    """Every address that may be written: rows in use, areas, and what writes to RAM alone."""
    return frozenset((*_written_rows(drive), *_written_areas(drive), *ram_only(drive)))


def _rows(drive: Drive) -> Iterator[tuple[Section, Register]]:
    """The rows of holding registers; a user names no others."""
    return ((section, row) for section, row in drive.registers() if row.address.first <= LAST)


def _written_rows(drive: Drive) -> Iterator[int]:
    for section, row in _rows(drive):
        if "w" in (row.access or section.access) and not row.unused:
            yield from row.address


def _written_areas(drive: Drive) -> Iterator[int]:
    for area in drive.areas:
        if "w" in area.access:
            yield from area.addresses


def ram_only(drive: Drive) -> Iterator[int]:
    """The addresses of the parameter area or section plus what the storage rule adds: not stored there."""
    for area in drive.areas:
        if area.id == drive.storage.area and drive.storage.add is not None:
            for address in area.addresses:
                yield address + drive.storage.add
    for section, row in _rows(drive):
        if section.id == drive.storage.area and drive.storage.add is not None and not row.unused:
            for address in row.address if "w" in (row.access or section.access) else ():
                yield address + drive.storage.add


@dataclass(frozen=True)
class Write:
    """A ladder user's request to write a register."""

    address: int
    value: int = 0
    unknown: bool = False
    stopped: bool = True


def _of_reference(drive: Drive) -> Iterator[int]:
    """The reference register, or both of a pair."""
    first = drive.operation.reference.register
    row = drive.register_at(first, "w")
    yield from range(first, first + (row.words or 1 if row else 1))


class Judge:
    """Says of every request to write a register of a drive which result it has."""

    def __init__(self, drive: Drive) -> None:
        operation = drive.operation
        steps = (step.register for command in operation.commands for step in command.first)
        commands = (command.register for command in operation.commands)
        own = operation.own_maximum
        kept = {
            one.register
            for one in drive.settings
            if one.needed or not (one.id == operation.lower_limit or (one.display and one.display.unit in ("Hz", "s")))
        }
        self._known: dict[str, set[int | None]] = {
            "STORE_REGISTER": {drive.storage.register},
            "OWNED": {*_of_reference(drive), *commands, *steps},
            "LINE_SETTING": {*kept, own.register if own else None},
        }
        self._writable = writable(drive)
        rows = sorted(
            (row for _, row in _rows(drive)), key=lambda row: drive.register_at(row.address.first, "w") is row
        )
        self._rows = {address: row for row in rows for address in row.address}
        self._areas = frozenset(address for area in drive.areas for address in area.addresses)
        self._bit = drive.storage.add or 0
        self._twins: dict[int, int] = {}
        for twin in drive.storage.twins:
            self._twins |= {twin.ram: twin.stored, twin.stored: twin.ram}

    def result(self, wish: Write) -> str:
        """The name of the result; `OK` where it may be written."""
        again = self._twins.get(wish.address, wish.address)
        meant: set[int | None] = {wish.address, wish.address & ~self._bit, again}
        for name, registers in self._known.items():
            if meant & registers:
                return name
        if wish.address not in self._writable:
            if meant & (self._rows.keys() | self._areas):
                return "NOT_WRITABLE"
            if not wish.unknown:
                return "UNKNOWN_ADDRESS"
        elif self._beyond(wish):
            return "RANGE"
        return "OK" if wish.stopped else "NOT_STOPPED"

    def _beyond(self, wish: Write) -> bool:
        row = self._rows.get(wish.address) or self._rows.get(wish.address & ~self._bit)
        if row is None or row.range is None or row.words == 2:
            return False
        number = wish.value - 0x10000 if row.signed and wish.value > 0x7FFF else wish.value
        return not row.range.min <= number <= row.range.max


Numbered = tuple[str, int, int]
"""Letter, group and number of a parameter: H5-02 is ("H", 5, 2), A40 is ("A", 0, 40), 20.01 is ("", 20, 1)."""


def parameters(drive: Drive) -> dict[Numbered, int]:
    """Each parameter that the manual numbers -> its register; those of an area have a number alone."""
    found: dict[Numbered, set[int]] = {}
    for id_, address in _identified(drive):
        letter = id_[:1] if id_[:1].isalpha() and id_.isascii() else ""
        group, _, number = id_[len(letter) :].replace(".", "-").rpartition("-")
        group = group.rstrip("-") or "0"
        if number.isdecimal() and group.isdecimal() and len(number) < 5 and len(group) < 4:
            found.setdefault((letter, int(group), int(number)), set()).add(address)
    if found or len(drive.areas) != 1:
        return {key: min(some) for key, some in found.items() if len(some) == 1}
    return {("", 0, number): address for number, address in enumerate(drive.areas[0].addresses)}


def _identified(drive: Drive) -> Iterator[tuple[str, int]]:
    for _, row in _rows(drive):
        first = (row.id or "").partition("..")[0]
        for index, address in enumerate(row.address):
            if not row.unused:
                yield _later(first, index), address
    for setting in drive.settings:
        if setting.register is not None:
            yield setting.id, setting.register


def _later(id_: str, steps: int) -> str:
    """The id that comes some steps after another: A2-01 -> A2-03."""
    return re.sub(r"[0-9]+$", lambda digits: str(int(digits[0]) + steps), id_)


@dataclass(frozen=True)
class Most:
    """Most words that one frame may read and write."""

    read: int
    write: int


def most(drive: Drive, *, ascii_mode: bool) -> Most:
    """The drive's limits of words, and what fits into its data field in a mode."""
    limits = drive.limits
    field = limits.ascii_data_bytes if ascii_mode else limits.data_bytes
    read = limits.read_words.value if limits.read_words else MOST_READ
    write = min(limits.write_words.value if limits.write_words else MOST_WRITTEN, MOST_WRITTEN)
    if field is None:
        return Most(read, write)
    return Most(min(read, (field.value - READ_HEAD) // 2), min(write, (field.value - WRITE_HEAD) // 2))
