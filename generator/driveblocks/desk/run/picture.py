"""A run as a picture: speed and reference of each drive, its state and reason in words, and what happened when."""

import re
import textwrap
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby, pairwise
from string import ascii_letters
from typing import Generic, TypeVar

from driveblocks.desk.run.look import PINS, seen
from driveblocks.desk.seen import is_bad, spelled
from driveblocks.docs.canvas import Canvas, folding
from driveblocks.maps.model import Drive
from structured_text.engines.engine import Value

MOST_CHANGES = 20_000
"""Changes of one value that a picture holds; older ones are forgotten."""
MOST_MARKS = 60
_MARK = "<!-- a picture of driveblocks run -->"
HEAD = rb"<svg [^>]*>\n" + re.escape(_MARK.encode())
"""How a picture begins."""

WIDE, NARROW = 1120, 390
LEFTS, RIGHT = {WIDE: 150, NARROW: 48}, 14
CHART, BAND, LANE = 84, 22, 16
SMALL, MONO = 6.2, 7.3
"""Widths of a small character and of one of a name."""
TOGETHER_US = 200_000
"""What happened within this time has one mark."""
STROKE = 6
"""Corners within a pixel that are no longer drawn as they are."""
FOR_LABEL, LABEL = 80, 46
"""Between two times on the axis, and the room of a number beside a curve."""

Kept = TypeVar("Kept")
Mark = tuple[int, str]
"""What happened, and when in microseconds."""


class Changes(Generic[Kept]):
    """A value from each time at which it changed."""

    def __init__(self, most: int) -> None:
        self.all: deque[tuple[int, Kept]] = deque(maxlen=most)

    def add(self, at_us: int, value: Kept) -> None:
        if not self.all or self.all[-1][1] != value:
            self.all.append((at_us, value))

    def spans(self, end_us: int) -> Iterator[tuple[int, int, Kept]]:
        """Each value with its begin and its end."""
        for (at, value), (until, _) in pairwise([*self.all, (end_us, None)]):
            yield at, until, value  # type: ignore[misc]  # the last one is not paired


@dataclass
class Track:
    """What a drive was seen to do."""

    drive: Drive
    most: int
    most_hz: float = 1.0
    """Of the scale: its maximum, or what is above that."""

    def __post_init__(self) -> None:
        self.hertz = Changes[float | None](self.most)
        self.asked = Changes[float](self.most)
        self.states = Changes[str](self.most)
        self.reasons = Changes[tuple[int, str]](self.most)
        self._before: Mapping[str, Value] = {}

    def add(self, at_us: int, pin: Mapping[str, Value]) -> None:
        if pin == self._before:
            return
        self._before = pin
        now = seen("", self.drive, 0, pin)
        self.hertz.add(at_us, None if now.hertz is None else abs(now.hertz))
        self.asked.add(at_us, abs(now.asked_hz))
        self.states.add(at_us, now.state)
        code = pin["Reason"]
        self.reasons.add(at_us, (code if isinstance(code, int) else 0, now.why))
        self.most_hz = max(self.most_hz, now.most_hz, abs(now.hertz or 0.0))


class Timing:
    """Gathers a run, scan by scan, and draws it."""

    def __init__(self, drives: Mapping[str, Drive], names: Sequence[str], port: str, most: int = MOST_CHANGES) -> None:
        """`drives`: the map of each drive block by its path; `names`: variables that are drawn as well."""
        self.port = port
        self.tracks = {path: Track(drive, most) for path, drive in drives.items()}
        self.lanes = {name: Changes[Value](most) for name in names}
        self.end_us = 1

    @property
    def needs(self) -> Iterator[str]:
        """The names of all values that it has to be given."""
        yield from self.lanes
        yield from (f"{path}.{pin}" for path in self.tracks for pin in PINS)

    def add(self, at_us: int, values: Mapping[str, Value]) -> None:
        self.end_us = max(1, at_us)
        for path, track in self.tracks.items():
            track.add(at_us, {pin: values[f"{path}.{pin}"] for pin in PINS})
        for name, lane in self.lanes.items():
            lane.add(at_us, values[name])

    def svg(self, marks: Sequence[Mark] = ()) -> str:
        """The picture; `marks` are what happened."""
        text = folding(*(_Sheet(self, _together(marks), width).drawn() for width in (WIDE, NARROW)))
        return text.replace("\n", f"\n{_MARK}\n", 1)


