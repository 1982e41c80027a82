"""Which facts of a map a vector or a relation pins, found from the plain document and without the project's rules.

A pinned fact cannot be changed alone without a contradiction that the loader must notice. What is not pinned rests
on the map author's care alone; the fuzz run counts such facts by kind.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

Path = tuple[str | int, ...]
"""Keys and indices from the root of the document to a value."""
Plain = Any
"""A YAML document as dict, list and str."""

READS = (3, 4)


TABLES = {"": 0, "coil": 2 << 16, "discrete": 4 << 16, "input": 6 << 16}


def number(text: str) -> int:
    """0026H -> 38, 500 -> 500; what is in another table than the holding registers is apart from them."""
    table, _, text = text.rpartition(" ")
    return TABLES[table] + (int(text[:-1], 16) if text.endswith("H") else int(text))


def span(text: str, digit: Callable[[str], int]) -> range:
    """0106H-0109H or 8-F -> the numbers from first to last."""
    first, _, last = text.partition("-")
    return range(digit(first), digit(last or first) + 1)


def addresses(text: str) -> range:
    """An address or a range of addresses."""
    return span(text, number)


def bits(text: str) -> range:
    """A bit or a range of bits."""
    return span(text, lambda digit: int(digit, 16))


def decimal(text: str | None) -> int | None:
    """A number printed in plain decimal, or None."""
    return int(text) if text is not None and text.isascii() and text.isdecimal() else None


def split_id(text: str) -> tuple[str, int]:
    """U1-07 -> (U1-, 7)."""
    head = text.rstrip("0123456789")
    return head, int(text[len(head) :] or 0)


def kind_of(path: Path) -> str:
    """What a value is, whichever of its list it is: `sections[].registers[].address`."""
    return "".join("[]" if isinstance(part, int) else f".{part}" for part in path).lstrip(".")


@dataclass(frozen=True)
class Row:
    """A register row with the section that it is in."""

    section: Plain
    entry: Plain

    @property
    def addresses(self) -> range:
        """Its addresses."""
        return addresses(self.entry["address"])


class Document:
    """A map as a plain document, with the look-ups that pins need."""

    def __init__(self, root: Plain) -> None:
        """Keep the document; everything else is found when asked for."""
        self.root = root

    def at(self, path: Path) -> Plain:
        """The value at a path."""
        value = self.root
        for part in path:
            value = value[part]
        return value

    @cached_property
    def rows(self) -> dict[int, Row]:
        """Each register address with its row."""
        return {
            address: row
            for section in self.root["sections"]
            for row in (Row(section, entry) for entry in section["registers"])
            for address in row.addresses
        }

    @cached_property
    def frames(self) -> dict[str, Plain]:
        """The example frames by id."""
        return {frame["id"]: frame for frame in self.root["frames"]}

    @cached_property
    def settings(self) -> dict[str, Plain]:
        """The keypad settings by id."""
        return {setting["id"]: setting for setting in self.root["settings"]}

    def exists(self, address: int) -> bool:
        """Whether a row or an area has an address."""
        return address in self.rows or any(
            address in addresses(area["addresses"]) for area in self.root.get("areas", [])
        )

    @cached_property
    def choices(self) -> list[Plain]:
        """The properties of the serial line that a setting chooses."""
        serial = self.root["serial"]
        return [serial[key] for key in ("mode", "baud", "format", "unit") if key in serial]

    @cached_property
    def fault_words(self) -> range:
        """The fault words whose bits are numbered, or none."""
        relation = self.root["faults"].get("bits")
        return range(number(relation["first"]), number(relation["last"]) + 1) if relation else range(0)

    @cached_property
    def fault_ids(self) -> set[str]:
        """The ids of the bits of the fault words."""
        rows = [self.rows[address] for address in self.fault_words if address in self.rows]
        return {bit["id"] for row in rows for bit in row.entry.get("bits", []) if "id" in bit}

    @cached_property
    def reporting(self) -> set[int]:
        """Addresses whose listed values repeat the table of faults or of errors."""
        faults = self.root["faults"]
        found = {a for text in faults["registers"] for a in addresses(text)} if faults.get("codes") else set()
        form = self.root["errors"].get("form", {})
        if "address" in form:
            found.add(number(form["address"]))
        return {address for address in found if address in self.rows and "values" in self.rows[address].entry}

    @cached_property
    def used_addresses(self) -> set[int]:
        """Addresses that something else in the map names: commands, conditions, frames, settings, errata ..."""
        return {address for text in _named(self.root, "") for address in addresses(text)} | set(self._carried())

    def _carried(self) -> Iterator[int]:
        for frame in self.root["frames"]:
            means = frame["means"]
            if "address" in means and "error" not in means:
                start = number(means["address"])
                yield from range(start, start + number(means.get("words", "1")))

    @cached_property
    def used_bits(self) -> set[tuple[int, int]]:
        """Address and bit that commands and conditions name."""
        operation = self.root["operation"]
        found = set()
        for command in operation["commands"]:
            for text in (*command.get("set", []), *command.get("clear", [])):
                found |= {(number(command["register"]), bit) for bit in bits(text)}
        for condition in self.conditions:
            found |= {(number(condition["register"]), bit) for bit in bits(condition.get("bit", "1-0"))}
        return found

    @cached_property
    def conditions(self) -> list[Plain]:
        """Every condition: of standstill, of the reference, of the status, of a scale."""
        operation = self.root["operation"]
        found = [*operation["standstill"]["all"], *operation["reference"].get("verify", [])]
        found += [condition for status in operation["status"] for condition in status["any"]]
        scales = (row.entry.get("scale", {}) for row in self.rows.values())
        return found + [scale["when"] for scale in scales if "when" in scale]

    @cached_property
    def errors_in_frames(self) -> set[int]:
        """The error codes that example frames carry."""
        return {number(frame["means"]["error"]) for frame in self.root["frames"] if "error" in frame["means"]}


def _named(value: Plain, key: str) -> Iterator[str]:
    """Every address, or range of them, that an entry names by `register`, `registers`, or in a reference."""
    if isinstance(value, dict):
        for name, inner in value.items():
            if name != "sections":
                yield from _named(inner, name)
            else:
                yield from (t for s in inner for r in s["registers"] for t in _named(r.get("scale", {}), ""))
    elif isinstance(value, list):
        for inner in value:
            yield from _named(inner, key)
    elif key in ("register", "registers") and value.endswith("H"):
        yield value
    elif key == "about" and value.startswith("register "):
        yield value.removeprefix("register ").partition("-")[0]


Pin = Callable[[Document, Path, str], bool]
"""Whether the value at a path is pinned against a new one."""


def always(_: Document, __: Path, ___: str) -> bool:
    """Pinned against every other value."""
    return True


def _printed(document: Document, path: Path, new: str) -> bool:
    """A printed frame whose checksum holds, or whose wrong checksum is that of other bytes."""
    frame, old = document.at(path[:-1]), document.at(path)
    if frame["checksum"] == "right":
        return True
    tail = 5 if frame["mode"] == "rtu" else 8
    return "printed_checksum_of" in frame and old[:-tail] == new[:-tail]


def _quantity_register(document: Document, path: Path, _: str) -> bool:
    return len(document.at(path[:2])["means"].get("values", [])) == 1


def _answers(document: Document, path: Path, new: str) -> bool:
    """The request that a reply answers, where another has another unit, function or quantity."""
    old = document.at(path)
    keys = ("unit", "function", "words")
    asked, other = (document.frames[id_]["means"] if id_ in document.frames else {} for id_ in (old, new))
    return any(asked.get(key) != other.get(key) for key in keys) and "error" not in document.at(path[:-1])["means"]


def _row_address(document: Document, path: Path, new: str) -> bool:
    row = Row(document.at(path[:2]), document.at(path[:-1]))
    return (
        _in_series(row)
        or ".." in row.entry.get("id", "")
        or any(address in document.used_addresses for address in set(row.addresses) - set(addresses(new)))
        or any(address in document.fault_words for address in row.addresses if _has_ids(row))
    )


def _has_ids(row: Row) -> bool:
    return any("id" in bit for bit in row.entry.get("bits", []))


def _in_series(row: Row) -> bool:
    """Whether a series of its section says where a row stands."""
    id_ = row.entry.get("id", "").partition("..")[0]
    group, own = split_id(id_)
    for series in row.section.get("series", []):
        first, _, last = series["ids"].partition("..")
        if split_id(first)[0] == group and split_id(first)[1] <= own <= split_id(last or first)[1]:
            return id_ not in series.get("apart", [])
    return False


def _row_id(document: Document, path: Path, _: str) -> bool:
    row = Row(document.at(path[:2]), document.at(path[:-1]))
    id_ = row.entry["id"]
    apart = any(id_ in series.get("apart", []) for series in row.section.get("series", []))
    return apart or _in_series(row) or ".." in id_ or "register" in document.settings.get(id_, {})


def _series_ids(document: Document, path: Path, new: str) -> bool:
    """The first id of a series moves all its places; the last only says where it ends."""
    section, series = document.at(path[:2]), document.at(path[:-1])
    held = [row for row in section["registers"] if _in_series(Row({"series": [{**series, "ids": new}]}, row))]
    return new.partition("..")[0] != series["ids"].partition("..")[0] and bool(held)


def _fault_code(document: Document, path: Path, _: str) -> bool:
    return document.at(path[:-1]).get("id") in document.fault_ids or bool(_listed_faults(document))


def _listed_faults(document: Document) -> list[int]:
    named = {a for text in document.root["faults"]["registers"] for a in addresses(text)}
    return [address for address in document.reporting if address in named]


def _fault_last(document: Document, path: Path, new: str) -> bool:
    dropped = range(number(new) + 1, number(document.at(path)) + 1)
    rows = [document.rows[address] for address in dropped if address in document.rows]
    return any(_has_ids(row) for row in rows) or not document.exists(number(new))


def _fault_id(document: Document, _: Path, __: str) -> bool:
    return bool(document.fault_words)


def _bit_number(document: Document, path: Path, new: str) -> bool:
    row, bit = Row(None, document.at(path[:4])), document.at(path[:-1])
    address = row.addresses[0]
    if address in document.fault_words and "id" in bit:
        return True
    left = set(bits(bit["bit"])) - set(bits(new))
    return any((address, one) in document.used_bits for one in left)


def _bit_id(document: Document, path: Path, _: str) -> bool:
    return Row(None, document.at(path[:4])).addresses[0] in document.fault_words


def _listed_value(document: Document, path: Path, _: str) -> bool:
    """A value of a register that a command writes, a condition awaits, or a table of codes repeats."""
    address, value = Row(None, document.at(path[:4])).addresses[0], number(document.at(path))
    commands = [c for c in document.root["operation"]["commands"] if number(c["register"]) == address and "value" in c]
    awaited = [c for c in document.conditions if number(c["register"]) == address and "bit" not in c]
    return (
        address in document.reporting
        or value in {number(command["value"]) for command in commands}
        or value in {number(condition["equals"]) for condition in awaited}
    )


def _error_code(document: Document, path: Path, _: str) -> bool:
    form = document.root["errors"].get("form", {})
    listed = "address" in form and number(form["address"]) in document.reporting
    return listed or number(document.at(path)) in document.errors_in_frames


def _error_form(document: Document, _: Path, __: str) -> bool:
    return bool(document.errors_in_frames)


def _error_added(document: Document, path: Path, new: str) -> bool:
    return _error_form(document, path, new) or number(new) not in (0x40, 0x80)


def _command_value(document: Document, path: Path, new: str) -> bool:
    """A value that the register lists with a name, or that another command has."""
    command = document.at(path[:-1])
    row = document.rows[number(command["register"])].entry
    taken = {
        number(other["value"])
        for other in document.root["operation"]["commands"]
        if other is not command and other["register"] == command["register"] and "value" in other
    }
    return "values" in row or number(new) in taken


def _does(document: Document, path: Path, new: str) -> bool:
    """A name that the register's table contradicts, or that another command has."""
    taken = {command["does"] for command in document.root["operation"]["commands"]}
    return new in taken or "because" not in document.at(path[:-1])


