"""CONFIGURATION, RESOURCE, TASK, globals, and programs on virtual time."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.configuration import start
from tests.structured_text.engines.embedded import schedule
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.engine import Engine, ScanError, Source

TEXT = """TYPE Row : ARRAY[0..2] OF INT; END_TYPE
FUNCTION_BLOCK Bump
VAR_EXTERNAL total : INT; END_VAR
  total := total + 1;
END_FUNCTION_BLOCK
PROGRAM Count
VAR_INPUT start : INT; END_VAR
VAR_OUTPUT sum : INT; END_VAR
VAR_EXTERNAL total : INT; share : Row; END_VAR
VAR scans : INT; inner : Bump; beat : TON; END_VAR
  scans := scans + 1;
  sum := start + scans;
  inner();
  share[1] := total;
  beat(IN := TRUE, PT := T#50ms);
END_PROGRAM
CONFIGURATION Plant
VAR_GLOBAL total : INT := 100; share : Row := [5]; begin : INT := 7; go : BOOL; END_VAR
RESOURCE Station ON PLC
VAR_GLOBAL local : INT; END_VAR
TASK Slow(INTERVAL := T#30ms, PRIORITY := 2);
TASK Fast(INTERVAL := T#20ms, PRIORITY := 1);
TASK Event(SINGLE := go, PRIORITY := 0);
PROGRAM First WITH Slow : Count(start := begin, sum => local);
PROGRAM Second WITH Fast : Count;
PROGRAM Third WITH Event : Count;
PROGRAM Fourth : Count;
END_RESOURCE
END_CONFIGURATION
"""
PROGRAMS = ("First", "Second", "Third", "Fourth")


def test_tasks_are_due_by_their_intervals() -> None:
    """Every 30 ms, every 20 ms, on an event, and in every tick of 10 ms."""
    running = start(build(TEXT))
    assert running.tick_ns == 10_000_000
    running.run(12)
    assert [running[f"Station.{name}.scans"] for name in PROGRAMS] == [4, 6, 0, 12]
    running["go"] = True
    running.run(3)
    running["go"] = False
    running.run()
    running["go"] = True
    running.run()
    assert running["station.THIRD.scans"] == 2


def test_globals_are_shared() -> None:
    """Among programs and blocks, of one configuration only."""
    library = build(TEXT)
    running, other = start(library, "plant"), start(library, "Plant")
    running.run(1)
    assert (running["total"], running["share"], other["total"]) == (103, [5, 103, 0], 100)
    assert (running["Station.local"], running["Station.First.start"]) == (8, 7)
    running["total"], running["share[2]"] = 0, 9
    running.run(1)
    assert (running["TOTAL"], running["share"]) == (1, [5, 1, 9])


def test_the_clock_is_the_configuration_s() -> None:
    """A timer of 50 ms, in a program that runs each 10 ms."""
    running = start(build(TEXT))
    running.run(5)
    assert (running["Station.Fourth.beat.Q"], running["Station.Fourth.beat.ET"]) == (False, 40_000_000)
    running.run(1)
    assert running["Station.Fourth.beat.Q"] is True


def test_programs_run_by_priority() -> None:
    """0 first; matiec looks at no priority and keeps to the order of declaration."""
    text = """PROGRAM Mark
VAR_INPUT number : INT; END_VAR
VAR_EXTERNAL trace : DINT; END_VAR
  trace := trace * 10 + INT_TO_DINT(number);
END_PROGRAM
CONFIGURATION Plant
VAR_GLOBAL trace : DINT; END_VAR
RESOURCE Station ON PLC
TASK Late(INTERVAL := T#10ms, PRIORITY := 5);
TASK Soon(INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM A1 WITH Late : Mark(number := 1);
PROGRAM A2 : Mark(number := 2);
PROGRAM A3 WITH Soon : Mark(number := 3);
PROGRAM A4 WITH Soon : Mark(number := 4);
END_RESOURCE
END_CONFIGURATION"""
    for by_priority, trace in ((True, 3412), (False, 1234)):
        running = schedule.start(build(text), by_priority=by_priority)
        running.run()
        assert running["trace"] == trace


def test_a_block_alone_has_globals_of_its_own() -> None:
    """With their initial values, so that a block with VAR_EXTERNAL can be tested without the configuration."""
    library = build(TEXT)
    one, two = library.instance("Count"), library.instance("Count")
    one.scan()
    one.scan()
    two.scan()
    assert (one["scans"], two["scans"]) == (2, 1)


def test_state_and_paths() -> None:
    """Globals first, each resource's after its name; then the programs."""
    running = start(build(TEXT))
    paths = list(running.state())
    assert paths[:7] == ["TOTAL", "SHARE[0]", "SHARE[1]", "SHARE[2]", "BEGIN", "GO", "STATION.LOCAL"]
    assert "STATION.FIRST.BEAT.ET" in paths
    for wrong in ("Station.Fifth.scans", "absent", "Station.First.absent", "Station"):
        with pytest.raises(KeyError):
            running[wrong]
    with pytest.raises(KeyError, match="no configuration"):
        start(build(TEXT), "Other")
    with pytest.raises(KeyError, match="0 configurations"):
        start(build("FUNCTION_BLOCK B VAR n : INT; END_VAR n := 1; END_FUNCTION_BLOCK"))


def test_a_fault_in_a_task_is_a_scan_error() -> None:
    """At the statement."""
    text = TEXT.replace("sum := start + scans;", "sum := start / (scans - 2);")
    running = start(build(text))
    running.run(1)
    with pytest.raises(ScanError) as caught:
        running.run(1)
    assert caught.value.message.line == text.splitlines().index("  sum := start / (scans - 2);") + 1


def test_matiec_runs_the_same(matiec: Engine) -> None:
    """Every variable after each of some ticks, events included; its C of connected programs does not compile."""
    text = TEXT.replace("(start := begin, sum => local)", "")
    theirs = start(matiec.build([Source("test.st", text)]))
    mine = schedule.start(build(text), by_priority=False)
    assert mine.tick_ns == theirs.tick_ns
    for tick in range(40):
        for running in (mine, theirs):
            running["go"] = tick % 7 > 3
            running.run()
        assert mine.state() == theirs.state()
