"""What a map says, as frozen data. Each class is one kind of entry; each field's text is its documentation.

The classes are the format: the decoder, the JSON schema and the format page's tables are made from them.
"""

from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cached_property, reduce, wraps
from itertools import pairwise
from operator import or_
from typing import Annotated, Any, Literal, TypeVar, get_args

from driveblocks.maps import form
from driveblocks.maps.form import Span
from driveblocks.maps.problem import Place

Str = Annotated[str, form.TEXT]
English = Annotated[str, form.ENGLISH]
Word = Annotated[str, form.WORD]
Id = Annotated[str, form.ID]
Address = Annotated[int, form.ADDRESS]
Addresses = Annotated[Span, form.ADDRESSES]
Bits = Annotated[Span, form.BITS]
Number = Annotated[int, form.NUMBER]
Count = Annotated[int, form.COUNT]
Writes = Annotated[int, form.WRITES]
Factor = Annotated[Decimal, form.DECIMAL]
Octets = Annotated[bytes, form.BYTES]
Adu = Annotated[bytes, form.ADU]
Ref = Annotated[str, form.REFERENCE]
Symbol = Annotated[str, form.SYMBOL]

Access = Literal["r", "w", "rw"]
Use = Literal["r", "w"]
"""What is done with a register: it is read, or written."""
USES: tuple[Use, ...] = get_args(Use)
Language = Literal["en", "zh", "cs", "da", "de", "es", "fi", "fr", "it", "ja", "ko", "nl", "pl", "pt", "ru", "sv", "tr"]
"""A language of manuals, by ISO 639-1."""
Unit = Literal["Hz", "A", "V", "kW", "W", "%", "r/min", "Nm", "s", "ms", "h", "°C", "kHz", "Ohm", "kWh"]
Shows = Literal["running", "reverse", "at_speed", "zero_speed", "ready", "warning", "fault", "limit"]
"""What a status word can show on a pin of the drive block."""
Measure = Literal[
    "output_frequency", "output_current", "output_voltage", "dc_bus_voltage", "output_power",
    "output_speed", "output_torque", "relative_power", "drive_temperature", "motor_temperature", "operating_time",
    "energy", "motor_torque",
]  # fmt: skip
"""What a register can show on a pin of the drive block."""
OpenScale = Literal["FrequencyScale", "CurrentScale", "VoltageScale", "DcVoltageScale", "PowerScale"]
"""A scale of a measure in `VFD_Settings`."""
Feed = Literal["any", "reads", "writes"]
"""What a drive's own watchdog takes for a sign of life of its master."""
Counts = Literal["running", "always", "bus_in_command"]
"""When it counts: while the motor runs, at standstill, too, or while the bus is in command of the drive."""
Reacts = Literal["stop", "quick_stop", "coast_stop", "trips", "runs_on", "other_speed"]
"""What a drive does by itself when its line is silent; the stops are those of the commands."""
By = Literal["edge", "level"]
Trust = Literal["read", "sister", "transcribed", "in_use"]
"""How far facts of a document can be trusted, the best first."""
Rung = Literal["read", "sister", "derived", "transcribed", "in_use"]
"""How far a fact can be trusted, the best first."""
Connector = Literal["rj45", "terminals", "d_sub"]
"""What the line is plugged into, or wired to."""
Wire = Literal["positive", "negative", "common", "shield", "supply", "reserved", "unconnected"]
"""What a pin of it is."""
Space = Literal["holding", "input", "coil", "discrete"]
"""A table of Modbus."""
Does = Literal[
    "run_forward", "run_reverse", "jog_forward", "jog_reverse", "jog_stop", "stop", "coast_stop", "quick_stop",
    "fault_reset",
]  # fmt: skip
Act = Literal[
    "starts", "jogs", "forward", "reverses", "stops", "quick_stops", "coasts", "ends_jog", "resets", "enables",
    "hands_over", "nothing",
]  # fmt: skip
"""What a bit or a value of a command register does to the motor."""


def fact(doc: str, example: str) -> Any:
    """Declare a key: its meaning, and one example as YAML."""
    return field(metadata={"doc": doc, "example": example})


def option(doc: str, example: str, *, default: Any = None) -> Any:
    """Declare a key that may be left out."""
    return field(metadata={"doc": doc, "example": example}, default=default)


_CHINESE = "the manual's Chinese, as printed, misprints included; a must where the manual is Chinese"
_SAYS_SO = "id of the document that says so, where the manual does not"
_ACTS = (
    "`stops` is by its ramp, `enables` lets another bit start, `hands_over` gives the command to keypad or terminals"
)
_BY = "what counts of that: its `edge`, so that it acts once when it comes, or its `level`; left out where nobody says"
_HOLDS = (
    "its stop holds the motor still by its level, whatever the others of the word say; only where the manual says that "
    "it wins"
)
_NO_CODE = "number on the keypad; left out where a switch chooses, or nothing"
_DELIVERED = "what a drive without codes has as delivered; of a single one it need not be said"
_WORDING = (
    "the manual's own words where it is neither English nor Chinese; of an English manual, what is printed where the "
    "English departs from it"
)


@dataclass(frozen=True, kw_only=True)
class Entry:
    """Base of all entries: where it is in the file."""

    at: Place = field(default=(0, 0), compare=False, repr=False)
    keys: dict[str, Place] = field(default_factory=dict, compare=False, repr=False)

    def place(self, key: str) -> Place:
        """Line and column of a key's value, or of the entry where the key is absent."""
        return self.keys.get(key, self.at)


@dataclass(frozen=True, kw_only=True)
class Trusted(Entry):
    """Base of entries that can be trusted less far than their document."""

    rung: Rung | None = option(
        "how far it can be trusted, where that is less than its document: nobody has read it there, or it is `derived` "
        "from other facts; the rungs, best first",
        "derived",
    )
    rule: English | None = option("of what is derived, how", "33H to 37H follow 32H in the order of the bits")


@dataclass(frozen=True, kw_only=True)
class Cited(Trusted):
    """Base of entries that are cited: they have a source."""

    printed: tuple[Annotated[str, form.CELL], ...] = field(
        metadata={
            "doc": "what stands there, to find it again: label and value as printed, in their order, no sentence",
            "example": "[C125 3, 2000H 5]",
        },
        default=(),
        repr=False,
    )


class Worded:
    """Base of entries with a name or text in English, and perhaps in Chinese or in the manual's own words."""

    zh: str | None
    zh_used: str | None
    wording: str | None

    @property
    def text_zh(self) -> str | None:
        """The Chinese to show to a person."""
        return self.zh_used or self.zh

    @property
    def own(self) -> str:
        """What is given beside the English to find it in the manual: the Chinese, or its own words, or nothing."""
        return self.text_zh or self.wording or ""


@dataclass(frozen=True, kw_only=True)
class Text(Worded, Entry):
    """A text in English, and as the manual has it where that is another language."""

    en: English = fact("English", "Shanghai SHUEN")
    zh: Str | None = option("Chinese as the manual prints it; a must where the manual is Chinese", "上海数恩")
    zh_used: Str | None = option("Chinese as it should read, where the manual misprints it", "超速")
    wording: Str | None = option(_WORDING, "Schaltanlagenbau Nord")


@dataclass(frozen=True, kw_only=True)
class Named(Worded, Entry):
    """Base of entries with a name."""

    name: English = fact("English name, a short noun phrase; identifiers are made from it", "Output frequency")
    zh: Str | None = option(_CHINESE, "输出频率")
    zh_used: Str | None = option("the wording to show, where `zh` holds a misprint (needs an erratum)", "超速")
    wording: Str | None = option(_WORDING, "Ausgangsfrequenz")


@dataclass(frozen=True, kw_only=True)
class Short(Entry):
    """Shorter wordings, for the blocks that return the text: a STRING holds 80 bytes everywhere, and no more."""

    en: English | None = option("English that fits", "PID target on the bus")
    zh: Str | None = option("Chinese that fits in UTF-8 and GB18030", '"总线 PID 目标值: 0 无效 1 有效"')


@dataclass(frozen=True, kw_only=True)
class Returned(Named):
    """Base of entries whose names a block returns as texts."""

    short: Short | None = option("shorter wordings, where a text is longer than 80 bytes", "{zh: ...}")


@dataclass(frozen=True, kw_only=True)
class Corroboration(Entry):
    """Another public document that says the same, or what this manual does not. Never replaces a value silently."""

    document: Word = fact("id of an entry under `documents`", "modbus_application")
    page: Str = fact("page or section in that document", "section 7, page 48")
    reads: English = fact("what it says, in short", "01 is ILLEGAL FUNCTION")
    value: Number | None = option("the value that it gives, where it is a number", "1")


