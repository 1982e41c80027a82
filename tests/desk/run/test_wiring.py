"""How a program reaches its port is found by types and calls, whatever its variables are called."""

import pytest
from tests.desk.run.desk import BOX, EXAMPLE, ONE, Desk, loaded, wired

from driveblocks.desk.run import wiring
from driveblocks.desk.run.wiring import DriveBlock, Wiring
from structured_text.engines.engine import BuildError


def told(text: str) -> str:
    """What is wrong with a program."""
    with pytest.raises(BuildError) as error:
        wired(text)
    return str(error.value)


def test_the_bytes_of_a_line_are_program_variables() -> None:
    found = wired(ONE)
    assert (found.line, found.port, found.rx_count, found.rx_chars, found.tx_chars) == (
        "Bus",
        None,
        "Received",
        "Rx",
        "Tx",
    )
    assert found.pins == {"ELAPSEDMS": "Elapsed", "PORTLATEMS": "Bus.PORTLATEMS", "PORTERRORID": "Bus.PORTERRORID"}
    assert found.restart == ("First",)
    assert found.drives == (DriveBlock("Motor", "JSCC"),)
    assert found.inputs == ("Start", "Hz")


def test_a_mailbox_of_its_own() -> None:
    found = wired(BOX)
    assert (found.line, found.port) == ("Bus", "Box")
    assert found.pins == {"ELAPSEDMS": "Elapsed", "PORTLATEMS": "Box.LateMs", "PORTERRORID": "Box.ErrorID"}


def test_the_example_measures_nothing_and_knows_its_first_scan() -> None:
    found = wired(EXAMPLE.read_text(encoding="utf-8"))
    assert [block.path for block in found.drives] == ["Pump1", "Pump2", "Fan"]
    assert found.restart == ()
    assert found.pins["ELAPSEDMS"] == "ElapsedMs"


CONTACT = ONE.replace("END_VAR", "  Contact : VFD_HardStop;\n  Began, Pressed : BOOL;\nEND_VAR").replace(
    "END_PROGRAM", "  Contact(Overdue := Bus.StopOverdue, Restart := Began, Reset := Pressed);\nEND_PROGRAM"
)


def test_the_contact_of_the_hard_stop_has_its_first_scan_and_its_button() -> None:
    desk = Desk(CONTACT)
    assert desk.controller.wiring.restart == ("First", "Began")
    assert desk.controller.wiring.inputs == ("Start", "Hz", "Pressed")
    desk.scan(3000)
    assert not desk.instance["Contact.HardStopOk"]
    desk.instance["Pressed"] = True
    desk.scan(10)
    assert desk.instance["Contact.HardStopOk"]


INSIDE = """TYPE
  Wires : STRUCT
    Count : UINT;
    Bytes : MB_Adu;
  END_STRUCT;
END_TYPE
FUNCTION_BLOCK Station
VAR_INPUT
  Ms : UINT;
  Go : BOOL;
END_VAR
VAR_IN_OUT
  In : Wires;
END_VAR
VAR
  Out : MB_LineFrame;
  Line : MB_ByteLine8;
  Motor : CHF_Drive;
  Slots : MB_Slots8;
END_VAR
  Motor(RunForward := Go, Slot := Slots[0]);
  Line(ElapsedMs := Ms, RxCount := In.Count, RxChars := In.Bytes, TxChars := Out, Slots := Slots);
END_FUNCTION_BLOCK
PROGRAM Plant
VAR
  Hall : Station;
  Cable : Wires;
  Time : UINT;
  Button : BOOL;
END_VAR
  Hall(Ms := Time, Go := Button, In := Cable);
END_PROGRAM
"""


def test_what_is_inside_a_block_leads_back_to_the_program() -> None:
    found = wired(INSIDE)
    assert (found.line, found.rx_count, found.rx_chars) == ("Hall.Line", "Cable.Count", "Cable.Bytes")
    assert (found.tx_chars, found.pins["ELAPSEDMS"]) == ("Hall.Out", "Time")
    assert found.drives == (DriveBlock("Hall.Motor", "CHF"),)
    assert found.inputs == ("Button",)


SHARED = ("Start : BOOL", "Received : UINT", "Motor : JSCC_Drive", "Slots : MB_Slots8")
"""Of the program, these are globals of its configuration."""


