"""Bytes of a line that others speak on, with their times, cut into frames."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from driveblocks.modbus import scan
from driveblocks.modbus.frame import ASCII_CHARS, RTU_BYTES, Mode, opened
from driveblocks.modbus.layout import Dialect, expected_sizes

GAP_US = 20_000
"""After so much silence a frame has ended; an adapter may hand it over in pieces."""
ASCII_GAP_US = 1_000_000
"""The same between two characters, by MODBUS over Serial Line V1.02, 2.5.2."""
_LINE = re.compile(rb":[^:\n]*\n?|[^:]+")


@dataclass(frozen=True)
class Caught:
    """Consecutive bytes, and when the first and the last of them came; `body` is None for what is no good frame."""

    at_us: int
    end_us: int
    data: bytes
    body: bytes | None


@dataclass
class Ear:
    """Takes bytes as they come, and gives whole frames and what lies between them."""

    mode: Mode
    character_us: float
    _data: bytes = b""
    _came: list[tuple[int, int]] = field(default_factory=list)
    """How many bytes had come after each piece, and when."""

    def take(self, at_us: int, data: bytes) -> Iterator[Caught]:
        """Bytes that came at a time; without any, only time has passed."""
        pause = ASCII_GAP_US if self.mode == "ascii" else max(GAP_US, int(4 * self.character_us))
        if self._data and at_us - self._came[-1][1] > pause:
            yield from self._cut(len(self._data))
        if data:
            self._data += data
            self._came.append((len(self._data), at_us))
            most = ASCII_CHARS if self.mode == "ascii" else RTU_BYTES
            yield from self._cut(max(0, len(self._data) - 2 * most))

    def end(self) -> Iterator[Caught]:
        """Nothing more comes."""
        yield from self._cut(len(self._data))

    def _cut(self, over: int) -> Iterator[Caught]:
        """What is whole, and whatever begins before `over`; the rest may be the beginning of a frame."""
        done = 0
        for piece in self._pieces():
            end = piece.start + len(piece.data)
            closed = self.mode == "ascii" and end < len(self._data)
            whole = piece.good and not (end == len(self._data) and self._may_go_on(piece.data))
            if not (whole or closed or piece.start < over):
                break
            body = opened(self.mode, piece.data)
            yield Caught(self._at(piece.start), self._at(end - 1), piece.data, body)
            done = end
        self._data = self._data[done:]
        self._came = [(count - done, at) for count, at in self._came if count > done]

    def _may_go_on(self, frame: bytes) -> bool:
        """Whether a good frame may be the beginning of a longer one, of which the rest is still to come."""
        return self.mode == "rtu" and max(expected_sizes(frame, Dialect()), default=0) + 2 > len(frame)

    def _pieces(self) -> Iterator[scan.Piece]:
        """Frames and what is between them; where the line speaks ASCII, from a colon to the end of its line."""
        if self.mode == "rtu":
            yield from scan.pieces(self._data, Dialect())
            return
        for found in _LINE.finditer(self._data):
            colon = found[0][:1] == b":"
            within = scan.pieces(found[0], Dialect()) if colon else [scan.Piece(0, found[0], good=False)]
            for piece in within:
                yield scan.Piece(found.start() + piece.start, piece.data, piece.good)

    def _at(self, place: int) -> int:
        return next(at for count, at in self._came if count > place)
