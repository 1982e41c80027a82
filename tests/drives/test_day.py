"""Some minutes of a working day; `make drives`: 24 hours of each family."""

import pytest
from tests.drives.day import day
from tests.drives.station import FAMILIES, maps


@pytest.mark.parametrize("kind", FAMILIES)
def test_nothing_that_is_sent_by_itself_stores(kind: str) -> None:
    written = day(kind, 80_000, every=100)
    assert written[maps()[kind].operation.reference.register] > 10
    assert sum(written.values()) > 20
