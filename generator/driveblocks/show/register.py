"""The page of one register: everything that the map holds about it."""

from collections.abc import Iterator
from decimal import Decimal

from rich.console import RenderableType
from rich.padding import Padding

from driveblocks.maps import view
from driveblocks.maps.form import address_text, bits_text, span_text, wire, wire_text
from driveblocks.maps.model import Area, Command, Drive, Register, Section, Step, Value
from driveblocks.meaning.pattern import of_condition
from driveblocks.meaning.status import status
from driveblocks.meaning.words import DOES, UNKNOWN, words
from driveblocks.show.errata import corroborated
from driveblocks.show.faults import recorded
from driveblocks.show.layout import OWN, both, card, code_text, listed, listing
from driveblocks.show.registers import area_facts

_ACCESS = {"r": "read only", "w": "write only", "rw": "read and write"}


def page(drive: Drive, section: Section, row: Register, address: int) -> Iterator[RenderableType]:
    """One register with its bits, values, scale, errata, absences and example frames."""
    id_ = view.ids(row)[address - row.address.first]
    run = f"{span_text(row.address)}  {row.id or ''}".rstrip() if len(row.address) > 1 else None
    yield card(
        "  ".join(part for part in (drive.prefix, address_text(address), id_) if part),
        ("name", "(not used)" if row.unused else both(row.name, row.own)),
        ("printed", _printed(row)),
        ("one of", run),
        ("address", f"{wire_text(address)} = {wire(address)}"),
        ("use", None if row.unused else _ACCESS[row.access or section.access]),
        ("unit", _unit(row)),
        ("scale", _scale(row)),
        ("signed", "two's complement, -32768 to 32767" if row.signed else None),
        ("range", f"{row.range.min} to {row.range.max} (raw)" if row.range else None),
        ("commands", "\n".join(_commands(drive, row, address))),
        ("motor", "\n".join(_motor(drive, address))),
        ("never", "\n".join(f"bits {bits_text(one.bit)} = {one.equals}: {one.why}" for one in row.never)),
        ("pins", "\n".join(_shows(drive, address)) if drive.is_read(row) else None),
        ("RAM only", _ram_only(drive, address)),
        ("note", row.note),
        ("also says", corroborated(drive, row.corroborated)),
        ("section", both(section.title.en, section.title.own)),
        ("source", row.source or section.source),
        ("examples", _frames(drive, address)),
    )
    yield from _bits(row)
    yield from _values(row)
    yield from recorded(drive, "register", address)


def _ram_only(drive: Drive, address: int) -> str | None:
    """The address at which a write to the same parameter is not stored."""
    kept = any(address in span for span in drive.with_ram_bit)
    return f"{address_text(address + (drive.storage.add or 0))} is not stored" if kept else None


def area_page(drive: Drive, area: Area, address: int) -> Iterator[RenderableType]:
    """One address of an area: its number by the area's rule."""
    stored = address in area.addresses
    number = address - area.addresses.first - (0 if stored else drive.storage.add or 0)
    yield card(
        f"{drive.prefix}  {address_text(address)}",
        ("is", f"{area.numbered_by.replace('_', ' ')} {number} of: {both(area.name, area.own)}"),
        ("RAM only", None if stored else drive.storage.note),
    )
    yield Padding(area_facts(area), (0, 0, 1, 0))
    yield from recorded(drive, "register", address)
    yield from recorded(drive, "area", area.id)


def _printed(row: Register) -> str | None:
    parts = [row.printed.address, row.printed.id] if row.printed else []
    return "  ".join(part for part in (*parts, row.zh if row.zh_used else None) if part) or None


def _unit(row: Register) -> str | None:
    return row.unit if row.unit is None or row.scale else f"{row.unit}; the manual gives no scale"


def _count(row: Register, factor: Decimal) -> str:
    return f"{factor} {row.unit}" if row.unit else str(factor)


def _scale(row: Register) -> str | None:
    scale = row.scale
    if scale is None:
        return None
    when = f"\nonly while {of_condition(scale.when)}" if scale.when else ""
    when += f"\nonly while {scale.needs.setting} = {scale.needs.value}" if scale.needs else ""
    for one in scale.otherwise:
        while_ = f"while {of_condition(one.when)}" if one.when else "otherwise"
        when += f"\none count is {_count(row, one.factor)} {while_}  ({one.source})"
    proof = f"\nproved by the example frame {scale.proof}" if scale.proof else ""
    return f"one count is {_count(row, scale.factor)}{when}{proof}\n({scale.source})"


