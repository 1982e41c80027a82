"""Every block and function as matiec translates it, under AddressSanitizer and UndefinedBehaviorSanitizer.

10^7 damaged inputs for each block that takes apart what comes from outside, 10^6 for every other, on each line of
matiec and with gcc and clang, as far as they are there. Exit status 1 with the input in hexadecimal on a find.

    python -m tests.native.sanitize [--scale 1] [--only NAME,..] [--line LINE] [--compiler gcc] [--seed 1]
"""

import argparse
import resource
import sys
import time
from collections.abc import Iterator, Sequence

from tests.native.sanitize.campaign import Outcome, Program, build, campaign
from tests.native.sanitize.sanitizers import compilers, found_lines


def programs(given: argparse.Namespace) -> Iterator[Program]:
    """Compile what is asked for."""
    only = [name.strip().upper() for name in given.only.split(",") if name.strip()]
    for engine in found_lines():
        if given.line not in ("", engine.name):
            continue
        for checked in compilers(engine):
            if given.compiler in ("", checked.name):
                start = time.perf_counter()
                program = build(engine, checked, only=only)
                print(
                    f"{program.label}: {len(program.pous)} compiled in {time.perf_counter() - start:.0f} s", flush=True
                )
                yield program


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
    parser.add_argument("--only", default="", help="blocks and functions, with commas")
    parser.add_argument("--line", default="", help="matiec-beremiz or matiec-openplc; both without it")
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
