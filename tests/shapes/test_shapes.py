"""Drives that are commanded by paths, pulses, several registers or active-low bits are one map each, and no code."""

import re
from dataclasses import replace
from decimal import Decimal
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.shapes import shapes, texts

from driveblocks.bench import runner
from driveblocks.bench.script import Suite
from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.unit import Unit
from driveblocks.cli import app
from driveblocks.desk.site.register import spans
from driveblocks.docs.page import documents
from driveblocks.maps import check
from driveblocks.maps.collection import Source
from driveblocks.maps.form import Span
from driveblocks.maps.model import Command, Condition, Does, Drive, Step
from driveblocks.maps.plan import plan
from driveblocks.maps.problem import Report
from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.polls import polls
from driveblocks.meaning.serial import serial
from driveblocks.output import units as tested
from driveblocks.reference.permission import Judge, Write
from driveblocks.render.context import kept
from driveblocks.render.drive import drive_block
from driveblocks.render.library import drive as library_of
from driveblocks.render.library import generic
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.language.lint import lint_sources

NAMES = tuple(shapes())
CONCERNED = re.compile(r"_Test(MayWrite|Command|Sequence|FaultReset|ResetStop|Standstill|[12]00[0-9]H)")
"""Programs that depend on the shape; requests and replies do not."""
every = pytest.mark.parametrize("name", NAMES)
FAULT = next(one for one in shapes()["packed"].operation.status if one.shows == "fault")


def command(drive: Drive, does: Does) -> Command:
    """One command of a drive."""
    return next(one for one in drive.operation.commands if one.does == does)


def judged(drive: Drive, *commands: Command) -> list[str]:
    """What the rules say when these commands stand in the place of the drive's own of their kind."""
    new = {one.does: one for one in commands}
    some = tuple(new.pop(one.does, one) for one in drive.operation.commands)
    report = Report("")
    check.check(replace(drive, operation=replace(drive.operation, commands=(*some, *new.values()))), report)
    return [problem.wrong for problem in report.problems]


def run(name: str, folder: Path, *words: str) -> str:
    """What a command prints about a shape."""
    path = folder / f"{name}.yaml"
    path.write_text(texts()[name], encoding="utf-8")
    result = CliRunner().invoke(app, [path.as_posix() if word == "MAP" else word for word in words])
    assert result.exit_code == 0, result.output
    return result.stdout


@cache
def units() -> dict[str, Unit]:
    """The blocks and programs of each."""
    sources = [Source(Path(f"{name}.yaml"), drive) for name, drive in shapes().items()]
    return {unit.suite.name: unit for unit in tested.units(sources, languages(["en"], "utf-8"))}


@pytest.mark.thorough
def test_their_blocks_are_clean_and_the_programs_of_their_commands_and_words_pass() -> None:
    blocks = {each.path: each for unit in units().values() for each in unit.blocks}
    assert [str(problem) for problem in lint_sources([(each.path, each.text) for each in blocks.values()])] == []
    made = tuple(each for name in NAMES for each in units()[name].suite.programs if CONCERNED.search(each.path))
    assert len(made) >= 4 * len(NAMES)
    assert runner.run([Unit(Suite("shapes", made, 1), tuple(blocks.values()))], [EmbeddedEngine()]).passed


@every
def test_the_command_block_is_left_out_where_a_command_takes_several_writes(name: str) -> None:
    unit, prefix = units()[name], shapes()[name].prefix
    paths = [*(each.path for each in unit.blocks), *(each.path for each in unit.suite.programs)]
    for block in (f"{prefix}_Command.st", f"{prefix}_TestCommand.st"):
        assert any(path.endswith(block) for path in paths) == (name in ("active_low", "packed"))


@every
def test_neither_direction_may_go_the_way_of_the_other(name: str) -> None:
    drive = shapes()[name]
    assert judged(drive) == []
    if name == "cia402":  # has one direction
        return
    forward, reverse = command(drive, "run_forward"), command(drive, "run_reverse")
    assert judged(drive, replace(forward, does="run_reverse"), replace(reverse, does="run_forward"))
    own = {key: getattr(reverse, key) for key in ("register", "value", "set", "clear")}
    wrong = judged(drive, replace(forward, first=(*forward.first, *reverse.first, Step(**own))))
    assert [each for each in wrong if each.endswith(("before its last write", "turns the motor in reverse"))]


