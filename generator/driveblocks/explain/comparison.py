"""A reply against the request that it should answer: which field does not match, and how that may have come."""

from driveblocks.explain.layout import Layout, take
from driveblocks.explain.reading import Wrong
from driveblocks.explain.suspicion import asked_by
from driveblocks.reference.reply import Manners, parse
from driveblocks.reference.request import READS, Asked

_LATE = "a late reply to an earlier request"
_OTHER_DRIVE = "another drive answered, or two have the same address"


def compared(manners: Manners, asked: Asked, data: bytes) -> tuple[Wrong, ...]:
    """What is wrong with a body as the reply to a request; nothing if it answers or refuses it."""
    result = parse(manners, asked, data).result
    if result in ("OK", "REFUSED"):
        return ()
    if _is_request(manners, asked, data):
        return (Wrong("this is the request itself", ("the adapter hears what it sends (half-duplex echo)",)),)
    one = take(data, "reply", manners)
    return (_told(result, asked, one, data),)


def _is_request(manners: Manners, asked: Asked, data: bytes) -> bool:
    one = take(data, "request", manners)
    return asked.function in (3, 4, 16) and one.fits and asked_by(one, ascii_mode=asked.ascii) == asked


def _told(result: str, asked: Asked, one: Layout, data: bytes) -> Wrong:
    size = 2 * asked.quantity
    written = {
        "BROADCAST": Wrong("the request was a broadcast, and nobody answers one"),
        "OTHER_UNIT": Wrong(f"unit: {data[0]} answers, and unit {asked.unit} was asked", (_OTHER_DRIVE, _LATE)),
        "OTHER_FUNCTION": Wrong(
            f"function: {data[1]:02X}H answers, and {asked.function:02X}H was asked", (_why_function(data, asked),)
        ),
        "BYTE_COUNT": Wrong(_count(one, asked), _why_count(data, size)),
        "OTHER_ADDRESS": _field("address", one.number("address"), asked.address),
        "OTHER_VALUE": _field("value", (one.words or (one.number("data word"),))[0], asked.value),
        "OTHER_SUB_FUNCTION": _field("sub-function", one.number("sub-function"), asked.sub_function),
        "OTHER_QUANTITY": _field("quantity", one.number("quantity"), asked.quantity),
    }
    if result in written:
        return written[result]
    if asked.function in READS and not one.refusal:
        wrong = f"length: {len(data)} bytes before the checksum, and the request asks for {3 + size}"
        return Wrong(wrong, _why_length(3 + size - len(data)))
    return Wrong(
        f"length: {len(data)} bytes before the checksum, and such a reply has {one.size}", _why_length(one.missing)
    )


def _field(name: str, found: int | None, wanted: int) -> Wrong:
    number = found or 0
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


def _count(one: Layout, asked: Asked) -> str:
    count = one.number("byte count")
    found = "missing" if count is None else str(count)
    many = f"{asked.quantity} register{'s' * (asked.quantity != 1)}"
    return f"byte count: {found}; the request asks for {many}, so it is {2 * asked.quantity}"


def _why_count(data: bytes, size: int) -> tuple[str, ...]:
    if int.from_bytes(data[2:4], "big") == size:
        return ("the byte count is a word: two-byte count",)
    if len(data) == 6:
        return ("this is a request, not a reply", _LATE)
    return (_LATE,)
