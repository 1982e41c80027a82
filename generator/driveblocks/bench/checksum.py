"""Programs for the checksums and the hexadecimal digits."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.script import Item, Script
from driveblocks.reference.checksum import crc16, lrc
from structured_text.language.writing import byte, word

LINE = "MODBUS over Serial Line V1.02"


def scripts() -> Iterator[Script]:
    yield _checksums()
    yield _digits()


def _entries(first: int) -> bytes:
    """256 bytes that look up 128 entries of both tables of a CRC that takes two bytes at a time."""
    data, crc = b"", 0xFFFF
    for entry in range(first, first + 128):
        pair = bytes([(crc ^ entry) & 0xFF, (crc >> 8) ^ entry])
        data += pair
        crc = crc16(pair, crc)
    return data


def _checksums() -> Script:
    program = kit.generic("Checksums", "both CRCs and the LRC", f"{LINE}, 6.2.1 and 6.2.2.")
    kit.declare(program, "Adu", Crc16="MB_Crc16", Compact="MB_Crc16Compact", Lrc="MB_Lrc")
    program.stage(
        "02H 07H has the CRC 1241H, in the order of the wire 41H 12H",
        *kit.fill("Adu", b"\x02\x07"),
        *_summed(2),
        kit.is_word("Crc16.Crc", word(0x1241), "CRC by table"),
        kit.is_word("Compact.Crc", word(0x1241), "CRC without table"),
        source=f"{LINE}, 6.2.2, example",
    )
    samples = {
        "entries 00H to 7FH of both tables": _entries(0),
        "entries 80H to FFH of both tables": _entries(128),
        "00H to FFH": bytes(range(256)),
        "256 times FFH": b"\xff" * 256,
    }
    for words, data in samples.items():
        statements = kit.fill("Adu", data)
        for end in (128, 256):
            program.stage(f"{words}: {end} bytes", *statements[end - 128 : end], *_checked(data[:end]))
    for length in (0, 1, 2, 3, 255, 256, 257, 65535):
        program.stage(f"{length} bytes FFH, at most 256", *_checked(data[:length], length))
    return program


def _summed(length: int) -> list[str]:
    return [f"{block}(Length := {length}, Adu := Adu);" for block in ("Crc16", "Compact", "Lrc")]


def _checked(data: bytes, length: int | None = None) -> Iterator[Item]:
    yield from _summed(len(data) if length is None else length)
    yield kit.is_word("Crc16.Crc", word(crc16(data)), "CRC by table")
    yield kit.is_word("Compact.Crc", word(crc16(data)), "CRC without table")
    yield kit.is_word("BYTE_TO_WORD(Lrc.Lrc)", word(lrc(data)), "LRC")


def _digits() -> Script:
    program = kit.generic("Digits", "hexadecimal digits", f"{LINE}, 2.5.2.")
    numbers = [*range(16), 16, 31, 255, 65535]
    probes = [
        kit.is_word(
            f"BYTE_TO_WORD(MB_HexDigit(Number := {number}))", word(b"0123456789ABCDEF"[number % 16]), f"{number}"
        )
        for number in numbers
    ]
    program.stage("numbers as digits", *probes)
    codes = [*range(0x2E, 0x48), 0x00, 0x0A, 0x0D, 0x20, *range(0x5F, 0x69), 0x7F, 0xB0, 0xFF]
    probes = [kit.is_number(f"MB_HexValue(Character := {byte(code)})", _value(code), f"{code:02X}H") for code in codes]
    program.stage("digits as numbers, 255 for what is none", *probes)
    return program


def _value(code: int) -> int:
    return b"0123456789ABCDEF".find(bytes([code])) if code in b"0123456789ABCDEF" else 255
