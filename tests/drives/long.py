"""Drive blocks at length: `python -m tests.drives.long [--walks N] [--first SEED] [--hours N]`.

The whole matrix, random walks, and a day of simulated bus without a store; on matiec
where it is found, else on the embedded engine. Each failure is printed; exit status 1 if there is one.
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import product

from tests.drives.day import HOUR_MS, day
from tests.drives.matrix import FAULTS, STATES, cell
from tests.drives.station import FAMILIES, MADE_UP, built
from tests.drives.walk import walk

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.engine import Library

SEEDS = 4
"""Runs of each field of the matrix: habits and chance differ."""
CHUNK = 50


@cache
def stations() -> Library:
    """The stations on the fastest engine, once per process."""
    found = {each.name: each.engine for each in survey().candidates() if each.engine is not None}
    name = next((each for each in MATIEC_NAMES if each in found), "embedded")
    return built(found[name])


def cells(kind: str, fault: str) -> list[str]:
    """A fault in all states."""
    runs = (_told(cell, kind, state, fault, seed=seed) for state, seed in product(STATES, range(SEEDS)))
    return [each for each in runs if each]


def walks(first: int) -> list[str]:
    """Some walks."""
    return [each for each in (_told(walk, seed) for seed in range(first, first + CHUNK)) if each]


def bus(kind: str, hours: int) -> list[str]:
    """Some hours of a drive."""
    told = _told(day, kind, hours * HOUR_MS, every=100)
    return [f"day of {kind}: {told}"] if told else []


def _told(run: Callable[..., object], *words: object, **keys: object) -> str:
    try:
        run(*words, stations=stations(), **keys)
    except AssertionError as error:
        return str(error)
    return ""


def main() -> int:
    """Run all of it."""
    parser = argparse.ArgumentParser(description="Drive blocks at length.")
    parser.add_argument("--walks", type=int, default=100_000, help="random walks")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--jobs", type=int, default=None, help="processes; as many as there are processors")
    parser.add_argument("--hours", type=int, default=24, help="of simulated bus, each family")
    options = parser.parse_args()
    stations()  # compiled once, for all processes
    kinds = (*FAMILIES, *MADE_UP)
    seeds = range(options.first, options.first + options.walks, CHUNK)
    parts: list[tuple[str, Callable[..., list[str]], list[tuple[object, ...]]]] = [
        (f"fields of the matrix, {len(STATES) * SEEDS} to a row", cells, list(product(kinds, FAULTS))),
        (f"times {CHUNK} walks", walks, [(seed,) for seed in seeds]),
        (f"families, {options.hours} hours each", bus, [(kind, options.hours) for kind in FAMILIES if options.hours]),
    ]
    failed = 0
    with ProcessPoolExecutor(options.jobs) as pool:
        for what, run, words in parts:
            failures = list(_failures(pool, run, words))
            failed += len(failures)
            print(f"{len(words)} {what}: {len(failures)} failures", flush=True)
    return 1 if failed else 0


def _failures(
    pool: ProcessPoolExecutor, run: Callable[..., list[str]], words: list[tuple[object, ...]]
) -> Iterator[str]:
    for found in pool.map(run, *zip(*words, strict=True)) if words else ():
        for each in found:
            print(each, flush=True)
            yield each


if __name__ == "__main__":
    sys.exit(main())
