"""The short form: every block by damaged and odd inputs under sanitizers."""

import pytest
from tests.native.sanitize.campaign import at_once, build
from tests.native.sanitize.sanitizers import Checked, compilers, found_lines, why_none

from structured_text.engines.matiec import MatiecEngine

INPUTS = 20_000


def checked(engine: MatiecEngine) -> Checked:
    """One compiler per line, another for the next line, so that all come up; the long form takes all with all."""
    found = compilers(engine)
    if not found:
        pytest.skip(why_none(engine))
    names = [each.name for each in found_lines()]
    return found[names.index(engine.name) % len(found)]


def test_no_block_goes_wrong(matiec: MatiecEngine) -> None:
    done = at_once(build(matiec, checked(matiec)), seed=1, count=INPUTS)
    assert done.finds == []
    built = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}
    received = {20, 21, 22, 23, 24, 25, 26, 27, 30, 31, 32, 33, 34, 35, 36, 37, 38, 40}
    assert set(done.results) == {0} | built | received, "the inputs reach every ErrorID"
