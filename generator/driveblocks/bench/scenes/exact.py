"""Scenes in scans of a millisecond: times that are kept to the millisecond, and parts of the control by themselves."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.motor import POWER, STANDS, run
from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.maps.rivals import first_reads
from driveblocks.meaning.polls import polls
from driveblocks.meaning.roles import roles
from driveblocks.meaning.serial import serial
from driveblocks.meaning.watchdog import feeds, watchdog
from driveblocks.meaning.words import words

MORE = More(
    blocks={
        "Command": ("VFD_Run", "under test: the command in hand"),
        "Known": ("VFD_Seen", "what it gets about the drive"),
        "Wish": ("VFD_Asked", "what it gets about the pins"),
        "Stage1": ("UINT", "the state that it gets"),
        "Answers": ("UINT", "Number that is answered"),
        "Anew": ("BOOL", "its command has just been posted"),
        "Way": ("BOOL", "the drive shows which way it turns"),
        "GoodSeen": ("UDINT", "replies of the last call"),
        "RequestsSeen": ("UDINT", "requests of the last call"),
        "SinceGood": ("UINT", "up to the last call: since a reply, ms"),
        "SinceRequest": ("UINT", "... since a request, ms"),
        "ReferencesSeen": ("UINT", "references of the last call"),
        "SinceReference": ("UINT", "... since one, ms"),
        "Period": ("UINT", "from the one before to the last one, ms"),
        "Youngest": ("UINT", "the lowest age of a measure since, ms"),
    },
    calls=(
        "Command(Seen := Known, Asked := Wish, CommLost := FALSE, State := Stage1, Order := 5, Sent := 5,",
        "  SentWord := WORD#16#0000, StepNumber := 0, Number := 7, Posted := Anew, Begun := Anew, Dropped := FALSE,",
        "  AskNumber := 7, Answer := Answers, AnswerErrorID := 20, KnowsDirection := Way, FollowWithinMs := 1000,",
        "  StepLast := 0, StepReached := TRUE, StepHoldMs := 0);",
        "Anew := FALSE;",
        "SinceGood := SinceGood + Pins.ElapsedMs;",
        "IF Bus.Good <> GoodSeen THEN",
        "  SinceGood := 0;",
        "END_IF;",
        "GoodSeen := Bus.Good;",
        "SinceRequest := SinceRequest + Pins.ElapsedMs;",
        "IF Bus.Requests <> RequestsSeen THEN",
        "  SinceRequest := 0;",
        "END_IF;",
        "RequestsSeen := Bus.Requests;",
        "SinceReference := SinceReference + Pins.ElapsedMs;",
        "IF Seen.References <> ReferencesSeen THEN",
        "  Period := SinceReference;",
        "  SinceReference := 0;",
        "END_IF;",
        "ReferencesSeen := Seen.References;",
        "Youngest := MIN(Youngest, Motor.Diagnosis.MeasuresAgeMs);",
    ),
)
MS: Shows = {"Pins.ElapsedMs": 1}
"""From here a scan is a millisecond."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    yield script(drive, stem, "MotorExact", "times to the millisecond", scenes(drive), MORE)


def _after(least: int, most: int) -> tuple[int, int]:
    """So many scans since the begin of a step."""
    return SCAN_MS * least, SCAN_MS * most


def scenes(drive: Drive) -> Iterator[Scene]:
    can = Ability(drive)
    yield scene("how often the reference is sent", POWER, run(), *_refresh(drive))
    yield scene("when the line stops a motor by itself", POWER, run(), *_attend())
    yield scene("when it does after a restart", POWER, run(), *_attend_anew())
    yield scene("when a drive is dead", POWER, *_dead())
    yield scene("when a request is withdrawn", POWER, *_mailbox())
    yield scene("when every call comes late", POWER, *_late_calls())
    if len(roles(drive).measure) == 1 and can.turns == 1:  # of several reads one is older, by what comes between
        yield scene("how old a measure is", POWER, *_young())
    yield scene("silence after a restart", POWER, *_quiet(drive))
    yield scene("when a stop is overdue", POWER, run(), *_overdue())
    yield scene("when a status is too old", POWER, run(), *_stale(drive))
    yield scene("when a start is not followed", POWER, *_follow(drive))
    yield scene("which call comes too late", POWER, *_restart())
    yield scene("a motor that ran before its command was acknowledged", *_ran())
    yield scene("one that runs the other way before that", *_other_way())
    yield scene("a restart while a command is in doubt", *_in_doubt())


