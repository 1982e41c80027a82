"""What only some manuals say: facts of other documents, misprints, example frames, and rows of every other kind."""

from collections.abc import Callable
from typing import Any

from tests.shapes.sheet import Row, Sheet, bit, hexadecimal, moved

from driveblocks.maps import form, model
from driveblocks.maps.shape import EntryOf, ListOf, Shape, keys_of
from driveblocks.modbus.checksum import crc16, lrc

ABOUT = {
    model.Section: "section {id}", model.Register: "register {address}", model.Fault: "fault {code}",
    model.ErrorCode: "error {code}", model.Function: "function {code}", model.Setting: "setting {id}",
    model.Frame: "frame {id}", model.Area: "area {id}",
}  # fmt: skip
"""How errata name an entry."""
MANY = (model.Register, model.Bit, model.Value, model.Fault)
FEW = (model.Area, model.Excluded, model.SubFunction, model.Edition, model.Tolerance, model.OtherScale)
"""Entries of which a map has many, and those that few maps have."""
SISTER, NORM = "sister_guide", "norm"
"""The document that facts are taken from, and the one that only says the same."""
SPECIAL = {"input": "input ", "discrete": "discrete ", "coil": "coil "}


# ---------------------------------------------------------------- what any entry may have


class Dress:
    """Goes through a map that is drawn, and adds what any entry of a kind may have."""

    def __init__(self, sheet: Sheet) -> None:
        """With what this manual has at all."""
        self.sheet, self.symbols = sheet, 0
        self.documents: dict[str, Row] = {}
        self.misprinted: dict[str, None] = {}
        others, odd = sheet.maybe(), sheet.maybe()
        self.facts, self.texts = 0.3 * others, 0.2 * odd
        self.trust = sheet.chance.choice(("read", "sister", "transcribed", "in_use"))

    def whole(self, made: Row) -> None:
        """All of a map."""
        self._entry(model.Drive, made, "")
        if self.misprinted:
            self._erratum(made)
        if self.documents:
            made["documents"] = list(self.documents.values())

    def _erratum(self, made: Row) -> None:
        about = [self.misprinted] if self.sheet.maybe(0.7) else [[each] for each in self.misprinted]
        for number, names in enumerate(about):
            sure = self.sheet.chance.choice(("certain", "likely", "open"))
            row = {"about": list(names), "where": f"page {number}", "printed": "this", "used": "that",
                   "why": "the table says so", "confidence": sure, "measured": self.sheet.maybe()}  # fmt: skip
            made["errata"].append(row | ({"corroborated": [self._agrees()]} if self.sheet.maybe() else {}))

    def _entry(self, cls: type, rows: Row, about: str) -> None:
        known = keys_of(cls)
        about = self._name(cls, rows, about)
        for key, value in list(rows.items()):
            for shape, one in self._inside(known[key].shape, value):
                self._entry(shape.cls, one, "warning" if key == "warnings" else about)
        if cls not in (model.Drive, model.Document, model.Corroboration):
            self._facts(cls, rows)
            self._words(cls, rows, about)

    def _inside(self, shape: Shape, value: object) -> list[tuple[EntryOf, Row]]:
        if isinstance(shape, ListOf) and isinstance(shape.item, EntryOf) and isinstance(value, list):
            return [(shape.item, each) for each in value]
        return [(shape, value)] if isinstance(shape, EntryOf) and isinstance(value, dict) else []

    def _name(self, cls: type, rows: Row, about: str) -> str:
        """How an erratum names an entry: by itself, or by what it belongs to."""
        if cls is model.Bit and about:
            return f"{about.replace('register', 'bit')}.{rows['bit']}"
        if cls not in ABOUT or (cls is model.ErrorCode and "code" not in rows):
            return "errors" if cls is model.ErrorCode else about
        if cls is model.Fault and about == "warning":
            return f"warning {rows['code']}"
        name = ABOUT[cls].format(**rows | {"address": str(rows.get("address")).partition("-")[0]})
        table = rows.get("space") or (self.space if cls is model.Register else "")
        self.space = table if cls is model.Section else self.space
        return name.replace("register ", SPECIAL[table]) if table in SPECIAL and cls is model.Register else name

    space: str | None = None
    """The table of the section that is gone through."""

    def _facts(self, cls: type, rows: Row) -> None:
        known = keys_of(cls)
        if "document" in known and self.sheet.maybe(self._often(cls, self.facts)):
            rows["document"] = self._document(SISTER, trust=self.trust)
        if "corroborated" in known and self.sheet.maybe(self.facts):
            rows["corroborated"] = [self._agrees()]
        if "note" in known and "note" not in rows and self.sheet.maybe(self._often(cls, 0.15)):
            rows["note"] = "see the next page"
        if cls is model.Register and self.sheet.maybe(0.02):
            rows["source"] = "page 9"

    def _often(self, cls: type, part: float) -> float:
        """A chance; less of what there is many of."""
        return part / 5 if cls in MANY else max(3 * part, 0.4) if cls in FEW else part

    def _document(self, name: str, **keys: str) -> str:
        said = {"id": name, "title": "Another guide", "publisher": "Drawn"} | keys
        self.documents.setdefault(name, said | ({"edition": "B"} if self.sheet.maybe() else {}))
        return name

    def _agrees(self) -> Row:
        row = {"document": self._document(NORM), "page": "12", "reads": "the same"}
        return row | ({"value": 1} if self.sheet.maybe() else {})

    def _words(self, cls: type, rows: Row, about: str) -> None:
        known, part = keys_of(cls), self._often(cls, 2 * self.texts)
        if rows.get("zh") and "zh_used" in known and self.sheet.maybe(part):
            rows["zh_used"] = f"{rows['zh']}改"
            self._misprinted(about)
        if "short" in known and "name" in rows and self.sheet.maybe(part):
            short = {"en": f"S {rows['name']}"} | ({"zh": f"短 {rows['name']}"} if "zh" in rows else {})
            rows["short"] = short
        if "symbol" in known and "name" in rows and "symbol" not in rows and self.sheet.maybe(part):
            self.symbols += 1
            rows["symbol"] = f"Own{self.symbols}"
        if cls is model.Frame and (rows["printed"] != rows["correct"] or "printed" in rows.get("plc", {})):
            self._misprinted(about)
        if printed := self._printed(cls, rows, 0.4 if cls is model.Bit and "id" in rows else part):
            rows |= printed
            self._misprinted(about)

    def _printed(self, cls: type, rows: Row, part: float) -> Row:
        if cls is model.Register and self.sheet.maybe(part) and "-" not in rows["address"]:
            row = {"address": moved(rows["address"], 1)}
            return {"printed": row | ({"id": "P9.99"} if "id" in rows else {})}
        if cls is model.Bit and "name" in rows and self.sheet.maybe(part):
            other = {"bit": "0" if str(rows["bit"]) != "0" else "1"}
            return {"printed": other | ({"id": "EV"} if "id" in rows else {})}
        if cls is model.Fault and self.sheet.maybe(part):
            return {"printed_code": "OEF"}
        return {}

    def _misprinted(self, about: str) -> None:
        if about:
            self.misprinted[about] = None


