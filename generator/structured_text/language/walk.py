"""Every node of a POU's statements, handed to whoever asked for its kind."""

from collections.abc import Callable, Iterator
from typing import Any

from structured_text.language import tree


def statements(body: list[tree.Statement]) -> Iterator[tree.Statement]:
    """Every statement, those inside others too, in source order."""
    stack = list(reversed(body))
    while stack:
        statement = stack.pop()
        yield statement
        for inner in reversed(bodies(statement)):
            stack.extend(reversed(inner))


def bodies(statement: tree.Statement) -> list[list[tree.Statement]]:
    """The lists of statements directly inside a statement."""
    if isinstance(statement, tree.If):
        made = [branch.body for branch in statement.branches]
        return [*made, statement.otherwise] if statement.otherwise is not None else made
    if isinstance(statement, tree.Case):
        made = [branch.body for branch in statement.branches]
        return [*made, statement.otherwise] if statement.otherwise is not None else made
    return [statement.body] if isinstance(statement, tree.For | tree.While | tree.RepeatUntil) else []


def heads(statement: tree.Statement) -> list[tree.Expression]:
    """The expressions directly in a statement, without those of the statements inside it."""
    if isinstance(statement, tree.Assign):
        return [statement.target, statement.value]
    if isinstance(statement, tree.CallStatement):
        return [statement.call]
    if isinstance(statement, tree.If):
        return [branch.condition for branch in statement.branches]
    if isinstance(statement, tree.Case):
        return [statement.selector, *_labels(statement)]
    return _loop_heads(statement)


def _labels(statement: tree.Case) -> list[tree.Expression]:
    made: list[tree.Expression] = []
    for branch in statement.branches:
        for label in branch.labels:
            made += [label.low, label.high] if isinstance(label, tree.LabelRange) else [label]
    return made


def _loop_heads(statement: tree.Statement) -> list[tree.Expression]:
    if isinstance(statement, tree.While | tree.RepeatUntil):
        return [statement.condition]
    if isinstance(statement, tree.For):
        made = [statement.variable, statement.start, statement.stop]
        return [*made, statement.step] if statement.step is not None else made
    return [statement.value] if isinstance(statement, tree.Return) and statement.value is not None else []


def children(value: tree.Expression) -> list[tree.Expression]:
    """The expressions directly inside an expression."""
    find = _CHILDREN.get(type(value))
    return find(value) if find is not None else []


def _call(value: tree.Call) -> list[tree.Expression]:
    return [value.callee, *(each.value for each in value.arguments if each.value is not None)]


def _repeat(value: tree.Repeat) -> list[tree.Expression]:
    return [value.count] if value.value is None else [value.count, value.value]


def _struct(value: tree.StructInitial) -> list[tree.Expression]:
    return [each.value for each in value.items if each.value is not None]


# By exact type, since this is asked once per expression of a file.
_CHILDREN: dict[type[tree.Expression], Callable[[Any], list[tree.Expression]]] = {
    tree.Binary: lambda value: [value.left, value.right],
    tree.Unary: lambda value: [value.operand],
    tree.Member: lambda value: [value.base],
    tree.BitAccess: lambda value: [value.base],
    tree.Dereference: lambda value: [value.base],
    tree.Index: lambda value: [value.base, *value.indices],
    tree.Call: _call,
    tree.ArrayInitial: lambda value: list(value.items),
    tree.Repeat: _repeat,
    tree.StructInitial: _struct,
}


def expressions(value: tree.Expression) -> Iterator[tree.Expression]:
    stack = [value]
    while stack:
        here = stack.pop()
        yield here
        find = _CHILDREN.get(type(here))
        if find is not None:
            stack.extend(reversed(find(here)))
