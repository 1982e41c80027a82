"""Mistakes that the matrix has found, each with the least that shows it."""

import pytest
from tests.second.bench import Second
from tests.second.drive import RUNS, STOPS
from tests.second.events import ignore
from tests.second.matrix import named, run
from tests.second.station import library, types_of

from structured_text.engines.engine import Value

TERMINALS = {"run": 1}
REFUSED = 40
"""Error of a request that the drive has refused."""
DOUBLED = 55
"""LineErrorID: two slots have one unit address."""
COIL, RESET, ON = 5, 3, 0xFF00
"""Write single coil; the coil of an MX2 that resets, and its value."""


def at_terminals() -> Second:
    """A CHF that its terminals run, with the reference from the bus."""
    b = Second("CHF", settings=TERMINALS, pins={"SpeedOnly": True})
    b.wait(lambda: b.models[0].reference_hz, 9000)
    b.models[0].terminal(True, b.now)
    b.run(3000)
    return b


def test_the_reference_is_taken_back_after_both_stops_of_speed_only() -> None:
    """The end of a jog follows the stop, and took back the reference of 0 that waited; none was ever sent again."""
    b = at_terminals()
    b.put(0, Enable=False).run(2000)
    assert b.models[0].reference_hz == 0.0
    b.put(0, Enable=True).run(2000)
    assert b.models[0].reference_hz == 25.0


def test_a_flickering_pin_of_speed_only_leaves_the_line_to_the_others() -> None:
    b = Second(*types_of("CHF", 3, ascii_=False), settings=TERMINALS, pins={"SpeedOnly": True}, ms=50)
    b.run(6000)
    b.flicker = "QuickStop"
    for _ in range(200):
        b.scan()
        assert all(b.shows("CommOk", each) for each in range(3))


def test_an_address_that_the_drive_cannot_have_can_be_corrected() -> None:
    """H5-01 of SN300G5 ends at 1FH: the line serves no other."""
    b = Second("SN300G5")
    b.wait(lambda: b.shows("StopConfirmed"), 9000)
    b.put(0, Address=77).run(9000)
    assert b.reason() == "MISSING"
    b.put(0, Address=1)
    assert b.wait(lambda: b.shows("StopConfirmed"), 9000)


@pytest.mark.thorough
def test_a_reset_waits_for_both_stops() -> None:
    """The end of a jog took back the reset that waited."""
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    for ms in range(0, 700, 20):
        b.put(0, JogForward=True).run(1500)
        b.models[0].trip(3, b.now)
        b.release().run(1500 + ms)
        b.put(0, FaultReset=True).run(100)
        b.put(0, FaultReset=False).run(3000)
        assert b.models[0].fault is None, f"after {ms} ms"
        assert b.wait(lambda: b.shows("Ready"), 9000)


def test_the_reference_is_sent_again_after_another_block_was_on_the_slot() -> None:
    """It took back the reference that was on its way, which was waited for ever after."""
    b = at_terminals().put(0, RefreshMs=100)
    for ms in range(0, 200, 20):
        b.run(ms)
        b.twin(on=True)
        b.run(1000)
        b.twin(on=False)
        b.run(6000)
        for hz in (10.0, 25.0):
            b.put(0, SpeedReferenceHz=hz).run(1000)
            assert b.models[0].reference_hz == hz, f"after {ms} ms"


def test_a_motor_is_ready_again_after_another_block_was_on_its_slot() -> None:
    """The stop of the other block was in the slot, and was waited for ever after."""
    b = Second("CHF")
    for ms in range(0, 200, 20):
        b.wait(lambda: b.shows("Ready"), 9000)
        b.run(ms)
        b.twin(on=True)
        b.run(2000)
        b.twin(on=False)
        assert b.wait(lambda: b.shows("Ready"), 9000), f"after {ms} ms"


def test_a_reference_that_feeds_a_watchdog_does_not_hide_that_run_is_not_followed() -> None:
    """Each acknowledged reference began FollowWithinMs anew."""
    b = Second("CHF", options={"CHF": {"comm_us": 6_000_000}})
    b.wait(lambda: b.shows("Ready"), 9000)
    ignore(b, RUNS)
    b.put(0, RunForward=True).run(6500)
    assert b.reason() == "NOT_FOLLOWED"


def test_a_flickering_stop_pin_during_a_reset_opens_no_contact() -> None:
    """Each rise of the pin began the reading of the fault anew, and standstill was not proved in time."""
    b = Second("CHF", ms=10)
    b.wait(lambda: b.shows("Ready"), 9000)
    b.press()
    b.put(0, JogForward=True).run(1500)
    b.models[0].trip(3, b.now, cause=True)
    b.wait(lambda: b.shows("Fault"), 3000)
    b.release().run(300)
    b.put(0, FaultReset=True).run(50)
    b.put(0, FaultReset=False)
    b.flicker = "QuickStop"
    b.run(9000)
    assert b.contact


