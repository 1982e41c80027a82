"""Texts of a map on Markdown pages: shown as they are, whatever they would mean there."""

import re
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest

from driveblocks.docs.page import Own, documents
from driveblocks.maps import inventory
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive, Entry
from driveblocks.maps.view import markdown
from driveblocks.platforms import TARGETS
from driveblocks.render.library import drive as library_of
from driveblocks.render.library import generic
from driveblocks.render.text import languages

EVIL = " <script>[x](y)|z\\"
CODE = re.compile(r"```.*?```|`[^`\n]*`", re.DOTALL)
EXAMPLE = Path(__file__).parents[1] / "maps" / "example.yaml"


def hostile(value: Any) -> Any:
    """A map whose texts all hold what Markdown would take for a tag, a link and the end of a cell."""
    if isinstance(value, str) and " " in value:
        return value + EVIL
    if isinstance(value, tuple):
        return tuple(map(hostile, value))
    if isinstance(value, Entry):
        return replace(value, **{each.name: hostile(getattr(value, each.name)) for each in fields(value)})
    return value


@pytest.fixture(scope="module")
def drive() -> Drive:
    """A drive with such texts."""
    made: Drive = hostile(load(EXAMPLE))
    return made


def raw(text: str) -> list[str]:
    """Lines outside of code in which a tag, a link or a cell of a map's text begins."""
    return [line for line in CODE.sub("", text).split("\n") if re.search(r"(?<!\\)(<script|\(y\)|\|z)", line)]


def test_a_text_is_shown_as_it_is() -> None:
    assert markdown("a|b\r\n# c <d> ![e](f) \\") == "a\\|b # c \\<d> ![e]\\(f) \\\\"


def test_no_text_of_a_map_is_markdown_on_a_page(drive: Drive) -> None:
    both = languages(["en"], "utf-8")
    files = [*generic(both), *library_of("example", drive, both)]
    own = {drive.prefix: Own(measured=[("Pump", [("plate" + EVIL, "1" + EVIL)])])}
    pages = documents(files, [drive], own, targets=TARGETS)
    pages["counts"] = inventory.table({EXAMPLE: drive}, Path()) + inventory.front({EXAMPLE: drive}, Path())
    wrong = {name: raw(text) for name, text in pages.items() if not name.endswith(".svg")}
    assert {name: lines for name, lines in wrong.items() if lines} == {}
    assert sum("script" in text for text in pages.values()) > 4
