"""Everything that can be said of pasted bytes: good or wrong, what they say, what they might be instead."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from driveblocks.desk.explain.comparison import compared
from driveblocks.desk.explain.guess import guesses, shown
from driveblocks.desk.explain.paste import Paste
from driveblocks.desk.explain.reading import Field, Reader, Reading, Wrong
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect
from driveblocks.maps.problem import Refused
from driveblocks.meaning.serial import serial
from driveblocks.modbus import layout, scan
from driveblocks.modbus.envelope import Wire, open_
from driveblocks.modbus.frame import ASCII_CHARS, RTU_BYTES
from driveblocks.modbus.layout import Dialect
from driveblocks.modbus.request import Asked, asked_by

NOISE = "noise, a wrong bit rate or parity, or a typing error: none of the usual causes comes out"
MOST_INSIDE = 16
"""Frames that are explained one by one when many are glued together."""


@dataclass(frozen=True)
class Explanation:
    """A frame explained. Readings are of `meant`, which is another frame where the pasted one is wrong."""

    wire: Wire
    wrongs: tuple[Wrong, ...] = ()
    readings: tuple[Reading, ...] = ()
    meant: Wire | None = None
    notes: tuple[str, ...] = ()
    inside: tuple["Explanation", ...] = ()
    """The frames that were found glued together."""
    asked: bytes | None = None
    """The request that the frame was compared with."""

    @property
    def good(self) -> bool:
        """Whether nothing is wrong, in at least one reading."""
        return not self.wrongs and any(not reading.wrongs for reading in self.readings)

    @property
    def all_wrongs(self) -> tuple[Wrong, ...]:
        """What is wrong with the frame, then with what it says."""
        return tuple(dict.fromkeys([*self.wrongs, *(wrong for one in self.readings for wrong in one.wrongs)]))


class Explainer:
    """Explains frames of one drive, or by the standard alone."""

    def __init__(self, drive: Drive | None = None) -> None:
        self.drive = drive
        self.dialect = dialect(drive) if drive is not None else Dialect()

    def explain(self, paste: Paste, request: Paste | None = None) -> Explanation:
        """Explain a pasted frame, as the reply to a request if one is given. Raises Refused for that one."""
        asked, sent = self._asked(request) if request is not None else (None, None)
        made = self._explained(paste.data, asked, sent)
        return replace(made, notes=(*paste.notes, *made.notes, *self._examples(made)))

    def _asked(self, request: Paste) -> tuple[Asked, bytes]:
        """The request that was pasted. Raises Refused if it is no good request."""
        made = self._explained(request.data, None, None)
        taken = layout.take(made.wire.body, "request", self.dialect) if made.wire.right else None
        fits = taken is not None and taken.fits and any(one.direction == "request" for one in made.readings)
        if made.wrongs or taken is None or not fits:
            why = made.all_wrongs[0].what if made.all_wrongs else "it reads as a reply"
            raise Refused(f"request:1:1: this is no good request: {why}; paste the request as it was sent")
        return asked_by(taken, ascii_mode=made.wire.mode == "ascii"), made.wire.frame

    # ------------------------------------------------------------ what kind of thing it is

    def _explained(self, data: bytes, asked: Asked | None, sent: bytes | None) -> Explanation:
        wire = open_(data)
        pieces = scan.pieces(data, self.dialect)
        broken = tuple(Wrong(what, (instead,) if instead else ()) for what, instead in wire.broken)
        broken = (*broken, *self._mode(wire, asked), *_size(wire))
        if len(pieces) > 1 and any(piece.good for piece in pieces) and not self._whole(wire):
            return self._zeros_behind(wire, asked, sent) or self._glued(wire, pieces, asked, sent)
        if not wire.right:
            return replace(self._damaged(wire, broken, asked), asked=sent)
        whole = Explanation(wire, broken, self._all(wire, asked), wire, asked=sent, notes=_echo_note(asked, sent, wire))
        return (None if whole.good else self._zeros_behind(wire, asked, sent)) or whole

    def _zeros_behind(self, wire: Wire, asked: Asked | None, sent: bytes | None) -> Explanation | None:
        """A good frame with 00 after it: the remainder after a CRC is 0, so the CRC stays right with 00 there."""
        core = wire.frame.rstrip(b"\0")
        for end in range(len(core), min(len(wire.frame), RTU_BYTES + 1)):
            if wire.mode == "rtu" and open_(wire.frame[:end]).right and self._whole(open_(wire.frame[:end])):
                inside = self._explained(wire.frame[:end], asked, sent)
                extra = scan.Piece(end, wire.frame[end:], good=False)
                pieces = (scan.Piece(0, wire.frame[:end], good=True), extra)
                if inside.good:
                    return Explanation(wire, (_glue(pieces, None),), inside=(inside,), asked=sent)
        return None

    def _whole(self, wire: Wire) -> bool:
        """Whether the bytes are one frame from end to end."""
        fits = len(wire.body) > 2 and any(one.fits for one in layout.readings(wire.body, self.dialect))
        return wire.right and not wire.broken and fits

    def _mode(self, wire: Wire, asked: Asked | None) -> Iterator[Wrong]:
        is_ascii, this = wire.mode == "ascii", f"this is {wire.mode.upper()}"
        modes = serial(self.drive).modes if self.drive else (wire.mode,)
        if self.drive and wire.mode not in modes and (wire.right or is_ascii):
            yield Wrong(f"{this}, and {self.drive.prefix} speaks {' and '.join(map(str.upper, modes))} only")
        if asked is not None and asked.ascii != is_ascii:
            yield Wrong(f"{this}, and the request was sent in {'ASCII' if asked.ascii else 'RTU'}")

    def _damaged(self, wire: Wire, broken: tuple[Wrong, ...], asked: Asked | None) -> Explanation:
        found = guesses(wire, self.dialect)
        meant = next((open_(guess.frame) for guess in found if guess.frame is not None), None)
        noise = (NOISE,) if wire.found else ()
        check = Wrong(_checksum(wire), tuple(guess.says for guess in found) or noise)
        told = (check,) if wire.aligned and (wire.found or not broken) else ()
        told = (*told, *(Wrong("the frame cannot be read", (guess.says,)) for guess in found if not wire.aligned))
        read = meant or (wire if wire.aligned and self._plausible(wire) else None)
        return Explanation(wire, (*broken, *told), self._all(read, asked) if read is not None else (), read)

    def _plausible(self, wire: Wire) -> bool:
        """Whether a body with a wrong checksum has the length of what it says that it is."""
        if len(wire.body) < 3 or not wire.found:
            return False
        return any(one.fits and one.function in layout.KNOWN for one in layout.readings(wire.body, self.dialect))

    # ------------------------------------------------------------ what it says

    def _all(self, wire: Wire, asked: Asked | None) -> tuple[Reading, ...]:
        return self._readings(wire) if asked is None else self._answered(wire, asked)

    def _readings(self, wire: Wire) -> tuple[Reading, ...]:
        """The readings of a body that nothing speaks against, or all of them."""
        if len(wire.body) < 2:
            return ()
        reader = Reader(self.drive, self.dialect, ascii_mode=wire.mode == "ascii")
        possible = layout.readings(wire.body, self.dialect)
        requests = tuple(one for one in possible if one.direction == "request")
        found = tuple(reader.read(one) for one in (requests if wire.body[0] == 0 and requests else possible))
        clean = tuple(one for one in found if not one.wrongs)
        return tuple(_framed(one, wire) for one in clean or _least_wrong(found))

    def _answered(self, wire: Wire, asked: Asked) -> tuple[Reading, ...]:
        """The body as the reply to a request."""
        if len(wire.body) < 2:
            return ()
        reader = Reader(self.drive, self.dialect, ascii_mode=wire.mode == "ascii")
        wrongs = compared(self.dialect, asked, wire.body)
        if not wrongs:
            one = reader.read(layout.take(wire.body, "reply", self.dialect), asked)
            against = tuple(f"The map speaks against this: {wrong.what}." for wrong in one.wrongs)
            return (_framed(replace(one, wrongs=(), notes=(*one.notes, *against)), wire),)
        request, reply = (layout.take(wire.body, direction, self.dialect) for direction in layout.DIRECTIONS)
        told = reader.read(request if request.fits and not reply.fits else reply)
        return (_framed(replace(told, wrongs=wrongs), wire),)

    # ------------------------------------------------------------ several frames

    def _glued(
        self, wire: Wire, pieces: tuple[scan.Piece, ...], asked: Asked | None, sent: bytes | None
    ) -> Explanation:
        """One frame with something around it, or several."""
        inside: list[Explanation] = []
        before = (asked, sent)
        frames = [one for one in pieces if one.good or wire.mode == "ascii"]
        for piece in frames[:MOST_INSIDE]:
            made = self._explained(piece.data, *before)
            if not made.good and (piece.data == before[1] or before[1] != sent):
                made = self._explained(piece.data, None, None)
            if made.good and made.asked is None and made.readings[0].direction == "request":
                one = layout.take(made.wire.body, "request", self.dialect)
                before = asked_by(one, ascii_mode=made.wire.mode == "ascii"), made.wire.frame
            inside.append(made)
        echo = any(one.good and one.asked == inside[0].wire.frame for one in inside[1:])
        wrong = _glue(pieces, inside[0].wire.frame if echo else None)
        rest = len(frames) - len(inside)
        notes = (f"{rest} more frames follow; paste them separately.",) if rest else ()
        return Explanation(wire, (wrong, *_size(wire)), inside=tuple(inside), asked=sent, notes=notes)

    # ------------------------------------------------------------ the manual's examples

    def _examples(self, made: Explanation) -> tuple[str, ...]:
        """The manual's example frames that look like this one."""
        found = []
        for frame in self.drive.frames if self.drive else ():
            if frame.correct == made.wire.frame:
                found.append(f"The manual's example {frame.id}: {frame.means.says}.")
            elif frame.printed == made.wire.frame:
                found.append(f"The manual prints its example {frame.id} like this, with a wrong checksum.")
        return tuple(found)


