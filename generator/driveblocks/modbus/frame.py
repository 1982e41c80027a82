"""Framing, by MODBUS over Serial Line V1.02, 2.5.1 and 2.5.2; a body is unit address, function code and data."""

from typing import Literal

from driveblocks.modbus.checksum import crc_bytes, lrc

Mode = Literal["rtu", "ascii"]
RTU_BYTES, ASCII_CHARS = 256, 513
"""The longest frames."""
_DIGITS = b"0123456789ABCDEF"


def checksum(mode: str, body: bytes) -> bytes:
    """The checksum that belongs to a body in a mode, as bytes: CRC or LRC."""
    return bytes([lrc(body)]) if mode == "ascii" else crc_bytes(body)


def seal(mode: str, body: bytes) -> bytes:
    """A body as a frame of a mode."""
    whole = body + checksum(mode, body)
    return whole if mode == "rtu" else f":{whole.hex().upper()}\r\n".encode("ascii")


def opened(mode: str, frame: bytes) -> bytes | None:
    """The body of a whole frame; None if its framing or its checksum is wrong."""
    if mode == "rtu":
        whole = frame
    elif frame[:1] == b":" and frame[-2:] == b"\r\n" and len(frame) % 2 and not frame[1:-2].strip(_DIGITS):
        whole = bytes.fromhex(frame[1:-2].decode("ascii"))
    else:
        return None
    size = len(whole) - (2 if mode == "rtu" else 1)
    return whole[:size] if size >= 2 and checksum(mode, whole[:size]) == whole[size:] else None
