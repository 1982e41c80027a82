"""Work counted in steps: twice the input must take about twice as many, on every machine and however busy it is."""

import sys
from collections.abc import Callable
from types import FrameType

SLACK = 20_000
"""Steps of what happens only from some size on, such as sorting the most mistakes that are reported."""


def steps(work: Callable[[], object]) -> int:
    """The calls and returns of functions, in Python and in C, that some work takes."""
    count = 0

    def counted(_: FrameType, __: str, ___: object) -> None:
        nonlocal count
        count += 1

    before = sys.getprofile()
    sys.setprofile(counted)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


def grows_evenly(work: Callable[[int], Callable[[], object]]) -> bool:
    """Whether from size 2 to 4 come at most little more than twice the steps that come from 1 to 2; a square has four.

    `work` makes what is counted, for a size. What does not grow falls out of the difference.
    """
    work(1)()  # what is done once only
    one, two, four = (steps(work(size)) for size in (1, 2, 4))
    return four - two <= 2.5 * max(two - one, 0) + SLACK
