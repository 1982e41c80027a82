"""Map -> values for the drive block: what it reads, what each pin is made of, and what each command writes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import reduce
from itertools import pairwise
from operator import or_

from driveblocks.maps import names
from driveblocks.maps.form import address_text, is_bit
from driveblocks.maps.model import Drive, kept
from driveblocks.maps.plan import busy, writes_by
from driveblocks.maps.revision import checked
from driveblocks.maps.rivals import First, first_reads, refusals
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.measure import PINS, Measure, Pin, measures, own_maximum
from driveblocks.meaning.pattern import Pattern, bits_of
from driveblocks.meaning.polls import Poll, fast_words, meaning_words, other_words, polls, schedule, slow_words
from driveblocks.meaning.reference import Reference, reference
from driveblocks.meaning.roles import Roles, roles
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import Patterns, Sign, registers, status
from driveblocks.meaning.watchdog import at_rest, feeds
from driveblocks.meaning.words import Command, words
from driveblocks.modbus.checksum import crc16
from driveblocks.modbus.layout import COIL_ON
from driveblocks.render import context
from driveblocks.render.constants import ORDERS, STOPS
from driveblocks.render.context import Word, word_input
from driveblocks.render.decoded import Call, Decoded
from driveblocks.render.expression import Test

BUSY = 6
"""The refusal of a busy drive in the standard, for maps without codes (MODBUS Application Protocol V1.1b3, 7)."""
CONSTANTS = {
    "stop": "RAMP_STOP", "quick_stop": "QUICK_STOP", "coast_stop": "COAST_STOP", "jog_stop": "JOG_STOP",
    "run_forward": "GO_FORWARD", "run_reverse": "GO_REVERSE", "jog_forward": "JOG_AHEAD", "jog_reverse": "JOG_BACK",
    "fault_reset": "RESET_FAULT",
}  # fmt: skip
"""Command -> the constant of that number, as VFD_Control has it."""
UNSIGNED = ("output_frequency", "output_speed")
"""What is shown without its sign, which is the direction."""
STATUS = {
    "running": "Running", "reverse": "Reverse", "at_speed": "AtSpeed", "zero_speed": "ZeroSpeed",
    "warning": "Warning", "fault": "Fault", "limit": "Diagnosis.LimitActive",
}  # fmt: skip
"""What a drive can show -> the pin or variable."""


@dataclass(frozen=True)
class Wait:
    """The state that the next write waits for: bits of a word, and what they are in it."""

    name: str
    number: str
    """At the end of the names of mask and value, where states are in several words."""
    mask: int
    value: int


@dataclass(frozen=True)
class Output:
    """An output of Orders, and what it is while nothing is awaited."""

    name: str
    kind: str
    means: str
    none: str


@dataclass(frozen=True)
class Write:
    """One write of a command: its register, the bits that it sets, and those that pass through."""

    register: int
    bits: int
    keep: int
    hold: int
    """How long the next write waits, ms."""
    wait: Wait | None
    moves: bool
    """With it the motor may begin to turn."""
    function: int
    """By what it is written."""


@dataclass(frozen=True)
class Read:
    """A read of the drive block, by its number; `other` is another quantity that it may have."""

    number: int
    read: Poll
    words: list[Word]
    other: int


@dataclass(frozen=True)
class Shown:
    """A read that shows the family: see `rivals.First`; `plate` is an identity of the map, by its tests."""

    function: int
    address: int
    words: int
    shows: str
    values: tuple[int, ...]
    mask: int
    tests: Patterns


@dataclass(frozen=True)
class Identified:
    """The reads that show the family."""

    plate: bool
    """The map has an identity; else other makes are told apart."""
    reads: list[Shown]
    where: str
    busy: int
    """The refusal that says nothing of it; 0: none."""
    source: str


@dataclass(frozen=True)
class Maximum:
    """The word of the drive's own maximum frequency, its scale and the function that applies it."""

    word: Word
    scale: Decimal | None
    function: str
    source: str


@dataclass(frozen=True)
class Faulty:
    """Where the code of the present fault or warning comes from: a word, or the bits of several."""

    word: Word | None
    words: list[Word]
    mask: int = 0
    """Of the word the bits with the code; 0: it is the whole word."""
    times: int = 1
    """What they count for the code in its lowest."""


