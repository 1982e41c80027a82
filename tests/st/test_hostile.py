"""Whatever the text, the front end ends soon, with its own errors and nothing else."""

import random
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from driveblocks.st.checker import analyse
from driveblocks.st.lint import lint, lint_sources
from driveblocks.st.parser import parse
from driveblocks.st.problems import ParseError, Problem
from driveblocks.st.tree import Unit

HERE = Path(__file__).parent
SAMPLES = [(HERE / name).read_text(encoding="utf-8") for name in ("clean.st", "everything.st")]
MANY = 100_000


def program(text: str) -> str:
    """A program with these statements."""
    return f"PROGRAM Example\nVAR\n  a : INT;\n  x : BOOL;\nEND_VAR\n{text}\nEND_PROGRAM\n"


HOSTILE = {
    "parentheses": program("a := " + "(" * MANY + "1" + ")" * MANY + ";"),
    "open parentheses": program("a := " + "(" * MANY),
    "branches": program("IF x THEN " * MANY),
    "cases": program("CASE a OF 1: " * MANY),
    "complements": program("x := " + "NOT " * MANY + "x;"),
    "signs": program("a := " + "- " * MANY + "a;"),
    "terms": program("a := " + "1 + " * MANY + "1;"),
    "members": program("a" + ".a" * MANY + " := 1;"),
    "indices": program("a" + "[a" * MANY + " := 1;"),
    "calls": program("a" + "(a" * MANY + ";"),
    "comments": "(* " * MANY,
    "unpaired comments": "(* (* *) " * (MANY // 10),
    "stars": "(" + "*" * MANY,
    "strings": "'" * MANY,
    "escapes": program("a := '" + "$$" * MANY),
    "digits": program("a := " + "9" * MANY + ";"),
    "hexadecimal digits": program("a := 16#" + "F" * MANY + ";"),
    "exponent": program("a := 1.0E" + "9" * 1000 + ";"),
    "duration": program("a := T#" + "1d" * MANY + ";"),
    "one word": "a" * MANY,
    "arrays": "TYPE T : " + "ARRAY[0..1] OF " * MANY + "INT; END_TYPE",
    "structures": "TYPE T : " + "STRUCT a : " * MANY + "INT; END_TYPE",
    "initial values": "PROGRAM p VAR a : INT := " + "[" * MANY,
    "nul bytes": "\0" * MANY,
    "braces": "{" * MANY,
    "aliases backwards": "".join(f"TYPE T{n} : T{n + 1}; END_TYPE\n" for n in range(3000)),
    "aliases forwards": "TYPE T0 : INT; END_TYPE\n"
    + "".join(f"TYPE T{n + 1} : STRUCT a : T{n}; END_STRUCT; END_TYPE\n" for n in range(3000)),
    "tower of blocks": "FUNCTION_BLOCK B0 VAR a : INT; END_VAR a := 1; END_FUNCTION_BLOCK\n"
    + "".join(f"FUNCTION_BLOCK B{n + 1} VAR b : B{n}; END_VAR b(); END_FUNCTION_BLOCK\n" for n in range(3000)),
    "huge array": "TYPE T : ARRAY[0..2000000000, 0..2000000000] OF INT; END_TYPE",
    "huge string": "TYPE T : STRING[99999999999]; END_TYPE",
    "labels": program(
        "CASE a OF " + "".join(f"{n}..{n + 5}: a := 1; " for n in range(5000)) + "ELSE a := 0; END_CASE;"
    ),
    "bounds": "TYPE T : ARRAY[0.." + "1 + " * MANY + "1] OF INT; END_TYPE",
}


def survive(text: str) -> list[Problem]:
    """Lint a text, and show that what it says has a place within the text."""
    problems = lint_sources([("hostile.st", text)])
    lines = text.count("\n") + 1
    for each in problems:
        assert 1 <= each.line <= lines
        assert each.column >= 1
        assert len(str(each)) < 400
    return problems


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_is_told_and_ends_soon(name: str) -> None:
    start = time.process_time()
    problems = survive(HOSTILE[name])
    assert problems
    assert time.process_time() - start < 10


def mutated(text: str, source: random.Random) -> str:
    """A text with a few tokens or characters taken out, doubled, swapped or replaced."""
    pieces = text.split(" ") if source.random() < 0.5 else list(text)
    for _ in range(source.randrange(1, 6)):
        at, other = source.randrange(len(pieces)), source.randrange(len(pieces))
        kind = source.randrange(4)
        if kind == 0:
            pieces[at] = ""
        elif kind == 1:
            pieces[at], pieces[other] = pieces[other], pieces[at]
        elif kind == 2:
            pieces[at] = pieces[other]
        else:
            pieces[at] = source.choice(
                ["(", ")", "END_IF", "'", "(*", "*)", ";", ":=", "16#", "#", "[", "..", "é", "VAR"]
            )
    return (" " if " " in text and len(pieces) < len(text) else "").join(pieces)


@pytest.mark.parametrize("seed", range(8))
def test_mutations_of_good_text_raise_nothing(seed: int) -> None:
    source = random.Random(seed)
    for _ in range(12):
        survive(mutated(SAMPLES[seed % 2], source))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(100, 120))
