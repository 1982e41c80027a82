"""Random expressions: where the embedded engine gives a value, matiec gives the same."""

import pytest
from tests.structured_text.engines.compare.expressions.batch import (
    Batch,
    evaluate,
    make_batch,
    mismatches,
    where_all_agree,
)
from tests.structured_text.engines.compare.expressions.terms import Term, atom, binary, unary
from tests.structured_text.engines.compare.witness import not_noticed

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine

VECTORS = 4


@pytest.mark.parametrize("seed", [1, 2])
def test_matiec_gives_what_the_embedded_engine_gives(seed: int, matiec: Engine) -> None:
    """The long form, with a million, is `python -m tests.structured_text.engines.compare.long expressions`."""
    embedded = EmbeddedEngine()
    batch, expected = where_all_agree(embedded, make_batch(seed, 700, VECTORS, not_noticed()))
    found = mismatches(batch, (embedded.name, matiec.name), expected, evaluate(matiec, batch))
    assert not found, "\n".join(str(each) for each in found[:5])
    assert len(batch.terms) > 200


def test_where_the_embedded_engine_stops_nothing_is_compared() -> None:
    """A sum that leaves its type stays out for all inputs, one that stays in its type is in."""
    terms = tuple(binary("BOOL", "comparison", (each, ">", _byte(5))) for each in (_complement(), _byte(7)))
    batch, values = where_all_agree(EmbeddedEngine(), Batch(terms, make_batch("stop", 1, 2).vectors))
    assert [each.text for each in batch.terms] == ["BYTE#16#07 > BYTE#16#05"]
    assert values == [[True], [True]]


def _complement() -> Term:
    return unary("BYTE", "not", "NOT", atom("BYTE", "variable", "vBYTE0"))


def _byte(number: int) -> Term:
    return atom("BYTE", "literal", f"BYTE#16#{number:02X}")