def test_terminals_that_start_get_the_reference_that_a_dip_of_the_supply_has_erased() -> None:
    """Where RefreshMs switches the refresh off nothing sent it again."""
    b = at_terminals().put(0, RefreshMs=65535)
    b.models[0].terminal(False, b.now)
    b.run(3000)
    b.models[0].power(False, b.now)
    b.run(300)
    b.models[0].power(True, b.now)
    b.run(3000)
    b.models[0].reset(b.now)
    b.models[0].terminal(True, b.now)
    b.run(2000)
    assert b.models[0].reference_hz == 25.0


def test_a_drive_that_begins_to_answer_does_not_wait_for_dead_ones() -> None:
    """Until its third reply it shared the quarter of the wire that the dead have."""
    b = Second(*types_of("CHF", 3, ascii_=True), ascii_=True, ms=40)
    b.echo = True
    b.wait(lambda: all(b.shows("Ready", each) for each in range(3)), 9000)
    b.deaf.add(1)
    b.put(0, Address=29, TurnRoundMs=0)
    b.stall(2000)
    b.run(5000)
    assert b.shows("StopConfirmed", 1)
    assert b.shows("StopConfirmed", 2)


def test_words_that_lay_in_the_slot_while_the_block_was_not_called_are_not_new() -> None:
    b = Second("JSCC")
    b.wait(lambda: b.shows("Ready"), 9000)
    for _ in range(15):
        b.run(20)
        b.leave("Skip0").run(80)
        b.deaf.add(1)
        b.run(700)
        b.leave("Skip0", on=False).scan()
        assert b.number("StatusAgeMs") >= 700
        b.deaf.clear()
        b.run(1000)


@pytest.mark.thorough
def test_a_drive_that_may_have_answered_its_stop_is_read_at_once() -> None:
    """Its reply may be an echo, which only a read can decide: that waited for the turn of the dead."""
    for ms in range(0, 10_000, 1000):
        b = Second("CHF")
        b.deaf.add(1)
        b.run(30_000 + ms)
        b.deaf.clear()
        b.run(3000)
        assert b.shows("StopConfirmed")


@pytest.mark.parametrize("family", ["ATV312", "PF4", "MX2", "SN300G5"])
def test_a_drive_that_stands_with_its_reference_reached_is_not_at_speed(family: str) -> None:
    """An Altivar says so in operation enabled while it stands: 0627H, "Normal stop", on page 10 of BBV51701."""
    b = Second(family, pins={"SpeedReferenceHz": 25.0})
    b.wait(lambda: b.shows("Ready"), 9000)
    ignore(b, RUNS)
    b.put(0, RunForward=True)
    for _ in range(150):
        b.scan()
        assert not b.shows("AtSpeed")
        assert b.reason() != "RUNS"


HELD = {
    "its fault register, 0, came twice, and passed for status and frequency": (
        "PF4, full control, replies doubled, ramping down", 300,
    ),
    "its stops, which it refused, left others without their references": ("CHF, jog, slow scans, local", 300),
    "the unit of another block in the slot passed for its own": ("CHF, jog, a changed address, standstill", 503),
    "a late reply of a dead drive left it to the next probe": (
        "GD200A, MonitorOnly, a stall of 300 ms, starting", 401,
    ),
    "its two stops, which it refused in turn, left others without their references": (
        "GD200A, MonitorOnly, slow scans, coasting", 503,
    ),
    "in a restart it was called no longer, and the line stopped its run with the end of a jog": (
        "GD200A, full control, block not called for 12 s, starting", 611,
    ),
    "the unit of before passed for its own": ("GD200A, jog, the line is not called, standstill", 503),
}  # fmt: skip


@pytest.mark.parametrize("what", HELD)
@pytest.mark.thorough
def test_a_cell_that_has_failed_holds(what: str) -> None:
    cell, seed = HELD[what]
    assert run(named(cell), seed).rules == []


def test_an_address_typed_twice_can_be_corrected() -> None:
    """A unit that had been heard kept its number until its stop was confirmed: LineErrorID 55 stayed for ever."""
    b = Second(*types_of("CHF", 3, ascii_=False))
    b.put(1, Address=1).restart()
    b.run(8000)
    assert [b.block[f"Slots[{each}].LineErrorID"] for each in (0, 1)] == [DOUBLED] * 2
    b.put(1, Address=2)
    assert b.wait(lambda: all(b.shows("Ready", each) for each in range(3)), 9000)
    for each in range(3):
        b.put(each, RunForward=True)
    assert b.wait(lambda: all(b.shows("AtSpeed", each) for each in range(3)), 9000)


