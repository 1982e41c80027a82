"""Declarations of POUs and configurations -> symbols, parameters and block types (clauses 2.4.3, 2.5, 2.7)."""

from structured_text.language import tree
from structured_text.language.report import Report
from structured_text.language.resolve import Resolver
from structured_text.language.types import VOID, Kind, Type

_DIRECTIONS = {
    tree.VarKind.INPUT: tree.Direction.INPUT,
    tree.VarKind.OUTPUT: tree.Direction.OUTPUT,
    tree.VarKind.IN_OUT: tree.Direction.IN_OUT,
}


def declare_type(resolver: Resolver, declared: tree.TypeDecl) -> None:
    """Resolve a TYPE declaration."""
    declared.type = resolver.declaration(declared)


def no_block_inside(report: Report, at: int, made: Type) -> None:
    """Report an array of blocks."""
    while isinstance(made, tree.Array):
        made = made.element
        if made.kind is Kind.BLOCK:
            text = "an array of blocks is refused by matiec: declare each instance by name"
            report.add(at, "block-array", text)


def declare_pou(resolver: Resolver, pou: tree.Pou) -> None:
    """Fill the symbols of a POU, and its parameters."""
    resolver.constants = pou.symbols
    parameters: dict[str, tree.Parameter] = {}
    for block in pou.blocks:
        for variable in block.variables:
            _declare_variable(resolver, pou, variable)
            direction = _DIRECTIONS.get(variable.kind)
            if direction is not None:
                made = tree.Parameter(variable.name, variable.type, direction, variable.start, variable)
                parameters.setdefault(variable.name.upper(), made)
    if isinstance(pou, tree.Function):
        pou.parameters = parameters
        _declare_result(resolver, pou)
    elif isinstance(pou, tree.FunctionBlock | tree.Program):
        pou.type = pou.type or tree.Block(pou.name, Kind.BLOCK, declaration=pou)
        pou.type.parameters = parameters
    resolver.constants = {}


def _declare_variable(resolver: Resolver, pou: tree.Pou, variable: tree.VarDecl) -> None:
    """Resolve the type of a variable and enter it."""
    variable.type = variable.spec.type if variable.grouped else resolver.spec(variable.spec)
    upper = variable.name.upper()
    first = pou.symbols.setdefault(upper, variable) if upper else variable
    if first is not variable:
        line = pou.unit.line(first.at) if pou.unit else 0
        text = f"{variable.name} is declared at line {line} already"
        resolver.report.add(variable.at, "duplicate-name", text)
    if variable.edge:
        text = f"{variable.edge} hides an instance: declare an R_TRIG and call it"
        resolver.report.add(variable.at, "edge-input", text)
    no_block_inside(resolver.report, variable.at, variable.type)
    if variable.type.kind is Kind.BLOCK:
        _block_variable_kind(resolver.report, pou, variable)


def _block_variable_kind(report: Report, pou: tree.Pou, variable: tree.VarDecl) -> None:
    """Report a block instance where none may be."""
    if isinstance(pou, tree.Function):
        text = f"a function keeps nothing between calls: declare the block {variable.name} in a function block"
        report.add(variable.at, "type-mismatch", text)
    elif variable.kind is tree.VarKind.IN_OUT:
        text = f"matiec crashes on a block as in-out: give {variable.name} its own instance, or pass its outputs"
        report.add(variable.at, "block-in-out", text)
    elif variable.kind in _DIRECTIONS:
        text = f"expected a value, found the block type {variable.type} for the parameter {variable.name}"
        report.add(variable.at, "type-mismatch", text)


def _declare_result(resolver: Resolver, pou: tree.Function) -> None:
    """The function's own name as a variable."""
    pou.type = VOID if pou.returns is None else resolver.spec(pou.returns)
    if pou.type is VOID:
        text = f"FUNCTION {pou.name} has no result type: write FUNCTION {pou.name} : BOOL and assign to {pou.name}"
        resolver.report.add(pou.name_at, "no-result-type", text)
    elif pou.type.kind is Kind.BLOCK:
        resolver.report.add(pou.name_at, "type-mismatch", f"expected a data type as result, found the block {pou.type}")
    spec = pou.returns or tree.NamedSpec(pou.name_at, "VOID")
    result = tree.VarDecl(pou.name_at, pou.name_at, pou.name, tree.VarKind.RESULT, spec, None)
    result.type = pou.type
    pou.result = result
    first = pou.symbols.setdefault(pou.name.upper(), result)
    if first is not result:
        text = f"{first.name} is the name of the function: choose another name"
        resolver.report.add(first.at, "duplicate-name", text)
