"""Real units on a real port: none may have the address of a simulated drive.

A PLC could read from the simulator that a drive has stopped whose motor turns.
"""

from collections.abc import Callable, Mapping

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Port
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect, plan, read_request
from driveblocks.modbus import layout, scan
from driveblocks.modbus.envelope import open_
from driveblocks.modbus.frame import seal

LISTEN_US = 3_000_000
QUIET_US = 50_000
"""Silence before a question; on a line that is never so quiet, it is asked after `MOST_WAIT_US`."""
MOST_WAIT_US = 1_000_000
REPLY_US = 500_000
TIMES = 2
LOOK_US = 2_000


class Neighbours:
    """Listens to a line and asks on it."""

    def __init__(self, link: Port, clock: Clock, drives: Mapping[int, Drive], *, ascii_mode: bool) -> None:
        self._link, self._clock, self._drives = link, clock, drives
        self._mode = "ascii" if ascii_mode else "rtu"
        self.echo = False
        """Whether the port hears what it sends."""

    def found(self, say: Callable[[str], None]) -> str:
        """Why the drives must not be simulated here; empty if no unit has answered."""
        say(f"listening for {LISTEN_US // 1_000_000} s for real units at {', '.join(map(str, self._drives))}")
        heard = self._heard(LISTEN_US)
        for unit in self._drives:
            if self._answers(heard, unit):
                return _refusal(unit)
        for unit in self._drives:
            say(f"asking unit {unit}")
            for _ in range(TIMES):
                if self._asked(unit, busy=bool(heard)):
                    return _refusal(unit)
        return ""

    def _heard(self, us: int) -> bytes:
        data, end = b"", self._clock.now_us() + us
        while self._clock.now_us() < end:
            data += self._link.receive()
            self._clock.sleep_until(self._clock.now_us() + LOOK_US)
        return data

    def _answers(self, data: bytes, unit: int) -> bool:
        """Whether a unit has answered somebody: a reply by its form, or a request that comes twice, as echoes do."""
        spoken, before = dialect(self._drives[unit]), b""
        for piece in scan.pieces(data, spoken):
            body = open_(piece.data).body if piece.good else b""
            forms = [each.direction for each in layout.readings(body, spoken) if each.fits] if len(body) > 2 else []
            if body[:1] == bytes([unit]) and (forms == ["reply"] or ("reply" in forms and piece.data == before)):
                return True
            before = piece.data
        return False

    def _asked(self, unit: int, *, busy: bool) -> bool:
        """Whether a unit answers a read; on a line that was quiet, anything that comes is an answer."""
        self._wait_for_silence()
        first = plan(self._drives[unit]).readable[0].first
        question = seal(self._mode, read_request(unit, self._drives[unit], Span(first, first)))
        self._link.send(question)
        heard = self._heard(REPLY_US)
        if heard.startswith(question):
            self.echo = True
            heard = heard[len(question) :]
        return self._answers(heard, unit) if busy else bool(heard)

    def _wait_for_silence(self) -> None:
        end = self._clock.now_us() + MOST_WAIT_US
        while self._heard(QUIET_US) and self._clock.now_us() < end:
            pass


def _refusal(unit: int) -> str:
    return (
        f"a real unit answers at address {unit}: a PLC could read from the simulator that it has stopped while its "
        f"motor turns; simulate another unit, or take the real one off the line"
    )
