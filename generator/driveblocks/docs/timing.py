"""What a drive block does in a start, a stop and a reset, column by column, and the picture of it.

A test runs each block against a simulated drive and compares what it does with these columns.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from operator import itemgetter

from driveblocks.docs.canvas import Canvas
from driveblocks.maps.model import Drive
from driveblocks.meaning.status import status
from driveblocks.meaning.words import words
from driveblocks.render.reasons import STATES

Speed = tuple[float, float]
"""Output frequency at the beginning and at the end of a column, as a share of the reference."""


@dataclass(frozen=True)
class Column:
    """A span of time in which the pins of the block stay as they are."""

    state: int
    sends: tuple[str, ...] = ()
    """What the block asks the line to send meanwhile."""
    run: bool = False
    reset: bool = False
    fault: bool = False
    running: bool = False
    at_speed: bool = False
    confirmed: bool = False
    speed: Speed = (0.0, 0.0)
    shaft: Speed | None = None
    """The same of the shaft, where it is not the output's."""
    event: str = ""
    """What a person or the drive does at its beginning."""


STOPPED = Column(1, confirmed=True)
STARTING = (
    Column(2, ("reference",), run=True, event="start"),
    Column(3, ("run",), run=True),
    Column(4, run=True),
    Column(4, ("refresh",), run=True, running=True, speed=(0.0, 1.0)),
    Column(4, ("refresh",), run=True, running=True, at_speed=True, speed=(1.0, 1.0)),
)


def start_and_stop() -> tuple[Column, ...]:
    seen = Column(0, ("stop",), running=True, at_speed=True, speed=(1.0, 0.8), event="stop")
    ramp = Column(0, ("stop",), running=True, speed=(0.8, 0.0))
    return (Column(0, ("stop",), event="power-up"), STOPPED, *STARTING, seen, ramp, STOPPED)


def fault_and_reset(drive: Drive) -> tuple[Column, ...]:
    """A trip while it runs, then the reset: by the bus, or at the drive where the bus cannot."""
    proved = proves_while_tripped(drive)
    tripped = Column(0, ("stop",), run=True, fault=True, event="trip", shaft=(1.0, 0.3))
    stands = (replace(STOPPED, run=True, fault=True),) if proved else ()
    released = replace(STOPPED, fault=True) if proved else Column(0, ("stop",), fault=True)
    begin = (STARTING[-1], tripped, *stands, replace(released, event="release"))
    begin = (*begin[:2], replace(begin[2], shaft=(0.3, 0.0)), *begin[3:])
    if "fault_reset" not in words(drive).named:
        return (*begin, replace(STOPPED, event="reset by other means"))
    asked = Column(0, ("stop", "reset"), fault=True, reset=True, event="reset")
    if proved:  # so the reset waits for that
        told = replace(STOPPED, sends=("reset",), fault=True, reset=True)
        begin = (*begin, replace(asked, sends=("stop",)), told)
        asked = Column(1, fault=True, reset=True)
    return (*begin, asked, Column(0, ("stop",), reset=True), replace(STOPPED, reset=True))


def proves_while_tripped(drive: Drive) -> bool:
    """Whether words can show a fault and prove standstill at once."""
    proof = status(drive).standstill.patterns
    return any(not any(fault.excludes(each) for each in proof) for fault in status(drive).shows("fault"))


WIDTH, LEFT, ROW, TOP, GAP, HIGH = 1120, 150, 32, 44, 60, 16
SIGNALS = {
    "RunForward": "run", "FaultReset": "reset", "Fault": "fault", "Running": "running", "AtSpeed": "at_speed",
    "StopConfirmed": "confirmed",
}  # fmt: skip
"""Pin of the block -> field of a column."""
TALL = ROW * (len(SIGNALS) + 5)


def picture(drive: Drive, name: str) -> str:
    parts = [("Power-up, start and stop", start_and_stop()), ("A fault, and its reset", fault_and_reset(drive))]
    canvas = Canvas(f"{name}: start, stop and reset", WIDTH, TOP + len(parts) * (TALL + GAP) - 10)
    for number, (title, columns) in enumerate(parts):
        _panel(canvas, TOP + number * (TALL + GAP), title, columns)
    canvas.text(
        16,
        canvas.height - 14,
        "Not to scale: a column lasts until something changes, or a read shows it. After a trip the shaft may coast.",
        "small",
    )
    return canvas.svg()


def _panel(canvas: Canvas, top: float, title: str, columns: tuple[Column, ...]) -> None:
    wide = (WIDTH - LEFT - 16) / len(columns)
    edges = [LEFT + wide * number for number in range(len(columns) + 1)]
    canvas.text(16, top - 14, title, "head")
    for x in edges:
        canvas.path([(x, top), (x, top + TALL - 6)], "thin")
    _words(canvas, top, "event", [each.event for each in columns], edges)
    _words(canvas, top + ROW, "sends", [", ".join(each.sends) for each in columns], edges)
    _words(canvas, top + 2 * ROW, "State", [STATES[each.state][0] for each in columns], edges)
    for row, (name, key) in enumerate(SIGNALS.items(), 3):
        canvas.text(LEFT - 10, top + ROW * row + 18, name, "mono", "end")
        shares = [(float(getattr(each, key)),) * 2 for each in columns]
        canvas.path(list(_curve(shares, edges, top + ROW * row + 22)), "stop" if key == "fault" else "line")
    for name, base, curve in (
        ("OutputFrequencyHz", top + TALL - 10 - ROW, [each.speed for each in columns]),
        ("motor shaft", top + TALL - 10, [each.shaft or each.speed for each in columns]),
    ):
        canvas.text(LEFT - 10, base - 4, name, "mono", "end")
        canvas.path(list(_curve(curve, edges, base)), "go")


def _words(canvas: Canvas, top: float, name: str, words: list[str], edges: list[float]) -> None:
    """A row of words, each in a band over all columns in a row that have it."""
    canvas.text(LEFT - 10, top + 18, name, "mono", "end")
    for word, spans in groupby(zip(words, pairwise(edges), strict=True), key=itemgetter(0)):
        ends = [edge for _, span in spans for edge in span]
        left, right = ends[0], ends[-1]
        if word:
            canvas.box(left + 2, top + 4, right - left - 4, 20, "band")
            canvas.text((left + right) / 2, top + 18, word, "small", "middle")


def _curve(shares: Iterable[Speed], edges: list[float], base: float) -> Iterator[tuple[float, float]]:
    for (begin, end), (left, right) in zip(shares, pairwise(edges), strict=True):
        yield left, base - HIGH * begin
        yield right, base - HIGH * end
