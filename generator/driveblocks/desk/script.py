"""What a person, or a script in their place, sets in a running program: `at 2.5s: Start1 := TRUE`."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import isfinite

from driveblocks.maps.problem import Refused
from structured_text.engines.engine import Instance, Message, Value

_UNITS = {"ms": 1_000, "s": 1_000_000, "min": 60_000_000}
_TIME = re.compile(r"([0-9]{1,12}(?:\.[0-9]{1,12})?)\s*(ms|s|min)")
_LINE = re.compile(r"at\s+(?P<time>[^:]*?)\s*:(?P<rest>.*)", re.IGNORECASE)
_SETTING = re.compile(r"\s*(?P<name>[A-Za-z_][\w.\[\],]*)\s*:=\s*(?P<value>.*?)\s*")
_COMMENT = re.compile(r"(?<!\S)#")
"""A number sign that begins a word; in 16#FF it does not."""
_WHOLE = re.compile(r"[-+]?\d+|(?P<base>16|8|2)#(?P<digits>[0-9A-Fa-f_]+)")


@dataclass(frozen=True)
class Setting:
    """A variable, its new value, and when."""

    name: str
    value: Value
    at_us: int = 0


def duration_us(text: str) -> int:
    """`60s`, `10ms`, `2.5 s`, `1min` in microseconds. Raises ValueError, which says what would be right."""
    found = _TIME.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"`{text}` is no time; write 10ms, 2.5s or 1min")
    return round(float(found[1]) * _UNITS[found[2]])


def read(path: str, text: str, program: Instance) -> list[Setting]:
    """A script in the order of its times; `#` begins a comment. Raises Refused with everything that is wrong."""
    settings: list[Setting] = []
    wrong: list[Message] = []
    for number, line in enumerate(text.splitlines(), 1):
        bare = _COMMENT.split(line)[0]
        if not bare.strip():
            continue
        settings += _line(bare, program, partial(Message, path, number), wrong)
    if wrong:
        raise Refused("\n".join(map(str, wrong)))
    return sorted(settings, key=lambda each: each.at_us)


def _line(line: str, program: Instance, at: Callable[[int, str], Message], wrong: list[Message]) -> Iterator[Setting]:
    """What a line sets; its first mistake is added to `wrong`, `at` its column."""
    column = len(line) - len(line.lstrip())
    found = _LINE.fullmatch(line.strip())
    if found is None:
        wrong.append(at(column + 1, "this is no step; write: at 2.5s: NAME := VALUE"))
        return
    place = column + found.start("time")
    try:
        at_us = duration_us(found["time"])
        column += found.start("rest")
        for part in found["rest"].split(";"):
            place = column + len(part) - len(part.lstrip())
            if part.strip():
                yield setting(part, program, at_us)
            column += len(part) + 1
    except ValueError as error:
        wrong.append(at(place + 1, str(error)))


def setting(text: str, program: Instance, at_us: int = 0) -> Setting:
    """`NAME := VALUE` of a variable of the program. Raises ValueError, which says what would be right."""
    found = _SETTING.fullmatch(text)
    if found is None:
        raise ValueError(f"`{text.strip()}` sets nothing; write NAME := VALUE")
    name = found["name"]
    try:
        old = program[name]
    except KeyError:
        raise ValueError(f"the program has no variable {name}") from None
    value = _value(found["value"], old, name)
    program[name] = value
    program[name] = old
    return Setting(name, value, at_us)


def _value(text: str, old: Value, name: str) -> Value:
    word = text.upper()
    if isinstance(old, bool):
        if word not in ("TRUE", "FALSE", "1", "0"):
            raise ValueError(f"{name} is a BOOL; write TRUE or FALSE, not `{text}`")
        return word in ("TRUE", "1")
    whole = _WHOLE.fullmatch(word)
    if isinstance(old, int) and whole:
        return int(whole["digits"].replace("_", ""), int(whole["base"])) if whole["base"] else int(word)
    if isinstance(old, float) and re.fullmatch(r"[-+]?\d+(\.\d+)?(E[-+]?\d+)?", word) and isfinite(float(word)):
        return float(word)
    if isinstance(old, int | float):
        kind = "a whole number" if isinstance(old, int) else "a number"
        raise ValueError(f"{name} takes {kind}, not `{text}`")
    raise ValueError(f"{name} is no BOOL and no number; set one of its members")
