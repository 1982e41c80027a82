"""The shape of the model's classes, read once from their type hints: shared by the decoder, the schema and the docs."""

import dataclasses
import types
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from driveblocks.maps import form
from driveblocks.maps.form import Form
from driveblocks.maps.model import Cited, Trusted


@dataclass(frozen=True)
class OneOf:
    """One of a closed list of words or small numbers."""

    words: dict[str, Any]


@dataclass(frozen=True)
class ListOf:
    item: "Shape"


@dataclass(frozen=True)
class EntryOf:
    """A mapping that becomes an instance of a model class."""

    cls: type


Shape = Form | OneOf | ListOf | EntryOf


@dataclass(frozen=True)
class Key:
    name: str
    shape: Shape
    required: bool
    doc: str
    example: str


_PLAIN: dict[Any, Shape] = {bool: OneOf({"true": True, "false": False}), str: form.TEXT}


@cache
def keys_of(cls: type) -> dict[str, Key]:
    """The keys of a model class in order. Raises TypeError for a type hint that a map cannot hold."""
    hints = get_type_hints(cls, include_extras=True)
    keys: dict[str, Key] = {}
    for item in dataclasses.fields(cls):
        if "doc" not in item.metadata:
            continue
        required = item.default is dataclasses.MISSING and item.default_factory is dataclasses.MISSING
        meta = item.metadata
        keys[item.name] = Key(item.name, shape_of(hints[item.name]), required, meta["doc"], meta["example"])
    return {name: keys[name] for name in sorted(keys, key=told_last(cls).__contains__)}


def told_last(cls: type) -> frozenset[str]:
    """The keys that a model class has as every other that is cited."""
    bases = [base for base in (Trusted, Cited) if issubclass(cls, base)]
    return frozenset(item.name for base in bases for item in dataclasses.fields(base) if "doc" in item.metadata)


@cache
def required_of(cls: type) -> tuple[Key, ...]:
    """The keys of a model class that may not be left out."""
    return tuple(key for key in keys_of(cls).values() if key.required)


def shape_of(hint: Any) -> Shape:
    """The shape that a type hint describes. Raises TypeError."""
    origin = get_origin(hint)
    if origin is Annotated:
        return next(extra for extra in get_args(hint)[1:] if isinstance(extra, Form))
    if origin is Literal:
        return OneOf({str(word): word for word in get_args(hint)})
    if origin is tuple:
        return ListOf(shape_of(get_args(hint)[0]))
    if origin in (Union, types.UnionType):
        return shape_of(next(arg for arg in get_args(hint) if arg is not type(None)))
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return EntryOf(hint)
    if hint not in _PLAIN:
        raise TypeError(f"a map cannot hold {hint!r}")
    return _PLAIN[hint]
