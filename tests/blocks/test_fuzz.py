"""The short form of the fuzz run, and proof that the run would notice."""

import functools

import pytest
from tests.blocks import fuzz
from tests.blocks.library import sources
from tests.shipped import drives

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import Source

library = functools.cache(fuzz.build)


@pytest.mark.parametrize("prefix", drives())
def test_damaged_replies_are_judged_as_by_the_reference(prefix: str) -> None:
    tally = fuzz.run(library(), drives()[prefix], 20_000, seed=3, lines=100)
    assert tally.wrong == []
    assert {"OK", "REFUSED", "SHORT", "LONG", "CHECKSUM", "NO_END", "NOT_HEX", "ODD_DIGITS"} <= set(tally.results)
    assert {"OTHER_UNIT", "OTHER_FUNCTION", "BYTE_COUNT", "OTHER_VALUE", "OTHER_ADDRESS"} <= set(tally.results)


FAULTS = [
    ("IF Received <> Crc16.Crc THEN", "IF Received = WORD#16#0000 THEN"),
    ("ELSIF Length < Due THEN", "ELSIF Length + 1 < Due THEN"),
    ("ELSIF CharCount > 513 THEN", "ELSIF CharCount > 1000 THEN"),
    ("Position := Position + 2;", "Position := Position + 0;"),
]


def damaged_library(good: str, bad: str) -> EmbeddedLibrary:
    """The blocks with one statement changed."""
    texts = [Source(each.path, each.text.replace(good, bad)) for each in sources()]
    assert any(bad in each.text for each in texts)
    chain = fuzz.CHAIN.format(prefix="CHF")
    return EmbeddedEngine(loop_limit=fuzz.TURNS).build([*texts, Source("chains", chain)])


@pytest.mark.parametrize(("good", "bad"), FAULTS)
def test_a_fault_in_the_blocks_is_found(good: str, bad: str) -> None:
    tally = fuzz.run(damaged_library(good, bad), drives()["CHF"], 6_000, seed=3, lines=60)
    assert tally.wrong
