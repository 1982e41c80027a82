"""What the words of registers mean in a map: names, values in units, bits, listed values, faults, commands."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from decimal import Decimal

from driveblocks.maps import view
from driveblocks.maps.adu import number
from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Area, Bit, Drive, Register, Use, Value
from driveblocks.maps.numbering import at
from driveblocks.meaning.quantity import Factor, of_row
from driveblocks.meaning.status import status
from driveblocks.meaning.words import words


@dataclass(frozen=True)
class Line:
    """A bit, field, value, fault or command of a word."""

    mark: str
    """Where it is in the word: `.5`, `.3-4`, `=`, or what it is: `fault`, `command`."""
    id: str
    name: str
    zh: str
    value: int | None = None


@dataclass(frozen=True)
class Held:
    """A register and the word that it holds or takes; without a word it is only named."""

    address: int | None
    word: int | None = None
    number: int | None = None
    """The word as a number, two's complement where the map says so."""
    id: str = ""
    name: str = ""
    zh: str = ""
    value: Decimal | None = None
    unit: str | None = None
    note: str = ""
    known: bool = True
    lines: tuple[Line, ...] = ()


def held(drive: Drive | None, address: int | None, word: int | None, *, writing: bool) -> Held:
    """What a drive's map says of an address and a word."""
    if drive is None or address is None:
        return Held(address, word, word)
    address = at(drive, address)
    use: Use = "w" if writing else "r"
    row = drive.register_at(address, use)
    if row is not None:
        return _row(drive, row, address, word, writing)
    ram = any(address in span for span in drive.ram_only)
    home = drive.register_at(address - (drive.storage.add or 0), use) if ram else None
    if home is not None:
        known = _row(drive, home, address - (drive.storage.add or 0), word, writing=False)
        return replace(known, address=address, note=_ram_note(drive) if writing else "")
    area = _area(drive, address)
    if area is None:
        return Held(address, word, word, note="not in the map", known=False)
    name, zh, note = area
    return Held(address, word, word, name=name, zh=zh, note=note if writing else "")


def _area(drive: Drive, address: int) -> tuple[str, str, str] | None:
    """Name in both languages of an address that a rule gives, and what a write there does."""
    for area in drive.areas:
        if address in area.addresses:
            return *_numbered(area, address), _stored(drive, area, address)
        moved = address - (drive.storage.add or 0)
        if drive.storage.area == area.id and drive.storage.add and moved in area.addresses:
            name, zh = _numbered(area, moved)
            return name, zh, _ram_note(drive)
    return None


def _ram_note(drive: Drive) -> str:
    return "RAM only, not stored" + "; it cannot be read at this address" * (not drive.storage.readable)


def _numbered(area: Area, address: int) -> tuple[str, str]:
    place = address - area.addresses.first
    return (
        f"{area.name}, {area.numbered_by.replace('_', ' ')} {place}",
        f"{area.text_zh} {place}" if area.text_zh else "",
    )


def _stored(drive: Drive, area: Area, address: int) -> str:
    storage = drive.storage
    if storage.method == "ram_address_bit" and storage.area == area.id and storage.add is not None:
        return f"stored in EEPROM, which frequent writes wear out; {address_text(address + storage.add)} is RAM only"
    return "counts as a write to EEPROM: the manual does not say" if storage.method == "unexplained" else ""


def _row(drive: Drive, row: Register, address: int, word: int | None, writing: bool) -> Held:
    known = Held(
        address,
        word,
        None if word is None else number(word, row.signed),
        id=view.ids(row)[address - row.address.first],
        name="not used" if row.unused else row.name or "",
        zh=row.text_zh or "",
    )
    if word is None:
        return known
    if row.words:
        return replace(known, note="one of two words of a value of 32 bits")
    factor = of_row(row, address).factor
    value = number(word, row.signed) * factor if factor is not None else None
    lines = (
        *_lines(row, word),
        *_faults(drive, row, address, word),
        *_warning(drive, row, word),
        *(_commands(drive, address, word) if writing else ()),
    )
    note = "; ".join(_notes(drive, row, word, writing))
    return replace(known, value=value, unit=row.unit, note=note, lines=lines)


def _lines(row: Register, word: int) -> Iterator[Line]:
    for bit in row.bits:
        yield from _bit(bit, word >> bit.bit.first & (1 << len(bit.bit)) - 1)
    for value in row.values:
        if word & value.value if row.masks else word == value.value & 0xFFFF:
            mark = f".{value.value.bit_length() - 1:X}" if row.masks else "="
            yield Line(mark, "", value.name, value.text_zh or "", 1 if row.masks else value.value)


