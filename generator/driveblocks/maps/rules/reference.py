"""Rules on references: what errata, absences and notices are about must exist."""

import re
from collections.abc import Callable
from functools import partial

from driveblocks.maps import form, references
from driveblocks.maps.form import bits_text, said
from driveblocks.maps.model import USES, Drive
from driveblocks.maps.problem import Place, Report

_SINGLE = (
    *("prose", "serial", "storage", "operation", "broadcast", "errors", "faults", "limits", "manual", "silence"),
    *("pins", "identity", "watchdog", "warnings", "commanded_by", "own_maximum", "lower_limit", "trip_output"),
)
_LIMITS = ("read_words", "write_words", "data_bytes", "ascii_data_bytes")
_NUMBER = re.compile(r"[0-9]{1,9}|[0-9A-F]{1,8}H")
_ADDRESSES = re.compile(r"([0-9A-F]{4})H(?:-([0-9A-F]{4})H)?")
_BIT = re.compile(r"([0-9A-F]{4})H\.([0-9A-F])(?:-([0-9A-F]))?")


class Known:
    """What references may name, and by which canonical names errata cover it."""

    def __init__(self, drive: Drive) -> None:
        self.drive = drive
        self.names: dict[str, set[str]] = {
            "frame": {frame.id for frame in drive.frames},
            "setting": {setting.id for setting in drive.settings},
            "section": {section.id for section in drive.sections},
            "area": {area.id for area in drive.areas},
            "limit": set(_LIMITS),
        }
        self.codes: dict[str, set[int | None]] = {
            "fault": {fault.code for fault in drive.faults.codes},
            "warning": {warning.code for warning in drive.warning_codes},
            "error": {error.code for error in drive.errors.codes},
            "function": {function.code for function in drive.functions},
        }
        self.finders: dict[str, Callable[[str], list[str]]] = {"register": self._registers, "bit": self._bits}
        self.finders |= {name: partial(self._in_table, table=name) for name in ("coil", "discrete", "input")}

    def resolve(self, refs: tuple[str, ...], place: Place, report: Report) -> list[str]:
        """The canonical names that references cover; notes one that names nothing, or that is there twice."""
        found: list[str] = []
        seen: set[str] = set()
        for ref in refs:
            if ref in seen:
                report.add(place, f"`{said(ref)}` is twice in one list", "keep one of them")
            seen.add(ref)
            names = self._of(*ref.partition(" ")[::2])
            if not names:
                self._unknown(ref, place, report)
            found += names
        return found

    def _unknown(self, ref: str, place: Place, report: Report) -> None:
        kind = ref.partition(" ")[0]
        kinds = (*self.finders, *self.codes, *self.names, *_SINGLE)
        if kind not in kinds:
            report.add(place, f"`{said(ref)}` is no reference", "start it with one of " + ", ".join(kinds))
        elif kind in _SINGLE:
            report.add(place, f"`{said(ref)}` is no reference", f"write `{kind}` alone")
        else:
            report.miss(place, f"`{said(ref)}` names nothing in this map", f"name an existing {kind}, as `{kind} ...`")

    def _of(self, kind: str, name: str) -> list[str]:
        if kind in _SINGLE:
            return [kind] if not name else []
        if kind in self.finders:
            return self.finders[kind](name)
        if kind in self.codes and _NUMBER.fullmatch(name):
            number = int(name[:-1], 16) if name.endswith("H") else int(name)
            return [f"{kind} {number:02X}H"] if number in self.codes[kind] else []
        return [f"{kind} {name}"] if name in self.names.get(kind, set()) else []

    def _in_table(self, name: str, table: str) -> list[str]:
        return self._bits(name, table) or self._registers(name, table)

    def _registers(self, name: str, table: str = "register") -> list[str]:
        if _ADDRESSES.fullmatch(name) is None:
            return []
        first, last = (span := form.ADDRESSES.parse(form.TABLES[table] + name)).first, span.last
        rows = self.drive.rows_in(span)
        in_area = any(first in area.addresses for area in self.drive.areas)
        if last < first or not (in_area or self.drive.register_at(first)):
            return []
        return [references.of(row.address.first) for row in rows] or [f"{table} {name}"]

    def _bits(self, name: str, table: str = "bit") -> list[str]:
        match = _BIT.fullmatch(name)
        if match is None:
            return []
        address = form.ADDRESS.parse(f"{form.TABLES[table]}{match[1]}H")
        low, high = int(match[2], 16), int(match[3] or match[2], 16)
        rows = dict.fromkeys(self.drive.register_at(address, use) for use in USES)
        bits = (bit.bit for row in rows if row for bit in row.bits)
        spans = [span for span in bits if span.first <= high and low <= span.last]
        return [references.of(address, f".{bits_text(span)}") for span in spans]
