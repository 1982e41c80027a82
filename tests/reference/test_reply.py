"""Replies: each way of being wrong, each form of refusal, the manuals' replies, and pymodbus as the drive."""

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
from driveblocks.reference.framing import ascii_decode, rtu_open
from driveblocks.reference.reply import Answer, Dialect, dialect, parse
from driveblocks.reference.request import Asked, body

STANDARD = Dialect()
WRITE_REPLY = Dialect(add=None, function=6, address=0x5001)
READ = Asked(3, 1, 0x2000, 2)
WRITE = Asked(6, 1, 0x1000, value=3)
SEVERAL = Asked(16, 1, 0x0001, 2, words=(7, 8))
LOOP = Asked(8, 1, value=0x12AB)
Word = st.integers(0, 0xFFFF)


@pytest.mark.parametrize(
    ("asked", "data", "answer"),
    [
        (None, "01 03 04 00 01 00 02", Answer("NO_REQUEST")),
        (Asked(0), "01 03 04 00 01 00 02", Answer("NO_REQUEST")),
        (Asked(3, 1, 0x2000, 0), "01 03 00", Answer("NO_REQUEST")),
        (Asked(6, 1, 0x1000, 0, value=3), "01 06 10 00 00 03", Answer("NO_REQUEST")),
        (Asked(16, 1, 0x0001, 126), "01 10 00 01 00 7E", Answer("NO_REQUEST")),
        (Asked(6, 0, 0x1000, value=3), "00 06 10 00 00 03", Answer("BROADCAST")),
        (READ, "01 03", Answer("SHORT")),
        (READ, "", Answer("SHORT")),
        (READ, "01 03 04" + " 00" * 252, Answer("LONG")),
        (READ, "02 03 04 00 01 00 02", Answer("OTHER_UNIT")),
        (READ, "01 83 02", Answer("REFUSED", reason=2)),
        (READ, "01 83 02 00", Answer("LONG")),
        (READ, "01 86 02", Answer("OTHER_FUNCTION")),
        (READ, "01 04 04 00 01 00 02", Answer("OTHER_FUNCTION")),
        (READ, "01 03 02 00 01", Answer("BYTE_COUNT")),
        (READ, "01 03 06 00 01 00 02", Answer("BYTE_COUNT")),
        (READ, "01 03 04 00 01 00", Answer("SHORT")),
        (READ, "01 03 04", Answer("SHORT")),
        (READ, "01 03 04 00 01 00 02 00", Answer("LONG")),
        (READ, "01 03 04 12 34 FF FE", Answer("OK", (0x1234, 0xFFFE))),
        (READ, "01 03 00 04 12 34 FF FE", Answer("BYTE_COUNT")),
        (WRITE, "01 06 10 00 00", Answer("SHORT")),
        (WRITE, "01 06 10 00 00 03 00", Answer("LONG")),
        (WRITE, "01 06 10 01 00 03", Answer("OTHER_ADDRESS")),
        (WRITE, "01 06 10 00 00 04", Answer("OTHER_VALUE")),
        (WRITE, "01 06 10 01 00 04", Answer("OTHER_ADDRESS")),
        (WRITE, "01 06 10 00 00 03", Answer("OK")),
        (WRITE, "01 06 50 01 00 05", Answer("OTHER_ADDRESS")),
        (SEVERAL, "01 10 00 02 00 02", Answer("OTHER_ADDRESS")),
        (SEVERAL, "01 10 00 01 00 01", Answer("OTHER_QUANTITY")),
        (SEVERAL, "01 10 00 01 00 02", Answer("OK")),
        (SEVERAL, "01 90 21", Answer("REFUSED", reason=0x21)),
        (LOOP, "01 08 00 01 12 AB", Answer("OTHER_SUB_FUNCTION")),
        (LOOP, "01 08 00 00 12 AA", Answer("OTHER_VALUE")),
        (LOOP, "01 08 00 00 12 AB", Answer("OK")),
        (Asked(7), "01 07 00 00 12 AB", Answer("OTHER_FUNCTION")),
    ],
)
def test_a_reply_by_the_standard(asked: Asked | None, data: str, answer: Answer) -> None:
    assert parse(STANDARD, asked, bytes.fromhex(data)) == answer


@pytest.mark.parametrize(
    ("asked", "data", "answer"),
    [
        (READ, "01 06 50 01 00 05", Answer("REFUSED", reason=5)),
        (WRITE, "01 06 50 01 01 00", Answer("REFUSED", reason=0x100)),
        (READ, "02 06 50 01 00 05", Answer("OTHER_UNIT")),
        (READ, "01 06 50 01 00 05 00", Answer("OTHER_FUNCTION")),
        (WRITE, "01 06 50 01 00 05 00", Answer("LONG")),
        (READ, "01 06 50 00 00 05", Answer("OTHER_FUNCTION")),
        (READ, "01 83 02", Answer("OTHER_FUNCTION")),
        # whoever writes 5001H gets the echo of that write
        (Asked(6, 1, 0x5001, value=5), "01 06 50 01 00 05", Answer("OK")),
        (Asked(6, 1, 0x5001, value=5), "01 06 50 01 00 06", Answer("OTHER_VALUE")),
    ],
)
def test_a_refusal_in_the_form_of_a_write(asked: Asked, data: str, answer: Answer) -> None:
    assert parse(WRITE_REPLY, asked, bytes.fromhex(data)) == answer


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


def test_every_example_reply_is_believed(drives: dict[str, Drive]) -> None:
    read = 0
    for drive in drives.values():
        requests = {frame.id: frame.means for frame in drive.frames}
        for frame in (one for one in drive.frames if one.direction == "reply"):
            said = requests.get(frame.answers or "")
            asked = Asked(3, frame.means.unit)
            if said is not None:
                value = said.data if said.data is not None else (*said.values, 0)[0]
                asked = Asked(said.function, said.unit, said.address or 0, said.words or 1, value)
            opened = (ascii_decode if frame.mode == "ascii" else rtu_open)(frame.correct)
            answer = parse(dialect(drive), asked, opened.data)
            if frame.means.error is not None:
                assert answer == Answer("REFUSED", reason=frame.means.error), frame.id
            else:
                assert answer.result == "OK", frame.id
                assert answer.words == (frame.means.values if asked.function == 3 else ()), frame.id
            read += 1
    assert read >= 12


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
