"""A drive whose map has an identity: nothing is written before it has shown what it is; and its own maximum counts."""

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import pytest
from tests.drives.words import sent
from tests.second.line import Bench, Frame

PLATE, MAXIMUM = 0x2003, 0x2004
"""The registers by which the made-up drive is known, and of its own maximum, in tenths of a hertz."""
OTHER = 0x0999


def writes(bench: Bench, frames: list[Frame]) -> list[Frame]:
    """The writes among them that a drive has acknowledged."""
    return [each for each in frames if not each.read and each in bench.acknowledged]


def another(bench: Bench, drive: int = 0) -> None:
    """Put a drive of another make at the address; it would obey."""
    bench.drives[drive].set(PLATE, OTHER)
    bench.drives[drive].keypad_run(20.0)


def bench(*types: str) -> Bench:
    """A line that is not started yet."""
    return Bench(*(types or ("CIA",)), start=False)


@pytest.mark.parametrize("again", [False, True])
def test_its_identity_is_read_before_anything_is_written(again: bool) -> None:
    one = bench().restart()
    if again:
        one.stopped().restart()
    start = len(one.frames)
    one.run(100)
    one.stopped()
    frames = one.frames[start:]
    first = next(index for index, each in enumerate(frames) if not each.read)
    assert [each for each in frames[:first] if each.address == PLATE and each in one.acknowledged]
    assert one.number("FirstStopMs") > 0
    assert one.out("IdentityRead") == one.out("IdentityWanted") == 0x0312


def begin(one: Bench) -> None:
    """A drive of another make from the beginning."""
    another(one)
    one.restart()


def stop_all(one: Bench) -> None:
    """The stop of all drives."""
    begin(one)
    one.run(3000)
    one.line(StopAll=True)


def restarted(one: Bench) -> None:
    """Exchanged while the PLC starts again."""
    one.restart().running()
    one.put(RunForward=False).stopped()
    another(one)
    one.restart()


def moved(one: Bench) -> None:
    """A new address, at which there is another one."""
    one.restart().stopped()
    one.drives[0].unit = 9
    another(one)
    one.put(Address=9)


def left(one: Bench) -> None:
    """Its block is no longer called."""
    begin(one)
    one.run(3000)
    one.leave("Skip0")


def exchanged(one: Bench, *, off: bool) -> None:
    """Exchanged while it is silent, with SupplyOff or without."""
    one.restart().running()
    one.put(RunForward=False).stopped()
    one.put(SupplyOff=off)
    one.deaf = {1}
    one.run(5000 if off else 14_000)
    another(one)
    one.deaf = set()


@pytest.mark.parametrize(
    "come",
    [begin, stop_all, restarted, moved, left, partial(exchanged, off=False), partial(exchanged, off=True)],
    ids=["power-up", "StopAll", "restart", "address", "not called", "silence", "supply"],
)
def test_not_one_write_reaches_another_drive(come: Callable[[Bench], None]) -> None:
    one = bench()
    come(one)
    before = len(one.frames)
    one.run(12_000)
    one.put(RunForward=True, Enable=False).run(2000)
    one.put(Enable=True, CoastStop=True).run(2000)
    assert one.drives[0].hertz > 0
    assert writes(one, one.frames[before:]) == []
    assert [each for each in one.frames[before:] if each.address == PLATE]
    if come is not left:
        assert one.reason() == "OTHER_DRIVE"
        assert one.shows("StopOverdue")
        assert not one.shows("CommOk")
        assert (one.out("IdentityRead"), one.out("IdentityWanted")) == (OTHER, 0x0312)
        assert one.out("ErrorID") == 73
    assert one.block["TheLine.StopOverdue"]


def test_a_refusal_is_another_drive() -> None:
    one = bench()
    one.spoil = lambda frame, reply: bytes([1, 0x83, 2]) if frame.address == PLATE else reply
    frames = one.restart().run(8000)
    assert one.reason() == "OTHER_DRIVE"
    assert not writes(one, frames)


def test_an_unanswered_read_does_not_keep_the_stop_back() -> None:
    """It may hear, and not be heard."""
    one = bench()
    one.deaf = {1}
    one.restart().until(lambda: not all(each.read for each in one.frames), 6000)
    first = len(one.frames) - 1
    one.run(100)
    assert 2 <= len([each for each in one.frames[:first] if each.address == PLATE]) <= 3  # while a late reply may come
    assert one.number("FirstStopMs") == pytest.approx(one.frames[first].ms, abs=60)
    later = one.run(20_000)
    kinds = [each.read for each in later]
    assert not any(a == b is False for a, b in pairwise(kinds)), "a read is sent before each stop"
    assert len([each for each in later if not each.read]) >= 2
    one.deaf = set()
    one.stopped()


def test_another_address_ends_it() -> None:
    one = bench()
    begin(one)
    one.run(3000)
    assert one.reason() == "OTHER_DRIVE"
    one.drives[0].set(PLATE, 0x0312)
    one.run(3000)
    assert one.reason() == "OTHER_DRIVE"
    one.drives[0].unit = 5
    one.put(Address=5).stopped()
    assert one.drives[0].mode == "standstill"


def test_a_drive_that_was_silent_is_looked_at_again_and_goes_on() -> None:
    one = bench().restart().running()
    one.put(RunForward=False).stopped()
    one.deaf = {1}
    one.run(14_000)
    one.deaf = set()
    one.stopped().running()
    assert [each for each in one.frames if each.address == PLATE]


def test_a_shorter_silence_leaves_it_known() -> None:
    one = bench().restart().stopped()
    one.deaf = {1}
    one.run(7000)
    one.deaf = set()
    before = len(one.frames)
    one.stopped()
    assert not [each for each in one.frames[before:] if each.address == PLATE]


def test_its_own_maximum_must_be_full_scale() -> None:
    one = bench()
    one.drives[0].set(MAXIMUM, 600)
    one.restart().run(4000)
    frames = one.put(RunForward=True).run(2000)
    assert one.reason() == "OTHER_MAXIMUM"
    assert one.number("OwnMaximumHz") == pytest.approx(60.0)
    assert not [each for each in sent(one, frames, "run_forward") if each.word == 0xF]
    one.put(RunForward=False, FullScaleHz=60.0).running()
