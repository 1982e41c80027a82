"""A drive block at the drive of another make: the stop of one is the run of another, so nothing is written to it."""

from collections.abc import Callable

import pytest
from tests.blocks.compare.comparison import beside
from tests.drives.strangers import PAIRS, Strange
from tests.second.line import Faults, Frame
from tests.second.pf4 import VARIANTS
from tests.second.station import built

from structured_text.engines.engine import Engine

POWERFLEX = ("PF4", *VARIANTS)
OWN_ADDRESS = {"PF525": 0x7C, "GD200A": 0x0E00, "SN300G5": 0x041C}
"""Where these show their unit address, by their manuals."""
FEW = [
    ("PF525", "GD200A"), ("GD200A", "PF4"), ("JSCC", "CHF"), ("PF525", "CHF"), ("GD200A", "CHF"), ("SN300G5", "MX2"),
]  # fmt: skip
TAKEN = {("CHF", "GD200A")}
"""A word at 1000H is by the text of 9.5.1 a parameter of the other, which the table of its map does not reach."""


@pytest.mark.parametrize(("block", "drive"), FEW)
def test_it_is_told_from_another_make_before_its_first_stop(block: str, drive: str) -> None:
    bench = Strange((block,), (drive,)).restart()
    bench.run(8000)
    bench.put(RunForward=True, Enable=False).run(1000)
    bench.put(Enable=True, CoastStop=True).line(StopAll=True).run(1000)
    assert (bench.drives[0].turned, bench.drives[0].changes) == (0.0, [])
    assert bench.reason() == "OTHER_DRIVE"
    assert bench.shows("StopOverdue")
    assert bench.block["TheLine.StopOverdue"]


@pytest.mark.thorough
def test_they_are_told_apart_on_matiec(matiec: Engine) -> None:
    for engine in beside(matiec).values():
        library = built(engine, [(one,) for one in dict(FEW)])
        for block, drive in FEW:
            bench = Strange((block,), (drive,), library).restart()
            bench.run(4000)
            assert (bench.drives[0].turned, bench.drives[0].changes) == (0.0, [])
            assert bench.reason() == "OTHER_DRIVE"
            Strange((block,), (block,), library).restart().stopped()


@pytest.mark.thorough
@pytest.mark.parametrize(("block", "drive"), PAIRS)
def test_no_stop_moves_a_drive_of_another_make(block: str, drive: str) -> None:
    bench = Strange((block,), (drive,)).restart()
    bench.run(8000)
    bench.put(RunForward=True, Enable=False).run(1000)
    one = bench.drives[0]
    assert one.turned == 0.0
    assert not one.drive.output
    if not (block in POWERFLEX and drive in POWERFLEX):
        assert bool(one.changes) == ((block, drive) in TAKEN)


@pytest.mark.parametrize(("block", "drive"), [("PF525", "GD200A"), ("JSCC", "CHF")])
def test_drives_that_are_swapped_at_their_addresses_are_not_moved(block: str, drive: str) -> None:
    swapped(block, drive)


@pytest.mark.thorough
@pytest.mark.parametrize(("block", "drive"), [(one, other) for one, other in PAIRS if one < other])
def test_no_pair_that_is_swapped_is_moved(block: str, drive: str) -> None:
    swapped(block, drive)


def swapped(block: str, drive: str) -> None:
    """Two blocks, each at the address of the other's drive."""
    bench = Strange((block, drive), (drive, block)).restart()
    bench.run(8000)
    bench.line(StopAll=True).run(1000)
    assert [one.turned for one in bench.drives] == [0.0, 0.0]
    if not (block in POWERFLEX and drive in POWERFLEX):
        for one, pair in zip(bench.drives, ((block, drive), (drive, block)), strict=True):
            assert bool(one.changes) == (pair in TAKEN)


def test_a_new_address_is_read_first_and_the_old_one_ends_it() -> None:
    bench = Strange(("PF525", "GD200A"), ("PF525", "GD200A"))
    bench.leave("Skip1").restart().stopped()
    bench.put(Address=2).run(6000)
    assert bench.reason() == "OTHER_DRIVE"
    assert (bench.drives[1].turned, bench.drives[1].changes) == (0.0, [])
    bench.put(Address=1).stopped()


