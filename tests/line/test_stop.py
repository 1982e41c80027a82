"""A stop is a compartment of its own: never merged, never kept waiting, never given up, and somebody says so."""

from itertools import pairwise

import pytest
from tests.line.vline import COMMAND, STOP, Bench, Config


def test_new_stops_are_sent_first_and_each_once() -> None:
    bench = Bench().ready()
    for slot in range(3):
        bench.command(slot)
        bench.ask(slot, 2, 3, 0x100)
    bench.stop(2)
    bench.stop(0)
    sent = bench.run(70)
    assert [each.stop for each in sent[:3]] == [True, True, False]
    assert {each.unit for each in sent[:2]} == {1, 3}


def test_a_stop_takes_back_the_command_that_waits() -> None:
    bench = Bench().ready()
    bench.stop(1)
    bench.command(0)
    bench.command(1)
    bench.run(140)  # after the stop three reads go before the other command
    assert bench.answer(1, COMMAND) == "TAKEN_BACK"
    assert bench.answer(0, COMMAND) == "OK"
    assert not [frame for frame in bench.drives[1].heard if frame[2:4] == b"\x10\x01"]


def test_stops_of_dead_drives_take_turns_within_a_quarter_of_the_wire() -> None:
    bench = Bench(Config(drives=4))
    for drive in bench.drives[:3]:
        drive.alive = False
    bench.ready()
    for slot in range(3):
        bench.stop(slot)
    sent = bench.run(6000)
    assert {each.unit for each in sent if each.stop} == {1, 2, 3}
    assert bench.slot(3, "Fresh") > 6000 / 28


def test_stop_all_lasts_for_each_drive_until_its_stop_is_sent() -> None:
    """Its block would show a start as possible that the stop takes back."""
    bench = Bench(Config(drives=8)).ready()
    bench.set(StopAll=True)
    bench.scan()
    bench.set(StopAll=False)
    over: set[int] = set()
    while len(over) < 8:
        sent = {each.unit - 1 for each in bench.sent if each.stop}
        bench.scan()
        over = {slot for slot in range(8) if not bench.slot(slot, "StopAll")}
        assert over <= sent


def test_a_stop_takes_the_place_of_what_the_port_has_not_taken() -> None:
    bench = Bench().ready()
    bench.command(0)
    bench.port_takes = False
    bench.run(100)
    bench.stop(0)
    bench.scan()
    bench.port_takes = True
    assert next(each.stop for each in bench.run(40))
    assert bench.answer(0, COMMAND) == "TAKEN_BACK"


def test_two_figures_for_how_late_a_stop_is_sent() -> None:
    """19200 8N1, 12 ms scans at most, port keeps 2 ms of silence: by hand from the formula on the line's page."""
    bench = Bench(Config(drives=7)).ready()
    bench.run(100)
    longest, stop, on_top = 20 + 5, 10 + 5, 12 + 2 + 2
    assert bench["StopAloneMs"] == longest + on_top + 2
    assert bench["WorstStopMs"] == bench["StopAloneMs"] + 6 * (stop + on_top)
    assert bench.slot(6, "WorstStopMs") == bench["WorstStopMs"]


def refreshes(bench: Bench, flickers: bool, scans: int = 1500) -> int:
    """Polls of the seven others while one drive's pin flickers in every scan."""
    before = sum(bench.slot(slot, "Fresh") for slot in range(1, 8))
    for _ in range(scans):
        if flickers:
            bench.put(0, StopAgain=True)
            bench.stop(0)
        bench.scan()
    return sum(bench.slot(slot, "Fresh") for slot in range(1, 8)) - before


def test_a_flickering_pin_costs_the_others_next_to_nothing() -> None:
    bench = Bench(Config(drives=8)).ready()
    bench.stop(0)
    bench.run(100)
    calm = refreshes(bench, flickers=False)
    before = len(bench.sent)
    assert refreshes(bench, flickers=True) > 0.95 * calm
    stops = [each.ms for each in bench.sent[before:] if each.stop]
    assert 28 <= len(stops) <= 30
    assert max(later - first for first, later in pairwise(stops)) <= 1000, "within 500 ms of falling due"


def test_a_repetition_does_not_hide_a_new_stop_that_is_not_sent_yet() -> None:
    """Another stop lies in the mailbox of a port that takes nothing."""
    bench = Bench().ready()
    bench.port_takes = False
    bench.stop(0)
    bench.run(30)
    bench.stop(1)
    bench.scan()
    bench.put(1, StopAgain=True)
    bench.stop(1)
    bench.run(bench["WorstStopMs"] + 20)
    assert bench.slot(1, "StopOverdue"), "its first frame is late"


