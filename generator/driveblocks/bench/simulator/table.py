"""A map as the numbers that a simulated drive works with, in Python and in C."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache

from driveblocks.bench.simulator.copies import Copy, copies, zeros
from driveblocks.bench.simulator.face import Situation, awaited, face, named_bits, situations
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.move import Move, moves
from driveblocks.bench.simulator.plate import plate
from driveblocks.bench.simulator.refusal import codes, refuses_beyond
from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive
from driveblocks.maps.pair import places, whole
from driveblocks.maps.plan import Words, dialect, most, plan
from driveblocks.maps.rivals import own_address
from driveblocks.meaning.measure import measures
from driveblocks.meaning.pattern import WORD, Pattern, bits_of
from driveblocks.meaning.quantity import quantity
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import registers, status
from driveblocks.meaning.watchdog import Watchdog, watchdog
from driveblocks.meaning.words import CommandWord, words
from driveblocks.modbus.layout import Dialect

MOST_TIMES = 32_000
"""Largest numerator of a reference: a word times it has 32 bits."""
MOST_PER = 10_000
"""Largest denominator of a reference in thousandths of a hertz: 3 counts per Hz are 1000/3 of them each."""


@dataclass(frozen=True)
class Gauge:
    """A measured register."""

    register: int
    shows: str
    milli: int
    """Thousandths of its unit in a count."""
    signed: bool
    shift: int | None = None
    """Of a value of 32 bits, 16 where the register holds its high word, 0 where its low one; None: of 16 bits."""


@dataclass(frozen=True)
class Limit:
    register: int
    low: int
    high: int
    signed: bool
    above: int | None = None
    """Of a value of 32 bits, the register of its high word; the other is that of its low one."""


@dataclass(frozen=True)
class Set:
    """The speed reference: target in thousandths of a hertz = word x `times` / `per`."""

    register: int
    times: int
    per: int
    signed: bool
    reverses: bool
    verify: tuple[Pattern, ...]
    above: int | None = None
    """Of a value of 32 bits, the register of its high word; the other is that of its low one."""


@dataclass(frozen=True)
class Storage:
    """What a write to a parameter stores: see `Memory`."""

    method: str
    at_once: bool
    """A write to a parameter is stored without more."""
    areas: tuple[Span, ...]
    """Parameters; of `ram_address_bit` those that the bit may be added to."""
    add: int
    register: int
    value: int


@dataclass(frozen=True)
class Table:
    """Everything about a drive that does not change."""

    functions: frozenset[int]
    sub_functions: tuple[int, ...]
    most: Words
    readable: tuple[Span, ...]
    writable: tuple[Span, ...]
    group: int
    """Addresses of a group, which no request may cross."""
    broadcast: int | None
    """The unit address to which all drives listen; None: the map has none."""
    broadcasts: tuple[int, ...]
    """The only start addresses that it may write to; empty: any."""
    limits: tuple[Limit, ...]
    dialect: Dialect
    codes: dict[str, int | None]
    moves: tuple[Move, ...]
    """What the words of the map's own commands do."""
    listed: tuple[Pattern, ...]
    """The words of the map's own commands, and of the steps before them."""
    words: tuple[CommandWord, ...]
    """What any word in a command register does, by its bits or its value."""
    silences: tuple[tuple[Pattern, int], ...]
    """Words that make it silent, and for how long, ms."""
    states: tuple[str, ...]
    named: dict[int, int]
    faces: dict[tuple[Situation, str | None], dict[int, int]]
    gauges: tuple[Gauge, ...]
    reference: Set
    storage: Storage
    present: int | None
    present_shift: int
    """How far up its word the code of the present fault is, in bits."""
    present_mask: int
    """The bits of that word which hold it; the others may show something else."""
    warned: int | None
    """The register with the code of a warning."""
    warning: tuple[int, int]
    """The bits of it that hold the code, and what they are in a warning: its first code, in its place."""
    fault_bits: tuple[int, int] | None
    shared: frozenset[int]
    """Registers that show something else than what was written there."""
    copies: dict[int, Copy]
    watchdog: Watchdog | None
    own_address: int | None
    """The register that shows its unit address until somebody writes it."""
    zeros: tuple[Span, ...]
    """Registers that read 0 until somebody writes them."""


