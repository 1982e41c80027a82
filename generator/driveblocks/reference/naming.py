"""Names of outputs: an entry's symbol, else the words of its English name with capitals, run together."""

import re
from functools import lru_cache

from driveblocks.maps.model import Bit, Register, Value


def name_of(entry: Register | Bit | Value) -> str:
    """`DC bus voltage` -> `DCBusVoltage`."""
    return entry.symbol or _together(entry.name or "")


def word_pin(row: Register, address: int) -> str:
    """The pin that takes a register's word: `Status word` -> `StatusWord`, `Status` -> `StatusWord`.

    Of a value of 32 bits: `Output frequency` -> `OutputFrequencyHighWord`, `OutputFrequencyLowWord`.
    """
    halves = ("High", "Low") if row.order != "low_first" else ("Low", "High")
    half = halves[(address - row.address.first) % 2] if row.words == 2 else ""
    return f"{name_of(row).removesuffix('Word')}{half}Word"


@lru_cache(1024)
def _together(words: str) -> str:
    return re.sub(r"[^A-Za-z0-9]*([A-Za-z0-9])([A-Za-z0-9]*)[^A-Za-z0-9]*", _capital, words)


def _capital(match: re.Match[str]) -> str:
    return match[1].upper() + match[2]