@dataclass(frozen=True, kw_only=True)
class Manual(Entry):
    """The manual that the map was read from."""

    language: Language | None = option(
        "its language; left out, it is Chinese where the title has a `zh`, and English where it has none", "en"
    )
    title: Text = fact("title in English, and as printed", "{en: Communication protocol, zh: 通讯协议说明}")
    publisher: Text = fact("who published it", "{en: Shanghai SHUEN, zh: 上海数恩}")
    edition: Str | None = option("edition or date as printed; left out when none is printed", "V20160418")
    covers: English = option("which part of the drive's documentation this is", "chapter 11 of the user manual")
    second_hand: bool = option(
        "the map rests on what others wrote down: the drive block runs only when its user has checked the manual",
        "true",
        default=False,
    )

    @property
    def written_in(self) -> Language:
        """The language of the manual, whether it is said or follows from the title."""
        return self.language or ("zh" if self.title.zh else "en")


@dataclass(frozen=True, kw_only=True)
class Document(Entry):
    """Another public document that corroborates values, or says what the manual does not."""

    id: Word = fact("short name for references", "modbus_application")
    title: Str = fact("title as printed", "MODBUS Application Protocol Specification")
    publisher: Str = fact("who published it", "Modbus Organization")
    edition: Str | None = option("edition, revision or date", "V1.1b3")
    trust: Trust | None = option(
        "how far it can be trusted, where facts are taken from it: `read` in the maker's document on this drive; "
        "`sister`: the maker's on a sister model; `transcribed` by somebody else; `in_use`: software of machines",
        "sister",
    )


@dataclass(frozen=True, kw_only=True)
class Value(Returned):
    """One value of an enumeration."""

    value: Number = fact("the number on the wire or on the keypad", "1")
    display: Str | None = option("of a keypad setting, what the keypad shows where that is not the number", '"19.2"')
    does: tuple[Act, ...] = option(
        f"of a command register, what the value does to the motor, all of it; {_ACTS}; a value but 0 that does not say "
        "it counts as starting",
        "[starts, reverses]",
        default=(),
    )
    by: By | None = option(_BY, "edge")
    holds: bool = option(_HOLDS, "true", default=False)
    symbol: Symbol | None = option(
        "identifier in Structured Text, where the one made from the name is too long or taken", "InputTerminals"
    )
    note: English | None = option("what else a person must know", "0 is not a stop")


@dataclass(frozen=True, kw_only=True)
class Range(Entry):
    """Smallest and greatest allowed number."""

    min: Number = fact("smallest", "-10000")
    max: Number = fact("greatest", "10000")

    def holds(self, number: int) -> bool:
        """Whether a number is allowed; a range that runs backwards is a mistake of its own and allows all."""
        return self.min > self.max or self.min <= number <= self.max


@dataclass(frozen=True, kw_only=True)
class Needed(Entry):
    """What a keypad setting must be before the drive listens."""

    value: Number | None = option("the number to enter; left out where any value serves that the PLC also uses", "2")
    by_terminals: Number | None = option(
        "the number that lets the drive's terminals run it instead, of the setting that chooses the source of the run "
        "command",
        "1",
    )
    why: English = fact("what it is for", "run commands come from the bus")

    @property
    def right(self) -> tuple[int, ...]:
        """The number that serves; none where any does that the PLC also uses."""
        return () if self.value is None else (self.value,)


@dataclass(frozen=True, kw_only=True)
class Switch(Entry):
    """A value of a keypad setting, on which something else depends."""

    setting: Id = fact("id of the keypad setting", "H5-05")
    value: Number = fact("the value", "0")


@dataclass(frozen=True, kw_only=True)
class Edition(Cited):
    """The factory setting of one edition of a drive or of its manual."""

    edition: Str = fact("the edition or firmware, as printed", "07/2012")
    default: Str = fact("its factory setting as printed", '"3"')
    source: English = fact("where that says so", "page 111")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Display(Entry):
    """A setting as the keypad shows it, where that is not its id and the number on the wire."""

    code: Str | None = option("what the keypad calls it, where that is not the id", "tbr")
    menu: English | None = option("where it is in the menu", "COM-, communication")
    unit: Str | None = option("unit of what is shown; of a time always `s`", "s")
    factor: Factor | None = option(
        "what one count on the wire is in this unit, with the decimals that the keypad shows", "0.1"
    )
    digits: Count | None = option("the least number of digits that it shows: 2 where 3 is 03", "2")
    hexadecimal: bool = option("whether a number is entered in hexadecimal: 31 as 1F", "true", default=False)


@dataclass(frozen=True, kw_only=True)
class Setting(Named, Cited):
    """A parameter that a person sets on the keypad for communication."""

    id: Id = fact("the manual's id", "H5-02")
    source: English = fact("where the manual says so", "table of communication parameters")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    register: Address | None = option("its register, where the manual lists one", "041DH")
    display: Display | None = option("the setting as the keypad shows it", "{menu: COM-, unit: s, factor: 0.1}")
    range: Range | None = option("allowed numbers", "{min: 0, max: 4}")
    unit_step: Number | None = option("smallest step", "1")
    default: Str | None = option("factory setting as printed", '"3"')
    editions: tuple[Edition, ...] = option(
        "in the place of `default`, where it differs by edition: a person has to look it up, so it is `needed`",
        "[{edition: 07/2012, default: ...}, {edition: 09/2014, default: ...}]",
        default=(),
    )
    values: tuple[Value, ...] = option(
        "meaning of each number", "[{value: 0, name: 1200 bit/s, zh: 1200BPS}]", default=()
    )
    needed: Needed | None = option("what it must be before the drive listens", "{value: 2, why: ...}")
    note: English | None = option("what else a person must know", "takes effect after a power cycle")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class ModeCode(Entry):
    """A code of the setting that chooses RTU or ASCII."""

    code: Number = fact("number on the keypad", "2")
    mode: Literal["rtu", "ascii"] = fact("the mode", "rtu")


@dataclass(frozen=True, kw_only=True)
class BaudCode(Entry):
    """A code of the setting that chooses the bit rate."""

    code: Number | None = option(_NO_CODE, "3")
    baud: Count = fact("bits per second", "9600")
    delivered: bool | None = option(_DELIVERED, "true")


@dataclass(frozen=True, kw_only=True)
class FormatCode(Entry):
    """A code of the setting that chooses parity and stop bits; what the manual does not say stays out."""

    code: Number | None = option(_NO_CODE, "1")
    parity: Literal["none", "even", "odd"] = fact("parity bit", "even")
    data_bits: Literal[7, 8] | None = option("data bits", "8")
    stop_bits: Literal[1, 2] | None = option("stop bits", "1")
    delivered: bool | None = option(_DELIVERED, "true")


@dataclass(frozen=True, kw_only=True)
class StopBitsCode(Entry):
    """A code of the setting that chooses the stop bits, where another chooses the parity."""

    code: Number = fact("number on the keypad", "1")
    stop_bits: Literal[1, 2] = fact("stop bits", "2")


@dataclass(frozen=True, kw_only=True)
class Choice(Cited):
    """Base of a serial property: the setting that chooses it and the factory's choice."""

    source: English = fact("where the manual says so", "table of communication parameters")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    setting: Id | None = option("id of the keypad setting", "H5-02")
    default: Number | None = option("factory setting, as a code of the list", "3")


@dataclass(frozen=True, kw_only=True)
class ModeChoice(Choice):
    """RTU, ASCII or both."""

    modes: tuple[Literal["rtu", "ascii"], ...] = fact("what the drive speaks", "[rtu, ascii]")
    codes: tuple[ModeCode, ...] = option("codes of the setting", "[{code: 2, mode: rtu}]", default=())


@dataclass(frozen=True, kw_only=True)
class BaudChoice(Choice):
    """Bit rates."""

    codes: tuple[BaudCode, ...] = option("codes of the setting", "[{code: 3, baud: 9600}]", default=())


