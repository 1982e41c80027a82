"""What becomes of intermediate results that leave their type."""

import pytest
from tests.structured_text.engines.embedded.snippets import FAULT, Row, assert_row, fault, outcome

U = "u1, u2, u3 : UINT;"
S = "s1, s2 : SINT;"
I = "i1, i2 : INT;"  # noqa: E741 - the letter that everybody uses
D = "d1, d2 : DINT;"
L = "n1, n2 : LINT;"
UD = "x1, x2 : UDINT;"
B = "b1, b2 : BYTE;"
W = "w1, w2 : WORD;"

# expression, type of the result, inputs, their values, then the result in C, and here: a fault where the
# standard gives another. Derived by hand from IEC 61131-3 2.5.1.5.2 (each operation in the operand's type) and ISO C
# 6.3.1 (promotion to int); the C column is also run with both lines of matiec.
ROWS: list[Row] = [
    # A sum that is only stored is cut to the same bits by both.
    ("u1 + u2", "UINT", U, {"u1": 65535, "u2": 2}, 1, 1),
    ("u1 - u2", "UINT", U, {"u1": 1, "u2": 2}, 65535, 65535),
    ("i1 + i2", "INT", I, {"i1": 32767, "i2": 1}, -32768, -32768),
    ("-i1", "INT", I, {"i1": -32768}, -32768, -32768),
    ("s1 * s2", "SINT", S, {"s1": 100, "s2": 3}, 44, 44),
    # One that is divided, compared or widened is not.
    ("(u1 + u2) / 2", "UINT", U, {"u1": 65535, "u2": 3}, 32769, FAULT),
    ("(u1 + u2) / 2", "UINT", U, {"u1": 65532, "u2": 3}, 32767, 32767),
    ("(u1 + u2) MOD 10", "UINT", U, {"u1": 65535, "u2": 3}, 8, FAULT),
    ("u1 - u2 > 5", "BOOL", U, {"u1": 1, "u2": 2}, False, FAULT),
    ("u1 + u2 = u3", "BOOL", U, {"u1": 65535, "u2": 1, "u3": 0}, False, FAULT),
    ("(i1 + i2) / 2", "INT", I, {"i1": 32767, "i2": 32767}, 32767, FAULT),
    ("(s1 * s2) / 2", "SINT", S, {"s1": 100, "s2": 3}, -106, FAULT),
    ("UINT_TO_UDINT(u1 * u2)", "UDINT", U, {"u1": 256, "u2": 257}, 256, 256),
    ("u1 * u2 / u3", "UINT", U, {"u1": 1000, "u2": 100, "u3": 100}, 1000, FAULT),
    # 32 bits unsigned wrap alike: the difference of two times of day counts right.
    ("x1 - x2 > 5", "BOOL", UD, {"x1": 3, "x2": 4294967295}, False, False),
    ("(x1 + x2) / 2", "UDINT", UD, {"x1": 4294967295, "x2": 3}, 1, 1),
    ("x1 * x2", "UDINT", UD, {"x1": 65536, "x2": 65537}, 65536, 65536),
    # 32 and 64 bits signed: C does not define the overflow (gcc is asked to wrap).
    ("d1 + d2", "DINT", D, {"d1": 2147483647, "d2": 1}, -2147483648, FAULT),
    ("d1 * d2", "DINT", D, {"d1": 65536, "d2": 65536}, 0, FAULT),
    ("-d1", "DINT", D, {"d1": -2147483648}, -2147483648, FAULT),
    ("n1 - n2", "LINT", L, {"n1": -(2**63), "n2": 1}, 2**63 - 1, FAULT),
    ("u1 * u2", "UINT", U, {"u1": 65535, "u2": 65535}, 1, FAULT),
    # NOT of what is narrower than int keeps C's upper bits.
    ("NOT b1", "BYTE", B, {"b1": 0xA5}, 0x5A, 0x5A),
    ("(NOT b1) = BYTE#16#5A", "BOOL", B, {"b1": 0xA5}, False, FAULT),
    ("NOT w1 = w2", "BOOL", W, {"w1": 0xFFFF, "w2": 0}, False, FAULT),
    ("(NOT w1 AND WORD#16#00FF) = WORD#16#00FF", "BOOL", W, {"w1": 0}, True, True),
    ("(b1 XOR BYTE#16#FF) = BYTE#16#5A", "BOOL", B, {"b1": 0xA5}, True, True),
    ("BYTE_TO_WORD(NOT b1)", "WORD", B, {"b1": 0xA5}, 0x5A, 0x5A),
    # The arguments and results of functions have their type in C, too.
    ("BYTE_TO_WORD(SHL(b1, 4))", "WORD", B, {"b1": 0xA5}, 0x50, 0x50),
    ("SHL(b1, 4) = BYTE#16#50", "BOOL", B, {"b1": 0xA5}, True, True),
    ("SHR(NOT w1, 4)", "WORD", W, {"w1": 0}, 0x0FFF, 0x0FFF),
    ("ADD(u1, u2) / 2", "UINT", U, {"u1": 65535, "u2": 3}, 1, 1),
    ("MAX(u1 + u2, 7)", "UINT", U, {"u1": 65535, "u2": 3}, 7, 7),
    ("ABS(i1) / 2", "INT", I, {"i1": -32768}, -16384, -16384),
    # Division.
    ("i1 / i2", "INT", I, {"i1": -7, "i2": 2}, -3, -3),
    ("i1 MOD i2", "INT", I, {"i1": -7, "i2": 2}, -1, -1),
    ("i1 MOD i2", "INT", I, {"i1": 7, "i2": -2}, 1, 1),
    ("i1 / i2", "INT", I, {"i1": -32768, "i2": -1}, -32768, -32768),
    ("d1 / d2", "DINT", D, {"d1": -2147483648, "d2": -1}, FAULT, FAULT),
    ("i1 / i2", "INT", I, {"i1": 1, "i2": 0}, FAULT, FAULT),
    ("i1 MOD i2", "INT", I, {"i1": 1, "i2": 0}, 0, FAULT),
    ("DIV(i1, i2)", "INT", I, {"i1": 1, "i2": 0}, 0, FAULT),
    # A literal without prefix that needs 64 bits makes C compute in 64.
    ("x1 + 3000000000 > 5", "BOOL", UD, {"x1": 1294967296}, True, FAULT),
    # Conversions between integers cut alike.
    ("UINT_TO_INT(u1)", "INT", U, {"u1": 65535}, -1, -1),
    ("INT_TO_SINT(i1)", "SINT", I, {"i1": 200}, -56, -56),
    ("INT_TO_UDINT(i1)", "UDINT", I, {"i1": -1}, 4294967295, 4294967295),
    ("SINT_TO_WORD(s1)", "WORD", S, {"s1": -1}, 65535, 65535),
    # A number of no type in particular: what is the same in every type that compilers choose.
    ("TRUNC(r1) > 1000", "BOOL", "r1 : REAL;", {"r1": 32767.0}, True, True),
    ("TRUNC(r1) < 0", "BOOL", "r1 : REAL;", {"r1": 0.5}, False, False),
    ("GT(TRUNC(r1), 100)", "BOOL", "r1 : REAL;", {"r1": 127.0}, True, True),
    ("1 - 2 < 0", "BOOL", "i1 : INT;", {}, True, True),
]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]} {row[3]}")
def test_each_row(row: Row) -> None:
    """One row: what C makes of it, or a fault."""
    assert_row(row)


