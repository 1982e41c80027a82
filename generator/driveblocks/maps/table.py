"""A register table from a spreadsheet, CSV, TSV or pasted text, as rows of a map."""

import csv
import io
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, InvalidOperation
from typing import get_args

from driveblocks.maps.form import ENGLISH, address_text
from driveblocks.maps.model import Unit

COLUMNS = {
    "address": ("address", "addr", "register", "reg", "modbus", "hex", "adresse", "地址", "寄存器"),
    "id": ("id", "code", "parameter", "par", "no", "number", "nummer", "功能码", "参数"),
    "name": ("name", "description", "designation", "function", "meaning", "bezeichnung", "名称", "说明"),
    "unit": ("unit", "units", "einheit", "单位"),
    "scale": ("scale", "factor", "resolution", "step", "faktor", "min. unit", "单位换算", "精度"),
    "access": ("access", "r/w", "rw", "attribute", "zugriff", "读写", "属性"),
}
"""What a row is made of -> what the heads of its columns are called; others are left out."""
MUST = ("address", "name")
ADDRESSES = ("hex", "decimal", "4xxxx")
_WORDS = {
    "r": "r", "ro": "r", "read": "r", "read only": "r", "w": "w", "wo": "w", "write": "w", "write only": "w",
    "rw": "rw", "r/w": "rw", "read/write": "rw", "只读": "r", "读": "r", "写": "w", "读写": "rw",
}  # fmt: skip
_UNITS = {each.lower(): each for each in get_args(Unit)} | {"rpm": "r/min", "ohm": "Ohm", "°c": "°C", "sec": "s"}
_HEX = re.compile(r"(?:0x|16#|h')?([0-9A-F]{1,4})(?:h|')?", re.IGNORECASE)
_MARKED = re.compile(r"(?:0x|16#|h')[0-9a-f]+'?|[0-9a-f]+h|[0-9]*[a-f][0-9a-f]*", re.IGNORECASE)
"""What only a hexadecimal number is."""


_TAKEN = {"yes", "no", "on", "off", "true", "false", "null"}
"""What YAML may take for something else than a text."""


class TableError(Exception):
    """What no row can be made of, for a person: each line names its place."""


@dataclass
class Table:
    """Rows of a map as YAML, and what was not understood, each with its line."""

    rows: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)


def read(text: str, name: str, columns: dict[str, str], addresses: str | None) -> Table:
    """The rows of a table whose first line names its columns.

    `columns`: what a row is made of -> the head of its column, where that is none of `COLUMNS`; `addresses`: how they
    are written, one of `ADDRESSES`, where the numbers do not show it. Raises TableError.
    """
    lines = [(number, cells) for number, cells in _lines(text) if any(cells)]
    if len(lines) < 2:
        raise TableError(f"{name}:1:1: no table; the first line names the columns, each line after it is a register")
    places = _places(name, lines[0][0], lines[0][1], columns)
    known = [each for each in (_cell(cells, places["address"]) for _, cells in lines[1:]) if each]
    form = addresses or _form(name, lines[0][0], known)
    made = Table()
    for number, cells in lines[1:]:
        row, wrong = _row(cells, places, form)
        if wrong:
            made.left.append(f"{name}:{number}:1: {'; '.join(wrong)}")
        else:
            made.rows.append(row)
    return made


def _lines(text: str) -> Iterator[tuple[int, list[str]]]:
    """Lines by their numbers, as cells, by the character that parts most of the first one."""
    lines = text.splitlines()
    first = next((line for line in lines if line.strip()), "")
    by = max("\t;,|", key=first.count)
    if not first.count(by):
        yield from ((number, re.split(r" {2,}", line.strip())) for number, line in enumerate(lines, 1))
        return
    reader, begun = csv.reader(io.StringIO(text, newline=""), delimiter=by), 1
    for row in reader:
        yield begun, [" ".join(cell.split()) for cell in row]
        begun = reader.line_num + 1


