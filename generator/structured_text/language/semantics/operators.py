"""The types of operators (clause 3.3.1, tables 24 to 30): operands of one type, nothing converted by itself."""

from structured_text.language.semantics.scope import Scope, infer
from structured_text.language.semantics.values import choose, default, fits, leave_open, settle
from structured_text.language.tree import Binary, Expression, Literal, Unary
from structured_text.language.types import (
    ANY_BIT,
    ANY_COMPARABLE,
    ANY_INT,
    ANY_NUM,
    BOOL,
    DATE,
    DATE_AND_TIME,
    REAL,
    TEMPORAL,
    TIME,
    TIME_OF_DAY,
    UNKNOWN,
    UNTYPED_INTEGER,
    UNTYPED_REAL,
    Elementary,
    Kind,
    Type,
    plain,
    same,
    untyped,
)

_COMPARISONS = frozenset(["=", "<>", "<", ">", "<=", ">="])
_KINDS_OF = {"AND": ANY_BIT, "OR": ANY_BIT, "XOR": ANY_BIT, "MOD": ANY_INT}
# What + and - make of moments and durations (table 30).
_TIMES: dict[tuple[str, Type, Type], Type] = {
    ("+", TIME, TIME): TIME, ("-", TIME, TIME): TIME, ("+", TIME_OF_DAY, TIME): TIME_OF_DAY,
    ("-", TIME_OF_DAY, TIME): TIME_OF_DAY, ("-", TIME_OF_DAY, TIME_OF_DAY): TIME,
    ("+", DATE_AND_TIME, TIME): DATE_AND_TIME, ("-", DATE_AND_TIME, TIME): DATE_AND_TIME,
    ("-", DATE_AND_TIME, DATE_AND_TIME): TIME, ("-", DATE, DATE): TIME,
}  # fmt: skip


def unary(scope: Scope, value: Unary) -> Type:
    """`-x`, `+x`, `NOT x`."""
    inner = infer(scope, value.operand)
    if value.op == "NOT":
        if untyped(inner):
            settle(scope.report, value.operand, default(value.operand))
            inner = value.operand.type
        return _operand(scope, value.operand, ANY_BIT, "NOT", inner)
    if untyped(inner):
        return inner
    if value.op == "-" and isinstance(inner, Elementary) and inner.kind is Kind.INTEGER and not inner.signed:
        scope.report.add(value.at, "type-mismatch", f"expected a signed number after -, found {inner}")
        return UNKNOWN
    return _operand(scope, value.operand, ANY_NUM | {Kind.TIME}, value.op, inner)


def _operand(scope: Scope, value: Expression, kinds: frozenset[Kind], op: str, have: Type) -> Type:
    """Report an operator that cannot take this type; the type of its result."""
    if have is UNKNOWN or have.kind in kinds:
        return plain(have)
    if have.kind is Kind.POINTER:
        return UNKNOWN
    if have.kind is Kind.BITS and Kind.INTEGER in kinds:
        name = plain(have).name
        text = f"expected a number for {op}, found {have}: write {name}_TO_U{'S' if name == 'BYTE' else ''}INT(...)"
        scope.report.add(value.at, "bit-string-arithmetic", text)
    elif have.kind is Kind.INTEGER and Kind.BITS in kinds:
        text = f"expected a bit string for {op}, found {have}: write {conversion_to_bits(have)}(...)"
        scope.report.add(value.at, "implicit-conversion", text)
    else:
        number = "an integer" if kinds == ANY_INT else "a number"
        shown = "a bit string" if Kind.BITS in kinds else number if Kind.INTEGER in kinds else "another type"
        scope.report.add(value.at, "type-mismatch", f"expected {shown} for {op}, found {have}")
    return UNKNOWN


def binary(scope: Scope, value: Binary) -> Type:
    left, right = infer(scope, value.left), infer(scope, value.right)
    if UNKNOWN in (left, right):
        for each in (value.left, value.right):
            settle(scope.report, each, UNKNOWN)
        return BOOL if value.op in _COMPARISONS else UNKNOWN
    if value.op in _COMPARISONS:
        return _comparison(scope, value, left, right)
    if value.op == "**":
        return _power(scope, value)
    if _about_time(value.op, left, right):
        return _time_arithmetic(scope, value)
    return _joined(scope, value, _KINDS_OF.get(value.op, ANY_NUM))


def _about_time(op: str, left: Type, right: Type) -> bool:
    """Whether an operator works on durations or moments."""
    if op not in ("+", "-", "*", "/"):
        return False
    return bool(TEMPORAL & {left.kind, right.kind})


def _joined(scope: Scope, value: Binary, kinds: frozenset[Kind]) -> Type:
    """Both operands of one type out of `kinds`; that type is the result's."""
    shared = _shared(scope, value)
    if shared is UNKNOWN:
        return UNKNOWN
    if untyped(shared):
        if shared is UNTYPED_REAL and Kind.REAL not in kinds:
            shared = REAL
        elif Kind.BITS not in kinds:
            _zero_divisor(scope, value)
            return shared
        else:
            shared = default(value.left)
    for each in (value.left, value.right):
        fits(scope.report, each, shared)
    _zero_divisor(scope, value)
    value.operand_type = shared
    return _operand(scope, value.left, kinds, value.op, shared)


