"""Rules of the house: every declaration commented, every file lint-clean and compiled."""

import re
from pathlib import Path

import pytest

from driveblocks.maps import catalog, collection
from driveblocks.maps.load import load, loads
from driveblocks.output import build
from driveblocks.platforms import PLATFORMS, port
from driveblocks.render import library as library_of
from driveblocks.render import text
from structured_text.language.checker import check
from structured_text.language.lint import Selection, lint, lint_sources
from structured_text.language.parser import parse
from structured_text.language.reserved import TARGET_WORDS
from structured_text.language.tree import Pou, TypeDecl, Unit

ROOT = Path(__file__).parents[2]
MAPS = [*catalog.shipped(), ROOT / "tests/maps/example.yaml"]


@pytest.fixture(scope="module")
def library() -> dict[str, str]:
    files = build.files(collection.read(MAPS), text.languages(["en", "zh"], "utf-8"))
    return {name: content for name, content in files.items() if name.startswith("iec61131/") and name.endswith(".st")}


@pytest.fixture(scope="module")
def units(library: dict[str, str]) -> list[Unit]:
    return [parse(content, name) for name, content in library.items()]


def test_every_declaration_has_a_comment(units: list[Unit]) -> None:
    bare: list[str] = []
    for unit in units:
        pous = [element for element in unit.elements if isinstance(element, Pou)]
        variables = [each for pou in pous for group in pou.blocks for each in group.variables]
        bare.extend(f"{unit.path}: {each.name}" for each in variables if not each.trailing and not each.leading)
    assert bare == []


def test_every_file_is_clean_by_the_linter_for_every_target(units: list[Unit]) -> None:
    assert check(units).blocks
    told = [str(problem) for problem in lint(units, None, TARGET_WORDS)]
    assert told == []


DECIDES = re.compile(r"/(VFD_\w+|\w+_(Drive|Orders|Reads|ParameterGate))\.st$")
"""Files of blocks that run a motor."""


def test_a_block_that_runs_a_motor_takes_a_decision_once(units: list[Unit]) -> None:
    told = [each for each in lint(units, Selection.of(["taken-back"], []), TARGET_WORDS) if DECIDES.search(each.path)]
    assert [str(each) for each in told] == []


@pytest.mark.parametrize("platform", PLATFORMS)
def test_adapters_and_first_motors_have_names_for_every_target(platform: str) -> None:
    drives = [load(path) for path in MAPS]
    made = [*port.adapter(platform, []), *(port.first_motor(platform, drive) for drive in drives)]
    readable = [
        (file.path, file.text) for file in made if "#include" not in file.text and "extern int" not in file.text
    ]
    names = Selection.of(["target-name", "long-name", "reserved-name", "underscore-name", "hidden-value"], [])
    assert [str(each) for each in lint_sources(readable, names, TARGET_WORDS)] == []


def test_every_file_holds_one_thing_named_like_it(units: list[Unit]) -> None:
    for unit in units:
        declared = [element.name for element in unit.elements if isinstance(element, (Pou, TypeDecl))]
        assert declared == [Path(unit.path).stem]
        assert len(declared[0]) <= 31


def test_no_block_is_longer_than_300_lines(library: dict[str, str]) -> None:
    lines = {name: content.count("\n") for name, content in library.items()}
    longer = {name: count for name, count in lines.items() if count > 300}
    assert {name for name in longer if not re.search(r"/MB_Line\d+\.st$", name)} == set()
    assert max(longer.values()) <= 429  # the line itself, which hands slots and tables on


def test_a_compartment_an_error_and_a_reason_have_names_in_the_blocks_of_drives(library: dict[str, str]) -> None:
    code = {
        name: re.sub(r"\(\*.*?\*\)", "", content, flags=re.DOTALL)
        for name, content in library.items()
        if not re.search(r"/(line|modbus|types)/|Text(En|Zh)\.st$", name)
    }
    literal = re.compile(
        r"(Ask|Answer)\[\d|\b(?!BusyReason)\w*(ErrorID|Error|Reason|Why\d?|Bar|Ends|Lost|_MayWrite) (:=|=|<>) [1-9]"
    )
    found = {name: [one[0] for one in literal.finditer(content)] for name, content in code.items()}
    assert {name: some for name, some in found.items() if some} == {}


def test_lines_fit_a_screen(library: dict[str, str]) -> None:
    lines = [(name, line) for name, content in library.items() for line in content.splitlines()]
    string = re.compile(r" *\w+ := '[^']*';")  # which cannot be broken, and stands alone
    assert [each for each in lines if len(each[1]) > 120 and not string.fullmatch(each[1])] == []


def test_comments_do_not_trip_their_reader(library: dict[str, str]) -> None:
    """No block that does not exist, no key of the map by itself, no sentence with two ends, no test of nothing."""
    for name, content in library.items():
        pointed = re.findall(r"see (MB_\w+|EX100_\w+)", content)
        assert [each for each in pointed if not any(path.endswith(f"/{each}.st") for path in library)] == [], name
        assert re.findall(r"see `absent`(?! in)|[^.]\.\.(?!\.)[\s)]|WordWord|AND WORD#16#FFFF", content) == [], name
        if not name.endswith(("Crc16.st", "Crc16Compact.st", "Lrc.st")):  # which sum up a frame of either way
            assert re.findall(r"\bAdu := Adu\b", content.partition("*)")[0]) == [], name


def test_a_word_called_so_and_an_edition_with_a_full_stop_are_not_said_twice() -> None:
    edited = MAPS[-1].read_text("utf-8").replace("name: Status\n", "name: Status word\n")
    edited = edited.replace("edition: V1.0\n", "edition: V1.0 corr.\n", 1)
    drive = loads(edited, "edited.yaml")
    made = {file.name: file.text for file in library_of.drive("edited", drive, [])}
    assert re.search(r"V1\.0\s+corr\.\n", made["EX100_Request"])
    assert re.findall(r"^  (\w+) : WORD;", made["EX100_Standstill"], re.MULTILINE)[0] == "StatusWord"


@pytest.mark.parametrize("codes", [["en"], ["zh"], ["zh", "en"]])
def test_texts_are_those_of_a_language_that_is_built(codes: list[str]) -> None:
    files = build.files(collection.read([MAPS[-1]]), text.languages(codes, "utf-8"))
    wanted = codes[0].capitalize()
    for content in (content for name, content in files.items() if name.startswith(("iec61131/modbus", "iec61131/ex"))):
        assert set(re.findall(r"(?:see|is) \w+Text(\w\w)\b", content)) <= {wanted}


def test_a_request_tests_only_what_can_be(library: dict[str, str]) -> None:
    """The unit address against limits that it can break, functions that the drive has."""
    for name, content in library.items():
        if name.endswith("_Request.st") and "types" not in name:
            known = set(re.search(r"FunctionCode : UINT; \(\* ([\d, ]+) \*\)", content)[1].split(", "))  # type: ignore[index]
            body = content.rpartition("END_VAR")[2]
            assert set(re.findall(r"FunctionCode = (\d+)", body)) <= known
            assert set(re.findall(r"functions? (\d+)(?: and (\d+))?", content)[0]) - {""} <= known
            assert not re.search(r"UnitAddress <> 0|UnitAddress < 1\b", body)
