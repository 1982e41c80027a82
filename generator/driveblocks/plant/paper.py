"""Markdown of a folder as one HTML page: no script, no other file, for a screen, a telephone and A4 paper."""

import html
import re
from collections.abc import Callable, Iterator, Mapping

from driveblocks.docs.canvas import STYLE

_CODE = re.compile(r"`([^`]+)`")
_INLINE = (
    (re.compile(r"\*\*(.+?)\*\*"), r"<b>\1</b>"),
    (re.compile(r"(?<![\w*])\*([^*\s][^*]*?)\*(?![\w*])"), r"<i>\1</i>"),
    (re.compile(r"\[([^\]]*)\]\((#[^)\s]+)\)"), r'<a href="\2">\1</a>'),
    (re.compile(r"\[([^\]]*)\]\([^)\s]+\)"), r"\1"),
)  # fmt: skip
"""Only places of the same page are led to: on paper, and on a telephone at the machine, there is no other."""
_PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")
_CELLS = re.compile(r"(?<!\\)\|")
_BOX, _DONE = "[ ]", "[\u00a0]"
CHECK = '<span class="tick"></span>'
PAGE = """body{font:15px/1.4 system-ui,sans-serif;color:#111;background:#fff;margin:0 auto;padding:1em;max-width:64em;
overflow-wrap:anywhere}
h1,h2,h3{line-height:1.2;break-after:avoid}h2{margin-top:2em;border-bottom:2px solid #111}
blockquote{margin:1em 0;padding:.5em 1em;border:2px solid #cf222e;break-inside:avoid}
table{border-collapse:collapse;width:100%;margin:.8em 0;font-size:13px}
th,td{border:1px solid #777;padding:.3em .5em;text-align:left;vertical-align:top;
overflow-wrap:break-word}th{background:#eee}
tr{break-inside:avoid}code{font-size:90%;background:#f2f2f2;padding:0 .2em}
ul{padding-left:1.3em}ul.ticks{list-style:none;padding-left:0}ul.ticks li{margin:.35em 0 .35em 1.9em}
ul.ticks .tick{margin-left:-1.9em;margin-right:.7em}
.tick{display:inline-block;width:.95em;height:.95em;border:1.5px solid #111;vertical-align:-.1em}
figure{margin:1em 0;break-inside:avoid}svg{max-width:100%;height:auto}
@media screen and (max-width:600px){body{padding:.6em}thead{display:none}
table,tbody,tr,td{display:block;width:auto}tr{border:1px solid #777;margin:.6em 0;padding:.2em .4em}
td{border:0;padding:.15em 0}td:empty{display:none}td[data-head]:before{content:attr(data-head) ": ";color:#555}
figure{overflow-x:auto}svg{max-width:none}}
@page{size:A4;margin:14mm}
@media print{body{font-size:10pt;max-width:none;padding:0}table{font-size:8.5pt}
h2.own:not(:first-of-type){break-before:page}
th,td{padding:.15em .4em}
th,.tick{print-color-adjust:exact}a{color:inherit;text-decoration:none}}"""


def page(title: str, text: str, pictures: Mapping[str, str]) -> str:
    """The page of a text in the Markdown that the templates of a plant use; `pictures` are SVG by their names."""
    style = f"{PAGE}\n{_scoped(STYLE.partition('@media')[0])}"
    head = (
        '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title><style>\n{style}\n</style>"
    )
    body = "\n".join(_blocks(text.splitlines(), pictures))
    return f'<!doctype html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'


def _scoped(style: str) -> str:
    """The style of pictures, for pictures alone."""
    return "\n".join(f"svg {each}" if each.startswith(".") else each for each in style.splitlines())


def _blocks(lines: list[str], pictures: Mapping[str, str]) -> Iterator[str]:
    at = 0
    while at < len(lines):
        kind = _kind(lines[at])
        end = at + 1
        while end < len(lines) and kind not in ("head", "picture") and _kind(lines[end]) == kind:
            end += 1
        yield from _MADE[kind](lines[at:end], pictures)
        at = end


