"""YAML's traps: plain words and digits that a YAML reader turns into something else than what was typed."""

import re
from collections.abc import Callable
from dataclasses import dataclass

_LONGEST = 64
"""Characters of the longest word that is taken for a trap; a longer one has no form that a map knows."""


@dataclass(frozen=True)
class Trap:
    """How a YAML reader reads a word, and what to write instead of it."""

    reading: str
    instead: Callable[[str], str]


def _quoted(text: str) -> str:
    return f'write "{text}" for a text; a number is written in plain decimal or with a trailing H'


def _truth(text: str) -> str:
    return f'write true or false where the key wants that, or "{text}" for a text'


def _nothing(text: str) -> str:
    return f'leave the key out, or write "{text}" for a text'


def _leading_zero(text: str) -> str:
    digits = text.lstrip("-+")
    if not digits.isdecimal():
        return _quoted(text)
    return f'write {int(digits)} for the number, {digits}H for hexadecimal, or "{text}" for a text'


def _hexadecimal(text: str) -> str:
    digits = text.lstrip("-+")[2:].upper()
    if not re.fullmatch(r"[0-9A-F]{1,4}", digits):
        return _quoted(text)
    return f'write {digits.zfill(4)}H for an address, {digits.zfill(2)}H for a number, or "{text}" for a text'


def _merge(_: str) -> str:
    return "write the keys out, so each line is complete"


_BOOLEAN = "YAML 1.1 reads it as TRUE or FALSE"
_TRAPS: tuple[tuple[str, str, Callable[[str], str]], ...] = (
    (r"(?i:yes|no|on|off|y|n)", _BOOLEAN, _truth),
    (r"(?!true|false)(?i:true|false)", _BOOLEAN, _truth),
    (r"~|(?i:null)", "YAML reads it as nothing at all", _nothing),
    (r"[-+]?0[0-7_]+", "YAML 1.1 reads it as an octal number", _leading_zero),
    (r"[-+]?0[0-9_]+", "some YAML readers take it as octal, some as decimal", _leading_zero),
    (r"[-+]?0o[0-7_]+", "YAML 1.2 reads it as an octal number", _quoted),
    (r"[-+]?0b[01_]+", "YAML 1.1 reads it as a binary number", _quoted),
    (r"[-+]?0[xX][0-9a-fA-F_]+", "YAML reads it as a number and the manual's digits are lost", _hexadecimal),
    (r"[-+]?[0-9][0-9_]*(?::[0-5]?[0-9])+(?:\.[0-9_]*)?", "YAML 1.1 reads it as a number to base 60", _quoted),
    (r"[-+]?(?:[0-9][0-9_]*\.?[0-9_]*|\.[0-9_]+)[eE][-+]?[0-9]+", "YAML reads it as a number with an exponent",
        _quoted),
    (r"[-+]?(?:\.[0-9_]+|[0-9][0-9_]*\.)", "YAML reads it as a number, though a digit is missing beside the point",
        _quoted),
    (r"[-+]?[0-9]+(?:_[0-9]*)+(?:\.[0-9_]*)?|[-+]?[0-9]+\.[0-9]*_[0-9_]*",
        "YAML 1.1 drops the underscore and reads a number", _quoted),
    (r"[-+]?\.(?i:inf)|\.(?i:nan)", "YAML reads it as infinity or not-a-number", _quoted),
    (r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}(?:[Tt ].*)?", "YAML reads it as a date", _quoted),
    (r"=", "YAML 1.1 reads it as the default value marker", _quoted),
    (r"<<", "it is YAML's merge key", _merge),
    (r"\+[0-9]+(?:\.[0-9]+)?", "YAML drops the plus sign", _quoted),
)  # fmt: skip
# one pattern with one group for each trap: a map has ten thousand plain words
_ANY = re.compile("|".join(f"({pattern})" for pattern, _, _ in _TRAPS))
_KNOWN = tuple(Trap(reading, instead) for _, reading, instead in _TRAPS)
_FIRST = frozenset("-+.~=<0123456789yYnNoOtTfF")


def find(text: str) -> Trap | None:
    """The trap that a plain word is, or None."""
    if text[:1] not in _FIRST or len(text) > _LONGEST:
        return None
    match = _ANY.fullmatch(text)
    return _KNOWN[match.lastindex - 1] if match is not None and match.lastindex is not None else None
