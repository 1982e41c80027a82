"""The global namespace in which compiled ST runs: one function per operation that Python does not have itself.

The names are the same in every model; what stands behind them is the model's.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from driveblocks.host.embedded import integers, reals, spellings, strings, times
from driveblocks.host.embedded.faults import MARK, FaultError, below_bounds
from driveblocks.host.embedded.standard_blocks import Run
from driveblocks.host.engine import Overflow
from driveblocks.st.types import ELEMENTARY

_SECOND = times.SECOND
_MILLISECOND = 1_000_000


def namespace(model: Overflow, line: str, run: Run) -> dict[str, Any]:
    """A fresh namespace of a model, bound to one clock."""
    table = {MARK: True, "__builtins__": {}, "run": run}
    table |= _COMMON
    table |= {"standard": _standard, "fail": _careful, "c": _c}[model]()
    if line == "openplc":
        table |= {"string_order": _openplc_order, "FIND": strings.openplc_find}
        table |= {"string_max": _openplc_greatest, "string_min": _openplc_least, "string_limit": _openplc_limit}
    # Variables of ST are in upper case too, and must not hide a function of the same name.
    return {f"std_{name}" if name.isupper() else name: each for name, each in table.items()}


# ------------------------------------------------------------ all models


def _endless() -> None:
    raise FaultError("this scan has used up its budget of loop turns: the loop does not end")


def _aliased() -> None:
    raise FaultError("two in-outs of this call are the same variable: matiec copies them, others share them")


def _not_once(now: int, stop: int, step: int) -> None:
    once = now <= stop < now + step if step > 0 else now >= stop > now + step
    if once:
        raise FaultError("this FOR runs exactly once, and not at all on Beremiz' compiler: use WHILE")


def _whole_from_string(read: Callable[[bytes], int], strict: bool) -> Callable[..., int]:
    def convert(text: bytes, name: str, width: int, signed: bool) -> int:
        number = read(text)
        kept = integers.wrap(number, width, signed)
        if strict and kept != number:
            raise FaultError(f"{number} does not fit {name}")
        return kept

    return convert


_COMMON: dict[str, Any] = {
    "abs": abs,
    "float": float,
    "len": len,
    "max": max,
    "min": min,
    "setattr": setattr,
    "single": reals.single,
    "whole_to_single": reals.whole_to_single,
    "agree": reals.agree,
    "agree_truth": reals.agree_truth,
    "divide_real": reals.divide,
    "below_bounds": below_bounds,
    "leaves_type": integers.leaves_type,
    "leaves_c": integers.leaves_c,
    "leaves_open": integers.leaves_open,
    "leaves_range": integers.leaves_range,
    "divide": integers.divide,
    "remainder": integers.remainder,
    "remainder_or_zero": integers.remainder_or_zero,
    "c_divide": integers.c_divide,
    "c_remainder": integers.c_remainder,
    "from_bcd": integers.from_bcd,
    "to_bcd": integers.to_bcd,
    "string_from_bool": spellings.from_bool,
    "string_from_whole": spellings.from_whole,
    "endless": _endless,
    "aliased": _aliased,
    "not_once": _not_once,
}


# ------------------------------------------------------------ the standard


def _standard() -> dict[str, Any]:
    table: dict[str, Any] = {name: reals.guarded(name, each) for name, each in reals.MATHEMATICS.items()}
    table |= {
        "power": reals.power,
        "round_to_whole": _standard_round,
        "cut_to_whole": _standard_cut,
        "shift_left": integers.shift_left,
        "shift_right": integers.shift_right,
        "rotate_left": integers.careful_rotate_left,
        "rotate_right": integers.careful_rotate_right,
        "limit": _limit,
        "mux": _mux,
    }
    table |= {"LEFT": strings.left, "RIGHT": strings.right, "MID": strings.mid, "CONCAT": strings.concat}
    table |= {"INSERT": strings.insert, "DELETE": strings.delete, "REPLACE": strings.replace, "FIND": strings.find}
    table |= {"string_from_bits": spellings.from_bits, "string_from_real": spellings.from_real}
    table |= {"string_to_bool": spellings.to_bool, "string_to_real": spellings.to_real}
    table |= {"string_to_whole": _whole_from_string(spellings.to_whole, True)}
    table |= _plain_times()
    return table


def _standard_round(number: float, _name: str, width: int, signed: bool) -> int:
    return integers.wrap(reals.nearest(number), width, signed)


def _standard_cut(number: float, _name: str, width: int, signed: bool) -> int:
    if not math.isfinite(number):
        raise FaultError(f"{number} has no integer value")
    return integers.wrap(int(number), width, signed)


def _limit(low: Any, value: Any, high: Any) -> Any:
    return min(max(value, low), high)


def _mux(which: int, _zero: Any, *inputs: Any) -> Any:
    if not 0 <= which < len(inputs):
        raise FaultError(f"MUX with K = {which}, but its inputs are 0..{len(inputs) - 1}")
    return inputs[which]


def _plain_times() -> dict[str, Any]:
    """Times as nanoseconds; numbers are milliseconds, as on most controllers."""
    return {
        "time_add": int.__add__,
        "time_subtract": int.__sub__,
        "time_multiply": times.multiply,
        "time_divide": times.divide,
        "date_of": times.date_of,
        "time_of_day": times.time_of_day,
        "time_from_number": lambda number: round(number * _MILLISECOND),
        "time_to_whole": lambda span: int(span / _MILLISECOND) if span < 0 else span // _MILLISECOND,
        "time_to_real": lambda span: span / _MILLISECOND,
        "time_to_bool": bool,
        "string_from_time": lambda span: spellings.from_time(*times.pair(span)),
        "string_from_date": lambda span, kind: spellings.from_date(kind, *times.pair(span)),
        "string_to_time": _to_time,
    }


def _to_time(text: bytes, kind: str) -> int:
    """STRING_TO_TIME of a literal; a STRING as a date is not implemented. FaultError."""
    if kind != "TIME":
        raise FaultError(f"this engine does not read {kind} from a STRING")
    return times.parsed(text.decode("latin-1"))


# ------------------------------------------------------------ fail where the standard and C can differ


def _careful() -> dict[str, Any]:
    table = _standard()
    table |= {
        "round_to_whole": _careful_round,
        "cut_to_whole": _careful_cut,
        "shift_left": integers.careful_shift_left,
        "shift_right": integers.careful_shift_right,
        "limit": _careful_limit,
        "string_order": strings.careful_order,
        "string_to_whole": _whole_from_string(spellings.careful_to_whole, True),
        "string_to_real": spellings.careful_to_real,
        "REPLACE": strings.careful_replace,
        "FIND": strings.careful_find,
        "time_add": times.careful_add,
        "time_subtract": times.careful_subtract,
        "time_multiply": times.careful_multiply,
        "time_divide": times.careful_divide,
    }
    seconds = "a number as TIME, or a TIME as a number: seconds on matiec, milliseconds elsewhere"
    for name in ("time_from_number", "time_to_whole", "time_to_real"):
        table[name] = _differing(seconds)
    for name in ("string_from_time", "string_from_date", "string_to_time"):
        table[name] = _differing("a time as STRING, or a STRING as a time: every compiler writes it in its own way")
    for name in ("string_from_bits", "string_from_real"):
        table[name] = _differing("a bit string or REAL as STRING: every compiler writes it in its own way")
    return table


def _differing(text: str) -> Callable[..., Any]:
    def refuse(*_: Any) -> Any:
        raise FaultError(text)

    return refuse


def _careful_round(number: float, name: str, width: int, signed: bool) -> int:
    value = reals.nearest(number) if math.isfinite(number) else None
    return _fitting(number, value, _c_round(number, name, width, signed), name)


def _careful_cut(number: float, name: str, width: int, signed: bool) -> int:
    value = int(number) if math.isfinite(number) else None
    return _fitting(number, value, _c_cut(number, name, width, signed), name)


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
    return min(max(value, low), high)


# ------------------------------------------------------------ C


def _c() -> dict[str, Any]:
    table: dict[str, Any] = {name: reals.c_function(name, each) for name, each in reals.MATHEMATICS.items()}
    table |= {
        "c_abs": reals.c_abs,
        "power": reals.c_power,
        "round_to_whole": _c_round,
        "cut_to_whole": _c_cut,
        "shift_left": integers.c_shift_left,
        "shift_right": integers.c_shift_right,
        "rotate_left": integers.rotate_left,
        "rotate_right": integers.rotate_right,
        "limit": _c_limit,
        "mux": _c_mux,
    }
    table |= {"LEFT": strings.c_left, "RIGHT": strings.c_right, "MID": strings.c_mid, "CONCAT": strings.c_concat}
    table |= {"INSERT": strings.c_insert, "DELETE": strings.c_delete, "REPLACE": strings.c_replace}
    table |= {"FIND": strings.c_find, "string_order": strings.order}
    table |= {"string_from_bits": spellings.c_from_bits, "string_from_real": spellings.c_from_real}
    table |= {"string_to_bool": spellings.c_to_bool, "string_to_real": spellings.c_to_real}
    table |= {"string_to_whole": _whole_from_string(spellings.c_to_whole, False)}
    table |= _c_times()
    return table


def _c_round(number: float, _name: str, width: int, signed: bool) -> int:
    return integers.wrap(reals.c_nearest(number, signed), width, signed)


def _c_cut(number: float, _name: str, width: int, signed: bool) -> int:
    """TRUNC: compilers convert through 32 bits what fits 32 bits signed, through 64 what is UDINT or wider."""
    if width == 64 and not signed:
        return reals.c_cut_unsigned_64(number) & ((1 << 64) - 1)
    register = 32 if width < 32 or (width == 32 and signed) else 64
    return integers.wrap(reals.c_cut(number, register), width, signed)


def _c_limit(low: Any, value: Any, high: Any) -> Any:
    return (value if value < high else high) if value > low else low


def _c_mux(which: int, zero: Any, *inputs: Any) -> Any:
    return inputs[which] if 0 <= which < len(inputs) else zero


def _c_times() -> dict[str, Any]:
    """Times as pairs; numbers are seconds."""
    return {
        "time_add": times.c_add,
        "time_subtract": times.c_subtract,
        "time_multiply": times.c_multiply,
        "time_divide": times.c_divide,
        "time_order": times.c_order,
        "time_min": times.c_least,
        "time_max": times.c_greatest,
        "time_limit": times.c_limit,
        "date_of": times.c_date_of,
        "time_of_day": times.c_time_of_day,
        "time_from_number": times.c_from_number,
        "time_to_whole": lambda span: span[0],
        "time_to_real": lambda span: float(span[0]) + span[1] / _SECOND,
        "time_to_bool": lambda span: span[0] != 0 or span[1] != 0,
        "string_from_time": lambda span: spellings.c_from_time(*span),
        "string_from_date": lambda span, kind: spellings.from_date(kind, *span),
        "string_to_time": lambda text, _: times.Span(int(spellings.c_to_real(text)), 0),
    }


def _openplc_order(left: bytes, right: bytes) -> int:
    """Compare no more characters than the shorter one has."""
    shorter = min(len(left), len(right))
    return strings.order(left[:shorter], right[:shorter])


def _openplc_greatest(first: bytes, *others: bytes) -> bytes:
    for each in others:
        first = each if _openplc_order(first, each) < 0 else first
    return first


def _openplc_least(first: bytes, *others: bytes) -> bytes:
    for each in others:
        first = each if _openplc_order(first, each) > 0 else first
    return first


def _openplc_limit(low: bytes, value: bytes, high: bytes) -> bytes:
    if _openplc_order(value, low) <= 0:
        return low
    return value if _openplc_order(value, high) < 0 else high
