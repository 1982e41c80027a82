"""What differs between two versions: pins, facts, words; and that no fact of a map can change unseen."""

import copy
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from driveblocks.diff import facts, interface
from driveblocks.diff.change import Kind
from driveblocks.maps import catalog, view
from driveblocks.maps.load import load

OLD = """FUNCTION_BLOCK Pump
VAR_INPUT
  Go : BOOL; (* starts it *)
  Hz : REAL := 50.0;
END_VAR
VAR_OUTPUT
  Amps : REAL;
END_VAR
VAR_IN_OUT
  Slot : INT;
END_VAR
VAR
  Inside : INT;
END_VAR
  Inside := 1;
END_FUNCTION_BLOCK
FUNCTION Half : INT
VAR_INPUT
  N : INT;
END_VAR
  Half := N / 2;
END_FUNCTION
TYPE
  Row : ARRAY[0..7] OF INT;
  Two : STRUCT
    A : INT;
    B : INT;
  END_STRUCT;
END_TYPE
"""
EDITS = {
    "nothing": ("", "", []),
    "a comment": ("(* starts it *)", "(* runs it *)", []),
    "a private variable": ("  Inside : INT;", "  Inside : INT;\n  More : INT;", []),
    "a name in capitals": ("  Go : BOOL;", "  GO : BOOL;", []),
    "a pin gone": ("  Amps : REAL;", "  Volts : REAL;", [
        "BREAKS block Pump, output Amps: is gone", "NEW block Pump, output Volts: REAL"]),
    "another type": ("  Go : BOOL;", "  Go : INT;", ["BREAKS block Pump, input Go: BOOL, now input INT"]),
    "another default": ("50.0", "60.0", ["ACTS block Pump, input Hz: default 50.0, now 60.0"]),
    "a new input": ("  Go : BOOL;", "  Go : BOOL;\n  Slow : BOOL;", ["NEW block Pump, input Slow: BOOL"]),
    "a new in-out": ("  Slot : INT;", "  Slot : INT;\n  Port : INT;", ["BREAKS block Pump, in-out Port: INT"]),
    "another result": ("FUNCTION Half : INT", "FUNCTION Half : DINT", [
        "BREAKS function Half: a function of INT, now a function of DINT"]),
    "a longer array": ("[0..7]", "[0..9]", [
        "BREAKS type Row: a type of ARRAY[0..7] OF INT, now a type of ARRAY[0..9] OF INT"]),
    "a field gone": ("    B : INT;\n", "", ["BREAKS type Two, field B: is gone"]),
    "a block gone": ("FUNCTION_BLOCK Pump", "FUNCTION_BLOCK Fan", [
        "BREAKS block Pump: is gone", "NEW block Fan: a block with 4 pins"]),
}  # fmt: skip


@pytest.mark.parametrize("edit", EDITS)
def test_pins(edit: str) -> None:
    before, after, said = EDITS[edit]
    assert before in OLD
    old, new = (interface.faces([("x.st", text)]) for text in (OLD, OLD.replace(before, after, 1)))
    assert [f"{each.kind.name} {each}" for each in interface.compared(old, new)] == said


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The places of all numbers, words and truths."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inside:
        yield from leaves(one, (*path, key))
    if not isinstance(value, (dict, list)):
        yield path


def edited(value: Any, path: tuple[Any, ...]) -> Any:
    """A copy in which one of them is another."""
    made = copy.deepcopy(value)
    inside = made
    for key in path[:-1]:
        inside = inside[key]
    inside[path[-1]] = f"{inside[path[-1]]} edited"
    return made


@pytest.mark.parametrize("path", catalog.shipped(), ids=lambda path: path.stem)
def test_no_fact_changes_unseen(path: Path) -> None:
    whole = view.of_drive(load(path), path.stem)
    for key, part in whole.items():
        if key in facts.OWN or not isinstance(part, (dict, list)):
            continue
        small = {key: part[:12] if isinstance(part, list) else part}
        unseen = [place for place in leaves(small) if not [*facts.compared(small, edited(small, place))]]
        assert not unseen


def test_what_only_a_person_reads_is_no_change_of_what_a_drive_does() -> None:
    drive = view.of_drive(load(catalog.resolve("chf")), "invt_chf")
    command = drive["operation"]["commands"][4]
    for key, kind in (("value", Kind.ACTS), ("register", Kind.ACTS), ("source", Kind.WORDS)):
        other = copy.deepcopy(drive)
        other["operation"]["commands"][4][key] = 9
        (change,) = facts.compared(drive, other)
        assert (change.kind, change.where) == (kind, f"operation, command {command['does']}")


