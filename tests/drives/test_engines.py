"""Three drive blocks and their line on every engine: after each compared scan the whole state is the same."""

from collections.abc import Mapping

import pytest
from tests.blocks.compare.comparison import beside
from tests.drives.bench import Bench
from tests.drives.station import FAMILIES, built
from tests.drives.walk import walk
from tests.line.twins import DifferentError, TwinLibrary, Twins

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Library

SEED = 19
"""A walk with a drive of each family."""


_BUILT: dict[str, Library] = {}


def twins(engines: Mapping[str, Engine], every: int) -> TwinLibrary:
    """A station on each of them."""
    for name in engines.keys() - _BUILT.keys():
        _BUILT[name] = built(engines[name])
    return TwinLibrary([_BUILT[name] for name in engines], every)


def test_matiec_and_the_embedded_engine(matiec: Engine) -> None:
    walk(SEED, twins(beside(matiec), every=20), steps=2)


@pytest.mark.thorough
def test_a_difference_is_found() -> None:
    both = twins({"one": EmbeddedEngine(), "other": EmbeddedEngine()}, every=1)
    bench = Bench(*FAMILIES, stations=both)
    assert isinstance(bench.block, Twins)
    bench.block.instances[1]["Drive2.Diagnosis.FaultBack3"] = 7
    with pytest.raises(DifferentError, match="FAULTBACK3"):
        bench.run(20)
