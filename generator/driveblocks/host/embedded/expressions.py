"""Expressions of ST as Python expressions."""

from __future__ import annotations

import ast
from collections.abc import Callable

from driveblocks.host.embedded import times
from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.floats import Floats
from driveblocks.host.embedded.ranges import Interval, declared
from driveblocks.host.embedded.scope import Scope, UnsupportedError
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.syntax import is_quiet
from driveblocks.host.embedded.terms import (
    TEMPORAL,
    CInteger,
    Floating,
    Plain,
    Term,
    Whole,
    common,
    elementary,
    is_integral,
    literal_type,
    promoted,
)
from driveblocks.host.embedded.widths import Widths
from driveblocks.st import tree
from driveblocks.st.tree import LiteralKind
from driveblocks.st.types import LREAL, Array, Elementary, EnumValue, Kind, String, Type, plain

_ORDER: dict[str, type[ast.cmpop]] = {
    "=": ast.Eq,
    "<>": ast.NotEq,
    "<": ast.Lt,
    ">": ast.Gt,
    "<=": ast.LtE,
    ">=": ast.GtE,
}
_RING: dict[str, type[ast.operator]] = {"+": ast.Add, "-": ast.Sub, "*": ast.Mult}
_BITS: dict[str, type[ast.operator]] = {"AND": ast.BitAnd, "OR": ast.BitOr, "XOR": ast.BitXor}
_FLOAT: dict[str, type[ast.operator]] = {**_RING, "/": ast.Div}
# Beyond this many bits a raw integer is wrapped before it is multiplied on.
_LONGEST = 160


