"""What a frame with a wrong checksum might be instead: each guess is tried, and reported only if it works out."""

from binascii import crc_hqx
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from driveblocks.modbus import layout
from driveblocks.modbus.checksum import crc16, crc_bytes, lrc, table
from driveblocks.modbus.envelope import DIGITS, Wire, open_
from driveblocks.modbus.frame import seal
from driveblocks.modbus.layout import Dialect

LONGEST = 2 * 513
"""Bytes beyond which nothing is tried: the longest ASCII frame as PLC registers with a character in each."""


@dataclass(frozen=True)
class Guess:
    """What the frame might be, and the frame that was meant, where it is known."""

    says: str
    frame: bytes | None = None


Tries = Iterator[Guess]


def guesses(wire: Wire, dialect: Dialect) -> list[Guess]:
    """What comes out, best first: causes that the checksum proves, then those that only the length speaks for."""
    if len(wire.frame) > LONGEST:
        return []
    if not wire.aligned:
        return [*_seven_bits(wire, dialect), *_lookalikes(wire)]
    proved = _PROVED_RTU if wire.mode == "rtu" else _PROVED_ASCII
    found = [guess for attempt in proved for guess in attempt(wire, dialect)]
    found = found or (list(_one_byte(wire, dialect)) if wire.mode == "rtu" else [])
    if not found:
        found = [guess for attempt in _LIKELY for guess in attempt(wire, dialect)]
    return list({guess.says: guess for guess in found}.values())[:4]


def shown(data: bytes) -> str:
    """Bytes as messages write them."""
    return data.hex(" ").upper()


def _fits(body: bytes, dialect: Dialect) -> bool:
    """Whether a body has the length that its function asks for, of a function known here."""
    if len(body) < 3:
        return False
    return any(one.fits and one.function in layout.KNOWN for one in layout.readings(body, dialect))


def _good(frame: bytes, dialect: Dialect) -> bool:
    """Whether bytes are an RTU frame with a right CRC and a fitting length."""
    return len(frame) >= 5 and crc_bytes(frame[:-2]) == frame[-2:] and _fits(frame[:-2], dialect)


# ---------------------------------------------------------------- RTU, proved by a checksum


def _swapped_crc(wire: Wire, _: Dialect) -> Tries:
    if len(wire.found) == 2 and wire.found[::-1] == wire.expected:
        yield Guess("the CRC bytes are swapped: the low byte is sent first", wire.sealed(wire.body))


def _pairs_swapped(wire: Wire, dialect: Dialect) -> Tries:
    """PLC registers printed low byte first, and dumps of 16-bit words."""
    even = wire.frame + bytes(len(wire.frame) % 2)
    swapped = b"".join(even[at : at + 2][::-1] for at in range(0, len(even), 2))
    for frame in (swapped, swapped[:-1]):
        if _good(frame, dialect) or (frame[:1] == b":" and open_(frame.rstrip(b"\0")).right):
            meant = frame if frame[:1] != b":" else frame.rstrip(b"\0")
            yield Guess("the two bytes of each pair are swapped, as in registers sent low byte first", meant)
            return


def _spread(wire: Wire, dialect: Dialect) -> Tries:
    """8-bit mode: one byte in each register."""
    for first in (0, 1):
        rest, bytes_ = wire.frame[first::2], wire.frame[1 - first :: 2]
        if rest and not any(rest) and _good(bytes_, dialect):
            yield Guess("every second byte is 00: these are PLC registers with one byte in each (8-bit mode)", bytes_)


def _no_colon(wire: Wire, _: Dialect) -> Tries:
    text = wire.frame.rstrip(b"\r\n")
    if len(text) >= 8 and all(byte in DIGITS for byte in text) and open_(b":" + text + b"\r\n").right:
        yield Guess("this is an ASCII frame without its colon", b":" + text + b"\r\n")


def _seven_bits(wire: Wire, _: Dialect) -> Tries:
    plain = bytes(byte & 0x7F for byte in wire.frame)
    if plain != wire.frame and plain[:1] == b":" and open_(plain).right:
        yield Guess("this is ASCII with parity in the highest bit: 7 data bits were received as 8", plain)


def _binary_lrc(wire: Wire, dialect: Dialect) -> Tries:
    body = wire.frame[:-1]
    if wire.frame and lrc(body) == wire.frame[-1] and _fits(body, dialect):
        says = "this is ASCII: the last byte is the LRC of an ASCII frame, whose colon and line end are missing"
        yield Guess(says, seal("ascii", body))


def _modbus_tcp(wire: Wire, dialect: Dialect) -> Tries:
    data = wire.frame
    counted = data[2:4] == b"\0\0" and int.from_bytes(data[4:6], "big") == len(data) - 6
    if counted and _fits(data[6:], dialect):
        yield Guess("this is Modbus TCP: six bytes of header, no CRC", seal("rtu", data[6:]))


