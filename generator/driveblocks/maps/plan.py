"""What a drive allows on the wire, derived from its map: words per frame, readable and writable addresses."""

import struct
from collections.abc import Iterable
from dataclasses import dataclass

from driveblocks.maps.form import SPACES, Span, space_of, wire
from driveblocks.maps.model import Drive, Limit, kept
from driveblocks.maps.numbering import at
from driveblocks.maps.view import error_number
from driveblocks.modbus.layout import COIL_ON, Dialect

READ_WORDS, WRITE_WORDS = 125, 123
"""MODBUS Application Protocol V1.1b3, 6.3 and 6.12: registers that fit into a PDU of 253 bytes."""

OF_BITS = frozenset({1, 2, 5})
"""Functions of coils and discrete inputs, which only a drive block sends, where its map has some."""

READ_OVERHEAD, WRITE_OVERHEAD = 1, 5
"""Data bytes beside the words: byte count of a read reply; address, quantity and byte count of a 10H request."""


@dataclass(frozen=True)
class Words:
    """Most registers per frame in one mode; 0 where the drive lacks the function or the mode."""

    read: int
    write: int


@dataclass(frozen=True)
class Plan:
    """What may be sent to a drive."""

    functions: frozenset[int]
    sub_functions: tuple[int, ...]
    rtu: Words
    ascii: Words
    readable: tuple[Span, ...]
    writable: tuple[Span, ...]


@kept
def plan(drive: Drive) -> Plan:
    """Derive the plan of a checked map."""
    functions = {function.code: function for function in drive.functions}
    return Plan(
        functions=frozenset(functions),
        sub_functions=tuple(sub.code for sub in functions[8].sub_functions) if 8 in functions else (),
        rtu=_words(drive, "rtu"),
        ascii=_words(drive, "ascii"),
        readable=_grouped(drive, merged(_allowed(drive, "r"))),
        writable=_grouped(drive, merged([*_allowed(drive, "w"), *drive.ram_only])),
    )


def _words(drive: Drive, mode: str) -> Words:
    codes = {function.code for function in drive.functions}
    if mode not in drive.serial.mode.modes:
        return Words(0, 0)
    limits = most(drive, mode)
    return Words(limits.read if codes & {3, 4} else 0, limits.write if 16 in codes else 0)


def holding(spans: Iterable[Span]) -> tuple[Span, ...]:
    """Those of some spans that are holding registers: what requests and parameters of a user can name."""
    return tuple(span for span in spans if space_of(span.first) == "holding")


def used(drive: Drive) -> frozenset[int]:
    """The functions that a drive block may use: those that the map lists, but for those of coils that are not sent."""
    return frozenset(function.code for function in drive.functions if function.sent or function.code not in OF_BITS)


def start_of(drive: Drive | None, function: int) -> int:
    """What is added to the address in a request of a function: its table's, where the map has rows of that."""
    table = {1: "coil", 2: "discrete", 4: "input", 5: "coil", 15: "coil"}.get(function, "holding")
    rows = drive.registers() if drive else ()
    start = SPACES[table] if any(space_of(row.address.first) == table for _, row in rows) else 0
    return at(drive, start) if drive else start


def reads_by(drive: Drive, address: int) -> int:
    """The function that reads a register: 04H a holding register, too, where the drive has no 03H."""
    return {"coil": 1, "discrete": 2, "input": 4}.get(space_of(address), 3 if 3 in used(drive) else 4)


def read_request(unit: int, drive: Drive, span: Span) -> bytes:
    """A read of addresses of one table, without checksum."""
    return bytes([unit, reads_by(drive, span.first)]) + struct.pack(">HH", wire(span.first), len(span))


def write_request(unit: int, drive: Drive, address: int, word: int) -> bytes:
    """A write of one register or coil, without checksum."""
    function, at = writes_by(drive, address), wire(address)
    if function == 16:
        return struct.pack(">BBHHBH", unit, function, at, 1, 2, word)
    return struct.pack(">BBHH", unit, function, at, word if function == 6 else COIL_ON * word)


def writes_by(drive: Drive, address: int) -> int:
    """The function that writes a value: 05H a coil, 10H a pair and what the drive does not let 06H write."""
    row = drive.register_at(address, "w")
    if space_of(address) == "coil":
        return 5
    return 16 if (row is not None and row.words) or 6 not in used(drive) else 6


def most(drive: Drive, mode: str) -> Words:
    """Most registers that fit into a frame of a mode, whether the drive has the mode and the functions or not."""
    size = drive.limits.ascii_data_bytes if mode == "ascii" else drive.limits.data_bytes
    room = size.value if size else 2 * READ_WORDS + READ_OVERHEAD
    read = min(_value(drive.limits.read_words, READ_WORDS), (room - READ_OVERHEAD) // 2)
    return Words(read, min(_value(drive.limits.write_words, WRITE_WORDS), (room - WRITE_OVERHEAD) // 2, WRITE_WORDS))


def _value(limit: Limit | None, default: int) -> int:
    return limit.value if limit else default


def _allowed(drive: Drive, use: str) -> list[Span]:
    """Address spans that may be read (`r`) or written (`w`); an unused one may be read in a block, never written."""
    spans = [area.addresses for area in drive.areas if use in area.access]
    for section, row in drive.registers():
        if use in (row.access or section.access) and not (row.unused and use == "w"):
            spans.append(row.address)
    return spans


def merged(spans: Iterable[Span]) -> tuple[Span, ...]:
    """Ranges in order, those that touch as one."""
    found: list[Span] = []
    for span in sorted(spans):
        if found and span.first <= found[-1].last + 1:
            found[-1] = Span(found[-1].first, max(found[-1].last, span.last))
        else:
            found.append(span)
    return tuple(found)


def group(drive: Drive, address: int) -> int:
    """The number of the group of an address, of which a request may have one; of most drives the same for all."""
    return address // drive.limits.group.value if drive.limits.group else 0


def _grouped(drive: Drive, spans: tuple[Span, ...]) -> tuple[Span, ...]:
    """Spans, none of them in two groups."""
    size = _value(drive.limits.group, 0x10000)
    return tuple(
        Span(max(span.first, start), min(span.last, start + size - 1))
        for span in spans
        for start in range(span.first - span.first % size, span.last + 1, size)
    )


def dialect(drive: Drive) -> Dialect:
    """How the drive refuses and what it is forgiven; where the manual does not say, the standard holds."""
    tolerant = any(tolerance.kind == "two_byte_count" for tolerance in drive.tolerances)
    form = drive.errors.form
    if form is None:
        return Dialect(two_byte_count=tolerant)
    address = None if form.address is None else wire(form.address)
    return Dialect(form.add, form.function, address, tolerant)


def busy(drive: Drive) -> int:
    """The code with which the drive says that it cannot do something now; 0: it has none."""
    return next((error_number(one) or 0 for one in drive.errors.codes if one.busy), 0)
