"""Broken maps: each a good map, an edit, and what the loader says of the result.

`python -m tests.maps.bad` lists their names; `python -m tests.maps.bad NAME` prints one as a whole map.

A case in `bad/*.diff` begins with `@@ name of base`; its lines, but for their first character, are

    ` `  a line of the base that stays, shown because something is marked in it, or to say where the next one belongs
    `-`  a line that goes
    `+`  a line that comes
    `~`  a line in which [-this goes-] and {+this comes+}
    `!`  a message, for the place that `^` marks: the first `!` for the first `^`, and so on

Lines of the base that are not shown stay. Where a message names another line by its number it says `line $`, and `$`
marks that line, again in the order of the messages.
"""

import re
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).with_suffix("")


class Case(NamedTuple):
    """A whole map, and the messages for it: `line:column: what is wrong; what would be right`."""

    text: str
    messages: list[str]


@cache
def topics() -> dict[str, dict[str, Case]]:
    """Every case by the name of its file, then by its own."""
    return {path.stem: dict(edits(path)) for path in sorted(FOLDER.glob("*.diff"))}


def cases() -> dict[str, Case]:
    """Every case by its name."""
    return {name: case for topic in topics().values() for name, case in topic.items()}


def edits(path: Path, base_of: Callable[[str], list[str]] | None = None) -> Iterator[tuple[str, Case]]:
    """The maps of one file, by name. Good ones have no messages."""
    for part in ("\n" + path.read_bytes().decode("utf-8")).split("\n@@ ")[1:]:
        head, *lines = part.removesuffix("\n").split("\n")
        name, _, base = head.partition(" of ")
        edit = [(line[0], line[1:]) for line in lines]
        marked = _edited((base_of or _base)(base), [each for each in edit if each[0] != "!"])
        yield name, _case(marked, [text[1:] for sign, text in edit if sign == "!"])


@cache
def _base(name: str) -> list[str]:
    return (FOLDER / f"{name}.yaml").read_text(encoding="utf-8").split("\n") if name else [""]


def _edited(base: list[str], edit: list[tuple[str, str]]) -> list[str]:
    """The lines after an edit, with its marks."""
    made: list[str] = []
    at = 0
    for sign, text in edit:
        old = new = text
        if sign == "~":
            old = re.sub(r"\[-(.*?)-\]", r"\1", re.sub(r"\{\+.*?\+\}", "", text))
            new = re.sub(r"\{\+(.*?)\+\}", r"\1", re.sub(r"\[-.*?-\]", "", text))
        if sign != "+":
            found = base.index(re.sub(r"[$^]", "", old), at)
            made += base[at:found]
            at = found + 1
        if sign != "-":
            made.append(new)
    return made + base[at:]


def _case(marked: list[str], messages: list[str]) -> Case:
    places = []
    others = []
    for number, line in enumerate(marked, 1):
        marks = list(re.finditer(r"[$^]", line))
        places += [(number, mark.start() + 1 - before) for before, mark in enumerate(marks) if mark[0] == "^"]
        others += [str(number) for mark in marks if mark[0] == "$"]
    named = iter(others)
    told = [re.sub(r"\$", lambda _: next(named), message) for message in messages]
    assert not list(named), "a $ that no message names"
    text = re.sub(r"[$^]", "", "\n".join(marked))
    return Case(text, [f"{line}:{column}: {words}" for (line, column), words in zip(places, told, strict=True)])


def main(names: list[str]) -> None:
    """Print the maps of these names, or all names."""
    found = cases()
    text = "".join(found[name].text for name in names) if names else "\n".join(found) + "\n"
    sys.stdout.buffer.write(text.encode("utf-8"))


if __name__ == "__main__":
    main(sys.argv[1:])
