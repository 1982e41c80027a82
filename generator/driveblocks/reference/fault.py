"""Fault numbers from fault words: 16 x (word - first) + bit + 1, for bits that have an id."""

from collections.abc import Sequence
from dataclasses import dataclass

from driveblocks.maps.model import Drive


@dataclass(frozen=True)
class Faulted:
    """The lowest fault number, 0 without any, and how many faults are set."""

    number: int
    count: int


def numbered(drive: Drive, words: Sequence[int]) -> Faulted:
    """What the fault words say, first word first. Raises ValueError if faults have no relation to bits."""
    relation = drive.faults.bits
    if relation is None:
        raise ValueError("the map gives no relation of faults to bits")
    found = []
    for address, word in zip(range(relation.first, relation.last + 1), words, strict=True):
        row = drive.register_at(address)
        for bit in row.bits if row else ():
            if bit.id is not None and word >> bit.bit.first & 1:
                found.append(16 * (address - relation.first) + bit.bit.first + 1)
    return Faulted(min(found, default=0), len(found))
