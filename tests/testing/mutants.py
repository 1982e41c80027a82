"""Single changes of the blocks that run a motor, drawn by a seed: which of them does `driveblocks test` find?

    python -m tests.testing.mutants [--seed S] [--number N] [--part K/N] [--only I ...]

Draws changes over the real text of line, control and drive blocks (an operator, a condition, a number, a constant, a
statement or a reset left out) that build, and runs on each what a map author runs: every test program of a
family. Prints each change with the first check that fails; the survivors are for a person to judge: is the change one
that nobody can tell from the text, or is a scene missing?
"""

import argparse
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from random import Random

from driveblocks.building.build import units
from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.host.engine import EngineError, Source
from driveblocks.maps import catalog, collection
from driveblocks.render.text import languages
from driveblocks.testing.execute import Setting, execute
from driveblocks.testing.unit import Unit

SEEDS, NUMBER = (611, 612), 300
"""Drawn before the scenes were judged by them."""
FAMILIES = ("invt_chf", "jscc", "shuen_sn300g5")
BLOCKS = re.compile(r".*/(?:line/MB_(?!\w*32)\w+|vfd/VFD_(?!\w*Text)\w+|\w+_(?:Drive|Reads|Orders|ParameterGate))\.st")
FIRST = ("Motor", "Line", "Parameters", "The manual's frames")
"""Groups that look at these blocks, which are run before the rest."""
SWAPS = {
    "AND": ("OR",), "OR": ("AND",), "TRUE": ("FALSE",), "FALSE": ("TRUE",), "NOT": ("",), "<": ("<=", ">"),
    "<=": ("<", ">"), ">": (">=", "<"), ">=": (">", "<"), "=": ("<>",), "<>": ("=",), "+": ("-",), "-": ("+",),
    "MAX": ("MIN",), "MIN": ("MAX",),
}  # fmt: skip
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
_TOKEN = re.compile(r":=|=>|<=|>=|<>|[<>=+-]|\b\w+#\w+\b|\b[A-Za-z_]\w*\b|\b\d+\b")
_STATEMENT = re.compile(r"^ +([\w.\[\]]+) := ([^;]+);", re.MULTILINE)
_CONDITION = re.compile(r"^ *(?:IF|ELSIF) (.*?) THEN", re.MULTILINE | re.DOTALL)
_CONSTANT = re.compile(r"^  ([A-Z][A-Z_0-9]+) : (\w+) := [^;]+;", re.MULTILINE)


@dataclass(frozen=True)
class Mutant:
    """A change in a file: from where to where, and what is there instead."""

    path: str
    at: int
    end: int
    line: int
    kind: str
    new: str
    old: str

    def __str__(self) -> str:
        """By its place and text."""
        return f"{Path(self.path).stem}:{self.line}: {self.kind}: {_short(self.old)} -> {_short(self.new)}"

    def edit(self, source: Source) -> Source:
        """The source with the change, where it is that file."""
        if source.path != self.path:
            return source
        return Source(source.path, source.text[: self.at] + self.new + source.text[self.end :])


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) < 60 else text[:57] + "..."


@cache
def made() -> dict[str, Unit]:
    """The units of the shipped families by name."""
    sources = collection.read([catalog.folder() / f"{name}.yaml" for name in FAMILIES])
    return {unit.suite.name: unit for unit in units(sources, languages(["en", "zh"], "utf-8"))}


def every() -> list[Mutant]:
    """All changes, a shared block once."""
    texts = {source.path: source.text for family in FAMILIES for source in made()[family].blocks}
    return [one for path, text in texts.items() if BLOCKS.fullmatch(path) for one in _changes(path, text)]


def _changes(path: str, text: str) -> Iterator[Mutant]:
    """All changes of a file; comments and declarations stay."""
    plain = _COMMENT.sub(lambda each: re.sub(r"[^\n]", " ", each[0]), text)
    if "END_VAR" not in plain:
        return
    begins = plain.rindex("END_VAR") + len("END_VAR")
    constants = dict(_CONSTANT.findall(plain[:begins]))
    for kind, start, end, new in (*_tokens(plain, begins, constants), *_parts(plain, begins)):
        yield Mutant(path, start, end, plain.count("\n", 0, start) + 1, kind, new, text[start:end])


