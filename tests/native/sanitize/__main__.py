"""Every block and function as matiec translates it, under AddressSanitizer and UndefinedBehaviorSanitizer.

10^7 damaged inputs for each block that takes apart what comes from outside, 10^6 for every other, on each line of
matiec and with gcc and clang, as far as they are there. Exit status 1 with the input in hexadecimal on a find, 2 if
nothing could run or a name is unknown.

    python -m tests.native.sanitize [--scale 1] [--only NAME,..] [--line LINE] [--compiler gcc] [--seed 1]
"""

import argparse
import resource
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.blocks.library import alone
from tests.native.driver import told_lines
from tests.native.sanitize.campaign import Outcome, Program, build, campaign
from tests.native.sanitize.sanitizers import compilers, found_lines

from structured_text.engines.discovery import MATIEC_NAMES


def programs(given: argparse.Namespace) -> Iterator[Program]:
    """Compile what is asked for, and say which line or compiler is not there."""
    print(told_lines(), flush=True)
    for engine in found_lines():
        if given.line not in ("", engine.name):
            continue
        found = {checked.name: checked for checked in compilers(engine)}
        for name in (given.compiler,) if given.compiler else ("gcc", "clang"):
            if name not in found:
                print(f"{engine.name} {name}: does not run, it or its sanitizers are not there", flush=True)
                continue
            start = time.perf_counter()
            program = build(engine, found[name], only=given.only)
            print(f"{program.label}: {len(program.pous)} compiled in {time.perf_counter() - start:.0f} s", flush=True)
            yield program


def names(text: str) -> list[str]:
    """Blocks and functions in upper case. Raises ArgumentTypeError for one that the library has not."""
    known = {Path(each.path).stem.upper() for each in alone() if not each.path.startswith("types/")}
    asked = [name.strip().upper() for name in text.split(",") if name.strip()]
    if unknown := [name for name in asked if name not in known]:
        raise argparse.ArgumentTypeError(f"the library has no {', '.join(unknown)}")
    return asked


def told(outcome: Outcome) -> str:
    """A line on a block: inputs, seconds of one core, and the ErrorIDs that it gave."""
    seen = " ".join(f"{code}:{number}" for code, number in sorted(outcome.results.items()))
    verdict = f"{len(outcome.finds)} FOUND" if outcome.finds else "ok"
    return (
        f"{outcome.label:22} {outcome.name:32} {outcome.inputs:>10,} inputs {outcome.seconds:7.1f} s  {verdict}  {seen}"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is asked for. Exit status 1 on a find, 2 if nothing could run."""
    parser = argparse.ArgumentParser(description="Blocks under sanitizers.")
    parser.add_argument("--scale", type=float, default=1.0, help="part of 10^7 and 10^6 inputs")
    parser.add_argument("--only", type=names, default=[], help="blocks and functions, with commas")
    parser.add_argument("--line", default="", choices=["", *MATIEC_NAMES], help="both without it")
    parser.add_argument("--compiler", default="", choices=["", "gcc", "clang"], help="both without it")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(arguments)
    start, total, finds = time.perf_counter(), 0, 0
    for outcome in campaign(list(programs(given)), given.scale, given.seed):
        total += outcome.inputs
        finds += len(outcome.finds)
        print("\n".join([told(outcome), *outcome.finds]), flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cores = f"{used.ru_utime + used.ru_stime:.0f} s of one core"
    print(f"{total:,} inputs in {time.perf_counter() - start:.0f} s ({cores}), {finds} finds")
    if not total:
        print("nothing ran: needs iec2c and a compiler with sanitizers; `driveblocks doctor` says what is missing")
        return 2
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
