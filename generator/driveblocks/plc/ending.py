"""The end of a run: every drive is stopped past the program, for a bounded time, and read for its standstill."""

import queue
from dataclasses import dataclass, field

from driveblocks.desk.clock import Clock
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import plan
from driveblocks.modbus.frame import opened, seal
from driveblocks.modbus.layout import granted
from driveblocks.plc.gate import Gate
from driveblocks.plc.guard import stop_request
from driveblocks.simulator.pattern import Pattern, of_condition

WITHIN_US = 10_000_000
"""How long it is tried where no drive block gives the time to standstill."""
LEAST_US = 2_000_000
"""How long it is tried at least: eight drives are not stopped and read in less."""
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
SILENT = "no reply to the stop"

Bell = queue.SimpleQueue[None]
"""What wakes the watchdog; signals may ring it, since its `put` may interrupt itself."""


@dataclass
class Ending:
    """Why a run ends; set by signals and by whatever else ends it, read by the scan loop."""

    reason: str = ""
    hurry: bool = False
    """Asked a second time: do not wait for the motors."""
    bell: Bell = field(default_factory=Bell)
    """Rings when the end is asked for, and when the scans are over."""

    def ask(self, reason: str, *, insists: bool = False) -> None:
        """End the run; who insists while it ends does not wait any longer.

        A terminal that closes brings a signal, the end of the input and a failing screen at once: these do not insist.
        """
        if self.reason and insists:
            self.hurry = True
        self.reason = self.reason or reason
        self.bell.put(None)


@dataclass(frozen=True)
class Speech:
    """How a line is spoken on."""

    ascii_mode: bool
    character_us: float
    silence_us: int = 0
    """What the drives ask for around a frame."""


class Stopper:
    """Stops drives, and reads whether they are at standstill."""

    def __init__(self, gate: Gate, clock: Clock, ending: Ending, speech: Speech) -> None:
        """On a port that was taken from the program."""
        self._port = gate.port
        self._clock = clock
        self._ending = ending
        self._ascii = speech.ascii_mode
        self._character_us = speech.character_us
        self._silence_us = max(speech.silence_us, SILENCE_US, int(SILENT_CHARACTERS * speech.character_us))
        self._sent, self._heard = gate.sent, gate.heard
        sent_us = clock.now_us() if gate.sent_us is None else gate.sent_us + self._wire_us(gate.sent)
        self._spoken_us = max(sent_us, gate.heard_us)
        self._reply_by_us = sent_us + REPLY_US if gate.sent else sent_us
        """Until then, the reply to the last request may begin."""

    def stop(self, drives: dict[int, Drive], within_us: int = WITHIN_US) -> dict[int, str]:
        """Stop them all; what cannot be confirmed of each, empty where its standstill is proved.

        A stop is sent to every drive before any is asked for its standstill.
        """
        end = self._clock.now_us() + within_us
        told = dict.fromkeys(drives, SILENT)
        self._confirm([unit for unit, drive in drives.items() if self._stopped(unit, drive)], drives, told, end)
        while (waiting := [unit for unit, why in told.items() if why]) and self._goes_on(end):
            stopped = [unit for unit in waiting if self._goes_on(end) and self._stopped(unit, drives[unit])]
            self._confirm(stopped, drives, told, end)
        return told

    def _confirm(self, stopped: list[int], drives: dict[int, Drive], told: dict[int, str], end: int) -> None:
        """Read whether drives that have acknowledged their stop are at standstill."""
        for unit in stopped:
            if self._goes_on(end):
                told[unit] = self._moves(unit, drives[unit])
            elif told[unit] == SILENT:
                told[unit] = "stop acknowledged, not read since"

    def _goes_on(self, end: int) -> bool:
        return self._clock.now_us() < end and not self._ending.hurry

    def _stopped(self, unit: int, drive: Drive) -> bool:
        """Send a stop; whether the drive has acknowledged it."""
        request = stop_request(unit, drive)
        return self._ask(request, 6) == request[:6]

    def _moves(self, unit: int, drive: Drive) -> str:
        """Why standstill is not proved; empty if it is."""
        function = 3 if 3 in plan(drive).functions else 4
        patterns = [of_condition(each) for each in drive.operation.standstill.all]
        words = {register: self._read(unit, function, register) for register in {each.register for each in patterns}}
        if None in words.values():
            return "stop acknowledged, its status is not answered"
        return (
            ""
            if all(_holds(each, words) for each in patterns)
            else "stop acknowledged, its status does not prove standstill"
        )

    def _read(self, unit: int, function: int, register: int) -> int | None:
        reply = self._ask(bytes([unit, function, *register.to_bytes(2, "big"), 0, 1]), 5)
        words = granted(reply, "reply").words if reply else ()
        return words[0] if len(words) == 1 else None

    def _ask(self, body: bytes, length: int) -> bytes:
        """A request, and its reply of this number of bytes, both without checksum; empty if there is none."""
        self._be_silent()
        request = self._sent = seal("ascii" if self._ascii else "rtu", body)
        self._port.send(request)
        self._heard, begun = b"", self._clock.now_us()
        wire = self._wire_us(request) + self._wire_us(seal("ascii" if self._ascii else "rtu", bytes(length)))
        self._spoken_us = self._reply_by_us = begun + self._wire_us(request)
        while self._clock.now_us() - begun < wire + (HURRY_US if self._ending.hurry else REPLY_US):
            self._listen()
            for text in (self._heard, self._heard.removeprefix(request)):
                reply = self._reply(text, length)
                if reply[:2] == body[:2]:
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


def _holds(pattern: Pattern, words: dict[int, int | None]) -> bool:
    return pattern.holds(words[pattern.register] or 0)
