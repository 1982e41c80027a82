"""Framing both ways: against pymodbus's framers, and each reason for refusal in its order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import DecodePDU

from driveblocks.reference.framing import Framed, ascii_decode, ascii_encode, rtu_open, rtu_seal

Bodies = st.binary(min_size=3, max_size=254)
RTU, ASCII = FramerRTU(DecodePDU(True)), FramerAscii(DecodePDU(True))


@given(Bodies)
def test_frames_are_those_of_pymodbus(body: bytes) -> None:
    assert rtu_seal(body).data == RTU.encode(body[1:], body[0], 0)
    assert ascii_encode(body).data == ASCII.encode(body[1:], body[0], 0)


@given(Bodies)
def test_pymodbus_reads_the_ascii_frames(body: bytes) -> None:
    characters = ascii_encode(body).data
    assert ASCII.decode(characters) == (len(characters), body[0], 0, body[1:])


@given(Bodies)
def test_what_is_framed_comes_out_again(body: bytes) -> None:
    assert rtu_open(rtu_seal(body).data) == Framed("OK", body)
    assert ascii_decode(ascii_encode(body).data) == Framed("OK", body)


@pytest.mark.parametrize("size", [0, 1, 255, 300])
def test_a_body_of_impossible_length_is_no_frame(size: int) -> None:
    assert rtu_seal(bytes(size)) == Framed("LENGTH")
    assert ascii_encode(bytes(size)) == Framed("LENGTH")


@pytest.mark.parametrize(
    ("frame", "result"),
    [
        ("", "SILENCE"),
        ("01", "SHORT"),
        ("01 83 02 C0", "SHORT"),
        ("01 83 02 C0 F1", "OK"),
        ("01 83 02 F1 C0", "CHECKSUM"),
        ("01 03 02 01 F4 B8 53", "OK"),
        ("01 03 02 01 F4 B8 53 01", "CHECKSUM"),
        # the rest after the CRC is 0: only the length of the reply shows that a 00 was received too much
        ("01 03 02 01 F4 B8 53 00", "OK"),
        ("01 03 02 01 F4 B8 53 00 00", "OK"),
        ("01 03 02 01 F4 B8 53 00 00 00", "OK"),
        ("01 03 02 01 F4 B8 53 00 00 01", "CHECKSUM"),
        ("01 " * 257, "LONG"),
    ],
)
def test_rtu_frames_are_opened_or_refused(frame: str, result: str) -> None:
    opened = rtu_open(bytes.fromhex(frame))
    assert opened.result == result
    assert opened.data == (bytes.fromhex(frame)[:-2] if result == "OK" else b"")


@pytest.mark.parametrize(
    ("characters", "result"),
    [
        ("", "SILENCE"),
        (":" * 514, "LONG"),
        ("010320000001DB\r\n", "NO_START"),
        (":0183027A\r", "SHORT"),
        ("010", "NO_START"),
        (":0183027A\r\n", "OK"),
        (":010320000001DB\n\r", "NO_END"),
        (":010320000001DB00", "NO_END"),
        (":0103200000010DB\r\n", "ODD_DIGITS"),
        (":01032000O001DB\r\n", "NOT_HEX"),
        (":010320000001db\r\n", "NOT_HEX"),
        (":010320000001DC\r\n", "CHECKSUM"),
        (":010320000001DB\r\n", "OK"),
    ],
)
def test_ascii_frames_are_decoded_or_refused(characters: str, result: str) -> None:
    assert ascii_decode(characters.encode("ascii")).result == result
