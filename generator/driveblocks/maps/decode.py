"""Nodes -> model: every key known, every value in its form, every mistake noted with its place, all at once."""

import difflib
import re
from typing import Any

from driveblocks.maps import form
from driveblocks.maps.form import Form
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.older import INSTEAD
from driveblocks.maps.problem import Report
from driveblocks.maps.shape import EntryOf, Key, ListOf, OneOf, Shape, keys_of, required_of

_NUMERIC = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?")
_BAD: Any = object()
"""The mark of a wrong value. What cannot do without it is not built; a list is built without its bad entries."""


def decode(cls: type, node: Node, report: Report) -> Any | None:
    """Build an instance of a model class from a node, noting every mistake.

    What could be read is built all the same, so that the rules can be tried on it; None when too little is left.
    """
    value = _entry(EntryOf(cls), node, report, "the map")
    return None if value is _BAD else value


def build(shape: Shape, node: Node, report: Report, name: str) -> Any:
    """Build one value of a shape; a wrong one is noted and becomes a mark that nothing accepts."""
    if isinstance(shape, EntryOf):
        return _entry(shape, node, report, name)
    if isinstance(shape, ListOf):
        return _list(shape, node, report, name)
    if not isinstance(node, Scalar):
        report.add(node.at, f"`{name}` is {_kind(node)}", f"it must be one value: {_right(shape)}")
        return _BAD
    if node.refused:
        return _BAD
    if isinstance(shape, OneOf):
        return _one_of(shape, node, report, name)
    return _formed(shape, node, report, name)


def _kind(node: Node) -> str:
    if isinstance(node, Scalar):
        return "one value" if node.text or not node.plain else "empty"
    return "a list" if isinstance(node, Items) else "a mapping"


def _right(shape: Form | OneOf) -> str:
    return shape.right if isinstance(shape, Form) else "write one of " + ", ".join(shape.words)


def _list(shape: ListOf, node: Node, report: Report, name: str) -> Any:
    if not isinstance(node, Items):
        report.add(node.at, f"`{name}` is {_kind(node)}", "it must be a list: lines that start with `- `, or [a, b]")
        return _BAD
    values = [build(shape.item, item, report, name) for item in node.items]
    good = tuple(value for value in values if value is not _BAD)
    # a list of entries can do without one; words or bytes would move up into its place
    return good if len(good) == len(values) or isinstance(shape.item, EntryOf) else _BAD


def _one_of(shape: OneOf, node: Scalar, report: Report, name: str) -> Any:
    if node.text in shape.words:
        return shape.words[node.text]
    if node.plain and not node.text:
        report.add(node.at, f"`{name}` has no value", _right(shape))
        return _BAD
    near = nearest(node.text, list(shape.words))
    right = INSTEAD.get((name, node.text)) or (f"did you mean `{near}`?" if near else _right(shape))
    report.add(node.at, f"`{name}: {_short(node.text)}` is not allowed", right)
    return _BAD


def _formed(shape: Form, node: Scalar, report: Report, name: str) -> Any:
    if node.plain and not node.text:
        report.add(node.at, f"`{name}` has no value", shape.right)
        return _BAD
    if shape.pattern.fullmatch(node.text) is None:
        right = _address(node.text) if shape in (form.ADDRESS, form.ADDRESSES) else ""
        report.add(node.at, f"`{name}: {_short(node.text)}` is not {_article(shape.name)}", right or shape.right)
        return _BAD
    if shape is form.ENGLISH and form.holds_chinese(node.text):
        report.add(node.at, f"`{name}` holds Chinese: the translation is missing", shape.right)
        return _BAD
    if shape in (form.TEXT, form.ENGLISH) and node.plain and _NUMERIC.fullmatch(node.text):
        report.add(node.at, f"`{name}` is a text, but {node.text} without quotes is a number", f'write "{node.text}"')
        return _BAD
    return shape.parse(node.text)


def _address(text: str) -> str:
    """What digits alone may mean; empty where they cannot be an address."""
    if not re.fullmatch("[0-9]{1,5}", text) or int(text) > 0xFFFF:
        return ""
    digits = f"{text:0>4}H if the manual's digits are hexadecimal, " if len(text) <= 4 else ""
    return f"write {digits}{form.address_text(int(text))} if they are decimal"


def _article(name: str) -> str:
    return f"an {name}" if name[0] in "aeiouE" else f"a {name}"


def _short(text: str) -> str:
    flat = " ".join(text.split())
    return flat if len(flat) <= 40 else flat[:37] + "..."


def _entry(shape: EntryOf, node: Node, report: Report, name: str) -> Any:
    if not isinstance(node, Entries):
        keys = ", ".join(key.name for key in required_of(shape.cls)) or "among " + ", ".join(keys_of(shape.cls))
        report.add(node.at, f"`{name}` is {_kind(node)}", f"it must be a mapping with the keys {keys}")
        return _BAD
    known = keys_of(shape.cls)
    meant = _unknown_keys(known, node, report, name)
    places = {key: value.at for key, (_, value) in node.entries.items() if key in known}
    values = {key: build(known[key].shape, node.entries[key][1], report, key) for key in places}
    good = {key: value for key, value in values.items() if value is not _BAD}
    lacking = [key for key in required_of(shape.cls) if key.name not in good]
    for key in lacking:
        if key.name not in meant and key.name not in places:
            report.add(node.at, f"`{name}` has no `{key.name}`", f"add `{key.name}`: {key.doc}, such as {key.example}")
    return _BAD if lacking else shape.cls(at=node.at, keys=places, **good)


def _unknown_keys(known: dict[str, Key], node: Entries, report: Report, name: str) -> set[str]:
    """Note the keys that the format does not have; return those of the format that were probably meant."""
    meant: set[str] = set()
    for text in node.entries.keys() - known.keys():
        key = node.entries[text][0]
        if key.refused:
            continue
        near = nearest(text, [word for word in known if word not in node.entries])
        right = f"did you mean `{near}`?" if near else "known keys: " + ", ".join(known)
        value = node.entries[text][1]
        if " " in text and isinstance(value, Scalar) and value.plain and not value.text:
            right = "a comma ends a value inside { }; put the whole text into quotes"
        report.add(key.at, f"unknown key `{_short(text)}` in `{name}`", right)
        meant.add(near or "")
    return meant


def nearest(text: str, words: list[str]) -> str | None:
    """The word that was probably meant."""
    near = difflib.get_close_matches(text[:40].lower(), words, 1, 0.6)
    return near[0] if near else None
