"""CRC-16 and LRC, by MODBUS over Serial Line V1.02, 6.2.2 and 6.2.1.

The CRC is stated as what it is, the rest of a division of polynomials over GF(2), and looked up from there: bits go
in as the line sends them, lowest first, and the remainder is mirrored.
"""

GENERATOR = 0x18005
"""x^16 + x^15 + x^2 + 1."""

START = 0xFFFF


def remainder(dividend: int, divisor: int) -> int:
    """The rest of a division of polynomials whose coefficients are the bits of the numbers."""
    width = divisor.bit_length()
    while dividend.bit_length() >= width:
        dividend ^= divisor << (dividend.bit_length() - width)
    return dividend


def mirrored(number: int, width: int) -> int:
    """The lowest `width` bits in reverse order."""
    return int(f"{number:0{width}b}"[::-1], 2)


def change(generator: int) -> tuple[int, ...]:
    """How each byte changes a mirrored 16-bit rest: entry n is the rest of n, moved up by 16 bits."""
    return tuple(mirrored(remainder(mirrored(byte, 8) << 16, generator), 16) for byte in range(256))


_CHANGE = change(GENERATOR)


def crc16(data: bytes, start: int = START) -> int:
    """CRC-16 of some bytes; its low byte is sent first."""
    crc = start
    for byte in data:
        crc = crc >> 8 ^ _CHANGE[(crc ^ byte) & 0xFF]
    return crc


def crc_bytes(data: bytes, start: int = START) -> bytes:
    """CRC-16 as its two bytes on the wire."""
    return crc16(data, start).to_bytes(2, "little")


def lrc(data: bytes) -> int:
    """LRC: what the bytes lack to a sum of 0 modulo 256."""
    return (0x100 - sum(data) % 0x100) % 0x100
