"""Serial ports: a simulated line in this process, a TCP socket that carries serial bytes, a serial port."""

import errno
import os
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any, Protocol

from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import Clock

AGAIN_US = 1_000_000
"""Between two attempts to open a port that has gone."""
CONNECT_S = 0.2
LATE_MS = 20
"""How long a network or an adapter may keep a request and a reply back, both together."""
MOST = 4096
EXCLUSIVE = None if os.name == "nt" else True
"""A second program must not speak on the line; Windows never lets it."""

_WHY = {
    errno.ENOENT: "there is no such port",
    errno.EACCES: "this user may not open it; on Linux, members of the group dialout may",
    errno.EAGAIN: "another program has this port",
    errno.EBUSY: "another program has this port",
}
"""What pyserial says at length."""


class Port(Protocol):
    """Bytes to and fro, without ever waiting."""

    late_ms: int

    @property
    def error(self) -> str:
        """Why it does not work; empty while it does."""

    def send(self, data: bytes) -> None:
        """Bytes onto the line; lost while the port does not work."""

    def receive(self) -> bytes:
        """Bytes that have come."""

    def close(self) -> None:
        """Give it back."""


class WirePort:
    """A simulated line in this process."""

    late_ms = 0
    error = ""

    def __init__(self, wire: Bus, clock: Clock) -> None:
        """Drives on a wire, and their time."""
        self._wire, self._clock = wire, clock

    def send(self, data: bytes) -> None:
        self._wire.send(data, self._clock.now_us())

    def receive(self) -> bytes:
        return self._wire.receive(self._clock.now_us())

    def close(self) -> None:
        """Nothing to give back."""


class DevicePort:
    """A port of the machine; one that disappears is looked for again, once a second.

    `device` has `read() -> bytes`, `write(bytes)` and `close()`, and `opened` makes it; all of them raise OSError.
    """

    late_ms = LATE_MS

    def __init__(self, opened: Callable[[], Any], clock: Clock) -> None:
        """Open it. Raises OSError."""
        self._opened = opened
        self._clock = clock
        self._device: Any = opened()
        self._tried_us = clock.now_us()
        self.error = ""

    def send(self, data: bytes) -> None:
        if self._device is not None:
            try:
                self._device.write(data)
            except OSError as error:
                self._gone(error)

    def receive(self) -> bytes:
        if self._device is None:
            self._look_again()
        try:
            return bytes(self._device.read()) if self._device is not None else b""
        except OSError as error:
            self._gone(error)
            return b""

    def close(self) -> None:
        if self._device is not None:
            self._device.close()
            self._device = None

    def _gone(self, error: OSError) -> None:
        self.error = reason(error)
        self._tried_us = self._clock.now_us()
        self.close()

    def _look_again(self) -> None:
        now = self._clock.now_us()
        if now - self._tried_us < AGAIN_US:
            return
        self._tried_us = now
        try:
            self._device = self._opened()
            self.error = ""
        except OSError as error:
            self.error = reason(error)


def reason(error: Exception) -> str:
    """Why a port does not work, without the number of the error."""
    return str(getattr(error, "strerror", None) or error)


class Socket:
    """A TCP connection as a device."""

    def __init__(self, address: tuple[str, int]) -> None:
        self._socket = socket.create_connection(address, CONNECT_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.setblocking(False)

    def write(self, data: bytes) -> None:
        self._socket.sendall(data)

    def read(self) -> bytes:
        try:
            data = self._socket.recv(MOST)
        except (BlockingIOError, InterruptedError):
            return b""
        if not data:
            raise OSError(errno.ECONNRESET, "the other side has closed the connection")
        return data

    def close(self) -> None:
        self._socket.close()


@contextmanager
def refusals(bit_rate: int, form: str) -> Iterator[None]:
    """Why a serial port cannot be opened or set, as OSError in plain words."""
    try:
        yield
    except ValueError:
        raise
    except OSError as error:
        if "Could not configure port" in str(error):
            raise OSError(errno.ENOTTY, "this is no serial port") from error
        raise OSError(error.errno, _WHY.get(error.errno or 0) or str(error)) from error
    except Exception as error:  # an error of its own on each platform, as of a pseudo-terminal that has no parity
        refuses = f"the port refuses {bit_rate} bit/s {form}; a pseudo-terminal takes 8N1 only"
        raise OSError(errno.EINVAL, refuses) from error


def takes(tuned: Callable[[], object]) -> bool:
    """Whether a port takes a rate and a format. Raises OSError for one that is not there at all."""
    try:
        tuned()
    except ValueError:
        return False
    except OSError as error:
        if "refuses" not in str(error):
            raise
        return False
    return True


class _Serial:
    def __init__(self, name: str, bit_rate: int, form: str) -> None:
        import serial

        with refusals(bit_rate, form):
            self._port = serial.Serial(
                name, bit_rate, int(form[0]), form[1], int(form[2]), timeout=0, write_timeout=0, exclusive=EXCLUSIVE
            )

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def read(self) -> bytes:
        return bytes(self._port.read(MOST))

    def close(self) -> None:
        self._port.close()


def tcp(host: str, port: int, clock: Clock) -> DevicePort:
    """Serial bytes over TCP; a name is looked up once, since nobody knows how long that takes. Raises OSError."""
    why = OSError(errno.EADDRNOTAVAIL, "the name has no address")
    for *_, (ip, *_) in socket.getaddrinfo(host, port, type=socket.SOCK_STREAM):
        try:
            return DevicePort(partial(Socket, (str(ip), port)), clock)
        except OSError as error:
            why = error
    raise why


def serial_port(name: str, bit_rate: int, form: str, clock: Clock) -> DevicePort:
    """A serial port by pyserial; a form is data bits, parity and stop bits. Raises ImportError, OSError, ValueError."""
    return DevicePort(lambda: _Serial(name, bit_rate, form), clock)
