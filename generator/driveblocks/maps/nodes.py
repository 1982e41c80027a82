"""The strict YAML of maps: mappings, lists and texts, each with its place; everything clever in YAML is refused."""

import contextlib
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, NoReturn

import yaml

from driveblocks.maps import syntax, trap
from driveblocks.maps.problem import MapError, Place, Report
from driveblocks.maps.source import HIDDEN

MAX_DEPTH = 16
MAX_NODES = 30_000
"""A map of 400 registers has some 6000."""
MAX_TEXT = 4000
"""Characters of one value."""
_LIBYAML: Any = getattr(yaml, "CSafeLoader", None)
"""The parser in C, many times as fast; None where PyYAML came without it."""
_EDGE = re.compile(HIDDEN.pattern + r"""|[?]|\\(?!["\\])|^%|[|>][-+0-9]*#|[^\n]\Z""", re.MULTILINE)
"""What libyaml reads otherwise than PyYAML's own parser, or may: see tests/maps/agreement.py."""


class Scalar(NamedTuple):
    """A text as written; `plain`: it was written without quotes, `refused`: its mistake is noted."""

    text: str
    plain: bool
    at: Place
    refused: bool = False


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    items: "tuple[Node, ...]"
    at: Place


@dataclass(frozen=True, slots=True)
class Entries:
    """A mapping: keys with their places, in file order, each key once."""

    entries: "dict[str, tuple[Scalar, Node]]"
    at: Place


Node = Scalar | Items | Entries


def told(key: str, node: Node) -> Iterator[str]:
    """What a key says, anywhere in a tree."""
    if isinstance(node, Items):
        yield from (word for row in node.items for word in told(key, row))
    elif isinstance(node, Entries):
        for name, (_, value) in node.entries.items():
            yield from [value.text] if name == key and isinstance(value, Scalar) else told(key, value)


def parse(text: str, report: Report, *, quick: bool = True, most: int = MAX_NODES) -> Node | None:
    """Return the root node, or None where the text is not YAML; mistakes go to the report. `most`: its values.

    libyaml reads only what both parsers read alike, and only while nothing is wrong; not `quick`: nothing. All else,
    and every complaint, comes from PyYAML's own parser, so that a map means the same, and gets the same messages, on
    every machine.
    """
    if "\t" in text:
        _tabs(text, report)
        return None
    root = _quickly(text, most) if quick else None
    return _read(yaml.SafeLoader, text, report, most) if root is None else root


def _quickly(text: str, most: int = MAX_NODES) -> Node | None:
    """What libyaml reads in a text; None where PyYAML's own parser has to say it."""
    report = Report("")
    if _LIBYAML is None or _EDGE.search(text):
        return None
    with contextlib.suppress(MapError):
        root = _read(_LIBYAML, text, report, most)
        return None if report.problems else root
    return None


def _read(loader: Any, text: str, report: Report, most: int) -> Node | None:
    parser = None
    try:
        parser = loader(text)
        return _document(_Events(parser, text, report, most))
    except _StopError:
        return None
    except yaml.YAMLError as error:
        report.add(*syntax.explain(error, text))
        return None
    except (ValueError, OverflowError):  # an escape beyond Unicode, a version of 5000 digits
        report.add((1, 1), "not YAML: a number in it is out of all bounds", "write plain characters, no \\U escapes")
        return None
    finally:
        if parser is not None:
            parser.dispose()


def _tabs(text: str, report: Report) -> None:
    for number, line in enumerate(text.split("\n"), 1):
        if "\t" in line:
            report.add(
                (number, line.index("\t") + 1), "there is a tab here", "YAML is indented with spaces; write spaces"
            )


class _StopError(Exception):
    """Reading on makes no sense."""


