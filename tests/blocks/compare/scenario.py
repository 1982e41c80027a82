"""Inputs that must hang together: frames and replies, right and damaged; requests near a drive's limits; commands.

What the blocks must make of them is judged elsewhere against the reference model; here they only have to get far.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import islice

from tests.blocks import answering, wire
from tests.blocks.asking import Asking
from tests.blocks.compare.pou import Pou
from tests.blocks.compare.value import Values
from tests.blocks.damage import Line, damaged, frame, line
from tests.shipped import drives
from tests.structured_text.engines.compare.scenarios import Inputs

from driveblocks.maps.model import Drive
from driveblocks.reference.reply import Dialect, dialect
from driveblocks.reference.request import Asked
from structured_text.engines.engine import Value

PER_LINE = 8
"""Replies to one open request before the next."""

Scenario = Callable[[Pou, Values, random.Random], Iterator[Inputs]]


def scenario(pou: Pou, values: Values, seed: int) -> Iterator[Inputs] | None:
    """The scenario of a POU, if there is one for its kind."""
    make = SCENARIOS.get(kind_of(pou))
    return make(pou, values, random.Random(f"{pou.name} {seed}")) if make is not None else None


def kind_of(pou: Pou) -> str:
    """The name of a POU after the prefix of its layer or drive."""
    return pou.name.partition("_")[2]


def _drives(pou: Pou) -> list[Drive]:
    """The drive of a drive's block, or all."""
    own = drives().get(pou.name.partition("_")[0])
    return [own] if own is not None else list(drives().values())


def _lines(pou: Pou, chance: random.Random, in_ascii: bool) -> Iterator[tuple[Drive, Line]]:
    """Open requests with the frames around them; every fourth reads as many words as a frame can carry."""
    drives = _drives(pou)
    while True:
        drive = chance.choice(drives)
        yield drive, _long_read(drive, chance, in_ascii) if chance.random() < 0.25 else line(drive, chance, in_ascii)


def _long_read(drive: Drive, chance: random.Random, in_ascii: bool) -> Line:
    asked = answering.questions(chance.choice([1, 247]), [3, 4], 125, [0, 0x1000, 0xFF83], chance)
    bodies = [answering.good(dialect(drive), asked, chance), answering.good(Dialect(), asked, chance)]
    return Line(asked, bodies, [frame(body, in_ascii) for body in bodies])


# ------------------------------------------------------------ frames and replies


def rtu_frames(pou: Pou, _: Values, chance: random.Random) -> Iterator[Inputs]:
    """Received RTU frames, right and damaged; sometimes with another length than they have."""
    for _drive, opened in _lines(pou, chance, False):
        for data in damaged(opened, False, PER_LINE, chance):
            yield {"AduLength": _length(data, chance), "Adu": data[:256]}


def ascii_frames(pou: Pou, _: Values, chance: random.Random) -> Iterator[Inputs]:
    """Received ASCII frames, right and damaged; sometimes with another length than they have."""
    for _drive, opened in _lines(pou, chance, True):
        for data in damaged(opened, True, PER_LINE, chance):
            yield {"CharCount": _length(data, chance), "Chars": data[:513]}


def _length(data: bytes, chance: random.Random) -> int:
    return len(data) if chance.random() < 0.95 else chance.choice([0, 1, 4, 10, 255, 256, 257, 513, 514, 65535])


def replies(pou: Pou, _: Values, chance: random.Random) -> Iterator[Inputs]:
    """Bodies of replies with the request that is open; sometimes a request that is none."""
    for drive, opened in _lines(pou, chance, False):
        asked = _request(opened.asked, chance)
        settings = _settings(drive) if pou.name.startswith("MB_") else {}
        yield {**asked, **settings, **_body(opened.bodies[0], chance)}
        for body in _bodies(opened, chance):
            yield _body(body, chance)
        yield _echo(opened.asked, chance)
        yield _nothing(opened.asked)


def _bodies(opened: Line, chance: random.Random) -> Iterator[bytes]:
    """Right bodies, and damaged ones without their checksum."""
    for data in damaged(opened, False, PER_LINE, chance):
        yield chance.choice(opened.bodies) if chance.random() < 0.3 else data[:-2]


