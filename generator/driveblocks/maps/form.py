"""The forms of a single value in a map: how it is written, what it means, what to say when it is not."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

_CJK = re.compile(r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef\U00020000-\U0003ffff]")


@dataclass(frozen=True, order=True)
class Span:
    """An inclusive range of numbers: addresses, or bits of a word."""

    first: int
    last: int

    def __iter__(self) -> Iterator[int]:
        return iter(self.first + each for each in range(len(self)))

    def __len__(self) -> int:
        """How many numbers the range holds; none when it runs backwards."""
        return max(0, self.last - self.first + 1)

    def __bool__(self) -> bool:
        """Whether the range holds a number at all: one that runs backwards does not."""
        return self.first <= self.last

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and self.first <= number <= self.last

    def overlaps(self, other: "Span") -> bool:
        return self.first <= other.last and other.first <= self.last


class Plate(str):
    """A pattern of the model numbers of nameplates: `x` is any letter or digit, `*` at its end any number of them.

    Hyphens, points, strokes, plus signs, brackets and blanks after letters and digits are no matter, and case is none.
    """

    def fits(self, number: str) -> bool:
        """Whether it is the pattern of a model number."""
        known = _bare(self).replace("x", "[A-Z0-9]").replace("*", "[A-Z0-9]*")
        return re.fullmatch(known, _bare(number.upper())) is not None

    def meets(self, other: "Plate") -> bool:
        """Whether a model number may fit both."""
        one, two = sorted((_bare(self), _bare(other)), key=len)
        for mine, its in zip(one, two, strict=False):
            if "*" in (mine, its):
                return True
            if mine != its and "x" not in (mine, its):
                return False
        return two[len(one) :] in ("", "*")


def _bare(number: str) -> str:
    return re.sub(r"(?<=[A-Z0-9x])[-./+() ]+", "", number)


@dataclass(frozen=True)
class Form:
    """One way to write a value: a full-match pattern, its parser, and the words for messages and for the schema."""

    name: str
    pattern: re.Pattern[str]
    parse: Callable[[str], Any]
    right: str
    numeric: bool = False
    """Whether an editor's YAML may read a match as a number, so that the schema must allow one."""


SPACES = {"holding": 0x00000, "coil": 0x20000, "discrete": 0x40000, "input": 0x60000}
"""The four tables of Modbus, each with addresses 0000H to FFFFH, and what is added to an address to tell them apart.

So every look-up by address knows the table, and none follows another. On the wire are the lowest 16 bits.
"""
TABLES = {"register": "", "bit": "", "coil": "coil ", "discrete": "discrete ", "input": "input "}
"""What a reference begins with that names a register, and what names the table before its address."""
_FEW = r"(?:(?:coil|discrete|input) )?"


def space_of(address: int) -> str:
    """The table of an address."""
    return next(name for name, start in SPACES.items() if start <= address <= start + 0xFFFF)


def is_bit(address: int) -> bool:
    """Whether an address is that of a coil or a discrete input, which holds one bit."""
    return space_of(address) in ("coil", "discrete")


def wire(address: int) -> int:
    """What is sent for an address."""
    return address & 0xFFFF


class Numbered(int):
    """An address to which the manual gives a number: the number of address 0 of its table, and how it is written."""

    first: int
    hexadecimal: bool

    def __new__(cls, address: int, first: int = 0, *, hexadecimal: bool = False) -> "Numbered":
        """Equal to the address in all but its text."""
        made = super().__new__(cls, address)
        made.first, made.hexadecimal = first, hexadecimal
        return made

    def __add__(self, count: int) -> "Numbered":
        """Another address of the same table."""
        return Numbered(int(self) + int(count), self.first, hexadecimal=self.hexadecimal)

    __radd__ = __add__

    def __sub__(self, other: int) -> int:
        """Another address of the same table, or how many lie between two."""
        return int(self) - int(other) if isinstance(other, Numbered) else self + -other

    @property
    def number(self) -> str:
        """What the manual writes."""
        number = wire(self) + self.first
        return f"{number:04X}H" if self.hexadecimal else str(number)


