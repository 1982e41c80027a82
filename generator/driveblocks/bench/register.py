"""Programs for decoders and scales: each bit alone, all, none, each value, and words that mean nothing."""

import random
from collections.abc import Iterator

from driveblocks.bench import kit
from driveblocks.bench.naming import register_block, scale_block
from driveblocks.bench.script import Probe, Script
from driveblocks.bench.table import Table
from driveblocks.maps.form import address_name, address_text
from driveblocks.maps.model import Drive, Register, Section
from driveblocks.reference.register import decode, engineering
from structured_text.language.writing import word

PER_WORD = 32
"""Outputs that one check compares, as bits of a DWORD."""

RANDOM = 6
"""Random words per register, the same in every run."""

LONG = (65536, 65537, 100000, 0x12345678, 0xFFFF, 16777215, 16777216, 16777217, 0x7FFFFFFF, 0x80000000, 0xFFFFFF00, -1)
"""Of 32 bits, those beyond the 24 of a REAL, too."""
RAW = (0, 1, 2, 3, 10, 99, 100, 500, 1000, 4095, 5000, 9999, 10000, 12345, 32767, 32768, 32769, 55536, 65534, 65535)


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program per register with bits or values, and one for all scales."""
    for section, row in drive.registers():
        if decode(row, 0):
            yield _decoder(drive, stem, section, row)
    rows = [(section, row) for section, row in drive.registers() if row.scale is not None]
    scales = kit.script(drive, stem, "Scales", "engineering values of registers")
    for section, row in rows:
        _scale(scales, drive, section, row)
    yield scales


# ---------------------------------------------------------------- bits, fields and values


def _decoder(drive: Drive, stem: str, section: Section, row: Register) -> Script:
    address, source = address_text(row.address.first), row.source or section.source
    title = f"register {address}, {row.name}, taken apart"
    read = drive.is_read(row)
    program = kit.script(drive, stem, f"{address_name(row.address.first)}{'' if read else 'Written'}", title, source)
    kit.declare(program, Decode=register_block(drive, row))
    outputs = decode(row, 0)
    flags = [name for name, value in outputs.items() if isinstance(value, bool)]
    numbers = [name for name, value in outputs.items() if not isinstance(value, bool)]
    table = _table(program, [flags[at : at + PER_WORD] for at in range(0, len(flags), PER_WORD)], numbers)
    for number in _words(row):
        found = decode(row, number)
        wanted = {f"Flags{at}": _packed(found, flags[at : at + PER_WORD]) for at in range(0, len(flags), PER_WORD)}
        wanted |= {f"Number{index}": found[name] for index, name in enumerate(numbers)}
        said = [name for name in flags if found[name]] + [f"{name} {found[name]}" for name in numbers]
        table.row(f"{number:04X}H: {', '.join(said) or 'nothing'}", {"Raw": number} | wanted)
    return program


def _packed(found: dict[str, bool | int], names: list[str]) -> int:
    return sum(1 << place for place, name in enumerate(names) if found[name])


def _table(program: Script, groups: list[list[str]], numbers: list[str]) -> Table:
    table = Table(program)
    table.column("Raw", "WORD", 0, "the register")
    table.do("Decode(Value := Raw);")
    for index, names in enumerate(groups):
        wanted = f"Flags{index * PER_WORD}"
        table.column(wanted, "DWORD", 0, f"outputs that must be TRUE, {names[0]} in bit 0")
        program.variables[f"Seen{index * PER_WORD}"] = ("DWORD", "outputs that are TRUE")
        table.do(*_collected(f"Seen{index * PER_WORD}", names))
        pins = f"Expected := {wanted}, Actual := Seen{index * PER_WORD}"
        table.do(Probe("Bytes", pins, f"outputs {names[0]} to {names[-1]}", names=tuple(names)))
    for index, name in enumerate(numbers):
        table.column(f"Number{index}", "UINT", 0, f"what {name} must be")
        table.do(kit.is_number(f"Decode.{name}", f"Number{index}", name))
    return table


def _collected(variable: str, names: list[str]) -> Iterator[str]:
    """Statements that put outputs into the bits of a DWORD."""
    yield f"{variable} := DWORD#16#00000000;"
    for place, name in enumerate(names):
        yield f"IF Decode.{name} THEN {variable} := {variable} OR DWORD#16#{1 << place:08X}; END_IF;"


def _words(row: Register) -> list[int]:
    """Words to try, in a fixed order without repetition."""
    words = [0, *(1 << bit for bit in range(16)), 0xFFFF, *(0xFFFF ^ 1 << bit for bit in range(16))]
    for bit in row.bits:
        if len(bit.bit) > 1 and not bit.unused:
            words += [number << bit.bit.first for number in range(min(1 << len(bit.bit), 32))]
    for value in row.values:
        words += [value.value, value.value + 1, value.value - 1, value.value | 0x8000, value.value + 0x100]
    source = random.Random(row.address.first)  # noqa: S311  (test words, no secrets)
    words += [source.getrandbits(16) for _ in range(RANDOM)]
    return list(dict.fromkeys(each & 0xFFFF for each in words))


# ---------------------------------------------------------------- scales


def _scale(program: Script, drive: Drive, section: Section, row: Register) -> None:
    assert row.scale is not None  # noqa: S101  (asked before)
    extra = (row.range.min, row.range.max) if row.range else ()
    probes = []
    mask = 0xFFFF if row.words is None else 0xFFFFFFFF
    for raw in dict.fromkeys(raw & mask for raw in (*RAW, *(LONG if row.words else ()), *extra)):
        pins = f"High := {word(raw >> 16)}, Low := {word(raw & 0xFFFF)}" if row.words else f"Raw := {word(raw)}"
        call = f"{scale_block(drive, row)}({pins})"
        value = engineering(row, raw)
        probes.append(kit.is_real(call, value, f"{raw:04X}H is {value:.9g} {row.unit or ''}".rstrip()))
    words = (
        f"{address_text(row.address.first)}, {row.name}, {row.scale.factor} {row.unit or ''}".rstrip() + " per count"
    )
    program.stage(words, *probes, source=f"{row.source or section.source}; {row.scale.source}")