def _bit(bit: Bit, found: int) -> Iterator[Line]:
    """A bit that is set, a field, a bit whose 0 has a meaning of its own; a hole only if something is in it."""
    mark = f".{bits_text(bit.bit)}"
    if bit.unused:
        if found:
            yield Line(mark, "", "not used by the manual, but not 0", "", found)
        return
    meaning = _listed(bit.values, found)
    if len(bit.bit) > 1:
        named = f"{bit.name}: {meaning.name if meaning else 'no listed value'}"
        yield Line(mark, bit.id or "", named, (meaning.text_zh if meaning else bit.text_zh) or "", found)
    elif meaning is not None:
        yield Line(mark, bit.id or "", meaning.name, meaning.text_zh or "", found)
    elif found:
        yield Line(mark, bit.id or "", bit.name or "", bit.text_zh or "", found)


def _listed(values: tuple[Value, ...], found: int) -> Value | None:
    return next((value for value in values if value.value == found), None)


def _faults(drive: Drive, row: Register, address: int, word: int) -> Iterator[Line]:
    told = any(address in span for span in drive.faults.registers) and row is drive.register_at(address)
    if not told or row.values:
        return
    word = drive.faults.code_in(address, word)
    fault = next((one for one in drive.faults.codes if one.code == word), None)
    if fault is not None:
        yield Line("fault", fault.id or "", fault.name, fault.text_zh or "", word)
    elif word == 0:
        yield Line("fault", "", "no fault", "无故障", 0)
    else:
        why = f"code {word:02X}H" + (", which the map does not list" if drive.faults.codes else "; the map has no list")
        yield Line("fault", "", why, "", word)


def _warning(drive: Drive, row: Register, word: int) -> Iterator[Line]:
    """The warning whose code a word holds; none where the values of the register name it."""
    told = drive.warnings
    if told is None or drive.register_at(told.register) is not row or row.values:
        return
    code = told.code_in(word)
    found = next((one for one in told.codes if one.code == code), None)
    name = found.name if found else f"code {code:02X}H, which the map does not list" if code else "no warning"
    yield Line("warning", (found.id if found else "") or "", name, (found.text_zh if found else "") or "", code)


def _commands(drive: Drive, address: int, word: int) -> Iterator[Line]:
    """The commands that a word is; a word that is none, by what its bits or its value do to the motor."""
    known, found = words(drive), False
    for command in known.commands:
        does, many = command.does.replace("_", " "), len(command.writes)
        for turn, write in enumerate(command.writes, 1):
            if write.register == address and write.pattern.holds(word):
                step = f", write {turn} of {many}" * (write is not command.last)
                found = True
                yield Line("command", "", does + (step or " with a negative reference" * command.negative), "", None)
    told = known.at(address)
    if told and not found and told.says(word):
        yield Line("command", "", told.says(word), "", None)


def _while(one: Factor) -> str:
    return "otherwise" if one.when is None else f"while {one.when}"


def _notes(drive: Drive, row: Register, word: int, writing: bool) -> Iterator[str]:
    factors = of_row(row, row.address.first).factors
    if factors and factors[0].when is not None:
        yield f"only while {factors[0].when}"
        yield from (f"{number(word, row.signed) * one.value} {row.unit} {_while(one)}" for one in factors[1:])
    if row.unit is not None and not factors:
        yield f"in {row.unit}, but the manual gives no scale"
    if row.range is not None and not row.range.holds(number(word, row.signed)):
        yield f"outside the range {row.range.min} to {row.range.max}"
    if row.values and not row.masks and _listed(row.values, word) is None:
        turned = _listed(row.values, (word & 0xFF) << 8 | word >> 8)
        yield (
            f"no listed value; with its bytes swapped it is {turned.value}, {turned.name}"
            if turned
            else "no listed value"
        )
    for never in row.never:
        if writing and never.holds(word):
            yield f"must never be sent: {never.why}"
    if row.masks:
        yield from _masks(row, word)
    if writing:
        yield from _stores(drive, row)
    proofs = [one for one in status(drive).standstill.patterns if one.register in row.address]
    if not writing and proofs:
        met = all(one.holds(word) for one in proofs)
        yield "as at standstill" if met else "no standstill"


def _stores(drive: Drive, row: Register) -> Iterator[str]:
    storage = drive.storage
    if storage.register is not None and storage.register in row.address:
        most = f", at most {storage.max_writes} times" if storage.max_writes else ""
        yield f"stores all parameters{most}"
    for twin in storage.twins:
        if twin.stored in row.address:
            yield f"stored in EEPROM, which frequent writes wear out; {address_text(twin.ram)} is the same in RAM"
    again = row.address.first + (storage.add or 0)
    if any(again in span for span in drive.ram_only):
        yield f"stored in EEPROM, which frequent writes wear out; {address_text(again)} is RAM only"


def _masks(row: Register, word: int) -> Iterator[str]:
    rest = word
    for value in row.values:
        rest &= ~value.value
    if rest or word == 0:
        yield "no listed bit" if word == 0 else f"bits {rest:04X}H are not listed"
