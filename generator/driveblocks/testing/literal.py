"""Literals and comments of the test programs."""

import re
import textwrap

WIDTH = 110
"""Columns of the longest line."""


def word(value: int) -> str:
    """A WORD literal of the low 16 bits: 38 -> WORD#16#0026, -1 -> WORD#16#FFFF."""
    return f"WORD#16#{value & 0xFFFF:04X}"


def byte(value: int) -> str:
    """A BYTE literal: 58 -> BYTE#16#3A."""
    return f"BYTE#16#{value:02X}"


def dword(value: int) -> str:
    """A DWORD literal: 38 -> DWORD#16#00000026."""
    return f"DWORD#16#{value:08X}"


def flag(value: bool) -> str:
    """TRUE or FALSE."""
    return "TRUE" if value else "FALSE"


def real(value: float) -> str:
    """A REAL literal that reads back as the same REAL: 50 -> 50.0, 1e30 -> 1.0E30."""
    mantissa, exponent = f"{value:.9g}".partition("e")[::2]
    whole = mantissa if "." in mantissa else f"{mantissa}.0"
    return f"{whole}E{int(exponent)}" if exponent else whole


def string(data: bytes) -> str:
    """A STRING literal of bytes. Bytes beyond printable ASCII are escaped, and then all: two compilers swallow the
    digit behind an escape.
    """
    if all(0x20 <= octet < 0x7F for octet in data):
        return "'" + data.decode("ascii").replace("$", "$$").replace("'", "$'") + "'"
    return "'" + "".join(f"${octet:02X}" for octet in data) + "'"


def comment(text: str) -> str:
    """A text that can stand in a comment: it neither ends it nor opens another."""
    return " ".join(text.replace("(*", "( *").replace("*)", "* )").split())


def paragraph(lead: str, text: str, end: str = "", width: int = WIDTH) -> list[str]:
    """Lines of a comment that starts with `lead`; further lines are indented to its end."""
    return textwrap.wrap(comment(text) + end, width, initial_indent=lead, subsequent_indent=" " * len(lead))


def flowing(statements: list[str], indent: str, width: int = WIDTH) -> list[str]:
    """Statements side by side, as many to a line as fit; one that does not fit by itself is broken at its blanks."""
    lines: list[str] = []
    for statement in statements:
        if lines and len(lines[-1]) + 1 + len(statement) <= width:
            lines[-1] += f" {statement}"
        else:
            lines += broken(statement, indent, width)
    return lines


def broken(statement: str, indent: str, width: int = WIDTH) -> list[str]:
    """A statement on as many lines as it needs; a blank in a text is no place to break."""
    lines = [indent]
    for piece in re.findall(r"(?:'(?:\$.|[^$'])*'|[^\s'])+", statement):
        if lines[-1].strip() and len(lines[-1]) + 1 + len(piece) > width:
            lines.append(f"{indent}  {piece}")
        else:
            lines[-1] += f" {piece}" if lines[-1].strip() else piece
    return lines


def remarked(statement: str, words: str, indent: str, width: int = WIDTH) -> list[str]:
    """A statement and a remark behind it, or before it where both together are too long."""
    lines, remark = broken(statement, indent, width), f"(* {comment(words)} *)"
    if len(lines[-1]) + 1 + len(remark) <= width + 10:
        return [*lines[:-1], f"{lines[-1]} {remark}"]
    return [*paragraph(f"{indent}(* ", words, " *)", width), *lines]