def _places(name: str, line: int, heads: Sequence[str], columns: dict[str, str]) -> dict[str, int]:
    """Which column is what."""
    places, wrong = {}, []
    for what, words in COLUMNS.items():
        asked = columns.get(what)
        found = [at for at, head in enumerate(heads) if (head == asked if asked else _is(head, words))]
        if asked and not found:
            wrong.append(f"no column is called `{asked}`")
        elif what in MUST and not found:
            wrong.append(f"no column is the {what}; name it, such as --column {what}=`{heads[0]}`")
        elif what in MUST and len(found) > 1:
            both = " and ".join(f"`{heads[at]}`" for at in found)
            wrong.append(f"{both} may be the {what}; name one by --column {what}=...")
        elif found:
            places[what] = found[0]
    if wrong:
        raise TableError("\n".join(f"{name}:{line}:1: {each}" for each in wrong))
    return places


def _is(head: str, words: Sequence[str]) -> bool:
    said = head.lower().strip(" .:")
    return any(said == word or word in re.split(r"[^\w./]+", said) for word in words)


def _form(name: str, line: int, known: Sequence[str]) -> str:
    """How addresses are written, where one of them shows it."""
    if any(_MARKED.fullmatch(each) for each in known):
        return "hex"
    if known and all(re.fullmatch("4[0-9]{4}", each) for each in known):
        return "4xxxx"
    raise TableError(
        f"{name}:{line}:1: no address shows whether it is hexadecimal; say so by --addresses {', '.join(ADDRESSES)}"
    )


def _row(cells: Sequence[str], places: dict[str, int], form: str) -> tuple[str, list[str]]:
    """A row as YAML, and what is wrong with it."""
    said = {what: _cell(cells, place) for what, place in places.items()}
    address, wrong = _address(said["address"], form), []
    if address is None:
        wrong.append(f"`{said['address']}` is no {form} address of one register")
    found = {"address": address_text(address or 0)}
    if said.get("id") and places.get("id") != places["address"]:
        found["id"] = _quoted(said["id"])
    english = said["name"].isascii() and re.fullmatch(ENGLISH.pattern, said["name"])
    if not said["name"]:
        wrong.append("the name is empty")
    found["name" if english else "wording"] = _quoted(said["name"])
    access, unit, scale = (said.get(what, "") for what in ("access", "unit", "scale"))
    if access:
        found["access"] = _WORDS.get(access.lower(), "")
        wrong += [] if found["access"] else [f"`{access}` is no access; write r, w or rw"]
    if unit not in ("", "-", "/"):
        found["unit"] = _quoted(_UNITS.get(unit.lower(), ""))
        wrong += [] if unit.lower() in _UNITS else [f"`{unit}` is no unit of a map"]
    if scale not in ("", "-", "/"):
        factor = _factor(scale)
        wrong += [] if factor else [f"`{scale}` is no factor"]
        found["scale"] = f"{{factor: {factor}, source: the table}}"
    return f"{{{', '.join(f'{key}: {value}' for key, value in found.items())}}}", wrong


def _cell(cells: Sequence[str], place: int) -> str:
    return cells[place] if place < len(cells) else ""


def _address(said: str, form: str) -> int | None:
    """A wire address: numbers such as 40001 count from 1."""
    if form == "hex":
        match = _HEX.fullmatch(said)
        return int(match[1], 16) if match else None
    if not said.isascii() or not said.isdigit():
        return None
    number = int(said) - (40001 if form == "4xxxx" else 0)
    return number if 0 <= number <= 0xFFFF else None


def _factor(said: str) -> Decimal | None:
    """0.01, also of `0.01 Hz`, `0,01` and `1/100`."""
    match = re.match(r"([0-9]+(?:[.,][0-9]+)?)(?:/([0-9]+))?", said)
    try:
        number = Decimal(match[1].replace(",", ".")) / Decimal(match[2] or 1) if match else Decimal(0)
    except (InvalidOperation, ZeroDivisionError):
        return None
    return number if number > 0 else None


def _quoted(said: str) -> str:
    """A text in a row of YAML; quoted where it would be read otherwise."""
    plain = re.fullmatch(r"[A-Za-z][A-Za-z0-9 ./()_+-]*", said) and said.lower() not in _TAKEN
    return said if plain else '"' + said.replace("\\", "\\\\").replace('"', '\\"') + '"'
