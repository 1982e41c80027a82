"""Scenes of what is heard on the wire beside replies: other masters, noise, copies, replies of another form."""

from collections.abc import Iterator

from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import simulated
from driveblocks.bench.scenes.motor import NOTHING_STARTED, RUNNING, STANDS, run
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import busy
from driveblocks.meaning.serial import serial
from driveblocks.reference.framing import ascii_encode, rtu_seal
from structured_text.language.writing import byte

MORE = More(
    other=True,
    blocks={
        "Printed": ("MB_Adu", "characters that come"),
        "Inject": ("UINT", "how many; they come with the next scan, after a reply"),
        "Place": ("UINT", "next character"),
        "Late": ("UINT", "late replies that its slots count"),
        "Lost": ("UINT", "registers of the read whose reply was lost"),
        "Hurry": ("BOOL", "the speed is another one in every scan"),
    },
    calls=(
        "Place := 0;",
        "WHILE (Place < Inject) AND (RxCount < 256) DO",
        "  RxChars[RxCount] := Printed[Place];",
        "  RxCount := RxCount + 1;",
        "  Place := Place + 1;",
        "END_WHILE;",
        "Inject := 0;",
        "IF Hurry THEN",
        "  Pins.SpeedReferenceHz := 70.0 - Pins.SpeedReferenceHz;",
        "END_IF;",
    ),
    after=("Late := Slots[0].Late + Slots[1].Late;",),
)
FRAMES = {
    "a read request": "63 03 00 10 00 02",
    "a request that writes one register": "63 06 00 01 00 02",
    "a request that writes two": "63 10 00 01 00 02 04 00 05 00 06",
    "a reply to a read": "63 03 06 00 01 00 02 00 03",
    "a reply to a write of two": "63 10 00 01 00 02",
    "a request that writes coils": "63 0F 00 13 00 0A 02 CD 01",
    "a refusal": "63 83 02",
}
"""What another master and its drives say."""
NO_FRAMES = {"no frame of any kind": "63 03 07 00 01", "a refusal without the bit of one": "63 03 02"}
"""What has a right checksum, and no length that a frame can have."""
NOISE = {
    "two characters": "FF 00",
    "another unit address": "63",
    "the end of a frame": "00 0A C5",
    "a break": "00 00 00",
}


START = (
    Step("power-up", ms=100),
    Step(
        "ready",
        {"Pins.Acknowledge": True},
        "Motor.Ready",
        3000,
        {"Reason": "READY", "Bus.ForeignFrames": 0},
        brisk=True,
    ),
)
"""... and nothing that another master has said before counts."""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    yield script(drive, stem, "MotorOthers", "what is heard beside replies", scenes(Ability(drive)), MORE)


def scenes(can: Ability) -> Iterator[Scene]:
    drive = can.drive
    usual = "ascii" if serial(drive).ascii else "rtu"
    for mode in serial(drive).modes:
        sets: Shows = {"Pins.Ascii": mode == "ascii", "Pins.ForeignMost": 20}
        yield scene(f"frames of another master, {mode}", Step("settings", sets, ms=20), START[1], *_frames(mode))
    yield scene("some frames in ten seconds", START, *_now_and_then(usual))
    yield scene("another master goes away", START, *_goes_away())
    yield scene("replies that come twice", START, run(), *_twice())
    yield scene("noise before a reply", START, run(), *_noise(usual))
    if simulated(drive).dialect.function == 6:
        yield scene("an echo of another write", START, *_other_write(drive, usual))
    if simulated(drive).dialect.two_byte_count:
        yield scene("replies with a byte count of two bytes", START, run(), *_wide())
    yield scene("a late reply after a stop", START, run(), *_late_stop())
    if serial(can.drive).highest > serial(can.drive).lowest:
        yield scene("late replies of one of two drives", START, *_late_other(can))
    yield scene("an echo that comes and goes", START, *_echo())
    if busy(drive):
        yield scene("a drive that is busy", START, *_busy(can))
    yield scene("a speed that changes in every scan", START, run(), *_hurry())
    yield scene("after a lost reply another number of registers is read", START, *_varied())
    yield scene("which slot is wrong", START, *_slots(can))


