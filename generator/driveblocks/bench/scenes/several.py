"""Scenes of parameters, continued: several registers at once, blocks that wait for their turn, and time."""

from collections.abc import Iterator

from driveblocks.bench.code import NUMBERS
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import mark
from driveblocks.bench.scenes.motor import NOTHING_STARTED
from driveblocks.bench.scenes.parameter import BLOCKS, CALLS, WITHIN_MS, does, error, idle, meant, place_of
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script
from driveblocks.bench.script import SCAN_MS, Script
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import most
from driveblocks.reference.permission import Judge, Write, readable, writable
from structured_text.language.writing import word

MOST_READ, MOST_WRITTEN = 4, 3
"""Registers of a block."""
FILLED = (0x0102, 0xA0B0, 0x7FFF, 0x8001)
GIVEN = (3, 2, 4)
"""Small words, which most registers take."""
SLACK = 4 * SCAN_MS


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    more = More(blocks=BLOCKS, calls=CALLS)
    yield script(drive, stem, "ParameterTurns", "several registers, turns and time", scenes(Ability(drive)), more)


def scenes(can: Ability) -> Iterator[Scene]:
    yield scene("several registers are read", idle(), *_read(can.drive))
    yield scene("several registers are written", idle(), *_written(can.drive))
    yield scene("one of several that may not be written", idle(), *_not_all(can.drive))
    yield scene("asked by hand", idle(), *_by_hand(can.drive))
    place = place_of(can.drive)
    if place is None:
        return
    yield scene("blocks that wait for their turn", idle(), *_turns(place))
    yield scene("a block that is called after the others", idle(), *_one_behind(place))
    yield scene("what is not done in time", idle(), *_in_time(place))
    yield scene("a short pulse of Execute", idle(), *_pulse(place))
    yield scene("a line or a block that is not called meanwhile", idle(), *_not_called(place))


def _runs(addresses: frozenset[int], length: int) -> Iterator[int]:
    """The first of this many addresses that follow one another."""
    return (each for each in sorted(addresses) if all(each + more in addresses for more in range(length)))


# ---------------------------------------------------------------- several registers


def _read(drive: Drive) -> Iterator[Step]:
    for count in range(1, MOST_READ + 1):
        place = next(_runs(readable(drive), count), None)
        if place is None or count > most(drive, "rtu").read:
            return
        held: Shows = {f"Fate.Filled[{at}]": word(each) for at, each in enumerate(FILLED)}
        yield Step(f"the drive has {count}", held | {"Fate.FillAt": word(place)}, ms=20)
        values = [FILLED[at] if at < count else 0 for at in range(MOST_READ)]
        shows: Shows = {
            f"Reader.Value{at or ''} = {word(each)}": True for at, each in zip((0, 2, 3, 4), values, strict=True)
        }
        yield Step("it holds them", {"Fate.Fills": True, ".Place": word(place), ".Count": count, ".Reading": True},
            "Reader.Done", 2500, shows | {"Reader.RefusedReason": 0})  # fmt: skip
        yield Step("released", {"Fate.Fills": False, ".Reading": False}, ms=40, shows=shows | {"Reader.Done": False})


def _most_written(drive: Drive) -> int:
    """Registers that one write of the family may have."""
    if all(function.code != 16 for function in drive.functions):
        return 1
    return min(MOST_WRITTEN, most(drive, "rtu").write)


def _written(drive: Drive) -> Iterator[Step]:
    judge = Judge(drive)
    harmless = writable(drive) - meant(drive)
    free = frozenset(each for each in harmless if all(judge.result(Write(each, one)) == "OK" for one in GIVEN))
    given = {f"Given{at or ''}": word(each) for at, each in zip((0, 2, 3), GIVEN, strict=True)}
    for count in range(1, MOST_WRITTEN + 1):
        place = next(_runs(free, count), None)
        if count > _most_written(drive):
            place = min(free, default=1)
            refused = error("Writer", "QUANTITY") | {"Seen.Others": min(1, len(free))}
            yield from does("Writer", place, "Error", refused, Count=count, **given)
        elif place is not None:
            shows: Shows = {
                f"Seen.LastWord = {word(GIVEN[count - 1])}": True,
                f"Seen.LastRegister = {word(place + count - 1)}": True,
            }
            yield from does("Writer", place, "Done", shows, Count=count, **given)
            yield from _read_again(drive, place, count)


def _read_again(drive: Drive, place: int, count: int) -> Iterator[Step]:
    if count <= most(drive, "rtu").read and all(place + at in readable(drive) for at in range(count)):
        values: Shows = {
            f"Reader.Value{at or ''} = {word(each)}": True
            for at, each in list(zip((0, 2, 3), GIVEN, strict=True))[:count]
        }
        yield from does("Reader", place, "Done", values, Count=count)