@dataclass(frozen=True)
class Measured:
    """A measure that the drive shows: its pin, its word and scale."""

    at: Pin
    word: Word
    low: Word | None
    """The low word of a value of 32 bits, whose high one is the word."""
    scale: Decimal | None
    function: str
    when: str | None
    """What the scale holds for; of several, one of these."""
    known: str
    """Whether that was read."""
    choices: list[tuple[str, Decimal]]
    """Of several scales, what each holds for and its factor."""
    signed: bool
    magnitude: bool
    """It is shown without its sign, which is the direction: the pins are the same for every family."""


@dataclass(frozen=True)
class Reading:
    """What the block reads, and which reads bring what; reads count from 1."""

    reads: list[Read]
    number: dict[int, int]
    """Address -> its read."""
    turns: list[int]
    places: dict[int, list[int]]
    """Read -> its places among the turns."""
    proof: list[Word]
    fault: Faulty
    warned: Faulty | None
    """Where the code of a warning comes from."""
    roles: Roles
    """Which reads bring what; of each role templates have the name, with `_reads`."""
    status_polls: int
    """In how many polls of the turns all fast ones are read again, at the most."""
    several: bool
    """Not all are read by one function."""
    identity: Identified | None


@dataclass(frozen=True)
class Showing:
    """What the block makes of the words: pins, and the decoders that it asks."""

    shown: dict[str, str]
    status: dict[str, list[Test]]
    says: dict[str, list[str]]
    forbids: list[str]
    """Nothing starts while one of these holds."""
    knows_direction: str
    """When it shows which way it turns: a sign says nothing at 0."""
    verify: list[Test]
    verified: list[str]
    measures: dict[str, Measured]
    pins: dict[str, Pin]
    commanded_by: list[str]
    """What all has to hold while the bus is in command."""
    own_maximum: Maximum | None
    decoders: list[Call]


@dataclass(frozen=True)
class Ordering:
    """What the block writes: stops and orders by their numbers, with names and constants."""

    stops: dict[int, Write]
    orders: dict[int, list[Write]]
    order_names: dict[int, str]
    order_constants: dict[int, str]
    stop_names: dict[int, str]
    stop_constants: dict[int, str]
    longest: int
    """Writes of the longest order."""
    awaited: list[Output]
    reached: str
    """TRUE when the state that the next write waits for is there."""
    can: frozenset[str]
    keeps: dict[int, int]
    write: int
    """The function code of stops."""
    by: int
    """That of the reference."""
    referred: Reference
    silent: tuple[int, int] | None
    """The write of the fault reset that makes the drive silent, and for how long, ms."""


@dataclass(frozen=True)
class Block:
    """For Drive and its parts, which are given all four as one."""

    reading: Reading
    showing: Showing
    ordering: Ordering
    own: dict[str, object]

    @property
    def values(self) -> dict[str, object]:
        """What its templates print."""
        reads = {f"{role}_reads": numbers for role, numbers in vars(self.reading.roles).items()}
        speed = vars(self.ordering.referred) | {"reference": self.ordering.referred.register}
        return reads | speed | vars(self.reading) | vars(self.showing) | vars(self.ordering) | self.own


@kept
def drive_block(drive: Drive) -> Block:
    """All that the drive block of a family is made of."""
    told = Decoded(drive)
    reading = _reading(drive)
    return Block(reading, _showing(drive, reading.number, told), _ordering(drive), _own(drive))


def _reading(drive: Drive) -> Reading:
    reads = polls(drive)
    places = list(_places(drive, reads))
    number = {each.address: each.number for each in places}
    turns = [index + 1 for index in schedule(reads)]
    return Reading(
        reads=[_read(drive, index, places, reads) for index in range(1, len(reads) + 1)],
        number=number,
        turns=turns,
        places={index: [turn for turn, each in enumerate(turns) if each == index] for index in turns},
        proof=context.standstill(drive).words,
        fault=_fault(drive),
        warned=_warned(drive),
        roles=roles(drive),
        status_polls=max(_gap(turns, index) for index in set(turns) if reads[index - 1].fast),
        several=len({read.function for read in (*reads, *(each.read for each in first_reads(drive)))}) > 1,
        identity=_identity(drive),
    )


def _gap(turns: list[int], number: int) -> int:
    """The most turns from one of a read to the next one."""
    places = [place for place, each in enumerate(turns) if each == number]
    return max(after - before for before, after in pairwise([*places, places[0] + len(turns)]))


