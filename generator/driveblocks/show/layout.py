"""The look of everything that `show` prints: tables, cards and headings that read well from 80 columns on."""

import re
from collections.abc import Iterable

from rich import box
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from driveblocks.maps.form import holds_chinese

_KANA = re.compile("[\u3040-\u30ff]")
OWN = "own"
"""The column of the manual's own words."""

LABEL = 12
"""Columns for the label of a line in a card."""

Line = tuple[str, object]
"""Label and content; a line whose content is None or empty is left out."""


def table(*columns: str, wide: Iterable[str] = (), numbers: Iterable[str] = ()) -> Table:
    """A table with a rule under its head; `wide` columns share what is left and fold, `numbers` are aligned right."""
    made = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, collapse_padding=True, header_style="bold")
    for column in columns:
        if column in wide:
            made.add_column(column, min_width=12, overflow="fold")
        else:
            made.add_column(column, no_wrap=True, justify="right" if column in numbers else "left")
    return made


def listing(columns: tuple[str, ...], rows: Iterable[tuple[str, ...]], wide: Iterable[str] = ()) -> Table:
    """A table with its rows; the column OWN has a head that fits its words, and is left out where it has none."""
    known = list(rows)
    words = [row[columns.index(OWN)] for row in known]
    kept = [at for at, column in enumerate(columns) if column != OWN or any(words)]
    heads = {OWN: own_head(words)}
    made = table(*(heads.get(columns[at], columns[at]) for at in kept), wide=[heads.get(one, one) for one in wide])
    for row in known:
        made.add_row(*(row[at] for at in kept))
    return made


def own_head(words: Iterable[str]) -> str:
    """What is above the manual's own words."""
    text = "".join(words)
    return "中文" if holds_chinese(text) and not _KANA.search(text) else "as printed"


def card(title: str, *lines: Line) -> RenderableType:
    """A title and below it labelled lines that fold beside their label."""
    return Group(Text(title, style="bold"), Padding(facts(*lines), (0, 0, 1, 2)))


def facts(*lines: Line) -> Table:
    """Labelled lines without a title."""
    grid = Table.grid(padding=(0, 2, 0, 0))
    grid.add_column(style="dim", width=LABEL, no_wrap=True)
    grid.add_column(overflow="fold")
    for label, content in lines:
        if content not in (None, "", ()):
            grid.add_row(label, content if isinstance(content, Table | Text) else str(content))
    return grid


def choices(rows: Iterable[tuple[str, ...]]) -> Table | None:
    """Codes with their meaning in English and as printed, to be shown beside a label; None without any."""
    grid = Table.grid(padding=(0, 2, 0, 0))
    grid.add_column(no_wrap=True, justify="right")
    for row in rows:
        grid.add_row(*row)
    return grid if grid.row_count else None


def heading(text: str) -> Text:
    return Text(f"\n{text}", style="bold underline")


def both(en: str | None, zh: str | None) -> str:
    """A text in English and as printed, side by side; once where they are the same."""
    return "  ".join(dict.fromkeys(text for text in (en, zh) if text))


def listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def code_text(code: int) -> str:
    """A code as the manuals print it: 30 -> 1EH."""
    return f"{code:02X}H"
