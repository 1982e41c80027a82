"""Where a master reaches simulated drives: a TCP port of this computer, a pseudo-terminal, a serial port's echo."""

import os
import socket
from contextlib import suppress

from driveblocks.desk.port import MOST, Port
from driveblocks.maps.problem import Refused

HOST = "127.0.0.1"
"""Nobody else may take a simulator for a drive."""


class TcpLink:
    """Serial bytes over TCP, for one master at a time."""

    late_ms = 0
    error = ""

    def __init__(self, port: int) -> None:
        """Listen; 0 takes any free port. Raises OSError."""
        self._server = socket.create_server((HOST, port))
        self._server.setblocking(False)
        self._master: socket.socket | None = None
        self.place = f"{HOST}:{self._server.getsockname()[1]}"

    @property
    def sockets(self) -> list[socket.socket]:
        """On which something may come."""
        return [self._server, *([self._master] if self._master is not None else [])]

    def send(self, data: bytes) -> None:
        if self._master is not None:
            try:
                self._master.sendall(data)
            except OSError:
                self._drop()

    def receive(self) -> bytes:
        self._accept()
        if self._master is None:
            return b""
        try:
            data = self._master.recv(MOST)
        except (BlockingIOError, InterruptedError):
            return b""
        except OSError:
            data = b""
        if not data:
            self._drop()
        return data

    def close(self) -> None:
        self._drop()
        self._server.close()

    def _accept(self) -> None:
        with suppress(BlockingIOError, InterruptedError, ConnectionError):
            other, _ = self._server.accept()
            if self._master is not None:  # a line has one master
                other.close()
                return
            other.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            other.setblocking(False)
            self._master = other

    def _drop(self) -> None:
        if self._master is not None:
            self._master.close()
            self._master = None


class PtyLink:
    """A pseudo-terminal, whose other end a program opens as it would a serial port."""

    late_ms = 0
    error = ""

    def __init__(self) -> None:
        """Make one. Raises Refused, OSError."""
        try:
            import tty

            made = os.openpty  # none on Windows
        except (ImportError, AttributeError):
            why = "--pty: this system has no pseudo-terminals"
            raise Refused(f"{why}; write --tcp {HOST}:5020, or --port with a null-modem pair") from None
        self._own, self._other = made()
        tty.setraw(self._other)
        os.set_blocking(self._own, False)
        self.place = os.ttyname(self._other)

    def send(self, data: bytes) -> None:
        """Bytes to the master; what nobody reads is lost when the buffer is full."""
        with suppress(OSError):
            os.write(self._own, data)

    def receive(self) -> bytes:
        try:
            return os.read(self._own, MOST)
        except OSError:
            return b""

    def close(self) -> None:
        for descriptor in (self._own, self._other):
            os.close(descriptor)


class WithoutEcho:
    """A port through an adapter that hears what it sends."""

    def __init__(self, inner: Port) -> None:
        self._inner, self._own = inner, b""
        self.late_ms, self.close = inner.late_ms, inner.close

    @property
    def error(self) -> str:
        return self._inner.error

    def send(self, data: bytes) -> None:
        self._own += data
        self._inner.send(data)

    def receive(self) -> bytes:
        data = self._inner.receive()
        same = next((at for at, (one, own) in enumerate(zip(data, self._own, strict=False)) if one != own), None)
        same = min(len(data), len(self._own)) if same is None else same
        self._own = self._own[same:] if same == len(data) else b""
        return data[same:]
