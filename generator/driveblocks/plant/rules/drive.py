"""Rules on a single drive: what its family can do, and what a start needs."""

from decimal import Decimal

from driveblocks.desk.run.drives import open_scales
from driveblocks.docs.keypad import no_time
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from driveblocks.maps.revision import checked
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.reference import Reference, reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.watchdog import watchdog
from driveblocks.meaning.words import words
from driveblocks.plant.model import Motor, Plant
from driveblocks.plant.rules.reference import known

LEAST_HZ, MOST_HZ = Decimal("0.1"), 10_000
"""Of `MaximumHz` and `FullScaleHz`."""
MOST_MS = 65534
"""65535 switches off what can be off."""
MOST_SCALE = 1_000_000
MOST_POLES = 100
OFF = 65535
MAY_BE_OFF = ("RefreshMs", "KeepWord")
REFERENCE, POLES = "ReferenceScale", "PolePairs"


def check(plant: Plant, report: Report) -> None:
    """Note what no drive block takes, and what one needs that nobody gives."""
    for each in plant.drives.values():
        _unit(each, report)
        _limits(each, report)
        _times(each, report)
        _speed(plant, each, report)
        _settings(each, report)
        _checked(each, report)


def unable(plant: Plant, warnings: Report) -> None:
    """Warn of buttons that reset no fault, since the line cannot: they close the contact of the hard stop alone."""
    for button in plant.buttons.values():
        name = button.reset
        if name is not None:
            drives = plant.members(name)
            if drives and not any(_resets(each.map) for each in drives):
                families = ", ".join(sorted({each.map.prefix for each in drives}))
                wrong = f"{button.name} resets no fault of {name}: {families} takes no reset over the line"
                warnings.add(button.place("reset"), wrong, "it closes the contact of the hard stop; reset at the drive")


def _resets(drive: Drive) -> bool:
    return any(each.does == "fault_reset" for each in words(drive).commands)


def _unit(motor: Motor, report: Report) -> None:
    line = serial(motor.map)
    if not line.lowest <= motor.unit <= line.highest or motor.unit == line.no_address:
        wrong = f"{motor.name} cannot have unit address {motor.unit}"
        report.add(motor.place("unit"), wrong, f"{motor.map.prefix} takes {line.lowest} to {line.highest}")


def _limits(motor: Motor, report: Report) -> None:
    """Maximum and full scale."""
    has, full = reference(motor.map), motor.full_scale_hz
    for key, value in (("maximum_hz", motor.maximum_hz), ("full_scale_hz", full)):
        if value is not None and not LEAST_HZ <= value <= MOST_HZ:
            report.add(motor.place(key), f"`{key}: {value}` is out of range", f"write {LEAST_HZ} to {MOST_HZ} Hz")
    if has.percent and full is None:
        wrong = f"{motor.name} has no `full_scale_hz`: the reference of {motor.map.prefix} is a part of it"
        report.add(motor.name_at, wrong, f"add it, as set in {has.maximum} of the drive, Hz")
    elif not has.percent and full is not None:
        wrong = f"the reference of {motor.map.prefix} is no part of a full scale"
        report.add(motor.place("full_scale_hz"), wrong, "leave `full_scale_hz` out")
    elif full is not None and motor.maximum_hz > full:
        wrong = f"`maximum_hz` of {motor.name} is above its `full_scale_hz`, {full}"
        report.add(motor.place("maximum_hz"), wrong, f"write at most {full}")
    most = _highest(motor, has)
    if most is not None and motor.maximum_hz > most:
        wrong = f"{motor.maximum_hz} Hz is more than the reference of {motor.map.prefix} can say"
        report.add(motor.place("maximum_hz"), wrong, f"write at most {most:.10g}")


def _highest(motor: Motor, has: Reference) -> float | None:
    """The highest speed that a reference can say, Hz; None: that is its full scale, or not known."""
    scale, poles = motor.values.get(REFERENCE), motor.values.get(POLES)
    if has.part:
        return None
    if not has.scaled:
        return float(has.highest / scale) if scale and scale > 0 else None
    return float(has.highest / has.ratio * (int(poles or 1) if has.in_rpm else 1))


