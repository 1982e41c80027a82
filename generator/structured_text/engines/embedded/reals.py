"""REAL and LREAL at run time: rounding to IEEE single precision, and conversions to integers, by the standard and by C.

C's conversions are those of x86-64, where a value that does not fit gives the "integer indefinite" (Intel SDM volume
1, 4.8.2 and the entries of CVTTSS2SI and CVTTSD2SI): the most negative number of the register, cut to the target.
"""

import ctypes
import math
import sys
from collections.abc import Callable

from structured_text.engines.embedded.faults import FaultError

_CELL: "memoryview[float]" = memoryview(bytearray(4)).cast("f")
_INDEFINITE_32 = -(1 << 31)
_INDEFINITE_64 = -(1 << 63)
# What x86-64 makes of an invalid operation: a NaN with its sign set.
# The functions of glibc that make a NaN without a sign.
# Whole numbers up to this size are exact in single precision.
EXACT_SINGLE = 1 << 24


def _single_by_cell(number: float, cell: "memoryview[float]" = _CELL) -> float:
    """Round to the nearest single, ties to even, infinity beyond the range. No thread switch can fall in between."""
    cell[0] = number
    return cell[0]


def _single_by_ctypes(number: float) -> float:
    """The same for an interpreter without a global lock."""
    return ctypes.c_float(number).value


_LOCKED: bool = getattr(sys, "_is_gil_enabled", lambda: True)()
single: Callable[[float], float] = _single_by_cell if _LOCKED else _single_by_ctypes


def whole_to_single(number: int) -> float:
    """Round an integer of up to 64 bits to single precision once, not first to double and then again."""
    excess = abs(number).bit_length() - 53
    if excess <= 0:
        return single(float(number))
    # Keep 53 bits and make the last one sticky: far more than a single holds, so that rounding again is right.
    kept = abs(number) >> excess
    sticky = 1 if abs(number) != kept << excess else 0
    return single(math.copysign(float((kept | sticky) << excess), number))


def nearest(number: float) -> int:
    """The nearest integer, halves to the even one (IEC 60559). FaultError for NaN and the infinities."""
    if not math.isfinite(number):
        raise FaultError(f"{number} has no integer value")
    return round(number)


def c_nearest(number: float, signed: bool) -> int:
    """How matiec rounds: adds a half and cuts, an exact half going to the even neighbour; 64 bits, then cut.

    To an unsigned type or a bit string everything below zero, and NaN, gives 0.
    """
    if not signed and not number >= 0:
        return 0
    moved = number + 0.5 if number >= 0 else number - 0.5
    cut = c_cut(moved, 64)
    if not math.isfinite(moved) or math.fmod(moved, 1.0) != 0.0:
        return cut
    return abs(cut) // 2 * 2 if cut >= 0 else -(abs(cut) // 2 * 2)


def c_cut(number: float, width: int) -> int:
    """Cut off the fraction in a signed register of 32 or 64 bits."""
    indefinite = _INDEFINITE_32 if width == 32 else _INDEFINITE_64
    if not math.isfinite(number):
        return indefinite
    cut = int(number)
    return cut if indefinite <= cut < -indefinite else indefinite


def c_cut_unsigned_64(number: float) -> int:
    """Cut to ULINT as compilers for x86-64 do: each half of the range by itself, below zero by two's complement."""
    if number >= float(1 << 63):
        return c_cut(number - float(1 << 63), 64) ^ (1 << 63)
    return c_cut(number, 64)


def power(base: float, exponent: float) -> float:
    """`base ** exponent`. FaultError where it is not defined or too large."""
    try:
        return math.pow(base, exponent)
    except (ValueError, OverflowError) as error:
        raise FaultError(f"{base} ** {exponent} has no value") from error


def guarded(name: str, function: Callable[[float], float]) -> Callable[[float], float]:
    """A function of the mathematical library that raises FaultError where it has no finite value."""

    def run(number: float) -> float:
        try:
            return function(number)
        except (ValueError, OverflowError) as error:
            raise FaultError(f"{name}({number}) has no value") from error

    return run


MATHEMATICS: dict[str, Callable[[float], float]] = {
    "SQRT": math.sqrt, "LN": math.log, "LOG": math.log10, "EXP": math.exp, "SIN": math.sin, "COS": math.cos,
    "TAN": math.tan, "ASIN": math.asin, "ACOS": math.acos, "ATAN": math.atan,
}  # fmt: skip


def agree(left: float, right: float) -> float:
    """The value of a REAL expression if the standard's and C's are the same. FaultError if not."""
    if left == right or (math.isnan(left) and math.isnan(right)):
        return left
    raise FaultError(
        f"C computes this with doubles and gets {right!r}, single precision gives {left!r};"
        " type the literals (REAL#0.1) or take them from a VAR CONSTANT"
    )


def agree_truth(left: bool, right: bool) -> bool:
    """The truth of a comparison of REALs if the standard's and C's are the same. FaultError if not."""
    if left == right:
        return left
    raise FaultError(
        "C compares this as doubles with another outcome than single precision;"
        " type the literals (REAL#0.1) or take them from a VAR CONSTANT"
    )
