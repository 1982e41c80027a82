"""What the blocks need of a map beyond the map's own rules: identifiers that every compiler takes, each once."""

from collections.abc import Callable, Iterator
from functools import partial

from driveblocks.maps.model import Bit, Drive, Register, Value
from driveblocks.maps.problem import Place, Report
from driveblocks.render import context, names

Named = Register | Bit | Value


def vet(drive: Drive, report: Report) -> None:
    """Note every name that makes no identifier, or one that is taken, with its place in the map."""
    blocks: dict[str, Place] = {}
    for _, row in drive.registers():
        for suffix in _suffixes(row):
            place = row.place("symbol" if row.symbol else "name")
            name = _tried(partial(_block, drive, row, suffix), place, report)
            _once(name, place, blocks, "block", report)
        pins: dict[str, Place] = {"VALUE": row.at, "UNKNOWN": row.at}
        for entry in _pins(row):
            place = entry.place("symbol" if entry.symbol else "name")
            _once(_tried(partial(context.symbol, entry), place, report), place, pins, "output", report)


def _suffixes(row: Register) -> Iterator[str]:
    """The blocks that a register has: a decoder, a scale."""
    if any(bit.name and not bit.unused for bit in row.bits) or row.values:
        yield ""
    if row.scale is not None and row.unit is not None:
        yield context.UNIT_NAMES[row.unit]


def _block(drive: Drive, row: Register, suffix: str) -> str:
    return names.block(drive.prefix, context.symbol(row) + suffix)


def _pins(row: Register) -> Iterator[Named]:
    for bit in row.bits:
        if bit.name and not bit.unused:
            yield bit
            if len(bit.bit) > 1:
                yield from bit.values
    yield from row.values


def _tried(make: Callable[[], str], place: Place, report: Report) -> str:
    try:
        return make()
    except ValueError as error:
        report.add(place, str(error), "add a short `symbol`")
        return ""


def _once(name: str, place: Place, taken: dict[str, Place], kind: str, report: Report) -> None:
    if name and name.upper() in taken:
        line = taken[name.upper()][0]
        report.add(place, f"the {kind} name {name} is taken by line {line}", "add another `symbol`")
    taken.setdefault(name.upper(), place)
