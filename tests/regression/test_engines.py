"""Mistakes that the engines once had, each by the least that showed it; matiec is asked where it is found."""

import pytest

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Source

# Types with initial values of their own (IEC 61131-3 2.3.3.2), as they reach a variable.
TYPES = """
TYPE T_Level : INT := 7; END_TYPE
TYPE T_Same : T_Level; END_TYPE
TYPE T_Other : T_Level := 8; END_TYPE
TYPE T_Digit : INT (5..10) := 6; END_TYPE
TYPE T_Hertz : REAL := 50.0; END_TYPE
TYPE T_Unit : STRING := 'Hz'; END_TYPE
TYPE T_Delay : TIME := T#5s; END_TYPE
TYPE T_Pair : STRUCT Level : T_Level; Digit : T_Digit; END_STRUCT; END_TYPE
TYPE T_Row : ARRAY[0..2] OF T_Digit; END_TYPE
TYPE T_First : ARRAY[0..1] OF INT := [3, 4]; END_TYPE
TYPE T_Second : T_First := [5, 6]; END_TYPE
"""
BLOCK = """
FUNCTION_BLOCK Show
VAR_INPUT Given : T_Other; END_VAR
VAR_OUTPUT Out : {type}; END_VAR
VAR
  Level : T_Level; Level2 : T_Level; Own : T_Level := 9; Same : T_Same; Digit : T_Digit; Hertz : T_Hertz;
  Unit : T_Unit; Delay : T_Delay; Pair : T_Pair; Row : T_Row; First : T_First; Second : T_Second;
END_VAR
VAR_TEMP Now : T_Level; END_VAR
  Out := {value};
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize(
    ("value", "kind", "expected"),
    [
        ("Level", "INT", 7),
        ("Level2", "INT", 7),
        ("Own", "INT", 9),
        ("Same", "INT", 7),
        ("Given", "INT", 8),
        ("Now", "INT", 7),
        ("Digit", "INT", 6),
        ("Hertz", "REAL", 50.0),
        ("Unit", "STRING", b"Hz"),
        ("Delay", "TIME", 5_000_000_000),
        ("Pair.Level", "INT", 7),
        ("Pair.Digit", "INT", 6),
        ("Row[1]", "INT", 6),
        ("First[1]", "INT", 4),
        ("Second[1]", "INT", 6),
    ],
)
def test_the_initial_value_of_a_type_reaches_its_variables(value: str, kind: str, expected: object) -> None:
    """Only structures, arrays and enumerations gave theirs; another name for an array gave its own to the first."""
    built = EmbeddedEngine().build([Source("show.st", TYPES + BLOCK.format(type=kind, value=value))])
    instance = built.instance("Show")
    instance.scan(0)
    assert instance["Out"] == expected


def test_the_initial_value_of_a_type_reaches_functions(engine: Engine) -> None:
    """Locals, defaults of inputs, and the result; one build serves for all of them."""
    text = """
TYPE T_Level : INT := 7; END_TYPE
TYPE T_Digit : INT (5..10) := 6; END_TYPE
TYPE T_Pair : STRUCT Level : T_Level; Digit : T_Digit; END_STRUCT; END_TYPE
FUNCTION Both : INT
VAR_INPUT Step1 : INT; Plus : T_Level; END_VAR
VAR Local1 : T_Level; END_VAR
  Both := Local1 * 100 + Plus * 10 + Step1;
END_FUNCTION
FUNCTION_BLOCK Show
VAR_OUTPUT Out, Out2, Out3 : INT; END_VAR
VAR Pair : T_Pair; END_VAR
  Out := Both(Step1 := 1);
  Out2 := Pair.Level;
  Out3 := Pair.Digit;
END_FUNCTION_BLOCK
"""
    instance = engine.build([Source("show.st", text)]).instance("Show")
    instance.scan(0)
    assert [instance[each] for each in ("Out", "Out2", "Out3")] == [771, 7, 6]


FUNCTION_OF_TYPES = """
TYPE T_Level : INT := 7; END_TYPE
TYPE T_Same : T_Level; END_TYPE
TYPE T_Digit : INT (5..10); END_TYPE
FUNCTION Show : INT
VAR_INPUT Level : T_Level; Same : T_Same; Digit : T_Digit; Own : T_Level := 1000; END_VAR
  Show := Level + 10 * Same + 100 * Digit + Own;
END_FUNCTION
"""


def test_a_call_from_outside_takes_the_initial_value_of_a_type(engine: Engine) -> None:
    """An input that was not given was 0 on matiec, where its type has an initial value."""
    library = engine.build([Source("show.st", FUNCTION_OF_TYPES)])
    assert library.call("Show", {}) == 7 + 70 + 500 + 1000
    assert library.call("Show", {"Level": 1}) == 1 + 70 + 500 + 1000
