"""What proves standstill: all conditions of the map at once."""

from collections.abc import Mapping

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Drive
from driveblocks.reference.register import number

WORD = Span(0, 15)


def holds(condition: Condition, word: int, *, signed: bool = False) -> bool:
    found = number(word, condition.bit or WORD)
    if signed and condition.bit is None and found > 0x7FFF:
        found -= 0x10000
    if condition.below is not None or condition.above is not None:
        return found < condition.below if condition.below is not None else found > (condition.above or 0)
    if condition.mask is not None:
        return all(word >> bit & 1 == (condition.equals or 0) >> bit & 1 for bit in WORD if condition.mask >> bit & 1)
    return number(word, condition.bit or WORD) == condition.equals


def proven(drive: Drive, words: Mapping[int, int]) -> bool:
    """Whether the words, by address, prove standstill. Raises KeyError when one of them is missing."""
    rows = {one.register: drive.register_at(one.register) for one in drive.operation.standstill.all}
    return all(
        holds(one, words[one.register], signed=(row := rows[one.register]) is not None and row.signed)
        for one in drive.operation.standstill.all
    )
