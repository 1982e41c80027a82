"""What variables did over a run: a trace as CSV, which grows by changes alone."""

from collections.abc import Callable, Mapping, Sequence

from driveblocks.desk.seen import text
from structured_text.engines.engine import Value

TRACE = rb"# (SIMULATED|REAL PORT), [^\n]*\nms,"
"""How a trace begins."""


class Trace:
    """A CSV file: a row for every scan in which something changed; its first line says whose port it was."""

    def __init__(self, write: Callable[[str], object], names: Sequence[str], port: str) -> None:
        self._write, self._names = write, names
        self._last: list[str] | None = None
        write(f"# {port}\n")
        write(",".join(["ms", *names]) + "\n")

    def add(self, at_us: int, values: Mapping[str, Value]) -> None:
        row = [_written(values[name]) for name in self._names]
        if row != self._last:
            self._last = row
            self._write(",".join([f"{at_us / 1000:g}", *row]) + "\n")


def _written(value: Value) -> str:
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, bytes):
        return _quoted(text(value))
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _quoted(words: str) -> str:
    """A text as a cell, which may hold what parts cells and rows."""
    return '"' + words.replace('"', '""') + '"' if any(sign in words for sign in ',"\r\n') else words
