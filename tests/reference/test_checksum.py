"""CRC and LRC against pymodbus, against frames typed from the manuals, and against the long division itself."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.framer import FramerAscii, FramerRTU

from driveblocks.reference.checksum import GENERATOR, START, crc16, crc_bytes, lrc, mirrored, remainder

Frames = st.binary(max_size=256)


@given(Frames)
def test_the_crc_is_that_of_pymodbus(data: bytes) -> None:
    assert int.from_bytes(crc_bytes(data), "big") == FramerRTU.compute_CRC(data)


@given(Frames)
def test_the_lrc_is_that_of_pymodbus(data: bytes) -> None:
    assert lrc(data) == FramerAscii.compute_LRC(data)


@given(st.binary(min_size=2, max_size=40))
def test_the_crc_is_the_rest_of_the_division(data: bytes) -> None:
    """The start FFFFH is the same as the first 16 bits inverted."""
    sent = int("".join(f"{mirrored(byte, 8):08b}" for byte in data), 2) << 16
    start = START << 8 * len(data)
    assert crc16(data) == mirrored(remainder(sent ^ start, GENERATOR), 16)


@pytest.mark.parametrize(
    ("body", "crc"),
    [
        ("01 03 20 00 00 01", "8F CA"),
        ("01 03 02 01 F4", "B8 53"),
        ("01 06 10 00 00 01", "4C CA"),
        ("01 10 FF FD 00 01 02 00 00", "BC B2"),
        ("01 08 00 00 12 AB", "AD 14"),
        ("", "FF FF"),
    ],
)
def test_crc_of_frames_from_the_manuals(body: str, crc: str) -> None:
    assert crc_bytes(bytes.fromhex(body)).hex(" ").upper() == crc


@pytest.mark.parametrize(
    ("body", "expected"), [("01 06 10 00 00 01", 0xE8), ("01 03 02 01 F4", 0x05), ("02 06 00 08 13 88", 0x55), ("", 0)]
)
def test_lrc_of_frames_from_the_manuals(body: str, expected: int) -> None:
    assert lrc(bytes.fromhex(body)) == expected


@given(st.binary(min_size=1, max_size=254), st.data())
def test_no_single_bit_goes_unnoticed(data: bytes, draw: st.DataObject) -> None:
    bit = draw.draw(st.integers(0, 8 * len(data) - 1))
    changed = bytearray(data)
    changed[bit // 8] ^= 1 << bit % 8
    assert crc16(bytes(changed)) != crc16(data)
    assert lrc(bytes(changed)) != lrc(data)
