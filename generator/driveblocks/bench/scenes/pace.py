"""Scenes of time: how often stops are repeated and dead drives are asked, and when a stop is overdue."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.motor import NOTHING_STARTED, POWER, RUNNING, STANDS, run
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.maps.rivals import first_reads
from driveblocks.meaning.serial import serial

CALLS = (
    "Stops := Seen.Stops - Marks[0];",
    "Reads := Seen.Reads - Marks[1];",
    "Writes := Seen.Writes - Marks[2];",
    "OtherReads := OtherSeen.Reads - Marks[3];",
    "Thrice := 3 * OtherReads;",
    "IF Mute THEN",
    "  Fate.Dumb := Slots[0].ResetAsked AND (Slots[0].Ask[1].Number <> Slots[0].Answer[1].Number);",
    "END_IF;",
    "IF Flaps THEN",
    "  Both := Seen.Reads + Seen.Writes;",
    "  Fate.Dumb := Both MOD 2 = 0;",
    "END_IF;",
)
COUNTS = {
    "Marks": ("VFD_TestTimes", "counts of before"),
    "Flaps": ("BOOL", "every other reply is lost"),
    "Both": ("UINT", "requests that the drive has heard"),
    "Thrice": ("UINT", "OtherReads three times"),
    "Mute": ("BOOL", "replies to fault resets are lost"),
    "Stops": ("UINT", "stops that the drive has heard since, so are the next"),
    "Reads": ("UINT", "reads"),
    "Writes": ("UINT", "writes"),
    "OtherReads": ("UINT", "reads of the second drive"),
}
FROM_HERE: Shows = {
    ".Marks[0]": "Seen.Stops", ".Marks[1]": "Seen.Reads", ".Marks[2]": "Seen.Writes", ".Marks[3]": "OtherSeen.Reads",
}  # fmt: skip
SLOW: Shows = {"Pins.ElapsedMs": 5 * SCAN_MS, "Pins.MaxScanMs": 5 * SCAN_MS}
"""Long scans, so that a long time takes few of them; steps then last five times as long."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    more = More(other=True, blocks=COUNTS, calls=CALLS)
    yield script(drive, stem, "MotorPace", "how often, and how soon", scenes(Ability(drive)), more)


def scenes(can: Ability) -> Iterator[Scene]:
    yield scene("how often a stop is repeated", POWER, run(), *_repeated())
    yield scene("how often where it cannot be read", POWER, run(), *_unread())
    yield scene("how often a refused stop is", POWER, run(), *_refused())
    yield scene("how often a dead drive gets a stop", POWER, run(), *_dead())
    if can.shows("ready"):
        yield scene("a drive that is not ready gets a stop", POWER, *_not_ready())
    if can.can("fault_reset") and can.drive.operation.in_one_word:
        yield scene("how often a fault reset is tried", POWER, *_resets(can))
    yield scene("how soon silence is overdue", POWER, run(), *_silent())
    yield scene("silence at standstill is no alarm", POWER, *_standing())
    yield scene("how often a dead drive is read", POWER, *_probes(can))
    yield scene("silence after power-up", *_boots())
    yield scene("silence without supply", POWER, run(), *_no_supply())
    if serial(can.drive).highest > serial(can.drive).lowest:
        yield scene("what a dead drive costs the others", POWER, *_costs(can))
        yield scene("two dead drives", POWER, run(), *_two_dead(can))
        yield scene("one silent drive of two", POWER, run(), *_one_silent(can))
    yield scene("a drive that answers now and then", POWER, *_flaps())


def _repeated() -> Iterator[Step]:
    runs_on: Shows = {"RunForward": False, "Fate.RunsOn": True, "StopWithinMs": 20000}
    yield Step("it acknowledges and runs on", runs_on, "Seen.Stops > 1", 300, {"Slots[0].StopAgain": False})
    yield Step("twice a second", FROM_HERE, ms=3000, shows={
        ".Stops": (4, 6), "Slots[0].StopAgain": True, "StopOverdue": False, "Reason": "STOPPING",
    })  # fmt: skip
    yield Step("until standstill", {"Fate.RunsOn": False}, "Motor.StopConfirmed", 3000)
    yield Step("then no more", FROM_HERE, ms=1500, shows=STANDS | {".Stops": 0})


