"""The folder for the electrician: lines, terminals, keypads, hard stops, the order of the work, what a fault means.

One page of Markdown, the same as HTML for paper, and the figures; all of them from the plant file and its maps.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from driveblocks.desk.site.line import Figures
from driveblocks.docs import chain, keypad, sto
from driveblocks.docs.timing import proves_while_tripped
from driveblocks.maps.model import Drive
from driveblocks.maps.view import title
from driveblocks.meaning.advice import advice
from driveblocks.meaning.plug import plug
from driveblocks.meaning.reference import reference
from driveblocks.meaning.setting import Setting, in_order
from driveblocks.plant import drawing, figures, paper
from driveblocks.plant.model import Group, Line, Motor, Plant
from driveblocks.plant.rules.memory import needed
from driveblocks.render.environment import render
from driveblocks.render.reasons import REASONS

NAME, FIGURES = "electrician", "figures"
ASIDE = re.compile(r"\[([^\]]*)\]\([^)]*\)")
RAMPS = (("accel", "ramp_up_s"), ("decel", "ramp_down_s"))
"""How makers begin the name of a ramp, and what the plant file says of it; the first of a map is that of the bus."""
LAMPS = {
    "running": ("{} runs", "nothing"),
    "fault": ("{} has a fault, or does not answer", "find its `Reason` or `FaultCode` on the panel, then look below"),
    "ready": ("{} can be started", "nothing; while it is dark, `Reason` says why"),
    "stopped": ("standstill is proved of {}; for the process, never for guards", "nothing"),
}  # fmt: skip


@dataclass(frozen=True)
class Row:
    """A cable, as the drawing and the table of its line have it."""

    name: str
    text: str
    what: str
    unit: int | None
    drive: Drive | None = None


def files(plant: Plant) -> dict[str, str]:
    """Name -> text of each file of the folder. Raises Refused."""
    found = figures.lines(plant)
    numbers = render("docs/Figures.md.j2", **_numbers(plant, found))
    pictures = dict(_pictures(plant))
    page = render("docs/Electrician.md.j2", **_electrician(plant), figures=_without_head(numbers))
    return {
        f"{NAME}.md": page,
        f"{NAME}.html": paper.page(plant.plant, page, pictures),
        f"{FIGURES}.md": numbers,
        **pictures,
    }


def _without_head(text: str) -> str:
    """A page as a part of another one, its headings one deeper."""
    return re.sub("(?m)^## ", "### ", text.partition("\n")[2].strip())


def _numbers(plant: Plant, found: Mapping[str, Figures]) -> dict[str, Any]:
    return {
        "plant": plant,
        "found": found,
        "memory": [round(each / 1000) for each in needed(plant, [each.line for each in found.values()])],
        "cuts": list(figures.cuts(plant, found)),
    }


def _electrician(plant: Plant) -> dict[str, Any]:
    maps = {each.map.prefix: each.map for each in plant.drives.values()}
    return {
        "plant": plant,
        "lines": [(line, list(units(plant, line))) for line in plant.lines.values()],
        "plug": plug,
        "title": title,
        "sheets": [(each, plant.lines[each.line].way, settings(plant, each)) for each in drives(plant)],
        "never": figures.never,
        "families": [(title(one), [_advised(each) for each in advice(one)]) for one in maps.values()],
        "reasons": [(each.code, each.en, ASIDE.sub(r"\1", each.remedy)) for each in REASONS],
        "lamps": list(_lamps(plant)),
        "stops": list(_stops(plant)),
        "alone": [each.name for each in plant.drives.values() if not proves_while_tripped(each.map)],
        "blank": keypad.BLANK,
    }


def drives(plant: Plant) -> Iterator[Motor]:
    """The drives line by line, in the order of their cables."""
    for line in plant.lines:
        yield from plant.on(line)


# ------------------------------------------------------------ lines


def units(plant: Plant, line: Line) -> Iterator[Row]:
    """What is on a line, from its first end to its last: the PLC, the drives, the meters."""
    yield Row("PLC", f"port {line.port}", "its port", None)
    for each in plant.on(line.name):
        yield Row(each.name, each.title, title(each.map), each.unit, each.map)
    for meter in plant.meters_on(line.name):
        yield Row(meter.name, meter.title, "meter", meter.unit)


def _pictures(plant: Plant) -> Iterator[tuple[str, str]]:
    for line in plant.lines.values():
        drawn = [_drawn(each) for each in units(plant, line)]
        yield f"line_{line.name}.svg", drawing.picture(f"Line {line.name}", drawn)
    yield "hard_stop.svg", chain.picture("the contact of a hard stop")
    yield "sto.svg", sto.picture()


def _drawn(row: Row) -> drawing.Unit:
    name = row.name if row.text == row.name else f"{row.name}: {row.text}"
    says = row.what if row.unit is None else f"unit address {row.unit}, {row.drive.prefix if row.drive else row.what}"
    if row.drive is None:
        return drawing.Unit(name, says, ("see its manual",) * 3)
    own = plug(row.drive)
    return drawing.Unit(name, says, (own.at("positive"), own.at("negative"), own.at("common")))


# ------------------------------------------------------------ keypads


def settings(plant: Plant, motor: Motor) -> dict[str, list[keypad.Row]]:
    """Title of a group -> the settings of one drive, filled in. Raises ValueError where the drive cannot be so."""
    way = plant.lines[motor.line].way
    silence = motor.values.get("WatchdogMs")
    wanted = keypad.wanted(motor.map, motor.unit, way.rate, way.form, silence / 1000 if silence else None, way.mode)
    found = keypad.rows(motor.map, wanted)
    ramps = {id_: f"**{seconds:g} s**" for id_, seconds in _ramps(motor)}
    return {name: [_filled(motor, each, ramps) for each in rows] for name, rows in found.items()}


def _ramps(motor: Motor) -> Iterator[tuple[str, float]]:
    own = [each for each in in_order(motor.map) if each.adjusted and each.keypad.unit == "s"]
    for begins, key in RAMPS:
        first = next((each for each in own if each.name.lower().startswith(begins)), None)
        seconds = getattr(motor, key)
        if first is not None and seconds is not None:
            yield first.id, float(seconds)


def _filled(motor: Motor, row: keypad.Row, ramps: Mapping[str, str]) -> keypad.Row:
    """A row with what the plant file says of it, beside address, rate, format and watchdog."""
    one, run = row.setting, motor.map.operation
    if one.id in ramps:
        return replace(row, set_to=ramps[one.id])
    if one.id == run.reference.maximum and reference(motor.map).percent:
        return replace(row, set_to=f"**{motor.full_scale_hz or motor.maximum_hz:f} Hz**")
    if motor.mode == "speed" and one.needed and one.needed.by_terminals is not None:
        return replace(row, set_to=f"**{one.said_of(one.needed.by_terminals)}**", wire=_wire(one))
    return row


def _wire(one: Setting) -> str:
    return str(one.needed.by_terminals) if one.needed else ""


# ------------------------------------------------------------ what means what


def _advised(one: Any) -> tuple[str, ...]:
    shown = f"{one.keypad} ({one.code})" if one.keypad else str(one.code)
    helps = "; ".join(one.remedies) or one.note or "see the drive's own manual"
    return shown, one.name, "; ".join(one.causes), helps, one.clears


def _members(plant: Plant, name: str) -> str:
    return ", ".join(each.name for each in plant.members(name))


def _lamps(plant: Plant) -> Iterator[tuple[str, str, str]]:
    for one in plant.lamps.values():
        says, helps = LAMPS[one.shows]
        group = plant.groups.get(one.of)
        whom = f"{_which(one.shows, group)}{_members(plant, one.of)}"
        yield one.title, says.format(whom), helps


def _which(shows: str, group: Group | None) -> str:
    return "" if group is None else "each of " if shows == "stopped" else "one of "


def _stops(plant: Plant) -> Iterator[tuple[str, str, str]]:
    """What stops whom, and how."""
    for button in plant.buttons.values():
        if button.does == "stop":
            yield button.title, _members(plant, button.of), "over the line, as the drive is set; it may fail"
        elif button.does == "stop_all":
            yield button.title, ", ".join(plant.drives), "over the lines, one after the other; it may fail"
    for contact in plant.hard_stops.values():
        named, late = (
            ", ".join(contact.drives),
            "opens the same circuit where a stop is overdue; a reset closes it again",
        )
        yield f"hard stop {contact.title}", named, "power or STO, by wire: the one that always stops"
        yield f"contact of {contact.title} (PLC)", named, late
    for each in plant.drives.values():
        says = figures.by_itself(each)
        yield f"watchdog of {each.name}", each.name if says else "nobody", says or "not set, or nothing is known of it"
    yield "PLC in STOP or without power", "nobody by the line", "as a cut cable: only watchdogs and hard stops act"
