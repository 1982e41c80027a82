"""Damaged replies, cheaply and many: bits and bytes changed, cut, extended, spliced, with a fitting checksum or not."""

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tests.blocks import answering

from driveblocks.maps.model import Drive
from driveblocks.reference.framing import ascii_encode, rtu_seal
from driveblocks.reference.reply import Dialect, dialect
from driveblocks.reference.request import Asked

HEX = b"0123456789ABCDEFabcdef:\r\n"


@dataclass(frozen=True)
class Line:
    """One open request and frames that may come while it is open: right answers, refusals, answers to others."""

    asked: Asked
    bodies: list[bytes]
    frames: list[bytes]


def frame(body: bytes, in_ascii: bool) -> bytes:
    """A body as it comes on the wire; a body that no frame can carry comes as it is."""
    made = ascii_encode(body) if in_ascii else rtu_seal(body)
    return made.data or body


def line(drive: Drive, chance: random.Random, in_ascii: bool) -> Line:
    """A random request and frames around it."""
    spoken = dialect(drive)
    places = [0, 0x1000, 0x2000, 0xFFFF, spoken.address or 0x5001]
    asked = answering.questions(chance.choice([1, 2, 247]), [3, 3, 3, 4, 6, 8, 16], 16, places, chance)
    others = [answering.questions(asked.unit, [3, 4, 6, 8, 16], 16, places, chance) for _ in range(4)]
    bodies = [answering.good(spoken, asked, chance) for _ in range(4)]
    bodies += [answering.refusal(spoken, asked, chance.randrange(256)) for _ in range(2)]
    bodies += [answering.good(Dialect(), other, chance) for other in others]
    return Line(asked, bodies, [frame(body, in_ascii) for body in bodies])


def damaged(wire: Line, in_ascii: bool, count: int, chance: random.Random) -> Iterator[bytes]:
    """So many frames; one in thirty stays as it was."""
    draw, octets = chance.random, chance.randbytes
    ways: tuple[Callable[[bytes, bytes], bytes], ...] = (
        lambda one, _: flipped(one, draw),
        lambda one, _: replaced(one, draw, HEX if in_ascii else None),
        lambda one, _: one[: int(draw() * len(one))],
        lambda one, _: one + octets(1 + int(draw() * 4)),
        lambda one, other: one[: int(draw() * len(one))] + other[int(draw() * len(other)) :],
        lambda one, _: one + octets(1 + int(draw() * 600)) if draw() < 0.1 else flipped(one, draw),
    )
    some, bodies = len(ways), wire.bodies
    for _ in range(count):
        at = int(draw() * len(bodies))
        other = int(draw() * len(bodies))
        way = ways[int(draw() * some)]
        kind = draw()
        if kind < 0.03:
            yield wire.frames[at]
        elif kind < 0.5:
            yield way(wire.frames[at], wire.frames[other])
        else:
            yield frame(way(bodies[at], bodies[other]), in_ascii)


def flipped(data: bytes, draw: Callable[[], float]) -> bytes:
    """One bit the other way."""
    if not data:
        return data
    at = int(draw() * 8 * len(data))
    return data[: at >> 3] + bytes((data[at >> 3] ^ 1 << (at & 7),)) + data[(at >> 3) + 1 :]


def replaced(data: bytes, draw: Callable[[], float], letters: bytes | None) -> bytes:
    """One byte another one; in ASCII mostly a character that frames are made of."""
    at = int(draw() * len(data))
    byte = int(draw() * 256) if letters is None or draw() < 0.2 else letters[int(draw() * len(letters))]
    return data[:at] + bytes((byte,)) + data[at + 1 :]
