"""Texts of faults, errors, bits and values in English and Chinese; None where the map has no such code."""

from collections.abc import Iterable
from typing import NamedTuple

from driveblocks.maps.model import Bit, Drive, ErrorCode, Fault, Returned, Worded


class Texts(NamedTuple):
    """A text in both languages."""

    en: str
    zh: str


def has(drive: Drive, suffix: str, entries: Iterable[Worded]) -> bool:
    """Whether a function has some entries in En or Zh: Chinese needs the manual's, or that of one of them."""
    return suffix == "En" or drive.manual.written_in == "zh" or any(one.zh is not None for one in entries)


UNKNOWN = Texts("unknown code", "未知代码")


def of(entry: Returned | Bit) -> Texts:
    """What a block returns for an entry: per language the short wording, else the full one."""
    name, zh = entry.name or "", entry.text_zh or entry.name or ""
    return Texts(name, zh) if entry.short is None else Texts(entry.short.en or name, entry.short.zh or zh)


UNREAD = Texts("code not read yet", "代码尚未读取")


def fault(drive: Drive, code: int) -> Texts | None:
    """The text of a fault code; 0 is none of most drives, and what a block shows until it has read one."""
    return _displayed(drive.faults.codes, code) or (None if code else UNREAD)


def warning(drive: Drive, code: int) -> Texts | None:
    """The text of a warning code, likewise."""
    return _displayed(drive.warnings.codes if drive.warnings else (), code)


def _displayed(codes: Iterable[Fault], code: int) -> Texts | None:
    found = next((one for one in codes if one.code == code), None)
    if found is None or not found.id:
        return of(found) if found else None
    return Texts(*(f"{found.id} {each}" for each in of(found)))


def error(drive: Drive, code: int) -> Texts | None:
    return _first(of(one) for one in drive.errors.codes if error_number(one) == code)


def error_number(entry: ErrorCode) -> int | None:
    """The printed code, or where none is printed the first number that another document gives."""
    if entry.code is not None:
        return entry.code
    return next((one.value for one in entry.corroborated if one.value is not None), None)


def bit(drive: Drive, address: int, number: int) -> Texts | None:
    """The text of a bit; a field is known by its lowest bit."""
    row = drive.register_at(address)
    if row is None or row.address.first != address:
        return None
    return _first(of(one) for one in row.bits if one.name and one.bit.first == number)


def value(drive: Drive, address: int, number: int) -> Texts | None:
    row = drive.register_at(address)
    if row is None or row.address.first != address:
        return None
    return _first(of(one) for one in row.values if one.value == number)


def _first(found: Iterable[Texts]) -> Texts | None:
    return next(iter(found), None)