def _least_wrong(found: tuple[Reading, ...]) -> tuple[Reading, ...]:
    """The reading with the least that is wrong; both if they say the same of themselves."""
    fewest = min(len(one.wrongs) for one in found)
    return tuple(one for one in found if len(one.wrongs) == fewest)


def _framed(one: Reading, wire: Wire) -> Reading:
    """A reading with the fields of the framing around those of the body."""
    verdict = "right" if wire.right else f"WRONG: {shown(wire.expected)} would be right"
    check = (Field(wire.name, wire.found, verdict),) if wire.found else ()
    if wire.mode == "rtu":
        return replace(one, fields=(*one.fields, *check))
    end = wire.frame[len(wire.frame.rstrip(b"\r\n")) :]
    ends = (Field("end", end, " ".join("CR" if sign == 13 else "LF" for sign in end)),) if end else ()
    return replace(one, fields=(Field("start", b":", "colon"), *one.fields, *check, *ends))


def _checksum(wire: Wire) -> str:
    if not wire.found:
        return f"{len(wire.frame)} byte{'s are' if len(wire.frame) != 1 else ' is'} too short for a frame"
    return f"the {wire.name} does not fit: the frame has {shown(wire.found)}, and {shown(wire.expected)} would be right"


def _size(wire: Wire) -> Iterator[Wrong]:
    most, unit = (RTU_BYTES, "bytes") if wire.mode == "rtu" else (ASCII_CHARS, "characters")
    if len(wire.frame) > most:
        yield Wrong(f"{len(wire.frame)} {unit} are too long for a frame: it has {most} at most")


