"""STRING at run time: bytes, cut at the length of the variable that takes them.

The standard makes it an error to count below zero, to name a character that is not there, and to build a string
longer than the maximum (IEC 61131-3 2.5.1.5.5); the `c_` functions clamp instead, as matiec's Beremiz line does.
"""

from __future__ import annotations

import math

from driveblocks.host.embedded.faults import FaultError
from driveblocks.host.embedded.integers import wrap
from driveblocks.st.types import DEFAULT_STRING_LENGTH


def _characters(text: bytes, first: int, last: int, name: str) -> None:
    """Check that the characters `first..last` (1-based) exist; an empty run is allowed anywhere inside."""
    if first < 1 or last < first - 1 or last > len(text):
        raise FaultError(f"{name} names characters {first}..{last} of a string of {len(text)}")


def _built(text: bytes, name: str) -> bytes:
    if len(text) > DEFAULT_STRING_LENGTH:
        raise FaultError(f"{name} builds a string of {len(text)} characters; at most {DEFAULT_STRING_LENGTH} fit")
    return text


def left(text: bytes, count: int) -> bytes:
    """LEFT. FaultError."""
    _characters(text, 1, count, "LEFT")
    return text[:count]


def right(text: bytes, count: int) -> bytes:
    """RIGHT. FaultError."""
    _characters(text, len(text) - count + 1, len(text), "RIGHT")
    return text[len(text) - count :]


def mid(text: bytes, count: int, position: int) -> bytes:
    """MID: `count` characters from `position` (1-based). FaultError."""
    _characters(text, position, position + count - 1, "MID")
    return text[position - 1 : position - 1 + count]


def concat(*texts: bytes) -> bytes:
    """CONCAT. FaultError."""
    return _built(b"".join(texts), "CONCAT")


def insert(text: bytes, other: bytes, position: int) -> bytes:
    """INSERT `other` behind character `position`. FaultError."""
    _characters(text, 1, position, "INSERT")
    return _built(text[:position] + other + text[position:], "INSERT")


def delete(text: bytes, count: int, position: int) -> bytes:
    """DELETE `count` characters from `position` on. FaultError."""
    _characters(text, position, position + count - 1, "DELETE")
    return text[: position - 1] + text[position - 1 + count :]


def replace(text: bytes, other: bytes, count: int, position: int) -> bytes:
    """REPLACE `count` characters from `position` on by all of `other`. FaultError."""
    _characters(text, position, position + count - 1, "REPLACE")
    return _built(text[: position - 1] + other + text[position - 1 + count :], "REPLACE")


def find(text: bytes, other: bytes) -> int:
    """FIND: where `other` begins (1-based), 0 if nowhere or empty."""
    return text.find(other) + 1 if other else 0


def careful_replace(text: bytes, other: bytes, count: int, position: int) -> bytes:
    """REPLACE where matiec, which takes no more of `other` than it removes, agrees. FaultError."""
    if len(other) > count:
        raise FaultError(f"REPLACE of {count} characters by {len(other)}: matiec inserts only {count} of them")
    return replace(text, other, count, position)


def careful_find(text: bytes, other: bytes) -> int:
    """FIND where both lines of matiec agree with the standard. FaultError."""
    found = find(text, other)
    if found != _naive_find(text, other) or found != openplc_find(text, other):
        raise FaultError("FIND gives different results among compilers for these strings")
    return found


# ------------------------------------------------------------ as matiec


def _count(*numbers: int) -> bool:
    return min(numbers) < 0


def c_left(text: bytes, count: int) -> bytes:
    """LEFT; what is not there is left out."""
    return b"" if _count(count) else text[:count]


def c_right(text: bytes, count: int) -> bytes:
    """RIGHT; what is not there is left out."""
    return b"" if _count(count) else text[len(text) - min(count, len(text)) :]


def c_mid(text: bytes, count: int, position: int) -> bytes:
    """MID; what is not there is left out. Position 0 reads memory before the string on matiec. FaultError."""
    if _count(count, position) or position > len(text):
        return b""
    if position == 0:
        raise FaultError("MID at position 0 reads outside the string on matiec")
    return text[position - 1 : position - 1 + count]


def c_concat(*texts: bytes) -> bytes:
    """CONCAT, cut at the maximum."""
    return b"".join(texts)[:DEFAULT_STRING_LENGTH]


def c_insert(text: bytes, other: bytes, position: int) -> bytes:
    """INSERT, cut at the maximum."""
    if _count(position):
        return b""
    place = min(position & 0xFF, len(text))
    return (text[:place] + other + text[place:])[:DEFAULT_STRING_LENGTH]


def c_delete(text: bytes, count: int, position: int) -> bytes:
    """DELETE; lengths pass through 8 bits. Position 0 writes outside the string on matiec. FaultError."""
    if _count(count, position):
        return b""
    count, position = count & 0xFF, position & 0xFF
    if position == 0:
        raise FaultError("DELETE at position 0 writes outside the string on matiec")
    place = len(text) if position > len(text) else position - 1
    return text[:place] + text[place + count :]


