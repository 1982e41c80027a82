"""Literals without prefix, and whether a value may be used where a type is wanted."""

import sys

from structured_text.language import tree
from structured_text.language.library import fold
from structured_text.language.report import Report
from structured_text.language.standard import FUNCTIONS
from structured_text.language.types import (
    ANY_BIT,
    DINT,
    INT,
    LINT,
    LREAL,
    REAL,
    ULINT,
    UNKNOWN,
    UNTYPED_INTEGER,
    UNTYPED_REAL,
    WORD,
    Elementary,
    Kind,
    Subrange,
    Type,
    conversion,
    convertible,
    plain,
    same,
    untyped,
)
from structured_text.language.walk import children, expressions

_LITERAL_KINDS = frozenset([Kind.INTEGER, Kind.BITS, Kind.REAL, Kind.BOOL])
# The largest value that rounds to a finite IEEE single, and the largest double.
_LARGEST_REAL = 3.4028235677973366e38
_LARGEST_LREAL = sys.float_info.max
# How many bits a positive number has in an INT, which is the least type that holds one, and in a SINT.
_BITS_OF_INT = 15
BITS_OF_SINT = 7


def fits(report: Report, value: tree.Expression, wanted: Type, rule: str = "type-mismatch") -> None:
    """Report a `value` of a known type that may not be used where `wanted` is; settle numbers without prefix."""
    have = value.type
    if untyped(have):
        settle(report, value, wanted)
    elif not same(wanted, have):
        mismatch(report, value, wanted, rule)
    elif isinstance(wanted, Subrange) and isinstance(value, tree.Literal):
        within(report, value, wanted)


def mismatch(report: Report, value: tree.Expression, wanted: Type, rule: str = "type-mismatch") -> None:
    """Report a value of another type, and how to convert it."""
    have = value.type
    if UNKNOWN in (have, wanted) or Kind.POINTER in (have.kind, wanted.kind):
        return
    if convertible(have, wanted):
        text = f"expected {plain(wanted)}, found {have}: write {conversion(have, wanted)}(...)"
        report.add(value.at, "implicit-conversion", text)
    elif isinstance(wanted, tree.Array) and isinstance(have, tree.Array) and wanted.bounds == have.bounds:
        text = f"expected {wanted}, found another type of the same shape, {have}: declare both by one TYPE"
        report.add(value.at, rule, text)
    else:
        report.add(value.at, rule, f"expected {wanted}, found {have}")


def settle(report: Report, value: tree.Expression, wanted: Type) -> None:
    """Give an expression of numbers without prefix the type `wanted`."""
    if wanted is UNKNOWN or wanted.kind is Kind.POINTER or not untyped(value.type):
        if untyped(value.type):
            settle(report, value, default(value))
        return
    if _misfit(value, wanted) is not None:
        _unsuitable(report, value, wanted)
        return
    push(report, value, wanted)


def choose(report: Report, value: tree.Expression, wanted: Type | None = None, bits: int = _BITS_OF_INT) -> None:
    """Settle a number without prefix that is used where any number may be; what is computed is marked as open."""
    leave_open(value, bits)
    settle(report, value, wanted or default(value))


def _unsuitable(report: Report, value: tree.Expression, wanted: Type) -> None:
    """Report a number without prefix that cannot be of the wanted type; it gets the type it has by default."""
    culprit = _misfit(value, wanted) or value
    if wanted.kind is Kind.REAL and isinstance(culprit, tree.Literal):
        text = f"expected {wanted}, found the integer {culprit.text}: write {culprit.text}.0"
        report.add(culprit.at, "integer-for-real", text)
    elif isinstance(culprit, tree.Call) and _gives_bits(culprit) and convertible(WORD, wanted):
        name = culprit.target.name if isinstance(culprit.target, tree.Builtin) else ""
        text = f"expected {wanted}, found the bit string of {name}: write {conversion(WORD, wanted)}({name}(...))"
        report.add(culprit.at, "implicit-conversion", text)
    else:
        report.add(culprit.at, "type-mismatch", f"expected {wanted}, found {culprit.type}")
    push(report, value, default(value))


def _misfit(value: tree.Expression, wanted: Type) -> tree.Expression | None:
    """The part of a number without prefix that cannot be of this type."""
    if wanted.kind not in _LITERAL_KINDS or (value.type is UNTYPED_REAL) != (wanted.kind is Kind.REAL):
        return value
    if isinstance(value, tree.Literal):
        return value if wanted.kind is Kind.BOOL and value.value not in (0, 1) else None
    if isinstance(value, tree.Call):
        if not _call_takes(value, wanted):
            return value
    elif not isinstance(value, tree.Binary | tree.Unary) or wanted.kind in (Kind.BITS, Kind.BOOL):
        return value
    parts = (each for each in _alike(value) if untyped(each.type))
    return next((found for each in parts if (found := _misfit(each, wanted)) is not None), None)


def _call_takes(value: tree.Call, wanted: Type) -> bool:
    """Whether an overloaded call of numbers without prefix can give this type; LEN, FIND, TRUNC give integers."""
    if not isinstance(value.target, tree.Builtin) or wanted.kind is Kind.BOOL:
        return False
    signature = FUNCTIONS.get(value.target.family)
    if signature is None or signature.result is UNTYPED_INTEGER:
        return wanted.kind is Kind.INTEGER
    return wanted.kind in signature.group