@dataclass
class _Sheet:
    """A picture of a width, drawn from the top down."""

    timing: Timing
    marks: Sequence[Mark]
    width: int
    top: float = 28
    short: dict[str, str] = field(default_factory=dict)
    """What stands there as a number or a letter, since its words found no room."""

    def __post_init__(self) -> None:
        self.left = LEFTS[self.width]

    def drawn(self) -> Canvas:
        self.canvas = Canvas(f"{self.timing.port}: what the drives did", self.width, 0)
        self.canvas.text(12, self.top, self.timing.port, "head")
        self._legend()
        grid, begin = len(self.canvas.body), self.top
        for path, track in self.timing.tracks.items():
            self._drive(path, track)
        changing = {name: lane for name, lane in self.timing.lanes.items() if len(lane.all) > 1}
        for name, lane in changing.items():
            self._lane(name, lane)
        body, self.canvas.body = self.canvas.body, self.canvas.body[:grid]
        self._axis(begin)
        self.canvas.body += body[grid:]
        self._lists(sorted(self.timing.lanes.keys() - changing.keys()))
        self.canvas.height = round(self.top + 12)
        return self.canvas

    def _x(self, at_us: int) -> float:
        return self.left + (self.width - self.left - RIGHT) * at_us / self.timing.end_us

    def _legend(self) -> None:
        x = 12.0
        self.top += 22
        for kind, words in (("go", "speed"), ("dashed", "reference"), ("stop", "a stop begins")):
            self.canvas.path([(x, self.top - 4), (x + 20, self.top - 4)], kind)
            self.canvas.text(x + 26, self.top, words, "small")
            x += 40 + SMALL * len(words)
        self.top += 24

    # ------------------------------------------------------------ drives

    def _drive(self, path: str, track: Track) -> None:
        end = self.timing.end_us
        self.canvas.text(self.left, self.top + 12, path, "head")
        base = self.top + 20 + CHART
        for share in (0.0, 1.0):
            y = base - CHART * share
            self.canvas.path([(self.left, y), (self.width - RIGHT, y)], "thin")
            self.canvas.text(self.left - 6, y + 4, f"{track.most_hz * share:g}", "small", "end")
        self.canvas.text(self.left - 6, base - CHART / 2 + 4, "Hz", "small", "end")
        scale = CHART / track.most_hz
        self._curve(((*span[:2], base - scale * span[2]) for span in track.asked.spans(end)), "dashed")
        read = ((at, to, None if value is None else base - scale * value) for at, to, value in track.hertz.spans(end))
        self._curve(read, "go")
        for (_, before), (at, state) in pairwise(track.states.all):
            if state.endswith("stopping") and not before.endswith("stopping") and not is_bad(before):
                self.canvas.path([(self._x(at), base - CHART), (self._x(at), base)], "stop")
        self.top = base + 4
        self._bands("state", ((*span[:2], span[2], "", is_bad(span[2])) for span in track.states.spans(end)))
        self._bands("why", ((at, to, why, str(code), False) for at, to, (code, why) in track.reasons.spans(end)))
        self.top += 16

    def _curve(self, spans: Iterable[tuple[int, int, float | None]], kind: str) -> None:
        """Begin, end and height of what stays as it is so long; where it is not known there is no line."""
        for known, some in groupby(spans, lambda span: span[2] is not None):
            corners = [(round(self._x(at), 1), round(y or 0.0, 1)) for begin, end, y in some for at in (begin, end)]
            if known:
                self.canvas.path([point for _, each in groupby(corners, _column) for point in _stroke([*each])], kind)

    def _bands(self, name: str, spans: Iterable[tuple[int, int, str, str, bool]]) -> None:
        """Begin, end, words, the number of a reason, and whether it is bad, each in a band as long as it was so."""
        self.canvas.text(self.left - 6, self.top + 15, name, "small", "end")
        for at, until, words, short, bad in spans:
            x, wide = self._x(at), max(1.0, self._x(until) - self._x(at) - 1)
            told = f"{words}, {at / 1e6:.2f} to {until / 1e6:.2f} s"
            self.canvas.box(x, self.top + 1, wide, BAND - 3, "band", told)
            if bad:
                self.canvas.box(x, self.top + 1, min(4.0, wide), BAND - 3, "alarm")
            whole = SMALL * _columns(words) + 10 <= wide
            key = "" if whole or not name else short or self._letter(words)
            if whole or SMALL * len(key) + 4 <= wide:
                self.canvas.text(x + wide / 2, self.top + 14, words if whole else key, "small", "middle")
            if key:
                self.short[f"{name} {key}"] = words
        self.top += BAND

    def _letter(self, words: str) -> str:
        """What stands for words that find no room, at their first place and at all others."""
        known = [each for key, each in self.short.items() if key.startswith("state")]
        place = known.index(words) if words in known else len(known)
        return ascii_letters[place % len(ascii_letters)]

    # ------------------------------------------------------------ variables

    def _lane(self, name: str, lane: Changes[Value]) -> None:
        if MONO * len(name) <= self.left - LABEL:
            self.canvas.text(self.left - LABEL, self.top + LANE, name, "mono", "end")
        else:
            self.canvas.text(self.left, self.top + 10, name, "mono")
            self.top += 14
        spans, values = lane.spans(self.timing.end_us), [value for _, value in lane.all]
        numbers = [float(value) for value in values if isinstance(value, int | float)]
        if len(numbers) < len(values):
            self._bands("", ((at, until, spelled(value), "", False) for at, until, value in spans))
        else:
            low, high = min(0.0, *numbers), max(numbers)
            base, scale = self.top + LANE, (LANE - 2) / ((high - low) or 1.0)
            heights = zip(spans, numbers, strict=True)
            self._curve(((at, to, base - scale * (number - low)) for (at, to, _), number in heights), "line")
            if not isinstance(values[0], bool):
                self.canvas.text(self.left - 6, base - LANE + 7, f"{high:.5g}", "small", "end")
                self.canvas.text(self.left - 6, base + 3, f"{low:.5g}", "small", "end")
            self.top = base
        self.top += 12

    # ------------------------------------------------------------ time, and what is said below

    def _axis(self, begin: float) -> None:
        """Times, and what happened, behind everything else."""
        end = self.timing.end_us
        steps = (digit * 10**power for power in range(4, 16) for digit in (1, 2, 5))
        step = next(each for each in steps if end / each * FOR_LABEL <= self.width - self.left - RIGHT)
        for at in range(0, end + 1, step):
            self.canvas.path([(self._x(at), self.top - 4), (self._x(at), self.top + 2)], "line")
            self.canvas.text(self._x(at), self.top + 14, f"{at / 1e6:g} s", "small", "middle")
        free = 0.0
        for number, (at, _) in enumerate(self.marks, 1):
            x = self._x(at)
            self.canvas.path([(x, begin), (x, self.top - 4)], "thin")
            if x >= free:
                self.canvas.text(x, begin - 4, str(number), "small", "middle")
                free = x + SMALL * (len(str(number)) + 1)
        self.top += 36

    def _lists(self, still: Sequence[str]) -> None:
        """What happened, reasons that stand there as numbers, and what did not change."""
        rows = [f"{number}: at {at / 1e6:.1f} s {says}" for number, (at, says) in enumerate(self.marks, 1)]
        rows += [f"{key}: {words}" for key, words in sorted(self.short.items(), key=_order)]
        kept = (f"{name} = {spelled(self.timing.lanes[name].all[-1][1])}" for name in still)
        rows += [f"the same all the time: {', '.join(kept)}"] if still else []
        for row in rows:
            for line in textwrap.wrap(row, int((self.width - 24) / SMALL), subsequent_indent="    "):
                self.canvas.text(12, self.top, line, "small")
                self.top += 16


