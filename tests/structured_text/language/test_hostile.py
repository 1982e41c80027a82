"""Whatever the text, the front end ends, with its own errors and nothing else, and its work grows evenly."""

import random
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.steps import grows_evenly

from structured_text.language.lint import lint_sources
from structured_text.language.problems import Problem

HERE = Path(__file__).parent
SAMPLES = [(HERE / name).read_text(encoding="utf-8") for name in ("clean.st", "everything.st")]
MANY = 10_000
"""Far more than any stack of calls is deep."""
FEW = 1500
"""The growth of work is seen on texts of this many parts, and of twice and four times as many."""


def program(text: str) -> str:
    """A program with these statements."""
    return f"PROGRAM Example\nVAR\n  a : INT;\n  x : BOOL;\nEND_VAR\n{text}\nEND_PROGRAM\n"


@cache
def hostile(many: int) -> dict[str, str]:
    """Texts made to hurt, of this many parts."""
    return {
        "parentheses": program("a := " + "(" * many + "1" + ")" * many + ";"),
        "open parentheses": program("a := " + "(" * many),
        "branches": program("IF x THEN " * many),
        "cases": program("CASE a OF 1: " * many),
        "complements": program("x := " + "NOT " * many + "x;"),
        "signs": program("a := " + "- " * many + "a;"),
        "terms": program("a := " + "1 + " * many + "1;"),
        "members": program("a" + ".a" * many + " := 1;"),
        "indices": program("a" + "[a" * many + " := 1;"),
        "calls": program("a" + "(a" * many + ";"),
        "comments": "(* " * many,
        "unpaired comments": "(* (* *) " * (many // 10),
        "stars": "(" + "*" * many,
        "strings": "'" * many,
        "escapes": program("a := '" + "$$" * many),
        "digits": program("a := " + "9" * many + ";"),
        "hexadecimal digits": program("a := 16#" + "F" * many + ";"),
        "exponent": program("a := 1.0E" + "9" * (many // 100) + ";"),
        "duration": program("a := T#" + "1d" * many + ";"),
        "one word": "a" * many,
        "arrays": "TYPE T : " + "ARRAY[0..1] OF " * many + "INT; END_TYPE",
        "structures": "TYPE T : " + "STRUCT a : " * many + "INT; END_TYPE",
        "initial values": "PROGRAM p VAR a : INT := " + "[" * many,
        "nul bytes": "\0" * many,
        "braces": "{" * many,
        "aliases backwards": "".join(f"TYPE T{n} : T{n + 1}; END_TYPE\n" for n in range(many // 33)),
        "aliases forwards": "TYPE T0 : INT; END_TYPE\n"
        + "".join(f"TYPE T{n + 1} : STRUCT a : T{n}; END_STRUCT; END_TYPE\n" for n in range(many // 33)),
        "tower of blocks": "FUNCTION_BLOCK B0 VAR a : INT; END_VAR a := 1; END_FUNCTION_BLOCK\n"
        + "".join(
            f"FUNCTION_BLOCK B{n + 1} VAR b : B{n}; END_VAR b(); END_FUNCTION_BLOCK\n" for n in range(many // 33)
        ),
        "huge array": "TYPE T : ARRAY[0..2000000000, 0..2000000000] OF INT; END_TYPE",
        "huge string": "TYPE T : STRING[99999999999]; END_TYPE",
        "labels": program(
            "CASE a OF " + "".join(f"{n}..{n + 5}: a := 1; " for n in range(many // 20)) + "ELSE a := 0; END_CASE;"
        ),
        "bounds": "TYPE T : ARRAY[0.." + "1 + " * many + "1] OF INT; END_TYPE",
    }


def assert_survived(text: str) -> list[Problem]:
    """Lint a text, and show that what it says has a place within the text."""
    problems = lint_sources([("hostile.st", text)])
    lines = text.count("\n") + 1
    for each in problems:
        assert 1 <= each.line <= lines
        assert each.column >= 1
        assert len(str(each)) < 400
    return problems


@pytest.mark.parametrize("name", hostile(MANY))
def test_hostile_text_is_reported(name: str) -> None:
    assert assert_survived(hostile(MANY)[name])


@pytest.mark.parametrize("name", hostile(FEW))
def test_twice_the_text_is_about_twice_the_work(name: str) -> None:
    assert grows_evenly(lambda size: lambda: assert_survived(hostile(FEW * size)[name]))


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


@given(st.sampled_from(SAMPLES), st.integers(0, 2**32))
def test_mutations_of_good_text_raise_nothing(text: str, seed: int) -> None:
    assert_survived(mutated(text, random.Random(seed)))


VOCABULARY = """
    IF THEN ELSE END_IF CASE OF END_CASE WHILE DO END_WHILE FOR TO BY END_FOR REPEAT UNTIL END_REPEAT VAR END_VAR EXIT
    VAR_INPUT FUNCTION_BLOCK END_FUNCTION_BLOCK FUNCTION END_FUNCTION PROGRAM END_PROGRAM TYPE END_TYPE STRUCT
    END_STRUCT ARRAY INT WORD BOOL TON a b c x 1 2.5 16#FF WORD#16#1 T#1s 'a' ( ) [ ] ; : , . .. := => + - * / **
    AND OR NOT MOD = <> < > <= >= & ^ # $ ' " (* *) // /* */ { } %IX0.0 SHL SHR MAX LEN INT_TO_REAL CONFIGURATION
    RESOURCE TASK ON PLC WITH VAR_GLOBAL VAR_EXTERNAL METHOD END_METHOD STRING POINTER
"""
WORDS = st.sampled_from(VOCABULARY.split())


@given(st.lists(WORDS, max_size=60))
def test_any_words_raise_nothing(words: list[str]) -> None:
    assert_survived(" ".join(words))
    assert_survived(program(" ".join(words)))


@given(st.text(max_size=200))
def test_any_text_raises_nothing(text: str) -> None:
    assert_survived(text)