def _cleared(document: Document, path: Path, new: str) -> bool:
    """A bit that a stop or a direction clears because another direction sets it."""
    commands, command = document.root["operation"]["commands"], document.at(path[:-2])
    others = [other for other in commands if other is not command and other["register"] == command["register"]]
    moves = [other for other in others if other["does"].startswith(("run_", "jog_f", "jog_r"))]
    set_by_others = {bit for other in moves for text in other.get("set", []) for bit in bits(text)}
    kept = {bit for text in command.get("clear", []) if text != document.at(path) for bit in bits(text)}
    kept |= {bit for text in command.get("set", []) for bit in bits(text)} | set(bits(new))
    stops = command["does"] in ("stop", "coast_stop", "quick_stop")
    return (command in moves or stops or command["does"].startswith("run_")) and not set_by_others <= kept


def _refers(document: Document, _: Path, new: str) -> bool:
    """A reference to a register that nothing describes."""
    return any(not document.exists(address) for address in addresses(new)) or not addresses(new)


def _setting_id(document: Document, path: Path, _: str) -> bool:
    setting = document.at(path[:-1])
    return "register" in setting or any(choice.get("setting") == setting["id"] for choice in document.choices)


def _setting_value(document: Document, path: Path, _: str) -> bool:
    setting, old = document.at(path[:2]), number(document.at(path))
    chosen = any(choice.get("setting") == setting["id"] and choice.get("codes") for choice in document.choices)
    needed = setting.get("needed", {}).get("value")
    return chosen or decimal(setting.get("default")) == old or (needed is not None and number(needed) == old)


