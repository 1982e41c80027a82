"""Rules about calls of functions and blocks."""

from structured_text.language import tree
from structured_text.language.lint_scope import Scope
from structured_text.language.loose import tell_loose
from structured_text.language.ranges import whole
from structured_text.language.types import BOOL, TEMPORAL, Elementary, Kind, Type, plain

_ORDERS = frozenset(["<", ">", "<=", ">="])
_ORDER_FUNCTIONS = frozenset(["LT", "GT", "LE", "GE", "MAX", "MIN", "LIMIT"])
_COMPARING_FUNCTIONS = frozenset(["LT", "GT", "LE", "GE", "EQ", "NE", "MAX", "MIN", "LIMIT"])
_STRING_FUNCTIONS = frozenset(["LEN", "LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE", "FIND"])
_SHIFTS = frozenset(["SHL", "SHR", "ROL", "ROR"])
_TIME_FUNCTIONS = frozenset(["ADD", "SUB", "MULTIME", "DIVTIME", "MAX", "MIN", "LIMIT", *_COMPARING_FUNCTIONS])


def call(scope: Scope, value: tree.Call) -> None:
    """A call."""
    if value.en is not None or value.eno is not None:
        scope.add(value.at, "en-eno", "EN and ENO are refused by RuSTy and IronPLC: use IF around the call")
    for binding in value.bindings:
        if binding.negated and binding.value is not None:
            text = f"matiec dies of NOT {binding.parameter.name} =>: read the output after the call"
            scope.add(binding.value.at, "negated-output", text)
    if isinstance(value.target, tree.Block | tree.Function):
        _aliases(scope, value)
        _order(scope, value)
    elif isinstance(value.target, tree.Builtin):
        _builtin(scope, value, value.target)


def _order(scope: Scope, value: tree.Call) -> None:
    """A function comes before what calls it."""
    target = value.target
    if isinstance(target, tree.Function) and target.unit is scope.pou.unit and target.at > scope.pou.at:
        text = f"{target.name} is declared further down: order types, functions, inner blocks, outer blocks, programs"
        scope.add(value.at, "declaration-order", text)


def _builtin(scope: Scope, value: tree.Call, target: tree.Builtin) -> None:
    if target.family == "CONVERT":
        _conversion(scope, value, target)
    elif target.family == "TRUNC":
        _real_to_integer(scope, value, target)
    elif target.family in ("SHR", "ROR", "ROL") and value.bindings[0].value is not None:
        tell_loose(scope, value.bindings[0].value, target.name)
    if value.open:
        text = f"nothing says which type {target.name} gives here, and compilers choose differently: store it first"
        scope.add(value.at, "open-type", text)
    kinds = {parameter.type.kind for parameter in target.parameters}
    _ordering(scope, value, target, kinds)
    if target.family in _SHIFTS and plain(target.parameters[0].type) is BOOL:
        scope.add(value.at, "bool-shift", f"matiec's library has no {target.name} of a BOOL: use BYTE or WORD")
    if target.family in _STRING_FUNCTIONS:
        text = f"{target.name} differs between runtimes: keep text in byte arrays; assign and compare strings only"
        scope.add(value.at, "string-function", text)
    if (target.family in _TIME_FUNCTIONS or target.family.startswith(("ADD_", "SUB_"))) and kinds & TEMPORAL:
        text = (
            f"matiec holds TIME in fractions of a second, and {target.name} goes wrong: count milliseconds in a UDINT"
        )
        scope.add(value.at, "time-arithmetic", text)


def _ordering(scope: Scope, value: tree.Call, target: tree.Builtin, kinds: set[Kind]) -> None:
    """A function that compares."""
    if target.family in _COMPARING_FUNCTIONS and kinds & {Kind.INTEGER, Kind.BITS}:
        for binding in value.bindings:
            if binding.value is not None:
                tell_loose(scope, binding.value, target.name)
    if target.family in _ORDER_FUNCTIONS and Kind.BITS in kinds:
        text = f"RuSTy compares bit strings with a sign in {target.name}: convert to UINT or USINT first"
        scope.add(value.at, "bit-string-order", text)


