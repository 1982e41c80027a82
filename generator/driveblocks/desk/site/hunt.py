"""Finds a drive on a line that nobody else speaks on: it listens first, then reads, and never writes."""

from dataclasses import replace

from driveblocks.desk.master import REPEAT_US, Reply
from driveblocks.desk.site.family import span_of
from driveblocks.desk.site.found import Asker, Fault, Found, Line, Trouble, Way
from driveblocks.desk.site.line import RATES
from driveblocks.desk.site.talk import LOOK, Talk, ended
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import identity_read, polls
from driveblocks.meaning.serial import serial
from driveblocks.modbus.layout import Dialect
from driveblocks.modbus.scan import pieces

QUIET_US = 60_000_000
"""Silence before anything is sent."""
BOUND_US = 600_000_000
"""The search ends after this time."""
SOON_US, LATE_US = 200_000, 1_200_000
"""How long a reply is waited for: in the search, and where a unit is known."""
TRIES = 3
NAMED = 4
"""How often all is tried where a person has named the only way."""
LIKELY = 4
WORST: tuple[Trouble, ...] = ("silent", "echo", "damaged", "half")
"""What a search without a drive has heard, from the least to what says most."""
SAID: dict[Trouble, str] = {
    "silent": "no drive answers", "echo": "the adapter hears itself, and no drive",
    "damaged": "something answers, and every answer is damaged", "half": "only parts of answers come",
}  # fmt: skip


def quiet(line: Line, ways: list[Way], asker: Asker, quiet_us: int = QUIET_US) -> Fault | None:
    """Listen for a time, at each rate in its turn; what was heard."""
    kinds = _kinds(ways)
    begun, share = line.now_us(), quiet_us // len(kinds)
    heard, here = b"", kinds[0]
    for at, way in enumerate(kinds, 1):
        while line.now_us() < begun + at * share and not heard:
            asker.progress((line.now_us() - begun) / 1e6, quiet_us / 1e6, f"listening at {way.rate} bit/s")
            if line.tune(way):
                here, heard = way, line.hear(min(1_000_000, begun + at * share - line.now_us()))
            else:
                break
    if not heard and line.now_us() < begun + quiet_us:
        heard = line.hear(begun + quiet_us - line.now_us())
    return _named(line, ways, here, heard) if heard else None


def while_typed(line: Line, ways: list[Way]) -> Fault | None:
    """What came since the quiet minute, while a person read and typed; the port is as `quiet` has left it."""
    heard = line.hear(0)
    return _named(line, ways, _kinds(ways)[-1], heard) if heard else None


def _kinds(ways: list[Way]) -> list[Way]:
    """The first way of each rate."""
    return list({each.rate: each for each in reversed(ways)}.values())[::-1]


def _named(line: Line, ways: list[Way], here: Way, heard: bytes) -> Fault:
    """Who speaks: what was heard in a way, then what comes in each of them."""
    for way in (None, *ways):
        if way is not None:
            here, heard = way, _some(line) if line.tune(way) else b""
        if _decodes(heard):
            text = f"another master speaks on this line, at {here}; nothing was sent"
            return Fault("foreign", text, LOOK["foreign"])
    said = "bytes came that made no frame: noise, or another master that speaks rarely; nothing was sent"
    return Fault("noise", said, LOOK["noise"])


def _some(line: Line) -> bytes:
    """What comes within some seconds, or until there is a frame."""
    end, heard = line.now_us() + 3_000_000, b""
    while line.now_us() < end and not _decodes(heard):
        heard += line.hear(end - line.now_us())
    return heard


def _decodes(heard: bytes) -> bool:
    return any(each.good for each in pieces(heard, Dialect()))


def ways(drive: Drive, rate: int | None = None, form: str | None = None, mode: str | None = None) -> list[Way]:
    """Rates, formats and modes of a map, the factory's first; those that a person names are the only ones."""
    named = serial(drive).rates
    rates = [*named[:1], *(each for each in (9600, 19200) if each in named[1:]), *named[1:]] or [9600, 19200, *RATES]
    modes = sorted(serial(drive).modes, key=lambda one: one != "rtu")
    forms = [one.form for one in serial(drive).characters if one.parity == "N" or one.stops == 1]
    forms = forms or ["8N1", "8E1", "8O1", "8N2"]
    found = [
        Way(each, shape, kind)
        for kind in modes
        for shape in (forms if form is None else [form])
        for each in (rates if rate is None else [rate])
        if mode in (None, kind) and not (shape[0] == "7" and kind == "rtu")
    ]
    return list(dict.fromkeys(found)) or [Way(rate or 9600, form or "8N1")]


