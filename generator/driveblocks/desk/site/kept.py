"""`site.yaml`: what was found out about each drive of a machine, an entry per label; a file of its user's."""

import json
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml

from driveblocks.desk.site.found import Found, Tens
from driveblocks.desk.site.session import SKIPPABLE, STEPS
from driveblocks.maps import nodes, source
from driveblocks.maps.decode import build
from driveblocks.maps.form import Form
from driveblocks.maps.model import Count, Entry, Id, Number, OpenScale, Str, Word, fact, option
from driveblocks.maps.problem import Report
from driveblocks.maps.shape import EntryOf
from structured_text import files
from structured_text.visible import file_name

LABEL = re.compile(r"[A-Za-z][A-Za-z0-9]{0,23}")
"""A label names a variable of the PLC, too."""
MOST_TEXT = 200
_UINT = re.compile("[0-9]{1,4}|[1-5][0-9]{4}|6[0-4][0-9]{3}|65[0-4][0-9]{2}|655[0-2][0-9]|6553[0-5]")
Ms = Annotated[int, Form("time of a PLC", _UINT, int, "write 0 to 65535, in ms", numeric=True)]
_END = re.compile(r"(?m)^\.\.\.(?!\S)\s?")
"""What ends a document of YAML: nothing can be written after it."""
PLANT = (
    "plant", "scan_ms", "max_scan_ms", "cpu", "language", "lines", "drives", "groups", "inputs", "buttons", "lamps",
    "hard_stops", "meters",
)  # fmt: skip
"""The keys of a plant, which may stand in the same file."""
HEAD = "# Written by `driveblocks commission`, one entry per drive; other entries, and all comments, are kept.\n"


@dataclass(frozen=True, kw_only=True)
class Place(Entry):
    """How the drive was found on its line."""

    rate: Count = fact("bits per second", "9600")
    form: Str = fact("data bits, parity, stop bits", "8N1")
    mode: Literal["rtu", "ascii"] = fact("framing", "rtu")
    unit: Number = fact("unit address", "1")


@dataclass(frozen=True, kw_only=True)
class Checked(Entry):
    """A setting of the keypad."""

    id: Id = fact("the manual's id", "H5-01")
    read: Number | None = option("as read", "1")
    must: Number | None = option("as it must be", "2")
    one_of: tuple[Number, ...] = option("as it may be, where several numbers serve", "[1, 2]", default=())
    told: Str | None = option("what a person said of it: yes or no", '"yes"')

    @property
    def right(self) -> tuple[int, ...]:
        """The numbers that serve; none where any does."""
        return self.one_of if self.must is None else (self.must,)


@dataclass(frozen=True, kw_only=True)
class Times(Entry):
    """What was measured, in ms and words."""

    reads: Count = fact("reads", "200")
    longest_ms: Number = fact("longest reply", "12")
    gap_ms: Count | None = option("shortest pause after a reply that held", "2")
    words: Number = fact("words of the longest read", "16")
    unlisted: Str = fact("a read of a register that the map does not list", "001BH, refused")
    turn_round_ms: Ms = fact("`TurnRoundMs`", "50")
    longest_reply_ms: Ms = fact("`LongestMs`", "500")


@dataclass(frozen=True, kw_only=True)
class Figures(Entry):
    """How well the line carried what was asked, in exchanges."""

    exchanges: Number = fact("exchanges", "231")
    good: Number = fact("with a good reply", "224")
    refused: Number = fact("refused", "7")
    damaged: Number = fact("spoilt", "0")
    late: Number = fact("with a reply that came too late", "0")
    doubled: Number = fact("with a reply more", "0")
    silent: Number = fact("without a reply", "0")


@dataclass(frozen=True, kw_only=True)
class Said(Entry):
    """A gap of the manual, for this drive."""

    gap: Str = fact("`what` of the gap", "scale of 3000H")
    answer: Str = fact("as typed", '"20.0"')
    word: Number | None = option("the register at that moment", "2000")
    gives: OpenScale | None = option("a scale of `VFD_Settings`", "FrequencyScale")
    value: Tens | None = option("the scale", '"0.01"')