def test_many_mutations_raise_nothing(seed: int) -> None:
    source = random.Random(seed)
    for _ in range(200):
        survive(mutated(SAMPLES[seed % 2], source))


VOCABULARY = """
    IF THEN ELSE END_IF CASE OF END_CASE WHILE DO END_WHILE FOR TO BY END_FOR REPEAT UNTIL END_REPEAT VAR END_VAR EXIT
    VAR_INPUT FUNCTION_BLOCK END_FUNCTION_BLOCK FUNCTION END_FUNCTION PROGRAM END_PROGRAM TYPE END_TYPE STRUCT
    END_STRUCT ARRAY INT WORD BOOL TON a b c x 1 2.5 16#FF WORD#16#1 T#1s 'a' ( ) [ ] ; : , . .. := => + - * / **
    AND OR NOT MOD = <> < > <= >= & ^ # $ ' " (* *) // /* */ { } %IX0.0 SHL SHR MAX LEN INT_TO_REAL CONFIGURATION
    RESOURCE TASK ON PLC WITH VAR_GLOBAL VAR_EXTERNAL METHOD END_METHOD STRING POINTER
"""
WORDS = st.sampled_from(VOCABULARY.split())


@settings(max_examples=150)
@given(st.lists(WORDS, max_size=60))
def test_any_words_raise_nothing(words: list[str]) -> None:
    survive(" ".join(words))
    survive(program(" ".join(words)))


@settings(max_examples=100)
@given(st.text(max_size=200))
def test_any_text_raises_nothing(text: str) -> None:
    survive(text)


def parsed(text: str) -> Unit | None:
    """The tree of a text, if it has one."""
    try:
        return parse(text, "mutated.st")
    except ParseError:
        return None


def test_white_space_and_comments_change_nothing_but_places() -> None:
    text = SAMPLES[0]
    spaced = text.replace(";", " ; ").replace("(*", "  (*").replace(":=", " (* here *) := ")
    assert [each.rule for each in lint([unit for unit in (parsed(spaced),) if unit])] == []
    one, two = parsed(text), parsed(spaced)
    assert one is not None
    assert two is not None
    assert [type(each) for each in one.elements] == [type(each) for each in two.elements]
    assert len(two.comments) == len(one.comments) + text.count(":=")


def test_analyse_survives_what_parses() -> None:
    source = random.Random(7)
    for _ in range(30):
        unit = parsed(mutated(SAMPLES[1], source))
        if unit is not None:
            checked, problems = analyse([unit])
            assert checked.units == [unit]
            assert all(each.path == "mutated.st" for each in problems)
