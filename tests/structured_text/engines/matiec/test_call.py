"""Functions on matiec."""

import platform
from collections.abc import Callable

import pytest

from structured_text.engines.engine import EngineError, ScanError, Value
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]

FUNCTIONS = """
TYPE
  Pair : STRUCT Left : INT; Right : INT; END_STRUCT;
END_TYPE
FUNCTION Sum : UINT
  VAR_INPUT
    A : UINT;
    B : UINT := 16#10;
    Twice : BOOL := TRUE;
  END_VAR
  VAR
    Local : UINT;
  END_VAR
  Local := A + B;
  IF Twice THEN
    Local := Local + Local;
  END_IF;
  Sum := Local;
END_FUNCTION
FUNCTION Echo : STRING
  VAR_INPUT
    Text : STRING := 'a$$b';
  END_VAR
  Echo := Text;
END_FUNCTION
FUNCTION Later : TIME
  VAR_INPUT
    Now : TIME := T#1s500ms;
  END_VAR
  Later := Now;
END_FUNCTION
FUNCTION Half : LREAL
  VAR_INPUT
    X : LREAL := 2.5;
  END_VAR
  VAR_OUTPUT
    Whole : BOOL;
  END_VAR
  Whole := FALSE;
  Half := X / 2.0;
END_FUNCTION
FUNCTION LeftOf : INT
  VAR_INPUT
    P : Pair;
  END_VAR
  LeftOf := P.Left;
END_FUNCTION
FUNCTION Over : DINT
  VAR_INPUT
    Parts : DINT;
  END_VAR
  Over := 10 / Parts;
END_FUNCTION
"""


@pytest.mark.parametrize(
    ("function", "arguments", "result"),
    [
        ("Sum", {"A": 1, "B": 2, "Twice": False}, 3),
        ("sum", {"a": 1, "b": 2}, 6),
        ("Sum", {}, 32),
        ("Sum", {"A": 65535, "B": 1, "Twice": False}, 0),
        ("Echo", {"Text": b"\x00\xff"}, b"\x00\xff"),
        ("Echo", {}, b"a$b"),
        ("Later", {"Now": -5}, -5),
        ("Later", {}, 1_500_000_000),
        ("Half", {"X": 5}, 2.5),
        ("Half", {}, 1.25),
        ("LeftOf", {"P": {"LEFT": -7, "RIGHT": 1}}, -7),
        ("Over", {"Parts": 3}, 3),
    ],
)
def test_call(build: Builder, function: str, arguments: dict[str, Value], result: Value) -> None:
    value = build(FUNCTIONS).call(function, arguments)
    assert value == result
    assert type(value) is type(result)


def test_unknown_names(build: Builder) -> None:
    library = build(FUNCTIONS)
    with pytest.raises(KeyError, match="Nothing"):
        library.call("Nothing", {})
    with pytest.raises(KeyError, match="C"):
        library.call("Sum", {"C": 1})
    with pytest.raises(ValueError, match="outside"):
        library.call("Sum", {"A": -1})


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="only x86 traps a division by zero")
def test_division_by_zero(build: Builder) -> None:
    library = build(FUNCTIONS)
    with pytest.raises(ScanError, match=r"^test.st:\d+:0: Over: .*division by zero"):
        library.call("Over", {"Parts": 0})
    assert library.call("Over", {"Parts": 2}) == 5


def test_default_that_is_no_literal_wants_the_argument(build: Builder) -> None:
    library = build(
        """TYPE
  Speed : (Slow, Fast);
END_TYPE
FUNCTION Pick : INT
  VAR_INPUT
    S : Speed := Fast;
    N : INT;
  END_VAR
  Pick := N;
END_FUNCTION
"""
    )
    assert library.call("Pick", {"S": 1, "N": 3}) == 3
    with pytest.raises(EngineError, match="give the argument"):
        library.call("Pick", {"N": 3})
