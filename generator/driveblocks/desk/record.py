"""What variables did over a run: a trace as CSV, and a timing picture as SVG. Memory and file grow by changes alone."""

import re
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from html import escape

from structured_text.engines.engine import Value

MOST_CHANGES = 20_000
"""Changes of one variable that a picture holds; older ones are forgotten."""

TRACE = rb"# (SIMULATED|REAL PORT), [^\n]*\nms,"
"""How a trace begins."""
_MARK = "<!-- a picture of driveblocks run -->"
PICTURE = rb"<svg [^>]*>\n" + re.escape(_MARK.encode())
"""How a picture begins."""

_LEFT, _PLOT, _RIGHT, _LANE, _HIGH, _TOP = 200, 770, 30, 44, 26, 34
_CHARACTER, _NUMBER = 8, 60
"""Room for a character of a name, and for the number beside it."""


class Trace:
    """A CSV file: a row for every scan in which something changed; its first line says whose port it was."""

    def __init__(self, write: Callable[[str], object], names: Sequence[str], port: str) -> None:
        self._write = write
        self._last: list[str] | None = None
        write(f"# {port}\n")
        write(",".join(["ms", *names]) + "\n")

    def add(self, at_us: int, values: Mapping[str, Value]) -> None:
        row = [_written(value) for value in values.values()]
        if row != self._last:
            self._last = row
            self._write(",".join([f"{at_us / 1000:g}", *row]) + "\n")


def _written(value: Value) -> str:
    if isinstance(value, bool):
        return str(int(value))
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Timing:
    """A timing diagram: a lane for each variable."""

    def __init__(self, names: Sequence[str], port: str, most: int = MOST_CHANGES) -> None:
        self._port = port
        self._changes: dict[str, deque[tuple[int, float]]] = {name: deque(maxlen=most) for name in names}
        self._left = max(_LEFT, max(map(len, names), default=0) * _CHARACTER + _NUMBER)
        self._end_us = 1

    def add(self, at_us: int, values: Mapping[str, Value]) -> None:
        self._end_us = max(1, at_us)
        for name, value in values.items():
            number = float(value) if isinstance(value, int | float) else 0.0
            changes = self._changes[name]
            if not changes or changes[-1][1] != number:
                changes.append((at_us, number))

    def svg(self) -> str:
        width, height = self._left + _PLOT + _RIGHT, _TOP + _LANE * len(self._changes) + 30
        parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
            'font-size="13" fill="#222">',
            _MARK,
            f'<rect width="{width}" height="{height}" fill="#fff"/>',
            f'<text x="10" y="20">{escape(self._port, quote=False)}</text>',
            *self._grid(height),
        ]
        for place, (name, changes) in enumerate(self._changes.items()):
            parts += self._lane(name, list(changes), _TOP + _LANE * place)
        return "\n".join([*parts, "</svg>", ""])

    def _x(self, at_us: int) -> float:
        return self._left + _PLOT * at_us / self._end_us

    def _grid(self, height: int) -> list[str]:
        steps = (digit * 10**power for power in range(4, 16) for digit in (1, 2, 5))
        step = next(each for each in steps if self._end_us / each <= 12)
        parts = []
        for at in range(0, self._end_us + 1, step):
            x = self._x(at)
            parts.append(f'<line stroke="#ddd" x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP}" y2="{height - 24}"/>')
            parts.append(f'<text x="{x:.1f}" y="{height - 8}" text-anchor="middle">{at / 1e6:g} s</text>')
        return parts

    def _lane(self, name: str, changes: list[tuple[int, float]], top: int) -> list[str]:
        values = [value for _, value in changes] or [0.0]
        low, high = min(0.0, *values), max(values)
        span = (high - low) or 1.0
        points, last = [], None
        for at, value in [*changes, (self._end_us, values[-1])]:
            y = top + 8 + _HIGH * (1 - (value - low) / span)
            if last is not None:
                points.append(f"{self._x(at):.1f},{last:.1f}")
            points.append(f"{self._x(at):.1f},{y:.1f}")
            last = y
        most = "" if high in (0.0, 1.0) else f"{high:g}"
        return [
            f'<text x="10" y="{top + 26}">{escape(name, quote=False)}</text>',
            f'<text x="{self._left - 6}" y="{top + 16}" text-anchor="end">{most}</text>',
            f'<polyline fill="none" stroke="#05c" stroke-width="1.5" points="{" ".join(points)}"/>',
        ]
