"""How values lie in memory: the nodes that read and write them, whole or one scalar at a time.

A node knows its size and how to turn bytes at an offset into a Python value and back. Offsets come from the C
compiler, never from rules of our own.
"""

import ctypes
import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import Any, Protocol

from structured_text.engines.engine import Value
from structured_text.language.types import greatest, least

Memory = ctypes.Array[ctypes.c_char]
NANOSECONDS = 1_000_000_000


class Node(Protocol):
    """A type as it lies in memory. `write` raises ValueError for what the type cannot hold."""

    @property
    def size(self) -> int:
        """Bytes, padding included."""

    def read(self, memory: Memory, offset: int) -> Value:
        """Make the Python value of the bytes at `offset`."""

    def write(self, memory: Memory, offset: int, value: Value) -> None:
        """Put a Python value at `offset`."""

    def leaves(self, path: str, offset: int, /) -> Iterator[tuple[str, int, "Scalar"]]:
        """Every scalar inside that belongs to the state: path, offset, node."""


Fields = tuple[int | float | bytes, ...]


@dataclass(frozen=True)
class Scalar:
    """A value without parts.

    `code`: as module `struct` reads it; `fields`: how many values that gives; `join` makes the Python value of them;
    `split` makes them of a Python value, and raises ValueError for what the type cannot hold.
    """

    code: str
    join: Callable[[Sequence[int | float | bytes]], Value]
    split: Callable[[Value], Fields]
    fields: int = 1

    @property
    def size(self) -> int:
        """Bytes, padding included."""
        return struct.calcsize("=" + self.code)

    def read(self, memory: Memory, offset: int) -> Value:
        """Make the Python value of the bytes at `offset`."""
        return self.join(struct.unpack_from("=" + self.code, memory, offset))

    def write(self, memory: Memory, offset: int, value: Value) -> None:
        """Put a Python value at `offset`."""
        struct.pack_into("=" + self.code, memory, offset, *self.split(value))

    def leaves(self, path: str, offset: int) -> Iterator[tuple[str, int, "Scalar"]]:
        """Give itself."""
        yield path, offset, self


def boolean() -> Scalar:
    """BOOL; whatever is not zero is TRUE."""

    def split(value: Value) -> Fields:
        if not isinstance(value, int) or value not in (0, 1):
            raise ValueError(f"{value!r} is no BOOL")
        return (bool(value),)

    return Scalar("?", lambda parts: bool(parts[0]), split)


def integer(name: str, code: str, last: int | None = None) -> Scalar:
    """A bit string, an integer or an enumeration; `last` is the greatest value if it is not that of the width."""
    width = struct.calcsize("=" + code) * 8
    signed = code.islower()
    low = least(width, signed=signed)
    high = last if last is not None else greatest(width, signed=signed)

    def split(value: Value) -> Fields:
        if not isinstance(value, int) or not low <= value <= high:
            raise ValueError(f"{value!r} is outside {low}..{high} of {name}")
        return (value,)

    return Scalar(code, lambda parts: int(parts[0]), split)


def floating(code: str) -> Scalar:
    """REAL (`f`) or LREAL (`d`)."""

    def split(value: Value) -> Fields:
        if not isinstance(value, int | float):
            raise ValueError(f"{value!r} is no number")
        try:
            struct.pack("=" + code, value)
        except OverflowError as error:
            raise ValueError(f"{value!r} is too large for a REAL") from error
        return (value,)

    return Scalar(code, lambda parts: float(parts[0]), split)


def text(length_size: int, body_offset: int, body_size: int) -> Scalar:
    """STRING: its length, then that number of bytes of a body of fixed size, as the C compiler says of the struct."""
    length = {1: "B", 2: "H", 4: "I"}.get(length_size, "Q")

    def join(parts: Sequence[int | float | bytes]) -> Value:
        size, body = parts
        return bytes(body)[: int(size)] if isinstance(body, bytes) else b""

    def split(value: Value) -> Fields:
        if not isinstance(value, bytes | bytearray):
            raise ValueError(f"{value!r} is not bytes")
        if len(value) > body_size:
            raise ValueError(f"{len(value)} bytes do not fit into a STRING of {body_size}")
        return len(value), bytes(value)

    return Scalar(f"{length}{body_offset - length_size}x{body_size}s", join, split, fields=2)


