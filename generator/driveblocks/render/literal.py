"""Literals and comments of Structured Text, in the forms of the portable part."""

import itertools
import re
import textwrap
from collections.abc import Iterable

WIDTH = 120
"""Longest line, but for a string that is longer itself."""

_BESIDE = re.compile(r"( *)(\S.*;) (\(\*.*\*\))")
_DECLARED = re.compile(r"  (\w+ : [^;]*;) +(\(\*.*\*\))")


def word(value: int) -> str:
    """A WORD literal: 38 -> WORD#16#0026."""
    return f"WORD#16#{value & 0xFFFF:04X}"


def byte(value: int) -> str:
    """A BYTE literal: 58 -> BYTE#16#3A."""
    return f"BYTE#16#{value & 0xFF:02X}"


def comment(text: str) -> str:
    """A text that cannot end the comment it stands in, nor open another."""
    return " ".join(text.replace("(*", "( *").replace("*)", "* )").split())


def string(text: str, encoding: str = "utf-8") -> str:
    """A STRING literal. Text beyond ASCII is escaped whole: after an escape two compilers swallow a digit."""
    data = text.encode(encoding)
    if all(0x20 <= octet < 0x7F for octet in data):
        return "'" + text.replace("$", "$$").replace("'", "$'") + "'"
    return "'" + "".join(f"${octet:02X}" for octet in data) + "'"


def rows(values: Iterable[str], per_row: int = 8, indent: str = "    ") -> str:
    """Array elements in rows, separated by commas."""
    items = list(values)
    lines = [", ".join(items[at : at + per_row]) for at in range(0, len(items), per_row)]
    return ",\n".join(indent + line for line in lines)


def paragraph(label: str, text: str, width: int = 100) -> str:
    """A labelled paragraph of a head comment, wrapped under its label."""
    lead = f"   {label:<9}"
    return textwrap.fill(comment(text), width, initial_indent=lead, subsequent_indent=" " * len(lead))


def aligned(text: str) -> str:
    """The text with the comments behind consecutive declarations in one column, and no line too long for a comment."""
    lines: list[str] = []
    for declared, group in itertools.groupby(text.split("\n"), lambda line: bool(_DECLARED.fullmatch(line))):
        run = list(group)
        lines.extend(_column(run) if declared else map(_above, run))
    return "\n".join(lines)


def _column(lines: list[str]) -> list[str]:
    matches = [match for line in lines if (match := _DECLARED.fullmatch(line))]
    width = max(len(match[1]) for match in matches)
    return [_wrapped(f"  {match[1]:<{width}} ", match[2]) for match in matches]


def _wrapped(lead: str, comment: str) -> str:
    """A declaration whose comment goes on below itself where the line ends."""
    lines = textwrap.wrap(comment, max(WIDTH - len(lead), 40), break_long_words=False, break_on_hyphens=False)
    return lead + f"\n{' ' * (len(lead) + 3)}".join(lines)


def _above(line: str) -> str:
    """A statement with its comment, the comment above where both are too long for one line."""
    match = _BESIDE.fullmatch(line) if len(line) > WIDTH else None
    return f"{match[1]}{match[3]}\n{match[1]}{match[2]}" if match else line
