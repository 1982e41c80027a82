"""Rules on what refers to what: lines, inputs, groups, buttons, lamps and hard stops."""

from collections.abc import Collection, Iterator

from driveblocks.maps.decode import nearest
from driveblocks.maps.problem import Place, Report
from driveblocks.plant.model import DOES, SHOWS, Button, Gathered, Group, Lamp, Plant
from driveblocks.plant.rules.name import unwritten

COUNTS = range(-32768, 32768)
"""Of an analog input: an INT of the PLC."""
MOST_MEMBERS = 16
"""Drives of a group: those that VFD_Members holds."""


def check(plant: Plant, report: Report) -> None:
    """Note every name that names nothing, and what does not go together."""
    if not plant.drives:
        report.miss(plant.at, "the plant has no drive", "write one below `drives:`")
    _lines(plant, report)
    _inputs(plant, report)
    _groups(plant, report)
    _hard_stops(plant, report)
    for button in plant.buttons.values():
        _button(plant, button, report)
    for lamp in plant.lamps.values():
        _lamp(plant, lamp, report)


def known(name: str, names: Collection[str], what: str, at: Place, report: Report) -> bool:
    """Whether a name is one of these; else it is noted."""
    if name not in names:
        near = nearest(name, list(names))
        right = (
            f"did you mean `{near}`?"
            if near
            else f"write one of {', '.join(sorted(names))}"
            if names
            else f"add the {what}"
        )
        report.add(at, f"there is no {what} `{name}`", right)
    return name in names


def _lines(plant: Plant, report: Report) -> None:
    at = [(each.line, each.place("line")) for each in plant.drives.values()]
    at += [(each.line, each.place("line")) for each in plant.meters.values()]
    for line, place in at:
        known(line, plant.written["lines"], "line", place, report)
    ports: dict[str, str] = {}
    for name, one in plant.lines.items():
        first = ports.setdefault(one.port.lower(), name)
        if first != name:
            report.add(one.place("port"), f"line {first} has this port, too", "give each line a port of its own")
        if not plant.on(name):
            report.miss(one.name_at, f"line {name} has no drive", "name it at a drive as `line`, or leave it out")


def _inputs(plant: Plant, report: Report) -> None:
    for name, each in plant.inputs.items():
        for key, pair in (("raw", each.raw), ("range", each.range)):
            if len(pair) != 2:
                report.add(each.place(key), f"`{key}` of {name} has {len(pair)} numbers", "write both ends, [0, 50]")
            elif pair[0] == pair[1]:
                report.add(each.place(key), f"`{key}` of {name} is empty: both ends are {pair[0]}", "write two numbers")
        if len(each.range) == 2 and each.range[0] > each.range[1]:
            wrong = f"`range` of {name} begins with its high end"
            report.add(each.place("range"), wrong, "write the low end first, and turn `raw` round, too")
        if any(count not in COUNTS for count in each.raw):
            wrong = f"`raw` of {name} does not fit an INT"
            report.add(each.place("raw"), wrong, f"write {COUNTS[0]} to {COUNTS[-1]}")
        _speed(plant, name, report)


def _speed(plant: Plant, name: str, report: Report) -> None:
    """An input that is a speed."""
    each, used = plant.inputs[name], [one.name for one in plant.drives.values() if one.speed == name]
    if used and each.unit != "Hz":
        report.add(each.place("unit"), f"{name} is the speed of {', '.join(used)} in {each.unit}", "write Hz")
    if used and len(each.range) == 2 and each.range[0] < 0:
        wrong = f"{name} is the speed of {', '.join(used)}, and begins below 0"
        report.add(each.place("range"), wrong, "begin it at 0: a negative speed stops the motor")


def _groups(plant: Plant, report: Report) -> None:
    taken: dict[str, str] = {}
    for group in plant.groups.values():
        for drive in _named(plant, group, report):
            first = taken.setdefault(drive, group.name)
            if first != group.name:
                report.add(group.drive_at(drive), f"{drive} is in group {first}, too", "leave it in one of them")
            elif drive in plant.drives and plant.drives[drive].mode != "full":
                wrong = f"{drive} is in group {group.name}, and `mode: {plant.drives[drive].mode}` starts nothing"
                report.add(group.drive_at(drive), wrong, "write `mode: full`, or take it out of the group")
        _kind(group, report)