def _times(motor: Motor, report: Report) -> None:
    if motor.stop_within_ms > MOST_MS:
        wrong = f"`stop_within_ms: {motor.stop_within_ms}` is too long"
        report.add(motor.place("stop_within_ms"), wrong, f"write 1 to {MOST_MS}")
    for key in ("ramp_up_s", "ramp_down_s"):
        if getattr(motor, key) is not None and not getattr(motor, key):
            report.add(motor.place(key), f"`{key}` of {motor.name} is 0", "write seconds, or leave it out")
    if motor.watchdog_ms is not None:
        if watchdog(motor.map) is None:
            wrong = f"the manual of {motor.map.prefix} knows of no watchdog"
            report.add(motor.place("watchdog_ms"), wrong, "leave `watchdog_ms` out, and rely on the hard stop")
        elif motor.watchdog_ms > MOST_MS:
            report.add(motor.place("watchdog_ms"), "this is too long for a watchdog", f"write at most {MOST_MS}")
        elif wrong := no_time(motor.map, Decimal(motor.watchdog_ms) / 1000):
            report.add(motor.place("watchdog_ms"), f"{motor.name}: {wrong}", "write a time that it takes, in ms")


def _speed(plant: Plant, motor: Motor, report: Report) -> None:
    speed = motor.speed
    if speed is None:
        return
    if motor.mode == "monitor":
        wrong = f"{motor.name} has a speed, and `mode: monitor` writes none"
        report.add(motor.place("speed"), wrong, "leave `speed` out, or write another mode")
    elif isinstance(speed, str):
        known(speed, plant.written["inputs"], "input", motor.place("speed"), report)
    elif not 0 < speed <= motor.maximum_hz:
        wrong = f"the speed of {motor.name} is {speed} Hz, and its `maximum_hz` {motor.maximum_hz}"
        report.add(motor.place("speed"), wrong, f"write more than 0, and at most {motor.maximum_hz}")


def _settings(motor: Motor, report: Report) -> None:
    """Scales that its manual leaves open, and what no setting may be."""
    has, open_ = reference(motor.map), open_scales(motor.map)
    given, places = motor.settings.given if motor.settings else {}, motor.settings.keys if motor.settings else {}
    for name, value in given.items():
        if name.endswith("Scale") and name not in open_:
            wrong = f"the manual of {motor.map.prefix} gives what `{name}` would say"
            report.add(places[name], wrong, "leave it out")
        elif name.endswith("Scale") and not 0 < value <= MOST_SCALE:
            report.add(places[name], f"`{name}: {value}` is no scale", f"write more than 0, and at most {MOST_SCALE}")
        elif name == POLES and not (has.in_rpm and value <= MOST_POLES):
            right = f"write 1 to {MOST_POLES}" if has.in_rpm else "leave it out"
            report.add(places[name], f"`{name}: {value}` is nothing for {motor.map.prefix}", right)
        elif name.endswith("Ms") and value == OFF and name not in MAY_BE_OFF:
            report.add(places[name], f"`{name}` cannot be off", f"write at most {MOST_MS}, or leave it out")
        elif name == "KeepWord" and not 0 <= value <= OFF:
            report.add(places[name], f"`{name}: {value}` is no word", "write 0000H to FFFFH")
    for name, needed in ((REFERENCE, REFERENCE in open_), (POLES, has.in_rpm)):
        if needed and name not in motor.values and name not in places and motor.mode != "monitor":
            wrong = f"{motor.name} has no `{name}`, and its manual does not give it: it would not start"
            right = f"add `settings: {{{name}: ...}}`; find it out on the uncoupled motor"
            report.add(motor.name_at, wrong, right)


def _checked(motor: Motor, report: Report) -> None:
    """Of a second-hand map the number that somebody has checked it."""
    number, given = checked(motor.map), motor.manual_checked
    right = f"write `manual_checked: {number}` once somebody has checked the map with the manual"
    if not second_hand(motor.map):
        if given is not None:
            wrong = f"the map of {motor.map.prefix} was read off the manual"
            report.add(motor.place("manual_checked"), wrong, "leave `manual_checked` out")
    elif given is None:
        report.add(motor.name_at, f"nobody has checked the map of {motor.name}: it would not start", right)
    elif given != number:
        wrong = f"{given} is another revision of the map of {motor.map.prefix}: it would not start"
        report.add(motor.place("manual_checked"), wrong, right)
