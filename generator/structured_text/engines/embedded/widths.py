"""Where the exact value of an integer matters: wrapped, checked or left alone, whatever exceeds its type fails."""

import ast
from collections.abc import Callable

from structured_text.engines.embedded.integers import c_name
from structured_text.engines.embedded.syntax import Pen
from structured_text.engines.embedded.terms import CInteger, Whole, elementary, promoted
from structured_text.language.types import Subrange, Type


class Widths:
    """Turns raw integers into exact ones."""

    def __init__(self, pen: Pen, fresh: Callable[[], str]) -> None:
        """`fresh` makes names of temporary variables."""
        self.pen = pen
        self.fresh = fresh

    def exact(self, raw: Whole) -> Whole:
        """The value for a use that depends on all of it: wrapped where the standard and C agree, else checked."""
        kind = CInteger(raw.type.width, raw.type.signed)
        if raw.c == kind and not kind.signed:
            return self.wrapped(raw, kind)
        return self._checked(raw, kind)

    def stored(self, raw: Whole, target: Type) -> Whole:
        """The value for a store into `target`, a parameter included: C cuts there, and so does the standard."""
        into = elementary(target)
        if into.width > raw.type.width:
            raw = self.exact(raw)
        if raw.c.signed and not raw.within(raw.c.low, raw.c.high):
            raw = self._defined(raw)
        kept = self.wrapped(raw, CInteger(into.width, into.signed))
        kept = Whole(kept.node, kept.low, kept.high, into, promoted(into))
        return self._in_range(kept, target) if isinstance(target, Subrange) else kept

    def wrapped(self, raw: Whole, kind: CInteger) -> Whole:
        """The value modulo a width, unless its interval already fits."""
        if raw.within(kind.low, kind.high):
            return raw
        pen = self.pen
        mask = pen.constant((1 << kind.width) - 1)
        if not kind.signed:
            node: ast.expr = pen.binary(raw.node, ast.BitAnd(), mask)
        else:
            half = pen.constant(1 << (kind.width - 1))
            moved = pen.binary(pen.binary(raw.node, ast.Add(), half), ast.BitAnd(), mask)
            node = pen.binary(moved, ast.Sub(), half)
        return Whole(node, kind.low, kind.high, raw.type, raw.c)

    def in_any_type(self, raw: Whole, bits: int) -> Whole:
        """Fail at run time if the value is negative or has more bits: the types that compilers choose then differ."""
        high = (1 << bits) - 1
        if raw.within(0, high):
            return raw
        return self._guarded(raw, 0, high, "leaves_open", (self.pen.constant(high),))

    def _checked(self, raw: Whole, kind: CInteger) -> Whole:
        """Fail at run time if the value has left its type."""
        if raw.within(kind.low, kind.high):
            return raw
        pen = self.pen
        facts = (pen.constant(raw.type.name), pen.constant(kind.width), pen.constant(kind.signed))
        return self._guarded(raw, kind.low, kind.high, "leaves_type", facts)

    def _defined(self, raw: Whole) -> Whole:
        """Fail at run time if the value has left the signed type in which C computes it."""
        return self._guarded(raw, raw.c.low, raw.c.high, "leaves_c", (self.pen.constant(c_name(raw.c)),))

    def _in_range(self, value: Whole, target: Subrange) -> Whole:
        """Fail at run time if the value is outside a subrange."""
        if value.within(target.first, target.last):
            return value
        facts = (self.pen.constant(target.first), self.pen.constant(target.last))
        return self._guarded(value, target.first, target.last, "leaves_range", facts)

    def _guarded(self, raw: Whole, low: int, high: int, complaint: str, facts: tuple[ast.expr, ...]) -> Whole:
        """Write `t if low <= (t := value) <= high else complaint(t, ...)`, testing only the sides that can fail."""
        pen, name = self.pen, self.fresh()
        kept: ast.expr = pen.keep(name, raw.node)
        if raw.low >= low:
            test = pen.compare(kept, (ast.LtE(), pen.constant(high)))
        elif raw.high <= high:
            test = pen.compare(kept, (ast.GtE(), pen.constant(low)))
        else:
            test = pen.compare(pen.constant(low), (ast.LtE(), kept), (ast.LtE(), pen.constant(high)))
        node = pen.choice(test, pen.name(name), pen.call(complaint, pen.name(name), *facts))
        return Whole(node, max(low, raw.low), min(high, raw.high), raw.type, raw.c)
