"""One wrong constant in one block turns the programs red, and they say what was expected and what was found."""

import pytest

from driveblocks.testing.outcome import Outcome
from driveblocks.testing.unit import Unit

from .conftest import changed, only, run

DRIVE = [
    ("EX100_Request", "Most := 16;", "Most := 17;", "Request"),
    ("EX100_Request", "(Quantity < 1)", "(Quantity < 2)", "Request"),
    ("EX100_Request", "UnitAddress > 247", "UnitAddress > 246", "Request"),
    ("EX100_Request", "AND (Address <> WORD#16#0001)", "AND (Address <> WORD#16#0002)", "Request"),
    ("EX100_Request", "Behind > 65536", "Behind > 65535", "Request"),
    ("EX100_CanRead", "<= WORD_TO_UDINT(WORD#16#0001)", "<= WORD_TO_UDINT(WORD#16#0002)", "Request"),
    ("EX100_CanRead", "WORD#16#0023", "WORD#16#0022", "Request"),
    ("EX100_CanWrite", ">= WORD_TO_UDINT(WORD#16#FFFD)", ">= WORD_TO_UDINT(WORD#16#FFFE)", "Request"),
    ("EX100_Reply", "ExceptionAdd := 128", "ExceptionAdd := 64", "Reply"),
    ("EX100_Reply", "TwoByteCount := FALSE", "TwoByteCount := TRUE", "Reply"),
    ("EX100_Status", "WORD#16#0004) = WORD#16#0004", "WORD#16#0010) = WORD#16#0010", "0010H"),
    ("EX100_RunCommand", "SHR(Value, 8)", "SHR(Value, 9)", "0000H"),
    ("EX100_ControlSource", "Bus := Value = WORD#16#0001", "Bus := Value = WORD#16#0002", "0011H"),
    ("EX100_DCBusVoltageV", "/ 10.0", "/ 100.0", "Scales"),
    ("EX100_FrequencyReferencePercent", "Count > 32767", "Count > 32768", "Scales"),
    ("EX100_Command", "OR WORD#16#0001;", "OR WORD#16#0002;", "Command"),
    ("EX100_Command", "ResetEdge := FaultReset AND NOT ResetMemory;", "ResetEdge := FaultReset;", "FaultReset"),
    ("EX100_Command", "IF ResetWaits AND StopStands THEN", "IF ResetWaits THEN", "FaultReset"),
    ("EX100_Command", "IF StopAcknowledged AND Stopping THEN", "IF StopAcknowledged THEN", "FaultReset"),
    ("EX100_Command", "    ResetWaits := FALSE;\n    StopStands := FALSE;", "    ResetWaits := FALSE;", "FaultReset"),
    (
        "EX100_Command",
        "  IF NewStop THEN\n    StopStands := FALSE;",
        "  IF NewStop THEN\n    Held := Held;",
        "ResetStop",
    ),
    ("EX100_Command", "OR (EnableMemory AND NOT Enable)", "", "ResetStop"),
    ("EX100_Command", "  ELSIF NOT Motion THEN", "  ELSIF NOT RunForward THEN", "FaultReset"),
    ("EX100_Command", "ELSIF RunForward AND NOT Held THEN", "ELSIF RunForward THEN", "FaultReset"),
    ("EX100_Command", "(NewStop OR ResetEdge)", "ResetEdge", "Sequence"),
    ("EX100_Command", "(NewStop OR ResetEdge)", "NewStop", "FaultReset"),
    ("EX100_Command", "KeepWord AND WORD#16#", "KeepWord OR WORD#16#", "KeepWord"),
    ("EX100_Command", "Address := WORD#16#0002;", "Address := WORD#16#0000;", "FaultReset"),
    ("EX100_Reference", "* 10000.0", "* 1000.0", "Reference"),
    ("EX100_Reference", "Count + 0.5", "Count + 0.25", "Reference"),
    ("EX100_Reference", "Count < -0.5", "Count < 0.0", "Reference"),
    ("EX100_Reference", "MaximumHz >= LEAST", "MaximumHz >= 0.05", "Reference"),
    ("EX100_Reference", "AND (MaximumHz <= MOST)", "", "Reference"),
    ("EX100_Standstill", "AND (OutputFrequencyWord = WORD#16#0000)", "", "Standstill"),
    ("EX100_FaultNumber", "Number := 17;", "Number := 16;", "FaultNumber"),
    ("EX100_FaultTextEn", "'OS Overspeed'", "'OS Overspeeding'", "FaultTextEn"),
    ("EX100_FaultTextZh", "$E8$BF$87$E6$B5$81", "$E8$BF$87$E5$8E$8B", "FaultTextZh"),
    ("EX100_ErrorTextEn", "    5:", "    6:", "ErrorTextEn"),
    ("EX100_BitTextEn", "    20:", "    19:", "BitTextEn"),
    ("EX100_ValueTextEn", "        4:", "        3:", "ValueTextEn"),
]
SHARED = [
    ("MB_Crc16", "WORD#16#C0C1", "WORD#16#C0C0", "Checksums"),
    ("MB_Crc16Compact", "WORD#16#C001", "WORD#16#C003", "Checksums"),
    ("MB_Lrc", "(256 - Sum)", "(255 - Sum)", "Checksums"),
    ("MB_HexDigit", "Digit + 55", "Digit + 87", "Digits"),
    ("MB_RtuSeal", "Adu[Length + 1]", "Adu[Length]", "RtuSeal"),
    ("MB_RtuOpen", "AduLength < 5", "AduLength < 4", "RtuOpen"),
    ("MB_AsciiEncode", "BYTE#16#0A", "BYTE#16#0D", "AsciiEncode"),
    ("MB_AsciiDecode", "ErrorID := 25;", "ErrorID := 24;", "AsciiDecode"),
    ("MB_PackAdu16", "SHL(BYTE_TO_WORD(Adu[Position]), 8)", "BYTE_TO_WORD(Adu[Position])", "PackingAdu"),
    ("MB_UnpackChars8", "AND WORD#16#00FF", "AND WORD#16#007F", "PackingChars"),
    ("MB_BuildRead", "(Quantity > 125)", "(Quantity > 126)", "BuildRead"),
    ("MB_BuildWriteMultiple", "UINT_TO_BYTE(2 * Quantity)", "UINT_TO_BYTE(Quantity)", "BuildMultiple"),
    ("MB_ParseReply", "Tail <> Request.Value", "Tail = Request.Value", "Standard06H"),
    ("MB_ResultTextEn", "    34:", "    39:", "ResultTextEn"),
]  # fmt: skip


def reds(unit: Unit) -> list[Outcome]:
    done = run(unit)
    assert not done.passed
    return [outcome for result in done.results for outcome in result.bad]


@pytest.mark.parametrize(("block", "old", "new", "program"), DRIVE, ids=lambda value: str(value)[:40])
@pytest.mark.thorough
def test_a_wrong_constant_of_a_drive_is_found(example: Unit, block: str, old: str, new: str, program: str) -> None:
    found = reds(only(changed(example, block, old, new), program))
    assert all(outcome.expected != outcome.actual and outcome.line for outcome in found)


@pytest.mark.parametrize(("block", "old", "new", "program"), SHARED, ids=lambda value: str(value)[:40])
def test_a_wrong_constant_of_the_shared_blocks_is_found(
    shared: Unit, block: str, old: str, new: str, program: str
) -> None:
    assert all(outcome.expected != outcome.actual for outcome in reds(only(changed(shared, block, old, new), program)))


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
