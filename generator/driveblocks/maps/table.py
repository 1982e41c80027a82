"""A register table from a spreadsheet, CSV, TSV or pasted text, as rows of a map.

Nothing is guessed: what may be read in two ways is refused with its lines, and what no row of a map is, is left out.
"""

import csv
import io
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from driveblocks.maps import cell, form, template
from driveblocks.maps.cell import NOTHING, Way
from driveblocks.maps.factor import doubt
from driveblocks.maps.model import Unit
from driveblocks.maps.problem import Refused
from structured_text.visible import file_name

COLUMNS = {
    "address": ("address", "addr", "register", "reg", "register number", "modbus", "hex", "adresse", "地址", "寄存器"),
    "id": ("id", "code", "parameter", "par", "no", "number", "nummer", "功能码", "参数"),
    "name": (
        "name", "description", "desc", "designation", "function", "meaning", "title", "bezeichnung", "名称", "说明",
    ),
    "unit": ("unit", "units", "einheit", "单位"),
    "scale": (
        "scale", "scaling", "factor", "gain", "faktor", "resolution", "min. unit", "multiplier", "divisor",
        "division factor", "单位换算", "精度",
    ),
    "access": ("access", "r/w", "rw", "attribute", "write/read", "read/write", "zugriff", "读写", "属性"),
    "table": ("table", "space", "fc", "register type", "reg type", "object type"),
    "type": ("type", "datatype", "format", "size of variable", "类型", "数据类型"),
    "size": ("size", "length", "len", "count", "words", "quantity", "长度"),
    "order": ("word order",),
}  # fmt: skip
"""What a row is made of -> what the heads of its columns are called, as a whole or by their last word."""
MUST = ("address", "name")
MOST = 100
"""Nobody reads more lines of one message."""
_WAYS: dict[str, Way] = {
    "resolution": "multiply", "min. unit": "multiply", "multiplier": "multiply", "单位换算": "multiply",
    "精度": "multiply", "divisor": "divide", "division factor": "divide",
}  # fmt: skip
_BITS = ("coil", "discrete")
_TAKEN = {"yes", "no", "on", "off", "true", "false", "null"}
"""What YAML may take for something else than a text."""


class TableError(Refused):
    """What no row can be made of, for a person: each line names its place."""


class Reading(NamedTuple):
    """How to read a table, where it does not show that itself."""

    columns: Mapping[str, str] = {}
    """What a row is made of -> the head of its column; an empty one: there is none."""
    addresses: str | None = None
    """How addresses are written, one of `cell.ADDRESSES`."""
    way: Way | None = None
    """What is done with a word by the factor that is given."""
    codes: bool = False
    """Whether functions name the table of Modbus."""
    order: cell.Order | None = None
    """Which word of a value of 32 bits comes first."""


@dataclass
class Table:
    """Rows of a map as YAML, and what was left out, each with its line."""

    rows: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    assumed: list[str] = field(default_factory=list)
    """What the table does not say."""


def few(lines: Sequence[str]) -> list[str]:
    """As many lines as somebody reads, and how many more there are."""
    more = len(lines) - MOST
    return [*lines[:MOST], f"and {more} more like these"] if more > 0 else list(lines)


def read(text: str, name: str, how: Reading) -> Table:
    """The rows of a table whose first line names its columns, or of a template of wb-mqtt-serial. Raises Refused."""
    if template.is_template(text):
        how = how._replace(addresses=how.addresses or "decimal", way=how.way or "multiply")
        return _read(template.lines(text, name), name, how)
    return _read([(number, cells) for number, cells in _lines(text, name) if any(cells)], name, how)


def _read(lines: Sequence[tuple[int, list[str]]], name: str, how: Reading) -> Table:
    if len(lines) < 2:
        raise TableError(f"{name}:1:1: no table; the first line names the columns, each line after it is a register")
    first, heads = lines[0]
    places = _places(f"{name}:{first}:1", heads, how.columns)
    rows = [_Row(number, cells, places) for number, cells in lines[1:]]
    asked = [] if how.addresses else _unclear(first, rows)
    asked += [] if "id" in how.columns or "id" not in places else _ids(first, heads[places["id"]], rows)
    asked += [] if "table" in how.columns or "table" in places else _tables(rows)
    scale, table = (heads[places[what]].lower() if what in places else "" for what in ("scale", "table"))
    how = how._replace(
        addresses=how.addresses or _written(rows),
        way=how.way or _WAYS.get(scale),
        codes=bool(re.search("fc|fun", table)),
    )
    for row in rows:
        row.read(how)
        asked += [f"{row.line}:1: {each}" for each in row.asked if not row.wrong]
    if asked:
        raise TableError("\n".join(few([f"{name}:{each}" for each in asked])))
    return _table(name, rows, places, how)