def _characters(mode: str, frame: str) -> bytes:
    body = bytes.fromhex(frame)
    return (ascii_encode(body) if mode == "ascii" else rtu_seal(body)).data


def _comes(data: bytes) -> Shows:
    came: Shows = {f".Printed[{at}]": byte(octet) for at, octet in enumerate(data)}
    return came | {".Inject": len(data)}


def _frames(mode: str) -> Iterator[Step]:
    for count, (words, frame) in enumerate(FRAMES.items(), 1):
        yield Step(words, _comes(_characters(mode, frame)), ms=100, shows={"Bus.ForeignFrames": count})
    for words, frame in NO_FRAMES.items():
        yield Step(words, _comes(_characters(mode, frame)), ms=100, shows={"Bus.ForeignFrames": len(FRAMES)})
    wrong = bytearray(_characters(mode, FRAMES["a read request"]))
    wrong[-3] ^= 1
    yield Step("a wrong checksum is none", _comes(bytes(wrong)), ms=100, shows={
        "Bus.ForeignFrames": len(FRAMES), "CommOk": True, "Bus.Timeouts": 0, "Reason": "READY", "Bus.Bad": 0,
    })  # fmt: skip


SLOW: Shows = {"Pins.ElapsedMs": 5 * SCAN_MS, "Pins.MaxScanMs": 5 * SCAN_MS}
"""Long scans: steps last five times as long."""


def _now_and_then(mode: str) -> Iterator[Step]:
    frame = _characters(mode, FRAMES["a read request"])
    for words in ("some", "as many after ten seconds"):
        for count in range(1, 4):
            yield Step(f"{words}: {count}", SLOW | _comes(frame), ms=40, shows={"Bus.ForeignFrames": count})
        yield Step("they are forgotten", ms=2200, shows={"Bus.ForeignFrames": 0, "Reason": "READY"})


def _goes_away() -> Iterator[Step]:
    yield Step("it is found", {"Fate.Foreign": 8}, why("FOREIGN"), 3000, {"Ready": False, "Bus.ErrorID": 54})
    yield Step("the last frames", {}, "Fate.Foreign = 0", 2000)
    yield Step("for half a minute", SLOW, ms=5600, shows={"Ready": False, "Reason": "FOREIGN", "Bus.ForeignFrames": 0})
    yield Step("then a start passes again", {}, "Motor.Ready", 1200, {"Bus.Error": False, "Reason": "READY"})


def _twice() -> Iterator[Step]:
    yield Step(
        "each of them", {"Fate.Twice": True}, ms=1000, shows=RUNNING | {"Bus.ForeignFrames": 0, "Seen.Starts": 1}
    )
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS | {"Bus.ForeignFrames": 0})


def _noise(mode: str) -> Iterator[Step]:
    late: Shows = {"Fate.HoldMs": 3 * SCAN_MS, "Pins.Settings.TurnRoundMs": 120, "Pins.Settings.LongestMs": 150}
    yield Step("replies take some scans", late | {".Mark": "Bus.Timeouts"}, ms=300, shows=RUNNING)
    for words, frame in NOISE.items():
        for turn in range(3):
            yield Step(f"{words}, {turn}", _comes(bytes.fromhex(frame)), ms=(6 + turn) * SCAN_MS, shows=RUNNING)
    yield Step("nothing was lost", ms=100, shows=RUNNING | {
        "Bus.Timeouts - Mark": (0, 2 if mode == "rtu" else 99), "Bus.ForeignFrames": 0, "Seen.Starts": 1,
    })  # fmt: skip


