"""One line of matiec with the driver that was compiled for it: records in, answers out, and what differs."""

import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.native.driver import run
from tests.native.exhaustive.scan import AnyScan

EXAMPLES = 5
"""Differences that are reported one by one."""


@dataclass(frozen=True)
class Finding:
    """How many cases a line was tried with and how many differ, with the first few in words."""

    line: str
    cases: int
    wrong: int = 0
    examples: tuple[str, ...] = ()
    note: str = ""


@dataclass(frozen=True)
class Trial:
    """Records for a scan, what it must answer to all of them, and how a record is reported in words.

    Raises ValueError if records or answers do not divide into `count`.
    """

    scan: AnyScan
    count: int
    records: bytes
    wanted: bytes
    tell: Callable[[int], str]

    def __post_init__(self) -> None:
        """Each record and each answer has the same size."""
        if self.count < 1 or len(self.records) % self.count or len(self.wanted) % self.count:
            raise ValueError(f"{self.scan.name}: records or answers of different sizes")


@dataclass(frozen=True)
class Bench:
    """A line's name and its driver."""

    line: str
    program: Path
    seconds: float = 3600.0

    def command(self, *arguments: object) -> Finding:
        """A command of the driver that judges by itself: `cases`, `wrong` and `difference` in lines of its output.

        Raises RuntimeError if the driver could not do it.
        """
        done = run(self.program, *arguments, seconds=self.seconds)
        told = dict(re.findall(r"^(\w+) (\d+)$", done.stdout, re.MULTILINE))
        if done.returncode not in {0, 1} or "wrong" not in told:
            raise RuntimeError(f"{self.line}: {arguments}: exit {done.returncode}, {done.stderr[:400]}")
        examples = re.findall(r"^difference (.*)$", done.stdout, re.MULTILINE)
        rest = ", ".join(f"{name} {int(number):,}" for name, number in told.items() if name not in {"cases", "wrong"})
        return Finding(self.line, int(told["cases"]), int(told["wrong"]), tuple(examples), rest)

    def answers(self, trial: Trial, command: str = "scan") -> bytes:
        """What the driver answers to the records of a trial. Raises RuntimeError if it could not do it."""
        with tempfile.TemporaryDirectory() as folder:
            given, found = Path(folder, "in"), Path(folder, "out")
            given.write_bytes(trial.records)
            done = run(self.program, command, trial.scan.name, given, found, seconds=self.seconds)
            if done.returncode:
                raise RuntimeError(f"{self.line}: {trial.scan.name}: exit {done.returncode}, {done.stderr[:400]}")
            return found.read_bytes()

    def judge(self, trial: Trial) -> Finding:
        """Compare the answers with what they must be."""
        found = self.answers(trial)
        if found == trial.wanted:
            return Finding(self.line, trial.count)
        size = len(trial.wanted) // trial.count
        if len(found) != len(trial.wanted):
            say = f"{trial.scan.name}: {len(found) // trial.count} bytes per answer, not {size}"
            return Finding(self.line, trial.count, trial.count, (say,))
        pairs = zip(_pieces(found, size), _pieces(trial.wanted, size), strict=True)
        wrong = [at for at, (one, other) in enumerate(pairs) if one != other]
        examples = [_told(trial, at, found[at * size :], size) for at in wrong[:EXAMPLES]]
        return Finding(self.line, trial.count, len(wrong), tuple(examples))


def _pieces(data: bytes, size: int) -> Iterator[bytes]:
    return (data[at : at + size] for at in range(0, len(data), size))


def _told(trial: Trial, at: int, found: bytes, size: int) -> str:
    """Where the answer to a record first differs, with the bytes from there on."""
    wanted = trial.wanted[at * size : (at + 1) * size]
    first = next(place for place in range(size) if found[place] != wanted[place])
    few = slice(first, min(first + 8, size))
    return f"{trial.scan.name} {trial.tell(at)}: byte {first}: {found[few].hex(' ')}, not {wanted[few].hex(' ')}"


def judged(benches: Sequence[Bench], trials: Iterator[Trial]) -> Iterator[Finding]:
    """Each trial on each line; a trial is made once."""
    for trial in trials:
        for bench in benches:
            yield bench.judge(trial)
