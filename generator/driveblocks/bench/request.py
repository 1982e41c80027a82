"""Programs for a drive's request block: every limit from both sides, and which of two mistakes is reported."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from itertools import combinations, pairwise
from typing import Any

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import Script
from driveblocks.bench.table import Table
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import start_of
from driveblocks.meaning.serial import serial
from driveblocks.reference.request import BUILDABLE, COUNTED, READS, Asked, Requests

UNTOUCHED = 0xAA
"""What is in the frame before each request: a request that is refused must keep it."""

PATTERN = (0xA5C3, 0x5A3C, 0x0000, 0xFFFF, 0x8001, 0x0180)
"""Words to write, over and over."""

ODD_FUNCTIONS = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 15, 16, 17, 22, 23, 43, 127, 128, 131, 134, 144, 255, 259, 262, 65535,
)  # fmt: skip
_PINS = {
    "ascii": ("Ascii", "BOOL"),
    "unit": ("UnitAddress", "UINT"),
    "function": ("FunctionCode", "UINT"),
    "address": ("Address", "WORD"),
    "quantity": ("Quantity", "UINT"),
    "value": ("Value", "WORD"),
    "sub_function": ("SubFunction", "WORD"),
}


@dataclass(frozen=True)
class Case:
    """A request, what it is about, and where the limit is in the manual."""

    about: str
    asked: Asked
    source: str = ""


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program with all cases, and one with the longest writes, byte for byte."""
    model = Requests(drive)
    base = usual(model)
    program = kit.script(drive, stem, "Request", "what may be asked, at every limit and just beyond")
    kit.declare(program, "Adu", "Words", "Request", Build=f"{drive.prefix}_Request")
    table = _table(program, base)
    seen: set[Asked] = set()
    for case in _cases(model, base):
        if case.asked not in seen:
            seen.add(case.asked)
            _row(table, model, case)
    yield program
    if 16 in model.functions:
        yield _writes(drive, stem, model)


def runs(addresses: Iterable[int]) -> list[Span]:
    """Addresses as runs without gaps."""
    found: list[Span] = []
    for address in sorted(addresses):
        if found and address == found[-1].last + 1:
            found[-1] = Span(found[-1].first, address)
        else:
            found.append(Span(address, address))
    return found


def longest(addresses: Iterable[int]) -> Span:
    """The longest run; 0000H alone where there is none."""
    return max(runs(addresses), key=len, default=Span(0, 0))


def usual(model: Requests, function: int | None = None) -> Asked:
    """A request that the drive takes; of a function if one is given, which may be one that it lacks."""
    known = sorted(set(model.functions) & BUILDABLE)
    code = function if function is not None else next(iter(known), 3)
    spans = model.readable if code in READS else model.writable
    subs = model.functions[8].sub_functions if 8 in model.functions else ()
    return Asked(
        code,
        max(serial(model.drive).lowest, 1),
        longest(spans).first,
        1,
        0x1234,
        subs[0].code if subs else 0,
        tuple(PATTERN[index % len(PATTERN)] for index in range(123)),
        serial(model.drive).ascii,
    )


def _table(program: Script, base: Asked) -> Table:
    """What every case starts from, and what is done with it."""
    table = Table(program)
    for name, (pin, type_) in _PINS.items():
        table.column(pin, type_, getattr(base, name), "input of Build, see there")
    table.column("WantedError", "UINT", 0, "ErrorID that Build must give")
    table.column("WantedLength", "UINT", 0, "Length that Build must give; 0 with an error")
    table.column("WantedFunction", "UINT", 0, "function that must be noted as open; 0 with an error")
    table.column("WantedHead", "DWORD", _untouched(b"")[0], "bytes 0 to 3 of the frame; as before with an error")
    table.column("WantedTail", "DWORD", _untouched(b"")[1], "bytes 4 to 7 of the frame; as before with an error")
    table.always(*kit.fill("Adu", bytes([UNTOUCHED] * 8)), *kit.fill_words("Words", PATTERN[:1]))
    pins = ", ".join(f"{pin} := {pin}" for pin, _ in _PINS.values())
    table.do(
        f"Build({pins}, Words := Words, Adu := Adu, Request := Request);",
        kit.is_number("Build.ErrorID", "WantedError", "ErrorID"),
        kit.is_number("Build.Length", "WantedLength", "Length"),
        kit.is_number("Request.FunctionCode", "WantedFunction", "function noted as open"),
        kit.are_bytes("Adu", 0, "WantedHead"),
        kit.are_bytes("Adu", 4, "WantedTail"),
    )
    return table


