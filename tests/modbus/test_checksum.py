"""CRC and LRC against pymodbus and the standard, and other CRCs by their published check values."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.framer import FramerAscii, FramerRTU

from driveblocks.modbus.checksum import crc16, crc_bytes, lrc, table


@given(st.binary(min_size=1, max_size=260))
def test_the_crc_is_that_of_pymodbus(data: bytes) -> None:
    assert crc_bytes(data) == FramerRTU.compute_CRC(data).to_bytes(2, "big")


@given(st.binary(min_size=1, max_size=260))
def test_the_lrc_is_that_of_pymodbus(data: bytes) -> None:
    assert lrc(data) == FramerAscii.compute_LRC(data)


def test_the_crc_of_the_standard() -> None:
    """MODBUS over Serial Line V1.02, 6.2.2 names the register after 02 07: 1241H, sent as 41 12."""
    assert crc_bytes(bytes([2, 7])) == bytes([0x41, 0x12])


def test_the_lrc_wraps() -> None:
    assert lrc(b"\xff\xff") == 2
    assert lrc(b"\x00") == 0


@pytest.mark.parametrize(("polynomial", "start", "check"), [(0xA001, 0xFFFF, 0x4B37), (0x8408, 0, 0x2189)])
def test_published_check_values(polynomial: int, start: int, check: int) -> None:
    """What CRC-16/MODBUS and CRC-16/KERMIT give for the nine digits."""
    assert crc16(b"123456789", start, table(polynomial)) == check