_CCITT, _DNP = table(0x8408), table(0xA6BC)
_OTHERS: tuple[tuple[str, Callable[[bytes], int]], ...] = (
    ("a CRC-16 that starts with 0000H instead of FFFFH", lambda data: crc16(data, 0)),
    ("a CRC-16 whose result is inverted", lambda data: crc16(data) ^ 0xFFFF),
    ("the CRC of CCITT (polynomial 1021H, start FFFFH)", lambda data: crc_hqx(data, 0xFFFF)),
    ("the CRC of XMODEM (polynomial 1021H, start 0000H)", lambda data: crc_hqx(data, 0)),
    ("the CRC of KERMIT (polynomial 1021H mirrored)", lambda data: crc16(data, 0, _CCITT)),
    ("the CRC of X.25 (polynomial 1021H mirrored, inverted)", lambda data: crc16(data, 0xFFFF, _CCITT) ^ 0xFFFF),
    ("the CRC of DNP", lambda data: crc16(data, 0, _DNP) ^ 0xFFFF),
    ("the sum of the bytes", lambda data: sum(data) & 0xFFFF),
)


def _other_crc(wire: Wire, dialect: Dialect) -> Tries:
    if len(wire.found) < 2 or not _fits(wire.body, dialect):
        return
    for name, compute in _OTHERS:
        crc = compute(wire.body)
        for order, words in (("little", ""), ("big", ", high byte first")):
            if crc.to_bytes(2, "little" if order == "little" else "big") == wire.found:
                yield Guess(f"the checksum is {name}{words}", wire.sealed(wire.body))


def _crc_of_other_bytes(wire: Wire, dialect: Dialect) -> Tries:
    body = wire.body
    if len(wire.found) == 2 and len(body) > 3:
        if crc_bytes(body[1:]) == wire.found:
            yield Guess("the CRC leaves out the unit address", wire.sealed(body))
        wide = body[:2] + b"\0" + body[2:]
        if body[1] in (3, 4) and crc_bytes(wide) == wire.found:
            says = f"the CRC is that of the reply with a two-byte count, {shown(wide)}"
            yield Guess(says, wire.sealed(body))
    yield from _byte_order(wire, dialect)


def _byte_order(wire: Wire, dialect: Dialect) -> Tries:
    """Words of the data with their bytes swapped: all of them, or any single one."""
    body = wire.body
    start = 3 if len(body) % 2 else 2
    places = list(range(start, len(body) - 1, 2))
    for chosen in (places, *([place] for place in places)):
        turned = bytearray(body)
        for place in chosen:
            turned[place : place + 2] = turned[place : place + 2][::-1]
        if turned != body and crc_bytes(bytes(turned)) == wire.found and _fits(bytes(turned), dialect):
            places_shown = ", ".join(str(place + 1) for place in chosen)
            says = f"the two bytes from byte {places_shown} on are in the wrong order: the high byte is sent first"
            yield Guess(says, wire.sealed(bytes(turned)))
            return


