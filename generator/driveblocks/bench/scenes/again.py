"""Scenes of a PLC that begins anew in the midst of something: nothing of it is left."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import mark
from driveblocks.bench.scenes.motor import NOTHING_STARTED, POWER, RUNNING, STANDS, run
from driveblocks.bench.scenes.scene import Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import Script
from driveblocks.maps.model import Drive
from driveblocks.maps.rivals import first_reads
from structured_text.language.writing import word

AT_REST: Shows = {
    "Enable": True, "RunForward": False, "JogForward": False, "QuickStop": False, "CoastStop": False,
    "FaultReset": False,
    "MonitorOnly": False, "SpeedOnly": False, "Pins.StopAll": False, "SpeedReferenceHz": 30.0, "Fate.Local": False,
    "Fate.RunsOn": False, "Fate.Skips": False, "Fate.RefusesWrites": False, "Fate.Dumb": False, "Fate.Cause": False,
    "Pins.Restart": False,
}  # fmt: skip
"""All pins as in the beginning, and nothing happens to the drive any more."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    yield script(drive, stem, "MotorAgain", "a PLC that begins anew in the midst of something", scenes(Ability(drive)))


def scenes(can: Ability) -> Iterator[Scene]:
    for words, steps in _midst(can):
        yield scene(f"a restart {words}", POWER, *steps, *_restart(can))
    yield scene("a restart with a fault", POWER, *_fault(can))
    yield scene("a restart while its block is not called", POWER, run(), *_not_called())
    yield scene("a restart that leaves the motor to its terminals", POWER, run(), *_terminals())
    if not first_reads(can.drive):  # whose drive gets no stop before it has said what it is
        yield scene("a Restart that stays", POWER, run(), *_stays())


def _midst(can: Ability) -> Iterator[tuple[str, list[Step]]]:
    """What is under way."""
    yield "while it runs", [run()]
    yield "while it ramps down", [run(), Step("released", {"RunForward": False}, "Seen.Stopping", 300)]
    if can.can("jog_forward"):
        yield "while it jogs", [Step("it jogs", {"JogForward": True}, "Seen.Milli > 2000", 1500)]
    register = can.run.last.register
    lost: Shows = {"Fate.Skips": True, "Fate.Skipped": word(mark(register)), "RunForward": True}
    yield "while a start waits for its answer", [Step("no answer", lost, why("STARTING"), 500), Step("", ms=100)]
    yield (
        "after a start without an answer",
        [Step("it is refused", {"Fate.RefusesWrites": True, "RunForward": True}, why("REFUSED"), 1500)],
    )
    ignored: Shows = {"Fate.Local": True, "RunForward": True, "Pins.Settings.FollowWithinMs": 500}
    yield "after a start that was not followed", [Step("nothing happens", ignored, why("NOT_FOLLOWED"), 3000)]
    yield "while it only reads", [Step("MonitorOnly", {"MonitorOnly": True}, why("MONITOR"), 2000)]
    speeds: Shows = {"SpeedOnly": True, "SpeedReferenceHz": 25.0}
    yield (
        "while it only gives the speed",
        [
            Step("SpeedOnly", speeds, f"({why('SPEED_ONLY')}) AND (Seen.References > 0)", 2000),
            Step("the terminals run it", {"Fate.KeypadRun": True}, "Motor.Running", 1500),
        ],
    )
    yield "while a stop pin is TRUE", [run(), Step("CoastStop", {"CoastStop": True}, "NOT Seen.Driven", 1000)]
    yield "while all are stopped", [run(), Step("StopAll", {"Pins.StopAll": True}, why("STOP_ALL"), 500)]
    runs_on: Shows = {"RunForward": False, "Fate.RunsOn": True, "StopWithinMs": 600}
    yield "while a stop is overdue", [run(), Step("it runs on", runs_on, "Motor.StopOverdue", 2000)]
    yield "while it is silent", [run(), Step("its answers are lost", {"Fate.Dumb": True}, why("OFFLINE"), 3000)]


