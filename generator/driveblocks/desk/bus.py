"""The line of simulated drives: who was asked and answered how often, and what gets lost or damaged on the way."""

import random
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from driveblocks.desk.wire import Wire
from driveblocks.modbus.frame import seal
from driveblocks.simulator.drive import SimulatedDrive

MOST_FRAMES = 1000
"""Frames that wait to be written down; older ones are forgotten."""


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
    """A frame on the line."""

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
        """A frame with one wrong bit."""
        place = self.chance.randrange(len(frame))
        wrong = frame[place] ^ 1 << self.chance.randrange(7)
        return frame[:place] + bytes([wrong]) + frame[place + 1 :]


class Bus(Wire):
    """A wire that counts, loses and remembers."""

    def __init__(
        self, drives: Sequence[SimulatedDrive], bit_rate: int, character_bits: int, *, ascii_mode: bool = False
    ) -> None:
        """Begin at time 0."""
        super().__init__([], bit_rate, character_bits, ascii_mode=ascii_mode)
        self.loss = Loss()
        self.counts: dict[int, Counts] = {}
        self.strange = 0
        """Characters that belong to no whole request."""
        self.frames: deque[Frame] = deque(maxlen=MOST_FRAMES)

        for drive in drives:
            self.add(drive)

    def add(self, drive: SimulatedDrive) -> None:
        """One more drive on the line."""
        self.counts.setdefault(drive.unit, Counts())
        self.drives = [*self.drives, drive]

    def happen(self, act: Callable[[Sequence[SimulatedDrive], Loss], None], now_us: int) -> None:
        """Let something happen to the drives or the line at a time."""
        self._pass(now_us)
        act(self.drives, self.loss)

    def given_up(self, data: bytes) -> None:
        """Characters that are no request."""
        self.strange += len(data)
        self.frames.append(Frame(self._asked_us, data, reply=False, fate="not understood"))

    def replies(self, body: bytes) -> Iterator[tuple[int, bytes]]:
        """What the drives reply, unless it gets lost."""
        request = self._sealed(body)
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
        frame, fate = self._sealed(reply), self.loss.fate()
        if fate == "damaged":
            frame = self.loss.spoiled(frame)
        self.frames.append(Frame(self._asked_us + drive.turn_us, frame, reply=True, fate=fate))
        if fate != "lost":
            yield drive.turn_us, frame

    def _sealed(self, body: bytes) -> bytes:
        return seal("ascii" if self._ascii else "rtu", body)
