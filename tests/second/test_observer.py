"""Each rule of the observer fires on a made-up history, and stays quiet on a good one."""

from typing import Any

import pytest
from tests.second import chf, jscc, sn300g5
from tests.second.frames import ascii_, rtu
from tests.second.observer import Figures, Observer, Truth

PINS = {
    "F": "RunForward", "R": "RunReverse", "J": "JogForward", "K": "JogReverse", "q": "QuickStop", "c": "CoastStop",
    "a": "StopAll", "r": "Restart", "m": "MonitorOnly", "s": "SpeedOnly", "l": "Left",
}  # fmt: skip
BY = {"b": "bus", "d": "bus", "i": "bus", "k": "keypad", "t": "terminals", "o": ""}
"""Third column: bus, bus that ramps down, bus by itself, keypad, terminals, open contact; a + is StopConfirmed."""
STOPPED = [(0, "", "+", 0.0)]
RUNNING = [*STOPPED, (100, "F", "+", 0.0), (200, "F", "b", 0.0), (2200, "F", "b", 20.0)]
GOOD: dict[str, list[tuple[int, str, str, float]]] = {
    "run and stop": [*RUNNING, (5000, "", "b", 20.0), (5100, "", "d", 19.0), (7100, "", "", 0.0), (7200, "", "+", 0.0)],
    "jog": [*STOPPED, (100, "J", "+", 0.0), (200, "J", "b", 5.0), (900, "", "d", 2.0), (1400, "", "+", 0.0)],
    "keypad": [*STOPPED, (100, "", "k+", 1.0), (3000, "", "k+", 20.0), (3400, "", "k", 20.0), (90_000, "", "k", 20.0)],
    "coast": [*RUNNING, (5000, "Fc", "", 20.0), (6000, "Fc", "+", 15.0), (9000, "Fc", "+", 0.0), (9100, "F", "+", 0.0)],
    "stop key, then an edge": [*RUNNING, (5000, "F", "d", 19.0), (7000, "F", "+", 0.0), (8000, "", "+", 0.0),
                               (8100, "F", "+", 0.0), (8200, "F", "b", 0.0)],
    "contact": [*RUNNING, (5000, "", "b", 20.0), (8000, "", "o", 20.0), (60_000, "", "o", 0.5)],
    "dip": [*RUNNING, (5000, "F", "", 19.0), (5300, "F", "i", 18.0), (6000, "F", "d", 9.0), (7000, "F", "+", 0.0)],
    "left while its run waits": [*STOPPED, (100, "F", "+", 0.0), (150, "Fl", "", 0.0), (1100, "Fl", "b", 0.0),
                                 (1700, "Fl", "d", 0.0), (1800, "Fl", "", 0.0)],
    "slower": [*RUNNING, (3000, "F<", "b", 20.0), (4500, "F<", "b", 10.0), (9000, "F<", "b", 10.0)],
    "reverse": [*STOPPED, (100, "R", "+", 0.0), (200, "R", "b", -1.0), (2200, "R", "b", -20.0)],
}  # fmt: skip
BAD: list[tuple[str, list[tuple[int, str, str, float]]]] = [
    ("edge", [(0, "F", "+", 0.0), (100, "F", "b", 0.0)]),  # the pin was TRUE at power-up
    ("edge", [*STOPPED, (100, "", "b", 0.0)]),  # no pin at all
    ("edge", [*STOPPED, (100, "F", "+", 0.0), (150, "Fq", "+", 0.0), (200, "F", "+", 0.0), (300, "F", "b", 0.0)]),
    ("edge", [*STOPPED, (100, "F-", "+", 0.0), (150, "F", "+", 0.0), (200, "F", "b", 0.0)]),  # rose without Enable
    ("edge", [*RUNNING, (5000, "F", "d", 19.0), (5100, "F", "b", 19.5)]),  # the stop key was overridden
    ("edge", [*RUNNING, (5000, "F", "", 19.0), (5100, "F", "b", 18.0)]),  # ... or a dip, or a trip
    ("edge", [*RUNNING, (5000, "F", "k", 20.0), (5100, "F", "b", 20.0)]),
    *[("edge", [*STOPPED, (100, "F", "+", 0.0), (150, f"F{pin}", "+", 0.0), (300, "F", "b", 0.0)]) for pin in "carmsl"],
    ("edge", [*STOPPED, (100, "F", "+", 0.0), (150, "Fl", "", 0.0), (1200, "Fl", "b", 0.0)]),  # AttendMs is over
    ("edge", [*STOPPED, (100, "F", "+", 0.0), (150, "Fl", "", 0.0), (200, "Fla", "", 0.0), (300, "Fl", "b", 0.0)]),
    ("edge", [*STOPPED, (100, "", "+", 0.0), (150, "Fl", "", 0.0), (300, "Fl", "b", 0.0)]),  # it has not seen the pin
    ("stop", [*RUNNING, (5000, "", "b", 20.0), (8001, "", "b", 20.0)]),
    ("stop", [*RUNNING, (5000, "F-", "b", 20.0), (8001, "F-", "b", 20.0)]),
    ("stop", [*RUNNING, (5000, "Fl", "d", 20.0), (8001, "Fl", "d", 0.2)]),  # nobody calls the block
    ("stop", [*RUNNING, (5000, "", "", 20.0), (8001, "", "", 2.0)]),  # it coasts for too long
    ("stop", [*STOPPED, (100, "F", "+", 0.0), (200, "F", "b", 0.0), (300, "", "b", 0.0), (3301, "", "b", 0.0)]),
    ("stop", [*RUNNING, (5000, "F", "", 19.0), (5300, "F", "i", 18.0), (9000, "F", "i", 20.0)]),  # nobody stops it
    ("confirmed", [*RUNNING, (5000, "F", "b+", 20.0)]),
    ("confirmed", [*RUNNING, (5000, "", "d+", 0.3)]),
    ("confirmed", [*STOPPED, (100, "", "k+", 1.0), (3101, "", "k+", 20.0)]),
    ("speed", [*RUNNING, (5000, "F", "b", 25.0)]),
    ("speed", [*RUNNING, (3000, "F<", "b", 20.0), (5300, "F<", "b", 20.0)]),
    ("direction", [*STOPPED, (100, "R", "+", 0.0), (200, "R", "b", 0.0), (300, "R", "b", 1.0)]),
]  # fmt: skip


