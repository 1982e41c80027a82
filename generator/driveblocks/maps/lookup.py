"""Find what a person means by a word: 0026H, U1-07, UV1, 1EH, a frame's name; and what is near when nothing fits."""

import difflib
import re
from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps import view
from driveblocks.maps.form import SPACES, address_text, span_text, wire
from driveblocks.maps.model import USES, Area, Bit, Drive, ErrorCode, Fault, Frame, Function, Register, Section, Setting
from driveblocks.maps.numbering import at, in_hex, numbered

Found = Section | Register | Area | Bit | Fault | ErrorCode | Function | Setting | Frame

_ADDRESS = re.compile(r"(?:0X)?([0-9A-F]{1,4})H?")

_TABLE = re.compile(r"(COIL|DISCRETE|INPUT) ([0-9A-F]{1,6})H?")
"""An address of another table than the holding registers, as maps write it; or a number of it, as manuals do."""

_HEXADECIMAL = re.compile(r"[0-9A-F]{4}H")

_DECIMAL = re.compile(r"[1-9][0-9]{3,4}")
"""An address as some PLCs want it, in decimal: 4096 is 1000H, unless there is a 4096H. Fewer digits are a code, too."""


@dataclass(frozen=True)
class Match:
    """One entry of a map that a word may mean."""

    entry: Found
    shown: str
    """The entry in a few words, beginning with a word that finds it."""
    address: int = 0
    """The register's or area's address that was asked for."""
    spelled: bool = True
    """Whether the word is written as the manuals write this kind of thing: 0001H is a register, 01H a code."""


def find(drive: Drive, word: str) -> list[Match]:
    """Everything that a word may mean, best first; regardless of case. Empty when nothing fits."""
    upper = word.upper()
    found = [*_by_id(drive, upper)] if word else []
    if match := _TABLE.fullmatch(upper):
        return [*_in_table(drive, match[1].lower(), match[2], upper.partition(" ")[2])]
    number = _number(upper)
    own = _own(drive, "holding", upper)
    found += [] if own is None else _at_address(drive, own, spelled=True)
    if number is not None:
        address = upper.startswith("0X") or len(upper.rstrip("H")) == 4
        found += _at_address(drive, number, spelled=address and not (own is not None and upper.endswith("H")))
        found += _by_code(drive, number, spelled=not address)
    if _DECIMAL.fullmatch(upper):
        found += _at_address(drive, int(upper), spelled=not any(match.spelled for match in found))
    return sorted(found, key=lambda match: not match.spelled)


def _own(drive: Drive, space: str, upper: str) -> int | None:
    """The address of what is written as the manual writes its numbers; None where it writes none so."""
    if upper.isdecimal() and len(upper) <= 6:
        return numbered(drive, space, int(upper))
    return numbered(drive, space, int(upper[:-1], 16)) if _HEXADECIMAL.fullmatch(upper) and in_hex(drive) else None


def _in_table(drive: Drive, space: str, text: str, upper: str) -> Iterator[Match]:
    """Coil 4 is a number where the manual numbers coils, and so is coil 0004H where it does so in hexadecimal."""
    own, sent = _own(drive, space, upper), SPACES[space] + int(text, 16)
    addresses = [sent] if own is None else [own, sent] if upper.endswith("H") else [own]
    for address in addresses:
        if wire(address) == address - SPACES[space]:
            yield from _at_address(drive, address, spelled=address == addresses[0])


def _number(upper: str) -> int | None:
    """0026H, 26H, 0x26 and 0026 are hexadecimal, 1 to 3 digits alone are decimal."""
    match = _ADDRESS.fullmatch(upper)
    if match is None:
        return None
    if upper.endswith("H") or upper.startswith("0X") or len(upper) == 4:
        return int(match[1], 16)
    return int(upper) if upper.isdecimal() else None


