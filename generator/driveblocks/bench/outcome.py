"""What came out of the test programs: per check, per program, and for a whole run."""

from dataclasses import dataclass, field

from driveblocks.bench.record import Moment

PASSED, FAILED, ERROR = "passed", "failed", "error"


@dataclass(frozen=True)
class Outcome:
    """One check: passed, failed (it found something else), or error (it could not be made)."""

    words: str
    status: str = PASSED
    message: str = ""
    expected: str = ""
    actual: str = ""
    path: str = ""
    line: int = 0
    scene: str = ""

    @property
    def place(self) -> str:
        return f"{self.path}:{self.line}" if self.line else self.path


@dataclass(frozen=True)
class Result:
    """One program on one engine. `seconds` is the time of its scans alone; `properties` are figures about it."""

    engine: str
    unit: str
    program: str
    outcomes: tuple[Outcome, ...]
    seconds: float = 0.0
    properties: tuple[tuple[str, str], ...] = ()
    group: str = ""
    """What the program is about, in the words of a user."""
    record: tuple[Moment, ...] = ()
    """Pins and frames of the first scene that failed, scan by scan."""

    @property
    def scenes(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(outcome.scene for outcome in self.outcomes if outcome.scene))

    def count(self, status: str) -> int:
        """How many checks ended like this."""
        return sum(outcome.status == status for outcome in self.outcomes)

    @property
    def passed(self) -> bool:
        return bool(self.outcomes) and self.count(PASSED) == len(self.outcomes)

    @property
    def bad(self) -> list[Outcome]:
        return [outcome for outcome in self.outcomes if outcome.status != PASSED]


@dataclass(frozen=True)
class Run:
    """All results, in the order of engines, drives and programs."""

    results: list[Result] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def passed(self) -> bool:
        """Whether everything passed, and there was something."""
        return bool(self.results) and all(result.passed for result in self.results)

    def count(self, status: str | None = None) -> int:
        """How many checks ended like this; all without a status."""
        return sum(len(each.outcomes) if status is None else each.count(status) for each in self.results)
