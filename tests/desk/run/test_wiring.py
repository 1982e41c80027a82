"""How a program reaches its port is found by types and calls, whatever its variables are called."""

import pytest
from tests.desk.run.desk import BOX, EXAMPLE, ONE, Desk, loaded, wired
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
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
    (line,) = found.lines
    assert (line.line, line.port, line.rx_count, line.rx_chars, line.tx_chars) == (
        "Bus",
        None,
        "Received",
        "Rx",
        "Tx",
    )
    assert line.pins == {"ELAPSEDMS": "Elapsed", "PORTLATEMS": "Bus.PORTLATEMS", "PORTERRORID": "Bus.PORTERRORID"}
    assert found.restart == ("First",)
    assert found.drives == (DriveBlock("Motor", "JSCC"),)
    assert found.inputs == ("Start", "Hz")


def test_a_mailbox_of_its_own() -> None:
    (line,) = wired(BOX).lines
    assert (line.line, line.port) == ("Bus", "Box")
    assert line.pins == {"ELAPSEDMS": "Elapsed", "PORTLATEMS": "Box.LateMs", "PORTERRORID": "Box.ErrorID"}


def test_the_example_measures_nothing_and_knows_its_first_scan() -> None:
    found = wired(EXAMPLE.read_text(encoding="utf-8"))
    assert [block.path for block in found.drives] == ["Pump1", "Pump2", "Fan"]
    assert found.restart == ()
    assert found.lines[0].pins["ELAPSEDMS"] == "ElapsedMs"


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
    (line,) = found.lines
    assert (line.line, line.rx_count, line.rx_chars) == ("Hall.Line", "Cable.Count", "Cable.Bytes")
    assert (line.tx_chars, line.pins["ELAPSEDMS"]) == ("Hall.Out", "Time")
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
    assert (found.lines[0].rx_count, found.inputs) == ("Received", ("Start", "Hz"))
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
    (line,) = wired(ONE.replace("  Quotient := 1", "  Elapsed := 10;\n  Quotient := 1")).lines
    assert line.pins["ELAPSEDMS"] is None
    assert line.notes == ()


def test_a_time_that_is_no_variable_is_reported() -> None:
    (note,) = wired(ONE.replace("ElapsedMs := Elapsed", "ElapsedMs := 10")).lines[0].notes
    assert str(note).startswith("my.st:20:3: ElapsedMs is no variable: a late scan is not seen;")


TWO = ONE.replace(
    "END_VAR\n",
    """  Count2 : UINT;
  Rx2 : MB_Adu;
  Tx2 : MB_LineFrame;
  Fan, Pump : CHF_Drive;
  Bus2 : MB_ByteLine2;
  Slots2 : MB_Slots2;
END_VAR
""",
).replace(
    "END_PROGRAM",
    """  Fan(Enable := TRUE, RunForward := Start, SpeedReferenceHz := Hz, MaximumHz := 50.0, FullScaleHz := 50.0,
    Address := 7, StopWithinMs := 15000, Slot := Slots2[1]);
  Bus2(ElapsedMs := Elapsed, BitRate := 9600, Restart := First, RxCount := Count2, RxChars := Rx2, TxChars := Tx2,
    Slots := Slots2);
END_PROGRAM""",
)


def test_each_line_has_its_port_and_the_drives_of_its_slots() -> None:
    found = wired(TWO)
    assert [(each.line, each.rx_count, [one.path for one in each.drives]) for each in found.lines] == [
        ("Bus", "Received", ["Motor"]), ("Bus2", "Count2", ["Fan"]),
    ]  # fmt: skip
    assert found.inputs == ("Start", "Hz")
    assert "cannot be seen on which line Fan is" in told(TWO.replace("Slots2[1]", "Slots2[Quotient]"))


def test_what_a_block_of_the_library_writes_is_no_input() -> None:
    scale = "  Level : VFD_Scale;\n  Raw : INT;\nEND_VAR\n  Level(Raw := Raw);\n"
    text = ONE.replace("END_VAR\n", scale).replace("SpeedReferenceHz := Hz", "SpeedReferenceHz := Level.Value")
    assert wired(text).inputs == ("Start",)


def test_the_drives_of_two_lines_turn_and_are_stopped_at_the_end() -> None:
    fan = SimulatedDrive(MAPS["CHF"], 7)
    desk = Desk(TWO, others=[fan]).scan(3000)
    desk.instance["Start"] = True
    desk.scan(4000)
    assert (desk.drives[0].mode, fan.mode) == ("running", "running")
    desk.session.run(0)
    assert desk.session.result is not None
    assert desk.session.result.stopped == ("Motor", "Fan")
    assert (desk.drives[0].mode, fan.mode) == ("standstill", "standstill")


SECOND = ONE.replace("  Bus :", "  Bus, Other :").replace(
    "END_PROGRAM", "  Other(RxCount := Received, RxChars := Rx, TxChars := Tx, Slots := Slots);\nEND_PROGRAM"
)


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("PROGRAM P\nVAR\n  A : INT;\nEND_VAR\n  A := 1;\nEND_PROGRAM\n", "my.st:1:9: P calls no line"),
        (SECOND, "my.st:22:3: Bus and Other share Received; give each line a port of its own"),
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
    assert [each.line for each in found.lines] == ["Bus"]
