"""SHL, SHR, ROL and ROR for every width and number of places, and where compilers part."""

import pytest
from tests.structured_text.engines.embedded.snippets import FAULT, Row, assert_row, block

WIDTHS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
DECLARATIONS = """VAR_INPUT x : {kind}; n : UINT; END_VAR
VAR_OUTPUT shl_, shr_, rol_, ror_ : {kind}; END_VAR"""
BODY = "shl_ := SHL(x, n); shr_ := SHR(x, n); rol_ := ROL(x, n); ror_ := ROR(x, n);"


@pytest.mark.parametrize("kind", WIDTHS)
def test_places_within_the_width(kind: str) -> None:
    """Against bit strings of text, moved by hand."""
    width = WIDTHS[kind]
    made = block(DECLARATIONS.format(kind=kind), BODY)
    value = 0x9E3779B97F4A7C15 >> (64 - width)
    bits = f"{value:0{width}b}"
    for places in range(width):
        made["x"], made["n"] = value, places
        made.scan()
        assert made["shl_"] == int(bits[places:] + "0" * places, 2)
        assert made["shr_"] == int("0" * places + bits[: width - places], 2)
        assert made["rol_"] == int(bits[places:] + bits[:places], 2)
        assert made["ror_"] == int(bits[width - places :] + bits[: width - places], 2)


ROWS: list[Row] = [
    ("SHL(w, 16)", "WORD", "w : WORD;", {"w": 0xFFFF}, 0, 0),
    ("SHR(w, 16)", "WORD", "w : WORD;", {"w": 0xFFFF}, 0, 0),
    ("SHR(w, n)", "WORD", "w : WORD; n : INT;", {"w": 0xFFFF, "n": 32}, 0xFFFF, FAULT),
    ("SHL(d, n)", "DWORD", "d : DWORD; n : INT;", {"d": 1, "n": 33}, 2, FAULT),
    ("SHL(w, n)", "WORD", "w : WORD; n : INT;", {"w": 3, "n": -1}, 0, FAULT),
    ("ROL(w, n)", "WORD", "w : WORD; n : INT;", {"w": 3, "n": -1}, 0x8001, FAULT),
    ("ROL(w, n)", "WORD", "w : WORD; n : INT;", {"w": 0x1234, "n": 20}, 0x2341, 0x2341),
    ("ROR(w, n)", "WORD", "w : WORD; n : INT;", {"w": 0x1234, "n": 20}, 0x4123, 0x4123),
    ("SHL(q, 1)", "BOOL", "q : BOOL;", {"q": True}, False, False),
    ("SHL(q, 0)", "BOOL", "q : BOOL;", {"q": True}, True, True),
    ("ROL(q, 5)", "BOOL", "q : BOOL;", {"q": True}, True, True),
]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]} {row[3]}")
def test_places_beyond_the_width(row: Row) -> None:
    """C leaves these undefined; x86-64 counts places modulo the register."""
    assert_row(row)
