"""The tags of a plant: what a panel and the inputs and outputs have to do with its program, and its alarms."""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from driveblocks.plant import program
from driveblocks.plant.model import Motor, Plant
from driveblocks.render.reasons import REASONS
from driveblocks.render.results import RESULTS
from driveblocks.render.text import ENGLISH, Language, led

HEADS = ("name", "type", "unit", "range", "text")
ALARM = "alarm"
"""The type of a row that says what a number of a tag means."""
FIRST_ALARM = 10
"""Reasons below are no trouble."""
STATUS = (
    ("Ready", "BOOL", "", "can be started"), ("Running", "BOOL", "", "runs"), ("Fault", "BOOL", "", "has a fault"),
    ("CommOk", "BOOL", "", "answers"), ("StopConfirmed", "BOOL", "", "its standstill is proved; never for guards"),
    ("StopOverdue", "BOOL", "", "its stop is late, or not proved"), ("Warning", "BOOL", "", "shows a warning"),
    ("OutputFrequencyHz", "REAL", "Hz", "output frequency"), ("OutputCurrentA", "REAL", "A", "output current"),
    ("Reason", "UINT", "", "why it does not run"), ("FaultCode", "UINT", "", "its fault"),
    ("ErrorID", "UINT", "", "its error"),
)  # fmt: skip
"""Pins of a drive block that a panel shows."""


@dataclass(frozen=True)
class Tag:
    """A row: a variable of the program, by its path in it; of an alarm, a number that it may have."""

    name: str
    type: str
    unit: str = ""
    range: str = ""
    texts: tuple[str, ...] = ("",)
    """English, then the second language, if there is one."""


def tags(plant: Plant, second: Language | None = None) -> Iterator[Tag]:
    """All of them: commands, buttons and inputs, lamps and contacts, drives, groups, meters, then alarms."""
    yield from _commands(plant)
    yield from _outputs(plant)
    for each in plant.drives.values():
        yield from _drive(each)
    yield from _others(plant)
    for each in plant.drives.values():
        yield from _alarms(each, second)


def table(plant: Plant, second: Language | None = None) -> str:
    """The tags as CSV (RFC 4180), with a mark by which a spreadsheet knows UTF-8; a second language has its column."""
    made = io.StringIO()
    rows = csv.writer(made, lineterminator="\r\n")
    rows.writerow([*HEADS, *([f"text {second.suffix.lower()}"] if second else [])])
    for each in tags(plant, second):
        texts = each.texts if second is None or len(each.texts) > 1 else (*each.texts, each.texts[0])
        rows.writerow([each.name, each.type, each.unit, each.range, *texts])
    return "\ufeff" + made.getvalue()


def _commands(plant: Plant) -> Iterator[Tag]:
    yield Tag("Hmi_StopAll", "BOOL", texts=("panel: TRUE stops everything",))
    yield Tag("Hmi_Reset", "BOOL", texts=("panel: rising closes the contacts of the hard stops, resets faults",))
    for name, each in program.commanded(plant).items():
        yield Tag(f"{name}_Start", "BOOL", texts=(f"panel: rising starts {each.title}",))
        yield Tag(f"{name}_Stop", "BOOL", texts=(f"panel: TRUE stops {each.title}",))
    for each in plant.drives.values():
        if plant.group_of(each.name):
            yield Tag(f"{each.name}_Off", "BOOL", texts=(f"panel: TRUE takes {each.title} out of service",))
        if each.speed is None and each.mode != "monitor":
            yield Tag(f"{each.name}_Hertz", "REAL", "Hz", f"0..{each.maximum_hz}", (f"panel: speed of {each.title}",))
    for button in plant.buttons.values():
        does = {"start": "starts", "stop": "FALSE stops", "reset": "resets", "stop_all": "FALSE stops everything"}
        what = f"{does[button.does]} {button.of}".strip()
        yield Tag(button.name, "BOOL", texts=(f"input, {button.title}: {what}",))
    for stop in plant.hard_stops.values():
        yield Tag(f"{stop.name}_Closed", "BOOL", texts=(f"input: {stop.title} is closed",))
    for name, one in plant.inputs.items():
        yield Tag(name, "INT", "", f"{one.raw[0]}..{one.raw[1]}", (f"analog input: {one.title}",))


