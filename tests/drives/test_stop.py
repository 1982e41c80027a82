"""A stop is sent at once, goes out again until the drive proves that it stands, and says when it is late."""

from itertools import pairwise

import pytest
from tests.drives.bench import Bench, Frame
from tests.drives.rules import STOPS, sent, watched
from tests.drives.station import FAMILIES, MADE_UP
from tests.drives.test_start import edge, motions

from driveblocks.simulator.habits import Habits

EVERY = (*FAMILIES, *MADE_UP)


def stops(bench: Bench, frames: list[Frame]) -> list[Frame]:
    """The stops among frames, of any kind."""
    return sent(bench, frames, *STOPS)


@pytest.mark.parametrize("kind", EVERY)
def test_a_stop_is_sent_at_once_and_again_until_the_motor_is_at_standstill(kind: str) -> None:
    bench = watched(kind).running()
    bench.drives[0].keeps_running = True
    begun = bench.now // 1000
    bench.put(RunForward=False, StopWithinMs=3000)
    frames = stops(bench, bench.run(5000))
    assert frames[0].ms - begun <= bench.number("StopAloneMs")
    apart = [b.ms - a.ms for a, b in pairwise(frames)]
    assert len(frames) >= 7
    assert min(apart) >= 500
    assert max(apart) <= 700
    assert bench.shows("StopOverdue")
    assert not bench.shows("StopConfirmed")
    bench.drives[0].keeps_running = False
    bench.until(lambda: bench.shows("StopConfirmed"))
    assert not stops(bench, bench.run(3000)[3:])
    assert not bench.shows("StopOverdue")


@pytest.mark.parametrize("kind", EVERY)
def test_a_fault_posts_a_stop(kind: str) -> None:
    """So that no run word stays in a drive that somebody resets on its keypad."""
    bench = watched(kind, habits=Habits(resumes=True)).running()
    bench.drives[0].trip(3)
    assert stops(bench, bench.run(300))
    bench.drives[0].clear_cause()
    bench.until(lambda: not bench.drives[0].motor.shaft, 9000)
    bench.drives[0].reset()
    bench.run(3000)
    assert bench.drives[0].mode == "standstill"
    bench.drives[0].trip(4)
    assert stops(bench, bench.run(300))


@pytest.mark.parametrize("kind", FAMILIES)
def test_a_stop_that_nobody_acknowledges_is_not_confirmed(kind: str) -> None:
    """Though all that is read says that the motor is at standstill."""
    bench = watched(kind, start=False)
    bench.spoil = lambda frame, reply: None if stops(bench, [frame]) else reply
    bench.restart()
    frames = bench.run(12_000)
    assert len(stops(bench, frames)) > 8
    assert bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")
    assert bench.shows("StopOverdue")
    bench.spoil = lambda _, reply: reply
    bench.stopped()


@pytest.mark.parametrize(
    ("kind", "odd", "word"),
    [("CHF", 0x1001, 5), ("CHF", 0x3000, 1), ("JSCC", 0x2001, 0), ("JSCC", 0x2000, 1), ("SN300G5", 0x0021, 1)],
)
def test_standstill_needs_status_and_frequency(kind: str, odd: int, word: int) -> None:
    bench = watched(kind).stopped()
    shown = bench.drives[0].word
    bench.drives[0].word = lambda address: word if address == odd else shown(address)  # type: ignore[method-assign]  # it lies
    bench.restart().run(3000)
    assert bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")


def test_words_read_before_the_acknowledgement_prove_nothing() -> None:
    """The stop is acknowledged late; meanwhile standstill is read, and then a motor that turns again."""
    bench = watched("CHF").stopped()
    bench.spoil = lambda frame, reply: None if stops(bench, [frame]) else reply
    bench.put(Enable=False).run(100)
    bench.spoil = lambda _, reply: reply
    bench.until(lambda: stops(bench, bench.acknowledged[-1:]))
    before = len(bench.acknowledged)
    bench.until(lambda: bench.shows("StopConfirmed"))
    assert {0x1001, 0x3000} <= {each.address for each in bench.acknowledged[before:]}


def test_a_stop_at_standstill_is_proved_by_words_read_after_it() -> None:
    """Somebody may have started the motor since standstill was read."""
    bench = watched("CHF").stopped()
    bench.put(Enable=False).run(1000)
    bench.put(Enable=True).run(1000)
    before = len(bench.acknowledged)
    bench.put(Enable=False).until(lambda: not bench.shows("StopConfirmed"))
    bench.until(lambda: stops(bench, bench.acknowledged[before:]))
    stopped = len(bench.acknowledged)
    bench.until(lambda: bench.shows("StopConfirmed"))
    assert {0x1001, 0x3000} <= {each.address for each in bench.acknowledged[stopped:]}


def test_the_frequency_is_read_last() -> None:
    """A frequency of 0 that was read before the status proves nothing: somebody may have started the motor since."""
    bench = watched("CHF").stopped()
    shown, words = bench.drives[0].word, {0x1001: 1, 0x3000: 0}
    bench.drives[0].word = lambda address: words.get(address, shown(address))  # type: ignore[method-assign]  # it lies
    bench.restart().run(1000)
    bench.until(lambda: bench.acknowledged[-1].address == 0x3000)
    words |= {0x1001: 3, 0x3000: 1000}
    for _ in range(100):
        bench.scan()
        assert not bench.shows("StopConfirmed")


@pytest.mark.parametrize("kind", FAMILIES)
def test_a_stop_follows_a_lost_connection(kind: str) -> None:
    """Though the motor stood before: nobody knows what has happened meanwhile."""
    bench = watched(kind).stopped()
    bench.deaf = {1}
    bench.until(lambda: not bench.shows("CommOk"), 9000)
    bench.deaf = set()
    before = len(bench.acknowledged)
    bench.until(lambda: bench.shows("StopConfirmed"), 9000)
    assert stops(bench, bench.acknowledged[before:])


