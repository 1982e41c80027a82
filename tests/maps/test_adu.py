"""Frames taken apart: PDUs against pymodbus, refusals in each family's form, and every wrong length."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import DecodePDU, ExceptionResponse, ModbusPDU
from pymodbus.pdu.diag_message import ReturnQueryDataRequest, ReturnQueryDataResponse
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    ReadHoldingRegistersResponse,
    ReadInputRegistersRequest,
    ReadInputRegistersResponse,
    WriteMultipleRegistersRequest,
    WriteMultipleRegistersResponse,
    WriteSingleRegisterRequest,
    WriteSingleRegisterResponse,
)

from driveblocks.maps import adu
from driveblocks.maps.adu import Fields, FrameError
from driveblocks.modbus.frame import checksum
from driveblocks.modbus.layout import Dialect, Direction

WORDS = st.lists(st.integers(0, 0xFFFF), min_size=1, max_size=16)
UNIT = st.integers(1, 247)
WORD = st.integers(0, 0xFFFF)


def both(pdu: ModbusPDU) -> list[tuple[str, bytes]]:
    """The frame that pymodbus builds of a PDU, in both modes."""
    framers = (("rtu", FramerRTU(DecodePDU(False))), ("ascii", FramerAscii(DecodePDU(False))))
    return [(mode, framer.buildFrame(pdu)) for mode, framer in framers]


def apart(pdu: ModbusPDU, direction: Direction, dialect: Dialect = Dialect()) -> Fields:  # noqa: B008 - frozen
    """What the frames of a PDU carry; the same in both modes, and their checksums hold."""
    found = set()
    for mode, frame in both(pdu):
        body, given = adu.split(mode, frame)
        assert given == checksum(mode, body)
        found.add(adu.fields(body, direction, dialect))
    assert len(found) == 1
    return found.pop()


@given(UNIT, WORD, st.integers(1, 125))
def test_read_requests(unit: int, address: int, count: int) -> None:
    holding = ReadHoldingRegistersRequest(address=address, count=count, dev_id=unit)
    assert apart(holding, "request") == Fields(unit, 3, address=address, words=count)
    inputs = ReadInputRegistersRequest(address=address, count=count, dev_id=unit)
    assert apart(inputs, "request") == Fields(unit, 4, address=address, words=count)


@given(UNIT, WORDS)
def test_read_replies(unit: int, values: list[int]) -> None:
    words, values_ = len(values), tuple(values)
    holding = ReadHoldingRegistersResponse(registers=values, dev_id=unit)
    assert apart(holding, "reply") == Fields(unit, 3, words=words, byte_count=2 * words, values=values_)
    inputs = ReadInputRegistersResponse(registers=values, dev_id=unit)
    assert apart(inputs, "reply") == Fields(unit, 4, words=words, byte_count=2 * words, values=values_)


@given(UNIT, WORD, WORD)
def test_writes_of_one(unit: int, address: int, value: int) -> None:
    due = Fields(unit, 6, address=address, values=(value,))
    assert apart(WriteSingleRegisterRequest(address=address, registers=[value], dev_id=unit), "request") == due
    assert apart(WriteSingleRegisterResponse(address=address, registers=[value], dev_id=unit), "reply") == due


@given(UNIT, WORD, WORDS)
def test_writes_of_several(unit: int, address: int, values: list[int]) -> None:
    words = len(values)
    request = WriteMultipleRegistersRequest(address=address, registers=values, dev_id=unit)
    due = Fields(unit, 16, address=address, words=words, byte_count=2 * words, values=tuple(values))
    assert apart(request, "request") == due
    reply = WriteMultipleRegistersResponse(address=address, count=words, dev_id=unit)
    assert apart(reply, "reply") == Fields(unit, 16, address=address, words=words)


@given(UNIT, WORD)
def test_loop_test(unit: int, data: int) -> None:
    due = Fields(unit, 8, sub_function=0, data=data)
    message = data.to_bytes(2, "big")
    assert apart(ReturnQueryDataRequest(message=message, dev_id=unit), "request") == due
    assert apart(ReturnQueryDataResponse(message=message, dev_id=unit), "reply") == due


@given(UNIT, st.sampled_from([3, 4, 6, 8, 16, 1, 2, 5]), st.integers(1, 255))
def test_exceptions(unit: int, function: int, code: int) -> None:
    pdu = ExceptionResponse(function, exception_code=code, device_id=unit)
    assert apart(pdu, "reply") == Fields(unit, function + 0x80, error=code)


def test_exceptions_with_another_addition() -> None:
    assert adu.fields(bytes([1, 0x43, 2]), "reply", Dialect(add=0x40)) == Fields(1, 0x43, error=2)


def test_a_refusal_by_a_write_to_a_fixed_address() -> None:
    refusal = Dialect(function=6, address=0x5001)
    body = bytes([1, 6, 0x50, 1, 0, 5])
    assert adu.fields(body, "reply", refusal) == Fields(1, 6, address=0x5001, error=5)
    assert adu.fields(body, "request", refusal) == Fields(1, 6, address=0x5001, values=(5,))
    assert adu.fields(bytes([1, 6, 0x50, 2, 0, 5]), "reply", refusal) == Fields(1, 6, address=0x5002, values=(5,))


def test_what_a_refused_request_is_due() -> None:
    assert adu.refused(Fields(7, 3, address=1, words=2), Dialect()) == Fields(7, 0x83)


@pytest.mark.parametrize(
    ("body", "direction", "wrong"),
    [
        ("01 03 00 01 00", "request", "a read request with 3 data bytes"),
        ("01 03 02 00", "reply", "a read reply with byte count 2 with 2 data bytes"),
        ("01 03 03 00 00 00", "reply", "a read reply with the odd byte count 3"),
        ("01 06 00 01 00", "request", "a write of one register with 3 data bytes"),
        ("01 08 00 00", "reply", "a diagnostics frame with 2 data bytes"),
        ("01 10 00 01 00 01", "request", "a write request with 4 data bytes"),
        ("01 10 00 01 00 01 02 00", "request", "a write request with byte count 2 with 6 data bytes"),
        ("01 10 00 01 00 02 02 00 00", "request", "byte count 2 for 2 words"),
        ("01 10 00 01 00", "reply", "a reply to a write with 3 data bytes"),
        ("01 83 01 02", "reply", "an exception reply with 2 data bytes"),
        ("01 07 00", "request", "function 07H is not one that a map's frame may have"),
        ("01 83 01", "request", "function 83H is not one that a map's frame may have"),
    ],
)
def test_a_wrong_length_is_named(body: str, direction: Direction, wrong: str) -> None:
    with pytest.raises(FrameError) as caught:
        adu.fields(bytes.fromhex(body), direction, Dialect())
    assert str(caught.value) == wrong
    assert caught.value.right


@pytest.mark.parametrize(
    ("mode", "frame", "wrong"),
    [
        ("rtu", b":0103\r\n", "this is an ASCII frame"),
        ("rtu", b"\x01\x03\x00\x00", "an RTU frame of 4 bytes"),
        ("ascii", b"\x01\x03\x00\x00\x00", "an ASCII frame without `:` before or CR LF after"),
        ("ascii", b":010300\n\r", "an ASCII frame without `:` before or CR LF after"),
        ("ascii", b":01030\r\n", "an ASCII frame with 5 digits"),
        ("ascii", b":0103FC\r\n", "an ASCII frame of 3 bytes"),
        ("ascii", b":\r\n", "an ASCII frame of 0 bytes"),
    ],
)
def test_a_frame_that_cannot_be_split_is_named(mode: str, frame: bytes, wrong: str) -> None:
    with pytest.raises(FrameError) as caught:
        adu.split(mode, frame)
    assert str(caught.value) == wrong


@given(st.sampled_from(["request", "reply"]), st.binary(min_size=3, max_size=40))
def test_any_body_is_taken_apart_or_named(direction: Direction, body: bytes) -> None:
    try:
        found = adu.fields(body, direction, Dialect(function=6, address=0x5001))
    except FrameError:
        return
    assert (found.unit, found.function) == (body[0], body[1])


@pytest.mark.parametrize(
    ("word", "signed", "number"),
    [(0xFFFF, True, -1), (0xFFFF, False, 65535), (0x7FFF, True, 32767), (0x8000, True, -32768)],
)
def test_the_number_of_a_word(word: int, signed: bool, number: int) -> None:
    assert adu.number(word, signed) == number


def test_fields_are_shown_as_a_map_writes_them() -> None:
    assert adu.shown("address", 0x26) == "0026H"
    assert adu.shown("function", 3) == "03H"
    assert adu.shown("words", 16) == "16"
    assert adu.shown("values", (1, 5000)) == "0001H 1388H"
    assert adu.shown("values", ()) == adu.shown("data", None) == "nothing"
    assert adu.shown("values", (0,) * 20) == " ".join(["0000H"] * 16) + " ... (20 words)"