@pytest.mark.parametrize("ms", [200, 1000, 5000])
def test_the_address_of_a_motor_that_runs_can_be_taken_back_from_another_block(ms: int) -> None:
    """The other block, which had begun at standstill, kept it, and no motor of the two ran any more."""
    b = Second(*types_of("CHF", 3, ascii_=False))
    b.wait(lambda: all(b.shows("Ready", each) for each in range(3)), 9000)
    b.put(0, RunForward=True)
    b.wait(lambda: b.shows("AtSpeed"), 9000)
    b.put(1, Address=1).run(ms)
    b.put(1, Address=2).release()
    assert b.wait(lambda: all(b.shows("Ready", each) for each in range(3)), 15_000)
    for each in (0, 1):
        b.put(each, RunForward=True)
    assert b.wait(lambda: all(b.shows("AtSpeed", each) for each in (0, 1)), 9000)


def seen_turning(mode: str) -> Second:
    """A CHF that has stood still, and that somebody else has started in a mode in which the bus does not; then dead."""
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    b.put(0, **{mode: True}).run(500)
    b.press()
    if mode == "SpeedOnly":
        b.models[0].set("run", 1, b.now)
        b.models[0].terminal(True, b.now)
    else:
        b.models[0].press("local", b.now)
        b.models[0].press("start", b.now)
    b.run(4000)
    assert b.shows("Running")
    assert b.contact
    b.deaf.add(1)
    b.run(4000)
    return b


@pytest.mark.parametrize(
    ("mode", "stop"),
    [
        ("SpeedOnly", "Enable"), ("SpeedOnly", "StopAll"), ("SpeedOnly", "SpeedOnly"),
        ("MonitorOnly", "MonitorOnly"),
    ],
)  # fmt: skip
def test_a_motor_that_was_seen_to_turn_is_not_proved_still(mode: str, stop: str) -> None:
    """The proof of before outlived a motion that the bus had not begun, and the contact stayed closed."""
    b = seen_turning(mode)
    if stop == "StopAll":
        b.line(StopAll=True)
    else:
        b.put(0, **{stop: False})
    b.run(15_000)
    assert b.models[0].motor.hz(b.now)
    assert not b.contact


@pytest.mark.parametrize("mode", ["", "SpeedOnly", "MonitorOnly"])
def test_a_drive_that_is_cut_off_at_proved_standstill_opens_no_contact(mode: str) -> None:
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    if mode:
        b.put(0, **{mode: True}).run(500)
    b.press()
    b.run(4000)
    b.models[0].power(False, b.now)
    b.run(4000)
    b.put(0, Enable=False, SpeedOnly=False, MonitorOnly=False).run(15_000)
    assert b.contact


@pytest.mark.parametrize("ms", range(80, 500, 120))
def test_a_stronger_stop_while_all_are_stopped_is_sent_at_once(ms: int) -> None:
    """It waited with the repetitions, for the proof to be read."""
    b = Second("CHF", ms=10, options={"CHF": {"down_hz_s": 2.0}})
    b.wait(lambda: b.shows("Ready"), 9000)
    b.put(0, RunForward=True, SpeedReferenceHz=40.0).run(6000)
    b.line(StopAll=True).run(ms)
    frames = b.put(0, CoastStop=True).run(100)
    assert (0x1000, 6) in [(each.address, each.word) for each in frames]


def test_a_stop_that_was_asked_for_long_ago_is_not_that_of_today() -> None:
    """In MonitorOnly the kind of the last stop was kept: a motor that a person ran then was left to coast."""
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    b.put(0, CoastStop=True).run(100)
    b.wait(lambda: b.shows("StopConfirmed"), 9000)
    b.put(0, MonitorOnly=True).run(500)
    b.put(0, CoastStop=False).run(5000)
    b.models[0].press("local", b.now)
    b.models[0].press("start", b.now)
    b.run(3000)
    words = [each.word for each in b.put(0, MonitorOnly=False).run(2000) if each.address == 0x1000 and not each.read]
    assert 5 in words
    assert 6 not in words


