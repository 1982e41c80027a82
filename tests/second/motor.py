"""A motor as straight lines of its speed over time: exact at every moment, however often one looks."""

from dataclasses import dataclass
from math import ceil, copysign

NEVER = 1 << 62
"""A time in microseconds that does not come."""


@dataclass
class Motor:
    """A shaft in Hz of the drive's output, reverse negative. `aim` begins a line, `settle` ends it at `end_us`."""

    start_us: int = 0
    start_hz: float = 0.0
    goal_hz: float = 0.0
    slope: float = 0.0
    """In Hz per microsecond."""
    end_us: int = NEVER

    def hz(self, now_us: int) -> float:
        """The speed of the shaft; a look at the time before the line shows its beginning."""
        if now_us >= self.end_us:
            return self.goal_hz
        return self.start_hz + self.slope * max(0, now_us - self.start_us)

    def aim(self, now_us: int, goal_hz: float, up_hz_s: float, down_hz_s: float) -> None:
        """Go to a speed, by the way of standstill where the direction changes: then `settle` and aim again."""
        hz = self.hz(now_us)
        if hz * goal_hz < 0:
            goal_hz = 0.0
        rate = up_hz_s if abs(goal_hz) > abs(hz) else down_hz_s
        self.start_us, self.start_hz, self.goal_hz = now_us, hz, goal_hz
        self.slope, self.end_us = 0.0, NEVER
        if hz != goal_hz:
            self.slope = copysign(rate / 1e6, goal_hz - hz)
            self.end_us = now_us + ceil(abs(goal_hz - hz) / rate * 1e6)

    def settle(self) -> None:
        """Stay at the speed that was aimed at."""
        self.start_us, self.start_hz, self.slope, self.end_us = self.end_us, self.goal_hz, 0.0, NEVER
