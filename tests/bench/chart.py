"""Pictures of figures: horizontal bars in groups, as SVG that reads on light and on dark pages."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from xml.sax.saxutils import escape

WIDTH = 760
LEFT = 250
"""Where bars begin; labels end a little before."""
LONGEST = 350
"""Length of the longest bar; its text follows it."""
ROW, HEAD, GAP, MARGIN = 22, 26, 10, 16
CHARACTER = 7.2
"""Most that a character of 13 pixels takes, on average over a word."""
STYLE = """text { font: 13px system-ui, sans-serif; fill: #24292f }
.head { font-weight: 600 }
.page { fill: #ffffff; stroke: #d0d7de }
.c { fill: #8c959f }
.ours { fill: #0969da }
.other { fill: #bc6c00 }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3 }
.page { fill: #0d1117; stroke: #30363d }
.c { fill: #848d97 }
.ours { fill: #4493f8 }
.other { fill: #d29922 }
}"""


@dataclass(frozen=True)
class Bar:
    """One bar: what it is, how long, the text after it, and of which kind: a key of the chart's legend."""

    label: str
    value: float
    text: str
    kind: str


@dataclass(frozen=True)
class Group:
    """Bars that are compared with each other."""

    title: str
    bars: tuple[Bar, ...]


@dataclass(frozen=True)
class Chart:
    """A picture: title, what a length means, groups on one scale, kind (`c`, `ours`, `other`) -> its word."""

    title: str
    axis: str
    groups: tuple[Group, ...]
    legend: dict[str, str]
    logarithmic: bool = False


def svg(chart: Chart) -> str:
    """The picture as text of an SVG file. Raises ValueError for a bar that is not longer than nothing."""
    body = list(_body(chart))
    height = MARGIN + 2 * HEAD + sum(HEAD + ROW * len(group.bars) + GAP for group in chart.groups) + MARGIN
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" '
        'role="img">',
        f"<title>{escape(chart.title)}</title>",
        f"<style>{STYLE}</style>",
        f'<rect class="page" x="0.5" y="0.5" width="{WIDTH - 1}" height="{height - 1}" rx="6"/>',
        *body,
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _body(chart: Chart) -> Iterator[str]:
    scale = _Scale.of(chart)
    yield _text(MARGIN, MARGIN + 14, f"{chart.title}: {chart.axis}", "head")
    yield from _legend(chart.legend, MARGIN + HEAD)
    top = MARGIN + 2 * HEAD
    for group in chart.groups:
        yield _text(MARGIN, top + 16, group.title, "head")
        for row, bar in enumerate(group.bars):
            y, length = top + HEAD + ROW * row, scale.length(bar.value)
            yield _text(LEFT - 8, y + 15, bar.label, end=True)
            yield f'<rect class="{bar.kind}" x="{LEFT}" y="{y + 3}" width="{length:.1f}" height="{ROW - 6}" rx="2"/>'
            yield _text(LEFT + length + 8, y + 15, bar.text)
        top += HEAD + ROW * len(group.bars) + GAP


def _legend(legend: dict[str, str], y: int) -> Iterator[str]:
    x = float(MARGIN)
    for kind, word in legend.items():
        yield f'<rect class="{kind}" x="{x:.1f}" y="{y + 3}" width="12" height="12" rx="2"/>'
        yield _text(x + 18, y + 14, word)
        x += 18 + CHARACTER * len(word) + 20


def _text(x: float, y: int, words: str, kind: str = "", *, end: bool = False) -> str:
    attributes = (f' class="{kind}"' if kind else "") + (' text-anchor="end"' if end else "")
    return f'<text x="{x:.1f}" y="{y}"{attributes}>{escape(words)}</text>'


@dataclass(frozen=True)
class _Scale:
    """Value -> length; a logarithmic one begins at half of the least value."""

    least: float
    most: float
    logarithmic: bool

    @classmethod
    def of(cls, chart: Chart) -> "_Scale":
        values = [bar.value for group in chart.groups for bar in group.bars]
        if not values or min(values) <= 0:
            raise ValueError(f"{chart.title}: expected bars longer than nothing")
        return cls(min(values) / 2, max(values), chart.logarithmic)

    def length(self, value: float) -> float:
        if self.logarithmic:
            return LONGEST * math.log(value / self.least) / math.log(self.most / self.least)
        return LONGEST * value / self.most


def overlaps(chart: Chart) -> list[str]:
    """Texts that would leave the picture or run into each other."""
    scale, wrong = _Scale.of(chart), []
    for bar in (bar for group in chart.groups for bar in group.bars):
        if CHARACTER * len(bar.label) > LEFT - 8 - MARGIN / 2:
            wrong.append(bar.label)
        if LEFT + scale.length(bar.value) + 8 + CHARACTER * len(bar.text) > WIDTH:
            wrong.append(bar.text)
    heads = [f"{chart.title}: {chart.axis}", *(group.title for group in chart.groups)]
    wrong += [head for head in heads if MARGIN + 1.1 * CHARACTER * len(head) > WIDTH]
    ends = [MARGIN]
    for word in chart.legend.values():
        ends.append(ends[-1] + int(38 + CHARACTER * len(word)))
    return wrong + [str(end) for _, end in pairwise(ends) if end > WIDTH]