def units(drive: Drive, unit: int | None = None) -> list[int]:
    """Addresses, the factory's and the usual ones first."""
    if unit is not None:
        return [unit]
    every = range(max(1, serial(drive).lowest), serial(drive).highest + 1)
    return list(dict.fromkeys([*(each for each in (serial(drive).factory, 1, 2, 3) if each in every), *every]))


def find(talk: Talk, every: list[Way], addresses: list[int], asker: Asker, found: Found) -> Talk:
    """Search the drive: the likely addresses in every way, then the likeliest with more patience, then all.

    Raises EndedError where no drive is found.
    """
    heard, span = set[Trouble](), first_read(talk.drive)
    order = [(way, addresses[:LIKELY], SOON_US) for way in every]
    order += [(way, addresses[:1], LATE_US) for way in every]
    order += [(way, addresses[LIKELY:], SOON_US) for way in every]
    order = [(way, some, patience) for way, some, patience in order if some] * (NAMED if len(every) == 1 else 1)
    begun, done, total = talk.line.now_us(), 0, sum(len(each) for _, each, _ in order)
    before = talk.way
    for way, some, patience in order:
        for unit in some if _tuned(talk.line, way, found) else ():
            if talk.line.now_us() - begun > BOUND_US:
                raise ended("bound", f"no drive found; {done} of {total} reads were tried within 10 minutes")
            asker.progress(done, total, f"{way}, unit {unit}")
            done += 1
            here = replace(talk, way=way, unit=unit)
            here, reply = _once(here, before, span, patience, found)
            if reply.answered:
                _alone(here, span)
                found.way, found.unit = here.way, here.unit
                return here
            if reply.kind == "foreign":
                raise ended("foreign", f"address {unit}, {way}: unit {reply.unit} replies to what it was not asked")
            heard |= {one for one in WORST if one == reply.kind}
            before = here.way
    worst = next((each for each in reversed(WORST) if each in heard), WORST[0])
    raise ended(worst, SAID[worst])


def _alone(here: Talk, span: Span) -> None:
    """Whether one unit alone has this address. Raises EndedError where a second reply comes to one request, again."""
    master = here.line.master
    for _ in range(2):
        doubles = master.said.doubles
        here.read(span)
        master.rest(REPEAT_US)
        if master.said.doubles == doubles:
            return
    raise ended("two", f"two replies come to each request to unit {here.unit}")


def _once(here: Talk, before: Way, span: Span, patience: int, found: Found) -> tuple[Talk, Reply]:
    """A read of the search; where a late reply of another unit comes, that one is asked again, with patience."""
    late = next((each.layout.body[0] for each in here.line.master.quiet() if each.role == "late" and each.layout), None)
    reply = here.read(span, patience) if late is None else Reply("silent")
    if reply.kind in ("foreign", "late"):
        late = reply.unit
    for way in dict.fromkeys((*here.framings, before)) if late is not None else ():
        there = replace(here, way=way, unit=late or 0)
        there.line.tune(way)
        there.line.master.rest(LATE_US)
        again = there.read(span, LATE_US)
        if again.answered:
            found.faults.append(Fault("slow", f"the drive needs {again.after_us // 1000} ms to reply", LOOK["slow"]))
            return there, again
    here.line.tune(here.way)
    if reply.kind in ("damaged", "half", "unclear"):
        reply = _again(here, span, reply)
    return here, reply


def _tuned(line: Line, way: Way, found: Found) -> bool:
    able = line.tune(way)
    said = f"{way}" if able else f"{way}: this port cannot"
    found.tried += [said] if said not in found.tried else []
    return able


def _again(talk: Talk, span: Span, first: Reply) -> Reply:
    """An answer that was spoilt: asked for again, with patience, until one is whole."""
    for _ in range(TRIES):
        reply = talk.read(span, LATE_US)
        if reply.answered:
            return reply
    return first


def first_read(drive: Drive) -> Span:
    """What a drive is looked for by: its identity, else the status that its block reads."""
    return span_of(identity_read(drive) or polls(drive)[0])
