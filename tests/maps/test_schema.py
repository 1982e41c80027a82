"""The JSON Schema beside the maps is current, valid, and takes what the loader takes."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps import decode, nodes, page, schema
from driveblocks.maps.problem import Report
from driveblocks.maps.shape import Key, keys_of

ROOT = Path(__file__).parents[2]
MAPS = [*sorted((ROOT / "vendor_maps").glob("*.yaml")), ROOT / "tests/maps/example.yaml"]


def test_the_file_is_current() -> None:
    written = (ROOT / "vendor_maps/schema.json").read_text(encoding="utf-8")
    assert written == schema.text(), "run: driveblocks schema vendor_maps"


def test_it_is_a_schema() -> None:
    jsonschema.Draft7Validator.check_schema(schema.schema())


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_a_good_map_passes(path: Path) -> None:
    data = yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)  # noqa: S506  (texts only, as editors see patterns)
    assert [each.message for each in wrong(data) if each.validator != "enum"] == []


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_a_good_map_passes_as_an_editor_reads_it(path: Path) -> None:
    assert [each.message for each in wrong(yaml.safe_load(path.read_text(encoding="utf-8")))] == []


def wrong(data: Any) -> list[jsonschema.ValidationError]:
    """What the schema finds; of a map with a base not what it misses, which the base may have."""
    found = jsonschema.Draft7Validator(schema.schema()).iter_errors(data)
    return [each for each in found if "base" not in data or each.validator != "required"]


def test_an_unknown_key_is_refused() -> None:
    data = yaml.safe_load((ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8"))
    data["colour"] = "red"
    assert any("colour" in e.message for e in jsonschema.Draft7Validator(schema.schema()).iter_errors(data))


def test_a_wrong_address_is_refused() -> None:
    data = yaml.safe_load((ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8"))
    data["sections"][0]["registers"][0]["address"] = "26h"
    assert list(jsonschema.Draft7Validator(schema.schema()).iter_errors(data))


KEYS = [(cls, key) for cls in page.classes() for key in keys_of(cls).values()]


@pytest.mark.parametrize(("cls", "key"), KEYS, ids=lambda value: getattr(value, "__name__", None) or value.name)
def test_every_key_has_a_meaning_and_a_sound_example(cls: type, key: Key) -> None:
    assert key.doc
    report = Report("example")
    root = nodes.parse(f"{key.name}: {key.example}", report)
    assert isinstance(root, nodes.Entries)
    if "..." not in key.example:
        decode.build(key.shape, root.entries[key.name][1], report, key.name)
    assert [str(problem) for problem in report.problems] == []


def test_every_class_is_in_the_schema() -> None:
    assert set(json.loads(schema.text())["definitions"]) == {cls.__name__ for cls in page.classes()}


def test_the_reference_is_current() -> None:
    written = (ROOT / "vendor_maps/keys.md").read_text(encoding="utf-8")
    assert written == page.reference(), "run: driveblocks schema vendor_maps"


def test_the_guide_is_current() -> None:
    text = (ROOT / "vendor_maps/README.md").read_text(encoding="utf-8")
    assert page.update(text) == text, "run: driveblocks schema vendor_maps"


def test_a_page_without_markers_is_refused() -> None:
    with pytest.raises(ValueError, match="markers"):
        page.update("no markers here")


def test_the_reference_lists_every_word_that_a_key_can_have() -> None:
    text = page.reference()
    for word in ("percent_of_maximum", "coast_stop", "zero_speed", "r/min", "likely", "ram_address_bit"):
        assert f"`{word}`" in text


def test_the_command_writes_over_its_own_files_alone(tmp_path: Path) -> None:
    command = ["schema", str(tmp_path)]
    assert CliRunner().invoke(app, command).exit_code == 0
    written = (tmp_path / "keys.md").read_bytes()
    (tmp_path / "keys.md").write_bytes(written[:-1])
    assert CliRunner().invoke(app, command).exit_code == 0
    assert (tmp_path / "keys.md").read_bytes() == written
    (tmp_path / "keys.md").unlink()
    (tmp_path / "schema.json").write_text('{"mine": 1}', encoding="utf-8")
    refused = CliRunner().invoke(app, command)
    assert (refused.exit_code, [each.name for each in tmp_path.iterdir()]) == (2, ["schema.json"])
    assert (tmp_path / "schema.json").read_text(encoding="utf-8") == '{"mine": 1}'
    assert "schema.json: there is a file that no `driveblocks schema` has written" in refused.stderr
