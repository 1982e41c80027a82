"""Rules on names and texts: both languages, one line, and a sound identifier for what becomes a pin."""

import re
from collections.abc import Iterator

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Bit, Drive, Entry, Named, Register, Text
from driveblocks.maps.problem import Report

_WORD = re.compile(r"[a-z]{3}")
_NOT_LETTERS = re.compile(r"[^A-Z0-9]+")


def check(drive: Drive, report: Report) -> None:
    """Note every name or text that a block or a person could not use."""
    for entry in _inside(drive):
        if isinstance(entry, (Named, Register, Bit)):
            _texts(entry, "name", entry.name, report)
        elif isinstance(entry, Text):
            _texts(entry, "en", entry.en, report)
    for _, row in drive.registers():
        _identifiers(row, report)


def _inside(entry: Entry) -> Iterator[Entry]:
    """An entry and every entry in it."""
    yield entry
    for value in vars(entry).values():
        if isinstance(value, Entry):
            yield from _inside(value)
        elif isinstance(value, tuple):
            for item in value:
                if isinstance(item, Entry):
                    yield from _inside(item)


def _texts(entry: Named | Register | Bit | Text, key: str, english: str | None, report: Report) -> None:
    if key == "name" and english and "\n" in english:
        report.add(entry.place(key), "this name has several lines", "write it on one line")
    if entry.zh_used is not None and entry.zh is None:
        report.miss(entry.place("zh_used"), "`zh_used` without `zh`", "add `zh` as the manual prints it")
    if entry.zh_used is not None and entry.zh_used == entry.zh:
        report.add(entry.place("zh_used"), "`zh_used` repeats `zh`", "remove it, or write what is printed into `zh`")
    if english is not None and entry.zh == english and _WORD.search(english):
        wrong = f"`zh` repeats the English `{key}`: the manual's wording is missing"
        report.add(entry.place("zh"), wrong, "write `zh` as the manual prints it")


def identifier(name: str) -> str:
    """What is left of a name in an identifier, whose case does not matter: `External fault 1` -> EXTERNALFAULT1."""
    return _NOT_LETTERS.sub("", name.upper())


def _identifiers(row: Register, report: Report) -> None:
    seen: dict[str, Bit] = {}
    named: tuple[Register | Bit, ...] = (row, *row.bits)
    for entry in named:
        if entry.name and not entry.symbol and not identifier(entry.name)[:1].isalpha():
            wrong = f"`{entry.name}` cannot become an identifier"
            report.add(entry.place("name"), wrong, "start the name with a letter A to Z, or add a `symbol`")
    for bit in row.bits:
        if not bit.name:
            continue
        other = seen.setdefault(identifier(bit.symbol or bit.name), bit)
        if other is not bit:
            wrong = f"`{bit.name}` makes the same identifier as line {other.at[0]} of {address_text(row.address.first)}"
            report.add(bit.place("name"), wrong, "give each bit of a register its own name or `symbol`")
