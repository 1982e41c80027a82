"""Rules on parameter ids, series of ids, areas and storage."""

import re
from functools import cache

from driveblocks.maps.form import Span, address_text, span_text
from driveblocks.maps.model import Area, Drive, Entry, Register, Series, Storage
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules.register import alias_spans

_CLASSES = {"A": "[A-Z]", "9": "[0-9]", "X": "[A-Z0-9]"}
_NUMBER = re.compile(r"(.*?)([0-9]+)")
_STORAGE_KEYS = {
    "enter_register": ("register", "value"),
    "ram_address_bit": ("add", "area"),
    "unexplained": (),
}


def check(drive: Drive, report: Report) -> None:
    """Note every rule that ids, series, areas or storage break."""
    _ids(drive, report)
    for section in drive.sections:
        for series in section.series:
            _series(series, section.registers, report)
    _areas(drive, report)
    _storage(drive, drive.storage, report)


@cache
def _pattern(forms: tuple[str, ...]) -> re.Pattern[str]:
    parts = ["".join(_CLASSES.get(char, re.escape(char)) for char in one) for one in forms]
    return re.compile("|".join(parts))


def of_form(drive: Drive, id_: str) -> bool:
    """Whether an id, or both ends of a range of ids, has one of the manual's forms."""
    return all(_pattern(drive.id_forms).fullmatch(part) for part in id_.split(".."))


def _form(drive: Drive, entry: Entry, key: str, id_: str, report: Report) -> None:
    if not of_form(drive, id_):
        forms = ", ".join(drive.id_forms)
        report.add(
            entry.place(key),
            f"id `{id_}` has none of the manual's forms",
            f"the forms are {forms}; `printed:` keeps a misprint",
        )


def _ids(drive: Drive, report: Report) -> None:
    seen: dict[str, Register] = {}
    for _, row in drive.registers():
        if row.id is None:
            continue
        _form(drive, row, "id", row.id, report)
        _id_range(row, report)
        if row.id in seen:
            wrong = f"id `{row.id}` is taken by line {seen[row.id].at[0]}"
            report.add(
                row.place("id"), wrong, "one row per id; if the manual misprints it, use the right one and `printed:`"
            )
        seen[row.id] = row


def _id_range(row: Register, report: Report) -> None:
    first, _, last = (row.id or "").partition("..")
    count = _numbered(last)[1] - _numbered(first)[1] + 1 if last else 1
    if last and _numbered(first)[0] != _numbered(last)[0]:
        report.add(row.place("id"), f"`{row.id}` joins two groups", "write one row per group")
    elif count != len(row.address):
        wrong = f"{count} id{'s' * (count != 1)} for {len(row.address)} register{'s' * (len(row.address) != 1)}"
        report.add(row.place("id"), wrong, "a range of ids needs a range of addresses of the same length")


def _numbered(id_: str) -> tuple[str, int]:
    """`U1-07` -> (`U1-`, 7); a text that does not end in digits -> (text, 0)."""
    match = re.fullmatch(r"(.*?)([0-9]+)", id_)
    return (match[1], int(match[2])) if match else (id_, 0)


def _series(series: Series, rows: tuple[Register, ...], report: Report) -> None:
    first, _, last = series.ids.partition("..")
    group, low = _numbered(first)
    end_group, high = _numbered(last or first)
    if group != end_group or high < low:
        report.add(
            series.place("ids"),
            f"`{series.ids}` is no run of ids",
            "write the first and the last, such as U1-01..U1-28",
        )
        return
    found = False
    for row in rows:
        row_group, number = _numbered((row.id or "").partition("..")[0])
        if row.id is None or row_group != group or not low <= number <= high:
            continue
        found = True
        _follows(series, row, series.base + number - low, report)
    if not found:
        report.add(
            series.place("ids"), f"no register of this section belongs to `{series.ids}`", "name ids of this section"
        )


def _follows(series: Series, row: Register, due: int, report: Report) -> None:
    if row.id in series.apart:
        if row.address.first == due:
            report.add(
                series.place("apart"), f"{row.id} is named as apart, but stands in the series", "remove it from `apart`"
            )
    elif row.address.first != due:
        stands, put = address_text(row.address.first), address_text(due)
        wrong = f"{row.id} stands at {stands}, but the series {series.ids} puts it at {put}"
        report.add(row.place("address"), wrong, "correct the address, or name the id under `apart` of the series")


def _areas(drive: Drive, report: Report) -> None:
    for area in drive.areas:
        _examples(drive, area, report)
    spans = list(alias_spans(drive))
    for index, (place, span, what) in enumerate(spans):
        if span.first > span.last:
            report.add(place, f"range {span_text(span)} runs backwards", "write the smaller address first")
        if span.last > 0xFFFF:
            report.add(place, f"{what} run past FFFFH", "addresses are 16 bits")
        _collisions(drive, (place, span, what), spans[:index], report)


def _collisions(
    drive: Drive, here: tuple[Place, Span, str], before: list[tuple[Place, Span, str]], report: Report
) -> None:
    place, span, what = here
    row = next((row for _, row in drive.registers() if row.address.overlaps(span)), None)
    if row is not None:
        wrong = f"{what} ({span_text(span)}) collides with register {span_text(row.address)} in line {row.at[0]}"
        report.add(place, wrong, "an address belongs either to a row or to an area")
    for _, other, name in before:
        if other.overlaps(span):
            report.add(place, f"{what} ({span_text(span)}) collides with {name}", "areas do not overlap")


def _examples(drive: Drive, area: Area, report: Report) -> None:
    for example in area.examples:
        _form(drive, example, "id", example.id, report)
        due = area.addresses.first + example.number
        if example.address != due:
            wrong = f"{example.id} has number {example.number} and address {address_text(example.address)}"
            report.add(example.place("address"), wrong, f"by the area's rule it is {address_text(due)}")
        if example.address not in area.addresses:
            report.add(
                example.place("address"),
                f"{address_text(example.address)} lies outside the area",
                "widen the area or correct it",
            )


def _storage(drive: Drive, storage: Storage, report: Report) -> None:
    needed = _STORAGE_KEYS[storage.method]
    for key in needed:
        if getattr(storage, key) is None:
            report.add(storage.at, f"`method: {storage.method}` has no `{key}`", f"it needs {' and '.join(needed)}")
    for keys in _STORAGE_KEYS.values():
        for key in keys:
            if key not in needed and getattr(storage, key) is not None:
                report.add(storage.place(key), f"`{key}` does not belong to `method: {storage.method}`", "remove it")
    if storage.register is not None and drive.register_at(storage.register) is None:
        report.add(
            storage.place("register"),
            f"{address_text(storage.register)} is in no register table",
            "name a listed register",
        )
    if storage.area is not None and storage.area not in {area.id for area in drive.areas}:
        report.add(storage.place("area"), f"there is no area `{storage.area}`", "name an entry of `areas`")
