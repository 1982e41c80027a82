"""The fields of a body by function and direction, by the MODBUS Application Protocol V1.1b3, 6.1 to 6.12 and 7.

A body is unit address, function code and data, without checksum.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

Direction = Literal["request", "reply"]
DIRECTIONS: tuple[Direction, Direction] = ("request", "reply")

WORDS_OF: dict[tuple[int, Direction], tuple[str, ...]] = {
    **{(function, "request"): ("address", "quantity") for function in (1, 2, 3, 4)},
    **{(function, direction): ("address", "value") for function in (5, 6) for direction in DIRECTIONS},
    (7, "request"): (),
    **{(8, direction): ("sub-function", "data word") for direction in DIRECTIONS},
    **{(function, direction): ("address", "quantity") for function in (15, 16) for direction in DIRECTIONS},
    **{(function, "reply"): () for function in (1, 2, 3, 4)},
}
"""The words that every frame of a kind begins with."""

_COUNTED = {*((function, "reply") for function in (1, 2, 3, 4)), (15, "request"), (16, "request")}
"""What ends with a byte count and as many bytes."""

_WORDS = frozenset({3, 4, 16})
"""Functions whose counted bytes are registers."""

_READ_BITS = frozenset({1, 2})
"""Reads of coils and discrete inputs, eight to a byte."""
COIL_ON = 0xFF00
"""What is written to a coil that becomes 1 (MODBUS Application Protocol V1.1b3, 6.5)."""

KNOWN = frozenset({1, 2, 3, 4, 5, 6, 7, 8, 15, 16})
IDENTIFY = frozenset({17, 43})
"""What a unit says of itself: no length of a request or reply is known, but that of a refusal."""


@dataclass(frozen=True)
class Dialect:
    """How a drive refuses, and what is tolerated. By default: what the standard says."""

    add: int | None = 0x80
    """A refusal is function code + add with one byte of reason."""
    function: int | None = None
    address: int | None = None
    """A refusal is a reply of this function at this address, with a word of reason."""
    two_byte_count: bool = False

    @property
    def added(self) -> int:
        """What is added to the function code where a refusal has the form of an exception."""
        return 0x80 if self.add is None else self.add


@dataclass(frozen=True)
class Part:
    """One field: its name and its bytes."""

    name: str
    data: bytes

    @property
    def number(self) -> int:
        """The bytes as a number, high byte first."""
        return int.from_bytes(self.data, "big")


@dataclass(frozen=True)
class Layout:
    """A body taken apart in one direction, as far as possible."""

    direction: Direction
    body: bytes
    parts: tuple[Part, ...]
    size: int
    """Bytes that a body of this kind has; more than there are if some are missing."""
    refusal: bool = False
    two_byte_count: bool = False

    @property
    def missing(self) -> int:
        """Bytes that are missing; negative if there are too many."""
        return self.size - len(self.body)

    @property
    def fits(self) -> bool:
        """Whether the length is right and the byte count agrees with what it counts."""
        return self.missing == 0 and self.agrees

    @property
    def agrees(self) -> bool:
        """Whether the byte count is even for registers and fits the quantity."""
        count = self.number("byte count")
        if count is None:
            return True
        words = self.body[1] in _WORDS
        quantity = self.number("quantity")
        wanted = quantity if quantity is None or words else -(-quantity // 8)
        return not (words and count % 2) and count > 0 and wanted in (None, count // 2 if words else count)

    def part(self, name: str) -> Part | None:
        return next((part for part in self.parts if part.name == name), None)

    def number(self, name: str) -> int | None:
        """The number in a field, or None without such a field."""
        found = self.part(name)
        return found.number if found else None

    @property
    def function(self) -> int:
        """The function that was asked, also of a refusal in the form of an exception."""
        asked = self.number("refused function")
        return self.body[1] if asked is None else asked

    @property
    def words(self) -> tuple[int, ...]:
        if self.body[1] == 6 and not self.refusal:
            value = self.number("value")
            return () if value is None else (value,)
        data = self.part("data")
        if data is None or self.body[1] not in _WORDS:
            return ()
        return tuple(int.from_bytes(data.data[at : at + 2], "big") for at in range(0, len(data.data) - 1, 2))

    def values(self, count: int) -> tuple[int, ...]:
        """What a reply to a read of `count` carries: registers, or coils, each 0 or 1; none if they are not as many."""
        data = self.part("data")
        if self.refusal or data is None or self.body[1] not in _READ_BITS:
            return self.words if len(self.words) == count else ()
        bits = tuple(byte >> bit & 1 for byte in data.data for bit in range(8))
        return bits[:count] if len(data.data) == bytes_of(count) else ()


def reply_size(request: bytes) -> int:
    """Bytes of the reply to a read, without checksum."""
    count = int.from_bytes(request[4:6], "big")
    return 3 + (bytes_of(count) if request[1] in _READ_BITS else 2 * count)


def bytes_of(bits: int) -> int:
    """Bytes that a number of coils takes."""
    return (bits + 7) // 8


def take(body: bytes, direction: Direction, dialect: Dialect) -> Layout:
    """Take a body of at least two bytes apart."""
    if direction == "reply":
        refusal = _exception(body, dialect) or _write_reply(body, dialect)
        if refusal is not None:
            return refusal
    return granted(body, direction)


def readings(body: bytes, dialect: Dialect) -> tuple[Layout, ...]:
    """The body as a request and as a reply: the directions that fit, else those of the right length, else both."""
    both = tuple(take(body, direction, dialect) for direction in DIRECTIONS)
    fitting = tuple(layout for layout in both if layout.fits)
    return fitting or tuple(layout for layout in both if layout.missing == 0) or both


def _exception(body: bytes, dialect: Dialect) -> Layout | None:
    add = dialect.added
    if body[1] < add or (add != 0x80 and body[1] - add not in KNOWN):
        return None
    parts = [Part("unit", body[:1]), Part("function", body[1:2]), Part("reason", body[2:3])]
    known = Part("refused function", bytes([body[1] - add]))
    return Layout("reply", body, (*_filled(parts), known, *_surplus(body[3:])), 3, refusal=True)


def _write_reply(body: bytes, dialect: Dialect) -> Layout | None:
    if dialect.address is None or body[1] != dialect.function:
        return None
    if body[2:4] != dialect.address.to_bytes(2, "big"):
        return None
    parts = [Part("unit", body[:1]), Part("function", body[1:2]), Part("address", body[2:4]), Part("reason", body[4:6])]
    return Layout("reply", body, (*_filled(parts), *_surplus(body[6:])), 6, refusal=True)


def granted(body: bytes, direction: Direction) -> Layout:
    """Take a body apart that refuses nothing."""
    kind = (body[1], direction)
    head = [Part("unit", body[:1]), Part("function", body[1:2])]
    if kind == (7, "reply"):
        return Layout(direction, body, (*head, *_filled([Part("status", body[2:3])]), *_surplus(body[3:])), 3)
    if kind not in WORDS_OF:
        return Layout(direction, body, (*head, *_filled([Part("data", body[2:])])), len(body))
    at = 2
    for name in WORDS_OF[kind]:
        head.append(Part(name, body[at : at + 2]))
        at += 2
    if kind not in _COUNTED:
        return Layout(direction, body, (*_filled(head), *_surplus(body[at:])), at)
    wide = _is_wide(body, at)
    behind = at + 1 + wide
    count = int.from_bytes(body[at:behind], "big")
    tail = [Part("byte count", body[at:behind]), Part("data", body[behind : behind + count])]
    size = behind + (count if len(body) >= behind else 2)
    parts = (*_filled([*head, *tail]), *_surplus(body[behind + count :]))
    return Layout(direction, body, parts, size, two_byte_count=wide)


@lru_cache(1024)
def request(body: bytes) -> Layout | None:
    """A request as the standard has it; None if its length is wrong. Of other functions nobody knows the length."""
    found = granted(body, "request") if len(body) >= 2 else None
    return None if found is None or found.missing or found.two_byte_count else found


def _is_wide(body: bytes, at: int) -> bool:
    """Whether the byte count is a word: a count of 0 would carry nothing, and the next byte counts what follows."""
    return (
        body[1] in _WORDS
        and body[at : at + 1] == b"\0"
        and body[at + 1 : at + 2] == bytes([(len(body) - at - 2) & 255])
    )


def _filled(parts: list[Part]) -> Iterator[Part]:
    return (part for part in parts if part.data)


def _surplus(data: bytes) -> Iterator[Part]:
    if data:
        yield Part("surplus", data)


def expected_sizes(data: bytes, dialect: Dialect) -> Iterator[int]:
    """How long a body that begins like this may be; nothing for functions that are not known here."""
    if len(data) >= 2 and data[1] - dialect.added in IDENTIFY:
        yield 3
    if len(data) < 2 or not {data[1], data[1] - dialect.added} & KNOWN:
        return
    for direction in DIRECTIONS:
        layout = take(data, direction, dialect)
        if layout.function in KNOWN:
            yield layout.size