class Wired(str):
    """What the map says with the manual's numbers, in the words for addresses; and the number of address 0 there."""

    said: str
    first: int

    def __new__(cls, text: str, said: str = "", first: int = 0) -> "Wired":
        """Equal to the text with addresses."""
        made = super().__new__(cls, text)
        made.said, made.first = said, first
        return made


def said(reference: str) -> str:
    """A reference for a person: as the map has it, with what is sent beside it."""
    own = written(reference)
    return own if own == reference else f"{own} (wire {reference.rpartition(' ')[2]})"


def written(reference: str) -> str:
    """A reference as the map has it."""
    return reference.said if isinstance(reference, Wired) else reference


def wire_text(address: int) -> str:
    """Print what is sent for an address: 38 -> 0026H; of another table than the holding registers with its name."""
    if address <= 0xFFFF:
        return f"{address:04X}H"
    return f"{space_of(address)} {wire(address):04X}H"


def address_text(address: int, part: str = "") -> str:
    """Print an address, or a part of it, for a person: 0026H; or the manual's number, with what is sent beside it."""
    sent = wire_text(address)
    if not isinstance(address, Numbered):
        return sent + part
    table, space, number = sent.rpartition(" ")
    return f"{table}{space}{address.number}{part} (wire {number})"


def address_name(address: int) -> str:
    """An address as a part of an identifier: 0026H, Coil0001H."""
    table, _, number = wire_text(address).rpartition(" ")
    return f"{table.capitalize()}{number}"


def span_text(span: Span) -> str:
    """Print an address range as `address_text` does: 0106H-0125H, or one address."""
    if len(span) == 1:
        return address_text(span.first)
    last = wire_text(wire(span.last))
    if not isinstance(span.first, Numbered):
        return f"{wire_text(span.first)}-{last}"
    end = Numbered(span.last, span.first.first, hexadecimal=span.first.hexadecimal)
    return f"{address_text(span.first, f'-{end.number}')[:-1]}-{last})"


def bits_text(span: Span) -> str:
    """Print bits as a map does: 3, A, 8-F."""
    return f"{span.first:X}" if len(span) == 1 else f"{span.first:X}-{span.last:X}"


def masked_text(register: int, mask: int, value: int, is_: str = "=") -> str:
    """Print what the bits of a mask must be, or with `<>` must not be: 2100H AND 006FH = 0023H."""
    return f"{address_text(register)} AND {mask:04X}H {is_} {value:04X}H"


def _number(text: str) -> int:
    return int(text[:-1], 16) if text.endswith("H") else int(text)


def _address(text: str) -> int:
    space, _, number = text.rpartition(" ")
    address = SPACES[space or "holding"] + int(number[:-1], 16)
    return Numbered(address, text.first, hexadecimal=text.said.endswith("H")) if isinstance(text, Wired) else address


def _addresses(text: str) -> Span:
    first, _, last = text.partition("-")
    start = _address(Wired(first, text.said, text.first) if isinstance(text, Wired) else first)
    return Span(start, start + _address(last) - wire(start) if last else start)


def _span(text: str, digit: Callable[[str], int]) -> Span:
    first, _, last = text.partition("-")
    return Span(digit(first), digit(last or first))


def _ascii_or_hex(text: str) -> bytes:
    if not text.startswith(":"):
        return bytes.fromhex(text)
    body, *ends = text.split(" ")
    return body.encode("ascii") + b"".join({"CR": b"\r", "LF": b"\n"}[end] for end in ends)


def _form(name: str, pattern: str, parse: Callable[[str], Any], right: str, *, numeric: bool = False) -> Form:
    return Form(name, re.compile(pattern), parse, right, numeric)


