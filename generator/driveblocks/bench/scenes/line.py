"""Scenes of the line: two motors, a slot or an address for two, other masters, ports, calls that stay away."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.motor import NOTHING_STARTED, POWER, RUNNING, STANDS, TOLD, run, stand
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.meaning.serial import serial


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    can = Ability(drive)
    yield script(
        drive, stem, "MotorLine", "two motors on a line, and what goes wrong there", lines(can), More(other=True)
    )


def lines(can: Ability) -> Iterator[Scene]:
    unit = serial(can.drive).lowest
    if serial(can.drive).highest > unit:
        yield scene("StopAll stops two motors", POWER, run(), *_stop_all(unit + 1))
        yield scene("one dead drive, and the other", POWER, run(), *_one_dead(unit + 1))
    yield scene("StopAll stops a motor whose block is not called", POWER, run(), *_stop_uncalled())
    yield scene("two blocks on one slot", POWER, run(), *_shared(unit))
    yield scene("one address twice", POWER, *_doubled(unit))
    yield scene("a line that is not called", POWER, run(), *_no_line())
    yield scene("a drive block that is not called", POWER, run(), *_no_drive())
    yield scene("a port in trouble", POWER, run(), *_port())
    yield scene("a port that is busy", POWER, run(), *_busy())
    yield scene("a port that is stuck", POWER, run(), *_stuck())
    yield scene("a port that hears itself", *_echo())
    yield scene("no time passes", POWER, run(), *_time())
    yield scene("a stop that is refused", POWER, run(), *_refused_stop())
    yield scene("a slow line that keeps the silence itself", *_slow())
    if len(serial(can.drive).modes) > 1:
        yield scene("MODBUS ASCII", *_ascii())
    yield scene("another master", POWER, *_foreign())
    yield scene("a scan that is too long", POWER, *_late_scan())  # the last: it is reported for ten seconds


def _two(unit: int) -> Step:
    """The second motor runs, too."""
    sets: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": unit}
    return Step("a second drive block", sets, "Other.Ready", 4000, {"Running": True, "Seen.Starts": 1})


def _stop_all(unit: int) -> Iterator[Step]:
    yield _two(unit)
    yield Step(
        "both run",
        {"Pins.OtherRuns": True},
        "ABS(OtherSeen.Milli - 20000) <= 200",
        3000,
        {"Bus.OnlineCount": 2, "Running": True},
    )
    yield Step("StopAll", {"Pins.StopAll": True}, "Motor.StopConfirmed AND Other.StopConfirmed", 4000, {
        "Seen.Driven": False, "OtherSeen.Driven": False, "Reason": "STOP_ALL", "Other.Reason = 22": True,
    })  # fmt: skip
    yield Step("it is over: nothing starts by itself", {"Pins.StopAll": False}, ms=800, shows={
        "Seen.Starts": 1, "OtherSeen.Starts": 1, "StopConfirmed": True, "Reason": "HELD",
    })  # fmt: skip
    yield Step("one of them again", {"RunForward": False}, "Motor.Ready", 500)
    yield Step("by a new edge", {"RunForward": True}, "Motor.AtSpeed", 3000, {"Seen.Starts": 2, "OtherSeen.Starts": 1})


def _stop_uncalled() -> Iterator[Step]:
    """By a stop of the line's own, at once."""
    gone: Shows = {"Pins.NoDrive": True, "Pins.AttendMs": 5000}
    yield Step("its block is not called", gone, ms=100, shows={"Seen.Driven": True, "Slots[0].Unattended": False})
    all_: Shows = {"Pins.StopAll": True, ".Mark": "Seen.Stops"}
    yield Step("StopAll", all_, "Seen.Stops > Mark", 300, {"Slots[0].Unattended": False})
    back: Shows = {"Pins.NoDrive": False, "Pins.StopAll": False, "RunForward": False}
    yield Step("the block is back", back, "Motor.Ready", 5000, STANDS | {"Seen.Starts": 1})


