"""Where a master reaches simulated drives: a TCP port of this computer, a pseudo-terminal, a serial port's echo."""

import os
import socket
from contextlib import suppress
from typing import Protocol

MOST = 4096
HOST = "127.0.0.1"
"""Nobody else may take a simulator for a drive."""


class Link(Protocol):
    """Bytes to and fro, without ever waiting."""

    @property
    def error(self) -> str:
        """Why it does not work; empty while it does."""

    def send(self, data: bytes) -> None:
        """Bytes to the master; lost where there is none."""

    def receive(self) -> bytes:
        """Bytes that have come."""

    def close(self) -> None:
        """Give it back."""


class UnavailableError(Exception):
    """This computer has no such thing; the text says what to use instead."""


class TcpLink:
    """Serial bytes over TCP, for one master at a time."""

    error = ""

    def __init__(self, port: int) -> None:
        """Listen; 0 takes any free port. Raises OSError."""
        self._server = socket.create_server((HOST, port))
        self._server.setblocking(False)
        self._master: socket.socket | None = None
        self.place = f"{HOST}:{self._server.getsockname()[1]}"

    def send(self, data: bytes) -> None:
        """Bytes to the master."""
        if self._master is not None:
            try:
                self._master.sendall(data)
            except OSError:
                self._drop()

    def receive(self) -> bytes:
        """Bytes of the master."""
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
        """Listen no more."""
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

    error = ""

    def __init__(self) -> None:
        """Make one. Raises UnavailableError, OSError."""
        try:
            import tty

            made = os.openpty  # none on Windows
        except (ImportError, AttributeError):
            why = "--pty: this system has no pseudo-terminals"
            raise UnavailableError(f"{why}; write --tcp {HOST}:5020, or --port with a null-modem pair") from None
        self._own, self._other = made()
        tty.setraw(self._other)
        os.set_blocking(self._own, False)
        self.place = os.ttyname(self._other)

    def send(self, data: bytes) -> None:
        """Bytes to the master; what nobody reads is lost when the buffer is full."""
        with suppress(OSError):
            os.write(self._own, data)

    def receive(self) -> bytes:
        """Bytes of the master."""
        try:
            return os.read(self._own, MOST)
        except OSError:
            return b""

    def close(self) -> None:
        """The terminal closes."""
        for descriptor in (self._own, self._other):
            os.close(descriptor)


class WithoutEcho:
    """A link through an adapter that hears what it sends."""

    def __init__(self, inner: Link) -> None:
        """Around that one."""
        self._inner = inner
        self._own = b""

    @property
    def error(self) -> str:
        """As the adapter says."""
        return self._inner.error

    def send(self, data: bytes) -> None:
        """Bytes whose echo will come."""
        self._own += data
        self._inner.send(data)

    def receive(self) -> bytes:
        """Bytes that have come, without the echo."""
        data = self._inner.receive()
        same = next((at for at, (one, own) in enumerate(zip(data, self._own, strict=False)) if one != own), None)
        same = min(len(data), len(self._own)) if same is None else same
        self._own = self._own[same:] if same == len(data) else b""
        return data[same:]

    def close(self) -> None:
        """Give it back."""
        self._inner.close()