def _needed(document: Document, path: Path, new: str) -> bool:
    values = [number(value["value"]) for value in document.at(path[:2]).get("values", [])]
    return bool(values) and number(new) not in values


def _setting_default(document: Document, path: Path, new: str) -> bool:
    setting = document.at(path[:-1])
    values = [number(value["value"]) for value in setting.get("values", [])]
    chosen = any(choice.get("setting") == setting["id"] and "default" in choice for choice in document.choices)
    return decimal(new) is not None and (chosen or (bool(values) and decimal(new) not in values))


def _choice(document: Document, path: Path) -> tuple[Plain, Plain]:
    """A property of the serial line and the setting that chooses it, {} where there is none."""
    choice = document.at(path[:2])
    return choice, document.settings.get(choice.get("setting", ""), {})


def _code(document: Document, path: Path, _: str) -> bool:
    return bool(_choice(document, path)[1].get("values"))


def _choice_default(document: Document, path: Path, new: str) -> bool:
    choice, setting = _choice(document, path)
    codes = [number(code["code"]) for code in choice.get("codes", [])]
    return decimal(setting.get("default")) is not None or (bool(codes) and number(new) not in codes)


def _choice_setting(document: Document, _: Path, new: str) -> bool:
    return new not in document.settings


def _said(words: Callable[[str], list[str]]) -> Pin:
    """Pinned by the words of the setting's value, when they hold exactly what the code says."""

    def pin(document: Document, path: Path, _: str) -> bool:
        code = document.at(path[:-1])
        values = _choice(document, path)[1].get("values", [])
        texts = [
            value.get("zh", "") + " " + value["name"]
            for value in values
            if number(value["value"]) == number(code["code"])
        ]
        return any(word in text for text in texts for word in words(document.at(path)))

    return pin