def _table(name: str, rows: "Sequence[_Row]", places: Mapping[str, int], how: Reading) -> Table:
    """Rows and what was left out; of rows of one address none is known to be the right one."""
    made, lines = Table(), dict[int, list[int]]()
    for row in rows:
        for at in row.addresses:
            lines.setdefault(at, []).append(row.line)
    for row in rows:
        twins = [(each, at) for at in row.addresses for each in lines[at][:2] if each != row.line and not row.wrong]
        row.wrong += [f"line {each} has {form.address_text(at)}, too" for each, at in twins[:1]]
        if row.wrong:
            made.left.append(f"{name}:{row.line}:1: {'; '.join(row.wrong)}")
        else:
            made.rows.append(f"{{{', '.join(f'{key}: {value}' for key, value in row.found.items())}}}")
    if "table" not in places and how.addresses != "4xxxx":
        made.assumed.append("no column names the table of Modbus: their section says it, by `space`")
    if "type" not in places:
        made.assumed.append("no column gives the type of a value: none has a sign, and one of one register has 16 bits")
    return made


class _Row:
    """One line: what each cell says, the row of a map in the making, what is wrong with it, and what must be asked."""

    def __init__(self, line: int, cells: Sequence[str], places: Mapping[str, int]) -> None:
        self.line = line
        self.said = {what: cells[place] if place < len(cells) else "" for what, place in places.items()}
        self.others = [each for at, each in enumerate(cells) if at not in places.values()]
        self.addresses = range(0)
        self.found: dict[str, str] = {}
        self.wrong: list[str] = []
        self.asked: list[str] = []

    def read(self, how: Reading) -> None:
        if _in_names(how.columns):
            self.said["name"], unit = cell.named(self.said["name"])
            self.said["unit"] = self._get("unit") or unit
        self._address(how)
        self._name()
        self._access()
        said = self._get("order").lower()
        self._width("high" if said == "high" else "low" if said == "low" else how.order)
        self._scale(how.way, asks="unit" not in how.columns)

    def loose(self) -> list[str]:
        """The cells that belong to no register: of other columns, and of a line without an address."""
        none = all(cell.place(self.said["address"], each) is None for each in cell.ADDRESSES)
        return [*self.others, *(self.said.values() if none else ())]

    def _get(self, what: str) -> str:
        said = self.said.get(what, "")
        return "" if said.lower() in NOTHING else said

    def _address(self, how: Reading) -> None:
        said, table = self.said["address"], self._get("table")
        place = cell.place(said, how.addresses or "")
        own = place.space if place else None
        space = cell.space(table, how.codes) if "table" in self.said else own or "holding"
        if place is None:
            what = "names two addresses, or none" if "(" in said else f"is no {how.addresses} address of one register"
            self.wrong.append(f"`{_shown(said)}` {what}")
        elif space is None or own not in (None, space):
            self.wrong.append(f"`{_shown(table)}` names no table of Modbus{' of this address' * bool(own)}")
        else:
            first = form.SPACES[space] + place.first
            self.addresses = range(first, first + place.words)
            self.found["address"] = f"{place.first:04X}H"
            self.found |= {"space": space} if space != "holding" else {}

    def _name(self) -> None:
        name, number = self._get("name"), self._get("id")
        if number:
            self.found["id"] = _quoted(number)
            self.wrong += [] if form.ID.pattern.fullmatch(number) else [f"`{_shown(number)}` is no id"]
        self.found["name" if name.isascii() else "wording"] = _quoted(name)
        if not name or not name.isprintable():
            self.wrong.append(f"the name is {'no text' if name else 'empty'}")

    def _access(self) -> None:
        if said := self._get("access"):
            access = cell.access(said)
            self.wrong += [] if access else [f"`{_shown(said)}` is no access; write r, w or rw"]
            self.found["access"] = access or ""
            if self.found.get("space") in ("input", "discrete") and "w" in self.found["access"]:
                self.wrong.append(f"`{_shown(said)}`: {self.found['space']} is read only")

    def _width(self, order: cell.Order | None) -> None:
        bit, pair = self.found.get("space") in _BITS, len(self.addresses) == len(("high", "low"))
        words = {2} if pair else set[int]()
        for what in ("type", "size"):
            said = self._get(what)
            kind = cell.width(said)
            right = said.lower() in ("", "bit", "bool", "boolean", "1") if bit else kind is not None
            if said and cell.names_table(said):
                self.asked.append(f"`{said}` names a table of Modbus; name its column by --column table=...")
            elif not right and (said or (what == "type" and what in self.said)):
                self.wrong.append(f"`{_shown(said)}` is no {what} of {'a bit' if bit else 'a value of 16 or 32 bits'}")
            words |= {kind[0]} if kind and not bit else set()
            self.found |= {"signed": "true"} if kind and kind[1] else {}
        if len(words) > 1 or (bit and pair):
            self.wrong.append("address, type and size say different numbers of registers")
        elif words == {2} and self.addresses:
            self._pair(order)
        below = next((each for each in self.others if re.match("-[0-9]", each)), None)
        if below and "type" not in self.said:
            self.wrong.append(f"`{_shown(below)}` is negative, and no column says how a sign is sent")

    def _pair(self, order: cell.Order | None) -> None:
        """A value of 32 bits, in two registers."""
        self.addresses = range(self.addresses[0], self.addresses[0] + 2)
        self.found["address"] += f"-{self.addresses[1] & 0xFFFF:04X}H"
        self.found["words"] = "2"
        if not self.addresses[1] & 0xFFFF:
            self.wrong.append("no register follows FFFFH")
        elif order is None:
            self.asked.append("which word of a value of 32 bits comes first; say --words high or low")
        elif order == "low":
            self.found["order"] = "low_first"

    def _scale(self, way: Way | None, *, asks: bool) -> None:
        said, scale = self._get("unit"), self._get("scale")
        whole = None if cell.unit(said) else cell.factor(said)
        if whole and scale and cell.factor(scale) not in (whole, whole._replace(unit="")):
            self.wrong.append(f"`{_shown(said)}` and `{_shown(scale)}` are two factors")
            return
        said, scale = ("", said) if whole else (said, scale)
        unit, factor = cell.unit(said), cell.factor(scale)
        if self._get("unit") and self.found.get("space") in _BITS:
            self.wrong.append("one bit has no unit")
        if said and unit is None:
            self.wrong.append(f"`{_shown(said)}` is no unit of a map")
        if factor and factor.unit:
            unit = cell.unit(factor.unit) if unit in (None, cell.unit(factor.unit)) else None
            factor = factor if unit else None
        if scale and (factor is None or not factor.number):
            self.wrong.append(f"`{_shown(scale)}` is no factor")
        elif factor:
            self._factor(factor, way, unit, asks=asks)
        self.found |= {"unit": _quoted(unit)} if unit and "scale" not in self.found else {}

    def _factor(self, factor: cell.Factor, way: Way | None, unit: Unit | None, *, asks: bool) -> None:
        """A factor, which has a unit and is one that a drive may have."""
        number, named = factor.per_count(way), cell.named(self._get("name"))[1] if asks else ""
        if not unit and factor.number != 1 and named:
            ways = "say --column unit=..., the head of the names, or --column unit= for none"
            self.asked.append(f"`({named})` in the name may be the unit; {ways}")
        elif not unit and factor.number != 1:
            self.wrong.append("a factor without a unit")
        elif number is None:
            both = f"{factor.number} {unit} per count or {factor.number} counts per {unit}"
            self.asked.append(f"`{factor.number}` may be {both}; say --factor multiply or divide")
        elif unit and (doubted := doubt(number, unit, 16 * len(self.addresses))):
            self.wrong.append(doubted[0])
        elif unit and number * 10**9 % 1:
            self.wrong.append(f"{number} has more than 9 decimals")
        elif unit:
            self.found["unit"] = _quoted(unit)
            self.found["scale"] = f"{{factor: {number.normalize():f}, source: the table}}"


