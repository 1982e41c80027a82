"""TIME, DATE, TIME_OF_DAY and DATE_AND_TIME at run time, in two representations.

The standard's is one integer of nanoseconds (dates since 1970-01-01). matiec's is a pair (seconds, nanoseconds) whose
operations leave it unnormalised at times, so that equal durations compare unequal; C's model keeps the pair, and only
`nanoseconds` and `pair` cross over.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import NamedTuple

from driveblocks.host.embedded.faults import FaultError
from driveblocks.host.embedded.integers import wrap
from driveblocks.host.embedded.reals import c_cut

SECOND = 1_000_000_000
DAY = 86_400 * SECOND
# The significand of the 80-bit format in which C compilers for x86-64 fold `long double` constants.
_EXTENDED_BITS = 64


class Span(NamedTuple):
    """matiec's TIME and dates. Compiled ST writes plain pairs, so that everything here goes by position."""

    seconds: int
    nanoseconds: int


def nanoseconds(span: Span) -> int:
    """The duration as one integer."""
    return span[0] * SECOND + span[1]


def pair(duration: int) -> Span:
    """A duration as a normalised pair: both parts have the same sign."""
    whole = abs(duration)
    sign = 1 if duration >= 0 else -1
    return Span(sign * (whole // SECOND), sign * (whole % SECOND))


def normalised(seconds: int, rest: int) -> Span:
    """Carry or borrow one second, once, and not when the rest is exactly one second: as matiec does."""
    seconds, rest = _long(seconds), _long(rest)
    if rest < -SECOND or (seconds > 0 and rest < 0):
        seconds, rest = seconds - 1, rest + SECOND
    if rest > SECOND or (seconds < 0 and rest > 0):
        seconds, rest = seconds + 1, rest - SECOND
    return Span(_long(seconds), _long(rest))


def _long(number: int) -> int:
    """Wrap to C's long of 64 bits."""
    return number if -(1 << 63) <= number < 1 << 63 else wrap(number, 64, True)


# ------------------------------------------------------------ arithmetic on pairs


def c_add(left: Span, right: Span) -> Span:
    """Add as matiec does."""
    return normalised(left[0] + right[0], left[1] + right[1])


def c_subtract(left: Span, right: Span) -> Span:
    """Subtract as matiec does."""
    return normalised(left[0] - right[0], left[1] - right[1])


def c_order(left: Span, right: Span) -> int:
    """Negative, zero or positive, by seconds first, as matiec compares."""
    if left[0] == right[0]:
        return _long(left[1] - right[1])
    return _long(left[0] - right[0])


def c_least(first: Span, *others: Span) -> Span:
    """MIN as matiec has it, whose order overflows between the ends of the range."""
    for each in others:
        first = each if c_order(first, each) > 0 else first
    return first


def c_greatest(first: Span, *others: Span) -> Span:
    """MAX as matiec has it."""
    for each in others:
        first = each if c_order(first, each) < 0 else first
    return first


def c_limit(low: Span, value: Span, high: Span) -> Span:
    """LIMIT as matiec has it."""
    if c_order(value, low) <= 0:
        return low
    return value if c_order(value, high) < 0 else high


def c_multiply(left: Span, factor: float) -> Span:
    """Multiply as matiec does: in doubles, the nanoseconds through a 32-bit int."""
    factor = float(factor)
    seconds = left[0] * factor
    whole = c_cut(seconds, 64)
    rest = c_cut(left[1] * factor, 32)
    quotient = abs(rest) // SECOND * (1 if rest >= 0 else -1)
    total = float(rest - quotient * SECOND) + (seconds - whole) * SECOND
    return normalised(whole + quotient, c_cut(total, 64))


def c_divide(left: Span, divisor: float) -> Span:
    """Divide as matiec does: in doubles. By zero the processor's conversion of an infinity shows."""
    divisor = float(divisor)
    seconds = _quotient(left[0], divisor)
    whole = c_cut(seconds, 64)
    total = _quotient(left[1], divisor) + (seconds - whole) * SECOND
    return normalised(whole, c_cut(total, 64))


def c_from_number(number: float) -> Span:
    """A number of seconds as matiec converts it."""
    if isinstance(number, int):
        return Span(_long(int(number)), 0)  # a BOOL becomes a number of seconds
    whole = c_cut(number, 64)
    return Span(whole, c_cut((number - whole) * SECOND, 64))


def _quotient(number: int, divisor: float) -> float:
    if divisor == 0.0:
        return math.nan if number == 0 else math.copysign(math.inf, number) * math.copysign(1.0, divisor)
    return number / divisor


# ------------------------------------------------------------ arithmetic on nanoseconds


def multiply(left: int, factor: float) -> int:
    """MUL of the standard, to the nearest nanosecond. FaultError for NaN and infinity."""
    return left * factor if isinstance(factor, int) else round(left * _fraction(factor))


def divide(left: int, divisor: float) -> int:
    """DIV of the standard, to the nearest nanosecond. ZeroDivisionError; FaultError for NaN and infinity."""
    return round(left / _fraction(divisor))


def _fraction(number: float) -> Fraction:
    if isinstance(number, float) and not math.isfinite(number):
        raise FaultError(f"a duration cannot be multiplied or divided by {number}")
    return Fraction(number)


_REPRESENTATION = "matiec's TIME arithmetic gives a value here that compares wrongly; count integer milliseconds"


def careful_add(left: int, right: int) -> int:
    """Add where matiec's pair stays normalised. FaultError."""
    return _sound(left + right, c_add(pair(left), pair(right)))


def careful_subtract(left: int, right: int) -> int:
    """Subtract where matiec's pair stays normalised. FaultError."""
    return _sound(left - right, c_subtract(pair(left), pair(right)))


def careful_multiply(left: int, factor: float) -> int:
    """Multiply where matiec loses nothing. FaultError."""
    return _sound(multiply(left, factor), c_multiply(pair(left), float(factor)))


def careful_divide(left: int, divisor: float) -> int:
    """Divide where matiec loses nothing. FaultError, ZeroDivisionError."""
    return _sound(divide(left, divisor), c_divide(pair(left), float(divisor)))


def _sound(duration: int, span: Span) -> int:
    if pair(duration) != span:
        raise FaultError(_REPRESENTATION)
    return duration


# ------------------------------------------------------------ literals, dates


_UNITS = {"d": DAY, "h": 3_600 * SECOND, "m": 60 * SECOND, "s": SECOND, "ms": SECOND // 1_000}
_PARTS = re.compile(r"([\d.]+)(ms|d|h|m|s)")


def c_literal(text: str, duration: int) -> Span:
    """The pair that C compilers fold a TIME literal into: cut, not rounded, in 80-bit arithmetic.

    T#1ms becomes 999999 ns. `text` is the literal as written, since its parts are converted one by one; `duration`
    its exact value, for a spelling that is not understood.
    """
    spelling = text.partition("#")[2].replace("_", "").lower()
    parts = {unit: _long_double(number) for number, unit in _PARTS.findall(spelling)}
    if not parts:
        return pair(duration)
    none = Fraction(0)
    total = none
    for unit, factor in (("d", 24), ("h", 60), ("m", 60)):
        total = _extended(_extended(total + parts.get(unit, none)) * factor)
    total = _extended(total + parts.get("s", none))
    total = _extended(total + _extended(parts.get("ms", none) / 1000))
    return _split(-total if spelling.startswith("-") else total)


def parsed(text: str) -> int:
    """The nanoseconds of a TIME literal such as T#-1h30m. FaultError for anything else."""
    prefix, mark, spelling = text.replace("_", "").upper().partition("#")
    parts = _PARTS.findall(spelling.lower())
    sign, digits = (-1, spelling[1:]) if spelling.startswith("-") else (1, spelling)
    if prefix not in ("T", "TIME") or not mark or "".join(a + b for a, b in parts) != digits.lower() or not parts:
        raise FaultError(f"{text!r} is no literal of TIME")
    return sign * round(sum(Fraction(number) * _UNITS[unit] for number, unit in parts))


def c_time_of_day_literal(duration: int) -> Span:
    """The pair of a TOD literal, whose seconds pass through a double."""
    minutes, rest = divmod(duration, 60 * SECOND)
    return _split(_extended(minutes * 60 + Fraction(rest / SECOND)))


def c_moment_literal(moment: int) -> Span:
    """The pair of a DT literal: its time of day cut as above, its date exact."""
    rest = c_time_of_day_literal(moment % DAY)
    return Span(date_of(moment) // SECOND + rest.seconds, rest.nanoseconds)


def _long_double(number: str) -> Fraction:
    """A part of a duration as C reads it: an integer constant is exact, one with a point is a double."""
    return Fraction(float(number)) if "." in number else Fraction(int(number))


def _split(total: Fraction) -> Span:
    seconds = int(total)
    return Span(seconds, int(_extended(_extended(total - seconds) * SECOND)))


def _extended(number: Fraction) -> Fraction:
    """Round to the 64-bit significand of the 80-bit format, ties to even."""
    if number == 0:
        return number
    magnitude = abs(number)
    exponent = magnitude.numerator.bit_length() - magnitude.denominator.bit_length()
    if Fraction(2) ** exponent > magnitude:
        exponent -= 1
    unit = Fraction(2) ** (exponent - _EXTENDED_BITS + 1)
    return round(number / unit) * unit


def date_of(moment: int) -> int:
    """DT_TO_DATE: midnight before a moment."""
    return moment - moment % DAY


def time_of_day(moment: int) -> int:
    """DT_TO_TOD: what has passed since midnight."""
    return moment % DAY


def c_date_of(moment: Span) -> Span:
    """DT_TO_DATE on pairs; before 1970 as matiec counts."""
    rest = int(math.fmod(moment[0], 86_400))
    return Span(moment[0] - rest - (86_400 if moment[0] < 0 else 0), 0)


def c_time_of_day(moment: Span) -> Span:
    """DT_TO_TOD on pairs; before 1970 as matiec counts."""
    rest = int(math.fmod(moment[0], 86_400))
    return Span(rest + (86_400 if moment[0] < 0 else 0), moment[1])
