"""Make a failing expression as small as it can be, for a report that a person can read."""

from __future__ import annotations

from collections.abc import Iterator

from tests.structured_text.engines.compare.expressions.batch import (
    Batch,
    Inputs,
    Mismatch,
    Trap,
    evaluate,
    mismatches,
    where_all_agree,
)
from tests.structured_text.engines.compare.expressions.grammar import TYPES, variable
from tests.structured_text.engines.compare.expressions.terms import Term, atom

from structured_text.engines.engine import BuildError, Engine

ROUNDS = 12
CANDIDATES = 120


def shrink(mismatch: Mismatch, embedded: Engine, other: Engine) -> Mismatch:
    """The smallest expression, reached by local steps, on which the engines still differ with the same inputs."""
    for _ in range(ROUNDS):
        candidates = sorted(_smaller(mismatch.term), key=lambda term: len(term.text))[:CANDIDATES]
        found = _first_failing(candidates, mismatch.inputs, embedded, other)
        if found is None:
            break
        mismatch = found
    return mismatch


def _first_failing(terms: list[Term], inputs: Inputs, embedded: Engine, other: Engine) -> Mismatch | None:
    """The first (shortest) expression on which the engines differ; where matiec refuses one or stops at one, halve."""
    if not terms:
        return None
    try:
        batch, values = where_all_agree(embedded, Batch(tuple(terms), (inputs,)))
        found = mismatches(batch, (embedded.name, other.name), values, evaluate(other, batch))
    except (BuildError, Trap):
        if len(terms) == 1:
            return None
        half = len(terms) // 2
        return _first_failing(terms[:half], inputs, embedded, other) or _first_failing(
            terms[half:], inputs, embedded, other
        )
    return found[0] if found else None


def _smaller(term: Term) -> Iterator[Term]:
    """Shorter expressions: any part on its own, and the whole with one part exchanged for something simpler."""
    seen = {term.text}
    for part in term.walk():
        simpler = [child for child in part.walk() if child is not part and child.type == part.type]
        simpler += [atom(part.type, "variable", variable(part.type, 0))] if part.type in TYPES else []
        for candidate in [part, *(term.replaced(part, each) for each in simpler)]:
            if candidate.text not in seen and len(candidate.text) < len(term.text):
                seen.add(candidate.text)
                yield candidate
