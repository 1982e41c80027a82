"""Scenes of the manual's frames: the line sends what it prints, byte for byte, and believes the replies that it prints.

Nobody but the program writes into the slot: it owns it, as a user does who has no drive block.
"""

from collections.abc import Iterator

from driveblocks.bench.scenes.drive import simulated
from driveblocks.bench.scenes.scene import More, Scene, Shows, Step, scene, script
from driveblocks.bench.script import Script
from driveblocks.maps.model import Drive, Frame, Means
from driveblocks.reference.permission import readable
from structured_text.language.writing import byte, dword, word

READS, WRITES = (3, 4), (6, 8, 16)
MOST_READ, MOST_WRITTEN = 4, 4
"""Registers of one request in a slot, beside polls."""
STOP, PARAMETER = 0, 2
"""Compartments: a write is posted as a stop, which is sent at once; a read as a parameter."""

MORE = More(
    blocks={
        "Printed": ("MB_Adu", "a reply as the manual prints it"),
        "Inject": ("UINT", "its characters; they come with the next scan"),
    },
    calls=(
        "Slots[0].Alive := UINT_TO_USINT((USINT_TO_UINT(Slots[0].Alive) + 1) MOD 256);",
        "IF Inject > 0 THEN",
        "  RxChars := Printed;",
        "  RxCount := Inject;",
        "  Inject := 0;",
        "END_IF;",
    ),
)


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program, where the manual prints a request or a refusal that the line can have to do with."""
    scenes = list(frames(drive))
    if scenes:
        yield script(drive, stem, "MotorFrames", "the manual's frames, sent and received by the line", scenes, MORE)


def frames(drive: Drive) -> Iterator[Scene]:
    """A scene per request with its replies, and per refusal that answers none."""
    for frame in drive.frames:
        means = frame.means
        if frame.direction == "request" and _sendable(means):
            replies = [each for each in drive.frames if each.answers == frame.id]
            yield scene(frame.id, *_asked(drive, frame, means), *_replies(means, replies))
        elif frame.answers is None and means.error is not None:
            wanted = Means(says=means.says, unit=means.unit, function=3, address=min(readable(drive)), words=1)
            yield scene(frame.id, *_asked(drive, frame, wanted), *_refused(frame))


def _sendable(means: Means) -> bool:
    if means.unit == 0 or means.function not in (*READS, *WRITES):
        return False
    return (means.words or 1) <= (MOST_READ if means.function in READS else MOST_WRITTEN)


def _box(means: Means) -> int:
    return PARAMETER if means.function in READS else STOP


def _asked(drive: Drive, frame: Frame, means: Means) -> Iterator[Step]:
    """The line gets to know its port by the drive's replies; then the drive is silent, and the request is posted."""
    form, ask = simulated(drive).dialect, f"Slots[0].Ask[{_box(means)}]"
    slot: Shows = {
        "Pins.NoDrive": True, "Pins.Others": 100, "Pins.Ascii": frame.mode == "ascii", "Fate.Unit": means.unit,
        "Slots[0].UnitAddress": means.unit, "Slots[0].TurnRoundMs": 30, "Slots[0].LongestMs": 60,
        "Slots[0].BootMs": 60000, "Slots[0].EndsByAnswer": True, "Slots[0].EndsByRefusal": True,
        "Slots[0].TwoByteCount": form.two_byte_count,
        "Slots[0].ExceptionAdd": 0 if form.address is not None else form.added,
        "Slots[0].ErrorFunction": form.function or 0, "Slots[0].ErrorAddress": word(form.address or 0),
        "Slots[0].Ask[3].FunctionCode": 3, "Slots[0].Ask[3].Address": word(min(readable(drive))),
        "Slots[0].Ask[3].Quantity": 1, "Slots[0].Ask[3].Number": 16,
        "Slots[0].Ask[0].Number": "Slots[0].Answer[0].Number",
    }  # fmt: skip
    yield Step("the port is learned by reads", slot, "Bus.Echo = 1", 3000, {"Bus.Error": False})
    yield Step("the line is quiet", {"Slots[0].Ask[3].Number": 0}, ms=200, shows={"TxCount = 0": True})
    yield Step("the drive is silent", {"Fate.Cut": True}, ms=20, shows={"TxCount = 0": True})
    value = (means.data or 0) if means.function == 8 else (means.values or (0,))[0]
    posted: Shows = {
        f"{ask}.FunctionCode": means.function, f"{ask}.Quantity": means.words or 1,
        f"{ask}.Address": word((means.sub_function if means.function == 8 else means.address) or 0),
        f"{ask}.Words[0]": word(value), f"{ask}.Words[3]": word(0),
    }  # fmt: skip
    if means.function == 16:
        posted |= {f"{ask}.Words[{index}]": word(each) for index, each in enumerate(means.values)}
    posted |= {f"{ask}.Number": f"{ask}.Number MOD 65535 + 1", "Slots[0].ParameterCleared": "Slots[0].Ask[2].Number"}
    yield Step(means.says, posted, "TxCount > 0", 500, {"Bus.Echo": 1} if frame.direction == "reply" else _bytes(frame))


def _bytes(frame: Frame) -> Shows:
    """What has just been sent, four bytes at a time; never what is printed wrong."""
    found: Shows = {f"TxCount = {len(frame.correct)}": True}
    for first in range(0, len(frame.correct), 4):
        part = frame.correct[first : first + 4]
        places = [f"SHL(BYTE_TO_DWORD(TxChars[{first + at}]), {8 * (len(part) - 1 - at)})" for at in range(len(part))]
        found[f"({' OR '.join(places)}) = {dword(int.from_bytes(part, 'big'))}"] = True
    return found


def _comes(data: bytes) -> Shows:
    came: Shows = {f".Printed[{at}]": byte(octet) for at, octet in enumerate(data)}
    return came | {".Inject": len(data)}


def _replies(means: Means, replies: list[Frame]) -> Iterator[Step]:
    box = _box(means)
    answered = f"Slots[0].Answer[{box}].Number = Slots[0].Ask[{box}].Number"
    for reply in replies:
        if reply.printed != reply.correct:
            wrong = _comes(reply.printed) | {".Mark": "Bus.Bad"}
            again = "(Bus.Bad > Mark) AND (TxCount > 0)"
            yield Step("as it is printed, which is wrong, it is not believed", wrong, again, 500, {answered: False})
        refused = reply.means.error is not None
        shows: Shows = {f"Slots[0].Answer[{box}].ErrorID = {40 if refused else 0}": True}
        if refused:
            shows["Slots[0].RefusedReason"] = reply.means.error or 0
        elif means.function in READS:
            values = enumerate(reply.means.values)
            shows |= {f"Slots[0].ParWords[{at}] = {word(value)}": True for at, value in values}
        yield Step(reply.means.says, _comes(reply.correct), answered, 200, shows)
        return


def _refused(frame: Frame) -> Iterator[Step]:
    answered = "Slots[0].Answer[2].Number = Slots[0].Ask[2].Number"
    shows: Shows = {"Slots[0].Answer[2].ErrorID = 40": True, "Slots[0].RefusedReason": frame.means.error or 0}
    yield Step(frame.means.says, _comes(frame.correct), answered, 200, shows)
