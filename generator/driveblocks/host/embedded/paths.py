"""Paths such as `Inner.Buffer[3].Crc`, and the state of an instance as a table of them."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from driveblocks.host.embedded import times
from driveblocks.host.embedded.shapes import is_scalar
from driveblocks.host.embedded.values import Values, members
from driveblocks.host.engine import Value
from driveblocks.st.tree import Array, Block, Struct
from driveblocks.st.types import Type, plain

_STEP = re.compile(r"\.?(?P<name>[A-Za-z_]\w*)|\[(?P<indices>\s*-?\d+\s*(?:,\s*-?\d+\s*)*)\]")

# A step inwards: the name of a slot, or an offset in a list.
Step = str | int


@dataclass(frozen=True, slots=True)
class Place:
    """Where a variable is: the steps to what holds it, the last step, and its type."""

    owner: tuple[Step, ...]
    last: Step
    kind: Type
    protected: bool

    def holder(self, root: Any) -> Any:
        """The object or list that holds the variable."""
        for step in self.owner:
            root = getattr(root, step) if isinstance(step, str) else root[step]
        return root

    def get(self, root: Any) -> Any:
        """The variable as it is inside."""
        holder = self.holder(root)
        return getattr(holder, self.last) if isinstance(self.last, str) else holder[self.last]

    def set(self, root: Any, value: Any) -> None:
        """Store what `Values.write` has made."""
        holder = self.holder(root)
        if isinstance(self.last, str):
            setattr(holder, self.last, value)
        else:
            holder[self.last] = value


class Paths:
    """All places of the instances of one block."""

    def __init__(self, block: Block, values: Values) -> None:
        """Prepare for a block."""
        self.block = block
        self.values = values
        self._places: dict[str, Place] = {}
        self._snapshot: Callable[[Any], dict[str, Value]] | None = None

    def read(self, root: Any, path: str) -> Value:
        """Read a variable. KeyError."""
        place = self._places.get(path) or self.find(path)
        return self.values.read(place.kind, place.get(root))

    def write(self, root: Any, path: str, value: Value) -> None:
        """Write a variable. KeyError, ValueError."""
        place = self._places.get(path) or self.find(path)
        if place.protected:
            raise ValueError(f"{path} is a CONSTANT")
        try:
            place.set(root, self.values.write(place.kind, place.get(root), value))
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error

    def find(self, path: str) -> Place:
        """The place of a path. KeyError with the path and what is wrong with it."""
        kind: Type = self.block
        steps: list[Step] = []
        at, protected = 0, False
        while at < len(path):
            match = _STEP.match(path, at)
            if match is None or path.startswith("."):
                raise KeyError(f"{path}: expected a name or [index] at {path[at:]!r}")
            at = match.end()
            protected = protected or _is_constant(kind, match["name"])
            more, kind = _enter(path, plain(kind) if match["indices"] else kind, match)
            steps += more
        if not steps:
            raise KeyError("an empty path names no variable")
        place = Place(tuple(steps[:-1]), steps[-1], kind, protected)
        self._places[path] = place
        return place

    # ------------------------------------------------------------ state

    def state(self, root: Any) -> dict[str, Value]:
        """Every scalar: path in upper case -> value, in the order of declaration."""
        if self._snapshot is None:
            self._snapshot = self._compile_snapshot()
        return self._snapshot(root)

    def _compile_snapshot(self) -> Callable[[Any], dict[str, Value]]:
        """One Python function that reads everything at once, since tests call it after every scan."""
        keys: list[ast.expr | None] = []
        items: list[ast.expr] = []
        for path, kind, node in leaves("", self.block, ast.Name("s", ast.Load())):
            keys.append(ast.Constant(path))
            call = ast.Call(ast.Name("nanoseconds", ast.Load()), [node], [])
            items.append(node if self.values.is_same(kind) else call)
        arguments = ast.arguments([], [ast.arg("s")], None, [], [], None, [])
        tree = ast.fix_missing_locations(ast.Expression(ast.Lambda(arguments, ast.Dict(keys, items))))
        code = compile(tree, f"<state of {self.block.name}>", "eval")
        snapshot: Callable[[Any], dict[str, Value]] = eval(  # noqa: S307 - our own compiled code
            code, {"nanoseconds": times.nanoseconds}
        )
        return snapshot


def leaves(path: str, kind: Type, node: ast.expr) -> Iterator[tuple[str, Type, ast.expr]]:
    """Every scalar in a variable: its path, its type, and the Python expression that reads it."""
    if is_scalar(kind):
        yield path, kind, node
    elif isinstance(kind, Array):
        yield from _element_leaves(path, kind, node, ())
    else:
        dot = f"{path}." if path else ""
        for name, each in members(kind).items():
            yield from leaves(dot + name, each, ast.Attribute(node, name, ast.Load()))


def _element_leaves(
    path: str, kind: Array, node: ast.expr, indices: tuple[int, ...]
) -> Iterator[tuple[str, Type, ast.expr]]:
    if len(indices) == len(kind.bounds):
        yield from leaves(f"{path}[{','.join(map(str, indices))}]", kind.element, node)
        return
    low, high = kind.bounds[len(indices)]
    for index in range(low, high + 1):
        item = ast.Subscript(node, ast.Constant(index - low), ast.Load())
        yield from _element_leaves(path, kind, item, (*indices, index))


def _is_constant(kind: Type, name: str | None) -> bool:
    declaration = kind.declaration if isinstance(kind, Block) else None
    if declaration is None or name is None:
        return False
    variable = declaration.symbols.get(name.upper())
    return variable is not None and variable.constant


def _enter(path: str, kind: Type, match: re.Match[str]) -> tuple[list[Step], Type]:
    """The steps of one part of a path, and the type that they lead to. KeyError."""
    if name := match["name"]:
        inner = members(kind).get(name.upper()) if isinstance(kind, Struct | Block) else None
        if inner is None:
            raise KeyError(f"{path}: there is no {name}")
        return [name.upper()], inner
    if not isinstance(kind, Array):
        raise KeyError(f"{path}: {match[0]} stands behind what is no array")
    indices = [int(each) for each in match["indices"].split(",")]
    if len(indices) != len(kind.bounds):
        raise KeyError(f"{path}: {kind} has {len(kind.bounds)} dimensions")
    for index, (low, high) in zip(indices, kind.bounds, strict=True):
        if not low <= index <= high:
            raise KeyError(f"{path}: index {index} is outside {low}..{high}")
    return [index - low for index, (low, _) in zip(indices, kind.bounds, strict=True)], kind.element