@dataclass(frozen=True, kw_only=True)
class Kept(Entry):
    """One drive."""

    map: Str = fact("name of the map", "invt_chf")
    revision: Str = fact("its revision", '"1A2B3C4D"')
    date: Str = fact("when", '"2026-11-23 10:30"')
    who: Str | None = option("who", "A. Person")
    line: Place = fact("the line", "{rate: 9600, form: 8N1, mode: rtu, unit: 1}")
    family: Literal["identity", "fits", "unknown"] = fact(
        "`identity`: by the map's; `fits`: it answers as the map says; `unknown`: it answers every address", "fits"
    )
    plate: Str | None = option("type, rating, firmware", '"5.5 kW, 1.02"')
    finished: tuple[Word, ...] = option("steps that were finished", "[quiet, find]", default=())
    skipped: tuple[Str, ...] = option("steps and questions passed over", "[plate]", default=())
    ended: Str | None = option("why it did not come to its end", "Ctrl-C")
    faults: tuple[Str, ...] = option("what was wrong", "[...]", default=())
    tried: tuple[Str, ...] = option("rates and formats that were tried", "[9600 bit/s 8N1 RTU]", default=())
    evidence: tuple[Str, ...] = option("what speaks for the family, with its frame", "[...]", default=())
    quality: Figures | None = option("exchanges on the line since it was found", "{exchanges: 231, ...}")
    settings: tuple[Checked, ...] = option("the keypad", "[{id: H5-01, read: 1}]", default=())
    measured: Times | None = option("times", "{reads: 200, ...}")
    answers: tuple[Said, ...] = option("gaps", "[{gap: ..., answer: ...}]", default=())


@dataclass(frozen=True)
class About:
    """What is written beside the findings."""

    label: str
    map: str
    revision: str
    date: str
    who: str


def read(path: Path) -> dict[str, Kept]:
    """The entries of a file by label. Raises MapError with everything that is wrong with it."""
    report, found = Report(file_name(path)), dict[str, Kept]()
    root = nodes.parse(source.read(path), report)
    if root is not None and not isinstance(root, nodes.Entries):
        report.add(root.at, "this is no file of `driveblocks commission`", "write an entry per drive: `PUMP:`")
    elif root is not None:
        for label, (key, node) in root.entries.items():
            if label in PLANT and not is_found(node):
                continue
            first = next(each for each in root.entries if each.lower() == label.lower())
            if first != label:
                report.add(key.at, f"`{label}` and `{first}` are one name in a PLC", "rename one of them")
            if key.at[1] != 1:
                report.add(key.at, f"`{label}` does not begin its line", "begin a line with each label")
            if not LABEL.fullmatch(label):
                report.add(key.at, f"`{label}` is no label", "write up to 24 letters and digits, a letter first")
            made = build(EntryOf(Kept), node, report, label)
            if isinstance(made, Kept):
                found[label] = made
    report.raise_if_any()
    return found


def is_found(node: nodes.Node | None) -> bool:
    """Whether an entry is what commission found of a drive, not a part of a plant: its `map` is one word."""
    own = node.entries if isinstance(node, nodes.Entries) else {}
    return all(isinstance(own.get(key, (None, None))[1], nodes.Scalar) for key in ("map", "revision"))


def write(path: Path, about: About, found: Found) -> None:
    """Put an entry into the file, in the place of the label's old one, in one step.

    Raises OSError, and MapError where the file was made unreadable meanwhile; it is then as it was.
    """
    report, there = Report(file_name(path)), path.exists()
    new = replaced(_END.sub("", source.read(path)) if there else HEAD, about.label, text(about, found))
    nodes.parse(new, report)
    report.raise_if_any()
    files.put(path, new.replace("\n", "\r\n") if there and b"\r\n" in files.data(path) else new)


