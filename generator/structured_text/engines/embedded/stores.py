"""Stores and copies of values."""

import ast

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.parts import term_of
from structured_text.engines.embedded.scope import Scope
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.language import tree
from structured_text.language.tree import Array
from structured_text.language.types import Type, plain


def stored_in(scope: Scope, target: tree.Expression, value: ast.expr) -> ast.expr:
    """An expression that stores a value of the target's type."""
    pen = scope.pen
    place = term_of(scope, target).node
    forget(scope, target)
    if isinstance(place, ast.Name):
        return pen.keep(place.id, value)
    if not is_scalar(target.type):
        return copy_term(scope, target.type, place, value)
    if isinstance(place, ast.Attribute):
        return pen.call("setattr", place.value, pen.constant(place.attr), value)
    place = known(place, ast.Subscript)
    return pen.method(place.value, "__setitem__", place.slice, value)


def forget(scope: Scope, target: tree.Expression) -> None:
    """Give up what was known about a variable that something has written."""
    if isinstance(target, tree.Name) and isinstance(target.symbol, tree.VarDecl):
        scope.ranges.forget([target.symbol])


def copy_term(scope: Scope, kind: Type, into: ast.expr, source: ast.expr) -> ast.expr:
    """An expression that copies an array or structure into another one."""
    return scope.pen.call(scope.object("copy", scope.shapes.copier(plain(kind))), into, source)


def copy_statement(scope: Scope, kind: Type, into: ast.expr, source: ast.expr) -> ast.stmt:
    """A statement that assigns a value: scalars as such, arrays and structures by copying into the target."""
    pen = scope.pen
    kind = plain(kind)
    if is_scalar(kind):
        return pen.assign(into, source)
    if isinstance(kind, Array) and len(kind.bounds) == 1 and is_scalar(kind.element):
        return pen.assign(pen.slice(into), source)
    return pen.statement(copy_term(scope, kind, into, source))
