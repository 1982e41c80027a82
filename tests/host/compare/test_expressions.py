"""Random expressions: matiec gives what C's model says, and the default model lets nothing pass that could differ."""

from dataclasses import replace

import pytest
from tests.host.compare.draws import Draws
from tests.host.compare.expressions.batch import (
    ALONE,
    Batch,
    Mismatch,
    evaluate,
    evaluate_alone,
    make_batch,
    mismatches,
    without_traps,
)
from tests.host.compare.expressions.grammar import TYPES, Grammar
from tests.host.compare.expressions.productions import PRODUCTIONS
from tests.host.compare.expressions.shrink import shrink
from tests.host.compare.expressions.terms import Term, atom, binary, call, unary
from tests.host.compare.lockstep import alike
from tests.host.compare.models import double
from tests.host.compare.witness import not_followed, not_noticed

from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.host.engine import Engine

VECTORS = 4


@pytest.mark.parametrize("seed", [1, 2])
def test_matiec_gives_what_the_model_of_c_gives(seed: int, matiec: Engine) -> None:
    """The long form, with a million, is `python -m tests.host.compare.long expressions`."""
    embedded = double(matiec)
    batch = make_batch(seed, 500, VECTORS, not_followed(matiec.name.partition("-")[2]))
    batch, expected = without_traps(embedded, batch)
    found = mismatches(batch, (embedded.name, matiec.name), expected, evaluate(matiec, batch))
    assert not found, "\n".join(str(shrink(each, embedded, matiec)) for each in found[:5])
    assert len(batch.terms) > 490


def test_what_the_default_model_lets_pass_is_the_same_in_both_models() -> None:
    """`fail` gives a value only where the standard and C give that same value."""
    batch = replace(make_batch("models", 150, VECTORS, not_noticed()), per_block=ALONE)
    values = [evaluate_alone(EmbeddedEngine(model=model), batch) for model in ("fail", "standard", "c")]
    passed = 0
    for number, vector in enumerate(batch.vectors):
        for term, fail, *others in zip(batch.terms, *(each[number] for each in values), strict=True):
            if fail is not None:
                passed += 1
                told = f"{term.text}: {fail!r}, {others!r} with {vector}"
                assert all(other is not None and alike(fail, other) for other in others), told
    assert passed > 200


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


def test_a_failing_expression_is_made_small() -> None:
    """The report names the smallest expression that still differs."""
    left, right = EmbeddedEngine(model="standard"), EmbeddedEngine(model="c")
    grammar = Grammar(Draws("shrink"), PRODUCTIONS)
    culprit = binary("BOOL", "comparison", (unary("BYTE", "not", "NOT", grammar.variable("BYTE")), "=", _byte(90)))
    term = call("BOOL", "select", "SEL", grammar.expression("BOOL", 2), culprit, culprit)
    inputs = {**make_batch("shrink", 1, 1).vectors[0], "vBYTE0": 165, "vBYTE1": 165, "vBYTE2": 165}
    batch = Batch((term,), (inputs,))
    (found,) = mismatches(batch, ("left", "right"), evaluate(left, batch), evaluate(right, batch))
    small = shrink(found, left, right)
    assert len(small.term.text) <= len("NOT vBYTE0 = BYTE#16#5A")
    assert isinstance(small, Mismatch)
    assert "vBYTE" in str(small)


def _byte(number: int) -> Term:
    return atom("BYTE", "literal", f"BYTE#16#{number:02X}")