def _written(rows: Sequence[_Row]) -> str:
    """How addresses are written, where that shows."""
    said = [row.said["address"] for row in rows]
    if any(map(cell.marked, said)):
        return "hex"
    plain = [one for one in said if cell.plain(one)]
    return "4xxxx" if plain and all(map(cell.numbers, plain)) else "decimal"


def _unclear(first: int, rows: Sequence[_Row]) -> list[str]:
    """Addresses that may be decimal or hexadecimal."""
    if _written(rows) == "4xxxx":
        return []
    shown = [row for row in rows if cell.marked(row.said["address"])]
    plain = [row for row in rows if cell.plain(row.said["address"])]
    if not shown:
        return [f"{first}:1: no address shows whether it is hexadecimal; say --addresses {', '.join(cell.ADDRESSES)}"]
    beside = f"and `{shown[0].said['address']}` of line {shown[0].line} is hexadecimal; say --addresses hex or decimal"
    return [f"{row.line}:1: `{row.said['address']}` may be decimal, {beside}" for row in plain]


def _ids(first: int, head: str, rows: Sequence[_Row]) -> list[str]:
    """Whether the column of the ids may be another: several registers have one of them, or they are functions."""
    ids = Counter(row.said["id"] for row in rows if row.said["id"].lower() not in NOTHING)
    codes = "fun" in head.lower() and all(cell.space(each, codes=True) for each in ids)
    shared = next((each for each, number in ids.items() if codes or number > 1), None)
    ways = "say --column id=..., --column id= for none, or --column table=..."
    return [f"{first}:1: `{_shown(head)}`, with `{_shown(shared)}`, may be no id; {ways}"] if shared else []


