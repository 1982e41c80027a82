"""Parts of the line, each alone: a call's time, what all drives show, frames that nobody here has asked for."""

import pytest
from tests.line.vline import library

from structured_text.engines.engine import Instance, Value

FOREIGN, DOUBLED, SHARED, PORT, STANDS, OVERDUE = 54, 55, 56, 57, 58, 61
REPLY, REQUEST, LATE, EITHER = 1, 2, 3, 4


def part(name: str, **pins: Value) -> Instance:
    """A block of the line; `__` in a pin is a dot."""
    block = library().instance(name)
    wire(block, **pins)
    return block


def wire(block: Instance, **pins: Value) -> None:
    """Set pins."""
    for pin, value in pins.items():
        block[pin.replace("__", ".")] = value


def called(block: Instance, **pins: Value) -> Instance:
    """One call."""
    wire(block, **pins)
    block.scan()
    return block


def number(block: Instance, name: str) -> int:
    """A number that the block shows."""
    value = block[name]
    assert isinstance(value, int)
    return value


def test_the_first_call_and_a_late_one_are_restarts() -> None:
    scan = part("MB_Scan", ElapsedMs=10)
    anew = [called(scan, ElapsedMs=ms)["Anew"] for ms in (10, 10, 1000, 1001, 10)]
    assert anew == [True, False, False, True, False]
    assert (scan["Passed"], scan["LongestMs"], scan["LateScans"]) == (10, 1001, 2)


def test_the_clock_wraps_and_a_restart_shifts_it() -> None:
    scan = part("MB_Scan", ElapsedMs=10, FirstRestarts=2, Given__Clock=59_995)
    assert called(scan)["Given.Clock"] == 59_998
    assert called(scan)["Given.Clock"] == 8
    assert scan["BeforeMs"] == 59_998


def test_a_clock_of_memory_that_was_left_comes_back() -> None:
    scan = part("MB_Scan", ElapsedMs=10, Given__Clock=65_535)
    assert number(called(scan), "Given.Clock") < 60_000


def test_time_that_stands_counts_as_a_millisecond_a_call() -> None:
    scan = called(part("MB_Scan", ElapsedMs=10), ElapsedMs=0)
    seen = [(called(scan)["Passed"], scan["Stands"]) for _ in range(99)]
    assert seen == [(0, False)] * 98 + [(1, True)]
    assert scan["Given.OnlyStops"]


def test_stop_all_is_new_once_and_again_after_a_restart() -> None:
    scan = called(part("MB_Scan", ElapsedMs=10))
    assert [called(scan, StopAll=True)["Given.StopsAll"] for _ in range(2)] == [True, False]
    assert called(scan, Restart=True)["Given.StopsAll"]
    assert (scan["Given.Restarts"], called(scan)["Given.Restarts"]) == (False, True)


def test_the_load_of_a_second() -> None:
    scan = called(part("MB_Scan", ElapsedMs=10))
    for _ in range(100):
        called(scan, IsOpen=number(scan, "SecondMs") < 250)
    assert scan["LoadPercent"] == 25


def drives(**pins: Value) -> Instance:
    """Drives that answer, in slots 0 and 1, the second with these pins; slot 3 rests."""
    block = part("MB_Drives", Used=True, Counts=True, Online=True, Resting=1)
    called(block)
    called(block, Slot=1, **pins)
    return block


@pytest.mark.parametrize(
    ("pins", "end", "shows"),
    [
        ({}, {}, (0, 0, 0)),
        ({"Shared": True}, {}, (SHARED, 1, 0)),
        ({"Doubled": 1}, {}, (DOUBLED, 1, 0)),
        ({"Doubled": 2, "Shared": True, "Overdue": True}, {}, (DOUBLED, 1, OVERDUE)),
        ({"Overdue": True}, {"Foreign": True}, (FOREIGN, 0, FOREIGN)),
        ({"Shared": True}, {"Foreign": True, "Twice": True}, (SHARED, 1, SHARED)),
        ({"Doubled": 1}, {"Stands": True, "Twice": True}, (STANDS, 0, STANDS)),
        ({"Doubled": 1}, {"Stands": True, "PortFails": True}, (PORT, 0, PORT)),
    ],
)
def test_the_worst_of_what_is_wrong(pins: dict[str, Value], end: dict[str, Value], shows: tuple[int, ...]) -> None:
    block = called(drives(**pins), Ends=True, **end)
    assert (block["ErrorID"], block["ErrorSlot"], block["CommonErrorID"]) == shows


