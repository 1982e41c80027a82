"""Replies: a byte count of two bytes, the dialects of the drives, and pymodbus as the drive."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.pdu import ExceptionResponse, ModbusPDU
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersResponse,
    WriteMultipleRegistersResponse,
    WriteSingleRegisterResponse,
)

from driveblocks.maps.model import Drive
from driveblocks.reference.reply import Answer, Dialect, dialect, parse
from driveblocks.reference.request import Asked, body

STANDARD = Dialect()
READ = Asked(3, 1, 0x2000, 2)
WRITE = Asked(6, 1, 0x1000, value=3)
SEVERAL = Asked(16, 1, 0x0001, 2, words=(7, 8))
LOOP = Asked(8, 1, value=0x12AB)
Word = st.integers(0, 0xFFFF)


@pytest.mark.parametrize(
    ("data", "answer"),
    [
        ("01 03 04 00 01 00 02", Answer("OK", (1, 2))),
        ("01 03 00 04 00 01 00 02", Answer("OK", (1, 2))),
        ("01 03 00 04 00 01 00", Answer("BYTE_COUNT")),
        ("01 03 00 05 00 01 00 02", Answer("BYTE_COUNT")),
        ("01 03 01 04 00 01 00 02", Answer("BYTE_COUNT")),
        ("01 03 04 04 00 01 00 02", Answer("LONG")),
    ],
)
def test_a_byte_count_of_two_bytes_where_it_is_tolerated(data: str, answer: Answer) -> None:
    assert parse(Dialect(two_byte_count=True), READ, bytes.fromhex(data)) == answer


def test_the_dialect_of_the_shipped_drives(drives: dict[str, Drive]) -> None:
    assert dialect(drives["SN300G5"]).add == 0x80
    assert dialect(drives["JSCC"]).add == 0x80
    chf = dialect(drives["CHF"])
    assert (chf.add, chf.function, chf.address) == (None, 6, 0x5001)


def reply(message: ModbusPDU) -> bytes:
    """The body that pymodbus sends as unit 1."""
    return b"\x01" + bytes([message.function_code]) + message.encode()


@given(st.lists(Word, min_size=1, max_size=125))
def test_what_pymodbus_answers_to_a_read_comes_back(words: list[int]) -> None:
    answer = parse(STANDARD, Asked(3, 1, 0, len(words)), reply(ReadHoldingRegistersResponse(registers=words)))
    assert answer == Answer("OK", tuple(words))


@given(Word, Word, st.integers(1, 123))
def test_what_pymodbus_answers_to_a_write_is_believed(address: int, value: int, count: int) -> None:
    single = reply(WriteSingleRegisterResponse(address=address, registers=[value]))
    several = reply(WriteMultipleRegistersResponse(address=address, count=count))
    assert parse(STANDARD, Asked(6, 1, address, value=value), single) == Answer("OK")
    assert parse(STANDARD, Asked(16, 1, address, count), several) == Answer("OK")


@given(st.sampled_from([3, 6, 16]), st.integers(1, 255))
def test_what_pymodbus_refuses_is_refused(function: int, code: int) -> None:
    assert parse(STANDARD, Asked(function), reply(ExceptionResponse(function, code))) == Answer("REFUSED", reason=code)


@given(Word, Word, st.data())
def test_no_changed_bit_of_an_echo_goes_unnoticed(address: int, value: int, draw: st.DataObject) -> None:
    asked = Asked(6, 1, address, value=value)
    changed = bytearray(body(asked))
    bit = draw.draw(st.integers(0, 8 * len(changed) - 1))
    changed[bit // 8] ^= 1 << bit % 8
    assert parse(STANDARD, asked, bytes(changed)).result not in ("OK", "REFUSED")


@given(st.binary(max_size=260), st.sampled_from([READ, WRITE, SEVERAL, LOOP]))
def test_only_exact_bytes_are_believed(data: bytes, asked: Asked) -> None:
    """Whatever arrives is judged without an exception, and only what the function defines is OK."""
    if parse(STANDARD, asked, data).result == "OK":
        assert data[:2] == body(asked)[:2]
        assert data[2:3] == b"\x04" if asked is READ else data == body(asked)[:6]
