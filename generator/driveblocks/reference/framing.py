"""RTU and ASCII framing both ways, by MODBUS over Serial Line V1.02, 2.5.1 and 2.5.2.

A body is what both framings carry: unit address, function code and data, 2 to 254 bytes.
"""

from dataclasses import dataclass

from driveblocks.reference.checksum import crc_bytes, lrc

BODY_BYTES = 254
RTU_BYTES = 256
ASCII_CHARS = 513
SHORTEST_RTU = 5
"""An exception reply: unit, function, code, two bytes of CRC."""

SHORTEST_ASCII = 11
"""An exception reply: colon, four bytes of two characters each, CR, LF."""

_DIGITS = b"0123456789ABCDEF"


@dataclass(frozen=True)
class Framed:
    """OK and the bytes that came out, or why there are none."""

    result: str
    data: bytes = b""


def rtu_seal(body: bytes) -> Framed:
    """Body to RTU frame: OK or LENGTH."""
    if not 2 <= len(body) <= BODY_BYTES:
        return Framed("LENGTH")
    return Framed("OK", body + crc_bytes(body))


def rtu_open(frame: bytes) -> Framed:
    """What was received between two silences to body: OK, SILENCE, SHORT, LONG or CHECKSUM."""
    if not frame:
        return Framed("SILENCE")
    if len(frame) < SHORTEST_RTU:
        return Framed("SHORT")
    if len(frame) > RTU_BYTES:
        return Framed("LONG")
    body = frame[:-2]
    return Framed("OK", body) if frame[-2:] == crc_bytes(body) else Framed("CHECKSUM")


def ascii_encode(body: bytes) -> Framed:
    """Body to the characters of an ASCII frame: OK or LENGTH."""
    if not 2 <= len(body) <= BODY_BYTES:
        return Framed("LENGTH")
    digits = (body + bytes([lrc(body)])).hex().upper()
    return Framed("OK", f":{digits}\r\n".encode("ascii"))


def ascii_decode(characters: bytes) -> Framed:
    """Characters from the colon on to body: OK or the first of the reasons that apply, in the blocks' order."""
    digits = characters[1:-2]
    wrong = (
        ("SILENCE", not characters),
        ("LONG", len(characters) > ASCII_CHARS),
        ("NO_START", characters[:1] != b":"),
        ("SHORT", len(characters) < SHORTEST_ASCII),
        ("NO_END", characters[-2:] != b"\r\n"),
        ("ODD_DIGITS", len(characters) % 2 == 0),
        ("NOT_HEX", any(digit not in _DIGITS for digit in digits)),
    )
    found = next((name for name, holds in wrong if holds), None)
    if found is not None:
        return Framed(found)
    data = bytes.fromhex(digits.decode("ascii"))
    return Framed("OK", data[:-1]) if lrc(data[:-1]) == data[-1] else Framed("CHECKSUM")
