"""What a ladder user may write, and the registers of the manual's numbers, against the reference model."""

from collections.abc import Iterator

from tests.blocks.library import Blocks

from driveblocks.maps.model import Drive
from driveblocks.reference.permission import Judge, Write, parameters
from driveblocks.testing.code import NUMBERS
from structured_text.engines.engine import Value

NEAR = (-1, 0, 1)


def assert_writes(blocks: Blocks, drive: Drive) -> None:
    """Every side of every row, area and alias; every side of every range."""
    judge = Judge(drive)
    for wish in _wishes(drive):
        pins = {"Address": wish.address, "Value": wish.value, "AllowUnknown": wish.unknown, "Stopped": wish.stopped}
        assert blocks.call(f"{drive.prefix}_MayWrite", pins) == NUMBERS[judge.result(wish)], wish


def _wishes(drive: Drive) -> Iterator[Write]:
    spans = [*(row.address for _, row in drive.registers()), *(area.addresses for area in drive.areas)]
    ends = {end | bit for span in spans for end in (span.first, span.last) for bit in (0, drive.storage.add or 0)}
    for address in sorted({end + step & 0xFFFF for end in ends for step in NEAR}):
        yield Write(address)
        yield Write(address, unknown=True)
        yield Write(address, unknown=True, stopped=False)
    for _, row in drive.registers():
        if row.range is not None:
            for value in (row.range.min, row.range.max):
                yield from (Write(row.address.first, value + step & 0xFFFF) for step in NEAR)


def assert_numbers(blocks: Blocks, drive: Drive) -> None:
    """Every number of every group, and those beside them."""
    known = parameters(drive)
    named = any(letter or group for letter, group, _ in known)
    for letter, group, number in sorted((one, two, last + step) for one, two, last in known for step in NEAR):
        pins: dict[str, Value] = {"Number": max(number, 0)}
        if named:
            pins |= {"Letter": ord(letter or "\0"), "Group": group}
        found = blocks.call(f"{drive.prefix}_ParameterAddress", pins)
        assert found == known.get((letter, group, max(number, 0)), -1), (letter, group, number)
