"""Framing of pasted bytes: RTU or ASCII, the checksum that is there and the one that belongs there."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.modbus.frame import Mode, checksum, seal

DIGITS = b"0123456789ABCDEFabcdef"
SHORTEST = {"rtu": 4, "ascii": 3}
"""Bytes of the shortest frame: unit address, function code and checksum."""


@dataclass(frozen=True)
class Wire:
    """A frame: what it carries, and its checksum."""

    mode: Mode
    frame: bytes
    """All bytes or characters as they came."""
    body: bytes
    found: bytes
    """The checksum as it came; empty if the frame is too short for one."""
    broken: tuple[tuple[str, str], ...] = ()
    """What is wrong with the framing: what it is, and what it might be instead."""

    aligned: bool = True
    """Whether the digits of an ASCII frame pair up into bytes; a stray character shifts all that follow."""

    @property
    def expected(self) -> bytes:
        """The checksum that belongs to the body."""
        return checksum(self.mode, self.body)

    @property
    def right(self) -> bool:
        return self.aligned and bool(self.body) and self.found == self.expected

    @property
    def name(self) -> str:
        return "LRC" if self.mode == "ascii" else "CRC"

    def sealed(self, body: bytes) -> bytes:
        """Another body framed in the same mode."""
        return seal(self.mode, body)


def mode_of(data: bytes) -> Mode:
    """RTU or ASCII: a colon, and mostly hexadecimal digits after it, unless it is an RTU frame with a right CRC."""
    text = data[1:].rstrip(b"\r\n")
    digits = sum(byte & 0x7F in DIGITS for byte in text)
    if data[:1] != b":" or 2 * digits < len(text) or _rtu(data).right:
        return "rtu"
    return "ascii"


def open_(data: bytes) -> Wire:
    """Take the framing off."""
    return _ascii(data) if mode_of(data) == "ascii" else _rtu(data)


def _rtu(data: bytes) -> Wire:
    if len(data) < SHORTEST["rtu"]:
        return Wire("rtu", data, data, b"")
    return Wire("rtu", data, data[:-2], data[-2:])


def _ascii(data: bytes) -> Wire:
    text = data.rstrip(b"\r\n")
    digits = bytes(byte for byte in text[1:] if byte in DIGITS)
    broken = tuple(_broken(text, data[len(text) :], digits))
    even = bytes.fromhex(digits[: len(digits) & ~1].decode("ascii"))
    aligned = len(digits) == len(text) - 1 and len(digits) % 2 == 0
    if len(even) < SHORTEST["ascii"]:
        return Wire("ascii", data, even, b"", broken, aligned)
    return Wire("ascii", data, even[:-1], even[-1:], broken, aligned)


def _broken(text: bytes, end: bytes, digits: bytes) -> Iterator[tuple[str, str]]:
    """What is wrong with the characters of an ASCII frame."""
    if end != b"\r\n":
        yield f"the frame ends with {_end(end)}, not with CR LF (0D 0A)", _why_end(end)
    strange = [(place, byte) for place, byte in enumerate(text[1:], 2) if byte not in DIGITS]
    for place, byte in strange[:3]:
        yield f"character {place}, `{chr(byte)}`, is no hexadecimal digit", _meant(byte)
    if len(strange) > 3:
        yield f"{len(strange) - 3} more characters are no hexadecimal digits", ""
    if digits.upper() != digits:
        yield "hexadecimal digits are in lower case", "the standard has upper case, and drives may refuse lower case"
    if len(text) % 2 == 0:
        yield f"{len(text) - 1} digits are an odd number", "a character is missing or one too many: each byte has two"


def _end(end: bytes) -> str:
    names = " ".join({13: "CR", 10: "LF"}[byte] for byte in end)
    return names or "neither CR nor LF"


def _why_end(end: bytes) -> str:
    if end == b"\n\r":
        return "CR and LF are swapped"
    if not end:
        return "the end was cut off, or the sender omits it"
    return (
        "the sender adds one of them, or a program took the other out"
        if len(end) == 1
        else "there is more than one end"
    )


def _meant(byte: int) -> str:
    meant = {"O": "0", "o": "0", "l": "1", "I": "1"}.get(chr(byte))
    if meant:
        return f"is the digit {meant} meant?"
    if byte & 0x80 and byte & 0x7F in DIGITS:
        return "without its highest bit it is one: parity was read as data, 7 data bits were received as 8"
    return "noise on the line, or not from an ASCII frame"