def table(drive: Drive, habits: Habits, *, ascii_mode: bool = False) -> Table:
    """The numbers of a map."""
    allowed = plan(drive)
    gauges = _gauges(drive, habits)
    measured = frozenset(gauge.register for gauge in gauges)
    longest = most(drive, "ascii" if ascii_mode else "rtu")
    broadcast, bits = serial(drive).broadcast, drive.faults.bits
    states = tuple(state.name for state in awaited(drive))
    named = named_bits(drive, measured)
    codes_at = {drive.faults.present, *drive.warned, *(range(bits.first, bits.last + 1) if bits else ())} - {None}
    known = {*measured, *named, *codes_at, *plate(drive, habits), dialect(drive).address}
    own = own_address(drive)
    again = copies(drive, habits, known)
    return Table(
        functions=allowed.functions,
        sub_functions=allowed.sub_functions,
        most=longest,
        readable=allowed.readable,
        writable=allowed.writable,
        group=drive.limits.group.value if drive.limits.group else 0x10000,
        broadcast=broadcast.address if broadcast else None,
        broadcasts=broadcast.starts if broadcast else (),
        limits=(*_limits(drive), *_choices(drive), *_highest(drive, habits)),
        dialect=dialect(drive),
        codes=codes(drive),
        moves=moves(drive),
        listed=tuple(each.pattern for one in words(drive).commands for each in one.writes),
        words=words(drive).registers,
        silences=tuple(_silences(drive)),
        states=states,
        named=named,
        faces=_faces(drive, measured),
        gauges=gauges,
        reference=_reference(drive, habits),
        storage=_storage(drive, allowed.writable),
        present=drive.faults.present,
        present_shift=drive.faults.present_bits.first if drive.faults.present_bits else 0,
        present_mask=bits_of([drive.faults.present_bits]) if drive.faults.present_bits else WORD,
        warned=next(iter(drive.warned), None),
        warning=_warning(drive),
        fault_bits=(bits.first, bits.last) if bits else None,
        shared=drive.shared,
        copies={each.register: each for each in again},
        own_address=own,
        watchdog=watchdog(drive),
        zeros=zeros(drive, {*known, *([] if own is None else [own]), *(each.register for each in again)}),
    )


def _silences(drive: Drive) -> Iterator[tuple[Pattern, int]]:
    writes = (one for command in words(drive).commands for one in command.writes)
    yield from ((one.pattern, one.silent_ms) for one in writes if one.silent_ms)


def _warning(drive: Drive) -> tuple[int, int]:
    if drive.warnings is None:
        return 0, 0
    span, codes = drive.warnings.span, drive.warnings.codes
    return bits_of([span]), (codes[0].code if codes else 1) << span.first


@lru_cache(8)
def _faces(drive: Drive, measured: frozenset[int]) -> dict[tuple[Situation, str | None], dict[int, int]]:
    names = [state.name for state in awaited(drive)]
    standing = (each for each in situations() if not each.fault and not each.running)
    keys = [(situation, None) for situation in situations()]
    keys += [(situation, name) for situation in standing for name in names]  # type: ignore[misc]  # str is str | None
    return {key: face(drive, measured, *key) for key in keys}


def _gauges(drive: Drive, habits: Habits) -> tuple[Gauge, ...]:
    shows = {at: each.name for each in measures(drive) for at in whole(drive, each.register)}
    known = status(drive)
    states = (one.pattern for one in known.states)
    told = registers((*(each for one in known.shown for each in one.patterns), *states))
    for each in known.standstill.patterns:
        # no status, and 0 at standstill: a frequency, or nothing that a motor could show
        if each.register not in told and each.mask == WORD and each.holds(0):
            for register in whole(drive, each.register):
                shows.setdefault(register, "output_frequency")
    return tuple(_gauge(drive, habits, register, what) for register, what in sorted(shows.items()))