def _parity_words(parity: str) -> list[str]:
    return {"none": [", N,", "无校验"], "even": [", E,", "偶校验"], "odd": [", O,", "奇校验"]}[parity]


def _area(document: Document, path: Path, new: str) -> bool:
    area = document.at(path[:-1])
    return bool(area["examples"]) and new[:5] != area["addresses"][:5]


def _one_bit(_: Document, __: Path, new: str) -> bool:
    return number(new) & (number(new) - 1) != 0 or number(new) == 0


def _factor(document: Document, path: Path, _: str) -> bool:
    """A scale, or a unit, of a register whose value a frame carries in engineering units."""
    row = Row(None, document.at(path[:4]))
    quantities = [q for frame in document.root["frames"] for q in frame["means"].get("quantities", [])]
    return number(f"{row.entry['address']}") in {number(q["register"]) for q in quantities if float(q["value"])}


def _words_limit(reads: bool) -> Pin:
    def pin(document: Document, _: Path, new: str) -> bool:
        means = [frame["means"] for frame in document.root["frames"] if "error" not in frame["means"]]
        words = [number(m["words"]) for m in means if "words" in m and (number(m["function"]) in READS) == reads]
        return any(count > int(new) for count in words)

    return pin


def _unit_bound(document: Document, path: Path, new: str) -> bool:
    units = [number(frame["means"]["unit"]) for frame in document.root["frames"]]
    low = path[-1] == "min"
    return any(unit and (unit < number(new) if low else unit > number(new)) for unit in units)