@pytest.mark.parametrize("deaf_us", [0, pytest.param(1_000_000, marks=pytest.mark.thorough)])
@pytest.mark.parametrize("acts", ["rise", "fall"])
def test_each_reset_of_an_mx2_helps(acts: str, deaf_us: int) -> None:
    """A reset that helped at once left the coil on, and to write it again was no change.

    A drive that does not answer for a second as it is reset may leave it on still, until the next reset begins.
    """
    b = Second("MX2", options={"MX2": {"reset_acts": acts, "reset_deaf_us": deaf_us}})
    for time in range(4):
        assert b.wait(lambda: b.shows("Ready"), 14_000), f"before fault {time}"
        b.put(0, RunForward=True).run(4000)
        b.models[0].trip(3, b.now)
        b.run(2000)
        b.release().run(6000)
        sent = len(b.frames)
        b.put(0, FaultReset=True).run(100)
        b.put(0, FaultReset=False).run(12_000)
        assert b.models[0].fault is None, f"fault {time}"
        assert b.reason() != "NO_RESET"
        words = [each.word for each in b.frames[sent:] if (each.function, each.address) == (COIL, RESET)]
        assert words[:2] == [0, ON]
        assert deaf_us or words[2:] == [0]


@pytest.mark.parametrize(("within", "ms"), [(0, 15_000), (65_535, 70_000)])
def test_a_motor_is_watched_whatever_its_time_to_stop(within: int, ms: int) -> None:
    """StopWithinMs 0 switched the watch off; 65535 is a time that its clock did not pass."""
    b = Second("CHF")
    b.wait(lambda: b.shows("Ready"), 9000)
    b.press()
    b.put(0, RunForward=True).run(4000)
    ignore(b, STOPS)
    b.put(0, StopWithinMs=within).release().run(ms)
    assert b.models[0].motor.hz(b.now)
    assert not b.contact


@pytest.mark.parametrize("pins", [{}, {"SpeedOnly": True}, {"MonitorOnly": True}])
def test_a_stop_that_another_block_has_left_in_the_slot_is_written_over(pins: dict[str, bool]) -> None:
    """It may have the same number, and no function code yet: it was never sent, and the contact stayed open."""
    b = Second(*types_of("CHF", 3, ascii_=False), pins=pins)
    b.run(6000)
    b.put(0, RunForward=not pins).run(1000)
    b.other(on=True, address=1)
    b.run(1000)
    b.other(on=False)
    assert b.wait(lambda: not b.shows("StopOverdue") and (pins or b.shows("StopConfirmed")), 12_000)


def test_what_another_make_was_asked_on_the_slot_says_nothing_of_the_drive() -> None:
    """The refusal of its first read passed for one of this block's own: another drive, until its address changed."""
    b = Second(*types_of("PF4", 3, ascii_=False))
    b.wait(lambda: b.shows("Ready"), 9000)
    b.other(on=True, address=1)
    b.run(2000)
    assert b.reason() == "SHARED"
    b.other(on=False)
    assert b.wait(lambda: b.shows("Ready"), 9000)


def test_a_stop_pin_takes_the_reference_back_although_the_stop_is_refused() -> None:
    """It waited for the stop, which a drive that terminals run refuses for as long as it turns."""
    refuses = {"SN300G5": {"not_in_command": "refuses"}}
    b = Second("SN300G5", settings={"b1_02": 1}, pins={"SpeedOnly": True}, options=refuses)
    b.wait(lambda: b.models[0].reference_hz, 9000)
    b.models[0].terminal(True, b.now)
    b.run(3000)
    b.put(0, Enable=False).run(2000)
    assert b.models[0].reference_hz == 0.0
    assert not b.shows("StopOverdue")


def rounds(refused: str) -> list[object]:
    """The kinds of stop that follow each other after a restart, and whether each is refused, R, or acknowledged, A."""
    block, kinds = library().instance("VFD_StopRound"), list[object]()
    pins = {"CanStopJog": True, "JogPosted": True, "Seen.CommOk": True, "Seen.Moving": True, "Asked.StopKind": 1}
    answer: dict[str, Value] = {"Due": True, "Seen.Restarted": True, **pins}
    for how in refused:
        for name, value in answer.items():
            block[name] = value
        block.scan()
        kinds.append(block["Kind"] if block["Posts"] else "closed")
        number = block["Number"]
        answer = {"Due": False, "Seen.Restarted": False, "AskNumber": number, "TriedNumber": number}
        answer |= {"AnswerErrorID": REFUSED if how == "R" else 0} | ({} if how == "R" else {"AnswerNumber": number})
    return kinds


def test_a_drive_that_refuses_both_stops_of_a_jog_gets_both_until_it_takes_each() -> None:
    """The end of the jog was left out as one that it does not know; it took the other at last, and jogged on."""
    stop, end = 1, 4
    assert rounds("RRRRAA ") == [stop, end, stop, end, stop, end, "closed"]
    assert rounds("RRRAA ") == [stop, end, stop, end, stop, "closed"]
    assert rounds("ARA ") == [stop, end, stop, "closed"]
