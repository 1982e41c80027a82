"""The JSON Schema beside the maps is current, valid, and takes what the loader takes."""

import json
from pathlib import Path

import jsonschema
import pytest
import yaml

from driveblocks.maps import schema
from driveblocks.maps.model import Drive
from driveblocks.maps.shape import EntryOf, ListOf, keys_of

ROOT = Path(__file__).parents[2]
MAPS = sorted((ROOT / "vendor_maps").glob("*.yaml")) + [ROOT / "tests/maps/example.yaml"]


def test_the_file_is_current() -> None:
    written = (ROOT / "vendor_maps/schema.json").read_text(encoding="utf-8")
    assert written == schema.text(), "run: driveblocks schema vendor_maps/schema.json"


def test_it_is_a_schema() -> None:
    jsonschema.Draft7Validator.check_schema(schema.schema())


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_a_good_map_passes(path: Path) -> None:
    data = yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)  # noqa: S506  (texts only, as editors see patterns)
    wrong = [e for e in jsonschema.Draft7Validator(schema.schema()).iter_errors(data) if e.validator != "enum"]
    assert [e.message for e in wrong] == []


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_a_good_map_passes_as_an_editor_reads_it(path: Path) -> None:
    data = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert [e.message for e in jsonschema.Draft7Validator(schema.schema()).iter_errors(data)] == []


def test_an_unknown_key_is_refused() -> None:
    data = yaml.safe_load((ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8"))
    data["colour"] = "red"
    assert any("colour" in e.message for e in jsonschema.Draft7Validator(schema.schema()).iter_errors(data))


def test_a_wrong_address_is_refused() -> None:
    data = yaml.safe_load((ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8"))
    data["sections"][0]["registers"][0]["address"] = "26h"
    assert list(jsonschema.Draft7Validator(schema.schema()).iter_errors(data))


def test_every_key_is_documented() -> None:
    seen: set[type] = set()
    todo: list[type] = [Drive]
    while todo:
        cls = todo.pop()
        seen.add(cls)
        for key in keys_of(cls).values():
            assert key.doc, f"{cls.__name__}.{key.name}"
            assert key.example, f"{cls.__name__}.{key.name}"
            shape = key.shape.item if isinstance(key.shape, ListOf) else key.shape
            if isinstance(shape, EntryOf) and shape.cls not in seen:
                todo.append(shape.cls)
    assert len(json.loads(schema.text())["definitions"]) == len(seen)
