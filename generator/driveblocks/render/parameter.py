"""Map -> values ready to print, of what a ladder user reads and writes beside the pins: single parameters."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.maps.form import Span, is_bit, space_of
from driveblocks.maps.model import Drive, Storage
from driveblocks.maps.plan import Plan, holding, merged
from driveblocks.meaning.measure import own_maximum
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.setting import settings
from driveblocks.meaning.words import words
from driveblocks.render.context import source_of

MOST = 4
"""Registers of a compartment; the last word of a write holds the mark of its block."""

_ID = re.compile(r"([A-Za-z]?)(?:([0-9]{1,3})?[.-]+)?([0-9]{1,4})")
"""An id of a manual: letter, group, number."""

_Key = tuple[int, int, int]
"""A parameter: its letter by its ASCII code, its group, its number; 0 for what its id does not have."""

# ---------------------------------------------------------------- which registers may be written


@dataclass(frozen=True)
class Ranged:
    """Registers with a range that a ladder user may write."""

    span: Span
    signed: bool
    min: int
    max: int


@dataclass(frozen=True)
class MayWrite:
    """For MayWrite."""

    name: str
    can_write: str
    fixed: tuple[Span, ...]
    """What is read only, or not used."""
    refused: list[tuple[str, str, tuple[Span, ...]]]
    """The name of the result, why, and the spans, from the weakest to the strongest."""
    ranges: list[Ranged]


def may_write(drive: Drive, allowed: Plan) -> MayWrite:
    """What a ladder user may write, and why not the rest."""
    kept = [
        ("LINE_SETTING", "what the connection and the full scale rest on", _with_aliases(drive, _settings(drive))),
        ("OWNED", "what moves the motor", _with_aliases(drive, _commanded(drive))),
        ("STORE_REGISTER", "what stores in the memory", _with_aliases(drive, [drive.storage.register])),
    ]
    taken = {one for _, _, some in kept for one in some}
    writable = {address for span in holding(allowed.writable) for address in span}
    fixed = _spans(_with_aliases(drive, _listed(drive)) - writable - taken)
    return MayWrite(
        name=f"{drive.prefix}_MayWrite",
        can_write=f"{drive.prefix}_CanWrite",
        fixed=fixed,
        refused=[(name, why, _spans(some)) for name, why, some in kept if some],
        ranges=list(_ranges(drive, writable - taken)),
    )


def _settings(drive: Drive) -> Iterator[int | None]:
    """The registers of the settings but limits and ramps, and of the maximum that the full scale is compared with."""
    yield from (one.register for one in drive.settings if not drive.adjusts(one))
    yield maximum.register if (maximum := own_maximum(drive)) else None


def _commanded(drive: Drive) -> Iterator[int]:
    """The registers by which the drive block moves the motor."""
    yield from reference(drive).registers
    yield from (each.register for each in words(drive).registers if not is_bit(each.register))


def _listed(drive: Drive) -> Iterator[int]:
    for _, row in drive.registers():
        yield from row.address if space_of(row.address.first) == "holding" else ()
    for area in drive.areas:
        yield from area.addresses


def _with_aliases(drive: Drive, addresses: Iterable[int | None]) -> set[int]:
    """Those of some addresses that are known, and where a drive has the same again: in RAM, or stored."""
    bit, twins = drive.storage.add or 0, drive.storage.twins
    pairs = {first: second for one in twins for first, second in ((one.ram, one.stored), (one.stored, one.ram))}
    return {alias for one in addresses if one is not None for alias in (one, one | bit, pairs.get(one, one))}


def _spans(addresses: Iterable[int]) -> tuple[Span, ...]:
    """Addresses as runs."""
    return merged(Span(each, each) for each in addresses)


def _ranges(drive: Drive, writable: set[int]) -> Iterator[Ranged]:
    for _, row in drive.registers():
        written = drive.register_at(row.address.first, "w") is row
        for span in _again(drive, row.address):
            if row.range is not None and not row.words and written and writable.issuperset(span):
                yield Ranged(span, row.signed, row.range.min, row.range.max)


def _again(drive: Drive, span: Span) -> Iterator[Span]:
    """A row's registers, and the same with the bit that spares the memory."""
    yield span
    if drive.storage.add is not None:
        yield Span(span.first + drive.storage.add, span.last + drive.storage.add)


# ---------------------------------------------------------------- the manual's numbers


