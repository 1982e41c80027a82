"""The two lines of matiec are distinguished by what they do."""

from dataclasses import replace

import pytest

from structured_text.engines.engine import Source
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.line import Behaviour, observe


@pytest.mark.parametrize(
    ("behaviour", "line", "pure"),
    [
        (Behaviour(0, f_trig_fires_at_once=True, empty_equals_x=False), "beremiz", True),
        (Behaviour(1, f_trig_fires_at_once=False, empty_equals_x=True), "openplc", True),
        (Behaviour(1, f_trig_fires_at_once=True, empty_equals_x=False), "beremiz", False),
        (Behaviour(0, f_trig_fires_at_once=False, empty_equals_x=True), "openplc", False),
        (Behaviour(1, f_trig_fires_at_once=True, empty_equals_x=True), "openplc", False),
    ],
)
def test_majority_decides(behaviour: Behaviour, line: str, pure: bool) -> None:
    assert (behaviour.line, behaviour.pure) == (line, pure)


def test_engine_is_named_by_what_it_does(matiec: MatiecEngine) -> None:
    behaviour = observe(replace(matiec, name="whatever"))
    assert matiec.name == f"matiec-{behaviour.line}"


def test_for_that_should_run_once(matiec: MatiecEngine) -> None:
    """The difference that matters most, seen through the whole engine."""
    text = """FUNCTION_BLOCK Once
  VAR_INPUT
    Last : INT := 3;
  END_VAR
  VAR_OUTPUT
    Turns : INT;
  END_VAR
  VAR
    I : INT;
  END_VAR
  Turns := 0;
  FOR I := 3 TO Last DO
    Turns := Turns + 1;
  END_FOR;
END_FUNCTION_BLOCK
"""
    once = matiec.build([Source("once.st", text)]).instance("Once")
    once.scan(0)
    assert once["Turns"] == {"matiec-beremiz": 0, "matiec-openplc": 1}[matiec.name]
    once["Last"] = 4
    once.scan(0)
    assert once["Turns"] == 2
