"""`driveblocks list` and `driveblocks counts`: which drives there are, and how much is known of each."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from rich.cells import cell_len

from driveblocks.cli import app
from driveblocks.maps import catalog, inventory

EXAMPLE = Path(__file__).parents[1] / "maps" / "example.yaml"


@pytest.fixture
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with one good map that means the shipped ones."""
    monkeypatch.setattr(catalog, "folder", lambda: tmp_path)
    (tmp_path / "example.yaml").write_text(EXAMPLE.read_text(encoding="utf-8"), encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("columns", [80, 120])
def test_the_table_fits_and_names_each_drive(shelf: Path, columns: int) -> None:
    result = CliRunner().invoke(app, ["list"], env={"COLUMNS": str(columns)})
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert max(map(cell_len, lines)) <= columns
    row = next(line for line in lines if line.startswith("example"))
    assert row.split()[:2] == ["example", "EX100_*"]
    assert row.split()[-3:] == ["27", "4", "9"]


def test_a_map_is_listed_by_the_model_number_of_its_drive(shelf: Path) -> None:
    models = "models: [{plate: EX1x-*, printed: [EX10-4], source: page 4}]\nmanual:"
    text = EXAMPLE.read_text(encoding="utf-8").replace("\nmanual:", f"\n{models}", 1)
    (shelf / "example.yaml").write_text(text, encoding="utf-8")
    (listed,) = json.loads(CliRunner().invoke(app, ["list", "ex10 4kw/5hp", "--json"]).stdout)
    assert (listed["drive"], [each["plate"] for each in listed["models"]]) == ("example", ["EX1x-*"])


def test_maps_that_are_named_are_listed_alone(shelf: Path) -> None:
    own = shelf / "other" / "mine.yaml"
    own.parent.mkdir()
    own.write_text(EXAMPLE.read_text(encoding="utf-8"), encoding="utf-8")
    result = CliRunner().invoke(app, ["list", str(own), "--json"])
    assert [(each["drive"], each["file"]) for each in json.loads(result.stdout)] == [("mine", str(own))]
    result = CliRunner().invoke(app, ["list", "nobody"])
    assert (result.exit_code, "there is no drive `nobody`" in result.stderr) == (2, True)
    result = CliRunner().invoke(app, ["show", str(own)])
    assert f"driveblocksshow{own}TOPIC" in "".join(result.stdout.split())  # however it is folded


def test_json_has_each_drive_whole_with_file_and_counts(shelf: Path) -> None:
    result = CliRunner().invoke(app, ["list", "--json"], env={"COLUMNS": "60"})
    assert result.exit_code == 0
    (drive,) = json.loads(result.stdout)
    shown = json.loads(CliRunner().invoke(app, ["show", "example", "--json"]).stdout)
    assert {key: value for key, value in drive.items() if key not in ("file", "counts", "trust")} == shown
    assert drive["file"] == str(shelf / "example.yaml")
    assert drive["counts"]["registers"] == 27 == sum(not one["unused"] for one in drive["registers"])


def test_a_bad_map_is_left_out_and_reported(shelf: Path) -> None:
    (shelf / "bad.yaml").write_text("format: 3\n", encoding="utf-8")
    result = CliRunner().invoke(app, ["list", "--json"])
    assert result.exit_code == 2
    assert [drive["drive"] for drive in json.loads(result.stdout)] == ["example"]
    assert f"{shelf / 'bad.yaml'}:1:9: " in result.stderr


def test_no_maps_at_all_is_an_error(shelf: Path) -> None:
    (shelf / "example.yaml").unlink()
    result = CliRunner().invoke(app, ["list", "--json"])
    assert (result.exit_code, json.loads(result.stdout)) == (2, [])


def test_every_shipped_drive_is_listed_and_no_word_of_its_family_is_broken_at_80_columns() -> None:
    drives = json.loads(CliRunner().invoke(app, ["list", "--json"]).stdout)
    assert [drive["drive"] for drive in drives] == [path.stem for path in catalog.shipped()]
    shown = CliRunner().invoke(app, ["list"], env={"COLUMNS": "80"}).stdout.partition("\n\n")[0].split()
    words = {word for drive in drives for part in ("vendor", "family") for word in drive[part]["en"].split()}
    assert words <= set(shown)
    assert {"registers", "faults", "frames"} <= set(shown)


def test_counts_are_printed_as_markdown(shelf: Path) -> None:
    result = CliRunner().invoke(app, ["counts"])
    assert result.exit_code == 0
    assert result.stdout.startswith("| drive and its register tables | registers |")
    assert "[**EX100**](" in result.stdout


def test_counts_are_written_between_the_markers(shelf: Path) -> None:
    page = shelf / "PAGE.md"
    page.write_text(f"top\n{inventory.BEGIN}\n{inventory.END}\nend\n", encoding="utf-8")
    stale = CliRunner().invoke(app, ["counts", str(page), "--check"])
    assert stale.exit_code == 1
    assert stale.stderr == f"not current: {page}; run: driveblocks counts {page}\n"
    assert "EX100" not in page.read_text(encoding="utf-8")
    assert CliRunner().invoke(app, ["counts", str(page)]).exit_code == 0
    assert "[**EX100**](example.yaml)" in page.read_text(encoding="utf-8")
    assert CliRunner().invoke(app, ["counts", str(page), "--check"]).exit_code == 0


@pytest.mark.parametrize("text", [None, "no markers"])
def test_a_page_that_cannot_be_written_is_refused(shelf: Path, text: str | None) -> None:
    page = shelf / "PAGE.md"
    if text is not None:
        page.write_text(text, encoding="utf-8")
    result = CliRunner().invoke(app, ["counts", str(page)])
    assert result.exit_code == 2
    assert result.stderr.startswith("cannot write the table: ")


def test_counts_of_a_bad_map_are_refused(shelf: Path) -> None:
    (shelf / "bad.yaml").write_text("format: 3\n", encoding="utf-8")
    result = CliRunner().invoke(app, ["counts"])
    assert result.exit_code == 2
    assert "bad.yaml:1:9: " in result.stderr
