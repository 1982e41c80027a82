"""The JSON of a map: its shape, its values, and that nothing of the map is left out."""

import dataclasses
import json
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from driveblocks.maps import catalog, view
from driveblocks.maps.form import Span
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive, Entry
from driveblocks.maps.shape import keys_of

EXAMPLE = Path(__file__).with_name("example.yaml")
COILS = Path(__file__).parent / "bad/coils.yaml"
"""A good map of coils, from which the bad ones of their rules are made."""

_TEXT = {"type": "string"}
_COUNT = {"type": "integer", "minimum": 0}
_BIT = {"type": "integer", "minimum": 0, "maximum": 15}
_BYTES = {"type": "string", "pattern": "^[0-9A-F]{2}( [0-9A-F]{2})*$"}


def _objects(**properties: Any) -> dict[str, Any]:
    item = {"type": "object", "properties": properties, "required": list(properties)}
    return {"type": "array", "items": item}


SHAPE = {
    "type": "object",
    "required": ["drive", "registers", "faults", "errors", "frames", "errata", "absent", "serial", "limits"],
    "properties": {
        "drive": _TEXT,
        "registers": _objects(
            address={"type": "integer", "minimum": 0, "maximum": 0xFFFF},
            id=_TEXT,
            name=_TEXT,
            name_zh=_TEXT,
            text_zh=_TEXT,
            access={"enum": ["r", "w", "rw"]},
            unit={"type": ["string", "null"]},
            scale={"type": ["number", "null"]},
            bits=_objects(bit=_BIT, name=_TEXT, name_zh=_TEXT, width=_COUNT),
            enum=_objects(value={"type": "integer"}, name=_TEXT, name_zh=_TEXT),
            section=_TEXT,
            source=_TEXT,
        ),
        "faults": _objects(code=_COUNT, id=_TEXT, name=_TEXT, name_zh=_TEXT, text_zh=_TEXT),
        "errors": _objects(code={"type": ["integer", "null"]}, name=_TEXT, name_zh=_TEXT),
        "frames": _objects(
            direction={"enum": ["request", "reply"]}, mode={"enum": ["rtu", "ascii"]}, printed=_BYTES, correct=_BYTES
        ),
        "errata": _objects(
            where=_TEXT, printed=_TEXT, used=_TEXT, why=_TEXT, confidence={"enum": ["certain", "likely", "open"]}
        ),
        "absent": _objects(what=_TEXT, matters=_TEXT, find_out=_TEXT),
        "serial": {"type": "object"},
        "limits": {"type": "object", "additionalProperties": {"type": ["integer", "object"]}},
    },
}  # fmt: skip


@pytest.fixture(scope="module")
def drive() -> Drive:
    """The example map."""
    return load(EXAMPLE)


@pytest.fixture(scope="module")
def seen(drive: Drive) -> dict[str, Any]:
    """The example map as a script reads it."""
    seen: dict[str, Any] = json.loads(json.dumps(view.of_drive(drive, "example")))
    return seen


@pytest.mark.parametrize("path", [EXAMPLE, COILS, *catalog.shipped()], ids=lambda path: path.stem)
def test_every_map_has_the_published_shape(path: Path) -> None:
    jsonschema.validate(view.of_drive(load(path), path.stem), SHAPE)


def _register(seen: dict[str, Any], address: int) -> dict[str, Any]:
    (found,) = (register for register in seen["registers"] if register["address"] == address)
    return dict(found)


def test_an_address_is_what_is_sent_and_its_table_is_beside_it() -> None:
    seen = view.of_drive(load(COILS), "coils")
    places = {(one.get("space", "holding"), one["address"]) for one in seen["registers"]}
    assert {space for space, _ in places} == {"holding", "input", "coil"}
    for command in seen["operation"]["commands"]:
        assert (command["space"], command["register"]) in places
        for step in command.get("first", ()):
            assert (step["space"], step["register"]) in places


def test_a_range_comes_out_as_one_register_each(seen: dict[str, Any]) -> None:
    run = [_register(seen, address) for address in range(0x0106, 0x010A)]
    assert [one["id"] for one in run] == ["A2-01", "A2-02", "A2-03", "A2-04"]
    assert {one["name"] for one in run} == {"User parameter"}


def test_a_register_without_an_id_has_an_empty_one(seen: dict[str, Any]) -> None:
    assert _register(seen, 0x0000)["id"] == ""


def test_access_comes_from_the_section_unless_the_row_says_otherwise(seen: dict[str, Any]) -> None:
    assert [_register(seen, address)["access"] for address in (0x0001, 0x0002, 0x0010)] == ["rw", "w", "r"]


