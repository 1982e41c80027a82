"""Expressions of Structured Text that templates make from facts: tests of bits, long lists, factors as a REAL."""

from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple, TypeVar

from driveblocks.maps.form import Span
from driveblocks.meaning.pattern import Is
from structured_text.language.writing import word

T = TypeVar("T")

TERMS = 50
"""Terms of one statement, and branches of one IF: compilers take some hundreds, and each nests what follows."""

_REAL_BITS = 24
"""Bits of a number that a REAL holds (IEC 60559, binary32)."""


class Test(NamedTuple):
    """What the bits of a mask in a word are compared with, in their place; without a mask the whole word."""

    pin: str
    mask: int
    value: int
    is_: Is = "="
    signed: bool = False


def holds(test: Test) -> str:
    """An expression that is TRUE when a word passes its test."""
    counted = f"({test.pin} AND {word(test.mask)})" if test.mask else test.pin
    if test.is_ in ("=", "<>"):
        return f"{counted} {test.is_} {word(test.value)}"
    number = test.value - 0x10000 if test.signed and test.value >> 15 else test.value
    kind = "INT" if test.signed else "UINT"
    return f"WORD_TO_{kind}({counted if not test.mask else counted[1:-1]}) {test.is_} {number}"


def within(span: Span, pin: str) -> str:
    """An expression that is TRUE when a UINT lies in a span."""
    if len(span) == 1:
        return f"{pin} = {span.first}"
    if span.first == 0:
        return f"{pin} <= {span.last}"
    return f"({pin} >= {span.first}) AND ({pin} <= {span.last})"


def label(span: Span) -> str:
    """The label of a branch for the numbers of a span; none begins at 0, where C calls a comparison always true."""
    if span.first == 0 and len(span) > 1:
        return f"0, {label(Span(1, span.last))}"
    return str(span.first) if len(span) == 1 else f"{span.first}..{span.last}"


def more(number: int) -> str:
    """What adds a number to the expression before it."""
    return f" {'+' if number > 0 else '-'} {abs(number)}" if number else ""


def statements(items: Sequence[T]) -> list[Sequence[T]]:
    """The items, as many at once as one statement may have."""
    return [items[at : at + TERMS] for at in range(0, len(items), TERMS)]


def each(words: Iterable[int], form: str) -> list[str]:
    """One term for each word, in which %s is its literal."""
    return [form % word(value) for value in words]


def none_of(words: Sequence[int], pin: str, known: str) -> str:
    """An expression that is TRUE when a pin has none of the words; `known` says it where they are too many for one."""
    return f"NOT {known}" if len(words) > TERMS else " AND ".join(each(words, f"({pin} <> %s)"))


def times(factor: Decimal) -> str:
    """What turns a count into engineering units; FACTOR is the factor as a constant of type REAL.

    `/ 100.0` for 0.01, `* 2.5` for 2.5, `* 3.0 / 1000.0` for 0.003: numbers that a REAL holds, so that a C compiler,
    for which a literal is a double, gets the same. What no literals give exactly is the constant.
    """
    ratio = Fraction(factor)
    if is_real(ratio):
        return f"* {real(ratio)}"
    if ratio.numerator == 1:
        return f"/ {ratio.denominator}.0"
    if 0xFFFF * ratio.numerator < 1 << _REAL_BITS:
        return f"* {ratio.numerator}.0 / {ratio.denominator}.0"
    return "* FACTOR"


def is_real(number: Fraction) -> bool:
    """Whether a REAL holds a number exactly: 24 bits, and no exponent that a scale could have is too large."""
    lowest = number.numerator & -number.numerator
    whole = number.denominator & (number.denominator - 1) == 0
    return whole and (number.numerator // max(lowest, 1)).bit_length() <= _REAL_BITS


def real(value: Decimal | Fraction) -> str:
    """A REAL literal."""
    ratio = Fraction(value)
    text = f"{(Decimal(ratio.numerator) / ratio.denominator).normalize():f}"
    return text if "." in text else f"{text}.0"
