"""What a PLC that is its own master sends to a drive, in order, and what each request waits for.

For PLCs whose users cannot import a block. It says what the drive blocks do, in the same order, and no more.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from driveblocks.maps.form import Span, address_text, bits_text, space_of, wire
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import read_request, write_request
from driveblocks.maps.trust import second_hand
from driveblocks.meaning import polls
from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.reference import reference
from driveblocks.meaning.status import Sign, registers, status
from driveblocks.meaning.watchdog import counts_at_rest, feeds, watchdog
from driveblocks.meaning.words import Write, words
from driveblocks.modbus.checksum import crc_bytes
from driveblocks.render.environment import render

AGAIN_MS, EVERY_MS = 500, 200
"""How often a stop is repeated; how often it is read."""
TABLES = {"coil": "0", "discrete": "1", "input": "3", "holding": "4"}
"""The first digit of a number, as many PLCs count."""
LAST_READ = 4
"""Function codes up to this one read."""
HERTZ = 25
"""The speed of the example."""
FULL_HZ = 50.0
"""What 100 % is, where nobody says."""


@dataclass(frozen=True)
class Request:
    """One request, without its checksum."""

    frame: bytes
    register: int
    says: str
    until: tuple[Pattern, ...] = ()
    """What has to hold, by what is read, before the next one is sent."""
    stays_ms: int = 0
    """How long it stays before the next one."""

    @property
    def function(self) -> int:
        """Its function code."""
        return self.frame[1]

    @property
    def value(self) -> str:
        """What it writes, or how many registers it reads."""
        if self.reads:
            return f"reads {int.from_bytes(self.frame[4:6], 'big')}"
        words = self.frame[7:] if self.function == 16 else self.frame[4:]
        return f"{words.hex(' ', 2).upper()}H = {int.from_bytes(words, 'big')}"

    @property
    def reads(self) -> bool:
        """Whether it reads."""
        return self.function <= LAST_READ

    @property
    def number(self) -> str:
        """The register as many PLCs count it: 48194, and above 9999 with a digit more: 412289."""
        number = wire(self.register) + 1
        return f"{TABLES[space_of(self.register)]}{number:0{4 if number <= 9999 else 5}d}"

    @property
    def bytes(self) -> str:
        """The frame in RTU."""
        return (self.frame + crc_bytes(self.frame)).hex(" ").upper()


@dataclass(frozen=True)
class Part:
    """Some requests with what they are for."""

    title: str
    does: str
    requests: tuple[Request, ...]
    every_ms: int = 0
    """They are sent again and again so often; 0: once."""
    until: tuple[Pattern, ...] = ()
    """When that ends."""


def recipe(drive: Drive, unit: int = 1, full_scale_hz: float = FULL_HZ) -> tuple[Part, ...]:
    """All of it, the stop first. `full_scale_hz`: what 100 % is, where the reference is a part of something."""
    return tuple(_parts(drive, unit, full_scale_hz))


def page(drive: Drive, word: str, unit: int = 1, full_scale_hz: float = FULL_HZ, *, page: str = "") -> str:
    """All of it as Markdown. `word` is what the map is called in a command; `page`: the drive's, if it lies beside."""
    return render(
        "docs/Master.md.j2",
        title=drive.family.en,
        prefix=drive.prefix,
        word=word,
        page=page,
        part=reference(drive).part,
        unit=unit,
        parts=recipe(drive, unit, full_scale_hz),
        barred=never(drive),
        checked=second_hand(drive),
        longest=AGAIN_MS,
    )


def _parts(drive: Drive, unit: int, full_scale_hz: float) -> Iterator[Part]:
    shown, able = status(drive), words(drive).named
    stop = tuple(_writes(drive, unit, "stop"))
    stands = shown.standstill.patterns
    yield Part("Stop", "First, and until standstill is proved: after a power-up nobody knows what the motor does.",
               (*stop, *_reads(drive, unit, stands)), AGAIN_MS, stands)  # fmt: skip
    for sign, does in ((shown.identity, "Is it this family?"), (shown.by_bus, "Is the bus in command?")):
        if sign.patterns:
            yield Part(does, sign.why or "Without it nothing is sent but stops.",
                       tuple(_reads(drive, unit, sign.patterns)), until=sign.patterns)  # fmt: skip
    if shown.verify:
        yield Part("What the reference means", "Settings of the drive; with others the same word is another speed.",
                   tuple(_reads(drive, unit, shown.verify)), until=shown.verify)  # fmt: skip
    for sign in shown.forbids:
        yield Part("What forbids a start", f"No start while it is so: {sign.why}.",
                   tuple(_reads(drive, unit, sign.patterns, "no start while")),
                   until=tuple(each.other for each in sign.patterns))  # fmt: skip
    yield Part("Read", "From now on, all the time.", tuple(_status(drive, unit)), EVERY_MS)
    wanted = speed(drive, unit, full_scale_hz)
    yield Part(
        "Start", "Only while standstill is proved; the speed first.", (wanted, *_writes(drive, unit, "run_forward"))
    )
    last = list(_writes(drive, unit, "run_forward"))[-1:] if feeds(drive) == "run" else []
    yield Part("Keep it running", _fed(drive), (wanted, *last), _period(drive))
    yield Part("Stop again", "As above: again until standstill is proved.",
               (*stop, *_reads(drive, unit, stands)), AGAIN_MS, stands)  # fmt: skip
    if "fault_reset" in able:
        yield Part("Reset a fault", "Once its cause is gone, and with the motor at standstill; then stop again.",
                   tuple(_writes(drive, unit, "fault_reset")))  # fmt: skip


