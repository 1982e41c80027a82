"""The short form of the fuzz run."""

import functools

import pytest
from tests.blocks import fuzz
from tests.shipped import drives

library = functools.cache(fuzz.build)


@pytest.mark.parametrize("prefix", drives())
def test_damaged_replies_are_judged_as_by_the_reference(prefix: str) -> None:
    tally = fuzz.run(library(), drives()[prefix], 20_000, seed=3, lines=100)
    assert tally.wrong == []
    assert {"OK", "REFUSED", "SHORT", "LONG", "CHECKSUM", "NO_END", "NOT_HEX", "ODD_DIGITS"} <= set(tally.results)
    assert {"OTHER_UNIT", "OTHER_FUNCTION", "BYTE_COUNT", "OTHER_VALUE", "OTHER_ADDRESS"} <= set(tally.results)
