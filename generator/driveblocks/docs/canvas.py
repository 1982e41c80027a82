"""Pictures as SVG that read on light and on dark pages; the same content gives the same text."""

import re
from dataclasses import dataclass, field

from driveblocks.platforms.element import escaped

STYLE = """text { font: 13px system-ui, sans-serif; fill: #24292f }
.head { font-weight: 600 }
.small, .type { font-size: 11px; fill: #57606a }
.group { font-size: 10px; fill: #0969da; letter-spacing: 0.06em }
.mono { font-family: ui-monospace, Menlo, Consolas, monospace; font-size: 12px }
.page { fill: #ffffff; stroke: #d0d7de }
.box { fill: #f6f8fa; stroke: #24292f; stroke-width: 1.5 }
.line { fill: none; stroke: #24292f; stroke-width: 1.5 }
.rail { fill: #24292f }
.gap { fill: #ffffff }
.dashed { fill: none; stroke: #24292f; stroke-dasharray: 5 4 }
.thin { fill: none; stroke: #afb8c1; stroke-dasharray: 3 3 }
.go { fill: none; stroke: #0969da; stroke-width: 2 }
.stop { fill: none; stroke: #cf222e; stroke-width: 2 }
.band { fill: #ddf4ff }
.mark { fill: #0969da }
.alarm { fill: #cf222e }
@media (prefers-color-scheme: dark) {
text { fill: #e6edf3 }
.small, .type { fill: #9198a1 }
.group { fill: #4493f8 }
.page { fill: #0d1117; stroke: #30363d }
.box { fill: #151b23; stroke: #e6edf3 }
.line { stroke: #e6edf3 }
.rail { fill: #e6edf3 }
.gap { fill: #0d1117 }
.dashed { stroke: #e6edf3 }
.thin { stroke: #656c76 }
.go { stroke: #4493f8 }
.stop { stroke: #f85149 }
.band { fill: #132a45 }
.mark { fill: #4493f8 }
.alarm { fill: #f85149 }
}"""


@dataclass
class Canvas:
    """A picture with a title; y increases downwards, all sizes are pixels."""

    title: str
    width: int
    height: int
    body: list[str] = field(default_factory=list)

    def text(self, x: float, y: float, words: str, kind: str = "", anchor: str = "start") -> None:
        attributes = (f' class="{kind}"' if kind else "") + (f' text-anchor="{anchor}"' if anchor != "start" else "")
        self.body.append(f'<text x="{x:g}" y="{y:g}"{attributes}>{escaped(words)}</text>')

    def box(  # noqa: PLR0913, PLR0917 - where, how large, how it looks and what it says
        self, x: float, y: float, width: float, height: float, kind: str = "box", told: str = ""
    ) -> None:
        """`told`: what a pointer above it reads."""
        end = f"><title>{escaped(told)}</title></rect>" if told else "/>"
        self.body.append(f'<rect class="{kind}" x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="4"{end}')

    def path(self, points: list[tuple[float, float]], kind: str = "line") -> None:
        """A line through these points; it joins one of its kind that was drawn just before."""
        begin, way = f'<path class="{kind}" d="', "M" + "L".join(f"{x:g},{y:g}" for x, y in points)
        if self.body and self.body[-1].startswith(begin):
            way = self.body.pop()[len(begin) : -len('"/>')] + way
        self.body.append(f'{begin}{way}"/>')

    def curve(self, begin: tuple[float, float], by: tuple[float, float], end: tuple[float, float]) -> None:
        """A line that bends towards a point."""
        (x0, y0), (x1, y1), (x, y) = begin, by, end
        self.body.append(f'<path class="line" d="M{x0:g},{y0:g} Q{x1:g},{y1:g} {x:g},{y:g}"/>')

    def arrow(self, points: list[tuple[float, float]], kind: str = "line") -> None:
        """A line through these points, with an arrowhead at its end."""
        self.path(points, kind)
        (x0, y0), (x, y) = points[-2:]
        dx, dy = (x > x0) - (x < x0), (y > y0) - (y < y0)
        self.path(
            [(x - 7 * dx - 4 * dy, y - 7 * dy - 4 * dx), (x, y), (x - 7 * dx + 4 * dy, y - 7 * dy + 4 * dx)], kind
        )

    @property
    def page(self) -> list[str]:
        """Its paper, and what is on it."""
        page = f'<rect class="page" x="0.5" y="0.5" width="{self.width - 1}" height="{self.height - 1}" rx="6"/>'
        return [page, *self.body]

    def svg(self) -> str:
        size = f'width="{self.width}" height="{self.height}" viewBox="0 0 {self.width} {self.height}"'
        return _whole(size, self.title, used(self.page), self.page)


def used(body: list[str]) -> str:
    """The lines of `STYLE` for what is in a picture."""
    classes = {name for line in body for found in re.findall(r'class="([^"]+)"', line) for name in found.split()}
    return "\n".join(
        line for line in STYLE.splitlines() if line[0] != "." or classes & set(re.findall(r"\.([a-z]+)[ ,]", line))
    )


def folding(wide: Canvas, narrow: Canvas) -> str:
    """One picture in two layouts: a window that has no room for the wide one shows the narrow one."""
    style = f"""{used([*wide.page, *narrow.page])}
:root {{ width: {wide.width}px; height: {wide.height}px }}
.narrow {{ display: none }}
@media (max-width: {wide.width - 1}px) {{
:root {{ width: {narrow.width}px; height: {narrow.height}px }}
.wide {{ display: none }}
.narrow {{ display: inline }}
}}"""
    layouts = {"wide": wide.page, "narrow": narrow.page}
    body = [line for name, page in layouts.items() for line in (f'<g class="{name}">', *page, "</g>")]
    return _whole(f'width="{wide.width}" height="{wide.height}"', wide.title, style, body)


def _whole(size: str, title: str, style: str, body: list[str]) -> str:
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img">', f"<title>{escaped(title)}</title>"]
    return "\n".join([*head, f"<style>{style}</style>", *body, "</svg>"]) + "\n"