def _not_all(drive: Drive) -> Iterator[Step]:
    """Of the registers of one write the first that may not be written says why."""
    judge = Judge(drive)
    near = {each + step for each in writable(drive) for step in range(-MOST_WRITTEN, MOST_WRITTEN + 1)}
    results = {each: judge.result(Write(each, GIVEN[0])) for each in sorted(near) if 0 <= each <= 0xFFFF}
    for bad in range(_most_written(drive)):
        place = next((each for each in results if each + bad in results and _fails_at(results, each, bad)), None)
        if place is not None:
            refused = error("Writer", results[place + bad]) | {"Seen.Others": 0, "Seen.Stores": 0}
            same = {name: word(GIVEN[0]) for name in ("Given", "Given2", "Given3")}
            yield from does("Writer", place, "Error", refused, Count=bad + 1, **same)


def _fails_at(results: dict[int, str], place: int, bad: int) -> bool:
    """Whether that one, counted from 0, is the first of some registers that may not be written."""
    return results[place + bad] != "OK" and all(results[place + at] == "OK" for at in range(bad))


def _by_hand(drive: Drive) -> Iterator[Step]:
    """A request written to the slot itself is checked, too: the high byte of the last word says why not."""
    place = min(readable(drive))
    rows = [("no register to read", 3, 0, "QUANTITY"), ("too many to read", 3, 5, "QUANTITY")]
    rows += [("no register to write", 6, 0, "QUANTITY"), ("too many to write", 16, 4, "QUANTITY")]
    for words, function, count, why in rows:
        yield Step(words, _asks(function, place, count), ms=60, shows={
            f"Slots[0].Ask[2].Words[3] = {word(256 * NUMBERS[why])}": True, "Slots[0].ParameterCleared": 0,
            "Seen.Others": 0,
        })  # fmt: skip
    answered = "Slots[0].Answer[2].Number = Slots[0].Ask[2].Number"
    reads = 3 if any(each.code == 3 for each in drive.functions) else 4
    read: Shows = {"Slots[0].Answer[2].ErrorID = 0": True, f"Slots[0].Ask[2].FunctionCode = {reads}": True}
    yield Step("a read", _asks(3, place, 1), answered, 500, read)
    marked: Shows = {"Slots[0].Ask[2].Words[3]": word(0x3400)}
    before: Shows = {".Count": "Seen.Reads"}
    yield Step("one that is taken back is not sent", _asks(3, 0xFFFF, 1) | marked | before, ms=200, shows={
        answered: False, "Slots[0].ParameterCleared": 0,
    })  # fmt: skip
    if drive.storage.method == "enter_register":
        return
    stores: Shows = {"Slots[0].Ask[2].Words[3]": word(2)}
    yield Step("a store, which the drive has not", _asks(6, place, 1) | stores, ms=60, shows={
        f"Slots[0].Ask[2].Words[3] = {word(256 * NUMBERS['NOT_ABLE'] + 2)}": True, "Seen.Stores": 0,
    })  # fmt: skip


def _asks(function: int, place: int, count: int) -> Shows:
    ask = "Slots[0].Ask[2]"
    return {
        f"{ask}.FunctionCode": function, f"{ask}.Address": word(place), f"{ask}.Quantity": count,
        f"{ask}.Words[3]": word(0), f"{ask}.Number": f"{ask}.Number MOD 65535 + 1",
    }  # fmt: skip


# ---------------------------------------------------------------- turns


def _turns(place: int) -> Iterator[Step]:
    """Between two readers that never rest a writer gets its turn, and they get theirs."""
    yield Step("two are at it", {".Rivals": True, ".Place": word(place)}, ms=400, shows={"Seen.Reads > 8": True})
    begin: Shows = {".Writing": True, ".Given": word(3), ".Within": 8000, ".Mark": "Slots[0].Ask[2].Number"}
    yield Step("a third comes", begin, ms=20, shows={"Writer.Busy": True, "Writer.Done": False, "Seen.Others": 0})
    yield Step("it gets its turn", {}, "Writer.Done", 4500, {
        "Slots[0].Ask[2].Number - Mark": (17, 21), "Seen.Others": 1, f"Seen.LastWord = {word(3)}": True,
    })  # fmt: skip
    released: Shows = {".Writing": False, ".Rivals": False}
    readers: Shows = {".Writing": False, ".Reading": True, ".Mark": "Slots[0].Ask[2].Number"}
    yield Step("another one, to read", readers, "Reader.Done", 4500, {"Slots[0].Ask[2].Number - Mark": (17, 21)})
    yield Step(
        "all rest", released, "NOT (Rival.Busy OR Rival2.Busy)", 1000, {"Writer.Done": False, "Clash = FALSE": True}
    )
    all_three: Shows = {".Writing": True, ".Reading": True, ".Rivals": True, ".Given": word(2)}
    yield Step("all at once", all_three, "Writer.Done AND Reader.Done", 6500, {f"Seen.LastWord = {word(2)}": True})
    yield Step("released", released | {".Reading": False}, ms=400, shows=NOTHING_STARTED | {
        "Clash = FALSE": True, "Upset = FALSE": True,
    })  # fmt: skip


