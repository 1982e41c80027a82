"""Declarations of ST that only matiec has read: bounds, sections, defaults, lines."""

import pytest

from structured_text.engines.matiec.declarations import ArrayOf, Named, Record, Unit, integer, read_declarations

TEXT = """(* TYPE Trap : INT; END_TYPE *)
TYPE {pragma}
  Row : ARRAY [ -3 .. 16#F , 0..1 ] OF Cell := [2(0), 1];
  Kind : (Red, Green) := Green;
  Small : INT (0..9) := 3;
  Cell : STRUCT
    A, B : BYTE := 16#FF;
    Inner : ARRAY[1..2] OF Small;
  END_STRUCT;
END_TYPE

FUNCTION_BLOCK Worker (* VAR X : INT; END_VAR *)
  VAR_INPUT CONSTANT
    First, Second : REAL := -1.5; Clock : BOOL R_EDGE;
  END_VAR
  VAR RETAIN
    Text : STRING := 'it$'s; END_VAR';
  END_VAR
  VAR
    Place AT %QX0.1 : BOOL;
    Own : Cell := (A := 1, B := 2);
  END_VAR
  First := 'VAR Y : INT; END_VAR';
END_FUNCTION_BLOCK
function lower : int
var_input
  x : row;
end_var
lower := 1;
end_function
PROGRAM P
END_PROGRAM
CONFIGURATION C
  VAR_GLOBAL G : Row; END_VAR
  RESOURCE R ON PLC
    VAR_GLOBAL H : INT; END_VAR
    TASK T(INTERVAL := T#1s, PRIORITY := 0);
    PROGRAM P1 WITH T : P;
  END_RESOURCE
END_CONFIGURATION
"""


def test_types() -> None:
    types = read_declarations(TEXT).types
    assert list(types) == ["ROW", "KIND", "SMALL", "CELL"]
    assert types["ROW"] == ArrayOf(((-3, 15), (0, 1)), Named("CELL"))
    assert types["SMALL"] == Named("INT")
    assert types["CELL"] == Record(
        {"A": Named("BYTE"), "B": Named("BYTE"), "INNER": ArrayOf(((1, 2),), Named("SMALL"))}
    )


def test_units_with_lines_and_variables() -> None:
    units = read_declarations(TEXT).units
    assert [(unit.kind, unit.name, unit.line) for unit in units.values()] == [
        ("FUNCTION_BLOCK", "Worker", 12),
        ("FUNCTION", "lower", 25),
        ("PROGRAM", "P", 31),
        ("CONFIGURATION", "C", 33),
    ]
    worker = units["WORKER"]
    assert list(worker.variables) == ["FIRST", "SECOND", "CLOCK", "TEXT", "PLACE", "OWN"]
    assert worker.variables["SECOND"].section == "VAR_INPUT CONSTANT"
    assert worker.variables["SECOND"].initial == "-1.5"
    assert worker.variables["TEXT"].initial == "'it$'s; END_VAR'"
    assert worker.variables["OWN"].initial == "(A:=1,B:=2)"
    assert worker.variables["PLACE"].spec == Named("BOOL")
    assert units["LOWER"].variables["X"].spec == Named("ROW")
    assert list(units["C"].variables) == ["G", "H"]


def test_names_resolve_to_what_they_stand_for() -> None:
    declared = read_declarations("TYPE A : B; END_TYPE TYPE B : ARRAY[0..1] OF INT; END_TYPE TYPE C : C; END_TYPE")
    assert declared.resolve(Named("A")) == ArrayOf(((0, 1),), Named("INT"))
    assert declared.resolve(Named("C")) == Named("C")
    assert declared.resolve(Named("TON")) == Named("TON")
    assert declared.resolve(None) is None


@pytest.mark.parametrize(
    "text", ["", "TYPE", "FUNCTION", "FUNCTION_BLOCK X VAR", "TYPE A : ARRAY[", "VAR_INPUT x : INT"]
)
def test_text_that_ends_early_ends_the_reading(text: str) -> None:
    try:
        found = read_declarations(text)
    except ValueError:  # a bound that is no number
        return
    assert all(isinstance(unit, Unit) for unit in found.units.values())


@pytest.mark.parametrize(
    ("text", "value"),
    [("5", 5), ("-5", -5), ("+1_000", 1000), ("16#fF", 255), ("2#1010", 10), ("INT#7", 7), ("UINT#16#10", 16)],
)
def test_integer(text: str, value: int) -> None:
    assert integer(text) == value