def _untouched(body: bytes) -> tuple[int, int]:
    """The first eight bytes of a frame that holds a body, as two numbers."""
    head = body[:8].ljust(8, bytes([UNTOUCHED]))
    return int.from_bytes(head[:4], "big"), int.from_bytes(head[4:], "big")


def _row(table: Table, model: Requests, case: Case) -> None:
    built = model.build(case.asked)
    head, tail = _untouched(built.body)
    refused = "" if built.result == "OK" else "refused, "
    words = f"{case.about}: {_said(model.drive, case.asked)}: {refused}{WORDS[built.result]}"
    asked = {pin: getattr(case.asked, name) for name, (pin, _) in _PINS.items()}
    wanted = {
        "WantedError": NUMBERS[built.result],
        "WantedLength": len(built.body),
        "WantedFunction": built.body[1] if built.body else 0,
        "WantedHead": head,
        "WantedTail": tail,
    }
    table.row(words, asked | wanted, source=case.source)


def _said(drive: Drive, asked: Asked) -> str:
    parts = [f"function {asked.function:02X}H"]
    if asked.function == 8:
        parts.append(f"sub-function {asked.sub_function:04X}H")
    else:
        parts.append(address_text(asked.address + start_of(drive, asked.function)))
    if asked.function in COUNTED:
        parts.append(f"{asked.quantity} register{'s' * (asked.quantity != 1)}")
    return ", ".join([*parts, f"unit {asked.unit}", *(["ASCII"] if asked.ascii else [])])


# ---------------------------------------------------------------- the cases


def _cases(model: Requests, base: Asked) -> Iterator[Case]:
    own = [usual(model, code) for code in sorted(set(model.functions) & BUILDABLE)]
    yield from _modes(model, own)
    yield from _functions(model, base)
    for asked in own:
        yield from _units(model, asked)
        yield from _broadcasts(model, asked)
        if asked.function in COUNTED:
            yield from _quantities(model, asked)
        if asked.function != 8:
            yield from _addresses(model, asked)
    yield from _sub_functions(model)
    for asked in own:
        yield from _two_mistakes(model, asked)


def _modes(model: Requests, own: list[Asked]) -> Iterator[Case]:
    for asked in own:
        for ascii_mode in (False, True):
            yield Case("mode", replace(asked, ascii=ascii_mode), serial(model.drive).said[0].source)


def _functions(model: Requests, base: Asked) -> Iterator[Case]:
    for code in ODD_FUNCTIONS:
        source = model.functions[code].source if code in model.functions else ""
        asked = usual(model, code) if code in model.functions and code in BUILDABLE else replace(base, function=code)
        yield Case("function", asked, source)


def _units(model: Requests, asked: Asked) -> Iterator[Case]:
    line = serial(model.drive)
    low, high = line.lowest, line.highest
    for number in sorted({0, 1, max(low - 1, 0), low, high, high + 1, 247, 248, 255, 256, 257, 65535}):
        yield Case("unit address", replace(asked, unit=number), line.units_said.source)


def _broadcasts(model: Requests, asked: Asked) -> Iterator[Case]:
    cast = serial(model.drive).broadcast
    if cast is None:
        return
    others = [run.first for run in runs(model.writable)[:4]]
    for address in (*cast.starts, *others):
        yield Case("broadcast", replace(asked, unit=0, address=address), cast.said.source)


def _quantities(model: Requests, asked: Asked) -> Iterator[Case]:
    use, limits = "read" if asked.function in READS else "write", model.drive.limits
    named = limits.read_words if asked.function in READS else limits.write_words
    for ascii_mode in (False, True):
        size = limits.ascii_data_bytes if ascii_mode else limits.data_bytes
        most = getattr(model.ascii if ascii_mode else model.rtu, use)
        source = "; ".join(limit.source for limit in (named, size) if limit is not None)
        for number in sorted({0, 1, 2, most - 1, most, most + 1, 123, 124, 125, 126, 255, 256, 257, 65535}):
            if number >= 0:
                yield Case("quantity", replace(asked, quantity=number, ascii=ascii_mode), source)


