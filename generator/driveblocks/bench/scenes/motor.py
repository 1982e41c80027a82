"""Scenes of one motor: power-up, starts, speeds, stops, faults, and who is in charge."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import mark
from driveblocks.bench.scenes.scene import Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.measure import PINS as MEASURED
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import status
from driveblocks.meaning.words import MOTIONS, words
from structured_text.language.writing import word

TOLD = "Seen.UntoldMs < 50"
"""The drive has just received a stop."""
POWER = Step("power-up", until="Motor.Ready", ms=4000, shows={"Reason": "READY"}, brisk=True)
PINS: dict[str, str] = {does: does.title().replace("_", "") for does in MOTIONS}
RUNNING: Shows = {"Running": True, "Reason": "RUNS", "StopConfirmed": False, "Error": False, "CommOk": True}
STANDS: Shows = {"StopConfirmed": True, "Running": False, "Seen.Driven": False, "OutputFrequencyHz": 0.0}
STARTED = "Motor.Running AND (Seen.Starts > 0)"
"""It runs, and not only shows so, as some drives do before the last write of a path."""
NOTHING_STARTED: Shows = {"Seen.Starts": 0, "Seen.Runs": 0, "Seen.Driven": False}


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    can = Ability(drive)
    groups = {
        "MotorStart": ("a motor from power-up to its speed", starts),
        "MotorStop": ("every way to stop a motor", stops),
        "MotorFault": ("trips and their reset", faults),
        "MotorSilence": ("a drive that is silent, refuses or does what nobody asked for", silence),
        "MotorMode": ("who is in charge, and what is missing", modes),
    }
    for subject, (title, scenes) in groups.items():
        yield script(drive, stem, subject, title, scenes(can))


def run(shows: Shows | None = None) -> Step:
    """A start forward, up to the speed."""
    wanted = RUNNING | {"Seen.Starts": 1} | (shows or {})
    return Step("RunForward starts it", {"RunForward": True}, "Motor.AtSpeed", 3000, wanted, brisk=True)


def stand(shows: Shows | None = None, ms: int = 4000) -> Step:
    return Step("the motor is at standstill", {}, "Motor.StopConfirmed", ms, STANDS | (shows or {}))


# ---------------------------------------------------------------- starts

_MORE = {
    "output_speed": 900.0, "output_torque": 50.0, "relative_power": 30.0, "drive_temperature": 40.0,
    "motor_temperature": 50.0, "operating_time": 100.0, "energy": 12.0, "motor_torque": 5.0,
}  # fmt: skip
"""What else a drive can show, and its value at 30 Hz of the simulated motor."""
_MEASURED = {"output_voltage": 240.0, "dc_bus_voltage": 540.0, "output_power": 1.25} | _MORE
_BY_SPEED = {"output_voltage": 8.0, "output_power": 0.125, "output_speed": 6.0, "relative_power": 1.125}
"""What goes by the frequency, which a coarse reference reaches only nearly, and how near it comes."""
_UNMEASURED: Shows = {f"Motor.Diagnosis.{each.valid}": False for each in MEASURED.values()}


def starts(can: Ability) -> Iterator[Scene]:
    yield scene("power-up", *_power_up(can))
    yield scene("a run pin that is held since power-up", *_held(can))
    for does in can.motions:
        yield scene(does.replace("_", " "), POWER, *_motion(can, does))
    for does in sorted(set(PINS) - set(can.motions)):
        yield scene(f"{does.replace('_', ' ')}, which the drive cannot", POWER, *_not_able(does))
    yield scene("new speeds while it runs", POWER, run(), *_speeds(can))
    yield scene("a reference that is none", POWER, *_no_reference())
    yield scene("forward and reverse together", POWER, run(), *_both())
    if can.can("run_reverse"):
        yield scene("from forward to reverse", POWER, run(), *_turns_round(can))
    yield scene("a start before the stop is confirmed", POWER, run(), *_too_early())
    yield scene("a short touch of the run pin", POWER, *_touch())


def _power_up(can: Ability) -> Iterator[Step]:
    yield Step("nothing is known yet", {"Fate.Dumb": True}, ms=500, shows=_UNMEASURED | {
        "CommOk": False, "Reason": "NO_REPLY", "Ready": False, "StopConfirmed": False, "StopOverdue": False,
        "HardStop.HardStopOk": False,
    })  # fmt: skip
    told: Shows = {
        "CommOk": True, "StopConfirmed": True, "ZeroSpeed": True, "Running": False, "Fault": False, "Error": False,
        "ErrorID": 0, "FaultCode": 0, "StopOverdue": False, "Reason": "READY", "Seen.Stops >= 1": True,
        "Seen.StopKind > 0": True, "Bus.AllOnline": True, "Bus.OnlineCount": 1, "Bus.Error": False,
        "OutputFrequencyHz": 0.0,
        "Motor.Diagnosis.OutputFrequencyValid": can.measures("output_frequency"),
    }  # fmt: skip
    abilities: Shows = {
        "Motor.Diagnosis.CanReverse": can.can("run_reverse"),
        "Motor.Diagnosis.CanJog": can.can("jog_forward") or can.can("jog_reverse"),
        "Motor.Diagnosis.CanQuickStop": can.can("quick_stop"),
        "Motor.Diagnosis.CanCoastStop": can.can("coast_stop"),
        "Motor.Diagnosis.CanResetFault": can.can("fault_reset"),
    }
    yield Step("a stop is sent, though it is at standstill", {"Fate.Dumb": False}, "Motor.Ready", 5000, told)
    yield Step("nothing starts", ms=500, shows=NOTHING_STARTED | abilities | {"HardStop.HardStopOk": False})
    yield Step("the contact closes by an edge", {"Pins.HardReset": True}, ms=50, shows={"HardStop.HardStopOk": True})


def _held(can: Ability) -> Iterator[Step]:
    yield Step("it starts nothing", {"RunForward": True}, "Motor.StopConfirmed", 4000, NOTHING_STARTED)
    yield Step("nor at standstill", ms=max(1000, 400 * can.turns), shows=NOTHING_STARTED | {"StopConfirmed": True})
    read = max(500, 400 * can.turns)  # the settings of the drive may be among many reads
    yield Step("it is released", {"RunForward": False}, "Motor.Ready", read, {"Reason": "READY"})
    yield run()


def _motion(can: Ability, does: str) -> Iterator[Step]:
    pin, jog, back = PINS[does], does.startswith("jog"), does.endswith("reverse")
    hertz = 5.0 if jog else 30.0
    opposite = "+" if back else "-"
    pace = why("RAMPING" if can.measures("output_frequency") and not jog else "RUNS")
    yield Step("the pin", {pin: True}, ms=20, shows={
        "Slots[0].Ask[1].Number <> Slots[0].Answer[1].Number": True, "StopConfirmed": False,
    })  # fmt: skip
    yield Step("the start is sent", {}, f"{why('STARTING')} OR {pace}", 200, {"StopConfirmed": False})
    sent = words(can.drive).named[does].last.register
    own, path = sent != reference(can.drive).register, can.path_ms(does)
    asked: Shows = {"Slots[0].Once": own, "Slots[0].Begins": own}  # after a long path, the reference is due again
    yield Step("it ramps up", {}, f"{STARTED} AND ({pace})", 1000 + path, {
        "Seen.Order": can.order(does), **(asked if path < 1000 else {}),
    })  # fmt: skip
    jogs = f"(ABS(Seen.Milli) >= {round(1000 * hertz) - 200}) AND NOT Motor.ZeroSpeed"
    until = jogs if jog else "Motor.AtSpeed"
    shows: Shows = {
        "Running": True, "Seen.Starts": 1, "Seen.Order": can.order(does), "Error": False, "ZeroSpeed": False,
        f"ABS(Seen.Milli {opposite} {round(1000 * hertz)}) <= 200": True,
    }  # fmt: skip
    yield Step("it reaches its speed", {}, until, 3000, shows)
    shows = {"Reason": "RUNS"}
    if can.shows("reverse"):
        shows["Reverse"] = back
    if not jog:
        shows |= {"OutputFrequencyHz": hertz, "ABS(ABS(Seen.StartMilli) - 30000) <= 200": True}
    if can.measures("output_current"):
        shows["OutputCurrentA"] = 5.0
    for name, value in _measured(can, jog=jog).items():
        shows[name if "Motor." in name else f"Motor.Diagnosis.{name}"] = value
    stays: Shows = {"Reason": "RUNS"} if jog else shows
    yield Step("and stays there", ms=max(1500, 400 * can.turns), shows=stays | {"Seen.Starts": 1})
    yield Step("the pin falls", {pin: False}, TOLD, 300, {"StopConfirmed": False})
    yield stand({"Reason": "READY"})


def _measured(can: Ability, *, jog: bool) -> Shows:
    """Measures at 30 Hz of the simulated motor."""
    if jog:
        return {}
    found: Shows = {MEASURED["output_current"].valid: can.measures("output_current")}
    for what in _MEASURED:
        found[MEASURED[what].valid] = can.measures(what)
        name = f"{MEASURED[what].name}{MEASURED[what].unit}"
        if what in _BY_SPEED and can.measures(what):
            found[f"ABS(Motor.Diagnosis.{name} - {_MEASURED[what]}) < {_BY_SPEED[what]}"] = True
        elif what in _MORE or can.measures(what):
            found[name] = _MEASURED[what] if can.measures(what) else 0.0
    return found


def _not_able(does: str) -> Iterator[Step]:
    pin = PINS[does]
    yield Step("it says so", {pin: True}, ms=300, shows=NOTHING_STARTED | {
        "Reason": "NOT_ABLE", "Error": True, "ErrorID": 16, "Ready": False,
    })  # fmt: skip
    yield Step("forward instead, but no new edge", {pin: False, "RunForward": True}, ms=60, shows=NOTHING_STARTED | {
        "Error": False, "ErrorID": 0,
    })  # fmt: skip
    yield Step("the pin falls", {"RunForward": False}, "Motor.Ready", 2000, {"Error": False, "Reason": "READY"})


def _speeds(can: Ability) -> Iterator[Step]:
    for hertz in (45.0, 10.0, *([] if can.runs_by_speed else [0.0]), 30.0):
        milli = f"ABS(Seen.Milli - {round(1000 * hertz)}) <= 200"
        yield Step(f"{hertz:g} Hz", {"SpeedReferenceHz": hertz}, milli, 2000, {"Running": True})
        if can.measures("output_frequency"):
            yield Step("it shows it", {}, f"ABS(Motor.OutputFrequencyHz - {hertz}) < 0.2", 1500, {"Seen.Starts": 1})
    beyond: Shows = {"SpeedReferenceHz": 45.0, "MaximumHz": 40.0}
    yield Step("beyond MaximumHz", beyond, "ABS(Seen.Milli - 40000) <= 200", 2000, {
        "Motor.Diagnosis.ReferenceLimited": True, "Running": True,
    })  # fmt: skip
    yield Step("and below it again", {"SpeedReferenceHz": 35.0}, "ABS(Seen.Milli - 35000) <= 200", 2000, {
        "Motor.Diagnosis.ReferenceLimited": False, "Seen.Starts": 1,
    })  # fmt: skip


def _no_reference() -> Iterator[Step]:
    bad: Shows = NOTHING_STARTED | {"Reason": "REFERENCE", "Error": True, "ErrorID": 13, "Ready": False}
    yield Step("negative", {"SpeedReferenceHz": -1.0, "RunForward": True}, ms=300, shows=bad)
    yield Step("good again, but no new edge", {"SpeedReferenceHz": 30.0}, ms=500, shows=NOTHING_STARTED | {
        "Reason": "REFERENCE", "Error": False,
    })  # fmt: skip
    yield Step("no maximum", {"RunForward": False, "MaximumHz": 0.0}, ms=300, shows={
        "ErrorID": 17, "Reason": "REFERENCE", "Ready": False,
    })  # fmt: skip
    yield Step("a new edge", {"MaximumHz": 50.0}, "Motor.Ready", 500, {"ErrorID": 0})
    yield run()
    yield Step("negative while it runs: it stops", {"SpeedReferenceHz": -1.0}, "Motor.StopConfirmed", 3000, STANDS | {
        "Reason": "REFERENCE", "ErrorID": 13,
    })  # fmt: skip


def _both() -> Iterator[Step]:
    yield Step("it stops", {"RunReverse": True}, "Motor.StopConfirmed", 3000, STANDS | {
        "Reason": "BOTH", "Error": True, "ErrorID": 14,
    })  # fmt: skip
    yield Step("one is released: no new edge", {"RunReverse": False}, ms=500, shows={
        "Reason": "HELD", "Seen.Starts": 1, "Error": False,
    })  # fmt: skip


def _turns_round(can: Ability) -> Iterator[Step]:
    pins: Shows = {"RunForward": False, "RunReverse": True}
    yield Step("it stops", pins, "Motor.StopConfirmed", 3000, STANDS)
    yield Step("and waits for a new edge", ms=500, shows={"Seen.Starts": 1, "Reason": "HELD"})
    yield Step("released", {"RunReverse": False}, "Motor.Ready", 500)
    yield Step(
        "a new edge",
        {"RunReverse": True},
        "Motor.AtSpeed",
        3000,
        {"Seen.Order": can.order("run_reverse"), "ABS(Seen.Milli + 30000) <= 200": True},
    )


def _too_early() -> Iterator[Step]:
    yield Step("released", {"RunForward": False}, "Seen.Stopping", 300, {"StopConfirmed": False})
    yield Step("set while it ramps down", {"RunForward": True}, ms=150, shows={"Reason": "NOT_STOPPED"})
    yield Step("still, and it starts nothing", ms=2000, shows=STANDS | {"Seen.Starts": 1, "Reason": "NOT_STOPPED"})
    yield Step("released", {"RunForward": False}, "Motor.Ready", 500)
    yield Step("a new edge", {"RunForward": True}, "Motor.AtSpeed", 3000, {"Seen.Starts": 2})


def _touch() -> Iterator[Step]:
    for _ in range(2):
        yield Step("for one scan", {"RunForward": True}, ms=20)
        yield Step("released: a new stop", {"RunForward": False}, ms=40, shows={"Slots[0].StopAgain": False})
        yield Step("at standstill", {}, "Motor.Ready", 3000, {"Seen.Driven": False})
    yield Step("nothing comes after", ms=500, shows={"Seen.Driven": False, "StopConfirmed": True})


# ---------------------------------------------------------------- stops


def stops(can: Ability) -> Iterator[Scene]:
    """Each pin that stops, and what a new start needs then."""
    rows: tuple[tuple[str, Shows, Shows, str, int], ...] = (
        ("Enable FALSE", {"Enable": False}, {"Enable": True}, "DISABLED", 1),
        ("QuickStop", {"QuickStop": True}, {"QuickStop": False}, "STOP_PIN", can.kind("quick_stop")),
        ("CoastStop", {"CoastStop": True}, {"CoastStop": False}, "STOP_PIN", can.kind("coast_stop")),
        ("StopAll", {"Pins.StopAll": True}, {"Pins.StopAll": False}, "STOP_ALL", 1),
    )
    for name, sets, frees, reason, kind in rows:
        yield scene(name, POWER, run(), *_stopped(sets, frees, reason, kind))
    yield scene("a stop is as quick as it says", POWER, run(), *_quick())
    yield scene("the run pin falls", POWER, run(), *_released())
    yield scene("a stop grows stronger", POWER, run(), *_stronger(can))
    if can.can("jog_forward"):
        yield scene("the jog pin falls", POWER, *_jog_ends(can))
        if can.can("jog_stop"):
            yield scene("a jog whose block is no longer called", POWER, *_jog_alone())
    yield scene("a motor that runs on", POWER, run(), *_runs_on())
    yield scene("a stop whose acknowledgement is lost", POWER, run(), *_unanswered_stop())
    yield scene("a flickering stop pin", POWER, run(), *_flicker())
    yield scene("the PLC restarts while it runs", POWER, run(), *_restart(can))


def _stopped(sets: Shows, frees: Shows, reason: str, kind: int) -> Iterator[Step]:
    yield Step("the stop is sent", sets, TOLD, 300, {"Seen.StopKind": kind, "Seen.Starts": 1})
    yield stand({"Reason": reason, "Seen.Starts": 1})
    yield Step("it is over, but the run pin is held", frees, ms=1000, shows=STANDS | {
        "Seen.Starts": 1, "Reason": "HELD",
    })  # fmt: skip
    yield Step("released", {"RunForward": False}, "Motor.Ready", 500)
    yield Step("a new edge", {"RunForward": True}, "Motor.AtSpeed", 3000, RUNNING | {"Seen.Starts": 2})


def _quick() -> Iterator[Step]:
    """From the pin to the stop that reaches the drive: no longer than StopAloneMs and the scan that hands it over."""
    late = "UINT_TO_DINT(WaitedMs) <= UINT_TO_DINT(Motor.Diagnosis.StopAloneMs) + 20"
    for _ in range(2):
        yield Step("Enable falls", {"Enable": False}, "Seen.UntoldMs < 20", 400, {late: True})
        yield Step("at standstill", {"RunForward": False, "Enable": True}, "Motor.Ready", 3000)
        yield Step("once more", {"RunForward": True}, "Motor.AtSpeed", 3000)


def _released() -> Iterator[Step]:
    yield Step("the stop is sent", {"RunForward": False}, TOLD, 300, {"Seen.StopKind": 1})
    yield Step("it ramps down", {}, "Seen.Milli < 20000", 1000, {"StopConfirmed": False, "Reason": "STOPPING"})
    yield stand({
        "Reason": "READY", "Motor.Diagnosis.StopReason": 6, "Motor.Diagnosis.StopKind": 1, "AtSpeed": False,
        "Slots[0].Answer[1].ErrorID = 0": True,
    })  # fmt: skip


def _stronger(can: Ability) -> Iterator[Step]:
    runs_on: Shows = {"RunForward": False, "Fate.RunsOn": True, "StopWithinMs": 20000}
    strongest = can.kind("coast_stop" if can.can("coast_stop") else "quick_stop")
    yield Step("a ramp, and it runs on", runs_on, TOLD, 300, {"Seen.StopKind": 1})
    yield Step("a quick stop", {"QuickStop": True}, ms=150, shows={"Seen.StopKind": can.kind("quick_stop")})
    yield Step("a coast stop", {"CoastStop": True}, ms=150, shows={"Seen.StopKind": strongest})
    pins: Shows = {"CoastStop": False, "QuickStop": False, ".Mark": "Seen.Stops"}
    yield Step("its repetitions are as strong", pins, "Seen.Stops > Mark", 1000, {
        "Seen.StopKind": strongest, "Slots[0].StopAgain": True,
    })  # fmt: skip
    yield Step("at standstill", {"Fate.RunsOn": False}, "Motor.StopConfirmed", 3000, STANDS)


def _jog_ends(can: Ability) -> Iterator[Step]:
    yield Step("it jogs", {"JogForward": True}, "ABS(Seen.Milli - 5000) <= 200", 1500, {"Seen.Order": 7})
    ends = f"(Seen.StopKind = {4 if can.can('jog_stop') else 1}) AND ({TOLD})"
    yield Step("it ends", {"JogForward": False}, ends, 800)
    yield stand()
    yield Step("nothing is left of it", ms=60, shows={"Slots[0].JogStop = 0": True, "StopConfirmed": True})
    yield run({"Seen.Starts": 2})
    yield Step("after a run there is but one stop", {"RunForward": False, ".Mark": "Seen.Stops"}, TOLD, 300)
    yield stand({"Seen.StopKind": 1, "Seen.Stops - Mark": (1, 2)})


def _jog_alone() -> Iterator[Step]:
    """The line knows which stop comes first."""
    yield Step("both stops are sent after power-up", ms=100, shows={"Seen.StopKind": 4})
    yield Step("it jogs", {"JogForward": True}, "ABS(Seen.Milli - 5000) <= 200", 1500, {"Seen.Order": 7})
    gone: Shows = {"Pins.NoDrive": True, "Pins.AttendMs": 200, ".Mark": "Seen.Stops"}
    yield Step("the line ends it", gone, "Seen.Stops > Mark", 1500, {"Seen.StopKind": 4})
    yield Step("and stops what may run beside", {}, "Seen.StopKind = 1", 500, {"Seen.Stops - Mark": 2})
    yield Step("the block is back", {"Pins.NoDrive": False, "JogForward": False}, "Motor.Ready", 5000, STANDS)


def _runs_on() -> Iterator[Step]:
    closed: Shows = {"Pins.HardReset": True, "StopWithinMs": 2500}
    yield Step("the contact is closed", closed, ms=50, shows={"HardStop.HardStopOk": True})
    yield Step("it acknowledges the stop and runs on", {"RunForward": False, "Fate.RunsOn": True}, ms=1500, shows={
        "StopConfirmed": False, "StopOverdue": False, "Seen.Driven": True, "Running": True, "Reason": "STOPPING",
    })  # fmt: skip
    yield Step("after StopWithinMs it is overdue", {}, "Motor.StopOverdue", 4000, {
        ".WaitedMs": (940, 1100),
        "HardStop.HardStopOk": False, "StopConfirmed": False, "Seen.Stops >= 4": True,
    })  # fmt: skip
    yield Step("now it obeys", {"Fate.RunsOn": False, "Pins.HardReset": False}, "Motor.StopConfirmed", 3000, STANDS)
    yield Step("no longer overdue; the contact waits for an edge", {}, "NOT Motor.StopOverdue", 500, {
        "HardStop.HardStopOk": False,
    })  # fmt: skip
    yield Step("which closes it", {"Pins.HardReset": True}, ms=50, shows={"HardStop.HardStopOk": True})


def _unanswered_stop() -> Iterator[Step]:
    lost: Shows = {"RunForward": False, "Fate.Cut": True}
    yield Step("the wire is cut for a moment", lost, ms=150, shows={"StopConfirmed": False, "Seen.Driven": True})
    yield Step(
        "the stop is sent again", {"Fate.Cut": False}, "Motor.StopConfirmed", 3000, STANDS | {"Bus.Retries >= 1": True}
    )


def _flicker() -> Iterator[Step]:
    for _ in range(3):
        yield Step("QuickStop", {"QuickStop": True}, ms=20)
        yield Step("not QuickStop", {"QuickStop": False}, ms=20, shows={"Seen.Starts": 1})
    yield Step("a stop that changes nothing is a repetition", {"QuickStop": True}, ms=40, shows={
        "Slots[0].StopAgain": True, "StopConfirmed": False,
    })  # fmt: skip
    yield Step("over", {"QuickStop": False}, ms=20)
    yield stand({"Seen.Starts": 1, "Reason": "HELD"})


def _restart(can: Ability) -> Iterator[Step]:
    yield Step(
        "Restart", {"Pins.Restart": True}, ms=40, shows={"StopConfirmed": False, "Reason": "RESTARTED", "CommOk": False}
    )
    yield Step("it is stopped, never adopted", {"Pins.Restart": False}, "Motor.StopConfirmed", 4000, STANDS | {
        "Seen.Starts": 1, "Reason": "HELD",
    })  # fmt: skip
    yield Step("a new edge", {"RunForward": False}, "Motor.Ready", 500 * can.turns)
    yield Step("runs it", {"RunForward": True}, "Motor.AtSpeed", 3000, {"Seen.Starts": 2})
    yield Step(
        "a scan of two seconds acts like a restart", {"Pins.ElapsedMs": 2000}, ms=40, shows={"StopConfirmed": False}
    )
    yield Step("it is stopped", {"Pins.ElapsedMs": SCAN_MS}, "Motor.StopConfirmed", 4000, STANDS)


# ---------------------------------------------------------------- faults


def faults(can: Ability) -> Iterator[Scene]:
    yield scene("a trip while it runs", POWER, run(), *_trip(can))
    yield scene("a trip at standstill", POWER, *_trip_still(can))
    if can.can("fault_reset"):
        yield scene("a reset whose cause is still there", POWER, run(), *_vain(can))
        yield scene("a reset while a run pin is held", POWER, run(), *_reset_held(can))
        yield scene("a reset without a fault", POWER, *_reset_nothing())
        yield scene("a reset that is refused", POWER, *_reset_refused(can))
        yield scene("a reset pin that is held", POWER, *_reset_latched(can))
    else:
        yield scene("a drive without a reset by the bus", POWER, *_no_reset(can))
    yield scene("two faults in turn", POWER, run(), *_two_faults(can))
    yield scene("nine faults in turn", POWER, *_nine_faults(can))


def _tripped(can: Ability) -> Shows:
    """What is shown in a trip; a drive whose speed says that it runs says so while the motor coasts."""
    still: Shows = {} if can.runs_by_speed else {"Running": False}
    return still | {"Fault": True, "FaultCode": can.code, "Reason": "FAULT", "Ready": False, "Error": False}


def _code_known(can: Ability) -> str:
    return f"Motor.Fault AND (Motor.FaultCode = {can.code})"


def _trip(can: Ability) -> Iterator[Step]:
    if can.measures("dc_bus_voltage"):
        yield Step("what is kept at a fault was read", {}, f"Motor.Diagnosis.{MEASURED['dc_bus_voltage'].valid}", 2000)
    trips: Shows = {"Fate.Trips": can.codes[1], "Fate.Cause": True}
    coasts: Shows = {"Seen.Starts": 1, "Running": can.runs_by_speed}
    both = _code_known(can) + ("" if can.runs_by_speed else " AND NOT Motor.Running")  # perhaps in two reads
    yield Step("it trips", trips, both, 1500, _tripped(can) | coasts)
    yield Step(
        "a stop is sent, so that no run word is left", ms=500, shows={"Seen.Stops >= 2": True, "StopOverdue": False}
    )
    yield Step("the motor is at standstill", {}, "Seen.Milli = 0", 4000, {"Reason": "FAULT", "Seen.Starts": 1})
    yield Step("the first fault is kept", ms=300, shows={
        "Motor.Diagnosis.FirstFaultCode": can.code, "Motor.Diagnosis.FaultBack1": can.code,
        "Motor.Diagnosis.FirstFaultMs > 200": True, "Motor.Diagnosis.FirstFaultMs < 5000": True,
        "Motor.Diagnosis.FirstFaultState": 4 if can.trips_at_once else (0, 4),
    } | _measured_at_fault(can))  # fmt: skip
    yield from _gone(can)
    yield Step("released", {"RunForward": False, "FaultReset": False}, "Motor.Ready", 1500)
    yield Step("a new edge", {"RunForward": True}, "Motor.AtSpeed", 3000, RUNNING | {
        "Seen.Starts": 2, "FaultCode": 0, "Motor.Diagnosis.FirstFaultCode": 0, "Motor.Diagnosis.FaultBack1": can.code,
    })  # fmt: skip
    other = can.codes[0] if can.code else 0
    known = f"Motor.Fault AND (Motor.Diagnosis.FirstFaultCode = {other})"
    yield Step("the first fault since then is another", {"Fate.Trips": can.codes[0]}, known, 1000 + 500 * can.turns, {
        "Motor.Diagnosis.FirstFaultCode": other, "Motor.Diagnosis.FaultBack1": other, "Fault": True,
        "Motor.Diagnosis.FaultBack2": can.code, "Motor.Diagnosis.FirstFaultMs > 200": True,
        "Motor.Diagnosis.FirstFaultMs < 3500": True,
    })  # fmt: skip


def _measured_at_fault(can: Ability) -> Shows:
    """What was read last, before it tripped; a fault that its code alone shows may be seen after the stop."""
    found: Shows = {}
    if can.measures("output_frequency") and can.trips_at_once:
        found["ABS(Motor.Diagnosis.FirstFaultHz - 30.0) < 8.0"] = True
    if can.measures("dc_bus_voltage"):
        found["Motor.Diagnosis.FirstFaultV"] = 540.0
    return found


def _gone(can: Ability) -> Iterator[Step]:
    """The fault is reset: by the bus after a release of the run pin, or by the keypad."""
    if can.can("fault_reset"):
        yield Step("its cause is gone; the run pin falls", {"Fate.Cause": False, "RunForward": False}, ms=200)
        yield Step(
            "FaultReset", {"FaultReset": True}, "NOT Motor.Fault", 4000, {"Seen.Resets >= 1": True, "FaultCode": 0}
        )
        yield Step(
            "still, and ready", {}, "Motor.StopConfirmed AND Motor.Ready", 3000, {"Reason": "READY", "Seen.Starts": 1}
        )
    else:
        sets: Shows = {"Fate.Cause": False, "Fate.KeypadReset": True}
        gone = "Motor.StopConfirmed AND NOT Motor.Fault"
        yield Step("somebody resets it on its keypad", sets, gone, 4000, STANDS | {"FaultCode": 0})
        held: Shows = {"Reason": "HELD"} if can.trips_at_once else {}
        yield Step("the run pin is still held", ms=500, shows={"Seen.Starts": 1} | held)


def _trip_still(can: Ability) -> Iterator[Step]:
    trips: Shows = {"Fate.Trips": can.codes[1], "Fate.Cause": True, "StopWithinMs": 1500}
    yield Step("it trips", trips, _code_known(can), 1500, _tripped(can) | NOTHING_STARTED)
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows=_tripped(can) | NOTHING_STARTED)
    yield Step("a stop that is repeated is not overdue", ms=2500, shows={"StopOverdue": False, "Seen.Stops >= 2": True})


def _vain(can: Ability) -> Iterator[Step]:
    yield Step("it trips", {"Fate.Trips": can.codes[1], "Fate.Cause": True}, "Motor.Fault", 1500)
    yield Step("the motor is at standstill", {"RunForward": False}, "Seen.Milli = 0", 4000)
    yield Step("FaultReset", {"FaultReset": True}, "Seen.Resets >= 1", 3000, {"Fault": True})
    slow: Shows = {"Pins.ElapsedMs": 5 * SCAN_MS, "Pins.MaxScanMs": 5 * SCAN_MS}
    yield Step("ten seconds have not helped", slow, why("FAULT_BACK"), 2600, {"Fault": True, "Ready": False})
    yield Step(
        "one is enough where it is answered",
        {"Pins.ElapsedMs": SCAN_MS},
        ms=500,
        shows={"Seen.Resets": 1, "Reason": "FAULT_BACK"},
    )
    yield Step("the cause is gone, the pin falls", {"Fate.Cause": False, "FaultReset": False}, ms=100)
    yield Step("a new edge", {"FaultReset": True}, "Motor.Ready", 4000, {"Fault": False, "Reason": "READY"})


def _reset_held(can: Ability) -> Iterator[Step]:
    yield Step("it trips", {"Fate.Trips": can.codes[1]}, "Motor.Fault", 1500)
    yield Step("the motor is at standstill", {}, "Seen.Milli = 0", 4000)
    yield Step("FaultReset is refused", {"FaultReset": True}, ms=1500, shows={
        "Fault": True, "Reason": "NO_RESET", "Seen.Resets": 0, "Seen.Starts": 1,
    })  # fmt: skip
    yield Step("both fall", {"RunForward": False, "FaultReset": False}, ms=200)
    yield Step("a new edge of FaultReset", {"FaultReset": True}, "Motor.Ready", 4000, {"Seen.Resets >= 1": True})


def _reset_nothing() -> Iterator[Step]:
    yield Step("nothing is sent", {"FaultReset": True}, ms=1000, shows=NOTHING_STARTED | {
        "Seen.Resets": 0, "StopConfirmed": True, "Error": False,
    })  # fmt: skip


def _reset_refused(can: Ability) -> Iterator[Step]:
    yield Step("it trips", {"Fate.Trips": can.codes[1]}, _code_known(can), 1500)
    yield Step("it refuses all writes", {"Fate.RefusesWrites": True, "FaultReset": True}, why("NO_RESET"), 13000, {
        "Fault": True, "Seen.Resets": 0,
    })  # fmt: skip


def _reset_latched(can: Ability) -> Iterator[Step]:
    yield Step("held before the fault", {"FaultReset": True}, ms=200)
    yield Step("it trips", {"Fate.Trips": can.codes[1]}, _code_known(can), 1500)
    yield Step("no edge, no reset", ms=2000, shows={"Fault": True, "Seen.Resets": 0})


def _no_reset(can: Ability) -> Iterator[Step]:
    yield Step("it trips", {"Fate.Trips": can.codes[1]}, "Motor.Fault", 1500)
    yield Step("FaultReset does nothing", {"FaultReset": True}, ms=2000, shows=NOTHING_STARTED | {
        "Fault": True, "Seen.Resets": 0, "Seen.Others": 0,
    })  # fmt: skip
    yield Step(
        "its keypad does", {"Fate.KeypadReset": True}, "Motor.StopConfirmed AND Motor.Ready", 4000, {"Fault": False}
    )


def _two_faults(can: Ability) -> Iterator[Step]:
    first, second = can.codes
    known = can.code > 0
    back = [(f"Motor.Diagnosis.FaultBack{place}", code if known else 0) for place, code in ((1, second), (2, first))]
    yield Step("the first", {"RunForward": False, "Fate.Trips": first}, "Motor.Fault", 1500)
    yield Step("it is known", ms=1500, shows={"FaultCode": first if known else 0})
    yield Step("reset on its keypad", {"Fate.KeypadReset": True}, "NOT Motor.Fault AND (Seen.Milli = 0)", 3000)
    yield Step("the second", {"Fate.Trips": second}, _code_known(can), 1500)
    yield Step("both are kept", ms=1500, shows=dict(back) | {"Motor.Diagnosis.FirstFaultCode": first if known else 0})


def _nine_faults(can: Ability) -> Iterator[Step]:
    """The last eight are kept, the last one first."""
    first, second = can.codes
    codes = [first, second, second, first, first, first, second, first, second]
    for count, code in enumerate(codes, 1):
        shown = code if can.code else 0
        known = f"Motor.Fault AND (Motor.FaultCode = {shown})"
        yield Step(f"fault {count}", {"Fate.Trips": code}, known, 1500 * can.turns, {"FaultCode": shown})
        yield Step("it is kept", ms=200 * can.turns, shows={"Fault": True, "Motor.Diagnosis.FaultBack1": shown})
        yield Step("it is reset", {"Fate.KeypadReset": True}, "NOT Motor.Fault", 1500)
    kept = [code if can.code else 0 for code in reversed(codes)][:8]
    yield Step("all are kept", ms=100, shows={
        f"Motor.Diagnosis.FaultBack{place}": code for place, code in enumerate(kept, 1)
    } | {"Motor.Diagnosis.FirstFaultCode": first if can.code else 0})  # fmt: skip
    yield Step("the PLC restarts", {"Pins.Restart": True}, ms=40)
    yield Step("it has stopped it", {"Pins.Restart": False}, "Motor.StopConfirmed", 3000)
    kept_first = f"Motor.Fault AND (Motor.Diagnosis.FirstFaultCode = {second if can.code else 0})"
    yield Step("its first fault", {"Fate.Trips": second}, kept_first, 1500 * can.turns)


# ---------------------------------------------------------------- silence and disobedience


def silence(can: Ability) -> Iterator[Scene]:
    """A dead drive and its return; refusals; a motor with a will of its own."""
    yield scene("a dead drive and its return", POWER, run(), *_dead())
    yield scene("damaged replies", POWER, run(), *_damaged())
    yield scene("replies that are lost now and then", POWER, run(), *_hiccup())
    yield scene("late replies", POWER, run(), *_late())
    yield scene("a run that is refused", POWER, *_refused())
    yield scene("a drive that refuses to be read", POWER, *_unreadable())
    yield scene("a command that is not followed", POWER, *_not_followed())
    yield scene("a reference that is not acknowledged", POWER, *_unacknowledged(can, "reference", "NO_REFERENCE"))
    yield scene("a run that is not acknowledged", POWER, *_unacknowledged(can, "run", "NO_RUN"))
    if can.runs_at_once:
        yield scene("a run whose reply is lost", POWER, *_unsaid(can))
        yield scene("a run that is never answered", POWER, *_tries(can))
    yield scene("started on its keypad", POWER, *_keypad_run())
    yield scene("stopped on its keypad", POWER, run(), *_keypad_stop())
    if can.shows("ready"):
        yield scene("an interlock", POWER, *_not_ready())
    if can.shows("warning") or can.warning:
        yield scene("a warning", POWER, run(), *_warning(can))
    yield scene("no supply on purpose", POWER, run(), *_no_supply())
    yield scene("a status that grows old", POWER, run(), *_stale())


def _dead() -> Iterator[Step]:
    yield Step("the contact is closed", {"Pins.HardReset": True}, ms=50, shows={"HardStop.HardStopOk": True})
    yield Step("the cable is cut", {"Fate.Cut": True, "Pins.HardReset": False}, why("OFFLINE"), 3000, {
        "CommOk": False, "Running": False, "Ready": False, "ZeroSpeed": False, "StopConfirmed": False,
        "Bus.AllOnline": False, "Bus.OnlineCount": 0, "Seen.Driven": True,
    })  # fmt: skip
    yield Step("its stop is overdue, the contact opens", {}, "Motor.StopOverdue", 6000, {
        "HardStop.HardStopOk": False, "Seen.Driven": True,
    })  # fmt: skip
    yield Step("the cable is whole: it is stopped first", {"Fate.Cut": False}, TOLD, 4000, {"Seen.Starts": 1})
    yield stand({"CommOk": True, "Seen.Starts": 1}, 5000)
    yield Step(
        "released", {"RunForward": False}, "Motor.Ready AND NOT Motor.StopOverdue", 2000, {"HardStop.HardStopOk": False}
    )
    yield Step("a new edge", {"RunForward": True, "Pins.HardReset": True}, "Motor.AtSpeed", 3000, {
        "Seen.Starts": 2, "HardStop.HardStopOk": True,
    })  # fmt: skip


def _damaged() -> Iterator[Step]:
    yield Step("for a moment", {"Fate.Damaged": True}, ms=100, shows={"Bus.Bad >= 1": True, "Running": True})
    yield Step("it runs on", {"Fate.Damaged": False}, ms=500, shows=RUNNING | {"Seen.Starts": 1})
    yield Step("for good", {"Fate.Damaged": True}, "NOT Motor.CommOk", 6000, {"Ready": False, "Running": False})
    yield Step(
        "well again: at standstill", {"Fate.Damaged": False}, "Motor.StopConfirmed", 6000, STANDS | {"Seen.Starts": 1}
    )


def _hiccup() -> Iterator[Step]:
    for _ in range(3):
        yield Step("lost", {"Fate.Dumb": True}, ms=60, shows={"Running": True})
        yield Step("well", {"Fate.Dumb": False}, ms=300, shows=RUNNING | {"Seen.Starts": 1})
    yield Step("the line has counted them", ms=20, shows={"Bus.Timeouts >= 3": True, "Bus.LateReplies": 0})


def _late() -> Iterator[Step]:
    late: Shows = {"Fate.HoldMs": 100, "Pins.Settings.LongestMs": 250}
    yield Step("later than TurnRoundMs", late, ms=1500, shows={"Bus.LateReplies >= 1": True})
    yield Step("for too long", {}, why("LATE_REPLIES"), 3000, {"CommOk": False})
    yield Step("in time again", {"Fate.HoldMs": 0}, "Motor.CommOk", 4000, {"Seen.Starts": 1})
    yield Step("it still obeys", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS)


def _refused() -> Iterator[Step]:
    refused: Shows = NOTHING_STARTED | {"Slots[0].Refusals >= 1": True}
    yield Step("it refuses writes", {"Fate.RefusesWrites": True, "RunForward": True}, why("REFUSED"), 1500, refused)
    yield Step("it takes them: no new edge", {"Fate.RefusesWrites": False}, ms=2000, shows=NOTHING_STARTED)
    yield Step("released", {"RunForward": False}, "Motor.Ready", 3000)
    yield run()


def _unreadable() -> Iterator[Step]:
    yield Step("it refuses every read", {"Fate.RefusesReads": True}, why("READ_REFUSED"), 8000, NOTHING_STARTED | {
        "CommOk": False, "StopConfirmed": False,
    })  # fmt: skip
    yield Step("it is read again", {"Fate.RefusesReads": False}, "Motor.StopConfirmed", 4000, STANDS)


def _not_followed() -> Iterator[Step]:
    sets: Shows = {"Fate.Local": True, "RunForward": True, "Pins.Settings.FollowWithinMs": 1000}
    yield Step("it acknowledges and does nothing", sets, why("NOT_FOLLOWED"), 3000, {
        "Motor.Diagnosis.CommandNotFollowed": True, "Seen.Driven": False,
    }, brisk=False)  # fmt: skip
    yield Step("it follows again", {"Fate.Local": False, "RunForward": False}, "Motor.Ready", 4000)
    yield run({"Motor.Diagnosis.CommandNotFollowed": False})


def _unacknowledged(can: Ability, what: str, reason: str) -> Iterator[Step]:
    register = reference(can.drive).register if what == "reference" else can.run.last.register
    if register == reference(can.drive).register and what == "run":
        return
    lost: Shows = {"Fate.Skips": True, "Fate.Skipped": word(mark(register)), "RunForward": True}
    yield Step("its write is lost", lost, why(reason), 6000, {"Seen.Starts": 0, "Running": False})
    yield Step("it comes again", {"Fate.Skips": False, "RunForward": False}, "Motor.Ready", 5000, NOTHING_STARTED)
    yield run()


def _unsaid(can: Ability) -> Iterator[Step]:
    """The status is read before a run is written again: it runs, so it is acknowledged."""
    lost: Shows = {"Fate.Unsaid": True, "Fate.Skipped": word(mark(can.run.last.register)), "RunForward": True}
    yield Step("it runs, and nobody says so", lost, "Motor.AtSpeed", 4000, {
        "Seen.Starts": 1, "Seen.Runs": 1, "Running": True,
    })  # fmt: skip
    yield Step("it runs on", {"Fate.Unsaid": False}, ms=1000, shows={"Running": True, "Seen.Starts": 1})


def _tries(can: Ability) -> Iterator[Step]:
    """One attempt and three more, with a look at the status before each."""
    register = can.run.last.register
    lost: Shows = {"Fate.Unsaid": True, "Fate.Skipped": word(mark(register)), "Fate.Local": True, "RunForward": True}
    before: Shows = {".Mark": "Seen.Writes - Seen.References"}
    yield Step("four times unanswered", lost | before, why("NO_RUN"), 6000, {
        "Seen.Writes - Seen.References - Mark": (4, 5), "Seen.Driven": False,
    })  # fmt: skip
    well: Shows = {"Fate.Unsaid": False, "Fate.Local": False, "RunForward": False}
    yield Step("it is well again", well, "Motor.Ready", 5000, NOTHING_STARTED)


def _keypad_run() -> Iterator[Step]:
    yield Step("it is stopped", {"Fate.KeypadRun": True}, "Seen.Stopping", 1500, {
        "StopConfirmed": False, "Slots[0].StopAgain": False,
    })  # fmt: skip
    yield stand(NOTHING_STARTED)


def _keypad_stop() -> Iterator[Step]:
    yield Step("the block sees it", {"Fate.KeypadStop": True}, why("BY_ITSELF"), 3000, {"Running": False})
    yield stand({"Seen.Starts": 1, "Reason": "BY_ITSELF", "Motor.Diagnosis.StopReason": 46})
    yield Step("released", {"RunForward": False}, "Motor.Ready", 1500)
    yield Step("a new edge", {"RunForward": True}, "Motor.AtSpeed", 3000, RUNNING | {"Seen.Starts": 2})


def _not_ready() -> Iterator[Step]:
    yield Step("it is not ready", {"Fate.NotReady": True}, why("NOT_READY"), 2000, {"Ready": False})
    barred = f"{why('NOT_READY')} OR {why('NOT_STOPPED')}"  # the stop of before may still be proved
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows=NOTHING_STARTED | {barred: True})
    yield Step("ready again", {"Fate.NotReady": False, "RunForward": False}, "Motor.Ready", 2000)
    yield run()


def _warning(can: Ability) -> Iterator[Step]:
    shown = {"Motor.Diagnosis.WarningCode": 0} if can.warning else {}
    until, after = ("Motor.Warning", "NOT Motor.Warning") if can.shows("warning") else ("", "")
    if can.warning:
        until = f"Motor.Diagnosis.WarningCode = {can.warning}"
        after = f"({after or 'TRUE'}) AND (Motor.Diagnosis.WarningCode = 0)"
    yield Step("it warns and runs on", {"Fate.Warns": True}, until, 1000, RUNNING | {"Fault": False})
    yield Step("no more", {"Fate.Warns": False}, after, 1000, {"Seen.Starts": 1} | shown)


def _no_supply() -> Iterator[Step]:
    yield Step("SupplyOff stops it", {"SupplyOff": True}, TOLD, 500, {"Reason": "NO_SUPPLY"})
    yield Step("at standstill", {}, "Motor.StopConfirmed", 3000, STANDS | {"Reason": "NO_SUPPLY"})
    yield Step("its silence is no alarm", {"Fate.NoPower": True}, ms=2500, shows={
        "StopOverdue": False, "CommOk": False, "Reason": "NO_SUPPLY", "Bus.StopOverdue": False,
    })  # fmt: skip
    back: Shows = {"Fate.NoPower": False, "SupplyOff": False}
    yield Step("its supply is back", back, "Motor.StopConfirmed", 12000, STANDS | {"Seen.Starts": 1, "Reason": "HELD"})
    yield Step("released", {"RunForward": False}, "Motor.Ready", 1500)


def _stale() -> Iterator[Step]:
    yield Step("StaleMs is short", {"Pins.Settings.StaleMs": 600}, ms=300, shows=RUNNING)
    yield Step("a reply is late", {"Fate.Dumb": True}, why("SLOW_LINE"), 600, {
        "CommOk": True, "Running": True, "Motor.Diagnosis.StatusAgeMs": (301, 360),
    })  # fmt: skip
    yield Step("it stays away", {}, why("STALE"), 600, {
        "CommOk": False, "Running": False, "Motor.Diagnosis.StatusAgeMs": (601, 65535),
        "Motor.Diagnosis.MeasuresAgeMs": (500, 65535),
    })  # fmt: skip
    yield Step("it comes: the motor is stopped", {"Fate.Dumb": False}, "Motor.StopConfirmed", 4000, STANDS | {
        "Seen.Starts": 1,
    })  # fmt: skip


# ---------------------------------------------------------------- modes


def modes(can: Ability) -> Iterator[Scene]:
    """Who is in charge, settings that are missing or wrong."""
    yield scene("MonitorOnly", POWER, run(), *_monitor())
    yield scene("SpeedOnly", POWER, *_speed_only(can))
    yield scene("SpeedOnly, and a stop pin that flickers", POWER, *_calm(can))
    yield scene("a setting that is missing", POWER, *_missing())
    yield scene("a setting of 65535", POWER, *_spoilt())
    yield scene("another unit address", POWER, run(), *_address(can))
    yield scene("the drive's watchdog", POWER, run(), *_heartbeat(can))
    if second_hand(can.drive):
        yield scene("a map that nobody has checked", *_unchecked())
    if status(can.drive).verify:
        yield scene("a setting that gives the reference another meaning", POWER, run(), *_wrong_setting())
    if status(can.drive).forbids:
        yield scene("what forbids a start", POWER, *_forbidden())
    yield scene("nothing set: the usual values", *_unset())


def _monitor() -> Iterator[Step]:
    yield Step("it stops first", {"MonitorOnly": True}, TOLD, 500, {"Seen.StopKind": 1})
    yield Step("until that is proved", ms=200, shows={"Motor.Diagnosis.State": 0, "Seen.Driven": True})
    yield Step(
        "then it only reads", {}, "(Seen.Milli = 0) AND (Motor.Diagnosis.State = 5)", 4000, {"Reason": "MONITOR"}
    )
    yield Step("somebody else starts it", {"Fate.KeypadRun": True}, "Motor.Running", 1500, {"Reason": "MONITOR"})
    yield Step("nobody stops it", ms=1500, shows={"Seen.Driven": True, "Seen.Starts": 1, "Motor.Running": True})
    yield Step("in charge again: it is stopped", {"MonitorOnly": False}, "Motor.StopConfirmed", 4000, STANDS | {
        "Seen.Starts": 1, "Reason": "HELD",
    })  # fmt: skip


def _speed_only(can: Ability) -> Iterator[Step]:
    yield Step("the terminals start it", {"SpeedOnly": True}, why("SPEED_ONLY"), 2000, NOTHING_STARTED)
    yield Step("the reference is sent", {"SpeedReferenceHz": 25.0}, "Seen.References >= 1", 2000, NOTHING_STARTED)
    yield Step(
        "a run pin starts nothing", {"RunForward": True}, ms=500, shows=NOTHING_STARTED | {"Reason": "SPEED_ONLY"}
    )
    register = reference(can.drive).register
    lost: Shows = {"Fate.Skips": True, "Fate.Skipped": word(mark(register)), "SpeedReferenceHz": 26.0}
    yield Step("a reference is lost", lost, why("NO_REFERENCE"), 3000, {"Error": True, "ErrorID": 20})
    yield Step("it is sent again", {"Fate.Skips": False}, why("SPEED_ONLY"), 2000, NOTHING_STARTED)
    refuses: Shows = {"Fate.RefusesWrites": True, "SpeedReferenceHz": 24.0, ".Mark": "Seen.Writes"}
    yield Step("one that is refused is sent again now and then", refuses, ms=1000, shows={
        "Seen.Writes - Mark": (4, 10),
    }, brisk=False)  # fmt: skip
    yield Step("until it is taken", {"Fate.RefusesWrites": False}, why("SPEED_ONLY"), 2000, NOTHING_STARTED)
    yield Step("the terminals do", {"Fate.KeypadRun": True}, "Motor.Running", 1500, {"Reason": "SPEED_ONLY"})
    yield Step("nobody stops it", {"RunForward": False}, ms=1500, shows={"Seen.Driven": True, "Running": True})
    all_: Shows = {"Pins.StopAll": True, ".Mark": "Seen.References", "SpeedReferenceHz": 20.0}
    yield Step("StopAll", all_, ms=600, shows={"ErrorID": 53, "Seen.References": "Mark", "Reason": "STOP_ALL"})
    over: Shows = {"Pins.StopAll": False, "SpeedReferenceHz": 25.0, "Fate.KeypadRun": True}
    yield Step("over", over, "(Seen.References > Mark) AND Motor.Running", 2000)
    yield Step("a wrong reference is reported", {"SpeedReferenceHz": -1.0}, why("REFERENCE"), 500, {"ErrorID": 13})
    yield Step("so is what is missing", {"SpeedReferenceHz": 25.0, "StopWithinMs": 0}, why("MISSING"), 500)
    unread: Shows = {"Fate.RefusesReads": True, "Pins.Settings.StaleMs": 600, "StopWithinMs": 5000}
    yield Step("it cannot be read", unread, "NOT Motor.CommOk", 2000, {"Slots[0].Online": True})
    blind: Shows = {"SpeedReferenceHz": 15.0, ".Mark": "Seen.References"}
    yield Step("no reference is sent to a drive that nobody sees", blind, ms=1000, shows={"Seen.References": "Mark"})
    seen: Shows = {"Fate.RefusesReads": False, "Pins.Settings.StaleMs": 0}
    yield Step("it is read again", seen, "Motor.CommOk AND (Seen.References > Mark)", 2000, {"Seen.Starts": 0})
    yield Step("Enable FALSE does", {"Enable": False, "StopWithinMs": 5000}, "Seen.Stopping", 500)
    yield Step("at standstill", {}, "(Seen.Milli = 0) AND NOT Motor.Running", 3000, {"Seen.Starts": 0})


def _calm(can: Ability) -> Iterator[Step]:
    """After a stop pin the reference stays 0 for half a second; a pair whose last word is 0 does not show it."""
    if reference(can.drive).pair == "low_first":
        return
    speeds: Shows = {"SpeedOnly": True, "SpeedReferenceHz": 25.0}
    yield Step("the reference is sent", speeds, f"({why('SPEED_ONLY')}) AND (Seen.References > 0)", 2000)
    register = word(reference(can.drive).registers[-1])
    given = f"(Seen.LastRegister = {register}) AND (Seen.LastWord <> WORD#16#0000)"
    for _ in range(2):
        yield Step("Enable falls", {"Enable": False}, ms=100, shows={"Motor.Diagnosis.State": 6})
        yield Step("and rises: none yet", {"Enable": True}, ms=300, shows={given: False})
    yield Step("then the reference", {}, given, 600, NOTHING_STARTED)


def _missing() -> Iterator[Step]:
    bad: Shows = NOTHING_STARTED | {"Reason": "MISSING", "Ready": False}
    yield Step("StopWithinMs is 0", {"StopWithinMs": 0, "RunForward": True}, ms=500, shows=bad)
    yield Step("it is set", {"StopWithinMs": 5000, "RunForward": False}, "Motor.Ready", 1500)
    yield run()


def _spoilt() -> Iterator[Step]:
    for setting in ("TurnRoundMs", "LongestMs", "BootMs", "FollowWithinMs", "StaleMs"):
        yield Step(setting, {f"Pins.Settings.{setting}": 65535, "RunForward": True}, ms=200, shows=NOTHING_STARTED | {
            "Reason": "MISSING", "ErrorID": 72, "Error": True,
        })  # fmt: skip
        good: Shows = {f"Pins.Settings.{setting}": 0, "RunForward": False}
        yield Step("0 is the map's value", good, "Motor.Ready", 1500, {"ErrorID": 0})
    for within in (500, 65534):
        yield Step(f"StopWithinMs {within}", {"StopWithinMs": within}, ms=60, shows={"ErrorID": 0, "Ready": True})
    yield Step("StopWithinMs 65535", {"StopWithinMs": 65535}, ms=60, shows={"ErrorID": 72, "Reason": "MISSING"})


def _address(can: Ability) -> Iterator[Step]:
    first = serial(can.drive).lowest
    there: Shows = {"Address": first + 1}
    yield Step("not while it runs", there, ms=500, shows=RUNNING)
    yield Step("it is stopped before", {"RunForward": False}, "Seen.Milli = 0", 3000, {"Seen.Driven": False})
    yield Step("nobody answers there", {}, why("NO_REPLY"), 5000, {"Seen.Milli = 0": True, "CommOk": False})
    yield Step(
        "the drive has this address now", {"Fate.Unit": first + 1}, "Motor.Ready", 4000, STANDS | {"Seen.Starts": 1}
    )
    last = serial(can.drive).highest
    if last < 255:
        yield Step("one that no drive has", {"Address": last + 1}, why("MISSING"), 3000, {"Ready": False})
    served = {f"Slots[0].UnitAddress = {last}": True}
    yield Step("the highest", {"Address": last, "Fate.Unit": last}, "Motor.Ready", 4000, STANDS | served)
    yield Step("none", {"Address": 0}, why("MISSING"), 3000, {"Ready": False})


def _heartbeat(can: Ability) -> Iterator[Step]:
    sets: Shows = {"Pins.Settings.WatchdogMs": 1000, "Pins.Settings.RefreshMs": 65535}
    fed: dict[str, tuple[str, Shows]] = {
        "reference": ("the reference is refreshed for it", {"Seen.References >= 4": True}),
        "polls": ("the reads feed it", {"Seen.References < 4": True}),
        "run": ("run is sent again for it, and starts nothing", {"Seen.Starts": 1}),
    }
    name, shows = fed[can.feeds]
    yield Step(name, sets, ms=3000, shows=RUNNING | shows)
    if can.fed_at_rest:
        yield Step("it is stopped", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS)
        yield Step("a reference of 0 feeds it at standstill", {".Mark": "Seen.References"}, ms=3000, shows=STANDS | {
            "Seen.References - Mark": (8, 12), "Seen.Starts": 1, "Error": False,
        })  # fmt: skip
        yield Step("it runs again", {"RunForward": True}, "Motor.Running", 2000, {"Seen.Starts": 2})
    rarely: Shows = {"Fate.Dumb": True} if can.feeds == "polls" else {"Pins.Settings.WatchdogMs": 30}
    yield Step("too rarely for it", rarely, why("HEARTBEAT"), 1500, {"Running": True})


def _unchecked() -> Iterator[Step]:
    yield Step("nothing starts", {"ManualChecked": 0}, why("UNCHECKED"), 2000, {"Ready": False})
    yield Step("not by an edge either", {"RunForward": True}, ms=500, shows=NOTHING_STARTED | {"Reason": "UNCHECKED"})


def _wrong_setting() -> Iterator[Step]:
    yield Step("it is stopped", {"RunForward": False}, "Motor.StopConfirmed", 3000)
    yield Step("set otherwise, and restarted", {"Fate.WrongSetting": True, "Pins.Restart": True}, ms=20)
    yield Step("the block sees it", {"Pins.Restart": False}, why("SETTING"), 3000, {"Ready": False})
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows={"Seen.Starts": 1, "Reason": "SETTING"})


def _forbidden() -> Iterator[Step]:
    yield Step("the drive shows it", {"Fate.Forbids": True}, why("FORBIDDEN"), 2000, {"Ready": False, "Error": False})
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows=NOTHING_STARTED | {"Reason": "FORBIDDEN"})
    over: Shows = {"Fate.Forbids": False, "RunForward": False}
    yield Step("it is over", over, "Motor.Ready", 2000, {"Reason": "READY"})
    yield run()
    yield Step("what runs goes on", {"Fate.Forbids": True}, ms=1500, shows=RUNNING | {"Seen.Starts": 1})


def _unset() -> Iterator[Step]:
    sets: Shows = {"Pins.Settings.TurnRoundMs": 0, "Pins.Settings.LongestMs": 0, "Pins.KeepsSilence": False}
    yield Step("power-up", sets, "Motor.Ready", 4000, brisk=False)
    yield run()._replace(brisk=False)
    yield Step("the turn-round is learned", ms=1000, shows={"(Motor.Diagnosis.TurnRoundMs <= 60)": True}, brisk=False)
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS)
