"""A drive that notices a silent line: what feeds its watchdog is sent three times within its time, and no more."""

from dataclasses import replace
from itertools import pairwise

import pytest
from tests.drives.words import motions, sent, stops
from tests.second.line import OFF, Bench

from driveblocks.bench.simulator.habits import Habits

TIME_MS = 600
SLOW = Habits(ramp=5)
"""25 Hz take 5 s."""


def fed(kind: str) -> Bench:
    """A motor that runs, with a watchdog and no other refresh."""
    return Bench(kind, habits=SLOW).put(RefreshMs=OFF, WatchdogMs=TIME_MS).running()


@pytest.mark.parametrize("kind", ["PUL", "CIA"])
def test_polls_feed_it_where_the_map_says_so(kind: str) -> None:
    bench = fed(kind)
    frames = bench.run(4000)
    assert not [each for each in frames if not each.read]
    assert bench.reason() == "RUNS"
    assert max(b.ms - a.ms for a, b in pairwise(frames)) < TIME_MS / 3


@pytest.mark.parametrize("kind", ["PUL", "CIA"])
def test_a_line_that_does_not_feed_it_says_so(kind: str) -> None:
    bench = fed(kind)
    bench.spoil = lambda *_: None
    bench.until(lambda: bench.reason() == "HEARTBEAT", 2 * TIME_MS)


@pytest.mark.parametrize("kind", ["CHF", "GD200A"])
def test_a_reference_of_0_feeds_it_while_the_motor_ramps_down(kind: str) -> None:
    bench = fed(kind).put(RunForward=False)
    bench.until(lambda: stops(bench, bench.frames[-1:]))
    begun = len(bench.frames)
    bench.until(lambda: not bench.shows("Running"), 9000)
    frames = bench.frames[begun:]
    references = sent(bench, frames, "reference")
    assert {each.word for each in references} == {0}
    assert max(b.ms - a.ms for a, b in pairwise(references)) <= TIME_MS / 2
    apart = [b.ms - a.ms for a, b in pairwise(stops(bench, frames))]
    assert min(apart) >= 500
    assert max(apart) <= 700
    bench.until(lambda: bench.shows("StopConfirmed"), 1000)
    assert not sent(bench, bench.run(3000), "reference")


def test_a_watchdog_that_counts_at_standstill_is_fed_there() -> None:
    """It trips within half a second of every reset where nobody writes; reads do not feed it."""
    bench = Bench("PRO", habits=replace(SLOW, watchdog_ms=500, watchdog_code=1)).put(WatchdogMs=500, RefreshMs=OFF)
    bench.until(lambda: bench.shows("StopConfirmed"), 2000)
    references = sent(bench, bench.run(4000), "reference")
    assert {each.word for each in references} == {0}
    assert max(b.ms - a.ms for a, b in pairwise(references)) <= 250
    assert (bench.shows("StopConfirmed"), bench.out("Error")) == (True, False)
    bench.drives[0].trip(1)
    bench.drives[0].clear_cause()
    bench.until(lambda: bench.shows("Fault"), 500)
    bench.put(FaultReset=True).until(lambda: bench.shows("Ready"), 3000)
    bench.run(2000)
    bench.put(FaultReset=False).running()


def test_what_is_not_fed_at_standstill_trips_there() -> None:
    bench = Bench("PRO", habits=replace(SLOW, watchdog_ms=500, watchdog_code=1)).put(RefreshMs=OFF)
    bench.until(lambda: bench.shows("Fault"), 3000)
    bench.put(FaultReset=True).run(3000)
    assert bench.shows("Fault")


def test_who_only_reads_feeds_nothing_at_standstill() -> None:
    bench = Bench("PRO", habits=SLOW).put(WatchdogMs=500, MonitorOnly=True)
    bench.run(2000)
    assert not [each for each in bench.run(3000) if not each.read]


def test_a_reference_that_was_lost_at_standstill_is_no_error() -> None:
    bench = Bench("PRO", habits=SLOW).put(WatchdogMs=500)
    bench.until(lambda: bench.shows("StopConfirmed"), 2000)
    bench.spoil = lambda frame, reply: reply if frame.read else None
    bench.run(300)
    bench.spoil = lambda _, reply: reply
    bench.run(1000)
    assert (bench.shows("StopConfirmed"), bench.out("Error")) == (True, False)


def test_a_drive_that_does_not_stop_in_time_is_left_to_its_watchdog() -> None:
    bench = fed("CHF")
    bench.drives[0].keeps_running = True
    bench.put(RunForward=False, StopWithinMs=3000)
    bench.until(lambda: bench.shows("StopOverdue"), 5000).run(300)
    assert not sent(bench, bench.run(3000), "reference")


def test_run_is_sent_again_where_it_alone_feeds_it() -> None:
    bench = fed("TWO")
    frames = bench.run(4000)
    runs = motions(bench, frames)
    assert {(each.address, each.word) for each in runs} == {(0x1002, 1)}
    assert max(b.ms - a.ms for a, b in pairwise(runs)) <= TIME_MS / 2
    assert not sent(bench, frames, "reference")
    bench.put(SpeedReferenceHz=10.0)
    runs = motions(bench, bench.run(3000))
    assert max(b.ms - a.ms for a, b in pairwise(runs)) <= TIME_MS / 2
    bench.put(SpeedReferenceHz=40.0)
    runs = motions(bench, bench.run(5000))
    assert max(b.ms - a.ms for a, b in pairwise(runs)) <= TIME_MS / 2
    bench.put(RunForward=False)
    assert not motions(bench, bench.run(9000)[2:])


def test_a_foreign_master_keeps_no_run_from_a_watchdog_that_only_run_feeds() -> None:
    """The motor stopped when its watchdog had starved."""
    bench = fed("TWO")
    bench.ms = 5  # so that foreign frames and replies come in scans of their own
    for _ in range(40):
        bench.foreign(bytes([9, 3, 0x10, 0, 0, 1]))
        bench.run(70)
    assert bench.block["TheLine.ErrorID"] == 54
    runs = motions(bench, bench.run(3000))
    assert max(b.ms - a.ms for a, b in pairwise(runs)) <= TIME_MS / 2
    assert bench.reason() == "RUNS"


def test_run_is_not_sent_again_after_a_stop_key() -> None:
    """The drive says that it runs until it stands; its frequency falls."""
    bench = fed("TWO")
    bench.drives[0].keypad_stop()
    bench.run(300)
    assert bench.drives[0].mode == "ramping down"
    assert not motions(bench, bench.run(12_000))
    assert bench.drives[0].mode == "standstill"


def test_a_run_that_stays_unanswered_once_is_sent_again_after_a_read() -> None:
    bench = fed("TWO")
    lost: list[int] = []

    def lose(frame: object, reply: bytes | None) -> bytes | None:
        if not lost and motions(bench, [frame]):  # type: ignore[list-item]  # a frame
            lost.append(bench.now)
            return None
        return reply

    bench.spoil = lose
    bench.until(lambda: lost)
    assert motions(bench, bench.run(1500))
    assert bench.reason() == "RUNS"