def _outputs(plant: Plant) -> Iterator[Tag]:
    for stop in plant.hard_stops.values():
        yield Tag(f"{stop.name}_Ok", "BOOL", texts=(f"output: contact in series with {stop.title}",))
    for lamp in plant.lamps.values():
        yield Tag(lamp.name, "BOOL", texts=(f"output, {lamp.title}: {lamp.of} {lamp.shows}",))
    for name, one in plant.inputs.items():
        ends = f"{one.range[0]}..{one.range[1]}"
        yield Tag(f"{name}_Scale.Value", "REAL", one.unit, ends, (one.title,))
        yield Tag(f"{name}_Scale.Broken", "BOOL", texts=(f"{one.title}: broken wire; what depends on it is stopped",))


def _drive(each: Motor) -> Iterator[Tag]:
    for pin, kind, unit, says in STATUS:
        top = f"0..{each.maximum_hz}" if unit == "Hz" else ""
        yield Tag(f"{each.name}.{pin}", kind, unit, top, (f"{each.title}: {says}",))
    yield Tag(f"{each.name}_Hours.Hours", "REAL", "h", "", (f"{each.title}: time that it has run",))
    yield Tag(f"{each.name}_Counted.Starts", "UDINT", "", "", (f"{each.title}: starts",))


def _others(plant: Plant) -> Iterator[Tag]:
    for each in plant.groups.values():
        pins = {"Running": "one runs", "Ready": "can be started", "Fault": "one has a fault, or does not answer"}
        pins |= {"Stopped": "all stand; never for guards", "Ended": "the command has ended: start again"}
        if each.kind == "duty_standby":
            pins |= {"Waiting": "no standby yet: a standstill is not proved", "Short": "fewer run than are to"}
        for pin, says in pins.items():
            yield Tag(f"{each.name}.{pin}", "BOOL", texts=(f"{each.title}: {says}",))
        yield Tag(f"{each.name}.RunCount", "UINT", "", f"0..{len(each.drives)}", (f"{each.title}: how many run",))
    for meter in plant.meters.values():
        yield Tag(f"{meter.name}.Valid", "BOOL", texts=(f"{meter.title}: its words are fresh",))
        for number in range(meter.words):
            unit = meter.unit_text or ""
            yield Tag(f"{meter.name}_Words[{number}]", "WORD", unit, "", (f"{meter.title}: register {number}",))
    for name in plant.lines:
        yield Tag(f"{name}.StopOverdue", "BOOL", texts=(f"line {name}: a stop is late, or not proved",))
        yield Tag(f"{name}.ErrorID", "UINT", texts=(f"line {name}: its error",))


def _alarms(each: Motor, second: Language | None) -> Iterator[Tag]:
    """What the numbers of a drive mean."""
    for one in REASONS:
        if one.code >= FIRST_ALARM:
            yield _alarm(each, "Reason", one.code, (one.en, one.zh), second)
    for fault in each.map.faults.codes:
        if fault.code:
            said = [led(fault, language.pick(fault)) for language in (ENGLISH, second or ENGLISH)]
            yield _alarm(each, "FaultCode", fault.code, said, second)
    for result in RESULTS:
        if result.code:
            yield _alarm(each, "ErrorID", result.code, (result.en, result.zh), second)


def _alarm(each: Motor, pin: str, code: int, texts: Iterable[str], second: Language | None) -> Tag:
    said = [f"{each.title}: {one}" for one in texts]
    return Tag(f"{each.name}.{pin}", ALARM, "", str(code), tuple(said if second else said[:1]))
