"""REAL is rounded to single precision after every operation; where C keeps doubles, it fails."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.structured_text.engines.embedded.snippets import FAULT, block, evaluate, fault, outcome

from structured_text.engines.embedded import EmbeddedEngine, reals
from structured_text.engines.engine import Source, Value

INPUTS = "a, b : REAL;"
SINGLES = st.floats(width=32, allow_nan=False, allow_infinity=False)


def packed(number: float) -> float:
    """Round to single precision by the C library's conversion inside `struct`; infinity where that refuses."""
    try:
        near: float = struct.unpack("<f", struct.pack("<f", number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)
    return near


@given(st.floats(allow_nan=False))
def test_single_is_what_struct_rounds_to(number: float) -> None:
    """Including subnormal results, ties and overflow."""
    assert reals.single(number) == packed(number)


@given(SINGLES, SINGLES)
def test_every_operation_is_rounded_once(a: float, b: float) -> None:
    """Sum, difference and product of singles, rounded from a double, are what single precision gives."""
    made = ARITHMETIC
    made["a"], made["b"] = a, b
    made.scan()
    assert (made["sum_"], made["less"], made["times"]) == (packed(a + b), packed(a - b), packed(a * b))


ARITHMETIC = block(
    "VAR_INPUT a, b : REAL; END_VAR VAR_OUTPUT sum_, less, times : REAL; END_VAR",
    "sum_ := a + b; less := a - b; times := a * b;",
)

# Expression, a, b, and the results in C and here.
ROWS: list[tuple[str, float, float, Value, Value]] = [
    # One operation with a literal that a single holds exactly: rounding a double is the same.
    ("a * 0.5", 3.0, 0.0, 1.5, 1.5),
    ("a / 10.0", 1.0, 0.0, packed(0.1), packed(0.1)),
    # 0.1 is no single: C multiplies with the double.
    ("a * 0.1", 9.0, 0.0, packed(9.0 * 0.1), FAULT),
    ("a * 0.1", 0.0, 0.0, 0.0, 0.0),
    ("a * REAL#0.1", 3.0, 0.0, packed(3.0 * packed(0.1)), packed(3.0 * packed(0.1))),
    # Two operations: C rounds only at the store once a double is in it.
    ("a * 10.0 / 3.0", packed(0.1), 0.0, packed(packed(0.1) * 10.0 / 3.0), packed(packed(0.1) * 10.0 / 3.0)),
    ("(a + b) - a", 16777216.0, 1.0, 0.0, 0.0),
    ("(a + 1.0) - a", 16777216.0, 0.0, 1.0, FAULT),
    # Division by zero.
    ("a / b", 1.0, 0.0, math.inf, FAULT),
    ("a / b", -1.0, 0.0, -math.inf, FAULT),
    ("a * b", 3e38, 10.0, math.inf, math.inf),
    # Functions.
    ("SQRT(a)", 2.0, 0.0, packed(math.sqrt(2.0)), packed(math.sqrt(2.0))),
    ("LN(a)", 2.0, 0.0, packed(math.log(2.0)), packed(math.log(2.0))),
    ("LOG(a)", 2.0, 0.0, packed(math.log10(2.0)), packed(math.log10(2.0))),
    ("EXP(a)", 1.5, 0.0, packed(math.exp(1.5)), packed(math.exp(1.5))),
    ("SIN(a)", 1.5, 0.0, packed(math.sin(1.5)), packed(math.sin(1.5))),
    ("COS(a)", 1.5, 0.0, packed(math.cos(1.5)), packed(math.cos(1.5))),
    ("TAN(a)", 1.5, 0.0, packed(math.tan(1.5)), packed(math.tan(1.5))),
    ("ASIN(a)", 0.5, 0.0, packed(math.asin(0.5)), packed(math.asin(0.5))),
    ("ACOS(a)", 0.5, 0.0, packed(math.acos(0.5)), packed(math.acos(0.5))),
    ("ATAN(a)", 0.5, 0.0, packed(math.atan(0.5)), packed(math.atan(0.5))),
    ("LN(a)", 0.0, 0.0, -math.inf, FAULT),
    ("EXPT(a, b)", 2.0, 10.0, 1024.0, 1024.0),
    ("a ** b", 2.0, 0.5, packed(math.sqrt(2.0)), packed(math.sqrt(2.0))),
    ("EXPT(a, b)", 0.0, -1.0, math.inf, FAULT),
    ("MAX(a, b, 2.5)", 1.0, 2.0, 2.5, 2.5),
    ("LIMIT(0.0, a, b)", 5.0, 2.0, 2.0, 2.0),
    ("LIMIT(b, a, 1.0)", 0.0, 2.0, 2.0, FAULT),
    ("LIMIT(0.0, a, b)", 5.0, math.nan, math.nan, FAULT),
    ("LIMIT(b, a, 9.0)", 5.0, math.nan, math.nan, FAULT),
    ("LIMIT(0.0, b, 9.0)", 5.0, math.nan, 0.0, FAULT),
]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]} {row[1]}")
def test_each_row(row: tuple[str, float, float, Value, Value]) -> None:
    """One row: what C makes of it, or a fault."""
    expression, a, b, c, here = row
    assert outcome(expression, "REAL", INPUTS, {"a": a, "b": b}) == here
    assert here in (c, FAULT)


