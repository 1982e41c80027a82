"""How late a plant is: the figures of its lines, as `driveblocks line` computes them, its memory, and a cut cable."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from driveblocks.desk.run import source
from driveblocks.desk.site import asked
from driveblocks.desk.site.line import Figures, figures
from driveblocks.maps.collection import Source
from driveblocks.maps.model import Drive
from driveblocks.meaning import conduct
from driveblocks.meaning.setting import setting
from driveblocks.meaning.watchdog import watchdog
from driveblocks.plant.model import Motor, Plant
from driveblocks.platforms import cost

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


@dataclass(frozen=True)
class Memory:
    """What the program takes in a PLC: bytes of data, and KiB of code from ... to."""

    data: int
    code: tuple[int, int]
    families: tuple[str, ...]


def maps(plant: Plant) -> list[Source]:
    """The maps of its drives, each once."""
    return [Source(path, drive) for path, drive in {each.path: each.map for each in plant.drives.values()}.items()]


def lines(plant: Plant, text: str) -> dict[str, Figures]:
    """The figures of each line with drives, at its own rate, by its name; `text` is the plant's program.

    Raises Refused where that does not compile.
    """
    found = asked.of_text(f"{plant.program}.st", text, maps(plant), plant.scan_ms)
    by_drive = {unit.name.upper(): line for line in found.values() for unit in line.units}
    own = {name: by_drive[plant.on(name)[0].name.upper()] for name in plant.lines if plant.on(name)}
    return {name: figures(line, line.rate) for name, line in own.items()}


def memory(plant: Plant, text: str) -> Memory:
    """What its program takes. Raises BuildError."""
    loaded = source.load(f"{plant.program}.st", text, maps(plant))
    families = tuple(dict.fromkeys(each.map.prefix for each in plant.drives.values()))
    least, most = (cost.CODE_KIB[""] + len(families) * each for each in cost.FAMILY_KIB)
    return Memory(cost.data(loaded.program), (least, most), families)


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
    return f"{' or '.join(does) or 'stops'} after {float(ms) / 1000:g} s of silence{by}"


def never(drive: Drive) -> str:
    """What must not be set, since the motor would run on."""
    own = watchdog(drive)
    chosen = setting(drive, own.chosen_by) if own else None
    on = [value for value, what in own.reactions if what == "runs_on" and value is not None] if own else []
    return f"{chosen.keypad.code} is never {' or '.join(map(chosen.said_of, on))}" if chosen and on else ""
