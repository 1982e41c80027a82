"""What is heard on a line: frames cut from bytes as they come, who asks whom, and what does not happen as it should."""

import re
from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect
from driveblocks.modbus.frame import opened
from driveblocks.modbus.layout import Dialect, Layout, expected_sizes, take
from driveblocks.modbus.request import Asked, asked_by
from driveblocks.modbus.scan import pieces, size_of

Role = Literal[
    "request", "broadcast", "reply", "refusal", "echo", "late", "twice", "late or twice", "unasked", "damaged",
]  # fmt: skip
"""`echo`: a request once more, too soon for its master; `late`: another request was sent since; `twice`: a second reply
to one request; `unasked`: no request was heard."""

QUIET_US = 20_000
"""Bytes that begin no frame wait so long for their rest; an adapter may hand over a frame in pieces."""
LONGEST = 520
"""Bytes after which they wait no more."""
HASTY_US = 20_000
"""A request so soon after another that has no reply: hardly a master gives up that fast."""
ECHO_US = 25_000
"""The same request so soon again: hardly a master sends it, and an adapter may be 16 ms late."""
ECHOED = (5, 6, 8)
"""Functions whose reply is the request once more."""
BROADCAST = 8
"""Bytes of one that writes a register; a longer one is taken for damaged in this rare case."""
FORGOTTEN_US = 3_000_000
"""A reply that comes later belongs to no request."""


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
        self._dialects, self._character_us = dialects or (Dialect(),), character_us
        self._bytes = b""
        self._came = deque[tuple[int, int]]()
        """How many bytes came when."""
        self._came_us = self._ended_us = 0

    def take(self, now_us: int, data: bytes) -> Iterator[Frame]:
        """Bytes that have come, or none; the frames that are whole."""
        if data:
            self._bytes, self._came_us = self._bytes + data, now_us
            self._came.append((len(data), now_us))
        while size := self._front():
            yield self._cut(size, good=True)
        if now_us - self._came_us >= max(QUIET_US, 4 * self._character_us):
            yield from self.rest()
        elif len(self._bytes) > LONGEST:
            yield from self.rest(LONGEST // 2)

    def rest(self, keep: int = 0) -> Iterator[Frame]:
        """What is left, but for `keep` bytes that may begin a frame."""
        while (at := self._ascii()) >= 0:
            if at:
                yield self._cut(at, good=False)
            yield self._cut(self._front(), good=True)
        for each in pieces(self._bytes, self._dialects[0]):
            size = len(each.data) if each.good else min(len(each.data), len(self._bytes) - keep)
            if size > 0:
                yield self._cut(size, good=self._is_whole(each.data))
            if size < len(each.data):
                return

    def _is_whole(self, data: bytes) -> bool:
        """Whether bytes are a good frame; one of a function that is not known here is known by its CRC alone."""
        known = any(size_of(data, each) == len(data) for each in self._dialects)
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
        size = max(size_of(self._bytes, each) for each in self._dialects)
        longest = max((most for each in self._dialects for most in expected_sizes(self._bytes, each)), default=0)
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


@dataclass
class Poll:
    """What is asked of a unit again and again: a function with an address and a quantity."""

    count: int = 0
    first_us: int = 0
    last_us: int = 0
    replies: int = 0
    refusals: int = 0
    unanswered: int = 0
    damaged: int = 0
    """Requests after which bytes came that made no frame."""
    shortest_us: int = 0
    longest_us: int = 0
    words: tuple[int, ...] = ()
    """The last ones, read or written."""

    @property
    def every_us(self) -> int:
        """The mean time between two requests; 0 for one alone."""
        return (self.last_us - self.first_us) // (self.count - 1) if self.count > 1 else 0


Key = tuple[int, int, int]
"""Function, address, quantity."""


@dataclass
class Unit:
    """What one address was asked and has said."""

    polls: dict[Key, Poll] = field(default_factory=dict)
    odd: Counter[Role] = field(default_factory=Counter)
    """Replies that are late, twice, unasked."""
    unclear: int = 0
    """Frames that are a reply sent twice, or a request that nobody has answered: they look the same."""


@dataclass(frozen=True)
class Open:
    """A request."""

    body: bytes
    asked: Asked
    end_us: int
    unsure: bool = False
    """It may be the reply to what was not heard."""

    def answered_by(self, reply: Layout) -> bool:
        """Whether a layout is the reply to it."""
        if not reply.fits or reply.body[0] != self.asked.unit or reply.function != self.asked.function:
            return False
        if reply.refusal:
            return True
        if self.asked.function in (3, 4):
            return len(reply.words) == self.asked.quantity
        if self.asked.function in (1, 2):
            return reply.number("byte count") == -(-self.asked.quantity // 8)
        if self.asked.function in (15, 16):
            return reply.body == self.body[:6]
        return self.asked.function not in ECHOED or reply.body == self.body


@dataclass(frozen=True)
class Said:
    """A frame, and what it is on this line; `asked`: the request that it is or answers."""

    frame: Frame
    role: Role
    layout: Layout | None = None
    asked: Asked | None = None


class Traffic:
    """Everything that was said on a line."""

    def __init__(self, drives: Mapping[int, Drive], anyone: Drive | None = None) -> None:
        """Drives by their units, and the one that every other unit is taken for."""
        self._drives, self._anyone = drives, anyone
        self.units: dict[int, Unit] = {}
        self.broadcasts = Counter[tuple[int, int]]()
        """By function and address."""
        self.frames = self.bytes = self.damaged = self.damaged_bytes = self.requests = self.hasty = self.echoes = 0
        self.begin_us = self.end_us = self.silence_us = 0
        self._open: Open | None = None
        self._unsure = True
        """At the beginning, and after damaged bytes: what was asked before is not known."""
        self._given = deque[Open](maxlen=8)
        """Requests without a reply."""
        self._last: tuple[Open, bytes] | None = None
        """The last request that was answered, and its reply."""

    @property
    def dialects(self) -> list[Dialect]:
        """How units refuse, by their maps; at least the standard's."""
        drives = [*self._drives.values(), *([self._anyone] if self._anyone else [])]
        return list(dict.fromkeys([*map(dialect, drives), Dialect()]))

    def waiting(self, unit: int) -> int:
        """Requests to a unit that were given up just now, and may still be answered."""
        return sum(one.asked.unit == unit and self.end_us - one.end_us < FORGOTTEN_US for one in self._given)

    def drive(self, unit: int) -> Drive | None:
        """The map of a unit, as far as a person has named it."""
        return self._drives.get(unit, self._anyone)

    def hear(self, frame: Frame) -> Said:
        """The next frame of the line."""
        self._count(frame)
        if not frame.good:
            return self._broken(frame)
        body = opened("ascii", frame.data) or opened("rtu", frame.data) or b""
        drive = self.drive(body[0])
        style = Dialect() if drive is None else dialect(drive)
        reply = take(body, "reply", style)
        if self._open is not None and self._open.answered_by(reply):
            return self._answer(frame, self._open, reply)
        asking = take(body, "request", style)
        if asking.fits and not reply.refusal:
            return self._echo(frame, asking) or self._ask(frame, asking)
        return self._stray(frame, reply)

    def _count(self, frame: Frame) -> None:
        self.begin_us = self.begin_us or frame.begin_us
        if self.end_us:
            self.silence_us = max(self.silence_us, frame.begin_us - self.end_us)
        self.end_us = frame.end_us
        self.frames += frame.good
        self.bytes += len(frame.data)

    def _broken(self, frame: Frame) -> Said:
        """Damaged bytes; what came before the first frame is the rest of one."""
        if self.frames:
            self.damaged += 1
            self.damaged_bytes += len(frame.data)
        self._unsure = True
        self._given.clear()
        return Said(frame, "damaged")

    def _echo(self, frame: Frame, asking: Layout) -> Said | None:
        """A request that was sent just now, or the late reply to one that is its own reply; else nothing."""
        given = self._open
        if given is None:
            return None
        if given.body == asking.body and frame.begin_us - given.end_us < ECHO_US:
            self.echoes += 1
            return Said(frame, "echo", asking, given.asked)
        late = next((one for one in self._given if one.body == asking.body), None)
        if asking.function not in ECHOED or late is None or frame.begin_us - late.end_us >= FORGOTTEN_US:
            return None
        self._come(late)
        self._unit(late).unclear += 1
        return Said(frame, "late", asking, late.asked)

    def _ask(self, frame: Frame, asking: Layout) -> Said:
        asked = asked_by(asking)
        self._give_up(frame.begin_us, clear=asked.function not in ECHOED)
        one = Open(asking.body, asked, frame.end_us, self._unsure and asked.function in ECHOED)
        self._unsure = False
        self.requests += 1
        if asked.unit == 0:
            self.broadcasts[asked.function, asked.address] += 1
            return Said(frame, "broadcast", asking, asked)
        poll, self._open = self._poll(one), one
        poll.first_us = poll.first_us if poll.count else frame.begin_us
        poll.count, poll.last_us = poll.count + 1, frame.begin_us
        poll.words = asking.words or poll.words
        return Said(frame, "request", asking, asked)

    def _give_up(self, now_us: int, *, clear: bool) -> None:
        """The open request has no reply, and another one is sent; not `clear`: or somebody's late reply came."""
        given, self._open = self._open, None
        if given is None:
            return
        if self._unsure:
            self._poll(given).damaged += 1
            return
        self._given.append(given)
        soon = now_us - given.end_us < HASTY_US
        again = self._last is not None and given.body == self._last[0].body == self._last[1]
        if given.unsure or again or (soon and given.asked.function in ECHOED):
            self._unit(given).unclear += 1
            self._poll(given).count -= 1
            return
        self._poll(given).unanswered += 1
        self.hasty += soon and clear

    def _answer(self, frame: Frame, one: Open, reply: Layout) -> Said:
        poll, took = self._poll(one), frame.begin_us - one.end_us
        if not self._unsure:  # else it may be the reply to a request that was damaged
            poll.shortest_us = min(took, poll.shortest_us) if poll.replies + poll.refusals else took
            poll.longest_us = max(took, poll.longest_us)
            if not any(each.answered_by(reply) for each in self._given):  # else it may be the late one to that
                poll.words = reply.words or poll.words
        poll.refusals += reply.refusal
        poll.replies += not reply.refusal
        self._open, self._last, self._unsure = None, (one, reply.body), False
        return Said(frame, "refusal" if reply.refusal else "reply", reply, one.asked)

    def _stray(self, frame: Frame, reply: Layout) -> Said:
        """A reply that answers no open request."""
        late = next((one for one in self._given if one.answered_by(reply)), None)
        if late is not None and frame.begin_us - late.end_us < FORGOTTEN_US:
            self._come(late)
            return self._odd(frame, reply, "late", late)
        last = None if self._last is None or self._unsure else self._last[0]
        if last is None or not last.answered_by(reply) or frame.begin_us - last.end_us >= FORGOTTEN_US:
            return self._odd(frame, reply, "unasked", None)
        late = next((one for one in self._given if one.body == last.body), None)
        if late is None or frame.begin_us - late.end_us >= FORGOTTEN_US:
            return self._odd(frame, reply, "twice", last)
        self._come(late)
        return self._odd(frame, reply, "late or twice", last)

    def _come(self, late: Open) -> None:
        """The reply to a request that was given up."""
        self._given.remove(late)
        self._poll(late).unanswered -= self._poll(late).unanswered > 0

    def _odd(self, frame: Frame, reply: Layout, role: Role, one: Open | None) -> Said:
        """Note it, unless it may belong to what was asked before anybody listened."""
        if role == "unasked" and frame.begin_us - self.begin_us < FORGOTTEN_US:
            return Said(frame, role, reply)
        self.units.setdefault(reply.body[0], Unit()).odd[role] += 1
        return Said(frame, role, reply, None if one is None else one.asked)

    def _unit(self, one: Open) -> Unit:
        return self.units.setdefault(one.asked.unit, Unit())

    def _poll(self, one: Open) -> Poll:
        key = one.asked.function, one.asked.address, one.asked.quantity
        return self._unit(one).polls.setdefault(key, Poll())
