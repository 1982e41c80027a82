"""The parts of a block's state: its scalars and whole arrays by path, and whether only some engines keep them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from structured_text.engines.embedded.values import members
from structured_text.language.tree import Array, Block, Direction, Struct
from structured_text.language.types import REAL, Kind, Type


@dataclass(frozen=True)
class Leaf:
    """A scalar, or an array of scalars; `path` in upper case.

    `handed_on`: it is, or belongs to, an in-out of an inner instance: matiec keeps a copy of what it was last handed,
    and where in-outs are references there is nothing to compare.
    """

    path: str
    kind: Type
    handed_on: bool

    @property
    def element(self) -> Type:
        """The type of an array's elements, or of the scalar itself."""
        return self.kind.element if isinstance(self.kind, Array) else self.kind

    @property
    def group(self) -> str:
        """How it is read: `array`, `text`, `real`, or `plain` for what Python and C compare as a number."""
        if isinstance(self.kind, Array):
            return "array"
        return {Kind.STRING: "text", Kind.REAL: "real"}.get(self.kind.kind, "plain")


def leaves(block: Block) -> list[Leaf]:
    """Every leaf of an instance in the order of declaration. ValueError for types that the library does not use."""
    return list(_leaves("", block, False))


def _leaves(path: str, kind: Type, handed_on: bool) -> Iterator[Leaf]:
    if _is_leaf(kind):
        yield Leaf(path, kind, handed_on)
    elif isinstance(kind, Struct | Block):
        for name, each in members(kind).items():
            yield from _leaves(f"{path}.{name}" if path else name, each, handed_on or _is_in_out(path, kind, name))
    else:
        raise ValueError(f"{path} is a {kind}")


def _is_leaf(kind: Type) -> bool:
    if isinstance(kind, Array):
        return len(kind.bounds) == 1 and kind.element.kind in (Kind.BITS, Kind.INTEGER)
    return kind is REAL or kind.kind in (Kind.BOOL, Kind.BITS, Kind.INTEGER, Kind.STRING)


def _is_in_out(path: str, kind: Type, name: str) -> bool:
    """Whether a name is an in-out of an instance that stands inside another."""
    parameter = kind.parameters.get(name) if path and isinstance(kind, Block) else None
    return parameter is not None and parameter.direction is Direction.IN_OUT