def _other_write(drive: Drive, mode: str) -> Iterator[Step]:
    """It has the form of a refusal, and another address: the reply still comes."""
    late: Shows = {"Fate.HoldMs": 3 * SCAN_MS, "Pins.Settings.TurnRoundMs": 120, "Pins.Settings.LongestMs": 150}
    yield Step("replies take some scans", late | {".Mark": "Bus.Timeouts"}, ms=300)
    echo = _characters(mode, f"{serial(drive).lowest:02X} 06 12 34 00 05")
    for turn in range(3):
        yield Step(f"it comes, {turn}", {}, "TxCount > 0", 500)
        yield Step("before the reply", _comes(echo), ms=(4 + turn) * SCAN_MS, shows={"CommOk": True})
    yield Step("no reply was lost", ms=200, shows={
        "Bus.Timeouts - Mark": (0, 1), "Bus.Refusals": 0, "CommOk": True,
    })  # fmt: skip


def _wide() -> Iterator[Step]:
    yield Step("from here", {"Fate.Wide": True, ".Mark": "Bus.Timeouts"}, ms=1500, shows=RUNNING | {
        "Bus.Timeouts": "Mark", "Bus.Bad": 0, "OutputFrequencyHz": 30.0, "Bus.ForeignFrames": 0,
    })  # fmt: skip
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS)


def _late_stop() -> Iterator[Step]:
    late: Shows = {"Fate.HoldMs": 100, "Pins.Settings.LongestMs": 300, "RunForward": False}
    for _ in range(2):
        yield Step("replies come late", late, ms=60, shows={"CommOk": True})
        yield Step("another stop after each", {"Enable": False}, ms=100, shows={"Bus.ForeignFrames": 0})
        yield Step("no longer", {"Enable": True}, ms=300, shows={"Bus.ForeignFrames": 0})
    yield Step("in time again", {"Fate.HoldMs": 0}, "Motor.StopConfirmed", 4000, STANDS | {
        "Bus.ForeignFrames": 0, "Bus.LateReplies >= 1": True, "Slots[0].LongestReplyMs": (60, 320),
    })  # fmt: skip


def _late_other(can: Ability) -> Iterator[Step]:
    """They come when the other drive has been asked already, and are nobody's but its own."""
    other: Shows = {"Pins.OtherOn": True, "Pins.OtherUnit": serial(can.drive).lowest + 1}
    yield Step("two drives", other, "Other.Ready", 4000, {"Bus.ForeignFrames": 0})
    late = 80 if serial(can.drive).silence else 60  # a silence of the drive's own lengthens what is in time
    yield Step(
        "one is later than it may be",
        {"OtherFate.HoldMs": late},
        "NOT Slots[1].Online",
        9000,
        {"CommOk": True},
        brisk=False,
    )
    yield Step("it is asked now and then", {".Mark": "Bus.LateReplies"}, ms=5000, shows={
        "Bus.ForeignFrames": 0, "Bus.LateReplies - Mark": (2, 12), "Slots[1].LongestReplyMs": (35, 100),
        "Bus.LateReplies = Late": True, "Slots[0].LongestReplyMs <= 40": True,
        "CommOk": True, "Reason": "READY",
    }, brisk=False)  # fmt: skip
    yield Step("in time again", {"OtherFate.HoldMs": 0}, "Other.Ready", 9000, {"CommOk": True, "Bus.ForeignFrames": 0})


def _echo() -> Iterator[Step]:
    yield Step("none is heard", ms=500, shows={"Bus.Echo": 1})
    yield Step("the port is in trouble", {"Pins.PortErrorID": 3}, ms=60, shows={"Bus.Echo": 0})
    yield Step("then it echoes", {"Pins.PortErrorID": 0, "Fate.Echo": True}, "Bus.Echo = 2", 3000)
    yield Step("and is used so", {}, "Motor.Ready", 3000, {"Bus.ForeignFrames": 0})
    yield run()
    quiet: Shows = {"Fate.Echo": False, "RunForward": False}
    yield Step("no longer", quiet, "Motor.StopConfirmed", 6000, STANDS)
    yield Step("that is found out", {}, "Bus.Echo = 1", 3000, {"Bus.ForeignFrames": 0, "CommOk": True})