def _addresses(model: Requests, asked: Asked) -> Iterator[Case]:
    spans = runs(model.readable if asked.function in READS else model.writable)
    source = Sources(model.drive).at
    for span in spans:
        for address in (span.first - 1, span.first, span.last, span.last + 1):
            if 0 <= address <= 0xFFFF:
                yield Case("address", replace(asked, address=address), source(address))
    yield from (Case("address", replace(asked, address=address), source(address)) for address in (0, 0xFFFF))
    if asked.function not in COUNTED:
        return
    if model.drive.limits.group is not None:
        size = model.drive.limits.group.value
        borders = (last for span in spans for last in span if last < span.last and (last + 1) % size == 0)
        yield from (Case("end of a group", replace(asked, address=last, quantity=2), source(last)) for last in borders)
    for span in spans:
        yield Case("end of a range", replace(asked, address=span.last, quantity=2), source(span.last))
        if len(span) > 1:
            yield Case("end of a range", replace(asked, address=span.last - 1, quantity=2), source(span.last))
    yield from _holes(model, asked, spans)
    for address, quantity in ((0xFFFF, 2), (0xFFFE, 2), (0xFFFE, 3)):
        yield Case("end of all addresses", replace(asked, address=address, quantity=quantity))


def _holes(model: Requests, asked: Asked, spans: list[Span]) -> Iterator[Case]:
    """Requests whose ends are allowed and whose middle is not."""
    most = model.rtu.read if asked.function in READS else model.rtu.write
    for before, after in pairwise(spans):
        quantity = after.first - before.last + 1
        if quantity <= most:
            yield Case("a hole between", replace(asked, address=before.last, quantity=quantity))


class Sources:
    def __init__(self, drive: Drive) -> None:
        self.drive = drive

    def at(self, address: int) -> str:
        found = self.drive.row_at(address)
        if found is not None:
            section, row = found
            return row.source or section.source
        area = next((area for area in self.drive.areas if address in area.addresses), None)
        return area.source if area else "in no table of the manual"


def _sub_functions(model: Requests) -> Iterator[Case]:
    if 8 not in model.functions:
        return
    asked = usual(model, 8)
    listed = [sub.code for sub in model.functions[8].sub_functions]
    near = {(code + step) & 0xFFFF for code in listed for step in (-1, 0, 1, 0x100)}
    for code in sorted({*near, 0, 1, 10, 0xFFFF}):
        yield Case("sub-function", replace(asked, sub_function=code), model.functions[8].source)
    for value in (0x0000, 0x00FF, 0xFF00, 0xFFFF):
        yield Case("data word", replace(asked, value=value), model.functions[8].source)


def _two_mistakes(model: Requests, asked: Asked) -> Iterator[Case]:
    """Two mistakes at once: the block reports the one that it looks for first."""
    for (one, first), (other, second) in combinations(_mistakes(model, asked), 2):
        if {field.name for field in fields(Asked) if field.name in first and field.name in second}:
            continue
        yield Case(f"{one} and {other}", replace(asked, **{**first, **second}))


def _mistakes(model: Requests, asked: Asked) -> list[tuple[str, dict[str, Any]]]:
    modes = serial(model.drive).modes
    allowed = model.readable if asked.function in READS else model.writable
    barred = next((address for address in range(0xFFFF, -1, -1) if address not in allowed), 0xFFFF)
    found: list[tuple[str, dict[str, Any]]] = [
        ("no such function", {"function": 7}),
        ("unit too high", {"unit": serial(model.drive).highest + 1}),
        ("broadcast", {"unit": 0}),
    ]
    if len(modes) == 1:
        found.append(("wrong mode", {"ascii": modes[0] == "rtu"}))
    if asked.function in COUNTED:
        most = model.rtu.read if asked.function in READS else model.rtu.write
        found += [("no register", {"quantity": 0}), ("too many registers", {"quantity": most + 1})]
        found.append(("past FFFFH", {"address": 0xFFFF, "quantity": 2}))
    if asked.function != 8:
        found.append(("barred address", {"address": barred}))
    else:
        found.append(("no such sub-function", {"sub_function": 0xFFFF}))
    return found


def _writes(drive: Drive, stem: str, model: Requests) -> Script:
    """The longest write of each mode, and one of one word, all bytes."""
    program = kit.script(drive, stem, "Write", "writes of several registers, all bytes", model.functions[16].source)
    kit.declare(program, "Adu", "Words", "Request", Build=f"{drive.prefix}_Request")
    asked = usual(model, 16)
    room = len(longest(model.writable))
    for ascii_mode in (mode == "ascii" for mode in serial(drive).modes):
        most = min((model.ascii if ascii_mode else model.rtu).write, room)
        for quantity in sorted({1, most}):
            each = replace(asked, quantity=quantity, ascii=ascii_mode, words=asked.words[:quantity])
            built = model.build(each)
            program.stage(
                f"{_said(drive, each)}: {WORDS[built.result]}",
                *kit.build(each),
                kit.has_result("Build", built.result),
                kit.is_number("Build.Length", len(built.body), "Length"),
                *kit.same_bytes("Adu", built.body),
            )
    return program
