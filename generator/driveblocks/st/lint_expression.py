"""Rules about expressions: what compilers compute differently."""

from __future__ import annotations

from driveblocks.st.lint_scope import Scope
from driveblocks.st.loose import loose
from driveblocks.st.tree import (
    Binary,
    Call,
    Case,
    Expression,
    Function,
    Index,
    Literal,
    LiteralKind,
    Member,
    Name,
    Qualified,
    Unary,
    VarDecl,
    VarKind,
)
from driveblocks.st.types import BOOL, Block, Builtin, Direction, Elementary, EnumValue, Kind, plain
from driveblocks.st.walk import children, expressions

_ORDERS = frozenset(["<", ">", "<=", ">="])
_ORDER_FUNCTIONS = frozenset(["LT", "GT", "LE", "GE", "MAX", "MIN", "LIMIT"])
_COMPARISONS = _ORDERS | {"=", "<>"}
_COMPARING_FUNCTIONS = frozenset(["LT", "GT", "LE", "GE", "EQ", "NE", "MAX", "MIN", "LIMIT"])
_TIMES = frozenset([Kind.TIME, Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME])
_STRING_FUNCTIONS = frozenset(["LEN", "LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE", "FIND"])
_SHIFTS = frozenset(["SHL", "SHR", "ROL", "ROR"])
_TIME_FUNCTIONS = frozenset(["ADD", "SUB", "MULTIME", "DIVTIME", "MAX", "MIN", "LIMIT", *_COMPARING_FUNCTIONS])


def pou(scope: Scope) -> None:
    """All rules about the expressions of one POU."""
    _shifts(scope)
    for each in scope.expressions:
        if isinstance(each, Binary):
            _binary(scope, each)
        elif isinstance(each, Call):
            _call(scope, each)
        elif isinstance(each, Unary):
            _sign(scope, each)
        elif isinstance(each, Member):
            _member(scope, each)
        elif isinstance(each, Qualified):
            text = f"{each.type_name}#{each.name} is refused by STruC++ and IronPLC: write {each.name}"
            scope.add(each.at, "enum-qualified", text)
    for statement in scope.statements:
        if isinstance(statement, Case):
            _loose(scope, statement.selector, "CASE")


def _loose(scope: Scope, value: Expression, user: str) -> None:
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
            f"this can leave {plain(culprit.type)}, and compilers differ on when it is cut before {user}: store it, "
            "widen the operands first, or take MOD on the way"
        )
        scope.add(culprit.at, "intermediate-overflow", text)


def _sign(scope: Scope, value: Unary) -> None:
    """Signs and NOT stand alone."""
    if isinstance(value.operand, Unary) and not value.operand.parentheses:
        text = f"matiec refuses {value.operand.op} right behind {value.op}: write parentheses, or leave both out"
        scope.add(value.at, "stray-sign", text)
    elif value.op == "+" and not isinstance(value.operand, Literal):
        scope.add(value.at, "stray-sign", "matiec refuses + in front of anything but a number: leave it out")


def _binary(scope: Scope, value: Binary) -> None:
    """An operator."""
    kind = value.operand_type.kind
    if value.op in _COMPARISONS:
        _comparison(scope, value, kind)
    elif value.op in ("/", "MOD") and kind is Kind.INTEGER:
        _loose(scope, value.left, value.op)
        _loose(scope, value.right, value.op)
    elif value.op in ("AND", "OR") and value.type is BOOL:
        _short_circuit(scope, value)
    if _TIMES & {value.left.type.kind, value.right.type.kind}:
        text = f"matiec holds TIME in fractions of a second, and {value.op} goes wrong: count milliseconds in a UDINT"
        scope.add(value.at, "time-arithmetic", text)


def _comparison(scope: Scope, value: Binary, kind: Kind) -> None:
    """A comparison."""
    if kind in (Kind.INTEGER, Kind.BITS):
        _loose(scope, value.left, value.op)
        _loose(scope, value.right, value.op)
    if kind is Kind.BITS and value.op in _ORDERS:
        name = value.operand_type.name
        text = (
            f"RuSTy compares {name} with a sign: write {name}_TO_U{'S' if name == 'BYTE' else ''}INT(...) on both sides"
        )
        scope.add(value.at, "bit-string-order", text)
    if kind is Kind.STRING:
        _string_comparison(scope, value)


def _string_comparison(scope: Scope, value: Binary) -> None:
    """A comparison of strings."""
    if value.op in _ORDERS:
        scope.add(value.at, "string-order", "only = and <> are the same everywhere for strings")
    for each in (value.left, value.right):
        if isinstance(each, Literal) and each.kind is LiteralKind.STRING and each.value == b"":
            text = "OpenPLC's matiec finds '' equal to every string: keep a BOOL or a length instead"
            scope.add(value.at, "empty-string", text)


