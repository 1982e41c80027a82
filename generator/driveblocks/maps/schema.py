"""The JSON Schema of maps, made from the model, so that an editor completes and checks while one types."""

import json
from typing import Any

from driveblocks.maps import form
from driveblocks.maps.form import Form
from driveblocks.maps.model import Drive
from driveblocks.maps.shape import EntryOf, Key, ListOf, OneOf, Shape, keys_of

Schema = dict[str, Any]
_HEAD: Schema = {
    "$schema": "http://json-schema.org/draft-07/schema#",
    "title": "DriveBlocks vendor map",
    "description": "Written by `driveblocks schema`; the rules across a map are checked by `driveblocks check`.",
}


def text() -> str:
    """The schema file's text, the same on every machine."""
    return json.dumps(schema(), ensure_ascii=False, indent=1) + "\n"


def schema() -> Schema:
    """JSON Schema (draft 7) of a whole map."""
    definitions: dict[str, Schema] = {}
    root = _reference(Drive, definitions)
    return {**_HEAD, **root, "definitions": dict(sorted(definitions.items()))}


def _reference(cls: type, definitions: dict[str, Schema]) -> Schema:
    if cls.__name__ not in definitions:
        definitions[cls.__name__] = {}  # a class may hold itself
        definitions[cls.__name__] = _entry(cls, definitions)
    return {"$ref": f"#/definitions/{cls.__name__}"}


def _entry(cls: type, definitions: dict[str, Schema]) -> Schema:
    keys = keys_of(cls)
    return {
        "type": "object",
        "description": (cls.__doc__ or "").strip().splitlines()[0],
        "additionalProperties": False,
        "required": [key.name for key in keys.values() if key.required],
        "properties": {key.name: _property(key, definitions) for key in keys.values()},
    }


def _property(key: Key, definitions: dict[str, Schema]) -> Schema:
    described = {"description": f"{key.doc}. Example: {key.example}"}
    shape = _shape(key.shape, definitions)
    # draft 7 readers ignore what is beside a $ref
    return {**described, "allOf": [shape]} if "$ref" in shape else {**described, **shape}


def _shape(shape: Shape, definitions: dict[str, Schema]) -> Schema:
    if isinstance(shape, ListOf):
        return {"type": "array", "items": _shape(shape.item, definitions)}
    if isinstance(shape, EntryOf):
        return _reference(shape.cls, definitions)
    if isinstance(shape, OneOf):
        return {"enum": list(shape.words.values())}
    return _form(shape)


def _form(shape: Form) -> Schema:
    schema: Schema = {"pattern": f"^(?:{_plain(shape)})$"}
    if shape.numeric or shape in (form.ADDRESS, form.ADDRESSES):
        return {"type": ["string", "number"], **schema}
    return {"type": "string", **schema}


def _plain(shape: Form) -> str:
    """JSON Schema's regular expressions know no inline flags; by `numbering` an address may be the manual's number."""
    free = shape in (form.TEXT, form.ENGLISH)
    number = r"|[1-9][0-9]{0,5}(-[1-9][0-9]{0,5})?" if shape in (form.ADDRESS, form.ADDRESSES) else ""
    return r"\S([\s\S]*\S)?" if free else shape.pattern.pattern + number
