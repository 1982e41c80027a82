"""Random changes of a map as its authors make them: names, symbols, scales, bits, lists, limits, commands, texts."""

import random
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from driveblocks.maps import form
from driveblocks.maps.form import Form
from driveblocks.maps.model import Drive
from driveblocks.maps.shape import EntryOf, ListOf, OneOf, Shape, keys_of

Plain = dict[str, Any]
"""An entry of a map as YAML has it: mappings, lists and texts."""

WORDS = (
    "IF", "EN", "INT", "Limit", "Step", "On", "Value", "Unknown", "State", "Error", "Command", "Request", "Reply",
    "Reference", "Standstill", "Can read", "Can write", "Fault number", "Fault text en", "Value text zh", "Test 0300H",
    "Test scales", "Test access", "D", "L", "T", "Word", "EOF", "NaN", "Real to int", "R trig", "Max", "Counter",
    "85 °C", "Over 85 °C", "Überlast", "Ω", "输出", "Ⅱ stage", "2 wires", "4-20 mA", "+", "x1", "It's $5", "(* a *)",
    "a *) b", "{{ name }}", "{% if %}", "100 %", "Run/stop (local)", "Length", "Address", "Count", "Number", "Rest",
    "Output frequency Hz", "Output frequency", "Running", "Stopped", "Ready", "Check", "Raw", "Words", "Adu",
    "A name of thirty-one characters", "A very long name that nobody can take in", "Short " * 40 + "end", "ab" * 15,
)  # fmt: skip
"""Names that stand for a class of names."""

SYMBOLS = (
    "IF", "EN", "INT", "Value", "Unknown", "Command", "CanRead", "TestScales", "D", "Status", "OutputFrequency", "Max",
    "A", "Running", "StandstillProven", "Eof", "TP", "Abcdefghijklmnopqrstuvwxyzabcde", "Abcdefghijklmnopqrstuvwxyz",
    "Trig", "ToInt", "LWord", "Count", "Retain", "X2",
)  # fmt: skip
TEXTS = (
    "ok", "it's $5", "(* a", "a *) b", "{{ x }} {% y %} {# z #}", "85 °C", "two\nlines", "tab\there", 'say "so"',
    "a very long text " * 30 + "ends", "back\\slash", "$0A", "—", "a" * 300, "Ω and µ", "''", "END_VAR; IF", "ends (*",
)  # fmt: skip
CHINESE = (
    "过流",
    "1: 过流",
    "过" * 26,
    "过" * 27,
    "a过" * 40,
    "过流 (*",
    "*)过",
    "℃",
    "𠮷",
    "'过$'",
    "x",
    "②",
    "过\n流",
)
NUMBERS = (
    "0", "1", "2", "3", "7", "10", "15", "16", "17", "31", "32", "100", "127", "128", "255", "256", "1000", "32767",
    "32768", "65534", "65535", "65536", "70000", "-1", "-2", "-32768", "-40000", "00H", "40H", "80H", "FFH", "FFFFH",
    "10000H", "FFFFFFFFH", "999999",
)  # fmt: skip
FACTORS = (
    "0.03", "0.001", "0.007", "7", "3", "0.333333333", "0.000000001", "999999999.999999999", "0.0625", "33.3", "0.1",
    "1", "2.5", "12.345678901"[:11], "0.01", "100", "1000000", "0.123456789",
)  # fmt: skip
ADDRESSES = ("0000H", "0001H", "00FFH", "0100H", "7FFFH", "8000H", "9000H", "FFFEH", "FFFFH", "2FFFH", "4000H")
PREFIXES = (
    "MB", "VFD", "R", "F", "CLOCK", "FP", "M", "X", "ABCDEFGHIJKL", "IF", "T", "TO", "SEEK", "FLT", "READ", "C2",
)  # fmt: skip

