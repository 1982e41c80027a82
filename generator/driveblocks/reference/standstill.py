"""What proves standstill: all conditions of the map at once."""

from collections.abc import Mapping

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Drive
from driveblocks.reference.register import number

WORD = Span(0, 15)


def holds(condition: Condition, word: int) -> bool:
    if condition.mask is not None:
        return all(word >> bit & 1 == condition.equals >> bit & 1 for bit in WORD if condition.mask >> bit & 1)
    return number(word, condition.bit or WORD) == condition.equals


def proven(drive: Drive, words: Mapping[int, int]) -> bool:
    """Whether the words, by address, prove standstill. Raises KeyError when one of them is missing."""
    return all(holds(condition, words[condition.register]) for condition in drive.operation.standstill.all)
