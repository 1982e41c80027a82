"""Initial values (clause 2.4.3.2): literals and enumerated values of the type declared."""

from structured_text.language import tree
from structured_text.language.library import fold
from structured_text.language.semantics.operands import block_variable
from structured_text.language.semantics.scope import Scope, expect
from structured_text.language.types import INT, UNKNOWN, Kind, Type


def initial_value(scope: Scope, value: tree.Expression, wanted: Type) -> None:
    """An initial value; constants and expressions are reported."""
    if isinstance(value, tree.ArrayInitial):
        _array_initial(scope, value, wanted)
    elif isinstance(value, tree.StructInitial):
        _struct_initial(scope, value, wanted)
    else:
        expect(scope, value, wanted)
        if wanted.kind is Kind.ARRAY and value.type is not UNKNOWN:
            scope.report.add(value.at, "type-mismatch", f"expected [...] for {wanted}")
        _literal_only(scope, value)


def _literal_only(scope: Scope, value: tree.Expression) -> None:
    """Report an initial value that is computed."""
    symbol = getattr(value, "symbol", None)
    if isinstance(value, tree.Literal) or isinstance(symbol, tree.EnumValue) or value.type is UNKNOWN:
        return
    text = "expected a literal or enumerated value: matiec refuses constants and expressions in initial values"
    scope.report.add(value.at, "initial-expression", text)


def _array_initial(scope: Scope, value: tree.ArrayInitial, wanted: Type) -> None:
    """`[1, 2(0)]`."""
    if not isinstance(wanted, tree.Array):
        _unwanted(scope, value, wanted, "[...]")
        return
    value.type = wanted
    count = sum(_array_item(scope, each, wanted.element) for each in value.items)
    if count > wanted.length:
        text = f"expected at most {wanted.length} initial values, found {count}"
        scope.report.add(value.at, "literal-range", text)


def _array_item(scope: Scope, item: tree.Expression, wanted: Type) -> int:
    """An element or a repetition; how many elements it fills."""
    if not isinstance(item, tree.Repeat):
        initial_value(scope, item, wanted)
        return 1
    item.type = wanted
    expect(scope, item.count, INT)
    if item.value is not None:
        initial_value(scope, item.value, wanted)
    number = fold(item.count, scope.constant)
    return 1 if number is None else number


def _struct_initial(scope: Scope, value: tree.StructInitial, wanted: Type) -> None:
    """`(a := 1)` for a structure or an instance."""
    if not isinstance(wanted, tree.Struct | tree.Block):
        _unwanted(scope, value, wanted, "(...)")
        return
    value.type = wanted
    seen: set[str] = set()
    for each in value.items:
        upper = (each.name or "").upper()
        known = wanted.fields.get(upper) if isinstance(wanted, tree.Struct) else block_variable(wanted, upper)
        if known is None:
            scope.report.add(each.at, "undeclared-name", f"expected a member of {wanted}, found {each.name}")
        elif upper in seen:
            scope.report.add(each.at, "duplicate-name", f"{each.name} has an initial value already")
        elif each.value is not None:
            initial_value(scope, each.value, known.type)
        seen.add(upper)


def _unwanted(scope: Scope, value: tree.Expression, wanted: Type, shown: str) -> None:
    """Report an initialiser of the wrong shape."""
    if wanted is not UNKNOWN:
        scope.report.add(value.at, "type-mismatch", f"expected a value of {wanted}, found {shown}")