class Expressions:
    """Compiles expressions; calls of functions are left to a subclass."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        self.scope = scope
        self.pen = scope.pen
        self.widths = Widths(scope.model, scope.pen, scope.fresh)
        self.floats = Floats(scope.model, scope.pen)
        self._terms: dict[type[tree.Expression], Callable[..., Term]] = {
            tree.Literal: self._literal,
            tree.Name: self._name,
            tree.Qualified: self._enumerated,
            tree.Member: self._member,
            tree.Index: self._index,
            tree.Unary: self._unary,
            tree.Binary: self._binary,
            tree.Call: self.call,
        }

    # ------------------------------------------------------------ what others ask for

    def term(self, expression: tree.Expression) -> Term:
        """An expression with all that is known about it. UnsupportedError."""
        compile_it = self._terms.get(type(expression))
        if compile_it is None:
            raise UnsupportedError(expression.at, "the embedded engine does not run this construct")
        self.pen.move(expression.at)
        return compile_it(expression)

    def call(self, call: tree.Call) -> Term:
        """A call of a function."""
        raise NotImplementedError

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
        here = self.pen.here
        exact = self.exact(expression)
        self.pen.here = here
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

    # ------------------------------------------------------------ operators

    def _unary(self, unary: tree.Unary) -> Term:
        term = self.term(unary.operand)
        self.pen.move(unary.at)
        if unary.op == "+":
            return term
        if unary.op == "NOT":
            return self.inverse(term)
        if isinstance(term, Floating):
            return self.floats.negated(term)
        if isinstance(term, Whole):
            if isinstance(term.node, ast.Constant) and isinstance(term.node.value, int):
                node: ast.expr = self.pen.constant(-term.node.value)
            else:
                node = self.pen.unary(ast.USub(), term.node)
            return Whole(node, -term.high, -term.low, term.type, term.c)
        return Plain(self.pen.call("time_subtract", self.pen.constant(self._no_time()), term.node), term.type)

    def _no_time(self) -> int | tuple[int, int]:
        return (0, 0) if self.scope.model == "c" else 0

    def inverse(self, term: Term) -> Term:
        """NOT: of bit strings the complement, which C takes in its promoted type."""
        if isinstance(term, Whole):
            return Whole(self.pen.unary(ast.Invert(), term.node), ~term.high, ~term.low, term.type, term.c)
        return Plain(self.pen.unary(ast.Not(), term.node), term.type)

    def _binary(self, binary: tree.Binary) -> Term:
        left, right = self.term(binary.left), self.term(binary.right)
        self.pen.move(binary.at)
        if binary.op in _ORDER:
            return Plain(self.comparison(left, binary.op, right), binary.type)
        return self.operation(left, binary.op, right, binary.type)

    def operation(self, left: Term, operator: str, right: Term, kind: Type) -> Term:
        """Two terms joined by an operator other than a comparison."""
        if kind.kind in TEMPORAL or left.type.kind in TEMPORAL:
            return Plain(self.span(left, operator, right), kind)
        if operator == "**":
            return self.power(left, right, elementary(kind))
        if isinstance(left, Floating) or isinstance(right, Floating):
            left, right = self._floating(left, kind), self._floating(right, kind)
            return self.floats.binary(left, _FLOAT[operator](), right, elementary(kind))
        if isinstance(left, Whole) and isinstance(right, Whole):
            return self._whole_operation(left, operator, right, elementary(kind))
        return Plain(self._logic(left.node, operator, right.node), kind)

    def _floating(self, term: Term, kind: Type) -> Floating:
        return known(term if isinstance(term, Floating) else self.fitted(term, kind), Floating)

    def _logic(self, left: ast.expr, operator: str, right: ast.expr) -> ast.expr:
        """BOOL: both sides are evaluated, except in C; Python's short circuit is taken where nobody can tell."""
        if operator == "XOR":
            return self.pen.compare(left, (ast.NotEq(), right))
        if self.scope.model == "c" or is_quiet(right):
            return self.pen.junction(ast.And() if operator == "AND" else ast.Or(), left, right)
        return self.pen.binary(left, _BITS[operator](), right)

    def comparison(self, left: Term, operator: str, right: Term) -> ast.expr:
        """The truth of a comparison."""
        order = _ORDER[operator]()
        if isinstance(left, Floating) or isinstance(right, Floating):
            kind = left.type if isinstance(left, Floating) else right.type
            return self.floats.compare(self._floating(left, kind), order, self._floating(right, kind))
        if isinstance(left, Whole) and isinstance(right, Whole):
            c = common(left.c, right.c)
            one, two = self.widths.converted(left, c), self.widths.converted(right, c)
            return self.pen.compare(one.node, (order, two.node))
        if left.type.kind in TEMPORAL:
            return self._moments(left, order, right)
        if left.type.kind is Kind.STRING and self.scope.model != "standard":
            return self._texts(left, order, right)
        return self.pen.compare(left.node, (order, right.node))

    def _moments(self, left: Term, order: ast.cmpop, right: Term) -> ast.expr:
        if self.scope.model != "c":
            return self.pen.compare(left.node, (order, right.node))
        return self.pen.compare(self.pen.call("time_order", left.node, right.node), (order, self.pen.constant(0)))

    def _texts(self, left: Term, order: ast.cmpop, right: Term) -> ast.expr:
        return self.pen.compare(self.pen.call("string_order", left.node, right.node), (order, self.pen.constant(0)))

    # ------------------------------------------------------------ integers

    def _whole_operation(self, left: Whole, operator: str, right: Whole, kind: Elementary) -> Whole:
        c = common(left.c, right.c)
        if operator in ("/", "MOD"):
            one, two = self.widths.converted(left, c), self.widths.converted(right, c)
            return self.quotient(one, two, kind, c) if operator == "/" else self.remainder(one, two, kind, c)
        if left.c != c and left.c.width < c.width:
            left = self.widths.exact(left)
        if right.c != c and right.c.width < c.width:
            right = self.widths.exact(right)
        if operator in _BITS:
            return self._bitwise(left, operator, right, kind, c)
        return self._ring(left, operator, right, kind, c)

    def _ring(self, left: Whole, operator: str, right: Whole, kind: Elementary, c: CInteger) -> Whole:
        if operator == "*":
            left, right = self._shortened(left), self._shortened(right)
            ends = [a * b for a in (left.low, left.high) for b in (right.low, right.high)]
        elif operator == "+":
            ends = [left.low + right.low, left.high + right.high]
        else:
            ends = [left.low - right.high, left.high - right.low]
        node = self.pen.binary(left.node, _RING[operator](), right.node)
        return Whole(node, min(ends), max(ends), kind, c)

    def _shortened(self, raw: Whole) -> Whole:
        long = max(raw.low.bit_length(), raw.high.bit_length()) > _LONGEST
        return self.widths.wrapped(raw, CInteger(64, False)) if long else raw

    def _bitwise(self, left: Whole, operator: str, right: Whole, kind: Elementary, c: CInteger) -> Whole:
        for mask, other in ((left, right), (right, left)):
            if operator == "AND" and self._is_cover(mask, other):
                return Whole(other.node, other.low, other.high, kind, c)
        node = self.pen.binary(left.node, _BITS[operator](), right.node)
        bits = max(each.bit_length() for each in (left.low, left.high, right.low, right.high))
        low, high = (0 if left.low >= 0 and right.low >= 0 else -(1 << bits)), (1 << bits) - 1
        if operator == "AND":
            tops = [each.high for each in (left, right) if each.low >= 0]
            low, high = (0, min(tops)) if tops else (low, high)
        return Whole(node, low, high, kind, c)

    def _is_cover(self, mask: Whole, other: Whole) -> bool:
        """Whether a mask changes nothing: 16#00FF on what is 0..255 anyway."""
        return mask.low == mask.high and mask.low & (mask.low + 1) == 0 and other.within(0, mask.low)

    def quotient(self, left: Whole, right: Whole, kind: Elementary, c: CInteger) -> Whole:
        """Integer division towards zero; ZeroDivisionError at run time."""
        most = max(abs(left.low), abs(left.high))
        if left.low >= 0 and right.low >= 0:
            node: ast.expr = self.pen.binary(left.node, ast.FloorDiv(), right.node)
            return Whole(node, 0, left.high // max(right.low, 1), kind, c)
        if self.scope.model == "c":
            node = self.pen.call("c_divide", left.node, right.node, self.pen.constant(c.low))
        else:
            node = self.pen.call("divide", left.node, right.node)
        return Whole(node, -most, most, kind, c)

    def remainder(self, left: Whole, right: Whole, kind: Elementary, c: CInteger) -> Whole:
        """MOD; for a divisor of zero 0, but ZeroDivisionError in the model that fails."""
        most = min(max(abs(left.low), abs(left.high)), max(abs(right.low), abs(right.high), 1) - 1)
        low = 0 if left.low >= 0 else -most
        strict = self.scope.model == "fail" or right.low > 0 or right.high < 0
        if left.low >= 0 and right.low >= 0 and strict:
            return Whole(self.pen.binary(left.node, ast.Mod(), right.node), low, most, kind, c)
        if self.scope.model == "c":
            node = self.pen.call("c_remainder", left.node, right.node, self.pen.constant(c.low))
        else:
            node = self.pen.call("remainder" if strict else "remainder_or_zero", left.node, right.node)
        return Whole(node, low, most, kind, c)

    # ------------------------------------------------------------ powers and times

    def power(self, left: Term, right: Term, kind: Elementary) -> Floating:
        """`x ** y`: by pow of doubles, whose result C keeps as a double until a store."""
        base, exponent = self.number(left), self.number(right)
        node = self.pen.call("power", base, exponent)
        return Floating(node, kind, "double", pending=kind is not LREAL)

    def number(self, term: Term) -> ast.expr:
        """A numeric term as the argument of a function that takes a double."""
        if isinstance(term, Floating):
            return self.floats.double(term)
        term = known(term, Whole)
        return self.widths.exact(term).node

    def span(self, left: Term, operator: str, right: Term) -> ast.expr:
        """Arithmetic with durations and dates."""
        if isinstance(left, Whole | Floating):
            left, right = right, left
        other = right.node if isinstance(right, Plain) else self.number(right)
        names = {"+": "time_add", "-": "time_subtract", "*": "time_multiply", "/": "time_divide"}
        return self.pen.call(names[operator], left.node, other)


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
