"""CRC-16 and LRC, by MODBUS over Serial Line V1.02, 6.2.2 and 6.2.1."""

START = 0xFFFF


def table(polynomial: int) -> tuple[int, ...]:
    """How each byte changes a 16-bit CRC that takes bits lowest first; the polynomial is mirrored, as A001H."""
    entries = []
    for entry in range(256):
        for _ in range(8):
            entry = entry >> 1 ^ polynomial if entry & 1 else entry >> 1  # noqa: PLW2901  (the register is shifted)
        entries.append(entry)
    return tuple(entries)


MODBUS = table(0xA001)


def crc16(data: bytes, start: int = START, changes: tuple[int, ...] = MODBUS) -> int:
    """CRC-16 of some bytes; its low byte is sent first."""
    crc = start
    for byte in data:
        crc = crc >> 8 ^ changes[(crc ^ byte) & 0xFF]
    return crc


def crc_bytes(data: bytes) -> bytes:
    """CRC-16 as its two bytes on the wire."""
    return crc16(data).to_bytes(2, "little")


def lrc(data: bytes) -> int:
    """LRC: the two's complement of the sum of the bytes."""
    return -sum(data) & 0xFF
