"""A serial port between a program and simulated drives, in virtual time: what is sent and received are real frames."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from driveblocks.reference.checksum import crc16
from structured_text.engines.engine import Instance

SCAN_MS = 10


class Answering(Protocol):
    """A drive, or whatever else answers on the line."""

    unit: int
    turn_us: int

    def step(self, ms: int) -> None:
        """Time passes."""

    def reply(self, request: bytes) -> bytes | None:
        """The reply to a request, both without checksum; None for silence."""


def sealed(frame: bytes) -> bytes:
    """A frame with its CRC."""
    return frame + crc16(frame).to_bytes(2, "little")


@dataclass
class Port:
    """The variables `RxCount`, `RxChars`, `TxCount` and `TxChars` of a program on one end, drives on the other."""

    program: Instance
    drives: Sequence[Answering]
    character_ms: float
    now: float = 0.0
    sent: list[bytes] = field(default_factory=list)
    """Requests, without their CRC."""
    coming: list[tuple[float, int]] = field(default_factory=list)
    """Bytes on their way to the program: when the last bit is there (ms), and which."""

    def scan(self) -> None:
        """Time passes, bytes come, the program runs, a request is sent."""
        self.now += SCAN_MS
        for drive in self.drives:
            drive.step(SCAN_MS)
        here = bytes(octet for at, octet in self.coming if at <= self.now)
        self.coming = self.coming[len(here) :]
        self.program["RxCount"] = len(here)
        if here:
            self.program["RxChars"] = here
        self.program.scan()
        count, text = self.program["TxCount"], self.program["TxChars"]
        assert isinstance(count, int)
        assert isinstance(text, list)
        if count:
            self._leave(bytes(text[:count]))  # type: ignore[arg-type]  # an array of BYTE

    def _leave(self, text: bytes) -> None:
        assert not self.coming, "a request is sent while a reply comes"
        frame = text[:-2]
        assert text == sealed(frame)
        self.sent.append(frame)
        start = self.now + self.character_ms * len(text)
        for drive in self.drives:
            if drive.unit == frame[0] and (reply := drive.reply(frame)) is not None:
                start += drive.turn_us / 1000
                self.coming = [(start + self.character_ms * n, octet) for n, octet in enumerate(sealed(reply), 1)]
