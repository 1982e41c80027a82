"""What is wrong with a source, and the errors that carry it."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Problem:
    """One thing that is wrong: 1-based line and column, what it is and what would be right; `rule` names the kind."""

    path: str
    line: int
    column: int
    text: str
    rule: str = "syntax"

    def __str__(self) -> str:
        """Print as compilers do, `file:line:col: text`."""
        return f"{self.path}:{self.line}:{self.column}: {self.text}"


class SourceError(Exception):
    """Sources that cannot be used; `problems` holds everything that was found, in order of place."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(str(each) for each in self.problems))


class CheckError(SourceError):
    """The text parses, but names, types or calls are wrong."""
