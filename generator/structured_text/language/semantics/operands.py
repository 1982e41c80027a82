"""The types of expressions (clause 3.3.1): operands of one type, nothing converted by itself."""

from typing import Any

from structured_text.language import tree
from structured_text.language.library import fold
from structured_text.language.report import nearest
from structured_text.language.semantics.scope import Scope, infer
from structured_text.language.semantics.values import choose, untyped_of, within
from structured_text.language.types import (
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
    WORD,
    WSTRING,
    Elementary,
    Kind,
    Pointer,
    Type,
    plain,
    untyped,
)

_FIXED_LITERALS = {tree.LiteralKind.BOOL: BOOL, tree.LiteralKind.STRING: STRING, tree.LiteralKind.WSTRING: WSTRING}
_FIXED_LITERALS |= {tree.LiteralKind.TIME: TIME, tree.LiteralKind.DATE: DATE}
_FIXED_LITERALS |= {tree.LiteralKind.TIME_OF_DAY: TIME_OF_DAY, tree.LiteralKind.DATE_AND_TIME: DATE_AND_TIME}
_NOT_KEPT = (tree.VarKind.TEMP, tree.VarKind.EXTERNAL)
_DIRECT = {"X": BOOL, "B": BYTE, "W": WORD, "D": DWORD, "L": LWORD}


def literal(scope: Scope, value: tree.Literal) -> Type:
    """A literal: of its prefix, or of its kind."""
    fixed = _FIXED_LITERALS.get(value.kind)
    if fixed is not None:
        return fixed
    if value.prefix is None:
        return untyped_of(value.kind)
    made = ELEMENTARY[value.prefix]
    within(scope.report, value, made)
    return made


def name(scope: Scope, value: tree.Name) -> Type:
    symbol = scope.symbols.get(value.name.upper())
    if symbol is not None:
        value.symbol = symbol
        return symbol.type
    values = scope.library.enum_values.get(value.name.upper())
    if values:
        value.symbol = values[0]
        if len(values) > 1:
            owners = " and ".join(each.type.name for each in values)
            text = f"{value.name} is a value of {owners}: use names that differ"
            scope.report.add(value.at, "ambiguous-name", text)
        return values[0].type
    return _unknown_name(scope, value)


def _unknown_name(scope: Scope, value: tree.Name) -> Type:
    """Report a name that is declared nowhere here."""
    upper = value.name.upper()
    variable = scope.library.global_variables.get(upper)
    if variable is not None:
        text = f"{value.name} is a global variable: declare it in a VAR_EXTERNAL of this block, or pass it"
        scope.report.add(value.at, "global-variable", text)
        value.symbol = variable
        return variable.type
    found = scope.library.find(upper)
    if found is not None:
        text = f"expected a variable, found the {type(found).__name__.lower()} {value.name}"
        scope.report.add(value.at, "undeclared-name", text)
        return UNKNOWN
    known = [each.name for each in scope.symbols.values()]
    hint = nearest(value.name, known)
    scope.report.add(value.at, "undeclared-name", f"expected a declared variable, found {value.name}{hint}")
    return UNKNOWN


def qualified(scope: Scope, value: tree.Qualified) -> Type:
    """`E#V`."""
    found = scope.library.find(value.type_name)
    enum = found.type if isinstance(found, tree.TypeDecl) else UNKNOWN
    return _enum_value(scope, value, enum, value.type_name, value.name)


def _enum_value(scope: Scope, value: tree.Qualified | tree.Member, enum: Type, type_name: str, name: str) -> Type:
    """A value of a named enumeration."""
    if not isinstance(enum, tree.Enum):
        text = f"expected an enumeration before {name}, found {type_name}"
        scope.report.add(value.at, "undeclared-name", text)
        return UNKNOWN
    value.symbol = enum.values.get(name.upper())
    if value.symbol is None:
        hint = nearest(name, [each.name for each in enum.values.values()])
        scope.report.add(value.at, "undeclared-name", f"expected a value of {enum}, found {name}{hint}")
    return enum


def member(scope: Scope, value: tree.Member) -> Type:
    if isinstance(value.base, tree.Name) and value.base.name.upper() not in scope.symbols:
        found = scope.library.find(value.base.name)
        if isinstance(found, tree.TypeDecl):
            return _enum_value(scope, value, found.type, value.base.name, value.name)
    base = infer(scope, value.base)
    upper = value.name.upper()
    if isinstance(base, tree.Struct):
        value.symbol = base.fields.get(upper)
        known = [each.name for each in base.fields.values()]
    elif isinstance(base, tree.Block):
        value.symbol = block_variable(base, upper)
        known = [each.name for each in base.parameters.values()]
        if isinstance(value.symbol, tree.VarDecl) and value.symbol.kind in _NOT_KEPT:
            text = f"{value.name} is no part of an instance of {base}, being a {value.symbol.kind.value}"
            scope.report.add(value.at, "undeclared-name", f"{text}: make it a VAR_OUTPUT")
            return UNKNOWN
    else:
        if base is not UNKNOWN:
            text = f"expected a structure or block before .{value.name}, found {base}"
            scope.report.add(value.at, "type-mismatch", text)
        return UNKNOWN
    if value.symbol is None:
        text = f"expected a member of {base}, found {value.name}{nearest(value.name, known)}"
        scope.report.add(value.at, "undeclared-name", text)
        return UNKNOWN
    return UNKNOWN if isinstance(value.symbol, tree.EnumValue) else value.symbol.type


