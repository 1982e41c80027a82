"""Which variables a piece of ST reads and writes."""

import dataclasses
from collections.abc import Iterator

from structured_text.language import tree
from structured_text.language.tree import Block, Direction

# What hangs in the tree without being a part of it.
_FOREIGN = (tree.VarDecl, tree.Pou, tree.Unit)
# Slots that hold no part of a node; `target` does in an assignment, and is foreign in a call.
_LEAVES = ("at", "end", "symbol", "type", "operand_type", "parentheses", "leading", "trailing", "bindings")


_KNOWN: dict[type[tree.Node], tuple[str, ...]] = {}


def _slots(kind: type[tree.Node]) -> tuple[str, ...]:
    """The slots of a class of nodes in which parts can be."""
    if kind not in _KNOWN:
        _KNOWN[kind] = tuple(each.name for each in dataclasses.fields(kind) if each.name not in _LEAVES)
    return _KNOWN[kind]


def walk(node: tree.Node) -> Iterator[tree.Node]:
    """A node and all nodes in it, in source order; declarations that it refers to are left out."""
    stack = [node]
    while stack:
        node = stack.pop()
        yield node
        parts: list[tree.Node] = []
        for slot in _slots(type(node)):
            value = getattr(node, slot)
            for child in value if isinstance(value, list) else (value,):
                if isinstance(child, tree.Node) and not isinstance(child, _FOREIGN):
                    parts.append(child)
        stack += reversed(parts)


def reads(nodes: list[tree.Statement]) -> list[tree.VarDecl]:
    """Every variable that is named, each once, in source order."""
    found: dict[tree.VarDecl, None] = {}
    for node in nodes:
        for each in walk(node):
            if isinstance(each, tree.Name) and isinstance(each.symbol, tree.VarDecl):
                found[each.symbol] = None
    return list(found)


def writes(nodes: list[tree.Statement]) -> list[tree.VarDecl]:
    """Every variable that is assigned as a whole: by `:=`, FOR, an output, an in-out or ENO."""
    found: dict[tree.VarDecl, None] = {}
    for node in nodes:
        for each in walk(node):
            for target in _targets(each):
                if isinstance(target, tree.Name) and isinstance(target.symbol, tree.VarDecl):
                    found[target.symbol] = None
    return list(found)


def _targets(node: tree.Node) -> Iterator[tree.Expression | None]:
    if isinstance(node, tree.Assign):
        yield node.target
    elif isinstance(node, tree.For):
        yield node.variable
    elif isinstance(node, tree.Call):
        yield node.eno
        for binding in node.bindings:
            if binding.parameter.direction is not Direction.INPUT:
                yield binding.value


def root(expression: tree.Expression) -> tree.VarDecl | None:
    """The variable in which a field or element lies."""
    while isinstance(expression, tree.Member | tree.Index):
        expression = expression.base
    symbol = expression.symbol if isinstance(expression, tree.Name) else None
    return symbol if isinstance(symbol, tree.VarDecl) else None


def touched(nodes: list[tree.Statement]) -> set[tree.VarDecl]:
    """Every variable of which any part may be written."""
    found = set()
    for node in nodes:
        for each in walk(node):
            for target in _targets(each):
                owner = None if target is None else root(target)
                if owner is not None:
                    found.add(owner)
    return found


def loops(nodes: list[tree.Statement], looping: set[tree.Function | Block]) -> bool:
    """Whether there is a loop anywhere, or a call of what loops."""
    for node in nodes:
        for each in walk(node):
            if isinstance(each, tree.For | tree.While | tree.RepeatUntil):
                return True
            if (
                isinstance(each, tree.Call)
                and isinstance(each.target, tree.Function | Block)
                and each.target in looping
            ):
                return True
    return False
