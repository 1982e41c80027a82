"""Literals: spelling -> value, by tables 4, 5, 7 of IEC 61131-3, second edition."""

import re
from calendar import monthrange
from collections.abc import Callable
from datetime import date, timedelta
from fractions import Fraction

from structured_text.language.tree import Literal, LiteralKind, LiteralValue, Qualified
from structured_text.language.types import BOOL, ELEMENTARY, Elementary, Kind

SECOND = 1_000_000_000
_UNITS = {"D": 86400 * SECOND, "H": 3600 * SECOND, "M": 60 * SECOND, "S": SECOND, "MS": 1_000_000, "US": 1000, "NS": 1}
_PART = re.compile(r"(\d[\d_]*(?:\.\d[\d_]*)?)(ms|us|ns|d|h|m|s)_?", re.IGNORECASE)
_INTEGER = re.compile(r"[+-]?\d+(?:_\d+)*")
_REAL = re.compile(r"[+-]?\d+(?:_\d+)*(?:\.\d+(?:_\d+)*)?(?:[eE][+-]?\d+)?")
_DIGITS = {2: re.compile(r"[01]+(?:_[01]+)*"), 8: re.compile(r"[0-7]+(?:_[0-7]+)*")}
_DIGITS[16] = re.compile(r"[0-9a-fA-F]+(?:_[0-9a-fA-F]+)*")
_CLOCK = re.compile(r"(\d{1,2}):(\d{1,2})(?::(\d{1,2}(?:\.\d+)?))?")
_DAY = re.compile(r"(\d{4})-(\d{1,2})-(\d{1,2})")
_EPOCH = date(1970, 1, 1)
_ESCAPES = {"$": "$", "'": "'", '"': '"', "L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}
_ESCAPE = re.compile(r"\$([0-9A-Fa-f]{2}|.)", re.DOTALL)
_WIDE_ESCAPE = re.compile(r"\$([0-9A-Fa-f]{4}|.)", re.DOTALL)
TIME_PREFIXES = {"T": "TIME", "TIME": "TIME", "LT": "LTIME", "LTIME": "LTIME"}
_KINDS = {
    "D": LiteralKind.DATE,
    "DATE": LiteralKind.DATE,
    "TOD": LiteralKind.TIME_OF_DAY,
    "TIME_OF_DAY": LiteralKind.TIME_OF_DAY,
    "DT": LiteralKind.DATE_AND_TIME,
    "DATE_AND_TIME": LiteralKind.DATE_AND_TIME,
}


class LiteralError(ValueError):
    """A literal that has no value; the text says what was expected."""


def number(at: int, text: str) -> Literal:
    """A literal without prefix: `12`, `-3`, `1.5E3`, `16#FF`. Raises LiteralError."""
    if "#" in text:
        base, value = _based(text)
        return Literal(at, text, LiteralKind.INTEGER, value, None, base)
    if text.isdigit() or _INTEGER.fullmatch(text):
        return Literal(at, text, LiteralKind.INTEGER, _whole(text))
    if text[:2] in ("0x", "0X"):
        raise LiteralError(f"expected a literal as 16#{text[2:]}, found {text}")
    if not _REAL.fullmatch(text):
        raise LiteralError(f"expected a number, found {text}")
    return Literal(at, text, LiteralKind.REAL, _float(text))


def string(at: int, text: str) -> Literal:
    """`'AB$0D'` with its quotes. Raises LiteralError."""
    return Literal(at, text, LiteralKind.STRING, _narrow(text))


def wide_string(at: int, text: str) -> Literal:
    """`"AB$000D"` with its quotes. Raises LiteralError."""
    return Literal(at, text, LiteralKind.WSTRING, _unescape(text, _WIDE_ESCAPE, 4))


def typed(at: int, text: str) -> Literal | Qualified:
    """`PREFIX#rest`; a prefix that is no elementary type makes a Qualified. Raises LiteralError."""
    prefix, rest = text.split("#", 1)
    upper = prefix.upper()
    if upper in TIME_PREFIXES:
        return Literal(at, text, LiteralKind.TIME, _duration(rest), TIME_PREFIXES[upper])
    if upper in _KINDS:
        kind = _KINDS[upper]
        return Literal(at, text, kind, _CALENDAR[kind](rest), kind.name)
    if upper in ("STRING", "WSTRING"):
        made = string(at, rest) if rest.startswith("'") else wide_string(at, rest)
        return Literal(at, text, made.kind, made.value, upper)
    if upper in ELEMENTARY:
        return _elementary(at, text, ELEMENTARY[upper], rest)
    if not rest.isidentifier():
        raise LiteralError(f"expected a literal with the prefix of an elementary type, found {text}")
    return Qualified(at, prefix, rest)


def _elementary(at: int, text: str, wanted: Elementary, rest: str) -> Literal:
    """A literal of a bit string, integer, real or BOOL."""
    if wanted is BOOL:
        return Literal(at, text, LiteralKind.BOOL, _boolean(rest), wanted.name)
    if wanted.kind is Kind.REAL:
        if not _REAL.fullmatch(rest):
            raise LiteralError(f"expected a real number after {wanted.name}#, found {rest}")
        return Literal(at, text, LiteralKind.REAL, _float(rest), wanted.name)
    if "#" in rest:
        base, value = _based(rest)
        return Literal(at, text, LiteralKind.INTEGER, value, wanted.name, base)
    if not _INTEGER.fullmatch(rest):
        raise LiteralError(f"expected an integer after {wanted.name}#, found {rest}")
    return Literal(at, text, LiteralKind.INTEGER, _whole(rest), wanted.name)


def _boolean(rest: str) -> bool:
    """TRUE, FALSE, 1 or 0."""
    upper = rest.upper()
    if upper not in ("TRUE", "FALSE", "0", "1"):
        raise LiteralError(f"expected TRUE, FALSE, 0 or 1 after BOOL#, found {rest}")
    return upper in ("TRUE", "1")


def _float(text: str) -> float:
    """A real; one beyond the range of LREAL is an error, not infinity."""
    value = float(text)
    if value in (float("inf"), float("-inf")):
        raise LiteralError(f"expected a number within LREAL, found {text[:40]}")
    return value


def _based(text: str) -> tuple[int, int]:
    """`16#FF` -> (16, 255)."""
    head, digits = text.split("#", 1)
    base = int(head) if head in ("2", "8", "10", "16") else 0
    if base == 0:
        raise LiteralError(f"expected the base 2#, 8# or 16#, found {head}#")
    if base == 10:
        raise LiteralError(f"expected a decimal number without base, found {text}")
    if not _DIGITS[base].fullmatch(digits):
        raise LiteralError(f"expected digits of base {base}, found {digits}")
    return base, _whole(digits, base)


def _whole(digits: str, base: int = 10) -> int:
    """An integer; no type holds more than 64 bits."""
    plain = digits.replace("_", "").lstrip("0") or "0"
    value = int(plain, base) if len(plain) <= 70 else 1 << 70
    if abs(value) >> 64:
        raise LiteralError(f"expected a number of at most 64 bits, found {digits[:40]}")
    return value


def _duration(rest: str) -> int:
    """`1d2h3m4.5s` -> nanoseconds. Units fall; only the last part may have a fraction."""
    sign, body = (-1, rest[1:]) if rest.startswith("-") else (1, rest.removeprefix("+"))
    total, here, last = Fraction(0), 0, len(_UNITS)
    order = list(_UNITS)[::-1]
    while here < len(body):
        part = _PART.match(body, here)
        if not part:
            raise LiteralError(f"expected a duration such as T#1m30s or T#1.5s, found {rest}")
        rank = order.index(part[2].upper())
        if rank >= last or (last < len(order) and "." in body[:here]):
            raise LiteralError(f"expected falling units d h m s ms and a fraction at the end only, found {rest}")
        total += Fraction(part[1].replace("_", "")) * _UNITS[part[2].upper()]
        here, last = part.end(), rank
    if not body:
        raise LiteralError("expected a duration such as T#500ms")
    return sign * round(total)


def _date(rest: str) -> int:
    """`2024-02-29` -> nanoseconds since 1970-01-01."""
    match = _DAY.fullmatch(rest)
    if not match or not (1 <= int(match[2]) <= 12 and int(match[1]) >= 1):
        raise LiteralError(f"expected a date as D#2024-02-29, found {rest}")
    year, month, day = (int(match[group]) for group in (1, 2, 3))
    if not 1 <= day <= monthrange(year, month)[1]:
        raise LiteralError(f"expected a day that the month has, found {rest}")
    return (date(year, month, day) - _EPOCH) // timedelta(days=1) * 86400 * SECOND


def _time_of_day(rest: str) -> int:
    """`23:59:59.5` -> nanoseconds since midnight."""
    match = _CLOCK.fullmatch(rest)
    if not match or int(match[1]) > 23 or int(match[2]) > 59 or Fraction(match[3] or 0) >= 60:
        raise LiteralError(f"expected a time of day as TOD#23:59:59, found {rest}")
    return round((int(match[1]) * 3600 + int(match[2]) * 60 + Fraction(match[3] or 0)) * SECOND)


def _date_and_time(rest: str) -> int:
    """`2024-02-29-23:59:59` -> nanoseconds since 1970-01-01."""
    parts = rest.rsplit("-", 1)
    if len(parts) != 2 or ":" not in parts[1]:
        raise LiteralError(f"expected a date and time as DT#2024-02-29-23:59:59, found {rest}")
    return _date(parts[0]) + _time_of_day(parts[1])


_CALENDAR: dict[LiteralKind, Callable[[str], LiteralValue]] = {
    LiteralKind.DATE: _date,
    LiteralKind.TIME_OF_DAY: _time_of_day,
    LiteralKind.DATE_AND_TIME: _date_and_time,
}


def _narrow(text: str) -> bytes:
    """Characters beyond `$` escapes become UTF-8; an escape is one byte."""
    inner = text[1:-1]
    if "$" not in inner:
        return inner.encode("utf-8", "surrogatepass")
    pieces = _ESCAPE.split(inner)
    made = bytearray()
    for index, piece in enumerate(pieces):
        if index % 2 == 0:
            made += piece.encode("utf-8", "surrogatepass")
        else:
            made += bytes([int(piece, 16)]) if len(piece) == 2 else _escaped(piece).encode()
    return bytes(made)


def _unescape(text: str, pattern: re.Pattern[str], digits: int) -> str:
    """Replace the escapes of a wide string."""

    def one(match: re.Match[str]) -> str:
        return chr(int(match[1], 16)) if len(match[1]) == digits else _escaped(match[1])

    return pattern.sub(one, text[1:-1])


def _escaped(letter: str) -> str:
    """What `$` and a letter mean."""
    upper = letter.upper()
    if upper not in _ESCAPES:
        raise LiteralError(f"expected $$ $' $L $N $P $R $T or $ and two hexadecimal digits, found ${letter}")
    return _ESCAPES[upper]
