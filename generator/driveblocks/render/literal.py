"""Literals and comments of Structured Text, as every compiler reads them."""

import textwrap
from collections.abc import Iterable


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
