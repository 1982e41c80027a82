"""Programs that go wrong: loops without end, wild indices, checks that are not reached, programs that never end."""

from dataclasses import replace

import pytest

from driveblocks.bench import execute, harness
from driveblocks.bench.execute import Setting
from driveblocks.bench.outcome import Outcome, Result
from driveblocks.bench.script import Probe, Program, Script
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Source

BLOCK = """FUNCTION_BLOCK VFD_Trouble
VAR_INPUT
  Number : UINT;
END_VAR
VAR_OUTPUT
  Result : UINT;
END_VAR
VAR
  Index : UINT;
  Table : ARRAY[0..3] OF UINT;
END_VAR
  IF Number = 99 THEN
    WHILE Index < 1 DO
      Result := 1;
    END_WHILE;
  END_IF;
  Table[Number] := Number;
  Result := Table[Number] + 1;
END_FUNCTION_BLOCK
"""
TYPES = "TYPE\n  MB_Adu : ARRAY[0..255] OF BYTE;\nEND_TYPE\nTYPE\n  MB_Chars : ARRAY[0..512] OF BYTE;\nEND_TYPE\n"
RIGHT = Probe("Number", "Expected := Trouble.Result, Actual := Trouble.Result", "itself")


def program(*stages: tuple[str, ...]) -> Program:
    """A program whose stages call the block with numbers; each call is followed by a check that holds."""
    script = Script("trouble", "VFD_TestTrouble", "trouble", "none")
    script.variables["Trouble"] = ("VFD_Trouble", "under test")
    for index, calls in enumerate(stages):
        items = [item for call in calls for item in (f"Trouble(Number := {call});", RIGHT)]
        script.stage(f"stage {index}", *items)
    (made,) = script.programs()
    return made


def scanned(made: Program, seconds: float = 600.0, engine: Engine | None = None) -> Result:
    """The program's result."""
    chosen = engine or EmbeddedEngine(loop_limit=1000)
    tests = [Source(path, text) for path, text in harness.texts().items()]
    sources = [Source("types.st", TYPES), Source("trouble.st", BLOCK), *tests, Source("tests/" + made.path, made.text)]
    return execute.execute(chosen.build(sources), made, Setting(chosen.name, "unit", "tests/", seconds))


def said(result: Result) -> list[tuple[str, str]]:
    return [(outcome.words.partition(":")[0], outcome.status) for outcome in result.outcomes]


def test_what_is_right_passes(engine: Engine) -> None:
    result = scanned(program(("0", "1"), ("2",)), engine=engine)
    assert said(result) == [("1", "passed"), ("2", "passed"), ("3", "passed")]
    assert result.passed


def test_a_wild_index_costs_the_checks_after_it_in_its_scan_alone() -> None:
    result = scanned(program(("0", "7", "1"), ("2",), ("9",), ("3",)))
    assert said(result) == [
        ("1", "passed"), ("2", "error"), ("3", "error"), ("4", "passed"), ("5", "error"), ("6", "passed"),
    ]  # fmt: skip
    assert "trouble.st:" in result.outcomes[1].message
    assert "outside 0..3" in result.outcomes[1].message
    assert result.outcomes[1].path == "tests/trouble/VFD_TestTrouble.st"


def test_a_loop_without_end_is_an_error_of_its_checks() -> None:
    result = scanned(program(("1",), ("99",), ("2",)))
    assert said(result) == [("1", "passed"), ("2", "error"), ("3", "passed")]
    assert "trouble.st:" in result.outcomes[1].message


def test_a_program_beyond_its_time_gives_up() -> None:
    result = scanned(program(("1",), ("2",), ("3",)), seconds=0.0)
    assert said(result) == [("1", "error"), ("2", "error"), ("3", "error")]
    assert result.outcomes[0].message == "the program was not done after 0 s"


def test_a_program_that_never_ends_fails() -> None:
    made = program(("1",), ("2",))
    text = made.body.text.replace("Done := TRUE;", "Done := FALSE;")
    result = scanned(replace(made, body=replace(made.body, text=text)))
    assert said(result) == [("1", "passed"), ("2", "passed"), ("ends", "failed")]
    assert result.outcomes[-1].message == "the program is not Done after 3 scans"


def test_a_check_that_the_program_skips_is_an_error() -> None:
    made = program(("1", "2"), ("3",))
    line = next(line for line in made.text.split("\n") if "(* 2: itself *)" in line)
    text = made.body.text.replace(line, "      Trouble(Number := 0);")
    result = scanned(replace(made, body=replace(made.body, text=text)))
    assert said(result) == [("1", "passed"), ("2", "error"), ("3", "passed")]
    assert result.outcomes[1].message == "the check was not reached"


