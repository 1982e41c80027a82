"""Instances on matiec: their clock, many scans at once, and scans that are stopped."""

import platform
import sys
from collections.abc import Callable

import pytest

from structured_text.engines.engine import ScanError
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]

TYPES = """
TYPE
  Bytes8 : ARRAY[1..8] OF BYTE;
END_TYPE
TYPE
  Station : STRUCT
    Busy : BOOL;
    Data : Bytes8;
    Scale : REAL;
  END_STRUCT;
END_TYPE
TYPE
  Stations : ARRAY[1..3] OF Station;
END_TYPE
"""

NESTED = (
    TYPES
    + """
FUNCTION_BLOCK Inner
  VAR_INPUT
    Value : BYTE;
  END_VAR
  VAR_IN_OUT
    Buffer : Bytes8;
    Place : Station;
  END_VAR
  VAR_OUTPUT
    Calls : UINT;
  END_VAR
  Buffer[2] := Value;
  Place.Busy := TRUE;
  Calls := Calls + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer
  VAR_INPUT
    Go : BOOL;
  END_VAR
  VAR_OUTPUT
    Done : BOOL;
    Elapsed : TIME;
  END_VAR
  VAR_IN_OUT
    Shared : Bytes8;
  END_VAR
  VAR
    Worker : Inner;
    Delay : TON;
    All : Stations;
  END_VAR
  Worker(Value := BYTE#16#12, Buffer := Shared, Place := All[2]);
  Delay(IN := Go, PT := T#1s);
  Done := Delay.Q;
  Elapsed := Delay.ET;
END_FUNCTION_BLOCK
PROGRAM Wrapper
  VAR
    Block : Outer;
    Local : Bytes8;
  END_VAR
  Block(Go := TRUE, Shared := Local);
END_PROGRAM
"""
)


def test_a_list_that_does_not_fit_is_refused_as_a_whole(build: Builder) -> None:
    outer = build(NESTED).instance("Outer")
    before = outer.state()
    with pytest.raises(ValueError, match=r"\w"):
        outer["All"] = [{"BUSY": True, "SCALE": b""}]
    with pytest.raises(ValueError, match=r"\w"):
        outer["All[1].Scale"] = 1e39
    assert outer.state() == before


def test_instances_of_a_library_share_its_clock(build: Builder) -> None:
    library, other = build(NESTED), build(NESTED)
    first, second, elsewhere = library.instance("Outer"), library.instance("Outer"), other.instance("Outer")
    for each in (first, second, elsewhere):
        each["Go"] = True
        each.scan(0)
    first.scan(300_000_000)
    second.scan()
    elsewhere.scan()
    assert (first["Elapsed"], second["Elapsed"], elsewhere["Elapsed"]) == (300_000_000, 300_000_000, 0)


def test_scan_many_is_many_scans(build: Builder) -> None:
    library = build(NESTED)
    one, many = library.instance("Wrapper"), library.instance("Wrapper")
    for i in range(20):
        one.scan(1000 + i * 70_000_000)
    many.scan_many(20, 1000, 70_000_000)
    assert many.state() == one.state()
    one.scan()
    many.scan()
    assert many.state() == one.state()


def test_blocks_in_source_order_and_unknown_block(build: Builder) -> None:
    library = build(NESTED)
    assert list(library.blocks()) == ["Inner", "Outer", "Wrapper"]
    with pytest.raises(KeyError, match="NOTHING"):
        library.instance("Nothing")


TRAP = """
FUNCTION_BLOCK Filler
  VAR_INPUT I : INT; END_VAR
  VAR J : INT; END_VAR
  J := I;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Divider
  VAR_INPUT Divisor : DINT := 1; END_VAR
  VAR_OUTPUT Quotient : DINT; END_VAR
  Quotient := 100 / Divisor;
END_FUNCTION_BLOCK
"""


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="only x86 traps a division by zero")
def test_division_by_zero_ends_the_scan_and_not_the_process(build: Builder) -> None:
    divider = build(TRAP).instance("Divider")
    divider["Divisor"] = 0
    with pytest.raises(ScanError, match=r"^test.st:7:0: Divider: .*division by zero"):
        divider.scan(0)
    with pytest.raises(ScanError, match="division by zero"):
        divider.scan_many(5)
    divider["Divisor"] = 4
    divider.scan(1)
    assert divider["Quotient"] == 25


@pytest.mark.skipif(sys.platform == "win32", reason="there is no timer of processor time on Windows")
def test_scan_without_end_is_stopped(build: Builder, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("structured_text.engines.matiec.binary.SCAN_SECONDS", 0.25)
    text = """FUNCTION_BLOCK Endless
  VAR_INPUT
    Stop : BOOL := TRUE;
  END_VAR
  VAR_OUTPUT
    Turns : DINT;
  END_VAR
  Turns := Turns + 1;
  WHILE NOT Stop DO
    Turns := Turns + 1;
  END_WHILE;
END_FUNCTION_BLOCK
"""
    endless = build(text).instance("Endless")
    endless.scan_many(1000)
    assert endless["Turns"] == 1000
    endless["Stop"] = False
    with pytest.raises(ScanError, match="Endless: the scan was stopped by the watchdog: it took many seconds"):
        endless.scan()
    endless["Stop"] = True
    endless.scan()
    assert endless["Turns"] != 0
