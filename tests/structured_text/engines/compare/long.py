"""The long form of the comparison: `python -m tests.structured_text.engines.compare.long [--scans N] [--blocks NAMES]`.

10^5 random scans of every block of the corpus, the full state compared after each, between the embedded engine and
each line of matiec. Exit status 1 if anything differs.
"""

import argparse
import sys
import time
from concurrent.futures import ProcessPoolExecutor

from tests.structured_text.engines.compare.cases import load_cases
from tests.structured_text.engines.compare.lockstep import Run, lockstep

from structured_text.engines.discovery import MATIEC_NAMES, survey
from structured_text.engines.embedded import EmbeddedEngine


def main() -> int:
    """Run what is asked for; print figures and every difference."""
    parser = argparse.ArgumentParser(description="Compare the engines at length.")
    parser.add_argument("--scans", type=int, default=100_000, help="per block of the corpus")
    parser.add_argument("--blocks", default=",".join(load_cases()), help="of the corpus, with commas between")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    for each in survey().candidates():
        if each.name in MATIEC_NAMES:
            print(f"{each.name}: {'runs' if each.engine else 'does not run'}, {each.note}", flush=True)
    failures = 0
    with ProcessPoolExecutor() as pool:
        jobs = [(name, options.scans, options.seed) for name in options.blocks.split(",")]
        for text, failed in pool.map(_long_case, jobs):
            print(text, flush=True)
            failures += failed
    return 1 if failures else 0


def _long_case(job: tuple[str, int, int]) -> tuple[str, int]:
    """One block on every engine; what came out, and how many comparisons failed."""
    name, scans, seed = job
    case = load_cases()[name]
    lines, failures = [], 0
    for each in survey().candidates():
        if each.engine is None or each.name not in MATIEC_NAMES:
            continue
        start = time.perf_counter()
        difference = lockstep(case, [Run(EmbeddedEngine(), case), Run(each.engine, case)], scans, seed, case.handed_on)
        seconds = time.perf_counter() - start
        lines.append(f"{name}, {each.name}: {difference or f'{scans} scans the same'}, {seconds:.0f} s")
        failures += difference is not None
    return "\n".join(lines), failures


if __name__ == "__main__":
    sys.exit(main())
