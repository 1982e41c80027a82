"""Terms as Python: what they are for given values. None means a value that the terms leave free."""

import math
import struct
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import z3

from driveblocks.prove.operations import FREE

Values = Mapping[str, Any]
Part = Callable[[list[Any], Values], None]
LENGTH = 1000
"""Statements of one Python function; the compiler is slow with long ones."""


def signed(value: int, width: int) -> int:
    return value - (1 << width) if value >> (width - 1) else value


def divided(left: int, right: int, width: int) -> int:
    return (1 << width) - 1 if right == 0 else left // right


def cut(left: int, right: int) -> int:
    quotient = abs(left) // abs(right)
    return quotient if (left < 0) == (right < 0) else -quotient


def single(value: float) -> float:
    """As a REAL has it; a sum, product or quotient of two REALs is rounded right by rounding twice."""
    try:
        found: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return found


def quotient(left: float, right: float) -> float:
    if right == 0.0:
        return (
            math.nan if left == 0.0 or math.isnan(left) else math.copysign(math.inf, left) * math.copysign(1.0, right)
        )
    return single(left / right)


def whole(cuts: bool, value: float, low: int, high: int) -> int | None:
    """A REAL cut, or rounded to the nearest; None where the standard leaves the result open."""
    if not math.isfinite(value):
        return None
    found = math.trunc(value) if cuts else round(value)
    return found & ((high << 1 | 1) if low else high) if low <= found <= high else None


def chosen(condition: Any, then: Any, otherwise: Any) -> Any:
    if condition is None:
        return then if then == otherwise else None
    return then if condition else otherwise


def every(*terms: Any) -> Any:
    return False if False in terms else None if None in terms else True


def either(*terms: Any) -> Any:
    return True if True in terms else None if None in terms else False


def _mask(node: z3.ExprRef) -> str:
    return str((1 << node.size()) - 1)


def _compared(op: str) -> Callable[..., str]:
    return lambda _, a, b: f"{a} {op} {b}"


def _signed(op: str) -> Callable[..., str]:
    return lambda n, a, b: f"signed({a}, {n.arg(0).size()}) {op} signed({b}, {n.arg(0).size()})"


OPERATIONS: dict[int, Callable[..., str]] = {
    z3.Z3_OP_NOT: lambda _, a: f"not {a}",
    z3.Z3_OP_XOR: _compared("!="),
    z3.Z3_OP_IMPLIES: lambda _, a, b: f"not {a} or {b}",
    z3.Z3_OP_EQ: _compared("=="),
    z3.Z3_OP_DISTINCT: _compared("!="),
    z3.Z3_OP_BADD: lambda n, *each: f"({' + '.join(each)}) & {_mask(n)}",
    z3.Z3_OP_BSUB: lambda n, a, b: f"({a} - {b}) & {_mask(n)}",
    z3.Z3_OP_BMUL: lambda n, *each: f"({' * '.join(each)}) & {_mask(n)}",
    z3.Z3_OP_BNEG: lambda n, a: f"-{a} & {_mask(n)}",
    z3.Z3_OP_BUDIV: lambda n, a, b: f"divided({a}, {b}, {n.size()})",
    z3.Z3_OP_BUREM: lambda _, a, b: f"{a} % {b} if {b} else {a}",
    z3.Z3_OP_BSDIV: lambda n, a, b: f"cut(signed({a}, {n.size()}), signed({b}, {n.size()})) & {_mask(n)}",
    z3.Z3_OP_BAND: lambda _, *each: " & ".join(each),
    z3.Z3_OP_BOR: lambda _, *each: " | ".join(each),
    z3.Z3_OP_BXOR: lambda _, *each: " ^ ".join(each),
    z3.Z3_OP_BNOT: lambda n, a: f"~{a} & {_mask(n)}",
    z3.Z3_OP_BSHL: lambda n, a, b: f"({a} << {b}) & {_mask(n)} if {b} < {n.size()} else 0",
    z3.Z3_OP_BLSHR: lambda n, a, b: f"{a} >> {b} if {b} < {n.size()} else 0",
    z3.Z3_OP_ZERO_EXT: lambda _, a: a,
    z3.Z3_OP_SIGN_EXT: lambda n, a: f"signed({a}, {n.arg(0).size()}) & {_mask(n)}",
    z3.Z3_OP_EXTRACT: lambda n, a: f"{a} >> {n.params()[1]} & {_mask(n)}",
    z3.Z3_OP_CONCAT: lambda n, a, b: f"{a} << {n.arg(1).size()} | {b}",
    z3.Z3_OP_ULEQ: _compared("<="),
    z3.Z3_OP_ULT: _compared("<"),
    z3.Z3_OP_UGEQ: _compared(">="),
    z3.Z3_OP_UGT: _compared(">"),
    z3.Z3_OP_SLEQ: _signed("<="),
    z3.Z3_OP_SLT: _signed("<"),
    z3.Z3_OP_SGEQ: _signed(">="),
    z3.Z3_OP_SGT: _signed(">"),
    z3.Z3_OP_FPA_EQ: _compared("=="),
    z3.Z3_OP_FPA_LT: _compared("<"),
    z3.Z3_OP_FPA_GT: _compared(">"),
    z3.Z3_OP_FPA_LE: _compared("<="),
    z3.Z3_OP_FPA_GE: _compared(">="),
    z3.Z3_OP_FPA_ABS: lambda _, a: f"abs({a})",
    z3.Z3_OP_FPA_NEG: lambda _, a: f"-{a}",
    z3.Z3_OP_FPA_IS_NAN: lambda _, a: f"{a} != {a}",
    z3.Z3_OP_FPA_ADD: lambda _, _rounding, a, b: f"single({a} + {b})",
    z3.Z3_OP_FPA_SUB: lambda _, _rounding, a, b: f"single({a} - {b})",
    z3.Z3_OP_FPA_MUL: lambda _, _rounding, a, b: f"single({a} * {b})",
    z3.Z3_OP_FPA_DIV: lambda _, _rounding, a, b: f"quotient({a}, {b})",
    z3.Z3_OP_FPA_TO_FP: lambda n, _rounding, a: f"single(signed({a}, {n.arg(1).size()}))",
    z3.Z3_OP_FPA_TO_FP_UNSIGNED: lambda _, _rounding, a: f"single({a})",
    z3.Z3_OP_FPA_TO_UBV: lambda n, rounding, a: f"whole({rounding}, {a}, 0, {_mask(n)})",
    z3.Z3_OP_FPA_TO_SBV: lambda n, rounding, a: (
        f"whole({rounding}, {a}, {-1 << (n.size() - 1)}, {(1 << (n.size() - 1)) - 1})"
    ),
    z3.Z3_OP_AND: lambda _, *each: " and ".join(each),
    z3.Z3_OP_OR: lambda _, *each: " or ".join(each),
    z3.Z3_OP_ITE: lambda _, a, b, c: f"{b} if {a} else {c}",
}
"""What each operation of the solver is in Python: of its node and its operands."""
ROUNDS, CUTS = z3.Z3_OP_FPA_RM_NEAREST_TIES_TO_EVEN, z3.Z3_OP_FPA_RM_TOWARD_ZERO
WHOLE = (z3.Z3_OP_FPA_TO_UBV, z3.Z3_OP_FPA_TO_SBV)
OPEN = {z3.Z3_OP_AND: "every", z3.Z3_OP_OR: "either", z3.Z3_OP_ITE: "chosen"}
"""What is called where an operand may be free, and the result need not be."""


