"""Scenes of what a line says of itself: how late its stops can be, what it counts, how long a round of polls takes."""

from collections.abc import Iterator
from dataclasses import replace

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.motor import POWER, RUNNING, STANDS, run
from driveblocks.bench.scenes.promise import Promise
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import polls
from driveblocks.meaning.serial import serial

MARKS = {
    "Marks": ("MB_Words16", "counts of before"),
    "Sent": ("UINT", "requests that the line has counted since"),
    "Heard": ("UINT", "requests that the drive has heard since"),
    "Requests": ("UDINT", "requests that its slots count, so are the next"),
    "Good": ("UDINT", "replies believed"),
    "Timeouts": ("UINT", "timeouts"),
    "Bad": ("UINT", "damaged replies"),
    "Refusals": ("UINT", "refusals"),
    "Retries": ("UINT", "retries"),
    "Late": ("UINT", "late replies"),
    "Lost": ("UDINT", "requests that no reply has ended"),
    "Cycles": ("UDINT", "Sent times CycleMs, ms"),
    "Least": ("UINT", "the lowest WorstStopMs since"),
    "Before": ("UINT", "what the drive had heard"),
}
CALLS = (
    "Heard := Seen.Reads + Seen.Writes - Before;",
    "Cycles := UINT_TO_UDINT(Sent) * UINT_TO_UDINT(Bus.CycleMs);",
    "Least := MIN(Least, Bus.WorstStopMs);",
    "Sent := UDINT_TO_UINT(Slots[0].Requests MOD 65536) - Mark;",
)
AFTER = (
    *(
        f"{name} := Slots[0].{name} + Slots[1].{name};"
        for name in ("Requests", "Good", "Timeouts", "Bad", "Refusals", "Retries", "Late")
    ),
    "Lost := Bus.Requests - Bus.Good;",
)
BEGIN: Shows = {".Mark": "UDINT_TO_UINT(Slots[0].Requests MOD 65536)", ".Before": "Seen.Reads + Seen.Writes"}
COUNTERS = ("Timeouts", "Bad", "Refusals", "Retries")
"""Of the line and of a slot."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    more = More(other=True, blocks=MARKS, calls=CALLS, after=AFTER)
    yield script(drive, stem, "MotorCount", "what a line counts and promises", scenes(Ability(drive)), more)


def scenes(can: Ability) -> Iterator[Scene]:
    """All scenes of the line's own figures; the first needs a line that was never late."""
    yield scene("a scan that is later than promised is counted", POWER._replace(brisk=False), *_late_scans())
    yield scene("what the line counts", POWER, run(), *_counts(can))
    yield scene("how late a stop can be", POWER, *_promises(can))
    yield scene("how busy the line is", POWER, *_load(can.drive))


def _late_scans() -> Iterator[Step]:
    yield Step("none yet", ms=100, shows={"Bus.LateScans": 0, "Bus.LongestScanMs": SCAN_MS, "Slots[0].ScanLate": False})
    yield Step("as long as promised", {"Pins.MaxScanMs": 200, "Pins.ElapsedMs": 200}, ms=40, shows={"Bus.LateScans": 0})
    yield Step("longer", {"Pins.ElapsedMs": 201}, "Bus.LateScans > 0", 100, {"Bus.LongestScanMs": 201})
    yield Step("each counts", ms=40, shows={"Bus.LateScans": (3, 4), "Slots[0].ScanLate": True})
    yield Step("for ten seconds", {"Pins.ElapsedMs": 200}, "NOT Slots[0].ScanLate", 2000, {
        ".WaitedMs": (980, 1040), "Bus.LongestScanMs": 201,
    })  # fmt: skip


def _promises(can: Ability) -> Iterator[Step]:
    drive = can.drive
    usual = Promise(
        ascii=serial(drive).ascii,
        silence=int(serial(drive).silence_ms),
        by_one=any(function.code == 6 for function in drive.functions),
    )
    worst = 0
    for words, sets, one in _lines(can, usual):
        worst = one.worst
        yield Step(words, sets, ms=18 * SCAN_MS, shows={
            "Bus.StopAloneMs": one.alone, "Bus.WorstStopMs": one.worst, "Bus.CutToContactMs": one.cut,
        })  # fmt: skip
    yield Step("it stays so in every scan", {".Least": 65535}, ms=18 * SCAN_MS, shows={".Least": worst})