def _refresh(drive: Drive) -> Iterator[Step]:
    usual: Shows = {"Pins.Settings.RefreshMs": 5 * SCAN_MS, ".Mark": "Seen.References"}
    yield Step("every five scans", usual, ms=100 * SCAN_MS, shows={
        "Seen.References - Mark": (19, 21), "Running": True,
    })  # fmt: skip
    slow = serial(drive).silence  # whose silence takes longer than that
    often: Shows = {"Pins.Settings.RefreshMs": 20}
    yield Step("every 20 ms", MS | often, ms=100 * SCAN_MS, shows={
        ".Period": (20, 40) if slow else 20, "Running": True,
    })  # fmt: skip
    if watchdog(drive) and feeds(drive) != "reference":
        return
    fed: Shows = {"Pins.Settings.RefreshMs": 65535, "Pins.Settings.WatchdogMs": 60}
    yield Step("three times in the time of a watchdog", fed, ms=100 * SCAN_MS, shows={
        ".Period": (20, 40) if slow else 21, "Running": True,
    })  # fmt: skip


def _attend() -> Iterator[Step]:
    nobody: Shows = {"Pins.AttendMs": 50, "Pins.NoDrive": True}
    yield Step("its block is not called", MS | nobody, "Slots[0].Unattended", 2000, {".WaitedMs": _after(51, 52)})


def _attend_anew() -> Iterator[Step]:
    """A restart gives its block all of the time."""
    nobody: Shows = {"Pins.AttendMs": 50, "Pins.NoDrive": True}
    yield Step("its block is not called", MS | nobody, ms=40 * SCAN_MS, shows={"Slots[0].Unattended": False})
    yield Step("Restart", {"Pins.Restart": True}, ms=SCAN_MS)
    yield Step("after 51 calls", {"Pins.Restart": False}, "Slots[0].Unattended", 2000, {".WaitedMs": _after(51, 51)})


def _dead() -> Iterator[Step]:
    yield Step("it answers", MS | {"Pins.OfflineMs": 300}, ms=50 * SCAN_MS, shows={"Slots[0].Online": True})
    yield Step("the cable is cut", {"Fate.Cut": True}, "NOT Slots[0].Online", 9000, {".SinceGood": 299})


def _mailbox() -> Iterator[Step]:
    """What the port does not take is withdrawn after more than a second."""
    yield Step("scans of 13 ms", {"Pins.ElapsedMs": 13}, ms=200)
    stuck: Shows = {"Pins.TxBusy": True, ".Mark": "Bus.Timeouts"}
    yield Step("the port takes nothing", stuck, "Bus.Timeouts > Mark", 3000, {".SinceRequest": 1001 - 13})


def _late_calls() -> Iterator[Step]:
    """A call that comes late gives a reply one call more, and no more."""
    late: Shows = {"Pins.ElapsedMs": 3 * SCAN_MS, "Pins.MaxScanMs": SCAN_MS}
    yield Step(
        "every call comes late", late, ms=10 * SCAN_MS, shows={"Slots[0].ScanLate": True, "Slots[0].Online": True}
    )
    begin: Shows = {"Fate.Dumb": True, ".Mark": "Bus.Timeouts"}
    yield Step("its replies are lost", begin, ms=20 * SCAN_MS, shows={"Bus.Timeouts - Mark": (4, 9)})


def _young() -> Iterator[Step]:
    yield Step("measures", {"Pins.ElapsedMs": SCAN_MS, ".Youngest": 65535}, ms=400, shows={".Youngest": SCAN_MS})


def _quiet(drive: Drive) -> Iterator[Step]:
    """After a restart the line keeps silence before its first request, whatever was before."""
    slow: Shows = {"Pins.BitRate": 9600, "Pins.KeepsSilence": False, "Pins.TxBusy": True}
    yield Step("a slow line on which it is quiet", MS | slow, ms=60 * SCAN_MS)
    yield Step("Restart", {"Pins.Restart": True, "Pins.TxBusy": False}, ms=SCAN_MS)
    yield Step("its first request", {"Pins.Restart": False}, "TxCount > 0", 2000, {
        ".WaitedMs": _after(4, 110 if first_reads(drive) else 14),
    })  # fmt: skip