def _tables(rows: Sequence[_Row]) -> list[str]:
    """What names a table of Modbus where no column does."""
    found = [(row.line, each) for row in rows for each in row.loose() if cell.names_table(each)]
    ways = "name its column by --column table=..., or split the file; if it has but one table, say --column table="
    return [f"{line}:1: `{_shown(each)}` names a table of Modbus; {ways}" for line, each in found]


def _lines(text: str, name: str) -> Iterator[tuple[int, list[str]]]:
    """Lines by their numbers, as cells, by the character that parts most of the first one. Raises TableError."""
    lines = text.splitlines()
    first = next((line for line in lines if line.strip()), "")
    by = max("\t;,|", key=first.count)
    if not first.count(by):
        yield from ((number, re.split(r" {2,}", line.strip())) for number, line in enumerate(lines, 1))
        return
    reader, begun = csv.reader(io.StringIO(text, newline=""), delimiter=by), 1
    try:
        for row in reader:
            yield begun, [" ".join(each.split()) for each in row]
            begun = reader.line_num + 1
    except csv.Error as error:
        raise TableError(f"{name}:{begun}:1: cannot be read as a table: {error}") from None


def _places(place: str, heads: Sequence[str], named: Mapping[str, str]) -> dict[str, int]:
    """Which column is what. Raises TableError."""
    places, wrong = {}, []
    if _in_names(named):
        named = {what: head for what, head in named.items() if what != "unit"}
    free = [None if head in named.values() else _meant(head) for head in heads]
    for what in COLUMNS:
        head = named.get(what)
        found = [at for at in range(len(heads)) if (free[at] == what if head is None else head and heads[at] == head)]
        if len(found) > 1:
            both = " and ".join(f"`{_shown(heads[at])}`" for at in found)
            wrong.append(f"{both} may be the {what}; name one by --column {what}=...")
        elif found:
            places[what] = found[0]
        elif head:
            wrong.append(f"no column is called `{_shown(head)}`")
        elif what in MUST:
            wrong.append(f"no column is the {what}; name it, such as --column {what}=`{_shown(heads[0])}`")
    if wrong:
        raise TableError("\n".join(f"{place}: {each}" for each in wrong))
    return places


def _in_names(named: Mapping[str, str]) -> bool:
    """Whether units are said to be in the column of the names."""
    head = named.get("unit") or ""
    return bool(head) and (head == named.get("name") or ("name" not in named and _meant(head) == "name"))


def _meant(head: str) -> str | None:
    """What a column is by its head: the whole of it, or its last word that is known."""
    said = re.sub(r"[\s_]+", " ", head.lower()).strip(" .:")
    parts = [each.strip(".") for each in re.split(r"[^\w./]+", said)]
    for known in (said, *reversed(parts)):
        for what, words in COLUMNS.items():
            if known in words:
                return what
    return None


def _shown(said: str) -> str:
    """What a cell says, as a terminal can show it."""
    return file_name(said if len(said) <= 60 else said[:60] + "...")


def _quoted(said: str) -> str:
    """A text in a row of YAML; quoted where it would be read otherwise."""
    plain = re.fullmatch(r"[A-Za-z][A-Za-z0-9 ./()_+-]*", said) and said.lower() not in _TAKEN
    return said if plain else '"' + said.replace("\\", "\\\\").replace('"', '\\"') + '"'
