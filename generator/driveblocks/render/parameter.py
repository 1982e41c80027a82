"""Map -> values ready to print, of what a ladder user reads and writes beside the pins: single parameters."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import Plan
from driveblocks.maps.rules.parameter import numbered
from driveblocks.render.context import Context, source_of

MOST = 4
"""Registers of a compartment; the last word of a write holds the mark of its block."""


# ---------------------------------------------------------------- which registers may be written


def may_write(drive: Drive, allowed: Plan) -> Context:
    """For MayWrite: spans that are refused, each with the name of its result, from the weakest to the strongest."""
    kept = {
        "LINE_SETTING": _with_aliases(drive, (one.register for one in drive.settings)),
        "OWNED": _with_aliases(drive, _commanded(drive)),
        "STORE_REGISTER": _with_aliases(drive, [drive.storage.register]),
    }
    taken = set().union(*kept.values())
    writable = {address for span in allowed.writable for address in span}
    fixed = _spans(_with_aliases(drive, _listed(drive)) - writable - taken)
    return {
        "name": f"{drive.prefix}_MayWrite",
        "can_write": f"{drive.prefix}_CanWrite",
        "fixed": fixed,
        "refused": {name: _spans(some) for name, some in kept.items() if some},
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
    """Those of some addresses that are known, and the same with the bit by which a drive leaves its memory alone."""
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


def addresses(drive: Drive) -> Context | None:
    """For ParameterAddress: the manual's numbers as runs by group; None where they prove no address.

    Ids that end in a number come from the rows of the tables; the only area gives them where no row has one.
    """
    groups = _groups(_numbered(drive))
    what, source = "an id of the manual", ""
    if not groups:
        if len(drive.areas) != 1:
            return None
        area = drive.areas[0]
        groups = {"": [_Run(0, len(area.addresses) - 1, area.addresses.first)]}
        what, source = f"a {area.numbered_by.replace('_', ' ')}", source_of(drive, area.source)
    first = next(iter(groups))
    return {
        "name": f"{drive.prefix}_ParameterAddress",
        "groups": groups,
        "what": what,
        "source": source,
        "example": (first, groups[first][0].last),
    }


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


def _numbered(drive: Drive) -> dict[tuple[str, int], int]:
    """Group and number of each id -> its address; without those that two rows claim."""
    found: dict[tuple[str, int], set[int]] = {}
    for id_, first, count in _ids(drive):
        start = id_.partition("..")[0]
        prefix, number = numbered(start)
        group = prefix.rstrip("-.")
        for index in range(count if group and prefix != start else 0):
            found.setdefault((group, number + index), set()).add(first + index)
    return {key: min(places) for key, places in found.items() if len(places) == 1}


def _ids(drive: Drive) -> Iterator[tuple[str, int, int]]:
    """Each id with its first address and the number of registers."""
    for _, row in drive.registers():
        if row.id is not None and not row.unused:
            yield row.id, row.address.first, len(row.address)
    for setting in drive.settings:
        if setting.register is not None:
            yield setting.id, setting.register, 1


def _groups(known: dict[tuple[str, int], int]) -> dict[str, list[_Run]]:
    """Runs of numbers whose addresses follow each other, by group."""
    groups: dict[str, list[_Run]] = {}
    for (group, number), address in sorted(known.items()):
        runs = groups.setdefault(group, [])
        if runs and number == runs[-1].last + 1 and address == runs[-1].away + number:
            runs[-1] = replace(runs[-1], last=number)
        else:
            runs.append(_Run(number, number, address))
    return groups


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
