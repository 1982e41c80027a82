"""Lines that differ from the map in one way, and one that does not: each is named, and nothing is written."""

import pytest
from tests.site.lines import NONE, WAYS, line


@pytest.mark.parametrize("way", [*WAYS, NONE])
def test_what_a_line_differs_in_is_named(way: str) -> None:
    verdict = line(1, way)
    assert verdict.kind == "named", verdict.why


@pytest.mark.long
def test_no_line_is_named_wrongly() -> None:
    assert not [each.why for each in map(line, range(1000)) if each.kind == "wrong"]
