"""A motor on its drive: output frequency and shaft, in thousandths of a hertz, reverse negative."""

from dataclasses import dataclass


@dataclass
class Motor:
    """What turns. A drive without output lets the shaft coast."""

    output: int = 0
    shaft: int = 0
    driven: bool = False

    def start(self) -> None:
        """The drive switches its output on: from 0 at standstill, from the shaft's speed while coasting."""
        if not self.driven:
            self.output, self.driven = self.shaft, True

    def release(self) -> None:
        self.output, self.driven = 0, False

    def step(self, ms: int, goal: int, ramp: int, coast: int) -> None:
        """Go towards a goal for a time, by a ramp in Hz/s."""
        if self.driven:
            self.output = self.shaft = _towards(self.output, goal, ramp * ms)
        else:
            self.shaft = _towards(self.shaft, 0, coast * ms)


def _towards(now: int, goal: int, most: int) -> int:
    return min(now + most, goal) if now < goal else max(now - most, goal)