def span(part_size: int) -> Scalar:
    """TIME, DATE, TOD and DT: seconds and nanoseconds, in Python nanoseconds; `part_size` is that of a C long.

    Both parts may be negative, and what iec2c writes need not be normalised; what is written here has one sign.
    """

    def split(value: Value) -> Fields:
        if not isinstance(value, int):
            raise ValueError(f"{value!r} is no number of nanoseconds")
        seconds, rest = divmod(abs(value), NANOSECONDS)
        sign = -1 if value < 0 else 1
        return sign * seconds, sign * rest

    return Scalar("qq" if part_size == 8 else "ii", lambda parts: int(parts[0]) * NANOSECONDS + int(parts[1]), split, 2)


@dataclass(frozen=True)
class ArrayNode:
    """An array, row-major; `bounds` holds (low, high) of each dimension."""

    element: Node
    bounds: tuple[tuple[int, int], ...]
    stride: int

    @cached_property
    def lengths(self) -> list[int]:
        """Number of elements of each dimension."""
        return [high - low + 1 for low, high in self.bounds]

    @property
    def size(self) -> int:
        return self.stride * prod(self.lengths)

    def read(self, memory: Memory, offset: int) -> Value:
        """Make a list (of lists, for several dimensions) that starts at the lower bound."""
        count = prod(self.lengths)
        if isinstance(self.element, Scalar) and self.element.size == self.stride and self.element.fields == 1:
            flat: list[Value] = list(struct.unpack_from(f"={count}{self.element.code}", memory, offset))
        else:
            flat = [self.element.read(memory, offset + i * self.stride) for i in range(count)]
        return _fold(flat, self.lengths)

    def write(self, memory: Memory, offset: int, value: Value) -> None:
        """Put a list or bytes; a shorter one keeps the rest."""
        self._write(memory, offset, value, self.lengths)

    def _write(self, memory: Memory, offset: int, value: Value, lengths: Sequence[int]) -> None:
        if not isinstance(value, list | tuple | bytes | bytearray):
            raise ValueError(f"{value!r} is neither a list nor bytes")
        if len(value) > lengths[0]:
            raise ValueError(f"{len(value)} values do not fit into {lengths[0]} elements")
        step = self.stride * prod(lengths[1:])
        for i, each in enumerate(value):
            if len(lengths) > 1:
                self._write(memory, offset + i * step, each, lengths[1:])
            else:
                self.element.write(memory, offset + i * step, each)

    def leaves(self, path: str, offset: int) -> Iterator[tuple[str, int, Scalar]]:
        """Every element, its path in the array's own bounds."""
        for i in range(prod(self.lengths)):
            yield from self.element.leaves(f"{path}[{self._index(i)}]", offset + i * self.stride)

    def _index(self, position: int) -> str:
        indices = []
        for low, high in reversed(self.bounds):
            position, index = divmod(position, high - low + 1)
            indices.append(str(low + index))
        return ",".join(reversed(indices))

    def place(self, indices: Sequence[int]) -> int:
        """Offset of an element. Raises IndexError for a wrong number of indices or one outside its bounds."""
        if len(indices) != len(self.bounds):
            raise IndexError(f"{len(self.bounds)} indices are needed")
        position = 0
        for index, (low, high) in zip(indices, self.bounds, strict=True):
            if not low <= index <= high:
                raise IndexError(f"index {index} is outside {low}..{high}")
            position = position * (high - low + 1) + index - low
        return position * self.stride


def _fold(flat: list[Value], lengths: Sequence[int]) -> list[Value]:
    for length in reversed(lengths[1:]):
        flat = [flat[i : i + length] for i in range(0, len(flat), length)]
    return flat


@dataclass(frozen=True)
class Part:
    """A member of a record; `listed` if it belongs to the state, `constant` if it is not for writing."""

    offset: int
    node: Node
    listed: bool = True
    constant: bool = False


