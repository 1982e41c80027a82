"""Conversions: every value of 8 bits and the edges of 16, every pair of integer types; reals with their rounding."""

import math
import struct

import pytest
from tests.structured_text.engines.embedded.snippets import FAULT, Row, assert_row, block, outcome

# Name -> (bits, signed).
INTEGERS = {
    "SINT": (8, True),
    "INT": (16, True),
    "DINT": (32, True),
    "LINT": (64, True),
    "USINT": (8, False),
    "UINT": (16, False),
    "UDINT": (32, False),
    "ULINT": (64, False),
    "BYTE": (8, False),
    "WORD": (16, False),
    "DWORD": (32, False),
    "LWORD": (64, False),
}


def cut(value: int, kind: str) -> int:
    """A value in two's complement, by `struct` rather than by arithmetic."""
    bits, signed = INTEGERS[kind]
    raw = (value % (1 << 64)).to_bytes(8, "little")[: bits // 8]
    return int.from_bytes(raw, "little", signed=signed)


def edges(kind: str) -> list[int]:
    """All values of 8 bits; around zero, the middle and both ends of the wider types."""
    bits, signed = INTEGERS[kind]
    low = -(1 << (bits - 1)) if signed else 0
    if bits == 8:
        return list(range(low, low + 256))
    middles = [0, 127, 128, 255, 256, 32767, 32768, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**63 - 1]
    around = {each + step for each in [low, low + (1 << bits) - 1, *middles] for step in (-2, -1, 0, 1, 2)}
    return sorted(each for each in around | {-each for each in around} if low <= each < low + (1 << bits))


@pytest.mark.parametrize("source", INTEGERS)
def test_integers_and_bit_strings_to_each_other(source: str) -> None:
    """The low bits: C casts exactly so, and the standard's overflow wraps."""
    targets = [each for each in INTEGERS if each != source]
    outputs = "".join(f"to_{each} : {each}; " for each in targets)
    body = "".join(f"to_{each} := {source}_TO_{each}(x);\n" for each in targets)
    made = block(f"VAR_INPUT x : {source}; END_VAR VAR_OUTPUT {outputs} END_VAR", body)
    for value in edges(source):
        made["x"] = value
        made.scan()
        assert {each: made[f"to_{each}"] for each in targets} == {each: cut(value, each) for each in targets}


@pytest.mark.parametrize("source", INTEGERS)
def test_integers_to_bool_and_reals(source: str) -> None:
    """REAL is rounded once from the integer, also from 64 bits."""
    body = f"q := {source}_TO_BOOL(x); r := {source}_TO_REAL(x); l := {source}_TO_LREAL(x); n := BOOL_TO_{source}(q);"
    declarations = f"VAR_INPUT x : {source}; END_VAR VAR_OUTPUT q : BOOL; r : REAL; l : LREAL; n : {source}; END_VAR"
    made = block(declarations, body)
    for value in edges(source):
        made["x"] = value
        made.scan()
        found = made["q"], made["r"], made["l"], made["n"]
        assert found == (value != 0, nearest_single(value), float(value), int(value != 0))


def nearest_single(value: int) -> float:
    """The single next to an integer, ties to even, found by looking at its neighbours."""
    rough: float = struct.unpack("<f", struct.pack("<f", float(value)))[0]
    bits: int = struct.unpack("<I", struct.pack("<f", rough))[0]
    candidates = [struct.unpack("<f", struct.pack("<I", bits + step))[0] for step in (-1, 0, 1) if bits + step >= 0]
    finite = [each for each in candidates if math.isfinite(each)]
    nearest: float = min(
        finite, key=lambda each: (abs(int(each) - value), struct.unpack("<I", struct.pack("<f", each))[0] & 1)
    )
    return nearest


def test_rounding_once_and_twice_differ() -> None:
    """The reference above does see the difference: to double and then to single would be 2**24 less."""
    value = (1 << 60) + (1 << 36) + 1
    twice: float = struct.unpack("<f", struct.pack("<f", float(value)))[0]
    assert nearest_single(value) != twice
    assert outcome("LINT_TO_REAL(n)", "REAL", "n : LINT;", {"n": value}) == nearest_single(value)


X = "r : REAL;"
Y = "l : LREAL;"
ROWS: list[Row] = [
    ("REAL_TO_INT(r)", "INT", X, {"r": 2.5}, 2, 2),
    ("REAL_TO_INT(r)", "INT", X, {"r": 3.5}, 4, 4),
    ("REAL_TO_INT(r)", "INT", X, {"r": -2.5}, -2, -2),
    ("REAL_TO_INT(r)", "INT", X, {"r": 0.5}, 0, 0),
    ("REAL_TO_INT(r)", "INT", X, {"r": -0.75}, -1, -1),
    ("REAL_TO_INT(r)", "INT", X, {"r": 32767.25}, 32767, 32767),
    ("REAL_TO_INT(r)", "INT", X, {"r": 40000.0}, -25536, FAULT),
    ("REAL_TO_INT(r)", "INT", X, {"r": math.nan}, 0, FAULT),
    ("REAL_TO_INT(r)", "INT", X, {"r": math.inf}, 0, FAULT),
    ("REAL_TO_LINT(r)", "LINT", X, {"r": math.nan}, -(2**63), FAULT),
    ("REAL_TO_DINT(r)", "DINT", X, {"r": 3e9}, -1294967296, FAULT),
    ("REAL_TO_UINT(r)", "UINT", X, {"r": -5.0}, 0, FAULT),
    ("REAL_TO_UINT(r)", "UINT", X, {"r": -0.25}, 0, 0),
    ("REAL_TO_WORD(r)", "WORD", X, {"r": 65536.0}, 0, FAULT),
    ("REAL_TO_BOOL(r)", "BOOL", X, {"r": 0.25}, True, True),
    ("REAL_TO_BOOL(r)", "BOOL", X, {"r": -0.0}, False, False),
    # Adding a half loses the last bit of large numbers: matiec rounds them to even ones.
    ("LREAL_TO_LINT(l)", "LINT", Y, {"l": 4503599627370497.0}, 4503599627370498, FAULT),
    ("TRUNC(r)", "INT", X, {"r": 2.75}, 2, 2),
    ("TRUNC(r)", "INT", X, {"r": -2.75}, -2, -2),
    ("TRUNC(r)", "INT", X, {"r": 1e10}, 0, FAULT),
    ("TRUNC(r)", "DINT", X, {"r": math.nan}, -(2**31), FAULT),
    ("LREAL_TO_REAL(l)", "REAL", Y, {"l": 1e300}, math.inf, math.inf),
    ("LREAL_TO_REAL(l)", "REAL", Y, {"l": 0.1}, 0.10000000149011612, 0.10000000149011612),
    ("REAL_TO_LREAL(r)", "LREAL", X, {"r": 0.5}, 0.5, 0.5),
    # Numbers as TIME: milliseconds nearly everywhere, seconds on matiec.
    ("DINT_TO_TIME(n)", "TIME", "n : DINT;", {"n": 7}, 7_000_000_000, FAULT),
    ("TIME_TO_DINT(t)", "DINT", "t : TIME;", {"t": 7_500_000_000}, 7, FAULT),
    ("TIME_TO_REAL(t)", "REAL", "t : TIME;", {"t": 7_500_000_000}, 7.5, FAULT),
    # BCD.
    ("WORD_BCD_TO_UINT(w)", "UINT", "w : WORD;", {"w": 0x1234}, 1234, 1234),
    ("WORD_BCD_TO_UINT(w)", "UINT", "w : WORD;", {"w": 0x12A4}, 0, FAULT),
    ("UINT_TO_BCD_WORD(u)", "WORD", "u : UINT;", {"u": 9876}, 0x9876, 0x9876),
    ("UINT_TO_BCD_WORD(u)", "WORD", "u : UINT;", {"u": 12345}, 0x2345, FAULT),
    # Strings.
    ("INT_TO_STRING(i)", "STRING", "i : INT;", {"i": -12}, b"-12", b"-12"),
    ("BOOL_TO_STRING(q)", "STRING", "q : BOOL;", {"q": True}, b"TRUE", b"TRUE"),
    ("WORD_TO_STRING(w)", "STRING", "w : WORD;", {"w": 0xAB}, b"16#ab", FAULT),
    ("REAL_TO_STRING(r)", "STRING", X, {"r": 0.5}, b"0.5", FAULT),
    ("STRING_TO_INT(s)", "INT", "s : STRING;", {"s": b"-1234"}, -1234, -1234),
    ("STRING_TO_INT(s)", "INT", "s : STRING;", {"s": b"-1_234"}, -1, FAULT),
    ("STRING_TO_INT(s)", "INT", "s : STRING;", {"s": b"12x"}, 12, FAULT),
    ("STRING_TO_WORD(s)", "WORD", "s : STRING;", {"s": b"16#aB"}, 0xAB, 0xAB),
    ("STRING_TO_BOOL(s)", "BOOL", "s : STRING;", {"s": b"true"}, True, True),
    ("STRING_TO_BOOL(s)", "BOOL", "s : STRING;", {"s": b"yes"}, False, FAULT),
    ("STRING_TO_REAL(s)", "REAL", "s : STRING;", {"s": b"-0.75"}, -0.75, -0.75),
]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]} {row[3]}")
def test_reals_times_and_strings(row: Row) -> None:
    """One row: what C makes of it, or a fault."""
    assert_row(row)


def test_real_to_int_rounds_halves_to_even() -> None:
    """Every quarter from -300 to 300, against Python's own `round`."""
    made = block(
        "VAR_INPUT r : REAL; END_VAR VAR_OUTPUT i : INT; c : INT; END_VAR", "i := REAL_TO_INT(r); c := TRUNC(r);"
    )
    for number in range(-1200, 1201):
        made["r"] = number / 4
        made.scan()
        assert (made["i"], made["c"]) == (round(number / 4), math.trunc(number / 4))