def test_the_fault_says_both_results_and_what_to_do() -> None:
    """A message that a person can act on."""
    text = fault("(u1 + u2) / 2", "UINT", U, u1=65535, u2=3)
    assert "65538 exceeds UINT" in text
    assert "the standard continues with 2" in text
    assert "store it first" in text


def test_subranges_are_checked_at_stores() -> None:
    """IEC 61131-3 2.3.3.1: a value outside is an error; matiec looks at nothing."""
    assert outcome("i1", "INT(0..9)", I, {"i1": 10}) == FAULT
    assert outcome("i1", "INT(0..9)", I, {"i1": 9}) == 9


@pytest.mark.parametrize(
    ("expression", "value", "agreed"),
    [
        ("TRUNC(r1) < 0", -1.0, "-1 is outside 0..32767"),
        ("TRUNC(r1) - 5 < 3", 4.0, "-1 is outside 0..32767"),
        ("-TRUNC(r1) < 3", 4.0, "-4 is outside 0..32767"),
        ("MAX(TRUNC(r1), 3) < 5", -1.0, "-1 is outside 0..32767"),
        ("GT(TRUNC(r1), 100)", 128.0, "128 is outside 0..127"),
    ],
)
def test_a_number_whose_type_nothing_shows_is_the_same_in_all_that_compilers_choose(
    expression: str, value: float, agreed: str
) -> None:
    text = fault(expression, "BOOL", "r1 : REAL;", r1=value)
    assert text.startswith("nothing gives the type of this number")
    assert agreed in text
