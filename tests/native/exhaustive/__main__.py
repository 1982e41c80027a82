"""The long form: `python -m tests.native.exhaustive [--short] [--line NAME] [CHECK ...]`, all checks if none is named.

Each check says for each line of matiec how many cases it tried and whether any differs; its seconds are those of all
lines together. Two checks run at a time. Without matiec the embedded engine does what it can in minutes, and says so.
Exit status 1 if anything differs, 2 for an unknown name.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed

from tests.native.driver import lines
from tests.native.exhaustive import program
from tests.native.exhaustive.bench import Bench
from tests.native.exhaustive.checks import CHECKS, Report, run
from tests.native.exhaustive.embedded import embedded

PROCESSES = 2


def main(arguments: Sequence[str]) -> int:
    """Run the checks that are named."""
    parser = argparse.ArgumentParser(prog="python -m tests.native.exhaustive")
    parser.add_argument("checks", nargs="*", metavar="CHECK", help=", ".join(CHECKS))
    parser.add_argument("--short", action="store_true", help="what the suite runs")
    parser.add_argument("--line", action="append", help="only this line, such as matiec-beremiz")
    asked = parser.parse_args(arguments)
    if unknown := sorted({*asked.checks} - {*CHECKS}):
        parser.error(f"there is no check {unknown[0]}")
    engines = [engine for engine in lines() if not asked.line or engine.name in asked.line]
    if not engines:
        print("no line of matiec was found: the embedded engine takes what it can in minutes, not the whole spaces")
        return report(embedded(asked.checks))
    return report(parallel([program.bench(engine) for engine in engines], asked.checks or [*CHECKS], asked.short))


def parallel(benches: Sequence[Bench], names: Sequence[str], short: bool) -> Iterator[Report]:
    """The reports of some checks as they come."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        jobs = [pool.submit(run, name, benches, short=short) for name in names]
        for job in as_completed(jobs):
            yield job.result()


def report(reports: Iterable[Report]) -> int:
    """Print each report. Exit status 1 if anything differs."""
    wrong = 0
    for one in reports:
        print(one, flush=True)
        wrong += one.wrong
    print("all the same" if not wrong else f"{wrong:,} differences")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
