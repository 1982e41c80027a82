"""REAL and LREAL expressions: rounded after every operation by the standard and by PLCs, only at stores by C.

A REAL literal without prefix is a double in C, and so is every operation on it until a store. Where the two readings
are built differently, both are computed and compared, if that is asked for.
"""

import ast

from structured_text.engines.embedded.reals import single
from structured_text.engines.embedded.syntax import Pen
from structured_text.engines.embedded.terms import Floating, Precision
from structured_text.language.types import REAL, Elementary


class Floats:
    """Joins REAL and LREAL terms and brings them to values."""

    def __init__(self, pen: Pen, strict: bool) -> None:
        """Write with `pen`; `strict`: compare with what C computes."""
        self.pen = pen
        self.strict = strict

    def literal(self, value: float, kind: Elementary, typed: bool) -> Floating:
        """A literal; `typed` if it has a prefix, which makes it a single in C too."""
        if kind is not REAL:
            return Floating(self.pen.constant(value), kind, "double")
        near = single(value)
        other = None if typed or near == value or not self.strict else self.pen.constant(value)
        return Floating(self.pen.constant(near), kind, "single" if typed else "double", other=other)

    def binary(self, left: Floating, operator: ast.operator, right: Floating, kind: Elementary) -> Floating:
        """Join two operands by + - * or /."""
        c: Precision = "double" if "double" in (left.c, right.c) else "single"
        node = self.pen.binary(self._standard(left), operator, self._standard(right))
        term = Floating(node, kind, c, pending=kind is REAL, c_pending=c == "single")
        if self._differs(left) or self._differs(right):
            term.other = self.pen.binary(self._c(left), operator, self._c(right))
        return term

    def negated(self, term: Floating) -> Floating:
        """Change the sign, which never rounds."""
        pen = self.pen
        other = None if term.other is None else pen.unary(ast.USub(), term.other)
        node = pen.unary(ast.USub(), term.node)
        return Floating(node, term.type, term.c, term.pending, other, term.c_pending)

    def stored(self, term: Floating) -> Floating:
        """The value as a variable or parameter of its type takes it."""
        if term.type is not REAL:
            return term
        if term.other is None:
            return Floating(self._standard(term), REAL, "single")
        both = self.pen.call("agree", self._standard(term), self._c_stored(term))
        return Floating(both, REAL, "single")

    def double(self, term: Floating) -> ast.expr:
        """The value as an operand that is wanted as a double: not rounded first where C has a double already."""
        if not self._differs(term):
            return self._standard(term)
        return self.pen.call("agree", self._standard(term), self._c(term))

    def compare(self, left: Floating, operator: ast.cmpop, right: Floating) -> ast.expr:
        pen = self.pen
        standard = pen.compare(self._standard(left), (operator, self._standard(right)))
        if not (self._differs(left) or self._differs(right)):
            return standard
        c = pen.compare(self._c(left), (operator, self._c(right)))
        return pen.call("agree_truth", standard, c)

    def _differs(self, term: Floating) -> bool:
        """Whether the standard and C use different numbers from here on, where that matters."""
        return self.strict and (term.other is not None or (term.pending and term.c == "double"))

    def _standard(self, term: Floating) -> ast.expr:
        return self.pen.call("single", term.node) if term.pending else term.node

    def _c(self, term: Floating) -> ast.expr:
        node = term.node if term.other is None else term.other
        return self.pen.call("single", node) if term.c_pending else node

    def _c_stored(self, term: Floating) -> ast.expr:
        if term.c == "single":
            return self._c(term)
        node = term.node if term.other is None else term.other
        exact = isinstance(node, ast.Constant) and isinstance(node.value, float) and single(node.value) == node.value
        return node if exact else self.pen.call("single", node)