def _one_dead(unit: int) -> Iterator[Step]:
    yield _two(unit)
    yield Step("both run", {"Pins.OtherRuns": True}, "ABS(OtherSeen.Milli - 20000) <= 200", 3000)
    yield Step("one is dead", {"Fate.Cut": True}, why("OFFLINE"), 4000, {"Bus.OnlineCount": 1, "Bus.AllOnline": False})
    yield Step("the other runs on", ms=2000, shows={
        "Other.Running": True, "Other.CommOk": True, "OtherSeen.Starts": 1, "OtherSeen.Driven": True,
        "Other.StopOverdue": False,
    })  # fmt: skip
    yield Step("and obeys", {"Pins.OtherRuns": False}, "Other.StopConfirmed", 3000, {"OtherSeen.Driven": False})


def _shared(unit: int) -> Iterator[Step]:
    sets: Shows = {"Pins.OtherOn": True, "Pins.OtherShares": True, "Pins.OtherUnit": unit}
    yield Step("a second block", sets, why("SHARED"), 500, {"Error": True, "ErrorID": 56})
    yield Step("the line stops the motor", {}, "Seen.Milli = 0", 3000, {
        "Seen.Driven": False, "Bus.ErrorID": 56, "StopOverdue": True,
    })  # fmt: skip
    yield Step("an edge starts nothing", {"Pins.OtherRuns": True}, ms=500, shows={"Seen.Starts": 1})
    gone: Shows = {"Pins.OtherOn": False, "Pins.OtherShares": False, "RunForward": False}
    yield Step("it is gone", gone, "Motor.StopConfirmed AND Motor.Ready", 4000, {"ErrorID": 0, "Seen.Starts": 1})


def _doubled(unit: int) -> Iterator[Step]:
    sets: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": unit}
    yield Step("on another slot", sets, why("LINE"), 1000, {"Bus.Error": True, "Bus.ErrorID": 55, "Ready": False})
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows=NOTHING_STARTED)


def _foreign() -> Iterator[Step]:
    yield Step("a few frames are borne", {"Fate.Foreign": 3}, ms=800, shows={"Reason": "READY", "Bus.ForeignFrames": 3})
    yield Step(
        "more are not", {"Fate.Foreign": 5}, why("FOREIGN"), 3000, {"Ready": False, "Bus.ForeignFrames >= 6": True}
    )
    yield Step("an edge starts nothing", {"RunForward": True}, ms=500, shows=NOTHING_STARTED | {"Reason": "FOREIGN"})
    yield Step(
        "Acknowledge", {"Pins.Acknowledge": True, "RunForward": False}, "Motor.Ready", 2000, {"Bus.ForeignFrames": 0}
    )
    yield run()
    yield Step("a few are borne while it runs", {"Fate.Foreign": 4}, ms=1500, shows=RUNNING | {"Seen.Starts": 1})


def _late_scan() -> Iterator[Step]:
    yield Step("longer than promised", {"Pins.ElapsedMs": 80}, ms=40)
    yield Step("it says so", {"Pins.ElapsedMs": SCAN_MS}, why("LATE_SCAN"), 500, {"Bus.LateScans >= 1": True})
    yield run()


def _no_line() -> Iterator[Step]:
    yield Step("nobody serves the slot", {"Pins.NoLine": True}, why("NO_LINE"), 3000, {
        "CommOk": False, "StopOverdue": True, "Running": False, "Seen.Driven": True, ".WaitedMs": (1960, 2080),
    })  # fmt: skip
    yield Step("the line is back: the motor is stopped", {"Pins.NoLine": False}, "Motor.StopConfirmed", 4000, STANDS | {
        "Seen.Starts": 1, "Reason": "HELD",
    })  # fmt: skip