def reads(frames: list[Frame], register: int) -> list[Frame]:
    """The reads of a register."""
    return [each for each in frames if each.read and each.address == register]


@pytest.mark.parametrize("kind", list(OWN_ADDRESS))
def test_its_own_drive_shows_its_address_twice_and_is_stopped_soon(kind: str) -> None:
    bench, overdue = Strange((kind,), (kind,)), list[object]()
    bench.watch.append(lambda each: overdue.append(each.block["TheLine.StopOverdue"]))
    bench.restart().stopped()
    assert not any(overdue[1:])
    first = next(at for at, each in enumerate(bench.frames) if not each.read)
    # twice, and the line repeats a standing read until its block has seen the answer
    assert 2 <= len(reads(bench.frames[:first], OWN_ADDRESS[kind])) <= 4
    assert bench.number("FirstStopMs") == pytest.approx(bench.frames[first].ms, abs=60)
    assert bench.number("FirstStopMs") < 400
    assert not bench.shows("StopOverdue")
    assert not reads(bench.run(3000), OWN_ADDRESS[kind])


def answer(bench: Strange, what: Callable[[int], bytes | None], register: int = 0x7C) -> None:
    """Answers to the n-th read of a register, from 0; None: its own."""
    seen = [0]

    def spoil(frame: Frame, reply: bytes | None) -> bytes | None:
        if frame.address != register or not frame.read:
            return reply
        seen[0] += 1
        return what(seen[0] - 1) or reply

    bench.spoil = spoil


OTHER = bytes([1, 3, 2, 0, 9])
REFUSED, BUSY = bytes([1, 0x83, 2]), bytes([1, 0x83, 6])


@pytest.mark.parametrize("wrong", [OTHER, REFUSED])
def test_one_contrary_answer_is_not_believed_and_two_are(wrong: bytes) -> None:
    one = Strange(("PF525",), ("PF525",))
    answer(one, lambda at: wrong if at == 0 else None)
    one.restart().stopped()
    two = Strange(("PF525",), ("PF525",))
    answer(two, lambda at: wrong if at < 3 else None)  # a repeated refusal is one
    two.restart().until(lambda: two.reason() == "OTHER_DRIVE", 1000)
    assert two.block["TheLine.StopOverdue"]
    assert not two.drives[0].changes
    two.stopped()  # by right answers
    assert not two.shows("StopOverdue")


def test_a_busy_drive_is_not_another_one() -> None:
    bench = Strange(("PF525",), ("PF525",))
    answer(bench, lambda at: BUSY if at < 20 else None)
    bench.restart().until(lambda: bench.shows("StopConfirmed"), 12_000)
    assert len(reads(bench.frames, 0x7C)) >= 22
    assert all(each.ms > reads(bench.frames, 0x7C)[20].ms for each in bench.frames if not each.read)


def test_an_answer_that_may_be_another_masters_does_not_count() -> None:
    bench = Strange(("PF525",), ("PF525",)).restart()
    bench.block["Slots[0].Doubtful"] = True
    bench.watch.append(lambda each: each.block.__setitem__("Slots[0].Doubtful", True))
    assert all(each.read for each in bench.run(3000))
    bench.watch.clear()
    bench.block["Slots[0].Doubtful"] = False
    bench.stopped()


def test_a_silent_drive_gets_its_stop_and_one_whose_answers_are_damaged_gets_none() -> None:
    silent = Strange(("PF525",), ("PF525",))
    silent.deaf = {1}
    assert [each for each in silent.restart().run(5000) if not each.read]
    damaged = Strange(("PF525",), ("PF525",))
    damaged.faults = Faults(garbled=1000)
    assert all(each.read for each in damaged.restart().wait(25_000))
    damaged.deaf, damaged.faults = {1}, Faults()
    assert all(each.read for each in damaged.wait(30_000))
    assert damaged.block["TheLine.StopOverdue"]
    damaged.deaf = set()
    damaged.stopped()
