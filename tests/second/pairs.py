"""All pairs of options: every two values of two options come together in at least one row."""

from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

Row = dict[str, Any]
Value = tuple[str, int]
"""An option, and the place of one of its values."""
TRIES = 30
"""Rows that are drawn for each one that is kept."""


def rows(options: Mapping[str, Sequence[Any]], seed: int = 0) -> list[Row]:
    """Rows of one value each, which hold every pair: greedy, the same rows for the same seed."""
    chance, names = Random(seed), list(options)
    bits = _bits(options)
    missing = {one: _later(options, bits, one[0]) for one in bits}
    found = []
    for one, two in sorted((one, two) for one in bits for two in bits if missing[one] & bits[two]):
        if not missing[one] & bits[two]:
            continue
        begun = dict((one, two))
        drawn = [begun | _others(options, begun, chance) for _ in range(TRIES)]
        best = max(drawn, key=lambda row: _new(missing, bits, row))
        for each in best.items():
            missing[each] &= ~_mask(bits, best)
        found.append({name: options[name][best[name]] for name in names})
    return found


def _bits(options: Mapping[str, Sequence[Any]]) -> dict[Value, int]:
    """A bit for each value of each option."""
    return {value: 1 << at for at, value in enumerate((name, i) for name in options for i in range(len(options[name])))}


def _later(options: Mapping[str, Sequence[Any]], bits: Mapping[Value, int], name: str) -> int:
    """The bits of the values of all options that come after one: so each pair is counted once."""
    after = list(options)[list(options).index(name) + 1 :]
    return sum(bit for value, bit in bits.items() if value[0] in after)


def _new(missing: Mapping[Value, int], bits: Mapping[Value, int], row: Row) -> int:
    """How many pairs of a row were in no row before."""
    mask = _mask(bits, row)
    return sum((missing[each] & mask).bit_count() for each in row.items())


def _mask(bits: Mapping[Value, int], row: Row) -> int:
    return sum(bits[each] for each in row.items())


def _others(options: Mapping[str, Sequence[Any]], begun: Row, chance: Random) -> Row:
    return {name: chance.randrange(len(values)) for name, values in options.items() if name not in begun}
