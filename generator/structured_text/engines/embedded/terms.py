"""What the compiler knows about a half-compiled expression.

Integers and bit strings travel as *raw* Python integers: additions, products, masks and complements are not wrapped
at once, since the value modulo the operand's width stays right. Only where the exact value matters (a comparison, a
division, an index, a store) is it wrapped, checked, or, if its interval proves that it fits, left alone.
"""

import ast
from dataclasses import dataclass
from typing import Literal, NamedTuple

from structured_text.engines.embedded.certainty import known
from structured_text.language.types import Elementary, Kind, Type, greatest, least, plain


class CInteger(NamedTuple):
    """An integer type of C after its promotions (ISO C 6.3.1.1): 32 or 64 bits."""

    width: int
    signed: bool

    @property
    def low(self) -> int:
        return least(self.width, signed=self.signed)

    @property
    def high(self) -> int:
        return greatest(self.width, signed=self.signed)


C_INT = CInteger(32, True)
C_UNSIGNED = CInteger(32, False)
C_LONG = CInteger(64, True)
C_UNSIGNED_LONG = CInteger(64, False)
# What gcc and clang take for a decimal constant that no standard type holds.
C_INT128 = CInteger(128, True)


def promoted(each: Elementary) -> CInteger:
    """What C computes in for an operand of an ST type: everything narrower than int becomes int."""
    return CInteger(each.width, each.signed) if each.width >= 32 else C_INT


def common(left: CInteger, right: CInteger) -> CInteger:
    """C's usual arithmetic conversions (ISO C 6.3.1.8)."""
    if left.width != right.width:
        return left if left.width > right.width else right
    return left if not left.signed else right


def literal_type(value: int, based: bool) -> CInteger:
    """The type of an integer constant without suffix (ISO C 6.4.4.1); only hexadecimal ones may be unsigned."""
    for each in (C_INT, C_UNSIGNED, C_LONG, C_UNSIGNED_LONG):
        if value <= each.high and (based or each.signed):
            return each
    return C_INT128


@dataclass(slots=True)
class Whole:
    """A raw integer in `low..high` that belongs to the ST type `type` and to the C type `c`.

    Once wrapped to `type.width` bits it is the standard's value, once wrapped to `c` it is C's.
    """

    node: ast.expr
    low: int
    high: int
    type: Elementary
    c: CInteger

    def within(self, low: int, high: int) -> bool:
        """Whether every value that it can have is in a range."""
        return low <= self.low and self.high <= high


Precision = Literal["single", "double"]


@dataclass(slots=True)
class Floating:
    """A REAL or LREAL, as a double before rounding.

    `node` is the standard's value, `other` C's where that is built differently (an untyped literal is a double in C,
    and so is every operation on it). `pending`: the standard still has to round `node` to single precision. `c` is
    the precision in which C has the value; a single one with `c_pending` still has to be rounded.
    """

    node: ast.expr
    type: Elementary
    c: Precision
    pending: bool = False
    other: ast.expr | None = None
    c_pending: bool = False


@dataclass(slots=True)
class Plain:
    """Anything that has one value on every compiler: BOOL, STRING, TIME, an array, a structure, an instance."""

    node: ast.expr
    type: Type


Term = Whole | Floating | Plain

INTEGRAL = (Kind.BITS, Kind.INTEGER)


def elementary(each: Type) -> Elementary:
    """The elementary type of a type that is known to be one (a subrange counts as its base)."""
    return known(plain(each), Elementary)


def is_integral(each: Type) -> bool:
    """Whether a type is an integer or a bit string, BOOL apart."""
    return each.kind in INTEGRAL
