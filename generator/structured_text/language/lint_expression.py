"""Rules about expressions: what compilers compute differently."""

from structured_text.language import tree
from structured_text.language.lint_call import call
from structured_text.language.lint_scope import Scope
from structured_text.language.loose import tell_loose
from structured_text.language.types import BOOL, TEMPORAL, Elementary, Kind, plain
from structured_text.language.walk import children, expressions

_ORDERS = frozenset(["<", ">", "<=", ">="])
_COMPARISONS = _ORDERS | {"=", "<>"}


def pou(scope: Scope) -> None:
    """All rules about the expressions of one POU."""
    _shifts(scope)
    for each in scope.expressions:
        if isinstance(each, tree.Binary):
            _binary(scope, each)
        elif isinstance(each, tree.Call):
            call(scope, each)
        elif isinstance(each, tree.Unary):
            _sign(scope, each)
        elif isinstance(each, tree.Member):
            _member(scope, each)
        elif isinstance(each, tree.Qualified):
            text = f"{each.type_name}#{each.name} is refused by STruC++ and IronPLC: write {each.name}"
            scope.add(each.at, "enum-qualified", text)
    for statement in scope.statements:
        if isinstance(statement, tree.Case):
            tell_loose(scope, statement.selector, "CASE")


def _sign(scope: Scope, value: tree.Unary) -> None:
    """Signs and NOT are used alone."""
    if isinstance(value.operand, tree.Unary) and not value.operand.parentheses:
        text = f"matiec refuses {value.operand.op} right after {value.op}: write parentheses, or leave both out"
        scope.add(value.at, "stray-sign", text)
    elif value.op == "+" and not isinstance(value.operand, tree.Literal):
        scope.add(value.at, "stray-sign", "matiec refuses + in front of anything but a number: leave it out")
    elif value.op == "NOT" and (_compares_reals(value.operand) or _joins_comparisons(value.operand)):
        text = "STruC++ makes C++ of it that does not compile: store the comparison in a BOOL first, and negate that"
        scope.add(value.at, "negated-comparison", text)


def _compares_reals(value: tree.Expression) -> bool:
    """Whether an expression is a comparison of REALs, or joins some."""
    if not isinstance(value, tree.Binary):
        return False
    if value.op in _COMPARISONS:
        return value.operand_type.kind is Kind.REAL
    return _compares_reals(value.left) or _compares_reals(value.right)


def _joins_comparisons(value: tree.Expression) -> bool:
    """Whether an expression joins comparisons, of anything, and nothing else."""
    if not isinstance(value, tree.Binary) or value.op in _COMPARISONS:
        return False
    sides = (value.left, value.right)
    return all(
        isinstance(each, tree.Binary) and (each.op in _COMPARISONS or _joins_comparisons(each)) for each in sides
    )


def _binary(scope: Scope, value: tree.Binary) -> None:
    """An operator."""
    kind = value.operand_type.kind
    if value.op in _COMPARISONS:
        _comparison(scope, value, kind)
    elif value.op in ("/", "MOD") and kind is Kind.INTEGER:
        tell_loose(scope, value.left, value.op)
        tell_loose(scope, value.right, value.op)
    elif value.op in ("AND", "OR") and value.type is BOOL:
        _short_circuit(scope, value)
    if TEMPORAL & {value.left.type.kind, value.right.type.kind}:
        text = f"matiec holds TIME in fractions of a second, and {value.op} goes wrong: count milliseconds in a UDINT"
        scope.add(value.at, "time-arithmetic", text)


def _comparison(scope: Scope, value: tree.Binary, kind: Kind) -> None:
    """A comparison."""
    if kind in (Kind.INTEGER, Kind.BITS):
        tell_loose(scope, value.left, value.op)
        tell_loose(scope, value.right, value.op)
    if kind is Kind.BITS and value.op in _ORDERS:
        name = value.operand_type.name
        text = (
            f"RuSTy compares {name} with a sign: write {name}_TO_U{'S' if name == 'BYTE' else ''}INT(...) on both sides"
        )
        scope.add(value.at, "bit-string-order", text)
    if kind is Kind.STRING:
        _string_comparison(scope, value)


