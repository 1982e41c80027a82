"""Frames in the registers of a PLC whose serial instruction takes one byte (8 bits) or two (16 bits) from each.

Source: JSCC instructions, section 6, tables D0 to D8: 8-bit mode for RTU, 16-bit mode for ASCII, the first of two
characters in the high byte, and nothing in the low byte after the last of an odd number.
"""

from collections.abc import Sequence


def pack(data: bytes, bits: int) -> list[int]:
    """Bytes to registers of 16 bits; `bits` is 8 or 16."""
    if bits == 8:
        return list(data)
    even = data + bytes(len(data) % 2)
    return [int.from_bytes(even[at : at + 2], "big") for at in range(0, len(even), 2)]


def unpack(registers: Sequence[int], count: int, bits: int) -> bytes:
    """The first `count` bytes that registers hold; in 8-bit mode their high bytes say nothing."""
    if bits == 8:
        return bytes(register & 0xFF for register in registers[:count])
    return b"".join(register.to_bytes(2, "big") for register in registers)[:count]
