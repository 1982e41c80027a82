"""`driveblocks test`: what is printed and written, and the exit status."""

import functools
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner, Result
from tests.shipped import BOTH
from tests.testing.conftest import changed, only

from driveblocks.bench.unit import Unit
from driveblocks.cli import app
from driveblocks.maps import collection
from driveblocks.maps.page import skeleton
from driveblocks.maps.view import UNPROVED
from driveblocks.output import units as tested
from structured_text.engines import discovery
from structured_text.engines.embedded import EmbeddedEngine

MINE = "my_drive.yaml"
EXAMPLE = Path(__file__).parents[1] / "maps" / "example.yaml"


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A user's map in the folder where the user stands."""
    monkeypatch.chdir(tmp_path)
    Path(MINE).write_text(EXAMPLE.read_text(encoding="utf-8"), encoding="utf-8")


@functools.cache
def whole() -> Unit:
    """All programs of the map, under the name that it has there."""
    (source,) = collection.read([EXAMPLE])
    return tested.units([collection.Source(Path("my_drive.yaml"), source.drive)], BOTH)[1]


@pytest.fixture
def brief() -> Unit:
    """Two programs of the map alone."""
    return only(whole(), "Frames", "Scales")


def invoke(made: Unit | None, *arguments: str) -> Result:
    """Run the command, with this unit instead of what the map makes."""
    return CliRunner().invoke(app, ["test", *arguments], obj=made and (lambda *_: [made]))


def test_a_good_map_passes_and_nothing_is_written_but_the_xml(brief: Unit) -> None:
    result = invoke(brief, MINE, "--junit", "junit.xml")
    assert result.exit_code == 0, result.output
    assert sorted(path.name for path in Path.cwd().iterdir()) == ["junit.xml", "my_drive.yaml"]
    last = result.stdout.splitlines()[-1]
    match = re.fullmatch(r"(\d+) checks of 1 drive on embedded: all passed in [\d.]+ s; junit\.xml", last)
    assert match
    root = ElementTree.parse("junit.xml").getroot()  # noqa: S314  (our own file)
    assert (root.attrib["tests"], root.attrib["failures"], root.attrib["errors"]) == (match[1], "0", "0")
    assert "my_drive.EX100_TestFrames" in {case.attrib["classname"] for case in root.iter("testcase")}


def test_the_table_has_a_row_per_group_and_a_column_per_engine_and_no_file_is_written(brief: Unit) -> None:
    lines = invoke(brief, MINE).stdout.splitlines()
    assert [path.name for path in Path.cwd().iterdir()] == ["my_drive.yaml"]
    assert re.search(r": all passed in [\d.]+ s$", lines[-1])
    assert lines[0] == "engine embedded: runs, part of DriveBlocks"
    assert [line.split(":")[0] for line in lines[1:3]] == ["engine matiec-beremiz", "engine matiec-openplc"]
    assert lines[3].split() == ["drive", "tested", "embedded"]
    row = next(line for line in lines if "Registers" in line)
    assert re.fullmatch(r"my_drive +Registers: [\d,]+ checks +[\d.]+ ms", row)


def test_a_drive_that_no_example_frame_backs_is_named(brief: Unit) -> None:
    before, _, rest = skeleton().partition("frames:")
    Path(MINE).write_text(f"{before}frames: []\nerrata:{rest.partition('errata:')[2]}", encoding="utf-8")
    lines = invoke(brief, MINE).stdout.splitlines()
    assert f"ACME: {UNPROVED}" in lines
    assert not [line for line in lines if "coverage" in line]


def test_a_failure_is_printed_with_place_and_values_and_gives_status_1() -> None:
    wrong = changed(whole(), "EX100_DCBusVoltageV", "/ 10.0", "/ 100.0")
    result = invoke(only(wrong, "Frames", "Scales"), MINE, "--junit", "results.xml")
    assert result.exit_code == 1
    place = r"tests/iec61131/my_drive/EX100_TestFrames\.st:\d+: my_drive\.EX100_TestFrames on embedded"
    assert re.search(
        rf"^{place}\n  12: read_voltage_reply: .*: 548\.8 V\n  expected 548\.8, found 54\.88$", result.stdout, re.M
    )
    assert re.search(r"^my_drive +Registers: \d+ checks +\d+ failed$", result.stdout, re.MULTILINE)
    assert re.search(r"checks of 1 drive on embedded: \d+ failed in", result.stdout.splitlines()[-1])
    assert "and " in result.stdout.splitlines()[-2]
    failures = list(ElementTree.parse("results.xml").iter("failure"))  # noqa: S314  (our own file)
    assert any(each.text and each.text.endswith("expected: 548.8\nactual: 54.88") for each in failures)


