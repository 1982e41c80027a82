"""What is the user's in a file of a plant: places between marks, whose content outlives the next run.

A place begins with `(* your own: begin NAME *)` and ends before `(* your own: end NAME *)`; the marks are text in every
form of a program. A content goes from file to file of one platform as it is, escapes and all.
"""

import difflib
import html
import re
from collections.abc import Iterator

_PLACE = re.compile(r"(\(\* your own: begin (\w+) \*\))(.*?)([ \t]*\(\* your own: end \2 \*\))", re.DOTALL)
_PROGRAM = re.compile(r"<pou [^>]*pouType=\"program\".*?</pou>", re.DOTALL)
_SAID = re.compile(r"<xhtml(?::p)?(?: [^>]*[^/>])?>(?:<!\[CDATA\[)?(.*?)(?:\]\]>)?</xhtml(?::p)?>", re.DOTALL)
"""A program, and a text, in a file of TC6."""
MOST_LINES = 200
"""Of a difference that is shown."""


def contents(text: str) -> dict[str, str]:
    """What is between the marks of each place, with plain line ends; places that are empty are left out."""
    found = {name: inner for _, name, inner, _ in _PLACE.findall(_plain(text))}
    return {name: inner for name, inner in found.items() if inner.strip()}


def has_places(text: str) -> bool:
    """Whether it is a program that a person reads and writes; a ladder is not, nor a list of files."""
    return bool(_PLACE.search(text))


def emptied(text: str) -> str:
    """The text with nothing in its places, and with plain line ends."""
    return _PLACE.sub(r"\1\n\4", _plain(text))


def filled(text: str, given: dict[str, str]) -> str:
    """The text with contents in its places, with its own line ends."""
    made = _PLACE.sub(lambda found: f"{found[1]}{given.get(found[2], found[3])}{found[4]}", _plain(text))
    return made.replace("\n", "\r\n") if "\r\n" in text else made


def homeless(text: str, given: dict[str, str]) -> list[str]:
    """The contents for which a text has no place."""
    return sorted(given.keys() - {name for _, name, _, _ in _PLACE.findall(text)})


def difference(name: str, old: str, new: str) -> Iterator[str]:
    """What a person reads of a change: a unified difference of what both say."""
    before, after = (_readable(name, each).splitlines() for each in (old, new))
    heads = f"{name}, as it is", f"{name}, as it would be"
    lines = list(difflib.unified_diff(before, after, *heads, lineterm="", n=1))
    yield from lines[:MOST_LINES]
    if len(lines) > MOST_LINES:
        yield f"... and {len(lines) - MOST_LINES} more lines"


def _readable(name: str, text: str) -> str:
    """Of a file in XML, the texts of its programs."""
    plain = _plain(text).removeprefix("\ufeff")
    if not name.endswith(".xml"):
        return plain
    return html.unescape("\n".join(said for each in _PROGRAM.findall(plain) for said in _SAID.findall(each)))


def _plain(text: str) -> str:
    return text.replace("\r\n", "\n")