def _no_drive() -> Iterator[Step]:
    for _ in range(2):
        yield Step("for a moment", {"Pins.NoDrive": True}, ms=600, shows={"Slots[0].Unattended": False})
        yield Step(
            "called again", {"Pins.NoDrive": False}, ms=100, shows={"Slots[0].Unattended": False, "Running": True}
        )
    yield Step("the line notices", {"Pins.NoDrive": True}, "Slots[0].Unattended", 1500, {"Seen.Driven": True})
    yield Step(
        "and stops the motor by itself",
        {},
        "Seen.Milli = 0",
        3000,
        {"Seen.Driven": False, "Slots[0].LastErrorID = 59": True},
    )
    yield Step("the block is back", {"Pins.NoDrive": False}, "Motor.StopConfirmed", 4000, STANDS | {"Seen.Starts": 1})


def _port() -> Iterator[Step]:
    yield Step("a frame is not sent", {"Pins.PortErrorID": 7}, ms=200, shows={"Bus.ErrorID": 57, "Running": True})
    yield Step("it does not work at all", {"Fate.Cut": True}, why("LINE"), 3000, {"Bus.Error": True, "Ready": False})
    yield Step("it works again", {"Pins.PortErrorID": 0, "Fate.Cut": False}, "Motor.StopConfirmed", 5000, STANDS | {
        "Seen.Starts": 1, "Bus.Error": False,
    })  # fmt: skip


def _busy() -> Iterator[Step]:
    yield Step("for a moment", {"Pins.TxBusy": True, ".Mark": "Bus.Timeouts"}, ms=200, shows={"Running": True})
    yield Step("it takes characters again, and nothing was lost", {"Pins.TxBusy": False}, ms=500, shows=RUNNING | {
        "Seen.Starts": 1, "Bus.Timeouts = Mark": True,
    })  # fmt: skip


def _stuck() -> Iterator[Step]:
    yield Step("the contact is closed", {"Pins.HardReset": True}, ms=50, shows={"HardStop.HardStopOk": True})
    stuck: Shows = {"Pins.TxBusy": True, "RunForward": False, "Pins.HardReset": False}
    yield Step("no stop is sent: it is overdue", stuck, "Motor.StopOverdue", 3000, {
        "(WaitedMs >= Bus.WorstStopMs) AND (WaitedMs <= Bus.WorstStopMs + 100)": True,
        "Seen.Driven": True, "HardStop.HardStopOk": False, "Bus.StopOverdue": True,
    })  # fmt: skip
    yield Step("it is sent", {"Pins.TxBusy": False}, "Motor.StopConfirmed", 5000, STANDS)


def _echo() -> Iterator[Step]:
    yield Step("from power-up on", {"Fate.Echo": True}, "Motor.Ready", 4000, {"Bus.Echo": 2, "Error": False})
    yield run()
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS | {"Bus.ForeignFrames": 0})


def _time() -> Iterator[Step]:
    yield Step("ElapsedMs is 0", {"Pins.ElapsedMs": 0}, why("LINE"), 3000, {"Bus.ErrorID": 58})
    yield Step("nothing but stops is sent", {".Mark": "Seen.Reads"}, ms=200, shows={"Seen.Reads": "Mark"})
    yield Step("it moves again", {"Pins.ElapsedMs": SCAN_MS}, "Motor.StopConfirmed", 5000, STANDS | {"Seen.Starts": 1})


def _refused_stop() -> Iterator[Step]:
    yield Step("it keeps asking", {"Fate.RefusesWrites": True, "RunForward": False}, ms=1500, shows={
        "StopConfirmed": False, "Seen.Driven": True, "Slots[0].Refusals >= 2": True,
    })  # fmt: skip
    yield Step("until it obeys", {"Fate.RefusesWrites": False}, "Motor.StopConfirmed", 4000, STANDS)


def _slow() -> Iterator[Step]:
    sets: Shows = {"Pins.BitRate": 9600, "Pins.KeepsSilence": False}
    yield Step("power-up", sets, "Motor.Ready", 4000)
    yield run()
    yield Step("it stops", {"RunForward": False}, TOLD, 800, {"Seen.StopKind": 1})
    yield stand()


def _ascii() -> Iterator[Step]:
    yield Step("power-up", {"Pins.Ascii": True}, "Motor.Ready", 3000, {"Bus.Bad": 0})
    yield run()
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS | {"Bus.Bad": 0})
