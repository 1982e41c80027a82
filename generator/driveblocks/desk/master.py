"""Asks on a line that nobody else speaks on, and knows which reply belongs to which request."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from driveblocks.desk.clock import Clock
from driveblocks.desk.exchange import ECHOED, LATE_US, Exchanges, Said
from driveblocks.desk.frames import QUIET_US, Cutter, Frame
from driveblocks.desk.port import Port
from driveblocks.modbus.envelope import mode_of
from driveblocks.modbus.frame import Mode, opened, seal
from driveblocks.modbus.layout import Dialect, Layout, reply_size

SILENT_CHARACTERS = 4
CHATTER_US = 1_000_000
"""A line on which somebody keeps speaking for this long is not waited for."""
LOOK_US = 1_000
HURRY_US = 50_000
"""How long a reply is waited for by those who do not wait: the request itself has to be sent."""
READS = (1, 2, 3, 4)
STRAYS = ("twice", "late or twice", "unasked")
"""What nobody has asked for; so are damaged bytes beside a good reply, or while nothing is asked."""
TRIES = 5
BUSY_US = 200_000
LEARNED = 8
"""Replies after which the longest of them says how long one is waited for."""
SHORTEST_US = 200_000
"""How long it is waited for at least."""
REPLY_US = 300_000
"""How long the reply to another master's last request is waited for."""
REPEAT_US = 600_000
"""A repeater, or a second unit at the same address, gives a reply once more within this time."""

Kind = Literal["good", "refused", "strange", "unclear", "late", "foreign", "two", "damaged", "half", "echo", "silent"]
"""`strange`: a good frame of the unit that is no reply of its family; `unclear`: it may answer another request, too;
`late`: it answers an earlier one."""


@dataclass(frozen=True)
class Speech:
    """How a line is spoken on."""

    mode: Mode
    character_us: float
    silence_us: int = 0
    """What the drives ask for around a frame."""


@dataclass(frozen=True)
class Last:
    """What was last spoken on a line before us, and when."""

    sent: bytes = b""
    heard: bytes = b""
    sent_us: int | None = None
    heard_us: int = 0
    reply_us: int = REPLY_US
    """How long the reply to it may take."""


@dataclass(frozen=True)
class Reply:
    """What came to a request."""

    kind: Kind
    layout: Layout | None = None
    unit: int | None = None
    """Whose frame it is."""
    after_us: int = 0
    """From the end of the request to the beginning of the reply."""
    echo: bool = False
    """The line gave the request back."""
    asked: bytes = b""
    data: bytes = b""
    """All bytes that came."""

    @property
    def words(self) -> tuple[int, ...]:
        """Registers, or coils, of a read that was granted."""
        if self.kind != "good" or self.layout is None:
            return ()
        return self.layout.values(int.from_bytes(self.asked[4:6], "big"))

    @property
    def refused(self) -> int | None:
        """The reason of a refusal; None where nothing was refused."""
        return (self.layout.number("reason") or 0) if self.layout and self.kind == "refused" else None

    @property
    def answered(self) -> bool:
        """Whether a unit is there."""
        return self.kind in ("good", "refused", "strange")

    @property
    def frame(self) -> str:
        """The bytes, for a person."""
        return self.data.hex(" ").upper()


