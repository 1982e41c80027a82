"""The end of a run: every drive is stopped past the program, for a bounded time, and told whether it stands."""

from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.maps.plan import plan
from driveblocks.modbus.frame import seal
from driveblocks.plc.clock import Clock
from driveblocks.plc.guard import stop_request
from driveblocks.plc.port import Port
from driveblocks.plc.wire import opened
from driveblocks.simulator.pattern import Pattern, of_condition

WITHIN_US = 10_000_000
"""How long it is tried."""
REPLY_US = 300_000
"""How long a reply may take, with its time on the wire."""
SILENCE_US = 20_000
"""Before each request."""
LOOK_US = 2_000
HURRY_US = 50_000
"""The same for who does not wait: the request itself has to leave."""
SILENT = "no reply to the stop"


@dataclass
class Ending:
    """Why a run ends; set by signals and by whatever else ends it, read by the scan loop."""

    reason: str = ""
    hurry: bool = False
    """Asked a second time: do not wait for the motors."""

    def ask(self, reason: str, *, insists: bool = False) -> None:
        """End the run; who insists while it ends does not wait any longer.

        A terminal that goes brings a signal, the end of the input and a failing screen at once: these do not insist.
        """
        if self.reason and insists:
            self.hurry = True
        self.reason = self.reason or reason


class Stopper:
    """Stops drives, and reads whether they stand."""

    def __init__(self, port: Port, clock: Clock, ending: Ending, *, ascii_mode: bool) -> None:
        """On a port that the program has left."""
        self._port = port
        self._clock = clock
        self._ending = ending
        self._ascii = ascii_mode

    def stop(self, drives: dict[int, Drive], within_us: int = WITHIN_US) -> dict[int, str]:
        """Stop them all; what cannot be confirmed of each, empty where its standstill is proved.

        A stop goes to every drive before any is asked whether it stands.
        """
        end = self._clock.now_us() + within_us
        told = dict.fromkeys(drives, SILENT)
        self._confirm([unit for unit, drive in drives.items() if self._stopped(unit, drive)], drives, told, end)
        while (waiting := [unit for unit, why in told.items() if why]) and self._goes_on(end):
            stopped = [unit for unit in waiting if self._goes_on(end) and self._stopped(unit, drives[unit])]
            self._confirm(stopped, drives, told, end)
        return told

    def _confirm(self, stopped: list[int], drives: dict[int, Drive], told: dict[int, str], end: int) -> None:
        """Read whether drives that have acknowledged their stop stand."""
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
            else "stop acknowledged, its status does not prove that it stands"
        )

    def _read(self, unit: int, function: int, register: int) -> int | None:
        reply = self._ask(bytes([unit, function, *register.to_bytes(2, "big"), 0, 1]), 5)
        return int.from_bytes(reply[3:5], "big") if reply[2:3] == b"\x02" else None

    def _ask(self, body: bytes, length: int) -> bytes:
        """A request, and its reply of so many bytes, both without checksum; empty if there is none."""
        mode = "ascii" if self._ascii else "rtu"
        request = seal(mode, body)
        self._clock.sleep_until(self._clock.now_us() + SILENCE_US)
        self._port.receive()
        self._port.send(request)
        heard, begun = b"", self._clock.now_us()
        while self._clock.now_us() - begun < (HURRY_US if self._ending.hurry else REPLY_US):
            self._clock.sleep_until(self._clock.now_us() + LOOK_US)
            heard += self._port.receive()
            for text in (heard, heard.removeprefix(request)):
                reply = self._reply(text, length)
                if reply[:2] == body[:2]:
                    return reply
        return b""

    def _reply(self, text: bytes, length: int) -> bytes:
        if self._ascii:
            return opened(text, ascii_mode=True) or b""
        whole = text[: length + 2]
        return whole[:-2] if len(whole) == length + 2 and seal("rtu", whole[:-2]) == whole else b""


def _holds(pattern: Pattern, words: dict[int, int | None]) -> bool:
    return pattern.holds(words[pattern.register] or 0)
