"""The statements and checks that programs have in common: bytes into arrays and out of them, requests, declarations."""

from collections.abc import Iterator

from driveblocks.bench.code import NUMBERS
from driveblocks.bench.script import Item, Probe, Script
from driveblocks.maps.model import Drive
from driveblocks.reference.request import Asked
from structured_text.language.writing import byte, dword, flag, real, string, word

GENERIC = "modbus"
"""Folder of the programs that test what all drives share."""

_ARRAYS = {
    "Adu": ("MB_Adu", "a frame as bytes"),
    "Chars": ("MB_Chars", "a frame as characters"),
    "Words": ("MB_Words", "registers that are written or were read"),
    "Request": ("MB_Request", "the open request"),
    "Registers": ("MB_Registers", "a frame in the registers of the PLC"),
}


def script(drive: Drive, stem: str, subject: str, title: str, source: str = "") -> Script:
    printed = drive.manual.title
    manual = f"{printed.en} ({printed.own})" if printed.own else printed.en
    return Script(stem, f"{drive.prefix}_Test{subject}", title, f"{manual}: {source}." if source else f"{manual}.")


def generic(subject: str, title: str, source: str) -> Script:
    """A program that tests a block that every drive shares."""
    return Script(GENERIC, f"MB_Test{subject}", title, source)


def declare(program: Script, *names: str, **blocks: str) -> None:
    """Declare shared arrays by name, and instances of blocks as name = type."""
    for name in names:
        program.variables[name] = _ARRAYS[name]
    for name, type_ in blocks.items():
        program.variables[name] = (type_, "under test")


def fill(box: str, data: bytes) -> list[str]:
    return [f"{box}[{index}] := {byte(octet)};" for index, octet in enumerate(data)]


def changed(box: str, usual: bytes, data: bytes) -> list[str]:
    """Statements that put bytes into Adu or Chars where others are by now."""
    filled = fill(box, data)
    return [filled[index] for index in range(len(data)) if data[index : index + 1] != usual[index : index + 1]]


def fill_words(box: str, words: list[int] | tuple[int, ...]) -> list[str]:
    return [f"{box}[{index}] := {word(value)};" for index, value in enumerate(words)]


def same_bytes(box: str, data: bytes, what: str = "bytes") -> Iterator[Probe]:
    """Checks that Adu or Chars starts with some bytes, four at a time."""
    for first in range(0, len(data), 4):
        part = data[first : first + 4]
        value = dword(int.from_bytes(part, "big"))
        pins = f"First := {first}, Count := {len(part)}, Expected := {value}, {box} := {box}"
        words = f"{what} {first} to {first + len(part) - 1}" if len(part) > 1 else f"{what} {first}"
        yield Probe(box, pins, words, len(part))


def are_bytes(box: str, first: int, expected: str) -> Probe:
    """A check of four bytes of Adu or Chars with a DWORD variable."""
    pins = f"First := {first}, Count := 4, Expected := {expected}, {box} := {box}"
    return Probe(box, pins, f"bytes {first} to {first + 3}")


def sample(length: int) -> bytes:
    """Bytes 7, 14, 21 and so on."""
    return bytes(7 * (index + 1) % 256 for index in range(min(length, 600)))


def ramp(box: str, length: int) -> list[str]:
    """Statements that fill an array like `sample`."""
    step = f"{box}[Index] := UINT_TO_BYTE(Octet); Octet := (Octet + 7) MOD 256; Index := Index + 1;"
    return ["Index := 0;", "Octet := 7;", f"WHILE Index < {length} DO {step} END_WHILE;"] if length else []


def declare_ramp(program: Script) -> None:
    """Declare what `ramp` and `cleared` count with."""
    program.variables["Index"] = ("UINT", "next byte")
    program.variables["Octet"] = ("UINT", "value of the next byte")


def cleared(box: str, length: int) -> list[str]:
    step = f"{box}[Index] := BYTE#16#00; Index := Index + 1;"
    return ["Index := 0;", f"WHILE Index < {max(length, 1)} DO {step} END_WHILE;"]


def last_bytes(box: str, data: bytes) -> Iterator[Probe]:
    """Checks of the last four bytes of a frame, with its checksum."""
    if len(data) > 8:
        pins = f"First := {len(data) - 4}, Count := 4"
        value = int.from_bytes(data[-4:], "big")
        yield Probe(box, f"{pins}, Expected := {dword(value)}, {box} := {box}", "last four bytes")


def same_words(box: str, words: list[int] | tuple[int, ...], what: str = "word") -> Iterator[Probe]:
    """Checks that Words or Registers starts with some words."""
    for index, value in enumerate(words):
        yield is_word(f"{box}[{index}]", word(value), f"{what} {index}")


def is_word(actual: str, expected: str, words: str) -> Probe:
    return Probe("Word", f"Expected := {expected}, Actual := {actual}", words)


def is_number(actual: str, expected: int | str, words: str) -> Probe:
    return Probe("Number", f"Expected := {expected}, Actual := {actual}", words)


def is_between(actual: str, lowest: str, highest: str, words: str) -> Probe:
    """A check of a UINT against bounds."""
    return Probe("Between", f"Lowest := {lowest}, Highest := {highest}, Actual := {actual}", words)


def is_flag(actual: str, expected: bool | str, words: str) -> Probe:
    value = expected if isinstance(expected, str) else flag(expected)
    return Probe("Flag", f"Expected := {value}, Actual := {actual}", words)


def is_real(actual: str, expected: float, words: str) -> Probe:
    """A check of a REAL, but for the last bit."""
    pins = f"Expected := {real(expected)}, Actual := {actual}, Tolerance := {real(abs(expected) * 2e-7)}"
    return Probe("Real", pins, words)


def is_text(actual: str, expected: bytes, words: str) -> Probe:
    return Probe("Text", f"Expected := {string(expected)}, Actual := {actual}", words)


def has_result(block: str, name: str) -> Probe:
    """A check that a block answered with the result of some name."""
    return is_number(f"{block}.ErrorID", NUMBERS[name], "ErrorID" if name == "OK" else f"ErrorID, {name}")


def build(asked: Asked) -> list[Item]:
    """Statements that hand a request to the instance Build of a drive's request block."""
    pins = (
        f"Ascii := {flag(asked.ascii)}, UnitAddress := {asked.unit}, FunctionCode := {asked.function}",
        f"Address := {word(asked.address)}, Quantity := {asked.quantity}",
        f"Value := {word(asked.value)}, SubFunction := {word(asked.sub_function)}",
        "Words := Words, Adu := Adu, Request := Request",
    )
    return [*fill_words("Words", asked.words), f"Build({', '.join(pins)});"]


def open_request(asked: Asked) -> list[Item]:
    """Statements that note a request as open, as the request block does."""
    return [
        f"Request.UnitAddress := {asked.unit};",
        f"Request.FunctionCode := {asked.function};",
        f"Request.Address := {word(asked.address)};",
        f"Request.Quantity := {asked.quantity};",
        f"Request.SubFunction := {word(asked.sub_function)};",
        f"Request.Value := {word(asked.value)};",
    ]
