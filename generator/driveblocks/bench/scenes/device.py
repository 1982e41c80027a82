"""Scenes of a meter beside a motor: what MB_Device reads and writes, and that neither disturbs the other."""

from collections.abc import Iterator

from driveblocks.bench.code import NUMBERS
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import simulated
from driveblocks.bench.scenes.motor import RUNNING, STANDS, run
from driveblocks.bench.scenes.parameter import place_of
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script
from driveblocks.bench.script import Script
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import most
from driveblocks.meaning.serial import serial
from driveblocks.modbus.layout import Dialect
from driveblocks.reference.permission import readable
from structured_text.language.writing import word

MORE = More(
    other=True,
    blocks={
        "Meter": ("MB_Device", "under test: the meter, which the second drive plays"),
        "Metered": ("MB_Words16", "what it shows"),
        "MeterUnit": ("USINT", "its pin Address"),
        "Code": ("USINT", "its pin FunctionCode"),
        "Place": ("WORD", "its pin First"),
        "Count": ("USINT", "its pin Quantity"),
        "Bytes": ("BOOL", "its pin SwapBytes"),
        "Pairs": ("BOOL", "its pin SwapWords"),
        "Within": ("UINT", "its pin StaleMs"),
        "Off": ("BOOL", "its pin SupplyOff"),
        "Writing": ("BOOL", "its pin Write"),
        "Several": ("BOOL", "its pin WriteMultiple"),
        "Target": ("WORD", "its pin WriteFirst"),
        "Given": ("WORD", "its pin Value"),
    },
    calls=(
        "Meter(Address := MeterUnit, FunctionCode := Code, First := Place, Quantity := Count, SwapBytes := Bytes,",
        "  SwapWords := Pairs, StaleMs := Within, TurnRoundMs := 30, LongestMs := 60, SupplyOff := Off,",
        "  Write := Writing, WriteFirst := Target, WriteMultiple := Several, Value := Given, Slot := Slots[1],",
        "  Words := Metered);",
    ),
)
HELD = (0x0102, 0xA0B0, 0x7FFF)
"""Words of the meter."""
FLOATS = ((0x4148, 0, "12.5"), (0xBE80, 0, "-0.25"), (0x4B00, 1, "8388609.0"), (0x4CC0, 0, "1.00663296E8"),
          (0x0040, 0, "0.0"), (0xFF80, 0, "-3.4E38"))  # fmt: skip
"""High word, low word, and what MB_Float makes of them; the last one is minus infinity."""
STALE_MS = 800


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program; none where the line has but one unit address, or the drive fewer registers than the meter."""
    first = _first(drive)
    if first is not None and serial(drive).highest > serial(drive).lowest:
        yield script(drive, stem, "MotorMeter", "a meter beside a motor", scenes(Ability(drive), first), MORE)


def scenes(can: Ability, first: int) -> Iterator[Scene]:
    drive = can.drive
    begin = tuple(_begin(drive, first))
    yield scene("a meter is read beside a motor", *begin, run(), *_beside())
    yield scene("a meter that sends its words in another order", *begin, *_orders())
    yield scene("pins of a meter that make no sense", *begin, *_senseless(drive, first))
    yield scene("a meter that falls silent", *begin, *_silent())
    if simulated(drive).dialect == Dialect():
        yield scene("a meter that refuses", *begin, *_refused())
    place = place_of(drive)
    if place is not None:
        yield scene("a meter is written", *begin, *_written(drive, place))


def _first(drive: Drive) -> int | None:
    """The first of three registers in a row that a read may ask for."""
    count, free = len(HELD), readable(drive)
    runs = (each for each in sorted(free) if all(each + more in free for more in range(count)))
    return next(runs, None) if all(most(drive, mode).read >= count for mode in serial(drive).modes) else None


def _code(drive: Drive) -> int:
    """The function by which it is read; 0: the meter's usual one, 03H."""
    return 0 if any(function.code == 3 for function in drive.functions) else 4


def _shown(*words: int) -> Shows:
    """What the words are, and that none follows."""
    return {f"Metered[{at}] = {word(each)}": True for at, each in enumerate((*words, 0))}


def _wrong(name: str) -> Shows:
    """What is wrong with reading; the words are then not to be used."""
    return {"Meter.Valid": False, "Meter.Error": name != "OK", "Meter.ErrorID": NUMBERS[name]}


GOOD: Shows = {"Meter.Valid": True, "Meter.CommOk": True, "Meter.ErrorID": 0, "Meter.Error": False}


def _begin(drive: Drive, first: int) -> Iterator[Step]:
    unit = serial(drive).lowest + 1
    pins: Shows = {
        ".MeterUnit": unit, ".Code": _code(drive), ".Place": word(first), ".Count": len(HELD),
        ".Bytes": False, ".Pairs": False, ".Within": STALE_MS, ".Off": False, ".Writing": False,
    }  # fmt: skip
    yield Step("power-up", pins, "Motor.Ready", 3000, {"Reason": "READY"}, brisk=True)
    held: Shows = {f"OtherFate.Filled[{at}]": word(each) for at, each in enumerate(HELD)}
    fills: Shows = {"OtherFate.Fills": True, "OtherFate.FillAt": word(first)}
    words = GOOD | _shown(*HELD) | {"Meter.AgeMs": (0, 400)}
    yield Step("the meter has words", held | fills, f"Meter.Valid AND {next(iter(_shown(HELD[0])))}", 3000, words)


