"""Names in Structured Text: identifiers made from English names, and what no compiler takes for one."""

import re

from driveblocks.maps.model import Bit, Register, Value
from structured_text.language.names import reserved, reserved_outside

MAX_LENGTH = 31
"""Longest identifier that every target takes."""

UNIT_NAMES = {
    "Hz": "Hz", "A": "A", "V": "V", "kW": "KW", "W": "W", "%": "Percent", "r/min": "Rpm", "Nm": "Nm", "s": "S",
    "ms": "Ms", "h": "H", "°C": "DegC", "kHz": "KHz", "Ohm": "Ohm", "kWh": "KWh",
}  # fmt: skip
"""A unit as the last part of a name."""

_WORD = re.compile(r"[A-Za-z0-9]+")


def pascal(name: str) -> str:
    """`Output frequency` -> `OutputFrequency`; acronyms stay as written: `DC bus voltage` -> `DCBusVoltage`."""
    return "".join(word[0].upper() + word[1:] for word in _WORD.findall(name))


def symbol(entry: Register | Bit | Value) -> str:
    """The identifier of an entry: its own symbol, or the one made from its name."""
    return entry.symbol or pascal(entry.name or "")


def block(prefix: str, name: str) -> str:
    return f"{prefix}_{name}"


def word_pin(row: Register, address: int) -> str:
    """The input that takes a register's word: of a value of 32 bits the high or the low one."""
    return f"{symbol(row).removesuffix('Word')}{_half(row, address)}Word"


def _half(row: Register, address: int) -> str:
    if row.words is None:
        return ""
    second = (address - row.address.first) % row.words == 1
    return "Low" if second != (row.order == "low_first") else "High"


def wrong_symbol(entry: Register | Bit | Value) -> str | None:
    """Why an entry's name makes no identifier, or None."""
    if entry.symbol:
        return None
    if not entry.name:
        return "this becomes part of a block and has no name"
    for letter in entry.name:
        if letter.isalnum() and not letter.isascii():
            return f"`{entry.name}` holds {letter}, which no identifier can"
    return None if symbol(entry)[:1].isalpha() else f"`{entry.name}` cannot become an identifier"


def wrong_pin(made: str) -> str | None:
    """Why a variable cannot have a name, or None."""
    return _wrong(made, reserved(made))


def wrong_block(made: str) -> str | None:
    """Why a block cannot have a name, or None."""
    return _wrong(made, reserved_outside(made))


def _wrong(made: str, why: str | None) -> str | None:
    if len(made) > MAX_LENGTH:
        return f"has {len(made)} characters, and some compilers take no more than {MAX_LENGTH}"
    return f"is {why}" if why else None
