"""Sixty one-token mistakes in the blocks that run a motor, drawn by a seed: which of them does the matrix find?

`python -m tests.second.mutants` draws changes that lint and build, runs the sample of `sample.py` on each, then walks,
until one fails, which none does on the real text, and prints which; the survivors are for a person to judge: what does
the judge not look at, or can nobody tell the change from the text? `survivors.yaml` says so; the latter are no
mistakes, and are not counted. `--only N` repeats one. A judge that has never been wrong is worthless; so this is the
judge of the judge.
"""

import argparse
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from hashlib import sha256
from pathlib import Path
from random import Random

import yaml
from tests.drives import station as first
from tests.drives.station import FAMILIES
from tests.second.long import fastest
from tests.second.matrix import Cell, Outcome, Run, run
from tests.second.sample import aimed, sample
from tests.second.station import built
from tests.second.walk import walk

from structured_text.engines.engine import EngineError, Library, Source
from structured_text.language.lint import lint_sources

SEEDS, NUMBER = (734, 421, 411, 412, 911, 1203, 1517, 1811, 2027, 3011), 60
WALKS = 100
LOOK_S = 900
"""Of a processor, after which the process of a look at a change that never ends is ended."""
SURVIVORS = Path(__file__).with_name("survivors.yaml")
CONTROL = ("Control", "Pins", "Run", "FaultReset", "Start", "FirstStop", "StopRound", "Send", "Why", "HardStop")
DRIVE = ("Link", "Unit", "Usual", "Identity", "Diagnose")
LINE = (
    "Line8", "Stop", "TriesOver", "Rank", "Withdrawn", "Overdue", "Promise", "OthersMs", "Foreign", "Listen",
    "Repeats", "ReplyMs", "WhyFailed", "WhyUnsent",
)  # fmt: skip
OF_EACH = ("Drive", "Reads", "Orders", "ParameterGate")
BLOCKS = (
    *(f"VFD_{each}" for each in (*CONTROL, *DRIVE)),
    *(f"MB_{each}" for each in LINE),
    *(f"{family}_{each}" for family in FAMILIES for each in OF_EACH),
)
NAME = re.compile(r"^FUNCTION(?:_BLOCK)? (\w+)", re.MULTILINE)
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
    says: str
    """The change in its line, and which of those that read the same."""

    def __str__(self) -> str:
        """By name."""
        return f"{self.block} line {self.line}: {self.old} to {self.new or 'nothing'}"

    def edit(self, text: str) -> str:
        """The text with the change, where it is that block's."""
        found = NAME.search(text)
        if not found or found[1] != self.block:
            return text
        return text[: self.at] + self.new + text[self.at + len(self.old) :]


def changes(block: str, text: str) -> Iterator[Mutant]:
    """All changes of a block, in the order of its text; comments and declarations stay."""
    plain = re.sub(r"\(\*.*?\*\)", lambda each: re.sub(r"[^\n]", " ", each[0]), text, flags=re.DOTALL)
    again = Counter[str]()
    for token in TOKEN.finditer(plain, plain.rindex("END_VAR") + len("END_VAR")):
        old, at = token[0], token.start()
        new = str(int(old) + 1) if old.isdigit() else SWAPS.get(old)
        if new is not None:
            begin, end = plain.rindex("\n", 0, at) + 1, plain.index("\n", at)
            line = f"{plain[begin:at]}[{old} -> {new}]{plain[at + len(old) : end]}"
            says = f"{block}: {' '.join(line.split())}"
            again[says] += 1
            same = f" (again {again[says] - 1})" if again[says] > 1 else ""
            yield Mutant(block, at, plain.count("\n", 0, at) + 1, old, new, says + same)


def named(sources: Iterable[Source]) -> Iterator[tuple[str, str]]:
    """Blocks and functions by name."""
    for source in sources:
        found = NAME.search(source.text)
        if found:
            yield found[1], source.text


def every() -> list[Mutant]:
    """All changes, in the order of the texts."""
    return [one for name, text in named(first.texts(kinds=FAMILIES)) if name in BLOCKS for one in changes(name, text)]