def block_variable(block: tree.Block, upper: str) -> Any:
    """A variable of a block: its declaration, or the parameter of a standard block."""
    if block.declaration is not None:
        return block.declaration.symbols.get(upper)
    return block.parameters.get(upper)


def index(scope: Scope, value: tree.Index) -> Type:
    base = infer(scope, value.base)
    for each in value.indices:
        _index_type(scope, each)
    if not isinstance(base, tree.Array):
        if base is not UNKNOWN:
            what = "a string has no elements" if base.kind is Kind.STRING else f"found {base}"
            rule = "string-index" if base.kind is Kind.STRING else "type-mismatch"
            scope.report.add(value.at, rule, f"expected an array before [, {what}")
        return UNKNOWN
    if len(value.indices) != len(base.bounds):
        text = f"expected {len(base.bounds)} indices, found {len(value.indices)}"
        scope.report.add(value.at, "type-mismatch", text)
    for each, bounds in zip(value.indices, base.bounds, strict=False):
        _index_range(scope, each, bounds)
    return base.element


def _index_type(scope: Scope, value: tree.Expression) -> None:
    """An index is an integer."""
    if untyped(infer(scope, value)):
        choose(scope.report, value)
    kind = value.type.kind
    if kind is Kind.BITS:
        text = f"expected an integer as index, found {value.type}: write {plain(value.type).name}_TO_UINT(...)"
        scope.report.add(value.at, "implicit-conversion", text)
    elif kind is not Kind.INTEGER and value.type is not UNKNOWN:
        scope.report.add(value.at, "type-mismatch", f"expected an integer as index, found {value.type}")


def _index_range(scope: Scope, value: tree.Expression, bounds: tuple[int, int]) -> None:
    """Report a constant index outside the bounds."""
    found = fold(value, scope.constant)
    if found is not None and not bounds[0] <= found <= bounds[1]:
        text = f"expected an index within {bounds[0]}..{bounds[1]}, found {found}"
        scope.report.add(value.at, "index-range", text)


def bit_access(scope: Scope, value: tree.BitAccess) -> Type:
    """`w.3`."""
    base = infer(scope, value.base)
    made = _DIRECT[value.unit]
    if base is UNKNOWN:
        return made
    if not isinstance(base, Elementary) or base.kind not in (Kind.BITS, Kind.INTEGER):
        text = f"expected a bit string before .{value.number}, found {base}"
        scope.report.add(value.at, "type-mismatch", text)
        return made
    if (value.number + 1) * made.width > base.width:
        text = f"expected a number within {base}, found .{value.number}"
        scope.report.add(value.at, "literal-range", text)
    scope.report.add(value.at, "bit-access", _bit_text(value, base, made))
    return made


def dereference(scope: Scope, value: tree.Dereference) -> Type:
    """`p^`."""
    base = infer(scope, value.base)
    scope.report.add(value.at, "pointer", "^ is not in the second edition: pass a VAR_IN_OUT instead")
    return base.target if isinstance(base, Pointer) else UNKNOWN


def direct(scope: Scope, value: tree.Direct) -> Type:
    """`%IX0.0`."""
    text = f"{value.text} ties the text to one machine: pass the value through a parameter"
    scope.report.add(value.at, "direct-address", text)
    letter = value.text[2:3].upper()
    return _DIRECT.get(letter, BOOL if letter.isdigit() else UNKNOWN)


def misplaced(scope: Scope, value: tree.Expression) -> Type:
    """An initialiser where an expression is wanted."""
    scope.report.add(
        value.at, "type-mismatch", "expected an expression, found the initial value of an array or structure"
    )
    return UNKNOWN


def _bit_text(value: tree.BitAccess, base: Elementary, made: Elementary) -> str:
    """What to write instead of a bit access."""
    name = plain(base).name
    if made is BOOL and base.kind is Kind.BITS:
        mask = f"{name}#16#{1 << value.number:0{base.width // 4}X}" if value.number < base.width else "mask"
        return f".{value.number} is refused by matiec: write (x AND {mask}) <> {name}#0"
    return f".{value.number} is refused by matiec: use SHR and a mask"
