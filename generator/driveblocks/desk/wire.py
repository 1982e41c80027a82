"""A simulated RS-485 line with its drives, in a time that is handed in: of a test, a demonstration or the clock."""

from collections import deque
from collections.abc import Iterator, Sequence

from driveblocks.modbus import frame, layout
from driveblocks.simulator.drive import SimulatedDrive

_LONGEST = 520
"""Characters that no request has."""
_MOST_WAITING = 2 * _LONGEST
"""Characters that wait for the wire; what comes faster than it can carry is lost, as in a buffer that is full."""
_PATIENCE_US = 50_000
"""After this silence a request that has begun is given up."""


class Wire:
    """Bytes in, bytes out; each character takes its time."""

    def __init__(
        self, drives: Sequence[SimulatedDrive], bit_rate: int, character_bits: int, *, ascii_mode: bool = False
    ) -> None:
        """Begin at time 0."""
        self.drives = drives
        self._character_us = character_bits * 1_000_000 / bit_rate
        self._ascii = ascii_mode
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
        for begun in _beginnings(self._asked, ascii_mode=self._ascii):
            body = opened(self._asked[begun:], ascii_mode=self._ascii)
            if body is not None:
                if begun:
                    self.given_up(self._asked[:begun])
                self._asked = b""
                self._answer(body)
                return

    def _answer(self, body: bytes) -> None:
        self._pass(self._asked_us)
        self._said.extend((self._asked_us + turn_us, reply) for turn_us, reply in self.replies(body))

    def replies(self, body: bytes) -> Iterator[tuple[int, bytes]]:
        """What the drives reply to a request, each with the time until it begins."""
        for drive in self.drives:
            reply = drive.reply(body)
            if reply is not None:
                yield drive.turn_us, frame.seal("ascii" if self._ascii else "rtu", reply)

    def given_up(self, data: bytes) -> None:
        """Characters that are no request."""

    def _give_up(self, now_us: int) -> None:
        if self._asked and now_us - self._asked_us > _PATIENCE_US:
            self.given_up(self._asked)
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


def _beginnings(text: bytes, *, ascii_mode: bool) -> Iterator[int]:
    """Where a request may begin that ends here; other units' frames may come before it."""
    yield 0
    if ascii_mode:
        yield max(0, text.rfind(b":"))
        return
    if len(text) > 8:
        yield len(text) - 8
    for begun in range(1, len(text) - 8):
        if text[begun + 1] == 16 and len(text) - begun == 9 + text[begun + 6]:
            yield begun


def opened(text: bytes, *, ascii_mode: bool) -> bytes | None:
    """A whole request without its checksum; None where it is not whole, or wrong."""
    body = frame.opened("ascii" if ascii_mode else "rtu", text)
    return None if body is None or layout.request(body) is None else body
