"""A reply against the request that it should answer: which field does not match, and how that may have come."""

from collections.abc import Iterator

from driveblocks.desk.explain.reading import Wrong
from driveblocks.modbus.layout import Dialect, Layout, granted, take
from driveblocks.modbus.request import READS, Asked, asked_by

LONGEST = 254
"""Bytes of the longest body."""

_LATE = "a late reply to an earlier request"
_OTHER_DRIVE = "another drive answered, or two have the same address"


def compared(dialect: Dialect, asked: Asked, data: bytes) -> tuple[Wrong, ...]:
    """What is wrong with a body as the reply to a request; nothing if it answers or refuses it."""
    wrong = next(_wrongs(dialect, asked, data), None)
    if wrong is not None and _is_request(dialect, asked, data):
        return (Wrong("this is the request itself", ("the adapter hears what it sends (half-duplex echo)",)),)
    return (wrong,) if wrong is not None else ()


def _is_request(dialect: Dialect, asked: Asked, data: bytes) -> bool:
    one = take(data, "request", dialect)
    return asked.function in (3, 4, 16) and one.fits and asked_by(one, ascii_mode=asked.ascii) == asked


def _wrongs(dialect: Dialect, asked: Asked, data: bytes) -> Iterator[Wrong]:
    one = take(data, "reply", dialect)
    if asked.unit == 0:
        yield Wrong("the request was a broadcast, and nobody answers one")
    if not 3 <= len(data) <= LONGEST:
        yield _length(one, asked)
    elif data[0] != asked.unit:
        yield Wrong(f"unit: {data[0]} answers, and unit {asked.unit} was asked", (_OTHER_DRIVE, _LATE))
    elif _refuses(dialect, asked, one):
        if one.missing:
            yield _length(one, asked)
    elif data[1] != asked.function:
        wrong = f"function: {data[1]:02X}H answers, and {asked.function:02X}H was asked"
        yield Wrong(wrong, (_why_function(data, asked),))
    else:
        yield from _granted(dialect, asked, granted(data, "reply"))


def _refuses(dialect: Dialect, asked: Asked, one: Layout) -> bool:
    """Whether a reply refuses this request, in the way in which the drive refuses."""
    if not one.refusal:
        return False
    refused = one.number("refused function")
    if refused is not None:
        return dialect.add is not None and refused == asked.function
    return one.missing == 0 and (asked.function, asked.address) != (dialect.function, dialect.address)


def _granted(dialect: Dialect, asked: Asked, one: Layout) -> Iterator[Wrong]:
    size = _bytes_of(asked)
    forgiven = dialect.two_byte_count or not one.two_byte_count
    if size is not None and (one.number("byte count") != size or not forgiven):
        yield Wrong(_count(one, asked, size), _why_count(one.body, size))
    if one.missing:
        yield _length(one, asked)
    wanted = {"address": asked.address, "quantity": asked.quantity, "sub-function": asked.sub_function}
    wanted |= {"value": asked.value, "data word": asked.value}
    for part in one.parts:
        if part.number != wanted.get(part.name, part.number):
            yield _field("value" if part.name == "data word" else part.name, part.number, wanted[part.name])


def _length(one: Layout, asked: Asked) -> Wrong:
    found = f"length: {len(one.body)} bytes before the checksum, and"
    size = _bytes_of(asked)
    if size is not None and not one.refusal:
        return Wrong(f"{found} the request asks for {3 + size}", _why_length(3 + size - len(one.body)))
    return Wrong(f"{found} such a reply has {one.size}", _why_length(one.missing))


def _field(name: str, number: int, wanted: int) -> Wrong:
    turned = number == (wanted & 0xFF) << 8 | wanted >> 8
    instead = ("its bytes are swapped",) if turned else (_LATE,)
    return Wrong(f"{name}: {number:04X}H answers, and {wanted:04X}H was asked", instead)


def _why_function(data: bytes, asked: Asked) -> str:
    if data[1] == asked.function | 0x80:
        return "a refusal as the standard has it, but the map says that this drive refuses in another way"
    return _LATE


def _why_length(missing: int) -> tuple[str, ...]:
    many = f"{abs(missing)} byte{'s' * (abs(missing) != 1)}"
    return (f"truncated: {many} missing",) if missing > 0 else (f"{many} too many",)


def _bytes_of(asked: Asked) -> int | None:
    """The bytes of registers, coils or inputs that a read asks for; None for what reads none of them."""
    if asked.function in READS:
        return 2 * asked.quantity
    return -(-asked.quantity // 8) if asked.function in (1, 2) else None


def _count(one: Layout, asked: Asked, size: int) -> str:
    count = one.number("byte count")
    found = "missing" if count is None else str(count)
    kind = {1: "coil", 2: "input"}.get(asked.function, "register")
    many = f"{asked.quantity} {kind}{'s' * (asked.quantity != 1)}"
    return f"byte count: {found}; the request asks for {many}, so it is {size}"


def _why_count(data: bytes, size: int) -> tuple[str, ...]:
    if int.from_bytes(data[2:4], "big") == size:
        return ("the byte count is a word: two-byte count",)
    if len(data) == 6:
        return ("this is a request, not a reply", _LATE)
    return (_LATE,)