def test_how_many_answer() -> None:
    block = called(drives(Vain=1, NewStop=True), Ends=True)
    assert (block["OnlineCount"], block["Healthy"], block["AllOnline"], block["StopWaits"]) == (3, 2, True, True)
    assert called(drives(Online=False), Ends=True)["AllOnline"] is False
    assert called(drives(Online=False, Counts=False), Ends=True)["AllOnline"] is True
    assert called(drives(Used=False), Ends=True)["OnlineCount"] == 2
    called(block, Ends=True, Resting=0)
    assert (block["OnlineCount"], block["AllOnline"], block["StopWaits"]) == (0, False, False)


def stray(found: int, **pins: Value) -> Instance:
    """One frame."""
    return called(
        part("MB_Stray", Found=found, TurnRoundMs=20, LongestMs=100, **{"Online": True, "Surplus": 255, **pins})
    )


def test_a_late_reply_is_a_measure() -> None:
    block = stray(LATE, ReplyMs=30, LateOwed=2, LongestReplyMs=8)
    shown = ("Ours", "LateOwed", "Late", "LateReplies", "LongestReplyMs", "Surplus")
    assert [block[name] for name in shown] == [True, 1, 1, 1, 30, 255]
    assert stray(REPLY, ReplyMs=30, LateOwed=1, LateMs=60)["LongestReplyMs"] == 60


def test_beside_another_master_it_is_a_doubt_and_no_measure() -> None:
    block = stray(LATE, ReplyMs=30, LateOwed=1, LongestReplyMs=8, Doubts=True)
    assert (block["Ours"], block["LongestReplyMs"], block["Surplus"]) == (True, 8, 0)


def test_a_late_reply_of_a_dead_drive_brings_its_probe() -> None:
    assert stray(LATE, LateOwed=1, PauseMs=900)["PauseMs"] == 900
    assert stray(LATE, LateOwed=1, PauseMs=900, Online=False)["PauseMs"] == 0


def test_another_masters_request_is_waited_for_once() -> None:
    block = stray(REQUEST, LateOwed=1, RestedMs=5)
    assert (block["Ours"], block["ForeignMs"], block["PauseMs"], block["Surplus"]) == (False, 25, 25, 255)
    assert stray(REQUEST, ForeignMs=3)["PauseMs"] == 0
    assert not stray(REQUEST, LateOwed=1, TwoByteCount=True)["Ours"]
    assert [stray(EITHER, LateOwed=1, TwoByteCount=two)["Ours"] for two in (False, True)] == [False, True]


def test_what_waited_for_another_masters_reply_waits_no_longer_than_that() -> None:
    """A panel that asks more often than the drive may take to answer kept the line from reading it at all."""
    assert stray(REPLY, ForeignMs=25, PauseMs=25)["PauseMs"] == 0
    assert stray(REPLY, ForeignMs=25, PauseMs=26)["PauseMs"] == 26
    assert stray(REPLY, ForeignMs=25, PauseMs=25, Online=False)["PauseMs"] == 25


def test_a_reply_that_nobody_has_asked_for_is_a_surplus() -> None:
    block = stray(REPLY, ForeignMs=25, LateOwed=1)
    assert (block["Ours"], block["ForeignMs"], block["Surplus"]) == (False, 0, 0)


@pytest.mark.parametrize(("first", "waits"), [(True, 60), (False, 0)])
def test_a_read_that_has_not_waited_may_have_got_the_reply_before(first: bool, waits: int) -> None:
    """What is read before the first stop waits for no late reply; each one after it was taken for the next."""
    pins = {"Event": 1, "Online": True, "PollFirst": first, "LongestMs": 60, "Polled": True}
    block = called(part("MB_Life", **pins, Track__LateOwed=1, Track__LateMs=5))
    assert (block["Track.WaitMs"], block["Track.LateMs"]) == (waits, waits or 5)


@pytest.mark.parametrize(
    ("back", "forced", "lost", "left"),
    [(True, 4, False, 0), (False, 4, False, 4), (True, 2, True, 0), (True, 2, False, 2), (False, 2, True, 2)],
)
def test_a_block_that_is_back_sends_its_own_stop_to_a_drive_that_refuses_the_lines(
    back: bool, forced: int, lost: bool, left: int
) -> None:
    """The line's were refused for good; the block never learned that, and no standstill ended them."""
    pins = {"Number": 36, "Answered": 32, "Tried": 34, "StopAgain": True, "HasCode": True, "BlockIsBack": back}
    track = {"Track__Forced": forced, "Track__Lost": lost, "Track__PendingMs": 500}
    assert called(part("MB_Stop", Passed=10, Online=True, **pins, **track))["Track.Forced"] == left
