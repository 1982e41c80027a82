"""How well the scans kept their time, in memory that does not grow."""

_STEP_US = 20
_STEPS = 100_000
"""Times are counted in steps up to 2 s."""


class Pace:
    def __init__(self, scan_us: int) -> None:
        self.scan_us = scan_us
        self.scans = 0
        self.late = 0
        """Scans that were not done when the next was due."""
        self.missed = 0
        """Scans that were left out because an earlier one took so long."""
        self.worst_us = 0
        self._counts: dict[int, int] = {}

    def add(self, took_us: int, behind_us: int) -> int:
        """One scan, done this long after the time when the next was due; how many are left out now."""
        missed = max(0, behind_us) // self.scan_us
        self.scans += 1
        self.late += behind_us > 0
        self.missed += missed
        self.worst_us = max(self.worst_us, took_us)
        step = min(took_us // _STEP_US, _STEPS)
        self._counts[step] = self._counts.get(step, 0) + 1
        return missed

    def share_us(self, percent: float) -> int:
        """The time within which this percentage of the scans was done."""
        wanted, seen = self.scans * percent / 100, 0
        for step in sorted(self._counts):
            seen += self._counts[step]
            if seen >= wanted:
                return min((step + 1) * _STEP_US, self.worst_us)
        return 0

    @property
    def kept(self) -> float:
        """Percent of the scans that were due and were done in time."""
        due = self.scans + self.missed
        return 100.0 * (self.scans - self.late) / due if due else 100.0

    def __str__(self) -> str:
        took = {"median": self.share_us(50), "99 %": self.share_us(99), "worst": self.worst_us}
        times = ", ".join(f"{us / 1000:.2f} ms ({what})" for what, us in took.items())
        scan = f"{self.scan_us / 1000:g} ms"
        return f"{self.scans} scans of {scan}: {self.kept:.1f} % kept, {self.missed} missed\na scan took {times}"
