"""Operators of ST as Python expressions."""

import ast

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.parts import fitted, term_of
from structured_text.engines.embedded.scope import Scope
from structured_text.engines.embedded.syntax import is_quiet
from structured_text.engines.embedded.terms import CInteger, Floating, Plain, Term, Whole, common, elementary
from structured_text.language import tree
from structured_text.language.types import LREAL, TEMPORAL, Elementary, Kind, Type

_ORDER: dict[str, type[ast.cmpop]] = {
    "=": ast.Eq, "<>": ast.NotEq, "<": ast.Lt, ">": ast.Gt, "<=": ast.LtE, ">=": ast.GtE,
}  # fmt: skip
_RING: dict[str, type[ast.operator]] = {"+": ast.Add, "-": ast.Sub, "*": ast.Mult}
_BITS: dict[str, type[ast.operator]] = {"AND": ast.BitAnd, "OR": ast.BitOr, "XOR": ast.BitXor}
_FLOAT: dict[str, type[ast.operator]] = {**_RING, "/": ast.Div}
# Beyond this many bits a raw integer is wrapped before it is multiplied on.
_LONGEST = 160


def unary(scope: Scope, value: tree.Unary) -> Term:
    """`-x`, `+x`, `NOT x`."""
    pen = scope.pen
    term = term_of(scope, value.operand)
    pen.move(value.at)
    if value.op == "+":
        return term
    if value.op == "NOT":
        return inverse(scope, term)
    if isinstance(term, Floating):
        return scope.floats.negated(term)
    if isinstance(term, Whole):
        if isinstance(term.node, ast.Constant) and isinstance(term.node.value, int):
            node: ast.expr = pen.constant(-term.node.value)
        else:
            node = pen.unary(ast.USub(), term.node)
        return Whole(node, -term.high, -term.low, term.type, term.c)
    return Plain(pen.call("time_subtract", pen.constant(0), term.node), term.type)


def inverse(scope: Scope, term: Term) -> Term:
    """NOT: of bit strings the complement, which C takes in its promoted type."""
    if isinstance(term, Whole):
        return Whole(scope.pen.unary(ast.Invert(), term.node), ~term.high, ~term.low, term.type, term.c)
    return Plain(scope.pen.unary(ast.Not(), term.node), term.type)


def binary(scope: Scope, value: tree.Binary) -> Term:
    """Two operands and their operator."""
    left, right = term_of(scope, value.left), term_of(scope, value.right)
    scope.pen.move(value.at)
    if value.op in _ORDER:
        return Plain(comparison(scope, left, value.op, right), value.type)
    return operation(scope, left, value.op, right, value.type)


def operation(scope: Scope, left: Term, operator: str, right: Term, kind: Type) -> Term:
    """Two terms joined by an operator other than a comparison."""
    if kind.kind in TEMPORAL or left.type.kind in TEMPORAL:
        return Plain(span(scope, left, operator, right), kind)
    if operator == "**":
        return _power(scope, left, right, elementary(kind))
    if isinstance(left, Floating) or isinstance(right, Floating):
        left, right = _floating(scope, left, kind), _floating(scope, right, kind)
        return scope.floats.binary(left, _FLOAT[operator](), right, elementary(kind))
    if isinstance(left, Whole) and isinstance(right, Whole):
        return _whole_operation(scope, left, operator, right, elementary(kind))
    return Plain(_logic(scope, left.node, operator, right.node), kind)


def _floating(scope: Scope, term: Term, kind: Type) -> Floating:
    return known(term if isinstance(term, Floating) else fitted(scope, term, kind), Floating)


def _logic(scope: Scope, left: ast.expr, operator: str, right: ast.expr) -> ast.expr:
    """BOOL: both sides are evaluated; Python's short circuit is taken where it makes no difference."""
    pen = scope.pen
    if operator == "XOR":
        return pen.compare(left, (ast.NotEq(), right))
    if is_quiet(right):
        return pen.junction(ast.And() if operator == "AND" else ast.Or(), left, right)
    return pen.binary(left, _BITS[operator](), right)


def comparison(scope: Scope, left: Term, operator: str, right: Term) -> ast.expr:
    """The truth of a comparison."""
    order = _ORDER[operator]()
    if isinstance(left, Floating) or isinstance(right, Floating):
        kind = left.type if isinstance(left, Floating) else right.type
        return scope.floats.compare(_floating(scope, left, kind), order, _floating(scope, right, kind))
    if isinstance(left, Whole) and isinstance(right, Whole):
        one, two = scope.widths.exact(left), scope.widths.exact(right)
        return scope.pen.compare(one.node, (order, two.node))
    if left.type.kind is Kind.STRING:
        return _texts(scope, left, order, right)
    return scope.pen.compare(left.node, (order, right.node))