def _function(document: Document, path: Path, new: str) -> bool:
    """A function of a frame, or one that no block sends; 08H has sub-functions, which the others lack."""
    code, frames = number(document.at(path)), document.root["frames"]
    framed = {number(frame["means"]["function"]) for frame in frames if "error" not in frame["means"]}
    return 8 in (code, number(new)) or number(new) not in (*READS, 6, 16) or code in framed


def _sub_function(document: Document, path: Path, _: str) -> bool:
    code = number(document.at(path))
    found = {number(frame["means"].get("sub_function", "99999")) for frame in document.root["frames"]}
    return code in found


def _shows(document: Document, path: Path, new: str) -> bool:
    """The one pin that must be shown, or one that something else shows."""
    listed = [one["shows"] for one in document.at(path[:2])]
    return document.at(path) == "running" or new in listed


def _present(document: Document, _: Path, new: str) -> bool:
    return not any(number(new) in addresses(text) for text in document.root["faults"]["registers"])


def _watched(document: Document, _: Path, new: str) -> bool:
    return number(new) not in {number(one["code"]) for one in document.root["faults"]["codes"]}


def _equals(document: Document, path: Path, new: str) -> bool:
    """A number that its bits cannot hold, or that the register does not list, or that it calls turning."""
    condition = document.at(path[:-1])
    row = document.rows[number(condition["register"])].entry
    width = len(bits(condition["bit"])) if "bit" in condition else 16
    named = {number(value["value"]): value["zh"] for value in row.get("values", [])} if "bit" not in condition else {}
    turning = "standstill" in path and any(word in named.get(number(new), "") for word in ("运行", "故障"))
    return (
        not 0 <= number(new) < 1 << width
        or (bool(named) and number(new) not in named)
        or turning
        or ("standstill" in path and "bit" in condition and width == 1)
    )