@pytest.mark.parametrize(
    ("kind", "pin", "does"),
    [
        ("CHF", "CoastStop", "coast_stop"),
        ("CHF", "QuickStop", "stop"),
        ("JSCC", "CoastStop", "stop"),
        ("SN300G5", "QuickStop", "stop"),
        ("CIA", "QuickStop", "quick_stop"),
        ("CIA", "CoastStop", "coast_stop"),
        ("PRO", "QuickStop", "quick_stop"),
        ("TWO", "CoastStop", "coast_stop"),
    ],
)
def test_each_stop_pin_sends_its_stop_or_the_one_there_is(kind: str, pin: str, does: str) -> None:
    bench = watched(kind).running()
    bench.put(**{pin: True})
    frames = bench.run(200)
    assert sent(bench, frames, does)
    assert stops(bench, frames) == sent(bench, frames, does)
    bench.put(**{pin: False}, RunForward=False).stopped()


def test_a_harder_stop_replaces_a_softer_one() -> None:
    bench = watched("CIA").running()
    bench.put(RunForward=False).run(100)
    bench.put(QuickStop=True)
    assert sent(bench, bench.run(100), "quick_stop")
    bench.put(CoastStop=True)
    frames = bench.run(1500)
    assert sent(bench, frames, "coast_stop")
    assert bench.shows("StopConfirmed")
    assert bench.drives[0].mode == "coasting"


def test_a_quick_stop_follows_a_coast_stop_no_more() -> None:
    bench = watched("CIA").running().put(CoastStop=True)
    bench.run(100)
    bench.put(CoastStop=False, QuickStop=True)
    frames = bench.run(600)
    assert not sent(bench, frames, "quick_stop") or bench.drives[0].mode == "coasting"


def test_a_jog_is_ended_by_its_own_stop_and_then_by_a_plain_one() -> None:
    bench = watched("CHF", habits=Habits(stop_ends_jog=False)).stopped().put(JogForward=True)
    bench.run(1500)
    bench.put(JogForward=False)
    frames = bench.run(300)
    assert sent(bench, frames, "jog_stop")
    bench.until(lambda: bench.shows("StopConfirmed"))


def test_only_the_drives_own_bits_change_with_a_stop() -> None:
    bench = watched("SN300G5").put(KeepWord=0x00FF).running()
    bench.put(RunForward=False)
    assert {each.word for each in stops(bench, bench.run(200))} == {0x00FC}
    bench.stopped()


@pytest.mark.parametrize("kind", FAMILIES)
def test_a_plc_that_starts_warm_stops_a_running_motor(kind: str) -> None:
    bench = watched(kind).running()
    frames = bench.restart().run(9000)
    assert stops(bench, frames)
    assert not motions(bench, frames)
    assert bench.shows("StopConfirmed")
    assert bench.drives[0].mode == "standstill"


@pytest.mark.parametrize("kind", FAMILIES)
def test_a_motor_that_comes_back_running_is_stopped(kind: str) -> None:
    """On first contact and after a lost connection, even if the drive says that it runs."""
    bench = watched(kind).running()
    bench.deaf = {1}
    bench.until(lambda: not bench.shows("CommOk"), 9000)
    bench.deaf = set()
    frames = bench.run(9000)
    assert stops(bench, frames)
    assert not motions(bench, frames)
    assert bench.shows("StopConfirmed")


def test_nothing_stale_is_shown_as_good() -> None:
    bench = watched("CHF").running()
    bench.deaf = {1}
    bench.run(6000)
    for pin in ("CommOk", "Ready", "Running", "AtSpeed", "ZeroSpeed", "StopConfirmed"):
        assert not bench.shows(pin)
    assert not bench.out("OutputFrequencyValid")
    assert not bench.out("DcBusVoltageValid")
    assert bench.shows("StopOverdue")
    assert bench.reason() == "OFFLINE"
    bench.put(SupplyOff=True).run(100)
    assert not bench.shows("StopOverdue")
    assert bench.reason() == "NO_SUPPLY"


def test_a_line_that_is_no_longer_called_is_reported() -> None:
    bench = watched("CHF").running()
    bench.leave("SkipLine")
    bench.run(2500)
    assert bench.reason() == "NO_LINE"
    assert bench.shows("StopOverdue")
    assert not bench.shows("CommOk")
    bench.leave("SkipLine", on=False)
    assert stops(bench, bench.run(300))


def test_a_drive_block_that_is_no_longer_called_is_stopped_by_the_line() -> None:
    bench = watched("CHF").running()
    bench.leave("Skip0")
    frames = bench.run(6000)
    assert stops(bench, frames)
    assert not motions(bench, stops(bench, frames))
    assert bench.drives[0].mode == "standstill"
    bench.leave("Skip0", on=False)
    assert not motions(bench, bench.run(4000))
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def test_a_drive_that_is_not_ready_gets_the_word_of_a_stop_again() -> None:
    """Behind a fault that was reset on its keypad, a drive by CiA 402 needs it."""
    bench = watched("CIA").stopped()
    bench.drives[0].trip(3)
    bench.run(1000)
    bench.drives[0].clear_cause()
    bench.drives[0].reset()
    bench.stopped().running()


def test_a_start_waits_for_a_repeated_stop() -> None:
    """A stop that waits would take the start back: until it is answered there is none."""
    bench = watched("CHF").running().put(RunForward=False)
    bench.until(lambda: bench.shows("StopConfirmed"), 9000)
    assert bench.block["Slots[0].Ask[0].Number"] == bench.block["Slots[0].Answer[0].Number"]
