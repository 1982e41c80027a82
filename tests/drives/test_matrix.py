"""A part of the matrix in which each fault and each state comes; `make drives`: all of it."""

import pytest
from tests.drives.matrix import FAULTS, STATES, cell
from tests.drives.rules import watched
from tests.drives.station import FAMILIES

SOME = [(FAMILIES[place % 3], list(STATES)[place * 5 % len(STATES)], fault) for place, fault in enumerate(FAULTS)]


@pytest.mark.parametrize(("kind", "state", "fault"), SOME)
def test_a_fault_of_the_wire(kind: str, state: str, fault: str) -> None:
    cell(kind, state, fault)


@pytest.mark.parametrize("kind", FAMILIES)
def test_an_echo_is_no_drive(kind: str) -> None:
    """A port that hears itself: with the drive all goes on, without it nothing is acknowledged."""
    bench = watched(kind, start=False)
    bench.echo = True
    bench.restart().running()
    bench.deaf = {1}
    before = len(bench.acknowledged)
    bench.run(9000)
    assert bench.acknowledged[before + 2 :] == []
    assert not bench.shows("CommOk")
    assert bench.shows("StopOverdue")
