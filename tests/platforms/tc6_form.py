"""What a type or program unit declares, read from Structured Text by a scanner that shares nothing with the parser."""

import re
from dataclasses import dataclass
from functools import lru_cache

_TOKEN = re.compile(
    r"""\(\*.*?\*\) | '(?:\$.|[^'$])*' | "(?:\$.|[^"$])*" | \.\. | := |
        (?:[^\s\[\](),;:'".(=]|\.(?!\.))+ | [\[\](),;:=]""",
    re.VERBOSE | re.DOTALL,
)


@dataclass(frozen=True)
class Row:
    """A declaration: section with its qualifiers, name, type and initial value as tokens, comment."""

    section: str
    name: str
    type: str
    initial: str = ""
    comment: str = ""


@dataclass(frozen=True)
class Unit:
    """One type (kind TYPE) or program unit; `returns` of a function. `head` and comments have single blanks."""

    kind: str
    name: str
    returns: str
    head: str
    rows: tuple[Row, ...]
    body: str


@dataclass(frozen=True)
class _Token:
    text: str
    end: int
    first: bool


def single(text: str) -> str:
    """A text with single blanks."""
    return " ".join(text.split())


@lru_cache(1024)  # many libraries hold the same blocks
def scanned(text: str) -> Unit:
    """The one unit that a canonical text, or the declaration of one, holds."""
    tokens = [_Token(m[0], m.end(), not text[text.rfind("\n", 0, m.start()) + 1 : m.start()].strip())
              for m in _TOKEN.finditer(text)]  # fmt: skip
    head, kind = single(tokens[0].text[2:-2]), tokens[1].text
    if kind == "TYPE":
        return _type(head, tokens)
    returns = tokens[4].text if kind == "FUNCTION" else ""
    at, rows, end = 5 if returns else 3, list[Row](), 0
    while tokens[at : at + 1] and tokens[at].text.startswith("VAR"):
        section = [tokens[at].text]
        at += 1
        while tokens[at].text in ("CONSTANT", "RETAIN"):
            section.append(tokens[at].text)
            at += 1
        close = next(i for i in range(at, len(tokens)) if tokens[i].text == "END_VAR")
        rows += _rows(" ".join(section), tokens[at:close])
        at, end = close + 1, tokens[close].end
    body = text[end:].rsplit(f"END_{kind}", 1)[0].strip("\n")
    return Unit(kind, tokens[2].text, returns, head, tuple(rows), body)


def _type(head: str, tokens: list[_Token]) -> Unit:
    name, words = tokens[2].text, [each.text for each in tokens]
    if words[4] == "STRUCT":
        rows = _rows("STRUCT", tokens[5 : words.index("END_STRUCT")])
    else:
        rows = _rows("TYPE", tokens[2 : words.index("END_TYPE")])
        head = single(f"{head} {rows[0].comment}")
        rows = [Row("TYPE", name, rows[0].type, rows[0].initial)]
    return Unit("TYPE", name, "", head, tuple(rows), "")


def _rows(section: str, tokens: list[_Token]) -> list[Row]:
    """A comment on a line of its own belongs to the next declaration, another one to the last."""
    rows: list[Row] = []
    words: list[str] = []
    before: list[str] = []
    for token in tokens:
        if token.text.startswith("(*"):
            comment = single(token.text[2:-2])
            if token.first and not words:
                before.append(comment)
            else:
                rows[-1] = Row(section, *_parts(rows[-1]), single(f"{rows[-1].comment} {comment}"))
        elif token.text == ";":
            kind, _, initial = " ".join(words[2:]).partition(" := ")
            rows.append(Row(section, words[0], kind, initial, " ".join(before)))
            words, before = [], []
        else:
            words.append(token.text)
    assert not words, words
    assert not before, before
    return rows


def _parts(row: Row) -> tuple[str, str, str]:
    return row.name, row.type, row.initial