def test_a_scale_is_a_number_with_its_source_and_condition_beside_it(seen: dict[str, Any]) -> None:
    reference = _register(seen, 0x0001)
    assert (reference["unit"], reference["scale"], reference["signed"]) == ("%", 0.01, True)
    assert reference["scale_from"]["when"] == {"register": 0x000F, "bit": {"first": 0, "last": 0}, "equals": 0}
    assert (_register(seen, 0x0020)["unit"], _register(seen, 0x0020)["scale"]) == ("Hz", None)


def test_fields_have_a_lowest_bit_and_a_width_and_holes_stand_apart(seen: dict[str, Any]) -> None:
    command = _register(seen, 0x0000)
    assert [(bit["bit"], bit["width"]) for bit in command["bits"]] == [(0, 1), (1, 1), (2, 1), (3, 1), (8, 2)]
    assert command["unused_bits"] == [4, 5, 6, 7, 10, 11, 12, 13, 14, 15]
    assert [value["value"] for value in command["bits"][-1]["values"]] == [0, 1, 2]


def test_a_mask_register_has_its_values_both_as_enum_and_as_bits(seen: dict[str, Any]) -> None:
    line = _register(seen, 0x0012)
    assert [(one["value"], one["name"]) for one in line["enum"]] == [
        (1, "CRC error"),
        (2, "Wrong length"),
        (4, "Overrun"),
    ]
    assert [(one["bit"], one["name"]) for one in line["bits"]] == [
        (0, "CRC error"),
        (1, "Wrong length"),
        (2, "Overrun"),
    ]


def test_chinese_comes_as_printed_and_as_it_should_read(seen: dict[str, Any]) -> None:
    voltage = _register(seen, 0x0023)
    assert (voltage["name_zh"], voltage["text_zh"]) == ("输出电压", "直流电压")
    overspeed = next(fault for fault in seen["faults"] if fault["id"] == "OS")
    assert (overspeed["code"], overspeed["name_zh"], overspeed["text_zh"]) == (0x11, "起速", "超速")


def test_unused_addresses_are_marked(seen: dict[str, Any]) -> None:
    unused = [one["address"] for one in seen["registers"] if one["unused"]]
    assert unused == [*range(0x0003, 0x000F), 0x0013]


def test_an_ascii_frame_is_the_hex_of_its_characters(seen: dict[str, Any]) -> None:
    frame = next(one for one in seen["frames"] if one["id"] == "run_reply")
    assert bytes.fromhex(frame["correct"]) == b":011000000002ED\r\n"


def test_a_wrong_checksum_stays_as_printed(seen: dict[str, Any]) -> None:
    frame = next(one for one in seen["frames"] if one["checksum"] == "wrong")
    assert (frame["printed"][-5:], frame["correct"][-5:]) == ("D4 9A", "D5 5C")


def test_an_error_without_code_has_null(seen: dict[str, Any]) -> None:
    assert [error["code"] for error in seen["errors"]] == [1, 2, 5, None]


def test_limits_are_numbers_with_their_sources(seen: dict[str, Any]) -> None:
    assert seen["limits"]["read_words"] == 16
    assert seen["limits"]["sources"]["read_words"] == "section 9.4, command 03H"


def test_serial_codes_are_there(seen: dict[str, Any]) -> None:
    assert seen["serial"]["baud"]["codes"][2] == {"code": 2, "baud": 19200}


def _changed(value: Any) -> Any:
    """Another value of the same type."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | Decimal):
        return value + 1
    if isinstance(value, Span):
        return Span(value.first + 1, value.last + 1)
    return value + (b"\x00" if isinstance(value, bytes) else "~")


def _variants(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Copies of a part of the model, each with one leaf changed; named by the class and key of the leaf."""
    if isinstance(value, Entry):
        cls: type = type(value)
        for key in keys_of(cls):
            for place, changed in _variants(getattr(value, key), f"{cls.__name__}.{key}"):
                yield place, dataclasses.replace(value, **{key: changed})
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            for place, changed in _variants(item, name):
                yield place, (*value[:index], changed, *value[index + 1 :])
    elif value is not None:
        yield name, _changed(value)


@pytest.mark.thorough
def test_whatever_changes_in_a_map_changes_its_json() -> None:
    """One change for each key that a map uses, wherever it first stands; the smallest map comes first."""
    tried: set[str] = set()
    for path in sorted([EXAMPLE, *catalog.shipped()], key=lambda path: path.stat().st_size):
        drive = load(path)
        original = view.of_drive(drive, path.stem) | {"revision": ""}  # which any change alters
        for place, changed in _variants(drive, "Drive"):
            if place not in tried:
                # of addresses with a RAM bit; without such addresses it says nothing
                lost = place == "Storage.readable" and drive.storage.add is None
                lost |= place in ("Drive.base", "Drive.without")  # whose facts are all there
                said = view.of_drive(changed, path.stem) | {"revision": ""}
                assert (said == original) is lost, place
                tried |= set() if lost else {place}
    assert len(tried) > 120
