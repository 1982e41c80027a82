"""The elementary data types of IEC 61131-3, second edition (table 10 and clause 2.3), with their sizes.

Types are compared by identity: one elementary type is one object (`INT is ELEMENTARY["INT"]`), one `TYPE` declaration
makes one object, and an alias (`TYPE A : INT; END_TYPE`) is the very type that it names. Only strings of different
lengths are equal through `same`.
"""

from dataclasses import dataclass, field
from enum import Enum

# The length of a STRING without `[n]`. The standard lets the implementation choose; 126 is what matiec's runtime has.
DEFAULT_STRING_LENGTH = 126
# An enumeration is held in an INT; the standard leaves it to the implementation.
ENUM_BITS = 16


class Kind(Enum):
    """What a type is made of."""

    BOOL = "bool"
    BITS = "bits"
    INTEGER = "integer"
    REAL = "real"
    TIME = "time"
    DATE = "date"
    TIME_OF_DAY = "time of day"
    DATE_AND_TIME = "date and time"
    STRING = "string"
    ENUM = "enum"
    ARRAY = "array"
    STRUCT = "struct"
    BLOCK = "block"
    POINTER = "pointer"
    NONE = "none"


@dataclass(slots=True, eq=False)
class Type:
    """Any type. `name` is as declared (elementary: upper case; anonymous: as it would be written)."""

    name: str
    kind: Kind

    @property
    def size(self) -> int:
        """Bytes, as the sum of the IEC widths (a BOOL counts 1), without alignment."""
        return 0

    def __str__(self) -> str:
        """Print as a person would write the type."""
        return self.name


def least(width: int, *, signed: bool) -> int:
    return -(1 << (width - 1)) if signed else 0


def greatest(width: int, *, signed: bool) -> int:
    """The greatest."""
    return (1 << (width - signed)) - 1


