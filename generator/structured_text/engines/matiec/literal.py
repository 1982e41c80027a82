"""The value of a literal, for the defaults of function parameters: C knows no defaults."""

import re

from structured_text.engines.engine import EngineError, Value
from structured_text.engines.matiec.declarations import integer

_MS = 1_000_000
_NANOSECONDS = {"d": 86_400_000 * _MS, "h": 3_600_000 * _MS, "m": 60_000 * _MS, "s": 1_000 * _MS, "ms": _MS}
_DURATION = re.compile(r"(-?)((?:\d[\d_]*(?:\.\d+)?(?:ms|[dhms])_?)+)", re.IGNORECASE)
_PART = re.compile(r"([\d_]+(?:\.\d+)?)(ms|[dhms])", re.IGNORECASE)
_STRING_ESCAPES = {"$$": b"$", "$'": b"'", "$L": b"\n", "$N": b"\n", "$P": b"\f", "$R": b"\r", "$T": b"\t"}
_ESCAPE = re.compile(r"\$[0-9A-F]{2}|\$.|[^$]", re.IGNORECASE)


def constant(text: str) -> Value:
    """Read `TRUE`, `BYTE#16#FF`, `-5`, `1.5E3`, `T#1s500ms` or `'abc$0D'`. Raises EngineError for anything else."""
    plain = text.strip()
    if plain.upper().removeprefix("BOOL#") in ("TRUE", "FALSE"):
        return plain.upper().endswith("TRUE")
    if plain.startswith("'"):
        return b"".join(_character(each) for each in _ESCAPE.findall(plain[1:-1]))
    prefix, _, rest = plain.rpartition("#")
    try:
        if prefix.upper() in ("T", "TIME"):
            return _duration(rest)
        if "16#" not in plain and ("." in rest or "E" in rest.upper()):
            return float(rest.replace("_", ""))
        return integer(plain)
    except ValueError as error:
        raise EngineError(f"{text} as the default of a parameter cannot be read here; give the argument") from error


def _character(text: str) -> bytes:
    if len(text) == 3:
        return bytes([int(text[1:], 16)])
    return _STRING_ESCAPES.get(text.upper(), text.encode("latin-1", "replace"))


def _duration(text: str) -> int:
    match = _DURATION.fullmatch(text)
    if match is None:
        raise ValueError(text)
    parts = _PART.findall(match[2])
    total = sum(round(float(number.replace("_", "")) * _NANOSECONDS[unit.lower()]) for number, unit in parts)
    return -total if match[1] else total
