"""Names of outputs: an entry's symbol, else the words of its English name with capitals, run together."""

import re

from driveblocks.maps.model import Bit, Register, Value


def name_of(entry: Register | Bit | Value) -> str:
    """`DC bus voltage` -> `DCBusVoltage`."""
    return entry.symbol or re.sub(r"[^A-Za-z0-9]*([A-Za-z0-9])([A-Za-z0-9]*)[^A-Za-z0-9]*", _capital, entry.name or "")


def word_pin(row: Register) -> str:
    """The pin that takes a register's word: `Status word` -> `StatusWord`, `Status` -> `StatusWord`."""
    return f"{name_of(row).removesuffix('Word')}Word"


def _capital(match: re.Match[str]) -> str:
    return match[1].upper() + match[2]
