"""A whole CONFIGURATION on matiec."""

from collections.abc import Callable

import pytest
from tests.structured_text.engines.configuration import start

from structured_text.engines.matiec import BadCError
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]


EDGES = """
PROGRAM Adder
  VAR_INPUT
    Start : INT := 1;
  END_VAR
  VAR_OUTPUT
    Sum : INT;
  END_VAR
  Sum := Sum + Start;
END_PROGRAM
CONFIGURATION Wires
  VAR_GLOBAL
    Go : BOOL;
    Base : INT := 3;
  END_VAR
  RESOURCE Cpu ON PLC
    TASK Cyclic(INTERVAL := T#20ms, PRIORITY := 0);
    TASK Edge(SINGLE := Go, PRIORITY := 1);
    PROGRAM Often WITH Cyclic : Adder;
    PROGRAM Always : Adder;
    PROGRAM Rarely WITH Edge : Adder;
  END_RESOURCE
END_CONFIGURATION
"""

LOCATED = """
PROGRAM Wired
  VAR
    Lamp AT %QX0.3 : BOOL;
    Level AT %IW4 : INT;
  END_VAR
  VAR
    Seen : INT;
  END_VAR
  Lamp := TRUE;
  Seen := Level + 1;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON PLC
    TASK Beat(INTERVAL := T#10ms, PRIORITY := 0);
    PROGRAM P WITH Beat : Wired;
  END_RESOURCE
END_CONFIGURATION
"""


def test_wires_of_programs_are_bad_c(build: Builder) -> None:
    """matiec assigns the global as it holds it, flags and all."""
    with pytest.raises(BadCError, match=r"Cpu.c:\d+:\d+: .*incompatible type"):
        build(EDGES.replace("Often WITH Cyclic : Adder", "Often WITH Cyclic : Adder(Start := Base)"))


def test_located_variables_have_places(build: Builder) -> None:
    plant = start(build(LOCATED))
    plant["Cpu.P.Level"] = 41
    plant.run()
    assert (plant["Cpu.P.Lamp"], plant["Cpu.P.Seen"]) == (True, 42)
