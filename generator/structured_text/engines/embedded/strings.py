"""STRING at run time: bytes, cut at the length of the variable that takes them.

The standard makes it an error to count below zero, to name a character that is not there, and to build a string
longer than the maximum (IEC 61131-3 2.5.1.5.5).
"""

from structured_text.engines.embedded.faults import FaultError
from structured_text.language.types import DEFAULT_STRING_LENGTH


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
    """INSERT `other` after character `position`. FaultError."""
    _characters(text, 1, position, "INSERT")
    return _built(text[:position] + other + text[position:], "INSERT")


def delete(text: bytes, count: int, position: int) -> bytes:
    """DELETE `count` characters from `position` on. FaultError."""
    _characters(text, position, position + count - 1, "DELETE")
    return text[: position - 1] + text[position - 1 + count :]


def replace(text: bytes, other: bytes, count: int, position: int) -> bytes:
    """REPLACE `count` characters from `position` on by all of `other`. FaultError."""
    if len(other) > count:
        raise FaultError(f"REPLACE of {count} characters by {len(other)}: matiec inserts only {count} of them")
    _characters(text, position, position + count - 1, "REPLACE")
    return _built(text[: position - 1] + other + text[position - 1 + count :], "REPLACE")


def find(text: bytes, other: bytes) -> int:
    """FIND: where `other` begins (1-based), 0 if nowhere or empty. FaultError where a line of matiec differs."""
    found = text.find(other) + 1 if other else 0
    if found != _naive_find(text, other) or found != _openplc_find(text, other):
        raise FaultError("FIND gives different results among compilers for these strings")
    return found


# ------------------------------------------------------------ FIND as matiec has it


def _naive_find(text: bytes, other: bytes) -> int:
    """FIND by a search that skips what it had matched, and so misses some overlaps: matiec's Beremiz line."""
    if not 0 < len(other) <= len(text):
        return 0
    start, matched = _scan(text, other)
    return start + 1 if matched == len(other) else 0


def _openplc_find(text: bytes, other: bytes) -> int:
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


# ------------------------------------------------------------ comparison


def order(left_text: bytes, right_text: bytes) -> int:
    """Negative, zero or positive. FaultError where one is the beginning of the other: OpenPLC calls them equal."""
    if left_text == right_text:
        return 0
    if left_text.startswith(right_text) or right_text.startswith(left_text):
        raise FaultError("one string is the beginning of the other: OpenPLC's compiler takes them for equal")
    return 1 if left_text > right_text else -1
