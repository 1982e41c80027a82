"""The reads of a drive block: typed by hand for the shipped maps, and the cheapest of all ways for made-up ones."""

from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import combinations

import pytest
from tests.shipped import drives

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Drive, Measured, Register, Scale
from driveblocks.meaning.polls import MOST_POLLS, Poll, polls, schedule, wire_ms

SHIPPED = drives()


def test_sn300g5_needs_three_reads() -> None:
    """000FH (meaning) and 0010H (status) in one; 0021H, 0022H, 0026H, 0027H in one; 0014H-0018H (faults) in one.

    0013H is listed as unused, and 001BH-001FH are in no table, so that nothing may be read over them.
    """
    assert polls(SHIPPED["SN300G5"]) == (
        Poll(3, 0x000F, 2, fast=True),
        Poll(3, 0x0021, 7, fast=True),
        Poll(3, 0x0014, 5, fast=False),
    )


def test_jscc_needs_two_reads() -> None:
    """2000H and 2001H are frequency and status; 3000H is the fault, and nothing between is in a table."""
    assert polls(SHIPPED["JSCC"]) == (Poll(3, 0x2000, 2, fast=True), Poll(3, 0x3000, 1, fast=False))


def test_chf_needs_three_reads() -> None:
    """1001H is the status; 3000H-3006H all measures, 7 words, just what an ASCII reply of 16 data bytes holds.

    5000H is the fault; read with 5001H after it, its reply cannot pass for one to 1001H.
    """
    assert polls(SHIPPED["CHF"]) == (
        Poll(3, 0x1001, 1, fast=True),
        Poll(3, 0x3000, 7, fast=True),
        Poll(3, 0x5000, 2, fast=False),
    )


def test_the_smaller_limit_of_both_modes_holds() -> None:
    """With 6 words in ASCII, 3000H-3006H no longer fit into one; the fast read gets 3000H, and one more word."""
    drive = SHIPPED["CHF"]
    assert drive.limits.ascii_data_bytes
    small = replace(
        drive, limits=replace(drive.limits, ascii_data_bytes=replace(drive.limits.ascii_data_bytes, value=13))
    )
    assert [(poll.address, poll.words, poll.fast) for poll in polls(small)] == [
        (0x1001, 1, True), (0x3000, 2, True), (0x5000, 1, False), (0x3002, 5, False)
    ]  # fmt: skip


def made_up(
    status: Sequence[int], frequency: int, others: Sequence[int] = (), rows: Sequence[Span] = (Span(0, 0x7F),)
) -> Drive:
    """A drive with status words, an output frequency and other measures, and rows that may be read."""
    base = SHIPPED["SN300G5"]
    section = replace(base.sections[1], registers=tuple(Register(address=row) for row in rows))
    shows = [("output_frequency", frequency), *(("output_current", other) for other in others)]
    operation = replace(
        base.operation,
        standstill=replace(base.operation.standstill, all=tuple(Condition(register=at, equals=0) for at in status)),
        status=(),
        measures=tuple(Measured(shows=what, register=at, source="made up") for what, at in shows),  # type: ignore[arg-type]
        reference=replace(base.operation.reference, verify=()),
    )
    faults = replace(base.faults, bits=None, present=None)
    return replace(base, sections=(section,), operation=operation, faults=faults)


@pytest.mark.parametrize(
    ("hole", "reads"), [(11, [(0, 13)]), (12, [(13, 1), (0, 2)])], ids=["as dear as 22", "dearer than 23 characters"]
)
def test_a_hole_is_read_over_while_that_is_cheaper(hole: int, reads: list[tuple[int, int]]) -> None:
    assert [(poll.address, poll.words) for poll in polls(made_up([0], hole + 1))] == reads


def test_nothing_is_read_over_a_register_that_no_table_lists() -> None:
    apart = made_up([0], 2, rows=(Span(0, 0), Span(2, 2)))
    assert [(poll.address, poll.words) for poll in polls(apart)] == [(2, 1), (0, 1)]


def test_an_area_may_be_read_and_not_be_read_over() -> None:
    """Its rule tells where a parameter would be, not that there is one."""
    drive = made_up([0x0200], 0x0202, rows=())
    drive = replace(drive, areas=(replace(SHIPPED["CHF"].areas[0], addresses=Span(0x0200, 0x0300)),))
    assert [(poll.address, poll.words) for poll in polls(drive)] == [(0x0202, 1), (0x0200, 1)]


