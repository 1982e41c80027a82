"""Between the variables of a program and the bytes of a port."""

from collections import deque

from driveblocks.desk.run.wiring import Wiring
from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.embedded.certainty import known

MOST_BYTES = 255
"""What a line takes in one scan."""


class Mailbox:
    """Hands received bytes to a program before its scan, and takes what it sends after it."""

    def __init__(self, instance: EmbeddedInstance, wiring: Wiring) -> None:
        self._instance = instance
        self._wiring = wiring
        self._waiting: deque[int] = deque()

    def give(self, data: bytes) -> None:
        """Put received bytes where the line finds them; what does not fit waits for the next scan."""
        self._waiting.extend(data)
        some = bytes(self._waiting.popleft() for _ in range(min(len(self._waiting), self._room())))
        if self._wiring.port is None:
            self._instance[self._wiring.rx_count] = len(some)
            if some:
                self._instance[self._wiring.rx_chars] = some
            return
        place = self._number(f"{self._wiring.port}.RxIn")
        for byte in some:
            self._instance[f"{self._wiring.port}.Rx[{place % 256}]"] = byte
            place += 1
        self._instance[f"{self._wiring.port}.RxIn"] = place % 256

    def take(self) -> bytes:
        """What the line wants to send now; empty for nothing."""
        if self._wiring.port is None:
            count = self._number(f"{self._wiring.line}.TxCount")
            return self._bytes(self._wiring.tx_chars, count) if count else b""
        port = self._wiring.port
        number, count = self._number(f"{port}.TxNumber"), self._number(f"{port}.TxCount")
        if number == self._number(f"{port}.TxTaken") or not count:
            return b""
        self._instance[f"{port}.TxTaken"] = number
        return self._bytes(f"{port}.Tx", count)

    def _room(self) -> int:
        if self._wiring.port is None:
            return MOST_BYTES
        used = self._number(f"{self._wiring.port}.RxIn") - self._number(f"{self._wiring.port}.RxOut")
        return MOST_BYTES - used % 256

    def _number(self, path: str) -> int:
        return known(self._instance[path], int)

    def _bytes(self, path: str, count: int) -> bytes:
        return bytes(known(self._instance[path], list)[:count])