class _Events:
    """The event stream with the limits on depth and number of nodes."""

    def __init__(self, parser: yaml.SafeLoader, text: str, report: Report, most: int) -> None:
        self.get: Callable[[], yaml.Event] = parser.get_event
        self.text = text
        self.report = report
        self.nodes, self.most = 0, most
        self.quick = not isinstance(parser, yaml.SafeLoader)

    def next(self) -> yaml.Event:
        event: yaml.Event = self.get()
        if isinstance(event, yaml.NodeEvent):
            self.nodes += 1
            if self.nodes > self.most:
                self.stop(event, f"more than {self.most} values in one file", "a map describes one drive family")
            if event.anchor is not None or getattr(event, "tag", None) is not None:
                self._clever(event)
        return event

    def place(self, event: yaml.Event) -> Place:
        mark = event.start_mark
        return (mark.line + 1, mark.column + 1) if mark else (1, 1)

    def _clever(self, event: yaml.NodeEvent) -> None:
        """Refuse what a person does not see by reading one line: aliases, anchors, tags."""
        if isinstance(event, yaml.AliasEvent):
            wrong = f"alias *{_short(event.anchor)} is not allowed in a map"
            self.stop(event, wrong, "write the value out, so each line is complete")
        if event.anchor is not None:
            wrong = f"anchor &{_short(event.anchor)} is not allowed in a map"
            self.refuse(event, wrong, "write the value out where it is used")
        tag = getattr(event, "tag", None)
        if tag is not None:
            wrong = f"tag {_short(tag.replace('tag:yaml.org,2002:', '!!'))} is not allowed in a map"
            self.refuse(event, wrong, "remove it; the key decides the type")

    def refuse(self, event: yaml.Event, wrong: str, right: str) -> None:
        self.report.add(self.place(event), wrong, right)

    def stop(self, event: yaml.Event, wrong: str, right: str) -> NoReturn:
        self.refuse(event, wrong, right)
        raise _StopError


def _short(text: str | None) -> str:
    text = text or ""
    return text if len(text) <= 60 else text[:57] + "..."


def _document(events: _Events) -> Node | None:
    events.next()  # the stream
    start = events.next()
    if isinstance(start, yaml.StreamEndEvent):
        events.stop(start, "the file is empty", "a map starts with `format: 2`")
    _directives(events, start)
    root = _node(events, events.next(), 0)
    events.next()  # the document's end
    more = events.next()
    if not isinstance(more, yaml.StreamEndEvent):
        events.stop(more, "a second YAML document starts here", "one file holds one map")
    return root


def _directives(events: _Events, start: yaml.Event) -> None:
    # an unknown directive shows only in the text: parsers skip it
    mark = start.start_mark
    if getattr(start, "explicit", False) and mark is not None and events.text.startswith("%", mark.index):
        events.refuse(start, "YAML directives (%) are not allowed in a map", "remove the line that starts with %")


def _node(events: _Events, event: yaml.Event, depth: int) -> Node:
    if depth > MAX_DEPTH:
        events.stop(event, f"nested deeper than {MAX_DEPTH} levels", "no key of a map is that deep")
    if isinstance(event, yaml.ScalarEvent):
        return _scalar(events, event)
    if isinstance(event, yaml.SequenceStartEvent):
        return Items(tuple(_items(events, depth)), events.place(event))
    return _entries(events, event, depth)


def _items(events: _Events, depth: int) -> Iterator[Node]:
    while not isinstance(event := events.next(), yaml.SequenceEndEvent):
        yield _node(events, event, depth + 1)


def _entries(events: _Events, start: yaml.Event, depth: int) -> Entries:
    entries: dict[str, tuple[Scalar, Node]] = {}
    while not isinstance(event := events.next(), yaml.MappingEndEvent):
        if not isinstance(event, yaml.ScalarEvent):
            events.stop(event, "a key must be one word", "write `key: value`; quote a text that starts with [ or {")
        key = _scalar(events, event)
        value = _node(events, events.next(), depth + 1)
        if key.text in entries:
            first = entries[key.text][0].at[0]
            wrong = f"key `{_short(key.text)}` is there twice; the first is in line {first}"
            events.report.add(key.at, wrong, "keep one of them")
        else:
            entries[key.text] = (key, value)
    return Entries(entries, events.place(start))


def _scalar(events: _Events, event: yaml.ScalarEvent) -> Scalar:
    text: str = event.value
    plain = event.style is None or event.style == ""
    if events.quick and plain and not text:  # a value that is left out: the parsers do not agree on its place
        raise _StopError
    refused = _refuse_trap(events, event, text) if plain else _refuse_escape(events, event, text)
    if len(text) > MAX_TEXT:
        events.refuse(event, f"a value of {len(text)} characters", f"one value has at most {MAX_TEXT}")
        return Scalar(text[:MAX_TEXT], plain, events.place(event), refused=True)
    return Scalar(text, plain, events.place(event), refused)


def _refuse_trap(events: _Events, event: yaml.ScalarEvent, text: str) -> bool:
    found = trap.find(text)
    if found is not None:
        events.refuse(event, f"`{text}` without quotes is a trap: {found.reading}", found.instead(text))
    return found is not None


def _refuse_escape(events: _Events, event: yaml.ScalarEvent, text: str) -> bool:
    hidden = HIDDEN.search(text) if event.style == '"' else None
    if hidden is not None:
        wrong = f"an escape puts the invisible character U+{ord(hidden[0]):04X} into this text"
        events.refuse(event, wrong, "write what can be seen")
    return hidden is not None
