"""Both dialects of TC6: what is written reads back as the canonical text, and what cannot be said is refused."""

import re
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import pytest
from tests.platforms.tc6_checks import (
    CHECKS,
    Made,
    assert_declarations,
    assert_ladders,
    assert_names,
    assert_room,
    made,
)
from tests.shapes import shapes
from tests.shipped import BOTH, sources

from driveblocks.maps.revision import checked
from driveblocks.platforms.part import Part, Shelf, shelf
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.writers import writer
from driveblocks.render import library
from driveblocks.render.library import File
from driveblocks.render.results import code
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, Source
from structured_text.language.lint import lint_sources
from structured_text.language.parser import parse

HEAD = "(* X: a sample\n   Purpose  none: & < > \" ' Ü 变频 ]] > *)\n"
SAMPLE = (
    HEAD + "TYPE\n  X_Mix : STRUCT\n    One : INT := -5; (* a < b && c *)\n"
    "    (* stands above *)\n    Two : REAL := 1.0E-3;\n    Three : STRING := 'a&b<\"$''; (* 变频器 *)\n"
    "  END_STRUCT;\nEND_TYPE\n",
    HEAD + "TYPE\n  X_Grid : ARRAY[0..1, -1..1] OF X_Mix; (* two by three *)\nEND_TYPE\n",
    HEAD + "FUNCTION X_Sum : REAL\nVAR_INPUT\n  A : REAL := 1.5; (* first *)\n  B : REAL; (* second,\n   at length *)\n"
    "END_VAR\n\n  X_Sum := A + B; (* < & *)\nEND_FUNCTION\n",
    HEAD + "FUNCTION_BLOCK X_Block\nVAR_INPUT\n  In : X_Mix := (One := 7, Two := 2.0); (* given *)\nEND_VAR\n"
    "VAR_OUTPUT\n  Out : BOOL := TRUE; (* taken *)\nEND_VAR\nVAR_IN_OUT\n  Both : X_Grid; (* both ways *)\nEND_VAR\n"
    "VAR RETAIN\n  Kept : UDINT; (* kept *)\nEND_VAR\nVAR_TEMP\n  Brief : INT; (* not kept *)\nEND_VAR\n"
    "VAR CONSTANT\n  MOST : ARRAY[0..9] OF WORD := [WORD#16#00FF, 8(WORD#16#0000), WORD#16#0001]; (* table *)\n"
    'END_VAR\n\n  (* first line is indented, "quoted" & <marked> *)\n  IF (Kept < 5) AND (In.One > 3) THEN\n'
    "    Out := FALSE;\n  END_IF;\nEND_FUNCTION_BLOCK\n",
)


@cache
def stock() -> Shelf:
    """The shipped library and a few samples with everything that a declaration can hold."""
    files = [*library.generic(BOTH)]
    files += [file for source in sources() for file in library.drive(source.path.stem, source.drive, BOTH)]
    files += [File("types", f"X{number}", one) for number, one in enumerate(SAMPLE)]
    return shelf(files, {source.path.stem: source.drive for source in sources()}, BOTH)


@cache
def written(target: str) -> list[Made]:
    return list(made(stock(), target))


@pytest.mark.parametrize("check", CHECKS, ids=lambda each: each.__name__)
@pytest.mark.parametrize("target", ["beremiz", "codesys"])
def test_what_is_written_reads_back(target: str, check: Callable[[Made], None]) -> None:
    for one in written(target):
        check(one)


def test_the_page_counts_what_is_shared() -> None:
    page = writer("codesys")(stock())["README.md"]
    for one in written("codesys"):
        if one.library.startswith("shared/"):
            kinds = Counter(unit.kind for unit in one.file.units)
            cells = [kinds[kind] for kind in ("TYPE", "FUNCTION", "FUNCTION_BLOCK")]
            name = one.library.removeprefix("shared/")
            assert re.search(rf"\| `{name}` \|.*\| {cells[0]} \| {cells[1]} \| {cells[2]} \|", page), name


def test_a_ladder_keeps_the_comment_of_a_pin() -> None:
    drive = stock().drives["jscc"]
    unproved = replace(drive, manual=replace(drive.manual, second_hand=True))
    for one in made(replace(_few(), drives={"jscc": unproved}), "beremiz"):
        assert_ladders(one)
        assert_room(one)
        assert one.file.text.count(f"ManualChecked := 0, (* {checked(drive)} once") == len(one.prefixes)
        assert one.file.text.count(f"<![CDATA[{checked(drive)} once") == len(one.prefixes)


def test_a_drive_whose_commands_are_a_way_of_states_has_no_program_for_another_master() -> None:
    drive = shapes()["cia402"]
    files = [*library.generic(BOTH), *library.drive("cia402", drive, BOTH)]
    for target in ("beremiz", "codesys"):
        for one in made(shelf(files, {"cia402": drive}, BOTH), target):
            assert_names(one)
            assert_declarations(one)
            assert not any(name.endswith("_Master") for name in one.file.named())


