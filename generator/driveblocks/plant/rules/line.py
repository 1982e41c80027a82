"""Rules on the lines: addresses, rates and formats that all drives have, and figures that hold."""

from collections.abc import Iterable, Mapping

from driveblocks.desk.site.asked import MOST_UNITS
from driveblocks.desk.site.line import Figures
from driveblocks.desk.site.report import complaints, mistaken
from driveblocks.maps.problem import Report
from driveblocks.maps.rivals import warning
from driveblocks.meaning.serial import serial
from driveblocks.plant import speech
from driveblocks.plant.model import Line, Meter, Motor, Plant

HIGHEST_UNIT = 247
MOST_WORDS, MOST_REGISTERS = 16, 0x10000
LONGEST_SCAN_MS, LONGEST_MS, LONGEST_POLL_MS = 1000, 60_000, 65534


def check(plant: Plant, report: Report) -> None:
    """Note what a line cannot be, without its figures."""
    _scan(plant, report)
    for name, line in plant.lines.items():
        _units(plant, name, report)
        if drives := plant.on(name):
            _spoken(line, drives, report)
    for meter in plant.meters.values():
        _meter(meter, report)


def _scan(plant: Plant, report: Report) -> None:
    if plant.scan_ms > LONGEST_SCAN_MS:
        report.add(plant.place("scan_ms"), f"`scan_ms: {plant.scan_ms}` is too long", "write at most 1000")
    if plant.longest_scan_ms < plant.scan_ms:
        wrong = f"`max_scan_ms: {plant.max_scan_ms}` is shorter than `scan_ms`, {plant.scan_ms}"
        report.add(plant.place("max_scan_ms"), wrong, "write the longest time between two scans")
    if plant.longest_scan_ms > LONGEST_MS:
        report.add(plant.place("max_scan_ms"), "this is too long for a scan", f"write at most {LONGEST_MS}")


def _units(plant: Plant, name: str, report: Report) -> None:
    """Addresses that two have, and more than a line takes."""
    units: list[Motor | Meter] = [*plant.on(name), *plant.meters_on(name)]
    first: dict[int, Motor | Meter] = {}
    for each in units:
        other = first.setdefault(each.unit, each)
        if other is not each:
            wrong = f"{other.name} has unit address {each.unit} on line {name}, too"
            free = next(unit for unit in range(1, HIGHEST_UNIT + 1) if unit not in {one.unit for one in units})
            report.add(each.place("unit"), wrong, f"write another, such as {free}; set it at the keypad, too")
    for each in units[MOST_UNITS:]:
        wrong = f"line {name} has {len(units)} units, and takes {MOST_UNITS}"
        report.add(each.name_at, wrong, "put it on a second line")


def _meter(meter: Meter, report: Report) -> None:
    if not 1 <= meter.unit <= HIGHEST_UNIT:
        report.add(meter.place("unit"), f"`unit: {meter.unit}` is out of range", f"write 1 to {HIGHEST_UNIT}")
    if not 1 <= meter.words <= MOST_WORDS:
        report.add(meter.place("words"), f"`words: {meter.words}` is out of range", f"write 1 to {MOST_WORDS}")
    if not 0 <= meter.address <= MOST_REGISTERS - max(1, meter.words):
        report.add(meter.place("address"), f"`address: {meter.address}` is out of range", "write 0000H to FFFFH")
    if meter.every_ms > LONGEST_POLL_MS:
        report.add(meter.place("every_ms"), "this is too long between two reads", f"write at most {LONGEST_POLL_MS}")


