"""Scenes of parameters: read, written, refused, stored, beside a motor that must not move meanwhile."""

from collections.abc import Iterator

from driveblocks.bench.code import NUMBERS
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import mark, simulated
from driveblocks.bench.scenes.motor import NOTHING_STARTED, STANDS, run
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, Value, scene, script, why
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.form import space_of
from driveblocks.maps.model import Drive
from driveblocks.meaning.measure import own_maximum
from driveblocks.meaning.reference import reference
from driveblocks.meaning.status import registers, status
from driveblocks.meaning.words import words
from driveblocks.reference.permission import Judge, Write, readable, writable
from structured_text.language.writing import word

BLOCKS = {
    "Reader": ("VFD_ReadParameter", "under test: reads a parameter"),
    "Writer": ("VFD_WriteParameter", "under test: writes one"),
    "Storer": ("VFD_Store", "under test: stores them"),
    "Rival": ("VFD_ReadParameter", "reads one again and again, so is the next"),
    "Rival2": ("VFD_ReadParameter", "..."),
    "Behind": ("VFD_ReadParameter", "... called after all others"),
    "Presses": ("BOOL", "it is at it"),
    "Reading": ("BOOL", "its pin Execute"),
    "Writing": ("BOOL", "its pin Execute"),
    "Storing": ("BOOL", "its pin Execute"),
    "Rivals": ("BOOL", "both are at it"),
    "Rests": ("BOOL", "Reader is not called"),
    "Place": ("WORD", "register"),
    "Count": ("UINT", "how many"),
    "Given": ("WORD", "what is written there"),
    "Given2": ("WORD", "... after it"),
    "Given3": ("WORD", "... after that"),
    "Unknown": ("BOOL", "its pin AllowUnknown"),
    "Within": ("UINT", "its pin WithinMs"),
    "Minimum": ("UINT", "its pin MinimumS"),
    "Stores": ("UDINT", "number of stores of the drive"),
    "Upset": ("BOOL", "one of the rivals has not got its answer"),
    "Hastes": ("BOOL", "Reader begins anew in the call after a failure"),
    "Slips": ("BOOL", "the port takes characters in the scan in which the writer gives up"),
    "Clash": ("BOOL", "Busy, Done and Error of a block have not excluded each other"),
}
_RIVAL = (
    "{0}(Execute := Rivals AND NOT {0}.Done AND NOT {0}.Error, Address := Place, WithinMs := 5000,",
    "  Slot := Slots[0]);",
)
CALLS = (
    *(line.format(name) for name in ("Rival", "Rival2") for line in _RIVAL),
    "Reading := Reading OR (Hastes AND Reader.Error);",
    "IF NOT Rests THEN",
    "  Reader(Execute := Reading, Address := Place, Quantity := Count, AllowUnknown := Unknown, WithinMs := Within,",
    "    Slot := Slots[0]);",
    "END_IF;",
    "Writer(Execute := Writing, Address := Place, Quantity := Count, Value := Given, Value2 := Given2,",
    "  Value3 := Given3, AllowUnknown := Unknown, WithinMs := Within, Slot := Slots[0]);",
    "IF Slips AND Writer.Error THEN",
    "  Pins.TxBusy := FALSE;",
    "END_IF;",
    "Storer(Execute := Storing, MinimumS := Minimum, WithinMs := Within, Slot := Slots[0], Stores := Stores);",
    "Behind(Execute := Presses AND NOT Behind.Done AND NOT Behind.Error, Address := Place, WithinMs := 5000,",
    "  Slot := Slots[0]);",
    "Upset := Upset OR Rival.Error OR Rival2.Error OR Behind.Error;",
    "Clash := Clash OR (Reader.Busy AND (Reader.Done OR Reader.Error)) OR (Reader.Done AND Reader.Error)",
    "  OR (Writer.Busy AND (Writer.Done OR Writer.Error)) OR (Writer.Done AND Writer.Error)",
    "  OR (Storer.Busy AND (Storer.Done OR Storer.Error)) OR (Storer.Done AND Storer.Error)",
    "  OR (Reader.Error <> (Reader.ErrorID > 0)) OR (Writer.Error <> (Writer.ErrorID > 0))",
    "  OR (Storer.Error <> (Storer.ErrorID > 0));",
)
WITHIN_MS = 1500
IDLE: Shows = {
    ".Reading": False, ".Writing": False, ".Storing": False, ".Count": 1, ".Unknown": False, "Pins.Others": 100,
    "Pins.Stores": 100, ".Within": WITHIN_MS, ".Rivals": False, ".Rests": False, ".Minimum": 0, ".Clash": False,
    ".Upset": False, ".Presses": False, ".Slips": False, ".Hastes": False,
}  # fmt: skip


EXECUTE = {"Reader": ".Reading", "Writer": ".Writing", "Storer": ".Storing"}


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    more = More(blocks=BLOCKS, calls=CALLS)
    can = Ability(drive)
    yield script(drive, stem, "Parameters", "parameters beside a motor", scenes(can), more)


