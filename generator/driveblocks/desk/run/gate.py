"""The port as a program has it, until it is taken from it."""

import threading
from collections.abc import Callable

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Port

PATIENCE_S = 0.5
"""How long a port may take to accept or to hand over bytes; it never should wait."""
PATIENCE_US = 500_000
"""The same, as it counts where a port is waited for longer."""

MOST_HEARD = 1000
"""Bytes that are kept of a line on which somebody keeps speaking; no frame and its echo are longer."""


class GivenUp(Exception):  # noqa: N818  (nothing is wrong with the port)
    """The port was taken: this scan must not act any more."""


class Gate:
    """A port that can be taken from the thread that uses it, and what was last spoken on its line."""

    def __init__(self, port: Port, clock: Clock) -> None:
        self.port = port
        self.late_ms, self.close = port.late_ms, port.close
        self.sent = b""
        """The last frame of the program."""
        self.heard = b""
        """What has come since."""
        self.sent_us: int | None = None
        self.heard_us = 0
        self._clock = clock
        self._lock = threading.Lock()
        self._taken = False

    @property
    def error(self) -> str:
        return self.port.error

    def send(self, data: bytes) -> None:
        """Bytes onto the line. Raises GivenUp."""
        with self._lock:
            self.check()
            self.sent, self.heard, self.sent_us = data, b"", self._clock.now_us()
            self.port.send(data)

    def receive(self) -> bytes:
        """Bytes that have come. Raises GivenUp."""
        with self._lock:
            self.check()
            data = self.port.receive()
            if data:
                self.heard, self.heard_us = (self.heard + data)[-MOST_HEARD:], self._clock.now_us()
            return data

    def check(self) -> None:
        """Raise GivenUp if the port was taken."""
        if self._taken:
            raise GivenUp

    def take(self, within_us: int = PATIENCE_US, hurries: Callable[[], bool] = bool) -> bool:
        """Take the port; whether it is free: not if a call of the other thread is stuck in it for so long."""
        self._taken = True
        for _ in range(0, within_us, PATIENCE_US):
            if self._lock.acquire(timeout=PATIENCE_S):
                self._lock.release()
                return True
            if hurries():
                break
        return False
