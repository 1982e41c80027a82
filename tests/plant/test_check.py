"""The rules of plants: each mistake at its place, several at once, and good plants good."""

import re
from pathlib import Path
from random import Random

import pytest
import yaml
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.desk.site.kept import PLANT
from driveblocks.maps.problem import MapError, Problem
from driveblocks.maps.shape import keys_of
from driveblocks.plant import check, load
from driveblocks.plant.line import lines
from driveblocks.plant.model import SECTIONS, Plant
from driveblocks.plant.rules import memory
from driveblocks.platforms.cost import CODE_KIB, FAMILY_KIB
from driveblocks.render.library import PLANT as GROUPS

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples/plants"
WORKS = (HERE / "works.yaml").read_text("utf-8")
MISTAKES = yaml.safe_load((HERE / "mistakes.yaml").read_text("utf-8"))


def problems(path: Path, text: str) -> tuple[Problem, ...]:
    """What is wrong with a plant."""
    path.write_text(text, encoding="utf-8")
    try:
        check.judged(path)
    except MapError as error:
        return error.problems
    return ()


@pytest.mark.parametrize(
    "name", ["pumps", *(pytest.param(each, marks=pytest.mark.thorough) for each in ("conveyor", "small"))]
)
def test_the_examples_are_good_and_nothing_is_to_be_looked_at(name: str) -> None:
    judged = check.judged(EXAMPLES / f"{name}.yaml")
    assert judged.figures.keys() == judged.plant.lines.keys()
    assert not judged.warnings


def test_the_plant_of_the_mistakes_is_good() -> None:
    judged = check.judged(HERE / "works.yaml")
    said = [each.wrong for each in judged.warnings]
    assert len(said) == 2
    assert said[1].startswith("line A: A stop of JSCC at a CHF may start the motor; its block sees that by")


@pytest.mark.parametrize(("old", "new", "at", "says"), MISTAKES, ids=[f"{new}" for _, new, *_ in MISTAKES])
def test_a_mistake_is_reported_at_its_place(tmp_path: Path, old: str, new: str, at: str, says: str) -> None:
    assert WORKS.count(old) == 1
    found = problems(tmp_path / "works.yaml", WORKS.replace(old, new))
    assert any(f"{each.line}:{each.column}" == at and f"{each.wrong}; {each.right}".startswith(says) for each in found)


def test_all_mistakes_come_at_once(tmp_path: Path) -> None:
    edits = {"unit: 2, maximum_hz: 50, full": "unit: 1, maximum_hz: 90, full", "{start: Pumps}": "{start: Pump}",
             "raw: [0, 27648]": "raw: [0, 0]", "mode: speed": "mode: fast"}  # fmt: skip
    text = WORKS
    for old, new in edits.items():
        text = text.replace(old, new)
    assert [each.line for each in problems(tmp_path / "works.yaml", text)] == [9, 9, 12, 16, 18]


@pytest.mark.thorough
def test_no_damage_to_a_file_is_more_than_a_mistake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chance, words = Random(7), ("[]", "{}", "5", "true", "''", "null", "-1", ": ", "{", "]", ", ", "P1", "Level", "Ü")
    monkeypatch.setattr(check, "_figures", lambda *_: {})
    for _ in range(300):
        token = chance.choice([*re.finditer(r"[\w.]+|\[[^\]]*\]|\{[^}]*\}", WORKS)])
        problems(tmp_path / "works.yaml", WORKS[: token.start()] + chance.choice(words) + WORKS[token.end() :])


def test_one_drive_more_than_a_line_takes(tmp_path: Path) -> None:
    drives = "".join(
        f"  M{unit}: {{drive: chf, line: A, unit: {unit}, maximum_hz: 50, full_scale_hz: 50, stop_within_ms: 15000}}\n"
        for unit in range(1, 34)
    )
    text = f'plant: Many\nlines:\n  A: {{port: "1", rate: 38400}}\ndrives:\n{drives}'
    (found,) = problems(tmp_path / "many.yaml", text)
    assert (found.line, found.column, found.wrong) == (37, 3, "line A has 33 units, and takes 32")


