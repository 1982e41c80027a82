"""Every usual way to write a frame gives the same bytes; what cannot be read is reported with line and column."""

import binascii

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.desk.explain.characters import BLANKS, NOT_SHOWN
from driveblocks.desk.explain.paste import LONGEST, Form, read
from driveblocks.maps.problem import Refused

REPLY = bytes.fromhex("01 03 02 01 F4 B8 53")
ASCII = b":010320000001DB\r\n"


@pytest.mark.parametrize(
    "text",
    [
        "01 03 02 01 F4 B8 53",
        "01030201F4B853",
        "010302 01f4b853",
        "0103 0201 F4B8 53",
        "1 3 2 1 F4 B8 53",
        "01:03:02:01:F4:B8:53",
        ":01:03:02:01:F4:B8:53",
        "01-03-02-01-F4-B8-53",
        "01,03,02,01,F4,B8,53",
        "01; 03; 02; 01; F4; B8; 53;",
        "01，03，02，01，Ｆ４，B8，53",
        "01、03、02、01、F4、B8、53",
        "0x01 0x03 0x02 0x01 0xF4 0xB8 0x53",
        "0X01,0X03,0X02,0X01,0XF4,0XB8,0X53",
        "{0x01, 0x03, 0x02, 0x01, 0xf4, 0xb8, 0x53}",
        "[0x1, 0x3, 0x2, 0x1, 0xf4, 0xb8, 0x53]",
        "0x01030201F4B853",
        r"\x01\x03\x02\x01\xf4\xb8\x53",
        r"b'\x01\x03\x02\x01\xf4\xb8S'",
        r'"\x01\x03\x02\x01\xf4\xb8S"',
        "01h 03h 02h 01h F4h B8h 53h",
        "01H,03H,02H,01H,F4H,B8H,53H",
        "$01 $03 $02 $01 $F4 $B8 $53",
        "&H01 &H03 &H02 &H01 &HF4 &HB8 &H53",
        "16#01 16#03 16#02 16#01 16#F4 16#B8 16#53",
        "BYTE#16#01, BYTE#16#03, BYTE#16#02, BYTE#16#01, BYTE#16#F4, BYTE#16#B8, BYTE#16#53",
        "D10=01 D11=03 D12=02 D13=01 D14=F4 D15=B8 D16=53",
        "0103 0201 F4B8 53--",
        '"01 03 02 01 F4 B8 53"',
        "RX: 01 03 02 01 F4 B8 53",
        "Rx 01 03 02 01 F4 B8 53",
        "RX:01 03 02 01 F4 B8 53",
        "<- 01 03 02 01 F4 B8 53",
        "[RX] 01 03 02 01 F4 B8 53",
        "接收：01 03 02 01 F4 B8 53",
        "12:30:01 RX 01 03 02 01 F4 B8 53",
        "[2024-05-01 12:30:01.123] RX <- 01 03 02 01 F4 B8 53",
        "01 03 02\n01 F4 B8 53\n",
    ],
)
def test_bytes_in_hexadecimal(text: str) -> None:
    paste = read(text)
    assert (paste.data, paste.form) == (REPLY, "hexadecimal")


@pytest.mark.parametrize(
    "text",
    [
        "00000000  01 03 02 01 f4 b8 53                              |......S|\n00000007\n",
        "00000000: 0103 0201 f4b8 53                        ......S",
        "0x0000:  0103 0201 f4b8 53                        ......S",
        "0000   01 03 02 01 f4 b8 53                              ......S",
        "0000000 01 03 02 01 f4 b8 53\n0000007",
        "0010: 01 03 02 01 f4 b8 53",
        "01 03 02 01 F4 B8 53  ......S",
        "01 03 02 01 F4 B8 53\t| ......S".replace("| ", ""),
        "01 03 02 01 F4 B8 53  ......S\n",
    ],
)
def test_hexdumps(text: str) -> None:
    paste = read(text)
    assert (paste.data, paste.form) == (REPLY, "hexdump")


def test_a_column_of_characters_that_looks_like_bytes_is_left_out() -> None:
    text = (
        "00000000  3a 30 31 30 33 32 30 30  30 30 30 30 31 44 42 0d  |:010320000001DB.|\n"
        "00000010  0a                                                |.|\n00000011\n"
    )
    assert read(text).data == ASCII
    text = "0000   30 30 30 31 44 42 0d 0a   0001DB..\n"
    assert read(text).data == b"0001DB\r\n"


@given(st.binary(min_size=1, max_size=100), st.integers(1, 2))
def test_dumps_of_any_bytes_as_xxd_prints_them(data: bytes, group: int) -> None:
    lines = []
    for at in range(0, len(data), 16):
        part = data[at : at + 16]
        column = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in part)
        digits = part.hex()
        grouped = " ".join(digits[place : place + 2 * group] for place in range(0, len(digits), 2 * group))
        lines.append(f"{at:08x}: {grouped:<47}  {column}")
    assert read("\n".join(lines)).data == data


@given(st.binary(min_size=1, max_size=100))
def test_dumps_of_any_bytes_as_hexdump_prints_them(data: bytes) -> None:
    lines = []
    for at in range(0, len(data), 16):
        part = data[at : at + 16]
        column = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in part)
        lines.append(f"{at:08x}  {part[:8].hex(' '):<23}  {part[8:].hex(' '):<23}  |{column}|")
    assert read("\n".join([*lines, f"{len(data):08x}"])).data == data


