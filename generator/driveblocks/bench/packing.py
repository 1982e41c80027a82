"""Programs for packing: frames into the registers of a PLC and back, both modes, every length that matters."""

from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.script import Item, Script
from driveblocks.reference.packing import pack, unpack
from structured_text.language.writing import word

BOXES = {"Adu": 256, "Chars": 513}
"""The arrays and how many bytes they hold."""

STALE = 0xDEAD
"""What is in registers that are not written."""


def scripts() -> Iterator[Script]:
    for box, most in BOXES.items():
        yield _packing(box, most)


def _packing(box: str, most: int) -> Script:
    source = "JSCC instructions, section 6, tables D0 to D8: one byte or two characters per register."
    program = kit.generic(f"Packing{box}", f"{box} into registers and back, 8 and 16 bits", source)
    kit.declare(program, box, "Registers")
    kit.declare_ramp(program)
    for bits in (8, 16):
        block, back = f"Pack{box}{bits}", f"Unpack{box}{bits}"
        kit.declare(program, **{block: f"MB_{block}", back: f"MB_{back}"})
        for count in (0, 1, 2, 3, 17, most - 1, most, most + 1, 65535):
            data = kit.sample(min(count, most))
            program.stage(f"{count} characters into registers of {bits} bits", *_packed(box, bits, count, data))
            noise = ", high bytes not 00H" if bits == 8 else ""
            words = f"{count} characters out of registers of {bits} bits{noise}"
            program.stage(words, *_unpacked(box, bits, count, data))
    return program


def _packed(box: str, bits: int, count: int, data: bytes) -> Iterator[Item]:
    """Pack; the registers are compared at both ends."""
    registers = pack(data, bits)
    ends = sorted({*range(min(4, len(registers))), *range(max(len(registers) - 3, 0), len(registers))})
    yield from kit.ramp(box, len(data))
    yield from kit.fill_words("Registers", [STALE] * 3)
    yield f"Pack{box}{bits}(CharCount := {count}, {box} := {box}, Registers := Registers);"
    yield kit.is_number(f"Pack{box}{bits}.RegisterCount", len(registers), "registers")
    for index in ends:
        yield kit.is_word(f"Registers[{index}]", word(registers[index]), f"register {index}")
    if len(registers) < 3:
        yield kit.is_word("Registers[2]", word(STALE), "register after it")


def _unpacked(box: str, bits: int, count: int, data: bytes) -> Iterator[Item]:
    """Unpack what was packed before; in 8-bit mode with something in the high bytes, which says nothing."""
    registers = [register | (0x5500 if bits == 8 else 0) for register in pack(data, bits)]
    yield from kit.fill_words("Registers", registers[:4])
    yield from kit.cleared(box, len(data))
    yield f"Unpack{box}{bits}(CharCount := {count}, Registers := Registers, {box} := {box});"
    yield kit.is_number(f"Unpack{box}{bits}.Unpacked", len(data), "characters")
    again = unpack(registers, len(data), bits)
    yield from kit.same_bytes(box, again[:8])
    yield from kit.last_bytes(box, again)