BLOCK = """(* X: a sample *)
FUNCTION_BLOCK X
VAR
  A : INT; (* a number *)
  B : X_Table; (* numbers *)
END_VAR

  A := 1;
END_FUNCTION_BLOCK
"""
NO_OWNER = "a comment that belongs to no declaration would be lost; put it after one"
MARK = "has no form in this XML; write it with a blank in it"


@cache
def _motors() -> Library:
    """The first motors for any port, with the library."""
    parts = [*stock().parts, *(stock().motor("iec61131", drive) for drive in stock().drives.values())]
    return EmbeddedEngine().build([Source(part.unit.path, part.text) for part in parts])


@pytest.mark.parametrize("prefix", ["CHF", "JSCC", "SN300G5"])
def test_a_first_motor_for_any_port_lints_clean_and_asks_its_drive(prefix: str) -> None:
    (drive,) = (one for one in stock().drives.values() if one.prefix == prefix)
    motor = stock().motor("iec61131", drive)
    problems = lint_sources((part.unit.path, part.text) for part in (*stock().parts, motor))
    assert [each for each in problems if each.path == motor.unit.path] == []
    program = _motors().instance(motor.name)
    program["ElapsedMs"] = 10
    frames = []
    for _ in range(100):
        program.scan()
        frames += [program["Tx[0]"]] if program["TxCount"] else []
    assert frames
    assert set(frames) == {drive.serial.unit.min}
    program["ElapsedMs"] = 0
    for _ in range(200):
        program.scan()
    assert program["Bus.ErrorID"] == code("TIME_STANDS")


@cache
def _few() -> Shelf:
    """Enough to show every mistake: the samples, and what one ladder calls."""
    whole = stock()
    names = (
        "X_Mix",
        "X_Grid",
        "X_Sum",
        "X_Block",
        "MB_Adu",
        "JSCC_Reference",
        "JSCC_Drive",
        "MB_ByteLine8",
        "VFD_HardStop",
    )
    parts = tuple(part for part in whole.parts if part.name in names)
    return replace(whole, parts=parts, drives={"jscc": whole.drives["jscc"]})


def _parsed(text: str) -> Shelf:
    """A shelf of one part that nobody has checked: a writer must not count on that."""
    return Shelf((Part("sample", parse(text, "sample/X.st")),), {}, tuple(BOTH))


@pytest.mark.parametrize(
    ("old", "new", "neutral", "codesys"),
    [
        ("A := 1;", "A := SEL(B[B[0]]>2, 1, 2);", f"8:17: `]]>` {MARK}", ""),
        ("a number", "a ]]> b", f"4:17: `]]>` {MARK}", ""),
        ("A := 1;", "A := 1; (* <xhtml:p> *)", f"8:14: `<xhtml:p>` {MARK}", ""),
        ("a number", "a \x0c b", *2 * ("4:17: character 000CH has no form in XML; leave it out",)),
        ("INT;", "INT R_EDGE;", *2 * ("4:3: R_EDGE has no form in this XML; call R_TRIG in the body",)),
        ("INT;", "INT := -(2);", "", ""),
        (
            "INT;",
            "INT := 2 * 3;",
            *2 * ("4:14: an expression has no form as a value in this XML; write what it comes to",),
        ),
        (
            "INT;",
            "INT (0..9);",
            *2 * ("4:7: this type is not written as XML; a type is an array, a structure or a name",),
        ),
        ("END_VAR", "(* lost *)\nEND_VAR", *2 * (f"6:1: {NO_OWNER}",)),
        ("END_FUNCTION_BLOCK\n", "END_FUNCTION_BLOCK\n(* lost *)\n", *2 * (f"10:1: {NO_OWNER}",)),
        ("(* numbers *)", "// x", *2 * ("5:16: a comment by `//` would not come back as it is; write (* *)",)),
    ],
)
def test_what_cannot_be_said_is_refused(old: str, new: str, neutral: str, codesys: str) -> None:
    parts = _parsed(BLOCK.replace(old, new))
    for target, said in (("beremiz", neutral), ("codesys", codesys)):
        if said:
            with pytest.raises(ExportError) as caught:
                writer(target)(parts)
            assert str(caught.value) == f"sample/X.st:{said}"
        else:
            assert writer(target)(parts)


def test_all_that_cannot_be_expressed_is_reported_at_once() -> None:
    text = BLOCK.replace("INT;", "INT R_EDGE := 2 * 3;").replace("numbers", "<xhtml:p>")
    with pytest.raises(ExportError) as caught:
        writer("beremiz")(_parsed(text))
    assert [(each.line, each.column) for each in caught.value.problems] == [(4, 3), (4, 21), (5, 19)]
