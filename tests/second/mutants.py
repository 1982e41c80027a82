"""Sixty one-token changes of the blocks that run a motor, drawn by a seed: which of them does the matrix find?

`python -m tests.second.mutants` builds each change, runs the sample of `sample.py` until a cell fails that passes on
the real text, and prints which, and the survivors. `--only N` repeats one. A judge that has never been wrong is
worthless; so this is the judge of the judge.
"""

import argparse
import re
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from random import Random

from tests.drives import station as first
from tests.drives.station import FAMILIES
from tests.second.matrix import Cell, run
from tests.second.sample import sample
from tests.second.station import built

from driveblocks.host.embedded.engine import EmbeddedEngine

SEED, NUMBER = 20261122, 60
BLOCKS = ("VFD_Control", "VFD_Link", "VFD_HardStop", "MB_Line8", *(f"{each}_Drive" for each in FAMILIES))
SWAPS = {
    "AND": "OR", "OR": "AND", "TRUE": "FALSE", "FALSE": "TRUE", "NOT": "", "<": "<=", "<=": "<", ">": ">=",
    ">=": ">", "=": "<>", "<>": "=", "+": "-", "-": "+", "MAX": "MIN", "MIN": "MAX",
}  # fmt: skip
TOKEN = re.compile(r":=|=>|<=|>=|<>|[<>=+-]|\b\w+#\w+\b|\b[A-Za-z_]\w*\b|\b\d+\b")


@dataclass(frozen=True)
class Mutant:
    """A change of a token of a block: where in its text, in what line, what was there, and what is there now."""

    block: str
    at: int
    line: int
    old: str
    new: str

    def __str__(self) -> str:
        """By name."""
        return f"{self.block} line {self.line}: {self.old} to {self.new or 'nothing'}"

    def edit(self, text: str) -> str:
        """The text with the change, where it is that block's."""
        if not re.search(rf"^FUNCTION_BLOCK {self.block}$", text, re.MULTILINE):
            return text
        return text[: self.at] + self.new + text[self.at + len(self.old) :]


def every() -> Iterator[Mutant]:
    """All changes, in the order of the texts; comments and declarations stay."""
    for source in first.texts(kinds=FAMILIES):
        named = re.search(r"^FUNCTION_BLOCK (\w+)$", source.text, re.MULTILINE)
        if not named or named[1] not in BLOCKS:
            continue
        plain = re.sub(r"\(\*.*?\*\)", lambda each: re.sub(r"[^\n]", " ", each[0]), source.text, flags=re.DOTALL)
        begins = plain.rindex("END_VAR") + len("END_VAR")
        for token in TOKEN.finditer(plain, begins):
            old = token[0]
            new = str(int(old) + 1) if old.isdigit() else SWAPS.get(old)
            if new is not None:
                yield Mutant(named[1], token.start(), plain.count("\n", 0, token.start()) + 1, old, new)


def drawn() -> list[Mutant]:
    """Those of the seed."""
    return Random(SEED).sample(list(every()), NUMBER)


def judged(number: int, most: int | None = None) -> tuple[Mutant, str]:
    """A change, and of so many cells the cell that finds it, with its rule; empty: none does."""
    one = drawn()[number]
    try:
        stations = built(EmbeddedEngine(), one.edit)
    except Exception as error:
        return one, f"does not build: {type(error).__name__}"
    cells: list[tuple[Cell, int]] = sample()
    Random(number).shuffle(cells)
    for cell, seed in cells[:most]:
        try:
            outcome = run(cell, seed, stations)
        except Exception as error:
            return one, f"{cell}, seed {seed}: {type(error).__name__}"
        if outcome.rules:
            return one, f"{cell}, seed {seed}: {outcome.rules[0]}"
    return one, ""


def main() -> int:
    """Judge all of them, or one."""
    parser = argparse.ArgumentParser(description="One-token changes of the blocks.")
    parser.add_argument("--only", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--cells", type=int, help="cells for each, all unless said")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    numbers = [options.only] if options.only is not None else list(range(options.first, NUMBER))
    survived = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for number, (one, by) in zip(numbers, pool.map(judged, numbers, [options.cells] * len(numbers)), strict=True):
            print(f"{number:2} {one}: {by or 'SURVIVES'}", flush=True)
            survived += [] if by else [one]
    print(f"{len(numbers) - len(survived)} of {len(numbers)} found")
    return 0


if __name__ == "__main__":
    sys.exit(main())