@pytest.mark.thorough
def test_a_scene_that_fails_is_printed_with_pins_and_frames_and_drawn() -> None:
    """A stop that never reaches the drive, seen from the pins alone."""
    wrong = changed(whole(), "EX100_Drive", "END_FUNCTION_BLOCK", "  QuickStop := FALSE;\nEND_FUNCTION_BLOCK")
    wrong = changed(wrong, "EX100_Drive", "END_VAR\n\n", "END_VAR\n\n  QuickStop := FALSE;\n")
    result = invoke(only(wrong, "MotorStop"), MINE, "--junit", "results.xml", "--picture", "pictures")
    assert result.exit_code == 1
    assert re.search(r"^my_drive +Motor: \d+ scenes, \d+ checks +\d+ failed$", result.stdout, re.MULTILINE)
    assert re.search(r"^ +ms +set +shown +Reason +Hz +motor +frame$", result.stdout, re.MULTILINE)
    last = re.findall(
        r"^ +\d+ +Enable RunForward QuickStop +CommOk Running +RUNS .* 30\.0 +[<>] 01 [0-9A-F ]+$", result.stdout, re.M
    )
    assert last
    cases = {case.attrib["name"]: case for case in ElementTree.parse("results.xml").iter("testcase")}  # noqa: S314
    assert cases["Enable FALSE"].find("failure") is None
    failure = cases["QuickStop"].find("failure")
    assert failure is not None
    assert "Enable RunForward QuickStop" in (failure.text or "")
    drawn = ElementTree.parse("pictures/EX100_TestMotorStop-embedded.svg").getroot()  # noqa: S314  (our own file)
    words = {each.text for each in drawn.iter("{http://www.w3.org/2000/svg}text")}
    assert {"QuickStop", "RunForward", "Running", "sent", "heard"} <= words

    assert invoke(only(wrong, "MotorStop"), MINE, "--picture", "pictures").exit_code == 1, "its own picture is replaced"
    Path("pictures/EX100_TestMotorStop-embedded.svg").write_text("<svg/>", encoding="utf-8")
    again = invoke(only(wrong, "MotorStop"), MINE, "--picture", "pictures")
    assert (again.exit_code, Path("pictures/EX100_TestMotorStop-embedded.svg").read_text("utf-8")) == (2, "<svg/>")
    assert "EX100_TestMotorStop-embedded.svg: there is a file that no `driveblocks test` has written" in again.stderr


def test_a_bad_map_gives_status_2_and_is_reported_with_its_place() -> None:
    text = Path(MINE).read_text(encoding="utf-8").replace("baud: 19200", "boud: 19200")
    Path("bad.yaml").write_text(text, encoding="utf-8")
    result = invoke(None, MINE, "bad.yaml", "--junit", "junit.xml")
    assert result.exit_code == 2
    assert re.search(r"^bad\.yaml:\d+:\d+: ", result.stderr, re.MULTILINE)
    assert not Path("junit.xml").exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["no_such_drive"], "there is no drive `no_such_drive`"),
        (["missing.yaml"], "missing.yaml"),
        (["--engine", "codesys"], "there is no engine `codesys`; write one of embedded, matiec, all"),
    ],
)
def test_what_cannot_be_meant_gives_status_2(arguments: list[str], said: str) -> None:
    result = invoke(None, *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


def without_matiec(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine that has nothing but the embedded engine."""
    found = discovery.survey({"PATH": ""})
    monkeypatch.setattr(discovery, "survey", lambda: discovery.Survey(found.embedded, None, found.cache))


def test_an_engine_that_is_not_there_gives_status_2_and_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    without_matiec(monkeypatch)
    result = invoke(None, MINE, "--engine", "matiec")
    assert result.exit_code == 2
    assert "engine matiec-beremiz cannot be used: no iec2c found" in result.stderr
    assert "engine matiec-openplc cannot be used: no iec2c found" in result.stderr


def test_several_engines_stand_side_by_side(brief: Unit, monkeypatch: pytest.MonkeyPatch) -> None:
    class Second(EmbeddedEngine):
        name = "matiec-openplc"

    found = discovery.survey({"PATH": ""})

    class Both(discovery.Survey):
        def candidates(self) -> list[discovery.Candidate]:
            return [found.embedded, discovery.Candidate("matiec-openplc", Second(), "here")]

    monkeypatch.setattr(discovery, "survey", lambda: Both(found.embedded, None, found.cache))
    result = invoke(brief, MINE, "--engine", "all", "--junit", "junit.xml")
    assert result.exit_code == 0
    assert "drive     tested" in result.stdout
    assert re.search(r"^drive +tested +embedded +openplc$", result.stdout, re.MULTILINE)
    assert "on embedded, matiec-openplc: all passed" in result.stdout
    suites = [each.attrib["name"] for each in ElementTree.parse("junit.xml").iter("testsuite")]  # noqa: S314
    assert {name.rpartition(" on ")[2] for name in suites} == {"embedded", "matiec-openplc"}


def test_an_xml_that_cannot_be_written_gives_status_2(brief: Unit) -> None:
    result = invoke(brief, MINE, "--junit", "no/such/folder/junit.xml")
    assert result.exit_code == 2
    assert "no/such/folder/junit.xml: cannot be written" in result.stderr


# ---------------------------------------------------------------- coverage


def test_coverage_below_what_is_required_gives_status_1() -> None:
    never = "  IF StandstillProven AND NOT StandstillProven THEN\n    StandstillProven := FALSE;\n  END_IF;\n"
    longer = changed(whole(), "EX100_Standstill", "END_FUNCTION_BLOCK", f"{never}END_FUNCTION_BLOCK")
    longer = only(longer, "Standstill")
    assert invoke(longer, MINE, "--coverage").exit_code == 0
    result = invoke(longer, MINE, "--require-coverage", "100")
    assert result.exit_code == 1
    assert re.search(r"^  iec61131/my_drive/EX100_Standstill\.st:\d+:6: never IF TRUE$", result.stdout, re.MULTILINE)
    assert re.search(r"^library\.coverage on embedded$", result.stdout, re.MULTILINE)
    assert "2 failed" in result.stdout.splitlines()[-1]
