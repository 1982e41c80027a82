"""A fixed sample of the matrix, small enough for the suite."""

from dataclasses import replace

from tests.second import pairs
from tests.second.events import AIMED, EVENTS, LONG
from tests.second.matrix import JOGS, MODES, STATES, Cell, row_of
from tests.second.pf4 import VARIANTS
from tests.second.profiles import FAMILIES as PROFILES
from tests.second.station import MIXED, NEWER

SIZE = 120
"""Cells of the sample."""
ONE_STATE = {
    "the motor turns round": "at speed", "a write without permission and one with it": "standstill",
    "parameters without an answer": "standstill", "parameters of several words": "standstill",
    "references of others never rest": "standstill", "all others trip": "at speed",
    "its highest address": "standstill", "a trip and a held reset": "at speed", "all but one are dead": "at speed",
    "another address for a dead drive": "at speed", "one fault after another": "at speed",
    "a run of more than a minute": "at speed", "scans of a millisecond": "at speed",
    "weaker and weaker stops": "at speed",
    "replies lost": "at speed", "replies cut short": "at speed", "noise before replies": "at speed",
    "a slow port": "at speed", "a stop while it is busy": "at speed", "a stop is refused": "at speed",
    "it is busy in its ramp": "at speed",
}  # fmt: skip
"""Aimed events that mean nothing else in the other state."""


SHORT_MS = 6000
MORE = (
    ("full control", "keypad start", "standstill"), ("full control", "it ignores runs", "standstill"),
    ("full control", "a reset", "tripped"), ("full control", "a dead drive", "standstill"),
    ("full control", "Enable falls", "standstill"), ("full control", "nothing", "local"),
    ("full control", "nothing", "at speed"), ("jog", "the pin falls and rises", "at speed"),
    ("MonitorOnly", "a trip", "at speed"), ("MonitorOnly", "nothing", "at speed"),
    ("SpeedOnly", "nothing", "at speed"), ("SpeedOnly", "StopAll pulse", "at speed"),
)  # fmt: skip
"""Where else an event shows what it shows in no other state."""


def least() -> list[tuple[Cell, int]]:
    """The least cell of each short event: a drive by words or by a path of states, alone on its line."""
    events = [name for name, event in EVENTS.items() if event.lasts <= SHORT_MS and name not in LONG]
    found = [Cell(("CHF", "ATV312")[at % 2], "full control", event, "at speed") for at, event in enumerate(events)]
    found += [Cell("CHF", *each) for each in MORE]
    return [(cell, _quick(cell)) for cell in found]


def _quick(cell: Cell) -> int:
    """The first seed without a second event of a short line in usual scans."""
    rows = ((seed, row_of(cell, seed)) for seed in range(0, 200, 2))
    return next(seed for seed, row in rows if row["size"] == 1 and row["ms"] == 20)


def aimed() -> list[tuple[Cell, int]]:
    """Cells of events that look at one rule each, for every family; seeds without a second event."""
    found = [
        (Cell(family, "full control", event, state), seed)
        for event in AIMED
        for family in MIXED
        for state, seed in (("standstill", 0), ("at speed", 2))
    ]
    found = [each for each in found if ONE_STATE.get(each[0].event, each[0].state) == each[0].state]
    found += [(Cell(family, "full control", "a trip", "at speed"), 2) for family in MIXED]
    found.append((Cell("PF4", "full control", "a trip", "standstill"), 4))  # one whose stop does not reset its fault
    found.append((Cell("CHF", "jog", "a stop while it is busy", "at speed"), 0))  # 5 does not end this one's jog
    found.append((Cell("CHF", "jog", "a stop is refused", "at speed"), 0))  # nor this one's
    found.append((Cell("JSCC", "full control", "a dead drive", "at speed"), 0))  # beside others that live
    found.append((Cell("CHF", "full control", "SpeedOnly", "at speed"), 0))  # the bus still runs it
    return [*found, *varied(found)]


def varied(found: list[tuple[Cell, int]]) -> list[tuple[Cell, int]]:
    """The cells of the PowerFlex 4, each for one of its variants; of SN300G5 and JSCC, each for a newer family."""
    return [
        (replace(cell, family=others[at % len(others)]), seed)
        for family, others in (("PF4", VARIANTS), ("SN300G5", NEWER), ("JSCC", PROFILES))
        for at, (cell, seed) in enumerate(each for each in found if each[0].family == family)
    ]


def sample() -> list[tuple[Cell, int]]:
    """Cells with their seeds: all pairs of family, mode, event and state; every second seed has a second event."""
    options = {"event": list(EVENTS), "state": STATES, "mode": MODES, "family": MIXED}
    rows = pairs.rows(options)
    step = max(1, len(rows) // SIZE)
    found = [
        (Cell(row["family"] if row["mode"] != "jog" else JOGS[0], row["mode"], row["event"], row["state"]), index % 4)
        for index, row in enumerate(rows[::step][:SIZE])
    ]
    return [*found, *varied(found)]