def scenes(can: Ability) -> Iterator[Scene]:
    yield scene("what may not be read or written", idle(), *_barred(can))
    place = place_of(can.drive)
    if place is None:
        return
    yield scene("a parameter is written and read", idle(), *_there_and_back(place))
    yield scene("a drive that refuses or is silent", idle(), *_in_vain(can.drive, place))
    yield scene("a parameter while the motor runs", idle(), run(), *_while_it_runs(can, place))
    yield scene("a start while a parameter is written", idle(), *_waits(place))
    if can.drive.storage.method == "enter_register":
        yield scene("parameters are stored", idle(), *_stored(place))
        yield scene("parameters are stored without success", idle(), *_not_stored(can.drive))


def place_of(drive: Drive) -> int | None:
    """A register that may be written with a small word at standstill, and read."""
    judge = Judge(drive)
    both = sorted((readable(drive) & writable(drive)) - meant(drive))
    return next((each for each in both if judge.result(Write(each, 3)) == "OK"), None)


def meant(drive: Drive) -> frozenset[int]:
    """Registers whose words the drive block looks at."""
    own = own_maximum(drive)
    return frozenset(registers(status(drive).settled)) | ({own.register} if own else frozenset())


def idle() -> Step:
    return Step("power-up", IDLE, "Motor.Ready", 4000, {"Reason": "READY"}, brisk=True)


def does(block: str, place: int, until: str, shows: Shows, **sets: Value) -> Iterator[Step]:
    """An edge of Execute, what comes of it, and its release."""
    execute = EXECUTE[block]
    given: Shows = {execute: True, ".Place": word(place)}
    given |= {f".{key}": each for key, each in sets.items()}
    yield Step(f"{block}.Execute", given, f"{block}.{until}", 2500, {f"{block}.Busy": False} | shows)
    yield Step("released", {execute: False, ".Unknown": False, ".Count": 1}, ms=30, shows={
        f"{block}.Done": False, f"{block}.Error": False, f"{block}.RefusedReason": 0, "Clash = FALSE": True,
    })  # fmt: skip


def error(block: str, name: str) -> Shows:
    """A result that is none."""
    found: Shows = {f"{block}.ErrorID": NUMBERS[name], f"{block}.Done": False}
    return found if name == "REFUSED" else found | {f"{block}.RefusedReason": 0}


def _barred(can: Ability) -> Iterator[Step]:
    listed = readable(can.drive) | writable(can.drive)
    free = next(each for each in range(0xFFFF, 0, -1) if each not in listed)
    untouched: Shows = {"Seen.Others": 0, "Seen.Starts": 0}
    written = (words(can.drive).stop.last.register, reference(can.drive).register)
    for place in dict.fromkeys(each for each in written if space_of(each) == "holding"):
        owned = error("Writer", "OWNED") | untouched
        yield from does("Writer", place, "Error", owned, Given=word(1), Unknown=True)
    yield from does("Writer", free, "Error", error("Writer", "UNKNOWN_ADDRESS") | untouched, Given=word(1))
    yield from does("Reader", free, "Error", error("Reader", "NOT_READABLE"))
    refused = error("Reader", "REFUSED") | {
        "StopConfirmed": True,
        "Reader.RefusedReason": simulated(can.drive).codes["address"] or 0,
    }
    yield from does("Reader", free, "Error", refused, Unknown=True)
    yield from does("Reader", 0xFFFF, "Error", error("Reader", "WRAP"), Count=2)
    yield from does("Reader", free, "Error", error("Reader", "QUANTITY"), Count=5)
    yield from does("Writer", free, "Error", error("Writer", "QUANTITY"), Count=4)
    yield Step("the motor has not moved", ms=50, shows=NOTHING_STARTED | {"StopConfirmed": True, "Seen.Others": 0})


def _there_and_back(place: int) -> Iterator[Step]:
    written: Shows = {"Seen.Others": 1, f"Seen.LastWord = {word(3)}": True}
    yield from does("Writer", place, "Done", written, Given=word(3))
    yield from does("Reader", place, "Done", {f"Reader.Value = {word(3)}": True})
    yield from does("Writer", place, "Done", {"Seen.Others": 2}, Given=word(2))
    yield from does("Reader", place, "Done", {f"Reader.Value = {word(2)}": True})
    both: Shows = {".Reading": True, ".Writing": True, ".Given": word(4)}
    yield Step("both at once", both, "Reader.Done AND Writer.Done", 2000, {"Seen.Others": 3})
    yield Step("released", {".Reading": False, ".Writing": False}, "Motor.Ready", 500, NOTHING_STARTED)


def _in_vain(drive: Drive, place: int) -> Iterator[Step]:
    nothing: Shows = {"Seen.Others": 0}
    yield Step("it refuses writes", {"Fate.RefusesWrites": True}, ms=50, shows=nothing)
    code = simulated(drive).codes["address"] or 0
    refused = error("Writer", "REFUSED") | nothing | {"Writer.RefusedReason": code, "Slots[0].RefusedReason": code}
    yield from does("Writer", place, "Error", refused, Given=word(3))
    lost: Shows = {"Fate.RefusesWrites": False, "Fate.Skips": True, "Fate.Skipped": word(mark(place))}
    yield Step("its answer stays away", lost, ms=50, shows=nothing)
    yield from does("Writer", place, "Error", error("Writer", "SILENCE") | nothing, Given=word(3))
    yield from does("Reader", place, "Done", {"Reader.RefusedReason": 0, "Reader.ErrorID": 0})
    yield Step("it is dead", {"Fate.Cut": True}, why("OFFLINE"), 3000, nothing)
    yield from does("Reader", place, "Error", error("Reader", "OFFLINE"))


