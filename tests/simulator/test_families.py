"""The shipped families: states and ramps, words typed by hand from the manuals' tables, frames as printed."""

import pytest
from tests import families
from tests.simulator.talk import MAPS, Talk, body, pairs, prepared, talk

from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.model import Frame

STATUS, FREQUENCY, COUNTS_PER_HZ = (families.said(name) for name in ("STATUS", "FREQUENCY", "COUNTS_PER_HZ"))
"""0.01 Hz by 000FH bit 0; 0.1 Hz by JSCC's example and PF4's words; CHF's manual has none, so that of `Habits`."""
WORDS, FAULT, CHART = (families.said(name) for name in ("FACES", "FAULT", "CHART"))
"""Bits that follow the state chart, not the motor, are in test_shapes.py."""
every_family = pytest.mark.parametrize("family", sorted(MAPS))


def assert_shows(one: Talk, family: str, what: str, hz: float) -> None:
    """Check status and output frequency, which may be signed."""
    assert one.read(STATUS[family]) & ~CHART.get(family, 0) == WORDS[family][what]
    counts = one.read(FREQUENCY[family])
    coarse = one.map.operation.reference.means == "fraction_of_full_scale"  # 16384 of it are 50 Hz
    assert abs(min(counts, 0x10000 - counts) - round(hz * COUNTS_PER_HZ[family])) <= coarse


@every_family
@pytest.mark.every_family
def test_it_starts_ramps_runs_and_stops(family: str) -> None:
    one = talk(family)
    assert_shows(one, family, "stands", 0)
    one.hertz(30)
    one.command("run_forward")
    one.drive.step(1000)
    assert one.drive.mode == "ramping up"
    assert_shows(one, family, "ramps", 10)
    one.drive.step(2000)
    assert one.drive.mode == "running"
    assert_shows(one, family, "runs", 30)
    one.hertz(20)
    one.drive.step(500)
    assert one.drive.mode == "ramping down"
    assert_shows(one, family, "ramps", 25)
    one.drive.step(500)
    assert_shows(one, family, "runs", 20)
    one.command("stop")
    one.drive.step(1000)
    assert one.drive.mode == "ramping down"
    assert_shows(one, family, "ramps", 10)
    one.drive.step(1001)  # 20 Hz may be a little more in a fraction
    assert one.drive.mode == "standstill"
    assert_shows(one, family, "stands", 0)


@every_family
def test_it_runs_in_reverse_and_a_change_of_direction_goes_through_zero(family: str) -> None:
    one = talk(family).at(30, "run_reverse")
    assert_shows(one, family, "reverse", 30)
    assert round(one.drive.hertz, 2) == -30
    one.drive.step(2000 - one.command("run_forward"))
    assert round(one.drive.hertz, 2) == -10
    one.drive.step(2000)
    assert round(one.drive.hertz, 2) == 10


@every_family
def test_a_fault_lets_the_motor_coast_and_is_reset_at_standstill_when_its_cause_is_gone(family: str) -> None:
    one = talk(family).at(30)
    one.drive.trip(2)
    assert one.drive.mode == "fault"
    assert_shows(one, family, "fault", 0)
    assert round(one.drive.hertz, 2) == 30
    one.drive.reset()
    one.drive.clear_cause()
    one.drive.reset()
    assert one.drive.fault == 2
    one.command("run_forward")
    one.drive.step(6000)
    assert one.drive.hertz == 0
    one.drive.reset()
    assert_shows(one, family, "stands", 0)
    one.drive.step(1000)
    assert one.drive.hertz == 0


@every_family
def test_the_code_of_a_fault_is_shown_where_the_map_says(family: str) -> None:
    one = talk(family)
    one.drive.trip(18)
    # SN300G5: 12H is EF4, bit 1 of 0015H; the others show the number
    where = FAULT[family]
    assert one.read(where[0]) == where[1]
    one.drive.clear_cause()
    one.drive.reset()
    assert one.read(where[0]) == 0
    keeps = talk(family, Habits(keeps_fault_code=True))
    keeps.drive.trip(18)
    keeps.drive.clear_cause()
    keeps.drive.reset()
    assert keeps.read(where[0]) == where[1]


@every_family
def test_a_warning_is_shown_where_there_is_one(family: str) -> None:
    one = talk(family)
    one.drive.warning = True
    assert_shows(one, family, "warning", 0)


@pytest.mark.parametrize(("prefix", "request_", "reply"), pairs(), ids=lambda each: getattr(each, "id", each))
def test_replies_are_those_that_the_manual_prints(prefix: str, request_: Frame, reply: Frame) -> None:
    drive = prepared(prefix, request_, reply)
    assert drive.reply(body(request_)) == body(reply)