def _unread() -> Iterator[Step]:
    unread: Shows = {"RunForward": False, "Fate.RunsOn": True, "Fate.RefusesReads": True, "StopWithinMs": 20000}
    yield Step("it acknowledges, and cannot be read", unread | FROM_HERE, ms=2700, shows={".Stops": 1})
    yield Step("again after three seconds", ms=1000, shows={".Stops": 2, "CommOk": True, "StopConfirmed": False})
    well: Shows = {"Fate.RunsOn": False, "Fate.RefusesReads": False}
    yield Step("until standstill", well, "Motor.StopConfirmed", 5000, STANDS)


def _refused() -> Iterator[Step]:
    refuses: Shows = {"RunForward": False, "Fate.RefusesWrites": True, "StopWithinMs": 20000}
    yield Step("it refuses the stop", refuses | FROM_HERE, ms=3000, shows={
        ".Writes": (5, 8), "StopConfirmed": False, "Seen.Driven": True, "CommOk": True,
    })  # fmt: skip
    yield Step("it takes it", {"Fate.RefusesWrites": False}, "Motor.StopConfirmed", 3000, STANDS)


def _dead() -> Iterator[Step]:
    deaf: Shows = {"RunForward": False, "Fate.RunsOn": True, "Fate.Dumb": True, "StopWithinMs": 20000}
    yield Step("its answers are lost, and it runs on", deaf | FROM_HERE, why("OFFLINE"), 3000, {".Stops": (1, 30)})
    yield Step("four attempts, then overdue", {}, "Motor.StopOverdue", 3000, {"Stops >= 4": True})
    yield Step("once a second", FROM_HERE, ms=5000, shows={".Stops": (4, 6), "StopOverdue": True, "CommOk": False})
    yield Step("it is heard again", {"Fate.Dumb": False, "Fate.RunsOn": False}, "Motor.StopConfirmed", 4000, STANDS)
    yield Step("no longer overdue", {}, "NOT Motor.StopOverdue", 1000, {"Bus.StopOverdue": False})


def _not_ready() -> Iterator[Step]:
    yield Step("it is not ready", {"Fate.NotReady": True}, why("NOT_READY"), 2000)
    yield Step(
        "once a second", FROM_HERE, ms=5000, shows={".Stops": (4, 6), "StopConfirmed": True, "StopOverdue": False}
    )
    yield Step("ready again", {"Fate.NotReady": False}, "Motor.Ready", 2000)
    yield Step("no more", FROM_HERE, ms=1500, shows={".Stops": 0})


def _resets(can: Ability) -> Iterator[Step]:
    """Where it is not answered, three times for one edge, the fault being read before each."""
    yield Step("it trips", {"Fate.Trips": can.codes[1], "Fate.Cause": True}, "Motor.Fault", 1500)
    yield Step("its code is known", ms=500)
    yield Step("no answer to a reset", {".Mute": True, "FaultReset": True}, why("NO_RESET"), 12000, {"Seen.Resets": 3})
    end: Shows = {".Mute": False, "Fate.Dumb": False, "Fate.Cause": False, "FaultReset": False}
    yield Step("it answers", end, ms=300, shows={"Fault": True})
    yield Step("a new edge", {"FaultReset": True}, "Motor.Ready", 4000, {"Seen.Resets": 4})
    trips: Shows = {"Fate.Trips": can.codes[1], "Fate.Cause": True, "FaultReset": False}
    yield Step("it trips again", trips, "Motor.Fault", 1500)
    yield Step("its code is known", ms=500)
    yield Step("a reset that is not answered", {".Mute": True, "FaultReset": True}, "Seen.Resets > 4", 3000)
    yield Step("is taken back by a stop, when somebody else takes charge", {"MonitorOnly": True}, ms=40, shows={
        "Slots[0].Ask[1].Number": "Slots[0].Answer[1].Number", "Reason": "NO_RESET",
    })  # fmt: skip
    if can.code:
        yield from _another_fault(can)
    yield Step("all is well", {".Mute": False, "Fate.Dumb": False, "Fate.Cause": False}, ms=20)


