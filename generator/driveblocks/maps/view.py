"""The whole of a map as plain dictionaries for JSON: one entry per register, numbers as numbers, nothing left out."""

import re
from collections.abc import Iterator
from decimal import Decimal
from typing import Any

from driveblocks.maps.form import ADDRESS, ADDRESSES, Span, space_of, wire
from driveblocks.maps.model import Bit, Drive, Entry, ErrorCode, Named, Register, Section
from driveblocks.maps.numbering import in_hex
from driveblocks.maps.revision import revision
from driveblocks.maps.shape import keys_of

Plain = dict[str, Any]
_NUMBERED = re.compile(r"(.*?)([0-9]+)")
_FIRST = ("value", "code", "id")
"""What a named entry is known by; it comes before the name."""


def of_drive(drive: Drive, stem: str) -> Plain:
    """Everything that a map says; `stem` is the name of its file without `.yaml`."""
    return {
        "drive": stem,
        "revision": f"{revision(drive):08X}",
        **{key: plain(getattr(drive, key)) for key in ("format", "prefix", "vendor", "family", "models", "manual")},
        **{key: plain(getattr(drive, key)) for key in ("id_forms", "documents")},
        "numbering": {**_entry(drive.numbering), "hexadecimal": in_hex(drive)} if drive.numbering else None,
        "registers": [one for section, row in drive.registers() for one in of_row(section, row)],
        "sections": [_without(section, "registers") for section in drive.sections],
        "areas": plain(drive.areas),
        "faults": [{"code": fault.code, "id": "", **_entry(fault)} for fault in drive.faults.codes],
        "fault_report": _without(drive.faults, "codes"),
        "warnings": [{"code": warning.code, "id": "", **_entry(warning)} for warning in drive.warning_codes],
        "warning_report": _without(drive.warnings, "codes") if drive.warnings else None,
        "errors": [{"code": None, **_entry(error)} for error in drive.errors.codes],
        "error_reply": _without(drive.errors, "codes"),
        "frames": plain(drive.frames),
        "errata": plain(drive.errata),
        "absent": plain(drive.absent),
        "serial": plain(drive.serial),
        "limits": _limits(drive),
        **{key: plain(getattr(drive, key)) for key in ("functions", "settings", "operation", "notices", "tolerances")},
        **{key: plain(getattr(drive, key)) for key in ("identity", "watchdog")},
        "storage": _without(drive.storage, *(() if drive.storage.add is not None else ("readable",))),
    }


UNPROVED = "no example frames: the tests rest on the reference model alone, which reads the same map"
"""What is said wherever a map without example frames is shown: a slip in it passes all its own tests."""

PROVABLE = "`driveblocks prove` shows that they hold in every call of its drive block"
"""What is said of the safety rules wherever a map is shown."""


def markdown(text: str) -> str:
    """A text in Markdown, shown as it is: it ends no line and no cell, and begins no tag, link or picture."""
    return re.sub(r"([\\|<]|(?<=\])\()", r"\\\1", re.sub(r"[\r\n]+", " ", text))


def sentence(text: str) -> str:
    """A text in Markdown that begins with a capital, but for an id, such as b1-01, which keeps its own."""
    named = any(each.isdecimal() for each in text.partition(" ")[0])
    return markdown(text if named else text[:1].upper() + text[1:])


def title(drive: Drive) -> str:
    """Maker and family in English, the maker once."""
    vendor, family = drive.vendor.en, drive.family.en
    return family if family.startswith(vendor) else f"{vendor} {family}"


def of_row(section: Section, row: Register) -> Iterator[Plain]:
    """The registers that a row describes, each with its own address and id; `unused` marks those not in use."""
    rest = _without(
        row, "address", "id", "name", "zh", "zh_used", "access", "unit", "scale", "values", "bits", "unused"
    )
    for address, id_ in zip(row.address, ids(row), strict=True):
        yield {
            "address": wire(address),
            "id": id_,
            "name": row.name or ("Not used" if row.unused else ""),
            "name_zh": row.zh or "",
            "text_zh": row.text_zh or "",
            "access": row.access or section.access,
            "unit": row.unit,
            "scale": plain(row.scale.factor) if row.scale else None,
            "scale_from": _without(row.scale, "factor") if row.scale else None,
            "bits": [_bit(bit) for bit in named_bits(row)],
            "unused_bits": [number for bit in row.bits if bit.unused for number in bit.bit],
            "enum": plain(row.values),
            "unused": row.unused,
            "section": section.id,
            "source": section.source,
            **rest,
        }