@dataclass(frozen=True, kw_only=True)
class FormatChoice(Choice):
    """Character formats."""

    codes: tuple[FormatCode, ...] = option(
        "codes of the setting", "[{code: 1, parity: even, data_bits: 8, stop_bits: 1}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class StopBitsChoice(Choice):
    """Stop bits, where their setting is not that of the parity."""

    codes: tuple[StopBitsCode, ...] = fact("codes of the setting", "[{code: 0, stop_bits: 1}, {code: 1, stop_bits: 2}]")


@dataclass(frozen=True, kw_only=True)
class UnitAddress(Cited):
    """Unit (slave) addresses."""

    min: Number = fact("smallest", "1")
    max: Number = fact("greatest", "247")
    source: English = fact("where the manual says so", "bus structure (3)")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    above_247: English | None = option(
        "where the manual says that 248 to 255 are addresses too, which the standard reserves", "table 3, `1 to 250`"
    )
    setting: Id | None = option("id of the keypad setting", "H5-01")
    default: Number | None = option("factory setting", "1")
    no_address: Number | None = option(
        "the number of that setting at which the drive answers nobody; it may be the factory setting", "0"
    )

    @property
    def silent(self) -> bool:
        """Whether the drive as delivered answers nobody."""
        return self.no_address is not None and self.no_address == self.default


@dataclass(frozen=True, kw_only=True)
class Silence(Cited):
    """Silence on the line around a frame."""

    source: English = fact("where the manual says so", "RTU frame structure")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    characters: Factor | None = option("silence before and after a frame, in character times", "3.5")
    milliseconds: Factor | None = option(
        "silence before and after a frame, in ms at any bit rate; also the pause that a drive wants after its reply",
        "10",
    )
    gap_characters: Factor | None = option("longest pause inside a frame, in character times", "1.5")


@dataclass(frozen=True, kw_only=True)
class ReplyDelay(Cited):
    """A keypad setting that lets the drive answer later."""

    setting: Id = fact("id of the keypad setting, whose `default` and `range` are counts of it", "P14.03")
    milliseconds: Factor = fact("how long one count is, ms", "1")
    source: English = fact("where the manual says so", "table of communication parameters")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Broadcast(Cited):
    """Frames to all drives at once."""

    address: Number = fact("the broadcast address", "0")
    replies: bool = fact("whether drives answer it", "false")
    source: English = fact("where the manual says so", "bus structure (3)")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    start_addresses: tuple[Address, ...] = option(
        "the only start addresses that a broadcast may use", "[0000H, 0001H]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class Pin(Entry):
    """A pin, or a terminal."""

    pin: Str = fact("its number, or what the drive prints beside it", '"4"')
    label: Str | None = option("the maker's word for it, where that is another", "D1 Modbus signal")
    wire: Wire = fact(
        "what it is: `positive` while nobody sends is D1, or B of TIA-485, `negative` D0, or A; `reserved` carries "
        "something else",
        "positive",
    )


@dataclass(frozen=True, kw_only=True)
class Plug(Cited):
    """Where the line is connected, as far as a text says."""

    connector: Connector | None = option("what it is", "rj45")
    pins: tuple[Pin, ...] = option(
        "its pins or terminals; a pin of a plug is a number", '[{pin: "4", label: D1, wire: positive}]', default=()
    )
    termination: English | None = option("the resistor at the ends of the line, and where it is", "built in, by S1")
    bias: English | None = option("what holds the two wires apart while nobody sends", "650 ohm, in the master")
    shield: English | None = option("where the shield goes", "on earth at each device")
    never: tuple[English, ...] = option("what not to do", "[wire pin 7]", default=())
    source: English = fact("where the manual says so", "page 8")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class Serial(Entry):
    """The line: interface, modes, rates, formats, addresses, pauses."""

    interface: Text = fact("electrical interface", "{en: RS-485 half duplex, zh: RS485}")
    mode: ModeChoice = fact("RTU or ASCII", "{modes: [rtu], source: ...}")
    baud: BaudChoice | None = option("bit rates", "{setting: H5-02, default: 3, codes: [...], source: ...}")
    format: FormatChoice | None = option("character formats", "{setting: H5-03, codes: [...], source: ...}")
    stop_bits: StopBitsChoice | None = option(
        "stop bits, where a setting of their own chooses them; then `format` has none",
        "{setting: H5-06, codes: [...], source: ...}",
    )
    unit: UnitAddress = fact("unit addresses", "{min: 1, max: 247, source: ...}")
    silence: Silence | None = option("pauses around frames", "{characters: 3.5, source: ...}")
    reply_delay: ReplyDelay | None = option(
        "what lets the drive answer later", "{setting: P14.03, milliseconds: 1, source: ...}"
    )
    broadcast: Broadcast | None = option("broadcast", "{address: 0, replies: false, source: ...}")
    pins: Plug | None = option("where the line is connected", "{connector: rj45, pins: [...], source: ...}")


@dataclass(frozen=True, kw_only=True)
class Limit(Cited):
    """One limit and where it is given."""

    value: Count = fact("the number", "16")
    source: English = fact("where the manual says so", "command 03H")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Limits(Entry):
    """What fits into one frame."""

    read_words: Limit | None = option("words that one 03H may read", "{value: 16, source: ...}")
    write_words: Limit | None = option("words that one request may write", "{value: 16, source: ...}")
    group: Limit | None = option(
        "addresses of a group, counted from 0000H, that no request may cross; 256 where the high byte is the group",
        "{value: 256, source: ...}",
    )
    data_bytes: Limit | None = option(
        "bytes of the data field (between function code and checksum) of an RTU frame", "{value: 25, source: ...}"
    )
    ascii_data_bytes: Limit | None = option(
        "bytes of the data field of an ASCII frame, each sent as two characters", "{value: 16, source: ...}"
    )


@dataclass(frozen=True, kw_only=True)
class SubFunction(Named):
    """A sub-function of function 08H."""

    code: Number = fact("sub-function code", "0000H")


@dataclass(frozen=True, kw_only=True)
class Function(Named, Cited):
    """A Modbus function that the drive knows."""

    code: Number = fact("function code", "03H")
    source: English = fact("where the manual says so", "RTU frame structure")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    sub_functions: tuple[SubFunction, ...] = option(
        "sub-functions of 08H", "[{code: 0000H, name: ..., zh: ...}]", default=()
    )
    sent: bool = option("`false` for a function that the manual lists and that no block sends", "false", default=True)


@dataclass(frozen=True, kw_only=True)
class Condition(Entry):
    """A register, or a bit of it, that must have a value; or a number that must be below or above another.

    It has one of `equals`, `below` and `above`; numbers are signed where the register's row says so.
    """

    register: Address = fact("the register", "000FH")
    bit: Bits | None = option("the bit or bits; left out for the whole word", "0")
    mask: Number | None = option(
        "bits that count, where they are not side by side; the value is in their place", "006FH"
    )
    equals: Number | None = option("the value", "0")
    differs: bool | None = option(
        "in a status: it holds while the value is any other, such as a fault code that is not 0", "true"
    )
    below: Number | None = option(
        "in a status or for standstill: it holds while the number is less; `below: 0` of a signed one: while it is "
        "negative",
        "0",
    )
    above: Number | None = option("in a status or for standstill: it holds while the number is greater", "5")


@dataclass(frozen=True, kw_only=True)
class OtherScale(Cited):
    """Another factor of a measure, which holds while something else is true: decimals or a unit by a register."""

    factor: Factor = fact("engineering units per count", "0.1")
    when: Condition | None = option(
        "holds only while this is true; left out of the last, which holds while no other does",
        "{register: 211FH, bit: 8-F, equals: 1}",
    )
    source: English = fact("where the manual states or proves it", "table of monitors, 211FH")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Scale(Cited):
    """Engineering value = raw word x factor, where the manual states or proves it."""

    factor: Factor = fact("engineering units per count", "0.01")
    source: English = fact("where the manual states or proves it", "000FH bit 0")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    when: Condition | None = option("holds only while this is true", "{register: 000FH, bit: 0, equals: 0}")
    otherwise: tuple[OtherScale, ...] = option(
        "the other factors of a measure, each with what it holds for; no two conditions may hold at once, and where "
        "none does, but for a last one without `when`, the measure is not valid; simulated drives have the first",
        "[{factor: 0.1, when: {register: 211FH, bit: 8-F, equals: 1}, source: ...}]",
        default=(),
    )
    needs: Switch | None = option(
        "holds only while a keypad setting, which then is needed so, has a value: a choice of decimals or of a unit",
        "{setting: H5-05, value: 0}",
    )
    proof: Word | None = option("id of the example frame that proves it", "read_frequency_reply")

    @property
    def choices(self) -> "tuple[Scale | OtherScale, ...]":
        """Each factor with what it holds for."""
        return self, *self.otherwise

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """On what the factor depends."""
        return tuple(one.when for one in self.choices if one.when is not None)


@dataclass(frozen=True, kw_only=True)
class PrintedBit(Entry):
    """How the manual prints a bit, where that is wrong."""

    bit: Str | None = option("the bit column as printed", "F")
    id: Str | None = option("the id as printed", "EV")


@dataclass(frozen=True, kw_only=True)
class Bit(Worded, Entry):
    """A bit, a field of bits, or a hole in a word."""

    bit: Bits = fact("bit number in hexadecimal, or a range for a field or a hole", "8-F")
    name: English | None = option("English name; left out for a hole", "Running")
    zh: Str | None = option(_CHINESE, '"1: 运行中"')
    zh_used: Str | None = option("the wording to show, where `zh` holds a misprint", "超速")
    short: Short | None = option("shorter wordings, where a text is longer than 80 bytes", "{zh: ...}")
    wording: Str | None = option(_WORDING, '"1: In Betrieb"')
    id: Str | None = option("the manual's short id, such as a fault's", "UV1")
    unused: bool = option("the manual says that the bit is not used", "true", default=False)
    does: tuple[Act, ...] = option(
        "of a command register, what the bit does to the motor at 1, or a field at any value but 0 that does not say "
        f"it itself; {_ACTS}; left out, it counts as starting",
        "[starts]",
        default=(),
    )
    at_0: tuple[Act, ...] = option("what it does at 0, as above; by its level", "[coasts]", default=())
    by: By | None = option(_BY, "edge")
    holds: bool = option(_HOLDS, "true", default=False)
    values: tuple[Value, ...] = option(
        "meaning of each value of a field, or of 0 and 1", "[{value: 0, name: ..., zh: ...}]", default=()
    )
    printed: PrintedBit | None = option("what the manual prints instead (needs an erratum)", "{bit: F}")
    symbol: Symbol | None = option(
        "identifier in Structured Text, where the one made from the name is too long or taken", "InputTerminals"
    )
    note: English | None = option("what else a person must know", "terminals 9 and 10")


@dataclass(frozen=True, kw_only=True)
class Never(Entry):
    """Bits of a command register that must never have a value, whatever else is in the word."""

    bit: Bits = fact("the bit or bits; `0-F` for the whole word", "4-5")
    equals: Number = fact("the value", "3")
    why: English = fact("what the drive would do", "the direction changes, or not, by edition")

    @property
    def mask(self) -> int:
        """The bits in their places."""
        return sum(1 << number for number in self.bit)

    def holds(self, word: int) -> bool:
        """Whether a word has the value."""
        return word & self.mask == self.equals << self.bit.first


@dataclass(frozen=True, kw_only=True)
class PrintedRow(Entry):
    """How the manual prints a register's row, where that is wrong."""

    address: Str | None = option("the address as printed", "0210H")
    id: Str | None = option("the id as printed", "B5-05")


@dataclass(frozen=True, kw_only=True)
class Register(Worded, Trusted):
    """One row of a register table: a register, or a run of registers that one row describes."""

    address: Addresses = fact("wire address, zero-based, or a range", "0026H")
    id: Id | None = option("the manual's parameter id, or a range of ids", "U1-07")
    name: English | None = option("English name; left out where the manual gives no name", "DC bus voltage")
    zh: Str | None = option(_CHINESE, "直流电压")
    zh_used: Str | None = option("the wording to show, where `zh` holds a misprint (needs an erratum)", "输出功率")
    wording: Str | None = option(_WORDING, "Zwischenkreisspannung")
    access: Access | None = option(
        "overrides the section's access; where something else is read at an address than is written, it has a row with "
        "`r` and one with `w`",
        "r",
    )
    unused: bool = option("the manual says that the address is not used", "true", default=False)
    unit: Unit | None = option("unit of the engineering value", "Hz")
    scale: Scale | None = option("factor of the engineering value", "{factor: 0.1, source: ...}")
    space: Space | None = option("overrides the section's `space`", "input")
    words: Literal[2] | None = option(
        "2: each value has 32 bits in two registers, and is named by the first; the address is a range", "2"
    )
    order: Literal["high_first", "low_first"] | None = option(
        "of 32 bits, the word that the first register holds; left out, the high one", "low_first"
    )
    signed: bool = option("the value is a two's complement number", "true", default=False)
    range: Range | None = option("allowed raw values", "{min: -10000, max: 10000}")
    values: tuple[Value, ...] = option(
        "meaning of each value of the word", "[{value: 1, name: ..., zh: ...}]", default=()
    )
    masks: bool = option(
        "the values are single bits; the manual does not say whether they combine", "true", default=False
    )
    does: tuple[Act, ...] = option(
        "of a command register without values and bits, what any value but 0 does to the motor, as in [Bit](#bit)",
        "[resets]",
        default=(),
    )
    bits: tuple[Bit, ...] = option("bits of the word", "[{bit: 0, name: Running, zh: 运行中}]", default=())
    never: tuple[Never, ...] = option(
        "what is never written to a command register: no command writes it, and `KeepWord` reaches none of its bits",
        "[{bit: 4-5, equals: 3, why: ...}]",
        default=(),
    )
    printed: PrintedRow | None = option("what the manual prints instead (needs an erratum)", "{address: 0210H}")
    symbol: Symbol | None = option(
        "identifier in Structured Text, where the one made from the name is too long or taken", "InputTerminals"
    )
    note: English | None = option("what else a person must know", "write 0 to store")
    source: English | None = option("overrides the section's source", "page 9")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )

    @property
    def size(self) -> int:
        """How many registers hold a value."""
        return self.words or 1

    @property
    def barred(self) -> int:
        """The bits of `never`, as a mask."""
        return reduce(or_, (one.mask for one in self.never), 0)


@dataclass(frozen=True, kw_only=True)
class Series(Entry):
    """A run of parameter ids whose registers follow each other: address = base + (number - first number)."""

    ids: Id = fact("first and last id", "U1-01..U1-28")
    base: Address = fact("address of the first id", "0020H")
    apart: tuple[Id, ...] = option("ids that the manual places elsewhere", "[C3-05]", default=())


@dataclass(frozen=True, kw_only=True)
class Section(Cited):
    """One register table of the manual, in the manual's order."""

    id: Word = fact("short name", "monitors_u1")
    title: Text = fact("heading of the table", "{en: U1 monitors, zh: U1-XX 监测具体内容寄存器}")
    source: English = fact("where it is in the manual", "section (II)")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    access: Access = fact("how its registers may be used: r, w or rw", "r")
    space: Space | None = option(
        "the table of Modbus that its registers are in: `holding` registers (read by 03H), `input` registers (04H), "
        "`coil`s (read by 01H, written by 05H) or `discrete` inputs (02H); a coil is a register whose value is 0 or 1. "
        "Elsewhere the table is named before the address, as in `register: coil 0001H`",
        "coil",
    )
    registers: tuple[Register, ...] = fact(
        "the rows, in the manual's order", "[{address: 0020H, id: U1-01, name: ..., zh: ...}]"
    )
    series: tuple[Series, ...] = option(
        "ids whose addresses follow each other; every row is checked against them",
        "[{ids: U1-01..U1-28, base: 0020H}]",
        default=(),
    )
    note: English | None = option("what else a person must know", "rows are printed out of order")


@dataclass(frozen=True, kw_only=True)
class AreaExample(Entry):
    """An example of an area's addressing rule, from the manual."""

    id: Id = fact("parameter", "P5.05")
    number: Number = fact("its number", "58")
    address: Address = fact("its address", "003AH")


@dataclass(frozen=True, kw_only=True)
class Excluded(Named):
    """Parameters of an area that must not be touched."""

    ids: Id = fact("which parameters", "PE")


@dataclass(frozen=True, kw_only=True)
class Area(Named, Cited):
    """Parameter registers that the manual gives by a rule: address = base + number."""

    id: Word = fact("short name", "function_codes")
    addresses: Addresses = fact("the addresses", "0000H-01FFH")
    numbered_by: Literal["sequence_number", "parameter_number"] = fact("what the number is", "sequence_number")
    access: Access = fact("r, w or rw", "rw")
    source: English = fact("where it is in the manual", "11.6.4 (1)")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    examples: tuple[AreaExample, ...] = fact("the manual's examples", "[{id: P5.05, number: 58, address: 003AH}]")
    excluded: tuple[Excluded, ...] = option(
        "parameters that must not be read or written", "[{ids: PE, name: ..., zh: ...}]", default=()
    )
    note: English | None = option("what else a person must know", "...")


@dataclass(frozen=True, kw_only=True)
class Twin(Entry):
    """Two registers of one value: a write to the one is stored, to the other not."""

    stored: Address = fact("the register whose writes are stored", "000EH")
    ram: Address = fact("the one whose writes stay in RAM", "000DH")


@dataclass(frozen=True, kw_only=True)
class TwinRange(Entry):
    """Twins by a rule: each register of a range that the map lists has one as far into the other range."""

    stored: Addresses = fact("the registers whose writes are stored", "F000H-FEFFH")
    ram: Addresses = fact("where writes to the same values stay in RAM; the map does not list these", "0000H-0EFFH")


@dataclass(frozen=True, kw_only=True)
class Storage(Cited):
    """What happens to a written parameter: RAM, EEPROM, or unexplained (then it counts as EEPROM)."""

    method: Literal["enter_register", "ram_address_bit", "ram_twin", "volatile", "unexplained"] = fact(
        "`enter_register`: writes reach RAM, writing a register stores them; `ram_address_bit`: writes are stored "
        "unless a bit is added to the address; `ram_twin`: writes are stored, but some registers are there a second "
        "time in RAM; `volatile`: nothing that is "
        "written outlasts the supply; `unexplained`: the manual does not say",
        "enter_register",
    )
    source: English = fact("where the manual says so", "section (VI)")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    note: English = fact("the rule in one or two sentences", "ENTER stores all parameters")
    register: Address | None = option("enter_register: the register to write", "FFFDH")
    value: Number | None = option(
        "enter_register: the word to write; where one bit stores, with the others as they must be", "0"
    )
    max_writes: Writes | None = option("how often the memory can be written", "100000")
    add: Number | None = option("ram_address_bit: what to add to an address", "8000H")
    area: Word | None = option("ram_address_bit: the only area, or section, where it may be added", "function_codes")
    twins: tuple[Twin, ...] = option(
        "ram_twin: the registers that are there twice", "[{stored: 000EH, ram: 000DH}]", default=()
    )
    twin_ranges: tuple[TwinRange, ...] = option(
        "ram_twin: the same by a rule", "[{stored: F000H-FEFFH, ram: 0000H-0EFFH}]", default=()
    )
    readable: bool = option("ram_address_bit: whether such an address may be read", "false", default=True)


@dataclass(frozen=True, kw_only=True)
class Step(Entry):
    """One write on the way to a command's own, and what the next one waits for."""

    register: Address = fact("register that is written", "2000H")
    value: Number | None = option("the whole word", "0006H")
    set: tuple[Bits, ...] = option("bits to set, others kept", "[3]", default=())
    clear: tuple[Bits, ...] = option("bits to clear, others kept", "[4]", default=())
    until: Word | None = option("state that the drive must show before the next write", "switched_on")
    for_ms: Count | None = option("how long the word stays before the next write, for a pulse, ms", "100")
    silent_ms: Count | None = option(
        "fault_reset: how long the drive answers nothing once it has answered this write, ms", "1000"
    )


@dataclass(frozen=True, kw_only=True)
class Command(Cited):
    """What one command is on the wire: a value of the command register, or bits set and cleared in it.

    The register's row must say that its bits or values do just that.
    """

    does: Does = fact("what it does", "run_forward")
    register: Address = fact("command register", "1000H")
    value: Number | None = option("the whole word", "1")
    set: tuple[Bits, ...] = option("bits to set, others kept", "[0]", default=())
    clear: tuple[Bits, ...] = option("bits to clear, others kept", "[1]", default=())
    first: tuple[Step, ...] = option(
        "writes that are sent before it, in this order: states, an edge, a pulse, another register; a stop has none",
        "[{register: 2000H, value: 0006H, until: ready_to_switch_on}]",
        default=(),
    )
    silent_ms: Count | None = option(
        "fault_reset: how long the drive answers nothing once it has answered this write, ms", "1000"
    )
    because: English | None = option(
        "the manual's reason, in a sentence, where its table of bits or values does not tell it",
        "section 3 says that writing 0 stops the motor by its ramp",
    )
    negative: bool = option(
        "run_reverse of a drive without such a command: it writes what run_forward does, and the reference is negative",
        "true",
        default=False,
    )
    source: English = fact("where the manual says so", "section (I), 0000H")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    note: English | None = option("what else a person must know", "bits 2 to 7 are terminals and are kept")

    @property
    def writes(self) -> tuple["Command | Step", ...]:
        """All its writes in their order, its own word last."""
        return (*self.first, self)


@dataclass(frozen=True, kw_only=True)
class Reference(Cited):
    """How the speed reference is given."""

    register: Address = fact("reference register", "0001H")
    means: Literal["frequency", "percent_of_maximum", "fraction_of_full_scale", "speed"] = fact(
        "what the word is; a fraction has its own count of full scale, a percentage has that of its register's scale; "
        "a speed in r/min needs `PolePairs` of `VFD_Settings`",
        "frequency",
    )
    source: English = fact("where the manual says so", "section (I), 0001H")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    maximum: Id | None = option("parameter that holds the 100 % value", "P0.04")
    full_scale: Number | None = option("fraction_of_full_scale: the word that is 100 %", "4000H")
    full_scale_hz: Factor | None = option(
        "fraction_of_full_scale: what 100 % is in Hz, where no parameter holds it and the manual gives it for good",
        "50",
    )
    negative_reverses: bool = option("a negative reference turns the motor the other way", "true", default=False)
    verify: tuple[Condition, ...] = option(
        "what must be read back before the reference means what it says",
        "[{register: 000FH, bit: 0, equals: 0}]",
        default=(),
    )


@dataclass(frozen=True, kw_only=True)
class Standstill(Cited):
    """What proves that the motor is at standstill: all of these at once, read after the stop was acknowledged."""

    all: tuple[Condition, ...] = fact("the conditions", "[{register: 0010H, bit: 0, equals: 0}]")
    source: English = fact("where the manual says so", "section (I), 0010H; U1-02")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    why: English = fact("why this proves it", "status and frequency both say so")


@dataclass(frozen=True, kw_only=True)
class InCommand(Cited):
    """What says that the bus is in command of the drive, and not its keypad or its terminals: all of these at once."""

    all: tuple[Condition, ...] = fact("the conditions", "[{register: 0C81H, bit: 9, equals: 1}]")
    source: English = fact("where the manual says so", "table of the status word")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class OwnMaximum(Cited):
    """The register of the drive's own maximum frequency, or of what 100 % is; its row has the unit Hz and a scale."""

    register: Address = fact("the register", "0303H")
    source: English = fact("where the manual says so", "table of parameters, E1-04")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class State(Cited):
    """A named state of the drive: a masked value of a status word."""

    name: Word = fact("its name, by which steps wait for it", "switched_on")
    register: Address = fact("the status word", "2100H")
    mask: Number | None = option("bits that count; left out for the whole word", "006FH")
    equals: Number = fact("their value, in their place", "0023H")
    source: English = fact("where the manual says so", "section 5, table of states")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Status(Cited):
    """What a pin of the drive block shows: TRUE while one of these holds."""

    shows: Shows = fact("the pin", "running")
    any: tuple[Condition, ...] = fact("the conditions", "[{register: 0010H, bit: 0, equals: 1}]")
    source: English = fact("where the manual says so", "section (I), 0010H")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Forbidding(Cited):
    """What forbids a start: no motion begins while one of these holds; one that is under way goes on."""

    any: tuple[Condition, ...] = fact("the conditions", "[{register: 2138H, bit: E, equals: 1}]")
    why: English = fact("what a person should know who wonders why nothing starts", "the drive watches no silent line")
    source: English = fact("where the manual says so", "table of the control words")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Measured(Cited):
    """A register whose value a pin of the drive block shows."""

    shows: Measure = fact("the pin", "output_current")
    register: Address = fact(
        "the register; without a scale the pin needs a setting, which only the first five measures have; a signed "
        "output frequency or speed is shown without its sign",
        "0022H",
    )
    source: English = fact("where the manual says so", "section (II), U1-03")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Identity(Cited):
    """By what one sees that the drive at an address is of this family: all of these at once, in one read."""

    all: tuple[Condition, ...] = fact("the conditions", "[{register: 0010H, equals: 1205H}]")
    source: English = fact("where the manual says so", "table of device data, product code")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    why: English = fact("why no other drive answers so", "the maker gives each family a code of its own")


@dataclass(frozen=True, kw_only=True)
class SilenceTime(Cited):
    """After how much silence the watchdog acts: a keypad setting or a register, and what one count of it is."""

    setting: Id | None = option("the keypad setting that holds it", "P14.04")
    register: Address | None = option("the register that holds it, where it is no keypad setting", "0000H")
    milliseconds: Factor = fact("how long one count is, ms", "100")
    source: English = fact("where the manual says so", "table of communication parameters")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")


@dataclass(frozen=True, kw_only=True)
class Reaction(Entry):
    """What the drive does when its line is silent, for one value of the setting that chooses it."""

    value: Number | None = option("value of the setting; left out where none chooses", "0")
    does: Reacts = fact("what the drive does", "coast_stop")


@dataclass(frozen=True, kw_only=True)
class Watchdog(Cited):
    """The drive's own watchdog of a silent line: what feeds it, when it acts, and what it then does."""

    feeds: Feed | None = option(
        "what it takes for a sign of life: any good frame, any good read, or any good write; left out where the manual "
        "does not say",
        "writes",
    )
    fed_by: tuple[Address, ...] = option(
        "in the place of `feeds`: the registers whose writes alone it takes for one", "[0001H]", default=()
    )
    counts: Counts | None = option(
        "when it counts: while the motor runs, always, so that it acts at standstill, too, or while the bus is in "
        "command; left out where the manual does not say, which is taken for `running`",
        "always",
    )
    time: SilenceTime | None = option(
        "after how much silence it acts", "{setting: P14.04, milliseconds: 100, source: ...}"
    )
    disabled_by: Switch | None = option("what switches it off", "{setting: H5-05, value: 0}")
    chosen_by: Id | None = option("the keypad setting that chooses what it does", "H5-04")
    reactions: tuple[Reaction, ...] = fact(
        "what the drive does, by value of that setting", "[{value: 0, does: stop}, {value: 3, does: runs_on}]"
    )
    fault: Number | None = option("code of the fault that it shows", "21H")
    source: English = fact("where the manual says so", "table of communication parameters")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    note: English | None = option("what else a person must know", "the motor does not start again by itself")


@dataclass(frozen=True, kw_only=True)
class Operation(Entry):
    """Commands, reference, what proves standstill, and what the drive shows."""

    commands: tuple[Command, ...] = fact(
        "what the drive can be asked to do", "[{does: stop, register: 1000H, value: 3, source: ...}]"
    )
    reference: Reference = fact("how speed is given", "{register: 0001H, means: frequency, source: ...}")
    standstill: Standstill = fact("what proves standstill", "{all: [...], source: ..., why: ...}")
    status: tuple[Status, ...] = fact(
        "what the pins of the drive block show; `running` is a must",
        "[{shows: running, any: [{register: 0010H, bit: 0, equals: 1}], source: ...}]",
    )
    measures: tuple[Measured, ...] = option(
        "registers whose values pins show", "[{shows: output_frequency, register: 0021H, source: ...}]", default=()
    )
    states: tuple[State, ...] = option(
        "named states that steps wait for",
        "[{name: switched_on, register: 2100H, mask: 006FH, equals: 0023H, ...}]",
        default=(),
    )
    forbids: tuple[Forbidding, ...] = option(
        "what forbids a start, and why",
        "[{any: [{register: 2138H, bit: E, equals: 1}], why: ..., source: ...}]",
        default=(),
    )
    commanded_by: InCommand | None = option(
        "what says that the bus is in command", "{all: [{register: 0C81H, bit: 9, equals: 1}], source: ...}"
    )
    own_maximum: OwnMaximum | None = option(
        "the register of the drive's own maximum frequency, or of what 100 % of the reference is, where its scale is "
        "known, too",
        "{register: 0303H, source: ...}",
    )
    lower_limit: Id | None = option(
        "the parameter with the lower limit of the speed: with a reference below it, 0 too, the motor may turn at it",
        "P00.05",
    )

    @property
    def by_sign(self) -> bool:
        """Whether a negative reference is what reverses a run."""
        return any(command.negative for command in self.commands)

    @property
    def silenced(self) -> "tuple[int, int] | None":
        """Of a fault reset, the number of the write that the drive is silent after, from 0, and for how long, ms."""
        writes = (each for one in self.commands if one.does == "fault_reset" for each in enumerate(one.writes))
        return next(((number, one.silent_ms) for number, one in writes if one.silent_ms), None)

    @property
    def in_one_word(self) -> bool:
        """Whether each command is one write of a word."""
        return not any(command.first or form.is_bit(command.register) for command in self.commands)


@dataclass(frozen=True, kw_only=True)
class BitRelation(Cited):
    """Fault number = 16 x (word - first) + bit + 1, for fault bits with an id."""

    first: Address = fact("first fault word", "0014H")
    last: Address = fact("last fault word", "0016H")
    source: English = fact("how it was found", "compared (I) with the table of fault numbers")


@dataclass(frozen=True, kw_only=True)
class Fault(Returned, Trusted):
    """One fault code, or one warning code."""

    code: Number = fact("the number that the drive reports", "1EH")
    id: Str | None = option("the drive's short display; several codes may have the same", "OPR")
    printed_code: Str | None = option("the code as printed, where that is wrong (needs an erratum)", "OEF")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    note: English | None = option("what else a person must know", "...")
    causes: tuple[Text, ...] = option("what may have caused it, in few words", "[{en: ...}]", default=())
    remedies: tuple[Text, ...] = option("what to do about it, in order, in few words", "[{en: ...}]", default=())
    power_cycle: bool = option(
        "true: no other way to clear it is named than to switch the drive off and on", "true", default=False
    )


@dataclass(frozen=True, kw_only=True)
class Help(Cited):
    """Where the causes and remedies of the codes are from."""

    source: English = fact("where they are", "chapter 4, table of fault descriptions")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    keypad: Str | None = option("how the keypad shows code 0; for codes without an `id`", "F000")

    def shown(self, code: int) -> str:
        """How the keypad shows a code; empty where nobody says."""
        head = (self.keypad or "").rstrip("0")
        return f"{head}{code:0{len(self.keypad) - len(head)}}" if self.keypad else ""


@dataclass(frozen=True, kw_only=True)
class TripOutput(Cited):
    """What becomes of the motor when the drive trips."""

    motor: Literal["coasts", "ramps", "differs"] = fact(
        "`coasts`: the output is switched off; `ramps`: it is decelerated first; `differs`: by the fault or a setting",
        "coasts",
    )
    source: English = fact("where the manual says so", "table of faults, column of the response")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    note: English | None = option(
        "what else a person must know; a must with `differs`", "a fault of the fan ramps down"
    )


@dataclass(frozen=True, kw_only=True)
class Faults(Cited):
    """Fault codes and the registers that report them."""

    source: English = fact("where the table is", "section (IV), table of fault numbers")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    registers: tuple[Addresses, ...] = fact("registers that hold a fault code", "[0080H, 0090H-0093H]")
    present: Address | None = option(
        "the one that holds the fault that is present, where `bits` do not show it", "3000H"
    )
    present_bits: Bits | None = option(
        "the bits of that register which hold the code, where the others hold something else, such as a warning", "0-7"
    )
    codes: tuple[Fault, ...] = option(
        "the codes, in the manual's order", "[{code: 01H, id: FU, name: ..., zh: ...}]", default=()
    )
    bits: BitRelation | None = option("relation of codes to fault bits", "{first: 0014H, last: 0016H, source: ...}")
    trip_output: TripOutput | None = option("what becomes of the motor in a trip", "{motor: coasts, source: ...}")
    help: Help | None = option("where causes and remedies are from; a must with them", "{source: chapter 4}")

    def code_in(self, address: int, word: int) -> int:
        """The code in a word of a register that reports faults."""
        bits = self.present_bits if address == self.present else None
        return word if bits is None else word >> bits.first & (1 << len(bits)) - 1


@dataclass(frozen=True, kw_only=True)
class Warnings(Cited):
    """Warning codes and the register that reports them."""

    source: English = fact("where the table is", "table of warnings")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    register: Address = fact("the register that holds the code of the present warning, 0 for none", "2100H")
    bits: Bits | None = option(
        "the bits of it which hold the code, where the others hold something else, such as a fault", "8-F"
    )
    codes: tuple[Fault, ...] = fact("the codes, in the manual's order", "[{code: 01H, id: CE1, name: ..., zh: ...}]")

    @property
    def span(self) -> Span:
        """The bits that hold the code."""
        return Span(0, 15) if self.bits is None else self.bits

    def code_in(self, word: int) -> int:
        """The code in a word of the register."""
        return word >> self.span.first & (1 << len(self.span)) - 1


@dataclass(frozen=True, kw_only=True)
class ErrorForm(Cited):
    """What a refusal looks like on the wire."""

    kind: Literal["exception", "write_reply"] = fact(
        "`exception`: function + add and one code byte; `write_reply`: a write function, a fixed address, the code "
        "as its word",
        "exception",
    )
    source: English = fact("where the manual says so", "error replies")
    add: Number | None = option("exception: what is added to the function code", "80H")
    function: Number | None = option("write_reply: the function code, whatever was asked", "06H")
    address: Address | None = option("write_reply: the address", "5001H")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class ErrorCode(Returned):
    """One reason for a refusal."""

    code: Number | None = option("the code; left out where the manual prints none", "21H")
    meaning: Text | None = option("the manual's explanation", "{en: ..., zh: ...}")
    causes: tuple[Text, ...] = option("the manual's list of causes", "[{en: ..., zh: ...}]", default=())
    busy: bool = option("the drive cannot do it now; the same request may be sent again", "true", default=False)
    note: English | None = option("what else a person must know", "...")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ..., value: 1}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class Errors(Cited):
    """How the drive refuses a request."""

    form: ErrorForm | None = option("what a refusal looks like", "{kind: exception, add: 80H, source: ...}")
    source: English = fact("where the table is", "meaning of error codes")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    codes: tuple[ErrorCode, ...] = fact("the reasons, in the manual's order", "[{code: 01H, name: ..., zh: ...}]")


