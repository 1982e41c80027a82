"""Framing, by MODBUS over Serial Line V1.02, 2.5.1 and 2.5.2; a body is unit address, function code and data."""

from typing import Literal

from driveblocks.modbus.checksum import crc_bytes, lrc

Mode = Literal["rtu", "ascii"]
RTU_BYTES, ASCII_CHARS = 256, 513
"""The longest frames."""


def checksum(mode: str, body: bytes) -> bytes:
    """The checksum that belongs to a body in a mode, as bytes: CRC or LRC."""
    return bytes([lrc(body)]) if mode == "ascii" else crc_bytes(body)


def seal(mode: str, body: bytes) -> bytes:
    """A body as a frame of a mode."""
    whole = body + checksum(mode, body)
    return whole if mode == "rtu" else f":{whole.hex().upper()}\r\n".encode("ascii")