def _busy(can: Ability) -> Iterator[Step]:
    """A refusal that means: later. The line tries again, and nobody has to know."""
    yield Step("for a moment", {"Fate.Busy": True, "RunForward": True}, ms=400, shows=NOTHING_STARTED | {
        "Reason": "STARTING", "Error": False, "Slots[0].Refusals >= 3": True,
    }, brisk=False)  # fmt: skip
    yield Step("it starts", {"Fate.Busy": False}, "Motor.AtSpeed", 3000, RUNNING | {"Seen.Starts": 1, "ErrorID": 0})
    yield Step("a stop", {"Fate.Busy": True, "RunForward": False}, ms=1500, shows={"Seen.Driven": True})
    yield Step("is sent until it is taken", {"Fate.Busy": False}, "Motor.StopConfirmed", 4000, STANDS)
    for_good: Shows = {"Fate.Busy": True, "RunForward": True}
    yield Step("a start for good", for_good, why("REFUSED"), 4000, {
        "Seen.Starts": 1, "Seen.Driven": False, ".WaitedMs": (700, 2500), "Motor.ErrorID": 40,
        f"Slots[0].RefusedReason = {busy(can.drive)}": True,
    })  # fmt: skip
    yield Step("released", {"Fate.Busy": False, "RunForward": False}, "Motor.Ready", 4000, {"Seen.Starts": 1})


def _hurry() -> Iterator[Step]:
    """Between repeated writes the reads keep their turn."""
    begin: Shows = {".Hurry": True, "SpeedReferenceHz": 34.0, ".Mark": "Seen.Reads + Seen.References"}
    yield Step("35 Hz, more or less", begin, ms=2000, shows={
        "Running": True, "CommOk": True, "Seen.Reads + Seen.References - Mark": (31, 999), "Seen.References > 12": True,
        "Motor.Diagnosis.StatusAgeMs": (0, 600), "Seen.Starts": 1, "ABS(Seen.Milli - 35000) <= 3000": True,
    }, brisk=False)  # fmt: skip
    still: Shows = {".Hurry": False, "RunForward": False}
    yield Step("it stops", still, "Motor.StopConfirmed", 4000, STANDS)


def _varied() -> Iterator[Step]:
    dumb: Shows = {"Fate.Dumb": True, ".Mark": "Bus.Timeouts"}
    yield Step("a reply is lost", dumb, "Bus.Timeouts > Mark", 1000, {"CommOk": True})
    next_: Shows = {"Fate.Dumb": False, ".Lost": "Seen.Registers", ".Mark": "Seen.Reads"}
    cannot = "(Slots[0].OtherQuantity = 0) OR (Slots[0].OtherQuantity = Slots[0].Ask[3].Quantity)"
    yield Step("the next one is another, if it can be", next_, "Seen.Reads > Mark", 200, {
        f"{cannot} OR (Seen.Registers <> Lost)": True,
    })  # fmt: skip
    yield Step("then as ever", ms=1000, shows={"CommOk": True, "Reason": "READY"})


def _slots(can: Ability) -> Iterator[Step]:
    unit = serial(can.drive).lowest
    yield Step("none", ms=20, shows={"Bus.ErrorSlot": 0, "Bus.ErrorID": 0})
    yield Step("two with one address", {"Pins.OtherOn": True, "Pins.OtherUnit": unit}, "Bus.ErrorID = 55", 1000, {
        "Bus.ErrorSlot": 1, "Other.Ready": False,
    })  # fmt: skip
    yield Step("the port is worse", {"Pins.PortErrorID": 3}, ms=60, shows={"Bus.ErrorSlot": 0, "Bus.ErrorID": 57})
    yield Step("no time passes for a moment", {"Pins.PortErrorID": 0, "Pins.ElapsedMs": 0}, ms=400, shows={
        "Bus.ErrorID": 55, "Bus.ErrorSlot": 1,
    })  # fmt: skip
    again: Shows = {"Bus.ErrorSlot": 1, "Slots[0].LineErrorID = 55": True, "Slots[1].LineErrorID = 55": True}
    yield Step("it works again", {"Pins.ElapsedMs": SCAN_MS}, ms=60, shows=again)
