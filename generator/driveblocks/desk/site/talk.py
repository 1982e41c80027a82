"""Reads on a line that nobody else should speak on, and what the bytes that come say of the line."""

from dataclasses import dataclass, replace

from driveblocks.desk.site.found import Fault, Line, Trouble, Way
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect, read_request
from driveblocks.modbus.frame import opened, seal
from driveblocks.modbus.layout import Dialect, reply_size, take
from driveblocks.modbus.scan import pieces

CHECKSUM = 2
"""Bytes of a CRC."""

SETTLE_US = 20_000
"""Silence before each request, at least."""
LOOK = {
    "silent": "drive switched on? A and B swapped? its keypad: address, bit rate, format, RTU or ASCII",
    "half": "termination at both ends, a common wire, another device with this address; an adapter that switches "
    "its direction too late",
    "echo": "the adapter hears itself and no drive: A and B, the wires to the drive, the drive's own address and rate",
    "damaged": "A and B, termination, the common wire between adapter and drive, parity on the keypad, motor cables "
    "beside the line",
    "family": "the plate: is it this family? Take its own map; nothing is written to this drive",
    "identity": "the plate: is it this family? Nothing is written to this drive",
    "two": "disconnect all drives but one, and give each an address of its own at the keypad",
    "foreign": "disconnect the PLC, and every other master",
    "noise": "nothing is sent: look at A and B, bias resistors, shield, motor cables beside the line",
    "slow": "the drive's own reply delay at the keypad; an adapter or a server on the way",
    "refused": "the edition of the manual; the firmware of the drive",
    "lost": "the adapter and its plug, the drive's supply",
    "bound": "name --unit, --rate or --format as the keypad has them",
}


class EndedError(Exception):
    """The steps must not go on."""

    def __init__(self, fault: Fault, unit: int | None = None) -> None:
        """For this reason; `unit` is the one whose reply came late."""
        super().__init__(fault.text)
        self.fault, self.unit = fault, unit


def ended(kind: Trouble, text: str) -> EndedError:
    """The end for a trouble."""
    return EndedError(Fault(kind, text, LOOK[kind]))


@dataclass(frozen=True)
class Reply:
    """What came to a read: words, a refusal, or a trouble."""

    words: tuple[int, ...] = ()
    refused: int | None = None
    trouble: Trouble | None = None
    unit: int | None = None
    """Whose frame it is."""
    after_us: int = 0
    echo: bool = False
    strange: bool = False
    """A good frame of the unit that has not the form of a reply of this family."""

    @property
    def answered(self) -> bool:
        """Whether a unit is there."""
        return bool(self.words) or self.refused is not None or self.strange


@dataclass(frozen=True)
class Talk:
    """A line, a drive's dialect, and a unit on it; it reads and nothing else."""

    line: Line
    drive: Drive
    way: Way
    unit: int = 1

    def read(self, span: Span, timeout_us: int, settle_us: int | None = None) -> Reply:
        """A read, once, after silence. Raises EndedError where somebody else speaks."""
        way, spoken = self.way, dialect(self.drive)
        body = read_request(self.unit, self.drive, span)
        request = seal(way.mode, body)
        self._silence(max(SETTLE_US, int(4 * way.character_us)) if settle_us is None else settle_us)
        whole = len(seal(way.mode, bytes(reply_size(body))))
        heard = self.line.exchange(request, timeout_us, 0 if settle_us is None else whole)
        echo = heard.data.startswith(request)
        found = judged(heard.data.removeprefix(request), way, body, spoken, echo=echo)
        if found.trouble == "damaged" and (late := self.stray(heard.data)).answered:
            found = Reply(trouble="foreign", unit=late.unit)
        return replace(found, after_us=heard.after_us, echo=echo)

    @property
    def framings(self) -> list[Way]:
        """The way, and with it those of the drive's other framings."""
        modes = self.drive.serial.mode.modes
        return list(dict.fromkeys((self.way, *(replace(self.way, mode=mode) for mode in modes))))

    def stray(self, data: bytes) -> Reply:
        """What bytes are that nobody has just asked for: a late reply, in any framing, or nothing."""
        read = (judged(data, way, b"", dialect(self.drive), echo=False) for way in self.framings)
        return next((each for each in read if each.answered), Reply())

    def _silence(self, wait_us: int) -> None:
        if stray := self.line.exchange(b"", wait_us).data:
            late = self.stray(stray)
            if late.answered:
                said = "a reply came so late that nobody waited for it any more"
                raise EndedError(Fault("slow", said, LOOK["slow"]), late.unit)
            raise ended("foreign", "somebody else speaks on this line, or noise does")


def judged(data: bytes, way: Way, body: bytes, spoken: Dialect, *, echo: bool) -> Reply:
    """What the bytes after a request are; an empty `body`: a reply to any request."""
    if not data:
        return Reply(trouble="echo" if echo else "silent")
    frames, spoilt = _frames(data, way, spoken)
    if len(frames) > 1:
        return Reply(trouble="two")
    if not frames or spoilt:
        return Reply(trouble="half" if not frames and _begun(data, way, body) else "damaged")
    return _meant(frames[0], body, spoken)


def _meant(frame: bytes, body: bytes, spoken: Dialect) -> Reply:
    """What one good frame is."""
    layout, asked = take(frame, "reply", spoken), int.from_bytes(body[4:6], "big")
    if body and frame[0] != body[0]:
        return Reply(trouble="foreign", unit=frame[0])
    if layout.refusal:
        return Reply(refused=layout.number("reason") or 0, unit=frame[0])
    if not body:
        return Reply(layout.words, unit=frame[0])
    if layout.function != body[1] or not layout.fits or not layout.values(asked):
        return Reply(trouble="family", unit=frame[0], strange=True)
    return Reply(layout.values(asked), unit=frame[0])


def _frames(data: bytes, way: Way, spoken: Dialect) -> tuple[list[bytes], bool]:
    """The bodies of good frames, and whether there is anything beside them."""
    cut = pieces(data, spoken)
    good = [opened(way.mode, each.data) for each in cut if each.good]
    found = [each for each in good if each is not None]
    return found, len(found) != len(cut)


def _begun(data: bytes, way: Way, body: bytes) -> bool:
    """Whether bytes are the beginning of a reply that is cut off."""
    if way.mode == "ascii":
        return data[:1] == b":" and not data.endswith(b"\n")
    return bool(body) and data[:2] == body[:2] and len(data) < reply_size(body) + CHECKSUM
