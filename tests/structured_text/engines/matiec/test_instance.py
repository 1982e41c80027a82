"""Instances on matiec: values of every type go in and come out, and nothing else changes."""

import math
import platform
import sys
from collections.abc import Callable

import pytest

from structured_text.engines.engine import ScanError, Value
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]

TYPES = """
TYPE
  Bytes8 : ARRAY[1..8] OF BYTE;
END_TYPE
TYPE
  Grid : ARRAY[0..2, -1..1] OF INT;
END_TYPE
TYPE
  Colour : (Red, Green, Blue);
END_TYPE
TYPE
  Percent : INT(0..100) := 50;
END_TYPE
TYPE
  Station : STRUCT
    Busy : BOOL;
    Data : Bytes8;
    Title : STRING;
    Scale : REAL;
  END_STRUCT;
END_TYPE
TYPE
  Stations : ARRAY[1..3] OF Station;
END_TYPE
"""

HOLDER = (
    TYPES
    + """
FUNCTION_BLOCK Holder
  VAR_INPUT
    Bit : BOOL;
    B : BYTE; W : WORD; Dw : DWORD; Lw : LWORD;
    Si : SINT; I : INT; Di : DINT; Li : LINT;
    Us : USINT; Ui : UINT; Ud : UDINT; Ul : ULINT;
    R : REAL; Lr : LREAL;
    Text : STRING := 'start$0D';
    Span : TIME := T#1s500ms;
  END_VAR
  VAR
    Marked : Colour := Green;
    Part : Percent;
    Matrix : Grid := [1, 2, 3, 4, 5, 6, 7, 8, 9];
    Longs : ARRAY[2..4] OF LREAL;
    Labels : ARRAY[0..1] OF STRING;
    All : Stations;
  END_VAR
  VAR_OUTPUT
    Scans : UINT := 7;
  END_VAR
  VAR CONSTANT
    LIMIT_OF_SCANS : INT := 99;
  END_VAR
  VAR_TEMP
    Passing : INT;
  END_VAR
  Passing := 5;
  Scans := Scans + 1;
  All[2].Data[3] := B;
END_FUNCTION_BLOCK
"""
)

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

EXTREMES: list[tuple[str, Value]] = [
    ("Bit", True),
    ("B", 0xFF),
    ("W", 0xFFFF),
    ("Dw", 0xFFFF_FFFF),
    ("Lw", 0xFFFF_FFFF_FFFF_FFFF),
    ("Si", -128),
    ("I", -32768),
    ("Di", -(2**31)),
    ("Li", -(2**63)),
    ("Us", 255),
    ("Ui", 65535),
    ("Ud", 2**32 - 1),
    ("Ul", 2**64 - 1),
    ("R", -1.5),
    ("R", math.inf),
    ("Lr", 1e300),
    ("Text", b""),
    ("Text", bytes(range(256))[130:256]),
    ("Span", 1),
    ("Span", -1_500_000_000),
    ("Span", 100 * 86400 * 10**9),
    ("Marked", 2),
    ("Matrix", [[1, -2, 3], [4, 5, -6], [7, 8, 32767]]),
    ("Longs", [0.5, -0.25, 1e-300]),
    ("Labels", [b"a", b"bc"]),
    ("All[3]", {"BUSY": True, "DATA": [1, 2, 3, 4, 5, 6, 7, 8], "TITLE": b"x", "SCALE": 0.5}),
    ("All[1].Data[8]", 200),
]


@pytest.mark.parametrize(("path", "value"), EXTREMES)
def test_value_goes_in_and_comes_out(build: Builder, path: str, value: Value) -> None:
    holder = build(HOLDER).instance("Holder")
    before = holder.state()
    holder[path] = value
    assert holder[path] == value
    changed = {name for name, now in holder.state().items() if now != before[name]}
    assert all(name.startswith(path.upper()) for name in changed)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("B", 256),
        ("B", -1),
        ("I", 32768),
        ("Ul", 2**64),
        ("I", 1.5),
        ("Bit", 2),
        ("R", 1e39),
        ("R", b"1"),
        ("Text", b"x" * 127),
        ("Text", 5),
        ("Span", 0.5),
        ("Marked", 3),
        ("All[1].Data", [0] * 9),
        ("All[1].Data", 7),
        ("All[1].Data", [1, 2, 300]),
        ("All", [{"BUSY": True, "SCALE": b""}]),
        ("LIMIT_OF_SCANS", 1),
        ("Matrix", [1, 2, 3]),
        ("All[1]", {"NOTHING": 1}),
        ("All[1]", 1),
    ],
)
def test_value_that_does_not_fit_is_refused(build: Builder, path: str, value: Value) -> None:
    holder = build(HOLDER).instance("Holder")
    before = holder.state()
    with pytest.raises(ValueError, match=r"\w"):
        holder[path] = value
    assert holder.state() == before


@pytest.mark.parametrize(
    "path",
    [
        "Nothing",
        "",
        "Bit.X",
        "B[1]",
        "All[0]",
        "All[4].Busy",
        "All[1",
        "Matrix[3,0]",
        "Matrix[0]",
        ".Bit",
        "A ll",
    ],
)
def test_path_that_leads_nowhere_is_a_key_error(build: Builder, path: str) -> None:
    holder = build(HOLDER).instance("Holder")
    with pytest.raises(KeyError, match=r"\w"):
        holder[path]
    with pytest.raises(KeyError, match=r"\w"):
        holder[path] = 0


def test_state_has_every_scalar_in_the_order_of_declaration(build: Builder) -> None:
    state = build(HOLDER).instance("Holder").state()
    names = list(state)
    assert names[:5] == ["BIT", "B", "W", "DW", "LW"]
    assert names.index("SPAN") < names.index("MARKED") < names.index("MATRIX[0,-1]") < names.index("MATRIX[0,0]")
    assert names.index("ALL[3].SCALE") < names.index("SCANS") < names.index("LIMIT_OF_SCANS")
    assert "PASSING" not in state  # a VAR_TEMP does not outlive the scan
    assert "ENO" not in state
    assert len(state) == 17 + 2 + 9 + 3 + 2 + 3 * (1 + 8 + 1 + 1) + 2
    assert all(type(state[name]) is kind for name, kind in (("BIT", bool), ("B", int), ("R", float), ("TEXT", bytes)))


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
    monkeypatch.setattr("structured_text.engines.matiec.guard.SCAN_SECONDS", 0.25)
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
