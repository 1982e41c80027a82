"""Programs for RTU and ASCII framing: every length that matters, every bit of a frame changed, every mark missing."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.code import WORDS
from driveblocks.bench.script import Script
from driveblocks.reference.framing import ascii_decode, ascii_encode, rtu_open, rtu_seal

LINE = "MODBUS over Serial Line V1.02"

BODY = bytes.fromhex("01 06 10 00 00 01")
"""A request that is framed: write 1 to 1000H of unit 1."""


def scripts() -> Iterator[Script]:
    yield from (_seal(), _open(), _encode(), _decode())


def _seal() -> Script:
    program = kit.generic("RtuSeal", "RTU framing, outgoing", f"{LINE}, 2.5.1.")
    kit.declare(program, "Adu", Seal="MB_RtuSeal")
    for length in (0, 1, 2, 3, 6, 253, 254, 255, 256, 65535):
        data = kit.sample(length)
        found = rtu_seal(data)
        program.stage(
            f"{length} bytes: {WORDS[found.result]}",
            *kit.fill("Adu", data[: min(length, 8)]),
            *(kit.ramp("Adu", length) if 8 < length <= 254 else ()),
            f"Seal(Length := {length}, Adu := Adu);",
            kit.has_result("Seal", found.result),
            kit.is_number("Seal.AduLength", len(found.data), "bytes of the frame"),
            *kit.same_bytes("Adu", found.data[:8]),
            *kit.last_bytes("Adu", found.data),
        )
    kit.declare_ramp(program)
    return program


def _open() -> Script:
    program = kit.generic("RtuOpen", "RTU framing, incoming", f"{LINE}, 2.5.1.")
    kit.declare(program, "Adu", Open="MB_RtuOpen")
    frame = rtu_seal(BODY).data
    program.defaults += kit.fill("Adu", _padded(frame))
    swapped = frame[:-2] + frame[:-3:-1]
    for words, data, length in (*_received(frame, 256), ("the bytes of the CRC the other way round", swapped, 8)):
        found = rtu_open(data[:length].ljust(length, b"\x00"))
        program.stage(
            f"{words}: {WORDS[found.result]}",
            *kit.changed("Adu", _padded(frame), data[:length]),
            f"Open(AduLength := {length}, Adu := Adu);",
            kit.has_result("Open", found.result),
            kit.is_number("Open.Length", len(found.data), "bytes without checksum"),
        )
    return program


def _padded(frame: bytes) -> bytes:
    """A frame with four more bytes after it, which are there but were not sent."""
    return frame + b"\x00" * 4


def _received(frame: bytes, most: int) -> Iterator[tuple[str, bytes, int]]:
    """A frame as it is, cut short, extended, with each bit changed; words, bytes, and how many are said to be there."""
    yield "as sent", frame, len(frame)
    for length in (*range(len(frame) + 4), most - 1, most, most + 1, 65535):
        yield f"{length} bytes of {len(frame)}", frame, length
    for index, octet in enumerate(frame):
        for bit in range(8):
            changed = frame[:index] + bytes([octet ^ 1 << bit]) + frame[index + 1 :]
            yield f"bit {bit} of byte {index} changed", changed, len(changed)


def _encode() -> Script:
    program = kit.generic("AsciiEncode", "ASCII framing, outgoing", f"{LINE}, 2.5.2.")
    kit.declare(program, "Adu", "Chars", Encode="MB_AsciiEncode")
    kit.declare_ramp(program)
    for length in (0, 1, 2, 3, 6, 16, 253, 254, 255, 256, 65535):
        data = kit.sample(length)
        found = ascii_encode(data)
        program.stage(
            f"{length} bytes: {WORDS[found.result]}",
            *(kit.ramp("Adu", length) if length <= 254 else ()),
            f"Encode(Length := {length}, Adu := Adu, Chars := Chars);",
            kit.has_result("Encode", found.result),
            kit.is_number("Encode.CharCount", len(found.data), "characters of the frame"),
            *kit.same_bytes("Chars", found.data[:40], "characters"),
            *kit.last_bytes("Chars", found.data),
        )
    return program


def _decode() -> Script:
    program = kit.generic("AsciiDecode", "ASCII framing, incoming", f"{LINE}, 2.5.2.")
    kit.declare(program, "Adu", "Chars", Decode="MB_AsciiDecode")
    frame = ascii_encode(BODY).data
    program.defaults += kit.fill("Chars", _padded(frame))
    garbled = ((words, data, len(data)) for words, data in _garbled(frame))
    for words, data, length in (*_received(frame, 513), *garbled):
        found = ascii_decode(data[:length].ljust(length, b"\x00"))
        program.stage(
            f"{words}: {WORDS[found.result]}",
            *kit.changed("Chars", _padded(frame), data[:length]),
            f"Decode(CharCount := {length}, Chars := Chars, Adu := Adu);",
            kit.has_result("Decode", found.result),
            kit.is_number("Decode.Length", len(found.data), "bytes without checksum"),
            *kit.same_bytes("Adu", found.data),
        )
    return program


def _garbled(frame: bytes) -> Iterator[tuple[str, bytes]]:
    yield "lower case", frame.replace(b"8", b"e").lower()
    yield "lower case, otherwise right", ascii_encode(b"\x01\x83\xab\xcd").data.lower()
    yield "upper case", ascii_encode(b"\x01\x83\xab\xcd").data
    yield "every digit as the second of two", ascii_encode(bytes(range(16))).data
    yield "every digit as the first of two", ascii_encode(bytes(range(0, 256, 16))).data
    yield "LF CR instead of CR LF", frame[:-2] + b"\n\r"
    yield "without CR", frame[:-2] + b"\n"
    yield "one digit too few", frame[:-3] + b"\r\n"
    yield "one digit too few, and no CR LF", frame[:-3] + b"00"
    yield "a blank among the digits", frame[:5] + b" " + frame[6:]
    yield "no colon, and much too short", b"01"
    yield "a colon alone", b":"
    yield "the shortest frame", ascii_encode(b"\x01\x83\x02").data
    yield "one byte less than the shortest", ascii_encode(b"\x01\x83").data
    for index in (1, 2, len(frame) - 4, len(frame) - 3):
        for character in b"/:@G`g":
            yield f"character {index} is {character:02X}H", frame[:index] + bytes([character]) + frame[index + 1 :]
