"""Integers and bit strings at run time: what wraps, what fails, and division as ST and C have it."""

from structured_text.engines.embedded.faults import FaultError
from structured_text.engines.embedded.terms import CInteger


def wrap(number: int, width: int, signed: bool) -> int:
    """The value that `width` bits of two's complement keep."""
    number &= (1 << width) - 1
    return number - (1 << width) if signed and number >> (width - 1) else number


def divide(left: int, right: int) -> int:
    """Divide towards zero (IEC 61131-3 table 24; ISO C 6.5.5). ZeroDivisionError."""
    return left // right if (left >= 0) == (right > 0) else -(-left // right)


def remainder(left: int, right: int) -> int:
    """The remainder of `divide`, with the sign of the dividend. ZeroDivisionError."""
    return left % right if left >= 0 and right > 0 else left - right * divide(left, right)


def leaves_type(number: int, name: str, width: int, signed: bool) -> int:
    """Fail: an intermediate result left its type and what comes next depends on it."""
    wrapped = wrap(number, width, signed)
    raise FaultError(
        f"the intermediate result {number} exceeds {name}: the standard continues with {wrapped}, C with {number};"
        " store it first, or compute in a wider type"
    )


def leaves_c(number: int, name: str) -> int:
    """Fail: a signed result left the type in which C computes it."""
    raise FaultError(f"the result {number} exceeds {name}: C does not define what happens then")


def leaves_open(number: int, high: int) -> int:
    """Fail: nothing gives the type of a number that is not the same in every type that compilers choose."""
    raise FaultError(
        f"nothing gives the type of this number, and {number} is outside 0..{high}, where all compilers agree:"
        " store it in a variable first"
    )


def leaves_range(number: int, first: int, last: int) -> int:
    """Fail: a value outside its subrange (IEC 61131-3 2.3.3.1)."""
    raise FaultError(f"{number} is outside the subrange {first}..{last}")


def c_name(each: CInteger) -> str:
    """What C calls the type, for messages."""
    return f"C's {'' if each.signed else 'unsigned '}{each.width}-bit integer"


# ------------------------------------------------------------ shifts and rotations


def shift_left(number: int, places: int, width: int) -> int:
    """SHL. FaultError."""
    _refuse_places(places, width)
    return (number << places) & ((1 << width) - 1) if places < width else 0


def shift_right(number: int, places: int, width: int) -> int:
    """SHR. FaultError."""
    _refuse_places(places, width)
    return number >> places if places < width else 0


def _refuse_places(places: int, width: int) -> None:
    """Negative places are an error by the standard, the full width or more is undefined in C."""
    if places < 0:
        raise FaultError(f"a shift by {places} places: the number of places must not be negative")
    if places >= max(width, 32):
        raise FaultError(f"a shift by {places} places: C does not define a shift by {max(width, 32)} or more")


def rotate_left(number: int, places: int, width: int) -> int:
    """ROL; the standard makes negative places an error. FaultError."""
    if places < 0:
        raise FaultError(f"a rotation by {places} places: the number of places must not be negative")
    places %= width
    return ((number << places) | (number >> (width - places))) & ((1 << width) - 1)


def rotate_right(number: int, places: int, width: int) -> int:
    """ROR. FaultError."""
    return rotate_left(number, width - places % width if places >= 0 else places, width)


# ------------------------------------------------------------ BCD


def from_bcd(number: int, width: int) -> int:
    """BCD_TO: decimal digits of four bits each. FaultError for a digit above nine."""
    digits = f"{number:0{width // 4}x}"
    if not digits.isdecimal():
        raise FaultError(f"16#{digits.upper()} is no BCD number")
    return int(digits)


def to_bcd(number: int, width: int) -> int:
    """TO_BCD. FaultError for a number with more digits than fit."""
    packed = int(str(number), 16)
    if packed >> width:
        raise FaultError(f"{number} does not fit into {width // 4} BCD digits")
    return packed
