"""What a first run begins with: the manuals' frames, requests and replies by the reference model, for each target."""

from collections.abc import Iterator

from tests.blocks import vectors
from tests.native.sanitize.seeds import lines
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.framing import ascii_encode, rtu_seal
from driveblocks.reference.reply import Dialect, dialect
from driveblocks.reference.request import Asked

ASCII, MADE = 1, 2
"""Flags: the framing; and whether the program makes the frame around the bytes."""


def seeds(target: str) -> list[bytes]:
    """Inputs of a target, in the form that `targets.h` reads. Raises KeyError for an unknown target."""
    if target == "rtu_open":
        return [rtu_seal(body).data for body in _bodies()]
    if target == "ascii_decode":
        return [ascii_encode(body).data for body in _bodies()]
    if target == "parse_reply":
        return [each for drive in drives().values() for each in _parses(drive)]
    prefix, _, kind = target.upper().partition("_")
    make = {"REPLY": _replies, "REQUEST": _requests}[kind]
    return list(make(drives()[prefix]))


def _bodies() -> list[bytes]:
    return [line.bodies[0] for drive in drives().values() for line in lines(drive)[:6]] + [
        lines(drives()["CHF"])[-1].bodies[0]
    ]


def settings(dialect: Dialect, asked: Asked, body: bytes) -> bytes:
    """An input of parse_reply."""
    form = _words(dialect.add or 0, dialect.function or 0, dialect.address or 0)
    return bytes([int(dialect.two_byte_count)]) + form + fields(asked) + body


def fields(asked: Asked) -> bytes:
    """An open request, as `asked` reads it."""
    return _words(asked.unit, asked.function, asked.address, asked.quantity, asked.sub_function, asked.value)


def _parses(drive: Drive) -> Iterator[bytes]:
    for line in lines(drive)[:12]:
        yield from (settings(dialect(drive), line.asked, body) for body in line.bodies[:5:2])


def _replies(drive: Drive) -> Iterator[bytes]:
    """Bodies that the program frames, and frames as they come."""
    for line in lines(drive)[:12]:
        for body in line.bodies[:5:2]:
            yield bytes([MADE]) + fields(line.asked) + body
            yield bytes([MADE | ASCII]) + fields(line.asked) + body
        yield bytes([0]) + fields(line.asked) + rtu_seal(line.bodies[0]).data
        yield bytes([ASCII]) + fields(line.asked) + ascii_encode(line.bodies[0]).data


def _requests(drive: Drive) -> Iterator[bytes]:
    printed = [vectors.asked(frame) for frame in drive.frames if frame.direction == "request"]
    for asked in [*printed, *(line.asked for line in lines(drive))]:
        yield bytes([int(asked.ascii)]) + fields(asked) + _words(*asked.words)


def _words(*words: int) -> bytes:
    return b"".join(word.to_bytes(2, "big") for word in words)
