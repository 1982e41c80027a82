"""The standard function blocks (IEC 61131-3 clause 2.5.2.3): bistables, edges, counters, timers.

Where the standard and matiec disagree, a block raises FaultError.
"""

from collections.abc import Callable
from typing import Any

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.faults import FaultError
from structured_text.engines.embedded.shapes import Record
from structured_text.language.standard import BLOCKS
from structured_text.language.tree import Block
from structured_text.language.types import Elementary

Body = Callable[[Any], None]

_IDLE, _RUNNING, _DONE = 0, 1, 2
# The slots after the parameters, with their initial values; they are no variables of ST.
_EDGE = {"memory": False}
_COUNT = {"memory_up": False, "memory_down": False}
_TIMER = {"state": _IDLE, "previous": False, "start": 0}
_CLOCK = {"previous": False, "offset": 0}
_INNER: dict[str, dict[str, Any]] = {
    "R_TRIG": _EDGE, "F_TRIG": {"memory": None}, "SEMA": {"memory": False}, "TP": _TIMER, "TON": _TIMER,
    "TOF": _TIMER, "RTC": _CLOCK,
}  # fmt: skip


class Run:
    """What all compiled ST of one build shares while it runs: the clock and the turns of loops that are left."""

    __slots__ = ("budget", "now")

    def __init__(self) -> None:
        """Start the clock, in nanoseconds, at 0."""
        self.now = 0
        self.budget: Any = iter(())


def inner_slots(block: Block) -> dict[str, Any]:
    """The hidden slots of a standard block."""
    return _INNER.get(block.name, _COUNT if block.name.startswith("CT") else {})


def classes() -> dict[Block, type[Record]]:
    """One class per standard block."""
    return {
        each: type(each.name, (Record,), {"__slots__": (*each.parameters, *inner_slots(each))})
        for each in BLOCKS.values()
    }


def bodies(run: Run) -> dict[str, Body]:
    """The body of every standard block by upper-case name."""
    table: dict[str, Body] = {"SR": _sr, "RS": _rs, "R_TRIG": _r_trig, "F_TRIG": _f_trig, "SEMA": _sema}
    table |= {**_timers(run), "RTC": _rtc(run)}
    for name, block in BLOCKS.items():
        if name.startswith("CT"):
            table[name] = _counter(name, block)
    return table


# ------------------------------------------------------------ bistables, semaphore, edges


def _sr(s: Any) -> None:
    s.Q1 = s.S1 or (not s.R and s.Q1)


def _rs(s: Any) -> None:
    s.Q1 = not s.R1 and (s.S or s.Q1)


def _r_trig(s: Any) -> None:
    s.Q = s.CLK and not s.memory
    s.memory = s.CLK


def _f_trig(s: Any) -> None:
    """By the standard's text Q is TRUE on a first call with CLK FALSE; other compilers differ. FaultError."""
    if s.memory is None and not s.CLK:
        raise FaultError("compilers disagree on F_TRIG called with CLK FALSE at first: use R_TRIG of the negation")
    s.Q = not s.CLK and not s.memory
    s.memory = not s.CLK


def _sema(_: Any) -> None:
    raise FaultError("SEMA grants at once on matiec and one call later by the standard: use a bistable")


# ------------------------------------------------------------ counters


def _counter(name: str, block: Block) -> Body:
    kind = known(block.parameters["CV"].type, Elementary)
    up, down = _up(kind), _down(kind)
    if name.startswith("CTUD"):
        return _up_down(up, down)
    return _count_up(up) if name.startswith("CTU") else _count_down(down)


def _up(kind: Elementary) -> Callable[[Any], None]:
    """Count up to PV; the standard counts to the end of the type, matiec does not. FaultError."""

    def count(s: Any) -> None:
        if s.CV < s.PV:
            s.CV += 1
        elif kind.high > s.CV:
            raise FaultError("a counter at PV counts on by the standard and stops on matiec: reset it first")

    return count


