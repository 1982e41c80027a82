"""Rules on parameter ids and on series of ids."""

import re
from collections.abc import Iterator
from functools import cache, lru_cache

from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive, Entry, Register, Section, Series
from driveblocks.maps.problem import Report, line
from driveblocks.maps.rules.unique import overlapping

_CLASSES = {"A": "[A-Z]", "a": "[a-z]", "9": "[0-9]", "X": "[A-Z0-9]"}
_NUMBERED = re.compile(r"(.*?)([0-9]+)")


def check(drive: Drive, report: Report) -> None:
    if not drive.id_forms:
        right = "write the form of the manual's ids, such as A9-99 for H5-01"
        report.add(drive.place("id_forms"), "`id_forms` is empty", right)
    for _, row in drive.registers():
        if row.id is not None:
            of_form(drive, row, row.id, report)
            _id_range(row, report)
    _twice(drive, report)
    for section in drive.sections:
        for series in section.series:
            _series(series, section, report)


@cache
def _pattern(forms: tuple[str, ...]) -> re.Pattern[str]:
    parts = ["".join(_CLASSES.get(char, re.escape(char)) for char in one) for one in forms]
    return re.compile("|".join(parts))


def of_form(drive: Drive, entry: Entry, id_: str, report: Report, key: str = "id") -> None:
    """Note an id, or an end of a range of ids, that has none of the manual's forms."""
    if drive.id_forms and not all(_pattern(drive.id_forms).fullmatch(part) for part in id_.split("..")):
        forms = ", ".join(drive.id_forms)
        wrong = f"id `{id_}` has none of the manual's forms"
        report.add(entry.place(key), wrong, f"the forms are {forms}; a misprint goes under `printed:`")


@lru_cache(4096)
def numbered(id_: str) -> tuple[str, int]:
    """`U1-07` -> (`U1-`, 7); a text that does not end in digits -> (text, 0)."""
    match = _NUMBERED.fullmatch(id_)
    return (match[1], int(match[2])) if match else (id_, 0)


def _run(ids: str) -> tuple[str, Span, bool]:
    """Group and numbers of a range of ids or of one id, and whether both ends have the same group."""
    first, _, last = ids.partition("..")
    group, low = numbered(first)
    end_group, high = numbered(last or first)
    return group, Span(low, high), group == end_group


def _id_range(row: Register, report: Report) -> None:
    _, numbers, one_group = _run(row.id or "")
    if not one_group:
        report.add(row.place("id"), f"`{row.id}` joins two groups", "write one row per group")
    elif numbers.first > numbers.last:
        report.add(row.place("id"), f"`{row.id}` runs backwards", "write the smaller number first")
    elif numbers.last - numbers.first + 1 != len(row.address):
        ids = _count(numbers.last - numbers.first + 1, "id")
        wrong = f"{ids} for {_count(len(row.address), 'register')}"
        report.add(row.place("id"), wrong, "a range of ids needs a range of addresses of the same length")


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'s' * (number != 1)}"


def _twice(drive: Drive, report: Report) -> None:
    groups: dict[str, list[tuple[Span, Register]]] = {}
    for _, row in drive.registers():
        if row.id is not None:
            group, numbers, _ = _run(row.id)
            groups.setdefault(group, []).append((numbers, row))
    for rows in groups.values():
        for earlier, later in overlapping(rows):
            wrong = f"id `{later.id}` is taken by {line(earlier.at)}"
            right = "one row per id; if the manual misprints it, use the right one and `printed:`"
            report.add(later.place("id"), wrong, right)


def _series(series: Series, section: Section, report: Report) -> None:
    group, numbers, one_group = _run(series.ids)
    if not one_group or not numbers:
        right = "write the first and the last, such as U1-01..U1-28"
        report.add(series.place("ids"), f"`{series.ids}` is no run of ids", right)
        return
    rows = list(_rows(section, group, numbers))
    _places(series, section, group, numbers, report)
    for number, row in rows:
        _follows(series, row, series.base + number - numbers.first, report)
    if not rows:
        wrong = f"no register of this section belongs to `{series.ids}`"
        report.miss(series.place("ids"), wrong, "name ids of this section")
    for id_ in sorted(set(series.apart) - {row.id for _, row in rows}):
        wrong = f"`{id_}` is named as apart, but no row of this section has it in `{series.ids}`"
        report.miss(series.place("apart"), wrong, "name an id of the series, or remove it")


def _places(series: Series, section: Section, group: str, numbers: Span, report: Report) -> None:
    """Note a row that is where the series has the place of another id: it has lost its own."""
    apart = {numbered(id_) for id_ in series.apart}
    digits = len(series.ids.partition("..")[0]) - len(group)
    for row in section.registers:
        number = numbers.first + row.address.first - series.base
        row_group, own = numbered((row.id or "").partition("..")[0])
        if number not in numbers or (row_group == group and own in numbers):
            continue
        if (group, number) not in apart:
            wrong = f"{address_text(row.address.first)} is the place of {group}{number:0{digits}d} in {series.ids}"
            report.add(row.at, wrong, f"this row has {row.id or 'no id'}; correct it, or name the id under `apart`")


def _rows(section: Section, group: str, numbers: Span) -> Iterator[tuple[int, Register]]:
    for row in section.registers:
        if row.id is not None and row.id.startswith(group):
            row_group, number = numbered(row.id.partition("..")[0])
            if row_group == group and number in numbers:
                yield number, row


def _follows(series: Series, row: Register, due: int, report: Report) -> None:
    if row.id in series.apart:
        if row.address.first == due:
            wrong = f"{row.id} is named as apart, but is in the series"
            report.add(series.place("apart"), wrong, "remove it from `apart`")
    elif row.address.first != due:
        stands, put = address_text(row.address.first), address_text(due)
        wrong = f"{row.id} is at {stands}, but the series {series.ids} puts it at {put}"
        report.add(row.place("address"), wrong, "correct the address, or name the id under `apart` of the series")
