"""What happens to a drive: power, keypad, interlock, a drive that does not obey, restarts and watchdogs."""

import pytest
from tests.shapes import shapes
from tests.simulator.talk import talk

from driveblocks.bench.simulator.habits import Habits


def test_nobody_answers_without_power_and_the_motor_coasts() -> None:
    one = talk("CHF").at(20)
    one.drive.power(on=False)
    assert one.ask("01 03 10 01 00 01") == ""
    one.drive.step(1000)
    assert one.drive.hertz == 15
    one.drive.power(on=True)
    one.drive.power(on=True)
    one.drive.step(10_000)
    assert one.drive.hertz == 0
    assert one.read(0x1001) == 3
    # command and reference were lost
    assert one.read(0x2000) == 0


def test_nothing_happens_to_a_drive_without_power() -> None:
    one = talk("CHF")
    one.drive.power(on=False)
    one.drive.trip(1)
    one.drive.keypad_run(10)
    assert one.drive.mode == "standstill"


def test_a_drive_may_restart_after_a_dip() -> None:
    one = talk("CHF", Habits(auto_restart=True)).at(20)
    one.drive.power(on=False)
    one.drive.step(100)
    one.drive.power(on=True)
    one.drive.step(1000)
    assert one.drive.hertz == 20
    assert one.read(0x1001) == 1
    one.command("stop")
    one.drive.step(5000)
    one.drive.power(on=False)
    one.drive.power(on=True)
    one.drive.step(1000)
    assert one.drive.hertz == 0


def test_a_drive_does_not_restart_against_an_interlock() -> None:
    one = talk("CHF", Habits(auto_restart=True)).at(20)
    one.drive.power(on=False)
    one.drive.inhibit(on=True)
    one.drive.power(on=True)
    one.drive.step(5000)
    assert one.drive.mode == "standstill"
    assert one.read(0x1001) == 3


def test_a_fault_outlives_the_power_while_its_cause_does() -> None:
    one = talk("CHF", Habits(auto_restart=True)).at(20)
    one.drive.trip(4)
    one.drive.trip(5)
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert one.read(0x5000) == 4
    one.drive.clear_cause()
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert one.read(0x5000) == 0


def test_keypad_and_terminals_start_and_stop() -> None:
    one = talk("CHF")
    one.drive.keypad_run(12.5, reverse=True)
    one.drive.step(2000)
    assert one.drive.hertz == -12.5
    one.drive.keypad_stop()
    one.drive.keypad_stop()
    one.drive.step(2000)
    assert one.drive.mode == "standstill"
    # run by the terminals, at the speed of the bus
    one.hertz(20)
    one.drive.keypad_run()
    one.drive.step(2000)
    assert one.drive.hertz == 20
    one.drive.trip(1)
    one.drive.keypad_run(10)
    assert one.drive.mode == "fault"


def test_a_drive_in_local_acknowledges_and_does_nothing() -> None:
    one = talk("JSCC")
    one.drive.local = True
    one.at(20)
    assert one.drive.mode == "standstill"
    one.drive.local = False
    one.at(20)
    one.drive.local = True
    one.command("stop")
    one.drive.step(1000)
    assert one.drive.hertz == 20


def test_a_drive_may_acknowledge_and_not_follow_or_not_stop() -> None:
    one = talk("JSCC")
    one.drive.follows = False
    one.at(20)
    assert one.drive.mode == "standstill"
    one.drive.follows = True
    one.at(20)
    one.drive.keeps_running = True
    one.command("stop")
    one.drive.step(1000)
    assert one.drive.hertz == 20


def test_an_interlock_takes_the_torque_off_and_lets_nothing_start() -> None:
    one = talk("SN300G5").at(20)
    one.drive.inhibit(on=True)
    assert one.drive.mode == "coasting"
    assert one.read(0x0010) == 0x02
    one.command("run_forward")
    one.drive.keypad_run(10)
    assert one.drive.mode == "coasting"
    one.drive.step(10_000)
    one.drive.inhibit(on=False)
    assert one.read(0x0010) == 0x22
    one.command("run_forward")
    assert one.drive.mode == "ramping up"


@pytest.mark.parametrize("family", ["SN300G5", "JSCC", "CHF"])
def test_a_run_word_that_is_still_there_may_act_again_after_a_reset(family: str) -> None:
    for resumes in (False, True):
        one = talk(family, Habits(resumes=resumes)).at(20)
        one.drive.trip(1)
        one.drive.clear_cause()
        one.drive.step(10_000)
        one.drive.reset()
        one.drive.step(1000)
        assert one.drive.hertz == 10 * resumes


def test_what_needs_an_edge_or_a_state_or_was_stopped_does_not_act_again() -> None:
    for name, words in (("cia402", (6, 7, 15)), ("two_registers", ()), ("pulse", (1, 0))):
        one = talk(shapes()[name], Habits(resumes=True))
        for word in words:
            one.write(0x1000, word)
            one.drive.step(200)
        one.drive.trip(1)
        one.drive.clear_cause()
        one.drive.step(10_000)
        one.drive.reset()
        assert one.drive.mode == "standstill"


def test_the_frequency_may_be_that_of_the_coasting_shaft() -> None:
    one = talk("CHF", Habits(coast_shows_zero=False)).at(20)
    one.command("coast_stop")
    assert (one.read(0x3000), one.read(0x1001)) == (2000, 3)
    one.drive.step(4000)
    assert one.read(0x3000) == 0


def test_the_status_may_say_stopped_while_the_motor_ramps_down() -> None:
    one = talk("JSCC", Habits(runs_while_stopping=False)).at(20)
    assert one.read(0x2001) == 1
    one.command("stop")
    one.drive.step(1000)
    assert one.read(0x2001) == 4
    assert one.read(0x2000) == 100


@pytest.mark.parametrize(("action", "mode"), [("trip", "fault"), ("stop", "ramping down"), ("coast", "coasting")])
def test_a_watchdog_acts_without_a_good_request_to_its_own_address(action: str, mode: str) -> None:
    one = talk("CHF", Habits(watchdog_ms=2000, watchdog=action, watchdog_code=18))  # type: ignore[arg-type]  # one of three
    one.drive.keypad_run(10)
    for _ in range(3):
        one.drive.step(1500)
        one.read(0x1001)
    assert one.drive.mode == "running"
    one.drive.step(1500)
    # neither another's request, nor one that is refused, nor one that all hear is good
    assert one.ask("02 03 10 01 00 01") == ""
    assert one.ask("01 03 99 99 00 01") == "01 06 50 01 00 04"
    assert one.ask("00 06 20 00 00 00") == ""
    one.drive.step(500)
    assert one.drive.mode == "running"
    one.drive.step(1)
    assert one.drive.mode == mode
    if action == "trip":
        assert one.read(0x5000) == 18
        one.drive.step(20_000)
        one.command("fault_reset")
        assert one.drive.mode == "standstill"


def test_a_watchdog_ignores_a_drive_at_standstill() -> None:
    one = talk("CHF", Habits(watchdog_ms=2000))
    one.drive.step(10_000)
    assert one.drive.mode == "standstill"


def test_without_a_watchdog_it_runs_on() -> None:
    one = talk("CHF").at(20)
    one.drive.step(1_000_000)
    assert one.drive.hertz == 20