TEXT = _form("text", r"(?s)\S(.*\S)?", str, "write a text of at least one character, with no space at either end")
ENGLISH = _form(
    "English text", r"(?s)\S(.*\S)?", str, "write it in English; the manual's own words go to `zh` or `wording`"
)
WORD = _form("word", r"[a-z][a-z0-9_]*", str, "write lower-case letters, digits and _, starting with a letter")
PREFIX = _form(
    "block prefix", r"[A-Z][A-Z0-9]{0,11}", str, "write 1 to 12 upper-case letters and digits, such as SN300G5"
)
ID = _form(
    "id",
    r"[^\s,]{1,24}(\.\.[^\s,]{1,24})?",
    str,
    "write the id as the manual prints it, such as H5-01, or a range A2-01..A2-32",
)
ADDRESS = _form(
    "address", _FEW + "[0-9A-F]{4}H", _address, "write four upper-case hexadecimal digits and H, such as 0026H"
)
ADDRESSES = _form(
    "address or range", _FEW + "[0-9A-F]{4}H(-[0-9A-F]{4}H)?", _addresses, "write 0026H, or a range 0106H-0125H"
)
BITS = _form(
    "bit or bits",
    r"[0-9A-F](-[0-9A-F])?",
    lambda t: _span(t, lambda d: int(d, 16)),
    "write one hexadecimal digit 0 to F, or a range 8-F",
    numeric=True,
)
NUMBER = _form(
    "number",
    r"0|-?[1-9][0-9]{0,9}|[0-9A-F]{2,8}H",
    _number,
    "write a decimal number such as 500, or hexadecimal such as 1EH",
    numeric=True,
)
CELL = _form(
    "printed cell",
    r"(?!.*[.;!?] )\S(.{0,46}\S)?",
    str,
    "write label and value as printed, 48 characters at most, no sentence",
)
COUNT = _form("count", r"[1-9][0-9]{0,5}", int, "write a decimal number from 1 to 999999", numeric=True)
WRITES = _form("number of writes", r"[1-9][0-9]{0,8}", int, "write a decimal number up to 999999999", numeric=True)
DECIMAL = _form(
    "decimal", r"-?(0|[1-9][0-9]{0,8})(\.[0-9]{1,9})?", Decimal, "write a decimal number such as 0.1", numeric=True
)
BYTES = _form(
    "row of bytes", r"[0-9A-F]{2}( [0-9A-F]{2})*", bytes.fromhex, "write bytes as upper-case pairs: 01 03 00 26"
)
ADU = _form(
    "frame",
    r"[0-9A-F]{2}( [0-9A-F]{2})*|:[0-9A-F]*( CR)?( LF)?",
    _ascii_or_hex,
    "write RTU bytes as 01 03 00 26, or ASCII characters as :0103 with CR LF named at the end",
)
REGISTER_WORD = _form(
    "PLC register",
    r"[0-9A-F]{2}([0-9A-F]{2}|--)?",
    str,
    "write 3A30, 0A-- for an empty low byte, or 01 for 8-bit mode",
    numeric=True,
)
REFERENCE = _form(
    "reference",
    r"[a-z_]+( \S+)?",
    lambda said: said,
    "write what the entry is about, such as `register 0220H` or `bit 0015H.7`",
)
PLATE = _form(
    "pattern of model numbers",
    r"[A-Z0-9](?:[-./ ]?[A-Z0-9]){2}(?:[-./ ]?[A-Z0-9x])*[-./]?\*?",
    Plate,
    "write it as on the nameplate, with three letters or digits at least, then `x` for any one and `*` at the end for "
    "all others, such as 22F-*",
)
ID_FORM = _form(
    "id form",
    r"[Aa9X\-.]+",
    str,
    "write A for a letter, a for a small one, 9 for a digit, X for A or 9: A9-99 is the form of H5-01",
)
SYMBOL = _form("symbol", r"[A-Z][A-Za-z0-9]{0,30}", str, "write an identifier such as InputTerminals, without _")
PLC_DEVICE = _form("PLC register name", r"[A-Z]+[0-9]+", str, "write the first register, such as D0")


def holds_chinese(text: str) -> bool:
    """Whether a text has Chinese characters or full-width punctuation."""
    return _CJK.search(text) is not None
