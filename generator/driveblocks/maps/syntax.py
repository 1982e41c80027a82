"""What a complaint of PyYAML's own parser means to someone who writes a map."""

from dataclasses import dataclass

import yaml

from driveblocks.maps.problem import Place

Said = tuple[Place, str, str]
"""Where, what is wrong, what would be right."""


@dataclass(frozen=True)
class _Complaint:
    """A parser's complaint: `here` is where it gave up, `since` where what it was reading began."""

    context: str
    problem: str
    here: Place
    since: Place
    character: str


@dataclass(frozen=True)
class _Words:
    """Our words for complaints whose context and problem hold these parts; {0} is the character, {1} the line."""

    context: str
    problem: tuple[str, ...]
    wrong: str
    right: str
    at_start: bool = False
    """Whether the mistake is where the reading began."""
    at_end: bool = False
    """Only where the text ends."""


_QUOTE_IT = "quote a text that holds , : {{ }} [ ] and close every quote"
_NO_DIRECTIVE = ("YAML directives (%) are not allowed in a map", "remove the line that starts with %")
_NO_TAG = ("a tag is not allowed in a map", "quote a text that starts with !")
_WORDS = (
    _Words("", ("cannot start any token",), "`{0}` cannot start a value", "quote a text that starts with it"),
    _Words("", ("mapping values are not allowed",), "there is a colon where no key can be",
        "quote a text that holds a colon and a space; else check the indentation of this line"),
    _Words("block mapping", ("expected <block end>",), "this does not continue the mapping that begins in line {1}",
        "check the indentation of this line, and quotes that end too early"),
    _Words("block collection", ("",), "this does not continue the list that begins in line {1}",
        "start the line with `- ` in the column of the list, or check its indentation"),
    _Words("flow mapping", ("",), "a comma or `}}` is missing before this in the mapping that `{{` opens in line {1}",
        "write {{key: value, key: value}}; " + _QUOTE_IT),
    _Words("flow sequence", ("",), "a comma or `]` is missing before this in the list that `[` opens in line {1}",
        "write [a, b]; " + _QUOTE_IT),
    _Words("quoted scalar", ("end of stream", "document"), "this quote is never closed", "close it with the same",
        True),
    _Words("quoted scalar", ("escape",), "this text holds an escape that YAML does not know",
        "write two backslashes for one, or put the text in single quotes", True),
    _Words("simple key", ("expected ':'",), "this line has no colon", "write `key: value`, or indent the line", True),
    _Words("", ("node content",), "the text ends in the middle of a `[` or `{{`",
        "write what is missing, and close it", at_end=True),
    _Words("", ("node content",), "a value is missing before `{0}`", "write it, or quote a text that starts with {0}"),
    _Words("", ("sequence entries are not allowed",), "a list starts in the middle of a line",
        "write each `- ` at the start of its own line, or the list as [a, b]"),
    _Words("", ("mapping keys are not allowed",), "`?` cannot start a value", "quote a text that starts with it"),
    _Words("an alias", ("",), "`*` starts an alias, which a map cannot have", "quote a text that starts with *", True),
    _Words("an anchor", ("",), "`&` starts an anchor, which a map cannot have", "quote a text that starts with &",
        True),
    _Words("", ("undefined tag handle",), *_NO_TAG),
    _Words(" a tag", ("",), *_NO_TAG, True),
    _Words("block scalar", ("",), "a text begins on the line of its `|` or `>`", "begin it on the next line", True),
    _Words("directive", ("",), *_NO_DIRECTIVE, True),
    _Words("", ("incompatible YAML", "YAML directive", "duplicate tag handle"), *_NO_DIRECTIVE),
    _Words("", ("document start",), "this is outside the map", "a map has no lines that start with % or ..."),
)  # fmt: skip


def explain(error: yaml.YAMLError, text: str) -> Said:
    """Turn a parser's error about `text` into place, what is wrong, and what would be right."""
    said = _complaint(error, text)
    for words in _WORDS:
        if words.at_end and said.character:
            continue
        if words.context in said.context and any(part in said.problem for part in words.problem):
            place = said.since if words.at_start else said.here
            wrong, right = (part.format(said.character, said.since[0]) for part in (words.wrong, words.right))
            return place, wrong, right
    told = ", ".join(part for part in (said.context, said.problem) if part)
    return said.here, f"not YAML: {told}", "check the indentation, colons and quotes near here"


def _complaint(error: yaml.YAMLError, text: str) -> _Complaint:
    here, since = getattr(error, "problem_mark", None), getattr(error, "context_mark", None)
    at = here.index if here is not None else 0
    return _Complaint(
        getattr(error, "context", None) or "",
        getattr(error, "problem", None) or getattr(error, "reason", None) or "unreadable",
        _place(here or since),
        _place(since or here),
        text[at : at + 1],
    )


def _place(mark: yaml.Mark | None) -> Place:
    return (mark.line + 1, mark.column + 1) if mark is not None else (1, 1)