def _string_comparison(scope: Scope, value: tree.Binary) -> None:
    """A comparison of strings."""
    if value.op in _ORDERS:
        scope.add(value.at, "string-order", "only = and <> are the same everywhere for strings")
    for each in (value.left, value.right):
        if isinstance(each, tree.Literal) and each.kind is tree.LiteralKind.STRING and each.value == b"":
            text = "OpenPLC's matiec finds '' equal to every string: keep a BOOL or a length instead"
            scope.add(value.at, "empty-string", text)


def _short_circuit(scope: Scope, value: tree.Binary) -> None:
    """A right side that is only safe if the left side was evaluated first, or that does something."""
    indices = {id(each) for index in expressions(value.left) for each in _indices(index)}  # an index there guards none
    names = [each for each in expressions(value.left) if isinstance(each, tree.Name) and id(each) not in indices]
    guard = {id(each.symbol) for each in names if each.symbol is not None}
    for each in expressions(value.right):
        if _acts(each):
            text = f"matiec skips the right side of {value.op} where others do not: call the function before"
            scope.add(each.at, "short-circuit", text)
        elif any(id(name.symbol) in guard for name in _risks(each)):
            text = f"only matiec skips the right side of {value.op}: use a nested IF"
            scope.add(each.at, "short-circuit", text)


def _acts(value: tree.Expression) -> bool:
    """Whether an expression changes something."""
    return isinstance(value, tree.Call) and any(
        binding.parameter.direction is not tree.Direction.INPUT and binding.value is not None
        for binding in value.bindings
    )


def _risks(value: tree.Expression) -> list[tree.Name]:
    """The variables on which it depends whether an expression can be evaluated at all."""
    if isinstance(value, tree.Binary) and value.op in ("/", "MOD"):
        return [each for each in expressions(value.right) if isinstance(each, tree.Name)]
    return _indices(value)


def _indices(value: tree.Expression) -> list[tree.Name]:
    """The variables by which an array is indexed."""
    if isinstance(value, tree.Index):
        return [each for index in value.indices for each in expressions(index) if isinstance(each, tree.Name)]
    return []


def _member(scope: Scope, value: tree.Member) -> None:
    """A member of an instance or enumeration."""
    if isinstance(value.symbol, tree.EnumValue):
        text = f"E.{value.name} is refused by matiec and IronPLC: write {value.name}"
        scope.add(value.at, "enum-qualified", text)
    elif isinstance(value.base.type, tree.Block) and isinstance(value.symbol, tree.VarDecl) and _internal(value.symbol):
        text = f"{value.name} is internal to {value.base.type}, and refused by RuSTy: make it a VAR_OUTPUT"
        scope.add(value.at, "private-access", text)


def _internal(variable: tree.VarDecl) -> bool:
    """Whether a variable of a block is none of its parameters."""
    return variable.kind not in (tree.VarKind.INPUT, tree.VarKind.OUTPUT, tree.VarKind.IN_OUT)


def _shifts(scope: Scope) -> None:
    """Every SHR without a mask or a narrowing conversion around it."""
    for head in scope.heads:
        _shift_in(scope, head, None)


def _shift_in(scope: Scope, value: tree.Expression, outer: tree.Expression | None) -> None:
    """Look at an expression in what surrounds it."""
    if isinstance(value, tree.Call) and isinstance(value.target, tree.Builtin) and value.target.family == "SHR":
        made = plain(value.type)
        if made.kind is Kind.BITS and not _masked(scope, value, outer):
            text = f"RuSTy shifts {made} arithmetically: mask it, as in SHR(w, 8) AND WORD#16#00FF"
            scope.add(value.at, "unmasked-shr", text)
    for inner in children(value):
        _shift_in(scope, inner, value)


def _masked(scope: Scope, value: tree.Call, outer: tree.Expression | None) -> bool:
    """Whether the bits that the shift moves in are taken away again at once."""
    made = plain(value.type)
    count = value.bindings[1].value if len(value.bindings) > 1 else None
    if not isinstance(made, Elementary) or count is None:
        return False
    found = scope.ranges.cut(count)
    kept = made.width - (found[1] if isinstance(count, tree.Literal) and found else 1)
    if isinstance(outer, tree.Binary) and outer.op == "AND":
        other = outer.right if outer.left is value else outer.left
        limits = scope.ranges.cut(other)
        return limits is not None and limits[1] < 1 << max(kept, 0)
    if isinstance(outer, tree.Call) and isinstance(outer.target, tree.Builtin) and outer.target.family == "CONVERT":
        return isinstance(outer.target.result, Elementary) and outer.target.result.width <= kept
    return False
