"""Register tables by section, in the manual's order, with bits and values below their register."""

from collections.abc import Iterator

from rich.console import RenderableType
from rich.table import Table

from driveblocks.maps import references
from driveblocks.maps.form import address_text, bits_text, span_text
from driveblocks.maps.model import Area, Drive, Register, Section, Value
from driveblocks.show.layout import OWN, both, facts, heading, listed, listing

LEGEND = (
    "use: r read, w write\n"
    "unit: 0.1 V = one count is 0.1 V, * = only under a condition, ? = no scale given\n"
    "see: E erratum, A something the manual does not say, N note\n"
    "`driveblocks show DRIVE ADDRESS` prints all of these"
)


def tables(drive: Drive) -> Iterator[RenderableType]:
    """Every section with its title, source and rows, then the areas that a rule describes."""
    yield LEGEND
    marks = _Marks(drive)
    for one in drive.sections:
        yield from _section(one, marks)
    for area in drive.areas:
        yield heading(both(area.name, area.own))
        yield area_facts(area)


def section(drive: Drive, one: Section) -> Iterator[RenderableType]:
    yield LEGEND
    yield from _section(one, _Marks(drive))


def _section(section: Section, marks: "_Marks") -> Iterator[RenderableType]:
    yield heading(both(section.title.en, section.title.own))
    yield section_facts(section)
    yield _rows(section, marks)


def section_facts(section: Section) -> Table:
    """Where a section is in the manual and what holds for all of it."""
    series = [
        f"{one.ids} from {address_text(one.base)}" + (f", apart from {listed(one.apart)}" if one.apart else "")
        for one in section.series
    ]
    return facts(("source", section.source), ("series", "\n".join(series)), ("note", section.note))


def area_facts(area: Area) -> Table:
    """The rule that gives the addresses of an area, with the manual's examples."""
    examples = [f"{one.id} is number {one.number}, address {address_text(one.address)}" for one in area.examples]
    excluded = [f"{one.ids}  {both(one.name, one.own)}" for one in area.excluded]
    return facts(
        ("addresses", span_text(area.addresses)),
        ("rule", f"address = {address_text(area.addresses.first)} + {area.numbered_by.replace('_', ' ')}"),
        ("examples", "\n".join(examples)),
        ("excluded", "\n".join(excluded)),
        ("use", area.access),
        ("source", area.source),
        ("note", area.note),
    )


class _Marks:
    """Which registers have more than their row shows."""

    def __init__(self, drive: Drive) -> None:
        self.errata = references.addresses(erratum.about for erratum in drive.errata)
        self.absent = references.addresses(absence.about for absence in drive.absent)

    def of(self, row: Register) -> str:
        """E, A and N as far as they hold."""
        noted = row.note or any(bit.note or any(v.note for v in bit.values) for bit in row.bits)
        noted = noted or any(value.note for value in row.values)
        touched = [any(address in known for address in row.address) for known in (self.errata, self.absent)]
        return "".join(mark for mark, holds in zip("EAN", (*touched, noted), strict=True) if holds)


def _rows(section: Section, marks: _Marks) -> Table:
    columns = ("address", "id", "use", "name", OWN, "unit", "see")
    return listing(columns, _lines(section, marks), ("name", OWN))


def _lines(section: Section, marks: _Marks) -> Iterator[tuple[str, ...]]:
    for row in section.registers:
        yield *_cells(section, row), marks.of(row)
        for cells in below(row):
            yield *cells, "", ""


def _cells(section: Section, row: Register) -> tuple[str, ...]:
    name = "(not used)" if row.unused else row.name or "(no name)"
    use = "" if row.unused else row.access or section.access
    address, id_ = _ends(span_text(row.address)), _ends(row.id or "", "..")
    return address, id_, use, name, row.own, unit(row)


def below(row: Register) -> Iterator[tuple[str, ...]]:
    """The bits, field values and values of a register as cells that begin with address, id, use, name and Chinese."""
    for bit in row.bits:
        name = "(not used)" if bit.unused else bit.name or ""
        yield f" .{bits_text(bit.bit)}", bit.id or "", "", name, bit.own
        for value in bit.values:
            yield _value("   =", value)
    for value in row.values:
        yield _value(f" .{value.value.bit_length() - 1:X} =" if row.masks else " =", value)


def _value(mark: str, value: Value) -> tuple[str, ...]:
    return f"{mark}{value.value}", "", "", value.name, value.own


def unit(row: Register) -> str:
    """The unit of a register as `0.1 V` for one count, `V ?` where the manual gives no scale, `*` with a condition."""
    if row.scale is None:
        return f"{row.unit} ?" if row.unit else ""
    return f"{row.scale.factor} {row.unit or ''}".rstrip() + " *" * (row.scale.when is not None)


def _ends(text: str, between: str = "-") -> str:
    """A range on two lines, so that the column stays as narrow as one address; what is sent is on the second."""
    if between in text and "(" in text:
        return text.replace(" (", "\n(")
    first, found, last = text.partition(between)
    return f"{first}{found}\n{last}" if found else text
