"""Open requests and replies to begin with: those of the manuals' frames, and others by the reference model."""

import random
from collections.abc import Iterator
from dataclasses import dataclass

from tests.blocks import damage, vectors
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.framing import ascii_decode, rtu_open
from driveblocks.reference.request import Asked

LINES_PER_DRIVE = 24
_FIELDS = ("unit", "function", "address", "quantity", "sub_function", "value")


@dataclass(frozen=True)
class Line:
    """An open request and bodies (unit address, function code, data) that may come while it is open."""

    asked: Asked
    bodies: tuple[bytes, ...]


def lines(drive: Drive) -> list[Line]:
    """What a drive's reply blocks begin with, the same each time."""
    chance = random.Random(f"sanitize {drive.prefix}")
    drawn = (damage.line(drive, chance, in_ascii=False) for _ in range(LINES_PER_DRIVE))
    return [*_printed(drive), *(Line(each.asked, tuple(each.bodies)) for each in drawn), _longest(chance)]


def _printed(drive: Drive) -> Iterator[Line]:
    for frame in drive.frames:
        if frame.direction == "reply":
            opened = ascii_decode(frame.correct) if frame.mode == "ascii" else rtu_open(frame.correct)
            for asked in vectors.questions(drive, frame):
                yield Line(asked, (opened.data,))


def _longest(chance: random.Random) -> Line:
    """A read of 125 registers, the most that a frame carries."""
    body = bytes((1, 3, 250)) + chance.randbytes(250)
    return Line(Asked(3, 1, 0, 125), (body, bytes((1, 3, 0)) + body[2:], body[:-1], bytes((1, 0x83, 2))))


def tables() -> tuple[str, dict[str, tuple[int, int]]]:
    """The C tables LINES, BODIES and BODY_BYTES; and first line and number of lines by prefix of a drive."""
    spans: dict[str, tuple[int, int]] = {}
    rows: list[str] = []
    places: list[str] = []
    data = b""
    for prefix, drive in drives().items():
        own = lines(drive)
        spans[prefix] = (len(rows), len(own))
        for line in own:
            asked = ", ".join(str(getattr(line.asked, name)) for name in _FIELDS)
            rows.append(f"{{{{{asked}}}, {len(places)}, {len(line.bodies)}}}")
            for body in line.bodies:
                places.append(f"{{{len(data)}, {len(body)}}}")
                data += body
    text = (
        f"static const uint8_t BODY_BYTES[] = {{{', '.join(map(str, data))}}};\n"
        f"static const Body BODIES[] = {{{', '.join(places)}}};\n"
        f"static const Line LINES[] = {{{', '.join(rows)}}};\n"
    )
    return text, spans
