"""The standard functions and function blocks of IEC 61131-3, second edition, clauses 2.5.1.5 and 2.5.2.3."""

from dataclasses import dataclass

from structured_text.language.tree import Block, Direction, Parameter
from structured_text.language.types import (
    ANY,
    ANY_BIT,
    ANY_COMPARABLE,
    ANY_ELEMENTARY,
    ANY_INT,
    ANY_MAGNITUDE,
    ANY_NUM,
    ANY_REAL,
    ANY_STRING,
    BOOL,
    DATE,
    DATE_AND_TIME,
    DINT,
    ELEMENTARY,
    INT,
    LINT,
    STRING,
    TIME,
    TIME_OF_DAY,
    UDINT,
    ULINT,
    UNTYPED_INTEGER,
    WSTRING,
    Kind,
    String,
    Type,
)

Group = frozenset[Kind]


@dataclass(frozen=True, slots=True)
class Signature:
    """A standard function. A formal whose type is "T" shares one type with all others of that kind, within `group`.

    `extensible`: the last formal may be repeated (IN1, IN2, IN3 ...). `result` "T" is the shared type;
    UNTYPED_INTEGER is any integer type that the context wants (LEN, FIND, TRUNC).
    """

    group: Group
    formals: tuple[tuple[str, Type | Group | str], ...]
    result: Type | str
    extensible: bool = False


