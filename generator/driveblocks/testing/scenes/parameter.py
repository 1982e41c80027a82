"""Scenes of parameters: read, written, refused, stored, beside a motor that must not move meanwhile."""

from collections.abc import Iterator

from driveblocks.maps.model import Drive
from driveblocks.reference.permission import Judge, Write, readable, writable
from driveblocks.st.writing import word
from driveblocks.testing.code import NUMBERS
from driveblocks.testing.scenes.ability import Ability
from driveblocks.testing.scenes.motor import NOTHING_STARTED, STANDS, run
from driveblocks.testing.scenes.scene import More, Scene, Shows, Step, Value, scene, script, why
from driveblocks.testing.script import SCAN_MS, Script

BLOCKS = {
    "Reader": ("VFD_ReadParameter", "under test: reads a parameter"),
    "Writer": ("VFD_WriteParameter", "under test: writes one"),
    "Storer": ("VFD_Store", "under test: stores them"),
    "Reading": ("BOOL", "its pin Execute"),
    "Writing": ("BOOL", "its pin Execute"),
    "Storing": ("BOOL", "its pin Execute"),
    "Place": ("WORD", "register"),
    "Count": ("UINT", "how many"),
    "Given": ("WORD", "what is written there"),
    "Unknown": ("BOOL", "its pin AllowUnknown"),
    "Stores": ("UDINT", "times that the drive was told to store"),
}
CALLS = (
    "Reader(Execute := Reading, Address := Place, Quantity := Count, AllowUnknown := Unknown, WithinMs := 1500,",
    "  Slot := Slots[0]);",
    "Writer(Execute := Writing, Address := Place, Quantity := Count, Value := Given, Value2 := Given,",
    "  AllowUnknown := Unknown, WithinMs := 1500, Slot := Slots[0]);",
    "Storer(Execute := Storing, WithinMs := 1500, Slot := Slots[0], Stores := Stores);",
)
IDLE: Shows = {
    ".Reading": False, ".Writing": False, ".Storing": False, ".Count": 1, ".Unknown": False, "Pins.Others": 100,
    "Pins.Stores": 100,
}  # fmt: skip


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program."""
    more = More(blocks=BLOCKS, calls=CALLS)
    yield script(drive, stem, "Parameters", "parameters beside a motor", scenes(Ability(drive)), more)


def scenes(can: Ability) -> Iterator[Scene]:
    """All scenes of parameters, as far as the map has any."""
    yield scene("what may not be read or written", _idle(), *_barred(can))
    place = _place(can.drive)
    if place is None:
        return
    yield scene("a parameter is written and read", _idle(), *_there_and_back(place))
    yield scene("a drive that refuses or is silent", _idle(), *_in_vain(place))
    yield scene("a parameter while the motor runs", _idle(), run(), *_while_it_runs(can, place))
    yield scene("a start while a parameter is written", _idle(), *_waits(place))
    if can.drive.storage.method == "enter_register":
        yield scene("parameters are stored", _idle(), *_stored())


def _place(drive: Drive) -> int | None:
    """A register that may be written with a small word at standstill, and read."""
    judge = Judge(drive)
    both = sorted(readable(drive) & writable(drive))
    return next((each for each in both if judge.result(Write(each, 3)) == "OK"), None)


def _idle() -> Step:
    return Step("power-up", IDLE, "Motor.Ready", 2000, {"Reason": "READY"})


def _does(block: str, place: int, until: str, shows: Shows, **sets: Value) -> Iterator[Step]:
    """An edge of Execute, what comes of it, and its release."""
    execute = {"Reader": ".Reading", "Writer": ".Writing", "Storer": ".Storing"}[block]
    given: Shows = {execute: True, ".Place": word(place)}
    given |= {f".{key}": each for key, each in sets.items()}
    yield Step(f"{block}.Execute", given, f"{block}.{until}", 2500, {f"{block}.Busy": False} | shows)
    yield Step("released", {execute: False, ".Unknown": False, ".Count": 1}, ms=30, shows={
        f"{block}.Done": False, f"{block}.Error": False,
    })  # fmt: skip


def _error(block: str, name: str) -> Shows:
    return {f"{block}.ErrorID": NUMBERS[name], f"{block}.Done": False}


def _barred(can: Ability) -> Iterator[Step]:
    operation = can.drive.operation
    listed = readable(can.drive) | writable(can.drive)
    free = next(each for each in range(0xFFFF, 0, -1) if each not in listed)
    command = next(one.register for one in operation.commands if one.does == "stop")
    untouched: Shows = {"Seen.Others": 0, "Seen.Starts": 0}
    for place in dict.fromkeys((command, operation.reference.register)):
        owned = _error("Writer", "OWNED") | untouched
        yield from _does("Writer", place, "Error", owned, Given=word(1), Unknown=True)
    yield from _does("Writer", free, "Error", _error("Writer", "UNKNOWN_ADDRESS") | untouched, Given=word(1))
    yield from _does("Reader", free, "Error", _error("Reader", "NOT_READABLE"))
    yield from _does("Reader", free, "Error", _error("Reader", "REFUSED") | {"StopConfirmed": True}, Unknown=True)
    yield from _does("Reader", 0xFFFF, "Error", _error("Reader", "WRAP"), Count=2)
    yield from _does("Reader", free, "Error", _error("Reader", "QUANTITY"), Count=5)
    yield from _does("Writer", free, "Error", _error("Writer", "QUANTITY"), Count=4)
    yield Step("the motor has not moved", ms=50, shows=NOTHING_STARTED | {"StopConfirmed": True, "Seen.Others": 0})


def _there_and_back(place: int) -> Iterator[Step]:
    written: Shows = {"Seen.Others": 1, f"Seen.LastWord = {word(3)}": True}
    yield from _does("Writer", place, "Done", written, Given=word(3))
    yield from _does("Reader", place, "Done", {f"Reader.Value = {word(3)}": True})
    yield from _does("Writer", place, "Done", {"Seen.Others": 2}, Given=word(2))
    yield from _does("Reader", place, "Done", {f"Reader.Value = {word(2)}": True})
    both: Shows = {".Reading": True, ".Writing": True, ".Given": word(4)}
    yield Step("both at once", both, "Reader.Done AND Writer.Done", 2000, {"Seen.Others": 3})
    yield Step("released", {".Reading": False, ".Writing": False}, "Motor.Ready", 500, NOTHING_STARTED)


def _in_vain(place: int) -> Iterator[Step]:
    nothing: Shows = {"Seen.Others": 0}
    yield Step("it refuses writes", {"Fate.RefusesWrites": True}, ms=50, shows=nothing)
    yield from _does("Writer", place, "Error", _error("Writer", "REFUSED") | nothing, Given=word(3))
    lost: Shows = {"Fate.RefusesWrites": False, "Fate.Skips": True, "Fate.Skipped": word(place)}
    yield Step("its answer stays away", lost, ms=50, shows=nothing)
    yield from _does("Writer", place, "Error", _error("Writer", "SILENCE") | nothing, Given=word(3))
    yield Step("it is dead", {"Fate.Cut": True}, why("OFFLINE"), 3000, nothing)
    yield from _does("Reader", place, "Error", _error("Reader", "OFFLINE"))


def _while_it_runs(can: Ability, place: int) -> Iterator[Step]:
    nothing: Shows = {"Seen.Others": 0, "Running": True}
    if Judge(can.drive).result(Write(place, 3, stopped=False)) == "NOT_STOPPED":
        refused = _error("Writer", "NOT_STOPPED") | nothing
        yield from _does("Writer", place, "Error", refused, Given=word(3))
    yield from _does("Reader", place, "Done", {"Running": True, "Seen.Starts": 1})
    yield Step("it stops", {"RunForward": False}, "Motor.StopConfirmed", 3000, STANDS)


def _waits(place: int) -> Iterator[Step]:
    pending: Shows = {".Writing": True, ".Place": word(place), ".Given": word(3), "Fate.Skips": True}
    pending |= {"Fate.Skipped": word(place)}
    yield Step("its answer stays away", pending, why("WRITE_WAITS"), 500, {"Ready": False, "Writer.Busy": True})
    yield Step("an edge starts nothing", {"RunForward": True}, ms=60, shows=NOTHING_STARTED | {"Reason": "WRITE_WAITS"})
    yield Step("it is given up", {".Writing": False}, "NOT Writer.Busy", 3000, NOTHING_STARTED)
    yield Step("released", {"RunForward": False, "Fate.Skips": False}, "Motor.Ready", 2000)
    yield run()


def _stored() -> Iterator[Step]:
    yield from _does("Storer", 0, "Error", _error("Storer", "TOO_SOON") | {"Seen.Stores": 0})
    yield Step("a minute passes", {"Pins.ElapsedMs": 500}, ms=2600, shows=NOTHING_STARTED)
    yield Step("at its usual pace", {"Pins.ElapsedMs": SCAN_MS}, "Motor.Ready", 3000, {"Seen.Stores": 0})
    yield from _does("Storer", 0, "Done", {"Seen.Stores": 1, "Stores = UINT_TO_UDINT(1)": True})
    yield from _does("Storer", 0, "Error", _error("Storer", "TOO_SOON") | {"Seen.Stores": 1})
