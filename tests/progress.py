"""Says what the tests are at, how far, and how long still: a line for every file that begins, with xdist, too."""

import time
from collections.abc import Callable

import pytest


class Progress:
    """A plugin of pytest; `collected` gives how many tests there are, `write` takes a line, `now` seconds."""

    def __init__(
        self, collected: Callable[[], int], write: Callable[[str], None], now: Callable[[], float] = time.monotonic
    ) -> None:
        """Begin before the first test."""
        self.collected, self.write, self.now = collected, write, now
        self.begun: float | None = None
        self.files: set[str] = set()
        self.ended = 0

    def pytest_report_teststatus(self, report: pytest.TestReport) -> tuple[str, str, str] | None:
        """No dot for a test that has passed: thousands of them say nothing."""
        return ("passed", "", "") if report.passed and report.when == "call" else None

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Name a file with its first test."""
        self.begun = self.now() if self.begun is None else self.begun
        file = nodeid.partition("::")[0].removeprefix("tests/")
        if file not in self.files:
            self.files.add(file)
            self.write(f"{100 * self.ended // max(self.collected(), 1):3} %  {self.left():>10}  {file}")

    def pytest_runtest_logfinish(self) -> None:
        """Count a test."""
        self.ended += 1

    def left(self) -> str:
        """About how long it still takes, if the tests to come take as long as those that have ended."""
        if self.begun is None or self.ended < 20:
            return ""
        still = (self.now() - self.begun) * (self.collected() - self.ended) / self.ended
        return f"{still / 60:.0f} min left" if still > 90 else f"{max(still, 0):.0f} s left"
