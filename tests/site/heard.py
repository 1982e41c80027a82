"""A thousand lines that are only listened to: masters, drives that answer well, late, twice or not, noise, adapters.

`python -m tests.site.heard [--runs N] [--first SEED]` (`make heard`) prints how each kind was named, and every wrong
finding with its seed; exit status 1 for a wrong one. The judge knows what was sent on the line, and nothing of how it
is found out.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from random import Random

from driveblocks.desk.clock import VirtualClock
from driveblocks.modbus.frame import seal
from driveblocks.site import ear
from driveblocks.site.found import Way
from driveblocks.site.listen import Files, Session
from driveblocks.site.overheard import odd
from driveblocks.site.traffic import Traffic

KINDS = (
    "plain", "silent", "late", "twice", "echo", "broadcast", "refused", "noise", "damaged", "masters", "no modbus",
    "quiet",
)  # fmt: skip
ALLOWED: dict[str, set[str]] = {
    "plain": set(), "silent": {"silent", "unanswered"}, "late": {"late", "late or twice"},
    "twice": {"twice", "late or twice"},
    "echo": {"echo"}, "broadcast": set(), "refused": {"refused"}, "noise": {"damaged", "unasked"},
    "damaged": {"damaged", "unasked"},
    "masters": {"masters", "unanswered", "damaged", "late", "unasked", "late or twice"},
    "no modbus": set(), "quiet": set(),
}  # fmt: skip
"""What may be said of each kind."""
ALIKE = "unclear"
"""May be said of a unit that is asked by writes of one register alone."""
LOOK_US = 2000


@dataclass
class Piece:
    """A frame on the wire, with the time of its first character."""

    at_us: float
    data: bytes
    spoilt: bool = False
    to: "Piece | None" = None
    """The request that a reply answers."""


@dataclass
class Truth:
    """What was sent."""

    kind: str
    way: Way
    pieces: list[Piece] = field(default_factory=list)
    asked: Counter[tuple[int, int, int]] = field(default_factory=Counter)
    """Unit, function, address: how often."""
    words: dict[tuple[int, int], set[int]] = field(default_factory=dict)
    """Unit and address: every word that was sent of it."""
    every_us: dict[tuple[int, int, int, int], float] = field(default_factory=dict)
    answering: set[int] = field(default_factory=set)
    units: set[int] = field(default_factory=set)
    owed: bytes = b""
    """A reply that comes after the next request."""


@dataclass(frozen=True)
class Poll:
    """A request that a master sends in each round."""

    unit: int
    function: int
    address: int
    words: tuple[int, ...]
    """Those that are written."""
    quantity: int = 1


@dataclass(frozen=True)
class Manner:
    """How a unit answers and how long its master waits, in us; and whether it is the one with the trouble."""

    turn: float
    timeout: float
    bad: bool


def body(poll: Poll) -> bytes:
    """A request."""
    head = bytes([poll.unit, poll.function]) + poll.address.to_bytes(2, "big")
    data = b"".join(word.to_bytes(2, "big") for word in poll.words)
    if poll.function == 6:
        return head + data
    head += poll.quantity.to_bytes(2, "big")
    return head + bytes([len(data)]) + data if poll.function == 16 else head


def polls(chance: Random, unit: int) -> Iterator[Poll]:
    """What a unit is asked."""
    places = chance.sample((0x1000, 0x2000, 0x2100, 0x3000, 0xF000), 3)
    for function, place in zip(chance.sample((3, 3, 4, 6, 16), chance.randint(1, 3)), places, strict=False):
        quantity = 1 if function == 6 else chance.randint(1, 12)
        words = tuple(chance.randrange(0x10000) for _ in range(quantity)) if function in (6, 16) else ()
        yield Poll(unit, function, place, words, quantity)


def truth(seed: int, kind: str) -> Truth:
    """A line by its seed."""
    chance = Random(f"{seed} {kind}")
    mode = chance.choice(("rtu", "rtu", "rtu", "ascii"))
    rate = chance.choice((9600, 19200, 19200, 4800, 38400, 57600, 115200, 2400))
    form = chance.choice(("8N1", "8E1", "8N1")) if mode == "rtu" else chance.choice(("8N1", "7E1"))
    made = Truth(kind, Way(rate, form, "ascii" if mode == "ascii" else "rtu"))
    if kind == "quiet":
        return made
    if kind == "no modbus":
        at = 0.0
        while at < 60e6:
            made.pieces.append(Piece(at, chance.randbytes(chance.randint(3, 30))))
            at += chance.uniform(50e3, 500e3)
        return made
    _master(made, chance, 1)
    if kind == "masters":
        _master(made, chance, 20)
        _collide(made)
    if kind in ("noise", "damaged"):
        _disturb(made, chance)
    made.pieces.sort(key=lambda one: one.at_us)
    return made


def _master(made: Truth, chance: Random, first: int) -> None:
    units = list(range(first, first + chance.randint(1, 4)))
    turns = {unit: chance.uniform(3e3, 45e3) for unit in units}
    plan = [poll for unit in units for poll in polls(chance, unit)]
    bad = chance.choice(units)
    timeout, pause = chance.uniform(150e3, 400e3), chance.uniform(5e3, 60e3)
    made.units |= set(units)
    made.answering |= {unit for unit in units if made.kind != "silent" or unit != bad}
    at, rounds, times = chance.uniform(0, 200e3), 0, dict[tuple[int, int, int, int], list[float]]()
    while at < 60e6:
        rounds += 1
        for number, poll in enumerate(plan):
            times.setdefault((poll.unit, poll.function, poll.address, poll.quantity), []).append(at)
            at = _exchange(made, chance, poll, at, Manner(turns[poll.unit], timeout, poll.unit == bad))
            at += pause
            if made.kind == "broadcast" and number == 0:
                at = _send(made, at, b"\0\x06\x20\0\0\x05") + pause
                made.asked[0, 6, 0x2000] += 1
                made.words.setdefault((0, 0x2000), set()).add(5)
    for key, some in times.items():
        made.asked[key[:3]] += len(some)
        made.every_us[key] = (some[-1] - some[0]) / max(1, len(some) - 1)


def _exchange(made: Truth, chance: Random, poll: Poll, at: float, manner: "Manner") -> float:
    """A request and what becomes of it; when the master goes on."""
    turn, timeout, bad = manner.turn, manner.timeout, manner.bad
    request, kind = body(poll), made.kind
    end = _send(made, at, request)
    sent = made.pieces[-1]
    for place, word in enumerate(poll.words):
        made.words.setdefault((poll.unit, poll.address + place), set()).add(word)
    if kind == "echo":
        end = _send(made, end + 500, request)
    if made.owed:
        end, made.owed = _send(made, end + chance.uniform(1e3, 60e3), made.owed), b""
    if bad and kind == "silent":
        return end + timeout
    reply = _reply(made, chance, poll, refuses=bad and kind == "refused")
    turn += chance.uniform(0, 2e3)
    if bad and kind == "late" and chance.random() < 0.3:
        made.owed = reply
        return end + timeout
    end = _send(made, end + turn, reply)
    made.pieces[-1].to = sent
    if bad and kind == "twice" and chance.random() < 0.5:
        end = _send(made, end + chance.uniform(1e3, 4e3), reply)
    return end


def _reply(made: Truth, chance: Random, poll: Poll, *, refuses: bool) -> bytes:
    if refuses:
        return bytes([poll.unit, poll.function | 0x80, 2])
    if poll.function in (6, 16):
        return body(poll)[:6]
    words = [chance.randrange(0x10000) for _ in range(poll.quantity)]
    for place, word in enumerate(words):
        made.words.setdefault((poll.unit, poll.address + place), set()).add(word)
    return bytes([poll.unit, poll.function, 2 * len(words)]) + b"".join(word.to_bytes(2, "big") for word in words)


def _send(made: Truth, at: float, data: bytes) -> float:
    """A frame; when it has ended."""
    frame = seal(made.way.mode, data)
    made.pieces.append(Piece(at, frame))
    return at + len(frame) * made.way.character_us


def _collide(made: Truth) -> None:
    """Frames that are sent at the same time spoil each other; a drive does not answer what it cannot read."""
    made.pieces.sort(key=lambda one: one.at_us)
    for one, other in pairwise(made.pieces):
        if other.at_us < one.at_us + len(one.data) * made.way.character_us:
            one.spoilt = other.spoilt = True
    made.pieces = [one for one in made.pieces if one.to is None or not one.to.spoilt]


def _disturb(made: Truth, chance: Random) -> None:
    """Noise between frames, or frames with a wrong bit; a drive does not answer those."""
    kept: list[Piece] = []
    for one, after in pairwise(made.pieces):
        if one.to is not None and one.to.spoilt:
            continue
        kept.append(one)
        if made.kind == "damaged" and chance.random() < 0.05:
            place, one.spoilt = chance.randrange(len(one.data)), True
            one.data = one.data[:place] + bytes([one.data[place] ^ 1 << chance.randrange(7)]) + one.data[place + 1 :]
        elif made.kind == "noise" and chance.random() < 0.1:
            end = one.at_us + len(one.data) * made.way.character_us
            room = (after.at_us - end) / made.way.character_us
            if room > 4:
                kept.append(
                    Piece(end + made.way.character_us, chance.randbytes(chance.randint(1, min(12, int(room) - 2))))
                )
    made.pieces = kept


@dataclass
class Wire:
    """The line as an adapter gives it: late, in pieces, and as garbage at a wrong rate."""

    truth: Truth
    clock: VirtualClock
    late_us: int
    chance: Random
    bytes_: list[tuple[float, int]] = field(default_factory=list)
    tuned: tuple[int, str] = (0, "")
    sent: int = 0

    def __post_init__(self) -> None:
        slots: dict[int, int] = {}
        step = self.truth.way.character_us
        for piece in self.truth.pieces:
            for place, byte in enumerate(piece.data):
                end = piece.at_us + (place + 1) * step
                slot = int(end / step)
                byte_ = byte & slots[slot] if piece.spoilt and slot in slots else byte
                slots[slot] = byte_
                self.bytes_.append((end, byte_))
        self.bytes_.sort(key=lambda one: one[0])
        self.bytes_.reverse()

    def tune(self, way: Way) -> bool:
        """Bytes that waited are lost."""
        self.receive()
        self.tuned = way.rate, way.form
        return True

    def close(self) -> None:
        """Nothing to give back."""

    def receive(self) -> bytes:
        """What has come by the last time that the adapter looked."""
        now = self.clock.now_us() // self.late_us * self.late_us
        data = bytearray()
        while self.bytes_ and self.bytes_[-1][0] <= now:
            data += self._seen(self.bytes_.pop()[1])
        return bytes(data)

    def _seen(self, byte: int) -> bytes:
        way = self.truth.way
        if self.tuned[0] != way.rate:
            return self.chance.randbytes(1) if self.chance.random() < min(1, self.tuned[0] / way.rate) else b""
        if way.form[0] == "7":
            return bytes([byte & 0x7F]) if self.tuned[1][0] == "7" else bytes([byte | (byte.bit_count() & 1) << 7])
        if self.tuned[1][0] == "7":
            return bytes([byte & 0x7F])
        if way.form == "8E1" and self.tuned[1] == "8N1":
            return bytes([byte]) if byte.bit_count() & 1 else b"\0"  # the parity bit is where the stop bit should be
        if way.form == "8N1" and self.tuned[1][1] != "N":
            return self.chance.randbytes(1)
        return bytes([byte])


@dataclass(frozen=True)
class Verdict:
    """`named`, `open` (could not be found out) or `wrong`, and why."""

    kind: str
    state: str
    why: str


def listened(seed: int, kind: str) -> tuple[Truth, Way | None, Traffic]:
    """A line, and what was found out of it."""
    ear.LOOK_US = LOOK_US
    chance, made, clock = Random(seed), truth(seed, kind), VirtualClock()
    wire = Wire(made, clock, chance.choice((1000, 1000, 4000, 16_000)), chance)
    session = Session(wire, clock, Traffic({}), Files())
    session.find(ear.ways(None, None))
    session.listen(10_000_000)
    session.end()
    return made, session.way, session.traffic


def line(seed: int, kind: str | None = None) -> Verdict:
    """One line, by its seed."""
    kind = kind or KINDS[Random(seed).randrange(len(KINDS))]
    made, way, traffic = listened(seed, kind)
    why = f"seed {seed}, {made.way}: "
    if way is None:
        return Verdict(kind, "named" if kind in ("quiet", "no modbus") else "open", f"{why}nothing decoded")
    if kind in ("quiet", "no modbus") or not _sounds(way, made.way):
        return Verdict(kind, "wrong", f"{why}heard at {way}")
    wrong = [*_wrong_units(made, traffic), *_wrong_words(made, traffic)]
    kinds = {what for what, _ in odd(traffic)}
    wrong += [f"it says {each}" for each in kinds - ALLOWED[kind] - {ALIKE}]
    state = "wrong" if wrong else "named" if _is_named(made, traffic, kinds) else "open"
    return Verdict(kind, state, why + "; ".join([*wrong, *sorted(kinds)]))


def _sounds(heard: Way, true: Way) -> bool:
    """Whether nobody can hear a difference: parity is not checked, and the eighth bit of ASCII is 0."""
    forms = {
        true.form,
        true.form.replace("E", "O"),
        *(("7E1", "7O1") if (true.form, true.mode) == ("8N1", "ascii") else ()),
    }
    return (heard.rate, heard.mode) == (true.rate, true.mode) and heard.form in forms


def _is_named(made: Truth, found: Traffic, kinds: set[str]) -> bool:
    if made.kind == "broadcast":
        return bool(found.broadcasts)
    return made.kind in kinds or made.kind == "plain" or (made.kind == "noise" and "damaged" in kinds)


def _wrong_units(made: Truth, found: Traffic) -> Iterator[str]:
    """Requests that nobody has sent, or more than were sent; times between them that are none."""
    quiet = made.kind not in ("noise", "damaged", "masters", "echo", "twice", "late")
    for number, unit in found.units.items():
        if number not in made.units:
            yield f"unit {number}"
        answered = any(each.replies for (function, *_), each in unit.polls.items() if function != 6)
        if answered and number not in made.answering:
            yield f"unit {number} answers"
        for (function, address, quantity), poll in unit.polls.items():
            key = number, function, address
            if poll.count > made.asked[key]:
                yield f"{key} was asked {poll.count} times, and not {made.asked[key]}"
            every = made.every_us.get((*key, quantity), 0)
            if quiet and function != 6 and poll.every_us and poll.count > 9 and not 0.7 < poll.every_us / every < 1.4:
                yield f"{key} every {poll.every_us} us, and not {every}"
    for (function, address), count in found.broadcasts.items():
        if count > made.asked[0, function, address]:
            yield "more broadcasts than were sent"


def _wrong_words(made: Truth, found: Traffic) -> Iterator[str]:
    for number, unit in found.units.items():
        for (_, address, _), poll in unit.polls.items():
            for place, word in enumerate(poll.words):
                if word not in made.words.get((number, address + place), ()):
                    yield f"{word} at {address + place:04X}H of unit {number}"


def main() -> int:
    """Run them."""
    parser = argparse.ArgumentParser(description="A thousand lines that are only listened to.")
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    found: list[Verdict] = []
    for seed in range(options.first, options.first + options.runs):
        found.append(each := line(seed))
        if each.state != "named":
            print(f"{each.state}: {each.kind}: {each.why}", flush=True)
    table = Counter((each.kind, each.state) for each in found)
    for kind in KINDS:
        print(f"{kind:12}" + "".join(f"{state:>8} {table[kind, state]:4}" for state in ("named", "open", "wrong")))
    return 1 if any(each.state == "wrong" for each in found) else 0


if __name__ == "__main__":
    sys.exit(main())