def _echo_note(asked: Asked | None, sent: bytes | None, wire: Wire) -> tuple[str, ...]:
    if asked is None or asked.unit == 0 or sent != wire.frame or asked.function not in (5, 6, 8):
        return ()
    return ("The reply repeats the request, as it should; an adapter that hears itself would show the same.",)


def _glue(pieces: tuple[scan.Piece, ...], echo: bytes | None) -> Wrong:
    """What the bytes around the good frames are."""
    good = [piece for piece in pieces if piece.good]
    places = " and ".join(f"{one.start + 1} to {one.start + len(one.data)}" for one in pieces[:MOST_INSIDE])
    if echo is not None and len(good) > 1:
        return Wrong(
            f"the request comes before the reply: bytes 1 to {len(echo)}",
            ("the adapter hears what it sends (half-duplex echo)", "a logger recorded both directions as one"),
        )
    if len(good) > 1 or pieces[0].data[:1] == b":":
        return Wrong(
            f"{len(pieces)} frames glued together: bytes {places}"
            if len(good) == len(pieces)
            else f"{len(good)} good frames among other bytes: pieces {places}",
            ("the silence between them was not noticed, or a logger recorded them as one",),
        )
    before, behind = pieces[0], pieces[-1]
    if behind.good:
        return Wrong(f"{_bytes(before)} before the frame: {_few(before.data)}", (_why_extra(before.data),))
    if before.good:
        return Wrong(f"{_bytes(behind)} after the frame: {_few(behind.data)}", (_why_extra(behind.data),))
    return Wrong(f"bytes before and after the frame, which is {shown(good[0].data)}", ("noise, or pieces of others",))


def _few(data: bytes) -> str:
    return shown(data[:16]) + " ..." * (len(data) > 16)


def _bytes(piece: scan.Piece) -> str:
    return f"{len(piece.data)} byte{'s' * (len(piece.data) != 1)} too many"


def _why_extra(data: bytes) -> str:
    if set(data) <= {0x00, 0xFF}:
        return "00 and FF are received while the line turns round; bias resistors or a later receiver help"
    return "the rest of another frame, an echo, or noise"
