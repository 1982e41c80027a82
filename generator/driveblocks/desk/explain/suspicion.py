"""What a drive, or the standard, would not take of a request or not send as a reply, and what was probably meant."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import most, plan, start_of
from driveblocks.meaning.serial import serial
from driveblocks.modbus.layout import KNOWN, Layout
from driveblocks.modbus.request import READS, Asked, asked_by

Told = tuple[str, str]
"""What is wrong, and what it might be instead."""

STANDARD_UNITS = Span(1, 247)


def wrongs(drive: Drive | None, one: Layout, *, ascii_mode: bool) -> Iterator[Told]:
    """Everything that is wrong with a frame whose bytes are as they were sent."""
    yield from _unit(drive, one)
    if drive is None:
        yield from _standard(one)
        return
    if one.function not in {function.code for function in drive.functions}:
        if not one.refusal:
            yield _function(drive, one)
    elif one.function in (*READS, 6, 8, 16) and not one.refusal:
        yield from _request(drive, one, ascii_mode)
    if one.direction == "reply" and one.function in READS and not one.refusal:
        limit = most(drive, "ascii" if ascii_mode else "rtu").read
        if len(one.words) > limit:
            yield f"{len(one.words)} registers are more than {drive.prefix} sends at once: {limit}", ""


def _unit(drive: Drive | None, one: Layout) -> Iterator[Told]:
    unit = one.body[0]
    if unit == 0 and one.direction == "reply":
        yield "unit 0 is the broadcast address, and nobody answers a broadcast", ""
        return
    known = Span(serial(drive).lowest, serial(drive).highest) if drive else STANDARD_UNITS
    if unit != 0 and unit not in known:
        yield f"unit {unit} is out of range: {known.first} to {known.last}", ""
    if unit == 0 and one.function not in (5, 6, 15, 16):
        yield f"unit 0 is a broadcast, and function {one.function:02X}H cannot be broadcast", ""
    elif unit == 0 and drive is not None:
        yield from _broadcast(drive, one)


def _broadcast(drive: Drive, one: Layout) -> Iterator[Told]:
    cast = serial(drive).broadcast
    if cast is None:
        yield "unit 0 is a broadcast, and the map knows of none", ""
    elif cast.starts and one.number("address") not in cast.starts:
        yield f"a broadcast starts at {' or '.join(map(address_text, cast.starts))} only", ""


def _function(drive: Drive, one: Layout) -> Told:
    known = ", ".join(f"{function.code:02X}H" for function in drive.functions)
    instead = "01H to 7FH are functions, more is an error reply" if one.function == 0 or one.function > 0x7F else ""
    return f"{drive.prefix} does not know function {one.function:02X}H; it knows {known}", instead


def _standard(one: Layout) -> Iterator[Told]:
    """The limits of the standard, where there is no map."""
    if one.function not in KNOWN and not one.refusal and (one.function == 0 or one.function > 0x7F):
        yield f"{one.function:02X}H is no function code", "a byte in the wrong place, or not Modbus"
    quantity, address = one.number("quantity"), one.number("address") or 0
    limit = {1: 2000, 2: 2000, 3: 125, 4: 125, 15: 1968, 16: 123}.get(one.function)
    if quantity is not None and limit is not None and not 1 <= quantity <= limit:
        yield f"quantity {quantity} is out of range: 1 to {limit}", _swapped(quantity, limit)
    elif quantity is not None and address + quantity > 0x10000:
        yield "the registers run past FFFFH", ""


def _request(drive: Drive, one: Layout, ascii_mode: bool) -> Iterator[Told]:
    """What the drive's request block refuses; a reply that repeats address and quantity is checked the same way."""
    asked = asked_by(one, ascii_mode=ascii_mode)
    reading = asked.function in READS
    if one.direction == "reply" and reading:
        return
    allows = plan(drive)
    counted = asked.function in (*READS, 16)
    wrong = list(_quantity(drive, asked)) if counted else []
    if wrong:
        yield wrong[0]
    elif counted and asked.address + asked.quantity > 0x10000:
        yield "the registers run past FFFFH", ""
    elif asked.function == 8:
        if asked.sub_function not in allows.sub_functions:
            yield f"{drive.prefix} does not know sub-function {asked.sub_function:04X}H", ""
    else:
        yield from _address(drive, asked, _within(allows.readable), _within(allows.writable))


def _within(spans: tuple[Span, ...]) -> frozenset[int]:
    return frozenset(address for span in spans for address in span)


def _quantity(drive: Drive, asked: Asked) -> Iterator[Told]:
    """A number of registers that no frame carries, or none in ASCII."""
    for mode, named in (("rtu", ""), ("ascii", " in ASCII")) if asked.ascii else (("rtu", ""),):
        words = most(drive, mode)
        limit = words.read if asked.function in READS else words.write
        if not 1 <= asked.quantity <= limit:
            wrong = f"quantity {asked.quantity} is out of range: 1 to {limit}{named}"
            yield wrong, _swapped(asked.quantity, limit)


def _address(drive: Drive, asked: Asked, readable: frozenset[int], writable: frozenset[int]) -> Iterator[Told]:
    reading = asked.function in READS
    allowed, other = (readable, writable) if reading else (writable, readable)
    first = asked.address + start_of(drive, asked.function)
    closed = [one for one in range(first, first + asked.quantity) if one not in allowed]
    if not closed:
        return
    whole = closed[-1] - closed[0] == len(closed) - 1
    where = span_text(Span(closed[0], closed[-1])) if whole else address_text(closed[0])
    wrong = f"{where} may not be {'read' if reading else 'written'}"
    if closed[0] in other:
        yield wrong, f"it may only be {'written' if reading else 'read'}"
    else:
        yield f"{wrong}: the map does not list it as such", _meant(drive, first, asked.quantity, allowed)


def _meant(drive: Drive, address: int, count: int, allowed: frozenset[int]) -> str:
    """Another address that is allowed and easily mistaken for this one."""
    turned = (address & 0xFF) << 8 | address >> 8
    tries = [(turned, "if its bytes are swapped"), (address - 1, "if it was counted from 1")]
    if str(address).isdecimal() and len(str(address)) <= 4:
        tries.append((int(str(address), 16), f"if {address} was meant as hexadecimal"))
    for other, why in tries:
        if other != address and other >= 0 and all(one in allowed for one in range(other, other + count)):
            row = drive.register_at(other)
            name = f" {row.name}" if row and row.name else ""
            return f"{address_text(other)}{name}, {why}"
    return ""


def _swapped(number: int, limit: int) -> str:
    turned = (number & 0xFF) << 8 | number >> 8
    return f"{turned}, if its bytes are swapped" if 1 <= turned <= limit else ""
