"""Map -> values ready to print, of what a ladder user reads and writes beside the pins: single parameters."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import Plan
from driveblocks.render.context import Context, source_of

MOST = 4
"""Registers of a compartment; the last word of a write holds the mark of its block."""

_ID = re.compile(r"([A-Za-z]?)(?:([0-9]{1,3})?[.-]+)?([0-9]{1,4})")
"""An id of a manual: letter, group, number."""

_Key = tuple[int, int, int]
"""A parameter: its letter by its ASCII code, its group, its number; 0 for what its id does not have."""

# ---------------------------------------------------------------- which registers may be written


def may_write(drive: Drive, allowed: Plan) -> Context:
    """For MayWrite: spans that are refused with the name of the result and why, from the weakest to the strongest."""
    kept = [
        (
            "LINE_SETTING",
            "what the connection rests on",
            _with_aliases(drive, (one.register for one in drive.settings)),
        ),
        ("OWNED", "what moves the motor", _with_aliases(drive, _commanded(drive))),
        ("STORE_REGISTER", "what stores in the memory", _with_aliases(drive, [drive.storage.register])),
    ]
    taken = {one for _, _, some in kept for one in some}
    writable = {address for span in allowed.writable for address in span}
    fixed = _spans(_with_aliases(drive, _listed(drive)) - writable - taken)
    return {
        "name": f"{drive.prefix}_MayWrite",
        "can_write": f"{drive.prefix}_CanWrite",
        "fixed": fixed,
        "refused": [(name, why, _spans(some)) for name, why, some in kept if some],
        "ranges": list(_ranges(drive, writable - taken)),
    }


def _commanded(drive: Drive) -> Iterator[int]:
    """The registers by which the drive block moves the motor."""
    yield drive.operation.reference.register
    for command in drive.operation.commands:
        yield command.register
        for step in command.first:
            yield step.register


def _listed(drive: Drive) -> Iterator[int]:
    for _, row in drive.registers():
        yield from row.address
    for area in drive.areas:
        yield from area.addresses


def _with_aliases(drive: Drive, addresses: Iterable[int | None]) -> set[int]:
    """Those of some addresses that are known, and the same with the bit by which a drive spares its memory."""
    bit = drive.storage.add or 0
    return {alias for one in addresses if one is not None for alias in (one, one | bit)}


def _spans(addresses: Iterable[int]) -> list[Span]:
    """Addresses as runs."""
    runs: list[Span] = []
    for address in sorted(addresses):
        if runs and address == runs[-1].last + 1:
            runs[-1] = Span(runs[-1].first, address)
        else:
            runs.append(Span(address, address))
    return runs


def _ranges(drive: Drive, writable: set[int]) -> Iterator[Context]:
    """Rows with a range that a ladder user may write."""
    for _, row in drive.registers():
        if row.range is not None and writable.issuperset(row.address):
            yield {"span": row.address, "signed": row.signed, "min": row.range.min, "max": row.range.max}


# ---------------------------------------------------------------- the manual's numbers


def addresses(drive: Drive) -> tuple[str, Context] | None:
    """The template for the manual's numbers and what it prints; None where they prove no address.

    Ids such as H5-02, F0.04, A40 or 20.01 come from the rows of the tables; the only area gives numbers where no row
    has an id.
    """
    name = f"{drive.prefix}_ParameterAddress"
    known = _numbered(drive)
    if known:
        letter, group, number = min(known)
        example = {"letter": letter, "group": group, "number": number, "id": f"{_group(letter, group)}-{number:02d}"}
        return "ParameterAddress", {"name": name, "letters": _letters(known), "example": example}
    if len(drive.areas) != 1:
        return None
    area = drive.areas[0]
    run = _Run(0, len(area.addresses) - 1, area.addresses.first)
    what = area.numbered_by.replace("_", " ")
    return "NumberAddress", {"name": name, "run": run, "what": what, "source": source_of(drive, area.source)}


@dataclass(frozen=True)
class _Run:
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
        if row.id is not None and not row.unused:
            yield row.id, row.address.first, len(row.address)
    for setting in drive.settings:
        if setting.register is not None:
            yield setting.id, setting.register, 1


def _letters(known: dict[_Key, int]) -> dict[int, dict[int, Context]]:
    """Runs of numbers whose registers follow each other, by letter and group."""
    letters: dict[int, dict[int, Context]] = {}
    for (letter, group, number), address in sorted(known.items()):
        empty: Context = {"name": _group(letter, group), "runs": []}
        runs = letters.setdefault(letter, {}).setdefault(group, empty)["runs"]
        if runs and number == runs[-1].last + 1 and address == runs[-1].away + number:
            runs[-1] = replace(runs[-1], last=number)
        else:
            runs.append(_Run(number, number, address))
    return letters


# ---------------------------------------------------------------- the part of the drive block


def passing(drive: Drive, allowed: Plan) -> Context:
    """For the part of a drive block that lets parameters pass: its functions, limits and how it stores."""
    rtu, ascii_, modes = allowed.rtu, allowed.ascii, drive.serial.mode.modes
    words = [some for mode, some in (("rtu", rtu), ("ascii", ascii_)) if mode in modes]
    written = min(some.write for some in words) if 16 in allowed.functions else 0
    store = drive.storage if drive.storage.method == "enter_register" else None
    return {
        "prefix": drive.prefix,
        "read": 3 if 3 in allowed.functions else 4,
        "most_read": min(MOST, *(some.read for some in words)),
        "single": 6 in allowed.functions,
        "multiple": 16 in allowed.functions,
        "most_written": max(min(MOST - 1, written), int(6 in allowed.functions)),
        "store": store,
    }
