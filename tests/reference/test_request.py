"""Requests: bytes against pymodbus, and each reason for refusal on drives whose limits are typed from their manuals."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.pdu import ModbusPDU
from pymodbus.pdu.diag_message import ReturnQueryDataRequest
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    ReadInputRegistersRequest,
    WriteMultipleRegistersRequest,
    WriteSingleRegisterRequest,
)

from driveblocks.maps.model import Drive
from driveblocks.reference.request import Asked, Built, Requests, body

pytestmark = pytest.mark.every_family

Word = st.integers(0, 0xFFFF)


def pdu(message: ModbusPDU) -> bytes:
    """Function code and data as pymodbus sends them."""
    return bytes([message.function_code]) + message.encode()


@given(st.sampled_from([3, 4]), Word, st.integers(1, 125))
def test_reads_are_those_of_pymodbus(function: int, address: int, quantity: int) -> None:
    kind = {3: ReadHoldingRegistersRequest, 4: ReadInputRegistersRequest}[function]
    asked = Asked(function, 9, address, quantity)
    assert body(asked) == b"\x09" + pdu(kind(address=address, count=quantity))


@given(Word, Word)
def test_single_writes_and_echo_tests_are_those_of_pymodbus(address: int, value: int) -> None:
    single = WriteSingleRegisterRequest(address=address, registers=[value])
    assert body(Asked(6, 1, address, value=value)) == b"\x01" + pdu(single)
    assert body(Asked(8, 1, value=value)) == b"\x01" + pdu(ReturnQueryDataRequest(value))


@given(Word, st.lists(Word, min_size=1, max_size=123))
def test_multiple_writes_are_those_of_pymodbus(address: int, words: list[int]) -> None:
    asked = Asked(16, 1, address, len(words), words=tuple(words))
    assert body(asked) == b"\x01" + pdu(WriteMultipleRegistersRequest(address=address, registers=words))


def build(drive: Drive, function: int, **more: Any) -> Built:
    """What a drive's request block answers."""
    return Requests(drive).build(Asked(function, **more))