def _showing(drive: Drive, number: dict[int, int], told: Decoded) -> Showing:
    shown, verify = status(drive).shown, status(drive).verify
    return Showing(
        shown=STATUS,
        status={one.name: [_tested(drive, each) for each in one.patterns] for one in shown},
        says={one.name: [told.holds(each) for each in one.patterns] for one in sorted(shown, key=_running_first)},
        forbids=[told.holds(each) for one in status(drive).forbids for each in one.patterns],
        knows_direction=_knows_direction(drive),
        verify=[_tested(drive, each) for each in verify],
        verified=[told.holds(each) for each in verify],
        measures={one.name: _measure(drive, one, told, number) for one in measures(drive)},
        pins=PINS,
        commanded_by=[told.holds(each) for each in status(drive).by_bus.patterns],
        own_maximum=_own_maximum(drive),
        decoders=told.used,
    )


def _knows_direction(drive: Drive) -> str:
    signs = status(drive).shows("reverse")
    numbers = registers(each for each in signs if each.is_ in ("<", ">"))
    moves = [f"(Reads.{word_input(drive, each).name} <> WORD#16#0000)" for each in numbers]
    later = ["Reads.DirectionRead"] if roles(drive).direction else []
    return " AND ".join([*later, *moves]) or str(bool(signs)).upper()


def _running_first(one: Sign) -> bool:
    """A key: a drive that stands may say that its reference is reached, which is shown only while it runs."""
    return one.name != "running"


def _ordering(drive: Drive) -> Ordering:
    written = [(one, list(_writes(drive, one))) for one in words(drive).commands]
    orders = {ORDERS[one.does]: writes for one, writes in written if one.does in ORDERS}
    stop = words(drive).stop.last
    by, of_speed = (writes_by(drive, each) for each in (stop.register, reference(drive).register))
    return Ordering(
        stops={STOPS[one.does]: writes[0] for one, writes in written if one.does in STOPS},
        orders=orders,
        order_names={ORDERS[does]: does.replace("_", " ") for does in ORDERS},
        order_constants={ORDERS[does]: CONSTANTS[does] for does in ORDERS},
        stop_names={STOPS[does]: does.replace("_", " ") for does in STOPS},
        stop_constants={STOPS[does]: CONSTANTS[does] for does in STOPS},
        longest=max(map(len, orders.values())),
        awaited=list(_awaited(drive)),
        reached=_reached(drive),
        can=frozenset(one.does for one, _ in written),
        keeps=context.kept(drive),
        write=by,
        by=of_speed,
        referred=reference(drive),
        silent=drive.operation.silenced,
    )


def family_number(prefix: str) -> int:
    """What the slot of a drive is marked with, 1 to 65535: the same in every version, another one for each family."""
    return crc16(prefix.encode()) or 1


def _own(drive: Drive) -> dict[str, object]:
    """What else the templates have to know of the family."""
    return {
        "source": context.source_of(drive, words(drive).stop.source), "prefix": drive.prefix, "serial": serial(drive),
        "family_number": family_number(drive.prefix), "dialect": refusals(drive), "busy": busy(drive),
        "second_hand": second_hand(drive), "checked": checked(drive), "feeds": feeds(drive),
        "fed_at_rest": at_rest(drive),
    }  # fmt: skip


def _writes(drive: Drive, one: Command) -> Iterator[Write]:
    """All writes of a command in order."""
    moves = one.does in ORDERS and one.does != "fault_reset"
    for each in one.writes:
        last = each is one.last
        word = each.word and COIL_ON if is_bit(each.register) else each.word
        by, wait = writes_by(drive, each.register), _wait(drive, each.until)
        yield Write(each.register, word, each.keeps, each.stays_ms, wait, moves and last, by)


def _state(drive: Drive, name: str) -> Pattern:
    return next(one.pattern for one in status(drive).states if one.name == name)


def _state_words(drive: Drive) -> dict[int, tuple[str, str]]:
    """The registers of the states that writes wait for: the name of the word, and what tells one from another."""
    awaited = {each.until for one in words(drive).commands for each in one.writes if each.until is not None}
    registers = sorted({_state(drive, each).register for each in awaited})
    return {each: (word_input(drive, each).name, str(at or "")) for at, each in enumerate(registers)}


def _awaited(drive: Drive) -> Iterator[Output]:
    words = _state_words(drive)
    if words:
        yield Output("Awaits", "BOOL", "the next write waits for a state of the drive", "FALSE")
    for word, number in words.values():
        yield Output(f"StateMask{number}", "WORD", f"... the bits of {word} that show it", "WORD#16#0000")
        yield Output(f"StateWord{number}", "WORD", "... and what they are then", "WORD#16#0000")