def drawn(seed: int) -> list[Mutant]:
    """All changes in the order of a seed, which an edit elsewhere does not change; `mutated` refuses some."""
    return sorted(every(), key=lambda one: sha256(f"{seed} {one.says}".encode()).hexdigest())


def mutated(one: Mutant) -> Library | None:
    """The stations with a change; None where it does not lint or does not build."""
    if lint_sources((each.path, each.text) for each in first.texts(one.edit, FAMILIES)):
        return None
    try:
        return built(fastest(), one.edit)
    except EngineError:
        return None


def ordered(one: Mutant, number: int) -> list[tuple[Cell, int]]:
    """Cells that look at one rule, and of the sample: the changed drive's first, of few drives and long scans."""

    def dear(each: tuple[Cell, int]) -> tuple[bool, float]:
        row = Run(*each).row
        return not one.block.startswith((f"{each[0].family}_", "VFD_", "MB_")), row["size"] / row["ms"]

    found = [*aimed(), *sample()]
    Random(number).shuffle(found)
    return sorted(found, key=dear)


def looks(one: Mutant, number: int, most: int | None) -> Iterator[tuple[str, Callable[[Library], Outcome]]]:
    """The cells, or the first of them; after all of them walks."""
    for cell, seed in ordered(one, number)[:most]:
        yield f"{cell}, seed {seed}", partial(run, cell, seed)
    for seed in range(WALKS if most is None else 0):
        yield f"walk {seed}", partial(walk, seed)


def judged(one: Mutant, number: int, most: int | None = None) -> str | None:
    """What finds a change, with its rule; empty: nothing does. None: it is no change."""
    stations = mutated(one)
    if stations is None:
        return None
    for name, look in looks(one, number, most):
        _for_seconds(LOOK_S)
        try:
            outcome = look(stations)
        except Exception as error:
            return f"{name}: {type(error).__name__}"
        if outcome.rules:
            return f"{name}: {outcome.rules[0]}"
    return ""


def _for_seconds(more: int) -> None:
    """This process ends when it has used so much more of a processor."""
    import resource

    used = int(sum(resource.getrusage(resource.RUSAGE_SELF)[:2]))
    resource.setrlimit(resource.RLIMIT_CPU, (used + more, resource.getrlimit(resource.RLIMIT_CPU)[1]))


def apart(one: Mutant, number: int, most: int | None) -> str | None:
    """As `judged`, in a process of its own: a change that writes out of an array or never ends ends it."""
    with ProcessPoolExecutor(1) as pool:
        try:
            return pool.submit(judged, one, number, most).result()
        except BrokenProcessPool:
            return "its process ends"


def survivors() -> dict[str, dict[str, str]]:
    """By change: `same`, why no drive of the lines can tell it, or `open`, what the judge does not look at."""
    rows = yaml.safe_load(SURVIVORS.read_text(encoding="utf-8"))
    return {row["change"]: {name: why for name, why in row.items() if name != "change"} for row in rows}


def main() -> int:
    """Judge all of them, or one."""
    parser = argparse.ArgumentParser(description="One-token changes of the blocks.")
    parser.add_argument("--seed", type=int, default=SEEDS[0])
    parser.add_argument("--only", type=int, nargs="*")
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--step", type=int, default=1)
    parser.add_argument("--cells", type=int, help="cells for each, all unless said")
    options = parser.parse_args()
    known = survivors()
    number = found = missed = same = 0
    for one in drawn(options.seed):
        if number - same >= NUMBER:
            break
        row = known.get(one.says, {"open": "no reason yet"})
        mine = number in options.only if options.only else number % options.step == options.first
        if not mine and mutated(one) is None:
            continue
        by = apart(one, number, options.cells) if mine else ""
        if by is None:
            continue
        if mine:
            print(f"{number:2} {one}: {by or f'SURVIVES, {row}'}", flush=True)
        number, found = number + 1, found + bool(by)
        same, missed = same + (not by and "same" in row), missed + (mine and not by and "open" in row)
    print(f"{found} of {found + missed} found; {same} more are the same to every drive of the lines")
    return 0


if __name__ == "__main__":
    sys.exit(main())
