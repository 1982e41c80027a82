"""Modbus frames written by hand from the manuals: RTU with the CRC of their C function, ASCII with their LRC."""

from functools import lru_cache


def _entry(byte: int) -> int:
    """One turn of the C function that SN300G5 (lines 211 to 227) and CHF (lines 277 to 294) print."""
    for _ in range(8):
        byte = (byte >> 1) ^ 0xA001 if byte & 1 else byte >> 1
    return byte


RUNS = {"CHF": (1, 2, 3, 4), "JSCC": (1, 2)}
"""Values of 1000H: CHF lines 319 to 326, JSCC lines 105 to 108."""
CONTROL_WORDS = {"ATV312": (8501, 0xF), "V20": (0x63, 0x40F), "ACS355": (0, 0xF)}
"""Where the control word is, and the bits that run.

Operation enabled, ATV312 page 12; ON by the PLC, G120C page 195; operation, ACS355 page 319.
"""
LAST_READ = 4
"""Function codes up to this one read registers, or bits."""
TABLE = tuple(_entry(byte) for byte in range(256))


@lru_cache(maxsize=1 << 16)
def crc(data: bytes) -> bytes:
    """CRC-16, low byte first, as the manuals that print it send it."""
    value = 0xFFFF
    for byte in data:
        value = (value >> 8) ^ TABLE[(value ^ byte) & 0xFF]
    return value.to_bytes(2, "little")


def lrc(data: bytes) -> int:
    """Two's complement of the sum of the bytes: CHF 11.6.3.3, line 300."""
    return -sum(data) & 0xFF


def rtu(body: bytes) -> bytes:
    """Unit, function and data as an RTU frame."""
    return body + crc(body)


def ascii_(body: bytes) -> bytes:
    """... as an ASCII frame: colon, capital hexadecimal digits, CR LF (CHF line 87, JSCC lines 68 to 79)."""
    return b":" + (body + bytes([lrc(body)])).hex().upper().encode() + b"\r\n"


@lru_cache(maxsize=1 << 16)
def runs(kind: str, body: bytes) -> bool:
    """Whether a request without checksum makes a drive of this make run or jog."""
    if kind == "MX2":
        return body[1:5] == b"\x05\0\0\xff"  # the run coil, I585 page 6-11
    if kind.startswith("PF"):
        return body[1:4] == b"\x06\x20\0" and bool(body[5] & 6)  # 2000H: start and jog, page C-4
    if kind == "GD200A":
        return body[1:4] == b"\x06\x20\0" and body[4:6] <= b"\0\4"  # 2000H: 1 to 4, page 139
    if kind in CONTROL_WORDS:
        address, bits = CONTROL_WORDS[kind]
        return body[1:4] == bytes((6, *divmod(address, 256))) and (body[4] << 8 | body[5]) & bits == bits
    if kind == "SN300G5":
        return body[1:4] == b"\x10\0\0" and bool(body[8] & 3)  # 0000H: bits 0 and 1
    return body[1:4] == b"\x06\x10\0" and body[5] in RUNS[kind]


def opened(frame: bytes) -> bytes | None:
    """Unit, function and data of an RTU frame; None: damaged."""
    return frame[:-2] if len(frame) >= 4 and crc(frame[:-2]) == frame[-2:] else None


@lru_cache(maxsize=1 << 16)
def ascii_opened(frame: bytes) -> bytes | None:
    """... of an ASCII frame; None: damaged, or written in small letters."""
    if len(frame) < len(b":\r\n"):
        return None
    digits = frame[1:-2]
    if frame[:1] != b":" or frame[-2:] != b"\r\n" or digits.strip(b"0123456789ABCDEF") or len(digits) % 2:
        return None
    data = bytes.fromhex(digits.decode())
    return data[:-1] if len(data) >= 3 and not lrc(data[:-1]) - data[-1] else None
