"""REAL: numbers of IEEE 754 single precision, from doubles, and from exact fractions."""

import struct
from fractions import Fraction
from math import copysign, inf

PRECISION = 24
SMALLEST_EXPONENT = -126
LARGEST = Fraction((2**PRECISION - 1) * 2 ** (128 - PRECISION))
_REAL = struct.Struct("f")


def nearest(value: Fraction) -> float:
    """The single nearest to a fraction, ties to the even one; infinite where it is beyond the largest."""
    if value == 0:
        return 0.0
    size = abs(value)
    exponent = size.numerator.bit_length() - size.denominator.bit_length()
    exponent = max(exponent - (size < Fraction(2) ** exponent), SMALLEST_EXPONENT)
    step = Fraction(2) ** (exponent - PRECISION + 1)
    rounded = round(size / step) * step
    number = inf if rounded > LARGEST else float(rounded)
    return number if value > 0 else -number


def stored(number: float) -> float:
    """What a REAL variable holds after a number was assigned to it."""
    try:
        (held,) = _REAL.unpack(_REAL.pack(number))
    except OverflowError:
        return copysign(inf, number)
    return float(held)
