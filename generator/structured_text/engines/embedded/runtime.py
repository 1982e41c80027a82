"""The global namespace in which compiled ST runs: one function per operation that Python does not have itself.

Where the standard and C after matiec differ, a function raises FaultError rather than choose.
"""

import math
from collections.abc import Callable
from typing import Any

from structured_text.engines.embedded import integers, reals, spellings, strings, times
from structured_text.engines.embedded.faults import MARK, FaultError, below_bounds
from structured_text.engines.embedded.standard_blocks import Run
from structured_text.language.types import ELEMENTARY


def namespace(run: Run) -> dict[str, Any]:
    """A fresh namespace, bound to one clock."""
    table = {MARK: True, "__builtins__": {}, "run": run} | _OPERATIONS
    # Variables of ST are in upper case too, and must not hide a function of the same name.
    return {f"std_{name}" if name.isupper() else name: each for name, each in table.items()}


def _endless() -> None:
    raise FaultError("this scan has used up its budget of loop turns: the loop does not end")


def _aliased() -> None:
    raise FaultError("two in-outs of this call are the same variable: matiec copies them, others share them")


def _not_once(now: int, stop: int, step: int) -> None:
    once = now <= stop < now + step if step > 0 else now >= stop > now + step
    if once:
        raise FaultError("this FOR runs exactly once, and not at all on Beremiz' compiler: use WHILE")


def _whole_from_string(text: bytes, name: str, width: int, signed: bool) -> int:
    number = spellings.to_whole(text)
    if integers.wrap(number, width, signed) != number:
        raise FaultError(f"{number} does not fit {name}")
    return number


def _mux(which: int, _zero: Any, *inputs: Any) -> Any:
    if not 0 <= which < len(inputs):
        raise FaultError(f"MUX with K = {which}, but its inputs are 0..{len(inputs) - 1}")
    return inputs[which]


def _differing(text: str) -> Callable[..., Any]:
    def refuse(*_: Any) -> Any:
        raise FaultError(text)

    return refuse


def _careful_round(number: float, name: str, width: int, signed: bool) -> int:
    value = reals.nearest(number) if math.isfinite(number) else None
    return _fitting(number, value, integers.wrap(reals.c_nearest(number, signed), width, signed), name)


def _careful_cut(number: float, name: str, width: int, signed: bool) -> int:
    value = int(number) if math.isfinite(number) else None
    return _fitting(number, value, _c_cut(number, width, signed), name)


def _fitting(number: float, value: int | None, in_c: int, name: str) -> int:
    """An integer that fits its type and is the same in C. FaultError."""
    kind = ELEMENTARY[name]
    if value is None or not kind.low <= value <= kind.high:
        raise FaultError(f"{number!r} does not fit {name}; C makes it {in_c}: check the range as REAL first")
    if value != in_c:
        raise FaultError(f"{number!r} becomes {value} by the standard and {in_c} in C: round it first")
    return value


def _careful_limit(low: Any, value: Any, high: Any) -> Any:
    if low > high:
        raise FaultError(f"LIMIT with MN {low} above MX {high}: the standard gives MX, matiec gives MN")
    limited = min(max(value, low), high)
    if limited != ((value if value < high else high) if value > low else low):
        raise FaultError("LIMIT of or by NaN: compilers differ in which number they give")
    return limited


def _c_cut(number: float, width: int, signed: bool) -> int:
    """TRUNC: compilers convert through 32 bits what fits 32 bits signed, through 64 what is UDINT or wider."""
    if width == 64 and not signed:
        return reals.c_cut_unsigned_64(number) & ((1 << 64) - 1)
    register = 32 if width < 32 or (width == 32 and signed) else 64
    return integers.wrap(reals.c_cut(number, register), width, signed)


_SECONDS = _differing("a number as TIME, or a TIME as a number: seconds on matiec, milliseconds elsewhere")
_MOMENTS = _differing("a time as STRING, or a STRING as a time: every compiler writes it in its own way")
_BITS = _differing("a bit string or REAL as STRING: every compiler writes it in its own way")
_OPERATIONS: dict[str, Any] = {name: reals.guarded(name, each) for name, each in reals.MATHEMATICS.items()} | {
    "abs": abs, "float": float, "len": len, "max": max, "min": min, "setattr": setattr,
    "endless": _endless, "aliased": _aliased, "not_once": _not_once, "below_bounds": below_bounds,
    "single": reals.single, "whole_to_single": reals.whole_to_single, "power": reals.power,
    "agree": reals.agree, "agree_truth": reals.agree_truth,
    "round_to_whole": _careful_round, "cut_to_whole": _careful_cut, "limit": _careful_limit, "mux": _mux,
    "leaves_type": integers.leaves_type, "leaves_c": integers.leaves_c, "leaves_open": integers.leaves_open,
    "leaves_range": integers.leaves_range, "divide": integers.divide, "remainder": integers.remainder,
    "shift_left": integers.shift_left, "shift_right": integers.shift_right,
    "rotate_left": integers.rotate_left, "rotate_right": integers.rotate_right,
    "from_bcd": integers.from_bcd, "to_bcd": integers.to_bcd,
    "time_add": times.add, "time_subtract": times.subtract, "time_multiply": times.multiply,
    "time_divide": times.divide, "date_of": times.date_of, "time_of_day": times.time_of_day, "time_to_bool": bool,
    "time_from_number": _SECONDS, "time_to_whole": _SECONDS, "time_to_real": _SECONDS,
    "LEFT": strings.left, "RIGHT": strings.right, "MID": strings.mid, "CONCAT": strings.concat,
    "INSERT": strings.insert, "DELETE": strings.delete, "REPLACE": strings.replace, "FIND": strings.find,
    "string_order": strings.order, "string_from_bool": spellings.from_bool, "string_from_whole": spellings.from_whole,
    "string_to_bool": spellings.to_bool, "string_to_whole": _whole_from_string, "string_to_real": spellings.to_real,
    "string_from_time": _MOMENTS, "string_from_date": _MOMENTS, "string_to_time": _MOMENTS,
    "string_from_bits": _BITS, "string_from_real": _BITS,
}  # fmt: skip
"""Every operation by the name that the compiler writes; those of ST in upper case."""