def _conversion(scope: Scope, value: tree.Call, target: tree.Builtin) -> None:
    """`X_TO_Y`."""
    source, result = target.parameters[0].type, target.result
    inner = value.bindings[0].value
    if Kind.STRING in (source.kind, result.kind):
        text = f"{target.name} is refused by RuSTy, and its text differs: build the characters yourself"
        scope.add(value.at, "string-conversion", text)
    elif TEMPORAL & {source.kind, result.kind}:
        text = f"{target.name} counts seconds on matiec and milliseconds elsewhere: keep time as integer milliseconds"
        scope.add(value.at, "time-conversion", text)
    elif source.kind is Kind.REAL and result.kind is not Kind.REAL:
        _real_to_integer(scope, value, target)
    elif inner is not None and _widens(source, result):
        tell_loose(scope, inner, target.name)


def _widens(source: object, result: object) -> bool:
    """Whether a conversion shows more than the low bits of its operand in the same order."""
    if not isinstance(source, Elementary) or not isinstance(result, Elementary):
        return True
    return result.width > source.width or result.kind in (Kind.REAL, Kind.BOOL)


def _real_to_integer(scope: Scope, value: tree.Call, target: tree.Builtin) -> None:
    """REAL_TO_INT and TRUNC of something that was not compared with both limits in this POU."""
    inner = value.bindings[0].value if value.bindings else None
    if inner is None or _fitting_literal(inner, plain(value.type)):
        return
    if isinstance(inner, tree.Name) and _compared(scope, inner) == {"<", ">"}:
        return
    text = (
        f"{target.name} of a value out of range or NaN gives rubbish without a word on matiec: "
        "compare a REAL variable with both limits first, and convert that"
    )
    scope.add(value.at, "real-to-int", text)


def _fitting_literal(value: tree.Expression, target: Type) -> bool:
    """Whether a value is a number, with a sign or without, within the limits of a type."""
    sign = -1.0 if isinstance(value, tree.Unary) and value.op == "-" else 1.0
    number = value.operand if isinstance(value, tree.Unary) else value
    if not isinstance(number, tree.Literal) or not isinstance(number.value, int | float):
        return False
    limits = whole(target)
    return limits is not None and limits[0] <= sign * number.value <= limits[1]


def _compared(scope: Scope, value: tree.Name) -> set[str]:
    """In which directions a variable is compared in this POU: `<` and `>` as if it were on the left."""
    mirrored = {"<": ">", "<=": ">", ">": "<", ">=": "<"}
    straight = {"<": "<", "<=": "<", ">": ">", ">=": ">"}
    made: set[str] = set()
    for each in scope.expressions:
        if isinstance(each, tree.Binary) and each.op in _ORDERS:
            if isinstance(each.left, tree.Name) and each.left.symbol is value.symbol:
                made.add(straight[each.op])
            if isinstance(each.right, tree.Name) and each.right.symbol is value.symbol:
                made.add(mirrored[each.op])
    return made


def _aliases(scope: Scope, value: tree.Call) -> None:
    """One variable, or a part of it, bound to two parameters that can change it."""
    paths: list[tuple[tuple[object, ...], bool]] = []
    for binding in value.bindings:
        if binding.value is None or binding.parameter.direction is tree.Direction.INPUT:
            continue
        path = _path(binding.value)
        in_out = binding.parameter.direction is tree.Direction.IN_OUT
        for other, other_in_out in paths:
            if path and (in_out or other_in_out) and _overlap(path, other):
                text = "matiec copies in-outs in and out, others pass references: bind each variable once"
                scope.add(binding.value.at, "in-out-alias", text)
                break
        paths.append((path, in_out))


def _path(value: tree.Expression) -> tuple[object, ...]:
    """What a variable is a part of, from the outside in; constant indices count, others may be anything (None)."""
    parts: list[object] = []
    while isinstance(value, tree.Member | tree.Index):
        if isinstance(value, tree.Member):
            parts.append(value.name.upper())
        else:
            parts.extend(each.value if isinstance(each, tree.Literal) else None for each in reversed(value.indices))
        value = value.base
    return (id(value.symbol), *reversed(parts)) if isinstance(value, tree.Name) and value.symbol is not None else ()


def _overlap(left: tuple[object, ...], right: tuple[object, ...]) -> bool:
    """Whether one path leads into the other."""
    return all(a == b or a is None or b is None for a, b in zip(left, right, strict=False))