# ---------------------------------------------------------------- other tables of Modbus


def into(made: Row, section: Row, space: str, base: Callable[[str], str]) -> None:
    """Put a section into another table: what names its rows names the table before the address."""
    section["space"] = space
    own = {end for row in section["registers"] for end in row["address"].split("-")}

    def renamed(shape: Shape, value: Any) -> Any:
        if isinstance(shape, ListOf) and isinstance(value, list):
            return [renamed(shape.item, each) for each in value]
        if isinstance(shape, EntryOf) and isinstance(value, dict):
            known = keys_of(shape.cls)
            return {key: renamed(known[key].shape, each) for key, each in value.items()}
        if shape is form.REFERENCE and str(value).partition(" ")[2] in own:
            return SPECIAL[space] + base(str(value).partition(" ")[2])
        if shape in (form.ADDRESS, form.ADDRESSES) and str(value).partition("-")[0] in own:
            return SPECIAL[space] + "-".join(map(base, str(value).split("-")))
        return value

    for key, value in list(made.items()):
        if key != "sections":
            made[key] = renamed(keys_of(model.Drive)[key].shape, value)
    for each in (one for one in made["sections"] if one is section or "space" not in one):
        rows = [renamed(EntryOf(model.Register), row) for row in each["registers"]]
        each["registers"] = rows
        for row in rows if each is section else ():
            row["address"] = row["address"].removeprefix(SPECIAL[space])