def shared(text: str) -> str:
    """A program whose variables are globals, in a configuration."""
    rows = "".join(f"  {each};\n" for each in SHARED)
    for each in SHARED:
        text = text.replace(f"  {each};\n", "")
    program = text.replace("PROGRAM One\n", f"PROGRAM One\nVAR_EXTERNAL\n{rows}END_VAR\n")
    resource = "RESOURCE R ON PLC\n  PROGRAM P : One;\nEND_RESOURCE\n"
    return f"{program}CONFIGURATION C\nVAR_GLOBAL\n{rows}END_VAR\n{resource}END_CONFIGURATION\n"


def test_globals_of_a_configuration_are_served_like_the_program_s_own() -> None:
    desk = Desk(shared(ONE)).started()
    found = desk.controller.wiring
    assert (found.rx_count, found.inputs) == ("Received", ("Start", "Hz"))
    assert found.drives == (DriveBlock("Motor", "JSCC"),)
    assert desk.drives[0].mode == "running"
    desk.session.run(0)
    assert desk.session.result is not None
    assert (desk.drives[0].mode, desk.session.result.stopped) == ("standstill", ("Motor",))


def test_a_drive_that_could_not_be_stopped_is_refused() -> None:
    """The program's own variable hides the global, by whose name the drive would be found."""
    inner = shared(ONE).replace("PROGRAM One", "FUNCTION_BLOCK Inner").replace("END_PROGRAM", "END_FUNCTION_BLOCK")
    outer = "PROGRAM One\nVAR\n  Motor : BOOL;\n  Box : Inner;\nEND_VAR\n  Box();\nEND_PROGRAM\n"
    text = inner.replace("CONFIGURATION C", f"{outer}CONFIGURATION C", 1)
    assert "this may be one JSCC_Drive or another, so it could not be stopped at the end; call each by its" in told(
        text
    )


def test_a_time_that_the_program_writes_itself_is_left_alone() -> None:
    found = wired(ONE.replace("  Quotient := 1", "  Elapsed := 10;\n  Quotient := 1"))
    assert found.pins["ELAPSEDMS"] is None
    assert found.notes == ()


def test_a_time_that_is_no_variable_is_reported() -> None:
    (note,) = wired(ONE.replace("ElapsedMs := Elapsed", "ElapsedMs := 10")).notes
    assert str(note).startswith("my.st:20:3: ElapsedMs is no variable: a late scan is not seen;")


SECOND = ONE.replace("  Bus :", "  Bus, Other :").replace(
    "END_PROGRAM", "  Other(RxCount := Received, RxChars := Rx, TxChars := Tx, Slots := Slots);\nEND_PROGRAM"
)


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("PROGRAM P\nVAR\n  A : INT;\nEND_VAR\n  A := 1;\nEND_PROGRAM\n", "my.st:1:9: P calls no line"),
        (SECOND, "my.st:22:3: 2 ports (Bus, Other): one port can be served"),
        (ONE.replace("RxCount := Received", "RxCount := 0"), "my.st:20:3: RxCount of Bus has no variable"),
        (ONE.replace("  Quotient := 1", "  Received := 0;\n  Quotient := 1"), "the program writes Received"),
        ("TYPE\n  Count : INT;\nEND_TYPE\n", "my.st:1:1: there is no PROGRAM"),
        (ONE + ONE.replace("One", "Two"), "my.st:23:1: there are 2 PROGRAMs; choose by --program: One, Two"),
        (ONE.replace("Hz : REAL", "Hz : REEL"), "my.st:4:8: "),
        (ONE.replace("JSCC_Drive", "ACME_Drive"), "my.st:10:11: "),
        (ONE.replace("Elapsed : UINT;", "Elapsed : UINT"), "my.st:6:3: "),
    ],
)  # fmt: skip
def test_what_is_wrong_is_reported_with_its_place(text: str, wrong: str) -> None:
    assert wrong in told(text)


def test_one_program_of_several_is_chosen() -> None:
    two = ONE + ONE.replace("One", "Two")
    assert loaded(two, "two").program.name == "Two"
    with pytest.raises(BuildError, match="there is no PROGRAM Three; choose by --program: One, Two"):
        loaded(two, "Three")


def test_a_block_that_the_program_brings_takes_the_place_of_the_library_s() -> None:
    pins = "VAR_INPUT\n  Number : UINT;\n  More : UINT;\nEND_VAR\n"
    own = f"FUNCTION MB_Plus : UINT\n{pins}  MB_Plus := Number + More;\nEND_FUNCTION\n"
    found: Wiring = wiring.find(loaded(own + ONE).program, set(loaded(own + ONE).drives))
    assert found.line == "Bus"
