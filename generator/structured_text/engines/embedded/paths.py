"""Paths such as `Inner.Buffer[3].Crc`, and the state of an instance as a table of them."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.embedded.values import member, members, read, written
from structured_text.engines.engine import Value
from structured_text.language.tree import Array, Block
from structured_text.language.types import Elementary, Kind, Type, plain

_STEP = re.compile(r"\.?(?P<name>[A-Za-z_]\w*)|\[(?P<indices>\s*-?\d+\s*(?:,\s*-?\d+\s*)*)\]")

# A step inwards: the name of a slot, or an offset in a list.
Step = str | int
OFTEN = 8
"""A variable that was read or written so often gets a function of its own, which costs as much as some accesses."""
QUICK = (Kind.BOOL, Kind.INTEGER, Kind.BITS)
_STORE = """
def store(s, v):
    if {fits}:
        s{place} = v
    else:
        slow(s, v)
"""


@dataclass(slots=True)
class Place:
    """Where a variable is: the steps to what holds it, the last step, and its type; how often it was asked for."""

    owner: tuple[Step, ...]
    last: Step
    kind: Type
    protected: bool
    uses: int = 0

    @property
    def expression(self) -> str:
        """The steps as Python writes them: `.SLOTS[2].ALIVE`."""
        steps = (*self.owner, self.last)
        return "".join(f".{step}" if isinstance(step, str) else f"[{step}]" for step in steps)

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
        """Store what `written` has made."""
        holder = self.holder(root)
        if isinstance(self.last, str):
            setattr(holder, self.last, value)
        else:
            holder[self.last] = value


class Paths:
    """All places of the instances of one block."""

    def __init__(self, block: Block) -> None:
        self.block = block
        self._places: dict[str, Place] = {}
        self._readers: dict[str, Callable[[Any], Value]] = {}
        self._writers: dict[str, Callable[[Any, Any], None]] = {}
        self._snapshot: Callable[[Any], dict[str, Value]] | None = None

    def read(self, root: Any, path: str) -> Value:
        """Read a variable. KeyError."""
        if (reader := self._readers.get(path)) is not None:
            return reader(root)
        place = self._places.get(path) or self.find(path)
        place.uses += 1
        if place.uses > OFTEN:
            self._readers[path] = self._reader(place)
        return read(place.kind, place.get(root))

    def write(self, root: Any, path: str, value: Value) -> None:
        """Write a variable. KeyError, ValueError."""
        if (writer := self._writers.get(path)) is not None:
            writer(root, value)
            return
        place = self._places.get(path) or self.find(path)
        place.uses += 1
        if place.uses > OFTEN:
            self._writers[path] = self._writer(place, path)
        self._write(place, root, path, value)

    def _write(self, place: Place, root: Any, path: str, value: Value) -> None:
        if place.protected:
            raise ValueError(f"{path} is a CONSTANT")
        try:
            place.set(root, written(place.kind, place.get(root), value))
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error

    def _reader(self, place: Place) -> Callable[[Any], Value]:
        """What reads a variable, quickly if it is a scalar or an array of them that looks the same inside."""
        kind = plain(place.kind)
        element = plain(kind.element) if isinstance(kind, Array) and len(kind.bounds) == 1 else kind
        if not is_scalar(element):
            return lambda root: read(place.kind, place.get(root))
        value = f"s{place.expression}"
        code = f"lambda s: {value}" if element is kind else f"lambda s: list({value})"
        made: Callable[[Any], Value] = eval(code)  # noqa: S307 - names that the parser took, and numbers
        return made

    def _writer(self, place: Place, path: str) -> Callable[[Any, Any], None]:
        """What writes a variable, quickly if it is a BOOL or a whole number that fits."""
        kind = place.kind

        def slow(root: Any, value: Value) -> None:
            self._write(place, root, path, value)

        if place.protected or not isinstance(kind, Elementary) or kind.kind not in QUICK:
            return slow
        whole = f"type(v) is int and {kind.low} <= v <= {kind.high}"
        fits = "v is True or v is False" if kind.kind is Kind.BOOL else whole
        known: dict[str, Any] = {"slow": slow}
        exec(_STORE.format(fits=fits, place=place.expression), known)  # noqa: S102 - as above
        store: Callable[[Any, Any], None] = known["store"]
        return store

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
        items = ", ".join(f"{path!r}: {place}" for path, _, place in leaves("", self.block, "s"))
        code = compile(f"lambda s: {{{items}}}", f"<state of {self.block.name}>", "eval")
        snapshot: Callable[[Any], dict[str, Value]] = eval(code, {})  # noqa: S307 - our own compiled code
        return snapshot


def leaves(path: str, kind: Type, place: str) -> Iterator[tuple[str, Type, str]]:
    """Every scalar in a variable: its path, its type, and the Python expression that reads it."""
    if is_scalar(kind):
        yield path, kind, place
    elif isinstance(kind, Array):
        yield from _element_leaves(path, kind, place, ())
    else:
        dot = f"{path}." if path else ""
        for name, each in members(kind).items():
            yield from leaves(dot + name, each, f"{place}.{name}")


def _element_leaves(path: str, kind: Array, place: str, indices: tuple[int, ...]) -> Iterator[tuple[str, Type, str]]:
    if len(indices) == len(kind.bounds):
        yield from leaves(f"{path}[{','.join(map(str, indices))}]", kind.element, place)
        return
    low, high = kind.bounds[len(indices)]
    for index in range(low, high + 1):
        yield from _element_leaves(path, kind, f"{place}[{index - low}]", (*indices, index))


def _is_constant(kind: Type, name: str | None) -> bool:
    declaration = kind.declaration if isinstance(kind, Block) else None
    if declaration is None or name is None:
        return False
    variable = declaration.symbols.get(name.upper())
    return variable is not None and variable.constant


def _enter(path: str, kind: Type, match: re.Match[str]) -> tuple[list[Step], Type]:
    """The steps of one part of a path, and the type that they lead to. KeyError."""
    if name := match["name"]:
        inner = member(kind, name.upper())
        if inner is None:
            raise KeyError(f"{path}: there is no {name}")
        return [name.upper()], inner
    if not isinstance(kind, Array):
        raise KeyError(f"{path}: {match[0]} follows what is no array")
    indices = [int(each) for each in match["indices"].split(",")]
    if len(indices) != len(kind.bounds):
        raise KeyError(f"{path}: {kind} has {len(kind.bounds)} dimensions")
    for index, (low, high) in zip(indices, kind.bounds, strict=True):
        if not low <= index <= high:
            raise KeyError(f"{path}: index {index} is outside {low}..{high}")
    return [index - low for index, (low, _) in zip(indices, kind.bounds, strict=True)], kind.element
