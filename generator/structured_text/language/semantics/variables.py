"""The initial values of variables and declared types, and what the variables refer to (clauses 2.3.3, 2.4.3)."""

from structured_text.language import tree
from structured_text.language.library import fold
from structured_text.language.resolve import Resolver
from structured_text.language.semantics.declarations import no_block_inside
from structured_text.language.semantics.operands import block_variable
from structured_text.language.semantics.scope import Scope, expect
from structured_text.language.tree import Array, Configuration, Pou, StructSpec, TypeDecl, VarBlock, VarDecl, VarKind
from structured_text.language.types import INT, UNKNOWN, Kind, Type, same


def check_type(scope: Scope, declared: TypeDecl) -> None:
    """Check the initial values of a TYPE declaration, and what its parts may not be."""
    made = declared.type
    if declared.initial is not None:
        initial_value(scope, declared.initial, made)
    if isinstance(declared.spec, StructSpec):
        for field in declared.spec.fields:
            _check_field(scope, field)
    if isinstance(made, Array):
        no_block_inside(scope.report, declared.spec.at, made)


def _check_field(scope: Scope, field: VarDecl) -> None:
    """A field of a structure."""
    if field.initial is not None and not field.grouped:
        initial_value(scope, field.initial, field.type)
    if field.type.kind is Kind.BLOCK:
        text = f"a block in a structure is refused by matiec: declare {field.name} beside the structure"
        scope.report.add(field.at, "block-in-struct", text)
    no_block_inside(scope.report, field.at, field.type)


def check_variables(scope: Scope, pou: Pou) -> None:
    """Check the initial values of a POU's variables, and what its externals mean."""
    for block in pou.blocks:
        for variable in block.variables:
            if variable.kind is VarKind.EXTERNAL:
                _external(scope, variable)
            if variable.initial is None or variable.grouped:
                continue
            if variable.kind in (VarKind.IN_OUT, VarKind.EXTERNAL):
                text = f"expected no initial value for {variable.kind.value} {variable.name}"
                scope.report.add(variable.initial.at, "type-mismatch", text)
            initial_value(scope, variable.initial, variable.type)


def _external(scope: Scope, variable: VarDecl) -> None:
    """Find the global that a VAR_EXTERNAL means."""
    target = scope.library.global_variables.get(variable.name.upper())
    variable.target = target
    if target is None:
        text = f"expected a VAR_GLOBAL {variable.name} in a configuration, found none"
        scope.report.add(variable.at, "undeclared-name", text)
    elif UNKNOWN not in (target.type, variable.type) and not same(target.type, variable.type):
        text = f"expected {target.type} as the VAR_GLOBAL has, found {variable.type}"
        scope.report.add(variable.at, "type-mismatch", text)
    elif target.constant != variable.constant:
        wanted = "VAR_EXTERNAL CONSTANT" if target.constant else "VAR_EXTERNAL without CONSTANT"
        scope.report.add(variable.at, "type-mismatch", f"expected {wanted}, as the VAR_GLOBAL has it")


def check_globals(scope: Scope, resolver: Resolver) -> None:
    """Resolve the types of global variables."""
    for unit in scope.library.units:
        scope.report.unit = unit
        for element in unit.elements:
            if isinstance(element, VarBlock):
                text = "VAR_GLOBAL outside a CONFIGURATION is refused by matiec: put it into one, or use parameters"
                scope.report.add(element.at, "top-level-global", text)
                _global_block(scope, resolver, element, {})
            elif isinstance(element, Configuration):
                for block in [*element.blocks, *(each for resource in element.resources for each in resource.blocks)]:
                    _global_block(scope, resolver, block, element.symbols)


def _global_block(scope: Scope, resolver: Resolver, block: VarBlock, symbols: dict[str, VarDecl]) -> None:
    """The variables of one VAR_GLOBAL."""
    for variable in block.variables:
        variable.type = variable.spec.type if variable.grouped else resolver.spec(variable.spec)
        first = symbols.setdefault(variable.name.upper(), variable) if block.kind is VarKind.GLOBAL else variable
        if first is not variable:
            scope.report.add(variable.at, "duplicate-name", f"{variable.name} is declared already")
        if variable.initial is not None and not variable.grouped:
            initial_value(scope, variable.initial, variable.type)
        no_block_inside(scope.report, variable.at, variable.type)


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