_POOLS: dict[str, tuple[str, ...]] = {
    form.ENGLISH.name: TEXTS,
    form.TEXT.name: (*TEXTS, *CHINESE),
    form.NUMBER.name: NUMBERS,
    form.COUNT.name: NUMBERS,
    form.DECIMAL.name: FACTORS,
    form.ADDRESS.name: ADDRESSES,
    form.ADDRESSES.name: (*ADDRESSES, "0100H-0103H", "5000H-50FFH", "0000H-FFFFH", "FFF0H-FFFFH"),
    form.BITS.name: ("0", "7", "8", "F", "0-3", "4-7", "8-F", "0-F", "1-E", "0-1", "E-F", "3-5", "C"),
    form.SYMBOL.name: SYMBOLS,
    form.PREFIX.name: PREFIXES,
    form.ID.name: ("A1", "P0.04", "H5-01", "A1-01..A1-09"),
    form.WORD.name: ("a", "words", "x_1"),
    form.REFERENCE.name: ("prose", "register 0000H"),
    form.ID_FORM.name: ("A9-99", "X.99", "A99"),
}


@dataclass(frozen=True)
class Place:
    """An entry of the map: its class, and its path in words."""

    path: str
    cls: type
    entry: Plain


def places(document: Plain) -> Iterator[Place]:
    """Every entry of a map, outermost first."""
    yield from _inside("", EntryOf(Drive), document)


def _inside(path: str, shape: Shape, value: Any) -> Iterator[Place]:
    if isinstance(shape, EntryOf) and isinstance(value, dict):
        yield Place(path, shape.cls, value)
        keys = keys_of(shape.cls)
        for name, inner in value.items():
            yield from _inside(f"{path}.{name}" if path else name, keys[name].shape, inner)
    elif isinstance(shape, ListOf) and isinstance(value, list):
        for index, item in enumerate(value):
            yield from _inside(f"{path}.{index}", shape.item, item)


def change(document: Plain, chance: random.Random) -> str:
    """Change a map in one way, or in some ways at once; what was done, in words."""
    said = []
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        kinds, weights = zip(*_KINDS, strict=True)
        said.append(chance.choices(kinds, weights)[0](document, chance))
    return "; ".join(said)


def _of(document: Plain, chance: random.Random, *classes: str) -> Place | None:
    """An entry of some classes by their names; rare classes as often as frequent ones."""
    found: dict[type, list[Place]] = {}
    for place in places(document):
        if not classes or place.cls.__name__ in classes:
            found.setdefault(place.cls, []).append(place)
    return chance.choice(found[chance.choice(sorted(found, key=lambda cls: cls.__name__))]) if found else None


def drawn(shape: Shape, chance: random.Random) -> Any:
    """Something that can stand in a place, whether it is right there or not."""
    if isinstance(shape, OneOf):
        return chance.choice(sorted(shape.words))
    if isinstance(shape, Form):
        return chance.choice(_POOLS.get(shape.name, TEXTS))
    if isinstance(shape, ListOf):
        return [drawn(shape.item, chance) for _ in range(chance.choice((0, 1, 1, 2)))]
    keys = keys_of(shape.cls).values()
    return {key.name: drawn(key.shape, chance) for key in keys if key.required or chance.random() < 0.1}


# ---------------------------------------------------------------- the kinds of changes


def _key(document: Plain, chance: random.Random) -> str:
    """Any key of any entry gets another value, whether it was there or not."""
    place = _of(document, chance)
    assert place is not None
    key = chance.choice(list(keys_of(place.cls).values()))
    place.entry[key.name] = drawn(key.shape, chance)
    return f"{place.path}.{key.name} = {_short(place.entry[key.name])}"


def _lose(document: Plain, chance: random.Random) -> str:
    """A key that may be left out is left out, or an item of a list."""
    place = _of(document, chance)
    assert place is not None
    keys = keys_of(place.cls)
    here = [name for name in place.entry if not keys[name].required or isinstance(keys[name].shape, ListOf)]
    if not here:
        return f"{place.path} stays"
    name = chance.choice(here)
    value = place.entry[name]
    if isinstance(value, list) and value and chance.random() < 0.8:
        index = chance.randrange(len(value))
        del value[index]
        return f"{place.path}.{name}.{index} is lost"
    place.entry.pop(name)
    return f"{place.path}.{name} is lost"


def _rename(document: Plain, chance: random.Random) -> str:
    """A name that becomes an identifier, or a symbol."""
    place = _of(document, chance, "Register", "Register", "Bit", "Value", "Fault", "ErrorCode")
    assert place is not None
    key = "symbol" if "symbol" in keys_of(place.cls) and chance.random() < 0.4 else "name"
    used = [each.entry["name"] for each in places(document) if each.entry.get("name")]
    place.entry[key] = chance.choice(SYMBOLS if key == "symbol" else (*WORDS, *used[:20]))
    return f"{place.path}.{key} = {_short(place.entry[key])}"


