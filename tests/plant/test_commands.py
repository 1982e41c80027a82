"""Commands that take a plant, or a drive of it: what they read from it, and that nothing in it is lost."""

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from driveblocks.desk.site import drives, hour, kept
from driveblocks.desk.site.found import Found, Way
from driveblocks.plant import check, draft, load
from driveblocks.plant.word import is_plant

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples/plants"
PUMPS, SMALL = EXAMPLES / "pumps.yaml", EXAMPLES / "small.yaml"
ABOUT = kept.About("P2", "schneider_altivar_312", "1A2B3C4D", "2026-11-30 10:00", "A. Person")


def command(*words: object) -> Result:
    return CliRunner().invoke(app, [*map(str, words)], env={"COLUMNS": "100"})


# ------------------------------------------------------------ line and sheet


def test_line_computes_each_line_of_a_plant() -> None:
    said = command("line", PUMPS)
    assert said.exit_code == 0
    lines = said.stdout.splitlines()
    assert [each for each in lines if each.startswith("Line ")] == ["Line A", "Line B"]
    assert "    1  P1" in said.stdout.replace("   1  P1", "    1  P1")


@pytest.mark.thorough
def test_the_figures_of_a_plant_are_there_as_json() -> None:
    plain = json.loads(command("line", PUMPS, "--json").stdout)
    assert {name: each["rate"] for name, each in plain.items()} == {"A": 19200, "B": 19200}


@pytest.mark.thorough
def test_line_shows_what_check_refuses(tmp_path: Path) -> None:
    path = tmp_path / "small.yaml"
    path.write_text(SMALL.read_text("utf-8").replace("speed: 45", "watchdog_ms: 500"), encoding="utf-8")
    said = command("line", path)
    assert said.exit_code == 1
    assert "What feeds the watchdog of Pump (2) may wait" in said.stdout


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([PUMPS, SMALL], "name one plant, one program, or drives\n"),
        ([PUMPS, "--rate", "9600"], "--rate is for a program or named drives, not for a plant\n"),
        ([PUMPS, "--picture", "no.svg"], "2 lines (A, B); --picture draws one: name its drives\n"),
    ],
)
def test_what_a_line_of_a_plant_cannot_be(words: list[object], says: str) -> None:
    said = command("line", *words)
    assert (said.exit_code, said.stderr) == (2, says)


def test_a_sheet_for_each_drive_with_its_own_address() -> None:
    said = command("sheet", f"{PUMPS}:P2")
    assert said.stdout.startswith("# Schneider Electric Altivar 312: settings for unit 2\n\n**P2**, Pump 2, line A\n")
    assert "**19200 bit/s**, **8E1**, watchdog **5 s**" in said.stdout
    every = [each for each in command("sheet", PUMPS).stdout.splitlines() if each.startswith("**P")]
    assert [each[2:4] for each in every] == ["P1", "P2", "P3", "P4", "P5", "P6"]


def test_the_sheet_of_a_drive_on_an_ascii_line_sets_it_to_ascii(tmp_path: Path) -> None:
    path = tmp_path / "works.yaml"
    works = (HERE / "works.yaml").read_text("utf-8")
    path.write_text(works.replace('form: "8E1"}', 'form: "8O1", mode: ascii}'), encoding="utf-8")
    said = command("sheet", f"{path}:P1").stdout
    assert "**8O1**" in said
    assert "| **1 = " in next(each for each in said.splitlines() if "FA.03" in each)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([f"{PUMPS}:P9"], f"{PUMPS} has no drive P9; it has P1, P2, P3, P4, P5, P6\n"),
        ([PUMPS, "--address", "3"], "a plant says address, rate, format and watchdog of its drives itself; "),
    ],
)
def test_what_a_sheet_of_a_plant_cannot_be(words: list[object], says: str) -> None:
    said = command("sheet", *words)
    assert said.exit_code == 2
    assert said.stderr.startswith(says)


# ------------------------------------------------------------ commission, parameters, site


def commissioned(monkeypatch: pytest.MonkeyPatch, *words: object) -> hour.Words:
    """The words that a commission is begun with."""
    begun: list[hour.Words] = []

    def run(given: hour.Words, _: object) -> Found:
        begun.append(given)
        return Found(ended="tried")

    monkeypatch.setattr(hour, "run", run)
    assert command("commission", *words).exit_code == 1
    return begun[0]


def test_commission_takes_what_is_not_given_from_the_plant(monkeypatch: pytest.MonkeyPatch) -> None:
    words = commissioned(monkeypatch, "--file", PUMPS, "--label", "P2")
    assert (words.map, words.rate, words.form, words.mode, words.unit) == (
        "schneider_altivar_312", 19200, "8E1", "rtu", 2,
    )  # fmt: skip
    words = commissioned(monkeypatch, "jscc", "--file", PUMPS, "--label", "P2", "--rate", "9600", "--unit", "7")
    assert (words.map, words.rate, words.form, words.unit) == ("jscc", 9600, "8E1", 7)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--file", "site.yaml"], "name the map, or a drive of a plant: --file plant.yaml --label P1; "),
        (["--file", PUMPS, "--label", "P7"], f"{PUMPS} has no drive P7; it has P1, P2, P3, P4, P5, P6"),
        (["jscc", "--label", "drives", "--tcp", "x:1"], "--label drives is a key of a plant; write another"),
    ],
)
def test_a_drive_that_is_not_in_the_plant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[object], says: str
) -> None:
    monkeypatch.chdir(tmp_path)
    said = command("commission", *words)
    assert said.exit_code == 2
    assert says in said.stderr


