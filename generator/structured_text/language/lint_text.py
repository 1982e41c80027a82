"""Rules about the text itself: comments, marks, and how declarations lie in a file."""

from structured_text.language.report import Report
from structured_text.language.tree import Configuration, Function, FunctionBlock, Program, TypeDecl, Unit

_COMMENTS = {
    "//": ("line-comment", "// is refused by matiec: write (* ... *)"),
    "/*": ("block-comment", "/* */ is refused by matiec and STruC++: write (* ... *)"),
    "{": ("pragma", "{...} breaks the C that matiec writes, and is refused elsewhere: leave it out"),
}
_NOTES = {
    "nested-comment": "a comment inside a comment is refused by matiec: remove the inner marks",
    "byte-order-mark": "a byte order mark is refused by matiec: save the file as UTF-8 without it",
    "missing-semicolon": "matiec wants a semicolon here: write END_...;",
    "stray-semicolon": "a semicolon is refused by matiec here: remove it",
}
_RULES = {"stray-semicolon": "empty-statement"}


def unit(unit: Unit, report: Report) -> None:
    """All rules about the text of one file."""
    for comment in unit.comments:
        found = _COMMENTS.get(comment.style)
        if found is not None:
            report.add(comment.at, *found)
    for note, at in unit.notes:
        report.add(at, _RULES.get(note, note), _NOTES[note])
    if not unit.elements:
        report.add(0, "empty-file", "matiec writes C that does not compile for a file without declarations")
    _types(unit, report)
    _configuration(unit, report)


def _types(unit: Unit, report: Report) -> None:
    """One type per TYPE, each ended by a semicolon."""
    last = 0
    for element in unit.elements:
        if not isinstance(element, TypeDecl):
            continue
        if element.block == last:
            text = f"IronPLC refuses a second type in one TYPE: give {element.name} a TYPE ... END_TYPE of its own"
            report.add(element.at, "several-types", text)
        last = element.block
        if not element.terminated:
            report.add(element.at, "missing-semicolon", "matiec wants a semicolon after END_STRUCT")


def _configuration(unit: Unit, report: Report) -> None:
    """A library file holds no CONFIGURATION."""
    parts = [each for each in unit.elements if isinstance(each, Function | FunctionBlock)]
    programs = [each for each in unit.elements if isinstance(each, Program)]
    for element in unit.elements:
        if isinstance(element, Configuration) and parts and not programs:
            text = "a library with a CONFIGURATION cannot be taken into a project: put it into a file of its own"
            report.add(element.at, "configuration-inside", text)
