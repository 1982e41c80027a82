"""A drive that answers, each time after its timeout: a reason of its own, which a dead one never has."""

from itertools import cycle

import pytest
from tests.second.line import Bench, Frame

LATE_MS, TIMELY_MS = 500, 5
"""Replies 250 ms after their timeout, and as they should be."""


def slow(*delays: int, kind: str = "CHF") -> Bench:
    """A line with one drive, from power-up: how long it takes to answer, by turns."""
    bench = Bench(kind, start=False).put(TurnRoundMs=250, LongestMs=500)
    return delayed(bench, *delays or (LATE_MS,)).restart()


def delayed(bench: Bench, *delays: int) -> Bench:
    """Its drive takes so long to answer, by turns."""
    turns = cycle(delays)

    def turn(_: Frame, reply: bytes | None) -> bytes | None:
        bench.drives[0].turn_us = 1000 * next(turns)
        return reply

    bench.spoil = turn
    return bench


def shown(bench: Bench, ms: int) -> list[str]:
    """The reasons that it shows in turn in this time."""
    reasons = [bench.reason()]
    end = bench.now + 1000 * ms
    while bench.now < end:
        bench.scan()
        reasons += [bench.reason()] * (bench.reason() != reasons[-1])
    return reasons


@pytest.mark.parametrize("kind", ["CHF", "PF4"])
def test_a_drive_that_was_never_in_time_has_a_reason_of_its_own_until_it_is(kind: str) -> None:
    bench = slow(kind=kind)
    assert shown(bench, 9000) == ["RESTARTED", "NO_REPLY", "LATE_REPLIES"]
    assert not bench.shows("CommOk")
    bench.block["Port.LateMs"] = 350
    bench.put(StaleMs=20_000)  # else such a line is too slow for it
    bench.until(lambda: bench.shows("StopConfirmed") and bench.reason() == "READY", 12_000)


def test_replies_of_which_few_are_in_time_make_it_no_silent_drive() -> None:
    assert shown(slow(500, 240, 450, 500, 230, 240, 400), 20_000) == ["RESTARTED", "NO_REPLY", "LATE_REPLIES"]


def test_a_run_that_ends_by_late_replies_says_so_and_silence_after_them_is_silence() -> None:
    bench = slow(TIMELY_MS).running()
    delayed(bench, LATE_MS).until(lambda: bench.reason() == "LATE_REPLIES")
    assert bench.number("StopReason") == 52
    assert shown(bench, 9000) == ["LATE_REPLIES"]
    bench.deaf = {1}
    assert shown(bench, 9000) == ["LATE_REPLIES", "OFFLINE"]
    bench.deaf.clear()
    assert shown(bench, 9000) == ["OFFLINE", "LATE_REPLIES"]
    delayed(bench, TIMELY_MS).until(lambda: bench.shows("StopConfirmed"), 12_000)
    assert "LATE_REPLIES" not in shown(bench, 500)


def test_a_dead_drive_never_has_it() -> None:
    bench = slow(TIMELY_MS)
    bench.deaf = {1}
    assert shown(bench, 9000) == ["RESTARTED", "NO_REPLY"]
    bench.deaf.clear()
    bench.stopped()
    bench.block["Slots[0].Timeouts"] = 0
    delayed(bench, LATE_MS).until(lambda: bench.block["Slots[0].Timeouts"] == 1)
    delayed(bench, TIMELY_MS).run(1000)
    assert (bench.block["Slots[0].Late"], bench.shows("CommOk")) == (1, True)
    bench.deaf = {1}
    assert "LATE_REPLIES" not in shown(bench, 9000)


def test_another_unit_is_not_late_because_one_before_it_was() -> None:
    bench = slow()
    bench.until(lambda: bench.reason() == "LATE_REPLIES")
    bench.put(Address=9)
    assert shown(bench, 9000)[-1] == "NO_REPLY"


@pytest.mark.parametrize(
    ("pins", "reason"),
    [({"SupplyOff": True}, "NO_SUPPLY"), ({"Address": 0}, "MISSING"), ({"Restart": True}, "RESTARTED")],
    ids=str,
)
def test_what_is_worse_comes_first(pins: dict[str, bool | int], reason: str) -> None:
    bench = slow()
    bench.until(lambda: bench.reason() == "LATE_REPLIES")
    if "Restart" in pins:
        bench.line(Restart=True)
    else:
        bench.put(**pins)
    bench.run(100)
    assert bench.reason() == reason


def test_beside_another_master_a_late_reply_may_be_one_to_it() -> None:
    bench = slow()
    bench.until(lambda: bench.reason() == "LATE_REPLIES")
    while bench.block["TheLine.ForeignFrames"] != 6:
        bench.foreign(bytes([9, 6, 0x10, 0, 0, 1]))
        bench.run(60)
    bench.run(40)
    assert bench.reason() == "NO_REPLY"
