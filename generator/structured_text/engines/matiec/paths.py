"""Paths of the face, `Inner.Buffer[3].Crc`, to places in memory."""

import re
import struct
from dataclasses import dataclass, field

from structured_text.engines.engine import Value
from structured_text.engines.matiec.layout import ArrayNode, Memory, Node, Part, PointerNode, RecordNode, Scalar

_STEP = re.compile(r"\.?(?P<name>[A-Za-z_]\w*)|\[(?P<indices>\s*-?\d+\s*(?:,\s*-?\d+\s*)*)\]")


@dataclass(frozen=True)
class Place:
    """Where a path leads: offsets to add, each but the last to a pointer that is then followed; and the node there."""

    jumps: tuple[tuple[int, PointerNode], ...]
    offset: int
    node: Node
    constant: bool

    def _follow(self, memory: Memory) -> Memory:
        for offset, pointer in self.jumps:
            memory = pointer.follow(memory, offset)
        return memory

    def read(self, memory: Memory) -> Value:
        """Make the value."""
        return self.node.read(self._follow(memory) if self.jumps else memory, self.offset)

    def write(self, memory: Memory, value: Value) -> None:
        """Put the value, whole or not at all. Raises ValueError."""
        if self.constant:
            raise ValueError("it is a CONSTANT")
        memory = self._follow(memory)
        if isinstance(self.node, Scalar):
            self.node.write(memory, self.offset, value)
            return
        before = memory[self.offset : self.offset + self.node.size]
        try:
            self.node.write(memory, self.offset, value)
        except ValueError:
            struct.pack_into(f"{len(before)}s", memory, self.offset, before)
            raise


@dataclass
class Paths:
    """The places of one root node; remembers those asked for."""

    root: Node
    _known: dict[str, Place] = field(default_factory=dict)

    def read(self, memory: Memory, path: str) -> Value:
        """Read a variable. KeyError."""
        return (self._known.get(path) or self.find(path)).read(memory)

    def write(self, memory: Memory, path: str, value: Value) -> None:
        """Write a variable, whole or not at all. KeyError, ValueError."""
        place = self._known.get(path) or self.find(path)
        try:
            place.write(memory, value)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error

    def find(self, path: str) -> Place:
        """Find the place of a path; the empty one leads to the root. KeyError with what is wrong with the path."""
        try:
            place = self._known[path] = self._find(path)
        except IndexError as error:
            raise KeyError(f"{path}: {error}") from error
        return place

    def _find(self, path: str) -> Place:
        jumps: list[tuple[int, PointerNode]] = []
        node, offset, at, constant = self.root, 0, 0, False
        while at < len(path):
            match = _STEP.match(path, at)
            if match is None or path.startswith("."):
                raise IndexError(f"expected a name or [index] at {path[at:]!r}")
            at = match.end()
            if isinstance(node, PointerNode):
                jumps.append((offset, node))
                node, offset = node.target, 0
            part = _part(node, match)
            offset, node, constant = offset + part.offset, part.node, constant or part.constant
        return Place(tuple(jumps), offset, node, constant)


def _part(node: Node, match: re.Match[str]) -> Part:
    if name := match["name"]:
        part = node.parts.get(name.upper()) if isinstance(node, RecordNode) else None
        if part is None:
            raise IndexError(f"there is no {name}")
        return part
    if not isinstance(node, ArrayNode):
        raise IndexError(f"{match[0]} follows what is no array")
    return Part(node.place([int(each) for each in match["indices"].split(",")]), node.element)
