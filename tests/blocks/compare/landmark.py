"""The values that a POU's statements name: its literals, and what its inputs must be to reach each arm of a CASE."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from structured_text.engines.embedded.usage import walk
from structured_text.language import tree
from structured_text.language.tree import Block, VarKind
from structured_text.language.walk import bodies

Arm = tuple[tuple[str, int], ...]
"""Inputs by name with the values that lead into a branch of a CASE or into its ELSE, outermost first."""


def callees(pou: tree.Function | tree.FunctionBlock) -> list[tree.Function | tree.FunctionBlock]:
    """A POU and all that it calls, directly or not, each once."""
    found: dict[tree.Function | tree.FunctionBlock, None] = {}
    waiting = [pou]
    while waiting:
        each = waiting.pop()
        if each not in found:
            found[each] = None
            waiting += _called(each)
    return list(found)


def _called(pou: tree.Function | tree.FunctionBlock) -> Iterator[tree.Function | tree.FunctionBlock]:
    for statement in pou.body:
        for node in walk(statement):
            target = node.target if isinstance(node, tree.Call) else None
            if isinstance(target, tree.Function):
                yield target
            elif isinstance(target, Block) and isinstance(target.declaration, tree.FunctionBlock):
                yield target.declaration


def literals(pou: tree.Function | tree.FunctionBlock) -> list[int | float]:
    """The numbers and bit strings in the statements of a POU and of all that it calls."""
    nodes = (node for each in callees(pou) for statement in each.body for node in walk(statement))
    values = (node.value for node in nodes if isinstance(node, tree.Literal))
    return [value for value in values if isinstance(value, int | float) and not isinstance(value, bool)]


def arms(body: Sequence[tree.Statement], outer: Arm = ()) -> Iterator[Arm]:
    """What leads to each branch of each CASE over an input and past all of them; inner ones after the outer."""
    for statement in body:
        name = _input(statement.selector) if isinstance(statement, tree.Case) else None
        if not isinstance(statement, tree.Case) or name is None:
            for inner in bodies(statement):
                yield from arms(inner, outer)
            continue
        values = [(value, branch.body) for branch in statement.branches for value in _values(branch)]
        other = max((value for value, _ in values), default=0) + 1
        for value, inner in (*values, (other, statement.otherwise or [])):
            yield (*outer, (name, value))
            yield from arms(inner, (*outer, (name, value)))


def _input(selector: tree.Expression) -> str | None:
    """The input that a selector is, or is converted from."""
    names = [node.symbol for node in walk(selector) if isinstance(node, tree.Name)]
    found = [each for each in names if isinstance(each, tree.VarDecl) and each.kind is VarKind.INPUT]
    return found[0].name if len(found) == 1 else None


def _values(branch: tree.CaseBranch) -> Iterator[int]:
    for label in branch.labels:
        ends = (label.low, label.high) if isinstance(label, tree.LabelRange) else (label,)
        for end in ends:
            if isinstance(end, tree.Literal) and isinstance(end.value, int):
                yield end.value
