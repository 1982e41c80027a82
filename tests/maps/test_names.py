"""Identifiers made from names, what check says of those that cannot be, and of the names of files."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps import collection, names
from driveblocks.maps.load import load
from driveblocks.maps.problem import MapError
from driveblocks.maps.rules.identifier import OWN
from driveblocks.output import build
from driveblocks.render import text

EXAMPLE = Path(__file__).with_name("example.yaml")


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("Output frequency", "OutputFrequency"),
        ("DC bus voltage", "DCBusVoltage"),
        ("Run/stop (local)", "RunStopLocal"),
        ("Over 85 °C", "Over85C"),
    ],
)
def test_names_become_identifiers(name: str, wanted: str) -> None:
    assert names.pascal(name) == wanted


def test_the_names_of_the_blocks_that_every_drive_has_are_taken() -> None:
    files = build.files(collection.read([EXAMPLE]), text.languages(["en", "zh"], "utf-8"))
    made = [path for path in files if path.endswith(".st")]
    drive = load(EXAMPLE)
    rows = {names.symbol(row) for _, row in drive.registers()}
    found = {name.removeprefix("EX100_") for path in made if (name := Path(path).stem).startswith("EX100_")}
    free = {name for name in found if not OWN.fullmatch(name)}
    assert {re.sub("V$|Percent$", "", name) for name in free} <= rows
    assert len(found - free) > 20


@pytest.mark.parametrize("name", ["..", "a\nb", "con", "Com1.x", "my drive", "-a", "ä", "a.", "\udcff"])
def test_a_file_whose_name_cannot_be_a_folder_is_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"{name}.yaml"
    path.write_text("format: 2", encoding="utf-8")
    with pytest.raises(MapError) as caught:
        load(path)
    assert len(caught.value.problems) > 1  # beside what is wrong inside
    assert "the name of this file cannot name the folder" in str(caught.value)
    assert "\n" not in str(caught.value.problems[0])
    assert str(caught.value).encode()


@pytest.mark.parametrize(("one", "other"), [("drive", "DRIVE"), ("one", "Modbus")])
def test_names_that_differ_in_case_alone_are_refused(tmp_path: Path, one: str, other: str) -> None:
    paths = [tmp_path / "a" / f"{one}.yaml", tmp_path / "b" / f"{other}.yaml"]
    for number, path in enumerate(paths):
        path.parent.mkdir()
        path.write_text(EXAMPLE.read_text("utf-8").replace("prefix: EX100", f"prefix: E{number}"), encoding="utf-8")
    said = [f"{path}:1:1: the folder {path.stem}/ is taken by" for path in paths]
    for command in ("check", "build"):
        result = CliRunner().invoke(app, [command, *map(str, paths), *(["-o", str(tmp_path)] * (command == "build"))])
        assert result.exit_code == 2
        assert any(one in result.output for one in said)