_REAL_FUNCTIONS = ("SQRT", "LN", "LOG", "EXP", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN")


def _functions() -> dict[str, Signature]:
    one, two = (("IN", "T"),), (("IN1", "T"), ("IN2", "T"))
    table = {"ABS": Signature(ANY_NUM, one, "T"), "MOVE": Signature(ANY, one, "T"), "NOT": Signature(ANY_BIT, one, "T")}
    table |= {name: Signature(ANY_REAL, one, "T") for name in _REAL_FUNCTIONS}
    table |= {name: Signature(ANY_MAGNITUDE, two, "T", name == "ADD") for name in ("ADD", "SUB")}
    table |= {name: Signature(ANY_NUM, two, "T", name == "MUL") for name in ("MUL", "DIV")}
    table |= {"MOD": Signature(ANY_INT, two, "T"), "EXPT": Signature(ANY_REAL, (("IN1", "T"), ("IN2", ANY_NUM)), "T")}
    table |= {name: Signature(ANY_BIT, (("IN", "T"), ("N", ANY_INT)), "T") for name in ("SHL", "SHR", "ROL", "ROR")}
    table |= {name: Signature(ANY_BIT, two, "T", True) for name in ("AND", "OR", "XOR")}
    table |= {name: Signature(ANY_COMPARABLE, two, BOOL, True) for name in ("GT", "GE", "EQ", "LE", "LT")}
    table |= {"NE": Signature(ANY_COMPARABLE, two, BOOL)}
    table |= {name: Signature(ANY_ELEMENTARY, two, "T", True) for name in ("MAX", "MIN")}
    table |= {"LIMIT": Signature(ANY_ELEMENTARY, (("MN", "T"), ("IN", "T"), ("MX", "T")), "T")}
    table |= {"SEL": Signature(ANY, (("G", BOOL), ("IN0", "T"), ("IN1", "T")), "T")}
    table |= {"MUX": Signature(ANY, (("K", ANY_INT), ("IN0", "T"), ("IN1", "T")), "T", True)}
    return table


def _string_functions() -> dict[str, Signature]:
    text, number = ("IN", "T"), ANY_INT
    pair: tuple[tuple[str, Type | Group | str], ...] = (("IN1", "T"), ("IN2", "T"))
    return {
        "LEN": Signature(ANY_STRING, (text,), UNTYPED_INTEGER),
        "LEFT": Signature(ANY_STRING, (text, ("L", number)), "T"),
        "RIGHT": Signature(ANY_STRING, (text, ("L", number)), "T"),
        "MID": Signature(ANY_STRING, (text, ("L", number), ("P", number)), "T"),
        "CONCAT": Signature(ANY_STRING, pair, "T", True),
        "INSERT": Signature(ANY_STRING, (*pair, ("P", number)), "T"),
        "DELETE": Signature(ANY_STRING, (text, ("L", number), ("P", number)), "T"),
        "REPLACE": Signature(ANY_STRING, (*pair, ("L", number), ("P", number)), "T"),
        "FIND": Signature(ANY_STRING, pair, UNTYPED_INTEGER),
    }


def _time_functions() -> dict[str, Signature]:
    rows: list[tuple[str, Type, Type | Group, Type]] = [
        ("ADD_TIME", TIME, TIME, TIME),
        ("ADD_TOD_TIME", TIME_OF_DAY, TIME, TIME_OF_DAY),
        ("ADD_DT_TIME", DATE_AND_TIME, TIME, DATE_AND_TIME),
        ("SUB_TIME", TIME, TIME, TIME),
        ("SUB_DATE_DATE", DATE, DATE, TIME),
        ("SUB_TOD_TIME", TIME_OF_DAY, TIME, TIME_OF_DAY),
        ("SUB_TOD_TOD", TIME_OF_DAY, TIME_OF_DAY, TIME),
        ("SUB_DT_TIME", DATE_AND_TIME, TIME, DATE_AND_TIME),
        ("SUB_DT_DT", DATE_AND_TIME, DATE_AND_TIME, TIME),
        ("MULTIME", TIME, ANY_NUM, TIME),
        ("DIVTIME", TIME, ANY_NUM, TIME),
        ("CONCAT_DATE_TOD", DATE, TIME_OF_DAY, DATE_AND_TIME),
    ]
    return {name: Signature(ANY, (("IN1", left), ("IN2", right)), result) for name, left, right, result in rows}


# Every overloaded or time function by upper-case name; the conversions are distinguished by `conversion_of`.
FUNCTIONS: dict[str, Signature] = _functions() | _string_functions() | _time_functions()
_CONVERTIBLE: dict[str, Type] = {**ELEMENTARY, "STRING": STRING, "WSTRING": WSTRING}
_BCD_BITS = ("BYTE", "WORD", "DWORD", "LWORD")
_BCD_NUMBERS = ("USINT", "UINT", "UDINT", "ULINT")


@dataclass(frozen=True, slots=True)
class Conversion:
    """`family` CONVERT, TRUNC, BCD_TO or TO_BCD; `source` None for the third edition's `TO_INT(x)`."""

    family: str
    source: Type | None
    result: Type


def conversion_of(name: str) -> Conversion | None:
    """Read a name such as INT_TO_REAL, REAL_TRUNC_INT, WORD_BCD_TO_UINT, UINT_TO_BCD_WORD or TO_INT."""
    for middle, family in (("_BCD_TO_", "BCD_TO"), ("_TO_BCD_", "TO_BCD"), ("_TRUNC_", "TRUNC"), ("_TO_", "CONVERT")):
        left, found, right = name.partition(middle)
        if found:
            return _pair(family, left, right)
    result = _CONVERTIBLE.get(name.removeprefix("TO_"))
    return Conversion("CONVERT", None, result) if name.startswith("TO_") and result else None


def _pair(family: str, left: str, right: str) -> Conversion | None:
    """The conversion between two named types, if there is one."""
    source, result = _CONVERTIBLE.get(left), _CONVERTIBLE.get(right)
    if source is None or result is None:
        return None
    allowed = {
        "CONVERT": True,
        "TRUNC": source.kind is Kind.REAL and result.kind is Kind.INTEGER,
        "BCD_TO": left in _BCD_BITS and right in _BCD_NUMBERS,
        "TO_BCD": left in _BCD_NUMBERS and right in _BCD_BITS,
    }
    return Conversion(family, source, result) if allowed[family] else None


def default_string(wide: bool) -> String:
    """STRING or WSTRING without a length."""
    return WSTRING if wide else STRING


def _block(name: str, inputs: str, outputs: str, **types: Type) -> Block:
    """A standard block; parameters are BOOL unless `types` says more."""
    block = Block(name, Kind.BLOCK)
    for direction, names in ((Direction.INPUT, inputs), (Direction.OUTPUT, outputs)):
        for each in names.split():
            block.parameters[each] = Parameter(each, types.get(each, BOOL), direction)
    return block


def _blocks() -> dict[str, Block]:
    made = [
        _block("SR", "S1 R", "Q1"),
        _block("RS", "S R1", "Q1"),
        _block("SEMA", "CLAIM RELEASE", "BUSY"),
        _block("R_TRIG", "CLK", "Q"),
        _block("F_TRIG", "CLK", "Q"),
        _block("RTC", "IN PDT", "Q CDT", PDT=DATE_AND_TIME, CDT=DATE_AND_TIME),
    ]
    made += [_block(name, "IN PT", "Q ET", PT=TIME, ET=TIME) for name in ("TP", "TON", "TOF")]
    for suffix, count in (("", INT), ("_DINT", DINT), ("_LINT", LINT), ("_UDINT", UDINT), ("_ULINT", ULINT)):
        made.append(_block("CTU" + suffix, "CU R PV", "Q CV", PV=count, CV=count))
        made.append(_block("CTD" + suffix, "CD LD PV", "Q CV", PV=count, CV=count))
        made.append(_block("CTUD" + suffix, "CU CD R LD PV", "QU QD CV", PV=count, CV=count))
    return {each.name: each for each in made}


# Every standard function block by upper-case name.
BLOCKS: dict[str, Block] = _blocks()