def test_the_run_register_may_not_be_written_before_the_direction() -> None:
    drive = shapes()["two_registers"]
    swapped = [
        replace(one, register=0x1000, value=one.first[0].value, first=(Step(register=0x1002, value=1),))
        for one in (command(drive, "run_forward"), command(drive, "run_reverse"))
    ]
    assert judged(drive, *swapped) == [
        "`run_forward` does not write 1000H, where value 1 `Reverse` turns the motor in reverse",
        "`run_reverse` does not write 1000H, where value 0 `Forward` turns the motor forward",
    ]


@pytest.mark.parametrize(
    ("name", "value"), [("cia402", 0x000F), ("profidrive", 0x047F), ("profidrive", 0x0C7F), ("two_registers", 1)]
)
def test_no_reset_passes_through_a_run(name: str, value: int) -> None:
    drive = shapes()[name]
    reset = command(drive, "fault_reset")
    wrong = judged(drive, replace(reset, first=(Step(register=reset.register, value=value),)))
    assert [each for each in wrong if each.startswith("`fault_reset` writes") and each.endswith("starts the motor")]


def test_a_stop_that_forgets_an_active_low_bit_is_refused() -> None:
    drive = shapes()["active_low"]
    wrong = judged(drive, replace(command(drive, "stop"), set=()))
    assert "`stop` writes 0000H to 1000H, where bit 0 `Run, active low` at 0 starts the motor" in wrong


def test_a_step_may_wait_for_a_state_and_a_time_and_states_may_wait_for_nobody() -> None:
    drive = shapes()["profidrive"]
    forward, (state,) = command(drive, "run_forward"), drive.operation.states
    step = replace(forward.first[0], for_ms=100)
    whole = (
        state,
        *(replace(state, name=f"other_{at}", equals=at) for at in (0x00, 0x04, 0x05, 0x40, 0x41, 0x44, 0x45)),
    )
    commands = (replace(forward, first=(step,)), *drive.operation.commands[1:])
    made = replace(drive, operation=replace(drive.operation, commands=commands, states=whole))
    assert judged(made) == []
    first, _ = drive_block(made).ordering.orders[5]
    assert (first.hold, first.wait and first.wait.name) == (100, "ready_to_switch_on")


def test_a_fault_is_shown_by_any_code_but_0(tmp_path: Path) -> None:
    said = drive_block(shapes()["packed"]).showing.says["fault"]
    assert said == ["((Reads.PresentFaultWord AND WORD#16#FF00) <> WORD#16#0000)"]
    assert "fault 2002H bits 8-F <> 0 (table 2)" in " ".join(run("packed", tmp_path, "show", "MAP").split())
    plain = replace(shapes()["packed"].operation, status=(replace(FAULT, any=(replace(FAULT.any[0], bit=None),)),))
    said = drive_block(replace(shapes()["packed"], operation=plain)).showing.says["fault"]
    assert said == ["(Reads.PresentFaultWord <> WORD#16#0000)"]


def test_the_code_of_a_fault_may_be_some_bits_of_its_word(tmp_path: Path) -> None:
    """The low byte is a warning, as in Delta's 2100H the high one is."""
    block = next(each.text for each in units()["packed"].blocks if each.path.endswith("PCK_Drive.st"))
    assert "Code := WORD_TO_UINT(Reads.PresentFaultWord AND WORD#16#FF00) / 256;" in block
    assert "fault code 2002H bits 8-F (table 3)" in " ".join(run("packed", tmp_path, "show", "MAP").split())
    asked = ("--request", "01 03 20 02 00 01 2E 0A", "--drive", "MAP")
    assert "Overcurrent" in run("packed", tmp_path, "explain", "01 03 02 01 03 F9 D5", *asked)
    assert "no fault" in run("packed", tmp_path, "explain", "01 03 02 00 03 F8 45", *asked)
    drive = SimulatedDrive(shapes()["packed"], 1)
    drive.trip(1)
    assert drive.reply(bytes.fromhex("01 03 20 02 00 01")) == bytes.fromhex("01 03 02 01 00")


