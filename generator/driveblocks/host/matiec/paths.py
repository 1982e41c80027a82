"""Paths of the face, `Inner.Buffer[3].Crc`, to places in memory."""

import re
from dataclasses import dataclass, field

from driveblocks.host.engine import Value
from driveblocks.host.matiec.layout import ArrayNode, Memory, Node, PointerNode, RecordNode

_STEP = re.compile(r"\.?(?P<name>[A-Za-z_]\w*)|\[(?P<indices>\s*-?\d+\s*(?:,\s*-?\d+\s*)*)\]")


@dataclass(frozen=True)
class Place:
    """Where a path leads: offsets to add, each but the last to a pointer that is then followed; and the node there."""

    jumps: tuple[tuple[int, PointerNode], ...]
    offset: int
    node: Node

    def read(self, memory: Memory) -> Value:
        """Make the value."""
        for offset, pointer in self.jumps:
            memory = pointer.follow(memory, offset)
        return self.node.read(memory, self.offset)

    def write(self, memory: Memory, value: Value) -> None:
        """Put the value. Raises ValueError."""
        for offset, pointer in self.jumps:
            memory = pointer.follow(memory, offset)
        self.node.write(memory, self.offset, value)


@dataclass
class Paths:
    """The places of one root node; remembers those asked for."""

    root: Node
    _known: dict[str, Place] = field(default_factory=dict)

    def find(self, path: str) -> Place:
        """Find the place of a path. Raises KeyError with the path and what is wrong with it."""
        place = self._known.get(path)
        if place is None:
            try:
                place = self._known[path] = self._find(path)
            except IndexError as error:
                raise KeyError(f"{path}: {error}") from error
        return place

    def _find(self, path: str) -> Place:
        jumps: list[tuple[int, PointerNode]] = []
        node, offset, at = self.root, 0, 0
        while at < len(path):
            match = _STEP.match(path, at)
            if match is None or (at == 0 and path.startswith(".")):
                raise IndexError(f"expected a name or [index] at {path[at:]!r}")
            at = match.end()
            if isinstance(node, PointerNode):
                jumps.append((offset, node))
                node, offset = node.target, 0
            step, node = _step(node, match)
            offset += step
        return Place(tuple(jumps), offset, node)


def _step(node: Node, match: re.Match[str]) -> tuple[int, Node]:
    if name := match["name"]:
        part = node.parts.get(name.upper()) if isinstance(node, RecordNode) else None
        if part is None:
            raise IndexError(f"there is no {name}")
        return part.offset, part.node
    if not isinstance(node, ArrayNode):
        raise IndexError(f"{match[0]} behind what is no array")
    return node.place([int(each) for each in match["indices"].split(",")]), node.element
