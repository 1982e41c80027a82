"""Rules about how literals are written."""

import re

from structured_text.language.lint_scope import Scope, literals_of
from structured_text.language.tree import Case, Literal, LiteralKind
from structured_text.language.types import BOOL, Elementary, Kind, Type, plain
from structured_text.language.walk import heads

# After these a digit or letter is taken into the escape by the C that matiec writes.
_HEX_ESCAPE = re.compile(r"\$[0-9A-Fa-f]{2}[0-9A-Za-z]")
_ESCAPED = re.compile(r"\$(?:[0-9A-Fa-f]{2}|.)")
# The range of normal IEEE singles.
_SMALLEST, _LARGEST = 1.17549435e-38, 3.4028235e38
_LONG_UNITS = re.compile(r"\d(us|ns)", re.IGNORECASE)


def pou(scope: Scope) -> None:
    """All rules about the literals of one POU."""
    labels = {
        id(each) for statement in scope.statements if isinstance(statement, Case) for each in heads(statement)[1:]
    }
    for each in scope.expressions:
        if isinstance(each, Literal):
            _literal(scope, each, id(each) in labels)
    for initial in scope.initials():
        for each in literals_of(initial):
            _literal(scope, each, False)


def _literal(scope: Scope, value: Literal, label: bool) -> None:
    """One literal."""
    if value.kind in (LiteralKind.STRING, LiteralKind.WSTRING):
        _string(scope, value)
    elif value.kind is LiteralKind.TIME:
        _time(scope, value)
    elif value.kind is LiteralKind.REAL or value.type.kind is Kind.REAL:
        _real(scope, value)
    elif value.kind is LiteralKind.INTEGER and not label:
        _integer(scope, value)
    elif value.kind is LiteralKind.BOOL and value.prefix:
        _bool(scope, value)
    if value.prefix and "#" in value.text and value.kind is not LiteralKind.STRING:
        _case(scope, value)


def _string(scope: Scope, value: Literal) -> None:
    """Strings."""
    if value.prefix is not None:
        scope.add(value.at, "typed-string", f"matiec refuses {value.prefix}# in front of a string: leave it out")
    if value.kind is LiteralKind.WSTRING:
        scope.add(value.at, "wide-string", "a string in double quotes is refused by matiec: use single ones")
        return
    if not value.text.isascii():
        text = "matiec refuses characters beyond ASCII in a string: write their bytes as $xx"
        scope.add(value.at, "string-encoding", text)
    if _loses_bytes(value.text):
        text = "matiec's C reads the digit or letter after $xx into the escape: escape it too ('$96$33')"
        scope.add(value.at, "string-escape", text)
    if "$L" in map(str.upper, _ESCAPED.findall(value.text)):
        scope.add(value.at, "string-escape", "matiec writes C that does not compile for $L: write $N or $0A")


def _loses_bytes(text: str) -> bool:
    """Whether a hexadecimal escape has a digit or letter after it."""
    here = 0
    while (found := _ESCAPED.search(text, here)) is not None:
        if _HEX_ESCAPE.match(text, found.start()):
            return True
        here = found.end()
    return False


def _time(scope: Scope, value: Literal) -> None:
    """Durations."""
    if _LONG_UNITS.search(value.text):
        scope.add(value.at, "time-literal", "us and ns are refused by matiec: write milliseconds, as T#3.5ms")


def _real(scope: Scope, value: Literal) -> None:
    """Reals."""
    if "." not in value.text and "#16" not in value.text:
        scope.add(value.at, "real-literal", f"matiec refuses a real without a point: write {_pointed(value.text)}")
    elif isinstance(value.value, float) and value.value and not _SMALLEST <= abs(value.value) <= _LARGEST:
        text = f"matiec refuses {value.text}, which is beyond the range of REAL, for an LREAL too"
        scope.add(value.at, "real-literal", text)


def _pointed(text: str) -> str:
    """`1E3` -> `1.0E3`."""
    found = re.search(r"[eE]", text.rsplit("#", 1)[-1])
    if not found:
        return text + ".0"
    place = text.rindex(found.group())
    return text[:place] + ".0" + text[place:]


def _integer(scope: Scope, value: Literal) -> None:
    made: Type = plain(value.type)
    if made is BOOL:
        _bool(scope, value)
    elif made.kind is Kind.BITS and value.prefix is None and isinstance(value.value, int):
        scope.add(
            value.at, "untyped-bit-literal", f"IronPLC refuses {value.text} as {made}: write {_bits(made, value.value)}"
        )
    elif made.kind is Kind.INTEGER and value.base != 10:
        scope.add(value.at, "based-integer", f"bits for a number: write {value.value!r} for {value.text}")


def _bits(made: Type, number: int) -> str:
    """How the canonical text writes a bit string."""
    width = made.width if isinstance(made, Elementary) else 16
    return f"{made.name}#16#{number:0{width // 4}X}"


def _bool(scope: Scope, value: Literal) -> None:
    wanted = "TRUE" if value.value else "FALSE"
    scope.add(value.at, "bool-literal", f"IronPLC refuses {value.text} for a BOOL: write {wanted}")


def _case(scope: Scope, value: Literal) -> None:
    """Prefixes and hexadecimal digits are upper case."""
    prefix, rest = value.text.split("#", 1)
    based = value.base == 16
    if prefix != prefix.upper() or (based and rest != rest.upper()):
        shown = prefix.upper() + "#" + (rest.upper() if based else rest)
        scope.add(value.at, "lower-case-literal", f"IronPLC refuses {value.text}: write {shown}")
