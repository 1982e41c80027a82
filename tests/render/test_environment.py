"""What templates make of every map at hand: a block declares what it names, and its head has the hash of its body."""

import re

import pytest
from tests.blocks.library import sources
from tests.blocks.test_fourth_drive import library as fourth
from tests.shapes import shapes
from tests.shipped import BOTH

from driveblocks.render import library
from structured_text.language.fingerprint import body, fingerprint, stream

INNER = re.compile(r"^VAR(?: CONSTANT)?\n(.*?)^END_VAR\n", re.DOTALL | re.MULTILINE)


def unnamed(text: str) -> list[str]:
    """Inner variables of a block that nothing names."""
    words = re.findall(r"\w+", re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL).upper())
    declared = re.findall(r"^  (\w+) : ", "".join(INNER.findall(text)), re.MULTILINE)
    return [name for name in declared if words.count(name.upper()) == 1]


def made(origin: str) -> dict[str, str]:
    """The blocks of some maps by path."""
    if origin == "shipped":
        return {each.path: each.text for each in sources()}
    if origin == "fourth":
        return {each.path: each.text for each in fourth()}
    return {each.path: each.text for name, drive in shapes().items() for each in library.drive(name, drive, BOTH)}


@pytest.mark.parametrize("origin", ["shipped", "fourth", "shapes"])
def test_a_block_declares_what_it_names(origin: str) -> None:
    assert {path: found for path, text in made(origin).items() if (found := unnamed(text))} == {}


def test_a_variable_that_nothing_names_is_found() -> None:
    text = "VAR_INPUT\n  Idle : BOOL; (* a pin *)\nEND_VAR\nVAR\n  Used : UINT; (* Spare *)\n  Spare : UINT;\nEND_VAR\n"
    assert unnamed(f"{text}\n  Used := 1;\n") == ["Spare"]


@pytest.mark.parametrize("origin", ["shipped", "fourth", "shapes"])
def test_the_hash_in_the_head_is_that_of_the_body(origin: str) -> None:
    for path, text in made(origin).items():
        said = re.search(r"^   Body     (\S+), a hash", text, re.MULTILINE)
        assert (said[1] if said else "") == (fingerprint(stream(body(text))) if body(text) else ""), path
