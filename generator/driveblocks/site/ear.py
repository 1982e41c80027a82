"""Ports that only listen: they have nothing to send with. How a line is spoken on is found by what decodes."""

import socket
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import CONNECT_S, EXCLUSIVE, MOST, refusals
from driveblocks.modbus.layout import Dialect
from driveblocks.site.found import Way
from driveblocks.site.line import RATES
from driveblocks.site.traffic import Cutter

LOOK_US = 1_000
FORMS = {"8N1": "8N1 or 8N2", "8E1": "8E1 or 8O1", "7E1": "7E1, 7O1 or 7N2"}
"""What is tried, and what it may be as well: a second stop bit is silence, and hardly any port checks parity."""
USUAL = (9600, 19200, 38400, 57600, 115200)
SHARES_US = (2_000_000, 10_000_000)
"""How long each rate and format is listened to in the first round and in the second."""
ENOUGH = 3
"""Good frames that prove a rate and a format; noise makes one now and then."""


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
        """As `Ear` says."""
        port: Any = self._port
        try:
            with refusals(way.rate, way.form):
                port.baudrate, port.bytesize, port.parity = way.rate, int(way.form[0]), way.form[1]
                if not port.is_open:
                    port.port = self._name
                    port.open()
        except ValueError:
            return False
        except OSError as error:
            if "refuses" not in str(error):
                raise
            return False
        return True

    def receive(self) -> bytes:
        """As `Ear` says."""
        return bytes(self._port.read(MOST))

    def close(self) -> None:
        """As `Ear` says."""
        self._port.close()


class TcpEar:
    """The bytes of a line over TCP; the server at the other end has a rate and a format of its own."""

    def __init__(self, host: str, number: int) -> None:
        """Raises OSError."""
        self._link = socket.create_connection((host, number), timeout=CONNECT_S)
        self._link.setblocking(False)

    def tune(self, way: Way) -> bool:  # noqa: ARG002 - a server has its own
        """As `Ear` says."""
        return True

    def receive(self) -> bytes:
        """As `Ear` says."""
        try:
            data = self._link.recv(MOST)
        except (BlockingIOError, InterruptedError):
            return b""
        if not data:
            raise OSError("the other side has closed the connection")
        return data

    def close(self) -> None:
        """As `Ear` says."""
        self._link.close()


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
    for share in SHARES_US:
        for way in tried:
            progress(way, came)
            if not ear.tune(way):
                continue
            good, some = _heard(ear, clock, Cutter(dialects, way.character_us), share)
            came += some
            if good >= ENOUGH:
                return way, came
    return None, came


def _heard(ear: Ear, clock: Clock, cutter: Cutter, share_us: int) -> tuple[int, int]:
    """Good frames and bytes within a time; it ends as soon as there are enough good ones."""
    ear.receive()  # what came at another rate
    end, good, came = clock.now_us() + share_us, 0, 0
    while clock.now_us() < end and good < ENOUGH:
        clock.sleep_until(clock.now_us() + LOOK_US)
        data = ear.receive()
        came += len(data)
        good += sum(each.good for each in cutter.take(clock.now_us(), data))
    return good, came
