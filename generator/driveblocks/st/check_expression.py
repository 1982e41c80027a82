"""The types of expressions (clause 3.3.1): operands of one type, nothing converted by itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from driveblocks.st.check_value import ValueChecker, untyped_of
from driveblocks.st.library import Library, fold
from driveblocks.st.report import Report, nearest
from driveblocks.st.tree import (
    ArrayInitial,
    Binary,
    BitAccess,
    Call,
    Dereference,
    Direct,
    Expression,
    Index,
    Literal,
    LiteralKind,
    Member,
    Name,
    Qualified,
    Repeat,
    StructInitial,
    TypeDecl,
    Unary,
    VarDecl,
    VarKind,
)
from driveblocks.st.types import (
    ANY_BIT,
    ANY_COMPARABLE,
    ANY_INT,
    ANY_NUM,
    BOOL,
    BYTE,
    DATE,
    DATE_AND_TIME,
    DWORD,
    ELEMENTARY,
    LWORD,
    REAL,
    STRING,
    TIME,
    TIME_OF_DAY,
    UNKNOWN,
    UNTYPED_INTEGER,
    UNTYPED_REAL,
    VOID,
    WORD,
    WSTRING,
    Array,
    Block,
    Elementary,
    Enum,
    EnumValue,
    Kind,
    Pointer,
    Struct,
    Type,
    plain,
    same,
    untyped,
)

_COMPARISONS = frozenset(["=", "<>", "<", ">", "<=", ">="])
_FIXED_LITERALS = {LiteralKind.BOOL: BOOL, LiteralKind.STRING: STRING, LiteralKind.WSTRING: WSTRING}
_FIXED_LITERALS |= {LiteralKind.TIME: TIME, LiteralKind.DATE: DATE}
_FIXED_LITERALS |= {LiteralKind.TIME_OF_DAY: TIME_OF_DAY, LiteralKind.DATE_AND_TIME: DATE_AND_TIME}
_DIRECT = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD, "L": LWORD}
_KINDS_OF = {"AND": ANY_BIT, "OR": ANY_BIT, "XOR": ANY_BIT, "MOD": ANY_INT}
_MOMENTS = frozenset([Kind.TIME, Kind.DATE, Kind.TIME_OF_DAY, Kind.DATE_AND_TIME])
# What + and - make of moments and durations (table 30).
_TIMES: dict[tuple[str, Type, Type], Type] = {
    ("+", TIME, TIME): TIME,
    ("-", TIME, TIME): TIME,
    ("+", TIME_OF_DAY, TIME): TIME_OF_DAY,
    ("-", TIME_OF_DAY, TIME): TIME_OF_DAY,
    ("-", TIME_OF_DAY, TIME_OF_DAY): TIME,
    ("+", DATE_AND_TIME, TIME): DATE_AND_TIME,
    ("-", DATE_AND_TIME, TIME): DATE_AND_TIME,
    ("-", DATE_AND_TIME, DATE_AND_TIME): TIME,
    ("-", DATE, DATE): TIME,
}


class ExpressionChecker(ValueChecker):
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

    def of_kind(self, value: Expression, kinds: frozenset[Kind], what: str) -> Type:
        """Check an expression that must be of one of these kinds."""
        self.infer(value)
        if untyped(value.type):
            self.settle(value, self.default(value))
        if value.type.kind not in kinds and value.type is not UNKNOWN:
            self.report.add(value.at, "type-mismatch", f"expected {what}, found {value.type}")
        return value.type

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
        kind = self.infer(value).kind
        if untyped(value.type):
            self.settle(value, self.default(value))
        elif kind is Kind.BITS:
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

    def unary(self, value: Unary) -> Type:
        """`-x`, `+x`, `NOT x`."""
        inner = self.infer(value.operand)
        if value.op == "NOT":
            if untyped(inner):
                self.settle(value.operand, self.default(value.operand))
                inner = value.operand.type
            return self.operand(value.operand, ANY_BIT, "NOT", inner)
        if untyped(inner):
            return inner
        if value.op == "-" and isinstance(inner, Elementary) and inner.kind is Kind.INTEGER and not inner.signed:
            self.report.add(value.at, "type-mismatch", f"expected a signed number behind -, found {inner}")
            return UNKNOWN
        return self.operand(value.operand, ANY_NUM | {Kind.TIME}, value.op, inner)

    def operand(self, value: Expression, kinds: frozenset[Kind], op: str, have: Type) -> Type:
        """Tell if an operator cannot take this type; the type of its result."""
        if have is UNKNOWN or have.kind in kinds:
            return plain(have)
        if have.kind is Kind.POINTER:
            return UNKNOWN
        if have.kind is Kind.BITS and Kind.INTEGER in kinds:
            name = plain(have).name
            text = f"expected a number for {op}, found {have}: write {name}_TO_U{'S' if name == 'BYTE' else ''}INT(...)"
            self.report.add(value.at, "bit-string-arithmetic", text)
        elif have.kind is Kind.INTEGER and Kind.BITS in kinds:
            text = f"expected a bit string for {op}, found {have}: write {conversion_to_bits(have)}(...)"
            self.report.add(value.at, "implicit-conversion", text)
        else:
            shown = "a bit string" if Kind.BITS in kinds else "a number" if Kind.INTEGER in kinds else "another type"
            self.report.add(value.at, "type-mismatch", f"expected {shown} for {op}, found {have}")
        return UNKNOWN

    def binary(self, value: Binary) -> Type:
        """Two operands."""
        left, right = self.infer(value.left), self.infer(value.right)
        if UNKNOWN in (left, right):
            for each in (value.left, value.right):
                self.settle(each, UNKNOWN)
            return BOOL if value.op in _COMPARISONS else UNKNOWN
        if value.op in _COMPARISONS:
            return self.comparison(value, left, right)
        if value.op == "**":
            return self.power(value)
        if self.about_time(value.op, left, right):
            return self.time_arithmetic(value)
        return self.joined(value, _KINDS_OF.get(value.op, ANY_NUM))

    @staticmethod
    def about_time(op: str, left: Type, right: Type) -> bool:
        """Whether an operator works on durations or moments."""
        if op not in ("+", "-", "*", "/"):
            return False
        return bool(_MOMENTS & {left.kind, right.kind})

    def joined(self, value: Binary, kinds: frozenset[Kind]) -> Type:
        """Both operands of one type out of `kinds`; that type is the result's."""
        shared = self.shared(value)
        if shared is UNKNOWN:
            return UNKNOWN
        if untyped(shared):
            if Kind.BITS not in kinds:
                self.zero_divisor(value)
                return shared
            shared = self.default(value.left)
        for each in (value.left, value.right):
            self.fits(each, shared)
        self.zero_divisor(value)
        value.operand_type = shared
        return self.operand(value.left, kinds, value.op, shared)

    def shared(self, value: Binary) -> Type:
        """The type that both operands can have; UNKNOWN, and told, if there is none."""
        left, right = value.left.type, value.right.type
        if untyped(left) and untyped(right):
            if left is not right:
                self.mixed(value)
                return UNKNOWN
            return left
        if untyped(left) or untyped(right):
            return plain(right if untyped(left) else left)
        if same(left, right):
            return plain(left)
        self.unlike(value)
        return UNKNOWN

    def mixed(self, value: Binary) -> None:
        """Tell of an integer beside a real, both without prefix."""
        integer = value.left if value.left.type is UNTYPED_INTEGER else value.right
        for each in (value.left, value.right):
            self.settle(each, REAL)
        if not isinstance(integer, Literal):
            self.report.add(value.at, "type-mismatch", f"expected reals on both sides of {value.op}, found an integer")

    def unlike(self, value: Binary) -> None:
        """Tell of operands of two types."""
        left, right = value.left.type, value.right.type
        if UNKNOWN in (left, right) or Kind.POINTER in (left.kind, right.kind):
            return
        if left.kind in ANY_NUM | ANY_BIT and right.kind in ANY_NUM | ANY_BIT:
            text = f"expected operands of one type for {value.op}, found {left} and {right}: convert one explicitly"
            self.report.add(value.at, "implicit-conversion", text)
        else:
            text = f"expected operands of one type for {value.op}, found {left} and {right}"
            self.report.add(value.at, "type-mismatch", text)

    def zero_divisor(self, value: Binary) -> None:
        """Tell of a division by a constant zero."""
        if value.op in ("/", "MOD") and isinstance(value.right, Literal) and value.right.value == 0:
            self.report.add(value.right.at, "literal-range", f"expected a divisor other than 0 for {value.op}")

    def comparison(self, value: Binary, left: Type, right: Type) -> Type:
        """Both operands of one elementary type; enumerations only for `=` and `<>`."""
        shared = self.shared(value)
        if untyped(shared):
            shared = max((self.default(value.left), self.default(value.right)), key=lambda each: each.size)
        if shared is UNKNOWN:
            for each in (value.left, value.right):
                self.settle(each, UNKNOWN)
            return BOOL
        for each in (value.left, value.right):
            self.fits(each, shared)
        value.operand_type = shared
        ordered = value.op not in ("=", "<>")
        if left.kind is not Kind.NONE and left.kind not in ANY_COMPARABLE:
            self.report.add(
                value.at, "type-mismatch", f"expected values of elementary types for {value.op}, found {left}"
            )
        elif ordered and Kind.ENUM in (left.kind, right.kind):
            self.report.add(value.at, "type-mismatch", f"expected = or <> for values of {left}, found {value.op}")
        return BOOL

    def power(self, value: Binary) -> Type:
        """`x ** n`: a real base, any number as exponent."""
        if untyped(value.right.type):
            self.settle(value.right, self.default(value.right))
        self.operand(value.right, ANY_NUM, "**", value.right.type)
        if value.left.type is UNTYPED_REAL:
            return UNTYPED_REAL
        self.settle(value.left, REAL)
        base = value.left.type
        value.operand_type = base
        if base.kind is not Kind.REAL and base is not UNKNOWN:
            self.report.add(value.left.at, "type-mismatch", f"expected REAL or LREAL before **, found {base}")
            return UNKNOWN
        return base

    def time_arithmetic(self, value: Binary) -> Type:
        """Durations and moments, by table 30."""
        left, right = value.left, value.right
        made = _TIMES.get((value.op, plain(left.type), plain(right.type)))
        if value.op in ("*", "/") and left.type is TIME:
            self.settle(right, self.default(right))
            made = TIME if right.type.kind in ANY_NUM else None
        elif value.op == "*" and right.type is TIME:
            self.settle(left, self.default(left))
            made = TIME if left.type.kind in ANY_NUM else None
        value.operand_type = plain(left.type)
        if made is None:
            for each in (left, right):
                self.settle(each, UNKNOWN)
            text = f"{value.op} is not defined for {left.type} and {right.type}"
            self.report.add(value.at, "type-mismatch", text)
            return UNKNOWN
        return made

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


def conversion_to_bits(have: Type) -> str:
    """The function that makes a bit string of the same width from an integer."""
    width = have.width if isinstance(have, Elementary) else 16
    return f"{plain(have).name}_TO_{ {8: 'BYTE', 16: 'WORD', 32: 'DWORD'}.get(width, 'LWORD') }"


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
