"""A line of a plant as it is wired: its units one below the other in their order, with their terminals."""

from collections.abc import Sequence
from dataclasses import dataclass

from driveblocks.docs.canvas import Canvas

WIDTH, BOX, WIDE, HIGH, GAP, TOP = 364, 90, 266, 100, 22, 74
WIRES = (("+", 20, "go"), ("-", 38, "line"), ("C", 56, "dashed"))
"""Wire, where its trunk is, and how it is drawn; as in the picture of a line."""
FIRST, STEP = 54, 17
"""Where in its box the first terminal is, and the next ones."""
MOST = 38
"""Characters of a terminal; the table beside the drawing has all of them."""


@dataclass(frozen=True)
class Unit:
    """A box: what it is, and its terminals for +, - and the common; empty where nobody says."""

    title: str
    says: str
    terminals: tuple[str, str, str]


def picture(title: str, units: Sequence[Unit]) -> str:
    """The line from its first unit to its last one, terminated at both."""
    canvas = Canvas(title, WIDTH, TOP + len(units) * (HIGH + GAP) + 64)
    last = TOP + (len(units) - 1) * (HIGH + GAP)
    for (wire, x, kind), end in zip(WIRES, (34, 34, 0), strict=True):
        at = FIRST + STEP * [one for one, *_ in WIRES].index(wire)
        canvas.path([(x, TOP - end if end else TOP + at), (x, last + (HIGH + end if end else at))], kind)
    for at, one in enumerate(units):
        _box(canvas, TOP + at * (HIGH + GAP), one)
    for y, word in ((TOP - 34, "begins"), (last + HIGH + 34, "ends")):
        _termination(canvas, y, f"120 ohm: the line {word} here")
    canvas.text(8, 20, "A chain from unit to unit: no branches.", "small")
    canvas.text(8, canvas.height - 8, "C: common. Shield: earth at each cabinet.", "small")
    return canvas.svg()


def _box(canvas: Canvas, y: float, one: Unit) -> None:
    canvas.box(BOX, y, WIDE, HIGH)
    canvas.text(BOX + 10, y + 19, one.title[:MOST], "head")
    canvas.text(BOX + 10, y + 35, one.says, "small")
    for at, ((wire, x, kind), terminal) in enumerate(zip(WIRES, one.terminals, strict=True)):
        here = y + FIRST + STEP * at
        canvas.path([(x, here), (BOX, here)], kind)
        canvas.box(x - 2, here - 2, 4, 4, "rail")
        short = terminal if len(terminal) <= MOST else f"{terminal[: MOST - 3]}..."
        canvas.text(BOX + 8, here + 4, wire, "mono")
        canvas.text(BOX + 24, here + 4, short or "______", "small")


def _termination(canvas: Canvas, y: float, words: str) -> None:
    """A resistor between the two wires, at an end of them."""
    (_, left, _), (_, right, _), _ = WIRES
    canvas.path([(left, y), (right, y)])
    canvas.box(left + 4, y - 4, right - left - 8, 8)
    canvas.text(right + 12, y + 4, words, "small")