class Program:
    """Terms in an order in which each comes after those that it is made of, compiled."""

    def __init__(self, terms: Iterable[z3.ExprRef]) -> None:
        """Sort and compile them."""
        self.places: dict[int, int] = {}
        self.start: list[Any] = []
        self._free: set[int] = set()
        self._nodes: list[z3.ExprRef] = []
        statements: list[str] = []
        for term in terms:
            statements += [each for node in self._new(term) if (each := self._statement(node))]
        self.parts = [_part(statements[begin : begin + LENGTH]) for begin in range(0, len(statements), LENGTH)]

    def _new(self, term: z3.ExprRef) -> Iterable[z3.ExprRef]:
        """The parts of a term that have no place yet, each after its own parts."""
        stack = [(term, False)]
        while stack:
            here, ready = stack.pop()
            if here.get_id() in self.places:
                continue
            if ready:
                self.places[here.get_id()] = len(self.start)
                self.start.append(None)
                self._nodes.append(here)  # or its number would be given to another one
                yield here
            else:
                stack.append((here, True))
                stack += [(each, False) for each in here.children()]

    def _statement(self, node: z3.ExprRef) -> str:
        kind, place = node.decl().kind(), self.places[node.get_id()]
        operands = [self.places[each.get_id()] for each in node.children()]
        if not operands:
            return self._leaf(node, kind, place)
        names = [f"k[{each}]" for each in operands]
        open_ones = [name for name, each in zip(names, operands, strict=True) if each in self._free]
        if open_ones or kind in WHOLE:
            self._free.add(place)
        if open_ones and kind in OPEN:
            return f"k[{place}] = {OPEN[kind]}({', '.join(names)})"
        made = OPERATIONS[kind](node, *names)
        if open_ones:
            made = f"None if {' or '.join(f'{name} is None' for name in open_ones)} else ({made})"
        return f"k[{place}] = {made}"

    def _leaf(self, node: z3.ExprRef, kind: int, place: int) -> str:
        """A constant has its value from the start, and what is free none."""
        if kind == z3.Z3_OP_UNINTERPRETED and not node.decl().name().startswith(FREE):
            return f"k[{place}] = values[{node.decl().name()!r}]"
        if kind == z3.Z3_OP_UNINTERPRETED:
            self._free.add(place)
        elif kind in (ROUNDS, CUTS):
            self.start[place] = kind == CUTS
        elif z3.is_bv_value(node):
            self.start[place] = node.as_long()
        elif z3.is_fp(node):
            bits = z3.simplify(z3.fpToIEEEBV(node))
            self.start[place] = struct.unpack("<f", struct.pack("<I", bits.as_long()))[0]
        else:
            self.start[place] = z3.is_true(node)
        return ""

    def run(self, values: Values) -> list[Any]:
        """What every term is, by its place."""
        known = self.start.copy()
        for part in self.parts:
            part(known, values)
        return known


def _part(statements: list[str]) -> Part:
    """A function of some statements."""
    body = "\n".join(f"  {each}" for each in statements)
    made: dict[str, Any] = {}
    exec(f"def part(k, values):\n{body}\n", globals(), made)  # noqa: S102 - the statements are made above
    found: Part = made["part"]
    return found
