"""The embedded engine: ST compiled to Python in this process, with no tool but Python."""

from collections.abc import Callable, Sequence

from structured_text.engines.embedded.compiler import Compiler
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import BuildError, Message, Source
from structured_text.language.checker import check
from structured_text.language.parser import ParseError, parse
from structured_text.language.problems import Problem, SourceError
from structured_text.language.tree import Unit

# Turns of loops in one scan. A frame of 256 bytes needs hundreds; a scan of a million takes some 0.1 s here.
LOOP_LIMIT = 1_000_000
PARSED, CHECKED = 0.2, 0.3
"""The shares of a build after which its texts are parsed, and checked."""


class EmbeddedEngine:
    """Runs ST in this process.

    Where compilers could differ, such as an intermediate result that overflows its type, a scan raises ScanError.
    `loop_limit`: turns of loops that one scan may take (the look that ends a WHILE counts as one).
    `coverage`: count the lines that run. `strict`: a REAL that C would compute with doubles, to another value than
    single precision gives, is such a place too; else it is computed in single precision, as PLCs do.
    """

    name = "embedded"

    def __init__(self, *, loop_limit: int = LOOP_LIMIT, coverage: bool = False, strict: bool = True) -> None:
        """Choose."""
        self.coverage = coverage
        self.strict = strict
        self.loop_limit = loop_limit
        self.told: Callable[[float], None] = lambda _: None
        """Called during a build with the share that is done."""

    def build(self, sources: Sequence[Source]) -> EmbeddedLibrary:
        """Compile the sources as one text in the given order. Raises BuildError."""
        units = _parsed(sources, self.told)
        try:
            checked = check(units)
        except SourceError as error:
            raise BuildError([_message(each) for each in error.problems]) from error
        told, rest = self.told, 1 - CHECKED
        compiler = Compiler(checked, self.coverage, self.strict, lambda share: told(CHECKED + rest * share))
        if compiler.messages:
            raise BuildError(compiler.messages)
        return EmbeddedLibrary(compiler, self.loop_limit)


def _parsed(sources: Sequence[Source], told: Callable[[float], None]) -> list[Unit]:
    """Parse all sources, so that the errors of all are reported at once. Raises BuildError."""
    units: list[Unit] = []
    problems: list[Problem] = []
    for at, source in enumerate(sources):
        told(PARSED * at / len(sources))
        try:
            units.append(parse(source.text, source.path))
        except ParseError as error:
            problems += error.problems
    if problems:
        raise BuildError([_message(each) for each in problems])
    return units


def _message(problem: Problem) -> Message:
    return Message(problem.path, problem.line, problem.column, problem.text)