def input_registers(sheet: Sheet, made: Row, section: Row) -> None:
    """What is read alone is in the table of input registers."""
    step = sheet.base("input") - sheet.numbers
    into(made, section, "input", lambda place: moved(place, step))
    made["functions"].append(sheet.named("Read input registers", code="04H", source="section 2"))


# ---------------------------------------------------------------- the line

PLUGS: tuple[Row, ...] = (
    {},
    {"connector": "rj45", "pins": [{"pin": "4", "label": "RS+", "wire": "positive"}, {"pin": "5", "wire": "negative"}],
     "termination": "120 ohm by S2", "bias": "in the master", "shield": "on earth", "never": ["use pin 7"]},
    {"connector": "terminals", "pins": [{"pin": "T1", "wire": "negative"}, {"pin": "T2", "wire": "positive"}]},
)  # fmt: skip
"""Where the line is connected, by the last unit address."""


def line(sheet: Sheet, made: Row) -> None:
    """Formats and rates that other settings choose, or none; both modes; addresses that the standard reserves."""
    serial, limits = made["serial"], made["limits"]
    for part, way in ((0.15, stop_bits), (0.5, uncoded), (0.15, modes)):
        if sheet.maybe(part):
            way(sheet, serial)
    if sheet.maybe(0.1) and "setting" not in serial["unit"]:
        serial["unit"] |= {"max": 250, "above_247": "table 3"}
    if "broadcast" in serial and sheet.maybe():
        serial["broadcast"]["start_addresses"] = [made["operation"]["reference"]["register"]]
    for key, value in (("write_words", 4), ("data_bytes", 60), ("group", 256)):
        if sheet.maybe(0.1):
            limits[key] = {"value": value, "source": "section 2"}
    if pins := PLUGS[serial["unit"]["max"] % len(PLUGS)]:
        serial["pins"] = pins | {"source": "figure 2"}
    if "ascii" in serial["mode"]["modes"] and sheet.maybe():
        limits["ascii_data_bytes"] = {"value": 40, "source": "section 2"}
    if sheet.maybe(0.15):
        made["tolerances"] = [{"kind": "two_byte_count", "source": "section 2", "why": "as printed there"}]


def stop_bits(sheet: Sheet, serial: Row) -> None:
    """A setting of their own chooses the stop bits."""
    if "format" not in serial or "stop_bits" in serial:
        return
    serial["format"]["codes"] = [{"code": code, "parity": parity, "data_bits": 8}
                                 for code, parity in enumerate(("none", "even", "odd"))]  # fmt: skip
    serial["format"]["default"] = 0
    given = next(each for each in sheet.settings if each["id"] == serial["format"]["setting"])
    given["default"] = "0"
    setting = sheet.setting(10, "Stop bits", default="1", needed={"why": "as the PLC has it"})
    codes = [{"code": code, "stop_bits": code + 1} for code in (0, 1)]
    serial["stop_bits"] = {"setting": setting, "default": 1, "codes": codes, "source": "section 1"}


def uncoded(sheet: Sheet, serial: Row) -> None:
    """Nothing chooses the rate or the format, or a switch does."""
    if "baud" not in serial:
        serial["baud"] = {"codes": [{"baud": 9600}, {"baud": 19200, "delivered": True}], "source": "section 1"}
    if "format" not in serial:
        forms = [{"parity": parity, "data_bits": 8, "stop_bits": 1} for parity in ("even", "odd")]
        forms[sheet.chance.randint(0, 1)]["delivered"] = True
        serial["format"] = {"codes": forms, "source": "section 1"}


def modes(sheet: Sheet, serial: Row) -> None:
    """ASCII as well, by a setting."""
    if "setting" in serial["mode"]:
        return
    setting = sheet.setting(12, "Mode", default="1", needed={"why": "as the PLC has it"})
    codes = [{"code": 1, "mode": "rtu"}, {"code": 2, "mode": "ascii"}]
    serial["mode"] |= {"modes": ["rtu", "ascii"], "setting": setting, "default": 1, "codes": codes}


# ---------------------------------------------------------------- settings, parameters, storage


