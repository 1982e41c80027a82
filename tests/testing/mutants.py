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
from hashlib import sha256
from itertools import zip_longest
from pathlib import Path
from typing import Any

import yaml
from tests.shapes import shapes

from driveblocks.maps import catalog, collection
from driveblocks.output.units import units
from driveblocks.render.text import languages
from driveblocks.testing.script import Program
from driveblocks.testing.unit import Unit
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.embedded.compiler import Compiler
from structured_text.engines.engine import EngineError, Source
from structured_text.language.checker import check
from structured_text.language.collector import paused
from structured_text.language.parser import parse
from structured_text.language.problems import SourceError
from structured_text.language.tree import Checked, Function, FunctionBlock, Pou
from structured_text.language.walk import statements

from .conftest import needed

SEEDS, NUMBER = (611, 612), 300
"""Drawn before the scenes were judged by them."""
FAMILIES = ("invt_chf", "jscc", "shuen_sn300g5")
MORE = "cia402"
"""A made-up family, whose map is second hand: it reaches what those do not."""
BLOCKS = re.compile(r".*/(?:line/MB_(?!\w*32)\w+|vfd/VFD_(?!\w*Text)\w+|\w+_(?:Drive|Reads|Orders|ParameterGate))\.st")
FIRST = ("Motor", "Line", "Parameters")
"""Groups of programs that look at these blocks, which are run before the rest."""
TURNS = 50_000
"""Turns of loops in a scan; no block takes a tenth of them."""
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
    before: str
    """Of its first line."""
    after: str
    """Of its last line."""

    def __str__(self) -> str:
        """By its place and text."""
        return f"{Path(self.path).stem}:{self.line}: {self.kind}: {_short(self.old)} -> {_short(self.new)}"

    @property
    def was(self) -> str:
        """The lines that it is in."""
        return self._lines(self.old)

    @property
    def now(self) -> str:
        """... with the change."""
        return self._lines(self.new)

    @property
    def why(self) -> str:
        """Why nothing finds it, where that is known."""
        return reasons().get((Path(self.path).stem, self.was, self.now), "")

    @property
    def survives(self) -> str:
        """What a person needs to judge it."""
        return f"SURVIVES\n  was: {self.was}\n  is: {self.now}"

    def _lines(self, part: str) -> str:
        return " ".join((self.before + part + self.after).split())

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
    """The units of the families by name."""
    sources = collection.read([catalog.folder() / f"{name}.yaml" for name in FAMILIES])
    one = shapes()[MORE]
    second_hand = replace(one, manual=replace(one.manual, second_hand=True))
    sources.append(collection.Source(Path(f"{MORE}.yaml"), second_hand))
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
        before = text[text.rfind("\n", 0, start) + 1 : start]
        after = text[end : text.find("\n", end)]
        yield Mutant(path, start, end, plain.count("\n", 0, start) + 1, kind, new, text[start:end], before, after)


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
    """All changes in the order of a seed, kinds in turn, so that none is rare; other changes keep their order."""
    by_kind: dict[str, list[Mutant]] = {}
    for one in every():
        by_kind.setdefault(one.kind, []).append(one)
    for kind in sorted(by_kind):
        by_kind[kind].sort(key=lambda one: sha256(f"{seed} {one.path} {one.was} {one.now}".encode()).digest())
    for turn in zip_longest(*(by_kind[kind] for kind in sorted(by_kind))):
        yield from filter(None, turn)


def _idle(one: Mutant) -> bool:
    """Whether a statement is left out that gives a variable what it has from the beginning, as all others do."""
    text = next(source.text for unit in made().values() for source in unit.blocks if source.path == one.path)
    plain = _COMMENT.sub("", text)
    given = {found[2] for found in _STATEMENT.finditer(plain) if found[1] == one.new}
    declared = re.search(rf"^  {re.escape(one.new)} : \w+;", plain, re.MULTILINE)
    handed = re.search(rf":= {re.escape(one.new)}\s*[,)]", plain)
    return one.kind == "reset" and given == {one.old} and declared is not None and handed is None


def judged(one: Mutant, most: int = 99) -> str | None:
    """The first check that fails, of `most` families; empty: none does. None: it does not build, or is no change."""
    if _idle(one):
        return None
    families = [family for family in (*FAMILIES, MORE) if _programs(family, one)]
    by: str | None = None
    for family in families[:most]:
        by = _found(one, family)
        if by != "":
            break
    return by


def _programs(family: str, one: Mutant) -> list[Program]:
    """The programs of a family that run the statement of a change, those that look at motors first."""
    text = next((source.text for source in made()[family].blocks if source.path == one.path), None)
    if text is None:
        return []
    place = (one.path, _statement(text, one.at))
    found = [program for program in made()[family].suite.programs if place in _reach(family)[program.name]]
    return sorted(found, key=lambda program: program.group not in FIRST)


@cache
def _statement(text: str, at: int) -> int:
    """The line where the innermost statement around a place begins."""
    unit = parse(text, "")
    bodies = [pou.body for pou in unit.elements if isinstance(pou, Function | FunctionBlock)]
    around = (each for body in bodies for each in statements(body) if each.at <= at < each.end)
    return max(unit.place(each.at)[0] for each in around)