def test_a_slow_word_rides_with_a_fast_one_and_makes_no_other_fast() -> None:
    found = polls(made_up([0x10], 0x11, others=[0x12, 0x40, 0x41]))
    assert found == (Poll(3, 0x10, 3, fast=True), Poll(3, 0x40, 2, fast=False))


def test_what_a_scale_depends_on_is_read() -> None:
    drive = made_up([0], 1)
    scale = Scale(factor=Decimal("0.1"), source="made up", when=Condition(register=0x60, equals=0))
    rows = (Register(address=Span(0, 0)), Register(address=Span(1, 1), scale=scale), Register(address=Span(2, 0x7F)))
    drive = replace(drive, sections=(replace(drive.sections[0], registers=rows),))
    assert polls(drive)[1] == Poll(3, 0x60, 1, fast=False)


def test_a_drive_with_function_04_alone_is_read_by_it() -> None:
    drive = made_up([0], 1)
    drive = replace(drive, functions=(replace(drive.functions[0], code=4),))
    assert polls(drive) == (Poll(4, 0, 2, fast=True),)


def test_a_word_that_cannot_be_read_is_named() -> None:
    with pytest.raises(ValueError, match="0080H, which the map does not let it read"):
        polls(made_up([0], 0x80))


def test_more_reads_than_a_plan_holds_are_refused() -> None:
    apart = [13 * each for each in range(MOST_POLLS + 1)]
    rows = [Span(0, 0xFF)]
    assert len(polls(made_up(apart[1:-1], apart[0], rows=rows))) == MOST_POLLS
    with pytest.raises(ValueError, match="13 reads; 12 fit"):
        polls(made_up(apart[1:], apart[0], rows=rows))


@pytest.mark.parametrize("words", [(0, 3, 9, 20, 31, 33), (0, 11, 13, 14, 27, 40), (0, 12, 15, 16, 17, 30, 46)])
def test_no_other_way_is_cheaper(words: tuple[int, ...]) -> None:
    """Every way to cut the words into runs of at most 16, against the plan."""
    found = polls(made_up(words[1:], words[0]))
    costs = []
    for cuts in range(len(words)):
        for at in combinations(range(1, len(words)), cuts):
            runs = [words[a:b] for a, b in zip((0, *at), (*at, len(words)), strict=True)]
            if all(run[-1] - run[0] < 16 for run in runs):
                costs.append(sum(23 + 2 * (run[-1] - run[0] + 1) for run in runs))
    needed = [[word for word in words if poll.address <= word < poll.address + poll.words] for poll in found]
    assert min(costs) == sum(23 + 2 * (each[-1] - each[0] + 1) for each in needed)


def test_no_two_reads_have_one_length() -> None:
    """A late reply to one would pass for that to the other; only where nothing may be read beyond, two are alike."""
    assert [poll.words for poll in polls(made_up([0], 0x20, others=[0x30, 0x40, 0x48]))] == [1, 2, 3, 9]
    assert [poll.words for poll in polls(made_up([0], 2, rows=(Span(0, 0), Span(2, 2))))] == [1, 1]


def test_the_schedule_sends_all_fast_ones_before_each_slow_one() -> None:
    def of(*fast: bool) -> tuple[int, ...]:
        return schedule(tuple(Poll(3, 0, 1, each) for each in fast))

    assert of(True, True, False, False) == (0, 1, 2, 0, 1, 3)
    assert of(True) == (0,)
    assert of(True, False, False) == (0, 0, 1, 0, 0, 2)
    assert schedule(polls(SHIPPED["SN300G5"])) == (0, 1, 2)
    assert schedule(polls(SHIPPED["CHF"])) == (0, 1, 2)


def test_wire_time_is_that_of_the_characters_and_pauses() -> None:
    """8 and 9 characters of 10 bits at 19200 bit/s are 8.85 ms, two silences of 3.5 characters 3.65, turn-round 5."""
    poll = Poll(3, 0x2000, 2, fast=True)
    assert wire_ms(poll, 19200, 10, 5) == pytest.approx(17.5)
    assert wire_ms(poll, 19200, 10, 5, 10) == pytest.approx(17 / 1.92 + 25)
    # above 19200 bit/s the silence is 1.75 ms; in ASCII there is none, and 17 and 19 characters
    assert wire_ms(poll, 38400, 10, 5) == pytest.approx(17 / 3.84 + 5 + 3.5)
    assert wire_ms(poll, 19200, 10, 5, None) == pytest.approx(36 / 1.92 + 5)
