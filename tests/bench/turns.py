"""Time of calls in Python, side by side: all of them in every round."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

Work = Callable[[], object]


@dataclass(frozen=True)
class Taken:
    """Nanoseconds of one call: the least of all rounds, and the median."""

    least: float
    median: float


def side_by_side(works: Mapping[str, Work], rounds: int, calls: int = 20) -> dict[str, Taken]:
    """Nanoseconds of one call of each, round by round in turn."""
    times: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(rounds):
        for name, work in works.items():
            times[name].append(_round(work, calls))
    return {name: Taken(min(found), sorted(found)[len(found) // 2]) for name, found in times.items()}


def _round(work: Work, calls: int) -> float:
    start = time.perf_counter_ns()
    for _ in range(calls):
        work()
    return (time.perf_counter_ns() - start) / calls
