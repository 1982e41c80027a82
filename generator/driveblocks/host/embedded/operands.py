"""Literals, variables, fields and elements of ST as Python expressions."""

from __future__ import annotations

import ast
from collections.abc import Callable

from driveblocks.host.embedded import times
from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.floats import Floats
from driveblocks.host.embedded.ranges import Interval, declared
from driveblocks.host.embedded.scope import Scope, UnsupportedError
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.terms import (
    Floating,
    Plain,
    Term,
    Whole,
    elementary,
    is_integral,
    literal_type,
    promoted,
)
from driveblocks.host.embedded.widths import Widths
from driveblocks.st import tree
from driveblocks.st.tree import Array, EnumValue, LiteralKind
from driveblocks.st.types import LREAL, TEMPORAL, Elementary, Kind, String, Type, plain


class Operands:
    """Compiles literals, variables, fields and elements; operators and calls are left to subclasses."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        self.scope = scope
        self.pen = scope.pen
        self.widths = Widths(scope.model, scope.pen, scope.fresh)
        self.floats = Floats(scope.model, scope.pen)
        self.terms: dict[type[tree.Expression], Callable[..., Term]] = {
            tree.Literal: self._literal,
            tree.Name: self._name,
            tree.Qualified: self._enumerated,
            tree.Member: self._member,
            tree.Index: self._index,
        }

    # ------------------------------------------------------------ what others ask for

    def term(self, expression: tree.Expression) -> Term:
        """An expression with all that is known about it. UnsupportedError."""
        compile_it = self.terms.get(type(expression))
        if compile_it is None:
            raise UnsupportedError(expression.at, "the embedded engine does not run this construct")
        self.pen.move(expression.at)
        return compile_it(expression)

    def whole(self, expression: tree.Expression) -> Whole:
        """An integer or bit string, raw."""
        return known(self.term(expression), Whole)

    def exact(self, expression: tree.Expression) -> Whole:
        """An integer or bit string whose exact value is needed."""
        return self.widths.exact(self.whole(expression))

    def truth(self, expression: tree.Expression) -> ast.expr:
        """A BOOL."""
        return self.term(expression).node

    def stored(self, expression: tree.Expression, target: Type) -> Term:
        """The value of an expression as a variable or parameter of type `target` takes it."""
        return self.fitted(self.term(expression), target)

    def fitted(self, term: Term, target: Type) -> Term:
        """A term cut or rounded to what a variable of type `target` takes."""
        if isinstance(term, Whole):
            if plain(target).kind is Kind.REAL:
                return Floating(self.pen.call("float", term.node), elementary(target), "single")
            return self.widths.stored(term, target)
        if isinstance(term, Floating):
            return self.floats.stored(term)
        if isinstance(target, String) and not self._short(term, target):
            return Plain(self.pen.slice(term.node, self.pen.constant(target.length)), target)
        return term

    def interval(self, expression: tree.Expression) -> Interval:
        """Between which values an integer expression is, once it is exact."""
        if isinstance(expression, tree.Name) and isinstance(expression.symbol, tree.VarDecl):
            whole = self._variable_interval(expression.symbol)
            if whole is not None:
                return whole
        mark = self.pen.mark()
        exact = self.exact(expression)
        self.pen.back(mark)
        return exact.low, exact.high

    # ------------------------------------------------------------ operands

    def _short(self, term: Plain, target: String) -> bool:
        """Whether a string surely fits."""
        if isinstance(term.node, ast.Constant) and isinstance(term.node.value, bytes):
            return len(term.node.value) <= target.length
        return isinstance(term.type, String) and term.type.length <= target.length

    def _literal(self, literal: tree.Literal) -> Term:
        kind = literal.type
        if plain(kind).kind is Kind.REAL:
            typed = literal.prefix is not None or literal.kind is LiteralKind.INTEGER
            return self.floats.literal(float(literal.value), elementary(kind), typed)
        if is_integral(kind):
            value = int(literal.value)
            untyped = literal_type(abs(value), literal.base != 10)
            c = untyped if literal.prefix is None else promoted(elementary(kind))
            return Whole(self.pen.constant(value), value, value, elementary(kind), c)
        if kind.kind in TEMPORAL:
            return Plain(self._moment(literal), kind)
        if isinstance(literal.value, str):
            raise UnsupportedError(literal.at, "the embedded engine has no WSTRING")
        if kind.kind is Kind.BOOL:
            return Plain(self.pen.constant(bool(literal.value)), kind)
        return Plain(self.pen.constant(literal.value), kind)

    def _moment(self, literal: tree.Literal) -> ast.expr:
        """A duration or date; in C's model the pair that a C compiler makes of it."""
        value = int(literal.value)
        if self.scope.model != "c":
            return self.pen.constant(value)
        return self.pen.constant(tuple(c_moment(literal, value)))

    def _name(self, name: tree.Name) -> Term:
        symbol = name.symbol
        if isinstance(symbol, EnumValue):
            return self._enumerated(name)
        if symbol is None:
            raise UnsupportedError(name.at, f"{name.name} names nothing that has a value")
        if symbol.constant and symbol.initial is not None and is_scalar(symbol.type):
            return self._constant(symbol)
        interval = self._variable_interval(symbol)
        return self._read(self.scope.variable(symbol), symbol.type, interval)

    def _variable_interval(self, symbol: tree.VarDecl) -> Interval | None:
        if not is_integral(symbol.type):
            return None
        if symbol.constant and symbol.initial is not None:
            value = self.scope.shapes.scalar(symbol.type, symbol.initial)
            return value, value
        return self.scope.ranges.of(symbol)

    def _constant(self, symbol: tree.VarDecl) -> Term:
        """A VAR CONSTANT: its value, but with the type in C of a variable."""
        value = self.scope.shapes.scalar(symbol.type, symbol.initial)
        interval = (value, value) if is_integral(symbol.type) else None
        return self._read(self.pen.constant(value), symbol.type, interval)

    def _read(self, node: ast.expr, kind: Type, interval: Interval | None = None) -> Term:
        """What a variable, field or element of a type gives."""
        if is_integral(kind):
            kind = known(kind, Elementary)
            low, high = interval or (kind.low, kind.high)
            return Whole(node, low, high, elementary(kind), promoted(elementary(kind)))
        if kind.kind is Kind.REAL:
            return Floating(node, elementary(kind), "double" if kind is LREAL else "single")
        return Plain(node, kind)

    def result(self, node: ast.expr, kind: Type, low: int | None = None, high: int | None = None) -> Term:
        """What a function of a type returns, with tighter bounds where they are known."""
        if low is None or high is None:
            return self._read(node, kind)
        return self._read(node, kind, (low, high))

    def _enumerated(self, name: tree.Name | tree.Qualified | tree.Member) -> Term:
        return Plain(self.pen.constant(known(name.symbol, EnumValue).number), name.type)

    def _member(self, member: tree.Member) -> Term:
        if isinstance(member.symbol, EnumValue):
            return self._enumerated(member)
        base = self.term(member.base).node
        self.pen.move(member.at)
        kind = member.type
        interval = None
        if isinstance(member.symbol, tree.VarDecl) and is_integral(kind):
            interval = declared(member.symbol, self.scope.model != "c")
        return self._read(self.pen.attribute(base, member.name.upper()), kind, interval)

    def _index(self, index: tree.Index) -> Term:
        node = self.term(index.base).node
        kind = plain(index.base.type)
        kind = known(kind, Array)
        for each, (low, high) in zip(index.indices, kind.bounds, strict=True):
            name = written(index.base)
            offset = self._offset(each, name, low, high)
            self.pen.move(each.at)
            self.scope.note_access(name, low, high, offset)
            node = self.pen.item(node, offset)
        self.pen.move(index.at)
        return self._read(node, index.type)

    def _offset(self, index: tree.Expression, array: str, low: int, high: int) -> ast.expr:
        """The Python offset of an index: never negative, so that Python's own check finds what is out of range."""
        exact = self.exact(index)
        self.pen.move(index.at)
        node = exact.node
        if low:
            if isinstance(node, ast.Constant) and isinstance(node.value, int) and node.value >= low:
                return self.pen.constant(node.value - low)
            node = self.pen.binary(node, ast.Sub(), self.pen.constant(low))
        if exact.low >= low:
            return node
        name = self.scope.fresh()
        test = self.pen.compare(self.pen.keep(name, node), (ast.GtE(), self.pen.constant(0)))
        facts = (self.pen.constant(array), self.pen.constant(low), self.pen.constant(high))
        return self.pen.choice(test, self.pen.name(name), self.pen.call("below_bounds", self.pen.name(name), *facts))


def c_moment(literal: tree.Literal, value: int) -> times.Span:
    """The pair that matiec's C has for a literal of a duration or date."""
    if literal.kind is LiteralKind.TIME:
        return times.c_literal(literal.text, value)
    if literal.kind is LiteralKind.TIME_OF_DAY:
        return times.c_time_of_day_literal(value)
    return times.c_moment_literal(value)


def written(expression: tree.Expression) -> str:
    """A variable as its user wrote it, for messages."""
    if isinstance(expression, tree.Name):
        return expression.name
    if isinstance(expression, tree.Member):
        return f"{written(expression.base)}.{expression.name}"
    if isinstance(expression, tree.Index):
        return f"{written(expression.base)}[...]"
    return "the array"
