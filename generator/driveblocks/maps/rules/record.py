"""Rules on what is recorded about the manual: errata, absences, documents, and what every entry refers to."""

import re
from collections.abc import Iterator

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Absence, Corroboration, Drive, Entry, Notice, Register
from driveblocks.maps.problem import Place, Report

_SINGLE = ("prose", "serial", "storage", "operation", "broadcast", "errors", "faults", "limits", "manual", "silence")
_NUMBER = re.compile(r"-?[0-9]+|[0-9A-F]+H")
_ADDRESSES = re.compile(r"([0-9A-F]{4})H(?:-([0-9A-F]{4})H)?")
_BIT = re.compile(r"([0-9A-F]{4})H\.([0-9A-F])(?:-([0-9A-F]))?")


def check(drive: Drive, report: Report) -> None:
    """Note every misprint without erratum, every reference into nothing, every unused document."""
    known = _Known(drive)
    covered: set[str] = set()
    for erratum in drive.errata:
        _twice(erratum.about, erratum.place("about"), report)
        for ref in erratum.about:
            covered.update(known.resolve(ref, erratum.place("about"), report))
    others: tuple[Absence | Notice, ...] = (*drive.absent, *drive.notices)
    for entry in others:
        for ref in entry.about:
            known.resolve(ref, entry.place("about"), report)
    _uncovered(drive, covered, report)
    _repeated(drive, report)
    _documents(drive, report)


class _Known:
    """What references may name: `kind name` -> whether it exists."""

    def __init__(self, drive: Drive) -> None:
        self.drive = drive
        self.rows: dict[int, Register] = {a: row for _, row in drive.registers() for a in row.address}
        self.names = {
            "frame": {frame.id for frame in drive.frames},
            "setting": {setting.id for setting in drive.settings},
            "section": {section.id for section in drive.sections},
            "area": {area.id for area in drive.areas},
            "limit": {"read_words", "write_words", "data_bytes", "ascii_data_bytes"},
        }
        self.numbers: dict[str, set[int | None]] = {
            "fault": {fault.code for fault in drive.faults.codes},
            "error": {error.code for error in drive.errors.codes},
            "function": {function.code for function in drive.functions},
        }

    def resolve(self, ref: str, place: Place, report: Report) -> list[str]:
        """The canonical names that a reference covers; notes one that names nothing."""
        kind, _, name = ref.partition(" ")
        found = self._of(kind, name)
        if not found:
            kinds = ("register", "bit", *self.numbers, *self.names, *_SINGLE)
            if kind not in kinds:
                report.add(place, f"`{ref}` is no reference", "start it with one of " + ", ".join(kinds))
            else:
                report.add(place, f"`{ref}` names nothing in this map", f"name an existing {kind}, as `{kind} ...`")
        return found

    def _of(self, kind: str, name: str) -> list[str]:
        if kind in _SINGLE:
            return [kind] if not name else []
        if kind == "register":
            return self._registers(name)
        if kind == "bit":
            return self._bits(name)
        if kind in self.numbers and _NUMBER.fullmatch(name):
            number = int(name[:-1], 16) if name.endswith("H") else int(name)
            return [f"{kind} {number}"] if number in self.numbers[kind] else []
        return [f"{kind} {name}"] if name in self.names.get(kind, set()) else []

    def _registers(self, name: str) -> list[str]:
        match = _ADDRESSES.fullmatch(name)
        if match is None:
            return []
        first, last = int(match[1], 16), int(match[2] or match[1], 16)
        found = [self.rows[address] for address in range(first, last + 1) if address in self.rows]
        missing = first not in self.rows and not any(first in area.addresses for area in self.drive.areas)
        if missing or last < first:
            return []
        return [f"register {address_text(row.address.first)}" for row in found] or [f"register {name}"]

    def _bits(self, name: str) -> list[str]:
        match = _BIT.fullmatch(name)
        row = self.rows.get(int(match[1], 16)) if match else None
        if match is None or row is None:
            return []
        low, high = int(match[2], 16), int(match[3] or match[2], 16)
        spans = [bit.bit for bit in row.bits if bit.bit.first <= high and low <= bit.bit.last]
        return [f"bit {match[1]}H.{bits_text(span)}" for span in spans]


def _twice(refs: tuple[str, ...], place: Place, report: Report) -> None:
    for ref in sorted({ref for ref in refs if refs.count(ref) > 1}):
        report.add(place, f"`{ref}` stands twice in one list", "keep one of them")
    if not refs:
        report.add(place, "an erratum about nothing", "name what it is about, or write `[prose]`")


def _misprints(drive: Drive) -> Iterator[tuple[str, Place]]:
    """Every entry that departs from what is printed, by canonical name."""
    for _, row in drive.registers():
        yield from _row_misprints(row)
    for fault in drive.faults.codes:
        if fault.printed_code is not None or fault.zh_used is not None:
            yield f"fault {fault.code}", fault.at
    for error in drive.errors.codes:
        if error.zh_used is not None and error.code is not None:
            yield f"error {error.code}", error.at
    for setting in drive.settings:
        if setting.zh_used is not None:
            yield f"setting {setting.id}", setting.at
    for frame in drive.frames:
        if frame.printed != frame.correct or (frame.plc is not None and frame.plc.printed):
            yield f"frame {frame.id}", frame.at


def _row_misprints(row: Register) -> Iterator[tuple[str, Place]]:
    address = address_text(row.address.first)
    nameless = not row.name and not row.unused
    if row.printed is not None or row.zh_used is not None or nameless:
        yield f"register {address}", row.at
    for bit in row.bits:
        if bit.printed is not None or bit.zh_used is not None:
            yield f"bit {address}.{bits_text(bit.bit)}", bit.at


def _uncovered(drive: Drive, covered: set[str], report: Report) -> None:
    for name, place in _misprints(drive):
        if name not in covered:
            wrong = f"{name} departs from the manual (or lacks its name), but no erratum names it"
            report.add(place, wrong, f"add an entry to `errata` with `about: [{name}]`")


def _repeated(drive: Drive, report: Report) -> None:
    seen: dict[tuple[tuple[str, ...], str], Entry] = {}
    for erratum in drive.errata:
        key = (erratum.about, erratum.printed)
        if key in seen:
            report.add(erratum.at, f"this erratum repeats the one in line {seen[key].at[0]}", "keep one of them")
        seen[key] = erratum


def _corroborations(drive: Drive) -> Iterator[Corroboration]:
    for _, row in drive.registers():
        yield from row.corroborated
    groups: tuple[tuple[Entry, ...], ...] = (drive.settings, drive.errors.codes, drive.errata, drive.absent)
    for group in groups:
        for entry in group:
            yield from getattr(entry, "corroborated", ())
    if drive.errors.form is not None:
        yield from drive.errors.form.corroborated


def _documents(drive: Drive, report: Report) -> None:
    ids = [document.id for document in drive.documents]
    for document in drive.documents:
        if ids.count(document.id) > 1:
            report.add(document.place("id"), f"document `{document.id}` stands twice", "one entry per document")
    used = set()
    for item in _corroborations(drive):
        used.add(item.document)
        if item.document not in ids:
            report.add(item.place("document"), f"there is no document `{item.document}`", "add it to `documents`")
    for document in drive.documents:
        if document.id not in used:
            report.add(
                document.at,
                f"nothing refers to document `{document.id}`",
                "remove it, or add `corroborated:` where it serves",
            )
