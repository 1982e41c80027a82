"""The states of a drive block, as `VFD_Control` has them, and what leads from one to the other."""

from driveblocks.docs.canvas import Canvas
from driveblocks.render.reasons import STATES

WIDTH, HEIGHT, W, H = 760, 560, 180, 58
PLACES = {0: (70, 60), 1: (70, 240), 2: (470, 240), 3: (470, 350), 4: (470, 460), 5: (70, 380), 6: (70, 470)}
SAYS = {
    0: "stop sent; again every 500 ms",
    1: "StopConfirmed",
    2: "waits for its reply",
    3: "waits for its replies",
    4: "reference sent again",
    5: "MonitorOnly",
    6: "SpeedOnly",
}


def picture() -> str:
    """The state diagram; it is the same for every family."""
    canvas = Canvas("States of a drive block", WIDTH, HEIGHT)
    for state, (x, y) in PLACES.items():
        canvas.box(x, y, W, H)
        canvas.text(x + W / 2, y + 25, f"{state}  {STATES[state][0]}", "head", "middle")
        canvas.text(x + W / 2, y + 44, SAYS[state], "small", "middle")
    _starts(canvas)
    _stops(canvas)
    _others(canvas)
    return canvas.svg()


def _starts(canvas: Canvas) -> None:
    canvas.arrow([(110, 20), (110, 60)])
    canvas.text(120, 34, "power-up, Restart, a scan over RestartMs, new Address", "small")
    canvas.arrow([(110, 118), (110, 240)], "go")
    _note(canvas, 118, 170, "stop acknowledged,", "standstill read", "after it")
    canvas.arrow([(250, 269), (470, 269)], "go")
    _note(canvas, 262, 246, "Ready, and a run or jog", "pin rises")
    canvas.arrow([(560, 298), (560, 350)], "go")
    canvas.text(568, 328, "reference acknowledged", "small")
    canvas.arrow([(560, 408), (560, 460)], "go")
    canvas.text(568, 438, "every write acknowledged", "small")


def _stops(canvas: Canvas) -> None:
    """From 2, 3 and 4 back to 0 by one line, from 1 by another."""
    for y in (269, 379, 489):
        canvas.path([(650, y), (730, y)], "stop")
    canvas.arrow([(730, 489), (730, 89), (250, 89)], "stop")
    for row, words in enumerate(
        (
            "its pin FALSE, another pin TRUE, Enable FALSE, QuickStop, CoastStop, StopAll,",
            "fault, no reply, SupplyOff TRUE, bad reference, MonitorOnly, SpeedOnly,",
            "not acknowledged, refused, does not run within FollowWithinMs,",
            "stops or changes direction by itself, another master (at a start), block not called",
        )
    ):
        canvas.text(722, 106 + 15 * row, words, "small", "end")
    canvas.arrow([(238, 240), (238, 118)], "stop")
    _note(canvas, 245, 190, "a stop pin or fault, no reply,", "the motor moves by itself")


def _others(canvas: Canvas) -> None:
    canvas.arrow([(110, 298), (110, 380)])
    canvas.text(118, 346, "MonitorOnly", "small")
    canvas.path([(220, 298), (220, 340), (290, 340), (290, 499)])
    canvas.arrow([(290, 499), (250, 499)])
    canvas.text(298, 420, "SpeedOnly", "small")
    canvas.path([(70, 409), (30, 409)], "stop")
    canvas.path([(70, 499), (30, 499)], "stop")
    canvas.arrow([(30, 499), (30, 89), (70, 89)], "stop")
    canvas.text(38, 458, "its pin FALSE", "small")
    canvas.text(
        70,
        546,
        "Blue leads to motion, red to a stop. With SpeedOnly a power-up leads to 6 once its stop is answered.",
        "small",
    )


def _note(canvas: Canvas, x: float, y: float, *lines: str) -> None:
    for row, words in enumerate(lines):
        canvas.text(x, y + 15 * row, words, "small")
