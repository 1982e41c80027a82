"""What an address is good for: reading, writing, or nothing."""

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive, Register, Use
from driveblocks.maps.problem import Place, Report

_VERBS = {"r": "read", "w": "written"}


def known(drive: Drive, address: int, use: Use, place: Place, report: Report) -> Register | None:
    """The row of an address that is to be read (`r`) or written (`w`); notes what forbids it."""
    found = drive.row_at(address, use)
    if found is None:
        report.miss(place, f"{address_text(address)} is in no register table", "name a listed register")
        return None
    section, row = found
    if row.unused:
        report.add(place, f"{address_text(address)} is unused", "name a register in use")
    elif use not in (row.access or section.access):
        wrong = f"{address_text(address)} cannot be {_VERBS[use]}"
        report.add(place, wrong, "name another register, or correct its `access`")
    else:
        return row
    return None


def cyclic(drive: Drive, address: int, place: Place, report: Report) -> Register | None:
    """The row of an address that is written again and again; notes what forbids it, a store first of all."""
    stored = _stored(drive, address)
    if stored is None:
        return known(drive, address, "w", place, report)
    wrong = f"{address_text(address)} is written again and again, and {stored}"
    report.add(place, wrong, "name a register whose writes stay in RAM")
    return None


def _stored(drive: Drive, address: int) -> str | None:
    """Why a write to an address ends in EEPROM, or counts as if it did; None where it stays in RAM."""
    storage, unexplained = drive.storage, drive.storage.method in ("unexplained", "ram_twin")
    if address == storage.register:
        return "a write there stores all parameters"
    for twin in storage.twins:
        if address == twin.ram:
            return None
        if address == twin.stored:
            return f"a write there is stored; {address_text(twin.ram)} is its twin in RAM"
    area = next((area.id for area in drive.areas if unexplained and address in area.addresses), None)
    if any(address in span for span in drive.with_ram_bit):
        area = storage.area
    if area is not None:
        return f"the area `{area}` is stored in EEPROM" + " as far as the manual says" * unexplained
    row = drive.register_at(address, "w")
    if unexplained and row is not None and row.id is not None:
        return f"the parameter {row.id} is stored in EEPROM as far as the manual says"
    return None


def carried(drive: Drive, address: int, use: Use, place: Place, report: Report) -> Register | None:
    """The row of an address that a frame reads or writes, None in an area; notes what forbids it."""
    if any(address in span for span in drive.ram_only):
        if use == "r" and not drive.storage.readable:
            wrong = f"{address_text(address)} is a RAM-only address, which cannot be read"
            report.add(place, wrong, "correct the frame, or `readable` under `storage`")
        return None
    for area in drive.areas:
        if address in area.addresses:
            if use not in area.access:
                wrong = f"{address_text(address)} cannot be {_VERBS[use]}"
                report.add(place, wrong, f"correct the frame, or the access of area `{area.id}`")
            return None
    return known(drive, address, use, place, report)
