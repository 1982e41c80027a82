"""Rules on names and texts: both languages, one line, short enough, and a sound identifier for what becomes a pin."""

import re
from collections.abc import Iterator

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Bit, Drive, Entry, Named, Register, Short, Text, Worded
from driveblocks.maps.problem import Place, Report

LONGEST = 80
"""Bytes of a text in a block: what an unsized STRING holds on every target."""

ENCODINGS = ("utf-8", "gb18030")
"""The encodings in which Chinese can be built; English stays within ASCII."""

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
    for worded in _returned(drive):
        for language, text, place in _wordings(worded):
            _fits(language, text, place, report)


def _returned(drive: Drive) -> Iterator[Worded | Bit]:
    """Every entry whose name a block returns as a text."""
    yield from drive.faults.codes
    yield from drive.errors.codes
    for _, row in drive.registers():
        yield from row.values
        yield from (bit for bit in row.bits if bit.name)


def _wordings(entry: Worded | Bit) -> Iterator[tuple[str, str, Place]]:
    """Language, text and place of what the blocks return: the short wording where there is one."""
    short = entry.short or Short()
    yield ("en", short.en, short.place("en")) if short.en else ("en", entry.name or "", entry.place("name"))
    zh = entry.place("zh_used" if entry.zh_used else "zh")
    yield ("zh", short.zh, short.place("zh")) if short.zh else ("zh", entry.text_zh or "", zh)


def _fits(language: str, text: str, place: Place, report: Report) -> None:
    for encoding in ENCODINGS:
        length = len(text.encode(encoding))
        if length > LONGEST:
            wrong = f"this text has {length} bytes in {encoding.upper()}, and a block returns at most {LONGEST}"
            report.add(place, wrong, f"write a shorter wording under `short: {{{language}: ...}}`")
            return


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