_MEANS = ("unit", "function", "address", "words", "byte_count", "values[]", "sub_function", "data", "error")
_REFERENCES = (
    "operation.commands[].register",
    "operation.reference.register",
    "operation.reference.verify[].register",
    "operation.standstill.all[].register",
    "operation.status[].any[].register",
    "operation.measures[].register",
    "operation.commanded_by.all[].register",
    "identity.all[].register",
    "watchdog.time.register",
    "sections[].registers[].scale.when.register",
    "faults.registers[]",
    "faults.bits.first",
    "storage.register",
    "serial.broadcast.start_addresses[]",
)
_ALWAYS = (
    "frames[].correct",
    "frames[].checksum",
    "frames[].printed_checksum_of",
    "frames[].direction",
    "frames[].mode",
    "frames[].plc.registers[]",
    "frames[].plc.bits",
    "frames[].means.quantities[].value",
    "frames[].means.quantities[].unit",
    "sections[].series[].base",
    "sections[].series[].apart[]",
    "areas[].examples[].number",
    "areas[].examples[].address",
    "errors.form.kind",
    "operation.commands[].set[]",
    "storage.method",
    "settings[].register",
    "watchdog.reactions[].value",
    *(f"frames[].means.{key}" for key in _MEANS),
)
PINS: dict[str, Pin] = {
    **dict.fromkeys(_ALWAYS, always),
    **dict.fromkeys(_REFERENCES, _refers),
    "frames[].printed": _printed,
    "frames[].answers": _answers,
    "frames[].means.quantities[].register": _quantity_register,
    "sections[].registers[].address": _row_address,
    "sections[].registers[].id": _row_id,
    "sections[].registers[].scale.factor": _factor,
    "sections[].registers[].unit": _factor,
    "sections[].registers[].values[].value": _listed_value,
    "sections[].registers[].bits[].bit": _bit_number,
    "sections[].registers[].bits[].id": _bit_id,
    "sections[].series[].ids": _series_ids,
    "faults.codes[].code": _fault_code,
    "faults.codes[].id": _fault_id,
    "faults.bits.first": always,
    "faults.bits.last": _fault_last,
    "errors.codes[].code": _error_code,
    "errors.form.add": _error_added,
    "errors.form.function": _error_form,
    "errors.form.address": _error_form,
    "operation.commands[].value": _command_value,
    "operation.commands[].does": _does,
    "operation.commands[].clear[]": _cleared,
    "operation.standstill.all[].equals": _equals,
    "operation.reference.verify[].equals": _equals,
    "operation.status[].shows": _shows,
    "operation.measures[].shows": _shows,
    "faults.present": _present,
    "watchdog.fault": _watched,
    "settings[].id": _setting_id,
    "settings[].values[].value": _setting_value,
    "settings[].needed.value": _needed,
    "settings[].default": _setting_default,
    "serial.mode.codes[].code": _code,
    "serial.baud.codes[].code": _code,
    "serial.format.codes[].code": _code,
    "serial.mode.codes[].mode": _said(lambda mode: [mode.upper()]),
    "serial.baud.codes[].baud": _said(lambda rate: [rate]),
    "serial.format.codes[].parity": _said(_parity_words),
    "serial.format.codes[].data_bits": _said(lambda count: [f"<{count}, "]),
    "serial.format.codes[].stop_bits": _said(lambda count: [f", {count}>"]),
    "serial.mode.default": _choice_default,
    "serial.baud.default": _choice_default,
    "serial.format.default": _choice_default,
    "serial.unit.default": _choice_default,
    "serial.mode.setting": _choice_setting,
    "serial.baud.setting": _choice_setting,
    "serial.format.setting": _choice_setting,
    "serial.unit.setting": _choice_setting,
    "serial.unit.min": _unit_bound,
    "serial.unit.max": _unit_bound,
    "areas[].addresses": _area,
    "storage.add": _one_bit,
    "limits.read_words.value": _words_limit(True),
    "limits.write_words.value": _words_limit(False),
    "functions[].code": _function,
    "functions[].sub_functions[].code": _sub_function,
}
"""How each kind of fact is pinned; a kind that is not here never is."""


def pinned(document: Document, path: Path, new: str) -> bool:
    """Whether a vector or relation of the map contradicts a new value at a path."""
    pin = PINS.get(kind_of(path))
    return pin is not None and pin(document, path, new)
