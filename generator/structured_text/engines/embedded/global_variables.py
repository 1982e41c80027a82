"""The globals of a build, whoever declares them: one object, which all instances see (IEC 61131-3 clause 2.7)."""

from collections.abc import Iterator
from typing import Any

from structured_text.engines.embedded.compiler import Compiler
from structured_text.engines.embedded.shapes import record_class
from structured_text.language import tree
from structured_text.language.tree import Block, Direction, Parameter, VarKind
from structured_text.language.types import Kind


def global_variables(compiler: Compiler) -> list[tuple[str, tree.VarDecl]]:
    """Every global of the sources with the name of the resource that holds it (empty: the configuration)."""
    found: list[tuple[str, tree.VarDecl]] = []
    for unit in compiler.checked.units:
        for each in unit.elements:
            if isinstance(each, tree.VarBlock):
                found += [("", variable) for variable in each.variables]
    for configuration in compiler.checked.configurations.values():
        found += globals_in(configuration)
    return found


def globals_in(configuration: tree.Configuration) -> Iterator[tuple[str, tree.VarDecl]]:
    """The globals of one configuration with the name of the resource that holds them (empty: itself)."""
    owners = [("", configuration.blocks)] + [(each.name, each.blocks) for each in configuration.resources]
    for owner, blocks in owners:
        for block in blocks:
            if block.kind is VarKind.GLOBAL:
                yield from ((owner, variable) for variable in block.variables)


def globals_of(compiler: Compiler) -> Any:
    """A fresh set of all globals with their initial values; instances refer to it."""
    variables = [each for _, each in global_variables(compiler)]
    slots = [compiler.shapes.global_slot(each) for each in variables]
    made = record_class("Globals", tuple(slots))()
    for slot, each in zip(slots, variables, strict=True):
        setattr(made, slot, compiler.shapes.maker(each.type, each.start)(made))
    return made


def globals_block(compiler: Compiler) -> tuple[Block, dict[str, str]]:
    """All globals as variables of one block, whoever owns them, and the slot behind each name."""
    block, slots = Block("", Kind.BLOCK), dict[str, str]()
    for _, each in global_variables(compiler):
        slot = slots.setdefault(each.name.upper(), compiler.shapes.global_slot(each))
        block.parameters.setdefault(each.name.upper(), Parameter(slot, each.type, Direction.INPUT))
    return block, slots


class GlobalsView:
    """Globals under their own names, for paths."""

    __slots__ = ("names", "target")

    def __init__(self, target: Any, names: dict[str, str]) -> None:
        object.__setattr__(self, "target", target)
        object.__setattr__(self, "names", names)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.target, self.names[name])

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.target, self.names[name], value)