@dataclass(frozen=True)
class RecordNode:
    """A structure, function block or program; `parts` by upper-case name in the order of declaration."""

    size: int
    parts: dict[str, Part] = field(default_factory=dict)

    def read(self, memory: Memory, offset: int) -> Value:
        parts = self.parts.items()
        return {name: part.node.read(memory, offset + part.offset) for name, part in parts if part.listed}

    def write(self, memory: Memory, offset: int, value: Value) -> None:
        """Put a dict; members that it does not name stay."""
        if not isinstance(value, dict):
            raise ValueError(f"{value!r} is no dict")
        for name, each in value.items():
            part = self.parts.get(name.upper())
            if part is None:
                raise ValueError(f"there is no member {name!r}")
            if part.constant:
                raise ValueError(f"{name} is a CONSTANT")
            part.node.write(memory, offset + part.offset, each)

    def leaves(self, path: str, offset: int) -> Iterator[tuple[str, int, Scalar]]:
        """Every scalar of every listed member."""
        dot = f"{path}." if path else ""
        for name, part in self.parts.items():
            if part.listed:
                yield from part.node.leaves(dot + name, offset + part.offset)


@dataclass(frozen=True)
class PointerNode:
    """A pointer to a variable that lives elsewhere: a global, or a place that an AT names."""

    target: Node

    @property
    def size(self) -> int:
        """Bytes of the pointer itself."""
        return ctypes.sizeof(ctypes.c_void_p)

    def follow(self, memory: Memory, offset: int) -> Memory:
        """Give the memory that the pointer shows. Raises ValueError if it is NULL."""
        address = ctypes.c_void_p.from_buffer(memory, offset).value
        if not address:
            raise ValueError("the variable has no place yet")
        return (ctypes.c_char * self.target.size).from_address(address)

    def read(self, memory: Memory, offset: int) -> Value:
        """Read what the pointer shows."""
        return self.target.read(self.follow(memory, offset), 0)

    def write(self, memory: Memory, offset: int, value: Value) -> None:
        """Write what the pointer shows."""
        self.target.write(self.follow(memory, offset), 0, value)

    def leaves(self, _path: str, _offset: int, /) -> Iterator[tuple[str, int, Scalar]]:
        """Give nothing: what lives elsewhere is no state of its user."""
        yield from ()


class Snapshot:
    """Reads all leaves of a node in one go; made for calls after every scan."""

    def __init__(self, node: Node) -> None:
        leaves = list(node.leaves("", 0))
        self._paths = [path for path, _, _ in leaves]
        order = sorted(range(len(leaves)), key=lambda i: leaves[i][1])
        in_memory = [leaves[i] for i in order]
        self._format = struct.Struct("=" + _format(in_memory))
        self._joined = [leaf for _, _, leaf in in_memory] if any(leaf.fields > 1 for _, _, leaf in leaves) else None
        # Interface variables lie first in memory wherever they are declared.
        self._order = None if order == list(range(len(leaves))) else _inverse(order)

    def read(self, memory: Memory) -> dict[str, Value]:
        """Path in upper case -> value, in declaration order."""
        values: Sequence[Value] = self._format.unpack_from(memory)
        if self._joined is not None:
            values = list(_join(self._joined, values))
        if self._order is not None:
            values = [values[i] for i in self._order]
        return dict(zip(self._paths, values, strict=True))


def _inverse(order: Sequence[int]) -> list[int]:
    """The place of each leaf in memory order."""
    places = [0] * len(order)
    for place, leaf in enumerate(order):
        places[leaf] = place
    return places


def _join(leaves: Sequence[Scalar], values: Sequence[Any]) -> Iterator[Value]:
    at = 0
    for leaf in leaves:
        if leaf.fields == 1:
            yield values[at]
        else:
            yield leaf.join(values[at : at + leaf.fields])
        at += leaf.fields


def _format(leaves: Sequence[tuple[str, int, Scalar]]) -> str:
    """One format for all leaves; equal neighbours are counted, gaps are passed over."""
    parts: list[tuple[int, str]] = []
    at = 0
    for _, offset, leaf in leaves:
        if offset > at:
            parts.append((offset - at, "x"))
        if parts and parts[-1][1] == leaf.code and leaf.fields == 1:
            parts[-1] = (parts[-1][0] + 1, leaf.code)
        else:
            parts.append((1, leaf.code))
        at = offset + leaf.size
    return "".join(f"{count}{code}" if count > 1 or code == "x" else code for count, code in parts)
