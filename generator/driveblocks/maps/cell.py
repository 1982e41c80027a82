"""What a cell of a register table says; None, or nothing, where it says it in no way that is understood."""

import re
from decimal import Decimal
from typing import Literal, NamedTuple, get_args

from driveblocks.maps.model import Space, Unit

ADDRESSES = ("hex", "decimal", "4xxxx")
Way = Literal["multiply", "divide"]
Order = Literal["high", "low"]
"""Which word of a value of 32 bits comes first."""
NOTHING = ("", "-", "/", "n/a")

_MARKED = re.compile(r"(?:0x|16#|h')([0-9a-f]{1,4})'?|([0-9a-f]{1,4})h", re.IGNORECASE)
"""What only a hexadecimal number is, whatever stands beside it."""
_ACCESS = {
    "r": "r", "ro": "r", "r/-": "r", "read": "r", "read only": "r", "w": "w", "wo": "w", "write": "w",
    "write only": "w", "rw": "rw", "wr": "rw", "r/w": "rw", "w/r": "rw", "read/write": "rw", "只读": "r", "读": "r",
    "写": "w", "读写": "rw",
}  # fmt: skip
_UNITS = {each.lower(): each for each in get_args(Unit)} | {
    "rpm": "r/min", "1/min": "r/min", "ohm": "Ohm", "℃": "°C", "deg c": "°C", "sec": "s"
}  # fmt: skip
_TABLES: dict[Space, str] = {
    "coil": r"coils?( status| registers?)?|0x",
    "discrete": r"discretes?( inputs?| registers?)?|input (status|bits?)|1x",
    "input": r"input registers?|inputs?|i|ir|3x",
    "holding": r"holding( registers?)?|h|hr|4x",
}
_BEFORE = re.compile("([0-9]+|modbus|read|write|single|multiple) ")
"""What stands before the name of a table and changes nothing."""
_CODES: dict[Space, tuple[int, ...]] = {
    "coil": (1, 5, 15), "discrete": (2,), "input": (4,), "holding": (3, 6, 10, 16, 23),
}  # fmt: skip
"""Functions, of which no list of decimal numbers has 10: there it is 10H."""
_REGIONS: dict[str, Space] = {"0": "coil", "1": "discrete", "3": "input", "4": "holding"}
_WIDTHS = {
    **dict.fromkeys(("1", "16bit", "u16", "ui16", "uint16", "uint16t", "ushort", "word", "uword"), (1, False)),
    **dict.fromkeys(("s16", "i16", "int16", "int16t", "sint16", "short16", "sword"), (1, True)),
    **dict.fromkeys(("2", "32bit", "u32", "ui32", "uint32", "uint32t", "udint", "dword", "udword"), (2, False)),
    **dict.fromkeys(("s32", "i32", "int32", "int32t", "sint32", "dint", "sdword"), (2, True)),
}
"""What values are called -> their registers, and whether they have a sign."""
_TO = re.compile(" ?[-–~] ?")
_TWICE = re.compile(r"([^()]+?) ?\(([^()]+)\)")
"""An address in two ways: 0x0026 (38)."""
_SIX = re.compile("[134][0-9]{5}", re.ASCII)
"""A number of a register that can be nothing else: an address has at most five digits."""
_FACTOR = re.compile(r"([x×*/÷]?) ?([0-9]{1,9}(?:[.,][0-9]{1,9})?)(?: ?/ ?([0-9]{1,9}))? ?([^0-9].*)?")


def marked(said: str) -> bool:
    """Whether a number, or one of several, is hexadecimal by a mark or by a letter."""
    each = (one for one in re.split("[-–~() ]+", said) if one)
    return any(_MARKED.fullmatch(one) or re.fullmatch("[0-9]*[a-f][0-9a-f]*", one, re.IGNORECASE) for one in each)


def plain(said: str) -> bool:
    """Whether a cell has decimal digits alone, as one address or as a first and a last."""
    return all(one.isascii() and one.isdigit() for one in _TO.split(said))


def numbers(said: str) -> bool:
    """Whether a cell has numbers of registers, of six digits, that name their table."""
    return all(_SIX.fullmatch(one) for one in _TO.split(said))


class Place(NamedTuple):
    """Where a value is: its first register, how many it has, and its table where the number names that."""

    first: int
    words: int
    space: Space | None


