"""What a simulated drive says of itself from the beginning: what it is, its own maximum, and that the bus commands."""

from collections.abc import Iterator
from decimal import Decimal

from driveblocks.maps.model import Drive
from driveblocks.meaning.pattern import WORD, Pattern, of_condition
from driveblocks.meaning.status import status
from driveblocks.simulator.habits import Habits


def plate(drive: Drive, habits: Habits) -> dict[int, int]:
    words: dict[int, int] = {}
    for each in (*status(drive).identity.patterns, *status(drive).by_bus.patterns, *chosen(drive)):
        words[each.register] = words.get(each.register, 0) & ~each.mask | each.value
    maximum = drive.operation.own_maximum
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is not None and row is not None and row.scale is not None:
        words[maximum.register] = int(habits.maximum_hz / Decimal(row.scale.factor)) & WORD
    return words


def chosen(drive: Drive) -> Iterator[Pattern]:
    """What chooses the first of several scales, by which measures are shown."""
    rows = (drive.register_at(one.register) for one in drive.operation.measures)
    scales = (row.scale for row in rows if row and row.scale and row.scale.otherwise)
    yield from (of_condition(scale.when) for scale in scales if scale.when)