def _order(short: tuple[str, str]) -> tuple[str, int, str]:
    """Letters of states by the alphabet, then the numbers of reasons by their size."""
    key = short[0].partition(" ")[2]
    return short[0][0], len(key), key


def _column(corner: tuple[float, float]) -> int:
    return int(corner[0])


def _stroke(corners: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """What happens within a pixel: all of it, or where it begins, its lowest, its highest and where it ends."""
    if len(corners) < STROKE:
        return corners
    x, ys = corners[0][0], [y for _, y in corners]
    return [(x, y) for y in (ys[0], min(ys), max(ys), ys[-1])]


def _together(marks: Iterable[Mark]) -> list[Mark]:
    """What happened at about the same time as one; the last of those that are too many are left out."""
    made: list[Mark] = []
    for at, says in marks:
        if made and at - made[-1][0] < TOGETHER_US:
            made[-1] = made[-1][0], f"{made[-1][1]}; {says}"
        else:
            made.append((at, says))
    return made if len(made) <= MOST_MARKS else [*made[: MOST_MARKS - 1], made[-1]]


def _columns(text: str) -> float:
    """About how many small characters a text is wide."""
    return sum(2.0 if ord(sign) > 0x2E80 else 1.3 if sign.isupper() else 1.0 for sign in text)
