"""Record again what the tools say: `python -m tests.structured_text.engines.accept.record [--checker] [--check]`.

Without `--checker` only the columns of matiec are written, of the lines that are found; what the checker says is then
left to the test, so that a change of it is seen. With `--check` nothing is written; exit status 1 if anything differs.
"""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial

from tests.structured_text.engines.accept.programs import load_programs
from tests.structured_text.engines.accept.verdicts import (
    COLUMNS,
    FILE,
    Verdicts,
    checker_verdict,
    matiec_verdict,
    read_verdicts,
    write_verdicts,
)

from structured_text.engines.discovery import MATIEC_NAMES, survey


def main() -> int:
    """Record; print what changed."""
    parser = argparse.ArgumentParser(description="Record what the tools say about the accept/reject corpus.")
    parser.add_argument("--checker", action="store_true", help="record the checker's column too")
    parser.add_argument("--check", action="store_true", help="write nothing, fail if anything differs")
    options = parser.parse_args()
    before = read_verdicts() if FILE.exists() else {}
    programs = load_programs()
    after = {name: {column: before.get(name, {}).get(column, "unknown") for column in COLUMNS} for name in programs}
    if options.checker:
        _fill(after, "checker", [checker_verdict(text) for text in programs.values()])
    for candidate in survey().candidates():
        if candidate.name not in MATIEC_NAMES:
            continue
        if candidate.engine is None:
            print(f"{candidate.name} keeps its column: {candidate.note}")
            continue
        # iec2c and the C compiler are processes of their own, so threads use every core.
        with ThreadPoolExecutor() as pool:
            _fill(after, candidate.name, list(pool.map(partial(matiec_verdict, candidate.engine), programs.values())))
    if not options.check:
        write_verdicts(after)
    return 1 if _report(before, after) and options.check else 0


def _fill(verdicts: Verdicts, column: str, said: list[str]) -> None:
    for name, verdict in zip(verdicts, said, strict=True):
        verdicts[name][column] = verdict


def _report(before: Verdicts, after: Verdicts) -> bool:
    changed = [name for name in {**before, **after} if before.get(name) != after.get(name)]
    for name in changed:
        print(f"{name}: {before.get(name)} -> {after.get(name)}")
    print(f"{len(after)} programs, {len(changed)} changed")
    return bool(changed)


if __name__ == "__main__":
    sys.exit(main())
