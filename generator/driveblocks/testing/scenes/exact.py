"""Scenes in scans of a millisecond: times that are kept to the millisecond, and parts of the control by themselves."""

from collections.abc import Iterator

from driveblocks.maps.model import Drive
from driveblocks.testing.scenes.motor import POWER, STANDS, run
from driveblocks.testing.scenes.reason import REASONS
from driveblocks.testing.scenes.scene import More, Scene, Shows, Step, scene, script, why
from driveblocks.testing.script import SCAN_MS, Script

MORE = More(
    blocks={
        "Command": ("VFD_Run", "under test: the command in hand"),
        "Known": ("VFD_Seen", "what it is told of the drive"),
        "Wish": ("VFD_Asked", "what it is told of the pins"),
        "Stage1": ("UINT", "the state that it is told"),
        "Answers": ("UINT", "Number that is answered"),
        "Anew": ("BOOL", "its command has just been posted"),
    },
    calls=(
        "Command(Seen := Known, Asked := Wish, CommLost := FALSE, State := Stage1, Order := 5, Sent := 5,",
        "  SentWord := WORD#16#0000, StepNumber := 0, Number := 7, Posted := Anew, Begun := Anew, Dropped := FALSE,",
        "  AskNumber := 7, Answer := Answers, AnswerErrorID := 20, KnowsDirection := FALSE, FollowWithinMs := 1000,",
        "  StepLast := 0, StepReached := TRUE, StepHoldMs := 0);",
        "Anew := FALSE;",
    ),
)
MS: Shows = {"Pins.ElapsedMs": 1}
"""From here a scan is a millisecond."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program."""
    yield script(drive, stem, "MotorExact", "times to the millisecond", scenes(drive), MORE)


def _after(least: int, most: int) -> tuple[int, int]:
    """So many scans since the begin of a step."""
    return SCAN_MS * least, SCAN_MS * most


def scenes(drive: Drive) -> Iterator[Scene]:
    """All of them."""
    yield scene("how often the reference is sent", POWER, run(), *_refresh(drive))
    yield scene("when the line stops a motor by itself", POWER, run(), *_attend())
    yield scene("when a stop is overdue", POWER, run(), *_overdue())
    yield scene("when a status is too old", POWER, run(), *_stale())
    yield scene("when a start is not followed", POWER, *_follow())
    yield scene("which call comes too late", POWER, *_restart())
    yield scene("a motor that ran before its command was acknowledged", *_ran())


def _refresh(drive: Drive) -> Iterator[Step]:
    slow = drive.serial.silence is not None  # whose silence takes longer than that
    often: Shows = {"Pins.Settings.RefreshMs": 20}
    yield Step("every 20 ms", MS | often, ms=30 * SCAN_MS, shows={"Running": True})
    yield Step("for 840 ms", {".Mark": "Seen.References"}, ms=840 * SCAN_MS, shows={
        "Seen.References - Mark": (30, 43) if slow else (42, 43), "Running": True,
    })  # fmt: skip
    fed: Shows = {"Pins.Settings.RefreshMs": 65535, "Pins.Settings.WatchdogMs": 60}
    yield Step("three times in the time of a watchdog", fed, ms=30 * SCAN_MS, shows={"Running": True})
    yield Step("for 840 ms", {".Mark": "Seen.References"}, ms=840 * SCAN_MS, shows={
        "Seen.References - Mark": (30, 42) if slow else (40, 42), "Running": True,
    })  # fmt: skip


def _attend() -> Iterator[Step]:
    nobody: Shows = {"Pins.AttendMs": 50, "Pins.NoDrive": True}
    yield Step("its block is not called", MS | nobody, "Slots[0].Unattended", 2000, {".WaitedMs": _after(51, 52)})


def _overdue() -> Iterator[Step]:
    runs_on: Shows = {"StopWithinMs": 100, "RunForward": False, "Fate.RunsOn": True}
    yield Step("it runs on", MS | runs_on, "Motor.StopOverdue", 6000, {".WaitedMs": _after(101, 103)})


def _stale() -> Iterator[Step]:
    yield Step("its status is older than StaleMs", MS | {"Pins.Settings.StaleMs": 50}, ms=60 * SCAN_MS, shows={
        "CommOk": True, "Running": True,
    })  # fmt: skip
    yield Step("its replies are lost", {"Fate.Dumb": True}, "NOT Motor.CommOk", 2000, {
        ".WaitedMs": _after(25, 54), "Motor.Diagnosis.StatusAgeMs": 51,
    })  # fmt: skip


def _follow() -> Iterator[Step]:
    ignored: Shows = {"Fate.Local": True, "RunForward": True, "Pins.Settings.FollowWithinMs": 80}
    yield Step("it does nothing", MS | ignored, why("NOT_FOLLOWED"), 4000, {".WaitedMs": _after(85, 130)})


def _restart() -> Iterator[Step]:
    yield Step("as late as it may", {"Pins.RestartMs": 30, "Pins.ElapsedMs": 30}, ms=100, shows={
        "StopConfirmed": True, "Reason": "READY",
    })  # fmt: skip
    yield Step("later", {"Pins.ElapsedMs": 31}, ms=40, shows={"StopConfirmed": False})
    yield Step("in time", {"Pins.ElapsedMs": SCAN_MS}, "Motor.StopConfirmed", 3000, STANDS)


def _ran() -> Iterator[Step]:
    """The command in hand by itself: what is shown in these few calls, no drive does at will."""
    begin: Shows = {"Known.CommOk": True, "Known.PassedMs": 1, "Wish.Order": 5, "Wish.Motion": True, ".Stage1": 3}
    yield Step("run is posted", begin | {"Known.Restarted": True, ".Anew": True}, ms=20)
    yield Step("and not answered yet", {"Known.Restarted": False, ".Anew": True}, ms=40, shows={
        "Command.Open": True, "Command.UnderWay": True, "Command.Ends": 0,
    })  # fmt: skip
    yield Step("nobody answers", {".Answers": 7}, ms=20, shows={"Command.Failed": True, "Command.Taken": False})
    yield Step("it runs", {"Known.Moving": True}, ms=40, shows={"Command.Ends": 0, "Command.RunsAgain": False})
    yield Step("it stands", {"Known.Moving": False, "Known.ProofRead": True}, ms=20, shows={
        "Command.Ends": REASONS["BY_ITSELF"], "Command.RunsAgain": False,
    })  # fmt: skip