def test_an_address_has_its_table_and_a_span_its_form() -> None:
    drive = view.of_drive(load(catalog.resolve("mx2")), "omron_mx2")
    other = copy.deepcopy(drive)
    other["operation"]["commands"][2]["register"] = 2
    del other["operation"]["status"][0]["any"][0]["space"]
    other["fault_report"]["registers"][0]["last"] = 0x0013
    reserved = next(each for each in other["registers"] if each["address"] == 0x0011)
    reserved["access"] = "rw"
    drive["registers"][0]["name"] = other["registers"][0]["name"] = ""
    other["registers"][0]["access"] = "r"
    assert [str(each) for each in facts.compared(drive, other)] == [
        "coil 0001H (wire 0000H): access rw, now r",
        "coil Reserved coil: access r, now rw",
        "fault_report: registers 0012H (wire 0011H), now 0012H-0014H (wire 0011H-0013H)",
        "operation, command stop: register coil 0001H (wire 0000H), now coil 0003H (wire 0002H)",
        "operation, status running, any coil 000FH (wire 000EH): is gone",
        "operation, status running, any 000FH (wire 000EH): is new",
    ]


def diff(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["diff", *arguments])


@pytest.fixture
def changed(tmp_path: Path) -> Callable[[str, str], str]:
    def make(old: str, new: str) -> str:
        text = catalog.resolve("chf").read_text("utf-8")
        assert old in text
        (tmp_path / "invt_chf.yaml").write_text(text.replace(old, new), "utf-8")
        return str(tmp_path / "invt_chf.yaml")

    return make


def test_a_map_and_itself() -> None:
    found = diff("chf", "invt_chf")
    assert found.exit_code == 0
    assert found.stdout.endswith("\nnothing differs\n")


def test_a_moved_register_acts_differently(changed: Callable[[str, str], str]) -> None:
    found = diff("chf", changed("3009H", "3019H"))
    assert found.exit_code == 0, found.stderr
    assert "  register PID feedback: address 3009H, now 3019H\n" in found.stdout.partition("acts differently")[2]


def test_another_limit_acts_differently(changed: Callable[[str, str], str]) -> None:
    limit = diff("chf", changed("read_words: {value: 16", "read_words: {value: 8"))
    assert limit.exit_code == 0, limit.stderr
    assert "limits: read words 16, now 8" in limit.stdout.partition("acts differently")[2]


def test_a_renamed_register_breaks_what_uses_its_decoder(changed: Callable[[str, str], str]) -> None:
    found = diff("chf", changed("name: Drive status", "name: Drive state"), "--changelog")
    assert found.exit_code == 1, found.stderr
    broken = found.stdout.partition("No longer compiles where it is used:\n\n")[2].partition("\n\n")[0]
    assert "- block CHF_DriveStatus: is gone" in broken.splitlines()
    assert found.stdout.endswith("\n1 change of texts and sources.\n")
    assert found.stdout.startswith("### INVT CHF series inverters, map revision ")


def test_another_prefix_is_another_family(changed: Callable[[str, str], str]) -> None:
    found = diff("chf", changed("prefix: CHF", "prefix: CHG"), "--json")
    assert found.exit_code == 0, found.stderr
    assert {"section": "Pins of the block", "what": "type of the instance", "old": "CHF_Drive", "new": "CHG_Drive"} in (
        json.loads(found.stdout)
    )


def test_the_swap_of_a_drive_is_told_by_name_or_nameplate_as_text_and_as_a_page() -> None:
    text, page = diff("acs355", "6SL3210-5BE17-5UV0"), diff("acs355", "v20", "--changelog")
    assert text.exit_code == page.exit_code == 0
    assert text.stdout.startswith("ABB ACS355 is replaced by Siemens SINAMICS V20\n")
    assert text.stdout.endswith("blocks/docs/Swapping.md\n")
    assert "| unit address | 5302, Station ID: 0 to 247 | P2021, Modbus address: 1 to 247 |" in page.stdout.splitlines()
    assert "<br>P0700, Selection of command source: 5 = " in page.stdout
    heads = [line[3:] for line in page.stdout.splitlines() if line.startswith("## ")]
    assert all(f"\n{head}\n" in text.stdout for head in heads)


def test_folders_of_blocks(tmp_path: Path) -> None:
    for name, text in (("old", OLD), ("new", OLD.replace("Go : BOOL", "Go : INT"))):
        (tmp_path / name).mkdir()
        (tmp_path / name / "pump.st").write_text(text, "utf-8")
    found = diff(str(tmp_path / "old"), str(tmp_path / "new"))
    assert found.exit_code == 1
    assert "block Pump, input Go: BOOL, now input INT" in found.stdout
    assert (
        diff("chf", str(tmp_path / "new")).stderr
        == "one is a map and the other a folder of blocks; name two of a kind\n"
    )


def test_bad_input_is_reported_for_both(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    found = diff("missing.yaml", str(tmp_path / "empty"))
    assert found.exit_code == 2
    assert "missing.yaml:1:1: " in found.stderr
    assert "empty:1:1: expected .st files in this folder, found none" in found.stderr
