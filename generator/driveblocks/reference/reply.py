"""Replies: which bytes are believed as the answer to the open request, and what they say.

MODBUS Application Protocol V1.1b3, 6.3 to 6.12 and 7; how a drive refuses comes from its map.
"""

from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.reference.request import READS, Asked

SHORTEST_BODY, LONGEST_BODY = 3, 254
MOST_REGISTERS = 125
"""6.3: a request asks for 1 to 125; one with 0 or more was made by hand, and no reply fits it."""


@dataclass(frozen=True)
class Answer:
    """OK with the words read, REFUSED with the drive's reason, or why the reply is not believed."""

    result: str
    words: tuple[int, ...] = ()
    reason: int = 0


@dataclass(frozen=True)
class Dialect:
    """How a drive refuses, and what is tolerated. By default: what the standard says."""

    add: int | None = 0x80
    """A refusal is function code + add with one byte of reason."""
    function: int | None = None
    address: int | None = None
    """A refusal is a reply of this function at this address, with a word of reason."""
    two_byte_count: bool = False


def dialect(drive: Drive) -> Dialect:
    """What a map says; where it does not say how the drive refuses, the standard holds."""
    tolerant = any(tolerance.kind == "two_byte_count" for tolerance in drive.tolerances)
    form = drive.errors.form
    if form is None:
        return Dialect(two_byte_count=tolerant)
    if form.kind == "exception":
        return Dialect(add=form.add, two_byte_count=tolerant)
    address = (form.address or 0) & 0xFFFF  # what is sent, of whatever table
    return Dialect(add=None, function=form.function, address=address, two_byte_count=tolerant)


def parse(dialect: Dialect, asked: Asked | None, body: bytes) -> Answer:
    """Compare a reply's body with the open request; None or function 0 means that there is none, and so does a quantity
    that no request has.
    """
    refused = _nobody(asked, body)
    if refused is not None or asked is None:
        return Answer(refused or "NO_REQUEST")
    return _refusal(dialect, asked, body) or _granted(dialect, asked, body)


def _nobody(asked: Asked | None, body: bytes) -> str | None:
    """Why a reply cannot be one to this request at all."""
    reasons = (
        ("NO_REQUEST", asked is None or asked.function == 0 or not 1 <= asked.quantity <= MOST_REGISTERS),
        ("BROADCAST", asked is not None and asked.unit == 0),
        ("SHORT", len(body) < SHORTEST_BODY),
        ("LONG", len(body) > LONGEST_BODY),
        ("OTHER_UNIT", asked is not None and int.from_bytes(body[:1], "big") != asked.unit),
    )
    return next((name for name, holds in reasons if holds), None)


def _refusal(dialect: Dialect, asked: Asked, body: bytes) -> Answer | None:
    """What a refusal says; None if the reply is none."""
    if dialect.function is not None and dialect.address is not None:
        head = bytes([asked.unit, dialect.function]) + dialect.address.to_bytes(2, "big")
        own = (asked.function, asked.address) == (dialect.function, dialect.address)
        if len(body) == 6 and body.startswith(head) and not own:
            return Answer("REFUSED", reason=_word(body, 4))
    if dialect.add is not None and body[1] == asked.function + dialect.add:
        return Answer("REFUSED", reason=body[2]) if len(body) == 3 else Answer("LONG")
    return None


def _granted(dialect: Dialect, asked: Asked, body: bytes) -> Answer:
    if body[1] != asked.function:
        return Answer("OTHER_FUNCTION")
    if asked.function in READS:
        return _read(dialect, asked, body)
    if len(body) != 6:
        return Answer("SHORT" if len(body) < 6 else "LONG")
    return Answer(_echo(asked, _word(body, 2), _word(body, 4)))


def _read(dialect: Dialect, asked: Asked, body: bytes) -> Answer:
    size = 2 * asked.quantity
    data = body[3:]
    if dialect.two_byte_count and len(body) == 4 + size and _word(body, 2) == size:
        data = body[4:]
    elif body[2] != size:
        return Answer("BYTE_COUNT")
    if len(data) != size:
        return Answer("SHORT" if len(data) < size else "LONG")
    return Answer("OK", tuple(_word(data, at) for at in range(0, size, 2)))


def _echo(asked: Asked, head: int, tail: int) -> str:
    """Compare both words of the echo with what the function says they are."""
    expected = {
        6: ((asked.address, "OTHER_ADDRESS"), (asked.value, "OTHER_VALUE")),
        8: ((asked.sub_function, "OTHER_SUB_FUNCTION"), (asked.value, "OTHER_VALUE")),
        16: ((asked.address, "OTHER_ADDRESS"), (asked.quantity, "OTHER_QUANTITY")),
    }.get(asked.function)
    if expected is None:
        return "OTHER_FUNCTION"
    both = zip((head, tail), expected, strict=True)
    return next((name for found, (wanted, name) in both if found != wanted), "OK")


def _word(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 2], "big")
