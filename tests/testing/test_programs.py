"""The programs themselves: portable, short-named, bounded per scan, commented, the same in every run."""

import re
from pathlib import Path

import pytest
from tests import shipped
from tests.shipped import BOTH

from driveblocks.bench.harness import PER_SCAN
from driveblocks.bench.script import MOST_STAGES, Program
from driveblocks.bench.suite import programs
from driveblocks.bench.unit import Unit
from driveblocks.maps import collection
from driveblocks.render.text import languages
from structured_text.language.lint import lint_sources
from structured_text.language.names import reserved

from .conftest import EXAMPLE, ROOT


@pytest.fixture(scope="module")
def all_units(made: dict[str, Unit]) -> list[Unit]:
    """The units of every map there is."""
    return [*shipped.units(), made["example"]]


@pytest.fixture(scope="module")
def all_programs(all_units: list[Unit]) -> list[Program]:
    return [program for unit in all_units for program in unit.suite.programs]


@pytest.mark.parametrize("name", ["modbus", *(Path(each.path).stem for each in shipped.sources()), "example"])
def test_the_linter_finds_nothing(name: str, made: dict[str, Unit]) -> None:
    (unit,) = [each for each in (*shipped.units(), made["example"]) if each.suite.name == name]
    texts = {source.path: source.text for source in unit.sources}
    assert [str(problem) for problem in lint_sources(texts.items())] == []


def test_names_are_short_and_each_program_has_one(all_programs: list[Program]) -> None:
    names = [program.name for program in all_programs]
    assert len(set(names)) == len(names)
    assert [name for name in names if len(name) > 31 or reserved(name)] == []


def test_a_file_holds_the_program_that_it_is_named_for(all_programs: list[Program]) -> None:
    for program in all_programs:
        assert re.findall(r"^(?:PROGRAM|FUNCTION|TYPE)\w* *(\w*)", program.text, re.MULTILINE) == [program.name]
        assert program.path.endswith(f"/{program.name}.st")


def test_a_scan_has_a_bounded_number_of_checks(all_programs: list[Program]) -> None:
    for program in all_programs:
        per_stage = [0] * program.stages
        for check in program.checks:
            per_stage[check.stage] += 1
        least = 0 if "_TestPart" in program.name else 1  # a block may be given a few bytes, call by call
        assert all(least <= count <= PER_SCAN for count in per_stage), program.name
        assert program.stages <= MOST_STAGES


def test_a_check_of_a_text_has_a_scan_of_its_own(all_programs: list[Program]) -> None:
    for program in all_programs:
        stages = [check.stage for check in program.checks if check.probe.block == "Text"]
        assert len(set(stages)) == len(stages), program.name


def test_every_check_is_numbered_and_named_in_a_comment_at_its_place(all_programs: list[Program]) -> None:
    for program in all_programs:
        lines = program.text.split("\n")
        for number, check in enumerate(program.checks, 1):
            near = " ".join(lines[program.line(check) - 1 : program.line(check) + 3])
            ranges = re.findall(r"\(\* (\d+)(?: to (\d+))?:", near)
            assert any(int(first) <= number <= int(last or first) for first, last in ranges), (program.name, number)


def test_lines_are_no_longer_than_a_screen_but_for_texts(all_programs: list[Program]) -> None:
    lines = [line for program in all_programs for line in program.text.split("\n")]
    assert [line for line in lines if len(line) > 122 and "'" not in line] == []


def test_two_runs_give_the_same_files() -> None:
    sources = collection.read([EXAMPLE])
    assert programs(sources, BOTH) == programs(collection.read([EXAMPLE]), BOTH)


def test_the_order_names_every_file_and_the_page_every_program(example: Unit, shared: Unit) -> None:
    files = programs(collection.read([EXAMPLE]), BOTH)
    order = files["tests/iec61131/order.txt"].split()
    assert {f"tests/iec61131/{path}" for path in order} == {path for path in files if path.endswith(".st")}
    assert order[0] == "harness/VFD_Failure.st"
    page = files["tests/README.md"]
    for program in (*shared.suite.programs, *example.suite.programs):
        assert f"[`{program.name}`](iec61131/{program.path}) | {len(program.checks)} |" in page
        assert f"tests/iec61131/{program.path}" in files


def test_a_language_that_is_left_out_is_not_tested() -> None:
    files = programs(collection.read([EXAMPLE]), languages(["en"], "utf-8"))
    assert not [path for path, text in files.items() if "TextZh" in path or "TextZh" in text]


def test_chinese_is_expected_in_the_encoding_that_was_built() -> None:
    files = programs(collection.read([EXAMPLE]), languages(["zh"], "gb18030"))
    escaped = "".join(f"${octet:02X}" for octet in "OC 过流".encode("gb18030"))
    assert f"'{escaped}'" in files["tests/iec61131/example/EX100_TestFaultTextZh.st"]


def test_what_is_expected_does_not_come_from_what_renders() -> None:
    folder = ROOT / "generator/driveblocks/bench"
    users = {"unit.py", "code.py", "request.py"}  # the library beside what tests it, and the words of comments
    for path in sorted(folder.glob("*.py")):
        imports = re.findall(r"^\s*(?:from|import) (driveblocks\.\S+)", path.read_text("utf-8"), re.MULTILINE)
        if path.name not in users:
            assert [name for name in imports if name.startswith(("driveblocks.render", "driveblocks.maps.plan"))] == []


def test_every_frame_of_the_manuals_is_in_a_program(all_units: list[Unit]) -> None:
    for source, unit in zip([*shipped.sources(), *collection.read([EXAMPLE])], all_units[1:], strict=True):
        told = {
            check.words.partition(":")[0].split(" ")[0] for program in unit.suite.programs for check in program.checks
        }
        assert [frame.id for frame in source.drive.frames if frame.id not in told] == []
