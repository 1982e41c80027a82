"""Commands on the drives' own values, typed by hand; stop wins over every combination of pins."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps.model import Drive
from driveblocks.reference.command import Commands, Pins, Told

pytestmark = pytest.mark.every_family

NAMES = ("run_forward", "run_reverse", "jog_forward", "jog_reverse", "fault_reset")
Choice = st.fixed_dictionaries({name: st.booleans() for name in NAMES})


def tell(drive: Drive, **pins: Any) -> Told:
    """What the first call answers."""
    return Commands(drive).step(Pins(**pins))


@pytest.mark.parametrize(
    ("prefix", "pins", "told"),
    [
        ("JSCC", {}, Told(0x1000, 3, stopping=True)),
        ("JSCC", {"run_forward": True}, Told(0x1000, 1)),
        ("JSCC", {"run_reverse": True}, Told(0x1000, 2)),
        ("JSCC", {"run_forward": True, "enable": False}, Told(0x1000, 3, stopping=True)),
        ("JSCC", {"run_forward": True, "coast_stop": True}, Told(0x1000, 3, stopping=True)),
        ("JSCC", {"jog_forward": True}, Told(0x1000, 3, "NOT_ABLE", stopping=True)),
        ("JSCC", {"fault_reset": True}, Told(0x1000, 3, "NOT_ABLE", stopping=True)),
        ("JSCC", {"fault_reset": True, "run_forward": True}, Told(0x1000, 1, "NOT_ABLE")),
        ("JSCC", {"run_forward": True, "run_reverse": True}, Told(0x1000, 3, "BOTH_DIRECTIONS", stopping=True)),
        ("CHF", {}, Told(0x1000, 5, stopping=True)),
        ("CHF", {"coast_stop": True, "run_forward": True}, Told(0x1000, 6, stopping=True)),
        ("CHF", {"quick_stop": True}, Told(0x1000, 5, stopping=True)),
        ("CHF", {"run_forward": True, "jog_reverse": True}, Told(0x1000, 5, "BOTH_DIRECTIONS", stopping=True)),
        ("CHF", {"run_reverse": True, "jog_reverse": True}, Told(0x1000, 2)),
        ("CHF", {"jog_reverse": True}, Told(0x1000, 4)),
        ("CHF", {"fault_reset": True, "run_forward": True}, Told(0x1000, 5, "HELD", stopping=True)),
        ("SN300G5", {"keep": {0: 0xFFFF}}, Told(0x0000, 0x00FC, stopping=True)),
        ("SN300G5", {"keep": {0: 0x00A7}, "run_forward": True}, Told(0x0000, 0x00A5)),
        ("SN300G5", {"keep": {0: 0x00A7}, "run_reverse": True}, Told(0x0000, 0x00A6)),
        ("SN300G5", {"keep": {0: 0x0003}, "jog_forward": True}, Told(0x0000, 0, "NOT_ABLE", stopping=True)),
        ("EX100", {"keep": {0: 0x0201}, "coast_stop": True}, Told(0x0000, 0x0208, stopping=True)),
        ("EX100", {"fault_reset": True}, Told(0x0000, 0, stopping=True)),
    ],
)
def test_words(drives: dict[str, Drive], prefix: str, pins: dict[str, Any], told: Told) -> None:
    assert tell(drives[prefix], **pins) == told


def words(drive: Drive, *steps: Pins) -> list[int]:
    """The words of calls one after the other."""
    commands = Commands(drive)
    return [commands.step(pins).value for pins in steps]


STOPPED, OVER = Pins(stop_acknowledged=True), Pins(reset_acknowledged=True)


def test_a_reset_is_asked_for_after_an_acknowledged_stop_until_it_is_acknowledged_itself(
    drives: dict[str, Drive],
) -> None:
    pressed = Pins(fault_reset=True)
    assert words(drives["CHF"], pressed, Pins(), STOPPED, Pins(), OVER, Pins()) == [5, 5, 7, 7, 5, 5]


def test_only_the_edge_of_the_reset_asks_for_one(drives: dict[str, Drive]) -> None:
    pressed = Pins(fault_reset=True)
    over = Pins(fault_reset=True, reset_acknowledged=True)
    steps = (Pins(), STOPPED, pressed, over, pressed, Pins(fault_reset=True, stop_acknowledged=True), pressed)
    assert words(drives["CHF"], *steps) == [5, 5, 7, 5, 5, 5, 5]


def test_a_stop_that_rises_comes_before_a_reset_and_one_that_stays_does_not(drives: dict[str, Drive]) -> None:
    stop = Pins(stop=True)
    steps = (Pins(), STOPPED, Pins(fault_reset=True), stop, Pins(stop=True, stop_acknowledged=True), stop, OVER)
    assert words(drives["CHF"], *steps) == [5, 5, 7, 5, 7, 7, 5]


def test_no_motion_follows_a_reset_without_a_new_edge(drives: dict[str, Drive]) -> None:
    run = Pins(run_forward=True)
    steps = (run, Pins(run_forward=True, fault_reset=True), Pins(run_forward=True, stop_acknowledged=True))
    after = (Pins(run_forward=True, reset_acknowledged=True), run, Pins(), run)
    assert words(drives["CHF"], *steps, *after) == [1, 5, 7, 5, 5, 5, 1]


def test_a_jog_ends_with_its_own_stop(drives: dict[str, Drive]) -> None:
    commands = Commands(drives["CHF"])
    jog, run = Pins(jog_forward=True), Pins(run_forward=True)
    steps = (jog, Pins(), Pins(), run, Pins(), jog, Pins(stop=True), Pins())
    assert [commands.step(pins).value for pins in steps] == [3, 8, 8, 1, 5, 3, 5, 5]


@pytest.mark.parametrize("prefix", ["SN300G5", "JSCC", "CHF", "EX100"])
@given(choice=Choice, stop=st.sampled_from(["stop", "quick_stop", "coast_stop", "disable"]), keep=st.integers(0, 65535))
def test_stop_wins(drives: dict[str, Drive], prefix: str, choice: dict[str, bool], stop: str, keep: int) -> None:
    asked = {"enable": False} if stop == "disable" else {stop: True}
    told = tell(drives[prefix], keep={0: keep}, **choice, **asked)
    assert told.stopping
    assert told.result == ("NOT_ABLE" if choice["fault_reset"] and prefix in ("SN300G5", "JSCC") else "OK")
    assert replace(told, result="OK") == tell(drives[prefix], keep={0: keep}, **asked)
