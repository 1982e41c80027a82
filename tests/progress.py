"""Says what the tests are at, and how far: a line for every file that begins, where processes run side by side."""

from collections.abc import Callable

import pytest


class Progress:
    """A plugin of pytest; `collected` gives how many tests there are, `write` takes a line."""

    def __init__(self, collected: Callable[[], int], write: Callable[[str], None]) -> None:
        """Begin before the first test."""
        self.collected, self.write = collected, write
        self.files: set[str] = set()
        self.ended = 0

    def pytest_report_teststatus(self, report: pytest.TestReport) -> tuple[str, str, str] | None:
        """No dot for a test that has passed: thousands of them say nothing."""
        return ("passed", "", "") if report.passed and report.when == "call" else None

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Name a file with its first test."""
        file = nodeid.partition("::")[0].removeprefix("tests/")
        if file not in self.files:
            self.files.add(file)
            self.write(f"{100 * self.ended // max(self.collected(), 1):3} %  {file}")

    def pytest_runtest_logfinish(self) -> None:
        """Count a test."""
        self.ended += 1