class Master:
    """The only one who asks on a line; it reads and writes what it is told to, one request after the other."""

    def __init__(self, port: Port, clock: Clock, speech: Speech, said: Exchanges | None = None) -> None:
        """`said`: what was said before, with the maps of the units."""
        self._port, self._clock, self.speech = port, clock, speech
        self.hurries: Callable[[], bool] = bool
        """Whether replies are hardly waited for."""
        self.said = said or Exchanges({}, own=True)
        """Everything that was said, with what is still owed."""
        self.lates = 0
        """Replies so far that were not waited for any more."""
        self.strays = 0
        """Replies so far that nobody had asked for."""
        self._replies = self.longest_us = 0
        """How long the slowest reply was waited for."""
        self._cutter = Cutter(self.said.dialects, speech.character_us)
        self._silence_us = max(speech.silence_us, QUIET_US, int(SILENT_CHARACTERS * speech.character_us))
        self._spoken_us = clock.now_us()
        self._data = b""
        """What has come since the last request; its first byte was handed over at `_first_us`."""
        self._first_us = 0

    def take_over(self, last: Last) -> None:
        """Begin after whoever has spoken before: wait for the reply to the last request."""
        if last.sent_us is None or opened(mode_of(last.sent), last.sent) is None:
            return
        end = last.sent_us + self._wire_us(last.sent)
        self.said.sent(Frame(last.sent_us, end, last.sent, good=True))
        self._spoken_us = max(end, last.heard_us)
        for frame in self._cutter.take(last.heard_us, last.heard):
            self.said.hear(frame)
        while self.said.waits and self._clock.now_us() < end + (HURRY_US if self.hurries() else last.reply_us):
            self._listen()

    @property
    def window_us(self) -> int:
        """How long a reply is waited for: a gateway's time, until the line has shown its own."""
        if self.hurries():
            return HURRY_US
        return LATE_US if self._replies < LEARNED or self.lates else min(LATE_US, max(SHORTEST_US, 3 * self.longest_us))

    @property
    def hears_itself(self) -> bool | None:
        """Whether the line gives back what is sent; None before a read has shown it."""
        return True if self.said.echoes else False if self._replies else None

    def ask(self, body: bytes, patience_us: int | None = None, pause_us: int | None = None) -> Reply:
        """A request without checksum, and what comes to it; `pause_us`: the silence before it, where not the usual."""
        self._be_silent(self._silence_us if pause_us is None else pause_us)
        self._wait(self.said.owed(body, self._clock.now_us()))
        if self.strays and self.said.repeats(body):
            self._wait(self._spoken_us + REPEAT_US - self._clock.now_us())
        request, begin = seal(self.speech.mode, body), self._clock.now_us()
        end = self._spoken_us = begin + self._wire_us(request)
        self._cutter.dialects = self.said.dialects
        self._cutter.expects = frozenset(self._length(each) for each in sizes(body, self._cutter.dialects))
        self._cutter.request, self._cutter.begins = request, body[:1] if self.speech.mode == "rtu" else b":"
        self._port.send(request)
        self.said.sent(Frame(begin, end, request, good=True))
        size = reply_size(body) if body[1] in READS else len(body)
        most = end + self._wire_us(seal(self.speech.mode, bytes(size)))
        return self._reply(body, end, most, patience_us)

    def patient(self, body: bytes, busy: int | None = None) -> Reply:
        """The same, again where the line spoils the reply or the drive is busy, which is that reason of a refusal."""
        reply = Reply("silent")
        for tried in range(TRIES):
            reply = self.ask(body)
            if reply.answered and (busy is None or reply.refused != busy):
                break
            if reply.kind == "unclear" or (reply.kind == "silent" and not tried):
                self.rest(LATE_US)
            elif reply.answered:
                self.rest(BUSY_US)
        return reply

    @property
    def answered(self) -> bool:
        """Whether any request of ours has got its reply."""
        return self._replies > 0

    def _reply(self, body: bytes, end: int, most: int, patience_us: int | None) -> Reply:
        """Wait for it: `end` is that of the request, and `most` when a reply at once would have ended."""
        self._data, heard = b"", list[Said]()
        while self._waits(most + (self.window_us if patience_us is None or self.hurries() else patience_us)):
            for said in self._listen():
                heard.append(said)
                if said.role in ("reply", "refusal"):
                    return self._good(body, said, end, heard)
        heard += map(self.said.hear, self._cutter.rest())
        return _spoilt(body, heard, self._data)

    def _waits(self, until: int) -> bool:
        """Whether it is not yet that time, or somebody speaks just now."""
        now = self._clock.now_us()
        quiet = max(self._silence_us, self._cutter.patience_us)
        return now < until or (self._data != b"" and now - self._spoken_us < quiet and now < until + CHATTER_US)

    def _good(self, body: bytes, said: Said, end: int, heard: list[Said]) -> Reply:
        layout, echo = said.layout, any(each.role == "echo" for each in heard)
        first = 0 if echo else self._first_us - int(self.speech.character_us)
        after = max(0, said.frame.begin_us - end, first - end)
        if body[1] not in ECHOED or echo:
            self._replies += 1
        self.longest_us = max(self.longest_us, after)
        self.strays += any(each.role == "damaged" for each in heard)
        kind: Kind = "refused" if said.role == "refusal" else "good"
        return Reply(kind, layout, body[0], after, echo, body, self._data)

    def quiet(self, pause_us: int | None = None) -> list[Said]:
        """Wait for the silence before a request; what was said meanwhile."""
        return self._be_silent(self._silence_us if pause_us is None else pause_us)

    @property
    def error(self) -> str:
        """Why the port does not work; empty while it does."""
        return self._port.error

    def rest(self, for_us: int) -> list[Said]:
        """Hear what comes within a time, and in a frame that has begun by then."""
        end, heard = self._clock.now_us() + for_us, list[Said]()
        while self._clock.now_us() < end:
            heard += self._listen()
        return heard

    def _wait(self, for_us: int) -> None:
        if for_us > 0:
            self.rest(for_us)
            self._be_silent(self._silence_us)

    def _be_silent(self, silence_us: int) -> list[Said]:
        """Wait until nothing has been said for a time; what was said meanwhile."""
        most, heard = self._clock.now_us() + CHATTER_US, self._listen(0)
        while self._clock.now_us() - self._spoken_us < silence_us and self._clock.now_us() < most:
            heard += self._listen()
        return heard

    def _listen(self, for_us: int = LOOK_US) -> list[Said]:
        """What was said meanwhile; each stray reply is counted."""
        if for_us:
            self._clock.sleep_until(self._clock.now_us() + for_us)
        now, some = self._clock.now_us(), self._port.receive()
        if some:
            self._first_us = self._first_us if self._data else now
            self._spoken_us, self._data = now, self._data + some
        heard = [self.said.hear(each) for each in self._cutter.take(now, some)]
        self.lates += sum(each.role == "late" for each in heard)
        self.strays += sum(each.role in STRAYS or (each.role == "damaged" and not self.said.waits) for each in heard)
        return heard

    def _length(self, size: int) -> int:
        """Bytes of a frame whose body is so long."""
        return len(seal(self.speech.mode, bytes(size)))

    def _wire_us(self, frame: bytes) -> int:
        return int(len(frame) * self.speech.character_us)


