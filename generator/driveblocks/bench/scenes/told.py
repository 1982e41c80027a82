"""Scenes of the slot: what a drive block hands to its line, and memory that is not blank when the PLC begins."""

from collections.abc import Iterator, Mapping

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import mark
from driveblocks.bench.scenes.motor import NOTHING_STARTED, RUNNING, STANDS, STARTED
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, Value, scene, script
from driveblocks.bench.script import Script
from driveblocks.maps.form import is_bit
from driveblocks.maps.model import Command, Drive
from driveblocks.maps.plan import busy
from driveblocks.maps.rivals import first_reads, refusals
from driveblocks.meaning.measure import measures
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.reference.command import Commands, kept
from structured_text.language.writing import word

KEPT = 0x5A5A
"""What is in a command register beside the commands' own bits."""
SETTINGS: dict[str, int] = {
    "TurnRoundMs": 35, "LongestMs": 70, "BootMs": 7000, "FollowWithinMs": 2000, "StaleMs": 3000, "RefreshMs": 700,
}  # fmt: skip
USUAL: dict[str, int] = {"LongestMs": 500, "BootMs": 10000}
"""What replaces settings that are 0, where neither map nor drive says it."""


SAID = " AND ".join(
    f"(Motor.Diagnosis.{name} = Slots[0].{name})"
    for name in ("TurnRoundMs", "LongestReplyMs", "StopAloneMs", "WorstStopMs")
)
"""The diagnosis shows what the line knows, which is a scan ahead of it."""
MORE = More(
    blocks={"Learned": ("UINT", "twice the longest reply, and 20 ms")},
    calls=("Learned := 2 * Slots[0].LongestReplyMs + 20;",),
)


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    yield script(
        drive, stem, "MotorSlot", "what the line gets to know, and memory that is not blank", scenes(drive), MORE
    )


def scenes(drive: Drive) -> Iterator[Scene]:
    can = Ability(drive)
    yield scene("memory that is not blank", *_not_blank(drive))
    yield scene("settings in use", *_settings(can))
    yield scene("settings left to the block", *_unset(can))


def known(drive: Drive) -> Shows:
    """What a slot holds of a family, whatever its motor does."""
    form = refusals(drive)
    stop, jog = _command(drive, "stop"), _command(drive, "jog_stop")
    found: Shows = {
        "UnitAddress": serial(drive).lowest, "StopWithinMs": 5000, "HasStop": True, "SupplyOff": False,
        "SilenceMs": int(serial(drive).silence_ms), "PollEveryMs": 0,
        "ExceptionAdd": form.added, "ErrorFunction": form.function or 0,
        "ErrorAddress": word(form.address or 0), "BusyReason": busy(drive), "TwoByteCount": form.two_byte_count,
        "Ask[0].FunctionCode": _write(drive, stop.register), "Ask[0].Quantity": 1,
        "Ask[0].Address": word(stop.register),
        "StopRegister": word(stop.register), "StopWord": word(_word(drive, stop)),
    }  # fmt: skip
    if jog is not stop:
        found |= {"JogStopRegister": word(jog.register), "JogStopWord": word(_word(drive, jog))}
    return found


def _command(drive: Drive, does: str) -> Command:
    found = [one for each in (does, "stop") for one in drive.operation.commands if one.does == each]
    return found[0]


def _write(drive: Drive, register: int) -> int:
    row = drive.register_at(register, "w")
    if is_bit(register):
        return 5
    return 6 if any(function.code == 6 for function in drive.functions) and not (row and row.words) else 16


def _word(drive: Drive, command: Command) -> int:
    """The word of a command, beside what is kept."""
    if drive.operation.in_one_word:
        return Commands(drive).word(command, {command.register: KEPT})
    if command.value is not None:
        return command.value
    beside = {bit for bit in kept(drive)[command.register] if KEPT >> bit & 1}
    return sum(1 << bit for bit in beside.union(*command.set))


def _slot(shows: Mapping[str, Value]) -> Shows:
    """What must be so in the slot; words and numbers of a byte are compared as they are."""
    return dict(_seen(f"Slots[0].{key}", value) for key, value in shows.items())


def _seen(key: str, value: Value) -> tuple[str, Value]:
    return (key, value) if isinstance(value, bool | tuple) else (f"{key} = {value}", True)


def _junk(shows: Shows) -> Shows:
    """Something else in each of these fields."""
    return {f"Slots[0].{key}": _other(value) for key, value in shows.items()}


def _other(value: Value) -> Value:
    if isinstance(value, bool):
        return not value
    return word(0x1234) if isinstance(value, str) else 77


LEFT: Shows = {
    "Online": True, "Unattended": True, "StopOverdue": True, "StopAll": True, "ScanLate": True,
    "Shared": True, "StopConfirmed": True, "EndsByAnswer": True, "ProvedStill": True, "Tripped": True,
    "StopAgain": True, "ResetAsked": True, "Once": True, "Begins": True, "JogStop": 2,
    "ParameterCleared": 9, "OtherQuantity": 3,
    "LineErrorID": 55, "PollCount": 7, "LongestReplyMs": 900, "Replies": 200, "SinceStoreMs": 65535, "Alive": 33,
    "Ask[1].Number": 9, "Ask[1].FunctionCode": 6, "Ask[1].Quantity": 9, "Ask[2].Number": 9, "Ask[2].FunctionCode": 6,
    "Ask[2].Quantity": 9, "Ask[3].Number": 35, "Ask[0].Number": 12, "Answer[0].Number": 13,
    "Answer[1].Tries": 3, "Answer[3].Tries": 3,
}  # fmt: skip
"""What may be in a slot that nobody has cleared: a drive online, a command and a parameter that wait."""