def settings(sheet: Sheet, made: Row) -> None:
    """What settings may have beside."""
    for one in sheet.settings:
        if sheet.maybe(0.2) and "default" in one and "values" not in one and not in_choice(made["serial"], one["id"]):
            one["editions"] = [{"edition": f"V{number}", "default": str(number), "source": "page 3"}
                               for number in (1, 2)]  # fmt: skip
            one.setdefault("needed", {"why": "it differs by edition"})
            del one["default"]
        if sheet.maybe(0.05):
            one["unit_step"] = 1
    sheet.setting(13, "Source of the run command", values=sheet.listed("Keypad", "Terminals", "Bus", "Both"),
                  needed={"value": 2, "by_terminals": 1, "why": "the bus runs the drive"})  # fmt: skip
    if sheet.maybe(0.3):
        sheet.settings[-1]["needed"] = {"value": 2, "why": "the bus runs the drive"}


def in_choice(serial: Row, setting: str) -> bool:
    """Whether a setting chooses something of the line."""
    return any(isinstance(each, dict) and each.get("setting") == setting for each in serial.values())


def parameters(sheet: Sheet, made: Row, at: int) -> None:
    """A table of parameters whose ids follow each other; settings among them."""
    rows = [row for row in sheet.words if str(row.get("id")).startswith("P1.")]
    if sheet.maybe(0.3):
        return
    sheet.words[:] = [row for row in sheet.words if row not in rows]
    for number, setting in enumerate(sheet.settings[:2], start=4):
        if "name" in setting and sheet.maybe(0.2):
            place = sheet.place(at + 0x40 + number)
            rows.append(sheet.named(setting["name"], id=setting["id"], address=place, symbol=f"Kept{number}"))
            setting["register"] = place
    section: Row = {"id": "parameters", "title": sheet.text("Parameters"), "source": "table 5", "access": "rw"}
    if sheet.maybe():
        section["series"] = [{"ids": "P1.01..P1.03", "base": sheet.place(at + 1)}]
        if sheet.maybe():
            rows.append(sheet.named("Delay", id="P1.09", address=sheet.place(at + 0x38)))
            section["series"][0] |= {"ids": "P1.01..P1.09", "apart": ["P1.09"]}
    made["sections"].append(section | {"registers": rows})


def memory(sheet: Sheet, made: Row, at: int) -> None:
    """A bit of the address that keeps writes in RAM; an area of parameters that the manual gives by a rule."""
    named = {each["id"] for each in made["sections"]}
    area = sheet.maybe(0.4)
    if area:
        made["areas"] = [areas(sheet)]
    kept = "function_codes" if area else "parameters"
    free = area or (kept in named and at < 0x8000 and at != 0x1000)
    if made["storage"]["method"] == "volatile" and free and sheet.maybe():
        made["storage"] |= {"method": "ram_address_bit", "add": hexadecimal(0x8000), "area": kept}
        made["storage"] |= {"readable": False} if sheet.maybe() else {}
    if sheet.maybe(0.1):
        made["storage"]["max_writes"] = 100000


def areas(sheet: Sheet) -> Row:
    """Parameters by a rule."""
    example = {"id": "P2.05", "number": 5, "address": sheet.place(5)}
    row = sheet.named("Function codes", id="function_codes", addresses=f"{sheet.place(0)}-{sheet.place(0x7F)}")
    row |= {"numbered_by": sheet.chance.choice(("sequence_number", "parameter_number")), "access": "rw"}
    row |= {"source": "section 6", "examples": [example]}
    if sheet.maybe(0.8):
        row["excluded"] = [sheet.named("Group of the maker", ids="P9")]
    return row


# ---------------------------------------------------------------- signs of the drive


def signs(sheet: Sheet, made: Row, at: int) -> None:
    """Who is in command, what forbids a start, what the reference rests on; conditions on numbers."""
    operation, table = made["operation"], {"source": "table 2"}
    word = sheet.place(at)
    bits = dict(zip(("Bus in command", "Start inhibited", "Large unit", "Local"), sheet.bits(4), strict=True))
    places = {name: {"register": word, "bit": bit(number)} for name, number in bits.items()}
    rows = [sheet.named(name, bit=bit(number)) for name, number in bits.items()]
    before = dict(operation)
    if sheet.maybe(0.15):
        operation["commanded_by"] = {"all": [places["Bus in command"] | {"equals": 1}]} | table
    if sheet.maybe(0.15):
        forbidden = [places["Start inhibited"] | {"equals": 1}]
        operation["forbids"] = [{"any": forbidden, "why": "the drive inhibits a start"} | table]
    row = next(each for each in sheet.words if each["address"] == operation["reference"]["register"])
    if "scale" in row and sheet.maybe(0.15):
        when = places["Large unit"] | {"equals": 0}
        row["scale"]["when"] = when
        operation["reference"] = operation["reference"] | {"verify": [dict(when)]}
    if operation != before:
        sheet.shown.append(sheet.named("More status", address=word, bits=rows))
    numbers(sheet, made)


