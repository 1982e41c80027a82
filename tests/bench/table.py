"""Text of the page: tables and paragraphs of Markdown, figures with the digits that a measurement deserves."""

import textwrap
from collections.abc import Sequence

WIDTH = 118


def prose(text: str) -> list[str]:
    """Paragraphs, wrapped anew; an empty line parts them, and one that begins with `- ` is an item of a list."""
    lines: list[str] = []
    for paragraph in textwrap.dedent(text).strip().split("\n\n"):
        words = " ".join(paragraph.split())
        item = words.startswith("- ")
        if lines and not (item and lines[-1].startswith(("- ", "  "))):
            lines.append("")
        indent = "  " if item else ""
        lines += textwrap.wrap(words, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return [*lines, ""]


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """A Markdown table: words to the left in the first column, figures to the right in the others."""
    marks = ["---", *("---:" for _ in heads[1:])]
    return [_row(heads), _row(marks), *(_row(row) for row in rows), ""]


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def short(figure: float | None) -> str:
    """Three digits: 4.81, 20.6, 877, 12,300; a small count as it is; a dash for none."""
    if figure is None:
        return "-"
    if isinstance(figure, int) and figure < 1000:
        return str(figure)
    for limit, digits in ((10, 2), (100, 1)):
        if figure < limit:
            return f"{figure:.{digits}f}"
    return f"{float(f'{figure:.3g}'):,.0f}"


def whole(figure: float | None) -> str:
    """A count: 1,603; a dash for none."""
    return "-" if figure is None else f"{int(figure):,}"


def times(figure: float, of: float) -> str:
    """A ratio: 1.66 x."""
    return f"{short(figure / of)} x"
