"""The one text that iec2c compiles, made of several sources, and the way back from its lines."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from typing import ClassVar

from structured_text.engines.engine import Message, Source


class Listing:
    """Sources one after the other; `text` is what iec2c gets, `place` leads a line back to its source.

    `starts`: the line (1-based) of the text on which each source begins.
    """

    # The file that iec2c reads, as its messages and the C's #line directives name it.
    NAME: ClassVar[str] = "source.st"

    def __init__(self, sources: Sequence[Source]) -> None:
        """Join the sources in the given order; each starts on a line of its own."""
        self.sources = tuple(sources)
        self.starts: list[int] = []
        parts = []
        line = 1
        for source in sources:
            part = source.text if source.text.endswith("\n") else source.text + "\n"
            self.starts.append(line)
            parts.append(part)
            line += part.count("\n")
        self.text = "".join(parts)

    def place(self, line: int) -> tuple[str, int]:
        """Path and line of a line (1-based) of the joined text; a line after the end belongs to the last source."""
        if not self.sources:
            return self.NAME, line
        index = max(bisect_right(self.starts, line) - 1, 0)
        return self.sources[index].path, line - self.starts[index] + 1

    def locate(self, messages: Iterable[Message]) -> list[Message]:
        """Lead messages about the joined text back to their sources; others stay as they are."""
        return [
            Message(*self.place(each.line), each.column, each.text) if each.path == self.NAME else each
            for each in messages
        ]