def test_a_program_that_is_not_in_the_library_loses_all_its_checks() -> None:
    made = program(("1",))
    tests = [Source(path, text) for path, text in harness.texts().items()]
    library = EmbeddedEngine().build([Source("types.st", TYPES), *tests])
    result = execute.execute(library, made, Setting("embedded", "unit", "", 600.0))
    assert said(result) == [("1", "error")]
    assert "VFD_TESTTROUBLE" in result.outcomes[0].message.upper()


@pytest.mark.parametrize(
    ("probe", "expected", "actual"),
    [
        (Probe("Number", "Expected := 7, Actual := Trouble.Result", "w"), "7", "1"),
        (Probe("Between", "Lowest := 5, Highest := 7, Actual := Trouble.Result", "w"), "5", "1"),
        (Probe("Word", "Expected := WORD#16#ABCD, Actual := WORD#16#00FF", "w"), "16#ABCD", "16#00FF"),
        (Probe("Flag", "Expected := TRUE, Actual := FALSE", "w"), "TRUE", "FALSE"),
        (Probe("Real", "Expected := 50.1, Actual := 5.01, Tolerance := 0.01", "w"), "50.1", "5.01"),
        (Probe("Text", "Expected := 'Overcurrent', Actual := 'Under'", "w"), "Overcurrent", "Under"),
        (Probe("Text", "Expected := 'Overcurrent', Actual := 'Over'", "w"), "Overcurrent", "Over"),
        (Probe("Text", "Expected := '$E8$BF$87', Actual := '$FF$FF$FF'", "w"), "过", "FF FF FF"),
        (Probe("Adu", "First := 1, Count := 2, Expected := DWORD#16#0000A1B2, Adu := Adu", "w", 2), "A1 B2", "00 00"),
        (
            Probe("Bytes", "Expected := DWORD#16#00000005, Actual := DWORD#16#00000000", "w", names=("A", "B", "C")),
            "A, C",
            "none of them",
        ),
    ],
    ids=lambda value: value.pins[:30] if isinstance(value, Probe) else None,
)
def test_values_are_shown_as_the_check_means_them(probe: Probe, expected: str, actual: str) -> None:
    script = Script("trouble", "VFD_TestTrouble", "trouble", "none")
    script.variables["Trouble"] = ("VFD_Trouble", "under test")
    script.variables["Adu"] = ("MB_Adu", "bytes")
    script.stage("shown", "Trouble(Number := 0);", probe)
    script.stage("after it", "Trouble(Number := 0);", RIGHT)
    (made,) = script.programs()
    bad, good = scanned(made).outcomes
    assert (bad.status, bad.expected, bad.actual, bad.words) == ("failed", expected, actual, "1: shown: w")
    assert isinstance(good, Outcome)
    assert good.status == "passed"


def test_bounds_take_what_lies_between_them() -> None:
    script = Script("trouble", "VFD_TestTrouble", "trouble", "none")
    script.variables["Trouble"] = ("VFD_Trouble", "under test")
    for lowest, highest in ((0, 1), (1, 1), (1, 2), (2, 3), (0, 0)):
        pins = f"Lowest := {lowest}, Highest := {highest}, Actual := Trouble.Result"
        script.stage(f"{lowest} to {highest}", "Trouble(Number := 0);", Probe("Between", pins, "1"))
    (made,) = script.programs()
    assert [outcome.status for outcome in scanned(made).outcomes] == ["passed", "passed", "passed", "failed", "failed"]


def test_a_stage_with_more_checks_than_a_scan_takes_becomes_several() -> None:
    result = scanned(made := program(tuple("0123" * 20)))
    assert (made.stages, len(result.outcomes), result.passed) == (3, 80, True)


def test_a_table_of_many_stages_becomes_several_programs() -> None:
    script = Script("trouble", "VFD_TestTrouble", "trouble", "none")
    script.variables["Trouble"] = ("VFD_Trouble", "under test")
    for _ in range(120):
        script.stage("again", "Trouble(Number := 0);", RIGHT)
    made = list(script.programs())
    assert [(one.name, one.stages) for one in made] == [("VFD_TestTrouble1", 100), ("VFD_TestTrouble2", 20)]
    assert all(scanned(one).passed for one in made)
