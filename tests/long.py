"""What runs for minutes and hours, one by one: `make long WHAT=line`; without WHAT the list.

SEED, FIRST, PART, TIMES and SECONDS are those of the environment, or of `make long WHAT=matrix TIMES=1`.
"""

import os
import random
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

SEARCH = "pytest -n auto -m hypothesis --hypothesis-profile search --hypothesis-seed"


class Run(NamedTuple):
    """What a long run does, how long it takes on two cores, and its modules, one after the other."""

    does: str
    takes: str
    modules: tuple[str, ...]


RUNS = {
    "fuzz": Run(
        "every property that hypothesis draws for, hostile files (SEED)",
        "some minutes",
        (
            SEARCH + " {SEED}",
            "pytest -n auto -m long",
        ),
    ),
    "compare": Run(
        "10^5 scans of every block of the corpus, embedded engine against matiec",
        "half an hour",
        ("tests.structured_text.engines.compare.long",),
    ),
    "traces": Run(
        "records how matiec runs the corpus (both lines of matiec)",
        "minutes",
        ("tests.structured_text.engines.compare.traces",),
    ),
    "verdicts": Run(
        "records what matiec says of the accept/reject corpus",
        "5 minutes",
        ("tests.structured_text.engines.accept.record",),
    ),
    "coverage": Run(
        "lines and branches of the blocks that the test programs reach, on every engine found",
        "some minutes",
        ("driveblocks test --engine all --require-coverage 90",),
    ),
    "sanitize": Run(
        "every block under ASan and UBSan: 10^7 damaged inputs per parser, 10^6 per other block",
        "10 minutes",
        ("tests.native.sanitize",),
    ),
    "exhaustive": Run(
        "CRC, decoders, permissions, standstill, lengths, all 2^32 REALs of the references, on matiec",
        "half an hour",
        ("tests.native.exhaustive",),
    ),
    "line": Run(
        "10^6 random stops on a virtual RS-485 line in C; writes the table of docs/measured/line.md (matiec)",
        "half an hour",
        ("tests.line.long --page",),
    ),
    "budget": Run(
        "10,000 random lines of real drive blocks: ages, stops, whom others stop; eight of each family while some die",
        "half an hour",
        ("tests.line.budget --alike", "tests.line.budget --first {FIRST} --store build/budget-{FIRST}.jsonl"),
    ),
    "panel": Run("2,000 walks beside a second master", "3 minutes", ("tests.line.panel --first {FIRST}",)),
    "owners": Run(
        "two makes on one slot, at one address, at each other's; other versions; refused stops of a restart",
        "a minute",
        ("tests.line.owners",),
    ),
    "drawn": Run(
        "1,000 maps drawn at random, each with a life of its motor; 50 simulated drives that lie",
        "an hour",
        ("tests.shapes.life --store build/drawn.jsonl", "tests.shapes.life --lies --count 50"),
    ),
    "plants": Run(
        "200 plants drawn at random, each good by the rules of plants (FIRST)",
        "some minutes",
        ("tests.plant.long --first {FIRST}",),
    ),
    "matrix": Run(
        "every mode x event x state on second models of the drives, four times, and random walks (TIMES)",
        "an hour",
        ("tests.second.long --times {TIMES}",),
    ),
    "walks": Run(
        "random walks with several on a line, PART 1 to 4, each with seeds of its own; goes on where it was ended",
        "90 minutes",
        ("tests.second.long --part {PART} --store build/walks-{PART}.jsonl",),
    ),
    "prove": Run(
        "every rule for every family and made-up drive, 10^3 calls per block on the engine",
        "an hour",
        ("driveblocks prove", "tests.prove.agreement", "pytest -n auto -m long tests/prove"),
    ),
    "planted": Run(
        "mistakes planted in blocks, linter, exports and commands: which test turns red", "hours", ("tests.planted",)
    ),
    "desk": Run(
        "words, verdicts and ends on lines that delay, double and damage: 2,200 saves, 1,200 hours, 300 ends",
        "half an hour",
        ("pytest -n auto -m long tests/desk",),
    ),
    "linux-line": Run(
        "a soft PLC by matiec against the simulator, 1 % of the frames damaged (SECONDS)",
        "an hour",
        ("tests.desk.simulate.softplc {SECONDS}",),
    ),
    "desk-line": Run(
        "`driveblocks run` at pymodbus's server, 1 % of the frames damaged (SECONDS)",
        "an hour",
        ("tests.desk.simulate.deskplc {SECONDS}",),
    ),
}


def commands(name: str) -> list[list[str]]:
    """The commands of a run, by the Python or the `driveblocks` of this environment."""
    given = {"SEED": str(random.randrange(10**9)), "TIMES": "4", "FIRST": "0", "PART": "1", "SECONDS": "3600"} | dict(
        os.environ
    )
    found = [shlex.split(text.format_map(given)) for text in RUNS[name].modules]
    product = str(Path(sys.executable).with_name("driveblocks"))
    return [[product, *words[1:]] if words[0] == "driveblocks" else [sys.executable, "-m", *words] for words in found]


def main(arguments: list[str]) -> int:
    """Run all of what is named, or print the list. Exit status 1 if a command failed, 2 for an unknown name."""
    if len(arguments) != 1 or arguments[0] not in RUNS:
        print("\n".join(f"{name:15} {each.takes:13} {each.does}" for name, each in RUNS.items()))
        return 2 if arguments else 0
    failed = 0
    for words in commands(arguments[0]):
        print(shlex.join(words), flush=True)
        failed |= subprocess.run(words, check=False).returncode != 0
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
