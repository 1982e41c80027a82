"""How fast the front end is, in lines per second of processor time."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from time import process_time

from driveblocks.st.checker import analyse
from driveblocks.st.lexer import tokenize
from driveblocks.st.lint import lint
from driveblocks.st.parser import parse
from driveblocks.st.tree import Configuration, Pou, TypeDecl


@dataclass(frozen=True, slots=True)
class Speed:
    """Lines per second: `lex` alone, `parse` with lexing, `check` of a parsed file, `lint` of one with its check."""

    lines: int
    lex: float
    parse: float
    check: float
    lint: float


def measure(text: str, rounds: int = 3) -> Speed:
    """The best of some rounds over one text, which must parse. Raises ParseError, ValueError for text without lines."""
    lines = text.count("\n")
    if not lines:
        raise ValueError("expected text of at least one line")

    def best(work: Callable[[], Callable[[], object]]) -> float:
        return lines / max(min(_seconds(work()) for _ in range(rounds)), 1e-9)

    return Speed(
        lines,
        lex=best(lambda: lambda: tokenize(text)),
        parse=best(lambda: lambda: parse(text, "speed.st")),
        check=best(lambda: _parsed(text, analyse)),
        lint=best(lambda: _parsed(text, lint)),
    )


def _parsed(text: str, work: Callable[..., object]) -> Callable[[], object]:
    """Work on a freshly parsed file; a tree is completed once only."""
    unit = parse(text, "speed.st")
    return lambda: work([unit])


def _seconds(work: Callable[[], object]) -> float:
    """Processor time of one run."""
    start = process_time()
    work()
    return process_time() - start


def multiplied(text: str, times: int) -> str:
    """A long text for measuring: every type, function, block and program of `text` so many times, as `Name_C1` ..."""
    kinds = TypeDecl | Pou | Configuration
    names = [each.name for each in parse(text, "speed.st").elements if isinstance(each, kinds)]
    copies = [text]
    for number in range(1, times):
        copy = text
        for name in names:
            copy = _renamed(copy, name, f"{name}_C{number}")
        copies.append(copy)
    return "\n".join(copies)


def _renamed(text: str, name: str, other: str) -> str:
    """Replace a whole word."""
    return re.sub(rf"\b{re.escape(name)}\b", other, text)
