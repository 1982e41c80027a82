"""Ports that only listen: they have nothing to send with. How a line is spoken on is found by what decodes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from driveblocks.desk.clock import Clock
from driveblocks.desk.frames import Cutter
from driveblocks.desk.port import EXCLUSIVE, MOST, Socket, refusals, takes
from driveblocks.desk.site.found import Way
from driveblocks.desk.site.line import RATES
from driveblocks.modbus.envelope import mode_of
from driveblocks.modbus.frame import Mode
from driveblocks.modbus.layout import Dialect

LOOK_US = 1_000
FORMS = {"8N1": "8N1 or 8N2", "8E1": "8E1 or 8O1", "7E1": "7E1, 7O1 or 7N2"}
"""What is tried, and what it may be as well: a second stop bit is silence, and hardly any port checks parity."""
USUAL = (9600, 19200, 38400, 57600, 115200)
SHARES_US = (2_000_000, 10_000_000)
"""How long each rate and format is listened to in the first round and in the second."""
ENOUGH = 3
"""Good frames that prove a rate and a format; noise makes one now and then."""
PART = 0.6
"""Of all bytes, in good frames; else the other ways are tried first."""


class Ear(Protocol):
    """A line that is heard."""

    def tune(self, way: Way) -> bool:
        """Take a rate and a format; whether the port can. Raises OSError for one that is not there."""

    def receive(self) -> bytes:
        """Bytes that have come. Raises OSError for a port that has gone."""

    def close(self) -> None:
        """Give it back."""


class SerialEar:
    """A serial port. RTS and DTR are kept low; opened once, it stays open while rates are tried."""

    def __init__(self, name: str) -> None:
        """Raises ImportError without pyserial."""
        import serial

        self._name, self._port = name, serial.Serial(timeout=0, exclusive=EXCLUSIVE)
        self._port.rts = self._port.dtr = False

    def tune(self, way: Way) -> bool:
        return takes(lambda: self._set(way))

    def _set(self, way: Way) -> None:
        port: Any = self._port
        with refusals(way.rate, way.form):
            port.baudrate, port.bytesize, port.parity = way.rate, int(way.form[0]), way.form[1]
            if not port.is_open:
                port.port = self._name
                port.open()

    def receive(self) -> bytes:
        return bytes(self._port.read(MOST))

    def close(self) -> None:
        self._port.close()


class TcpEar:
    """The bytes of a line over TCP; the server at the other end has a rate and a format of its own."""

    def __init__(self, host: str, number: int) -> None:
        """Raises OSError."""
        link = Socket((host, number))
        self.receive, self.close = link.read, link.close

    def tune(self, way: Way) -> bool:  # noqa: ARG002 - a server has its own
        return True


def ways(rate: int | None, form: str | None) -> list[Way]:
    """What is tried: the usual rates first; what a person names is all."""
    rates = [rate] if rate else list(dict.fromkeys((*USUAL, *RATES)))
    return [Way(each, shape) for shape in ([form] if form else FORMS) for each in rates]


def find(
    ear: Ear, clock: Clock, tried: Sequence[Way], dialects: Sequence[Dialect], progress: Callable[[Way, int], None]
) -> tuple[Way | None, int]:
    """The way in which frames decode, None where there is none, and how many bytes came in all.

    `progress` gets each way and the bytes before it. Raises OSError.
    """
    came = 0
    best: tuple[float, Way] | None = None
    for share in SHARES_US:
        for one in tried:
            progress(one, came)
            if not ear.tune(one):
                continue
            tally = _heard(ear, clock, Cutter(dialects, one.character_us), share)
            came += tally.came
            way = replace(one, mode=tally.mode)
            if tally.sure:
                return way, came
            if tally.frames >= ENOUGH:
                best = max(best or (0, way), (tally.part, way), key=lambda each: each[0])
        if best is not None:
            return best[1], came
    return None, came


@dataclass
class _Tally:
    frames: int = 0
    good: int = 0
    """Bytes of good frames."""
    came: int = 0
    mode: Mode = "rtu"
    """Of the last good frame."""

    @property
    def part(self) -> float:
        """How much of it is good; at a wrong format some frames decode, too."""
        return self.good / max(1, self.came)

    @property
    def sure(self) -> bool:
        """Whether nothing else need be tried."""
        return self.frames >= ENOUGH and self.part > PART


def _heard(ear: Ear, clock: Clock, cutter: Cutter, share_us: int) -> _Tally:
    """What comes within a time; it ends as soon as that is enough."""
    ear.receive()  # what came at another rate
    end, tally = clock.now_us() + share_us, _Tally()
    while clock.now_us() < end and not tally.sure:
        clock.sleep_until(clock.now_us() + LOOK_US)
        data = ear.receive()
        tally.came += len(data)
        for each in cutter.take(clock.now_us(), data):
            tally.frames += each.good
            tally.good += len(each.data) * each.good
            tally.mode = mode_of(each.data) if each.good else tally.mode
    return tally