def _reached(drive: Drive) -> str:
    tests = [
        f"((Reads.{word} AND Orders.StateMask{number}) = Orders.StateWord{number})"
        for word, number in _state_words(drive).values()
    ]
    return f"NOT Orders.Awaits OR (Reads.StatesRead AND {' AND '.join(tests)})" if tests else "TRUE"


def _wait(drive: Drive, name: str | None) -> Wait | None:
    if name is None:
        return None
    state = _state(drive, name)
    return Wait(name, _state_words(drive)[state.register][1], state.mask, state.value)


def _places(drive: Drive, reads: tuple[Poll, ...]) -> Iterator[Word]:
    """Each word that the block keeps, and the number of the read that brings it."""
    for address in sorted(fast_words(drive) | slow_words(drive)):
        for number, read in enumerate(reads, 1):
            if address in read.addresses:
                yield replace(word_input(drive, address), number=number, index=address - read.address)


def _read(drive: Drive, number: int, places: list[Word], reads: tuple[Poll, ...]) -> Read:
    read = reads[number - 1]
    words = [place for place in places if place.number == number]
    return Read(number, read, words, other_words(drive, read, reads))


def _identity(drive: Drive) -> Identified | None:
    firsts, own = first_reads(drive), status(drive).identity
    if not firsts:
        return None
    tests = own.patterns
    reads = [_shown(each, tests) for each in firsts]
    sources = [context.source_of(drive, own.said.source)] if own.patterns else [each.source for each in firsts]
    where = " and ".join(f"at {address_text(each.address)}" for each in reads)
    return Identified(bool(tests), reads, where, busy(drive) or BUSY * (not drive.errors.codes), "; ".join(sources))


def _shown(first: First, tests: Patterns) -> Shown:
    mask = reduce(or_, first.values, 0)
    read, shows = first.read, "plate" if tests else first.shows
    return Shown(read.function, read.address, read.words, shows, first.values, mask, tests)


def _own_maximum(drive: Drive) -> Maximum | None:
    maximum = own_maximum(drive)
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is None or row is None:
        return None
    function = names.block(drive.prefix, names.symbol(row) + names.UNIT_NAMES[row.unit or "Hz"])
    source = context.source_of(drive, maximum.said.source)
    return Maximum(word_input(drive, maximum.register), maximum.quantity.factor, function, source)


def _tested(drive: Drive, one: Pattern) -> Test:
    return context.tested(word_input(drive, one.register).name, one)


def _fault(drive: Drive) -> Faulty:
    if drive.faults.present is not None:
        bits = drive.faults.present_bits
        mask, times = (bits_of([bits]), 1 << bits.first) if bits else (0, 1)
        return Faulty(word_input(drive, drive.faults.present), [], mask, times)
    numbers = context.fault_number(drive)
    return Faulty(None, numbers.words if numbers else [])


def _warned(drive: Drive) -> Faulty | None:
    warnings = drive.warnings
    if warnings is None:
        return None
    word, bits = word_input(drive, warnings.register), warnings.bits
    return Faulty(word, [], bits_of([bits]), 1 << bits.first) if bits else Faulty(word, [])


def _measure(drive: Drive, one: Measure, told: Decoded, number: dict[int, int]) -> Measured:
    row, has = drive.register_at(one.register), one.quantity
    assert row is not None  # noqa: S101  (a checked map lists the registers that it measures)
    holds = [told.holds(each.when) if each.when else "" for each in has.factors]
    return Measured(
        at=PINS[one.name],
        word=word_input(drive, has.high),
        low=word_input(drive, has.low) if has.pair else None,
        scale=has.factor,
        function=names.block(drive.prefix, names.symbol(row) + PINS[one.name].unit),
        when="" if not all(holds) else " OR ".join(holds) if len(holds) < 2 else f"({' OR '.join(holds)})",
        known=_known(drive, one, number),
        choices=list(zip(holds, (each.value for each in has.factors), strict=True)) if has.factors[1:] else [],
        signed=has.signed,
        magnitude=has.signed and one.name in UNSIGNED,
    )


def _known(drive: Drive, one: Measure, number: dict[int, int]) -> str:
    """Whether what a scale depends on was read: with what the reference depends on, or by itself; empty: with it."""
    asked = {each.when.register for each in one.quantity.factors if each.when}
    own = sorted({number[each] for each in asked - meaning_words(drive)} - {number[one.register]})
    verified = ["Reads.SettingsRead"] if asked & meaning_words(drive) else []
    return " AND ".join(verified + [f"Reads.Young{each}" for each in own])