def _tokens(plain: str, begins: int, constants: dict[str, str]) -> Iterator[tuple[str, int, int, str]]:
    """An operator, a number, a constant."""
    for token in _TOKEN.finditer(plain, begins):
        old = token[0]
        if old.isdigit():
            yield "number", token.start(), token.end(), str(int(old) + 1)
        for new in SWAPS.get(old, ()):
            yield "operator", token.start(), token.end(), new
        others = [name for name, kind in constants.items() if kind == constants.get(old) and name != old]
        if others:
            yield "constant", token.start(), token.end(), others[token.start() % len(others)]


def _parts(plain: str, begins: int) -> Iterator[tuple[str, int, int, str]]:
    """A condition negated, a statement without effect, a reset left out."""
    for found in _CONDITION.finditer(plain, begins):
        yield "condition", found.start(1), found.end(1), f"NOT ({found[1]})"
    for found in _STATEMENT.finditer(plain, begins):
        if found[1] != found[2]:
            kind = "reset" if found[2] in ("0", "FALSE") else "statement"
            yield kind, found.start(2), found.end(2), found[1]


def drawn(seed: int) -> Iterator[Mutant]:
    """All changes in the order of a seed, kinds in turn, so that none is rare."""
    random = Random(seed)
    by_kind: dict[str, list[Mutant]] = {}
    for one in every():
        by_kind.setdefault(one.kind, []).append(one)
    for kind in sorted(by_kind):
        random.shuffle(by_kind[kind])
    while any(by_kind.values()):
        for kind in sorted(by_kind):
            if by_kind[kind]:
                yield by_kind[kind].pop()


def judged(one: Mutant) -> str | None:
    """The first check that fails; empty: none does. None: it does not build, or is in no family."""
    found = [family for family in FAMILIES if any(source.path == one.path for source in made()[family].blocks)]
    for family in found:
        by = _found(one, made()[family], family)
        if by != "":
            return by
    return "" if found else None


def _found(one: Mutant, unit: Unit, family: str) -> str | None:
    """The same of a family."""
    changed = replace(unit, blocks=tuple(one.edit(source) for source in unit.blocks))
    try:
        library = EmbeddedEngine().build(changed.sources)
    except EngineError:
        return None
    programs = sorted(unit.suite.programs, key=lambda program: program.group not in FIRST)
    for program in programs:
        result = execute(library, program, Setting("embedded", family, "", 60.0))
        if result.bad:
            return f"{program.name}: {result.bad[0].words}"
    return ""


def main(argv: Sequence[str] | None = None) -> int:
    """Judge a part of the draw."""
    parser = argparse.ArgumentParser(description="Single changes of the blocks that run a motor.")
    parser.add_argument("--seed", type=int, default=SEEDS[0])
    parser.add_argument("--number", type=int, default=NUMBER)
    parser.add_argument("--part", default="1/1", help="K/N: every Nth change, from the Kth")
    parser.add_argument("--only", type=int, nargs="*")
    options = parser.parse_args(argv)
    which, of = map(int, options.part.split("/"))
    tally: Counter[str] = Counter()
    for number, one in enumerate(drawn(options.seed)):
        if (options.only is not None and number not in options.only) or number % of != which - 1:
            continue
        by = judged(one)
        tally["found" if by else "none" if by is None else "survived"] += 1
        if by is not None:
            print(f"{number}: {one}: {by or 'SURVIVES'}", flush=True)
        if tally["found"] + tally["survived"] >= options.number / of:
            break
    print(f"{tally['found']} found, {tally['survived']} survived, {tally['none']} were no change")
    return 0


if __name__ == "__main__":
    sys.exit(main())
