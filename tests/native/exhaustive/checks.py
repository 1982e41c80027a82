"""All checks by name, and what running one says."""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from tests.native.exhaustive import checksums, permissions, references, standstills, words
from tests.native.exhaustive.bench import EXAMPLES, Bench, Finding

Check = Callable[[Sequence[Bench], bool], Iterator[Finding]]
"""A check of some lines, in its short form or whole."""

CHECKS: dict[str, Check] = {
    **{name: references.sweeping(name) for name in references.SWEEPS},
    "decoders": words.decoders,
    "standstill": standstills.standstills,
    "scales": words.scales,
    "fault-numbers": words.fault_numbers,
    "reference-rule": references.rules,
    "reference-words": references.words,
    "permissions": permissions.permissions,
    "checksums": checksums.checksums,
}
"""The longest first, so that two processes end together."""


@dataclass(frozen=True)
class Report:
    """What a check found on all lines, and how long it took."""

    name: str
    seconds: float
    lines: tuple[Finding, ...]

    @property
    def wrong(self) -> int:
        """Differences on all lines."""
        return sum(one.wrong for one in self.lines)

    def __str__(self) -> str:
        """One row per line of matiec, then the first differences."""
        rows = [_row(self.name, self.seconds, one) for one in self.lines]
        return "\n".join([*rows, *(f"    {one.line}: {text}" for one in self.lines for text in one.examples)])


def _row(name: str, seconds: float, one: Finding) -> str:
    result = f"{one.wrong:,} DIFFERENT" if one.wrong else "same"
    note = f" ({one.note})" if one.note else ""
    return f"{name:27} {one.line:15} {one.cases:>14,} cases {seconds:7.1f} s  {result}{note}"


def run(name: str, benches: Sequence[Bench], *, short: bool) -> Report:
    """Run a check. Raises RuntimeError if a driver could not do it."""
    begin = time.monotonic()
    findings = [*CHECKS[name](benches, short)]
    return Report(name, time.monotonic() - begin, (*_summed(findings, benches),))


def _summed(findings: Iterable[Finding], benches: Sequence[Bench]) -> Iterator[Finding]:
    """The findings of each line as one; the note of a line that has only one."""
    for bench in benches:
        own = [one for one in findings if one.line == bench.line]
        examples = [text for one in own for text in one.examples]
        note = own[0].note if len(own) == 1 else ""
        cases, wrong = sum(one.cases for one in own), sum(one.wrong for one in own)
        yield Finding(bench.line, cases, wrong, tuple(examples[:EXAMPLES]), note)
