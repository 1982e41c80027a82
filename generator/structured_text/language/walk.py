"""Every node of a POU's statements, handed to whoever asked for its kind."""

from collections.abc import Callable, Iterator
from typing import Any

from structured_text.language.tree import (
    ArrayInitial,
    Assign,
    Binary,
    BitAccess,
    Call,
    CallStatement,
    Case,
    Dereference,
    Expression,
    For,
    If,
    Index,
    LabelRange,
    Member,
    Repeat,
    RepeatUntil,
    Return,
    Statement,
    StructInitial,
    Unary,
    While,
)


def statements(body: list[Statement]) -> Iterator[Statement]:
    """Every statement, those inside others too, in source order."""
    stack = list(reversed(body))
    while stack:
        statement = stack.pop()
        yield statement
        for inner in reversed(bodies(statement)):
            stack.extend(reversed(inner))


def bodies(statement: Statement) -> list[list[Statement]]:
    """The lists of statements directly inside a statement."""
    if isinstance(statement, If):
        made = [branch.body for branch in statement.branches]
        return [*made, statement.otherwise] if statement.otherwise is not None else made
    if isinstance(statement, Case):
        made = [branch.body for branch in statement.branches]
        return [*made, statement.otherwise] if statement.otherwise is not None else made
    return [statement.body] if isinstance(statement, For | While | RepeatUntil) else []


def heads(statement: Statement) -> list[Expression]:
    """The expressions directly in a statement, without those of the statements inside it."""
    if isinstance(statement, Assign):
        return [statement.target, statement.value]
    if isinstance(statement, CallStatement):
        return [statement.call]
    if isinstance(statement, If):
        return [branch.condition for branch in statement.branches]
    if isinstance(statement, Case):
        return [statement.selector, *_labels(statement)]
    return _loop_heads(statement)


def _labels(statement: Case) -> list[Expression]:
    made: list[Expression] = []
    for branch in statement.branches:
        for label in branch.labels:
            made += [label.low, label.high] if isinstance(label, LabelRange) else [label]
    return made


def _loop_heads(statement: Statement) -> list[Expression]:
    if isinstance(statement, While | RepeatUntil):
        return [statement.condition]
    if isinstance(statement, For):
        made = [statement.variable, statement.start, statement.stop]
        return [*made, statement.step] if statement.step is not None else made
    return [statement.value] if isinstance(statement, Return) and statement.value is not None else []


def children(value: Expression) -> list[Expression]:
    """The expressions directly inside an expression."""
    find = _CHILDREN.get(type(value))
    return find(value) if find is not None else []


def _call(value: Call) -> list[Expression]:
    return [value.callee, *(each.value for each in value.arguments if each.value is not None)]


def _repeat(value: Repeat) -> list[Expression]:
    return [value.count] if value.value is None else [value.count, value.value]


def _struct(value: StructInitial) -> list[Expression]:
    return [each.value for each in value.items if each.value is not None]


# By exact type, since this is asked once per expression of a file.
_CHILDREN: dict[type[Expression], Callable[[Any], list[Expression]]] = {
    Binary: lambda value: [value.left, value.right],
    Unary: lambda value: [value.operand],
    Member: lambda value: [value.base],
    BitAccess: lambda value: [value.base],
    Dereference: lambda value: [value.base],
    Index: lambda value: [value.base, *value.indices],
    Call: _call,
    ArrayInitial: lambda value: list(value.items),
    Repeat: _repeat,
    StructInitial: _struct,
}


def expressions(value: Expression) -> Iterator[Expression]:
    stack = [value]
    while stack:
        here = stack.pop()
        yield here
        find = _CHILDREN.get(type(here))
        if find is not None:
            stack.extend(reversed(find(here)))
