"""Reads on a line that nobody else should speak on, and what the bytes that come say of the line."""

from dataclasses import dataclass

from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import manners
from driveblocks.modbus.frame import opened, seal
from driveblocks.modbus.layout import Manners, take
from driveblocks.modbus.scan import pieces
from driveblocks.site.found import Fault, Line, Trouble, Way
from driveblocks.site.register import function

SETTLE_US = 20_000
"""Silence before each request, at least."""
LOOK = {
    "silent": "drive switched on? A and B swapped? its keypad: address, bit rate, format, RTU or ASCII; is MODBUS chosen",
    "half": "termination at both ends, a common wire, another device with this address; an adapter that switches "
    "its direction too late",
    "echo": "the adapter hears itself and no drive: A and B, the wires to the drive, the drive's own address and rate",
    "damaged": "A and B, termination, the common wire between adapter and drive, parity on the keypad, motor cables "
    "beside the line",
    "family": "the plate: is it this family? Take its own map; nothing is written to this drive",
    "identity": "the plate: is it this family? Nothing is written to this drive",
    "two": "disconnect all drives but one, and give each an address of its own at the keypad",
    "foreign": "disconnect the PLC, and every other master",
    "noise": "nothing is sent: look at A and B, bias resistors, shield, motor cables beside the line; is a master on it",
    "slow": "the drive's own reply delay at the keypad; an adapter or a server on the way",
    "refused": "the edition of the manual; the firmware of the drive",
    "lost": "the adapter and its plug, the drive's supply",
    "bound": "name --unit, --rate or --format as the keypad has them",
}


class EndedError(Exception):
    """The steps must not go on."""

    def __init__(self, fault: Fault) -> None:
        """For this reason."""
        super().__init__(fault.text)
        self.fault = fault


def ended(kind: Trouble, text: str) -> EndedError:
    """The end for a trouble."""
    return EndedError(Fault(kind, text, LOOK[kind]))


@dataclass(frozen=True)
class Reply:
    """What came to a read: words, a refusal, or a trouble."""

    words: tuple[int, ...] = ()
    refused: int | None = None
    trouble: Trouble | None = None
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
    """A line and a drive's manners on it; it reads and nothing else."""

    line: Line
    drive: Drive

    def read(self, way: Way, unit: int, span: Span, timeout_us: int) -> Reply:
        """A read, once. Raises EndedError, with the fault, where somebody else speaks."""
        code, manner = function(self.drive), manners(self.drive)
        body = bytes([unit, code]) + span.first.to_bytes(2, "big") + len(span).to_bytes(2, "big")
        request = seal(way.mode, body)
        self._silence(way)
        heard = self.line.exchange(request, timeout_us)
        echo = heard.data.startswith(request)
        data = heard.data.removeprefix(request)
        found = judged(data, way, body, manner, allow_echo=echo)
        return Reply(found.words, found.refused, found.trouble, heard.after_us, echo, found.strange)

    def _silence(self, way: Way) -> None:
        wait = max(SETTLE_US, int(4 * way.character_us))
        if stray := self.line.exchange(b"", wait).data:
            late = judged(stray, way, b"", manners(self.drive), allow_echo=False)
            if late.words or late.refused is not None:
                raise ended("slow", "a reply came after more than a second, when nobody waited for it any more")
            raise ended("foreign", "somebody else speaks on this line")


def judged(data: bytes, way: Way, body: bytes, manner: Manners, *, allow_echo: bool) -> Reply:
    """What the bytes after a request are; an empty `body`: a reply to any."""
    if not data:
        return Reply(trouble="echo" if allow_echo else "silent")
    if way.mode == "ascii":
        frames = [frame for each in pieces(data, manner) if (frame := opened("ascii", each.data)) is not None]
        spoilt = len(frames) != data.count(b":") or not frames
    else:
        cut = pieces(data, manner)
        frames = [each.data[:-2] for each in cut if each.good]
        spoilt = any(not each.good for each in cut)
    if len(frames) > 1:
        return Reply(trouble="two")
    if not frames:
        half = bool(body) and way.mode == "rtu" and data[:2] == body[:2] and len(data) < 5 + 2 * body[5]
        half = half or (way.mode == "ascii" and data[:1] == b":" and not data.endswith(b"\n"))
        return Reply(trouble="half" if half else "damaged")
    if spoilt:
        return Reply(trouble="damaged")
    frame = frames[0]
    layout = take(frame, "reply", manner)
    if body and frame[0] != body[0]:
        return Reply(trouble="foreign")
    if layout.refusal:
        return Reply(refused=layout.number("reason") or 0)
    if body and (
        layout.function != body[1] or not layout.fits or len(layout.words) != int.from_bytes(body[4:6], "big")
    ):
        return Reply(trouble="family", strange=True)
    return Reply(layout.words)
