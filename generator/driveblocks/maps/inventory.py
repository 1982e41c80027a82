"""The READMEs' table of drives: how much each shipped map holds, per section and per kind, as Markdown."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from driveblocks.maps import counts, view
from driveblocks.maps.counts import Counts, Tally
from driveblocks.maps.model import Drive

BEGIN, END = "<!-- drives:begin -->", "<!-- drives:end -->"

_COLUMNS = (
    "drive and its register tables", "registers", "bits", "enums", "enum values",
    "settings", "faults", "errors", "frames", "errata", "absent",
)  # fmt: skip


def update(text: str, maps: Mapping[Path, Drive], folder: Path) -> str:
    """A page's text with the part between the markers made anew; `folder` is where the page lies, for its links.

    Raises ValueError without markers.
    """
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the page lacks the markers {BEGIN} and {END}")
    return f"{before}{BEGIN}\n{table(maps, folder)}{END}{after}"


def table(maps: Mapping[Path, Drive], folder: Path) -> str:
    """One line for each drive with its totals, and below it one for each of its register tables."""
    rows = [_COLUMNS, ("---",) + ("---:",) * (len(_COLUMNS) - 1)]
    for path, drive in maps.items():
        rows += _drive(drive, Path(os.path.relpath(path.resolve(), folder.resolve())))
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _drive(drive: Drive, link: Path) -> Iterator[tuple[str, ...]]:
    held = counts.of_drive(drive)
    name = f"[**{drive.prefix}**]({link.as_posix()}) {view.title(drive)}"
    yield name, *_numbers(held.total), *_kinds(held)
    blank = ("",) * len(_kinds(held))
    for section in drive.sections:
        yield f"· {section.title.en}", *_numbers(held.sections[section.id]), *blank
    lists = str(held.setting_values.enums), str(held.setting_values.enum_values)
    yield "· keypad settings", "", "", *lists, str(held.settings), *blank[1:]


def _numbers(tally: Tally) -> tuple[str, ...]:
    return str(tally.registers), str(tally.bits), str(tally.enums), str(tally.enum_values)


def _kinds(held: Counts) -> tuple[str, ...]:
    return tuple(map(str, (held.settings, held.faults, held.errors, held.frames, held.errata, held.absent)))
