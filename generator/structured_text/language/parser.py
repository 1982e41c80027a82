"""A source file -> its tree; everything that is wrong is reported at once."""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence

from structured_text.language.collector import paused
from structured_text.language.grammar.cursor import Cursor, TooManyProblemsError
from structured_text.language.grammar.elements import parsed_elements
from structured_text.language.lexer import tokenize
from structured_text.language.problems import Problem, SourceError
from structured_text.language.tree import Element, Unit, Unsupported, VarBlock, line_starts


class ParseError(SourceError):
    """The text is no Structured Text; `unit` holds those elements of it that are whole."""

    def __init__(self, problems: Sequence[Problem], unit: Unit) -> None:
        super().__init__(problems)
        self.unit = unit


def parse(text: str, path: str) -> Unit:
    """Parse a file that messages name by `path`. Raises ParseError with every problem found, in order of place."""
    with paused():
        return _parsed(text, path)


def _parsed(text: str, path: str) -> Unit:
    """As `parse`."""
    tokens = tokenize(text)
    cursor = Cursor(tokens)
    elements: list[Element] = []
    try:
        elements = parsed_elements(cursor)
    except TooManyProblemsError:
        cursor.problems.append((len(text), "too many problems: the rest is not shown", "syntax"))
    wrong = sorted(cursor.problems)
    whole = _whole(elements, [at for at, _, _ in wrong], tokens.ats) if wrong else elements
    unit = Unit(path, text, whole, tokens.comments, line_starts(text), tokens.notes)
    for element in whole:
        if not isinstance(element, VarBlock | Unsupported) and hasattr(element, "unit"):
            element.unit = unit
    if wrong:
        raise ParseError([Problem(path, *unit.place(at), said, rule) for at, said, rule in wrong], unit)
    return unit


def _whole(elements: list[Element], wrong: list[int], ats: list[int]) -> list[Element]:
    """The elements without a mistake, which may also be noticed at the token after them."""

    def torn(element: Element) -> bool:
        behind = ats[min(bisect_left(ats, element.end), len(ats) - 1)]
        return bisect_right(wrong, element.at) < bisect_right(wrong, behind)

    return [element for element in elements if not torn(element)]