def judged(history: list[tuple[int, str, str, float]], **figures: Any) -> list[str]:
    """The rules that a history breaks; `-` is Enable FALSE, `<` half of the reference of 20 Hz."""
    one = Observer({1: chf.stores}, Figures(stop_us=3_000_000, seen_us=3_000_000, **figures))
    for ms, pins, motor, hz in history:
        on: dict[str, object] = {PINS[each]: True for each in pins if each in PINS}
        on |= {"Enable": "-" not in pins, "SpeedReferenceHz": 10.0 if "<" in pins else 20.0, "MaximumHz": 50.0}
        by = BY.get(motor[:1], "")
        truth = Truth(hz, by, stopping=motor[:1] == "d", contact_open=motor[:1] == "o", itself=motor[:1] == "i")
        one.scan(1000 * ms, 1, on, confirmed="+" in motor, truth=truth)
    return [rule for _, _, rule, _ in one.found]


@pytest.mark.parametrize("name", GOOD)
def test_a_good_history_is_quiet(name: str) -> None:
    assert judged(GOOD[name]) == []


@pytest.mark.parametrize(("rule", "history"), BAD)
def test_a_bad_history_breaks_its_rule_once(rule: str, history: list[tuple[int, str, str, float]]) -> None:
    last = history[-1]
    assert judged([*history, (last[0] + 10, *last[1:])]) == [rule]


def test_a_coast_counts_where_it_is_asked() -> None:
    assert judged(GOOD["coast"], coast_counts=True) == ["confirmed"]


def test_a_rule_is_reported_again_when_it_is_broken_again() -> None:
    bad = (5000, "F", "b+", 20.0)
    assert judged([*RUNNING, bad, (5100, "F", "b", 20.0), (5200, *bad[1:])]) == ["confirmed"] * 2


@pytest.mark.parametrize(
    ("body", "rule"),
    [
        ("01 06 10 00 00 05", ""), ("02 10 00 00 00 01 02 00 00", ""), ("03 06 10 00 00 03", ""),
        ("01 03 00 04 00 02", ""),        ("01 06 80 08 00 05", ""), ("02 10 02 00 00 01 02 00 05", ""),
        ("00 06 10 00 00 05", "unit"), ("04 03 10 01 00 01", "unit"),
        ("01 06 00 08 00 05", "store"), ("02 10 FF FD 00 01 02 00 00", "store"), ("03 06 00 05 00 01", "store"),
        ("03 10 00 05 00 01 02 00 01", "store"),
    ],
)  # fmt: skip
def test_what_is_sent(body: str, rule: str) -> None:
    units = {1: chf.stores, 2: sn300g5.stores, 3: jscc.stores}
    for coded in (rtu, ascii_):
        one = Observer(units, Figures(stop_us=0), ascii_=coded is ascii_)
        one.sent(7, coded(bytes.fromhex(body)))
        assert [each[2] for each in one.found] == ([rule] if rule else [])
    asked = Observer(units, Figures(stop_us=0))
    asked.may_store = {1, 2, 3}
    asked.sent(7, rtu(bytes.fromhex(body)))
    assert [each[2] for each in asked.found] == (["unit"] if rule == "unit" else [])


def test_a_damaged_frame_of_the_master_is_found() -> None:
    one = Observer({1: chf.stores}, Figures(stop_us=0))
    one.sent(7, b"\x01\x03\x10\x01\x00\x01\x00\x00")
    assert one.found == [(7, -1, "frame", "0103100100010000")]
