"""A block on one engine, with ways in and out that are quick enough for 10^5 scans of every block.

The state is read as an image: numbers as a tuple, the bits of REALs, texts, and arrays as lists. Two images that are
equal stand for states that are alike to the bit; two that are not may still be (NaN has many bit patterns), so that
whoever compares looks at `state()` then.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from operator import attrgetter, itemgetter
from typing import Any, Literal, Protocol

from tests.blocks.compare.leaf import Leaf
from tests.blocks.compare.pou import Pou
from tests.structured_text.engines.compare.lockstep import State
from tests.structured_text.engines.compare.scenarios import Inputs

from structured_text.engines.embedded.library import EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.engine import Value
from structured_text.engines.matiec.layout import ArrayNode, Memory, Scalar
from structured_text.engines.matiec.library import MatiecInstance, MatiecLibrary
from structured_text.language.tree import Array
from structured_text.language.types import Kind

Image = tuple[object, ...]
Setter = Callable[[Value], None]
CODES: dict[tuple[int, bool], Literal["B", "H", "I", "b", "h", "i"]] = {
    (8, False): "B", (16, False): "H", (32, False): "I", (8, True): "b", (16, True): "h", (32, True): "i",
}  # fmt: skip
"""How module `struct` reads an element by width in bits and sign."""


class Subject(Protocol):
    """One POU on one engine; `follows_c`: it keeps copies of in-outs, as C from matiec does."""

    name: str
    follows_c: bool
    instance: EmbeddedInstance | MatiecInstance

    def step(self, inputs: Inputs) -> None:
        """Set inputs and scan. ScanError."""

    def image(self) -> Image:
        """Read the whole state quickly: what every engine keeps, then (`follows_c`) what was handed on."""

    def state(self) -> State:
        """Read the whole state as users do."""


class _Stepping:
    """What both kinds share: setters by path."""

    def __init__(self, instance: EmbeddedInstance | MatiecInstance, setters: dict[str, Setter]) -> None:
        self.instance = instance
        self._setters = setters
        self.state = instance.state

    def step(self, inputs: Inputs) -> None:
        """Set inputs and scan. ScanError."""
        for path, value in inputs.items():
            self._setters[path](value)
        self.instance.scan(0)


def _array_setter(memory: Memory, offset: int, code: str) -> Setter:
    def fill(value: Value) -> None:
        assert isinstance(value, bytes | list)
        struct.pack_into(f"={len(value)}{code}", memory, offset, *value)

    return fill


def _grouped(found: Sequence[Leaf], follows_c: bool) -> list[tuple[str, list[Leaf]]]:
    """The leaves of each group in the order of an image: those that every engine keeps, then those handed on."""
    groups = [(handed, group) for handed in (False, True) for group in ("plain", "real", "text", "array")]
    return [
        (group, [each for each in found if (each.handed_on, each.group) == (handed, group)])
        for handed, group in groups
        if follows_c or not handed
    ]


# ------------------------------------------------------------ embedded


class EmbeddedSubject(_Stepping):
    """On the embedded engine, whose variables are attributes and lists."""

    follows_c = False

    def __init__(self, library: EmbeddedLibrary, pou: Pou, name: str) -> None:
        """Make an instance."""
        instance = library.instance(pou.block)
        self._root: Any = instance._root
        super().__init__(instance, {pin.path: self._setter(pin.path, bool(pin.length)) for pin in pou.pins})
        self.name = name
        self._readers = [_attributes(group, each) for group, each in _grouped(pou.leaves, False) if each]

    def image(self) -> Image:
        """Read the whole state; arrays are the live lists."""
        root = self._root
        return tuple([read(root) for read in self._readers])

    def _setter(self, path: str, is_array: bool) -> Setter:
        *outer, last = path.upper().split(".")
        holder = attrgetter(".".join(outer))(self._root) if outer else self._root
        if not is_array:
            return lambda value: setattr(holder, last, value)
        box: list[Any] = getattr(holder, last)

        def fill(value: Any) -> None:
            box[: len(value)] = value

        return fill


def _attributes(group: str, found: Sequence[Leaf]) -> Callable[[Any], object]:
    one_or_more: Callable[[Any], Any] = attrgetter(*(each.path for each in found))
    get = one_or_more if len(found) > 1 else lambda root: (one_or_more(root),)
    if group != "real":
        return get
    pack = struct.Struct(f"={len(found)}f").pack
    return lambda root: pack(*get(root))


# ------------------------------------------------------------ matiec


class MatiecSubject(_Stepping):
    """On matiec, whose variables are bytes."""

    follows_c = True

    def __init__(self, library: MatiecLibrary, pou: Pou, name: str) -> None:
        """Make an instance."""
        instance = library.instance(pou.block)
        self._paths = instance._block.paths
        self._memory: Memory = instance._memory
        self._view = memoryview(self._memory).cast("B")
        super().__init__(instance, {pin.path: self._setter(pin.path) for pin in pou.pins})
        self.name = name
        self._readers = [self._reader(group, each) for group, each in _grouped(pou.leaves, True) if each]

    def image(self) -> Image:
        """Read the whole state."""
        return tuple([read() for read in self._readers])

    def _setter(self, path: str) -> Setter:
        place = self._paths.find(path)
        memory, offset, node = self._memory, place.offset, place.node
        if isinstance(node, ArrayNode):
            assert isinstance(node.element, Scalar)
            return _array_setter(memory, offset, node.element.code)
        assert isinstance(node, Scalar)
        pack = struct.Struct("=" + node.code).pack_into
        return lambda value: pack(memory, offset, value)

    def _reader(self, group: str, found: Sequence[Leaf]) -> Callable[[], object]:
        if group == "array":
            boxes = [self._list(each) for each in found]
            return lambda: tuple([box() for box in boxes])
        if group == "text":
            places = [self._paths.find(each.path) for each in found]
            return lambda: tuple([place.read(self._memory) for place in places])
        return self._numbers(found, real=group == "real")

    def _list(self, leaf: Leaf) -> Callable[[], object]:
        """What gives an array as a list; an array that has not changed gives the list made before."""
        place = self._paths.find(leaf.path)
        start, end = place.offset, place.offset + place.node.size
        view = self._view[start:end].cast(_code(leaf))
        before, made = b"", list[int]()

        def read() -> list[int]:
            nonlocal before, made
            now = view.tobytes()
            if now != before:
                before, made = now, view.tolist()
            return made

        return read

    def _numbers(self, found: Sequence[Leaf], *, real: bool) -> Callable[[], object]:
        """One `struct` format over all of them, then the order of the leaves; REALs as the bytes of all."""
        places = [self._paths.find(each.path) for each in found]
        in_memory = sorted(range(len(places)), key=lambda at: places[at].offset)
        text, at = "=", 0
        for each in in_memory:
            place, node = places[each], places[each].node
            assert isinstance(node, Scalar)
            text += f"{place.offset - at}x{node.code}"
            at = place.offset + node.size
        order = [in_memory.index(each) for each in range(len(places))]
        unpack, memory = struct.Struct(text).unpack_from, self._memory
        arrange: Callable[[Any], Any] = itemgetter(*order) if len(order) > 1 else tuple
        if not real:
            return lambda: arrange(unpack(memory))
        pack = struct.Struct(f"={len(places)}f").pack
        return lambda: pack(*arrange(unpack(memory)))


def _code(leaf: Leaf) -> Literal["B", "H", "I", "b", "h", "i"]:
    assert isinstance(leaf.kind, Array)
    element: Any = leaf.element
    assert element.kind in (Kind.BITS, Kind.INTEGER), leaf
    return CODES[element.width, element.signed]