@cache
def _reach(family: str) -> dict[str, set[tuple[str, int]]]:
    """Of each program the files and lines of the statements that it runs."""
    with paused():
        library = EmbeddedEngine(loop_limit=TURNS, coverage=True).build(made()[family].sources)
    reached = {}
    before = library.coverage()
    for program in made()[family].suite.programs:
        assert not _failed(library, program), program.name
        after = library.coverage()
        places = ((path, line, hits) for path, lines in after.items() for line, hits in lines.items())
        reached[program.name] = {(path, line) for path, line, hits in places if hits > before[path][line]}
        before = after
    return reached


def _found(one: Mutant, family: str) -> str | None:
    """The same of a family."""
    library = _library(family)
    objects = library.compiler.objects
    with paused():
        changed = _compiled(one, family)
    if changed is None or all(_same(changed.objects[key], objects[key]) for key in _bodies(one, objects)):
        return None
    for key, value in objects.items():
        changed.objects.setdefault(key, value)
    changed.objects["run"] = library.compiler.run
    before = {key: objects[key] for key in _bodies(one, objects)}
    objects.update({key: changed.objects[key] for key in before})
    try:
        failed = (_failed(library, program) for program in _programs(family, one))
        return next((words for words in failed if words), "")
    finally:
        objects.update(before)


def _bodies(one: Mutant, objects: dict[str, Any]) -> list[str]:
    """The functions that a file is compiled to."""
    return [key for key in objects if key.partition("_")[2] == Path(one.path).stem.upper()]


def _same(one: Any, other: Any) -> bool:
    """Whether two functions do the same, instruction by instruction, as where a constant has the value of another."""
    mine, theirs = one.__code__, other.__code__
    parts = ("co_code", "co_consts", "co_names", "co_varnames")
    return all(getattr(mine, part) == getattr(theirs, part) for part in parts)


@cache
def _library(family: str) -> EmbeddedLibrary:
    """What a family is built to, without a change; for each change one function of it is another."""
    with paused():
        return EmbeddedEngine(loop_limit=TURNS).build(made()[family].sources)


def _compiled(one: Mutant, family: str) -> "_Single | None":
    """The changed block alone; None: it does not build."""
    unit = made()[family]
    sources = needed(unit, [source.text for source in unit.blocks if source.path == one.path])
    try:
        single = _Single(check([parse(each.text, each.path) for each in map(one.edit, sources)]), one.path)
    except SourceError:
        return None
    return None if single.messages else single


class _Single(Compiler):
    """Compiles one file and leaves out the others."""

    def __init__(self, checked: Checked, path: str) -> None:
        self.path = path
        super().__init__(checked)

    def _attempt(self, pou: Pou) -> None:
        if pou.unit is not None and pou.unit.path == self.path:
            super()._attempt(pou)


def _failed(library: EmbeddedLibrary, program: Program) -> str:
    """The first check that fails; empty: none does."""
    instance = library.instance(program.name)
    for _ in range(sum(program.scans) + 1):
        try:
            instance.scan()
        except EngineError as error:
            return f"{program.name}: {error}"
        if instance["Failures"]:
            first = instance["FirstFailed"]
            assert isinstance(first, int)  # a UINT
            return f"{program.name}: {program.checks[first - 1].words}"
        if instance["Done"]:
            return ""
    return f"{program.name}: it does not end"


@cache
def reasons() -> dict[tuple[str, str, str], str]:
    """Why a change may survive: by block, text before and after."""
    rows = yaml.safe_load((Path(__file__).parent / "survivors.yaml").read_text(encoding="utf-8")) or []
    return {(row["block"], row["was"], row["is"]): row["why"] for row in rows}


def main(argv: Sequence[str] | None = None) -> int:
    """Judge a part of the draw. 1: one survives without a reason."""
    parser = argparse.ArgumentParser(description="Single changes of the blocks that run a motor.")
    parser.add_argument("--seed", type=int, default=SEEDS[0])
    parser.add_argument("--number", type=int, default=NUMBER)
    parser.add_argument("--part", default="1/1", help="K/N: every Nth change, from the Kth")
    parser.add_argument("--only", type=int, nargs="*")
    parser.add_argument("--quick", action="store_true", help="by one family")
    options = parser.parse_args(argv)
    which, of = map(int, options.part.split("/"))
    tally: Counter[str] = Counter()
    for number, one in enumerate(drawn(options.seed)):
        if (options.only is not None and number not in options.only) or number % of != which - 1:
            continue
        by = judged(one, 1 if options.quick else 99)
        verdict = "found" if by else "no change" if by is None else "explained" if one.why else "survived"
        tally[verdict] += 1
        if by is not None:
            print(f"{number}: {one}: {by or one.why or one.survives}", flush=True)
        if tally.total() - tally["no change"] >= options.number / of:
            break
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(tally.items())))
    return 1 if tally["survived"] else 0


if __name__ == "__main__":
    sys.exit(main())
