"""Calls (clauses 2.5.1, 2.5.2, 3.3.2.2): which function or block is meant."""

from structured_text.language.report import nearest
from structured_text.language.semantics.arguments import bind, infer_argument
from structured_text.language.semantics.functions import standard_call, type_conversion
from structured_text.language.semantics.scope import Scope, infer
from structured_text.language.standard import BLOCKS, FUNCTIONS, Conversion, conversion_of
from structured_text.language.tree import Block, Call, Function, FunctionBlock, Name
from structured_text.language.types import UNKNOWN, UNTYPED_INTEGER, VOID, Kind, Type

# What dialects take addresses and sizes with.
_ADDRESSES = frozenset(["ADR", "ADRINST", "BITADR", "REF", "SIZEOF", "INDEXOF"])


def call_type(scope: Scope, value: Call, statement: bool = False) -> Type:
    """The type of a call; VOID for a block, which only a statement may invoke."""
    callee = value.callee
    name = callee.name.upper() if isinstance(callee, Name) else ""
    symbol = scope.symbols.get(name)
    if not name or (symbol is not None and symbol.type.kind is Kind.BLOCK):
        return _invoke(scope, value, statement)
    found = scope.library.find(name)
    if isinstance(found, Function):
        return _function(scope, value, found)
    if name in FUNCTIONS:
        return standard_call(scope, value, name, FUNCTIONS[name])
    converted = conversion_of(name) or (Conversion("TRUNC", None, UNTYPED_INTEGER) if name == "TRUNC" else None)
    if converted is not None:
        return type_conversion(scope, value, name, converted)
    return _unknown_callee(scope, value, name)


def _unknown_callee(scope: Scope, value: Call, name: str) -> Type:
    """Report a name that cannot be called."""
    for each in value.arguments:
        infer_argument(scope, each)
    found = scope.library.find(name)
    symbol = scope.symbols.get(name)
    shown = value.callee.name if isinstance(value.callee, Name) else name
    if symbol is not None:
        if symbol.type is not UNKNOWN:
            text = f"expected a function or block instance, found the variable {shown}"
            scope.report.add(value.at, "type-mismatch", text)
    elif name in _ADDRESSES:
        text = f"{name} is not in the second edition: pass a VAR_IN_OUT, and sizes as inputs"
        scope.report.add(value.at, "pointer", text)
    elif isinstance(found, FunctionBlock) or name in BLOCKS:
        text = f"expected an instance, found the block type {shown}: declare a variable of it and call that"
        scope.report.add(value.at, "undeclared-name", text)
    else:
        functions = [named.name for named, _ in scope.library.names.values() if isinstance(named, Function)]
        hint = nearest(shown, [*functions, *FUNCTIONS, *(each.name for each in scope.symbols.values())])
        scope.report.add(value.at, "undeclared-name", f"expected a function or instance, found {shown}{hint}")
    return UNKNOWN


def _invoke(scope: Scope, value: Call, statement: bool) -> Type:
    have = infer(scope, value.callee)
    if not isinstance(have, Block):
        for each in value.arguments:
            infer_argument(scope, each)
        if have is not UNKNOWN:
            scope.report.add(value.at, "type-mismatch", f"expected a function or block instance, found {have}")
        return UNKNOWN
    value.target = have
    bind(scope, value, list(have.parameters.values()), have.name)
    if not statement:
        scope.report.add(value.at, "type-mismatch", "expected a value, found the invocation of a block")
        return UNKNOWN
    return VOID


def _function(scope: Scope, value: Call, found: Function) -> Type:
    """A function in ST."""
    value.target = found
    scope.called.add(found.name.upper())
    bind(scope, value, list(found.parameters.values()), found.name)
    return found.type
