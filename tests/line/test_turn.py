"""Who speaks when: ranks, round robin, and nobody starves."""

from itertools import pairwise

import pytest
from tests.line.vline import COMMAND, PARAMETER, Bench, Config


def test_run_and_reset_before_parameter() -> None:
    bench = Bench(Config(drives=5)).ready()
    bench.ask(0, PARAMETER, 6, 0x100)
    bench.put(1, ResetAsked=True)
    bench.command(1)
    bench.command(2)
    asked = [each.unit for each in bench.run(500) if not each.read]
    assert (sorted(asked[:2]), asked[2:]) == ([2, 3], [1])


@pytest.mark.parametrize("drives", [1, 2, 3, 5])
def test_polls_and_commands_take_turns_under_a_stream_of_commands(drives: int) -> None:
    """Three reads, or as many as there are drives, then one command."""
    bench = Bench(Config(drives=drives)).ready()
    for _ in range(100):
        for slot in range(drives):
            if bench.answer(slot, COMMAND):
                bench.command(slot)
        bench.scan()
    sent = "".join("R" if each.read else "w" for each in bench.sent[-30:])
    assert {len(reads) for reads in sent.strip("R").strip("w").split("w")} == {min(drives, 3)}, sent


@pytest.mark.parametrize("noisy", [(0,), (0, 1, 2, 3)])
def test_constant_commands_hold_up_neither_a_reset_nor_a_parameter(noisy: tuple[int, ...]) -> None:
    """A reference that changed in every scan left no other time: the reset of another drive was never sent."""
    bench = Bench(Config(drives=5)).ready()
    bench.put(4, ResetAsked=True)
    bench.command(4)
    for slot in (0, 4):
        bench.ask(slot, PARAMETER, 3, 0x0777)
    for _ in range(60):
        for slot in noisy:
            if bench.answer(slot, COMMAND):
                bench.command(slot)
        bench.scan()
    assert [bench.answer(4, COMMAND), bench.answer(0, PARAMETER), bench.answer(4, PARAMETER)] == ["OK"] * 3


def test_the_next_request_is_sent_in_the_scan_of_the_reply() -> None:
    """Seven drives, six words, 19200 8N1, 10 ms: two scans per transaction where the port keeps the silence."""
    bench = Bench(Config(drives=7)).ready()
    assert len(bench.run(7 * 20 * 10)) >= 68
    keeps = Bench(Config(drives=7, keeps=False)).ready()
    assert len(keeps.run(7 * 30 * 10)) >= 68
    assert keeps.short == []


def test_the_largest_silence_on_the_line_counts_even_where_the_port_keeps_some() -> None:
    bench = Bench(Config(drives=2))
    bench.put(1, SilenceMs=25)
    bench.ready().run(200)
    starts = [each.ms for each in bench.run(500)]
    assert min(later - before for before, later in pairwise(starts)) >= 16 + 25


@pytest.mark.parametrize("stands", [True, False])
def test_one_address_twice_lets_only_reads_and_stops_out_and_the_others_go_on(stands: bool) -> None:
    """Both are overdue at once, unless the first is at standstill; that one is still read."""
    bench = Bench().ready()
    bench.put(1, StopConfirmed=stands)
    bench.put(2, StopConfirmed=True)
    bench.run(110)  # a slot at rest is looked at each 100 ms
    bench.put(2, UnitAddress=2)
    bench.run(100)
    assert (bench["ErrorID"], bench["ErrorSlot"]) in ((55, 1), (55, 2))
    assert [bench.slot(slot, "LineErrorID") for slot in range(3)] == [0 if stands else 61, 55, 55]
    assert [bench.slot(slot, "StopOverdue") for slot in range(3)] == [False, not stands, not stands]
    bench.command(0)
    bench.command(1)
    bench.stop(1)
    sent = bench.run(300)
    assert [each.stop for each in sent if each.unit == 2 and not each.read] == [True]
    assert len([each for each in sent if each.unit == 1]) >= 7  # of three drives
    assert bench.answer(0, COMMAND) == "OK"
    bench.put(2, UnitAddress=3)
    bench.run(600)
    assert bench["ErrorID"] == 0
    assert {each.unit for each in bench.run(100)} == {1, 2, 3}


def test_one_slot_for_two_drive_blocks_lets_only_stops_out_and_the_others_go_on() -> None:
    bench = Bench().ready()
    bench.run(50)
    bench.put(1, Shared=True)
    bench.scan()
    assert bench.slot(1, "StopOverdue"), "at once"
    sent = bench.run(2000)
    stops = [each for each in sent if each.unit == 2]
    assert all(each.stop for each in stops)
    assert 4 <= len(stops) <= 5, "nobody proves that it stands"
    assert len([each for each in sent if each.unit != 2]) > 80
    bench.command(0)
    bench.run(100)
    assert bench.answer(0, COMMAND) == "OK"
    assert (bench["ErrorID"], bench["ErrorSlot"]) == (56, 1)
    assert [bench.slot(slot, "LineErrorID") for slot in (0, 1)] == [61, 56]
    bench.put(1, Shared=False)
    assert not any(each.read and each.unit == 2 for each in bench.run(1900)), "a block in a slower task is seen rarely"
    assert any(each.read and each.unit == 2 for each in bench.run(300))
    assert bench["ErrorID"] == 0


def test_stops_that_are_repeated_leave_others_time_for_a_start() -> None:
    """Of seven drives that nobody serves the stops were repeated all the time, and the eighth could not be started."""
    bench = Bench(Config(drives=8, scan=40_000, max_scan=45)).ready()
    bench.attended.intersection_update({7})
    bench.run(6000)
    before = len(bench.sent)
    bench.ask(7, PARAMETER, 3, 0x0777)
    bench.command(7)
    bench.run(1200)
    assert bench.answer(7, COMMAND) == "OK"
    bench.run(1800)
    assert bench.answer(7, PARAMETER) == "OK"
    assert sum(each.stop for each in bench.sent[before:]) >= 3


def test_what_feeds_a_watchdog_takes_no_start_its_turn() -> None:
    """Stops that are repeated and feeds of others took turns with each other, and a command was never sent."""
    bench = Bench(Config(drives=8, scan=40_000, max_scan=45)).ready()
    bench.attended.intersection_update({6, 7})
    bench.run(6000)
    bench.put(6, AskFeeds=True)
    bench.command(7)
    for _ in range(60):
        if bench.answer(6, COMMAND):
            bench.command(6)
        bench.scan()
    assert bench.answer(7, COMMAND) == "OK"


def test_refreshes_take_no_start_its_turn() -> None:
    """What was left had waited for two rounds before each turn, as feeds had the others."""
    bench = Bench(Config(drives=3, scan=40_000, max_scan=45)).ready()
    bench.put(0, AskFeeds=True)
    bench.put(1, AskLater=True)
    bench.command(2)
    for _ in range(60):
        for slot in (0, 1):
            if bench.answer(slot, COMMAND):
                bench.command(slot)
        bench.scan()
    assert bench.answer(2, COMMAND) == "OK"
