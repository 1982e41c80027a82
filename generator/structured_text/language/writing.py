"""Literals, comments and lines of the Structured Text that is written here, in the forms of the portable part."""

import itertools
import re
import textwrap

WIDTH = 110
"""Columns of the longest line of a program."""

MOST = 120
"""Columns of the longest line with a comment, but for a string that is longer itself."""

_BESIDE = re.compile(r"( *)(\S.*;) (\(\*.*\*\))")
_PIECES = re.compile(r"(?:'(?:\$.|[^$'])*'|[^\s'])+")
_JOINTS = re.compile(r"(?<=,) (?=\S)| (?=(?:AND|OR) )")
_DECLARED = re.compile(r"  (\w+ : [^;]*;) +(\(\*.*\*\))")


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
    digit after an escape.
    """
    if all(0x20 <= octet < 0x7F for octet in data):
        return "'" + data.decode("ascii").replace("$", "$$").replace("'", "$'") + "'"
    return "'" + "".join(f"${octet:02X}" for octet in data) + "'"


def comment(text: str) -> str:
    """A text that can be in a comment: it neither ends it nor opens another."""
    return " ".join(text.replace("(*", "( *").replace("*)", "* )").split())


def paragraph(lead: str, text: str, end: str = "", width: int = WIDTH) -> list[str]:
    """Lines of a comment that starts with `lead`; further lines are indented to its end."""
    whole = comment(text) + end
    if whole and len(lead) + len(whole) <= width:
        return [lead + whole]  # as most are
    later, words = " " * len(lead), whole.split()
    if "-" in whole or max(map(len, words), default=width) > width - len(lead):
        return textwrap.wrap(whole, width, initial_indent=lead, subsequent_indent=later)
    return _filled(words, lead, later, width)  # what that does, too, where a line ends at blanks alone


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
    pieces = _PIECES.findall(statement) if "'" in statement else statement.split()
    whole = indent + " ".join(pieces)
    return [whole] if len(whole) <= width else _filled(pieces, indent, f"{indent}  ", width)


def _filled(pieces: list[str], lead: str, later: str, width: int) -> list[str]:
    lines = [lead + pieces[0]]
    for piece in pieces[1:]:
        if len(lines[-1]) + 1 + len(piece) > width:
            lines.append(later + piece)
        else:
            lines[-1] += f" {piece}"
    return lines


def remarked(statement: str, words: str, indent: str, width: int = WIDTH) -> list[str]:
    """A statement and a remark after it, or before it where both together are too long."""
    lines, remark = broken(statement, indent, width), f"(* {comment(words)} *)"
    if len(lines[-1]) + 1 + len(remark) <= width + 10:
        return [*lines[:-1], f"{lines[-1]} {remark}"]
    return [*paragraph(f"{indent}(* ", words, " *)", width), *lines]


def aligned(text: str) -> str:
    """The text with the comments after consecutive declarations in one column, and no line too long for a comment."""
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
    """A declaration whose comment continues below itself where the line ends."""
    width = max(MOST - len(lead), 40)
    if len(comment) <= width and "\t" not in comment:
        return lead + comment
    lines = textwrap.wrap(comment, width, break_long_words=False, break_on_hyphens=False)
    return lead + f"\n{' ' * (len(lead) + 3)}".join(lines)


def _above(line: str) -> str:
    """A statement with its comment, the comment above where both are too long for one line."""
    match = _BESIDE.fullmatch(line) if len(line) > MOST else None
    return f"{match[1]}{match[3]}\n{match[1]}{match[2]}" if match else line


def folded(text: str) -> str:
    """A program in which a long line is broken after commas, before AND and OR; not one with a text or comment."""
    return "\n".join(itertools.chain.from_iterable(map(_folded, text.split("\n"))))


def _folded(line: str) -> list[str]:
    if len(line) <= MOST or "'" in line or "(*" in line:
        return [line]
    start = line[: -len(line.lstrip())]
    return _filled(_JOINTS.split(line.lstrip()), start, f"{start}  ", MOST)
