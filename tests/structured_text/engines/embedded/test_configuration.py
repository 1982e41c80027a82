"""CONFIGURATION, RESOURCE, TASK, globals, and programs on virtual time."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.configuration import start
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.engine import ScanError

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
VAR_GLOBAL total : INT := 100; share : Row := [5]; END_VAR
RESOURCE Station ON PLC
TASK Slow(INTERVAL := T#30ms, PRIORITY := 2);
TASK Fast(INTERVAL := T#20ms, PRIORITY := 1);
PROGRAM First WITH Slow : Count;
PROGRAM Second WITH Fast : Count;
PROGRAM Fourth : Count;
END_RESOURCE
END_CONFIGURATION
"""


def test_globals_are_shared() -> None:
    """Among programs and blocks, of one configuration only."""
    library = build(TEXT)
    running, other = start(library, "plant"), start(library, "Plant")
    running.run(1)
    assert (running["total"], running["share"], other["total"]) == (103, [5, 103, 0], 100)
    running["total"], running["share[2]"] = 0, 9
    running.run(1)
    assert (running["TOTAL"], running["share"]) == (1, [5, 1, 9])


def test_a_block_alone_has_globals_of_its_own() -> None:
    """With their initial values, so that a block with VAR_EXTERNAL can be tested without the configuration."""
    library = build(TEXT)
    one, two = library.instance("Count"), library.instance("Count")
    one.scan()
    one.scan()
    two.scan()
    assert (one["scans"], two["scans"]) == (2, 1)


def test_a_fault_in_a_task_is_a_scan_error() -> None:
    """At the statement."""
    text = TEXT.replace("sum := start + scans;", "sum := start / (scans - 2);")
    running = start(build(text))
    running.run(1)
    with pytest.raises(ScanError) as caught:
        running.run(1)
    assert caught.value.message.line == text.splitlines().index("  sum := start / (scans - 2);") + 1
