"""PLC registers against the tables of the manuals, typed by hand, and there and back."""

from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps.model import Drive
from driveblocks.reference.packing import pack, unpack


def test_eight_bit_mode_is_that_of_the_manual() -> None:
    assert pack(bytes.fromhex("01 06 10 00 00 01 4C CA"), 8) == [1, 6, 0x10, 0, 0, 1, 0x4C, 0xCA]


def test_sixteen_bit_mode_is_that_of_the_manual() -> None:
    registers = [0x3A30, 0x3130, 0x3631, 0x3030, 0x3030, 0x3030, 0x3145, 0x380D, 0x0A00]
    assert pack(b":010610000001E8\r\n", 16) == registers
    assert unpack(registers, 17, 16) == b":010610000001E8\r\n"


def test_the_high_byte_says_nothing_in_eight_bit_mode() -> None:
    assert unpack([0xFF01, 0x0006], 2, 8) == b"\x01\x06"


@given(st.binary(max_size=513), st.sampled_from([8, 16]))
def test_packing_loses_nothing(data: bytes, bits: int) -> None:
    registers = pack(data, bits)
    assert unpack(registers, len(data), bits) == data
    assert len(registers) == (len(data) if bits == 8 else (len(data) + 1) // 2)


def test_every_table_of_the_maps(drives: dict[str, Drive]) -> None:
    tables = [(frame.correct, frame.plc) for drive in drives.values() for frame in drive.frames if frame.plc]
    assert len(tables) > 8
    for data, table in tables:
        assert pack(data, table.bits) == [int(word.replace("-", "0"), 16) for word in table.registers]
