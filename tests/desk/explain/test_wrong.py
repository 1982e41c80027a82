"""Wrong frames: what is reported of each, and what it might be instead. Frames are typed; checksums are as printed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.desk.explain.explaining import Explain, rtu

from driveblocks.modbus.frame import seal
from driveblocks.reference.checksum import crc16, crc_bytes, lrc

READ = "01 03 20 00 00 01 8F CA"
REPLY = "01 03 02 01 F4 B8 53"
BODY = bytes.fromhex("01 03 20 00 00 01")


def inverted(frame: str) -> str:
    """All bits of a frame inverted."""
    return bytes(byte ^ 0xFF for byte in bytes.fromhex(frame)).hex(" ")


@pytest.mark.parametrize(
    ("frame", "perhaps", "meant"),
    [
        ("01 03 20 00 00 01 CA 8F", "the CRC bytes are swapped", READ),
        ("03 01 00 20 01 00 CA 8F", "the two bytes of each pair are swapped", READ),
        ("0000000 0301 0102 b8f4 0053\n0000007", "the two bytes of each pair are swapped", REPLY + " 00"),
        ("303A 3031 3233 3030 3030 3030 4431 0D42 000A", "the two bytes of each pair are swapped", ":010320000001DB"),
        ("01 00 03 00 20 00 00 00 00 00 01 00 8F 00 CA 00", "one byte in each (8-bit mode)", READ),
        ("0001 0003 0020 0000 0000 0001 008F 00CA", "one byte in each (8-bit mode)", READ),
        ("01 03 20 00 00 01 DB", "this is ASCII: the last byte is the LRC", ":010320000001DB"),
        (b"010320000001DB\r\n".hex(), "an ASCII frame without its colon", ":010320000001DB"),
        (
            bytes(c | 0x80 * (c % 2) for c in b":010320000001DB\r\n").hex(),
            "parity in the highest bit",
            ":010320000001DB",
        ),
        ("00 01 00 00 00 06 01 03 20 00 00 01", "this is Modbus TCP", READ),
        (
            f"{BODY.hex()}{crc16(BODY, 0):04x}",
            "a CRC-16 that starts with 0000H instead of FFFFH, high byte first",
            READ,
        ),
        (f"{BODY.hex()}{crc16(BODY, 0).to_bytes(2, 'little').hex()}", "a CRC-16 that starts with 0000H", READ),
        (f"{BODY.hex()}{sum(BODY):04x}", "the sum of the bytes, high byte first", READ),
        (f"{BODY.hex()}{crc_bytes(BODY[1:]).hex()}", "the CRC leaves out the unit address", READ),
        ("01 03 04 00 00 00 00 43 07", "two-byte count, 01 03 00 04 00 00 00 00", "01 03 04 00 00 00 00 FA 33"),
        ("01 03 00 20 00 01 8F CA", "from byte 3 on are in the wrong order", READ),
        ("01 03 02 F4 01 B8 53", "from byte 4 on are in the wrong order", REPLY),
        (inverted(READ), "lines A and B are exchanged", READ),
        ("10 30 02 00 00 10 F8 AC", "the two digits of each byte are swapped", READ),
        ("03 01 20 00 00 01 8F CA", "bytes 1 and 2 are exchanged", READ),
        ("01 03 20 00 00 05 8F CA", "one bit is wrong: byte 6 is 05 and would be 01", READ),
        ("02 06 10 00 00 01 4C CA", "one byte is wrong: byte 1 is 02 and would be 01", "01 06 10 00 00 01 4C CA"),
        ("03 20 00 00 01 8F CA", "the first byte is missing: with unit 1", READ),
        ("01 03 20 00 00 01 8F", "the last byte is missing: it is the second of the CRC", READ),
        ("01 03 20 00 00 01", "the checksum is missing: CRC 8F CA belongs after it", READ),
        (":010320000001", "the checksum is missing: LRC DB belongs after it", ":010320000001DB"),
        (":010320000001BD", "the LRC with its two digits swapped", ":010320000001DB"),
        (":01032000000125", "the sum of the bytes", ":010320000001DB"),
        (":010320000001DA", "the inverted sum", ":010320000001DB"),
        (":01032000000123", "the exclusive OR of the bytes", ":010320000001DB"),
        (
            f":010320000001{lrc(b'010320000001'):02X}",
            "computed over the characters instead of the bytes",
            ":010320000001DB",
        ),
        (f":010320000001{lrc(b':010320000001'):02X}", "over the characters and the colon", ":010320000001DB"),
        (":0103200000018FCA", "the checksum is the CRC of an RTU frame", ":010320000001DB"),
        (":01032OO0OOO1DB", "with digits instead of the letters", ":010320000001DB"),
    ],
)
def test_what_it_might_be_instead(explain: Explain, frame: str, perhaps: str, meant: str) -> None:
    made = explain("CHF", frame)
    assert not made.good
    assert perhaps in " | ".join(one for wrong in made.wrongs for one in wrong.instead)
    assert made.meant is not None
    assert made.meant.frame == (f"{meant}\r\n".encode() if meant.startswith(":") else bytes.fromhex(meant))
    assert made.readings


@pytest.mark.parametrize(
    ("frame", "perhaps"),
    [
        ("01", "the frame is cut off: unit, function and checksum are the least"),
        ("01 03 04 02 4D", "truncated: 4 bytes missing; of function 03H a reply has 9 bytes"),
        ("01 06 20 00 D8", "truncated: 3 bytes missing; of function 06H request and reply have 8 bytes"),
        ("01 10 00 00 00 02 04 00", "truncated: 5 bytes missing; of function 10H a request has 13 bytes"),
        (":0106100000", "truncated: 2 bytes missing; of function 06H request and reply have 7 bytes"),
        ("01 03 20 00 00 01 12 34", "noise, a wrong bit rate or parity, or a typing error"),
        ("81 63 27 42 55 01 12 34 99 F1", "noise, a wrong bit rate or parity, or a typing error"),
    ],
)
def test_what_no_checksum_proves(explain: Explain, frame: str, perhaps: str) -> None:
    made = explain("", frame)
    assert not made.good
    assert perhaps in " | ".join(one for wrong in made.wrongs for one in wrong.instead)


@pytest.mark.parametrize(
    ("frame", "wrongs"),
    [
        (":010320000001DB<CR>", ["the frame ends with CR, not with CR LF (0D 0A)"]),
        (":010320000001DB<LF><CR>", ["the frame ends with LF CR, not with CR LF (0D 0A)"]),
        (b":010320000001DB".hex(), ["the frame ends with neither CR nor LF, not with CR LF (0D 0A)"]),
        (":010320000001db", ["hexadecimal digits are in lower case"]),
        (":01032000001DB", ["13 digits are an odd number"]),
        (
            ":01032000GG01DB",
            ["character 10, `G`, is no hexadecimal digit", "character 11, `G`, is no hexadecimal digit"],
        ),
        (":010320000001DC", ["the LRC does not fit: the frame has DC, and DB would be right"]),
        ("01 03 20 00 00 01 CA 8F", ["the CRC does not fit: the frame has CA 8F, and 8F CA would be right"]),
        (REPLY + " 00", ["1 byte too many after the frame: 00"]),
        (REPLY + " 00 00", ["2 bytes too many after the frame: 00 00"]),
        (READ + " AA 55", ["2 bytes too many after the frame: AA 55"]),
        ("FF " + READ, ["1 byte too many before the frame: FF"]),
        ("FF " + READ + " FF", ["bytes before and after the frame, which is 01 03 20 00 00 01 8F CA"]),
        (READ + READ, ["2 frames glued together: bytes 1 to 8 and 9 to 16"]),
        (READ + REPLY, ["the request comes before the reply: bytes 1 to 8"]),
        (":010320000001DB:01030201F405", ["the request comes before the reply: bytes 1 to 17"]),
        (":010320000001DB:010320000001DB", ["2 frames glued together: bytes 1 to 17 and 18 to 34"]),
        (rtu("01 03 00 02 01 F4"), ["the byte count is a word: two-byte count"]),
        (rtu("01 10 10 00 00 02 02 00 01"), ["the byte count 2 does not fit: a quantity of 2 needs 4"]),
        (rtu("01 10 10 00 00 01 03 00 01 02"), ["the byte count 3 does not fit: a quantity of 1 needs 2"]),
        (rtu("01 06 10 00 00 01 00 07"), ["function 06H has 6 bytes and the checksum; 2 bytes too many"]),
        (rtu("01 06 10 00 00"), ["function 06H has 6 bytes and the checksum, 1 more than these"]),
        (rtu("F8 03 20 00 00 01"), ["unit 248 is out of range: 1 to 247"]),
        (rtu("00 03 20 00 00 01"), ["unit 0 is a broadcast, and function 03H cannot be broadcast"]),
        (rtu("00 06 10 00 00 03"), ["unit 0 is a broadcast, and the map knows of none"]),
        (rtu("00 03 02 01 F4"), ["unit 0 is the broadcast address, and nobody answers a broadcast"]),
        (rtu("01 05 00 00 FF 00"), ["JSCC does not know function 05H; it knows 03H, 06H, 10H"]),
        (rtu("01 03 20 00 00 00"), ["quantity 0 is out of range: 1 to 12"]),
        (rtu("01 03 20 00 01 00"), ["quantity 256 is out of range: 1 to 12"]),
        (rtu("01 03 20 04 00 01"), ["2004H may not be read: the map does not list it as such"]),
        (rtu("01 03 10 00 00 01"), ["1000H may not be read"]),
        (rtu("01 06 20 00 00 01"), ["2000H may not be written"]),
        (rtu("01 10 FF FF 00 02 04 00 00 00 00"), ["the registers run past FFFFH"]),
        (rtu("01 03 1A" + " 00" * 26), ["13 registers are more than JSCC sends at once: 12"]),
        ("11" * 300, ["300 bytes are too long for a frame: it has 256 at most"]),
    ],
)
def test_what_is_wrong(explain: Explain, frame: str, wrongs: list[str]) -> None:
    made = explain("JSCC", frame)
    assert not made.good
    told = [wrong.what for wrong in made.all_wrongs]
    assert all(any(wrong in one for one in told) for wrong in wrongs), told


@pytest.mark.parametrize(
    ("frame", "perhaps"),
    [
        (rtu("01 03 20 00 01 00"), "1, if its bytes are swapped"),
        (rtu("01 03 07 D0 00 01"), "2000H Output frequency, if 2000 was meant as hexadecimal"),
        (rtu("01 03 20 02 00 01"), "2001H Drive status, if it was counted from 1"),
        (rtu("01 06 00 10 20 00"), ""),
        (rtu("01 03 10 00 00 01"), "it may only be written"),
        (rtu("01 06 20 00 00 01"), "it may only be read"),
    ],
)
def test_what_was_probably_meant(explain: Explain, frame: str, perhaps: str) -> None:
    made = explain("JSCC", frame)
    told = [one for wrong in made.all_wrongs for one in wrong.instead]
    assert told == ([perhaps] if perhaps else [])


def test_swapped_bytes_of_an_address(explain: Explain) -> None:
    (wrong,) = explain("SN300G5", rtu("01 03 26 00 00 02")).all_wrongs
    assert wrong.what == "2600H-2601H may not be read: the map does not list it as such"
    assert wrong.instead == ("0026H DC bus voltage, if its bytes are swapped",)


def test_a_drive_without_ascii(explain: Explain) -> None:
    (wrong,) = explain("SN300G5", ":010300260002D4").all_wrongs
    assert wrong.what == "this is ASCII, and SN300G5 speaks RTU only"


@given(st.binary(min_size=2, max_size=20), st.data())
def test_no_frame_with_a_changed_bit_is_good(explain: Explain, body: bytes, draw: st.DataObject) -> None:
    frame = bytearray(seal("rtu", body))
    bit = draw.draw(st.integers(0, 8 * len(frame) - 1))
    frame[bit // 8] ^= 1 << bit % 8
    assert not explain("", frame.hex()).good


@given(st.binary(min_size=1, max_size=300), st.sampled_from(["", "JSCC", "CHF", "SN300G5", "EX100"]))
def test_any_bytes_are_explained(explain: Explain, data: bytes, prefix: str) -> None:
    made = explain(prefix, data.hex())
    assert made.good or made.all_wrongs


@given(st.text("0123456789ABCDEFg", max_size=60), st.sampled_from(["", "JSCC", "SN300G5"]))
def test_any_characters_are_explained(explain: Explain, characters: str, prefix: str) -> None:
    made = explain(prefix, f":{characters}00")
    assert made.good or made.all_wrongs


def test_of_very_many_frames_the_first_are_explained(explain: Explain) -> None:
    made = explain("", READ * 1000)
    assert len(made.inside) == 16
    assert made.notes == ("984 more frames follow; paste them separately.",)