def _retext(document: Plain, chance: random.Random) -> str:
    """A text, English or Chinese."""
    found = []
    for place in places(document):
        for name, key in keys_of(place.cls).items():
            if key.shape in (form.TEXT, form.ENGLISH) and name in place.entry and name != "id":
                found.append((place, name))
    place, name = chance.choice(found)
    place.entry[name] = chance.choice(CHINESE if name.startswith("zh") else TEXTS)
    return f"{place.path}.{name} = {_short(place.entry[name])}"


def _scale(document: Plain, chance: random.Random) -> str:
    """A register gets a scale, or another."""
    place = _of(document, chance, "Register")
    assert place is not None
    row = place.entry
    if chance.random() < 0.4:
        register = document["operation"]["reference"]["register"]
        rows = [each for each in places(document) if each.entry.get("address") == register]
        place = next((each for each in rows if each.cls.__name__ == "Register"), place)
        row = place.entry
    row.setdefault("unit", chance.choice(["Hz", "A", "V", "%", "°C", "Ohm", "r/min"]))
    row.setdefault("name", chance.choice(WORDS))
    row.setdefault("zh", "值")
    row["scale"] = {**row.get("scale", {"source": "table"}), "factor": chance.choice(FACTORS)}
    if chance.random() < 0.3:
        row["signed"] = chance.choice(["true", "false"])
    if chance.random() < 0.3:
        row["range"] = {"min": "0", "max": chance.choice(["1", "100", "5000", "20000", "65535"])}
    return f"{place.path} has the factor {row['scale']['factor']}"


def _bits(document: Plain, chance: random.Random) -> str:
    """A register has other bits, by their widths."""
    place = _of(document, chance, "Register")
    assert place is not None
    place.entry.pop("values", None)
    place.entry.pop("scale", None)
    bits: list[Plain] = []
    first = 0
    while first < 16:
        last = min(first + chance.choice((0, 0, 0, 1, 2, 3, 7)), 15)
        span = f"{first:X}" if last == first else f"{first:X}-{last:X}"
        name = chance.choice((f"Part {first}", f"Part {first}", chance.choice(WORDS)))
        bit: Plain = {"bit": span, "name": name, "zh": "位"}
        if last > first and chance.random() < 0.7:
            count = min(1 << (last - first + 1), chance.choice((1, 3, 4, 256)))
            bit["values"] = [{"value": f"{n}", "name": f"{name} {n}", "zh": f"值{n}"} for n in range(count)]
        bits.append(bit if chance.random() < 0.8 else {"bit": span, "unused": "true"})
        first = last + 1
    place.entry["bits"] = bits
    place.entry.setdefault("name", "Some word")
    place.entry.setdefault("zh", "字")
    return f"{place.path} has {len(bits)} bits and fields"


def _values(document: Plain, chance: random.Random) -> str:
    """A register has other values, few or many."""
    place = _of(document, chance, "Register")
    assert place is not None
    for key in ("bits", "scale", "range", "masks"):
        place.entry.pop(key, None)
    masks = chance.random() < 0.2
    count = chance.choice((1, 2, 16)) if masks else chance.choice((1, 2, 10, 251, 252, 300))
    step = chance.choice((1, 3, 100))
    numbers = [1 << n for n in range(count)] if masks else [n * step for n in range(count)]
    place.entry["values"] = [{"value": f"{n}", "name": f"Kind {n}", "zh": f"种{n}"} for n in numbers]
    place.entry.update({"masks": "true"} if masks else {})
    place.entry.setdefault("name", "Some word")
    place.entry.setdefault("zh", "字")
    return f"{place.path} has {count} values"


def _rows(document: Plain, chance: random.Random) -> str:
    """A table gets more registers: together or apart, with or without meaning."""
    place = _of(document, chance, "Section")
    assert place is not None
    count, step = chance.choice((1, 10, 100, 300)), chance.choice((1, 2, 7))
    first = chance.choice((0x4000, 0x5000, 0xF000, 0x0A00))
    extra = chance.choice(({}, {"unit": "V", "scale": {"factor": chance.choice(FACTORS), "source": "table"}}))
    for number in range(count):
        row = {"address": f"{(first + number * step) & 0xFFFF:04X}H", "name": f"Row {number}", "zh": f"行{number}"}
        place.entry["registers"].append(row | deepcopy(extra) if number < 100 else row)
    return f"{place.path} gets {count} rows from {first:04X}H in steps of {step}"