def _one_behind(place: int) -> Iterator[Step]:
    """One that is called after all others gets its answers, whoever is quicker."""
    presses: Shows = {".Presses": True, ".Place": word(place), ".Given": word(3), ".Within": 8000}
    yield Step("one is at it", presses, ms=300, shows={"Behind.Error": False})
    for _ in range(2):
        two: Shows = {".Writing": True, ".Reading": True}
        yield Step("two more", two, "Writer.Done AND Reader.Done", 5000, {"Upset = FALSE": True})
        yield Step("released", {".Writing": False, ".Reading": False}, ms=100, shows={"Upset = FALSE": True})
    yield Step("all rest", {".Presses": False}, ms=400, shows={"Clash = FALSE": True, "Upset = FALSE": True})


# ---------------------------------------------------------------- time


def _in_time(place: int) -> Iterator[Step]:
    never: Shows = {"Fate.Skips": True, "Fate.Skipped": word(mark(place)), "Pins.ParameterRetries": 200}
    lost: Shows = {".Writing": True, ".Place": word(place), ".Given": word(3)}
    yield Step("a write that is not answered", never | lost, ms=200, shows={
        "Writer.Busy": True, "Writer.Error": False, "Writer.ErrorID": 0,
    })  # fmt: skip
    yield Step("is given up in time", {}, "Writer.Error", 2500, error("Writer", "SILENCE") | {
        ".WaitedMs": (WITHIN_MS - 200 - SLACK, WITHIN_MS - 200 + SLACK),
    })  # fmt: skip
    yield Step("and is sent no more", {"Fate.Skips": False, ".Writing": False}, ms=400, shows={
        "Seen.Others": 0, "Writer.Error": False, f"Slots[0].Ask[2].Words[3] = {word(0x3400)}": True,
    })  # fmt: skip
    unread: Shows = {"Fate.Unread": True, ".Reading": True, ".Within": 600}
    yield Step("so is a read", unread, "Reader.Error", 1000, error("Reader", "SILENCE") | {
        f"Slots[0].Ask[2].Words[3] = {word(0x3400)}": True,
    })  # fmt: skip
    yield Step("released", {"Fate.Unread": False, ".Reading": False}, ms=1000, shows={"Reader.Error": False})
    yield Step("its drive answers nothing", {"Fate.Dumb": True}, "Slots[0].Timeouts > 0", 500)
    yield Step("first of all it has to", {".Reading": True}, "Reader.Error", 1000, error("Reader", "NOT_SENT"))
    yield Step("released", {"Fate.Dumb": False, ".Reading": False}, ms=1000, shows={"Reader.Error": False})
    stuck: Shows = {"Pins.TxBusy": True, ".Writing": True, ".Reading": True, ".Within": 300}
    both = error("Writer", "NOT_SENT") | error("Reader", "NOT_SENT")
    yield Step("the port takes nothing", stuck, "Writer.Error AND Reader.Error", 1000, both | {
        ".WaitedMs": (300 - SLACK, 300 + SLACK),
    })  # fmt: skip
    freed: Shows = {"Pins.TxBusy": False, ".Writing": False, ".Reading": False}
    yield Step("what was not sent then is not sent later", freed, ms=600, shows={"Seen.Others": 0, "CommOk": True})
    slow: Shows = {"Fate.HoldMs": 100, "Pins.Settings.TurnRoundMs": 200, "Pins.Settings.LongestMs": 200}
    yield Step("a reply takes long", slow, ms=400, shows={"CommOk": True})
    yield Step("a request has just been sent", {}, "TxCount > 0", 500)
    mailbox: Shows = {".Writing": True, "Pins.TxBusy": True, ".Slips": True}
    yield Step("the next is in the mailbox", mailbox, "Writer.Error", 1000, error("Writer", "SILENCE"))
    freed |= {".Slips": False, "Fate.HoldMs": 0, "Pins.Settings.TurnRoundMs": 30, "Pins.Settings.LongestMs": 60}
    yield Step("it is not sent any more", freed, ms=600, shows={
        "Seen.Others": 0, "CommOk": True,
    })  # fmt: skip
    usual: Shows = {"Fate.Skips": True, ".Within": 0, ".Writing": True}
    yield Step("without WithinMs five seconds", usual, "Writer.Error", 6000, error("Writer", "SILENCE") | {
        ".WaitedMs": (5000 - SLACK, 5000 + SLACK),
    })  # fmt: skip
    yield Step("released", {".Writing": False, "Fate.Skips": False}, ms=100, shows={"Writer.Error": False})


