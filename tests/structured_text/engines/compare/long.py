"""The long forms of the comparison.

`python -m tests.structured_text.engines.compare.long [corpus] [expressions] [--scans N] [--blocks NAME,...]
[--expressions N] [--first BATCH] [--engine NAME] [--seed N] [--without PRODUCTION,...]`.

`corpus`: 10^5 random scans of every block, the full state compared after each, between the embedded engine and
each line of matiec. `expressions`: 10^6 random expressions with four inputs each, where the embedded engine gives a
value, with each line of matiec. Exit status 1 if anything differs.
"""

import argparse
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.structured_text.engines.compare.cases import Case, load_cases
from tests.structured_text.engines.compare.expressions.batch import evaluate, make_batch, mismatches, where_all_agree
from tests.structured_text.engines.compare.lockstep import Run, lockstep
from tests.structured_text.engines.compare.witness import not_noticed

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine
from structured_text.engines.matiec import Flags, MatiecEngine
from structured_text.engines.matiec.cache import Cache

PER_BATCH = 4000
VECTORS = 4
PER_POOL = 25  # batches
# A compilation without optimisation takes a fifth of the time of one with -O2; every level has its turn.
OPTIMISATION = ("1", *("0",) * 7, "2", *("0",) * 7)

# Engine, seed, number of the batch, productions to leave out.
Job = tuple[str, int, int, list[str]]


def main() -> int:
    """Run what is asked for; print figures and every difference."""
    parser = argparse.ArgumentParser(description="Compare the engines at length.")
    parser.add_argument("what", nargs="*", default=["corpus", "expressions"], help="corpus, expressions")
    parser.add_argument("--scans", type=int, default=100_000, help="per block of the corpus")
    parser.add_argument("--blocks", default=",".join(load_cases()), help="of the corpus, with commas between")
    parser.add_argument("--expressions", type=int, default=1_000_000)
    parser.add_argument("--first", type=int, default=0, help="batch of expressions to begin with")
    parser.add_argument("--engine", choices=MATIEC_NAMES, action="append", help="for expressions; all without it")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--without", default="", help="productions to leave out, with commas between")
    options = parser.parse_args()
    failures = 0
    if "corpus" in options.what:
        failures += _corpus(options.blocks.split(","), options.scans, options.seed)
    if "expressions" in options.what:
        failures += _expressions(options)
    return 1 if failures else 0


def _matiec() -> Iterator[MatiecEngine]:
    for each in survey().candidates():
        if each.name in MATIEC_NAMES:
            print(f"{each.name}: {'runs' if each.engine else 'does not run'}, {each.note}", flush=True)
            if isinstance(each.engine, MatiecEngine):
                yield each.engine


# ------------------------------------------------------------ corpus


def _corpus(blocks: list[str], scans: int, seed: int) -> int:
    jobs = [(name, scans, seed) for name in blocks]
    with ProcessPoolExecutor() as pool:
        failures = 0
        for text, failed in pool.map(_long_case, jobs):
            print(text, flush=True)
            failures += failed
    return failures


def _long_case(job: tuple[str, int, int]) -> tuple[str, int]:
    """One block on every engine; what came out, and how many comparisons failed."""
    name, scans, seed = job
    case = load_cases()[name]
    lines, failures = [], 0
    for title, runs, but in _pairs(case):
        start = time.perf_counter()
        difference = lockstep(case, runs, scans, seed, but)
        seconds = time.perf_counter() - start
        lines.append(f"{name}, {title}: {difference or f'{scans} scans the same'}, {seconds:.0f} s")
        failures += difference is not None
    return "\n".join(lines), failures


def _pairs(case: Case) -> Iterator[tuple[str, list[Run], tuple[str, ...]]]:
    engines: list[Engine] = [each.engine for each in survey().candidates() if each.engine and each.name in MATIEC_NAMES]
    for engine in engines:
        yield engine.name, [Run(EmbeddedEngine(), case), Run(engine, case)], case.handed_on


# ------------------------------------------------------------ expressions


def _expressions(options: argparse.Namespace) -> int:
    batches = range(options.first, -(-options.expressions // PER_BATCH))
    failures = 0
    for engine in _matiec():
        done = 0
        asked = not options.engine or engine.name in options.engine
        jobs = [(engine.name, options.seed, number, options.without.split(",")) for number in batches if asked]
        for text, compared, failed in chain.from_iterable(_in_turns(jobs)):
            done, failures = done + compared, failures + failed
            print(text, end="", flush=True)
            if done % (25 * PER_BATCH) < PER_BATCH:
                print(f"{engine.name}: {done} expressions so far", flush=True)
        print(f"{engine.name}: {done} expressions with {VECTORS} inputs each", flush=True)
    return failures


def _in_turns(jobs: list[Job]) -> Iterator[list[tuple[str, int, int]]]:
    """Results in order. What a C compiler makes of a batch stays loaded, so that processes are renewed now and then."""
    for start in range(0, len(jobs), PER_POOL):
        with ProcessPoolExecutor() as pool:
            yield list(pool.map(_long_batch, jobs[start : start + PER_POOL]))


def _long_batch(job: Job) -> tuple[str, int, int]:
    """One batch on one line: the differences, how many were compared, how many differ."""
    name, seed, number, without = job
    (engine,) = (each for each in _quietly() if each.name == name)
    embedded = EmbeddedEngine()
    batch = make_batch((seed, number), PER_BATCH, VECTORS, [*not_noticed(), *without])
    batch, expected = where_all_agree(embedded, batch)
    with TemporaryDirectory() as folder:  # nobody builds a batch twice, so the cache of the user stays clean of it
        flags = Flags(optimise=OPTIMISATION[number % len(OPTIMISATION)])
        matiec = replace(engine, flags=flags, cache=Cache(Path(folder)))
        found = mismatches(batch, (embedded.name, name), expected, evaluate(matiec, batch))
        told = "".join(f"{name}, batch {number}: {each}\n" for each in found)
    return told, len(batch.terms), len(found)


def _quietly() -> list[MatiecEngine]:
    return [each.engine for each in survey().candidates() if isinstance(each.engine, MatiecEngine)]


if __name__ == "__main__":
    sys.exit(main())