@given(st.binary(min_size=1, max_size=60))
def test_bytes_printed_by_python(data: bytes) -> None:
    escaped = "".join(f"\\x{byte:02x}" for byte in data)
    assert read(f"b'{escaped}'").data == data
    assert read(repr(data)).data == data
    assert read(binascii.hexlify(data).decode()).data == data


@pytest.mark.parametrize(
    ("text", "data", "notes"),
    [
        (":010320000001DB", ASCII, (NOT_SHOWN,)),
        (":010320000001DB\n", ASCII, (NOT_SHOWN,)),
        (":010320000001DB\r\n", ASCII, (NOT_SHOWN,)),
        (":010320000001DB<CR><LF>", ASCII, ()),
        (":010320000001DB[CR][LF]", ASCII, ()),
        (r":010320000001DB\r\n", ASCII, ()),
        (":010320000001DB CR LF", ASCII, ()),
        (":010320000001DB<0D><0A>", ASCII, ()),
        (":010320000001DB␍␊", ASCII, ()),
        ("':010320000001DB'", ASCII, (NOT_SHOWN,)),
        (r'":010320000001DB\r\n"', ASCII, ()),
        ("：010320000001DB", ASCII, (NOT_SHOWN,)),
        (": 01 03 20 00 00 01 DB", ASCII, (BLANKS, NOT_SHOWN)),
        ("TX: :010320000001DB", ASCII, (NOT_SHOWN,)),
        (":010320000001DB<CR>", b":010320000001DB\r", ()),
        (":010320000001DB<LF>", b":010320000001DB\n", ()),
        (":010320000001db", b":010320000001db\r\n", (NOT_SHOWN,)),
        (":0103200O0001DB", b":0103200O0001DB\r\n", (NOT_SHOWN,)),
        (":010320000001DB:01030201F405", ASCII + b":01030201F405\r\n", (NOT_SHOWN,)),
        (":010320000001DB\n:01030201F405\n", ASCII + b":01030201F405\r\n", (NOT_SHOWN,)),
    ],
)
def test_characters_of_ascii_frames(text: str, data: bytes, notes: tuple[str, ...]) -> None:
    paste = read(text)
    form: Form = "characters"
    assert (paste.data, paste.form, paste.notes) == (data, form, notes)


@pytest.mark.parametrize(
    "text",
    [
        "3A 30 31 30 33 32 30 30 30 30 30 30 31 44 42 0D 0A",
        "3A303130333230303030303031444 20D0A".replace(" ", ""),
        "3A30 3130 3332 3030 3030 3030 3144 420D 0A--",
        "D0=3A30 D1=3130 D2=3332 D3=3030 D4=3030 D5=3030 D6=3144 D7=420D D8=0A--",
    ],
)
def test_ascii_frames_as_bytes(text: str) -> None:
    assert read(text).data == ASCII


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "frame:1:1: there is nothing; paste a frame, such as 01 03 20 00 00 01 8F CA or :010320000001DB"),
        (" \n\t", "frame:1:1: there is nothing; paste a frame, such as 01 03 20 00 00 01 8F CA or :010320000001DB"),
        ("--", "frame:1:1: there are no bytes; write them as 01 03 20 00 00 01 8F CA"),
        ("01 O3 02", "frame:1:4: `O` is no hexadecimal digit; is the digit 0 meant?"),
        ("01 03 0G", "frame:1:8: `G` is no hexadecimal digit; is the digit 6 meant?"),
        ("hello", "frame:1:1: `h` is no hexadecimal digit; bytes are written with 0 to 9 and A to F"),
        ("01 03\nzz", "frame:2:1: `z` is no hexadecimal digit; bytes are written with 0 to 9 and A to F"),
        ("RX: 01 0X", "frame:1:9: `X` is no hexadecimal digit; bytes are written with 0 to 9 and A to F"),
        ("01 \x07", "frame:1:4: `U+0007` is no hexadecimal digit; bytes are written with 0 to 9 and A to F"),
        ("01 03 244", "frame:1:7: `244` has 3 digits; a byte is two hexadecimal digits, and decimal 244 is F4"),
        ("0103020", "frame:1:1: `0103020` has 7 digits; a byte is two hexadecimal digits"),
        ("0x123", "frame:1:3: `123` has 3 digits; a byte is two hexadecimal digits, and decimal 123 is 7B"),
        (r"b'\x0g'", r"frame:1:3: `\x` is no byte of a string; write it as \x and two digits"),
        (
            "00000000: 0103 0201\n00000010: f4b8 53",
            "frame:2:1: this line does not start with the offset 0004; "
            "paste the dump's lines as they were printed, without gaps",
        ),
        ("1" * (LONGEST + 1), f"frame:1:{LONGEST + 1}: this is too long for a frame; paste one frame"),
    ],
)
def test_what_cannot_be_read(text: str, message: str) -> None:
    with pytest.raises(Refused) as caught:
        read(text)
    assert str(caught.value) == message


@given(st.text(max_size=80) | st.text("0123456789ABCDEFxh:, \n<>CRLF\\|.", max_size=80))
def test_any_text_is_read_or_refused_with_its_place(text: str) -> None:
    told, paste = "", None
    try:
        paste = read(text, "-")
    except Refused as error:
        told = str(error)
    assert told.startswith("-:") if paste is None else paste.data


@given(st.binary(min_size=1, max_size=40), st.sampled_from(["", " ", ",", "-", "\n", ", 0x"]))
def test_bytes_with_any_separator(data: bytes, between: str) -> None:
    first = "0x" if "0x" in between else ""
    assert read(first + between.join(f"{byte:02X}" for byte in data)).data == data