def named_bits(row: Register) -> tuple[Bit, ...]:
    """The bits and fields of a register without its holes; of a mask register, the bit of each of its values."""
    bits = tuple(bit for bit in row.bits if not bit.unused)
    if not row.masks:
        return bits
    return bits + tuple(
        Bit(
            bit=Span(value.value.bit_length() - 1, value.value.bit_length() - 1),
            name=value.name,
            zh=value.zh,
            zh_used=value.zh_used,
            wording=value.wording,
            note=value.note,
            at=value.at,
        )
        for value in row.values
    )


def ids(row: Register) -> tuple[str, ...]:
    """The manual's id of each register of a row, "" without one: A2-01..A2-03 -> A2-01, A2-02, A2-03."""
    first, _, last = (row.id or "").partition("..")
    match = _NUMBERED.fullmatch(first)
    if not last or match is None:
        return (first,) * len(row.address)
    low, width = int(match[2]), len(match[2])
    return tuple(f"{match[1]}{low + n:0{width}d}" for n in range(len(row.address)))


def error_number(entry: ErrorCode) -> int | None:
    """The printed code, or where none is printed the first number that another document gives."""
    found = (one.value for one in entry.corroborated if one.value is not None)
    return entry.code if entry.code is not None else next(found, None)


def plain(value: Any) -> Any:
    """Any part of the model as JSON has it: spans as first and last, factors as numbers, bytes as upper-case pairs."""
    if isinstance(value, Entry):
        return _entry(value)
    if isinstance(value, Span):
        return {"first": value.first, "last": value.last}
    if isinstance(value, bytes):
        return value.hex(" ").upper()
    if isinstance(value, Decimal):
        return int(value) if value == value.to_integral_value() else float(value)
    return [plain(item) for item in value] if isinstance(value, tuple) else value


def _entry(entry: Entry) -> Plain:
    """An entry under the keys of the map; what it omits is omitted again, but for true and false.

    A named entry has the manual's wording as `name_zh` and the corrected one as `text_zh`. An address is what is sent
    for it; `space` is its table where that is not the holding registers.
    """
    cls: type = type(entry)
    said = {key: value for key in keys_of(cls) if (value := getattr(entry, key)) not in (None, ())}
    said |= _placed(cls, said)
    if isinstance(entry, Named):
        first = {key: said.pop(key) for key in _FIRST if key in said}
        names = {"name": said.pop("name"), "name_zh": said.pop("zh", ""), "text_zh": entry.text_zh or ""}
        said.pop("zh_used", None)
        said = {**first, **names, **said}
    return {key: plain(value) for key, value in said.items()}


def _placed(cls: type, said: Plain) -> Plain:
    """The addresses of an entry as they are sent, and their table, which is one."""
    found = {key: said[key] for key, one in keys_of(cls).items() if key in said and one.shape in (ADDRESS, ADDRESSES)}
    spans = [value if isinstance(value, Span) else Span(value, value) for value in found.values()]
    tables = {space_of(span.first) for span in spans} - {"holding"}
    sent = {
        key: Span(wire(value.first), wire(value.last)) if isinstance(value, Span) else wire(value)
        for key, value in found.items()
    }
    return sent | ({"space": tables.pop()} if tables else {})


def _without(entry: Entry, *keys: str) -> Plain:
    return {key: value for key, value in _entry(entry).items() if key not in keys}


def _bit(bit: Bit) -> Plain:
    return {
        "bit": bit.bit.first,
        "width": len(bit.bit),
        "id": bit.id or "",
        "name": bit.name or "",
        "name_zh": bit.zh or "",
        "text_zh": bit.text_zh or "",
        "values": plain(bit.values),
        **_without(bit, "bit", "name", "zh", "zh_used", "id", "values", "unused"),
    }


def _limits(drive: Drive) -> Plain:
    cls: type = type(drive.limits)
    said = {key: limit for key in keys_of(cls) if (limit := getattr(drive.limits, key)) is not None}
    numbers = {key: limit.value for key, limit in said.items()}
    documents = {key: limit.document for key, limit in said.items() if limit.document}
    return {**numbers, "sources": {key: limit.source for key, limit in said.items()}, "documents": documents}
