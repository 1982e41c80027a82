"""A whole CONFIGURATION on matiec."""

from collections.abc import Callable

import pytest
from tests.structured_text.engines.configuration import start

from structured_text.engines.matiec import BadCError
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]

PLANT = """
TYPE
  Row : ARRAY[5..7] OF INT;
END_TYPE
TYPE
  Tank : STRUCT Level : REAL; Rows : Row; END_STRUCT;
END_TYPE
PROGRAM Counter
  VAR
    Count : UINT;
    Delay : TON;
  END_VAR
  VAR_EXTERNAL
    Total : INT;
    Storage : Tank;
  END_VAR
  Count := Count + 1;
  Total := Total + 1;
  Storage.Rows[6] := Total;
  Delay(IN := TRUE, PT := T#45ms);
END_PROGRAM
CONFIGURATION Plant
  VAR_GLOBAL
    Total : INT := 100;
    Storage : Tank;
    Clock : TON;
  END_VAR
  RESOURCE Cpu ON PLC
    VAR_GLOBAL
      Own : LREAL := 0.5;
    END_VAR
    TASK Fast(INTERVAL := T#10ms, PRIORITY := 0);
    TASK Slow(INTERVAL := T#25ms, PRIORITY := 1);
    PROGRAM Quick WITH Fast : Counter;
    PROGRAM Lazy WITH Slow : Counter;
  END_RESOURCE
END_CONFIGURATION
"""

TWO = """
PROGRAM Counter
  VAR
    Count : UINT;
  END_VAR
  Count := Count + 1;
END_PROGRAM
CONFIGURATION Both
  RESOURCE One ON PLC
    TASK Beat(INTERVAL := T#10ms, PRIORITY := 0);
    PROGRAM P WITH Beat : Counter;
  END_RESOURCE
  RESOURCE Two ON PLC
    TASK Beat(INTERVAL := T#20ms, PRIORITY := 0);
    PROGRAM P WITH Beat : Counter;
    PROGRAM Q WITH Beat : Counter;
  END_RESOURCE
END_CONFIGURATION
"""

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


def test_tasks_run_when_due(build: Builder) -> None:
    plant = start(build(PLANT))
    assert plant.tick_ns == 5_000_000
    plant.run()
    assert (plant["Cpu.Quick.Count"], plant["Cpu.Lazy.Count"]) == (1, 1)
    plant.run(9)  # 50 ms in all: ticks 0 2 4 6 8 and 0 5
    assert (plant["cpu.quick.count"], plant["CPU.LAZY.COUNT"]) == (5, 2)
    assert plant["Total"] == 107
    assert plant["Storage.Rows[6]"] == 107


def test_clock_runs_with_the_ticks(build: Builder) -> None:
    plant = start(build(PLANT), "plant")
    plant.run(9)
    assert (plant["Cpu.Quick.Delay.ET"], plant["Cpu.Quick.Delay.Q"]) == (40_000_000, False)
    plant.run(2)
    assert (plant["Cpu.Quick.Delay.ET"], plant["Cpu.Quick.Delay.Q"]) == (45_000_000, True)


def test_variables_can_be_written(build: Builder) -> None:
    plant = start(build(PLANT))
    plant["Total"] = -3
    plant["Cpu.Lazy.Count"] = 1000
    plant["Storage"] = {"LEVEL": 1.5, "ROWS": [1, 2, 3]}
    plant["Cpu.Own"] = 2.25
    plant.run()
    assert plant["Cpu.Lazy.Count"] == 1001
    assert plant["Storage"] == {"LEVEL": 1.5, "ROWS": [1, -1, 3]}
    assert plant["Cpu.Quick.Total"] == -1  # through the VAR_EXTERNAL
    assert plant["Cpu.Own"] == 2.25


def test_state_has_globals_and_programs(build: Builder) -> None:
    state = start(build(PLANT)).state()
    assert list(state)[:5] == ["TOTAL", "STORAGE.LEVEL", "STORAGE.ROWS[5]", "STORAGE.ROWS[6]", "STORAGE.ROWS[7]"]
    assert state["CPU.OWN"] == 0.5
    assert next(name for name in state if name.startswith("CPU.QUICK.")) == "CPU.QUICK.COUNT"
    assert not [name for name in state if name.endswith("QUICK.TOTAL")]


def test_configurations_are_apart(build: Builder) -> None:
    library = build(PLANT)
    first, second = start(library), start(library)
    first.run(3)
    assert (first["Cpu.Quick.Count"], second["Cpu.Quick.Count"]) == (2, 0)
    assert start(library)["Total"] == 100


def test_two_resources(build: Builder) -> None:
    both = start(build(TWO))
    both.run(4)
    assert [both[f"{name}.Count"] for name in ("One.P", "Two.P", "Two.Q")] == [4, 2, 2]


def test_programs_without_a_task_and_on_an_edge(build: Builder) -> None:
    wires = start(build(EDGES))
    wires["Cpu.Always.Start"] = 10
    sums = []
    for go in (False, True, True, False, True):
        wires["Go"] = go
        wires.run()
        sums.append([wires[f"Cpu.{name}.Sum"] for name in ("Often", "Always", "Rarely")])
    assert sums == [[1, 10, 0], [2, 20, 1], [3, 30, 1], [4, 40, 1], [5, 50, 2]]


def test_wires_of_programs_are_bad_c(build: Builder) -> None:
    """matiec assigns the global as it holds it, flags and all."""
    with pytest.raises(BadCError, match=r"Cpu.c:\d+:\d+: .*incompatible type"):
        build(EDGES.replace("Often WITH Cyclic : Adder", "Often WITH Cyclic : Adder(Start := Base)"))


def test_located_variables_have_places(build: Builder) -> None:
    plant = start(build(LOCATED))
    plant["Cpu.P.Level"] = 41
    plant.run()
    assert (plant["Cpu.P.Lamp"], plant["Cpu.P.Seen"]) == (True, 42)


def test_unknown_names(build: Builder) -> None:
    plant = start(build(PLANT))
    for path in ("Nothing", "Cpu", "Cpu.Nothing", "Cpu.Quick.Nothing", "Cpu.Quick.Count.X", "Totally"):
        with pytest.raises(KeyError, match=r"\w"):
            plant[path]
    with pytest.raises(KeyError, match="Other"):
        start(build(PLANT), "Other")


def test_no_configuration(build: Builder) -> None:
    library = build("FUNCTION F : INT VAR_INPUT A : INT; END_VAR F := A; END_FUNCTION\n")
    with pytest.raises(KeyError, match="no configuration"):
        start(library)