def _while_it_runs(can: Ability, place: int) -> Iterator[Step]:
    nothing: Shows = {"Seen.Others": 0, "Running": True}
    if Judge(can.drive).result(Write(place, 3, stopped=False)) == "NOT_STOPPED":
        refused = error("Writer", "NOT_STOPPED") | nothing
        yield from does("Writer", place, "Error", refused, Given=word(3))
    yield from does("Reader", place, "Done", {"Running": True, "Seen.Starts": 1})
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS)


def _waits(place: int) -> Iterator[Step]:
    pending: Shows = {".Writing": True, ".Place": word(place), ".Given": word(3), "Fate.Skips": True}
    pending |= {"Fate.Skipped": word(mark(place))}
    yield Step("its answer stays away", pending, why("WRITE_WAITS"), 500, {"Ready": False, "Writer.Busy": True})
    yield Step("an edge starts nothing", {"RunForward": True}, ms=60, shows=NOTHING_STARTED | {"Reason": "WRITE_WAITS"})
    yield Step("a stop is a new one", {"Enable": False}, ms=60, shows={"Slots[0].StopAgain": False})
    yield Step("it is given up", {".Writing": False, "Enable": True}, "NOT Writer.Busy", 3000, NOTHING_STARTED)
    yield Step("released", {"RunForward": False, "Fate.Skips": False}, "Motor.Ready", 2000)
    yield run()


def _minute() -> Iterator[Step]:
    """From one store to the next."""
    yield Step("a minute passes", {"Pins.ElapsedMs": 500}, ms=2600, shows=NOTHING_STARTED)
    yield Step("at its usual pace", {"Pins.ElapsedMs": SCAN_MS}, "Motor.Ready", 3000, {"Seen.Stores": 0})


def _not_stored(drive: Drive) -> Iterator[Step]:
    yield from _minute()
    nothing: Shows = {"Seen.Stores": 0}
    yield Step("it refuses writes", {"Fate.RefusesWrites": True}, ms=50, shows=nothing)
    refused = error("Storer", "REFUSED") | nothing | {"Storer.RefusedReason": simulated(drive).codes["address"] or 0}
    yield from does("Storer", 0, "Error", refused)
    yield Step("it is well", {"Fate.RefusesWrites": False}, ms=50, shows=nothing)
    yield from does("Storer", 0, "Error", error("Storer", "TOO_SOON") | nothing)
    yield from _minute()
    lost: Shows = {"Fate.Skips": True, "Fate.Skipped": word(mark(drive.storage.register or 0))}
    yield Step("its answers are lost", lost | {"Pins.ParameterRetries": 200}, ms=20, shows=nothing)
    yield from does("Storer", 0, "Error", error("Storer", "SILENCE"), Within=600)
    yield Step("it answers", {"Fate.Skips": False, ".Within": WITHIN_MS}, "Motor.Ready", 2000)
    yield Step("it is dead", {"Fate.Cut": True}, why("OFFLINE"), 3000)
    yield Step("a minute passes", {"Pins.ElapsedMs": 500}, ms=2600)
    yield Step("at its usual pace", {"Pins.ElapsedMs": SCAN_MS}, ms=100)
    yield from does("Storer", 0, "Error", error("Storer", "OFFLINE"))


def _stored(place: int) -> Iterator[Step]:
    yield from does("Storer", 0, "Error", error("Storer", "TOO_SOON") | {
        "Seen.Stores": 0, "Storer.Worn": False,
    })  # fmt: skip
    yield from _minute()
    rivals: Shows = {".Rivals": True, ".Place": word(place)}
    yield Step("two that read without rest", rivals, ms=200, shows={"Storer.Busy": False})
    yield Step("Execute", {".Storing": True, ".Within": 8000, ".Mark": "Slots[0].Ask[2].Number"}, ms=40, shows={
        "Storer.Busy": True, "Storer.Done": False, "Storer.Error": False, "Storer.ErrorID": 0,
    })  # fmt: skip
    yield Step("it gets its turn", {}, "Storer.Done", 4500, {
        "Slots[0].Ask[2].Number - Mark": (17, 21), "Seen.Stores": 1, "Stores = UINT_TO_UDINT(1)": True,
        "Storer.Busy": False,
    })  # fmt: skip
    rest: Shows = {".Rivals": False, ".Storing": False}
    yield Step("all rest", rest, "NOT (Rival.Busy OR Rival2.Busy)", 1000, {"Storer.Done": False, "Clash = FALSE": True})
    yield from does("Storer", 0, "Error", error("Storer", "TOO_SOON") | {
        "Seen.Stores": 1, "Stores = UINT_TO_UDINT(1)": True,
    })  # fmt: skip
