"""Programs for the texts of faults, errors, bits, values and results, in each language that was built."""

from collections.abc import Iterable, Iterator
from typing import Protocol

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import Probe, Script
from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Drive, Register
from driveblocks.reference import text as reference
from structured_text.language.writing import string, word


class Language(Protocol):
    """A language of texts: En or Zh as the last part of names, and the encoding of its bytes."""

    @property
    def suffix(self) -> str:
        """En or Zh."""

    @property
    def encoding(self) -> str:
        """A codec of Python."""


LAST = 0xFFFF
"""The last holding register; those of other tables have no texts by address."""


def scripts(drive: Drive, stem: str, languages: Iterable[Language]) -> Iterator[Script]:
    faults = sorted({fault.code for fault in drive.faults.codes})
    numbers = {reference.error_number(error) for error in drive.errors.codes}
    rows = [row for _, row in drive.registers() if row.address.first <= LAST and drive.is_read(row)]
    bits = [bit for row in rows for bit in row.bits if bit.name]
    values = [value for row in rows for value in row.values]
    for language in languages:
        if reference.has(drive, language.suffix, drive.faults.codes):
            yield _codes(drive, stem, language, "Fault", faults)
        if drive.warnings and reference.has(drive, language.suffix, drive.warnings.codes):
            yield _codes(drive, stem, language, "Warning", sorted(one.code for one in drive.warnings.codes))
        if reference.has(drive, language.suffix, drive.errors.codes):
            yield _codes(drive, stem, language, "Error", sorted(number for number in numbers if number is not None))
        if bits and reference.has(drive, language.suffix, bits):
            yield _places(drive, stem, language, "Bit")
        if values and reference.has(drive, language.suffix, values):
            yield _places(drive, stem, language, "Value")


def results(languages: Iterable[Language]) -> Iterator[Script]:
    """Programs for the texts of result codes: each code has one."""
    for language in languages:
        title = "every result code has a text"
        program = kit.generic(f"ResultText{language.suffix}", title, "the result codes of DriveBlocks.")
        program.variables["Found"] = ("STRING", "the text")
        for name, number in NUMBERS.items():
            unknown = string(_bytes(reference.UNKNOWN, language))
            program.stage(
                f"{number}, {WORDS[name]}",
                f"Found := MB_ResultText{language.suffix}(Code := {number});",
                kit.is_flag(f"Found = {unknown}", False, "is an unknown code"),
            )
        call = f"MB_ResultText{language.suffix}(Code := 65535)"
        program.stage("65535, no code", kit.is_text(call, _bytes(reference.UNKNOWN, language), "text"))
        yield program


REASONS = (*range(7), *range(10, 20), *range(20, 30), *range(30, 36), *range(40, 62))
"""Every number that `Reason` of a drive block can have."""


STATES = (*range(7),)
"""Every number that the state of a drive block can have."""


def own(languages: Iterable[Language]) -> Iterator[Script]:
    """Programs for the texts of reasons and states: each number has one, and no other has."""
    for language in languages:
        yield _own(language, "Reason", REASONS)
        yield _own(language, "State", STATES)


def _own(language: Language, kind: str, numbers: tuple[int, ...]) -> Script:
    name, title = f"{kind}Text{language.suffix}", f"every {kind.lower()} has a text"
    program = kit.generic(name, title, f"the {kind.lower()}s of DriveBlocks.")
    program.variables["Found"] = ("STRING", "the text")
    unknown = string(_bytes(reference.UNKNOWN, language))
    for number in range(max(numbers) + 2):
        what = "has a text" if number in numbers else "has none"
        program.stage(
            f"{number} {what}",
            f"Found := VFD_{kind}Text{language.suffix}(Code := {number});",
            kit.is_flag(f"Found = {unknown}", number not in numbers, "is an unknown code"),
        )
    return program


def _bytes(texts: reference.Texts | None, language: Language) -> bytes:
    found = texts or reference.UNKNOWN
    return (found.zh if language.suffix == "Zh" else found.en).encode(language.encoding)


def _codes(drive: Drive, stem: str, language: Language, kind: str, codes: list[int]) -> Script:
    """Codes of faults, warnings or errors; and some that are none."""
    told = {"Fault": drive.faults, "Warning": drive.warnings, "Error": drive.errors}[kind]
    find = {"Fault": reference.fault, "Warning": reference.warning, "Error": reference.error}[kind]
    source = told.source if told else ""
    title = f"texts of {kind.lower()} codes"
    program = kit.script(drive, stem, f"{kind}Text{language.suffix}", title, source)
    for code in dict.fromkeys((*codes, 0, min(max(codes, default=0) + 1, 65535), 256, 65535)):
        call = f"{drive.prefix}_{kind}Text{language.suffix}(Code := {code})"
        program.stage(f"{kind.lower()} {code}", kit.is_text(call, _bytes(find(drive, code), language), "text"))
    return program


def _places(drive: Drive, stem: str, language: Language, kind: str) -> Script:
    """Texts of bits or of values: each that a register lists, one that it does not, and a register of no table."""
    program = kit.script(drive, stem, f"{kind}Text{language.suffix}", f"texts of {kind.lower()}s")
    for section, row in drive.registers():
        address = row.address.first
        if address <= LAST and drive.is_read(row):
            for number, name in sorted((_bits if kind == "Bit" else _values)(row).items()):
                probe = _place(drive, language, kind, address, number)
                program.stage(f"{address_text(address)}{name}", probe, source=row.source or section.source)
    program.stage("a register that is in no table", _place(drive, language, kind, 0xFFFF, 0))
    return program


def _bits(row: Register) -> dict[int, str]:
    named = {bit.bit.first: f".{bits_text(bit.bit)}" for bit in row.bits}
    other = next((number for number in range(17) if number not in named), 16)
    return named | ({other: f".{other}, which has no name"} if named else {})


def _values(row: Register) -> dict[int, str]:
    listed = {value.value for value in row.values}
    return {number: f" = {number}" for number in listed | ({min(max(listed) + 1, 65535)} if listed else set())}


def _place(drive: Drive, language: Language, kind: str, address: int, number: int) -> Probe:
    """A check of the text of a bit or value."""
    find, pin = {"Bit": (reference.bit, "BitNumber"), "Value": (reference.value, "Value")}[kind]
    found = find(drive, address, number)
    name = f"{drive.prefix}_{kind}Text{language.suffix}"
    call = f"{name}(Address := {word(address)}, {pin} := {number & 0xFFFF})"
    return kit.is_text(call, _bytes(found, language), "text")