def push(report: Report, value: tree.Expression, wanted: Type) -> None:
    """Set the type of every part that has none."""
    if not untyped(value.type):
        return
    value.type = plain(wanted)
    if isinstance(value, tree.Literal):
        within(report, value, wanted)
    elif isinstance(value, tree.Unary):
        push(report, value.operand, plain(wanted))
    elif isinstance(value, tree.Binary):
        value.operand_type = plain(wanted)
        push(report, value.left, plain(wanted))
        push(report, value.right, plain(wanted))
        _computed(report, value, plain(wanted))
    elif isinstance(value, tree.Call) and isinstance(value.target, tree.Builtin):
        _push_call(report, value, value.target, plain(wanted))


def _computed(report: Report, value: tree.Binary, wanted: Type) -> None:
    """Report literals that amount to more than the range of their type."""
    found = fold(value, lambda _: None)
    if found is not None and isinstance(wanted, Elementary) and not wanted.low <= found <= wanted.high:
        text = f"expected a value of {wanted.name}, {wanted.low}..{wanted.high}, found {found}"
        report.add(value.at, "literal-range", text)


def _push_call(report: Report, value: tree.Call, target: tree.Builtin, wanted: Type) -> None:
    """Set the type of an overloaded call whose arguments are numbers without prefix, or of LEN, FIND and TRUNC."""
    parameters = tuple(
        tree.Parameter(each.name, wanted, each.direction) if untyped(each.type) else each for each in target.parameters
    )
    value.target = tree.Builtin(target.name, target.family, parameters, wanted)
    for binding, parameter in zip(value.bindings, parameters, strict=True):
        binding.parameter = parameter
        if binding.value is not None:
            push(report, binding.value, parameter.type)


def within(report: Report, value: tree.Literal, wanted: Type) -> None:
    """Report a literal beyond the range of its type; make its Python value fit the type."""
    if not isinstance(wanted, Elementary) or isinstance(value.value, bytes | str):
        return
    if wanted.kind is Kind.REAL:
        _real(report, value, wanted)
    elif wanted.kind is Kind.BOOL:
        value.value = bool(value.value)
    elif wanted.kind in (Kind.INTEGER, Kind.BITS):
        low, high = (wanted.first, wanted.last) if isinstance(wanted, Subrange) else (wanted.low, wanted.high)
        if not low <= value.value <= high:
            shown = value.text if len(value.text) <= 40 else value.text[:37] + "..."
            text = f"expected a value of {wanted.name}, {low}..{high}, found {shown}"
            report.add(value.at, "literal-range", text)


def _real(report: Report, value: tree.Literal, wanted: Elementary) -> None:
    """Make a number a float; report one beyond the range."""
    number = value.value
    if isinstance(number, bytes | str):
        return
    limit = _LARGEST_REAL if wanted.width == 32 else _LARGEST_LREAL
    if not -limit <= number <= limit:
        report.add(value.at, "literal-range", f"expected a value of {wanted.name}, found {value.text[:40]}")
        number = 0.0
    value.value = float(number)


def default(value: tree.Expression) -> Type:
    """The type of a number whose context gives none: the smallest of INT, DINT, LINT, ULINT that holds it; REAL."""
    if value.type is UNTYPED_REAL:
        return LREAL if isinstance(value, tree.Literal) and abs(float(value.value)) > _LARGEST_REAL else REAL
    if isinstance(value, tree.Call) and _gives_bits(value):
        return WORD
    if not isinstance(value, tree.Literal) or not isinstance(value.value, int):
        return INT
    return next((each for each in (INT, DINT, LINT) if each.low <= value.value <= each.high), ULINT)


def leave_open(value: tree.Expression, bits: int = _BITS_OF_INT) -> None:
    """Mark the calls without a type, and what is computed from them: compilers choose their types as they like.

    matiec takes ULINT or LINT, but SINT for an argument of a standard function, where `bits` is 7.
    """
    if not untyped(value.type) or not any(isinstance(each, tree.Call) for each in expressions(value)):
        return
    if isinstance(value, tree.Unary | tree.Binary | tree.Call):
        value.open = bits
    for each in children(value):
        leave_open(each, bits)


def _alike(value: tree.Expression) -> list[tree.Expression]:
    """The parts of an operation or call that have its type if they have none of their own."""
    if isinstance(value, tree.Call):
        return [each.value for each in value.bindings if each.value is not None]
    return list(children(value))


def _gives_bits(value: tree.Call) -> bool:
    """Whether a call gives a bit string and never a number: SHL, AND and their kind."""
    signature = FUNCTIONS.get(value.target.family) if isinstance(value.target, tree.Builtin) else None
    return signature is not None and signature.group == ANY_BIT


def untyped_of(kind: tree.LiteralKind) -> Type:
    """The type of a number without prefix before its context is known."""
    return UNTYPED_REAL if kind is tree.LiteralKind.REAL else UNTYPED_INTEGER