def test_a_scale_may_rest_on_a_setting_of_the_keypad(tmp_path: Path) -> None:
    assert "one count is 0.01 Hz only while P2.02 = 0 (table 2)" in " ".join(
        run("packed", tmp_path, "show", "MAP", "2001H").split()
    )


def test_a_status_may_be_a_bit_that_is_0() -> None:
    assert drive_block(shapes()["packed"]).showing.says["warning"] == ["NOT DriveStatusBits.NoWarning"]


def test_what_must_never_be_sent_is_refused_in_a_command() -> None:
    drive = shapes()["packed"]
    wrong = judged(drive, replace(command(drive, "stop"), set=(Span(0, 0), Span(6, 6))))
    said = "`stop` writes 0041H to 1000H, whose bits 6 must never be 1: the drive no longer obeys the bus"
    assert said in wrong
    passing = replace(command(drive, "run_forward"), first=(Step(register=0x1000, value=0x0031),))
    assert any(
        "`run_forward` writes 0031H to 1000H, whose bits 4-5 must never be 3" in each for each in judged(drive, passing)
    )


def test_what_must_never_be_sent_is_not_reached_by_the_word_of_experts() -> None:
    """Local control, bit 6, has no command: without `never` it would pass with the relay, bit 7."""
    drive = shapes()["packed"]
    plain = tuple(
        replace(section, registers=tuple(replace(row, never=()) for row in section.registers))
        for section in drive.sections
    )
    assert kept(drive) == {0x1000: 0x0080}
    assert kept(replace(drive, sections=plain)) == {0x1000: 0x00C0}
    orders = next(each.text for each in units()["packed"].blocks if each.path.endswith("PCK_Orders.st"))
    assert "KeepWord AND WORD#16#0080" in orders


def test_what_must_never_be_sent_is_said_by_show_and_by_explain(tmp_path: Path) -> None:
    said = "bits 4-5 = 3: it changes the direction"
    for topic in ((), ("1000H",)):
        assert said in " ".join(run("packed", tmp_path, "show", "MAP", *topic).split())
    frame = "01 06 10 00 00 32 0C DF"
    assert "must never be sent: it changes the direction" in " ".join(
        run("packed", tmp_path, "explain", "--drive", "MAP", frame).split()
    )


def test_show_prints_the_way_the_states_and_what_the_pins_show(tmp_path: Path) -> None:
    page = run("cia402", tmp_path, "show", "MAP")
    lines = [" ".join(line.split()) for line in page.splitlines()]
    assert "run forward, 1 1000H 0006H until ready_to_switch_on" in lines
    assert "fault reset, 1 1000H 0000H then" in lines
    assert "running 2000H AND 006FH = 0027H (table 2)" in lines
    assert "output frequency 2001H (table 2)" in lines
    assert "fault code 2002H (table 3)" in lines
    assert "state switched_on 2000H AND 006FH = 0023H (table 2)" in lines
    assert "run forward, 1 1000H 0 1-2 for 100 ms" in " ".join(run("pulse", tmp_path, "show", "MAP").split())
    registers = (run("cia402", tmp_path, "show", "MAP", address) for address in ("1000H", "2000H"))
    assert [word in page for page in registers for word in ("run forward, write 2: write 0007H", "running: 2000H")] == [
        True, False, False, True
    ]  # fmt: skip


def test_show_says_what_the_keypad_needs(tmp_path: Path) -> None:
    page = " ".join(run("two_registers", tmp_path, "show", "MAP", "serial").split())
    assert "1 to 247 by P3.00; factory setting 0; at 0 it answers nobody" in page
    assert "needed 1: run commands come from the bus" in page


