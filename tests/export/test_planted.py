"""Every planted mistake of a writer is found by its check, and there is none in the writers as they are."""

from pathlib import Path

import pytest
from tests.export.planted import PLANTED, Planted


@pytest.mark.parametrize("planted", PLANTED, ids=lambda planted: planted.name)
def test_a_planted_mistake_is_found(planted: Planted, tmp_path: Path) -> None:
    assert planted.old in planted.source
    assert planted.found(tmp_path)


def test_nothing_is_found_in_the_writers_as_they_are(tmp_path: Path) -> None:
    for planted in PLANTED:
        planted.check()