def _beside() -> Iterator[Step]:
    yield Step("both", ms=500, shows=RUNNING | GOOD | _shown(*HELD) | {"OtherSeen.Writes": 0})
    yield Step("StopAll", {"Pins.StopAll": True}, "Motor.StopConfirmed", 4000, GOOD | {
        "OtherSeen.Writes": 0, "Bus.StopOverdue": False,
    })  # fmt: skip
    yield Step("released", {"Pins.StopAll": False, "RunForward": False}, "Motor.Ready", 4000, STANDS | GOOD)
    again: Shows = {"Pins.Restart": True}
    yield Step("a restart", again, ms=40, shows={"Meter.Valid": False, "Meter.AgeMs": 65535} | _shown(0, 0))
    yield Step("it is read anew", {"Pins.Restart": False}, "Meter.Valid", 1000, _shown(*HELD))


def _orders() -> Iterator[Step]:
    bytes_ = [each % 256 * 256 + each // 256 for each in HELD]
    yield Step("the low byte first", {".Bytes": True}, ms=400, shows=GOOD | _shown(*bytes_))
    yield Step("and the low word", {".Pairs": True}, ms=400, shows=GOOD | _shown(bytes_[1], bytes_[0], bytes_[2]))
    yield Step("the low word", {".Bytes": False}, ms=400, shows=GOOD | _shown(HELD[1], HELD[0], HELD[2]))
    floats: Shows = {
        f"MB_Float(High := {word(high)}, Low := {word(low)}) = REAL#{real}": True for high, low, real in FLOATS
    }
    yield Step("numbers with a decimal point", ms=100, shows=floats)


def _senseless(drive: Drive, first: int) -> Iterator[Step]:
    unit = serial(drive).lowest + 1
    right: Shows = {
        ".MeterUnit": unit,
        ".Code": _code(drive),
        ".Count": len(HELD),
        ".Place": word(first),
        ".Within": STALE_MS,
    }
    for words, pins, name in (
        ("no address", {".MeterUnit": 0}, "UNIT"),
        ("an address beyond 247", {".MeterUnit": 248}, "UNIT"),
        ("a function that does not read", {".Code": 6}, "FUNCTION"),
        ("too many registers", {".Count": 17}, "QUANTITY"),
        ("registers beyond the last", {".Place": word(0xFFFE)}, "WRAP"),
        ("a time that switches nothing off", {".Within": 65535}, "BAD_SETTING"),
        ("the address of the drive", {".MeterUnit": unit - 1}, "DOUBLED"),
    ):
        yield Step(words, {**right, **pins}, ms=150, shows=_wrong(name))
        yield Step("nothing is sent", {".Mark": "OtherSeen.Reads"}, ms=100, shows={"OtherSeen.Reads": "Mark"})
    yield Step("right again", right, "Meter.Valid AND Meter.CommOk AND Motor.CommOk", 9000, GOOD | _shown(*HELD))


def _silent() -> Iterator[Step]:
    cut: Shows = {"OtherFate.Cut": True}
    yield Step("for a moment", cut, ms=STALE_MS // 2, shows={"Meter.Valid": True, "CommOk": True})
    yield Step("for longer", {}, "NOT Meter.CommOk", 3000, _wrong("OFFLINE") | _shown(*HELD) | {"CommOk": True})
    yield run()
    yield Step("a stop is in time", {"RunForward": False}, "Motor.StopConfirmed", 4000, STANDS | {
        "Bus.StopOverdue": False,
    })  # fmt: skip
    yield Step("it has no power on purpose", {".Off": True}, ms=60, shows=_wrong("OK") | {"Bus.AllOnline": True})
    yield Step(
        "it is back",
        {"OtherFate.Cut": False, ".Off": False},
        "Meter.Valid AND Meter.CommOk",
        9000,
        GOOD | _shown(*HELD),
    )


def _refused() -> Iterator[Step]:
    refuses: Shows = {"OtherFate.RefusesReads": True}
    yield Step("every read", refuses, ms=STALE_MS + 200, shows=_wrong("REFUSED") | {
        "Meter.CommOk": True, "Meter.RefusedReason > 0": True, "CommOk": True,
    })  # fmt: skip
    yield Step("no longer", {"OtherFate.RefusesReads": False}, "Meter.Valid", 1000, GOOD | _shown(*HELD))


def _written(drive: Drive, place: int) -> Iterator[Step]:
    single = any(function.code == 6 for function in drive.functions)
    edge: Shows = {".Target": word(place), ".Given": word(3), ".Several": not single, ".Writing": True}
    once: Shows = {
        f"OtherSeen.LastWord = {word(3)}": True, f"OtherSeen.LastRegister = {word(place)}": True, "OtherSeen.Writes": 1,
    }  # fmt: skip
    yield Step("a rising edge", edge, "Meter.WriteDone", 2500, GOOD | once | {"Meter.WriteError": False})
    yield Step("it is held", ms=500, shows=GOOD | once | {"Meter.WriteBusy": False})
    yield Step("it falls", {".Writing": False}, ms=40, shows={"Meter.WriteDone": False})
    cut: Shows = {"OtherFate.Cut": True, ".Writing": True}
    yield Step(
        "nobody answers", cut, "Meter.WriteError", 5000, {"Meter.WriteDone": False, "Meter.WriteErrorID > 0": True}
    )
