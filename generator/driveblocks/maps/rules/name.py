"""Rules on names and texts: both languages, one line."""

import re
from collections.abc import Iterator

from driveblocks.maps.model import Bit, Drive, Entry, Named, Register, Text
from driveblocks.maps.problem import Report

_WORD = re.compile(r"[a-z]{3}")


def check(drive: Drive, report: Report) -> None:
    """Note every name or text that a block or a person could not use."""
    for entry in _inside(drive):
        if isinstance(entry, (Named, Register, Bit)):
            _texts(entry, "name", entry.name, report)
        elif isinstance(entry, Text):
            _texts(entry, "en", entry.en, report)


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
