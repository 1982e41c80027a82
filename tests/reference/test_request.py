"""Requests: bytes against pymodbus, and the order of what is wrong."""

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
from driveblocks.reference.request import Asked, Requests, body

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


def test_every_mistake_is_reported_in_the_order_of_the_block(drives: dict[str, Drive]) -> None:
    worst = Asked(3, 0, 0xFFFF, 200, ascii=True)
    wrongs = list(Requests(drives["SN300G5"]).wrongs(worst))
    assert wrongs == ["MODE", "NO_BROADCAST", "QUANTITY", "ASCII_LIMIT", "WRAP", "NOT_READABLE"]