def _texts(scope: Scope, left: Term, order: ast.cmpop, right: Term) -> ast.expr:
    pen = scope.pen
    return pen.compare(pen.call("string_order", left.node, right.node), (order, pen.constant(0)))


def _whole_operation(scope: Scope, left: Whole, operator: str, right: Whole, kind: Elementary) -> Whole:
    c = common(left.c, right.c)
    if operator in ("/", "MOD"):
        one, two = scope.widths.exact(left), scope.widths.exact(right)
        return _quotient(scope, one, two, kind, c) if operator == "/" else _remainder(scope, one, two, kind, c)
    if left.c != c and left.c.width < c.width:
        left = scope.widths.exact(left)
    if right.c != c and right.c.width < c.width:
        right = scope.widths.exact(right)
    if operator in _BITS:
        return _bitwise(scope, left, operator, right, kind)
    return _ring(scope, left, operator, right, kind)


def _ring(scope: Scope, left: Whole, operator: str, right: Whole, kind: Elementary) -> Whole:
    c = common(left.c, right.c)
    if operator == "*":
        left, right = _shortened(scope, left), _shortened(scope, right)
        ends = [a * b for a in (left.low, left.high) for b in (right.low, right.high)]
    elif operator == "+":
        ends = [left.low + right.low, left.high + right.high]
    else:
        ends = [left.low - right.high, left.high - right.low]
    node = scope.pen.binary(left.node, _RING[operator](), right.node)
    return Whole(node, min(ends), max(ends), kind, c)


def _shortened(scope: Scope, raw: Whole) -> Whole:
    long = max(raw.low.bit_length(), raw.high.bit_length()) > _LONGEST
    return scope.widths.wrapped(raw, CInteger(64, False)) if long else raw


def _bitwise(scope: Scope, left: Whole, operator: str, right: Whole, kind: Elementary) -> Whole:
    c = common(left.c, right.c)
    for mask, other in ((left, right), (right, left)):
        if operator == "AND" and _is_cover(mask, other):
            return Whole(other.node, other.low, other.high, kind, c)
    node = scope.pen.binary(left.node, _BITS[operator](), right.node)
    bits = max(each.bit_length() for each in (left.low, left.high, right.low, right.high))
    low, high = (0 if left.low >= 0 and right.low >= 0 else -(1 << bits)), (1 << bits) - 1
    if operator == "AND":
        tops = [each.high for each in (left, right) if each.low >= 0]
        low, high = (0, min(tops)) if tops else (low, high)
    return Whole(node, low, high, kind, c)


def _is_cover(mask: Whole, other: Whole) -> bool:
    """Whether a mask changes nothing: 16#00FF on what is 0..255 anyway."""
    return mask.low == mask.high and mask.low & (mask.low + 1) == 0 and other.within(0, mask.low)


def _quotient(scope: Scope, left: Whole, right: Whole, kind: Elementary, c: CInteger) -> Whole:
    """Integer division towards zero; ZeroDivisionError at run time."""
    pen = scope.pen
    most = max(abs(left.low), abs(left.high))
    if left.low >= 0 and right.low >= 0:
        node = pen.binary(left.node, ast.FloorDiv(), right.node)
        return Whole(node, 0, left.high // max(right.low, 1), kind, c)
    return Whole(pen.call("divide", left.node, right.node), -most, most, kind, c)


def _remainder(scope: Scope, left: Whole, right: Whole, kind: Elementary, c: CInteger) -> Whole:
    """MOD; ZeroDivisionError at run time, although table 24 gives 0: compilers differ."""
    pen = scope.pen
    most = min(max(abs(left.low), abs(left.high)), max(abs(right.low), abs(right.high), 1) - 1)
    low = 0 if left.low >= 0 else -most
    if left.low >= 0 and right.low >= 0:
        return Whole(pen.binary(left.node, ast.Mod(), right.node), low, most, kind, c)
    return Whole(pen.call("remainder", left.node, right.node), low, most, kind, c)


def _power(scope: Scope, left: Term, right: Term, kind: Elementary) -> Floating:
    """`x ** y`: by pow of doubles, whose result C keeps as a double until a store."""
    base, exponent = number(scope, left), number(scope, right)
    node = scope.pen.call("power", base, exponent)
    return Floating(node, kind, "double", pending=kind is not LREAL)


def number(scope: Scope, term: Term) -> ast.expr:
    """A numeric term as the argument of a function that takes a double."""
    if isinstance(term, Floating):
        return scope.floats.double(term)
    term = known(term, Whole)
    return scope.widths.exact(term).node


def span(scope: Scope, left: Term, operator: str, right: Term) -> ast.expr:
    """Arithmetic with durations and dates."""
    if isinstance(left, Whole | Floating):
        left, right = right, left
    other = right.node if isinstance(right, Plain) else number(scope, right)
    names = {"+": "time_add", "-": "time_subtract", "*": "time_multiply", "/": "time_divide"}
    return scope.pen.call(names[operator], left.node, other)
