"""What `driveblocks site` makes of `site.yaml`: settings for the PLC, a page to be signed, a field report."""

import html
from collections.abc import Iterable, Iterator, Mapping, Sequence

from driveblocks import __version__
from driveblocks.desk.exchange import PARTS, Quality
from driveblocks.desk.site.kept import Kept
from driveblocks.desk.site.steps import script
from driveblocks.maps.model import Drive
from driveblocks.platforms import PLATFORMS

STYLE = (
    "body{font:14px sans-serif;margin:2em;max-width:50em}table{border-collapse:collapse;width:100%;margin:.5em 0}"
    "td,th{border:1px solid #888;padding:.25em .5em;text-align:left;vertical-align:top}h2{page-break-before:always}"
    "h2:first-of-type{page-break-before:auto}td:last-child{min-width:8em}.sign{margin-top:3em;display:flex;gap:3em}"
    ".sign div{flex:1;"
    "border-top:1px solid #000;padding-top:.3em}"
)


def members(one: Kept) -> dict[str, str]:
    """Members of `VFD_Settings` that were found out, and their values."""
    found: dict[str, str] = {}
    if one.measured is not None:
        found["TurnRoundMs"] = str(one.measured.turn_round_ms)
        found["LongestMs"] = str(one.measured.longest_reply_ms)
    return found | {each.gives: each.value for each in one.answers if each.gives and each.value}


def initialisation(entries: Mapping[str, Kept], target: str) -> Iterator[str]:
    """Declarations and assignments of one `VFD_Settings` per drive, in a platform's form."""
    platform = PLATFORMS[target]
    quote, sign = platform.quote, platform.comment
    comment = "{} {}" if sign else "(*{} {} *)"
    yield comment.format(sign, "to be declared:")
    for label in entries:
        yield f"{label}Settings : {quote}VFD_Settings{quote};"
    for label, one in entries.items():
        yield ""
        said = f"{label}: measured on one drive, {one.date}, map {one.map} {one.revision}"
        yield comment.format(sign, " ".join(said.replace("*", " ").split()))  # whatever is there, it stays a comment
        if not members(one):
            yield comment.format(sign, "nothing was measured: all members keep their usual values")
        for name, value in members(one).items():
            real = value if "." in value or not name.endswith("Scale") else f"{value}.0"
            yield f"{platform.member}{label}Settings.{name} := {real};"


def page(entries: Mapping[str, Kept], drives: Mapping[str, Drive]) -> str:
    """An HTML page to be printed and signed; `drives` are the maps by name."""
    body = "".join(_sheet(label, one, drives.get(one.map)) for label, one in entries.items())
    head = f"<meta charset='utf-8'><title>Commissioning</title><style>{STYLE}</style>"
    return f"<!doctype html><html lang='en'><head>{head}</head><body><h1>Commissioning</h1>{body}</body></html>\n"


def measured(entries: Mapping[str, Kept]) -> dict[str, list[tuple[str, list[tuple[str, str]]]]]:
    """Name of a map -> label and facts of each drive of it, without who was there."""
    found: dict[str, list[tuple[str, list[tuple[str, str]]]]] = {}
    for label, one in entries.items():
        rows = [(name, value) for name, value in _facts(one) if name != "who"]
        rows += [(f"gap: {each.gap}", f"{each.answer}{_given(each.gives, each.value, '; ')}") for each in one.answers]
        found.setdefault(one.map, []).append((label, rows))
    return found


def _sheet(label: str, one: Kept, drive: Drive | None) -> str:
    parts = [f"<h2>{html.escape(label)}</h2>", _table(("", ""), _facts(one))]
    settings = [
        (each.id, _text(each.read), " or ".join(map(str, each.right)) or "as the PLC", each.told or "")
        for each in one.settings
    ]
    answers = [(each.gap, each.answer, _text(each.word), _given(each.gives, each.value)) for each in one.answers]
    runs = [(what, do, "") for what, do in script(drive)] if drive else []
    tables: tuple[tuple[str, tuple[str, ...], Sequence[tuple[str, ...]]], ...] = (
        ("Keypad", ("id", "read", "must be", "right, by eye"), settings),
        ("What the manual does not say", ("gap", "answer", "word read", "setting"), answers),
        (
            "For <code>driveblocks run --allow-run</code>: motor uncoupled, hard stop in hand",
            ("gap", "what to do", "seen"),
            runs,
        ),
    )
    for title, heads, rows in tables:
        parts += [f"<h3>{title}</h3>", _table(heads, rows)] if rows else []
    note = "These are facts of one drive. They say nothing of its family, and do not replace the test of the hard stop."
    return "".join((*parts, f"<p>{note}</p><div class='sign'><div>date</div><div>name</div><div>signature</div></div>"))


def _facts(one: Kept) -> Iterator[tuple[str, str]]:
    family = {
        "identity": "recognised by the map's identity",
        "fits": "answers as its map says; compare the plate",
        "unknown": "could not be found out: it answers every address; compare the plate",
    }
    place, times = one.line, one.measured
    yield "map", f"{one.map}, revision {one.revision}"
    yield "date", one.date
    yield "who", one.who or ""
    yield "plate", one.plate or "not asked or not answered"
    yield "line", f"unit {place.unit}, {place.rate} bit/s {place.form} {place.mode.upper()}"
    yield "family", family[one.family]
    if times is not None:
        yield "longest reply", f"{times.longest_ms} ms of {times.reads} reads, as seen at the adapter"
        yield "pause after a reply", f"{times.gap_ms} ms holds" if times.gap_ms else "not found out"
        yield "longest read", f"{times.words} words"
        yield "unlisted register", times.unlisted
    if one.quality is not None:
        figures = Quality(**{name: getattr(one.quality, name) for name in ("exchanges", *PARTS)})
        yield "exchanges", f"{figures}; {figures.verdict}"
    for at, each in enumerate(one.evidence):
        yield "" if at else "evidence", each
    yield "settings", ", ".join(f"{name} {value}" for name, value in members(one).items()) or "none found out"
    yield "skipped", ", ".join(one.skipped) or "nothing"
    yield "ended early", one.ended or "no"
    yield "troubles", "; ".join(one.faults) or "none"


def report(label: str, one: Kept) -> Iterator[str]:
    """A text that a user can send: what was tried and what differed, without who and where."""
    yield f"Field report: {one.map}, revision {one.revision}, driveblocks {__version__}"
    for name, value in _facts(one):
        if name not in ("map", "who"):
            yield f"- {name}: {value}"
    yield f"- tried: {', '.join(one.tried) or 'not kept'}"
    for each in one.settings:
        if each.told == "no" or (each.read is not None and each.right and each.read not in each.right):
            due = " or ".join(map(str, each.right)) or "as the PLC"
            yield f"- setting {each.id}: {'by eye not right' if each.read is None else each.read}, must be {due}"
    for said in one.answers:
        word = "" if said.word is None else f"; word {said.word}"
        yield f"- gap `{said.gap}`: {said.answer}{word}{_given(said.gives, said.value, '; ')}"
    yield f"One drive ({label}) says nothing of its family."


def _given(gives: str | None, value: str | None, before: str = "") -> str:
    return f"{before}{gives} {value or 'not found out'}" if gives else ""


def _text(number: int | None) -> str:
    return "" if number is None else str(number)


def _table(heads: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    head = f"<tr>{''.join(f'<th>{each}</th>' for each in heads)}</tr>" if any(heads) else ""
    body = "".join(f"<tr>{''.join(f'<td>{html.escape(each)}</td>' for each in row)}</tr>" for row in rows)
    return f"<table>{head}{body}</table>"
