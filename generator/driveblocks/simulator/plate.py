"""What a simulated drive says of itself from the beginning: what it is, its own maximum, and that the bus commands."""

from decimal import Decimal

from driveblocks.maps.model import Drive
from driveblocks.simulator.habits import Habits
from driveblocks.simulator.pattern import WORD, of_condition


def plate(drive: Drive, habits: Habits) -> dict[int, int]:
    """Words by register."""
    words: dict[int, int] = {}
    conditions = [
        *(drive.identity.all if drive.identity else ()),
        *(drive.operation.commanded_by.all if drive.operation.commanded_by else ()),
    ]
    for each in map(of_condition, conditions):
        words[each.register] = words.get(each.register, 0) & ~each.mask | each.value
    maximum = drive.operation.own_maximum
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is not None and row is not None and row.scale is not None:
        words[maximum.register] = int(habits.maximum_hz / Decimal(row.scale.factor)) & WORD
    return words