def _damaged(wire: Wire, dialect: Dialect) -> Tries:
    """Small damage that a right CRC proves: one bit, two bytes exchanged, nibbles, all bits inverted."""
    frame = wire.frame
    inverted = bytes(byte ^ 0xFF for byte in frame)
    nibbles = bytes((byte & 0xF) << 4 | byte >> 4 for byte in frame)
    if _good(inverted, dialect):
        yield Guess("all bits are inverted: lines A and B are exchanged", inverted)
    if nibbles != frame and _good(nibbles, dialect):
        yield Guess("the two digits of each byte are swapped", nibbles)
    for at in range(len(frame) - 1):
        turned = frame[:at] + frame[at : at + 2][::-1] + frame[at + 2 :]
        if turned != frame and at < len(frame) - 2 and _good(turned, dialect):
            yield Guess(f"bytes {at + 1} and {at + 2} are exchanged", turned)
    for bit in range(8 * len(frame)):
        flipped = bytearray(frame)
        flipped[bit // 8] ^= 1 << bit % 8
        if _good(bytes(flipped), dialect):
            was, meant = frame[bit // 8], flipped[bit // 8]
            says = f"one bit is wrong: byte {bit // 8 + 1} is {was:02X} and would be {meant:02X}"
            yield Guess(f"{says}; noise on the line", bytes(flipped))


def _one_byte(wire: Wire, dialect: Dialect) -> Tries:
    """One byte of a short frame; in a long one something always comes out."""
    frame = wire.frame
    for at in range(len(frame) - 2 if len(frame) <= 16 else 0):
        for value in range(256):
            meant = frame[:at] + bytes([value]) + frame[at + 1 :]
            if value != frame[at] and _good(meant, dialect):
                yield Guess(f"one byte is wrong: byte {at + 1} is {frame[at]:02X} and would be {value:02X}", meant)


def _lost_byte(wire: Wire, dialect: Dialect) -> Tries:
    """The first byte is often lost while the line turns round; or one in the middle is."""
    for unit in range(1, 248):
        if _good(bytes([unit]) + wire.frame, dialect):
            says = f"the first byte is missing: with unit {unit} before it the CRC is right"
            yield Guess(f"{says}; the receiver was switched on too late", bytes([unit]) + wire.frame)
    if len(wire.frame) >= 5 and crc_bytes(wire.frame[:-1])[:1] == wire.frame[-1:] and _fits(wire.frame[:-1], dialect):
        yield Guess("the last byte is missing: it is the second of the CRC", seal("rtu", wire.frame[:-1]))


_PROVED_RTU = (
    _swapped_crc, _pairs_swapped, _spread, _no_colon, _seven_bits, _crc_of_other_bytes, _other_crc, _modbus_tcp,
    _binary_lrc, _damaged, _lost_byte,
)  # fmt: skip

# ---------------------------------------------------------------- ASCII, proved by a checksum


def _lookalikes(wire: Wire) -> Tries:
    """Letters that look like a digit."""
    meant = wire.frame.translate(bytes.maketrans(b"OoIlSZ", b"001152"))
    if meant != wire.frame and open_(meant).right:
        yield Guess("with digits instead of the letters that look like them the frame is right", meant)


def _lrc_of_characters(wire: Wire, _: Dialect) -> Tries:
    digits = wire.frame.rstrip(b"\r\n")[1:-2]
    found = wire.found[:1]
    if bytes([lrc(digits)]) == found:
        yield Guess("the LRC was computed over the characters instead of the bytes", wire.sealed(wire.body))
    elif bytes([lrc(b":" + digits)]) == found:
        yield Guess("the LRC was computed over the characters and the colon", wire.sealed(wire.body))


def _crc_in_ascii(wire: Wire, dialect: Dialect) -> Tries:
    data = wire.body + wire.found
    body = data[:-2]
    if len(data) > 4 and crc_bytes(body) in (data[-2:], data[:-3:-1]) and _fits(body, dialect):
        yield Guess("the checksum is the CRC of an RTU frame; ASCII has an LRC", wire.sealed(body))


def _other_lrc(wire: Wire, dialect: Dialect) -> Tries:
    if len(wire.found) != 1 or not _fits(wire.body, dialect):
        return
    found, right = wire.found[0], wire.expected[0]
    exclusive = 0
    for byte in wire.body:
        exclusive ^= byte
    others = (
        ("the sum of the bytes; the LRC is what it lacks to 0 (two's complement)", sum(wire.body) & 0xFF),
        ("the inverted sum; the LRC is one more (two's complement)", ~sum(wire.body) & 0xFF),
        ("the exclusive OR of the bytes; the LRC is the two's complement of their sum", exclusive),
        ("the LRC with its two digits swapped", (right & 0xF) << 4 | right >> 4),
    )
    for name, value in others:
        if found == value != right:
            yield Guess(f"the checksum is {name}", wire.sealed(wire.body))


_PROVED_ASCII = (_lrc_of_characters, _crc_in_ascii, _other_lrc)

# ---------------------------------------------------------------- only the length speaks for it


def _no_checksum(wire: Wire, dialect: Dialect) -> Tries:
    data = wire.body + wire.found
    if _fits(data, dialect) and not _whole(wire, dialect):
        sealed = wire.sealed(data)
        check = shown(sealed[-2:]) if wire.mode == "rtu" else f"{lrc(data):02X}"
        yield Guess(f"the checksum is missing: {wire.name} {check} belongs after it", sealed)


def _whole(wire: Wire, dialect: Dialect) -> bool:
    """Whether the frame has the right length as it is, so that only its checksum is wrong."""
    return bool(wire.found) and _fits(wire.body, dialect)


def _truncated(wire: Wire, dialect: Dialect) -> Tries:
    data = wire.body + wire.found
    if len(data) < 2:
        yield Guess("the frame is cut off: unit, function and checksum are the least")
        return
    check = 2 if wire.mode == "rtu" else 1
    kinds: dict[int, list[str]] = {}
    for one in layout.readings(data, dialect):
        size = one.size + check
        counted = one.number("quantity") is not None and one.number("byte count") is not None and one.agrees
        if one.function in layout.KNOWN and size > len(data) and (counted or not _whole(wire, dialect)):
            open_end = one.direction == "reply" and one.body[1] in _COUNTED_REPLIES and one.number("byte count") is None
            least = "at least " if open_end else ""
            kinds.setdefault(size, []).append(
                f"{'a refusal' if one.refusal else f'a {one.direction}'} has {least}{size}"
            )
    for size, said in kinds.items():
        missing = f"{size - len(data)} byte{'s' * (size - len(data) != 1)} missing"
        what = "request and reply have " + str(size) if len(said) > 1 else said[0]
        yield Guess(f"truncated: {missing}; of function {data[1] & 0x7F:02X}H {what} bytes")


_COUNTED_REPLIES = (1, 2, 3, 4)

_LIKELY = (_no_checksum, _truncated)
