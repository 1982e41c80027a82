"""What a simulated drive says of itself from the beginning: what it is, its own maximum, and that the bus commands."""

from collections.abc import Iterator

from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.model import Drive
from driveblocks.meaning.measure import measures, own_maximum
from driveblocks.meaning.pattern import WORD, Pattern
from driveblocks.meaning.quantity import quantity
from driveblocks.meaning.status import status


def plate(drive: Drive, habits: Habits) -> dict[int, int]:
    words: dict[int, int] = {}
    shows = status(drive)
    for each in (*shows.identity.patterns, *shows.by_bus.patterns, *shows.allowed, *chosen(drive)):
        words[each.register] = words.get(each.register, 0) & ~each.mask | each.value
    return words | own_maximum_word(drive, habits.maximum_hz)


def own_maximum_word(drive: Drive, hertz: int) -> dict[int, int]:
    """The register of the drive's own maximum, and its word, where its scale is known."""
    one = own_maximum(drive)
    factor = one.quantity.factor if one else None
    return {one.register: int(hertz / factor) & WORD} if one and factor else {}


def chosen(drive: Drive) -> Iterator[Pattern]:
    """What chooses the first of several scales, by which measures are shown."""
    several = (quantity(drive, one.register).factors for one in measures(drive))
    yield from (factors[0].when for factors in several if factors[1:] and factors[0].when)
