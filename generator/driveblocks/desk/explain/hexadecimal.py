"""Bytes in hexadecimal: pairs with any separators or none, 0x, \\x, $, 16#, &H, and the suffix h."""

import re

from driveblocks.desk.explain.unreadable import Spot

_TOKEN = re.compile(
    r"""
    (?P<escape>\\x(?P<e>[0-9A-Fa-f]{1,2}))
    | (?P<prefix>(?:0[xX]|(?:(?:BYTE|WORD|USINT|UINT)\#)?16\#|&[hH]|\$)(?P<p>[0-9A-Fa-f]+))
    | (?P<empty>(?P<m>[0-9A-Fa-f]{2})--(?![0-9A-Fa-f]))
    | (?P<device>[A-Za-z]{1,2}[0-9]{1,5}\s*=)
    | (?P<suffix>(?P<s>[0-9A-Fa-f]+)[hH](?![0-9A-Za-z]))
    | (?P<plain>[0-9A-Fa-f]+)
    | (?P<between>[\s,;:.|/_{}()\[\]<>"'`+*-]+)
    """,
    re.VERBOSE,
)
_DIGITS = ("e", "p", "m", "s", "plain")
_ESCAPED = re.compile(r"""\s*b?(["'])(?P<inner>.*)\1[\s,;]*$""", re.DOTALL)
_LITERAL = re.compile(r"""\s*b(["']).*\1[\s,;]*$""", re.DOTALL)
_INNER = re.compile(r"\\x(?P<hex>[0-9A-Fa-f]{2})|\\(?P<sign>[rnt0abfv\\'\"])|(?P<literal>[^\\])", re.DOTALL)
_SIGNS = {"r": 13, "n": 10, "t": 9, "0": 0, "a": 7, "b": 8, "f": 12, "v": 11, "\\": 92, "'": 39, '"': 34}
_LOOKALIKE = {"O": "0", "o": "0", "l": "1", "I": "1", "S": "5", "Z": "2", "G": "6"}


def is_literal(line: str) -> bool:
    """Whether a line is bytes as Python prints them: b'...', exactly what was received."""
    return _LITERAL.fullmatch(line) is not None


def read(line: str, start: int = 0) -> bytes:
    """The bytes of one line that begins at `start` of its text. Raises Spot."""
    quoted = _ESCAPED.match(line)
    if quoted and ("\\" in quoted["inner"] or is_literal(line)):
        return _string(quoted["inner"], start + quoted.start("inner"))
    data, at = bytearray(), 0
    while at < len(line):
        match = _TOKEN.match(line, at)
        if match is None:
            raise Spot(start + at, *_stranger(line[at]))
        group = next((name for name in _DIGITS if match[name]), None)
        if group is not None:
            following = line[match.end() : match.end() + 1] if group in ("plain", "p") else ""
            data += _bytes(match[group], start + match.start(group), following)
        at = match.end()
    return bytes(data)


def _bytes(digits: str, place: int, following: str) -> bytes:
    """Two digits to a byte; a single digit is a byte whose first digit is 0."""
    if following.isalnum():
        raise Spot(place + len(digits), *_stranger(following))
    if len(digits) == 1:
        return bytes([int(digits, 16)])
    if len(digits) % 2:
        byte = re.fullmatch("[01][0-9][0-9]|2[0-4][0-9]|25[0-5]", digits)
        decimal = f", and decimal {digits} is {int(digits):02X}" if byte else ""
        raise Spot(place, f"`{digits}` has {len(digits)} digits", f"a byte is two hexadecimal digits{decimal}")
    return bytes.fromhex(digits)


def _stranger(character: str) -> tuple[str, str]:
    meant = _LOOKALIKE.get(character)
    right = f"is the digit {meant} meant?" if meant else "bytes are written with 0 to 9 and A to F"
    shown = character if character.isprintable() else f"U+{ord(character):04X}"
    return f"`{shown}` is no hexadecimal digit", right


def _string(inner: str, start: int) -> bytes:
    """The bytes of a string as programming languages print it: what is not escaped means itself."""
    data, at = bytearray(), 0
    while at < len(inner):
        match = _INNER.match(inner, at)
        if match is None or (match["literal"] or " ") > "\x7e":
            raise Spot(start + at, f"`{inner[at : at + 2]}` is no byte of a string", r"write it as \x and two digits")
        if match["hex"]:
            data += bytes.fromhex(match["hex"])
        else:
            data.append(_SIGNS[match["sign"]] if match["sign"] else ord(match["literal"]))
        at = match.end()
    return bytes(data)