def place(said: str, form: str) -> Place | None:
    """One register, or two that follow each other; None for any other, and for two ways that do not agree."""
    twice = _TWICE.fullmatch(said)
    if twice is None:
        return _span(said, form)
    ways = [("hex",) if marked(one) else ("decimal", "4xxxx") for one in twice.groups()]
    one, two = ([_span(each, way) for way in some] for each, some in zip(twice.groups(), ways, strict=True))
    agreed = [(a, b) for a in one for b in two if a and b and a[:2] == b[:2] and ways[0] != ways[1]]
    return next((a._replace(space=a.space or b.space) for a, b in agreed), None)


def _span(said: str, form: str) -> Place | None:
    ends = [address(one, form) for one in _TO.split(said)]
    if len(ends) > 2 or not all(ends):
        return None
    (first, space), (last, other) = ends[0] or (0, None), ends[-1] or (0, None)
    return Place(first, len(ends), space) if (last - first, other) == (len(ends) - 1, space) else None


def address(said: str, form: str) -> tuple[int, Space | None] | None:
    """A wire address, and its table where numbers such as 40001 name that; those count from 1."""
    if form == "4xxxx":
        match = re.fullmatch("([0134])([0-9]{4,5})", said, re.ASCII)
        return (int(match[2]) - 1, _REGIONS[match[1]]) if match and 1 <= int(match[2]) <= 0x10000 else None
    match = _MARKED.fullmatch(said) or (re.fullmatch("([0-9a-f]{1,4})", said, re.IGNORECASE) if form == "hex" else None)
    if match:
        return int(match[1] or match[2], 16), None
    plain = form == "decimal" and re.fullmatch("[0-9]{1,5}", said, re.ASCII) and int(said) <= 0xFFFF
    return (int(said), None) if plain else None


def space(said: str, codes: bool = False) -> Space | None:
    """The table of Modbus, by its name, or by the `codes` of the functions that read and write it."""
    words = re.findall("[a-z0-9]+", said.lower())
    bare = _BEFORE.sub("", " ".join(words))
    found = {each for each, pattern in _TABLES.items() if re.fullmatch(pattern, bare)}
    if codes and words and not found:
        found = {each for each, numbers in _CODES.items() if set(map(_code, words)) <= set(numbers)}
    return found.pop() if len(found) == 1 else None


def names_table(said: str) -> bool:
    """Whether a cell in any place speaks of a table of Modbus."""
    return bool(space(said) and re.search("coil|discrete|holding|register|^[0134]x$", said.lower()))


def _code(word: str) -> int:
    """The number of a function; 0 where a word is none."""
    if re.fullmatch("[0-9]{1,2}", word):
        return int(word)
    match = re.fullmatch("0x([0-9a-f]{1,2})|([0-9a-f]{1,2})h?", word)
    return int(match[1] or match[2], 16) if match else 0


def width(said: str) -> tuple[int, bool] | None:
    """How many registers a value has and whether it has a sign, by its type or its size; None: it is something else."""
    return _WIDTHS.get("".join(re.findall(r"[a-z0-9]+", said.lower())))


def access(said: str) -> str | None:
    """How a register may be used: r, w or rw."""
    return _ACCESS.get(said.lower())


def unit(said: str) -> Unit | None:
    """A unit of a map; of a single letter the case counts: H is no hour."""
    found = _UNITS.get(said.lower())
    return found if len(said) > 1 or found == said else None


def named(said: str) -> tuple[str, str]:
    """A name without the unit in brackets at its end, and the unit: Output frequency (Hz)."""
    match = re.fullmatch(r"(.*\S) *[(\[]([^()\[\]]+)[)\]]", said)
    return (match[1], match[2]) if match and unit(match[2]) else (said, "")


class Factor(NamedTuple):
    """A number, its unit, and its direction where a fraction or a stroke shows it; x10 may be meant for writing."""

    number: Decimal
    way: Way | None
    unit: str

    def per_count(self, way: Way | None) -> Decimal | None:
        """Units per count, as its own marks say, else as `way` does; None: it may be meant either way."""
        way = self.way or way or ("multiply" if self.number <= 1 else None)
        if way is None:
            return None
        return 1 / self.number if way == "divide" else self.number


def factor(said: str) -> Factor | None:
    """0.01, 0,01, 1/100, x0.01, /100 and `0.01 Hz`; None too for 1,000 and 1.000, which some write for a thousand."""
    match = _FACTOR.fullmatch(said)
    if match is None or re.fullmatch("[1-9][0-9]*[.,][0-9]{3}", match[2]) or not int(match[3] or 1):
        return None
    number = Decimal(match[2].replace(",", ".")) / int(match[3] or 1)
    way: Way | None = "multiply" if match[3] and number < 1 else None
    if match[1] in ("/", "÷"):
        way = "divide"
    return Factor(number, way, match[4] or "")