def _spoken(line: Line, drives: list[Motor], report: Report) -> None:
    """How the line is spoken on: what each drive has, and what all have."""
    way, maps = line.way, [each.map for each in drives]
    modes = speech.modes(maps)
    if not modes:
        report.add(line.name_at, f"the drives of line {line.name} have no framing in common", _apart(drives))
        return
    for each in drives:
        if way.mode not in serial(each.map).modes:
            wrong = f"{each.name} ({each.map.prefix}) speaks no {way.mode.upper()}"
            report.add(line.place("mode"), wrong, f"write `mode: {modes[0]}`")
    rates, forms = speech.delivered(maps)
    lists = {each.name: serial(each.map).rates for each in drives}
    written = str(line.rate or ""), line.form or ""
    _common(line, "rate", written[0], {name: [*map(str, sorted(has))] for name, has in lists.items()}, rates, report)
    has = {each.name: speech.forms(each.map, way.mode) for each in drives}
    _common(line, "form", written[1], has, forms, report)


def _common(  # noqa: PLR0913, PLR0917 - a key, what it is, and what each drive has
    line: Line,
    key: str,
    written: str,
    has: Mapping[str, Iterable[str]],
    usual: Iterable[object],
    report: Report,
) -> None:
    """Note a rate or format that a drive does not have; where none is written, that they are delivered differently."""
    lists = {name: list(each) for name, each in has.items() if each}
    common = [each for each in next(iter(lists.values()), []) if all(each in one for one in lists.values())]
    quoted = [f'"{each}"' if "E" in each else each for each in common]
    right = f"write one of {', '.join(quoted)}"
    if lists and not common:
        said = "; ".join(f"{name} has {', '.join(each)}" for name, each in lists.items())
        report.add(line.name_at, f"no {_WORD[key]} suits all drives of line {line.name}: {said}", _SPLIT)
    elif written:
        for name in [name for name, each in lists.items() if written not in each]:
            report.add(line.place(key), f"{name} has no {_WORD[key]} {written}", right)
    elif len(known := sorted(map(str, usual))) > 1:
        wrong = f"the drives of line {line.name} are delivered with {' and '.join(known)}"
        report.add(line.name_at, wrong, f"add `{key}`; {right}" if common else f"add `{key}`")
    elif lists and known[0] not in common:
        wrong = f"line {line.name} has no `{key}`, and {known[0]} does not suit all of its drives"
        report.add(line.name_at, wrong, f"add `{key}`; {right}")


_WORD = {"rate": "bit rate", "form": "format"}
_SPLIT = "put them on two lines"


def _apart(drives: Iterable[Motor]) -> str:
    said = "; ".join(f"{each.name} has {', '.join(serial(each.map).modes)}" for each in drives)
    return f"put them on two lines: {said}"


def hold(plant: Plant, figures: Figures, report: Report) -> None:
    """Note which figures of a line do not hold, each at its drive; margin is what a stop takes beside the ramp."""
    for each, ages in complaints(figures).items():
        for age in ages:
            motor = plant.drives[age.unit.name]
            place = motor.place("watchdog_ms") if "watchdog" in each.what else motor.name_at
            report.add(place, f"{each.what} of {motor.name} {each.said}", f"what helps: {each.helps}")
    for age in figures.ages:
        drive = plant.drives.get(age.unit.name)
        if drive and drive.ramp_down_s is not None:
            _in_time(drive, figures.worst + 2 * age.promised.read, report)


def _in_time(motor: Motor, beside: int, report: Report) -> None:
    """Note a stop that is overdue while the motor still ramps down: the frame, the ramp, and the proof."""
    least = int(1000 * (motor.ramp_down_s or 0)) + beside
    if motor.stop_within_ms < least:
        wrong = f"a stop of {motor.name} takes its ramp and up to {beside} ms on the line"
        report.add(motor.place("stop_within_ms"), wrong, f"write at least {least}")


def mixed(plant: Plant, name: str, figures: Figures, warnings: Report) -> None:
    """Warn of makes whose stop does harm at another of the line."""
    for pair in mistaken(figures.line):
        right = "check the addresses, and `driveblocks line` says more"
        warnings.add(plant.lines[name].name_at, f"line {name}: {warning(pair).rstrip('.')}", right)