def test_a_repetition_takes_the_command_back_from_the_mailbox_too() -> None:
    """A draft let a run pass at 30 ms whose stop went out at 380 ms."""
    bench = Bench().ready()
    bench.stop(1)
    bench.run(100)
    bench.port_takes = False
    bench.command(1)
    while (bench["Exchange.Phase"], bench["Sending.Box"], bench["OpenSlot"]) != (1, COMMAND, 1):
        bench.scan()
    bench.put(1, StopAgain=True)
    bench.stop(1)
    bench.scan()
    assert bench.answer(1, COMMAND) == "TAKEN_BACK"
    bench.port_takes = True
    assert all(each.read or each.stop for each in bench.run(800))


def test_a_drive_that_may_take_65_seconds_to_answer_holds_the_line_no_longer() -> None:
    """The clock of a request ends there, and never came past it."""
    bench = Bench(Config(drives=2, scan=100_000, max_scan=110))
    bench.run(3000)
    bench.put(1, TurnRoundMs=65_534, LongestMs=65_534)
    bench.drives[1].alive = False
    bench.run(3000)
    bench.stop(0)
    bench.run(70_000)
    assert bench.answer(0, STOP) == "OK"


def test_a_unit_that_is_added_counts_in_the_figures_from_the_next_call_on() -> None:
    """Slots are looked at one a call, and what it may take came into the figures up to twelve calls after its reads."""
    bench = Bench(Config(drives=3, turn_ms=50, longest_ms=500))
    bench.put(2, UnitAddress=0)
    bench.run(5000)
    before = bench["WorstStopMs"]
    bench.put(2, UnitAddress=3, TurnRoundMs=500)
    bench.run(20)
    shown = bench["WorstStopMs"]
    bench.run(1000)
    assert before + 500 < shown == bench["WorstStopMs"]


@pytest.mark.parametrize("how", [{"TurnRoundMs": 20}, {"UnitAddress": 0}])
def test_figures_hold_while_a_request_is_open_that_waits_for_longer(how: dict[str, int]) -> None:
    """A reply time that is learned while another request is open, or a unit that is taken out."""
    bench = Bench(Config(drives=2, turn_ms=20, longest_ms=500))
    bench.put(0, TurnRoundMs=500, StopConfirmed=True)
    bench.ready().run(500)
    bench.drives[0].alive = False
    while not (bench["Track[0].Life.Vain"] and bench["Exchange.Phase"] == 2):
        bench.scan()
    bench.put(0, **how)
    bench.run(100)
    bench.stop(1)
    promised, began, sent = bench["StopAloneMs"], bench.now, len(bench.sent)
    while not any(each.stop for each in bench.sent[sent:]):
        bench.scan()
    assert bench.now - began <= 1000 * promised
    bench.run(1000)
    assert bench["StopAloneMs"] < 100


def test_a_unit_that_is_taken_out_while_it_may_turn_stays_in_the_figures() -> None:
    """The line stops it by itself, with the time that it takes."""
    bench = Bench(Config(drives=2, turn_ms=20, longest_ms=500))
    bench.put(0, TurnRoundMs=500)
    bench.ready().run(500)
    before = bench["WorstStopMs"]
    bench.put(0, UnitAddress=0)
    bench.run(3000)
    assert bench["WorstStopMs"] == before


def test_a_slot_that_waits_for_the_line_is_looked_at_in_the_same_call() -> None:
    """A slot at rest is left out of most calls; the proofs of its stops take for granted that it asks nothing."""
    bench = Bench(Config(drives=3)).ready()
    for number in range(200):
        if number % 7 == 0:
            bench.stop(number % 3)
        elif number % 5 == 0:
            bench.command(number % 3)
        bench.drives[1].alive = number % 60 < 40
        bench.scan()
        waits = [slot for slot in range(3) if not all(bench.answer(slot, box) for box in (STOP, COMMAND))]
        rest = [slot for slot in range(3) if bench[f"Track[{slot}].RestedMs"]]
        assert not set(rest) & set(waits)
        assert all(bench[f"Track[{slot}].Reads"] for slot in rest if bench[f"Track[{slot}].Life.PauseMs"] == 0)


def test_no_retry_of_a_command_is_sent_before_a_stop() -> None:
    bench = Bench().ready()
    bench.drives[0].alive = False
    bench.command(0)
    bench.run(30)
    bench.stop(1)
    assert next(each.stop for each in bench.run(80))


def test_a_new_stop_of_a_dead_drive_is_sent_at_once() -> None:
    bench = Bench()
    bench.drives[1].alive = False
    bench.ready().run(5000)
    for _ in range(3):
        bench.stop(1)
        assert next(each for each in bench.run(60) if each.stop)


def test_the_retry_of_a_new_stop_waits_for_no_pause() -> None:
    """An acknowledged stop is repeated every 500 ms; that is no pause for the next one, even if it comes meanwhile."""
    bench = Bench().ready()
    bench.stop(1)
    bench.run(60)
    bench.stop(1)
    bench.drives[1].alive = False
    sent = [each.ms for each in bench.run(450) if each.stop]
    assert len(sent) > 3
    assert max(later - first for first, later in pairwise(sent)) < 200
