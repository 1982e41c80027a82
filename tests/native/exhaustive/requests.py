"""Every number on every pin of the blocks that build requests, every quantity with every function among them.

The drives' request blocks are judged by the reference model; the builders under them by the limits of the MODBUS
Application Protocol V1.1b3, 6.3, 6.4, 6.6, 6.8 and 6.12, and of MODBUS over Serial Line V1.02, 2.2.
"""

import struct
from array import array
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.frames import noise
from tests.native.exhaustive.scan import Scan
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.request import COUNTED, Asked, Requests, body
from driveblocks.render.results import code

ANSWERED = ("ErrorID", "Length", "Adu", "Request")
READ = Scan(
    "MB_BuildRead", ("UnitAddress", "FunctionCode", "Address", "Quantity", "MaxWords"), ANSWERED, ("Adu", "Request")
)
MULTIPLE = Scan(
    "MB_BuildWriteMultiple", ("UnitAddress", "Address", "Quantity", "MaxWords"), ANSWERED, ("Words", "Adu", "Request")
)
SINGLE = Scan("MB_BuildWriteSingle", ("UnitAddress", "Address", "Value"), ANSWERED, ("Adu", "Request"))
DIAGNOSTICS = Scan("MB_BuildDiagnostics", ("UnitAddress", "SubFunction", "Value"), ANSWERED, ("Adu", "Request"))
PINS = ("Ascii", "UnitAddress", "FunctionCode", "Address", "Quantity", "Value", "SubFunction")


def of_drive(prefix: str) -> Scan:
    """A drive's request block."""
    return Scan(f"{prefix}_Request", PINS, ANSWERED, ("Words", "Adu", "Request"))


SCANS = (READ, MULTIPLE, SINGLE, DIAGNOSTICS, *map(of_drive, drives()))

WORDS = noise(250)
ADU = noise(256)
OPEN = struct.pack("=6H", 99, 99, 99, 99, 99, 99)
"""What is in the open request before a block writes it."""

VALUES = tuple(array("H", WORDS))


@dataclass(frozen=True)
class Put:
    """What goes into a builder: the request, and the most words that it may carry."""

    asked: Asked
    most: int = 125


Wrong = Callable[[Put], str | None]
"""Why a builder must refuse; None if it must not."""


def answer(asked: Asked, wrong: str | None) -> bytes:
    """Error, length, frame and open request as a block leaves them."""
    if wrong is not None:
        return struct.pack("=HH", code(wrong), 0) + ADU + OPEN[:2] + b"\0\0" + OPEN[4:]
    frame = body(asked)
    return struct.pack("=HH", 0, len(frame)) + frame + ADU[len(frame) :] + _noted(asked)


def _noted(asked: Asked) -> bytes:
    """The open request: only what the function carries."""
    address = 0 if asked.function == 8 else asked.address
    quantity = asked.quantity if asked.function in COUNTED else 1
    sub_function = asked.sub_function if asked.function == 8 else 0
    value = asked.value if asked.function in {6, 8} else 0
    return struct.pack("=6H", asked.unit, asked.function, address, quantity, sub_function, value)


# ---------------------------------------------------------------- builders


def wrong_read(put: Put) -> str | None:
    """What is wrong with a read."""
    asked = put.asked
    if not 1 <= asked.unit <= 247:
        return "UNIT"
    if asked.function not in {3, 4}:
        return "FUNCTION"
    return _wrong_quantity(asked, min(put.most, 125))


def wrong_multiple(put: Put) -> str | None:
    """What is wrong with a write of registers."""
    return "UNIT" if put.asked.unit > 247 else _wrong_quantity(put.asked, min(put.most, 123))


def _wrong_quantity(asked: Asked, most: int) -> str | None:
    if not 1 <= asked.quantity <= most:
        return "QUANTITY"
    return "WRAP" if asked.address + asked.quantity > 0x10000 else None


def wrong_single(put: Put) -> str | None:
    """What is wrong with a write of one register."""
    return "UNIT" if put.asked.unit > 247 else None


def wrong_diagnostics(put: Put) -> str | None:
    """What is wrong with a diagnosis."""
    return None if 1 <= put.asked.unit <= 247 else "UNIT"


