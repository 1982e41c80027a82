"""Frames cut from bytes as they come."""

import re
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from driveblocks.modbus.frame import opened
from driveblocks.modbus.layout import Dialect, expected_sizes
from driveblocks.modbus.scan import pieces, size_of

QUIET_US = 20_000
"""Bytes that begin no frame wait so long for their rest; an adapter may hand over a frame in pieces."""
PIECES_US = 300_000
"""A gateway or a busy machine hands over a frame in pieces so far apart."""
LONGEST = 520
"""Bytes after which they wait no more."""
BROADCAST = 8
"""Bytes of one that writes a register; a longer one is taken for damaged in this rare case."""


@dataclass(frozen=True)
class Frame:
    """Bytes that came together: a good frame, or what is none; times in us, as the adapter handed it over."""

    begin_us: int
    end_us: int
    data: bytes
    good: bool


class Cutter:
    """Cuts what comes into frames."""

    def __init__(self, dialects: Sequence[Dialect], character_us: float) -> None:
        """How units refuse, by their maps, and the time of a character on the wire."""
        self.dialects, self._character_us = dialects or (Dialect(),), character_us
        self._bytes = b""
        self._came = deque[tuple[int, int]]()
        """How many bytes came when."""
        self._came_us = self._ended_us = 0
        self.expects: frozenset[int] = frozenset()
        """Lengths of good frames that are the beginning of no longer one here."""
        self.begins = b""
        """The first bytes of a reply to our request."""
        self.request = b""
        """Ours, which an adapter may give back."""

    def take(self, now_us: int, data: bytes) -> Iterator[Frame]:
        """Bytes that have come, or none; the frames that are whole."""
        if data:
            self._bytes, self._came_us = self._bytes + data, now_us
            self._came.append((len(data), now_us))
        while size := self._front():
            yield self._cut(size, good=True)
        if now_us - self._came_us >= max(self.patience_us, 4 * self._character_us):
            yield from self.rest()
        elif len(self._bytes) > LONGEST:
            yield from self.rest(LONGEST // 2)

    @property
    def patience_us(self) -> int:
        """How long the bytes that have come wait for their rest: a reply that has begun may come in pieces."""
        begun = self.begins and self._bytes.startswith(self.begins) and len(self._bytes) < max(self.expects, default=0)
        return PIECES_US if begun else QUIET_US

    def rest(self, keep: int = 0) -> Iterator[Frame]:
        """What is left, but for `keep` bytes that may begin a frame."""
        while (at := self._ascii()) >= 0:
            if at:
                yield self._cut(at, good=False)
            yield self._cut(self._front(), good=True)
        for each in pieces(self._bytes, self.dialects[0]):
            size = len(each.data) if each.good else min(len(each.data), len(self._bytes) - keep)
            if size > 0:
                yield self._cut(size, good=self._is_whole(each.data))
            if size < len(each.data):
                return

    def _is_whole(self, data: bytes) -> bool:
        """Whether bytes are a good frame; one of a function that is not known here is known by its CRC alone."""
        known = any(size_of(data, each) == len(data) for each in self.dialects)
        return known or opened("ascii" if data[:1] == b":" else "rtu", data) is not None

    def _ascii(self) -> int:
        """Where the first good ASCII frame begins; -1 if there is none."""
        ends = (each.end() for each in re.finditer(rb"\r\n", self._bytes))
        starts = ((self._bytes.rfind(b":", 0, end), end) for end in ends)
        return next((at for at, end in starts if at >= 0 and opened("ascii", self._bytes[at:end])), -1)

    def _front(self) -> int:
        """The length of the good frame that comes first; 0 while there is none, or while it may begin a longer one."""
        end = self._bytes.find(b"\r\n") + 2
        if self._bytes[:1] == b":" and end > 1 and opened("ascii", self._bytes[:end]):
            return end
        if self.request and self._bytes.startswith(self.request):
            return len(self.request)
        size = max(size_of(self._bytes, each) for each in self.dialects)
        if size in self.expects:
            return size
        longest = max((most for each in self.dialects for most in expected_sizes(self._bytes, each)), default=0)
        if size and opened("rtu", self._bytes[: size - 1]):  # see `size_of`: does a broadcast begin with the last byte?
            longest = max(longest, size + BROADCAST)
        return 0 if size and len(self._bytes) < longest + 2 else size

    def _cut(self, size: int, *, good: bool) -> Frame:
        data, self._bytes = self._bytes[:size], self._bytes[size:]
        last, after, wanted = self._came_us, 0, size
        while wanted > 0:
            count, last = self._came.popleft()
            wanted, after = wanted - count, max(0, count - wanted)
        if after:
            self._came.appendleft((after, last))
        end = last - int(after * self._character_us)
        begin = max(end - int(size * self._character_us), self._ended_us)
        self._ended_us = max(begin, end)
        return Frame(begin, self._ended_us, data, good)