def _not_blank(drive: Drive) -> Iterator[Step]:
    left = {f"Slots[0].{key}": value for key, value in LEFT.items()}
    at_once = known(drive)
    if first_reads(drive):
        del at_once["Ask[0].FunctionCode"]  # no stop may be sent before the drive has said what it is
    held: Shows = left | _junk(known(drive)) | {"Pins.Settings.KeepWord": word(KEPT)}
    yield Step("memory holds what was there before", held, ms=60, shows=_slot(at_once) | NOTHING_STARTED | {
        "StopConfirmed": False, "Seen.Others": 0,
    })  # fmt: skip
    yield Step("nothing of it counts", {}, "Motor.Ready", 2000, STANDS | NOTHING_STARTED | _slot({
        "Ask[0].Number > 12": True, "Answer[0].Tries >= 1": True,
        "Unattended": False, "StopOverdue": False, "StopAll": False, "ScanLate": False,
        "Shared": False, "StopConfirmed": True, "ProvedStill": True,
        "Tripped": False, "JogStop": 0, "LineErrorID": 0, "LongestReplyMs <= 60": True, "Replies < 100": True,
        "SinceStoreMs <= WaitedMs + 100": True, "ResetAsked": False,
    } | _nothing_waits()))  # fmt: skip
    run = _command(drive, "run_forward")
    speed = reference(drive).register
    yield Step("it runs as ever", {"RunForward": True, "Pins.Settings.RefreshMs": 65535}, STARTED, 3000, {
        "Seen.Starts": 1, "Seen.LastRegister = " + word(mark(run.register)): True,
    })  # fmt: skip
    yield Step("what the line knows then", ms=20, shows=_slot(known(drive) | {
        "Once": run.register != speed, "Begins": run.register != speed, "ResetAsked": False,
        "Ask[1].FunctionCode": _write(drive, run.register), "Ask[1].Quantity": 1, "Ask[1].Address": word(run.register),
        "StopConfirmed": False, "ProvedStill": False,
        "EndsByAnswer": False,
    } | _nothing_waits()))  # fmt: skip
    yield Step("up to its speed", {}, "Motor.AtSpeed", 3000, RUNNING | {"Seen.Starts": 1})
    yield Step("another speed", {"SpeedReferenceHz": 35.0}, "ABS(Seen.Milli - 35000) <= 200", 2000, _slot({
        "Once": False, "Begins": False, "Ask[1].Address": word(speed),
    }))  # fmt: skip
    stop = _command(drive, "stop")
    yield Step("and stops", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS | {
        f"Seen.LastWord = {word(_word(drive, stop))}": True, "Seen.Others": 0,
    } | _slot(_nothing_waits()))  # fmt: skip


def _nothing_waits() -> Shows:
    return {f"Ask[{box}].Number": f"Slots[0].Answer[{box}].Number" for box in (1, 2)}


def _settings(can: Ability) -> Iterator[Step]:
    sets: Shows = {f"Pins.Settings.{key}": value for key, value in SETTINGS.items()}
    yield Step("all are set", sets | {"StopWithinMs": 4000}, "Motor.Ready", 3000, _slot({
        key: SETTINGS[key] for key in ("TurnRoundMs", "LongestMs", "BootMs")
    } | {"StopWithinMs": 4000}))  # fmt: skip
    yield Step("the diagnosis says it", {}, SAID, 200, _diagnosis(can) | {
        "Motor.Diagnosis.TurnRoundMs": SETTINGS["TurnRoundMs"],
    })  # fmt: skip
    yield Step("LongestMs is at least TurnRoundMs", {"Pins.Settings.TurnRoundMs": 90}, ms=60, shows=_slot({
        "TurnRoundMs": 90, "LongestMs": 90,
    }))  # fmt: skip


def _diagnosis(can: Ability) -> Shows:
    """What the line knows and the drive block shows, once SAID."""
    found: Shows = {f"Slots[0].{name} = Bus.{name}": True for name in ("StopAloneMs", "WorstStopMs")}
    found |= {"Motor.Diagnosis.StatusAgeMs": (0, 400), "Motor.Diagnosis.State": 1}
    found["(Motor.Diagnosis.StopKind = 1) OR (Motor.Diagnosis.StopKind = 4)"] = True
    if measures(can.drive) and can.turns == 1:
        found["Motor.Diagnosis.MeasuresAgeMs"] = (0, 600)
    return found


def _unset(can: Ability) -> Iterator[Step]:
    sets: Shows = {f"Pins.Settings.{key}": 0 for key in SETTINGS}
    learned = "Slots[0].TurnRoundMs = MAX(50, Learned)"
    yield Step("none is set", sets, ms=100, shows=_slot({**USUAL, "TurnRoundMs": 500}))
    yield Step("it learns how fast the drive is", {}, "Slots[0].Replies >= 20", 4000)
    yield Step("from then on", {}, "Motor.Ready", 4000, {learned: True} | _slot(USUAL))
    yield Step("the diagnosis says it", {}, SAID, 200, {learned: True} | _slot(USUAL) | _diagnosis(can))
    yield Step("replies come later", {"Fate.HoldMs": 40}, ms=600, shows={learned: True, "CommOk": True})
    yield Step("so late that nobody can learn it", {"Slots[0].LongestReplyMs": 241}, ms=60, shows=_slot({
        "TurnRoundMs": 500,
    }))  # fmt: skip
