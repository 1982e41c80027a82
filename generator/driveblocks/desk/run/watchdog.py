"""The watchdog of the scans, as a PLC has it: for how long one has been going on, and when it has to be given up."""

import queue
from collections.abc import Callable

from driveblocks.desk.clock import RealClock
from driveblocks.desk.ending import Bell, Ending

LIMIT_US = 500_000
FIRST_US = 3_000_000
"""For the first scan."""
PATIENCE_US = 500_000
"""How long the scan that is under way may go on when the run has been asked to end."""

LOOK_US = 200_000
"""Between two looks at least; the bell and the end of a limit are heeded at once."""

now_us = RealClock().now_us


def heard(bell: Bell, within_us: int) -> None:
    """Wait until a bell rings, for so long at most."""
    try:
        bell.get(timeout=within_us / 1e6)
    except queue.Empty:
        return


class Watchdog:
    """Begins and ends with every scan; `watch` runs in another thread, on the clock of the machine."""

    def __init__(
        self, limit_us: int = LIMIT_US, now_us: Callable[[], int] = now_us, wait: Callable[[Bell, int], None] = heard
    ) -> None:
        """A scan may take so long; `now_us` and `wait` are the time and a way to let it pass."""
        self.limit_us = limit_us
        self.bites = False
        """A scan has taken too long."""
        self._now_us = now_us
        self._wait = wait
        self._begun_us: int | None = None
        self.may_us = max(FIRST_US, limit_us)
        """How long the next or present one may take."""

    def begin(self) -> None:
        self._begun_us = self._now_us()

    def end(self) -> None:
        self._begun_us = None
        self.may_us = self.limit_us

    @property
    def scanning(self) -> bool:
        return self._begun_us is not None

    def left_us(self) -> int:
        """How long the scan that is under way, or one that begins now, may still take."""
        begun = self._begun_us
        return self.may_us - (0 if begun is None else self._now_us() - begun)

    def watch(self, ending: Ending, over: Callable[[], bool]) -> None:
        """Come back when the scans are over, or have to be given up: for a slow one, or since the end was asked for."""
        asked_us: int | None = None
        while not over():
            left = self.left_us()
            if left <= 0:
                self.bites = True
                return
            if ending.reason:
                if not self.scanning:
                    return
                now = self._now_us()
                asked_us = now if asked_us is None else asked_us
                left = min(left, asked_us + PATIENCE_US - now)
                if left <= 0:
                    return
            self._wait(ending.bell, min(left, self.limit_us, LOOK_US))
