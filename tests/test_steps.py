"""The measure of work tells even growth from the square of it, and does not look at a clock."""

from collections.abc import Callable

import pytest
from tests.steps import grows_evenly, steps


def turns(count: int) -> Callable[[], object]:
    """Work of this many calls."""
    return lambda: [abs(each) for each in range(count)]


@pytest.mark.parametrize(
    ("count", "even"),
    [
        (lambda _: 20_000, True),
        (lambda size: 20_000 * size, True),
        (lambda size: 100_000 + 20_000 * size, True),
        (lambda size: 100_000 + 20_000 * size**2, False),
        (lambda size: 60_000 if size > 2 else 0, False),
    ],
)
def test_even_growth(count: Callable[[int], int], even: bool) -> None:
    assert grows_evenly(lambda size: turns(count(size))) is even


def test_steps_are_the_same_each_time() -> None:
    assert steps(turns(1000)) == steps(turns(1000)) >= 2000
