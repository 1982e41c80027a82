"""Analog inputs, and what is counted of a motor."""

import pytest

from driveblocks.desk.run import source
from structured_text.engines.embedded import EmbeddedInstance

SCALE = """
PROGRAM Scale
VAR
  Raw : INT; RawLow : INT; RawHigh : INT := 27648; Low : REAL; High : REAL := 50.0; One : VFD_Scale;
END_VAR
  One(Raw := Raw, RawLow := RawLow, RawHigh := RawHigh, Low := Low, High := High);
END_PROGRAM
"""
HOURS = """
PROGRAM Hours
VAR
  Running : BOOL; Starts : UDINT; Counted : VFD_Counted; One : VFD_Hours;
END_VAR
  One(ElapsedMs := 400, Running := Running, Starts := Starts, Counted := Counted);
END_PROGRAM
"""


def made(text: str, name: str) -> EmbeddedInstance:
    return source.load("one.st", text, source.known([])).library.instance(name)


@pytest.mark.parametrize(
    ("raw", "value", "broken"),
    [
        (0, 0.0, False), (13824, 25.0, False), (27648, 50.0, False), (-1382, 0.0, False), (29030, 50.0, False),
        (-1383, 0.0, True), (29031, 0.0, True), (-4864, 0.0, True), (32767, 0.0, True), (-32768, 0.0, True),
    ],
)  # fmt: skip
def test_analog_input(raw: int, value: float, broken: bool) -> None:
    one = made(SCALE, "Scale")
    one["Raw"] = raw
    one.scan()
    assert one["One.Value"] == pytest.approx(value)
    assert one["One.Broken"] is broken


def test_analog_input_that_falls_and_one_of_4_to_20_ma() -> None:
    one = made(SCALE, "Scale")
    one["RawLow"], one["RawHigh"], one["Raw"] = 27648, 5530, 5530
    one["Low"], one["High"] = 10.0, 40.0
    one.scan()
    assert one["One.Value"] == pytest.approx(40.0)
    one["Raw"] = 0
    one.scan()
    assert one["One.Broken"]
    assert one["One.Value"] == pytest.approx(10.0)


def test_ends_that_are_the_same_are_broken() -> None:
    one = made(SCALE, "Scale")
    one["RawHigh"] = 0
    one.scan()
    assert one["One.Broken"]
    assert one["One.Value"] == pytest.approx(0.0)


def test_seconds_are_counted_while_it_runs_and_starts_over_a_restart_of_the_block() -> None:
    one = made(HOURS, "Hours")
    one["Counted.RunS"], one["Counted.Starts"] = 3600, 7
    for running, starts in [(False, 0), (True, 1), (True, 1), (True, 1), (False, 1), (True, 2), (True, 2)]:
        one["Running"], one["Starts"] = running, starts
        one.scan()
    assert one["Counted.RunS"] == 3602
    assert one["Counted.Starts"] == 9
    assert one["One.Hours"] == pytest.approx(3602 / 3600)
    for starts in (0, 1):
        one["Starts"] = starts
        one.scan()
    assert one["Counted.Starts"] == 10
