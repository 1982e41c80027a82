"""Each operator on what another has made, of every integer type at its edges: the standard's result, or a fault."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from itertools import product

import pytest
from tests.structured_text.engines.embedded.snippets import FAULT
from tests.structured_text.engines.embedded.test_conversions import INTEGERS, cut

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Instance, ScanError, Source, Value

Operation = Callable[[int, int], int]


def quotient(left: int, right: int) -> int:
    """Towards zero; by zero there is none, and every engine that gives one is wrong."""
    return abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)


NUMBERS: dict[str, Operation] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": quotient,
    "MOD": lambda left, right: left - right * quotient(left, right),
}
BITS: dict[str, Operation] = {"AND": operator.and_, "OR": operator.or_, "XOR": operator.xor}
ORDER: dict[str, Operation] = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "=": operator.eq, "<>": operator.ne,
}  # fmt: skip


def expressions(kind: str) -> Iterator[tuple[str, str, str]]:
    """Inner operator, outer operator, and the type of what comes out."""
    own = BITS if kind in ("BYTE", "WORD", "DWORD", "LWORD") else NUMBERS
    yield from ((inner, outer, kind) for inner, outer in product(own, own))
    yield from ((inner, outer, "BOOL") for inner, outer in product(own, ORDER))


def source(kind: str) -> Source:
    """A block for each expression."""
    blocks = (
        f"FUNCTION_BLOCK E{number}\nVAR_INPUT\n  A, B, C : {kind};\nEND_VAR\nVAR_OUTPUT\n  Answer : {made};\nEND_VAR\n"
        f"  Answer := (A {inner} B) {outer} C;\nEND_FUNCTION_BLOCK\n"
        for number, (inner, outer, made) in enumerate(expressions(kind))
    )
    return Source("operators.st", "".join(blocks))


def scanned(instance: Instance, values: tuple[int, ...]) -> Value:
    """What the expression is, or FAULT."""
    instance["A"], instance["B"], instance["C"] = values
    try:
        instance.scan(0)
    except ScanError:
        return FAULT
    return instance["Answer"]


@pytest.mark.parametrize("kind", INTEGERS)
@pytest.mark.thorough
def test_where_the_embedded_engine_gives_a_value_it_is_that_of_the_standard(kind: str, engine: Engine) -> None:
    """Each result is wrapped in its type before the next operation; matiec gives the same wherever there is one."""
    embedded = EmbeddedEngine().build([source(kind)])
    library = engine.build([source(kind)])
    bits, signed = INTEGERS[kind]
    edges = sorted({cut(each, kind) for each in (0, 1, 7, (1 << bits) - 1, 1 << (bits - 1), (1 << bits - signed) - 2)})
    operations, given = {**NUMBERS, **BITS, **ORDER}, 0
    for number, (inner, outer, _) in enumerate(expressions(kind)):
        judge, other = embedded.instance(f"E{number}"), library.instance(f"E{number}")
        for values in product(edges, repeat=3):
            if scanned(judge, values) == FAULT:
                continue
            first = cut(operations[inner](*values[:2]), kind)
            wanted = operations[outer](first, values[2])
            given += 1
            assert scanned(other, values) == (wanted if outer in ORDER else cut(wanted, kind)), (inner, outer, values)
    assert given > 3000