def numbers(sheet: Sheet, made: Row) -> None:
    """Status and standstill by numbers."""
    operation, present = made["operation"], made["faults"].get("present")
    stands = operation["standstill"]["all"][1]
    status = {each["shows"]: each for each in operation["status"]}
    if sheet.maybe(0.1):
        stands.pop("equals")
        stands["below"] = sheet.chance.choice((1, 5))
    if sheet.maybe(0.2) and "below" not in stands:
        status["running"]["any"].append({"register": stands["register"], "above": 0})
    if sheet.maybe(0.1):
        operation["status"].append({"shows": "zero_speed", "any": [{"register": stands["register"], "below": 1}],
                                    "source": "table 2"})  # fmt: skip
    if present and "present_bits" not in made["faults"] and "fault" in status and sheet.maybe(0.2):
        status["fault"]["any"] = [{"register": present, "equals": 0, "differs": True}]


def rows(sheet: Sheet, made: Row, at: int) -> None:
    """Rows of other kinds: unused ones, ranges, masks, values that are written never."""
    sheet.shown += [{"address": sheet.place(at), "unused": True}] if sheet.maybe(0.1) else []
    if sheet.maybe(0.1):
        values = [sheet.named(name, value=1 << number) for number, name in enumerate(("Low", "High", "Hot"))]
        sheet.shown.append(sheet.named("Signals", address=sheet.place(at + 1), values=values, masks=True))
    if sheet.maybe(0.1):
        fields = [sheet.named("Mode", bit="0-3", values=sheet.listed("Off", "Slow", "Fast")), sheet.named("Wet", bit=4)]
        sheet.shown.append(sheet.named("Terminals", address=sheet.place(at + 2), bits=fields))
    reference = next(each for each in sheet.words if each["address"] == made["operation"]["reference"]["register"])
    if sheet.maybe(0.1) and not reference.get("signed"):
        reference["range"] = {"min": 0, "max": 30000}
    commands = {one["register"]: one for one in made["operation"]["commands"]}
    for row in sheet.words:
        if row["address"] in commands and "bits" in row and sheet.maybe(0.3):
            free = max({*range(16)} - {int(str(each["bit"]), 16) for each in row["bits"]})
            row["bits"].append({"bit": bit(free), "does": ["hands_over"]} | sheet.named("Local"))
            row["never"] = [{"bit": bit(free), "equals": 1, "why": "the drive would leave the bus"}]


def counting(sheet: Sheet, does: list[str]) -> Row:
    """What counts of a value: its edge or its level; that a stop holds the motor."""
    if sheet.maybe(0.15) and does in (["stops"], ["coasts"], ["quick_stops"]):
        return {"by": "level", "holds": True}
    return {"by": sheet.chance.choice(("edge", "level"))} if sheet.maybe(0.1) else {}


def reset(sheet: Sheet, made: Row, at: int) -> None:
    """A fault reset in a register of its own, where any value resets; a silence after it."""
    commands = made["operation"]["commands"]
    if sheet.maybe(0.1):
        commands[:] = [each for each in commands if each["does"] != "fault_reset"]
        sheet.words.append(sheet.named("Fault reset", address=sheet.place(at), does=["resets"]))
        commands.append({"does": "fault_reset", "register": sheet.place(at), "value": 1, "source": "table 1"})
    for one in commands:
        if one["does"] == "fault_reset" and sheet.maybe(0.3):
            pulse = [step for step in one.get("first", ()) if "for_ms" in step]
            (pulse[0] if pulse else one)["silent_ms"] = 500  # the write that resets; what ends a pulse may be a stop


# ---------------------------------------------------------------- faults, refusals, prose


