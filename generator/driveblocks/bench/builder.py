"""Programs for the builders that every drive shares: the standard's limits, the frame, and what is noted as open."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.bench import kit
from driveblocks.bench.code import WORDS
from driveblocks.bench.script import Item, Script
from driveblocks.reference.request import Asked, body
from structured_text.language.writing import word

LINE = "MODBUS over Serial Line V1.02"
PROTOCOL = "MODBUS Application Protocol V1.1b3"

MOST = {3: 125, 4: 125, 16: 123}
"""Registers per frame by the standard."""

UNTOUCHED = b"\xaa" * 12
"""What is in the frame before; a request that is refused keeps it."""

NUMBERS = (0x0000, 0x00FF, 0xFF00, 0xFFFF)
UNITS = (0, 1, 247, 248, 256, 257, 65535)


@dataclass(frozen=True)
class Case:
    """A request, the result that the standard's limits give, and MaxWords where it is given."""

    about: str
    asked: Asked
    result: str
    most: int | None = None


def scripts() -> Iterator[Script]:
    yield _program("BuildRead", "requests of functions 03H and 04H", "6.3 and 6.4", "MB_BuildRead", _reads())
    yield _program("BuildSingle", "requests of function 06H", "6.6", "MB_BuildWriteSingle", _singles())
    yield _program("BuildDiagnose", "requests of function 08H", "6.8", "MB_BuildDiagnostics", _diagnostics())
    multiple = kit.generic("BuildMultiple", "requests of function 10H", f"{PROTOCOL}, 6.12; {LINE}, 2.1.")
    kit.declare(multiple, "Adu", "Words", "Request", Build="MB_BuildWriteMultiple")
    _multiple(multiple)
    yield multiple


def _program(subject: str, title: str, section: str, block: str, cases: Iterable[Case]) -> Script:
    program = kit.generic(subject, title, f"{PROTOCOL}, {section}; broadcast by {LINE}, 2.1.")
    kit.declare(program, "Adu", "Request", Build=block)
    program.defaults += kit.fill("Adu", UNTOUCHED)
    for case in cases:
        _built(program, case)
    return program


# ---------------------------------------------------------------- one request


def _pins(asked: Asked, most: int | None) -> str:
    given = [f"UnitAddress := {asked.unit}"]
    if asked.function not in (6, 8, 16):
        given.append(f"FunctionCode := {asked.function}")
    given.append(
        f"SubFunction := {word(asked.sub_function)}" if asked.function == 8 else f"Address := {word(asked.address)}"
    )
    given.append(f"Value := {word(asked.value)}" if asked.function in (6, 8) else f"Quantity := {asked.quantity}")
    if most is not None:
        given.append(f"MaxWords := {most}")
    if asked.function == 16:
        given.append("Words := Words")
    return ", ".join([*given, "Adu := Adu", "Request := Request"])


def _built(program: Script, case: Case) -> None:
    """Build one request: the frame and what is noted as open, or neither."""
    data = body(case.asked) if case.result == "OK" else b""
    program.stage(
        f"{case.about}: {WORDS[case.result]}",
        f"Build({_pins(case.asked, case.most)});",
        kit.has_result("Build", case.result),
        kit.is_number("Build.Length", len(data), "Length"),
        *kit.same_bytes("Adu", data[:12].ljust(12, UNTOUCHED[:1])),
        kit.is_number("Request.FunctionCode", case.asked.function if data else 0, "function noted as open"),
        *(_noted(case.asked) if data else ()),
    )


def _noted(asked: Asked) -> Iterator[Item]:
    """Checks of the other fields of the open request."""
    yield kit.is_number("Request.UnitAddress", asked.unit, "unit noted")
    yield kit.is_number("Request.Quantity", asked.quantity, "number of registers noted")
    yield kit.is_word("Request.SubFunction", word(asked.sub_function), "sub-function noted, 0 without")
    yield kit.is_word("Request.Address", word(asked.address), "address noted, 0 without")
    yield kit.is_word("Request.Value", word(asked.value), "word noted, 0 without")


# ---------------------------------------------------------------- the cases


def _units(good: Asked, least: int) -> Iterator[Case]:
    for unit in UNITS:
        yield Case(f"unit {unit}", replace(good, unit=unit), "OK" if least <= unit <= 247 else "UNIT")


def _quantities(good: Asked) -> Iterator[Case]:
    """Numbers of registers at the standard's limits, at those of MaxWords, and at the end of all addresses."""
    most = MOST[good.function]
    for quantity in (0, 1, most, most + 1, 256, 257, 65535):
        result = "OK" if 1 <= quantity <= most else "QUANTITY"
        yield Case(f"{quantity} registers", replace(good, quantity=quantity), result)
    for limit, quantity in ((16, 16), (16, 17), (0, 1), (1, 1), (200, most + 1)):
        result = "OK" if quantity <= min(limit, most) else "QUANTITY"
        yield Case(f"{quantity} of {limit} registers", replace(good, quantity=quantity), result, limit)
    for address, quantity in ((0xFFFF, 1), (0xFFFF, 2), (0xFFFE, 2), (0xFFFE, 3), (0x10000 - most, most), (0, most)):
        result = "OK" if address + quantity <= 0x10000 else "WRAP"
        asked = replace(good, address=address, quantity=quantity)
        yield Case(f"{quantity} registers from {address:04X}H", asked, result)


def _reads() -> Iterator[Case]:
    good = Asked(3, 1, 0x2100, 2)
    yield Case("function 03H", good, "OK")
    yield Case("function 04H", replace(good, function=4), "OK")
    for code in (0, 1, 2, 5, 7, 15, 259):
        yield Case(f"function {code}", replace(good, function=code), "FUNCTION")
    yield from _units(good, 1)
    yield from _quantities(good)


def _singles() -> Iterator[Case]:
    good = Asked(6, 1, 0x1000, 1, 0x1234)
    yield from _units(good, 0)
    for number in NUMBERS:
        yield Case(f"register {number:04X}H", replace(good, address=number), "OK")
        yield Case(f"word {number:04X}H", replace(good, value=number), "OK")


def _diagnostics() -> Iterator[Case]:
    good = Asked(8, 1, value=0x12AB)
    yield from _units(good, 1)
    for number in (1, *NUMBERS):
        yield Case(f"sub-function {number:04X}H", replace(good, sub_function=number), "OK")
        yield Case(f"data word {number:04X}H", replace(good, value=number), "OK")


def _multiple(program: Script) -> None:
    program.defaults += kit.fill("Adu", UNTOUCHED)
    words = tuple(0x0103 * (index + 1) & 0xFFFF for index in range(MOST[16]))
    last = kit.is_word("Words[122]", word(words[122]), "last word")
    program.stage("the words that all cases write", *kit.fill_words("Words", words), last)
    good = Asked(16, 1, 0x2100, 2, words=words)
    for case in (*_units(good, 0), *_quantities(good)):
        _built(program, case)
    longest = replace(good, quantity=MOST[16])
    program.stage(
        f"{MOST[16]} registers, every byte", f"Build({_pins(longest, None)});", *kit.same_bytes("Adu", body(longest))
    )