def test_a_drive_is_commissioned_whatever_is_wrong_with_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "plant.yaml"
    path.write_text(PUMPS.read_text("utf-8").replace("drive: jscc", "drive: unknown", 1), encoding="utf-8")
    assert commissioned(monkeypatch, "--file", path, "--label", "P2").map == "schneider_altivar_312"
    said = command("commission", "--file", path, "--label", "P1")
    assert (said.exit_code, "there is no drive `unknown`" in said.stderr) == (2, True)


@pytest.mark.parametrize("name", ["conveyor", "pumps", "small"])
def test_nothing_that_the_user_has_written_is_lost_by_commission(tmp_path: Path, name: str) -> None:
    before = (EXAMPLES / f"{name}.yaml").read_text("utf-8")
    path = tmp_path / "plant.yaml"
    path.write_text(before, encoding="utf-8")
    kept.write(path, ABOUT, Found(Way(19200, "8E1"), 2, "fits"))
    once = path.read_text("utf-8")
    assert once.startswith(before)
    kept.write(path, ABOUT, Found(Way(9600, "8E1"), 2, "fits"))
    assert path.read_text("utf-8") == once.replace(
        'rate: 19200, form: "8E1", mode: "rtu", unit: 2', 'rate: 9600, form: "8E1", mode: "rtu", unit: 2'
    )
    assert list(kept.read(path)) == ["P2"]
    assert load.load(path).found.keys() == {"P2"}


def test_a_site_of_today_is_valid_whatever_its_labels(tmp_path: Path) -> None:
    path = tmp_path / "site.yaml"
    for label in ("Pump", "drives", "plant"):
        about = kept.About(label, "jscc", "1A2B3C4D", "2026-11-30 10:00", "")
        kept.write(path, about, Found(Way(9600), 1, "fits"))
    assert list(kept.read(path)) == ["Pump", "drives", "plant"]
    assert not is_plant(HERE / "no such file.yaml")
    assert "PumpSettings" in command("site", path).stdout


def test_site_prints_what_was_found_in_a_plant(tmp_path: Path) -> None:
    path = tmp_path / "plant.yaml"
    path.write_text(PUMPS.read_text("utf-8"), encoding="utf-8")
    kept.write(path, ABOUT, Found(Way(19200, "8E1"), 2, "fits"))
    said = command("site", path)
    assert (said.exit_code, "P2Settings" in said.stdout) == (0, True)


def test_parameters_are_saved_from_a_drive_of_a_plant(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[Any] = []

    def save(*given: object) -> tuple[str, bool]:
        begun.append(given)
        return "saved", True

    monkeypatch.setattr(drives, "save", save)
    assert command("parameters", "save", f"{PUMPS}:P2", "p2.csv", "--tcp", "x:1").exit_code == 0
    name, file, place = begun[0]
    assert (name, file, place.rate, place.form, place.ascii) == (
        "schneider_altivar_312@2", Path("p2.csv"), 19200, "8E1", False,
    )  # fmt: skip
    command("parameters", "save", "chf@3", "p3.csv", "--tcp", "x:1")
    assert (begun[1][0], begun[1][2].rate, begun[1][2].form) == ("chf@3", 9600, "8N1")


def test_drives_of_lines_that_differ_are_not_compared() -> None:
    works = HERE / "works.yaml"
    said = command("parameters", "compare", f"{works}:P1", f"{works}:F1", "--tcp", "x:1")
    assert (said.exit_code, "are on lines of other rates or formats" in said.stderr) == (2, True)


# ------------------------------------------------------------ new


def test_new_writes_a_plant_that_is_good(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    said = command("new", "--plant", 'Water "works"')
    assert (said.exit_code, said.stdout.splitlines()[-1]) == (0, "driveblocks check plant.yaml")
    judged = check.judged(Path("plant.yaml"))
    assert (judged.plant.plant, judged.plant.program, judged.warnings) == ('Water "works"', "WaterWorks", ())
    assert command("new", "--plant", "Other").stderr == "plant.yaml: is there already; name another file with -o\n"
    assert command("new", "--plant", "7 pumps", "-o", "x.yaml").exit_code == 2


ANSWERS = (
    "A", "1", "19200", "8E1",
    "1P", "P1", "unknown", "jscc", "1", "Pump 1", "50", "10", "15000", "100",
    "P2", "gd200a", "2", "", "50", "10", "15000", "yes",
    "P3", "chf", "3", "", "50", "60", "10", "15000",
    "", "", "10", "sequence",
)  # fmt: skip


def test_a_plant_is_made_of_what_a_person_answers(tmp_path: Path) -> None:
    answers, said = iter(ANSWERS), list[str]()
    path = tmp_path / "plant.yaml"
    path.write_text(draft.asked("Asked for", lambda *_: next(answers), said.append), encoding="utf-8")
    assert next(answers, None) is None
    plant = check.good(path)
    assert list(plant.drives) == ["P1", "P2", "P3"]
    assert plant.groups["Group"].kind == "sequence"
    assert said[0] == "  1P is no name; write up to 22 letters and digits, a letter first"
    assert said[1].startswith("    there is no drive `unknown`")