def c_replace(text: bytes, other: bytes, count: int, position: int) -> bytes:
    """REPLACE by no more characters than are removed. Position 0 writes outside on matiec. FaultError."""
    if _count(count, position):
        return b""
    count, position = count & 0xFF, position & 0xFF
    if position == 0:
        raise FaultError("REPLACE at position 0 writes outside the string on matiec")
    place = len(text) if position > len(text) else position - 1
    rest = text[place + count :] if place + count <= 0xFF else text[(place + count) & 0xFF :]
    return (text[:place] + other[:count] + rest)[:DEFAULT_STRING_LENGTH]


def _naive_find(text: bytes, other: bytes) -> int:
    """FIND by a search that skips what it had matched, and so misses some overlaps: matiec's Beremiz line."""
    if not 0 < len(other) <= len(text):
        return 0
    start, matched = _scan(text, other)
    return start + 1 if matched == len(other) else 0


def openplc_find(text: bytes, other: bytes) -> int:
    """The OpenPLC line of matiec: it takes a match of all but the last character for none, and others for one."""
    start, matched = _scan(text, other)
    return 0 if matched == len(other) - 1 else start + 1


def _scan(text: bytes, other: bytes) -> tuple[int, int]:
    start = matched = 0
    while start + matched < len(text) and matched < len(other):
        if text[start + matched] != other[matched]:
            start, matched = start + matched + 1, 0
        else:
            matched += 1
    return start, matched


c_find = _naive_find


# ------------------------------------------------------------ comparison


def order(left_text: bytes, right_text: bytes) -> int:
    """Negative, zero or positive, byte by byte; a beginning comes before the whole."""
    return (left_text > right_text) - (left_text < right_text)


def careful_order(left_text: bytes, right_text: bytes) -> int:
    """Negative, zero or positive. FaultError where one is the beginning of the other: OpenPLC calls them equal."""
    if left_text == right_text:
        return 0
    if left_text.startswith(right_text) or right_text.startswith(left_text):
        raise FaultError("one string is the beginning of the other: OpenPLC's compiler takes them for equal")
    return 1 if left_text > right_text else -1


# ------------------------------------------------------------ to and from numbers


def from_bool(number: bool) -> bytes:
    """BOOL_TO_STRING."""
    return b"TRUE" if number else b"FALSE"


def from_whole(number: int) -> bytes:
    """INT_TO_STRING and its like."""
    return b"%d" % number


def from_bits(number: int) -> bytes:
    """BYTE_TO_STRING and its like, as a literal of the standard."""
    return b"16#%X" % number


def c_from_bits(number: int) -> bytes:
    """The same as matiec writes it."""
    return b"16#%x" % number


def from_real(number: float) -> bytes:
    """REAL_TO_STRING with ten significant digits, as matiec writes it."""
    return b"%.10g" % number


def c_from_real(number: float) -> bytes:
    """The same by C's library, which shows the sign of a NaN."""
    return b"-nan" if math.isnan(number) and math.copysign(1.0, number) < 0 else from_real(number)


def from_time(seconds: int, nanoseconds: int) -> bytes:
    """TIME_TO_STRING as matiec writes it: from days down to the last part that is not zero."""
    parts = []
    rest = abs(seconds)
    sign = -1 if seconds < 0 else 1
    for unit, size in ((b"d", 86_400), (b"h", 3_600), (b"m", 60), (b"s", 1)):
        parts.append(b"%d%s" % (sign * (rest // size), unit))
        rest %= size
        if rest == 0 and nanoseconds == 0:
            break
    if nanoseconds:
        parts.append(b"%gms" % (nanoseconds / 1_000_000))
    return b"T#" + b"".join(parts)


_BASES = {b"2#": 2, b"8#": 8, b"16#": 16}


def to_whole(text: bytes) -> int:
    """STRING_TO_INT of a literal: sign, digits, underscores, or a based number. FaultError."""
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
        return float(text)
    except ValueError as error:
        raise FaultError(f"{text!r} is no number") from error


def to_bool(text: bytes) -> bool:
    """STRING_TO_BOOL: TRUE or 1, FALSE or 0, in any case. FaultError."""
    word = text.upper()
    if word not in (b"TRUE", b"FALSE", b"1", b"0"):
        raise FaultError(f"{text!r} is neither TRUE nor FALSE")
    return word in (b"TRUE", b"1")


def c_to_bool(text: bytes) -> bool:
    """The same as on matiec: all else is FALSE."""
    return text.upper() in (b"TRUE", b"1")


def c_to_whole(text: bytes) -> int:
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


def c_to_real(text: bytes) -> float:
    """STRING_TO_REAL as matiec reads it: with a point by atof, without one as an integer."""
    if b"." not in text[1:]:
        return float(c_to_whole(text))
    for end in range(len(text), 0, -1):
        try:
            return float(text[:end])
        except ValueError:
            continue
    return 0.0


# ------------------------------------------------------------ where the standard and C agree


def careful_to_whole(text: bytes) -> int:
    """STRING_TO_INT of a literal that matiec reads as the same number. FaultError."""
    number = to_whole(text)
    if c_to_whole(text) != number:
        raise FaultError(f"{text!r} is {number} by the standard and {c_to_whole(text)} on matiec")
    return number


def careful_to_real(text: bytes) -> float:
    """STRING_TO_REAL of a literal that matiec reads as the same number. FaultError."""
    number = to_real(text)
    if c_to_real(text) != number:
        raise FaultError(f"{text!r} is {number} by the standard and {c_to_real(text)} on matiec")
    return number