def _spoilt(body: bytes, heard: list[Said], data: bytes) -> Reply:
    """What came where no reply did."""
    roles, echo = [each.role for each in heard], any(each.role == "echo" for each in heard)
    other = next((each for each in heard if each.layout is not None and each.role != "echo"), None)
    if "unclear" in roles:
        return Reply("unclear", None, body[0], 0, echo, body, data)
    if other is not None and other.layout is not None:
        unit = other.layout.body[0]
        kind: Kind = "late" if other.role == "late" else "strange" if other.role == "strange" else "foreign"
        return Reply(kind, other.layout, unit, 0, echo, body, data)
    if "damaged" in roles:
        half = _is_half(body, heard[-1].frame.data)
        return Reply("half" if half else "damaged", None, None, 0, echo, body, data)
    return Reply("echo" if echo else "silent", None, None, 0, echo, body, data)


def _is_half(body: bytes, data: bytes) -> bool:
    """Whether bytes are the beginning of a reply that is cut off."""
    if data[:1] == b":":
        return not data.endswith(b"\n")
    return data[:2] == body[:2] and len(data) < reply_size(body) + 2


def sizes(body: bytes, dialects: Sequence[Dialect]) -> Iterator[int]:
    """How long replies to a request may be, without checksum."""
    whole = reply_size(body) if body[1] in READS else 6
    yield from (whole, 3)
    for each in dialects:
        yield from [whole + 1] * each.two_byte_count + [6] * (each.address is not None)
