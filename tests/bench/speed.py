"""How fast the front end is, in lines per second of processor time."""

from collections.abc import Callable
from time import process_time

from structured_text.language.checker import analyse
from structured_text.language.lexer import tokenize
from structured_text.language.lint import lint
from structured_text.language.parser import parse

Work = Callable[[], object]


def measure(text: str, rounds: int = 3) -> dict[str, float]:
    """The best of some rounds over one text: `lex` alone, `parse` with lexing, `check` of a parsed file, `lint`.

    Raises ParseError.
    """

    def parsed(work: Callable[..., object]) -> Work:
        unit = parse(text, "speed.st")  # anew each time: a tree is completed once only
        return lambda: work([unit])

    steps: dict[str, Callable[[], Work]] = {
        "lex": lambda: lambda: tokenize(text),
        "parse": lambda: lambda: parse(text, "speed.st"),
        "check": lambda: parsed(analyse),
        "lint": lambda: parsed(lint),
    }
    lines = text.count("\n")
    return {name: lines / max(min(_seconds(step()) for _ in range(rounds)), 1e-9) for name, step in steps.items()}


def _seconds(work: Work) -> float:
    """Processor time of one run."""
    start = process_time()
    work()
    return process_time() - start