def _gauge(drive: Drive, habits: Habits, register: int, shows: str) -> Gauge:
    has = quantity(drive, register)
    shift = (16 if register == has.high else 0) if has.pair else None
    return Gauge(register, shows, max(1, int(1000 * _factor(drive, habits, register))), has.signed, shift)


def _factor(drive: Drive, habits: Habits, register: int) -> Decimal:
    return habits.scales.get(register, quantity(drive, register).factor or habits.scale)


def _limits(drive: Drive) -> tuple[Limit, ...]:
    return tuple(
        Limit(low, row.range.min, row.range.max, row.signed or row.range.min < 0, high if row.words else None)
        for _, row in drive.registers()
        if row.range and drive.register_at(row.address.first, "w") is row
        for address in list(row.address)[:: row.size]
        for high, low in [places(row, address) if row.words else (address, address)]
    )


def _choices(drive: Drive) -> Iterator[Limit]:
    """A command register whose row lists values takes these; between the lowest and the highest of them, any."""
    for register in dict.fromkeys(command.last.register for command in words(drive).commands):
        row = drive.register_at(register, "w")
        if row and row.values and not row.masks and not row.range:
            listed = [each.value for each in row.values]
            yield Limit(register, min(listed), max(listed), signed=False)


def _highest(drive: Drive, habits: Habits) -> Iterator[Limit]:
    """A reference in Hz ends at the drive's own maximum, where the manual has its scale and refuses what is beyond."""
    one = reference(drive)
    in_hertz = one.scaled and not one.part and not one.in_rpm
    if in_hertz and not one.ranged and not one.quantity.signed and refuses_beyond(drive):
        yield Limit(one.register, 0, int(habits.maximum_hz * one.ratio), signed=False)


def _reference(drive: Drive, habits: Habits) -> Set:
    one = reference(drive)
    counts = one.ratio if one.scaled else one.ratio / Fraction(_factor(drive, habits, one.register))
    milli = Fraction(1000 * (habits.maximum_hz if one.part else habits.pole_pairs if one.in_rpm else 1)) / counts
    times, per = milli.limit_denominator(min(MOST_PER, max(1, int(MOST_TIMES / milli)))).as_integer_ratio()
    has, above = one.quantity, one.quantity.high if one.pair else None
    return Set(has.low, times, per, has.signed, one.reverses, status(drive).verify, above)


def _around(span: Span, address: int) -> list[Span]:
    """A span without an address."""
    return [
        part
        for part in (Span(span.first, min(span.last, address - 1)), Span(max(span.first, address + 1), span.last))
        if part
    ]


def _storage(drive: Drive, writable: tuple[Span, ...]) -> Storage:
    """Parameters are the areas, and writable rows of sections without a command; the rest is never stored."""
    storage = drive.storage
    told = {one.register for one in words(drive).registers} | {*reference(drive).registers}
    sections = [each for each in drive.sections if not any(row.address.first in told for row in each.registers)]
    rows = [row.address for section in sections for row in section.registers]
    areas = [area.addresses for area in drive.areas]
    kept = list(drive.with_ram_bit) if storage.method == "ram_address_bit" else [*areas, *rows]
    for twin in storage.twins:
        parts = [part for span in kept for part in _around(span, twin.ram)]
        kept = [*parts, *([] if any(twin.stored in part for part in parts) else [Span(twin.stored, twin.stored)])]
    return Storage(
        method=storage.method,
        at_once=storage.method in ("ram_address_bit", "ram_twin", "unexplained"),
        areas=tuple(sorted(span for span in kept if any(span.first in each for each in writable))),
        add=storage.add or 0,
        register=-1 if storage.register is None else storage.register,
        value=(storage.value or 0) & WORD,
    )