def test_no_request_crosses_a_group(tmp_path: Path) -> None:
    """The pins of this drive want 2000H to 2002H; its manual keeps each two addresses apart."""
    drive = shapes()["pulse"]
    whole = replace(drive, limits=replace(drive.limits, group=None))
    assert [(each.address, each.words) for each in polls(whole)] == [(0x2000, 3)]
    assert [(each.address, each.words) for each in polls(drive)] == [(0x2000, 2), (0x2002, 1)]
    assert [(each.first, each.last) for each in plan(drive).readable if each.first >= 0x2000] == [
        (0x2000, 0x2001), (0x2002, 0x2002),
    ]  # fmt: skip
    assert spans(drive, [0x2000, 0x2001, 0x2002], 16) == [Span(0x2000, 0x2001), Span(0x2002, 0x2002)]
    for one, asked, said in (
        (drive, "01 03 20 00 00 02", "01 03 04"), (drive, "01 03 20 01 00 02", "01 83"),
        (whole, "01 03 20 01 00 02", "01 03 04"),
    ):  # fmt: skip
        reply = SimulatedDrive(one, 1).reply(bytes.fromhex(asked))
        assert reply is not None
        assert reply.hex(" ").startswith(said)
    page = " ".join(run("pulse", tmp_path, "show", "MAP", "serial").split())
    assert "2 addresses of a group, which no request may cross (section 2)" in page


def test_a_setting_lets_the_drive_answer_later(tmp_path: Path) -> None:
    delay = serial(shapes()["pulse"]).delay
    assert delay
    assert (delay.factory_ms, delay.most_ms) == (30, 500)
    assert serial(shapes()["packed"]).delay is None
    assert "by P3.06, 30 ms as delivered, 500 ms at most" in run("pulse", tmp_path, "show", "MAP", "serial")
    assert "begin after 30 ms" in run("pulse", tmp_path, "line", "MAP")
    assert "begin after 7 ms" in run("pulse", tmp_path, "line", "MAP", "--reply", "7ms")
    drive = shapes()["pulse"]
    files = [*generic(languages(["en"], "utf-8")), *library_of("one", drive, languages(["en"], "utf-8"))]
    page = documents(files, [drive])["docs/PUL_Drive.md"]
    assert "a turn-round of 30 ms, which is the factory setting of P3.06." in page
    assert "| the drive answers later by P3.06, 30 ms as delivered, 500 ms at most |" in page


def test_a_write_is_stored_as_the_map_says(tmp_path: Path) -> None:
    """Each write in its turn, with the stores of the drive after it."""
    for name, writes in {
        "cia402": [("3000 00 07", 0), ("3001 00 01", 0), ("3001 00 02", 1)],
        "profidrive": [("3000 00 07", 0)],
        "pulse": [("1001 13 88", 0)],
        "active_low": [("1001 13 88", 0), ("1002 13 88", 1)],
    }.items():
        drive = SimulatedDrive(shapes()[name], 1)
        for written, stores in writes:
            assert drive.reply(bytes.fromhex(f"01 06 {written}")) == bytes.fromhex(f"01 06 {written}")
            assert drive.memory.stores == stores, (name, written)
    assert "write 2 to 3001H" in run("cia402", tmp_path, "show", "MAP")
    assert "1001H is 1002H in RAM" in run("active_low", tmp_path, "show", "MAP")
    told = " ".join(run("active_low", tmp_path, "explain", "01 06 10 02 13 88 21 9C", "--drive", "MAP").split())
    assert "stored in EEPROM, which frequent writes wear out; 1001H is the same in RAM" in told


def test_a_drive_that_stores_nothing_refuses_a_store_and_the_stored_twin_of_the_reference_is_its_own() -> None:
    for name in ("profidrive", "pulse", "active_low"):
        gate = next(each.text for each in units()[name].blocks if each.path.endswith("_ParameterGate.st"))
        assert "Why := ERROR_NOT_ABLE;" in gate, name
    gate = next(each.text for each in units()["cia402"].blocks if each.path.endswith("CIA_ParameterGate.st"))
    assert "Ask.Address := WORD#16#3001;" in gate
    assert "Ask.Words[0] := WORD#16#0002;" in gate
    judge = Judge(shapes()["active_low"])
    assert [judge.result(Write(each)) for each in (0x1001, 0x1002, 0x1003)] == ["OWNED", "OWNED", "OK"]