def copied(path: Path) -> Path:
    """A copy of a file beside it, under a name that nothing has. Raises OSError."""
    names = (path.with_name(f"{path.stem}.{number}{path.suffix}") for number in count(1))
    copy = next(each for each in names if not os.path.lexists(each))
    files.put(copy, files.data(path), new=True, mode=path.stat().st_mode & 0o777)
    return copy


def try_out(path: Path) -> None:
    """Raise OSError where a file could not be written."""
    with files.beside(path):
        pass


def replaced(old: str, label: str, entry: str) -> str:
    """A file's text with an entry in the place of the label's old one, or after all; its comments are kept."""
    lines = old.splitlines()
    root = nodes.parse("\n".join((*lines, "")), Report(""))
    begins = {key: at.at[0] - 1 for key, (at, _) in root.entries.items()} if isinstance(root, nodes.Entries) else {}
    first, made = begins.get(label), entry.splitlines()
    if first is None:
        return "\n".join((*lines, *[""] * bool(lines), *made, ""))
    after = min((each for each in begins.values() if each > first), default=len(lines))
    last, notes = _taken(lines[first:after])
    return "\n".join((*lines[:first], made[0], *notes, *made[1:], *lines[first + last :], ""))


def _taken(lines: list[str]) -> tuple[int, list[str]]:
    """How many lines an entry takes, and the comments in them."""
    ends: dict[int, int] = {}
    for token in yaml.scan("\n".join((*lines, ""))):
        start, end = token.start_mark, token.end_mark
        if start.index < end.index and not isinstance(token, yaml.DocumentEndToken):
            ends |= {at: len(lines[at]) for at in range(start.line, end.line)} | {end.line: end.column}
    last = max(at for at, column in ends.items() if column) + 1
    rests = (line[ends.get(at, 0) :].strip() for at, line in enumerate(lines[:last]))
    return last, [f"  {each}" for each in rests if each.startswith("#")]


def text(about: About, found: Found) -> str:
    """An entry as YAML."""
    return f"{about.label}:\n" + "".join(f"  {line}\n" for line in _lines(about, found))


def _lines(about: About, found: Found) -> Iterator[str]:
    known = found.way is not None and found.unit is not None
    open_ = [each for each in STEPS if each not in found.done and not (each in SKIPPABLE and each in found.skipped)]
    facts = {
        "map": about.map, "revision": about.revision, "date": about.date, "who": about.who,
        "line": {**vars(found.way), "unit": found.unit} if known else {},
        "family": found.family, "plate": found.plate,
        "ended": found.ended or (f"not finished: {', '.join(open_)}" if open_ else ""),
        "finished": found.done, "skipped": found.skipped, "tried": found.tried,
        "faults": [each.text for each in found.faults], "evidence": found.evidence,
    }  # fmt: skip
    yield from (f"{key}: {_flow(value)}" for key, value in facts.items() if value)
    rows: dict[str, list[dict[str, Any]]] = {
        "settings": [
            {"id": each.id, "read": each.read, **_due(each.must), "told": each.told} for each in found.settings
        ],
        "answers": [vars(each) for each in found.answers],
    }
    if (times := found.measured) is not None:
        given = {**vars(times), "turn_round_ms": times.turn_round_ms, "longest_reply_ms": times.longest_reply_ms}
        yield f"measured: {_flow(given)}"
    if found.quality is not None:
        yield f"quality: {_flow(vars(found.quality))}"
    for key, entries in rows.items():
        yield from [f"{key}:", *(f"  - {_flow(each)}" for each in entries)] if entries else []


def _due(numbers: tuple[int, ...]) -> dict[str, Any]:
    return {"one_of": list(numbers)} if len(numbers) > 1 else {"must": next(iter(numbers), None)}


def _flow(value: object) -> str:
    """A value as YAML in one line; of a mapping, only what is known."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(each)}" for key, each in value.items() if each not in (None, "")) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(_flow, value))}]"
    if isinstance(value, str):
        plain = source.HIDDEN.sub("?", " ".join(value.split()))[:MOST_TEXT].strip()
        return json.dumps(plain, ensure_ascii=False)
    return str(value)
