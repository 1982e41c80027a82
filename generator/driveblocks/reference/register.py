"""Words of registers: their bits, fields and values by name, and engineering values."""

from collections.abc import Iterator
from fractions import Fraction

from driveblocks.maps.form import Span
from driveblocks.maps.model import Register
from driveblocks.reference.naming import name_of
from driveblocks.reference.single import nearest


def decode(row: Register, word: int) -> dict[str, bool | int]:
    """What a register's decoder answers, by the name of the output; empty for a register that has no decoder."""
    return dict([*_bits(row, word), *_values(row, word)])


def number(word: int, span: Span) -> int:
    """The number that some bits of a word make."""
    return sum(((word >> bit) & 1) << place for place, bit in enumerate(span))


def _bits(row: Register, word: int) -> Iterator[tuple[str, bool | int]]:
    for bit in row.bits:
        if bit.unused or bit.name is None:
            continue
        found = number(word, bit.bit)
        if len(bit.bit) == 1:
            yield name_of(bit), found == 1
            continue
        yield name_of(bit), found
        for value in bit.values:
            yield name_of(value), found == value.value


def _values(row: Register, word: int) -> Iterator[tuple[str, bool | int]]:
    for value in row.values:
        yield name_of(value), (word & value.value) != 0 if row.masks else word == value.value & 0xFFFF
    if row.values:
        yield "Unknown", is_unknown(row, word)


def is_unknown(row: Register, word: int) -> bool:
    """Whether the manual lists no value like this; of single bits, whether one is missing or none is set."""
    if not row.masks:
        return all(word != value.value & 0xFFFF for value in row.values)
    listed = 0
    for value in row.values:
        listed |= value.value
    return word == 0 or word & ~listed != 0


def count(row: Register, word: int) -> int:
    """The number that a word, or two, means: two's complement where the map says so."""
    bits = 32 if row.words == 2 else 16
    return word - (1 << bits) if row.signed and word >= 1 << bits - 1 else word


def exact(row: Register, word: int) -> Fraction:
    """The engineering value of a word, without any rounding. Raises ValueError for a register without scale."""
    if row.scale is None:
        raise ValueError(f"the map gives no scale for {row.name}")
    return count(row, word) * Fraction(row.scale.factor)


def engineering(row: Register, word: int) -> float:
    """The engineering value as the nearest REAL. Raises ValueError for a register without scale."""
    return nearest(exact(row, word))