def fault_words(sheet: Sheet, made: Row, at: int) -> None:
    """The present fault is a bit of fault words, in the place of a code."""
    faults = made["faults"]
    if not sheet.maybe(0.25) or "present_bits" in faults or "fault" in made.get("watchdog", {}):
        return
    present = faults.pop("present")
    sheet.shown[:] = [row for row in sheet.shown if row["address"] != present]
    chosen = sorted(sheet.chance.sample(range(32), 5))
    for word in (0, 1):
        bits = [sheet.named(f"Bit fault {number}", bit=bit(number % 16), id=f"B{number}")
                for number in chosen if number // 16 == word]  # fmt: skip
        sheet.shown.append(sheet.named(f"Fault word {word}", address=sheet.place(at + word), bits=bits))
    first, last = sheet.place(at), sheet.place(at + 1)
    faults |= {"registers": [f"{first}-{last}"], "bits": {"first": first, "last": last, "source": "table 3"}}
    faults["codes"] = [sheet.named(f"Bit fault {number}", code=number + 1, id=f"B{number}") for number in chosen]


def refusals(sheet: Sheet, made: Row, at: int) -> None:
    """Refusals as a write reply, with causes; functions that nobody sends."""
    errors = made["errors"]
    if sheet.maybe(0.1):
        sheet.shown.append(sheet.named("Error reply", address=sheet.place(at)))
        errors["form"] = {"kind": "write_reply", "function": "06H", "address": sheet.place(at), "source": "section 3"}
    for one in errors["codes"]:
        if sheet.maybe(0.2):
            one |= {"meaning": sheet.text("It may not."), "causes": [sheet.text("It is elsewhere.")]}
    if sheet.maybe(0.3):
        subs = [sheet.named("Return query data", code="0000H"), sheet.named("Restart", code="0001H")]
        row = sheet.named("Diagnostics", code="08H", source="section 2")
        made["functions"].append(row | {"sub_functions": subs[: sheet.chance.randint(1, 2)]})
    if sheet.maybe(0.1):
        made["functions"].append(sheet.named("Report identity", code="11H", source="section 2", sent=False))


def prose(sheet: Sheet, made: Row, shown: str) -> None:
    """What a person is asked on site; what notices are about; whose words the map has."""
    made["manual"] |= {"covers": "chapter 9"} if sheet.maybe(0.1) else {}
    made["manual"] |= {"second_hand": True} if sheet.maybe(0.1) else {}
    for one in made["notices"]:
        one.update({"about": [f"register {shown}"]} if sheet.maybe(0.3) else {})
    gap = made["absent"][0]
    ask = {"do": "look at the keypad", "ask": "what does it show"}
    ways: tuple[Row, ...] = ({"read": shown}, {"by_run": True}, {})
    gap |= {"on_site": ask | sheet.chance.choice(ways)} if sheet.maybe(0.3) else {}
    for row in sheet.shown:
        if row.get("name") == "Output current" and "scale" not in row:
            gives = ask | {"read": row["address"], "gives": "CurrentScale"}
            gap = {"what": "the scale of the current", "about": [f"register {row['address']}"], "on_site": gives}
            made["absent"].append(gap | {"matters": "nobody knows", "find_out": "compare it"})


# ---------------------------------------------------------------- example frames


class Frames:
    """The manual's examples, in one mode."""

    def __init__(self, sheet: Sheet, mode: str) -> None:
        self.sheet, self.mode, self.rows = sheet, mode, list[Row]()

    def add(self, name: str, body: list[int], direction: str, means: Row, answers: str = "") -> None:
        """A frame, its checksum printed right or wrong; perhaps with the table of the PLC's registers."""
        data = bytes(body)
        right, wrong = self._text(data, self._sum(data)), self._text(data, b"\x12\x34"[: len(self._sum(data))])
        odd = self.sheet.maybe(0.15) and right != wrong
        row: Row = {"id": f"{name}_{self.mode}", "direction": direction, "mode": self.mode, "source": "section 2",
                    "printed": wrong if odd else right, "checksum": "wrong" if odd else "right"}  # fmt: skip
        if odd and self.sheet.maybe():
            other = bytes([2, *body[1:]])
            row |= {"printed": self._text(data, self._sum(other)), "printed_checksum_of": other.hex(" ").upper()}
        row |= {"correct": right} | ({"answers": f"{answers}_{self.mode}"} if answers else {})
        row["means"] = {"says": f"an example, {name}", "unit": 1, "function": f"{body[1]:02X}H"} | means
        if self.sheet.maybe(0.15):
            row["plc"] = self._plc(data)
        self.rows.append(row)

    def _sum(self, data: bytes) -> bytes:
        return crc16(data).to_bytes(2, "little") if self.mode == "rtu" else bytes([lrc(data)])

    def _text(self, data: bytes, checked: bytes) -> str:
        sent = (data + checked).hex(" ").upper()
        return sent if self.mode == "rtu" else f":{sent.replace(' ', '')} CR LF"

    def _plc(self, data: bytes) -> Row:
        sent = form.ADU.parse(self._text(data, self._sum(data)))
        made = sent.hex().upper()
        width = self.sheet.chance.choice((2, 4))
        cells = [made[at : at + width] for at in range(0, len(made), width)]
        cells[-1] = cells[-1].ljust(width, "-")
        misprint = {"printed": [("FE" * 2)[:width], *cells[1:]]} if self.sheet.maybe(0.4) else {}
        return {"bits": 4 * width, "first": "D0", "registers": cells} | misprint


def frames(sheet: Sheet, made: Row, at: int, row: Row, space: str) -> None:
    """A measure that is asked for and told, an echo, a refusal; `row` is the measure's, `at` its address."""
    function, place = 4 if space == "input" else 3, SPECIAL.get(space, "") + row["address"]
    codes = [int(str(each["code"])[:-1], 16) for each in made["functions"]]
    for mode in made["serial"]["mode"]["modes"]:
        one = Frames(sheet, mode)
        asked = {"address": sheet.place(at), "words": 1}
        one.add("ask", [1, function, *at.to_bytes(2, "big"), 0, 1], "request", asked)
        value = float(f"{500 * row['scale']['factor']:.6g}")
        told = {"words": 1, "byte_count": 2, "values": [500],
                "quantities": [{"register": place, "value": value, "unit": row["unit"]}]}  # fmt: skip
        row["scale"]["proof"] = f"tell_{mode}"
        one.add("tell", [1, function, 2, 1, 0xF4], "reply", told, "ask")
        if 8 in codes:
            echo = {"sub_function": "0000H", "data": "12ABH"}
            one.add("echo", [1, 8, 0, 0, 0x12, 0xAB], "request", echo)
            one.add("echoed", [1, 8, 0, 0, 0x12, 0xAB], "reply", echo, "echo")
        if made["errors"].get("form", {}).get("kind", "exception") == "exception":
            one.add("refuse", [1, 0x80 + function, 2], "reply", {"error": 2}, "ask")
        made["frames"] += one.rows


# ---------------------------------------------------------------- all of it


def add(sheet: Sheet, made: Row, places: tuple[int, int, int, int]) -> None:
    """Everything of this page that a map may have; `places` are commands, status, measures and parameters."""
    commands, shown, values, kept = places
    fault_words(sheet, made, values + 0xB0)
    signs(sheet, made, shown + 1)
    rows(sheet, made, shown + 0x10)
    reset(sheet, made, commands + 9)
    refusals(sheet, made, values + 0xC0)
    line(sheet, made)
    settings(sheet, made)
    parameters(sheet, made, kept)
    memory(sheet, made, kept)
    prose(sheet, made, next(row["address"].partition("-")[0] for row in sheet.shown if "name" in row))


def _low(sheet: Sheet, place: str) -> bool:
    """Whether an address is one of the lowest, by which the simulated drive can tell its tables apart."""
    first = place.partition("-")[0]
    return (int(first[:-1], 16) if first.endswith("H") else int(first) - sheet.numbers) < 0x3F00


def last(sheet: Sheet, made: Row, measured: list[Row]) -> None:
    """What needs the whole map: another table, its frames, and what any entry may have."""
    section = next(each for each in made["sections"] if each["id"] == "status")
    stands = next(each["register"] for each in measured if each["shows"] == "output_frequency")
    row = next(each for each in section["registers"] if each["address"] == stands)
    at = int(stands[:-1], 16) if stands.endswith("H") else int(stands) - sheet.numbers
    if sheet.maybe(0.3) and all(_low(sheet, each["address"]) for each in section["registers"]):
        input_registers(sheet, made, section)
        row = next(each for each in section["registers"] if each["address"] == sheet.place(at, "input")[6:])
    if sheet.maybe():
        frames(sheet, made, at, row, section.get("space", ""))
        if "numbering" in made and sheet.maybe():
            made["numbering"]["proof"] = made["frames"][0]["id"]
    for one in (each for each in made["sections"] if sheet.maybe(0.1)):
        one.setdefault("space", "holding")
        one["registers"][0] |= {"access": one["access"], "space": one["space"]}
    Dress(sheet).whole(made)
