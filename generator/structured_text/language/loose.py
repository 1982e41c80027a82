"""Values whose bits beyond their type may be there or not.

C, which matiec writes, computes in `int`: the sum of two UINTs, a complement or a left shift keeps bits that the type
has no room for, until it is stored. Others cut at once. Where only the low bits matter (a store, another sum, a mask)
nobody sees the difference; a comparison, a division, a right shift or a conversion to a wider type does.
"""

from structured_text.language.lint_scope import Scope
from structured_text.language.ranges import whole
from structured_text.language.tree import Binary, Builtin, Call, Expression, Literal, Unary
from structured_text.language.types import Elementary, Kind, plain

# `i + 1` at the very end of a type's range is what people check by other means; reporting each would bury the rest.
_SMALL_STEP = 256


def loose(value: Expression, scope: Scope) -> Expression | None:
    """The part of an expression that can overflow its type before it is stored; None if no part can."""
    made = plain(value.type)
    if not isinstance(made, Elementary) or made.kind not in (Kind.INTEGER, Kind.BITS):
        return None
    if isinstance(value, Unary):
        return _unary(value, scope)
    if isinstance(value, Binary):
        return _binary(value, scope)
    if isinstance(value, Call) and isinstance(value.target, Builtin) and value.target.family == "SHL":
        return value if _leaves(value, scope) else None
    return None


def _unary(value: Unary, scope: Scope) -> Expression | None:
    """NOT of a bit string is loose; a sign is as loose as its operand."""
    if value.op == "NOT":
        return value if value.type.kind is Kind.BITS else None
    return loose(value.operand, scope)


def _binary(value: Binary, scope: Scope) -> Expression | None:
    """AND takes stray bits away if one side has none."""
    left, right = loose(value.left, scope), loose(value.right, scope)
    if value.op == "AND":
        return left if left is not None and right is not None else None
    if value.op in ("/", "MOD"):
        return None
    if value.op in ("+", "-", "*") and _leaves(value, scope) and not _small_step(value):
        return value
    return left or right


def _leaves(value: Expression, scope: Scope) -> bool:
    """Whether the range of an operation is wider than its type."""
    found, limits = scope.ranges.of(value), whole(plain(value.type))
    return found is not None and limits is not None and not (limits[0] <= found[0] and found[1] <= limits[1])


def _small_step(value: Binary) -> bool:
    """`i + 1`, or `i - 1` of a signed number."""
    step = value.right if isinstance(value.right, Literal) else value.left
    if not isinstance(step, Literal) or not isinstance(step.value, int) or not 0 <= step.value <= _SMALL_STEP:
        return False
    made = plain(value.type)
    signed = isinstance(made, Elementary) and made.signed
    return value.op == "+" or (value.op == "-" and signed)


def tell_loose(scope: Scope, value: Expression, user: str) -> None:
    """An operand whose bits beyond its type may be used."""
    culprit = loose(value, scope)
    if culprit is None:
        return
    if isinstance(culprit, Unary):
        text = (
            f"matiec keeps the bits that NOT sets beyond the type, and {user} sees them: XOR with a mask, or store it"
        )
        scope.add(culprit.at, "complement-compare", text)
    elif isinstance(culprit, Call):
        text = f"compilers differ on the bits that SHL pushes out of the type, and {user} sees them: store it first"
        scope.add(culprit.at, "unstored-shift", text)
    else:
        text = (
            f"this can overflow {plain(culprit.type)}, and compilers differ on when it is cut before {user}: store it, "
            "widen the operands first, or take MOD on the way"
        )
        scope.add(culprit.at, "intermediate-overflow", text)
