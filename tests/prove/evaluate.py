"""Terms as Python: what they are for given values. None means a value that the terms leave free."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import z3

Values = Mapping[str, Any]


def signed(value: int, width: int) -> int:
    return value - (1 << width) if value >> (width - 1) else value


def _divided(left: int, right: int, width: int) -> int:
    return (1 << width) - 1 if right == 0 else left // right


def _cut(left: int, right: int) -> int:
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def _ite(condition: Any, then: Any, otherwise: Any) -> Any:
    if condition is None:
        return then if then == otherwise else None
    return then if condition else otherwise


def _and(*terms: Any) -> Any:
    return False if False in terms else None if None in terms else True


def _or(*terms: Any) -> Any:
    return True if True in terms else None if None in terms else False


OPERATIONS: dict[int, Callable[..., Any]] = {
    z3.Z3_OP_NOT: lambda _, a: not a,
    z3.Z3_OP_XOR: lambda _, a, b: a != b,
    z3.Z3_OP_IMPLIES: lambda _, a, b: not a or b,
    z3.Z3_OP_EQ: lambda _, a, b: a == b,
    z3.Z3_OP_DISTINCT: lambda _, a, b: a != b,
    z3.Z3_OP_BADD: lambda n, *each: sum(each) % (1 << n.size()),
    z3.Z3_OP_BSUB: lambda n, a, b: (a - b) % (1 << n.size()),
    z3.Z3_OP_BMUL: lambda n, a, b: a * b % (1 << n.size()),
    z3.Z3_OP_BNEG: lambda n, a: -a % (1 << n.size()),
    z3.Z3_OP_BUDIV: lambda n, a, b: _divided(a, b, n.size()),
    z3.Z3_OP_BUREM: lambda _, a, b: a % b if b else a,
    z3.Z3_OP_BSDIV: lambda n, a, b: _cut(signed(a, n.size()), signed(b, n.size())) % (1 << n.size()),
    z3.Z3_OP_BAND: lambda _, a, b: a & b,
    z3.Z3_OP_BOR: lambda _, a, b: a | b,
    z3.Z3_OP_BXOR: lambda _, a, b: a ^ b,
    z3.Z3_OP_BNOT: lambda n, a: ~a % (1 << n.size()),
    z3.Z3_OP_BSHL: lambda n, a, b: (a << b) % (1 << n.size()) if b < n.size() else 0,
    z3.Z3_OP_BLSHR: lambda n, a, b: a >> b if b < n.size() else 0,
    z3.Z3_OP_ZERO_EXT: lambda _, a: a,
    z3.Z3_OP_SIGN_EXT: lambda n, a: signed(a, n.arg(0).size()) % (1 << n.size()),
    z3.Z3_OP_EXTRACT: lambda n, a: a >> n.params()[1] & ((1 << n.size()) - 1),
    z3.Z3_OP_CONCAT: lambda n, a, b: a << n.arg(1).size() | b,
    z3.Z3_OP_ULEQ: lambda _, a, b: a <= b,
    z3.Z3_OP_ULT: lambda _, a, b: a < b,
    z3.Z3_OP_UGEQ: lambda _, a, b: a >= b,
    z3.Z3_OP_UGT: lambda _, a, b: a > b,
    z3.Z3_OP_SLEQ: lambda n, a, b: signed(a, n.arg(0).size()) <= signed(b, n.arg(0).size()),
    z3.Z3_OP_SLT: lambda n, a, b: signed(a, n.arg(0).size()) < signed(b, n.arg(0).size()),
    z3.Z3_OP_SGEQ: lambda n, a, b: signed(a, n.arg(0).size()) >= signed(b, n.arg(0).size()),
    z3.Z3_OP_SGT: lambda n, a, b: signed(a, n.arg(0).size()) > signed(b, n.arg(0).size()),
    z3.Z3_OP_FPA_EQ: lambda _, a, b: a == b,
    z3.Z3_OP_FPA_LT: lambda _, a, b: a < b,
    z3.Z3_OP_FPA_GT: lambda _, a, b: a > b,
    z3.Z3_OP_FPA_LE: lambda _, a, b: a <= b,
    z3.Z3_OP_FPA_GE: lambda _, a, b: a >= b,
    z3.Z3_OP_FPA_NEG: lambda _, a: -a,
}
"""What each operation of the solver does: its node, and its operands."""
_JUNCTIONS = {z3.Z3_OP_AND: _and, z3.Z3_OP_OR: _or, z3.Z3_OP_ITE: _ite}


class Program:
    """Terms in an order in which each comes after those that it is made of."""

    def __init__(self, terms: Iterable[z3.ExprRef]) -> None:
        """Sort them."""
        self.nodes: dict[int, z3.ExprRef] = {}
        for term in terms:
            self._add(term)
        steps = [self._step(node) for node in self.nodes.values()]
        self.steps = [each for each in steps if each is not None]

    def _add(self, term: z3.ExprRef) -> None:
        stack = [(term, False)]
        while stack:
            here, ready = stack.pop()
            if ready:
                self.nodes[here.get_id()] = here
            elif here.get_id() not in self.nodes:
                stack.append((here, True))
                stack += [(each, False) for each in here.children()]

    def _step(self, node: z3.ExprRef) -> tuple[int, Callable[[dict[int, Any], Values], Any]]:
        kind, number = node.decl().kind(), node.get_id()
        operands = [each.get_id() for each in node.children()]
        if kind in _JUNCTIONS:
            joined = _JUNCTIONS[kind]
            return number, lambda known, _: joined(*(known[each] for each in operands))
        if not operands:
            return number, self._leaf(node, kind)
        operation = OPERATIONS[kind]

        def step(known: dict[int, Any], _: Values) -> Any:
            given = [known[each] for each in operands]
            return None if None in given else operation(node, *given)

        return number, step

    @staticmethod
    def _leaf(node: z3.ExprRef, kind: int) -> Callable[[dict[int, Any], Values], Any]:
        if kind == z3.Z3_OP_UNINTERPRETED:
            name = node.decl().name()
            return lambda _, values: values.get(name)
        constant: Any = z3.is_true(node)
        if z3.is_bv_value(node):
            constant = node.as_long()
        elif z3.is_fp(node):
            constant = float(str(z3.simplify(z3.fpToReal(node)).as_fraction().limit_denominator(10**45).__float__()))
        return lambda *_: constant

    def run(self, values: Values) -> dict[int, Any]:
        """What every term is, by its id."""
        known: dict[int, Any] = {}
        for number, step in self.steps:
            known[number] = step(known, values)
        return known
