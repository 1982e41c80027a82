"""Values as STRING and back: literals of the standard, where matiec reads them (`_c_`) as the same."""

from structured_text.engines.embedded.faults import FaultError
from structured_text.engines.embedded.integers import wrap


def from_bool(number: bool) -> bytes:
    """BOOL_TO_STRING."""
    return b"TRUE" if number else b"FALSE"


def from_whole(number: int) -> bytes:
    """INT_TO_STRING and its like."""
    return b"%d" % number


_BASES = {b"2#": 2, b"8#": 8, b"16#": 16}


def to_whole(text: bytes) -> int:
    """STRING_TO_INT of a literal. FaultError."""
    number, in_c = _whole(text), _c_to_whole(text)
    if in_c != number:
        raise FaultError(f"{text!r} is {number} by the standard and {in_c} on matiec")
    return number


def _whole(text: bytes) -> int:
    """A literal by the standard: sign, digits, underscores, or a based number. FaultError."""
    digits = text.replace(b"_", b"")
    for prefix, base in _BASES.items():
        if digits.startswith(prefix):
            return _parsed(text, digits[len(prefix) :], base)
    return _parsed(text, digits, 10)


def _parsed(text: bytes, digits: bytes, base: int) -> int:
    try:
        return int(digits, base)
    except ValueError as error:
        raise FaultError(f"{text!r} is no integer literal") from error


def to_real(text: bytes) -> float:
    """STRING_TO_REAL of a literal. FaultError."""
    try:
        number = float(text)
    except ValueError as error:
        raise FaultError(f"{text!r} is no number") from error
    in_c = _c_to_real(text)
    if in_c != number:
        raise FaultError(f"{text!r} is {number} by the standard and {in_c} on matiec")
    return number


def to_bool(text: bytes) -> bool:
    """STRING_TO_BOOL: TRUE or 1, FALSE or 0, in any case. FaultError."""
    word = text.upper()
    if word not in (b"TRUE", b"FALSE", b"1", b"0"):
        raise FaultError(f"{text!r} is neither TRUE nor FALSE")
    return word in (b"TRUE", b"1")


def _c_to_whole(text: bytes) -> int:
    """STRING_TO_INT as matiec reads it: from the right, skipping what is no digit."""
    for prefix, bits in ((b"2#", 1), (b"8#", 3), (b"16#", 4)):
        if text.startswith(prefix) and len(text) > len(prefix) - 1:
            return _c_based(text[len(prefix) :], bits)
    sign = -1 if text.startswith(b"-") else 1
    total, factor, digits = 0, sign, 0
    for character in reversed(text):
        if digits >= 20:
            break
        if 0x30 <= character <= 0x39:
            total, factor, digits = total + (character - 0x30) * factor, factor * 10, digits + 1
        elif character >= 0x2E:
            total, factor, digits = 0, sign, 0
    return total


def _c_based(digits: bytes, bits: int) -> int:
    total = shift = 0
    for character in reversed(digits):
        if shift >= 64:
            break
        digit = "0123456789abcdef".find(chr(character).lower())
        if 0 <= digit < 1 << bits:
            # Binary and octal digits are shifted as ints, by places modulo 32 on x86-64.
            total |= digit << shift if bits == 4 else wrap(digit << shift % 32, 32, True)
            shift += bits
    return total


def _c_to_real(text: bytes) -> float:
    """STRING_TO_REAL as matiec reads it: with a point by atof, without one as a signed integer of 64 bits."""
    if b"." not in text[1:]:
        return float(wrap(_c_to_whole(text), 64, True))
    for end in range(len(text), 0, -1):
        try:
            return float(text[:end])
        except ValueError:
            continue
    return 0.0
