"""`driveblocks run` on a real clock at pymodbus's server, frames damaged; `make long WHAT=desk-line`: for an hour."""

import os

import pytest
from tests.stand.deskplc import exchange

DAMAGE = 0.05
"""One frame in twenty, since there are a few dozen."""


@pytest.mark.thorough
@pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here")
def test_a_motor_of_pymodbus_starts_turns_and_stops_and_both_sides_count_the_same() -> None:
    made = exchange(0, DAMAGE)
    explained = made.explained()
    assert (made.status, made.rounds, made.lost_stops, made.wrong_values()) == (0, 1, 0, 0), made.lines
    assert made.peer.heard == made.peer.replied > 0
    assert made.peer.cable.loss.damaged > 0
    assert explained["asked again"] >= 0
    assert explained["after the end"] >= 3  # a stop, and a read of either register of its standstill
    assert explained["losses not noticed"] <= explained["asked again"] + explained["after the end"]
    asked, _, wired, *lines, _, _ = made.lines
    assert (asked.split(": ")[-1], wired.split(": ")[-1]) == ("Motor 7", "WIRED")
    assert all(line.startswith("REAL PORT ") for line in lines)
    assert made.lines[-3] == "REAL PORT  stopped, and standstill read: Motor"
