"""Texts of the blocks."""

import pytest

from driveblocks.maps.rules.name import ENCODINGS, LONGEST
from driveblocks.render import results


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_the_texts_of_results_fit_as_those_of_a_map_must(encoding: str) -> None:
    texts = [text for result in results.RESULTS for text in (result.en, result.zh)]
    assert [text for text in texts if len(text.encode(encoding)) > LONGEST] == []
