"""The Linux line in a soft PLC by matiec, over a pseudo-terminal, against the simulator. It needs iec2c."""

import os
from pathlib import Path

import pytest
from tests.blocks.toolchains import FOUND
from tests.desk.simulate.softplc import WHY_NOT, Desk, built, plc

pytestmark = [
    pytest.mark.skipif(bool(WHY_NOT), reason=WHY_NOT),
    pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here"),
]


@pytest.fixture(scope="module", params=range(max(1, len(FOUND))))
def program(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The soft PLC by each line of matiec."""
    return built(tmp_path_factory.mktemp("softplc"), FOUND[request.param])


def test_a_motor_starts_trips_is_reset_and_stops_and_both_sides_count_the_same(program: Path) -> None:
    desk = Desk()
    with plc(program, desk.link.place) as soft:
        soft.until(lambda seen: seen["confirmed"] == 1 and seen["comm"] == 1)
        soft.set("start", on=True)
        soft.until(lambda seen: seen["running"] == 1 and seen["hertz"] == 20)
        assert desk.drive.hertz == 20
        desk.drive.trip(3)
        soft.until(lambda seen: seen["fault"] == 1 and seen["running"] == 0)
        desk.drive.clear_cause()
        soft.set("start", on=False)
        soft.set("reset", on=True)
        soft.until(lambda seen: seen["fault"] == 0 and seen["confirmed"] == 1)
        assert desk.drive.mode == "standstill"
        soft.set("start", on=True)
        soft.until(lambda seen: seen["running"] == 1)
        soft.set("start", on=False)
        soft.until(lambda seen: seen["confirmed"] == 1 and seen["running"] == 0)
        assert desk.drive.mode == "standstill"
    desk.stop()
    desk.link.close()
    counts, seen = desk.bus.counts[1], soft.seen
    open_ = counts.heard - seen["good"]
    assert seen["requests"] >= seen["good"] > 0
    assert counts.heard == counts.replied
    assert 0 <= open_ - seen["timeouts"] - seen["bad"] <= 20  # what has passed since it last told
    assert (seen["port"], desk.bus.strange) == (0, 0)
