"""Framing both ways, against pymodbus's framers."""

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