def _pulse(place: int) -> Iterator[Step]:
    """Execute need not stay; a result lasts one call at least, and a new edge begins anew whatever was before."""
    yield Step("Execute for one scan", {".Reading": True, ".Place": word(place)}, ms=20, shows={"Reader.Busy": True})
    yield Step("it continues", {".Reading": False}, "Reader.Done", 1000, {"Reader.Busy": False, "Reader.Error": False})
    yield Step("for one call", ms=20, shows={"Reader.Done": False, "Reader.Busy": False})
    refuses: Shows = {"Fate.RefusesReads": True, ".Reading": True}
    yield Step("a read that is refused", refuses, ms=20, shows={"Reader.Busy": True, "Reader.Error": False})
    yield Step("fails", {".Reading": False}, "Reader.Error", 1000, error("Reader", "REFUSED"))
    yield Step("the next begins at once", {"Fate.RefusesReads": False, ".Reading": True}, ms=20, shows={
        "Reader.Busy": True, "Reader.Error": False, "Reader.ErrorID": 0, "Reader.RefusedReason": 0,
    })  # fmt: skip
    yield Step("and is done", {}, "Reader.Done", 2000, {"Reader.Error": False, "Clash = FALSE": True})
    yield Step("as long as Execute is held", ms=200, shows={"Reader.Done": True, "Reader.Busy": False})
    yield Step("released", {".Reading": False}, ms=20, shows={"Reader.Done": False})
    hastes: Shows = {"Fate.RefusesReads": True, ".Reading": True, ".Hastes": True}
    yield Step("another one that is refused", hastes, ms=20, shows={"Reader.Busy": True})
    yield Step("fails", {".Reading": False}, "Reader.Error", 1000, error("Reader", "REFUSED"))
    yield Step("the next begins in the very next call", {".Hastes": False, "Fate.RefusesReads": False}, ms=20, shows={
        "Reader.Busy": True, "Reader.Error": False, "Reader.ErrorID": 0,
    })  # fmt: skip
    yield Step("and is done", {}, "Reader.Done", 2000, {"Reader.Error": False})
    yield Step("released", {".Reading": False}, ms=40, shows={"Reader.Done": False})


def _not_called(place: int) -> Iterator[Step]:
    yield Step("a read begins", {".Reading": True, ".Place": word(place), ".Within": 0}, "Reader.Busy", 100)
    asked = "Slots[0].Ask[2].Number <> Slots[0].Answer[2].Number"
    yield Step("it is asked", {"Fate.Dumb": True}, asked, 200, {"Reader.Busy": True})
    others: Shows = {".Rests": True, "Fate.Dumb": False, ".Writing": True, ".Given": word(3)}
    yield Step("it is not called, and another one is", others, "Writer.Done", 3000, {"Reader.Busy": True})
    lost: Shows = {".Rests": False, ".Writing": False}
    yield Step("its answer is lost", lost, "Reader.Error", 200, error("Reader", "LOST"))
    yield Step("released", {".Reading": False}, "Motor.Ready", 3000)
    nobody: Shows = {"Pins.NoLine": True, "Pins.NoDrive": True}
    calm: Shows = {"Reader.Busy": True, "Reader.Error": False, "Writer.Busy": True, "Writer.Error": False}
    yield Step(
        "nobody calls the line",
        nobody | {".Reading": True, ".Writing": True},
        ms=900 * SCAN_MS,
        shows=calm,
        brisk=False,
    )
    yield Step("it is called for a moment", {"Pins.NoLine": False}, ms=20, shows=calm)
    yield Step("and not any more", nobody, ms=900 * SCAN_MS, shows=calm, brisk=False)
    told = error("Reader", "NO_LINE") | error("Writer", "NO_LINE")
    yield Step("that is reported", {}, "Reader.Error OR Writer.Error", 3000, told | {
        ".WaitedMs": 101 * SCAN_MS,
    })  # fmt: skip
    back: Shows = {"Pins.NoLine": False, "Pins.NoDrive": False, ".Reading": False, ".Writing": False}
    yield Step("it is called again", back, "Motor.Ready", 5000, NOTHING_STARTED)