def _by_id(drive: Drive, upper: str) -> Iterator[Match]:
    for _, row in drive.registers():
        for address, id_ in zip(row.address, view.ids(row), strict=True):
            if id_.upper() == upper:
                yield _register(row, address)
    for setting in drive.settings:
        if setting.id.upper() == upper:
            yield Match(setting, f"{setting.id}  keypad setting  {setting.name}")
    yield from _faults_by_id(drive, upper)
    for frame in drive.frames:
        if frame.id.upper() == upper:
            yield Match(frame, f"{frame.id}  example frame")
    for section in drive.sections:
        if section.id.upper() == upper:
            yield Match(section, f"{section.id}  register table  {section.title.en}")


def _faults_by_id(drive: Drive, upper: str) -> Iterator[Match]:
    faults = [fault for fault in (*drive.faults.codes, *drive.warning_codes) if (fault.id or "").upper() == upper]
    for fault in faults:
        yield _fault(drive, fault)
    if faults:
        return
    for _, row in drive.registers():
        for bit in row.bits:
            if (bit.id or "").upper() == upper:
                yield Match(bit, f"{bit.id}  bit of {address_text(row.address.first)}", row.address.first)


def _at_address(drive: Drive, address: int, *, spelled: bool) -> Iterator[Match]:
    address = at(drive, address)
    again = address - (drive.storage.add or 0) if any(address in span for span in drive.ram_only) else address
    for row in filter(None, dict.fromkeys(drive.register_at(again, use) for use in USES)):
        yield _register(row, again, spelled=spelled)
    for area in drive.areas:
        if again in area.addresses:
            yield Match(area, f"{address_text(address)}  in the area {area.name}", address, spelled)


def _by_code(drive: Drive, code: int, *, spelled: bool) -> Iterator[Match]:
    for fault in (*drive.faults.codes, *drive.warning_codes):
        if fault.code == code:
            yield _fault(drive, fault, spelled=spelled)
    for error in drive.errors.codes:
        if error.code == code:
            yield Match(error, f"{code:02X}H  error code  {error.name}", spelled=spelled)
    for function in drive.functions:
        if function.code == code:
            yield Match(function, f"{code:02X}H  function  {function.name}", spelled=spelled)


def _register(row: Register, address: int, *, spelled: bool = True) -> Match:
    id_ = view.ids(row)[address - row.address.first]
    words = (address_text(address), id_, "register", row.name or "")
    return Match(row, "  ".join(word for word in words if word), address, spelled)


def _fault(drive: Drive, fault: Fault, *, spelled: bool = True) -> Match:
    words = (f"{fault.code:02X}H", fault.id, drive.kind_of(fault), fault.name)
    return Match(fault, "  ".join(word for word in words if word), spelled=spelled)


def near(drive: Drive, word: str, topics: tuple[str, ...] = ()) -> list[str]:
    """What a word that means nothing may have meant: like ids, names that hold it, neighbours of an address."""
    upper = word.upper()
    known = {key.upper(): shown for key, shown in (*((topic, topic) for topic in topics), *_everything(drive))}
    like = [known[one] for one in difflib.get_close_matches(upper, known, 4, 0.6)]
    holding = [shown for _, shown in _everything(drive) if upper in shown.upper() or word in shown]
    return list(dict.fromkeys([*like, *_neighbours(drive, upper), *holding]))[:8]


def _everything(drive: Drive) -> Iterator[tuple[str, str]]:
    for _, row in drive.registers():
        if not row.unused:
            yield row.id or address_text(row.address.first), _words(row)
    for fault in (*drive.faults.codes, *drive.warning_codes):
        kind = drive.kind_of(fault)
        shown = "  ".join(filter(None, (f"{fault.code:02X}H", fault.id, kind, fault.name, fault.own)))
        yield fault.id or f"{fault.code:02X}H", shown
    for frame in drive.frames:
        yield frame.id, f"{frame.id}  example frame"


def _words(row: Register) -> str:
    return "  ".join(filter(None, (span_text(row.address), row.id, row.name, row.own)))


def _neighbours(drive: Drive, upper: str) -> list[str]:
    number = _number(upper)
    if number is None:
        return []
    rows = [row for _, row in drive.registers() if not row.unused]
    rows.sort(key=lambda row: min(abs(row.address.first - number), abs(row.address.last - number)))
    return [_words(row) for row in rows[:3]]
