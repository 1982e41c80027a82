"""Rules on names and texts: the manual's own wording, one line, short enough."""

import re
from collections.abc import Iterator

from driveblocks.maps.model import Bit, Drive, Entry, Fault, Manual, Named, Register, Returned, Short, Text
from driveblocks.maps.problem import Place, Report

LONGEST = 80
"""Bytes of a text in a block: what an unsized STRING holds on every target."""

ENCODINGS = ("utf-8", "gb18030")
"""The encodings in which Chinese can be built; English beyond ASCII is UTF-8."""

_WORD = re.compile(r"[a-z]{3}")

Some = Named | Register | Bit | Text
"""What has words."""


def check(drive: Drive, report: Report) -> None:
    """Note every name or text that a block or a person could not use."""
    for entry in _inside(drive):
        if isinstance(entry, (Named, Register, Bit, Text)):
            key = "en" if isinstance(entry, Text) else "name"
            english: str | None = getattr(entry, key)
            _texts(entry, key, english, report)
            _wording(drive.manual, entry, key, english, report)
            if isinstance(entry, Named) or (isinstance(entry, Text) and _translated(drive, entry)):
                worded(drive.manual, entry, f"`{english}`", report)
    for returned in _returned(drive):
        lead = f"{returned.id} " if isinstance(returned, Fault) and returned.id else ""
        for language, text, place in _wordings(returned):
            _fits(language, lead + text, place, report)


def _returned(drive: Drive) -> Iterator[Returned | Bit]:
    """Every entry whose name a block returns as a text."""
    yield from (*drive.faults.codes, *drive.warning_codes)
    yield from drive.errors.codes
    for _, row in drive.registers():
        yield from row.values
        yield from (bit for bit in row.bits if bit.name)


def _wordings(entry: Returned | Bit) -> Iterator[tuple[str, str, Place]]:
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


def _translated(drive: Drive, text: Text) -> bool:
    """Whether a text reads otherwise in another language; names of makers do so where the script is another."""
    names = (drive.vendor, drive.family, drive.manual.publisher)
    return drive.manual.written_in == "zh" or not any(text is name for name in names)


def worded(manual: Manual, entry: Some, what: str, report: Report) -> None:
    """Note an entry in English that lacks the words of a manual in another language."""
    key = {"en": None, "zh": "zh"}.get(manual.written_in, "wording")
    if key is not None and getattr(entry, key) is None:
        other = "" if manual.language else ", or `language: en` under `manual`"
        wrong = f"{what} has no `{key}`: the manual's wording is missing"
        report.miss(entry.at, wrong, f"add `{key}` as the manual prints it{other}")


def _wording(manual: Manual, entry: Some, key: str, english: str | None, report: Report) -> None:
    if entry.wording is not None and manual.written_in == "zh":
        report.add(entry.place("wording"), "`wording` in the map of a Chinese manual", "write it to `zh`")
    if entry.wording is not None and entry.wording == english and manual.written_in == "en":
        report.add(entry.place("wording"), f"`wording` repeats the English `{key}`", "remove it")


def _inside(entry: Entry) -> Iterator[Entry]:
    yield entry
    for value in vars(entry).values():
        if isinstance(value, Entry):
            yield from _inside(value)
        elif isinstance(value, tuple):
            for item in value:
                if isinstance(item, Entry):
                    yield from _inside(item)


def _texts(entry: Some, key: str, english: str | None, report: Report) -> None:
    if english and ("\n" in english or "\r" in english):
        report.add(entry.place(key), "this name has several lines", "write it on one line")
    if entry.zh_used is not None and entry.zh is None:
        report.miss(entry.place("zh_used"), "`zh_used` without `zh`", "add `zh` as the manual prints it")
    if entry.zh_used is not None and entry.zh_used == entry.zh:
        report.add(entry.place("zh_used"), "`zh_used` repeats `zh`", "remove it, or write what is printed into `zh`")
    if english is not None and entry.zh == english and _WORD.search(english):
        wrong = f"`zh` repeats the English `{key}`: the manual's wording is missing"
        report.add(entry.place("zh"), wrong, "write `zh` as the manual prints it")