def test_show_lists_what_the_drive_does_by_itself_and_says_of_itself(tmp_path: Path) -> None:
    page = " ".join(run("cia402", tmp_path, "show", "MAP").split())
    assert (
        "cable cut by P3.02: 0 ignore: the motor runs on, 1 coast stop (factory): the motor coasts, 2 fallback speed: "
        "the motor changes to another speed; P3.01 = 0: the motor runs on, whatever else is set; "
        "after P3.01, 0.0 to 60.0 s; fed by any good frame; it does not start again by itself (section 1)"
    ) in page
    assert "trip the output is switched off and the motor coasts (table 3)" in page
    assert "bus commands while 2000H bit 9 = 1 (table 2)" in page
    assert "own maximum 2004H (P1.08) x 0.1 Hz (table 2)" in page
    assert "identity 2003H = 786 (table 2)" in page
    for shape, says in (
        ("profidrive", "after 2003H x 1 ms; fed by any good write; it counts at standstill, too (section 1)"),
        ("pulse", "the motor stops quickly; fed by any good read; the manual does not say after how long (section 1)"),
        ("two_registers", "the motor ramps down; fed by writes to 1002H alone; the manual does not say after how long"),
        ("active_low", "cable cut the manual does not say: count on a motor that runs on"),
        ("active_low", "trip the manual does not say whether the motor coasts or is ramped down"),
        ("active_low", "identity the manual does not say how to see it"),
    ):
        assert says in " ".join(run(shape, tmp_path, "show", "MAP").split()), shape
    for address, says in (("2000H", "bus in command: 2000H bit 9 = 1"), ("2003H", "identity: 2003H = 786")):
        assert says in run("cia402", tmp_path, "show", "MAP", address)
    assert "own maximum frequency" in run("cia402", tmp_path, "show", "MAP", "P1.08")


def test_the_templates_get_what_the_drive_says_of_itself_or_nothing() -> None:
    block = drive_block(shapes()["cia402"])
    identity, bus, maximum = block.reading.identity, block.showing.commanded_by, block.showing.own_maximum
    assert identity
    assert bus
    assert maximum
    assert maximum.scale
    (plate,) = identity.reads
    assert (plate.function, plate.address, plate.words) == (3, 0x2003, 1)
    assert plate.tests == (Pattern(0x2003, 0xFFFF, 0x0312),)
    assert identity.plate
    assert (bus, block.reading.roles.by_bus) == (["DriveStatusBits.Remote"], (1,))
    assert (maximum.word.address, maximum.scale) == (0x2004, Decimal("0.1"))
    assert block.reading.roles.verify == (1,)
    assert {name: drive_block(drive).own["feeds"] for name, drive in shapes().items()} == {
        "cia402": "polls", "profidrive": "reference", "pulse": "polls", "two_registers": "run", "active_low": None,
        "packed": None,
    }  # fmt: skip
    assert drive_block(shapes()["two_registers"]).reading.identity is None
    bare = drive_block(shapes()["active_low"])
    assert (bare.showing.commanded_by, bare.showing.own_maximum) == ([], None)
    apart = bare.reading.identity  # from CHF, whose jog stop is its run, from JSCC, and from the MD type
    assert apart
    assert not apart.plate
    assert [(read.address, read.shows) for read in apart.reads] == [
        (0x2000, "any"), (0x2001, "any"), (0x3000, "refusal"),
    ]  # fmt: skip


def test_an_identity_of_several_bits_is_one_read() -> None:
    drive = shapes()["cia402"]
    asked = (
        Condition(register=0x2004, bit=Span(4, 7), equals=9),
        Condition(register=0x2003, mask=0xFF00, equals=0x0300),
    )
    assert drive.identity is not None
    identity = drive_block(replace(drive, identity=replace(drive.identity, all=asked))).reading.identity
    assert identity
    (plate,) = identity.reads
    assert (plate.address, plate.words) == (0x2003, 2)
    assert plate.tests == (Pattern(0x2004, 0x00F0, 0x0090), Pattern(0x2003, 0xFF00, 0x0300))


def test_explain_knows_a_write_on_the_way_and_a_mask(tmp_path: Path) -> None:
    written = run("cia402", tmp_path, "explain", "01 06 10 00 00 06 0D 08", "--drive", "MAP")
    assert "run forward, write 1 of 3" in written
    assert "stop" in written
    asked = ("--request", "01 03 20 00 00 01 8F CA")
    for reply, said in (("01 03 02 00 02 39 85", "as at standstill"), ("01 03 02 00 07 F9 86", "no standstill")):
        assert said in run("profidrive", tmp_path, "explain", reply, "--drive", "MAP", *asked)
