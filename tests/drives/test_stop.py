"""A stop is sent at once, goes out again until the drive proves that it stands, and says when it is late."""

from itertools import pairwise

import pytest
from tests.drives.words import sent, stops
from tests.second.line import Bench
from tests.second.station import MADE_UP

from driveblocks.bench.simulator.habits import Habits

KINDS = ("CHF", *MADE_UP)


@pytest.mark.parametrize("kind", KINDS)
def test_a_stop_is_sent_at_once_and_again_until_the_motor_is_at_standstill(kind: str) -> None:
    bench = Bench(kind).running()
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


@pytest.mark.parametrize("kind", KINDS)
def test_a_fault_posts_a_stop(kind: str) -> None:
    """So that no run word stays in a drive that somebody resets on its keypad."""
    bench = Bench(kind, habits=Habits(resumes=True)).running()
    bench.drives[0].trip(3)
    assert stops(bench, bench.run(300))
    bench.drives[0].clear_cause()
    bench.until(lambda: not bench.drives[0].motor.shaft, 9000)
    bench.drives[0].reset()
    bench.run(3000)
    assert bench.drives[0].mode == "standstill"
    bench.drives[0].trip(4)
    assert stops(bench, bench.run(300))


def test_a_stop_that_nobody_acknowledges_is_not_confirmed() -> None:
    """Though all that is read says that the motor is at standstill."""
    bench = Bench("CHF", start=False)
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
    [("CHF", 0x1001, 5), ("CHF", 0x3000, 1), ("JSCC", 0x2001, 5), ("JSCC", 0x2000, 1), ("SN300G5", 0x0021, 1)],
)
def test_standstill_needs_status_and_frequency(kind: str, odd: int, word: int) -> None:
    bench = Bench(kind).stopped()
    shown = bench.drives[0].word
    bench.drives[0].word = lambda address: word if address == odd else shown(address)  # type: ignore[method-assign]  # it lies
    bench.restart().run(3000)
    assert bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")


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
    bench = Bench(kind).running()
    bench.put(**{pin: True})
    frames = bench.run(200)
    assert sent(bench, frames, does)
    assert stops(bench, frames) == sent(bench, frames, does)
    bench.put(**{pin: False}, RunForward=False).stopped()


def test_a_harder_stop_replaces_a_softer_one() -> None:
    bench = Bench("CIA").running()
    bench.put(RunForward=False).run(100)
    bench.put(QuickStop=True)
    assert sent(bench, bench.run(100), "quick_stop")
    bench.put(CoastStop=True)
    frames = bench.run(1500)
    assert sent(bench, frames, "coast_stop")
    assert bench.shows("StopConfirmed")
    assert bench.drives[0].mode == "coasting"


def test_a_drive_that_is_not_ready_gets_the_word_of_a_stop_again() -> None:
    """Behind a fault that was reset on its keypad, a drive by CiA 402 needs it."""
    bench = Bench("CIA").stopped()
    bench.drives[0].trip(3)
    bench.run(1000)
    bench.drives[0].clear_cause()
    bench.drives[0].reset()
    bench.stopped().running()


def test_a_start_waits_for_a_repeated_stop() -> None:
    """A stop that waits would take the start back: until it is answered there is none."""
    bench = Bench("CHF").running().put(RunForward=False)
    bench.until(lambda: bench.shows("StopConfirmed"), 9000)
    assert bench.block["Slots[0].Ask[0].Number"] == bench.block["Slots[0].Answer[0].Number"]
