"""Texts as a message may hold them: control characters would steer the terminal, so they are written out."""

import re
from pathlib import Path

_HIDDEN = re.compile(
    "[\0-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f"
    "\ufeff\ufff9-\ufffb\ufffe\uffff\ud800-\udfff\U000e0000-\U000e0fff]"
)
"""Control characters but for tab and line feed, what directs or hides text, and what is no character at all."""


def visible(text: str) -> str:
    """A text with what nobody can see written as JSON does, \\u001b; tabs and line feeds stay."""
    return _HIDDEN.sub(lambda match: _written(match[0]), text)


def file_name(path: str | Path) -> str:
    """The name of a file as a message holds it: in one line, whatever is in it."""
    return visible(str(path)).replace("\n", _written("\n")).replace("\t", _written("\t"))


def _written(character: str) -> str:
    units = character.encode("utf-16-be", "surrogatepass").hex()
    return "".join(f"\\u{units[at : at + 4]}" for at in range(0, len(units), 4))