def _shared(scope: Scope, value: Binary) -> Type:
    """The type that both operands can have; UNKNOWN, and reported, if there is none."""
    left, right = value.left.type, value.right.type
    if untyped(left) and untyped(right):
        if left is not right:
            _mixed(scope, value)
            return UNKNOWN
        return left
    if untyped(left) or untyped(right):
        return plain(right if untyped(left) else left)
    if same(left, right):
        return plain(left)
    _unlike(scope, value)
    return UNKNOWN


def _mixed(scope: Scope, value: Binary) -> None:
    """Report an integer beside a real, both without prefix."""
    integer = value.left if value.left.type is UNTYPED_INTEGER else value.right
    for each in (value.left, value.right):
        settle(scope.report, each, REAL)
    if not isinstance(integer, Literal):
        scope.report.add(value.at, "type-mismatch", f"expected reals on both sides of {value.op}, found an integer")


def _unlike(scope: Scope, value: Binary) -> None:
    """Report operands of two types."""
    left, right = value.left.type, value.right.type
    if UNKNOWN in (left, right) or Kind.POINTER in (left.kind, right.kind):
        return
    if left.kind in ANY_NUM | ANY_BIT and right.kind in ANY_NUM | ANY_BIT:
        text = f"expected operands of one type for {value.op}, found {left} and {right}: convert one explicitly"
        scope.report.add(value.at, "implicit-conversion", text)
    else:
        text = f"expected operands of one type for {value.op}, found {left} and {right}"
        scope.report.add(value.at, "type-mismatch", text)


def _zero_divisor(scope: Scope, value: Binary) -> None:
    """Report a division by a constant zero."""
    if value.op in ("/", "MOD") and isinstance(value.right, Literal) and value.right.value == 0:
        scope.report.add(value.right.at, "literal-range", f"expected a divisor other than 0 for {value.op}")


def _comparison(scope: Scope, value: Binary, left: Type, right: Type) -> Type:
    """Both operands of one elementary type; enumerations only for `=` and `<>`."""
    shared = _shared(scope, value)
    if untyped(shared):
        either = default(value.left), default(value.right)
        shared = max(either, key=lambda each: (each.size, each.kind is Kind.BITS))
        leave_open(value.left)
        leave_open(value.right)
    if shared is UNKNOWN:
        for each in (value.left, value.right):
            settle(scope.report, each, UNKNOWN)
        return BOOL
    for each in (value.left, value.right):
        fits(scope.report, each, shared)
    value.operand_type = shared
    ordered = value.op not in ("=", "<>")
    if left.kind is not Kind.NONE and left.kind not in ANY_COMPARABLE:
        scope.report.add(value.at, "type-mismatch", f"expected values of elementary types for {value.op}, found {left}")
    elif ordered and Kind.ENUM in (left.kind, right.kind):
        scope.report.add(value.at, "type-mismatch", f"expected = or <> for values of {left}, found {value.op}")
    return BOOL


def _power(scope: Scope, value: Binary) -> Type:
    """`x ** n`: a real base, any number as exponent."""
    if untyped(value.right.type):
        choose(scope.report, value.right)
    _operand(scope, value.right, ANY_NUM, "**", value.right.type)
    if value.left.type is UNTYPED_REAL:
        return UNTYPED_REAL
    settle(scope.report, value.left, REAL)
    base = value.left.type
    value.operand_type = base
    if base.kind is not Kind.REAL and base is not UNKNOWN:
        scope.report.add(value.left.at, "type-mismatch", f"expected REAL or LREAL before **, found {base}")
        return UNKNOWN
    return base


def _time_arithmetic(scope: Scope, value: Binary) -> Type:
    """Durations and moments, by table 30."""
    left, right = value.left, value.right
    made = _TIMES.get((value.op, plain(left.type), plain(right.type)))
    if value.op in ("*", "/") and left.type is TIME:
        choose(scope.report, right)
        made = TIME if right.type.kind in ANY_NUM else None
    elif value.op == "*" and right.type is TIME:
        choose(scope.report, left)
        made = TIME if left.type.kind in ANY_NUM else None
    value.operand_type = plain(left.type)
    if made is None:
        for each in (left, right):
            settle(scope.report, each, UNKNOWN)
        text = f"{value.op} is not defined for {left.type} and {right.type}"
        scope.report.add(value.at, "type-mismatch", text)
        return UNKNOWN
    return made


def conversion_to_bits(have: Type) -> str:
    """The function that makes a bit string of the same width from an integer."""
    width = have.width if isinstance(have, Elementary) else 16
    return f"{plain(have).name}_TO_{ {8: 'BYTE', 16: 'WORD', 32: 'DWORD'}.get(width, 'LWORD') }"