def _lines(can: Ability, usual: Promise) -> Iterator[tuple[str, Shows, Promise]]:
    """Lines one after the other, each an edit of the one before."""
    yield "as scenes have it", {}, usual
    slow = replace(usual, rate=9600, keeps=False, retries=0, scan=20)
    pins: Shows = {"Pins.BitRate": 0, "Pins.CharacterBits": 0, "Pins.KeepsSilence": False, "Pins.MaxScanMs": 0}
    yield "slow, and nothing wired", pins | {"Pins.CommandRetries": 255}, slow
    at = replace(slow, rate=19200, bits=11, port=7, retries=5)
    pins = {"Pins.BitRate": 19200, "Pins.CharacterBits": 11, "Pins.PortLateMs": 7, "Pins.CommandRetries": 5}
    yield "8E1, and a port that keeps frames back", pins, at
    at = replace(at, rate=38400, keeps=True, scan=50, offline=3000, turn_round=80, longest=400)
    pins = {"Pins.BitRate": 38400, "Pins.KeepsSilence": True, "Pins.MaxScanMs": 50, "Pins.OfflineMs": 3000}
    pins |= {"Pins.Settings.TurnRoundMs": 80, "Pins.Settings.LongestMs": 400}
    yield "a slow drive", pins, at
    if len(serial(can.drive).modes) > 1:
        at = replace(at, ascii=True, offline=1000)
        yield "in ASCII", {"Pins.Ascii": True, "Pins.OfflineMs": 0}, at
        at = replace(at, ascii=False)
        yield "in RTU", {"Pins.Ascii": False}, at
    unit = serial(can.drive).lowest
    if serial(can.drive).highest > unit:
        pins = {"Pins.OtherOn": True, "Pins.OtherUnit": unit + 1, "Pins.OfflineMs": 1000}
        pins |= {"Pins.Settings.TurnRoundMs": 30, "Pins.Settings.LongestMs": 60}
        yield "two drives", pins, replace(at, drives=2, offline=1000, turn_round=30, longest=60)


def _counts(can: Ability) -> Iterator[Step]:
    """What it counts from one moment on: a drive may be known by what it refuses, before its first stop."""
    same: Shows = {f"Bus.{name} = {name}": True for name in ("Requests", "Good", *COUNTERS)}
    known: Shows = {".Marks[2]": "UINT_TO_WORD(Bus.Refusals)"}
    yield Step("from here", BEGIN | known | {".Marks[0]": "UINT_TO_WORD(Bus.Retries)"}, ms=20)
    yield Step("each request reaches the drive", ms=1000, shows=RUNNING | same | {
        "Sent > 20": True, "Sent + 1 - Heard": (0, 2),
        "Lost <= 6": True, "Bus.Timeouts": 0, "Bus.Bad": 0,
        "Bus.Refusals - WORD_TO_UINT(Marks[2])": 0, "Bus.LateReplies": 0,
        "Bus.LastErrorID": 40 if can.known_by_refusal else 0,
    }, brisk=False)  # fmt: skip
    for words, what, counter, error in (
        ("its replies are lost", "Dumb", "Timeouts", 20),
        ("its replies are damaged", "Damaged", "Bad", 23),
        ("it refuses reads", "RefusesReads", "Refusals", 40),
    ):
        yield Step(words, BEGIN | {f"Fate.{what}": True, ".Marks[1]": f"UINT_TO_WORD(Bus.{counter})"}, ms=600)
        more = f"Bus.{counter} - WORD_TO_UINT(Marks[1])"
        yield Step("each is counted", {f"Fate.{what}": False}, ms=60, shows=same | {
            more: (3, 200), f"Heard - ({more})": (0, 4), "Bus.LastErrorID": error,
            f"Slots[0].LastErrorID = {error}": True,
        })  # fmt: skip
        yield Step("it is well again", {}, "Motor.CommOk", 3000)
    yield Step("late replies", BEGIN | {"Fate.HoldMs": 100, "Pins.Settings.LongestMs": 200}, ms=800, shows=same | {
        "Bus.LateReplies >= 1": True, "Bus.LateReplies = Late": True,
        "Heard + 1 - Bus.LateReplies": (0, 99),
        "Slots[0].LongestReplyMs": (60, 140), "Bus.ForeignFrames": 0,
    })  # fmt: skip
    end: Shows = {"Fate.HoldMs": 0, "RunForward": False}
    yield Step("it stops", end, "Motor.StopConfirmed", 4000, STANDS | same | {"Bus.ForeignFrames": 0})


def _load(drive: Drive) -> Iterator[Step]:
    """One drive that answers at once keeps the line busy; a dead one leaves it free.

    A round is two scans, or four after a read that is as long as the next. Cycles takes the last of them for all: where
    such reads are, it is from a third of the 1200 ms to twice as much.
    """
    alike = len({each.words for each in polls(drive)}) < len(polls(drive))
    least, most = (400, 2400) if alike else (1000, 1400)
    yield Step("from here", BEGIN, ms=1200, shows={
        "Bus.LoadPercent": (40, 100), "Bus.CycleMs": (20, 100), "Bus.WorstCycleMs >= Bus.CycleMs": True,
        f"Cycles > {least}": True, f"Cycles < {most}": True,
    })  # fmt: skip
    yield Step("it is dead", {"Fate.Cut": True}, "NOT Slots[0].Online", 4000, {"Bus.OnlineCount": 0})
    yield Step("it is probed now and then", ms=2400, shows={"Bus.LoadPercent": (0, 12)}, brisk=False)
