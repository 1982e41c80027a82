"""Operators of ST as Python expressions."""

from __future__ import annotations

import ast

from driveblocks.host.embedded.certainty import known
from driveblocks.host.embedded.operands import Operands
from driveblocks.host.embedded.scope import Scope
from driveblocks.host.embedded.syntax import is_quiet
from driveblocks.host.embedded.terms import CInteger, Floating, Plain, Term, Whole, common, elementary
from driveblocks.st import tree
from driveblocks.st.types import LREAL, TEMPORAL, Elementary, Kind, Type

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


class Expressions(Operands):
    """Compiles operators; calls of functions are left to a subclass."""

    def __init__(self, scope: Scope) -> None:
        """Compile within a scope."""
        super().__init__(scope)
        self.terms |= {tree.Unary: self._unary, tree.Binary: self._binary, tree.Call: self.call}

    def term(self, expression: tree.Expression) -> Term:
        """As everywhere; a number whose type nothing tells must be the same in all types that compilers choose."""
        made = super().term(expression)
        if isinstance(expression, tree.Unary | tree.Binary | tree.Call) and expression.open and isinstance(made, Whole):
            self.pen.move(expression.at)
            return self.widths.in_any_type(made, expression.open)
        return made

    def call(self, call: tree.Call) -> Term:
        """A call of a function."""
        raise NotImplementedError

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