def _short_circuit(scope: Scope, value: Binary) -> None:
    """A right side that is only safe if the left side was evaluated first, or that does something."""
    guard = {id(each.symbol) for each in expressions(value.left) if isinstance(each, Name) and each.symbol is not None}
    for each in expressions(value.right):
        if _acts(each):
            text = f"matiec skips the right side of {value.op} where others do not: call the function before"
            scope.add(each.at, "short-circuit", text)
        elif any(id(name.symbol) in guard for name in _risks(each)):
            text = f"only matiec skips the right side of {value.op}: use a nested IF"
            scope.add(each.at, "short-circuit", text)


def _acts(value: Expression) -> bool:
    """Whether an expression changes something."""
    return isinstance(value, Call) and any(
        binding.parameter.direction is not Direction.INPUT and binding.value is not None for binding in value.bindings
    )


def _risks(value: Expression) -> list[Name]:
    """The variables on which it depends whether an expression can be evaluated at all."""
    if isinstance(value, Binary) and value.op in ("/", "MOD"):
        return [each for each in expressions(value.right) if isinstance(each, Name)]
    if isinstance(value, Index):
        return [each for index in value.indices for each in expressions(index) if isinstance(each, Name)]
    return []


def _member(scope: Scope, value: Member) -> None:
    """A member of an instance or enumeration."""
    if isinstance(value.symbol, EnumValue):
        text = f"E.{value.name} is refused by matiec and IronPLC: write {value.name}"
        scope.add(value.at, "enum-qualified", text)
    elif isinstance(value.base.type, Block) and isinstance(value.symbol, VarDecl) and _internal(value.symbol):
        text = f"{value.name} is internal to {value.base.type}, and refused by RuSTy: make it a VAR_OUTPUT"
        scope.add(value.at, "private-access", text)


def _internal(variable: VarDecl) -> bool:
    """Whether a variable of a block is none of its parameters."""
    return variable.kind not in (VarKind.INPUT, VarKind.OUTPUT, VarKind.IN_OUT)


def _call(scope: Scope, value: Call) -> None:
    """A call."""
    if value.en is not None or value.eno is not None:
        scope.add(value.at, "en-eno", "EN and ENO are refused by RuSTy and IronPLC: use IF around the call")
    for binding in value.bindings:
        if binding.negated and binding.value is not None:
            text = f"matiec dies of NOT {binding.parameter.name} =>: read the output after the call"
            scope.add(binding.value.at, "negated-output", text)
    if isinstance(value.target, Block | Function):
        _aliases(scope, value)
        _order(scope, value)
    elif isinstance(value.target, Builtin):
        _builtin(scope, value, value.target)


def _order(scope: Scope, value: Call) -> None:
    """A function stands before what calls it."""
    target = value.target
    if isinstance(target, Function) and target.unit is scope.pou.unit and target.at > scope.pou.at:
        text = f"{target.name} is declared further down: order types, functions, inner blocks, outer blocks, programs"
        scope.add(value.at, "declaration-order", text)


def _builtin(scope: Scope, value: Call, target: Builtin) -> None:
    """A standard function."""
    if target.family == "CONVERT":
        _conversion(scope, value, target)
    elif target.family == "TRUNC":
        _real_to_integer(scope, value, target)
    elif target.family in ("SHR", "ROR", "ROL") and value.bindings[0].value is not None:
        _loose(scope, value.bindings[0].value, target.name)
    kinds = {parameter.type.kind for parameter in target.parameters}
    _ordering(scope, value, target, kinds)
    if target.family in _SHIFTS and plain(target.parameters[0].type) is BOOL:
        scope.add(value.at, "bool-shift", f"matiec's library has no {target.name} of a BOOL: use BYTE or WORD")
    if target.family in _STRING_FUNCTIONS:
        text = f"{target.name} differs between runtimes: keep text in byte arrays; assign and compare strings only"
        scope.add(value.at, "string-function", text)
    if (target.family in _TIME_FUNCTIONS or target.family.startswith(("ADD_", "SUB_"))) and kinds & _TIMES:
        text = (
            f"matiec holds TIME in fractions of a second, and {target.name} goes wrong: count milliseconds in a UDINT"
        )
        scope.add(value.at, "time-arithmetic", text)


def _ordering(scope: Scope, value: Call, target: Builtin, kinds: set[Kind]) -> None:
    """A function that compares."""
    if target.family in _COMPARING_FUNCTIONS and kinds & {Kind.INTEGER, Kind.BITS}:
        for binding in value.bindings:
            if binding.value is not None:
                _loose(scope, binding.value, target.name)
    if target.family in _ORDER_FUNCTIONS and Kind.BITS in kinds:
        text = f"RuSTy compares bit strings with a sign in {target.name}: convert to UINT or USINT first"
        scope.add(value.at, "bit-string-order", text)


