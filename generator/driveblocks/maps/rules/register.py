"""Rules on registers, their bits, values, ranges and scales."""

from collections.abc import Iterator

from driveblocks.maps.form import Span, address_text, bits_text, span_text
from driveblocks.maps.model import Bit, Drive, Range, Register, Section, Value
from driveblocks.maps.problem import Place, Report


def check(drive: Drive, report: Report) -> None:
    """Note every rule that a register table breaks."""
    _addresses(drive, report)
    _section_ids(drive, report)
    for _, row in drive.registers():
        _spans(row, report)
        _words_of(row, report)
        _unused(row, report)
        _bits(row, report)
        _scale(row, report)


def _section_ids(drive: Drive, report: Report) -> None:
    seen: dict[str, Section] = {}
    for section in drive.sections:
        if section.id in seen:
            report.add(section.place("id"), f"section id `{section.id}` stands twice", "give each section its own id")
        seen[section.id] = section
        if not section.registers:
            report.add(
                section.place("registers"), f"section `{section.id}` has no registers", "list its rows, or remove it"
            )


def _addresses(drive: Drive, report: Report) -> None:
    taken: dict[int, Register] = {}
    for _, row in drive.registers():
        clash = next((taken[address] for address in row.address if address in taken), None)
        if clash is not None:
            wrong = f"address {span_text(row.address)} is taken by line {clash.at[0]}"
            report.add(
                row.place("address"),
                wrong,
                "one row per address; if the manual misprints it, use the right one and `printed:`",
            )
        for address in row.address:
            taken.setdefault(address, row)


def _spans(row: Register, report: Report) -> None:
    if row.address.first > row.address.last:
        report.add(
            row.place("address"), f"range {span_text(row.address)} runs backwards", "write the smaller address first"
        )
    if len(row.address) > 1 and (row.bits or row.values or row.scale):
        report.add(
            row.place("address"),
            "a range of registers cannot have bits, values or a scale",
            "write one row per register",
        )


def _words_of(row: Register, report: Report) -> None:
    low, high = (-32768, 32767) if row.signed else (0, 65535)
    if row.range is not None:
        _range(row.range, low, high, row.signed, report)
    _values(row.values, low, high, "the word", report)
    for value in row.values:
        if row.masks and (value.value <= 0 or value.value & (value.value - 1)):
            report.add(
                value.place("value"),
                f"{value.value} is not a single bit",
                "with `masks: true` each value is 1, 2, 4, 8 ...",
            )
    if row.masks and not row.values:
        report.add(row.place("masks"), "`masks` without `values`", "list the values, or remove `masks`")
    if row.values and row.bits:
        report.add(
            row.place("values"), "a register has either values or bits", "put the values into a bit field, or drop one"
        )


def _range(allowed: Range, low: int, high: int, signed: bool, report: Report) -> None:
    if allowed.min > allowed.max:
        report.add(
            allowed.at, f"range {allowed.min} to {allowed.max} runs backwards", "write the smaller number as `min`"
        )
    if allowed.min < low or allowed.max > high:
        hint = "" if signed or allowed.min >= 0 else "; a negative number needs `signed: true`"
        report.add(
            allowed.at,
            f"range {allowed.min} to {allowed.max} does not fit the word",
            f"a word holds {low} to {high}{hint}",
        )


def _values(values: tuple[Value, ...], low: int, high: int, holder: str, report: Report) -> None:
    seen: dict[int, Value] = {}
    names: dict[str, Value] = {}
    for value in values:
        if not low <= value.value <= high:
            report.add(value.place("value"), f"value {value.value} does not fit {holder}", f"it holds {low} to {high}")
        if value.value in seen:
            report.add(
                value.place("value"),
                f"value {value.value} stands twice",
                f"the first is in line {seen[value.value].at[0]}",
            )
        if value.name in names:
            report.add(value.place("name"), f"name `{value.name}` stands twice", "give each value its own name")
        seen[value.value] = value
        names[value.name] = value


def _unused(row: Register, report: Report) -> None:
    facts = [key for key in ("scale", "unit", "values", "bits", "range", "id") if getattr(row, key)]
    if row.unused and facts:
        report.add(row.place(facts[0]), f"an unused register has `{facts[0]}`", "remove it, or remove `unused`")
    _named(row, f"register {span_text(row.address)}", row.unused, report)


def _named(entry: Register | Bit, what: str, unused: bool, report: Report) -> None:
    if entry.name and not entry.zh:
        report.add(entry.at, f"{what} has no `zh`: the manual's wording is missing", "add `zh` as the manual prints it")
    if entry.zh and not entry.name and not unused:
        report.add(entry.at, f"{what} has no `name`: the translation is missing", "add the English `name`")


def _bits(row: Register, report: Report) -> None:
    taken: dict[int, Bit] = {}
    names: dict[str, Bit] = {}
    for bit in row.bits:
        _one_bit(row, bit, report)
        clash = next((taken[number] for number in bit.bit if number in taken), None)
        if clash is not None:
            wrong = f"bit {bits_text(bit.bit)} of {address_text(row.address.first)} is taken by line {clash.at[0]}"
            report.add(bit.place("bit"), wrong, "one entry per bit")
        if bit.name and bit.name in names:
            report.add(
                bit.place("name"), f"bit name `{bit.name}` stands twice in this register", "give each bit its own name"
            )
        taken.update(dict.fromkeys(bit.bit, bit))
        if bit.name:
            names[bit.name] = bit


def _one_bit(row: Register, bit: Bit, report: Report) -> None:
    if bit.bit.first > bit.bit.last:
        report.add(bit.place("bit"), f"bits {bits_text(bit.bit)} run backwards", "write the lower bit first")
    if bit.unused and (bit.values or bit.id):
        report.add(bit.at, "an unused bit has values or an id", "remove them, or remove `unused`")
    if not bit.unused and not bit.name and not bit.zh:
        report.add(
            bit.at,
            f"bit {bits_text(bit.bit)} has neither a name nor `unused: true`",
            "add `name` and `zh`, or `unused: true`",
        )
    _named(bit, f"bit {bits_text(bit.bit)} of {address_text(row.address.first)}", bit.unused, report)
    if len(bit.bit) > 0:
        _values(bit.values, 0, (1 << len(bit.bit)) - 1, f"{len(bit.bit)} bit{'s' * (len(bit.bit) > 1)}", report)


def _scale(row: Register, report: Report) -> None:
    if row.scale is None:
        return
    if row.unit is None:
        report.add(
            row.place("scale"),
            "a scale without a unit",
            "add `unit`, or leave the scale out when the manual gives none",
        )
    if row.scale.factor <= 0:
        report.add(
            row.scale.place("factor"),
            f"factor {row.scale.factor} is not positive",
            "write units per count, such as 0.01",
        )
    if row.values:
        report.add(row.place("scale"), "a register of listed values has a scale", "remove one of them")


def alias_spans(drive: Drive) -> Iterator[tuple[Place, Span, str]]:
    """Every address span that is not a row: areas, and their RAM-only aliases."""
    for area in drive.areas:
        yield area.place("addresses"), area.addresses, f"area `{area.id}`"
        if drive.storage.add is not None and drive.storage.area == area.id:
            span = Span(area.addresses.first + drive.storage.add, area.addresses.last + drive.storage.add)
            yield drive.storage.place("add"), span, f"the RAM-only addresses of `{area.id}`"
