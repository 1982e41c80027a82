"""Bistables, edges, counters and timers (IEC 61131-3 clause 2.5.2.3), call by call."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.engine import ScanError

MS = 1_000_000
LIBRARY = build("FUNCTION_BLOCK B VAR n : INT; END_VAR n := 1; END_FUNCTION_BLOCK")


def standard(name: str) -> EmbeddedInstance:
    """A standard block on its own."""
    return LIBRARY.instance(name)


def test_bistables() -> None:
    """SR: set wins; RS: reset wins; without either they hold."""
    sr, rs = standard("SR"), standard("RS")
    for set_, reset, q_sr, q_rs in ((0, 0, 0, 0), (1, 0, 1, 1), (0, 0, 1, 1), (1, 1, 1, 0), (0, 0, 1, 0), (0, 1, 0, 0)):
        sr["S1"], sr["R"], rs["S"], rs["R1"] = set_, reset, set_, reset
        sr.scan()
        rs.scan()
        assert (sr["Q1"], rs["Q1"]) == (bool(q_sr), bool(q_rs))


def test_rising_edge() -> None:
    """One call long."""
    trig = standard("R_TRIG")
    seen = []
    for level in (False, True, True, False, True):
        trig["CLK"] = level
        trig.scan()
        seen.append(trig["Q"])
    assert seen == [False, True, False, False, True]


def test_falling_edge() -> None:
    """On a first call with CLK FALSE: an edge by the standard's text and Beremiz, none in OpenPLC, so refused."""
    trig = standard("F_TRIG")
    seen = []
    for level in (True, False, False, True, False):
        trig["CLK"] = level
        trig.scan()
        seen.append(trig["Q"])
    assert seen == [False, True, False, False, True]
    with pytest.raises(ScanError, match="R_TRIG of the negation"):
        standard("F_TRIG").scan()


def pulses(block: EmbeddedInstance, pin: str, count: int) -> None:
    """So many rising edges."""
    for _ in range(count):
        for level in (True, False):
            block[pin] = level
            block.scan()


@pytest.mark.parametrize("suffix", ["", "_DINT", "_LINT", "_UDINT", "_ULINT"])
def test_counters(suffix: str) -> None:
    """Up to PV, down to zero, both ways; reset and load go first."""
    up, down, both = (standard(name + suffix) for name in ("CTU", "CTD", "CTUD"))
    up["PV"] = down["PV"] = both["PV"] = 3
    pulses(up, "CU", 2)
    assert (up["CV"], up["Q"]) == (2, False)
    pulses(up, "CU", 1)
    assert (up["CV"], up["Q"]) == (3, True)
    up["R"] = True
    pulses(up, "CU", 1)
    assert (up["CV"], up["Q"]) == (0, False)
    down["LD"] = True
    down.scan()
    down["LD"] = False
    pulses(down, "CD", 3)
    assert (down["CV"], down["Q"]) == (0, True)
    pulses(both, "CU", 2)
    pulses(both, "CD", 1)
    assert (both["CV"], both["QU"], both["QD"]) == (1, False, False)
    both["CU"] = both["CD"] = True
    both.scan()
    assert both["CV"] == 1


def test_counting_on_at_the_end() -> None:
    """By the standard to the end of the type; matiec stops at PV and at zero; so it is refused."""
    for name, pin, text in (("CTU", "CU", "at PV"), ("CTD", "CD", "at zero")):
        with pytest.raises(ScanError, match=text):
            pulses(standard(name), pin, 1)


# Milliseconds, IN, then Q and ET in milliseconds; PT is 50 ms. From the timing diagrams of table 38.
TON = [(0, 0, 0, 0), (10, 1, 0, 0), (30, 1, 0, 20), (59, 1, 0, 49), (60, 1, 1, 50), (99, 1, 1, 50), (100, 0, 0, 0)]
TON += [(110, 1, 0, 0), (120, 0, 0, 0), (130, 1, 0, 0), (500, 1, 1, 50)]
TOF = [(0, 0, 0, 0), (10, 1, 1, 0), (30, 0, 1, 0), (50, 0, 1, 20), (79, 0, 1, 49), (80, 0, 0, 50), (99, 0, 0, 50)]
TOF += [(100, 1, 1, 0), (110, 0, 1, 0), (120, 1, 1, 0), (300, 1, 1, 0)]
TP = [(0, 0, 0, 0), (10, 1, 1, 0), (20, 0, 1, 10), (30, 1, 1, 20), (59, 1, 1, 49), (60, 1, 0, 50), (90, 1, 0, 50)]
TP += [(100, 0, 0, 0), (110, 1, 1, 0), (120, 0, 1, 10), (170, 0, 0, 0), (180, 1, 1, 0)]


@pytest.mark.parametrize(("name", "rows"), [("TON", TON), ("TOF", TOF), ("TP", TP)])
def test_timers(name: str, rows: list[tuple[int, int, int, int]]) -> None:
    """On virtual time, far from zero as well."""
    for start in (0, 10**15):
        timer = standard(name)
        timer["PT"] = 50 * MS
        for now, level, q, elapsed in rows:
            timer["IN"] = bool(level)
            timer.scan(start + now * MS)
            assert (now, timer["Q"], timer["ET"]) == (now, bool(q), elapsed * MS)


def test_time_stays_when_nobody_moves_it() -> None:
    """`scan()` without a time leaves the clock alone."""
    timer = standard("TON")
    timer["IN"], timer["PT"] = True, 10 * MS
    timer.scan(5 * MS)
    for _ in range(5):
        timer.scan()
        assert timer["ET"] == 0
    timer.scan(15 * MS)
    assert timer["Q"] is True


def test_a_time_of_zero() -> None:
    """Runs out in the next call on matiec and at once by the standard's diagrams: refused."""
    refused = standard("TON")
    refused["IN"] = True
    with pytest.raises(ScanError, match="PT of zero"):
        refused.scan(0)


def test_real_time_clock() -> None:
    """Runs on from PDT since the rising edge of IN."""
    clock = standard("RTC")
    clock["PDT"] = 10**18
    clock.scan(5 * MS)
    assert (clock["Q"], clock["CDT"]) == (False, 5 * MS)
    clock["IN"] = True
    clock.scan(7 * MS)
    clock.scan(10 * MS)
    assert (clock["Q"], clock["CDT"]) == (True, 10**18 + 3 * MS)


def test_semaphore() -> None:
    """BUSY says, by the standard, who had it before; matiec grants at once."""
    with pytest.raises(ScanError, match="SEMA"):
        standard("SEMA").scan()
