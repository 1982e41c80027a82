"""Maps drawn at random are good, and so are the lives of some of them; tests/shapes/life.py judges many."""

import pytest
from tests.shapes import life

FEW = range(12)


def test_a_map_drawn_at_random_is_good() -> None:
    assert len(life.made(FEW)) == len(FEW)


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["0", "45", "60"])
def test_its_drive_lives(name: str) -> None:
    assert life.judge(name).told == []


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["1", "2", "3", "4"])
def test_a_drive_that_is_not_as_its_map_says_is_found(name: str) -> None:
    assert life.lie(name).told == []