def _conversion(scope: Scope, value: Call, target: Builtin) -> None:
    """`X_TO_Y`."""
    source, result = target.parameters[0].type, target.result
    inner = value.bindings[0].value
    if Kind.STRING in (source.kind, result.kind):
        text = f"{target.name} is refused by RuSTy, and its text differs: build the characters yourself"
        scope.add(value.at, "string-conversion", text)
    elif _TIMES & {source.kind, result.kind}:
        text = f"{target.name} counts seconds on matiec and milliseconds elsewhere: keep time as integer milliseconds"
        scope.add(value.at, "time-conversion", text)
    elif source.kind is Kind.REAL and result.kind is not Kind.REAL:
        _real_to_integer(scope, value, target)
    elif inner is not None and _widens(source, result):
        _loose(scope, inner, target.name)


def _widens(source: object, result: object) -> bool:
    """Whether a conversion shows more than the low bits of its operand in the same order."""
    if not isinstance(source, Elementary) or not isinstance(result, Elementary):
        return True
    return result.width > source.width or result.kind in (Kind.REAL, Kind.BOOL)


def _real_to_integer(scope: Scope, value: Call, target: Builtin) -> None:
    """REAL_TO_INT and TRUNC of something that was not compared with both limits in this POU."""
    inner = value.bindings[0].value if value.bindings else None
    if inner is None or isinstance(inner, Literal):
        return
    if isinstance(inner, Name) and _compared(scope, inner) == {"<", ">"}:
        return
    text = (
        f"{target.name} of a value out of range or NaN gives rubbish without a word on matiec: "
        "compare a REAL variable with both limits first, and convert that"
    )
    scope.add(value.at, "real-to-int", text)


def _compared(scope: Scope, value: Name) -> set[str]:
    """In which directions a variable is compared in this POU: `<` and `>` as if it stood on the left."""
    mirrored = {"<": ">", "<=": ">", ">": "<", ">=": "<"}
    straight = {"<": "<", "<=": "<", ">": ">", ">=": ">"}
    made: set[str] = set()
    for each in scope.expressions:
        if isinstance(each, Binary) and each.op in _ORDERS:
            if isinstance(each.left, Name) and each.left.symbol is value.symbol:
                made.add(straight[each.op])
            if isinstance(each.right, Name) and each.right.symbol is value.symbol:
                made.add(mirrored[each.op])
    return made


def _aliases(scope: Scope, value: Call) -> None:
    """One variable, or a part of it, bound to two parameters that can change it."""
    paths: list[tuple[tuple[object, ...], bool]] = []
    for binding in value.bindings:
        if binding.value is None or binding.parameter.direction is Direction.INPUT:
            continue
        path = _path(binding.value)
        in_out = binding.parameter.direction is Direction.IN_OUT
        for other, other_in_out in paths:
            if path and (in_out or other_in_out) and _overlap(path, other):
                text = "matiec copies in-outs in and out, others pass references: bind each variable once"
                scope.add(binding.value.at, "in-out-alias", text)
                break
        paths.append((path, in_out))


def _path(value: Expression) -> tuple[object, ...]:
    """What a variable is a part of, from the outside in; constant indices count, others may be anything (None)."""
    parts: list[object] = []
    while isinstance(value, Member | Index):
        if isinstance(value, Member):
            parts.append(value.name.upper())
        else:
            parts.extend(each.value if isinstance(each, Literal) else None for each in reversed(value.indices))
        value = value.base
    return (id(value.symbol), *reversed(parts)) if isinstance(value, Name) and value.symbol is not None else ()


def _overlap(left: tuple[object, ...], right: tuple[object, ...]) -> bool:
    """Whether one path leads into the other."""
    return all(a == b or a is None or b is None for a, b in zip(left, right, strict=False))


def _shifts(scope: Scope) -> None:
    """Every SHR that no mask and no narrowing conversion stands around."""
    for head in scope.heads:
        _shift_in(scope, head, None)


def _shift_in(scope: Scope, value: Expression, outer: Expression | None) -> None:
    """Look at an expression in what surrounds it."""
    if isinstance(value, Call) and isinstance(value.target, Builtin) and value.target.family == "SHR":
        made = plain(value.type)
        if made.kind is Kind.BITS and not _masked(scope, value, outer):
            text = f"RuSTy shifts {made} arithmetically: mask it, as in SHR(w, 8) AND WORD#16#00FF"
            scope.add(value.at, "unmasked-shr", text)
    for inner in children(value):
        _shift_in(scope, inner, value)


def _masked(scope: Scope, value: Call, outer: Expression | None) -> bool:
    """Whether the bits that the shift moves in are taken away again at once."""
    made = plain(value.type)
    count = value.bindings[1].value if len(value.bindings) > 1 else None
    if not isinstance(made, Elementary) or count is None:
        return False
    found = scope.ranges.cut(count)
    kept = made.width - (found[1] if isinstance(count, Literal) and found else 1)
    if isinstance(outer, Binary) and outer.op == "AND":
        other = outer.right if outer.left is value else outer.left
        limits = scope.ranges.cut(other)
        return limits is not None and limits[1] < 1 << max(kept, 0)
    if isinstance(outer, Call) and isinstance(outer.target, Builtin) and outer.target.family == "CONVERT":
        return isinstance(outer.target.result, Elementary) and outer.target.result.width <= kept
    return False
