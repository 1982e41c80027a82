"""Every block and function of the library at length: `python -m tests.blocks.compare.long [--scans N] [--blocks A,B]
[--seed N]`.

10^5 random scans of each; after every scan its full state is compared between both lines of matiec and the embedded
engine. A line that is not found is said to be missing.
Exit status 1 if anything differs.
"""

import argparse
import functools
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

from tests.blocks.compare.comparison import Libraries, beside, build, compare, subjects
from tests.blocks.compare.pou import Pou, shipped

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine

SCANS = 100_000

# POU, scans, seed.
Job = tuple[str, int, int]


def main() -> int:
    """Run what is asked for; print every block and every difference."""
    parser = argparse.ArgumentParser(description="Compare every block of the library on every engine.")
    parser.add_argument("--scans", type=int, default=SCANS, help="per block or function")
    parser.add_argument("--blocks", type=_names, default=list(shipped().pous), help="with commas between")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    _tell_engines()
    start = time.perf_counter()
    jobs = [(pou.name, options.scans, options.seed) for pou in _slow_first(options.blocks)]
    failed = 0
    for told, differs in _results(jobs):
        print(told, flush=True)
        failed += differs
    minutes = (time.perf_counter() - start) / 60
    print(f"{len(jobs)} blocks and functions, {options.scans} scans each, {failed} that differ, {minutes:.1f} min")
    return 1 if failed else 0


def _names(text: str) -> list[str]:
    names = text.split(",")
    if unknown := [name for name in names if name not in shipped().pous]:
        raise argparse.ArgumentTypeError(f"the library has no {', '.join(unknown)}")
    return names


def _tell_engines() -> None:
    for each in survey().candidates():
        print(f"{each.name}: {'runs' if each.engine else 'does not run'}, {each.note}", flush=True)


def _slow_first(names: list[str]) -> list[Pou]:
    """Those with the most state first, so that no process is left with a long one at the end."""
    pous = [shipped().pous[name] for name in names]
    return sorted(pous, key=lambda pou: -sum(leaf.kind.size for leaf in pou.leaves))


def _results(jobs: list[Job]) -> Iterator[tuple[str, bool]]:
    if len(jobs) == 1:
        yield _long(jobs[0])
        return
    with ProcessPoolExecutor() as pool:
        yield from pool.map(_long, jobs)


@functools.cache
def _libraries() -> Libraries:
    """The library on every engine found; once per process. The embedded one alone fails where others would differ."""
    engines: dict[str, Engine] = {}
    for each in survey().candidates():
        if each.engine is not None and each.name in MATIEC_NAMES:
            engines |= beside(each.engine)
    return build(engines or {"embedded": EmbeddedEngine()})


def _long(job: Job) -> tuple[str, bool]:
    """One POU on every engine: what came out, and whether there is a difference."""
    name, scans, seed = job
    pou, libraries = shipped().pous[name], _libraries()
    start = time.perf_counter()
    difference = compare(pou, subjects(libraries, pou), scans, seed)
    seconds = time.perf_counter() - start
    if difference is None:
        return f"{name}: {scans} scans the same on {', '.join(libraries)}; {seconds:.0f} s", False
    again = f"python -m tests.blocks.compare.long --blocks {name} --scans {difference.scan + 1} --seed {seed}"
    return f"DIFFERENT: {difference}\n  again: {again}", True


if __name__ == "__main__":
    sys.exit(main())
