"""A request past any program, and the reply to it: one after the other, with the silence that the line asks for."""

from collections.abc import Callable
from dataclasses import dataclass

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Port
from driveblocks.modbus.frame import opened, seal

REPLY_US = 300_000
"""How long a drive may take to reply, beside the time on the wire."""
SILENCE_US = 20_000
"""Before each request, at least: an adapter may keep the end of a reply back for 16 ms."""
SILENT_CHARACTERS = 3.5
CHATTER_US = 1_000_000
"""A line on which somebody keeps speaking for this long is not waited for."""
LOOK_US = 2_000
HURRY_US = 50_000
"""As REPLY_US, for those who do not wait: the request itself has to be sent."""


@dataclass(frozen=True)
class Speech:
    """How a line is spoken on."""

    ascii_mode: bool
    character_us: float
    silence_us: int = 0
    """What the drives ask for around a frame."""


@dataclass(frozen=True)
class Last:
    """What was last spoken on a line, and when."""

    sent: bytes = b""
    heard: bytes = b""
    sent_us: int | None = None
    heard_us: int = 0


class Asker:
    """Asks on a line that nobody else speaks on."""

    def __init__(
        self, port: Port, clock: Clock, speech: Speech, last: Last | None = None, hurries: Callable[[], bool] = bool
    ) -> None:
        """After what was `last` spoken; `hurries`: a reply is not waited for as long."""
        last = last or Last()
        self._port = port
        self._clock = clock
        self._hurries = hurries
        self._ascii = speech.ascii_mode
        self._character_us = speech.character_us
        self._silence_us = max(speech.silence_us, SILENCE_US, int(SILENT_CHARACTERS * speech.character_us))
        self._sent, self._heard = last.sent, last.heard
        sent_us = clock.now_us() if last.sent_us is None else last.sent_us + self._wire_us(last.sent)
        self._spoken_us = max(sent_us, last.heard_us)
        self._reply_by_us = sent_us + REPLY_US if last.sent else sent_us
        """Until then, the reply to the last request may begin."""

    def ask(self, body: bytes, *lengths: int, functions: tuple[int, ...] = ()) -> bytes:
        """A request, and its reply of one of these numbers of bytes, without checksum; empty if there is none.

        The reply has the function of the request, or one of `functions`.
        """
        self._be_silent()
        request = self._sent = seal("ascii" if self._ascii else "rtu", body)
        self._port.send(request)
        self._heard, begun = b"", self._clock.now_us()
        longest = seal("ascii" if self._ascii else "rtu", bytes(max(lengths)))
        wire = self._wire_us(request) + self._wire_us(longest)
        self._spoken_us = self._reply_by_us = begun + self._wire_us(request)
        while self._clock.now_us() - begun < wire + (HURRY_US if self._hurries() else REPLY_US):
            self._listen()
            for text in (self._heard, self._heard.removeprefix(request)):
                for length in lengths:
                    reply = self._reply(text, length)
                    if reply[:1] == body[:1] and reply[1] in (body[1], *functions):
                        return reply
        return b""

    def _be_silent(self) -> None:
        """Wait until the reply to the last request has come, or does not come, and nothing has been said since."""
        self._hear()
        most = max(self._clock.now_us(), self._reply_by_us) + CHATTER_US
        while (now := self._clock.now_us()) < most:
            replied = self._heard.removeprefix(self._sent)  # an adapter may give back what was sent
            if (replied or now >= self._reply_by_us) and now - self._spoken_us >= self._silence_us:
                return
            self._listen()

    def _listen(self) -> None:
        self._clock.sleep_until(self._clock.now_us() + LOOK_US)
        self._hear()

    def _hear(self) -> None:
        if some := self._port.receive():
            self._heard += some
            self._spoken_us = self._clock.now_us()

    def _wire_us(self, frame: bytes) -> int:
        return int(len(frame) * self._character_us)

    def _reply(self, text: bytes, length: int) -> bytes:
        body = opened("ascii", text) if self._ascii else opened("rtu", text[: length + 2])
        return body if body is not None and len(body) == length else b""
