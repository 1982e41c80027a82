"""Random expressions: where the embedded engine gives a value, matiec gives the same."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from tests.structured_text.engines.compare.draws import Draws
from tests.structured_text.engines.compare.expressions.batch import (
    Batch,
    Mismatch,
    evaluate,
    make_batch,
    mismatches,
    where_all_agree,
)
from tests.structured_text.engines.compare.expressions.grammar import TYPES, Grammar
from tests.structured_text.engines.compare.expressions.productions import PRODUCTIONS
from tests.structured_text.engines.compare.expressions.shrink import shrink
from tests.structured_text.engines.compare.expressions.terms import Term, atom, binary, call, unary
from tests.structured_text.engines.compare.witness import not_noticed

from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.engine import Engine, Source

VECTORS = 4


@pytest.mark.parametrize("seed", [1, 2])
def test_matiec_gives_what_the_embedded_engine_gives(seed: int, matiec: Engine) -> None:
    """The long form, with a million, is `python -m tests.structured_text.engines.compare.long expressions`."""
    embedded = EmbeddedEngine()
    batch, expected = where_all_agree(embedded, make_batch(seed, 700, VECTORS, not_noticed()))
    found = mismatches(batch, (embedded.name, matiec.name), expected, evaluate(matiec, batch))
    assert not found, "\n".join(str(shrink(each, embedded, matiec)) for each in found[:5])
    assert len(batch.terms) > 200


def test_where_the_embedded_engine_stops_nothing_is_compared() -> None:
    """A sum that leaves its type stays out for all inputs, one that stays in its type is in."""
    terms = tuple(binary("BOOL", "comparison", (each, ">", _byte(5))) for each in (_complement(), _byte(7)))
    batch, values = where_all_agree(EmbeddedEngine(), Batch(terms, make_batch("stop", 1, 2).vectors))
    assert [each.text for each in batch.terms] == ["BYTE#16#07 > BYTE#16#05"]
    assert values == [[True], [True]]


def test_every_production_comes_up() -> None:
    """Nothing of the grammar is out of reach."""
    batch = make_batch("coverage", 2000, 0)
    seen = {part.rule for term in batch.terms for part in term.walk()}
    assert seen >= {each.rule for each in PRODUCTIONS} - {"leaf"}
    assert {term.type for term in batch.terms} == set(TYPES)


def test_a_production_can_be_left_out() -> None:
    """What a listed difference names is never made."""
    without = {"shift", "comparison", "leaf"}
    batch = make_batch("without", 500, 0, sorted(without))
    assert not {part.rule for term in batch.terms for part in term.walk()} & without


def test_the_same_seed_makes_the_same_expressions() -> None:
    """A failure can be looked at again, on any machine."""
    left, right = (make_batch(7, 50, 2) for _ in range(2))
    assert left.text == right.text
    assert repr(left.vectors) == repr(right.vectors)
    assert make_batch(8, 50, 2).text != left.text


def test_parentheses_stand_where_the_tree_needs_them() -> None:
    """By the precedence of table 55; operators of one level bind to the left."""
    a, b, c = (atom("INT", "variable", name) for name in "abc")
    product = binary("INT", "x", (binary("INT", "x", (a, "+", b)), "*", c))
    assert product.text == "(a + b) * c"
    assert binary("INT", "x", (a, "-", binary("INT", "x", (b, "-", c)))).text == "a - (b - c)"
    assert binary("INT", "x", (binary("INT", "x", (a, "-", b)), "-", c)).text == "a - b - c"
    assert unary("INT", "x", "-", unary("INT", "x", "-", a)).text == "-(-a)"
    assert call("INT", "x", "MAX", a, product).text == "MAX(a, (a + b) * c)"


class Mistaken(EmbeddedEngine):
    """Takes one number for another."""

    def build(self, sources: Sequence[Source]) -> EmbeddedLibrary:
        """Build with the mistake. Raises BuildError."""
        return super().build([replace(each, text=each.text.replace("BYTE#16#5A", "BYTE#16#5B")) for each in sources])


def test_a_failing_expression_is_made_small() -> None:
    """The report names the smallest expression that still differs."""
    left, right = EmbeddedEngine(), Mistaken()
    culprit = binary("BOOL", "comparison", (Grammar(Draws("shrink"), PRODUCTIONS).variable("BYTE"), "=", _byte(90)))
    term = call("BOOL", "select", "SEL", atom("BOOL", "variable", "vBOOL0"), culprit, culprit)
    inputs = {**make_batch("shrink", 1, 1).vectors[0], "vBYTE0": 90, "vBYTE1": 90, "vBYTE2": 90}
    batch = Batch((term,), (inputs,))
    (found,) = mismatches(batch, ("left", "right"), evaluate(left, batch), evaluate(right, batch))
    small = shrink(found, left, right)
    assert len(small.term.text) <= len("vBYTE0 = BYTE#16#5A")
    assert isinstance(small, Mismatch)
    assert "BYTE#16#5A" in str(small)


def _complement() -> Term:
    return unary("BYTE", "not", "NOT", atom("BYTE", "variable", "vBYTE0"))


def _byte(number: int) -> Term:
    return atom("BYTE", "literal", f"BYTE#16#{number:02X}")
