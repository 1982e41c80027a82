"""What a map says by a rule, as if it said it of each: twins of registers in RAM, and the profile that it describes."""

from dataclasses import replace

from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Drive, Register, Section, Twin, TwinRange


def derived(drive: Drive) -> Drive:
    """The same map with a row for each twin in RAM, and with its profile among what is read before a start."""
    return _profiled(_twinned(drive))


def _twinned(drive: Drive) -> Drive:
    pairs = [
        (section, row, each)
        for section, row in drive.registers()
        for each in drive.storage.twin_ranges
        if row.address.first in each.stored and "w" in (row.access or section.access) and not row.unused
    ]
    if not pairs:
        return drive
    twins = [
        Twin(stored=address, ram=_moved(address, each), at=each.at) for _, row, each in pairs for address in row.address
    ]
    made = {id(section): [_ram(row, each) for of, row, each in pairs if of is section] for section, _, _ in pairs}
    sections = tuple(_with(section, made.get(id(section), [])) for section in drive.sections)
    return replace(drive, sections=sections, storage=replace(drive.storage, twins=(*drive.storage.twins, *twins)))


def _moved(address: int, by: TwinRange) -> int:
    return by.ram.first + (address - by.stored.first)


def _with(section: Section, rows: list[Register]) -> Section:
    return replace(section, registers=(*section.registers, *rows)) if rows else section


def _ram(row: Register, by: TwinRange) -> Register:
    """The row of the same value in RAM, which is written and not read."""
    return replace(
        row,
        address=Span(_moved(row.address.first, by), _moved(row.address.last, by)),
        id=None,
        name=f"{row.name} in RAM",
        zh=f"{row.zh} (RAM)" if row.zh else None,
        zh_used=None,
        access="w",
        values=(),
        bits=(),
        printed=None,
        symbol=f"{row.symbol}Ram" if row.symbol else None,
        corroborated=(),
    )


def _profiled(drive: Drive) -> Drive:
    """A profile is read as what gives the reference its meaning is: nothing starts while it is another."""
    one, operation = drive.profile, drive.operation
    address = next((each.register for each in drive.settings if one and each.id == one.setting), None)
    if one is None or address is None:
        return drive
    read = Condition(register=address, equals=one.value, at=one.at, keys={"register": one.place("setting")})
    reference = replace(operation.reference, verify=(*operation.reference.verify, read))
    return replace(drive, operation=replace(operation, reference=reference))
