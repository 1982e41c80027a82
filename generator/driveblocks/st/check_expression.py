"""The types of expressions (clause 3.3.1): operands of one type, nothing converted by itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from driveblocks.st.check_operator import OperatorChecker
from driveblocks.st.check_value import untyped_of
from driveblocks.st.library import Library, fold
from driveblocks.st.report import Report, nearest
from driveblocks.st.tree import (
    Array,
    ArrayInitial,
    Binary,
    BitAccess,
    Block,
    Call,
    Dereference,
    Direct,
    Enum,
    EnumValue,
    Expression,
    Index,
    Literal,
    LiteralKind,
    Member,
    Name,
    Qualified,
    Repeat,
    Struct,
    StructInitial,
    TypeDecl,
    Unary,
    VarDecl,
    VarKind,
)
from driveblocks.st.types import (
    BOOL,
    BYTE,
    DATE,
    DATE_AND_TIME,
    DWORD,
    ELEMENTARY,
    LWORD,
    STRING,
    TIME,
    TIME_OF_DAY,
    UNKNOWN,
    VOID,
    WORD,
    WSTRING,
    Elementary,
    Kind,
    Pointer,
    Type,
    plain,
    untyped,
)

_FIXED_LITERALS = {LiteralKind.BOOL: BOOL, LiteralKind.STRING: STRING, LiteralKind.WSTRING: WSTRING}
_FIXED_LITERALS |= {LiteralKind.TIME: TIME, LiteralKind.DATE: DATE}
_FIXED_LITERALS |= {LiteralKind.TIME_OF_DAY: TIME_OF_DAY, LiteralKind.DATE_AND_TIME: DATE_AND_TIME}
_NOT_KEPT = (VarKind.TEMP, VarKind.EXTERNAL)
_DIRECT = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD, "L": LWORD}


class ExpressionChecker(OperatorChecker):
    """Finds the type of every expression in the scope `symbols`."""

    def __init__(self, library: Library, report: Report) -> None:
        """Check against these declarations."""
        super().__init__(report)
        self.library = library
        self.symbols: dict[str, VarDecl] = {}

    def infer(self, value: Expression) -> Type:
        """The type of an expression, left in its slot; a number without prefix may still be untyped."""
        made: Type = _HANDLERS[type(value)](self, value)
        value.type = made
        return made

    def wanted(self, value: Expression, wanted: Type) -> None:
        """Check an expression that must be of the type `wanted`."""
        self.infer(value)
        self.fits(value, wanted)

    def literal(self, value: Literal) -> Type:
        """A literal: of its prefix, or of its kind."""
        fixed = _FIXED_LITERALS.get(value.kind)
        if fixed is not None:
            return fixed
        if value.prefix is None:
            return untyped_of(value.kind)
        made = ELEMENTARY[value.prefix]
        self.within(value, made)
        return made

    def name(self, value: Name) -> Type:
        """A variable or an enumerated value."""
        symbol = self.symbols.get(value.name.upper())
        if symbol is not None:
            value.symbol = symbol
            return symbol.type
        values = self.library.enum_values.get(value.name.upper())
        if values:
            value.symbol = values[0]
            if len(values) > 1:
                owners = " and ".join(each.type.name for each in values)
                text = f"{value.name} is a value of {owners}: use names that differ"
                self.report.add(value.at, "ambiguous-name", text)
            return values[0].type
        return self.unknown_name(value)

    def unknown_name(self, value: Name) -> Type:
        """Tell of a name that is declared nowhere here."""
        upper = value.name.upper()
        variable = self.library.global_variables.get(upper)
        if variable is not None:
            text = f"{value.name} is a global variable: declare it in a VAR_EXTERNAL of this block, or pass it"
            self.report.add(value.at, "global-variable", text)
            value.symbol = variable
            return variable.type
        found = self.library.find(upper)
        if found is not None:
            text = f"expected a variable, found the {type(found).__name__.lower()} {value.name}"
            self.report.add(value.at, "undeclared-name", text)
            return UNKNOWN
        known = [each.name for each in self.symbols.values()]
        hint = nearest(value.name, known)
        self.report.add(value.at, "undeclared-name", f"expected a declared variable, found {value.name}{hint}")
        return UNKNOWN

    def qualified(self, value: Qualified) -> Type:
        """`E#V`."""
        found = self.library.find(value.type_name)
        enum = found.type if isinstance(found, TypeDecl) else UNKNOWN
        return self.enum_value(value, enum, value.type_name, value.name)

    def enum_value(self, value: Qualified | Member, enum: Type, type_name: str, name: str) -> Type:
        """A value of a named enumeration."""
        if not isinstance(enum, Enum):
            text = f"expected an enumeration before {name}, found {type_name}"
            self.report.add(value.at, "undeclared-name", text)
            return UNKNOWN
        value.symbol = enum.values.get(name.upper())
        if value.symbol is None:
            hint = nearest(name, [each.name for each in enum.values.values()])
            self.report.add(value.at, "undeclared-name", f"expected a value of {enum}, found {name}{hint}")
        return enum

    def member(self, value: Member) -> Type:
        """A field, or a variable of an instance."""
        if isinstance(value.base, Name) and value.base.name.upper() not in self.symbols:
            found = self.library.find(value.base.name)
            if isinstance(found, TypeDecl):
                return self.enum_value(value, found.type, value.base.name, value.name)
        base = self.infer(value.base)
        upper = value.name.upper()
        if isinstance(base, Struct):
            value.symbol = base.fields.get(upper)
            known = [each.name for each in base.fields.values()]
        elif isinstance(base, Block):
            value.symbol = self.block_variable(base, upper)
            known = [each.name for each in base.parameters.values()]
            if isinstance(value.symbol, VarDecl) and value.symbol.kind in _NOT_KEPT:
                text = f"{value.name} is no part of an instance of {base}, being a {value.symbol.kind.value}"
                self.report.add(value.at, "undeclared-name", f"{text}: make it a VAR_OUTPUT")
                return UNKNOWN
        else:
            if base is not UNKNOWN:
                text = f"expected a structure or block before .{value.name}, found {base}"
                self.report.add(value.at, "type-mismatch", text)
            return UNKNOWN
        if value.symbol is None:
            text = f"expected a member of {base}, found {value.name}{nearest(value.name, known)}"
            self.report.add(value.at, "undeclared-name", text)
            return UNKNOWN
        return UNKNOWN if isinstance(value.symbol, EnumValue) else value.symbol.type

    @staticmethod
    def block_variable(block: Block, upper: str) -> Any:
        """A variable of a block: its declaration, or the parameter of a standard block."""
        if block.declaration is not None:
            return block.declaration.symbols.get(upper)
        return block.parameters.get(upper)

    def index(self, value: Index) -> Type:
        """An element of an array."""
        base = self.infer(value.base)
        for each in value.indices:
            self.index_type(each)
        if not isinstance(base, Array):
            if base is not UNKNOWN:
                what = "a string has no elements" if base.kind is Kind.STRING else f"found {base}"
                rule = "string-index" if base.kind is Kind.STRING else "type-mismatch"
                self.report.add(value.at, rule, f"expected an array before [, {what}")
            return UNKNOWN
        if len(value.indices) != len(base.bounds):
            text = f"expected {len(base.bounds)} indices, found {len(value.indices)}"
            self.report.add(value.at, "type-mismatch", text)
        for each, bounds in zip(value.indices, base.bounds, strict=False):
            self.index_range(each, bounds)
        return base.element

    def index_type(self, value: Expression) -> None:
        """An index is an integer."""
        if untyped(self.infer(value)):
            self.choose(value)
        kind = value.type.kind
        if kind is Kind.BITS:
            text = f"expected an integer as index, found {value.type}: write {plain(value.type).name}_TO_UINT(...)"
            self.report.add(value.at, "implicit-conversion", text)
        elif kind is not Kind.INTEGER and value.type is not UNKNOWN:
            self.report.add(value.at, "type-mismatch", f"expected an integer as index, found {value.type}")

    def index_range(self, value: Expression, bounds: tuple[int, int]) -> None:
        """Tell of a constant index outside the bounds."""
        found = fold(value, self.constant)
        if found is not None and not bounds[0] <= found <= bounds[1]:
            text = f"expected an index within {bounds[0]}..{bounds[1]}, found {found}"
            self.report.add(value.at, "index-range", text)

    def constant(self, name: str) -> Expression | None:
        """The initial value of a constant in scope."""
        symbol = self.symbols.get(name.upper())
        return symbol.initial if symbol is not None and symbol.constant else None

    def bit_access(self, value: BitAccess) -> Type:
        """`w.3`."""
        base = self.infer(value.base)
        made = _DIRECT[value.unit]
        if base is UNKNOWN:
            return made
        if not isinstance(base, Elementary) or base.kind not in (Kind.BITS, Kind.INTEGER):
            text = f"expected a bit string before .{value.number}, found {base}"
            self.report.add(value.at, "type-mismatch", text)
            return made
        if (value.number + 1) * made.width > base.width:
            text = f"expected a number within {base}, found .{value.number}"
            self.report.add(value.at, "literal-range", text)
        self.report.add(value.at, "bit-access", _bit_text(value, base, made))
        return made

    def dereference(self, value: Dereference) -> Type:
        """`p^`."""
        base = self.infer(value.base)
        self.report.add(value.at, "pointer", "^ is not in the second edition: pass a VAR_IN_OUT instead")
        return base.target if isinstance(base, Pointer) else UNKNOWN

    def direct(self, value: Direct) -> Type:
        """`%IX0.0`."""
        text = f"{value.text} ties the text to one machine: pass the value through a parameter"
        self.report.add(value.at, "direct-address", text)
        letter = value.text[2:3].upper()
        return _DIRECT.get(letter, BOOL if letter.isdigit() else UNKNOWN)

    def call(self, value: Call) -> Type:
        """Defined by the checker of calls."""
        raise NotImplementedError

    def misplaced(self, value: Expression) -> Type:
        """An initialiser where an expression is wanted."""
        self.report.add(
            value.at, "type-mismatch", "expected an expression, found the initial value of an array or structure"
        )
        return UNKNOWN

    def instance_of(self, value: Expression) -> VarDecl | None:
        """The variable that an expression is a part of; None for anything that is no variable."""
        value = self.outermost(value)
        symbol = value.symbol if isinstance(value, Name) else None
        return symbol if isinstance(symbol, VarDecl) else None

    @staticmethod
    def outermost(value: Expression) -> Expression:
        """What an expression is a part of."""
        while isinstance(value, Member | Index | BitAccess):
            value = value.base
        return value

    def assignable(self, value: Expression, what: str) -> None:
        """Tell if an expression, whose type is known, is nothing that can be written to."""
        if isinstance(self.outermost(value), Direct | Dereference):
            return
        root = self.instance_of(value)
        if root is None:
            if value.type is not UNKNOWN or not isinstance(value, Name | Member | Index | BitAccess):
                self.report.add(value.at, "not-assignable", f"expected a variable {what}")
            return
        if root.constant:
            self.report.add(value.at, "not-assignable", f"expected a variable {what}, found the constant {root.name}")
        elif value.type.kind is Kind.BLOCK or value.type is VOID:
            self.report.add(value.at, "not-assignable", f"expected a variable {what}, found the block {root.name}")
        self.output_of_instance(value, what)

    def output_of_instance(self, value: Expression, what: str) -> None:
        """Tell of a write to an output of another block."""
        while isinstance(value, Member | Index | BitAccess):
            if isinstance(value, Member) and isinstance(value.base.type, Block):
                parameter = value.base.type.parameters.get(value.name.upper())
                if parameter is None or parameter.direction.value != VarKind.INPUT.value:
                    text = f"expected a variable {what}, found {value.name} of a block: only its inputs can be written"
                    self.report.add(value.at, "write-to-output", text)
            value = value.base


def _bit_text(value: BitAccess, base: Elementary, made: Elementary) -> str:
    """What to write instead of a bit access."""
    name = plain(base).name
    if made is BOOL and base.kind is Kind.BITS:
        mask = f"{name}#16#{1 << value.number:0{base.width // 4}X}" if value.number < base.width else "mask"
        return f".{value.number} is refused by matiec: write (x AND {mask}) <> {name}#0"
    return f".{value.number} is refused by matiec: use SHR and a mask"


_HANDLERS: dict[type[Expression], Callable[[ExpressionChecker, Any], Type]] = {
    Literal: ExpressionChecker.literal,
    Name: ExpressionChecker.name,
    Qualified: ExpressionChecker.qualified,
    Member: ExpressionChecker.member,
    Index: ExpressionChecker.index,
    BitAccess: ExpressionChecker.bit_access,
    Dereference: ExpressionChecker.dereference,
    Direct: ExpressionChecker.direct,
    Unary: ExpressionChecker.unary,
    Binary: ExpressionChecker.binary,
    Call: lambda checker, value: checker.call(value),
    Repeat: ExpressionChecker.misplaced,
    ArrayInitial: ExpressionChecker.misplaced,
    StructInitial: ExpressionChecker.misplaced,
}