def test_a_map_that_is_bad_or_clashes_is_said_at_its_drive(tmp_path: Path) -> None:
    bad = (EXAMPLES.parents[1] / "vendor_maps/jscc.yaml").read_text("utf-8")
    (tmp_path / "mine.yaml").write_text(bad.replace("format: 2", "format: 9", 1), encoding="utf-8")
    (found, *_) = problems(tmp_path / "works.yaml", WORKS.replace("drive: jscc", "drive: mine.yaml"))
    assert (found.line, found.column) == (8, 15)
    assert found.wrong.startswith("the map of `mine.yaml` is bad: ")
    (tmp_path / "mine.yaml").write_text(bad.replace("prefix: JSCC", "prefix: CHF"), encoding="utf-8")
    (found, *_) = problems(tmp_path / "works.yaml", WORKS.replace("drive: jscc", "drive: mine.yaml"))
    assert "prefix CHF is taken by" in found.wrong


def test_a_map_of_ones_own_is_beside_the_plant(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = (EXAMPLES.parents[1] / "tests/maps/example.yaml").read_text("utf-8")
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps/mine.yaml").write_text(own, encoding="utf-8")
    path = tmp_path / "works.yaml"
    path.write_text(WORKS.replace("drive: jscc", "drive: maps/mine.yaml"), encoding="utf-8")
    monkeypatch.chdir(EXAMPLES)
    motor = load.load(path).drives["P1"]
    assert (motor.path, motor.map.prefix) == (tmp_path / "maps/mine.yaml", "EX100")


def test_a_plant_that_may_not_fit_is_good_with_a_warning(tmp_path: Path) -> None:
    text = (
        'plant: One\ncpu: S7-1217C\nlines:\n  A: {port: "1"}\ndrives:\n'
        "  M1: {drive: atv312, line: A, unit: 1, maximum_hz: 50, stop_within_ms: 15000}\n"
    )
    path = tmp_path / "one.yaml"
    path.write_text(text, encoding="utf-8")
    (warning,) = check.judged(path).warnings
    assert (warning.line, warning.column) == (2, 6)
    assert warning.wrong.startswith("S7-1217C has 150 kB, and the plant may take ")


@pytest.mark.thorough
def test_the_data_of_a_plant_is_what_the_page_of_memory_says(tmp_path: Path) -> None:
    drives = "".join(
        f"  M{unit}: {{drive: rockwell_powerflex_4, line: A, unit: {unit}, maximum_hz: 50, stop_within_ms: 15000}}\n"
        for unit in range(1, 5)
    )
    path = tmp_path / "four.yaml"
    path.write_text(f'plant: Four\nlines:\n  A: {{port: "1", rate: 19200}}\ndrives:\n{drives}', encoding="utf-8")
    plant = load.load(path)
    code = CODE_KIB[""] + CODE_KIB[GROUPS]
    found = [round((each - 12_354) / 1024) - code for each in memory.needed(plant, lines(plant).values())]
    assert found == [*FAMILY_KIB], "docs/memory.md says 12,354 bytes for four drives"


FOUND = """
{}:
  map: "{}"
  revision: "1A2B3C4D"
  date: "2026-11-30 10:00"
  line: {{rate: 19200, form: "8E1", mode: rtu, unit: 2}}
  family: "fits"
  measured: {{reads: 9, longest_ms: 12, words: 4, unlisted: "none", turn_round_ms: 50, longest_reply_ms: 400}}
  answers:
    - {{gap: "scale", answer: "1", gives: FrequencyScale, value: "0.01"}}
"""
"""An entry as commission writes it."""


def test_what_commission_found_counts_unless_the_plant_says_otherwise(tmp_path: Path) -> None:
    path, given = tmp_path / "works.yaml", WORKS.replace("ramp_down_s: 10", "settings: {LongestMs: 500}")
    path.write_text(given + FOUND.format("P2", "invt_chf"), encoding="utf-8")
    values = {name: str(each) for name, each in load.load(path).drives["P2"].values.items()}
    assert values == {"FrequencyScale": "0.01", "LongestMs": "500", "TurnRoundMs": "50"}


def test_what_commission_found_of_no_drive_or_of_another_is_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "works.yaml"
    path.write_text(WORKS + FOUND.format("X9", "jscc") + FOUND.format("P2", "jscc"), encoding="utf-8")
    assert [each.wrong for each in check.judged(path).warnings][-2:] == [
        "no drive is called X9, of which commission has found this",
        "commission has found a jscc at P2, and the plant has invt_chf",
    ]


def test_a_button_that_can_reset_nothing_over_the_line_is_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "works.yaml"
    buttons = "  StartPumps: {start: Pumps}\n  ResetP1: {reset: P1}\n  ResetPumps: {reset: Pumps}\n"
    path.write_text(WORKS.replace("  StartPumps: {start: Pumps}\n", buttons), encoding="utf-8")
    (warning,) = [each for each in check.judged(path).warnings if each.line > 18]
    assert (warning.line, warning.column) == (19, 20)
    assert warning.wrong == "ResetP1 resets no fault of P1: JSCC takes no reset over the line"


def test_the_hard_stop_of_a_plant_without_any_has_a_name_of_its_own(tmp_path: Path) -> None:
    text = WORKS[: WORKS.index("hard_stops:")] + WORKS[WORKS.index("meters:") :]
    path = tmp_path / "works.yaml"
    assert not problems(path, text)
    assert load.load(path).hard_stops["HardStop"].drives == ("P1", "P2", "P3", "F1", "F2")
    (found,) = problems(path, text.replace("  PumpsRun:", "  Hardstop:"))
    assert (found.line, found.wrong) == (21, "`Hardstop` is a variable of the program itself")


def test_a_drive_of_a_plant_may_be_named_by_its_nameplate(tmp_path: Path) -> None:
    path = tmp_path / "works.yaml"
    path.write_text(WORKS.replace("drive: atv312", "drive: ATV312HU15N4"), encoding="utf-8")
    motor = load.load(path).drives["F1"]
    assert (motor.path.stem, motor.map.prefix) == ("schneider_altivar_312", "ATV312")
    assert (EXAMPLES.parents[1] / "vendor_maps").samefile(motor.path.parent)


def test_how_a_line_is_spoken_on_is_as_all_its_drives_are_delivered(tmp_path: Path) -> None:
    path = tmp_path / "works.yaml"
    path.write_text(WORKS, encoding="utf-8")
    lines = load.load(path).lines
    assert str(lines["A"].way) == "19200 bit/s 8E1 RTU"
    assert str(lines["B"].way) == "9600 bit/s 8E1 RTU"


def test_the_keys_of_a_plant_are_those_that_commission_leaves_alone() -> None:
    assert set(PLANT) == {*keys_of(Plant), *SECTIONS}


def test_check_tells_a_plant_from_a_map(tmp_path: Path) -> None:
    said = CliRunner().invoke(app, ["check", str(HERE / "works.yaml"), "jscc"])
    assert said.exit_code == 0
    lines = said.stdout.splitlines()
    assert lines[0].endswith(": good: 2 lines, 5 drives, 1 group, 1 input, 2 buttons, 1 lamp, 2 hard stops, 1 meter")
    assert lines[1].split(":", 3)[3].startswith(" warning: line A: ")
    assert lines[-1] == "2 files good"
    path = tmp_path / "bad.yaml"
    path.write_text(WORKS.replace("duty: 2", "duty: 3"), encoding="utf-8")
    said = CliRunner().invoke(app, ["check", str(path)])
    assert (said.exit_code, said.stderr.splitlines()[-1]) == (2, "1 of 1 plant bad, 1 mistake")