def _another_fault(can: Ability) -> Iterator[Step]:
    """A fault that was not read is not reset."""
    yield Step("in charge again", {"MonitorOnly": False, ".Mute": False, "FaultReset": False}, ms=1000 + can.silent_ms)
    begin: Shows = {".Mark": "Seen.Resets", ".Mute": True, "FaultReset": True}
    yield Step("a reset that is not answered", begin, "Seen.Resets > Mark", 3000, {"Fault": True})
    other: Shows = {"Fate.Cause": False, "Fate.KeypadReset": True, "Fate.Trips": can.codes[0], ".Mark": "Seen.Resets"}
    yield Step("another fault comes", other, ms=SCAN_MS)
    yield Step("it is not reset", {"Fate.Cause": True}, why("NO_RESET"), 9000, {"Seen.Resets - Mark": (0, 1)})


def _silent() -> Iterator[Step]:
    yield Step("the cable is cut", {"Fate.Cut": True}, "Motor.StopOverdue", 4000, {
        "(WaitedMs >= 900) AND (WaitedMs <= Bus.CutToContactMs + 20)": True, "Seen.Driven": True, "CommOk": False,
    })  # fmt: skip
    yield Step("as long as it is", ms=1500, shows={"StopOverdue": True, "Bus.StopOverdue": True, "Bus.ErrorID": 61})
    yield Step("it is whole: stopped", {"Fate.Cut": False}, "Motor.StopConfirmed", 4000, STANDS)


def _standing() -> Iterator[Step]:
    """A fan whose isolator is open must not trip the others."""
    yield Step("the cable is cut", {"Fate.Cut": True}, why("OFFLINE"), 4000, {"StopOverdue": False})
    yield Step("for long", SLOW, ms=1600, shows={"StopOverdue": False, "Bus.StopOverdue": False, "CommOk": False})
    yield Step("not if it is to stop, either", {"Enable": False}, ms=600, shows={"StopOverdue": False})
    back: Shows = {"Fate.Cut": False, "Enable": True, "Pins.ElapsedMs": SCAN_MS}
    yield Step("it is whole", back, "Motor.Ready", 12000, STANDS | NOTHING_STARTED)


def _probes(can: Ability) -> Iterator[Step]:
    """After one, two, four and eight seconds, then every eight; each second where a stop waits for its identity."""
    yield Step("its answers are lost", {"Fate.Dumb": True}, why("OFFLINE"), 4000)
    named = bool(first_reads(can.drive))  # forgotten after ten seconds
    yield Step("for 16 s", SLOW | FROM_HERE, ms=3200, shows={".Reads": (3, 16 if named else 6), ".Writes": (0, 18)})
    yield Step("for 24 s more", SLOW | FROM_HERE, ms=4800, shows={
        ".Reads": (22, 25) if named else (2, 4), ".Writes": (0, 26),
    })  # fmt: skip
    back: Shows = {"Fate.Dumb": False, "Pins.ElapsedMs": SCAN_MS}
    yield Step("it answers: read as ever", back, "Motor.Ready", 12000, NOTHING_STARTED | {"Bus.AllOnline": True})
    yield Step("no pause is left", FROM_HERE, ms=1000, shows={"Reads >= 8": True})


def _boots() -> Iterator[Step]:
    silent: Shows = {"Fate.Dumb": True, "Pins.Settings.BootMs": 4000}
    yield Step(
        "it boots", silent, ms=3800, shows={"StopOverdue": False, "Bus.StopOverdue": False, "Reason": "NO_REPLY"}
    )
    yield Step("for too long", {}, "Motor.StopOverdue", 2500, {".WaitedMs": (100, 2000), "Reason": "NO_REPLY"})
    yield Step("it has booted", {"Fate.Dumb": False}, "Motor.Ready", 4000, STANDS | NOTHING_STARTED | {
        "StopOverdue": False,
    })  # fmt: skip


def _no_supply() -> Iterator[Step]:
    yield Step("it is stopped", {"SupplyOff": True}, "Motor.StopConfirmed", 4000, STANDS)
    yield Step("its answers are lost", {"Fate.Dumb": True}, "NOT Slots[0].Online", 4000, {"StopOverdue": False})
    begin: Shows = SLOW | FROM_HERE | {".Mark": "Bus.Timeouts"}
    yield Step("one read in ten seconds, and no stop", begin, ms=6000, shows={
        ".Reads": (2, 4), ".Writes": 0, ".Stops": 0, "StopOverdue": False, "Bus.AllOnline": False, "Bus.OnlineCount": 0,
        "Bus.Timeouts": "Mark",
    })  # fmt: skip
    back: Shows = {"Fate.Dumb": False, "Pins.ElapsedMs": SCAN_MS, "SupplyOff": False, "RunForward": False}
    yield Step("its supply is back", back, "Motor.Ready", 3000, STANDS | {"Bus.AllOnline": True})


