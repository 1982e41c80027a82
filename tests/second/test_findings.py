"""What was found by hand before there was a matrix, each held against the second models."""

import pytest
from tests.second.bench import Second
from tests.second.drive import Refusal
from tests.second.observer import MOVES
from tests.second.station import types_of

EIGHT = range(8)
STARTS_MS = 2 * 18 * 4 * 100
"""18 writes start eight drives; another that feeds a watchdog follows each, and three reads each of both: in scans of
50 ms each takes 100 ms."""
RUN_HZ = 25.0
RAMP_STOP, JOG_STOP = 5, 8
"""Words of the stops of CHF and GD200A."""
OVER = 3
"""A fault's code."""


def turns(b: Second, index: int = 0) -> float:
    """The speed of a shaft, Hz."""
    return abs(b.models[index].motor.hz(b.now))


def ready(b: Second) -> Second:
    """Wait until every drive may be started, and close the contact."""
    assert b.wait(lambda: all(b.shows("Ready", each) for each in range(len(b.models))), 20_000)
    b.press()
    assert b.contact
    return b


def test_eight_drives_in_slow_scans_start_at_once_and_run_on() -> None:
    """At 50 ms a status grew older than StaleMs, and a start used up the time that its drive had to follow."""
    b = ready(Second(*types_of("CHF", 8, ascii_=False), ms=50))
    for each in EIGHT:
        b.put(each, RunForward=True)
    assert b.wait(lambda: all(b.shows("Running", each) for each in EIGHT), STARTS_MS)
    for _ in range(15):
        b.run(1000)
        assert {b.models[each].by for each in EIGHT} == {"bus"}
        assert all(b.number("StatusAgeMs", each) < b.number("StaleMs", each) for each in EIGHT)
        assert b.contact


@pytest.mark.parametrize("family", ["CHF", "GD200A"])
@pytest.mark.parametrize("how", ["Restart", "a late scan", "a cable that is cut for 9 s"])
def test_a_jog_that_only_its_own_stop_ends_is_ended(family: str, how: str) -> None:
    """A PLC that restarts has forgotten that it jogs."""
    b = ready(Second(family, options={family: {"stop_ends_jog": False}}))
    b.put(0, JogForward=True).run(2000)
    assert turns(b) > 0
    if how == "Restart":
        b.restart()
    elif how == "a late scan":
        b.scan(1500)
    else:
        b.deaf.add(1)
        b.put(0, JogForward=False).run(9000)
        b.deaf.discard(1)
        b.run(8000)
    b.run(6000)
    assert (turns(b), b.models[0].by) == (0, "")
    b.put(0, JogForward=False)
    assert b.wait(lambda: b.shows("StopConfirmed"), 9000)


@pytest.mark.parametrize("family", ["CHF", "GD200A"])
@pytest.mark.parametrize("pin", ["JogForward", "Enable", "QuickStop"])
@pytest.mark.parametrize(("times", "words"), [(1, [JOG_STOP]), (2, [JOG_STOP]), (3, [JOG_STOP, RAMP_STOP])])
def test_the_end_of_a_jog_is_sent_again_after_a_refusal(
    monkeypatch: pytest.MonkeyPatch, family: str, pin: str, times: int, words: list[int]
) -> None:
    """A drive may refuse a stop now and obey the next; where that was the end of a jog, it was never sent again."""
    b = ready(Second(family, options={family: {"stop_ends_jog": False}}))
    b.put(0, JogForward=True).run(2000)
    assert turns(b) > 0
    left, write = [times], b.models[0]._write

    def refuse(written: dict[int, int], now_us: int) -> None:
        if left[0] and not set(words).isdisjoint(written.values()):
            left[0] -= 1
            raise Refusal("address")
        write(written, now_us)

    monkeypatch.setattr(b.models[0], "_write", refuse)
    b.put(0, **{pin: pin == "QuickStop"})
    assert b.wait(lambda: b.shows("StopConfirmed"), 4500)
    assert (left, turns(b), b.models[0].by) == ([0], 0, "")


@pytest.mark.parametrize("family", ["CHF", "JSCC", "SN300G5"])
@pytest.mark.parametrize("moving", [True, False])
def test_the_trip_of_one_drive_opens_no_contact(family: str, moving: bool) -> None:
    b = ready(Second(*types_of(family, 3, ascii_=False)))
    if moving:
        b.put(0, RunForward=True)
        assert b.wait(lambda: b.shows("AtSpeed"), 9000)
    b.models[0].trip(OVER, b.now)
    assert b.wait(lambda: b.shows("Fault"), 5000)
    for _ in range(30):
        b.run(1000)
        assert b.contact
        assert not b.shows("StopOverdue")


@pytest.mark.parametrize("moment", range(0, 1100, 220))
@pytest.mark.thorough
def test_the_stop_key_of_one_of_eight_is_not_overridden(moment: int) -> None:
    b = ready(Second(*types_of("CHF", 8, ascii_=False)))
    for each in EIGHT:
        b.put(each, RunForward=True)
    assert b.wait(lambda: all(turns(b, each) > RUN_HZ - 1 for each in EIGHT), 12_000)
    b.run(moment)
    b.models[0].press("stop", b.now)
    b.run(9000)
    assert turns(b) == 0
    assert all(turns(b, each) > RUN_HZ - 1 for each in EIGHT[1:])


def test_a_fault_that_only_the_supply_clears() -> None:
    b = ready(Second("CHF", options={"CHF": {"power_cycle_only": frozenset({OVER})}}))
    b.models[0].trip(OVER, b.now)
    b.run(3000)
    b.put(0, FaultReset=True).run(12_000)
    assert b.shows("Fault")
    assert b.reason() == "FAULT_BACK"
    b.put(0, FaultReset=False, **dict.fromkeys(MOVES, False))
    b.models[0].power(False, b.now)
    b.run(1000)
    b.models[0].power(True, b.now)
    assert b.wait(lambda: b.shows("Ready"), 20_000)
    b.put(0, RunForward=True)
    assert b.wait(lambda: b.shows("AtSpeed"), 9000)


@pytest.mark.parametrize("family", ["CHF", "JSCC"])
@pytest.mark.parametrize("signed", [True, False])
def test_a_motor_in_reverse_stops_whatever_sign_its_monitors_have(family: str, signed: bool) -> None:
    b = ready(Second(family, options={family: {"signed_monitors": signed}}))
    b.put(0, RunReverse=True)
    assert b.wait(lambda: turns(b) > RUN_HZ - 1, 9000)
    b.run(2000)
    assert b.shows("Running")
    b.put(0, RunReverse=False)
    for _ in range(600):
        b.scan()
        assert not (b.shows("StopConfirmed") and turns(b))
    assert b.shows("StopConfirmed")
    assert b.contact


@pytest.mark.parametrize("pin", ["RunForward", "RunReverse"])
@pytest.mark.parametrize("way_at_rest", ["clockwise", "counterclockwise"])
def test_a_v20_that_is_magnetised_at_0_hz_shows_no_way_yet(pin: str, way_at_rest: str) -> None:
    # bit 14 of its status says nothing at 0 Hz: a start in one of both ways was taken for one that others have turned
    b = Second("V20", options={"V20": {"comm_us": None, "start_us": 1_000_000, "way_at_rest": way_at_rest}})
    assert b.wait(lambda: b.shows("Ready"), 9000)
    b.put(0, **{pin: True})
    assert b.wait(lambda: b.shows("AtSpeed"), 6000), b.told()
