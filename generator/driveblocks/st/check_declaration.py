"""Declarations of POUs and configurations -> symbols, parameters and block types (clauses 2.4.3, 2.5, 2.7)."""

from __future__ import annotations

from driveblocks.st.check_statement import StatementChecker
from driveblocks.st.library import Library
from driveblocks.st.report import Report
from driveblocks.st.resolve import Resolver
from driveblocks.st.tree import (
    Array,
    Block,
    Direction,
    Function,
    FunctionBlock,
    NamedSpec,
    Parameter,
    Pou,
    Program,
    StructSpec,
    TypeDecl,
    VarDecl,
    VarKind,
)
from driveblocks.st.types import UNKNOWN, VOID, Kind, Type, same

_DIRECTIONS = {
    VarKind.INPUT: Direction.INPUT,
    VarKind.OUTPUT: Direction.OUTPUT,
    VarKind.IN_OUT: Direction.IN_OUT,
}


class DeclarationChecker(StatementChecker):
    """Reads the declarations before any body is looked at."""

    def __init__(self, library: Library, report: Report) -> None:
        """Check against these declarations."""
        super().__init__(library, report)
        self.resolver = Resolver(library)

    def declare_type(self, declared: TypeDecl) -> None:
        """Resolve a TYPE declaration."""
        declared.type = self.resolver.declaration(declared)

    def check_type(self, declared: TypeDecl) -> None:
        """Check the initial values of a TYPE declaration, and what its parts may not be."""
        self.symbols = {}
        made = declared.type
        if declared.initial is not None:
            self.initial(declared.initial, made)
        if isinstance(declared.spec, StructSpec):
            for field in declared.spec.fields:
                self.check_field(field)
        if isinstance(made, Array):
            self.no_block_inside(declared.spec.at, made)

    def check_field(self, field: VarDecl) -> None:
        """A field of a structure."""
        if field.initial is not None and not field.grouped:
            self.initial(field.initial, field.type)
        if field.type.kind is Kind.BLOCK:
            text = f"a block in a structure is refused by matiec: declare {field.name} beside the structure"
            self.report.add(field.at, "block-in-struct", text)
        self.no_block_inside(field.at, field.type)

    def no_block_inside(self, at: int, made: Type) -> None:
        """Tell of an array of blocks."""
        while isinstance(made, Array):
            made = made.element
            if made.kind is Kind.BLOCK:
                text = "an array of blocks is refused by matiec: declare each instance by name"
                self.report.add(at, "block-array", text)

    def declare_pou(self, pou: Pou) -> None:
        """Fill the symbols of a POU, and its parameters."""
        self.resolver.constants = pou.symbols
        parameters: dict[str, Parameter] = {}
        for block in pou.blocks:
            for variable in block.variables:
                self.declare_variable(pou, variable)
                direction = _DIRECTIONS.get(variable.kind)
                if direction is not None:
                    made = Parameter(variable.name, variable.type, direction, variable.start, variable)
                    parameters.setdefault(variable.name.upper(), made)
        if isinstance(pou, Function):
            pou.parameters = parameters
            self.declare_result(pou)
        elif isinstance(pou, FunctionBlock | Program):
            pou.type = pou.type or Block(pou.name, Kind.BLOCK, declaration=pou)
            pou.type.parameters = parameters
        self.resolver.constants = {}

    def declare_variable(self, pou: Pou, variable: VarDecl) -> None:
        """Resolve the type of a variable and enter it."""
        variable.type = variable.spec.type if variable.grouped else self.resolver.spec(variable.spec)
        upper = variable.name.upper()
        first = pou.symbols.setdefault(upper, variable) if upper else variable
        if first is not variable:
            line = pou.unit.line(first.at) if pou.unit else 0
            text = f"{variable.name} is declared at line {line} already"
            self.report.add(variable.at, "duplicate-name", text)
        if variable.edge:
            text = f"{variable.edge} hides an instance: declare an R_TRIG and call it"
            self.report.add(variable.at, "edge-input", text)
        self.no_block_inside(variable.at, variable.type)
        if variable.type.kind is Kind.BLOCK:
            self.block_variable_kind(pou, variable)

    def block_variable_kind(self, pou: Pou, variable: VarDecl) -> None:
        """Tell of a block instance where none may be."""
        if isinstance(pou, Function):
            text = f"a function keeps nothing between calls: declare the block {variable.name} in a function block"
            self.report.add(variable.at, "type-mismatch", text)
        elif variable.kind is VarKind.IN_OUT:
            text = f"matiec crashes on a block as in-out: give {variable.name} its own instance, or pass its outputs"
            self.report.add(variable.at, "block-in-out", text)
        elif variable.kind in _DIRECTIONS:
            text = f"expected a value, found the block type {variable.type} for the parameter {variable.name}"
            self.report.add(variable.at, "type-mismatch", text)

    def declare_result(self, pou: Function) -> None:
        """The function's own name as a variable."""
        pou.type = VOID if pou.returns is None else self.resolver.spec(pou.returns)
        if pou.type is VOID:
            text = f"FUNCTION {pou.name} has no result type: write FUNCTION {pou.name} : BOOL and assign to {pou.name}"
            self.report.add(pou.name_at, "no-result-type", text)
        elif pou.type.kind is Kind.BLOCK:
            self.report.add(pou.name_at, "type-mismatch", f"expected a data type as result, found the block {pou.type}")
        spec = pou.returns or NamedSpec(pou.name_at, "VOID")
        result = VarDecl(pou.name_at, pou.name_at, pou.name, VarKind.RESULT, spec, None)
        result.type = pou.type
        pou.result = result
        first = pou.symbols.setdefault(pou.name.upper(), result)
        if first is not result:
            text = f"{first.name} is the name of the function: choose another name"
            self.report.add(first.at, "duplicate-name", text)

    def check_variables(self, pou: Pou) -> None:
        """Check the initial values of a POU's variables, and what its externals mean."""
        self.symbols = pou.symbols
        for block in pou.blocks:
            for variable in block.variables:
                if variable.kind is VarKind.EXTERNAL:
                    self.external(variable)
                if variable.initial is None or variable.grouped:
                    continue
                if variable.kind in (VarKind.IN_OUT, VarKind.EXTERNAL):
                    text = f"expected no initial value for {variable.kind.value} {variable.name}"
                    self.report.add(variable.initial.at, "type-mismatch", text)
                self.initial(variable.initial, variable.type)

    def external(self, variable: VarDecl) -> None:
        """Find the global that a VAR_EXTERNAL means."""
        target = self.library.global_variables.get(variable.name.upper())
        variable.target = target
        if target is None:
            text = f"expected a VAR_GLOBAL {variable.name} in a configuration, found none"
            self.report.add(variable.at, "undeclared-name", text)
        elif UNKNOWN not in (target.type, variable.type) and not same(target.type, variable.type):
            text = f"expected {target.type} as the VAR_GLOBAL has, found {variable.type}"
            self.report.add(variable.at, "type-mismatch", text)
        elif target.constant != variable.constant:
            wanted = "VAR_EXTERNAL CONSTANT" if target.constant else "VAR_EXTERNAL without CONSTANT"
            self.report.add(variable.at, "type-mismatch", f"expected {wanted}, as the VAR_GLOBAL has it")
