"""The parts of a statement or expression, compiled: what the functions of the compiler ask of each other."""

import ast
from functools import partial

from structured_text.engines.coverage import Outcome
from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.ranges import Interval, Ranges
from structured_text.engines.embedded.scope import Scope, UnsupportedError
from structured_text.engines.embedded.terms import Floating, Plain, Term, Whole, elementary, is_integral, promoted
from structured_text.language import tree
from structured_text.language.types import LREAL, Elementary, Kind, String, Type, plain


def term_of(scope: Scope, expression: tree.Expression) -> Term:
    """An expression with all that is known about it. UnsupportedError.

    A number whose type nothing gives must be the same in all types that compilers choose.
    """
    compiled = scope.terms.get(type(expression))
    if compiled is None:
        raise UnsupportedError(expression.at, "the embedded engine does not run this construct")
    scope.pen.move(expression.at)
    made = compiled(scope, expression)
    if isinstance(expression, tree.Unary | tree.Binary | tree.Call) and expression.open and isinstance(made, Whole):
        scope.pen.move(expression.at)
        return scope.widths.in_any_type(made, expression.open)
    return made


def whole_of(scope: Scope, expression: tree.Expression) -> Whole:
    """An integer or bit string, raw."""
    return known(term_of(scope, expression), Whole)


def exact_of(scope: Scope, expression: tree.Expression) -> Whole:
    """An integer or bit string whose exact value is needed."""
    return scope.widths.exact(whole_of(scope, expression))


def truth_of(scope: Scope, expression: tree.Expression) -> ast.expr:
    """A BOOL."""
    return term_of(scope, expression).node


def stored(scope: Scope, expression: tree.Expression, target: Type) -> Term:
    """The value of an expression as a variable or parameter of type `target` takes it."""
    return fitted(scope, term_of(scope, expression), target)


def fitted(scope: Scope, term: Term, target: Type) -> Term:
    """A term cut or rounded to what a variable of type `target` takes."""
    pen = scope.pen
    if isinstance(term, Whole):
        if plain(target).kind is Kind.REAL:
            return Floating(pen.call("float", term.node), elementary(target), "single")
        return scope.widths.stored(term, target)
    if isinstance(term, Floating):
        return scope.floats.stored(term)
    if isinstance(target, String) and not _short(term, target):
        return Plain(pen.slice(term.node, pen.constant(target.length)), target)
    return term


def interval_of(scope: Scope, expression: tree.Expression) -> Interval:
    """Between which values an integer expression is, once it is exact."""
    if isinstance(expression, tree.Name) and isinstance(expression.symbol, tree.VarDecl):
        whole = variable_interval(scope, expression.symbol)
        if whole is not None:
            return whole
    mark = scope.pen.mark()
    exact = exact_of(scope, expression)
    scope.pen.back(mark)
    return exact.low, exact.high


def _short(term: Plain, target: String) -> bool:
    """Whether a string surely fits."""
    if isinstance(term.node, ast.Constant) and isinstance(term.node.value, bytes):
        return len(term.node.value) <= target.length
    return isinstance(term.type, String) and term.type.length <= target.length


def variable_interval(scope: Scope, symbol: tree.VarDecl) -> Interval | None:
    """Between which values an integer variable is; None for any other."""
    if not is_integral(symbol.type):
        return None
    if symbol.constant and symbol.initial is not None:
        value = scope.shapes.scalar(symbol.type, symbol.initial)
        return value, value
    return scope.ranges.of(symbol)


def read_as(node: ast.expr, kind: Type, interval: Interval | None = None) -> Term:
    """What a variable, field or element of a type gives."""
    if is_integral(kind):
        kind = known(kind, Elementary)
        low, high = interval or (kind.low, kind.high)
        return Whole(node, low, high, elementary(kind), promoted(elementary(kind)))
    if kind.kind is Kind.REAL:
        return Floating(node, elementary(kind), "double" if kind is LREAL else "single")
    return Plain(node, kind)


def result_of(node: ast.expr, kind: Type, low: int | None = None, high: int | None = None) -> Term:
    """What a function of a type returns, with tighter bounds where they are known."""
    if low is None or high is None:
        return read_as(node, kind)
    return read_as(node, kind, (low, high))


def counted(scope: Scope, at: int, text: str) -> list[ast.stmt]:
    """A statement that counts an outcome of the decision at `at`; nothing unless coverage is asked for."""
    if not scope.coverage:
        return []
    pen = scope.pen
    return [_count(scope, scope.counter("outcomes", Outcome(*pen.unit.place(at), text)))]


def assume(scope: Scope, condition: tree.Expression, truth: bool) -> None:
    """Know from now on that a condition is so."""
    scope.ranges.assume(condition, truth, partial(interval_of, scope))


def supposing(scope: Scope, condition: tree.Expression, truth: bool) -> Ranges:
    """What would be known if a condition were so."""
    now = scope.ranges.copy()
    assume(scope, condition, truth)
    then = scope.ranges.copy()
    scope.ranges.become(now)
    return then


def body_of(scope: Scope, statements: list[tree.Statement]) -> list[ast.stmt]:
    """A list of statements; each is at its ST line and, if asked for, counts itself. UnsupportedError."""
    written: list[ast.stmt] = []
    for each in statements:
        scope.pen.move(each.at)
        if scope.coverage and not isinstance(each, tree.Empty):
            written.append(_count(scope, scope.counter("hits", scope.pen.line)))
        written += scope.statements[type(each)](scope, each)
    return written or [scope.pen.nothing()]


def _count(scope: Scope, place: int) -> ast.stmt:
    pen = scope.pen
    return pen.increment(pen.item(pen.name("counts"), pen.constant(place)))
