"""Mistakes planted in the blocks are found: here some of them, and that each has its place; by `make drives` all."""

import pytest
from tests.drives.planted import PLANTED, Planted
from tests.drives.station import texts


def test_every_mistake_has_its_place() -> None:
    there = {each.kinds: "".join(one.text for one in texts(kinds=each.kinds)) for each in PLANTED}
    assert [each.name for each in PLANTED if each.old not in there[each.kinds]] == []
    assert len({each.name for each in PLANTED}) == len(PLANTED) >= 30


@pytest.mark.parametrize("planted", PLANTED[::30], ids=lambda each: each.name)
def test_it_is_found(planted: Planted) -> None:
    assert planted.found(), planted.by