def test_comparisons_in_double_and_in_single() -> None:
    """The value of a literal that is no single: equal to a variable that holds it only in single precision."""
    assert outcome("a = 0.1", "BOOL", INPUTS, {"a": 0.1}) == FAULT
    assert evaluate("a > 0.1", "BOOL", INPUTS, a=0.25) is True


def test_the_fault_says_what_to_write() -> None:
    """A message that a person can act on."""
    assert "REAL#0.1" in fault("a * 0.1", "REAL", INPUTS, a=9.0)


def test_lreal_is_python_s_float() -> None:
    """Nothing is rounded, and literals are doubles in C as well."""
    assert evaluate("x * 0.1 + 0.2", "LREAL", "x : LREAL;", x=3.0) == 3.0 * 0.1 + 0.2


def test_constants_are_singles() -> None:
    """A VAR CONSTANT of type REAL holds the rounded literal, in C as well: the portable way to scale."""
    declarations = "VAR_INPUT a : REAL; END_VAR VAR_OUTPUT y : REAL; END_VAR VAR CONSTANT K : REAL := 0.01; END_VAR"
    made = block(declarations, "y := a * K;")
    made["a"] = 12345.0
    made.scan()
    assert made["y"] == packed(12345.0 * packed(0.01))


def test_nan_compares_unequal() -> None:
    """Not even to itself."""
    assert evaluate("a = a", "BOOL", INPUTS, a=math.nan) is False
    assert evaluate("a <> a", "BOOL", INPUTS, a=math.nan) is True
    assert evaluate("(a < 1.0) OR (a >= 1.0)", "BOOL", INPUTS, a=math.nan) is False


# Expression, a, b, and what a C program of floats prints by "%.9g": every literal is one (27648.0f), SQRT is sqrtf.
IN_FLOATS = [
    ("a / 27648.0", 13824.0, 0.0, "0.5"),
    ("a / 27648.0 * 50.0", 12345.0, 0.0, "22.325304"),
    ("a * 0.01", 12345.0, 0.0, "123.449997"),
    ("a * 0.1 + b * 0.2", 12345.0, 3.0, "1235.09998"),
    ("(a * 0.1 - b) / 0.3", 12345.0, 3.0, "4105"),
    ("(a + 1.0) - a", 16777216.0, 0.0, "0"),
    ("a / b * 100.0 / 1.1", 12345.0, 27648.0, "40.5914612"),
    ("-a * 0.1", 12345.0, 0.0, "-1234.5"),
    ("a * 1.0E-3 * 1.0E-3", 12345.0, 0.0, "0.0123450011"),
    ("0.1 + 0.2", 0.0, 0.0, "0.300000012"),
    ("1.0 / 3.0", 0.0, 0.0, "0.333333343"),
    ("SQRT(a * 0.1)", 2.0, 0.0, "0.44721359"),
    ("a ** 0.1", 2.0, 0.0, "1.07177341"),
    ("SEL(a = 0.1, 0.0, 1.0)", 0.1, 0.0, "1"),
    ("SEL(a * 3.0 = 0.3, 0.0, 1.0)", 0.1, 0.0, "1"),
    ("SEL(a > 0.1, 0.0, 1.0)", 0.1, 0.0, "0"),
]


@pytest.mark.parametrize("row", IN_FLOATS, ids=lambda row: row[0])
def test_a_plc_computes_in_floats(row: tuple[str, float, float, str]) -> None:
    """Where nothing is compared with C's doubles, each operation is rounded to single precision, and none fails."""
    expression, a, b, printed = row
    text = f"VAR_INPUT {INPUTS} END_VAR VAR_OUTPUT y : REAL; END_VAR y := {expression};"
    source = Source("test.st", f"FUNCTION_BLOCK Test {text} END_FUNCTION_BLOCK")
    made = EmbeddedEngine(strict=False).build([source]).instance("Test")
    made["a"], made["b"] = a, b
    made.scan(0)
    assert made["y"] == packed(float(printed))


def test_strictness_is_for_tests_and_proofs() -> None:
    """Some of these are faults where C's doubles count, as they do unless one says otherwise."""
    results = [outcome(row[0], "REAL", INPUTS, {"a": row[1], "b": row[2]}) for row in IN_FLOATS]
    assert results.count(FAULT) == 6