def _restart(can: Ability) -> Iterator[Step]:
    """Stopped, with nothing of before; then all is as after power-up."""
    begin: Shows = {"Pins.Restart": True, ".Mark": "Seen.Starts"}
    yield Step("Restart", begin, ms=40, shows={
        "Reason": "RESTARTED", "CommOk": False, "StopConfirmed": False, "Ready": False, "Running": False,
        "Motor.Diagnosis.StopReason": 10, "Motor.Diagnosis.CommandNotFollowed": False,
    })  # fmt: skip
    if not first_reads(can.drive):
        yield Step("over: a stop at once", AT_REST | {"StopWithinMs": 5000}, "Seen.UntoldMs <= 40", 120)
    yield Step("nothing asked", AT_REST | {"StopWithinMs": 5000}, "Motor.Ready", 4000, STANDS | {
        "Seen.Starts": "Mark", "Reason": "READY", "Error": False, "StopOverdue": False, "Motor.Diagnosis.State": 1,
        "Motor.Diagnosis.StopReason": 10, "Motor.Diagnosis.Starts = 0": True,
        "Slots[0].ProvedStill": True, "Slots[0].JogStop = 0": True,
        "Slots[0].ResetAsked": False, "Slots[0].Tripped": False,
        "Slots[0].Ask[1].Number": "Slots[0].Answer[1].Number", "Slots[0].Ask[2].Number": "Slots[0].Answer[2].Number",
    })  # fmt: skip
    yield Step("no stop comes after", {".Mark": "Seen.Stops"}, ms=700, shows={"Seen.Stops": "Mark", "Ready": True})
    stopped: Shows = {"Seen.StopKind": 1, "Motor.Diagnosis.StopReason": 6}
    if can.drive.operation.in_one_word:  # of others the first write of a start may be the word of a stop
        stopped["Seen.Stops - Mark"] = (1, 2)
    yield Step("it starts as ever", {"RunForward": True, ".Mark": "Seen.Stops"}, "Motor.AtSpeed", 3000, RUNNING | {
        "Motor.Diagnosis.StopReason": 10, "ABS(Seen.StartMilli - 30000) <= 200": True,
    })  # fmt: skip
    yield Step("and stops by one stop", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS | stopped)


def _not_called() -> Iterator[Step]:
    gone: Shows = {"Pins.NoDrive": True}
    yield Step("its block is not called", gone, ms=700, shows={"Slots[0].Unattended": False, "Seen.Driven": True})
    yield Step("Restart", {"Pins.Restart": True}, ms=40)
    yield Step("its time begins anew", {"Pins.Restart": False}, ms=700, shows={"Slots[0].Unattended": False})
    yield Step("the block is back", AT_REST | {"Pins.NoDrive": False}, "Motor.Ready", 5000, STANDS | {"Seen.Starts": 1})


def _terminals() -> Iterator[Step]:
    """Whoever gives only the speed from now on does not wait for standstill: the terminals may run it."""
    speeds: Shows = {"Pins.Restart": True, "SpeedOnly": True, "RunForward": False, "Fate.RunsOn": True}
    yield Step("Restart", speeds, ms=40, shows={"Reason": "RESTARTED"})
    yield Step("over", {"Pins.Restart": False}, f"({why('SPEED_ONLY')}) AND (Motor.Diagnosis.State = 6)", 1500, {
        "Seen.Driven": True, "Seen.Starts": 1,
    })  # fmt: skip


def _fault(can: Ability) -> Iterator[Step]:
    yield Step("it trips", {"Fate.Trips": can.codes[1], "FaultReset": False}, "Motor.Fault", 1500, NOTHING_STARTED)
    if can.can("fault_reset"):
        refused: Shows = {"Fate.RefusesWrites": True, "FaultReset": True}
        yield Step("a reset is asked for", refused, ms=200, shows={"Seen.Resets": 0, "Fault": True})
    yield Step("Restart", {"Pins.Restart": True}, ms=40, shows={"Reason": "RESTARTED"})
    over: Shows = {"Pins.Restart": False, "Fate.RefusesWrites": False}
    yield Step("the reset is forgotten, its pin held", over, ms=2000, shows={
        "Fault": True, "Seen.Resets": 0, "Reason": "FAULT", "Ready": False, "Seen.Stops >= 1": True,
        "FaultCode": can.code, "Motor.Diagnosis.FirstFaultCode": can.code, "StopOverdue": False,
        "Motor.Diagnosis.FaultBack1": can.code,
    })  # fmt: skip
    yield Step("reset on its keypad", {"Fate.KeypadReset": True, "FaultReset": False}, "Motor.Ready", 3000, STANDS)


def _stays() -> Iterator[Step]:
    yield Step("for long", {"Pins.Restart": True}, ms=1500, shows={
        "Reason": "RESTARTED", "CommOk": False, "StopConfirmed": False, "Ready": False, "Seen.Starts": 1,
    })  # fmt: skip
    yield Step("it is stopped all the same", {}, "Seen.Milli = 0", 3000, {"Seen.Driven": False, "Reason": "RESTARTED"})
    over: Shows = {"Pins.Restart": False, "RunForward": False}
    yield Step("it is over", over, "Motor.Ready", 4000, STANDS | {"Seen.Starts": 1})