def _codes(document: Plain, chance: random.Random) -> str:
    """There are other fault codes or reasons for refusal, few or many."""
    kind = chance.choice(("faults", "errors"))
    count, first = chance.choice((1, 2, 60, 254, 1200)), chance.choice((1, 2, 100))
    text = chance.choice(TEXTS)
    document[kind]["codes"] = [
        {"code": f"{first + n}", "name": f"{text[:40].strip()} {n}", "zh": f"{chance.choice(CHINESE)}{n}"}
        for n in range(count)
    ]
    document["faults"].pop("bits", None)
    for place in places(document):
        if place.cls.__name__ == "Bit":
            place.entry.pop("id", None)
    return f"{count} codes of {kind} from {first}"


def _functions(document: Plain, chance: random.Random) -> str:
    """The drive knows other functions, sub-functions, limits, modes or a broadcast."""
    functions = document["functions"]
    kind = chance.choice(("function", "function", "sub", "limits", "broadcast", "broadcast", "unit"))
    if kind == "function":
        code = chance.choice(("01H", "03H", "04H", "05H", "06H", "08H", "0FH", "10H", "17H", "2BH"))
        if any(each["code"] == code for each in functions):
            document["functions"] = [each for each in functions if each["code"] != code]
        else:
            functions.append({"code": code, "name": "Another function", "zh": "功能", "source": "table"})
        return f"function {code} comes or goes"
    if kind == "sub":
        count = chance.choice((1, 2, 60, 251, 300))
        subs = [{"code": f"{n:04X}H", "name": f"Test {n}", "zh": f"试{n}"} for n in range(count)]
        subs[-1]["code"] = chance.choice((subs[-1]["code"], *NUMBERS))
        document["functions"] = [each for each in functions if each["code"] != "08H"]
        document["functions"].append(
            {"code": "08H", "name": "Diagnostics", "zh": "诊断", "source": "table", "sub_functions": subs}
        )
        return f"{count} sub-functions, the last {subs[-1]['code']}"
    if kind == "limits":
        name = chance.choice(("read_words", "write_words", "data_bytes", "ascii_data_bytes"))
        document["limits"][name] = {"value": chance.choice((*NUMBERS[1:18], "123", "125", "250")), "source": "table"}
        return f"limits.{name} = {document['limits'][name]['value']}"
    if kind == "unit":
        unit = document["serial"]["unit"]
        unit["min"], unit["max"] = sorted(chance.choices(NUMBERS[:16], k=2), key=int)
        return f"units {unit['min']} to {unit['max']}"
    starts = [f"{n:04X}H" for n in range(chance.choice((0, 1, 3, 130, 300)))]
    document["serial"]["broadcast"] = {"address": "0", "replies": "false", "source": "table", "start_addresses": starts}
    return f"broadcast to {len(starts)} start addresses"


def _commands(document: Plain, chance: random.Random) -> str:
    """A command comes, goes, or is another word."""
    commands = document["operation"]["commands"]
    one = chance.choice(commands)
    kind = chance.choice(("lose", "value", "does", "set", "clear", "register"))
    if kind == "lose":
        commands.remove(one)
        return f"the command {one['does']} is lost"
    if kind == "does":
        does = chance.choice(("run_reverse", "jog_forward", "jog_reverse", "jog_stop", "coast_stop", "quick_stop"))
        commands.append({**deepcopy(one), "does": does})
        return f"{one['does']} is {does}, too"
    if kind == "register":
        one["register"] = chance.choice([each["register"] for each in commands] + list(ADDRESSES))
    elif kind == "value":
        one["value"] = chance.choice(NUMBERS)
        one.pop("set", None)
        one.pop("clear", None)
    else:
        one.pop("value", None)
        one[kind] = [chance.choice(_POOLS[form.BITS.name]) for _ in range(chance.choice((0, 1, 2)))]
    return f"{one['does']} has another {kind}: {_short(one)}"


