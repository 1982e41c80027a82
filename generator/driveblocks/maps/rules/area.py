"""Rules on areas, which give parameter registers by a rule, and on what happens to a written parameter."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.model import Area, AreaExample, Drive, Storage
from driveblocks.maps.problem import Place, Report, line
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.parameter import of_form
from driveblocks.maps.rules.unique import overlapping, unique

_STORAGE_KEYS = {
    "enter_register": ("register", "value"),
    "ram_address_bit": ("add", "area"),
    "ram_twin": ("twins",),  # those of `twin_ranges`, too
    "volatile": (),
    "unexplained": (),
}
_Claim = tuple[Place, str]
"""Who has a span of addresses: the place of a message, and the words for it."""


def check(drive: Drive, report: Report) -> None:
    unique(drive.areas, "id", "area", report)
    for area in drive.areas:
        for example in area.examples:
            _example(drive, area, example, report)
    _spans(drive, report)
    _storage_keys(drive.storage, report)
    _storage(drive, drive.storage, report)


def _claims(drive: Drive) -> Iterator[tuple[Span, _Claim]]:
    for area in drive.areas:
        yield area.addresses, (area.place("addresses"), f"area `{area.id}`")
    kind = "area" if any(area.id == drive.storage.area for area in drive.areas) else "section"
    for alias in drive.ram_only:
        yield alias, (drive.storage.place("add"), f"the RAM-only part of {kind} `{drive.storage.area}`")


def _spans(drive: Drive, report: Report) -> None:
    claims = list(_claims(drive))
    for span, (place, what) in claims:
        if span.first > span.last:
            report.add(place, f"range {span_text(span)} runs backwards", "write the smaller address first")
        if span.last > 0xFFFF:
            report.add(place, f"{what} runs past FFFFH", "an address has 16 bits")
    rows: list[tuple[Span, _Claim]] = [
        (row.address, (row.place("address"), f"register {span_text(row.address)} in {line(row.at)}"))
        for _, row in drive.registers()
    ]
    starts = {id(claim) for _, claim in claims}
    for earlier, later in overlapping([*rows, *claims]):
        if id(later) in starts:
            report.add(later[0], f"{later[1]} collides with {earlier[1]}", "an address belongs to one row or one area")


def _example(drive: Drive, area: Area, example: AreaExample, report: Report) -> None:
    of_form(drive, example, example.id, report)
    due = area.addresses.first + example.number
    offset = drive.storage.add if any(example.address in span for span in drive.ram_only) else 0
    if example.address != due + (offset or 0):
        wrong = f"{example.id} has number {example.number} and address {address_text(example.address)}"
        report.add(example.place("address"), wrong, f"by the area's rule it is {address_text(due)}")
    if area.addresses and example.address - (offset or 0) not in area.addresses:
        wrong = f"{address_text(example.address)} lies outside the area"
        report.add(example.place("address"), wrong, f"the area has {span_text(area.addresses)}")


def _storage_keys(storage: Storage, report: Report) -> None:
    needed = _STORAGE_KEYS[storage.method]
    for key in needed:
        if getattr(storage, key) in (None, ()):
            wrong = f"`method: {storage.method}` has no `{key}`"
            report.miss(storage.at, wrong, f"it needs {' and '.join(needed)}")
    for method, keys in _STORAGE_KEYS.items():
        for key in keys:
            if method != storage.method and getattr(storage, key) not in (None, ()):
                wrong = f"`{key}` does not belong to `method: {storage.method}`"
                report.add(storage.place(key), wrong, f"remove it, or write `method: {method}`")


def _storage(drive: Drive, storage: Storage, report: Report) -> None:
    if storage.register is not None:
        row = known(drive, storage.register, "w", storage.place("register"), report)
        allowed = row.range if row is not None else None
        if allowed is not None and storage.value is not None and not allowed.holds(storage.value):
            wrong = f"{storage.value} is outside the range of {address_text(storage.register)}"
            report.add(storage.place("value"), wrong, f"it holds {allowed.min} to {allowed.max}")
    _twins(drive, storage, report)
    named = {*(area.id for area in drive.areas), *(section.id for section in drive.sections)}
    if storage.area is not None and storage.area not in named:
        wrong = f"there is no area `{storage.area}`"
        report.miss(storage.place("area"), wrong, "name an entry of `areas` or `sections`")
    elif storage.area is not None and storage.add is not None:
        _address_bit(drive, storage.add, storage.place("add"), report)


def _twins(drive: Drive, storage: Storage, report: Report) -> None:
    twice = [address for twin in storage.twins for address in (twin.stored, twin.ram)]
    for twin in storage.twins:
        for key, address in (("stored", twin.stored), ("ram", twin.ram)):
            known(drive, address, "w", twin.place(key), report)
            if twice.count(address) > 1:
                report.add(twin.place(key), f"{address_text(address)} is there twice", "name each register once")
    for each in storage.twin_ranges:
        if len(each.stored) != len(each.ram):
            report.add(
                each.at, "the two ranges have not one length", "each register has its twin as far into the other"
            )
        elif not any(each.stored.first <= twin.stored <= each.stored.last for twin in storage.twins):
            report.miss(each.place("stored"), "the map lists no register of this range", "list those that are written")


def _address_bit(drive: Drive, add: int, place: Place, report: Report) -> None:
    last = max(drive.with_ram_bit, key=lambda span: span.last, default=None)
    if last is None:
        report.add(place, f"`{drive.storage.area}` has no register that may be written", "name another section")
    elif add == 0 or add & (add - 1) or last.last >= add:
        wrong = f"{address_text(add)} is not an address bit above {span_text(last)}"
        report.add(place, wrong, "write one bit that no address of the area has, such as 8000H")