def _down(kind: Elementary) -> Callable[[Any], None]:
    """Count down to zero; the standard counts to the end of the type, matiec does not. FaultError."""

    def count(s: Any) -> None:
        if s.CV > 0:
            s.CV -= 1
        elif kind.low < s.CV:
            raise FaultError("a counter at zero counts on by the standard and stops on matiec: load it first")

    return count


def _count_up(up: Callable[[Any], None]) -> Body:
    def body(s: Any) -> None:
        edge, s.memory_up = s.CU and not s.memory_up, s.CU
        if s.R:
            s.CV = 0
        elif edge:
            up(s)
        s.Q = s.CV >= s.PV

    return body


def _count_down(down: Callable[[Any], None]) -> Body:
    def body(s: Any) -> None:
        edge, s.memory_down = s.CD and not s.memory_down, s.CD
        if s.LD:
            s.CV = s.PV
        elif edge:
            down(s)
        s.Q = s.CV <= 0

    return body


def _up_down(up: Callable[[Any], None], down: Callable[[Any], None]) -> Body:
    def body(s: Any) -> None:
        edge_up, s.memory_up = s.CU and not s.memory_up, s.CU
        edge_down, s.memory_down = s.CD and not s.memory_down, s.CD
        if s.R:
            s.CV = 0
        elif s.LD:
            s.CV = s.PV
        elif edge_up != edge_down:
            (up if edge_up else down)(s)
        s.QU = s.CV >= s.PV
        s.QD = s.CV <= 0

    return body


# ------------------------------------------------------------ timers


def _timers(run: Run) -> dict[str, Body]:
    """TP, TON and TOF. A timer is started by one call, and can only run out in a later one."""

    def start(s: Any) -> None:
        if s.PT <= 0:
            raise FaultError("a timer with PT of zero runs out at once by the standard, one call later on matiec")
        s.state, s.start = _RUNNING, run.now

    def go_on(s: Any) -> bool:
        """Bring ET up to now; whether the time has just run out."""
        if s.start + s.PT <= run.now:
            s.state, s.ET = _DONE, s.PT
            return True
        s.ET = run.now - s.start
        return False

    def reset(s: Any) -> None:
        s.state, s.ET = _IDLE, 0

    return {"TP": _tp(start, go_on, reset), "TON": _ton(start, go_on, reset), "TOF": _tof(start, go_on, reset)}


def _tp(start: Body, go_on: Callable[[Any], bool], reset: Body) -> Body:
    def body(s: Any) -> None:
        if s.state == _IDLE and s.IN and not s.previous:
            start(s)
            s.Q = True
        elif s.state == _RUNNING and go_on(s):
            s.Q = False
        if s.state == _DONE and not s.IN:
            reset(s)
        s.previous = s.IN

    return body


def _ton(start: Body, go_on: Callable[[Any], bool], reset: Body) -> Body:
    def body(s: Any) -> None:
        if not s.IN:
            reset(s)
            s.Q = False
        elif s.state == _IDLE and not s.previous:
            start(s)
            s.Q = False
        elif s.state == _RUNNING and go_on(s):
            s.Q = True
        s.previous = s.IN

    return body


def _tof(start: Body, go_on: Callable[[Any], bool], reset: Body) -> Body:
    def body(s: Any) -> None:
        if s.IN:
            reset(s)
        elif s.state == _IDLE and s.previous:
            start(s)
        elif s.state == _RUNNING:
            go_on(s)
        s.Q = s.IN or s.state == _RUNNING
        s.previous = s.IN

    return body


def _rtc(run: Run) -> Body:
    """The clock of the engine, or from the rising edge of IN on, what PDT said plus the time since."""

    def body(s: Any) -> None:
        if s.IN and not s.previous:
            s.offset = s.PDT - run.now
        s.CDT = run.now + s.offset if s.IN else run.now
        s.Q = s.previous = s.IN

    return body
