"""The strict YAML of maps: mappings, lists and texts, each with its place; everything clever in YAML is refused."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

import yaml

from driveblocks.maps.problem import Place, Report

MAX_DEPTH = 16
MAX_NODES = 200_000
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass(frozen=True, slots=True)
class Scalar:
    """A text as written; `plain` tells that it stood without quotes."""

    text: str
    plain: bool
    at: Place


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

_TRAPS: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(pattern), reading)
    for pattern, reading in (
        (r"(?i:yes|no|on|off|y|n)", "YAML 1.1 reads it as TRUE or FALSE"),
        (r"(?i:true|false)(?<!true)(?<!false)", "YAML 1.1 reads it as TRUE or FALSE"),
        (r"~|(?i:null)", "YAML reads it as nothing at all"),
        (r"[-+]?0[0-7_]+", "YAML 1.1 reads it as an octal number"),
        (r"[-+]?0[0-9_]+", "some YAML readers take it as octal, some as decimal"),
        (r"[-+]?0o[0-7_]+", "YAML 1.2 reads it as an octal number"),
        (r"[-+]?0b[01_]+", "YAML 1.1 reads it as a binary number"),
        (r"[-+]?0[xX][0-9a-fA-F_]+", "YAML reads it as a number and the manual's digits are lost"),
        (r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?", "YAML 1.1 reads it as a number to base 60"),
        (r"[-+]?([0-9][0-9_]*\.?[0-9_]*|\.[0-9_]+)[eE][-+]?[0-9]+", "YAML reads it as a number with an exponent"),
        (r"[-+]?(\.[0-9_]+|[0-9][0-9_]*\.)", "YAML reads it as a number, though a digit is missing beside the point"),
        (r"[-+]?[0-9]+(_[0-9]*)+(\.[0-9_]*)?", "YAML 1.1 drops the underscore and reads a number"),
        (r"[-+]?\.(?i:inf)|\.(?i:nan)", "YAML reads it as infinity or not-a-number"),
        (r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt ].*)?", "YAML reads it as a date"),
        (r"=", "YAML 1.1 reads it as the default value marker"),
        (r"<<", "it is YAML's merge key"),
        (r"\+[0-9]+(\.[0-9]+)?", "YAML drops the plus sign"),
    )
)
_FIRST = re.compile(r"[-+.~=<0-9yYnNoOtTfF]")


def parse(text: str, report: Report) -> Node | None:
    """Return the root node, or None where the text is not YAML; mistakes go to the report."""
    parser = _LOADER(text)
    try:
        return _document(_Events(parser, report))
    except _StopError:
        return None
    except yaml.YAMLError as error:
        _syntax(error, report)
        return None
    finally:
        parser.dispose()


class _StopError(Exception):
    """Reading on makes no sense."""


class _Events:
    """The event stream with the limits on depth and number of nodes."""

    def __init__(self, parser: yaml.SafeLoader, report: Report) -> None:
        self.parser = parser
        self.report = report
        self.nodes = 0

    def next(self) -> yaml.Event:
        event: yaml.Event = self.parser.get_event()  # type: ignore[no-untyped-call]
        if isinstance(event, yaml.NodeEvent):
            self._guard(event)
        return event

    def place(self, event: yaml.Event) -> Place:
        mark = event.start_mark
        return (mark.line + 1, mark.column + 1) if mark else (1, 1)

    def _guard(self, event: yaml.NodeEvent) -> None:
        self.nodes += 1
        if self.nodes > MAX_NODES:
            self.stop(event, f"more than {MAX_NODES} values in one file", "a map describes one drive family")
        if isinstance(event, yaml.AliasEvent):
            self.stop(
                event,
                f"alias *{event.anchor} is not allowed in a map",
                "write the value out, so each line stands alone",
            )
        if event.anchor is not None:
            self.refuse(
                event, f"anchor &{event.anchor} is not allowed in a map", "write the value out where it is used"
            )
        tag = getattr(event, "tag", None)
        if tag is not None:
            self.refuse(event, f"tag {tag} is not allowed in a map", "remove it; the key decides the type")

    def refuse(self, event: yaml.Event, wrong: str, right: str) -> None:
        self.report.add(self.place(event), wrong, right)

    def stop(self, event: yaml.Event, wrong: str, right: str) -> NoReturn:
        self.refuse(event, wrong, right)
        raise _StopError


def _document(events: _Events) -> Node | None:
    events.next()  # the stream
    start = events.next()
    if isinstance(start, yaml.StreamEndEvent):
        events.stop(start, "the file is empty", "a map starts with `format: 1`")
    if getattr(start, "version", None) or getattr(start, "tags", None):
        events.refuse(start, "YAML directives (%) are not allowed in a map", "remove the line that starts with %")
    root = _node(events, events.next(), 0)
    events.next()  # the document's end
    more = events.next()
    if not isinstance(more, yaml.StreamEndEvent):
        events.stop(more, "a second YAML document starts here", "one file holds one map")
    return root


def _node(events: _Events, event: yaml.Event, depth: int) -> Node:
    if depth > MAX_DEPTH:
        events.stop(event, f"nested deeper than {MAX_DEPTH} levels", "no key of a map goes that deep")
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
            events.report.add(
                key.at, f"key `{key.text}` stands twice; the first is in line {first}", "keep one of them"
            )
        else:
            entries[key.text] = (key, value)
    return Entries(entries, events.place(start))


def _scalar(events: _Events, event: yaml.ScalarEvent) -> Scalar:
    plain = event.style is None or event.style == ""
    scalar = Scalar(event.value, plain, events.place(event))
    if plain and _FIRST.match(event.value):
        _refuse_trap(scalar, events.report)
    return scalar


def _refuse_trap(scalar: Scalar, report: Report) -> None:
    for pattern, reading in _TRAPS:
        if pattern.fullmatch(scalar.text):
            report.add(scalar.at, f"`{scalar.text}` without quotes is a trap: {reading}", _instead(scalar.text))
            return


def _instead(text: str) -> str:
    if re.fullmatch(r"0[xX][0-9a-fA-F]{1,4}", text):
        return f"write {text[2:].upper().zfill(4)}H for an address, or quote it"
    if re.fullmatch(r"[-+]?0[0-9]+", text):
        return f"write {int(text)}, or {text}H for hexadecimal, or quote it"
    return f'write "{text}" for a text; a number is written in plain decimal or with a trailing H'


def _syntax(error: yaml.YAMLError, report: Report) -> None:
    mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
    place = (mark.line + 1, mark.column + 1) if mark else (1, 1)
    problem = getattr(error, "problem", None) or getattr(error, "reason", None) or "unreadable"
    context = getattr(error, "context", None)
    said = f"{context}, {problem}" if context else str(problem)
    report.add(place, f"not YAML: {said}", "check the indentation, colons and quotes near here")
