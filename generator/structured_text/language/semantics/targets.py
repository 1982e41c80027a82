"""What can be written to, and what an expression is a part of."""

from structured_text.language import tree
from structured_text.language.semantics.scope import Scope
from structured_text.language.types import UNKNOWN, VOID, Kind


def _instance_of(value: tree.Expression) -> tree.VarDecl | None:
    """The variable that an expression is a part of; None for anything that is no variable."""
    value = _outermost(value)
    symbol = value.symbol if isinstance(value, tree.Name) else None
    return symbol if isinstance(symbol, tree.VarDecl) else None


def _outermost(value: tree.Expression) -> tree.Expression:
    """What an expression is a part of."""
    while isinstance(value, tree.Member | tree.Index | tree.BitAccess):
        value = value.base
    return value


def assignable(scope: Scope, value: tree.Expression, what: str) -> None:
    """Note that an expression, whose type is known, is written to; report it if it cannot be."""
    if isinstance(_outermost(value), tree.Direct | tree.Dereference):
        return
    root = _instance_of(value)
    if root is not None:
        scope.written.add(root.name.upper())
        _writable(scope, value, root, what)
    elif value.type is not UNKNOWN or not isinstance(value, tree.Name | tree.Member | tree.Index | tree.BitAccess):
        scope.report.add(value.at, "not-assignable", f"expected a variable {what}")


def _writable(scope: Scope, value: tree.Expression, root: tree.VarDecl, what: str) -> None:
    """Report a part of the variable `root` that cannot be written to."""
    if root.constant:
        scope.report.add(value.at, "not-assignable", f"expected a variable {what}, found the constant {root.name}")
    elif value.type.kind is Kind.BLOCK or value.type is VOID:
        scope.report.add(value.at, "not-assignable", f"expected a variable {what}, found the block {root.name}")
    _output_of_instance(scope, value, what)


def _output_of_instance(scope: Scope, value: tree.Expression, what: str) -> None:
    """Report a write to an output of another block."""
    while isinstance(value, tree.Member | tree.Index | tree.BitAccess):
        if isinstance(value, tree.Member) and isinstance(value.base.type, tree.Block):
            parameter = value.base.type.parameters.get(value.name.upper())
            if parameter is None or parameter.direction.value != tree.VarKind.INPUT.value:
                text = f"expected a variable {what}, found {value.name} of a block: only its inputs can be written"
                scope.report.add(value.at, "write-to-output", text)
        value = value.base
