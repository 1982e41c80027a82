"""What a drive, or the standard, would not take of a request or not send as a reply, and what was probably meant."""

from collections.abc import Callable, Iterator

from driveblocks.explain.layout import KNOWN, Layout
from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.model import Drive
from driveblocks.reference.permission import most
from driveblocks.reference.request import BUILDABLE, COUNTED, READS, Asked, Requests

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
    elif one.function in BUILDABLE and not one.refusal:
        yield from _request(drive, one, ascii_mode)
    if one.direction == "reply" and one.function in READS and not one.refusal:
        yield from _many(drive, one, ascii_mode)


def asked_by(one: Layout, *, ascii_mode: bool = False) -> Asked:
    """The request that a layout is, or that its reply answers as far as the reply repeats it."""
    value = one.number("data word") if one.function == 8 else one.number("value")
    quantity = one.number("quantity")
    return Asked(
        function=one.function,
        unit=one.body[0],
        address=one.number("address") or 0,
        quantity=1 if quantity is None else quantity,
        value=value or 0,
        sub_function=one.number("sub-function") or 0,
        words=one.words,
        ascii=ascii_mode,
    )


def _unit(drive: Drive | None, one: Layout) -> Iterator[Told]:
    unit = one.body[0]
    if unit == 0 and one.direction == "reply":
        yield "unit 0 is the broadcast address, and nobody answers a broadcast", ""
        return
    known = Span(drive.serial.unit.min, drive.serial.unit.max) if drive else STANDARD_UNITS
    if unit != 0 and unit not in known:
        yield f"unit {unit} is out of range: {known.first} to {known.last}", ""
    if unit == 0 and one.function not in (5, 6, 15, 16):
        yield f"unit 0 is a broadcast, and function {one.function:02X}H cannot be broadcast", ""
    elif unit == 0 and drive is not None:
        yield from _broadcast(drive, one)


def _broadcast(drive: Drive, one: Layout) -> Iterator[Told]:
    cast = drive.serial.broadcast
    if cast is None:
        yield "unit 0 is a broadcast, and the map knows of none", ""
    elif cast.start_addresses and one.number("address") not in cast.start_addresses:
        yield f"a broadcast starts at {' or '.join(map(address_text, cast.start_addresses))} only", ""


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
        yield (
            f"quantity {quantity} is out of range: 1 to {limit}",
            _swapped(quantity, lambda turned: 1 <= turned <= limit),
        )
    elif quantity is not None and address + quantity > 0x10000:
        yield "the registers run past FFFFH", ""


def _request(drive: Drive, one: Layout, ascii_mode: bool) -> Iterator[Told]:
    """What the drive's request block refuses; a reply that repeats address and quantity is judged the same."""
    asked = asked_by(one, ascii_mode=ascii_mode)
    if one.direction == "reply" and one.function in READS:
        return
    requests = Requests(drive)
    results = list(requests.wrongs(asked))
    if "QUANTITY" in results or "ASCII_LIMIT" in results:
        yield _quantity(drive, asked, ascii_mode="QUANTITY" not in results)
    elif "WRAP" in results:
        yield "the registers run past FFFFH", ""
    elif "NOT_READABLE" in results or "NOT_WRITABLE" in results:
        yield _address(drive, requests, asked)
    elif "SUB_FUNCTION" in results:
        yield f"{drive.prefix} does not know sub-function {asked.sub_function:04X}H", ""


def _quantity(drive: Drive, asked: Asked, *, ascii_mode: bool) -> Told:
    limits = most(drive, ascii_mode=ascii_mode)
    limit = limits.read if asked.function in READS else limits.write
    wrong = f"quantity {asked.quantity} is out of range: 1 to {limit}{' in ASCII' if ascii_mode else ''}"
    return wrong, _swapped(asked.quantity, lambda turned: 1 <= turned <= limit)


def _many(drive: Drive, one: Layout, ascii_mode: bool) -> Iterator[Told]:
    limit = most(drive, ascii_mode=ascii_mode).read
    if len(one.words) > limit:
        yield f"{len(one.words)} registers are more than {drive.prefix} sends at once: {limit}", ""


def _address(drive: Drive, requests: Requests, asked: Asked) -> Told:
    reading = asked.function in READS
    allowed = requests.readable if reading else requests.writable
    count = asked.quantity if asked.function in COUNTED else 1
    closed = [one for one in range(asked.address, asked.address + count) if one not in allowed]
    where = (
        span_text(Span(closed[0], closed[-1])) if closed[-1] - closed[0] == len(closed) - 1 else address_text(closed[0])
    )
    wrong = f"{where} may not be {'read' if reading else 'written'}"
    if not reading and closed[0] in requests.readable:
        return wrong, "it may only be read"
    if reading and closed[0] in requests.writable:
        return wrong, "it may only be written"
    return f"{wrong}: the map does not list it as such", _meant(drive, asked.address, count, allowed)


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


def _swapped(number: int, good: Callable[[int], bool]) -> str:
    turned = (number & 0xFF) << 8 | number >> 8
    return f"{turned}, if its bytes are swapped" if good(turned) else ""