def _writes(drive: Drive, unit: int, does: str) -> Iterator[Request]:
    states = {each.name: each.pattern for each in status(drive).states}
    for write in words(drive).named[does].writes:
        frame = write_request(unit, drive, write.register, write.word)
        until = (states[write.until],) if write.until else ()
        yield Request(frame, write.register, _says(drive, write), until, write.stays_ms or write.silent_ms)


def _says(drive: Drive, write: Write) -> str:
    """What the drive does by it."""
    return words(drive).of(write).says(write.word) or "no motion; a step on the way"


def speed(drive: Drive, unit: int = 1, full_scale_hz: float = FULL_HZ) -> Request:
    """What writes the speed of the example."""
    known = reference(drive)
    counts = known.ratio * HERTZ / round(full_scale_hz) if known.part else known.ratio * HERTZ
    word, first = round(counts), min(known.registers)
    frame = write_request(unit, drive, first, word)
    if known.pair:
        halves = (word >> 16, word & 0xFFFF) if known.pair == "high_first" else (word & 0xFFFF, word >> 16)
        data = b"".join(each.to_bytes(2, "big") for each in halves)
        frame = bytes([unit, 16]) + wire(first).to_bytes(2, "big") + bytes([0, 2, 4]) + data
    return Request(frame, first, f"the speed, here {HERTZ} Hz" + _scaled(drive, full_scale_hz))


def _scaled(drive: Drive, full_scale_hz: float) -> str:
    known = reference(drive)
    if not known.scaled:
        return "; how many counts a hertz is, the manual does not say: find it out with the motor uncoupled"
    if known.part:
        return f" where {known.maximum} is {full_scale_hz:g} Hz; {float(known.ratio):g} is all of it"
    if known.in_rpm:
        return f" of a motor with one pair of poles; {float(known.ratio):g} for each hertz"
    return f"; {float(known.ratio):g} for each hertz"


def _reads(drive: Drive, unit: int, patterns: Sequence[Pattern], says: str = "check that") -> Iterator[Request]:
    """One read for each register."""
    for register in registers(patterns):
        said = " and ".join(str(each) for each in patterns if each.register == register)
        yield Request(read_request(unit, drive, Span(register, register)), register, f"{says} {said}")


def _status(drive: Drive, unit: int) -> Iterator[Request]:
    shown = status(drive).shown
    for poll in polls.polls(drive):
        if poll.fast:
            span = Span(poll.address, poll.address + poll.words - 1)
            said = "; ".join(_shown(each, span) for each in shown if _shown(each, span))
            yield Request(
                read_request(unit, drive, span), poll.address, said or "the output frequency: 0 at standstill"
            )


def _shown(sign: Sign, span: Span) -> str:
    found = " or ".join(str(each) for each in sign.patterns if each.register in span)
    return f"{sign.name.replace('_', ' ')} while {found}" if found else ""


def _period(drive: Drive) -> int:
    """A third of the shortest time of its watchdog, in ms, a second where it has none that is known."""
    own = watchdog(drive)
    least = own.time.least_ms if own and own.time else None
    return max(50, int(least) // 3) if least and least >= 150 else AGAIN_MS


def _fed(drive: Drive) -> str:
    own = watchdog(drive)
    if own is None:
        return "The manual knows of no watchdog: what the drive does when the line is cut, it does not say."
    by = {"polls": "any request" if own.feeds == "any" else "reads", "reference": "the speed", "run": "the run command"}
    named = feeds(drive)
    said = f"Its watchdog is fed by {by[named]}." if named else "The manual does not say what feeds its watchdog."
    if counts_at_rest(drive):
        said += " It counts at standstill, too: then send a speed of 0 as often."
    return said + (f" Set {own.time.setting} above three times the period." if own.time and own.time.setting else "")


def never(drive: Drive) -> list[str]:
    """What must not be written."""
    listed = ", ".join(address_text(each.register) for each in words(drive).registers)
    barred = [
        f"{address_text(row.address.first)} with bit {bits_text(one.bit)} = {one.equals}: {one.why}"
        for _, row in drive.registers()
        for one in row.never
    ]
    return [
        f"To {listed}: any word that is not in this list.",
        *barred,
        f"Parameters, again and again: {drive.storage.note}",
        *(each.text.en for each in drive.notices if each.kind == "prohibition"),
    ]
