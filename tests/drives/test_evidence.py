"""What another master reads proves nothing: evidence of standstill, of a trip, of a run that has ended.

The slot says of each reply whether it may be one to somebody else, and counts those that nobody has asked for. Both
are set here by hand, between the line and the drive block.
"""

import pytest
from tests.drives.words import sent, stops
from tests.second.line import Bench
from tests.second.station import MIXED

LONGEST_MS, TURN_ROUND_MS = 60, 20
"""As the bench sets it."""


def doubted(bench: Bench, *, on: bool = True) -> Bench:
    """Every read may be an answer to another master, or none."""
    bench.watch = [lambda one: one.block.__setitem__("Slots[0].Doubtful", on)]
    bench.block["Slots[0].Doubtful"] = on
    return bench


def surplus(bench: Bench, every_ms: int) -> Bench:
    """A reply that nobody has asked for, again and again."""

    def counts(one: Bench) -> None:
        one.block["Slots[0].Surplus"] = one.now // 1000 // every_ms % 256

    bench.watch = [counts]
    return bench


def acknowledged(bench: Bench) -> Bench:
    """Its pin falls, and its stop is acknowledged."""
    bench.put(RunForward=False)
    return bench.until(lambda: bench.out("Control.Acknowledged"))


def confirmed_after(bench: Bench) -> int:
    """From a motor at rest to the proof, ms."""
    bench.until(lambda: bench.drives[0].hertz == 0.0, 9000)
    begun = bench.now
    bench.until(lambda: bench.shows("StopConfirmed"))
    return (bench.now - begun) // 1000


@pytest.mark.parametrize("kind", MIXED)
def test_in_quiet_the_proof_takes_twice_the_longest_reply_and_two_reads(kind: str) -> None:
    bench = Bench(kind).running()
    reads = 2 * 3 * (20 + bench.ms) * 2
    assert LONGEST_MS < confirmed_after(acknowledged(bench)) <= 2 * LONGEST_MS + reads


@pytest.mark.parametrize("kind", MIXED)
def test_doubtful_reads_prove_no_standstill_and_say_why(kind: str) -> None:
    bench = doubted(acknowledged(Bench(kind).running()))
    bench.run(9000)
    assert bench.drives[0].hertz == 0.0
    assert bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")
    assert bench.reason() == "UNPROVED"
    doubted(bench, on=False).until(lambda: bench.shows("StopConfirmed"), 1000)
    assert bench.reason() != "UNPROVED"


def test_replies_in_excess_prove_no_standstill() -> None:
    bench = surplus(acknowledged(Bench("CHF").running()), TURN_ROUND_MS)
    bench.run(9000)
    assert not bench.shows("StopConfirmed")
    assert bench.reason() == "UNPROVED"
    surplus(bench, 10 * LONGEST_MS).until(lambda: bench.shows("StopConfirmed"), 1000)


def test_a_doubt_withdraws_no_proof() -> None:
    bench = doubted(Bench("CHF").stopped())
    for _ in range(100):
        bench.scan()
        assert bench.shows("StopConfirmed")
    surplus(bench, 40)
    for _ in range(100):
        bench.scan()
        assert bench.shows("StopConfirmed")


def test_a_doubtful_read_of_motion_counts_at_once() -> None:
    bench = doubted(Bench("CHF").stopped())
    bench.drives[0].keypad_run(20.0)
    frames = bench.run(300)
    assert stops(bench, frames)
    assert not bench.shows("StopConfirmed")


def test_a_doubtful_read_of_a_fault_counts_at_once() -> None:
    bench = doubted(Bench("CHF").running())
    bench.drives[0].trip(3)
    assert stops(bench, bench.run(300))
    assert bench.shows("Fault")


def test_a_run_that_seems_to_have_ended_ends_once_that_is_no_doubt() -> None:
    """Its refreshes end at once, for somebody may have pressed the stop key."""
    bench = doubted(Bench("CHF").put(RefreshMs=200, StaleMs=3000).running())
    bench.drives[0].keypad_stop()
    bench.until(lambda: not bench.shows("Running"), 9000)
    frames = bench.run(2000)
    assert not sent(bench, frames, "reference", "run_forward", "stop")
    doubted(bench, on=False)
    assert stops(bench, bench.run(200))
    assert bench.number("StopReason") == 46


def test_a_run_that_seems_to_have_ended_ends_when_that_lasts() -> None:
    bench = doubted(Bench("CHF").put(StaleMs=3000).running())
    bench.drives[0].keypad_stop()
    bench.until(lambda: not bench.shows("Running"), 9000)
    assert stops(bench, bench.run(3500))


def test_one_doubt_ends_no_run() -> None:
    """A master that reads another register of this drive reads 0, and its reply is taken for ours."""
    bench = Bench("CHF").running()

    def zero(frame: object, reply: bytes | None) -> bytes | None:
        return bytes(each if place < 3 else 0 for place, each in enumerate(reply)) if reply else reply

    bench.spoil = zero
    doubted(bench).run(300)
    bench.spoil = lambda _, reply: reply
    doubted(bench, on=False).run(2000)
    assert bench.drives[0].mode == "running"
    assert bench.reason() == "RUNS"


def test_a_trip_is_proved_like_a_standstill() -> None:
    bench = doubted(Bench("JSCC").running())
    bench.drives[0].trip(3)
    bench.run(6000)
    assert not bench.block["Slots[0].Tripped"]
    doubted(bench, on=False).run(1000)
    assert bench.block["Slots[0].Tripped"]


def test_settings_are_proved_before_a_start() -> None:
    bench = doubted(Bench("SN300G5"))
    bench.run(3000)
    assert not bench.out("Known.Seen.SettingsRead")
    doubted(bench, on=False).stopped()
