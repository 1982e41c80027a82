"""`driveblocks run` on a real clock at pymodbus's server, frames damaged; `make long WHAT=desk-line`: for an hour."""

import os

import pytest
from tests.desk.simulate.deskplc import exchange

DAMAGE = 0.05
"""One frame in twenty, since there are a few dozen."""


@pytest.mark.thorough
@pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here")
def test_a_motor_of_pymodbus_starts_turns_and_stops() -> None:
    made = exchange(0, DAMAGE)
    figures = made.figures
    assert [figures[each] for each in ("rounds", "lost stops", "wrong values", "exit status")] == [1, 0, 0, 0], figures
    assert figures["Requests"] >= figures["Good"] > 0
    assert figures["damaged"] > 0
    asked, _, wired, *lines, _, _ = made.lines
    assert (asked.split(": ")[-1], wired.split(": ")[-1]) == ("Motor 7", "WIRED")
    assert all(line.startswith("REAL PORT ") for line in lines)
    assert made.lines[-3] == "REAL PORT  stopped, and standstill read: Motor"