def _overdue() -> Iterator[Step]:
    runs_on: Shows = {"StopWithinMs": 100, "RunForward": False, "Fate.RunsOn": True}
    yield Step("it runs on", MS | runs_on, "Motor.StopOverdue", 6000, {".WaitedMs": _after(101, 103)})


def _stale(drive: Drive) -> Iterator[Step]:
    """The status is as old as all reads of it in turn, and one other, each with the silence around it."""
    age = max(50, 25 * sum(each.fast for each in polls(drive)))
    yield Step("it is read more often", MS, ms=100 * SCAN_MS)
    yield Step("its status is older than StaleMs", {"Pins.Settings.StaleMs": age}, ms=60 * SCAN_MS, shows={
        "CommOk": True, "Running": True,
    })  # fmt: skip
    yield Step("its replies are lost", {"Fate.Dumb": True}, "NOT Motor.CommOk", 2000, {
        ".WaitedMs": _after(25, age + 4), "Motor.Diagnosis.StatusAgeMs": age + 1,
    })  # fmt: skip


def _follow(drive: Drive) -> Iterator[Step]:
    """Each state on the way to a run is proved first. The time is at least that of two reads in turn, and a round."""
    states = len(words(drive).named["run_forward"].writes) - 1
    most = 1080 + 80 * states + 40 * len(polls(drive))
    ignored: Shows = {
        "Fate.Local": True,
        "RunForward": True,
        "Pins.Settings.FollowWithinMs": 1000,
        "Pins.Settings.StaleMs": 1000,
    }
    yield Step("it does nothing", MS | ignored, why("NOT_FOLLOWED"), 30000, {
        ".WaitedMs": _after(1005, most),
    })  # fmt: skip


def _restart() -> Iterator[Step]:
    yield Step("as late as it may", {"Pins.RestartMs": 30, "Pins.ElapsedMs": 30}, ms=100, shows={
        "StopConfirmed": True, "Reason": "READY",
    })  # fmt: skip
    yield Step("later", {"Pins.ElapsedMs": 31}, ms=40, shows={"StopConfirmed": False})
    yield Step("in time", {"Pins.ElapsedMs": SCAN_MS}, "Motor.StopConfirmed", 3000, STANDS)


def _posted() -> Iterator[Step]:
    """The command in hand by itself: what is shown in a few calls, no drive does at will."""
    begin: Shows = {
        "Known.CommOk": True, "Known.PassedMs": 1, "Known.Moving": False, "Known.Backwards": False,
        "Known.ProofRead": False, "Wish.Order": 5, "Wish.Motion": True, ".Stage1": 3, ".Way": False, ".Answers": 6,
    }  # fmt: skip
    yield Step("run is posted", begin | {"Known.Restarted": True, ".Anew": True}, ms=20)
    yield Step("and not answered yet", {"Known.Restarted": False, ".Anew": True}, ms=40, shows={
        "Command.Open": True, "Command.UnderWay": True, "Command.Ends": 0,
    })  # fmt: skip


def _other_way() -> Iterator[Step]:
    yield from _posted()
    back: Shows = {"Known.Moving": True, "Known.Backwards": True}
    yield Step("it runs the other way, as far as it shows", back, ms=20, shows={"Command.Ends": 0})
    yield Step("it does", {".Way": True}, ms=20, shows={"Command.Open": True, "Command.Ends": REASONS["BY_ITSELF"]})


def _in_doubt() -> Iterator[Step]:
    yield from _posted()
    yield Step("nobody answers", {".Answers": 7}, ms=20, shows={"Command.Failed": True, "Command.RunsAgain": False})
    anew: Shows = {"Known.Restarted": True, "Known.ProofRead": True, ".Answers": 6}
    yield Step("Restart", anew, ms=20, shows={"Command.RunsAgain": False, "Command.Failed": False})


def _ran() -> Iterator[Step]:
    yield from _posted()
    yield Step("nobody answers", {".Answers": 7}, ms=20, shows={"Command.Failed": True, "Command.Taken": False})
    yield Step("it runs", {"Known.Moving": True}, ms=40, shows={"Command.Ends": 0, "Command.RunsAgain": False})
    yield Step("at standstill", {"Known.Moving": False, "Known.ProofRead": True}, ms=20, shows={
        "Command.Ends": REASONS["BY_ITSELF"], "Command.RunsAgain": False,
    })  # fmt: skip