@pytest.mark.parametrize(
    ("prefix", "function", "more", "result"),
    [
        # SN300G5: RTU only; units 1 to 20H; 03 08 10 with 16 words; broadcasts start at 0000H, 0001H or 0002H
        ("SN300G5", 3, {"address": 0x26, "quantity": 2}, "OK"),
        ("SN300G5", 3, {"address": 0x26, "quantity": 2, "ascii": True}, "MODE"),
        ("SN300G5", 6, {"address": 0x0000}, "FUNCTION"),
        ("SN300G5", 4, {"address": 0x0026}, "FUNCTION"),
        ("SN300G5", 6, {"address": 0x0000, "ascii": True}, "MODE"),
        ("SN300G5", 3, {"address": 0x26, "unit": 0x20}, "OK"),
        ("SN300G5", 3, {"address": 0x26, "unit": 0x21}, "UNIT"),
        ("SN300G5", 3, {"address": 0x26, "unit": 0}, "NO_BROADCAST"),
        ("SN300G5", 8, {"unit": 0}, "NO_BROADCAST"),
        ("SN300G5", 16, {"address": 0x0000, "unit": 0, "words": (1,)}, "OK"),
        ("SN300G5", 16, {"address": 0x0006, "unit": 0, "words": (1,)}, "NO_BROADCAST"),
        ("SN300G5", 3, {"address": 0x0000, "quantity": 16}, "OK"),
        ("SN300G5", 3, {"address": 0x0000, "quantity": 17}, "QUANTITY"),
        ("SN300G5", 3, {"address": 0x0000, "quantity": 0}, "QUANTITY"),
        ("SN300G5", 3, {"address": 0xFFFF, "quantity": 2}, "WRAP"),
        ("SN300G5", 3, {"address": 0x0036, "quantity": 1}, "OK"),
        ("SN300G5", 3, {"address": 0x0036, "quantity": 2}, "NOT_READABLE"),
        ("SN300G5", 3, {"address": 0x0013, "quantity": 1}, "OK"),
        ("SN300G5", 16, {"address": 0x0000, "quantity": 2, "words": (1, 2)}, "OK"),
        ("SN300G5", 16, {"address": 0x0002, "words": (1,)}, "NOT_WRITABLE"),
        ("SN300G5", 16, {"address": 0x0010, "words": (1,)}, "NOT_WRITABLE"),
        ("SN300G5", 16, {"address": 0xFFFD, "words": (0,)}, "OK"),
        ("SN300G5", 8, {"value": 0x12AB}, "OK"),
        ("SN300G5", 8, {"sub_function": 1}, "SUB_FUNCTION"),
        # JSCC: 25 data bytes are 12 words of a reply and 10 of a 10H request; no broadcast; 00nnH
        ("JSCC", 3, {"address": 0x2000, "quantity": 2}, "OK"),
        ("JSCC", 3, {"address": 0x0000, "quantity": 12}, "OK"),
        ("JSCC", 3, {"address": 0x0000, "quantity": 13}, "QUANTITY"),
        ("JSCC", 16, {"address": 0x0000, "quantity": 10, "words": (0,) * 10}, "OK"),
        ("JSCC", 16, {"address": 0x0000, "quantity": 11, "words": (0,) * 11}, "QUANTITY"),
        ("JSCC", 6, {"address": 0x1000, "value": 3, "unit": 0}, "NO_BROADCAST"),
        ("JSCC", 6, {"address": 0x1000, "value": 3, "unit": 248}, "UNIT"),
        ("JSCC", 8, {}, "FUNCTION"),
        ("JSCC", 3, {"address": 0x1000}, "NOT_READABLE"),
        ("JSCC", 3, {"address": 0x00FF, "quantity": 2}, "NOT_READABLE"),
        ("JSCC", 6, {"address": 0x2000}, "NOT_WRITABLE"),
        # CHF: 16 words by RTU, 7 by ASCII (16 data bytes); 8000H more is RAM alone and cannot be read
        ("CHF", 3, {"address": 0x3000, "quantity": 16}, "OK"),
        ("CHF", 3, {"address": 0x3000, "quantity": 7, "ascii": True}, "OK"),
        ("CHF", 3, {"address": 0x3000, "quantity": 8, "ascii": True}, "ASCII_LIMIT"),
        ("CHF", 3, {"address": 0x3000, "quantity": 17, "ascii": True}, "QUANTITY"),
        ("CHF", 3, {"address": 0x0007}, "OK"),
        ("CHF", 3, {"address": 0x8007}, "NOT_READABLE"),
        ("CHF", 6, {"address": 0x8007, "value": 5}, "OK"),
        ("CHF", 6, {"address": 0x81FF}, "OK"),
        ("CHF", 6, {"address": 0x8200}, "NOT_WRITABLE"),
        ("CHF", 6, {"address": 0x9000}, "NOT_WRITABLE"),
        ("CHF", 6, {"address": 0x1000, "value": 5, "unit": 0}, "OK"),
        ("CHF", 6, {"address": 0x1001}, "NOT_WRITABLE"),
        ("CHF", 16, {"address": 0x1000, "words": (5,)}, "FUNCTION"),
    ],
)
def test_the_first_thing_that_is_wrong(
    drives: dict[str, Drive], prefix: str, function: int, more: dict[str, Any], result: str
) -> None:
    assert build(drives[prefix], function, **more).result == result


def test_every_mistake_is_reported_in_the_order_of_the_block(drives: dict[str, Drive]) -> None:
    worst = Asked(3, 0, 0xFFFF, 200, ascii=True)
    wrongs = list(Requests(drives["SN300G5"]).wrongs(worst))
    assert wrongs == ["MODE", "NO_BROADCAST", "QUANTITY", "ASCII_LIMIT", "WRAP", "NOT_READABLE"]


def test_a_refused_request_has_no_bytes(drives: dict[str, Drive]) -> None:
    assert build(drives["CHF"], 3, address=0x8007).body == b""


def test_every_example_request_is_built(drives: dict[str, Drive]) -> None:
    built = 0
    for drive in drives.values():
        for frame in (one for one in drive.frames if one.direction == "request"):
            said = frame.means
            asked = Asked(
                function=said.function,
                unit=said.unit,
                address=said.address or 0,
                quantity=said.words or 1,
                value=said.data if said.data is not None else (*said.values, 0)[0],
                sub_function=said.sub_function or 0,
                words=said.values,
                ascii=frame.mode == "ascii",
            )
            made = Requests(drive).build(asked)
            if frame.mode == "rtu":
                assert (made.result, made.body) == ("OK", frame.correct[:-2]), frame.id
            else:
                assert (made.result, made.body.hex().upper().encode()) == ("OK", frame.correct[1:-4]), frame.id
            built += 1
    assert built >= 12