def _costs(can: Ability) -> Iterator[Step]:
    other: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": serial(can.drive).lowest + 1}
    timeouts: Shows = {".Mark": "Bus.Timeouts"}
    yield Step("two drives", other | timeouts, "Other.Ready", 4000, {
        "Bus.OnlineCount": 2, "Bus.ForeignFrames": 0, "Bus.Timeouts": "Mark",
    })  # fmt: skip
    yield Step("both are read as often", FROM_HERE, ms=2000, shows={
        "Reads + 3 - OtherReads": (0, 6), ".Reads": (9, 99),
    })  # fmt: skip
    yield Step("one is dead", {"Fate.Cut": True}, "NOT Slots[0].Online", 4000, {"Other.CommOk": True})
    yield Step("it is left alone", {}, ms=1000, shows={"Other.CommOk": True})
    begin: Shows = FROM_HERE | {".Mark": "OtherReads"}
    # where all of its reads are of one length it is read in every other scan
    yield Step("the other has the wire to itself", begin, ms=2000, shows={
        "Thrice > Mark": True, ".OtherReads": (20, 200), "Bus.OnlineCount": 1, "Bus.AllOnline": False,
    })  # fmt: skip
    yield Step("it answers again", {"Fate.Cut": False}, "Bus.OnlineCount = 2", 9000, {"Other.CommOk": True})


def _one_silent(can: Ability) -> Iterator[Step]:
    """Its stop is overdue after its attempts and its longest time."""
    other: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": serial(can.drive).lowest + 1}
    yield Step("two drives", other | {"Pins.Settings.LongestMs": 1500}, "Other.Ready", 4000)
    cut: Shows = {"Fate.Cut": True, "StopWithinMs": 20000}
    yield Step("one is cut off", cut, why("OFFLINE"), 6000, {"Other.CommOk": True, "StopOverdue": False})
    yield Step("its stop is sent, and not overdue yet", ms=1300, shows={"StopOverdue": False})
    yield Step("now it is", {}, "Motor.StopOverdue", 8000, {"Other.StopOverdue": False, "Other.CommOk": True})


def _flaps() -> Iterator[Step]:
    """Three replies in a row make it one that answers."""
    yield Step("it is dead", {"Fate.Cut": True}, why("OFFLINE"), 4000)
    flaps: Shows = {"Fate.Cut": False, ".Flaps": True}
    yield Step("every other reply is lost", flaps, ms=6000, shows={"CommOk": False, "Slots[0].Online": False})
    yield Step("none is", {".Flaps": False, "Fate.Dumb": False}, "Motor.Ready", 9000, NOTHING_STARTED)


def _two_dead(can: Ability) -> Iterator[Step]:
    other: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": serial(can.drive).lowest + 1}
    yield Step("a second drive block", other, "Other.Ready", 4000)
    yield Step("both run", {"Pins.OtherRuns": True}, "OtherSeen.Milli >= 19800", 4000, RUNNING)
    yield Step("both cables are cut", {"Fate.Cut": True, "OtherFate.Cut": True}, "Bus.OnlineCount = 0", 4000, {
        "(WaitedMs >= 850) AND (WaitedMs <= Bus.CutToContactMs)": True,
    })  # fmt: skip
    yield Step("both stops are overdue", {}, "Motor.StopOverdue AND Other.StopOverdue", 4000)
    whole: Shows = {"Fate.Cut": False, "OtherFate.Cut": False}
    both = "Motor.StopConfirmed AND Other.StopConfirmed"
    yield Step("both are whole: stopped", whole, both, 6000, STANDS | {"OtherSeen.Driven": False})
    yield Step("nothing is overdue", {}, "NOT Bus.StopOverdue", 1000, {"OtherSeen.Starts": 1, "Seen.Starts": 1})
