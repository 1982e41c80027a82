"""The parameters of a drive in a file: a table with commas, whole at any moment, which says how far it came."""

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from driveblocks.desk.site.register import rows, unread, value
from driveblocks.maps.form import SPACES, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.maps.revision import revision
from driveblocks.maps.table import few
from structured_text import files
from structured_text.visible import file_name

COLUMNS = ("address", "id", "name", "word", "value", "unit", "default")
LONGEST = 4096
"""Characters of a line."""
_HEAD = re.compile(r"# map: (?P<map>\S+), revision (?P<revision>[0-9A-F]{8})")
_UNIT = re.compile(r"# unit: (?P<unit>[0-9]{1,3})")
_OURS = re.compile(rf"# parameters of .+, read by driveblocks|# read: [0-9]+ of [0-9]+|{_HEAD.pattern}|{_UNIT.pattern}")
_PLACE = re.compile(r"(?:(coil|discrete|input) )?(?:\S+ \(wire )?([0-9A-F]{4})H\)?")
_WORD = re.compile(r"[0-9]{1,5}")

Word = int | str
"""What was read, or why nothing was: `refused 2`, `no reply`."""


@dataclass(frozen=True)
class Saved:
    """A drive's words by address; where a file's map is another, its revision differs."""

    where: str
    stem: str
    unit: int
    words: dict[int, Word]
    revision: str


def write(path: Path, stem: str, drive: Drive, unit: int, words: Mapping[int, Word]) -> None:
    """Put the file in the place of the one that is there, in one step; lines of its user's stay. Raises OSError."""
    known = {address: word for address, word in words.items() if isinstance(word, int)}
    every = rows(drive)
    text = io.StringIO()
    text.write(f"# parameters of {drive.prefix}, read by driveblocks\n")
    text.write(f"# map: {stem}, revision {revision(drive):08X}\n# unit: {unit}\n")
    text.write(f"# read: {len(words)} of {len(every)}\n")
    left_out = [f"# {line}" for line in unread(drive)]
    old = files.data(path).decode("utf-8-sig", "replace").splitlines() if path.exists() else []
    ours = {line for line in map(_line, old) if line in left_out or _OURS.fullmatch(line)}
    notes = (line for line in old if line.startswith(("#", '"#')) and _line(line) not in ours)
    text.writelines(f"{line}\n" for line in (*left_out, *notes))
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for row in every:
        if row.address in words:
            word = words[row.address]
            shown = value(row, word, known) if isinstance(word, int) else ("", "")
            table.writerow((address_text(row.address), row.id, row.name, word, *shown, row.default))
    files.put(path, text.getvalue())


def _line(line: str) -> str:
    """A line as it was written: spreadsheets fill each up with commas, and quote a note that holds one."""
    cells = _cells(line)
    if cells and cells[0].startswith("#"):
        return ",".join(cells).rstrip(",")
    more = cells[len(COLUMNS) :]
    return line[: -len(more)] if more and not any(more) else line


def _cells(line: str) -> list[str]:
    """Its cells; none of a line that is too long for a row."""
    return next(csv.reader([line]), []) if len(line) <= LONGEST else []


def read(path: Path) -> Saved:
    """A file that `write` has made. Raises Refused with everything that is wrong with it."""
    name = file_name(path)
    try:
        lines = [_line(line) for line in files.text(path).splitlines()]
    except files.BadFile as error:
        raise Refused(str(error)) from None
    head = next((found for line in lines if (found := _HEAD.fullmatch(line))), None)
    unit = next((found for line in lines if (found := _UNIT.fullmatch(line))), None)
    if head is None or unit is None:
        raise Refused(f"{name}:1:1: is no file of `driveblocks parameters save`: it names no map and no unit")
    words, wrong = dict[int, Word](), list[str]()
    for number, line in enumerate(lines, 1):
        if line.startswith("#") or line == ",".join(COLUMNS):
            continue
        cells = _cells(line)
        found = _PLACE.fullmatch(cells[0]) if len(cells) == len(COLUMNS) else None
        if found is None:
            wrong.append(f"{name}:{number}:1: is no row; write {', '.join(COLUMNS)}")
        elif _WORD.fullmatch(cells[3]) and int(cells[3]) > 0xFFFF:
            wrong.append(f"{name}:{number}:1: {cells[3]} is no word; write 0 to 65535")
        else:
            address = SPACES[found[1] or "holding"] + int(found[2], 16)
            words[address] = int(cells[3]) if _WORD.fullmatch(cells[3]) else cells[3]
    if wrong:
        raise Refused("\n".join(few(wrong)))
    return Saved(name, head["map"], int(unit["unit"]), words, head["revision"])