READS = [
    Put(Asked(function, 1, at, 2), most) for function in (3, 4) for at, most in ((0x20, 125), (0xFFC0, 65535), (0, 16))
]
BUILDERS: tuple[tuple[Scan, Wrong, list[Put], tuple[str, ...]], ...] = (
    (READ, wrong_read, READS, ("unit", "function", "address", "quantity", "most")),
    (
        MULTIPLE,
        wrong_multiple,
        [Put(Asked(16, 1, at, 2, words=VALUES), most) for at, most in ((0, 123), (0xFFC0, 65535), (7, 16))],
        ("unit", "address", "quantity", "most"),
    ),
    (SINGLE, wrong_single, [Put(Asked(6, 1, 0x1000, value=5))], ("unit", "address", "value")),
    (DIAGNOSTICS, wrong_diagnostics, [Put(Asked(8, 1, sub_function=0, value=5))], ("unit", "sub_function", "value")),
)
"""Each builder with its limits, what it is given, and the pins that go through all numbers, one at a time."""

FIELDS = {
    "UnitAddress": "unit",
    "FunctionCode": "function",
    "Address": "address",
    "Quantity": "quantity",
    "Value": "value",
    "SubFunction": "sub_function",
}


def numbers(short: bool) -> Sequence[int]:
    """All numbers of a pin; short: those up to 130 and around its powers of two, and the last ones."""
    around = (number for bit in range(8, 16) for number in range((1 << bit) - 10, (1 << bit) + 10))
    return [*range(131), *around, *range(0xFFF0, 0x10000)] if short else range(0x10000)


def builders(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every number of each pin, with every choice of the others that changes the limits."""
    for scan, wrong, puts, pins in BUILDERS:
        for put in puts:
            for pin in pins:
                yield from judged(benches, iter([_built(scan, wrong, put, pin, numbers(short))]))


def _built(scan: Scan, wrong: Wrong, put: Put, pin: str, tried: Sequence[int]) -> Trial:
    puts = [_with(put, pin, number) for number in tried]
    records = b"".join(array("H", [_pin(one, name) for name in scan.given]).tobytes() for one in puts)
    wanted = b"".join(answer(one.asked, wrong(one)) for one in puts)
    head = (WORDS if "Words" in scan.filled else b"") + ADU + OPEN
    return Trial(scan, len(puts), records, wanted, lambda at: f"of {pin} {tried[at]}", head)


def _with(put: Put, pin: str, number: int) -> Put:
    if pin == "most":
        return Put(put.asked, number)
    return Put(_changed(put.asked, pin, number), put.most)


def _changed(asked: Asked, pin: str, number: int) -> Asked:
    change: dict[str, Any] = {pin: number}
    return replace(asked, **change)


def _pin(put: Put, name: str) -> int:
    value = put.most if name == "MaxWords" else getattr(put.asked, FIELDS[name])
    assert isinstance(value, int)
    return value


# ---------------------------------------------------------------- request blocks of the drives


def of_drives(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every quantity with the functions at addresses of each kind; every function, unit and address."""
    for drive in drives().values():
        yield from judged(benches, _asked(drive, short))


def _asked(drive: Drive, short: bool) -> Iterator[Trial]:
    model = Requests(drive)
    base = Asked(3, 1, 0, 1, value=0x1234, words=VALUES)
    for function in (3, 4, 6, 8, 16, 0, 23):
        for address in sorted({min(model.readable), min(model.writable), max(model.writable), 0xFFFF})[
            -1 if short else 0 :
        ]:
            for in_ascii in (False,) if short else (False, True):
                asked = replace(base, function=function, address=address, ascii=in_ascii)
                yield _tried(drive.prefix, model, asked, "quantity", numbers(short))
        for pin in ("unit", "address", "sub_function"):
            yield _tried(drive.prefix, model, replace(base, function=function), pin, numbers(short))
            yield _tried(drive.prefix, model, replace(base, function=function, unit=0), pin, numbers(short))
    yield _tried(drive.prefix, model, base, "function", numbers(short))


def _tried(prefix: str, model: Requests, asked: Asked, pin: str, tried: Sequence[int]) -> Trial:
    cases = [_changed(asked, pin, number) for number in tried]
    records = b"".join(
        struct.pack("=?6H", one.ascii, one.unit, one.function, one.address, one.quantity, one.value, one.sub_function)
        for one in cases
    )
    wanted = b"".join(answer(one, next(model.wrongs(one), None)) for one in cases)
    tell = f"of function {asked.function}, unit {asked.unit}, {asked.address:04X}H, ASCII {asked.ascii}, {pin}"
    return Trial(of_drive(prefix), len(cases), records, wanted, lambda at: f"{tell} {tried[at]}", WORDS + ADU + OPEN)
