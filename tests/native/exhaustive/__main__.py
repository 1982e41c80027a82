"""The long form: `python -m tests.native.exhaustive [--short] [--line NAME] [CHECK ...]`, all checks if none is named.

Each check says for each line of matiec how many cases it tried and whether any differs; its seconds are those of all
lines together. Two checks run at a time. Exit status 1 if anything differs or a check could not be done, 2 for an
unknown name or if nothing could run.
"""

import argparse
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed

from tests.native.driver import lines, told_lines
from tests.native.exhaustive import program
from tests.native.exhaustive.bench import Bench, Finding
from tests.native.exhaustive.checks import CHECKS, Report, run

from structured_text.engines.discovery import MATIEC_NAMES

PROCESSES = 2


def main(arguments: Sequence[str]) -> int:
    """Run the checks that are named."""
    parser = argparse.ArgumentParser(prog="python -m tests.native.exhaustive")
    parser.add_argument("checks", nargs="*", metavar="CHECK", help=", ".join(CHECKS))
    parser.add_argument("--short", action="store_true", help="what the suite runs")
    parser.add_argument("--line", action="append", choices=MATIEC_NAMES, help="only this line")
    asked = parser.parse_args(arguments)
    if unknown := sorted({*asked.checks} - {*CHECKS}):
        parser.error(f"there is no check {unknown[0]}")
    engines = [engine for engine in lines() if not asked.line or engine.name in asked.line]
    print(told_lines(), flush=True)
    if not engines:
        print("nothing ran: needs matiec; `driveblocks doctor` says what is missing")
        return 2
    return report(parallel([program.bench(engine) for engine in engines], asked.checks or [*CHECKS], asked.short))


def parallel(benches: Sequence[Bench], names: Sequence[str], short: bool) -> Iterator[Report]:
    """The reports of some checks as they come; a check that could not be done is reported as one that differs."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        jobs = {pool.submit(run, name, benches, short=short): name for name in names}
        for job in as_completed(jobs):
            try:
                yield job.result()
            except (RuntimeError, OSError, subprocess.TimeoutExpired) as error:
                yield Report(jobs[job], 0.0, (Finding("none", 0, 1, (f"could not be done: {error}",)),))


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