@dataclass(frozen=True, kw_only=True)
class Notice(Cited):
    """A prohibition, warning, hazard or procedure that the manual gives in prose."""

    kind: Literal["prohibition", "warning", "hazard", "procedure"] = fact("what it is", "prohibition")
    text: Text = fact("the text; the Chinese as printed", "{en: ..., zh: ...}")
    source: English = fact("where it is", "notes (2)")
    about: tuple[Ref, ...] = option("what it is about", "[register FFFDH]", default=())
    note: English | None = option("what to make of it", "this hides a lost line")


@dataclass(frozen=True, kw_only=True)
class Quantity(Entry):
    """An engineering value in an example frame."""

    register: Address = fact("the register", "2000H")
    value: Factor = fact("the value", "50.0")
    unit: Unit = fact("its unit", "Hz")


@dataclass(frozen=True, kw_only=True)
class Means(Entry):
    """What an example frame means, typed by hand from the manual's words, never computed from the bytes."""

    says: English = fact("in one sentence", "reads 2 words from 0026H")
    unit: Number = fact("unit address", "1")
    function: Number = fact("function code", "03H")
    address: Address | None = option("register address", "0026H")
    words: Number | None = option("number of words", "2")
    byte_count: Number | None = option("byte count field", "4")
    values: tuple[Number, ...] = option("words carried, in order", "[500]", default=())
    sub_function: Number | None = option("sub-function of 08H", "0000H")
    data: Number | None = option("data word of 08H", "12ABH")
    error: Number | None = option("error code", "5")
    quantities: tuple[Quantity, ...] = option(
        "engineering values", "[{register: 2000H, value: 50.0, unit: Hz}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class PlcTable(Entry):
    """The same frame as a table of PLC registers, one byte (8) or two characters (16) in each."""

    bits: Literal[8, 16] = fact("the serial instruction's mode", "16")
    first: Annotated[str, form.PLC_DEVICE] = fact("the first register", "D0")
    registers: tuple[Annotated[str, form.REGISTER_WORD], ...] = fact(
        "contents in hexadecimal, high byte first; -- is a byte that is not sent", "[3A30, 0A--]"
    )
    printed: tuple[Annotated[str, form.REGISTER_WORD], ...] = option(
        "the contents as printed, where they are wrong (needs an erratum)", "[3A30, 3631]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class Frame(Entry):
    """An example frame of the manual: the test vector of everything that builds or parses frames."""

    id: Word = fact("short name", "read_dc_bus_request")
    direction: Literal["request", "reply"] = fact("who sends it", "request")
    mode: Literal["rtu", "ascii"] = fact("framing", "rtu")
    source: English = fact("where it is", "command 03H, RTU request")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    printed: Adu = fact("as printed", "01 03 00 26 00 02 25 C0")
    checksum: Literal["right", "wrong"] = fact("verdict on the printed checksum", "right")
    printed_checksum_of: Octets | None = option(
        "wrong checksum: the bytes that it does belong to, where found", "01 03 00 04"
    )
    correct: Adu = fact("the correct bytes", "01 03 00 26 00 02 25 C0")
    answers: Word | None = option("reply: id of the request that it answers", "read_dc_bus_request")
    means: Means = fact("what it says", "{says: ..., unit: 1, function: 03H, address: 0026H, words: 2}")
    plc: PlcTable | None = option("the manual's table of PLC registers", "{bits: 16, first: D0, registers: [...]}")


@dataclass(frozen=True, kw_only=True)
class Erratum(Entry):
    """A misprint or contradiction of the manual and what the map makes of it."""

    about: tuple[Ref, ...] = fact("what it is about; `prose` where no entry of the map is touched", "[register 0220H]")
    where: English = fact("where it is in the manual", "section (V), row C7-02")
    printed: Str = fact("what is printed", "0210H C7-02 防乱系数")
    used: Str = fact("what the map uses", "0220H")
    why: English = fact("the reason", "0210H is C3-02; C7-01 is 021FH and C7-03 is 0221H")
    confidence: Literal["certain", "likely", "open"] = fact("how sure", "certain")
    measured: bool = fact("whether it was tried on a drive", "false")
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class OnSite(Entry):
    """How `driveblocks commission` closes a gap for one drive: what a person does, and what is asked then."""

    do: English = fact("what a person does first", "set the keypad to 20.0 Hz and run by the keypad, motor uncoupled")
    ask: English = fact("the question, without its mark", "which frequency does the keypad show, in Hz")
    read: Address | None = option("the register that is read at the answer", "3000H")
    gives: OpenScale | None = option(
        "the member of `VFD_Settings` that the answer, a number, and the register give", "FrequencyScale"
    )
    by_run: bool = option(
        "only a run by the bus shows it: it is printed for `driveblocks run --allow-run`, and not asked",
        "true",
        default=False,
    )


@dataclass(frozen=True, kw_only=True)
class Absence(Entry):
    """Something that a person needs and the manual does not say."""

    what: English = fact("what is missing", "scale of 1001H")
    about: tuple[Ref, ...] = fact("what it is about", "[register 1001H]")
    matters: English = fact("why it matters", "a guessed scale is a tenfold overspeed")
    find_out: English = fact("how to find out", "write 500 with the motor uncoupled and read the keypad")
    on_site: OnSite | None = option(
        "how `driveblocks commission` closes it for one drive; at most ten of a map, six of them asked",
        "{do: ..., ask: ..., read: 3000H}",
    )
    corroborated: tuple[Corroboration, ...] = option(
        "other documents on this", "[{document: ..., page: ..., reads: ...}]", default=()
    )


@dataclass(frozen=True, kw_only=True)
class Tolerance(Cited):
    """A departure from the standard that replies are allowed; a write answered by another word is none."""

    kind: Literal["two_byte_count"] = fact(
        "`two_byte_count`: the byte count of a read reply may be a word instead of a byte", "two_byte_count"
    )
    source: English = fact("what the manual shows", "11.6.1, CRC of the RTU reply")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")
    why: English = fact("why it is allowed", "the printed CRC is that of such a reply")


@dataclass(frozen=True, kw_only=True)
class Numbering(Cited):
    """How the manual numbers registers, where it does not give the addresses that are sent."""

    first: Count = fact("the number of the register whose address is 0", "40001")
    coil: Count | None = option("the same for coils, where it is another", "1")
    discrete: Count | None = option("the same for discrete inputs", "10001")
    input: Count | None = option("the same for input registers", "30001")
    proof: Word | None = option("id of an example request that shows it", "read_request")
    says: English | None = option("the manual's own words, where no example shows it", "the number minus 1 is sent")
    source: English = fact("where the manual says so", "section 5")
    document: Word | None = option(_SAYS_SO, "fieldbus_guide")

    def base(self, space: str) -> int:
        """The number whose address is 0 in a table of Modbus."""
        own: int | None = getattr(self, space, None)
        return self.first if own is None else own


@dataclass(frozen=True, kw_only=True)
class Drive(Entry):
    """A whole map: one drive family."""

    format: Literal[2] = fact("version of this format", "2")
    base: Word | None = option(
        "the map of a sister model, by the name of its file, where this one says only what is different",
        "rockwell_powerflex_4",
    )
    without: tuple[Str, ...] = option(
        "what the base has and this drive has not, or has otherwise as a whole: keys and names of rows",
        "[settings, faults > codes > 48]",
        default=(),
    )
    profile: Switch | None = option(
        "of a drive whose commands a keypad setting chooses: the value for which this map holds; it is read before a "
        "start, and another profile is another map, with this one as `base`",
        "{setting: P33, value: 1}",
    )
    prefix: Annotated[str, form.PREFIX] = fact("what the names of its blocks start with", "SN300G5")
    vendor: Text = fact("maker", "{en: SHUEN, zh: 数恩}")
    family: Text = fact("family", "{en: SN300G5 series, zh: SN300G5系列变频器}")
    manual: Manual = fact("the manual that the map was read from", "{title: ..., publisher: ...}")
    id_forms: tuple[Annotated[str, form.ID_FORM], ...] = fact(
        "forms of the manual's parameter ids: A letter, a small letter, 9 digit, X letter or digit", "[A9-99]"
    )
    numbering: Numbering | None = option(
        "how the manual numbers registers; then every address of this map is such a number, as in `address: 40102`",
        "{first: 40001, proof: read_request, source: section 5}",
    )
    documents: tuple[Document, ...] = option(
        "other public documents that corroborate values, or that facts are taken from",
        "[{id: ..., title: ..., publisher: ...}]",
        default=(),
    )
    serial: Serial = fact("the line", "{interface: ..., mode: ..., unit: ...}")
    limits: Limits = fact("what fits into one frame", "{read_words: {value: 16, source: ...}}")
    functions: tuple[Function, ...] = fact("Modbus functions", "[{code: 03H, name: ..., zh: ..., source: ...}]")
    settings: tuple[Setting, ...] = fact(
        "keypad settings for communication", "[{id: H5-01, name: ..., zh: ..., source: ...}]"
    )
    sections: tuple[Section, ...] = fact(
        "register tables, in the manual's order", "[{id: ..., title: ..., source: ..., access: r, registers: [...]}]"
    )
    areas: tuple[Area, ...] = option("parameter registers given by a rule", "[{id: function_codes, ...}]", default=())
    storage: Storage = fact("what happens to written parameters", "{method: unexplained, source: ..., note: ...}")
    operation: Operation = fact("commands, reference, standstill", "{commands: [...], reference: ..., standstill: ...}")
    identity: Identity | None = option(
        "by what the drive is recognised over the bus",
        "{all: [{register: 0010H, equals: 1205H}], source: ..., why: ...}",
    )
    watchdog: Watchdog | None = option(
        "the drive's own watchdog of a silent line", "{feeds: any, chosen_by: H5-04, reactions: [...], source: ...}"
    )
    faults: Faults = fact("fault codes", "{source: ..., registers: [...], codes: [...]}")
    warnings: Warnings | None = option(
        "warning codes, where a register holds one", "{source: ..., register: 2100H, codes: [...]}"
    )
    errors: Errors = fact("error replies", "{form: ..., source: ..., codes: [...]}")
    tolerances: tuple[Tolerance, ...] = option(
        "departures from the standard that replies are allowed",
        "[{kind: two_byte_count, source: ..., why: ...}]",
        default=(),
    )
    notices: tuple[Notice, ...] = fact(
        "prohibitions, warnings, hazards, procedures", "[{kind: warning, text: ..., source: ...}]"
    )
    frames: tuple[Frame, ...] = fact(
        "the manual's example frames; `[]` where it has none", "[{id: ..., direction: request, mode: rtu, ...}]"
    )
    errata: tuple[Erratum, ...] = fact(
        "every misprint and contradiction", "[{about: [...], where: ..., printed: ..., used: ..., why: ..., ...}]"
    )
    absent: tuple[Absence, ...] = fact(
        "what the manual does not say", "[{what: ..., about: [...], matters: ..., find_out: ...}]"
    )

    def __hash__(self) -> int:
        """Of equal maps the same; that of every fact would take as long as what is kept by map."""
        return hash(self.prefix)

    @property
    def warning_codes(self) -> tuple[Fault, ...]:
        """The warnings that have codes."""
        return self.warnings.codes if self.warnings else ()

    @property
    def warned(self) -> tuple[int, ...]:
        """The register that holds the code of a warning, where there is one."""
        return (self.warnings.register,) if self.warnings else ()

    def kind_of(self, code: Fault) -> Literal["fault", "warning"]:
        """What a code is of."""
        return "warning" if any(one is code for one in self.warning_codes) else "fault"

    def registers(self) -> Iterator[tuple[Section, Register]]:
        """Every row of every section, in the manual's order."""
        for section in self.sections:
            for register in section.registers:
                yield section, register

    def row_at(self, address: int, use: Use = "r") -> tuple[Section, Register] | None:
        """The row that describes an address, with its section, or None; of two that share it, the one for this use."""
        firsts, rows = self._by_address[use]
        index = bisect_right(firsts, address) - 1
        found = rows[index] if index >= 0 else None
        return found if found is not None and address in found[1].address else None

    def adjusts(self, one: Setting) -> bool:
        """Whether a setting is a limit or a ramp that nothing needs: a PLC may write it."""
        unit = one.display.unit if one.display else None
        return one.needed is None and (unit in ("Hz", "s") or one.id == self.operation.lower_limit)

    def register_at(self, address: int, use: Use = "r") -> Register | None:
        """The row that describes an address, or None; of two that share it, the one for this use."""
        found = self.row_at(address, use)
        return found[1] if found is not None else None

    def is_read(self, row: Register) -> bool:
        """Whether what is read at a row's address is what the row says."""
        return self.register_at(row.address.first) is row

    def rows_in(self, span: Span) -> list[Register]:
        """The rows that describe any address of a span, by address."""
        firsts, rows = self._by_address["r"]
        low = max(bisect_right(firsts, span.first) - 1, 0)
        high = bisect_right(firsts, span.last)
        return [row for _, row in rows[low:high] if row.address.overlaps(span)]

    @cached_property
    def with_ram_bit(self) -> tuple[Span, ...]:
        """The registers to whose addresses `storage.add` may be added: an area, or what a section lets write."""
        areas = [area.addresses for area in self.areas if area.id == self.storage.area]
        rows = [(section, row) for section, row in self.registers() if section.id == self.storage.area]
        written = [row.address for section, row in rows if "w" in (row.access or section.access) and not row.unused]
        return () if self.storage.add is None else (*areas, *written)

    @cached_property
    def ram_only(self) -> tuple[Span, ...]:
        """The same registers at the addresses that write to RAM alone."""
        add = self.storage.add or 0
        return tuple(Span(span.first + add, span.last + add) for span in self.with_ram_bit)

    @cached_property
    def shared(self) -> frozenset[int]:
        """The addresses at which something else is read than written: each has a row for reads and one for writes."""
        return frozenset(address for _, row in self._twins["r"] for address in row.address)

    @cached_property
    def _twins(self) -> dict[Use, list[tuple[Section, Register]]]:
        """The rows of `shared`, by their use."""
        rows = sorted(self.registers(), key=lambda pair: pair[1].address)
        pairs = [two for two in pairwise(rows) if two[0][1].address == two[1][1].address]
        by_use = [{row.access or section.access: (section, row) for section, row in two} for two in pairs]
        return {use: [one[use] for one in by_use if one.keys() == {"r", "w"}] for use in USES}

    @cached_property
    def _by_address(self) -> dict[Use, tuple[list[int], list[tuple[Section, Register]]]]:
        rows = sorted(self.registers(), key=lambda pair: pair[1].address)
        hidden = {use: {id(row) for _, row in self._twins[use]} for use in USES}
        kept = {use: [pair for pair in rows if id(pair[1]) not in hidden["r" if use == "w" else "w"]] for use in hidden}
        return {use: ([row.address.first for _, row in some], some) for use, some in kept.items()}


Known = TypeVar("Known")


def kept(work: Callable[[Drive], Known]) -> Callable[[Drive], Known]:
    """Of each map worked out once, and kept as long as the map: many maps are built one after the other."""
    name = f"{work.__module__}.{work.__qualname__}"

    @wraps(work)
    def known(drive: Drive) -> Known:
        of = vars(drive)
        if name not in of:
            of[name] = work(drive)
        found: Known = of[name]
        return found

    return known
