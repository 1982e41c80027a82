"""How late a plant is, as `driveblocks line` computes it, and what a cut cable does."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from driveblocks.desk.site.line import Figures, figures
from driveblocks.maps.model import Drive
from driveblocks.meaning import conduct
from driveblocks.meaning.setting import setting
from driveblocks.meaning.watchdog import watchdog
from driveblocks.plant import line
from driveblocks.plant.model import Motor, Plant

DOES = {
    "stop": "ramps down", "quick_stop": "stops quickly", "coast_stop": "coasts", "trips": "trips",
    "other_speed": "changes to another speed",
}  # fmt: skip
"""What a watchdog may do, of the motor; that it runs on is what must not be set."""


@dataclass(frozen=True)
class Cut:
    """What becomes of a motor when the cable of its line is cut."""

    motor: Motor
    by_itself: str
    contact: str
    """The hard stop that opens."""
    after_ms: int
    """... at most, where no drive of the line answers any more."""
    stops: bool
    """By the map and the plant, its own watchdog stops it, as the keypad sheet says."""


def lines(plant: Plant) -> dict[str, Figures]:
    """The figures of each line with drives, at its own rate, by its name. Raises Refused."""
    made = line.lines(plant, [each for each in plant.lines if plant.on(each)])
    return {name: figures(one, one.rate) for name, one in made.items()}


def cuts(plant: Plant, found: Mapping[str, Figures]) -> Iterator[Cut]:
    """What a cut cable does, drive by drive."""
    for each in plant.drives.values():
        contact = next(stop.name for stop in plant.hard_stops.values() if each.name in stop.drives)
        says = by_itself(each)
        yield Cut(each, says or conduct.delivered(each.map), contact, found[each.line].cut, bool(says))


def by_itself(motor: Motor) -> str:
    """What its own watchdog does, once it is set as the plant says; empty where nothing may be counted on."""
    own, ms = watchdog(motor.map), motor.values.get("WatchdogMs")
    if own is None or not ms:
        return ""
    chosen = setting(motor.map, own.chosen_by)
    does = list(dict.fromkeys(DOES[what] for _, what in own.reactions if what in DOES))
    by = f", as {chosen.keypad.code} is set" if chosen and len(does) > 1 else ""
    return f"{_either(does) or 'stops'} after {float(ms) / 1000:g} s of silence{by}"


def _either(words: list[str]) -> str:
    *most, last = words or [""]
    return f"{', '.join(most)} or {last}" if most else last


def never(drive: Drive) -> str:
    """What must not be set, since the motor would run on."""
    own = watchdog(drive)
    chosen = setting(drive, own.chosen_by) if own else None
    on = [value for value, what in own.reactions if what == "runs_on" and value is not None] if own else []
    return f"{chosen.keypad.code} is never {' or '.join(map(chosen.said_of, on))}" if chosen and on else ""
