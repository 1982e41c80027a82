"""A simulated RS-485 line with its drives, in a time that is handed in: of a test, a demonstration or the clock.

It counts who was asked and answered how often, and remembers what gets lost or damaged on the way.
"""

import random
from collections import defaultdict, deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.modbus import frame, layout

MOST_FRAMES = 1000
"""Frames that wait to be written down; older ones are forgotten."""
_LONGEST = 520
"""Characters that no request has."""
_MOST_WAITING = 2 * _LONGEST
"""Characters that wait for the wire; what comes faster than it can carry is lost, as in a buffer that is full."""
_PATIENCE_US = 50_000
"""After this silence a request that has begun is given up."""


@dataclass
class Counts:
    """What a drive has seen."""

    heard: int = 0
    """Whole requests to it."""
    replied: int = 0
    refused: int = 0
    """Of the replies, refusals."""


@dataclass(frozen=True)
class Frame:
    at_us: float
    data: bytes
    reply: bool
    fate: str = ""
    """`lost` or `damaged` by the scenario; `not understood`."""


@dataclass
class Loss:
    """What the line does to frames; the same seed does the same."""

    drop: float = 0.0
    """Share of frames, to and fro, that get lost."""
    damage: float = 0.0
    """Share of frames that arrive with a wrong bit."""
    dropped: int = 0
    damaged: int = 0
    chance: random.Random = field(default_factory=lambda: random.Random(1))  # noqa: S311 - no secret

    def fate(self) -> str:
        """What becomes of a frame: `lost`, `damaged`, or nothing."""
        if self.drop and self.chance.random() < self.drop:
            self.dropped += 1
            return "lost"
        if self.damage and self.chance.random() < self.damage:
            self.damaged += 1
            return "damaged"
        return ""

    def spoiled(self, frame: bytes) -> bytes:
        place = self.chance.randrange(len(frame))
        wrong = frame[place] ^ 1 << self.chance.randrange(7)
        return frame[:place] + bytes([wrong]) + frame[place + 1 :]


class Bus:
    """Bytes in, bytes out; each character takes its time."""

    def __init__(
        self, drives: Sequence[SimulatedDrive], bit_rate: int, character_bits: int, *, ascii_mode: bool = False
    ) -> None:
        """Begin at time 0."""
        self.drives = drives
        self.loss = Loss()
        self.counts: dict[int, Counts] = defaultdict(Counts)
        self.strange = 0
        """Characters that belong to no whole request."""
        self.frames: deque[Frame] = deque(maxlen=MOST_FRAMES)
        self._character_us = character_bits * 1_000_000 / bit_rate
        self._mode: frame.Mode = "ascii" if ascii_mode else "rtu"
        self._asked = b""
        self._asked_us = 0.0
        """When the last character asked ends."""
        self._said: deque[tuple[float, bytes]] = deque()
        """Replies with when each begins."""
        self._stepped_ms = 0

    @property
    def speaking(self) -> bool:
        """Whether a reply is on its way; if none is, nothing happens until the master sends."""
        return bool(self._said)

    def happen(self, act: Callable[[Sequence[SimulatedDrive], Loss], None], now_us: int) -> None:
        """Let something happen to the drives or the line at a time."""
        self._pass(now_us)
        act(self.drives, self.loss)

    def send(self, data: bytes, now_us: int) -> None:
        """Characters of the master go onto the wire; one that meets a reply spoils it."""
        self._give_up(now_us)
        if self._said and self._said[-1][0] + len(self._said[-1][1]) * self._character_us > now_us:
            self._said.clear()
            return
        if self._asked_us - now_us > _MOST_WAITING * self._character_us:
            return
        self._asked_us = max(now_us, self._asked_us) + len(data) * self._character_us
        self._asked = (self._asked + data)[-_LONGEST:]
        for begun in self._beginnings():
            body = frame.opened(self._mode, self._asked[begun:])
            if body is not None and layout.request(body) is not None:
                if begun:
                    self._strange(self._asked[:begun])
                self._asked = b""
                self._pass(self._asked_us)
                self._said.extend((self._asked_us + turn_us, reply) for turn_us, reply in self.replies(body))
                return

    def _beginnings(self) -> Iterator[int]:
        """Where a request may begin that ends here; other units' frames may come before it."""
        text = self._asked
        yield 0
        if self._mode == "ascii":
            yield max(0, text.rfind(b":"))
            return
        if len(text) > 8:
            yield len(text) - 8
        for begun in range(1, len(text) - 8):
            if text[begun + 1] == 16 and len(text) - begun == 9 + text[begun + 6]:
                yield begun

    def _strange(self, data: bytes) -> None:
        self.strange += len(data)
        self.frames.append(Frame(self._asked_us, data, reply=False, fate="not understood"))

    def replies(self, body: bytes) -> Iterator[tuple[int, bytes]]:
        """What the drives reply to a request, unless it gets lost, each with the time until it begins."""
        request = frame.seal(self._mode, body)
        fate = self.loss.fate()
        damaged = self.loss.spoiled(request) if fate == "damaged" else request
        self.frames.append(Frame(self._asked_us, damaged, reply=False, fate=fate))
        if fate:
            return
        for drive in self.drives:
            reply = drive.reply(body)
            if body[0] == drive.unit and drive.powered:
                self.counts[drive.unit].heard += 1
            if reply is not None:
                yield from self._answered(drive, body, reply)

    def _answered(self, drive: SimulatedDrive, body: bytes, reply: bytes) -> Iterator[tuple[int, bytes]]:
        counts, at = self.counts[drive.unit], drive.table.dialect.address
        counts.replied += 1
        counts.refused += reply[1] != body[1] or (at is not None and reply[2:4] == at.to_bytes(2, "big") != body[2:4])
        sealed, fate = frame.seal(self._mode, reply), self.loss.fate()
        if fate == "damaged":
            sealed = self.loss.spoiled(sealed)
        self.frames.append(Frame(self._asked_us + drive.turn_us, sealed, reply=True, fate=fate))
        if fate != "lost":
            yield drive.turn_us, sealed

    def _give_up(self, now_us: int) -> None:
        if self._asked and now_us - self._asked_us > _PATIENCE_US:
            self._strange(self._asked)
            self._asked = b""

    def receive(self, now_us: int) -> bytes:
        """Characters of the drives that have ended by now."""
        self._pass(now_us)
        self._give_up(now_us)
        heard = b""
        while self._said:
            begin, reply = self._said.popleft()
            ended = max(0, min(len(reply), int((now_us - begin) / self._character_us)))
            heard += reply[:ended]
            if ended < len(reply):
                self._said.appendleft((begin + ended * self._character_us, reply[ended:]))
                break
        return heard

    def _pass(self, now_us: float) -> None:
        """Time of the drives, in whole milliseconds."""
        passed = int(now_us // 1000) - self._stepped_ms
        if passed > 0:
            self._stepped_ms += passed
            for drive in self.drives:
                drive.step(passed)
