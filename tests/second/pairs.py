"""All pairs of options: every two values of two options come together in at least one row."""

from collections.abc import Mapping, Sequence
from itertools import combinations
from random import Random
from typing import Any

Row = dict[str, Any]
TRIES = 30
"""Rows that are drawn for each one that is kept."""


def rows(options: Mapping[str, Sequence[Any]], seed: int = 0) -> list[Row]:
    """Rows of one value each, which hold every pair: greedy, the same rows for the same seed."""
    chance, names = Random(seed), list(options)
    missing = {
        ((one, i), (two, j))
        for one, two in combinations(names, 2)
        for i in range(len(options[one]))
        for j in range(len(options[two]))
    }
    found = []
    while missing:
        begun = min(missing)
        drawn = [dict(begun) | _others(options, dict(begun), chance) for _ in range(TRIES)]
        best = max(drawn, key=lambda row: len(missing & _pairs(names, row)))
        missing -= _pairs(names, best)
        found.append({name: options[name][best[name]] for name in names})
    return found


def _others(options: Mapping[str, Sequence[Any]], begun: Row, chance: Random) -> Row:
    return {name: chance.randrange(len(values)) for name, values in options.items() if name not in begun}


def _pairs(names: Sequence[str], row: Row) -> set[Any]:
    return {((one, row[one]), (two, row[two])) for one, two in combinations(names, 2)}
