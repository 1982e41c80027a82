"""Variables by path on every engine: values of every type go in and come out, and nothing else changes."""

import math

import pytest

from structured_text.engines.engine import Engine, Instance, Source, Value

TYPES = """
TYPE
  Bytes8 : ARRAY[1..8] OF BYTE;
END_TYPE
TYPE
  Grid : ARRAY[0..2, -1..1] OF INT;
END_TYPE
TYPE
  Colour : (Red, Green, Blue);
END_TYPE
TYPE
  Percent : INT(0..100) := 50;
END_TYPE
TYPE
  Station : STRUCT
    Busy : BOOL;
    Data : Bytes8;
    Title : STRING;
    Scale : REAL;
  END_STRUCT;
END_TYPE
TYPE
  Stations : ARRAY[1..3] OF Station;
END_TYPE
"""

HOLDER = (
    TYPES
    + """
FUNCTION_BLOCK Holder
  VAR_INPUT
    Bit : BOOL;
    B : BYTE; W : WORD; Dw : DWORD; Lw : LWORD;
    Si : SINT; I : INT; Di : DINT; Li : LINT;
    Us : USINT; Ui : UINT; Ud : UDINT; Ul : ULINT;
    R : REAL; Lr : LREAL;
    Text : STRING := 'start$0D';
    Span : TIME := T#1s500ms;
  END_VAR
  VAR
    Marked : Colour := Green;
    Part : Percent;
    Matrix : Grid := [1, 2, 3, 4, 5, 6, 7, 8, 9];
    Longs : ARRAY[2..4] OF LREAL;
    Labels : ARRAY[0..1] OF STRING;
    All : Stations;
  END_VAR
  VAR_OUTPUT
    Scans : UINT := 7;
  END_VAR
  VAR CONSTANT
    LIMIT_OF_SCANS : INT := 99;
  END_VAR
  VAR_TEMP
    Passing : INT;
  END_VAR
  Passing := 5;
  Scans := Scans + 1;
  All[2].Data[3] := B;
END_FUNCTION_BLOCK
"""
)


def made(engine: Engine) -> Instance:
    """A fresh Holder."""
    return engine.build([Source("test.st", HOLDER)]).instance("Holder")


EXTREMES: list[tuple[str, Value]] = [
    ("Bit", True),
    ("B", 0xFF),
    ("W", 0xFFFF),
    ("Dw", 0xFFFF_FFFF),
    ("Lw", 0xFFFF_FFFF_FFFF_FFFF),
    ("Si", -128),
    ("I", -32768),
    ("Di", -(2**31)),
    ("Li", -(2**63)),
    ("Us", 255),
    ("Ui", 65535),
    ("Ud", 2**32 - 1),
    ("Ul", 2**64 - 1),
    ("R", -1.5),
    ("R", math.inf),
    ("Lr", 1e300),
    ("Text", b""),
    ("Text", bytes(range(256))[130:256]),
    ("Span", 1),
    ("Span", -1_500_000_000),
    ("Span", 100 * 86400 * 10**9),
    ("Marked", 2),
    ("Matrix", [[1, -2, 3], [4, 5, -6], [7, 8, 32767]]),
    ("Longs", [0.5, -0.25, 1e-300]),
    ("Labels", [b"a", b"bc"]),
    ("All[3]", {"BUSY": True, "DATA": [1, 2, 3, 4, 5, 6, 7, 8], "TITLE": b"x", "SCALE": 0.5}),
    ("All[1].Data[8]", 200),
]


@pytest.mark.parametrize(("path", "value"), EXTREMES)
def test_value_goes_in_and_comes_out(engine: Engine, path: str, value: Value) -> None:
    holder = made(engine)
    before = holder.state()
    holder[path] = value
    assert holder[path] == value
    changed = {name for name, now in holder.state().items() if now != before[name]}
    assert all(name.startswith(path.upper()) for name in changed)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("B", 256),
        ("B", -1),
        ("I", 32768),
        ("Ul", 2**64),
        ("I", 1.5),
        ("Bit", 2),
        ("R", b"1"),
        ("Text", b"x" * 127),
        ("Text", 5),
        ("Span", 0.5),
        ("Marked", 3),
        ("All[1].Data", [0] * 9),
        ("All[1].Data", 7),
        ("All[1].Data", [1, 2, 300]),
        ("LIMIT_OF_SCANS", 1),
        ("Matrix", [1, 2, 3]),
        ("All[1]", {"NOTHING": 1}),
        ("All[1]", 1),
    ],
)
def test_value_that_does_not_fit_is_refused(engine: Engine, path: str, value: Value) -> None:
    holder = made(engine)
    before = holder.state()
    with pytest.raises(ValueError, match=r"\w"):
        holder[path] = value
    assert holder.state() == before


@pytest.mark.parametrize(
    "path",
    [
        "Nothing",
        "",
        "Bit.X",
        "B[1]",
        "All[0]",
        "All[4].Busy",
        "All[1",
        "Matrix[3,0]",
        "Matrix[0]",
        ".Bit",
        "A ll",
    ],
)
def test_path_that_leads_nowhere_is_a_key_error(engine: Engine, path: str) -> None:
    holder = made(engine)
    with pytest.raises(KeyError, match=r"\w"):
        holder[path]
    with pytest.raises(KeyError, match=r"\w"):
        holder[path] = 0


def test_state_has_every_scalar_in_the_order_of_declaration(engine: Engine) -> None:
    state = made(engine).state()
    names = list(state)
    assert names[:5] == ["BIT", "B", "W", "DW", "LW"]
    assert names.index("SPAN") < names.index("MARKED") < names.index("MATRIX[0,-1]") < names.index("MATRIX[0,0]")
    assert names.index("ALL[3].SCALE") < names.index("SCANS") < names.index("LIMIT_OF_SCANS")
    assert "PASSING" not in state  # a VAR_TEMP does not outlive the scan
    assert "ENO" not in state
    assert len(state) == 17 + 2 + 9 + 3 + 2 + 3 * (1 + 8 + 1 + 1) + 2
    assert all(type(state[name]) is kind for name, kind in (("BIT", bool), ("B", int), ("R", float), ("TEXT", bytes)))
