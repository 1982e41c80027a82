"""Where two rules meet: a mode and a restart, an address and a late scan, the drive's own keys and a refresh."""

import pytest
from tests.drives.bench import Bench, Faults, Frame
from tests.drives.rules import watched
from tests.drives.station import FAMILIES
from tests.drives.test_start import motions
from tests.drives.test_stop import stops


def test_a_late_scan_takes_no_other_address_while_the_motor_may_turn() -> None:
    """Two drives that exist: the one that was started is stopped before the block turns to the other."""
    bench = Bench("CHF", "CHF")
    bench.put(1, Address=0)
    bench.running().put(Address=2)
    bench.run(1000)
    bench.scan(1500)
    begun = len(bench.frames)
    bench.run(8000)
    assert stops(bench, [each for each in bench.frames[begun:] if each.unit == 1])
    assert bench.drives[0].mode == "standstill"
    first = next(at for at, each in enumerate(bench.frames) if each.unit == 2)
    assert all(each.unit == 2 for each in bench.frames[first + 1 :])


@pytest.mark.parametrize("kind", FAMILIES)
@pytest.mark.parametrize("mode", ["SpeedOnly", "MonitorOnly"])
@pytest.mark.parametrize("late", [True, False])
def test_a_restart_into_a_mode_stops_what_the_bus_has_started(kind: str, mode: str, late: bool) -> None:
    bench = Bench(kind).running().put(**{mode: True})
    if late:
        bench.scan(1500)
    else:
        bench.restart()
    bench.until(lambda: bench.drives[0].mode == "standstill", 8000)
    bench.wait(20_000)
    assert not bench.shows("StopOverdue")


def test_a_wrong_address_can_be_corrected() -> None:
    bench = Bench("CHF", start=False).put(Address=77).restart()
    bench.wait(30_000)
    bench.put(Address=1).run(3000)
    bench.line(Acknowledge=True)
    bench.running()


def test_an_address_is_kept_for_what_answers_and_taken_for_what_has_no_supply() -> None:
    bench = Bench("CHF").running().put(Address=77)
    assert {each.unit for each in bench.run(2000)} == {1}
    bench.deaf = {1}
    bench.put(SupplyOff=True).run(5000)
    assert {each.unit for each in bench.wait(30_000)} == {77}


@pytest.mark.parametrize("kind", FAMILIES)
@pytest.mark.parametrize(("pin", "value"), [("Enable", False), ("QuickStop", True), ("CoastStop", True)])
def test_with_speed_only_a_stop_pin_sends_its_stop_and_no_speed(kind: str, pin: str, value: bool) -> None:
    bench = Bench(kind).stopped().put(SpeedOnly=True)
    bench.run(1000)
    bench.drives[0].keypad_run()
    bench.run(4000)
    bench.put(**{pin: value})
    frames = bench.run(3000)
    assert len(stops(bench, frames)) == 1
    reference = bench.maps[0].operation.reference.register
    assert [each.word for each in frames if each.address == reference and not each.read][:1] == [0]
    assert not bench.shows("StopOverdue")
    bench.put(**{pin: not value}).run(2000)
    bench.drives[0].keypad_run()
    bench.run(6000)
    assert abs(bench.drives[0].hertz - 25.0) < 0.3


@pytest.mark.parametrize("kind", FAMILIES)
@pytest.mark.parametrize("scale", [0.0, 0.01])
@pytest.mark.parametrize(("step", "lost"), [(60, 0), pytest.param(11, 30, marks=pytest.mark.long)])
def test_the_stop_key_of_a_drive_is_never_overridden(kind: str, scale: float, step: int, lost: int) -> None:
    """Pressed at any moment of a round of polls and of a refresh; two are due while it falls, two after that."""
    bench = Bench(kind).put(FrequencyScale=scale)
    bench.faults = Faults(unanswered=lost)
    for moment in range(0, 1100, step):
        bench.put(RunForward=False).run(100)
        bench.stopped().put(RunForward=True)
        assert at_speed(bench)
        bench.run(moment)
        bench.drives[0].keypad_stop()
        assert not motions(bench, bench.run(4600)), moment
        assert bench.drives[0].mode == "standstill"


def at_speed(bench: Bench) -> bool:
    """Scan until the motor has its 25 Hz, by its shaft: without a scale the block cannot say so."""
    bench.until(lambda: bench.drives[0].hertz > 24.0, 9000)
    return True


def test_a_drive_that_refuses_to_be_read_has_a_reason() -> None:
    bench = Bench("SN300G5")
    bench.spoil = lambda frame, reply: bytes([1, 0x83, 2]) if frame.read and reply else reply
    bench.run(3000)
    assert bench.reason() == "READ_REFUSED"
    assert bench.block["Slots[0].RefusedReason"] == 2
    assert bench.block["Slots[0].RefusedAddress"] == bench.frames[-1].address


def test_a_status_that_grows_old_has_a_reason_before_it_stops_the_motor() -> None:
    bench = Bench("CHF").put(StaleMs=2000).running()
    bench.spoil = lambda frame, reply: None if frame.read else reply
    bench.line(OfflineMs=60_000).run(1500)
    assert bench.shows("Running")
    assert bench.reason() == "SLOW_LINE"
    bench.run(1500)
    assert bench.reason() == "STALE"


def test_a_start_has_its_time_from_its_acknowledgement() -> None:
    """Seven others on a slow line must not use up the time that a drive has to follow."""
    bench = Bench("CHF").put(FollowWithinMs=800).stopped()
    slow: list[Frame] = []

    def lose(frame: Frame, reply: bytes | None) -> bytes | None:
        if not frame.read and bench.pins[0].get("RunForward") and len(slow) < 3:
            slow.append(frame)
            return None
        return reply

    bench.line(CommandRetries=10)
    bench.put(LongestMs=400)
    bench.spoil = lose
    bench.put(RunForward=True).run(4000)
    assert len(slow) == 3
    assert bench.drives[0].mode == "running"


def test_a_flickering_pin_posts_repetitions() -> None:
    bench = Bench("CHF").stopped()
    bench.run(1000)
    for _ in range(50):
        bench.put(Enable=False).scan()
        bench.put(Enable=True).scan()
    assert bench.block["Slots[0].StopAgain"] is True
    bench.put(Enable=True).run(3000)
    bench.running()
    bench.put(Enable=False).scan()
    assert bench.block["Slots[0].StopAgain"] is False


def test_a_stop_on_the_keypad_and_a_motion_make_a_stop_new() -> None:
    bench = watched("CHF").stopped()
    bench.run(1000)
    bench.drives[0].keypad_run(30.0)
    begun = bench.now // 1000
    bench.until(lambda: bool(stops(bench, [each for each in bench.frames if each.ms > begun])), 400)


def test_a_drive_that_is_busy_is_asked_again() -> None:
    """24H of SN300G5: the same request may simply be sent again."""
    bench = Bench("SN300G5").stopped()
    busy = bench.now + 700_000
    bench.spoil = lambda frame, reply: bytes([1, 0x90, 0x24]) if not frame.read and bench.now < busy else reply
    bench.running()
    assert bench.now > busy
