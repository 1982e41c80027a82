"""The linter finds each construct of a file that has them all, and nothing in a clean one."""

import re
from collections import defaultdict
from pathlib import Path

import pytest

from structured_text.engines.engine import Engine, Source
from structured_text.language.checker import check
from structured_text.language.lint import lint_sources
from structured_text.language.names import reserved
from structured_text.language.parser import parse
from structured_text.language.rules import RULES

FINDS = re.compile(r"\(\* finds: ([\w, -]+) \*\)$")
# What cannot be beside the rest in a file, stops the parser, or is found for a target or where selected: see `rules/`.
ELSEWHERE = {
    "taken-back",
    "syntax",
    "long-expression",
    "undeclared-name",
    "unknown-type",
    "duplicate-name",
    "type-mismatch",
    "call-arguments",
    "not-assignable",
    "literal-range",
    "no-result",
    "duplicate-label",
    "misplaced-exit",
    "ambiguous-name",
    "return-value",
    "dialect-assignment",
    "configuration-inside",
    "empty-file",
    "target-name",
    "long-name",
    "program-task",
    "program-connection",
}
# Names that stop at least one compiler and are easily taken.
TAKEN = """
    len by to on of or left right find limit min max sel mux move mod step task time tod date real int byte word string
    action transition resource program retain constant read_only read_write eq ne ge gt le lt add sub mul div and not
    xor any abs ln log exp sin cos tan sqrt trunc insert delete replace concat mid rs sr sema tp ton tof ctu ctd ctud
    r_trig f_trig pid ramp rtc integral derivative hysteresis eno en null dt t
"""
FREE = "data status state value index count length error busy done reset timeout address quantity func unit crc lrc"


def test_each_construct_is_found_in_its_line_and_nothing_else(here: Path) -> None:
    text = (here / "everything.st").read_text(encoding="utf-8")
    wanted = defaultdict(set, {1: {"byte-order-mark"}})
    for number, line in enumerate(text.splitlines(), 1):
        if found := FINDS.search(line):
            wanted[number] |= set(found[1].split(", "))
    told = defaultdict(set)
    for each in lint_sources([("everything.st", text)]):
        told[each.line].add(each.rule)
    assert dict(told) == dict(wanted)
    assert set().union(*wanted.values()) == set(RULES) - ELSEWHERE


def test_nothing_is_found_in_clean_text(here: Path) -> None:
    text = (here / "clean.st").read_text(encoding="utf-8")
    assert text.count("\n") >= 300
    assert lint_sources([("clean.st", text)]) == []
    assert check([parse(text, "clean.st")]).callees_first[-1].name == "MB_Master"


def test_every_engine_builds_the_clean_text(here: Path, engine: Engine) -> None:
    library = engine.build([Source.read(here / "clean.st")])
    assert "MB_MASTER" in {name.upper() for name in library.blocks()}


@pytest.mark.parametrize("name", TAKEN.split())
def test_names_that_trip_people_are_reserved(name: str) -> None:
    assert reserved(name)
    assert reserved(name.upper())
    assert reserved(name.title())


@pytest.mark.parametrize("name", [*FREE.split(), "buf", "tx", "rx", "n", "mode", "code", "retries"])
def test_good_names_are_free(name: str) -> None:
    assert reserved(name) is None
