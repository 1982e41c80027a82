"""`driveblocks check`: every map judged, every mistake with its place, exit status 2 when one is bad."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps import catalog, page, view

EXAMPLE = Path(__file__).parents[1] / "maps" / "example.yaml"


@pytest.fixture
def good(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A good map in the folder where the user stands."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.yaml").write_text(EXAMPLE.read_text(encoding="utf-8"), encoding="utf-8")
    return "good.yaml"


@pytest.fixture
def bad(good: str) -> str:
    """A map with two mistakes beside it."""
    text = Path(good).read_text(encoding="utf-8")
    text = text.replace("prefix: EX100", "prefix: ex100").replace("baud: 19200", "boud: 19200")
    Path("bad.yaml").write_text(text, encoding="utf-8")
    return "bad.yaml"


def test_a_good_map_is_said_to_be_good_with_what_it_holds(good: str) -> None:
    result = CliRunner().invoke(app, ["check", good])
    assert result.exit_code == 0
    assert result.stdout.splitlines() == [
        "good.yaml: good: 27 registers, 17 bits, 13 enum values, 4 settings, 4 faults, 4 errors, 9 frames, "
        "8 errata, 3 absent",
        "1 map good",
    ]
    assert result.stderr == ""


def test_all_mistakes_come_sorted_on_standard_error(bad: str) -> None:
    result = CliRunner().invoke(app, ["check", bad])
    assert result.exit_code == 2
    assert result.stdout == ""
    *mistakes, summary = result.stderr.splitlines()
    assert len(mistakes) == 2
    assert all(line.startswith("bad.yaml:") and "; " in line for line in mistakes)
    places = [tuple(map(int, line.split(":")[1:3])) for line in mistakes]
    assert places == sorted(places)
    assert summary == "1 of 1 map bad, 2 mistakes"


def test_all_maps_are_checked_when_the_first_is_bad(good: str, bad: str) -> None:
    result = CliRunner().invoke(app, ["check", bad, good, "missing.yaml"])
    assert result.exit_code == 2
    assert result.stdout.startswith("good.yaml: good: ")
    assert "missing.yaml:1:1: this file cannot be read: No such file or directory; " in result.stderr
    assert result.stderr.splitlines()[-1] == "2 of 3 maps bad, 3 mistakes"


def test_a_map_without_example_frames_is_good_and_told_what_its_tests_rest_on(good: str) -> None:
    before, _, rest = page.skeleton().partition("frames:")
    Path(good).write_text(f"{before}frames: []\nerrata:{rest.partition('errata:')[2]}", encoding="utf-8")
    result = CliRunner().invoke(app, ["check", good])
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.splitlines()[1] == f"good.yaml: note: {view.UNPROVED}"
    assert CliRunner().invoke(app, ["build", good, "-o", "out", "--to", "openplc"]).exit_code == 0
    assert view.UNPROVED in Path("out/README.md").read_text(encoding="utf-8")
    for command in ("show", "list"):
        assert view.UNPROVED in CliRunner().invoke(app, [command, good], env={"COLUMNS": "200"}).stdout


def test_a_folder_is_refused(tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["check", str(tmp_path)])
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{tmp_path}:1:1: this file cannot be read: it is a folder; ")


def test_a_path_is_in_messages_as_it_was_typed(bad: str, tmp_path: Path) -> None:
    Path("sub").mkdir()
    typed = f"sub/../{bad}"
    result = CliRunner().invoke(app, ["check", typed])
    assert result.stderr.startswith(f"{typed}:")


def test_an_unknown_name_is_answered_with_the_known_ones() -> None:
    result = CliRunner().invoke(app, ["check", "nosuchdrive"])
    assert result.exit_code == 2
    assert result.stderr.startswith("nosuchdrive:1:1: there is no drive `nosuchdrive`; known drives are ")


def test_an_installation_without_maps_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(catalog, "shipped", lambda: ())
    result = CliRunner().invoke(app, ["check"])
    assert result.exit_code == 2
    assert "there are no maps here; name the maps to check" in result.stderr


def test_the_shipped_maps_are_good() -> None:
    result = CliRunner().invoke(app, ["check"])
    assert result.stderr == ""
    assert result.exit_code == 0
    assert result.stdout.splitlines()[-1] == f"{len(catalog.shipped())} maps good"
