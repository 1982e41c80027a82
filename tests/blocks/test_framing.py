"""Checksums, framing and packing on every engine, against the reference model and the standard's own limits."""

import random

import pytest
from tests.blocks import wire
from tests.blocks.library import Blocks, built, number, octets, result, words

from driveblocks.reference import framing, packing
from driveblocks.reference.checksum import crc16, lrc
from structured_text.engines.engine import Engine

LENGTHS = (0, 1, 2, 3, 8, 127, 128, 253, 254, 255, 256)


def noise(length: int, seed: int = 7) -> bytes:
    """Random bytes, the same on every run."""
    return random.Random(f"{seed} {length}").randbytes(length)


@pytest.mark.parametrize("block", ["MB_Crc16", "MB_Crc16Compact"])
def test_crc_of_every_length_and_every_byte(engine: Engine, block: str) -> None:
    blocks = built(engine)
    for length in LENGTHS:
        data = noise(length)
        assert blocks.run(block, {"Length": length, "Adu": data})["Crc"] == crc16(data), length
    for byte in range(256):
        assert blocks.run(block, {"Length": 1, "Adu": bytes([byte])})["Crc"] == crc16(bytes([byte])), byte
    data = noise(256)
    for beyond in (257, 65535):
        assert blocks.run(block, {"Length": beyond, "Adu": data})["Crc"] == crc16(data), beyond
    # catalogue of parametrised CRC algorithms: the check value of CRC-16/MODBUS
    assert blocks.run(block, {"Length": 9, "Adu": b"123456789"})["Crc"] == 0x4B37


def test_lrc_of_every_length(engine: Engine) -> None:
    blocks = built(engine)
    for length in LENGTHS:
        data = noise(length)
        assert blocks.run("MB_Lrc", {"Length": length, "Adu": data})["Lrc"] == lrc(data), length
    assert blocks.run("MB_Lrc", {"Length": 257, "Adu": noise(256)})["Lrc"] == lrc(noise(256))
    assert blocks.run("MB_Lrc", {"Length": 256, "Adu": b"\xff" * 256})["Lrc"] == 0


def test_hexadecimal_digits(engine: Engine) -> None:
    blocks = built(engine)
    for value, digit in enumerate(b"0123456789ABCDEF"):
        assert blocks.call("MB_HexDigit", {"Number": value}) == digit
    for character in range(256):
        known = b"0123456789ABCDEF".find(character)
        found = blocks.call("MB_HexValue", {"Character": character})
        assert isinstance(found, int)
        assert found == known if known >= 0 else found > 15, character


@pytest.mark.parametrize("length", LENGTHS)
def test_rtu_and_ascii_frames_of_every_length(engine: Engine, length: int) -> None:
    blocks = built(engine)
    body = noise(length)
    for in_ascii, model in ((False, framing.rtu_seal), (True, framing.ascii_encode)):
        wanted = model(body)
        block, pin = ("MB_AsciiEncode", "CharCount") if in_ascii else ("MB_RtuSeal", "AduLength")
        done = blocks.run(block, {"Length": length, "Adu": body})
        assert result(done) == wanted.result
        assert octets(done, "Chars" if in_ascii else "Adu", number(done, pin)) == wanted.data
        if wanted.result == "OK" and length >= 3:
            assert wire.unframe(blocks, wanted.data, ascii_mode=in_ascii).body == body


def received(blocks: Blocks, data: bytes, *, ascii_mode: bool) -> str:
    """The result of opening, checked against the reference."""
    found = wire.unframe(blocks, data, ascii_mode=ascii_mode)
    wanted = framing.ascii_decode(data) if ascii_mode else framing.rtu_open(data)
    assert (found.result, found.body) == (wanted.result, wanted.data), data
    return found.result


FRAME = framing.ascii_encode(bytes.fromhex("010302 01F4")).data
RTU_RESULTS = [
    (b"", "SILENCE"),
    (b"\x01\x83\x02\xc0", "SHORT"),
    (b"\x01\x83\x02\xc0\xf1", "OK"),
    # the rest after the CRC is 0: only the length of the reply shows that a 00 was received too much
    (bytes.fromhex("01 03 02 01 F4 B8 53 00 00"), "OK"),
    (bytes.fromhex("01 03 02 01 F4 B8 53 00 01"), "CHECKSUM"),
    (framing.rtu_seal(noise(254)).data + b"\x00", "LONG"),
    (bytes.fromhex("01 03 02 01 F4 53 B8"), "CHECKSUM"),
    (bytes.fromhex("01 03 02 01 F4 B8 53"), "OK"),
    (framing.rtu_seal(noise(254)).data, "OK"),
]
ASCII_RESULTS = [
    (b"", "SILENCE"),
    (b":" + b"0" * 513, "LONG"),
    (b"0" + FRAME[1:], "NO_START"),
    (b":0183\r\n", "SHORT"),
    (FRAME[:-2] + b"\n\r", "NO_END"),
    (FRAME[:-2] + b"\r\r", "NO_END"),
    (FRAME[:-2] + b"\n\n", "NO_END"),
    (FRAME[:5] + FRAME[6:], "ODD_DIGITS"),
    (FRAME.replace(b"F", b"f"), "NOT_HEX"),
    (FRAME.replace(b"F", b"G"), "NOT_HEX"),
    (FRAME.replace(b"F", b"/"), "NOT_HEX"),
    (FRAME.replace(b"F", b":"), "NOT_HEX"),
    (FRAME.replace(b"F4", b"F5"), "CHECKSUM"),
    (FRAME, "OK"),
    (framing.ascii_encode(noise(254)).data, "OK"),
]


@pytest.mark.parametrize(("data", "wanted"), RTU_RESULTS)
def test_results_of_opening_rtu(engine: Engine, data: bytes, wanted: str) -> None:
    assert received(built(engine), data, ascii_mode=False) == wanted


@pytest.mark.parametrize(("data", "wanted"), ASCII_RESULTS)
def test_results_of_decoding_ascii(engine: Engine, data: bytes, wanted: str) -> None:
    assert received(built(engine), data, ascii_mode=True) == wanted


@pytest.mark.parametrize("box", ["Adu", "Chars"])
@pytest.mark.parametrize("bits", [8, 16])
def test_packing_of_every_length_and_back(engine: Engine, box: str, bits: int) -> None:
    blocks = built(engine)
    most = {"Adu": 256, "Chars": 513}[box]
    for length in (0, 1, 2, 3, 17, 255, 256, 512, 513, 514, 65535):
        data = noise(min(length, most))
        done = blocks.run(f"MB_Pack{box}{bits}", {"CharCount": length, box: data})
        registers = words(done, "Registers", number(done, "RegisterCount"))
        assert list(registers) == packing.pack(data, bits), length
        back = blocks.run(f"MB_Unpack{box}{bits}", {"CharCount": length, "Registers": list(registers)})
        assert octets(back, box, number(back, "Unpacked")) == data, length


def test_unpacking_8_bits_ignores_the_high_bytes(engine: Engine) -> None:
    done = built(engine).run("MB_UnpackAdu8", {"CharCount": 2, "Registers": [0xFF01, 0x8003]})
    assert octets(done, "Adu", 2) == b"\x01\x03"