def _echo(asked: Asked, chance: random.Random) -> Inputs:
    """A reply that repeats its request, or all but one bit; of a function that does so, or of one that nobody knows."""
    written = replace(asked, function=chance.choice([5, 6, 8, 16]))
    pairs = {8: (written.sub_function, written.value), 16: (written.address, written.quantity)}
    first, second = pairs.get(written.function, (written.address, written.value))
    flip = chance.choice([0, 1 << chance.randrange(32)])
    data = ((first << 16 | second) ^ flip).to_bytes(4, "big")
    return {**_pins(written), "Length": 6, "Adu": bytes([written.unit, written.function]) + data}


def _nothing(asked: Asked) -> Inputs:
    """A reply of no words to a read of no registers: no request block builds one, but a parser may get it."""
    read = replace(asked, function=3, quantity=0)
    return {**_pins(read), "Length": 3, "Adu": bytes([read.unit, 3, 0])}


def _body(body: bytes, chance: random.Random) -> Inputs:
    return {"Length": _length(body, chance), "Adu": body[:256]}


def _request(asked: Asked, chance: random.Random) -> dict[str, Value]:
    request = _pins(asked)
    if chance.random() < 0.2:
        request[chance.choice(list(request))] = chance.choice([0, 1, 2, 125, 126, 0x5001, 0x8000, 65535])
    return request


def _pins(asked: Asked) -> dict[str, Value]:
    return {f"Request.{name}": value for name, value in wire.opened(asked).items()}


def _settings(drive: Drive) -> Inputs:
    """The pins of the generic parser that say how a drive refuses."""
    spoken = dialect(drive)
    return {
        "ExceptionAdd": spoken.add or 0,
        "ErrorFunction": spoken.function or 0,
        "ErrorAddress": spoken.address or 0,
        "TwoByteCount": spoken.two_byte_count,
    }


# ------------------------------------------------------------ requests and commands


def requests(pou: Pou, _: Values, chance: random.Random) -> Iterator[Inputs]:
    """Requests near the limits of the drive, or with a count that no ASCII frame carries, or past the end."""
    (drive,) = _drives(pou)
    asking = Asking(drive, str(chance.random()))
    limits = [*asking.limits()]
    most, fits = asking.model.rtu, asking.model.ascii
    counts = sorted({fits.read + 1, most.read, fits.write + 1, most.write, 1})
    while True:
        asked = chance.choice(limits) if chance.random() < 0.3 else asking.any()
        if chance.random() < 0.2:
            asked = replace(asking.plain(), ascii=True, quantity=chance.choice(counts))
        elif chance.random() < 0.1:
            asked = replace(asking.plain(), address=0xFFFF, quantity=2)
        pins = wire.pins(asked)
        if chance.random() < 0.6:
            del pins["Words"]
        yield pins


def builds(pou: Pou, values: Values, chance: random.Random) -> Iterator[Inputs]:
    """Requests that the builders take, some with one pin at random, and some that run past the last register."""
    draw = {pin.path: values.of(pin) for pin in pou.pins}
    while True:
        pins: Inputs = {
            "UnitAddress": chance.randint(1, 247),
            "FunctionCode": chance.choice([3, 4]),
            "Address": chance.choice([chance.randrange(0x10000), 0xFFFF - chance.randrange(130)]),
            "Quantity": chance.randint(1, 125),
            "MaxWords": chance.choice([125, 123, chance.randint(1, 125)]),
        }
        off = chance.choice(list(draw))
        more = {path: draw[path]() for path in draw if path not in pins or (path == off and chance.random() < 0.5)}
        yield {**{path: value for path, value in pins.items() if path in draw}, **more}


def commands(pou: Pou, values: Values, chance: random.Random) -> Iterator[Inputs]:
    """Mostly enabled, with no more than a few pins at a time, and held for some scans."""
    switches = [pin.path for pin in pou.pins if not pin.path.startswith("Keep")]
    others = [(pin.path, values.of(pin)) for pin in pou.pins if pin.path.startswith("Keep")]
    while True:
        chosen = chance.sample(switches, chance.choice([0, 1, 1, 1, 2, 2, 3]))
        pins: Inputs = {name: name in chosen for name in switches}
        yield {**pins, "Enable": chance.random() < 0.9, **{path: draw() for path, draw in others}}
        yield from islice(iter(dict, None), chance.choice([0, 0, 1, 2]))


SCENARIOS: dict[str, Scenario] = {
    "RtuOpen": rtu_frames,
    "AsciiDecode": ascii_frames,
    "ParseReply": replies,
    "Reply": replies,
    "Request": requests,
    "BuildRead": builds,
    "BuildWriteSingle": builds,
    "BuildWriteMultiple": builds,
    "BuildDiagnostics": builds,
    "Command": commands,
}