@dataclass(frozen=True)
class Run:
    """Numbers whose registers follow each other."""

    first: int
    last: int
    base: int

    @property
    def span(self) -> Span:
        """The numbers."""
        return Span(self.first, self.last)

    @property
    def registers(self) -> Span:
        """Their registers."""
        return Span(self.base, self.base + self.last - self.first)

    @property
    def away(self) -> int:
        """What turns a number into its register."""
        return self.base - self.first


@dataclass(frozen=True)
class Example:
    """An id of the manual, whole and in its parts."""

    letter: int
    group: int
    number: int
    id: str


@dataclass(frozen=True)
class Group:
    """The runs of a group of parameters."""

    name: str
    runs: list[Run]


@dataclass(frozen=True)
class ParameterAddress:
    """For ParameterAddress: runs by letter and group."""

    name: str
    letters: dict[int, dict[int, Group]]
    example: Example


@dataclass(frozen=True)
class NumberAddress:
    """For NumberAddress."""

    name: str
    run: Run
    what: str
    source: str


def addresses(drive: Drive) -> ParameterAddress | NumberAddress | None:
    """What turns the manual's numbers into addresses; None where they prove none.

    Ids such as H5-02, F0.04, A40 or 20.01 come from the rows of the tables; the only area gives numbers where no row
    has an id.
    """
    name = f"{drive.prefix}_ParameterAddress"
    known = _numbered(drive)
    if known:
        letter, group, number = min(known)
        example = Example(letter, group, number, f"{_group(letter, group)}-{number:02d}")
        return ParameterAddress(name, _letters(known), example)
    if len(drive.areas) != 1:
        return None
    area = drive.areas[0]
    run = Run(0, len(area.addresses) - 1, area.addresses.first)
    what = area.numbered_by.replace("_", " ")
    return NumberAddress(name, run, what, source_of(drive, area.source))


def _numbered(drive: Drive) -> dict[_Key, int]:
    """The parameters that have an id -> their registers; without those that two rows claim."""
    found: dict[_Key, set[int]] = {}
    for id_, first, count in _ids(drive):
        parts = _ID.fullmatch(id_.partition("..")[0])
        if parts is not None:
            letter, group = ord(parts[1] or "\0"), int(parts[2] or 0)
            for index in range(count):
                found.setdefault((letter, group, int(parts[3]) + index), set()).add(first + index)
    return {key: min(places) for key, places in found.items() if len(places) == 1}


def _group(letter: int, group: int) -> str:
    """A group as its ids begin, such as H5."""
    return (chr(letter) if letter else "") + (str(group) if group else "")


def _ids(drive: Drive) -> Iterator[tuple[str, int, int]]:
    """Each id with its first address and the number of registers."""
    for _, row in drive.registers():
        if row.id is not None and not row.unused and space_of(row.address.first) == "holding":
            yield row.id, row.address.first, len(row.address)
    yield from ((one.id, one.register, 1) for one in settings(drive) if one.register is not None)


def _letters(known: dict[_Key, int]) -> dict[int, dict[int, Group]]:
    letters: dict[int, dict[int, Group]] = {}
    for (letter, group, number), address in sorted(known.items()):
        runs = letters.setdefault(letter, {}).setdefault(group, Group(_group(letter, group), [])).runs
        if runs and number == runs[-1].last + 1 and address == runs[-1].away + number:
            runs[-1] = replace(runs[-1], last=number)
        else:
            runs.append(Run(number, number, address))
    return letters


# ---------------------------------------------------------------- the part of the drive block


@dataclass(frozen=True)
class Passing:
    """For the part of a drive block that lets parameters pass: its functions, limits and how it stores."""

    prefix: str
    read: int
    most_read: int
    single: bool
    multiple: bool
    most_written: int
    store: Storage | None


def passing(drive: Drive, allowed: Plan) -> Passing:
    """What of parameters passes."""
    rtu, ascii_, modes = allowed.rtu, allowed.ascii, serial(drive).modes
    words = [some for mode, some in (("rtu", rtu), ("ascii", ascii_)) if mode in modes]
    written = min(some.write for some in words) if 16 in allowed.functions else 0
    store = drive.storage if drive.storage.method == "enter_register" else None
    return Passing(
        prefix=drive.prefix,
        read=3 if 3 in allowed.functions else 4,
        most_read=min(MOST, *(some.read for some in words)),
        single=6 in allowed.functions,
        multiple=16 in allowed.functions,
        most_written=max(min(MOST - 1, written), int(6 in allowed.functions)),
        store=store,
    )