def _proof(document: Plain, chance: random.Random) -> str:
    """Standstill, or the reference, has other conditions."""
    rows = [each.entry for each in places(document) if each.cls.__name__ == "Register"]
    whole = [row for row in rows if not row.get("unused") and "-" not in row["address"] and not row.get("values")]
    count = min(chance.choice((1, 1, 3, 20, 150)), len(whole))
    more = [{"register": row["address"], "equals": "0"} for row in chance.sample(whole, count)]
    target = chance.choice(("standstill", "standstill", "reference"))
    key = "all" if target == "standstill" else "verify"
    document["operation"][target].setdefault(key, []).extend(more)
    return f"{count} more conditions of {target}"


def _reference(document: Plain, chance: random.Random) -> str:
    """The reference means something else, or its register counts otherwise."""
    reference = document["operation"]["reference"]
    if chance.random() < 0.5:
        reference["means"] = chance.choice(("frequency", "percent_of_maximum"))
        reference.setdefault("maximum", document["settings"][0]["id"] if document["settings"] else "A1")
    rows = [each.entry for each in places(document) if each.entry.get("address") == reference["register"]]
    if rows:
        row = rows[0]
        row["unit"] = "Hz" if reference["means"] == "frequency" else "%"
        row["scale"] = {"factor": chance.choice(FACTORS), "source": "table"}
        if chance.random() < 0.3:
            row.pop("scale")
        row["signed"] = chance.choice(("true", "false"))
        if chance.random() < 0.5:
            row["range"] = {"min": "0", "max": chance.choice(("1", "100", "1000", "10000", "32767"))}
    return f"the reference means {reference['means']}, {_short(rows[:1])}"


def _form(document: Plain, chance: random.Random) -> str:
    """Refusals look otherwise, replies may have a long byte count, parameters are stored otherwise."""
    kind = chance.choice(("exception", "write_reply", "none", "tolerance", "storage", "area"))
    if kind == "tolerance":
        document["tolerances"] = [{"kind": "two_byte_count", "source": "table", "why": "as printed"}]
    elif kind == "storage":
        document["storage"] = drawn(EntryOf(_class("storage")), chance)
    elif kind == "area":
        first, last = sorted(chance.choices(ADDRESSES, k=2))
        document.setdefault("areas", []).append(
            {"id": "more", "name": "More", "zh": "更多", "addresses": f"{first}-{last}", "access": "rw", "source": "s",
             "numbered_by": "sequence_number", "examples": []}
        )  # fmt: skip
    elif kind == "none":
        document["errors"].pop("form", None)
    elif kind == "exception":
        document["errors"]["form"] = {"kind": kind, "add": chance.choice(NUMBERS), "source": "table"}
    else:
        where = chance.choice(ADDRESSES)
        document["errors"]["form"] = {"kind": kind, "function": "06H", "address": where, "source": "table"}
    return f"another form: {kind}"


def _class(key: str) -> type:
    shape = keys_of(Drive)[key].shape
    assert isinstance(shape, EntryOf)
    return shape.cls


def _frames(document: Plain, chance: random.Random) -> str:
    """Frames are lost."""
    kept = chance.randrange(len(document["frames"]) + 1)
    document["frames"] = document["frames"][:kept]
    return f"{kept} frames are kept"


def _access(document: Plain, chance: random.Random) -> str:
    """A register or a table is read or written otherwise, or is not used."""
    place = _of(document, chance, "Register", "Section", "Area")
    assert place is not None
    place.entry["access"] = chance.choice(("r", "w", "rw"))
    return f"{place.path}.access = {place.entry['access']}"


def _move(document: Plain, chance: random.Random) -> str:
    """A register stands elsewhere."""
    place = _of(document, chance, "Register")
    assert place is not None
    place.entry["address"] = chance.choice(_POOLS[form.ADDRESSES.name])
    return f"{place.path}.address = {place.entry['address']}"


def _prefix(document: Plain, chance: random.Random) -> str:
    document["prefix"] = chance.choice(PREFIXES)
    return f"prefix = {document['prefix']}"


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= 80 else text[:77] + "..."


_KINDS: tuple[tuple[Callable[[Plain, random.Random], str], int], ...] = (
    (_key, 10), (_lose, 8), (_rename, 16), (_retext, 10), (_scale, 12), (_bits, 8), (_values, 8), (_rows, 6),
    (_codes, 6), (_functions, 10), (_commands, 8), (_proof, 5), (_reference, 10), (_form, 5), (_frames, 1),
    (_access, 5), (_move, 4), (_prefix, 3),
)  # fmt: skip
"""Each kind of change and how often it is drawn."""
