"""Frames inside pasted bytes: several glued together, or one with something before or after it."""

from dataclasses import dataclass

from driveblocks.modbus import layout
from driveblocks.modbus.checksum import crc_bytes
from driveblocks.modbus.envelope import mode_of, open_
from driveblocks.modbus.frame import RTU_BYTES
from driveblocks.modbus.layout import Dialect


@dataclass(frozen=True)
class Piece:
    """Consecutive bytes: one good frame, or what is none."""

    start: int
    data: bytes
    good: bool


def pieces(data: bytes, dialect: Dialect) -> tuple[Piece, ...]:
    """Cut bytes into good frames and what is between them."""
    return _ascii(data) if mode_of(data) == "ascii" else _rtu(data, dialect)


def _rtu(data: bytes, dialect: Dialect) -> tuple[Piece, ...]:
    found: list[Piece] = []
    at = between = 0
    while at < len(data):
        size = size_of(data[at : at + RTU_BYTES], dialect)
        if size == 0:
            at += 1
            continue
        if at > between:
            found.append(Piece(between, data[between:at], good=False))
        found.append(Piece(at, data[at : at + size], good=True))
        at = between = at + size
    if between < len(data):
        found.append(Piece(between, data[between:], good=False))
    return tuple(found)


def size_of(data: bytes, dialect: Dialect) -> int:
    """The length of the longest good RTU frame that bytes begin with; 0 if they begin with none.

    One reply in 65536 begins with what would be a request with its checksum. A good frame with 00 after it has a right
    checksum, too: the 00 is a part of it unless a good broadcast begins there.
    """
    sizes = set(layout.expected_sizes(data, dialect))
    good = {size + 2 for size in sizes if size >= 3 and _sealed(data[: size + 2], size)}
    longest = max(good, default=0)
    return longest - (longest - 1 in good and size_of(data[longest - 1 :], dialect) > 0)


def _sealed(data: bytes, size: int) -> bool:
    return len(data) == size + 2 and crc_bytes(data[:size]) == data[size:]


def _ascii(data: bytes) -> tuple[Piece, ...]:
    starts = [at for at, byte in enumerate(data) if byte == ord(":")]
    ends = [*starts[1:], len(data)]
    found = []
    for start, end in zip(starts, ends, strict=True):
        wire = open_(data[start:end])
        found.append(Piece(start, data[start:end], wire.right and not wire.broken))
    return tuple(found)
