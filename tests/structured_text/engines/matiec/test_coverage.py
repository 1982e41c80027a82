"""Which lines of the ST have run on matiec."""

from dataclasses import replace

import pytest

from structured_text.engines.engine import Source
from structured_text.engines.matiec import BadCError, Flags, MatiecEngine

BRANCHES = """FUNCTION_BLOCK Branches
  VAR_INPUT
    A : INT;
  END_VAR
  VAR
    X, I : INT;
  END_VAR
  IF A = 1 THEN
    X := 1;
  ELSIF A = 2 THEN
    X := 2;
    RETURN;
  ELSE
    X := 3;
  END_IF;
  CASE A OF
    1, 7: X := 5;
          X := 6;
  ELSE
    X := 8;
  END_CASE;
  I := 0;
  WHILE I < 4 DO
    I := I + 1;
  END_WHILE;
END_FUNCTION_BLOCK
"""
FRONT = Source("front.st", "FUNCTION One : INT\n  VAR_INPUT\n    A : INT;\n  END_VAR\n  One := A;\nEND_FUNCTION\n")


def test_hits_of_every_statement(matiec: MatiecEngine) -> None:
    counting = replace(matiec, flags=Flags(coverage=True))
    library = counting.build([FRONT, Source("branches.st", BRANCHES)])
    branches = library.instance("Branches")
    for a in (1, 2, 2, 5):
        branches["A"] = a
        branches.scan(0)
    found = library.coverage()
    assert found["front.st"] == {5: 0}
    assert found["branches.st"] == {8: 4, 9: 1, 11: 2, 12: 2, 14: 1, 16: 2, 17: 1, 18: 1, 20: 1, 22: 2, 23: 2, 24: 8}


def test_a_library_counts_from_its_build_on(matiec: MatiecEngine) -> None:
    """Its C is loaded once, and all that were built from the same sources count together."""
    counting = replace(matiec, flags=Flags(coverage=True))
    first = counting.build([FRONT])
    first.call("One", {"A": 1})
    second = counting.build([FRONT])
    second.call("One", {"A": 1})
    assert (first.coverage(), second.coverage()) == ({"front.st": {5: 2}}, {"front.st": {5: 1}})


def test_nothing_is_counted_unless_asked(matiec: MatiecEngine) -> None:
    assert matiec.build([FRONT]).coverage() == {}


def test_global_without_configuration_is_bad_c_and_no_broken_library(matiec: MatiecEngine) -> None:
    text = "PROGRAM Wanting\n  VAR_EXTERNAL\n    G : INT;\n  END_VAR\n  G := 1;\nEND_PROGRAM\n"
    with pytest.raises(BadCError, match="__GET_GLOBAL_G"):
        matiec.build([Source("p.st", text)])