@dataclass(slots=True, eq=False)
class Elementary(Type):
    """A type of table 10. `width` in bits; `signed` for SINT INT DINT LINT and the reals."""

    width: int
    signed: bool = False

    @property
    def size(self) -> int:
        """Bytes; a BOOL takes one."""
        return max(self.width // 8, 1)

    @property
    def low(self) -> int:
        return least(self.width, signed=self.signed)

    @property
    def high(self) -> int:
        return greatest(self.width, signed=self.signed)


@dataclass(slots=True, eq=False)
class Subrange(Elementary):
    """`INT(0..9)`: behaves as `base` in every expression; assignments outside `first..last` are errors."""

    base: Elementary = field(kw_only=True)
    first: int = field(kw_only=True)
    last: int = field(kw_only=True)


@dataclass(slots=True, eq=False)
class String(Type):
    """STRING or WSTRING (`wide`) of at most `length` characters."""

    length: int = DEFAULT_STRING_LENGTH
    wide: bool = False

    @property
    def size(self) -> int:
        """Bytes of the text and its terminator."""
        return (self.length + 1) * (2 if self.wide else 1)


@dataclass(slots=True, eq=False)
class Pointer(Type):
    """POINTER TO, REF_TO or REFERENCE TO: parsed so that it can be named, never run."""

    target: Type


def _table() -> dict[str, Elementary]:
    rows = [("BOOL", Kind.BOOL, 1, False)]
    rows += [(name, Kind.BITS, width, False) for name, width in (("BYTE", 8), ("WORD", 16), ("DWORD", 32))]
    rows += [("LWORD", Kind.BITS, 64, False)]
    for name, width in (("SINT", 8), ("INT", 16), ("DINT", 32), ("LINT", 64)):
        rows += [(name, Kind.INTEGER, width, True), ("U" + name, Kind.INTEGER, width, False)]
    rows += [("REAL", Kind.REAL, 32, True), ("LREAL", Kind.REAL, 64, True), ("TIME", Kind.TIME, 64, True)]
    rows += [("DATE", Kind.DATE, 64, False), ("TIME_OF_DAY", Kind.TIME_OF_DAY, 64, False)]
    rows += [("DATE_AND_TIME", Kind.DATE_AND_TIME, 64, False)]
    return {name: Elementary(name, kind, width, signed) for name, kind, width, signed in rows}


# Every elementary type by upper-case name, TOD and DT included.
ELEMENTARY: dict[str, Elementary] = _table()
ELEMENTARY["TOD"] = ELEMENTARY["TIME_OF_DAY"]
ELEMENTARY["DT"] = ELEMENTARY["DATE_AND_TIME"]

BOOL, BYTE, WORD, DWORD, LWORD = (ELEMENTARY[name] for name in ("BOOL", "BYTE", "WORD", "DWORD", "LWORD"))
SINT, INT, DINT, LINT = (ELEMENTARY[name] for name in ("SINT", "INT", "DINT", "LINT"))
USINT, UINT, UDINT, ULINT = (ELEMENTARY[name] for name in ("USINT", "UINT", "UDINT", "ULINT"))
REAL, LREAL, TIME = (ELEMENTARY[name] for name in ("REAL", "LREAL", "TIME"))
DATE, TIME_OF_DAY, DATE_AND_TIME = (ELEMENTARY[name] for name in ("DATE", "TIME_OF_DAY", "DATE_AND_TIME"))
STRING = String("STRING", Kind.STRING)
WSTRING = String("WSTRING", Kind.STRING, wide=True)

# What an expression has before the checker has been there, and after it could not be resolved.
UNKNOWN = Type("?", Kind.NONE)
# What a function without result returns (third edition).
VOID = Type("VOID", Kind.NONE)


def plain(each: Type) -> Type:
    """The type that a value of `each` has in an expression: a subrange counts as its base."""
    return each.base if isinstance(each, Subrange) else each


def same(left: Type, right: Type) -> bool:
    """Whether a value of `right` may be used where `left` is wanted, without any conversion.

    Arrays are the same by their declaration only, as on matiec: two that are written out alike are two types.
    """
    left, right = plain(left), plain(right)
    if left is right or UNKNOWN in (left, right):
        return True
    if isinstance(left, String) and isinstance(right, String):
        return left.wide == right.wide
    return False


# What a number without prefix has until its context gives it a type; never left over by a check without errors.
UNTYPED_INTEGER = Type("an integer literal", Kind.NONE)
UNTYPED_REAL = Type("a real literal", Kind.NONE)
_ELEMENTARY_KINDS = frozenset(
    [Kind.BOOL, Kind.BITS, Kind.INTEGER, Kind.REAL, Kind.TIME, Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME]
)
# The generic types of table 11, as the kinds that they cover.
ANY_INT = frozenset([Kind.INTEGER])
ANY_REAL = frozenset([Kind.REAL])
ANY_NUM = ANY_INT | ANY_REAL
ANY_MAGNITUDE = ANY_NUM | {Kind.TIME}
ANY_BIT = frozenset([Kind.BOOL, Kind.BITS])
ANY_STRING = frozenset([Kind.STRING])
ANY_ELEMENTARY = _ELEMENTARY_KINDS | ANY_STRING
ANY_COMPARABLE = ANY_ELEMENTARY | {Kind.ENUM}
ANY = ANY_COMPARABLE | {Kind.ARRAY, Kind.STRUCT}
# Durations and moments: what is counted in nanoseconds.
TEMPORAL = frozenset([Kind.TIME, Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME])


def untyped(each: Type) -> bool:
    """Whether a type is that of a number without prefix."""
    return each is UNTYPED_INTEGER or each is UNTYPED_REAL


def convertible(source: Type, wanted: Type) -> bool:
    """Whether `SOURCE_TO_WANTED` exists and people expect it to happen by itself: between numbers and bit strings."""
    numeric = (Kind.BITS, Kind.INTEGER, Kind.REAL)
    return plain(source) is not plain(wanted) and source.kind in numeric and wanted.kind in numeric


def conversion(source: Type, wanted: Type) -> str:
    """The name of the function that converts: INT_TO_REAL."""
    return f"{plain(source).name}_TO_{plain(wanted).name}"