def test_enter_stores_and_illegal_data_is_refused_as_printed() -> None:
    """The frames that no other answers: SN300G5's ENTER, and CHF's refusal with error 5."""
    enter = next(frame for frame in MAPS["SN300G5"].frames if frame.id == "enter_request")
    one = talk("SN300G5")
    assert one.drive.reply(body(enter)) == bytes.fromhex("01 10 FF FD 00 01")
    assert one.drive.stores == 1
    refused = next(frame for frame in MAPS["CHF"].frames if frame.id == "error_rtu_reply")
    chf = talk("CHF")
    assert chf.write(0x2000, 10001) == body(refused)
    assert chf.read(0x5001) == 5


def test_chf_jogs_until_its_jog_stop_and_coasts() -> None:
    one = talk("CHF")
    one.command("jog_reverse")
    one.drive.step(2000)
    assert one.drive.hertz == -5
    one.command("jog_stop")
    one.drive.step(500)
    assert one.drive.mode == "standstill"
    one.at(30)
    one.command("jog_stop")
    one.drive.step(1000)
    assert round(one.drive.hertz, 2) == 30
    one.command("coast_stop")
    one.drive.step(1000)
    assert one.drive.mode == "coasting"
    assert one.drive.hertz == 25
    assert one.read(0x3000) == 0
    one.command("run_forward")
    one.drive.step(100)
    assert one.drive.hertz == 26


def test_a_stop_may_leave_a_jog_to_its_own_stop() -> None:
    one = talk("CHF", Habits(stop_ends_jog=False))
    one.command("jog_forward")
    one.drive.step(1000)
    one.command("stop")
    one.drive.step(1000)
    assert one.drive.hertz == 5


def test_chf_resets_by_bus_and_a_negative_reference_reverses() -> None:
    one = talk("CHF")
    one.drive.trip(3)
    one.command("fault_reset")
    assert one.drive.fault == 3
    one.drive.clear_cause()
    one.command("fault_reset")
    assert one.drive.fault == 0
    one.at(-20)
    assert one.drive.hertz == -20
    assert one.read(0x1001) == 2


def test_a_reference_means_something_else_while_its_meaning_is_not_verified() -> None:
    """SN300G5 with 000FH bit 0 = 1: the unit of O1-03, here ten times as much."""
    one = talk("SN300G5")
    one.write(0x000F, 1)
    one.at(4)
    assert one.drive.hertz == 40
    one.write(0x000F, 0)
    one.drive.step(10_000)
    assert one.drive.hertz == 4


def test_a_drive_runs_at_no_frequency_and_at_no_more_than_its_maximum() -> None:
    one = talk("SN300G5").at(0)
    assert one.read(0x0010) == 0x23
    jscc = talk("JSCC").at(655.35)
    assert jscc.drive.hertz == 50


def test_terminals_of_sn300g5_are_no_command_and_both_directions_are_the_worse_one() -> None:
    one = talk("SN300G5").at(20)
    one.write(0x0000, 0x00FD)
    assert one.drive.mode == "running"
    one.write(0x0000, 0x0003)
    one.drive.step(1000)
    assert one.drive.hertz == 10  # on its way to the other direction
    one.write(0x0000, 0x00FC)
    one.drive.step(2000)
    assert one.drive.mode == "standstill"


def test_a_command_word_of_zero_is_no_stop_of_jscc() -> None:
    one = talk("JSCC").at(20)
    one.write(0x1000, 0)
    one.drive.step(1000)
    assert one.drive.hertz == 20


def test_measures_go_with_speed_and_load() -> None:
    one = talk("CHF")
    assert [one.read(address) for address in (0x3002, 0x3003, 0x3004, 0x3006)] == [54000, 0, 0, 0]
    one.at(25)
    one.drive.load = 80
    # 540 V; half of 400 V; 80 % of 10 A; half of 80 % of 4 kW
    assert [one.read(address) for address in (0x3002, 0x3003, 0x3004, 0x3006)] == [54000, 20000, 800, 160]


def test_a_word_that_is_no_command_does_what_its_bits_do() -> None:
    """PowerFlex 4: a reset beside a start starts, a stop alone stops, whatever rate is asked for beside it."""
    one = talk("PF4").at(20)
    one.write(0x2000, 0x0101)
    one.drive.step(4000)
    assert one.drive.mode == "standstill"
    one.write(0x2000, 0x0108)
    assert one.drive.mode == "standstill"
    one.write(0x2000, 0x000A)
    one.drive.step(100)
    assert one.drive.mode == "ramping up"
