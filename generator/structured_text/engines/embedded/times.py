"""TIME, DATE, TIME_OF_DAY and DATE_AND_TIME at run time: one integer of nanoseconds (dates since 1970-01-01).

matiec's is a pair (seconds, nanoseconds) whose operations do not always normalise it, so that equal durations
compare unequal: every operation is done in both, and fails where the pair comes out otherwise.
"""

import math
from fractions import Fraction
from typing import NamedTuple

from structured_text.engines.embedded.faults import FaultError
from structured_text.engines.embedded.integers import wrap
from structured_text.engines.embedded.reals import c_cut

SECOND = 1_000_000_000
DAY = 86_400 * SECOND


class Span(NamedTuple):
    """matiec's TIME and dates."""

    seconds: int
    nanoseconds: int


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


def _quotient(number: int, divisor: float) -> float:
    if divisor == 0.0:
        return math.nan if number == 0 else math.copysign(math.inf, number) * math.copysign(1.0, divisor)
    return number / divisor


def _fraction(number: float) -> Fraction:
    if isinstance(number, float) and not math.isfinite(number):
        raise FaultError(f"a duration cannot be multiplied or divided by {number}")
    return Fraction(number)


# ------------------------------------------------------------ arithmetic on nanoseconds, where matiec's is the same


def add(left: int, right: int) -> int:
    """ADD. FaultError."""
    one, two = pair(left), pair(right)
    return _sound(left + right, normalised(one.seconds + two.seconds, one.nanoseconds + two.nanoseconds))


def subtract(left: int, right: int) -> int:
    """SUB. FaultError."""
    one, two = pair(left), pair(right)
    return _sound(left - right, normalised(one.seconds - two.seconds, one.nanoseconds - two.nanoseconds))


def multiply(left: int, factor: float) -> int:
    """MUL, to the nearest nanosecond. FaultError, also for NaN and infinity."""
    product = left * factor if isinstance(factor, int) else round(left * _fraction(factor))
    return _sound(product, c_multiply(pair(left), float(factor)))


def divide(left: int, divisor: float) -> int:
    """DIV, to the nearest nanosecond. ZeroDivisionError; FaultError, also for NaN and infinity."""
    return _sound(round(left / _fraction(divisor)), c_divide(pair(left), float(divisor)))


def _sound(duration: int, span: Span) -> int:
    if pair(duration) != span:
        raise FaultError(
            "matiec's TIME arithmetic gives a value here that compares wrongly; count integer milliseconds"
        )
    return duration


# ------------------------------------------------------------ dates


def date_of(moment: int) -> int:
    """DT_TO_DATE: midnight before a moment."""
    return moment - moment % DAY


def time_of_day(moment: int) -> int:
    """DT_TO_TOD: what has passed since midnight."""
    return moment % DAY
