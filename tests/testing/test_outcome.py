"""What a program says of a wrong block: which check failed, where, what was expected and what was found."""

from driveblocks.bench.outcome import Outcome
from driveblocks.bench.unit import Unit

from .conftest import changed, only, run


def reds(unit: Unit) -> list[Outcome]:
    done = run(unit)
    assert not done.passed
    return [outcome for result in done.results for outcome in result.bad]


def test_a_failure_says_which_check_failed_where_and_how(example: Unit) -> None:
    unit = only(changed(example, "EX100_DCBusVoltageV", "/ 10.0", "/ 100.0"), "Frames")
    (found,) = reds(unit)
    assert found.words.endswith(": 548.8 V")
    assert (found.expected, found.actual) == ("548.8", "54.88")
    assert found.message == "expected 548.8, found 54.88"
    (program,) = unit.suite.programs
    lines = program.text.split("\n")[found.line - 1 : found.line + 1]
    assert found.place == f"tests/iec61131/example/EX100_TestFrames.st:{found.line}"
    assert "EX100_DCBusVoltageV(Raw := Words[0])" in lines[0]
    assert f"(* {found.words.partition(':')[0]}: 548.8 V *)" in lines[1]


def test_names_of_outputs_stand_for_bits(example: Unit) -> None:
    unit = only(
        changed(example, "EX100_Status", "WORD#16#0004) = WORD#16#0004", "WORD#16#0010) = WORD#16#0010"), "0010H"
    )
    found = next(outcome for outcome in reds(unit) if outcome.words.startswith("4: 0004H: Ready"))
    assert (found.expected, found.actual) == ("Ready", "none of them")


def test_one_failure_hides_no_other(example: Unit) -> None:
    unit = only(example, "FaultTextEn", "FaultNumber")
    unit = changed(unit, "EX100_FaultTextEn", "'OC Overcurrent'", "'OC Undercurrent'")
    unit = changed(unit, "EX100_FaultTextEn", "'OS Overspeed'", "'OS Underspeed'")
    unit = changed(unit, "EX100_FaultNumber", "Number := 17;", "Number := 18;")
    found = reds(unit)
    texts = [(outcome.expected, outcome.actual) for outcome in found if "text" in outcome.words]
    assert texts == [("OC Overcurrent", "OC Undercurrent"), ("OS Overspeed", "OS Underspeed")]
    assert len(found) > len(texts)


def test_a_library_that_does_not_compile_is_an_error_of_its_build(example: Unit, shared: Unit) -> None:
    done = run(changed(example, "EX100_Status", "Running := (", "Running := ((("), only(shared, "Digits"))
    build, *others = done.results
    assert (build.program, build.count("error")) == ("build", 1)
    assert "iec61131/example/EX100_Status.st:" in build.bad[0].message
    assert [result.passed for result in others] == [True, True]
