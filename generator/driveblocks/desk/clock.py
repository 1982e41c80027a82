"""Time for a scan loop: of the machine, or as fast as it can be computed."""

import time
from typing import Protocol


class Clock(Protocol):
    """Microseconds since some beginning."""

    def now_us(self) -> int:
        """The time."""

    def sleep_until(self, us: int) -> None:
        """Come back at that time."""


class RealClock:
    """The machine's own, since this one was made."""

    def __init__(self) -> None:
        self._begun_ns = time.monotonic_ns()

    def now_us(self) -> int:
        return (time.monotonic_ns() - self._begun_ns) // 1000

    def sleep_until(self, us: int) -> None:
        left = us - self.now_us()
        if left > 0:
            time.sleep(left / 1e6)


class VirtualClock:
    """Time that passes by sleeping alone."""

    def __init__(self) -> None:
        self._now = 0

    def now_us(self) -> int:
        return self._now

    def sleep_until(self, us: int) -> None:
        self._now = max(self._now, us)