def _named(plant: Plant, one: Gathered, report: Report) -> Iterator[str]:
    """The drives of a group or a hard stop that are there, each once."""
    for at, drive in enumerate(one.drives):
        if drive in one.drives[:at]:
            report.add(one.place("drives"), f"{drive} is named twice in {one.name}", "name it once")
        elif known(drive, plant.written["drives"], "drive", one.drive_at(drive), report):
            yield drive
    if not one.drives:
        report.add(one.place("drives"), f"{one.name} names no drive", "write its drives, as [P1, P2]")


def _kind(group: Group, report: Report) -> None:
    """What goes with the kind of a group."""
    for key, kind in (("duty", "duty_standby"), ("change", "duty_standby"), ("delay_ms", "sequence")):
        if getattr(group, key) is not None and group.kind != kind:
            wrong = f"`{key}` is for `kind: {kind}`, and {group.name} is `{group.kind}`"
            report.add(group.place(key), wrong, "leave it out, or change the kind")
    most, duty = len(group.drives), group.duty or 1
    if most > MOST_MEMBERS:
        wrong = f"group {group.name} has {most} drives, and {MOST_MEMBERS} are possible"
        report.add(group.place("drives"), wrong, "make two groups of it")
    if group.kind == "duty_standby" and duty >= most > 0:
        wrong = f"{duty} of the {most} drives of {group.name} are to run, and none stands by"
        report.add(group.place("duty"), wrong, f"write 1 to {most - 1}" if most > 1 else "add a drive to the group")
    if (group.delay_ms or 0) > 60_000:
        report.add(group.place("delay_ms"), f"`delay_ms: {group.delay_ms}` is too long", "write at most 60000")


def _hard_stops(plant: Plant, report: Report) -> None:
    taken: dict[str, str] = {}
    for one in plant.hard_stops.values():
        for drive in one.drives if unwritten(one) else _named(plant, one, report):
            first = taken.setdefault(drive, one.name)
            if first != one.name:
                report.add(one.drive_at(drive), f"{drive} is in hard stop {first}, too", "leave it in one of them")
    for name in plant.drives.keys() - taken.keys():
        report.miss(plant.drives[name].name_at, f"{name} is in no hard stop", "add it to one of `hard_stops`")


def _button(plant: Plant, button: Button, report: Report) -> None:
    told = [key for key in DOES if key in button.keys]
    if len(told) != 1:
        wrong = f"{button.name} does {', '.join(told) or 'nothing'}"
        report.add(button.at, wrong, f"write one of {', '.join(DOES)}")
        return
    key, of = told[0], getattr(button, told[0])
    if key == "stop_all" or of is None or not _target(plant, of, button.place(key), report):
        return
    if key == "start" and of in plant.drives:
        mode, group = plant.drives[of].mode, plant.group_of(of)
        if mode != "full":
            wrong = f"{button.name} starts {of}, and `mode: {mode}` starts nothing"
            report.add(button.place(key), wrong, "write `mode: full` at the drive, or leave the button out")
        elif group:
            wrong = f"{button.name} starts {of}, which is of group {group.name}"
            report.add(button.place(key), wrong, f"write `start: {group.name}`, or take the drive out of the group")


def _lamp(plant: Plant, lamp: Lamp, report: Report) -> None:
    told = [key for key in SHOWS if key in lamp.keys]
    if len(told) != 1:
        wrong = f"{lamp.name} shows {', '.join(told) or 'nothing'}"
        report.add(lamp.at, wrong, f"write one of {', '.join(SHOWS)}")
    elif getattr(lamp, told[0]) is not None:
        _target(plant, lamp.of, lamp.place(told[0]), report)


def _target(plant: Plant, name: str, at: Place, report: Report) -> bool:
    return known(name, plant.written["drives"] | plant.written["groups"], "drive or group", at, report)
