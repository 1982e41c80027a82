"""The same walks on every engine: after each scan the whole state is the same."""

from collections.abc import Mapping

import pytest
from tests.blocks.compare.comparison import beside
from tests.line.twins import DifferentError, Twins
from tests.line.vline import line_sources
from tests.line.walk import walk

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Library

_BUILT: dict[str, Library] = {}


def twins(engines: Mapping[str, Engine], every: int = 1) -> Twins:
    """A line on each of them."""
    for name in engines.keys() - _BUILT.keys():
        _BUILT[name] = engines[name].build(line_sources())
    return Twins([_BUILT[name].instance("MB_Line8") for name in engines], every)


@pytest.mark.parametrize("seed", [6, 16])
def test_matiec_and_the_embedded_engine(matiec: Engine, seed: int) -> None:
    walk(seed, 300, twins(beside(matiec), every=3))


def test_a_difference_is_found() -> None:
    both = twins({"one": EmbeddedEngine(), "other": EmbeddedEngine()})
    both.instances[1]["Good"] = 7
    with pytest.raises(DifferentError, match="GOOD"):
        walk(0, 3, both)