def _kind(line: str) -> str:
    starts = (("#", "head"), ("> ", "quote"), ("|", "table"), (f"- {_BOX}", "ticks"), ("- ", "list"), ("![", "picture"))
    return next((kind for start, kind in starts if line.startswith(start)), "text" if line.strip() else "nothing")


def _head(lines: list[str], __: Mapping[str, str]) -> Iterator[str]:
    marks, _, words = lines[0].partition(" ")
    level = len(marks)
    own = ' class="own"' if level == 2 else ""
    yield f'<h{level} id="{_anchor(words)}"{own}>{_inline(words)}</h{level}>'


def _anchor(words: str) -> str:
    return re.sub(r"[^\w -]", "", words.lower()).replace(" ", "-")


def _picture(lines: list[str], pictures: Mapping[str, str]) -> Iterator[str]:
    found = _PICTURE.match(lines[0])
    svg = pictures[found[1]] if found else ""
    yield f"<figure>{re.sub('<style>.*?</style>', '', svg, flags=re.DOTALL)}</figure>"


def _table(lines: list[str], __: Mapping[str, str]) -> Iterator[str]:
    heads, _, *rows = [[cell.strip() for cell in _CELLS.split(line.strip()[1:-1])] for line in lines]
    head = "".join(f"<th>{_inline(each)}</th>" for each in heads)
    yield f"<table><thead><tr>{head}</tr></thead><tbody>"
    for row in rows:
        said = [each for each in row if each]
        wide = len(said) == 1 < len(heads)  # a title between rows
        cells = f'<td colspan="{len(heads)}">{_inline(said[0])}</td>' if wide else "".join(map(_cell, heads, row))
        yield f"<tr>{cells}</tr>"
    yield "</tbody></table>"


def _cell(head: str, text: str) -> str:
    label = f' data-head="{html.escape(head)}"' if head else ""
    return f"<td{label}>{_inline(text)}</td>"


def _ticks(lines: list[str], _: Mapping[str, str]) -> Iterator[str]:
    yield '<ul class="ticks">'
    yield from (f"<li>{CHECK}{_inline(each.removeprefix(f'- {_BOX} '))}</li>" for each in lines)
    yield "</ul>"


def _list(lines: list[str], _: Mapping[str, str]) -> Iterator[str]:
    yield "<ul>"
    yield from (f"<li>{_inline(each[2:])}</li>" for each in lines)
    yield "</ul>"


def _quote(lines: list[str], _: Mapping[str, str]) -> Iterator[str]:
    yield f"<blockquote>{'<br>'.join(_inline(each[2:]) for each in lines)}</blockquote>"


def _text(lines: list[str], _: Mapping[str, str]) -> Iterator[str]:
    yield f"<p>{_inline(' '.join(lines))}</p>"


def _nothing(_: list[str], __: Mapping[str, str]) -> Iterator[str]:
    return iter(())


_MADE: dict[str, Callable[[list[str], Mapping[str, str]], Iterator[str]]] = {
    "head": _head, "quote": _quote, "table": _table, "ticks": _ticks, "list": _list, "picture": _picture,
    "text": _text, "nothing": _nothing,
}  # fmt: skip


def _inline(text: str) -> str:
    """Code, stress and links; a box to tick; what is behind a backslash is itself."""
    parts = _CODE.split(text)
    return "".join(f"<code>{html.escape(each)}</code>" if at % 2 else _words(each) for at, each in enumerate(parts))


def _words(text: str) -> str:
    boxed = text.replace(_BOX, "\0").replace(_DONE, "\0")
    plain = html.escape(re.sub(r"\\([\\|<(\[])", r"\1", boxed), quote=False)
    for pattern, made in _INLINE:
        plain = pattern.sub(made, plain)
    return plain.replace("\0", CHECK)
