"""Literals, variables, fields and elements of ST as Python expressions."""

import ast

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.parts import exact_of, read_as, term_of, variable_interval
from structured_text.engines.embedded.ranges import declared
from structured_text.engines.embedded.scope import Scope, UnsupportedError
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.embedded.terms import Plain, Term, Whole, elementary, is_integral, literal_type, promoted
from structured_text.language import tree
from structured_text.language.tree import Array, EnumValue, LiteralKind
from structured_text.language.types import TEMPORAL, Kind, plain


def literal(scope: Scope, value: tree.Literal) -> Term:
    """A literal, with the type that C gives it."""
    pen = scope.pen
    kind = value.type
    if plain(kind).kind is Kind.REAL:
        typed = value.prefix is not None or value.kind is LiteralKind.INTEGER
        return scope.floats.literal(float(value.value), elementary(kind), typed)
    if is_integral(kind):
        number = int(value.value)
        untyped = literal_type(abs(number), value.base != 10)
        c = untyped if value.prefix is None else promoted(elementary(kind))
        return Whole(pen.constant(number), number, number, elementary(kind), c)
    if kind.kind in TEMPORAL:
        return Plain(pen.constant(int(value.value)), kind)
    if isinstance(value.value, str):
        raise UnsupportedError(value.at, "the embedded engine has no WSTRING")
    if kind.kind is Kind.BOOL:
        return Plain(pen.constant(bool(value.value)), kind)
    return Plain(pen.constant(value.value), kind)


def name(scope: Scope, value: tree.Name) -> Term:
    """A variable, a constant or an enumerated value."""
    symbol = value.symbol
    if isinstance(symbol, EnumValue):
        return enumerated(scope, value)
    if symbol is None:
        raise UnsupportedError(value.at, f"{value.name} names nothing that has a value")
    if symbol.constant and symbol.initial is not None and is_scalar(symbol.type):
        return _constant(scope, symbol)
    interval = variable_interval(scope, symbol)
    return read_as(scope.variable(symbol), symbol.type, interval)


def _constant(scope: Scope, symbol: tree.VarDecl) -> Term:
    """A VAR CONSTANT: its value, but with the type in C of a variable."""
    value = scope.shapes.scalar(symbol.type, symbol.initial)
    interval = (value, value) if is_integral(symbol.type) else None
    return read_as(scope.pen.constant(value), symbol.type, interval)


def enumerated(scope: Scope, value: tree.Name | tree.Qualified | tree.Member) -> Term:
    """The number of an enumerated value."""
    return Plain(scope.pen.constant(known(value.symbol, EnumValue).number), value.type)


def member(scope: Scope, value: tree.Member) -> Term:
    """A field, or a variable of an instance."""
    if isinstance(value.symbol, EnumValue):
        return enumerated(scope, value)
    base = term_of(scope, value.base).node
    scope.pen.move(value.at)
    kind = value.type
    interval = None
    if isinstance(value.symbol, tree.VarDecl) and is_integral(kind):
        interval = declared(value.symbol)
    return read_as(scope.pen.attribute(base, value.name.upper()), kind, interval)


def index(scope: Scope, value: tree.Index) -> Term:
    """An element of an array."""
    pen = scope.pen
    node = term_of(scope, value.base).node
    kind = known(plain(value.base.type), Array)
    for each, (low, high) in zip(value.indices, kind.bounds, strict=True):
        name = written(value.base)
        offset = _offset(scope, each, name, low, high)
        pen.move(each.at)
        scope.note_access(name, low, high, offset)
        node = pen.item(node, offset)
    pen.move(value.at)
    return read_as(node, value.type)


def _offset(scope: Scope, index: tree.Expression, array: str, low: int, high: int) -> ast.expr:
    """The Python offset of an index: never negative, so that Python's own check finds what is out of range."""
    pen = scope.pen
    exact = exact_of(scope, index)
    pen.move(index.at)
    node = exact.node
    if low:
        if isinstance(node, ast.Constant) and isinstance(node.value, int) and node.value >= low:
            return pen.constant(node.value - low)
        node = pen.binary(node, ast.Sub(), pen.constant(low))
    if exact.low >= low:
        return node
    name = scope.fresh()
    test = pen.compare(pen.keep(name, node), (ast.GtE(), pen.constant(0)))
    facts = (pen.constant(array), pen.constant(low), pen.constant(high))
    return pen.choice(test, pen.name(name), pen.call("below_bounds", pen.name(name), *facts))


def written(expression: tree.Expression) -> str:
    """A variable as its user wrote it, for messages."""
    if isinstance(expression, tree.Name):
        return expression.name
    if isinstance(expression, tree.Member):
        return f"{written(expression.base)}.{expression.name}"
    if isinstance(expression, tree.Index):
        return f"{written(expression.base)}[...]"
    return "the array"