def _commands(drive: Drive, row: Register, address: int) -> Iterator[str]:
    if drive.register_at(row.address.first, "w") is not row:
        return
    for command in drive.operation.commands:
        does = command.does.replace("_", " ")
        for number, step in enumerate(command.first, 1):
            if step.register == address:
                yield f"{does}, write {number}: {_written(drive, step)}"
        if command.register == address:
            note = f" ({command.note})" if command.note else ""
            yield f"{does}: {_written(drive, command)}{note}"


def _motor(drive: Drive, address: int) -> Iterator[str]:
    """What bits and values of a command register do to the motor."""
    told = words(drive).at(address)
    for one in told.causes(UNKNOWN) if told else ():
        does = " and ".join(text for act, text in DOES.items() if act in one.effect.acts and one.effect.declared)
        by = f", by its {one.effect.by}" if one.effect.by == "edge" else ""
        if does:
            yield f"{one} {does}{by}{', whatever else is set' if one.effect.holds else ''}"


def value_text(drive: Drive, one: Command | Step) -> str:
    """The word that a command writes, in hexadecimal where its bits have names; nothing where it writes single bits."""
    row = drive.register_at(one.register, "w")
    if one.value is None:
        return ""
    return address_text(one.value) if row is not None and row.bits else str(one.value)


def _written(drive: Drive, one: Command | Step) -> str:
    parts = [f"write {value_text(drive, one)}"] if one.value is not None else []
    parts += [f"set bit {listed(map(bits_text, one.set))}"] if one.set else []
    parts += [f"clear bit {listed(map(bits_text, one.clear))}"] if one.clear else []
    return listed(parts)


def _shows(drive: Drive, address: int) -> Iterator[str]:
    """What a register shows on pins of the drive block."""
    operation = drive.operation
    for sign in (*status(drive).shown, *status(drive).forbids):
        some = [str(one) for one in sign.patterns if one.register == address]
        if some:
            yield f"{sign.name.replace('_', ' ')}: {' or '.join(some)}"
    yield from (one.shows.replace("_", " ") for one in operation.measures if one.register == address)
    if address == drive.faults.present:
        yield "fault code"
    if address in drive.warned:
        yield "warning code"
    yield from (f"state {one.name}: {of_condition(one)}" for one in operation.states if one.register == address)
    for what, told in (("bus in command", operation.commanded_by), ("identity", drive.identity)):
        asked = [str(of_condition(one)) for one in told.all if one.register == address] if told else []
        if asked:
            yield f"{what}: {' and '.join(asked)}"
    if operation.own_maximum is not None and operation.own_maximum.register == address:
        yield "own maximum frequency"


def _frames(drive: Drive, address: int) -> str:
    """Ids of the example frames that read or write a register."""
    found = []
    for frame in drive.frames:
        start, count = frame.means.address, frame.means.words or 1
        if start is not None and start <= address < start + count:
            found.append(frame.id)
    return listed(found)


def _bits(row: Register) -> Iterator[RenderableType]:
    if not row.bits:
        return
    columns = ("bit", "id", "name", OWN, "note")
    yield Padding(listing(columns, _bit_rows(row), ("name", OWN, "note")), (0, 0, 1, 0))


def _bit_rows(row: Register) -> Iterator[tuple[str, ...]]:
    for bit in row.bits:
        name = "(not used)" if bit.unused else bit.name or ""
        printed = f"printed {both(bit.printed.bit, bit.printed.id)}" if bit.printed else None
        misread = f"printed {bit.zh}" if bit.zh_used else None
        note = "; ".join(part for part in (bit.note, printed, misread) if part)
        yield bits_text(bit.bit), bit.id or "", name, bit.own, note
        for value in bit.values:
            yield f" ={value.value}", "", value.name, value.own, value.note or ""


def _values(row: Register) -> Iterator[RenderableType]:
    if not row.values:
        return
    if row.masks:
        yield "Each value is a single bit; the manual does not say whether they may combine."
    rows = ((str(value.value), _hex(value), value.name, value.own, value.note or "") for value in row.values)
    yield Padding(listing(("value", "hex", "name", OWN, "note"), rows, ("name", OWN, "note")), (0, 0, 1, 0))


def _hex(value: Value) -> str:
    return code_text(value.value & 0xFFFF)
