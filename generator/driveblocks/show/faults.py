"""Fault codes and error replies."""

from collections.abc import Iterator

from rich.console import RenderableType

from driveblocks.maps import references
from driveblocks.maps.form import address_text, bits_text, span_text
from driveblocks.maps.model import Bit, Drive, ErrorCode, Fault, Register, Warnings
from driveblocks.show.errata import corroborated, of_absence, of_erratum, of_notice
from driveblocks.show.layout import OWN, both, card, code_text, facts, heading, listed, listing


def faults(drive: Drive) -> Iterator[RenderableType]:
    known = drive.faults
    yield heading(f"Fault codes: {len(known.codes)}")
    relation = known.bits and (
        f"code = 16 x (word - {address_text(known.bits.first)}) + bit + 1, words {address_text(known.bits.first)} to "
        f"{address_text(known.bits.last)} ({known.bits.source})"
    )
    yield facts(
        ("reported in", listed(map(span_text, known.registers))), ("fault bits", relation), ("source", known.source)
    )
    yield _codes(known.codes)
    if drive.warnings is not None:
        yield heading(f"Warning codes: {len(drive.warnings.codes)}")
        yield facts(("reported in", reported(drive.warnings)), ("source", drive.warnings.source))
        yield _codes(drive.warnings.codes)


def _codes(codes: tuple[Fault, ...]) -> RenderableType:
    rows = ((code_text(one.code), one.id or "", one.name, one.own, one.note or "") for one in codes)
    return listing(("code", "display", "name", OWN, "note"), rows, ("name", OWN, "note"))


def reported(warnings: Warnings) -> str:
    """The register, or the bits of it, in which a warning has its code."""
    return address_text(warnings.register) + (f" bits {bits_text(warnings.bits)}" if warnings.bits else "")


def of_fault(drive: Drive, fault: Fault) -> Iterator[RenderableType]:
    """One fault or warning code with its bits, the registers that report it, and what is recorded about it."""
    kind = drive.kind_of(fault)
    if kind == "warning" and drive.warnings is not None:
        where, source = reported(drive.warnings), drive.warnings.source
    else:
        where, source = listed(map(span_text, drive.faults.registers)), drive.faults.source
    bits = [f"{place}  {both(bit.name, bit.own)}" for place, bit in bits_of(drive, fault.id)]
    printed = fault.zh if fault.zh_used else None
    yield card(
        f"{drive.prefix}  {kind} {code_text(fault.code)} ({fault.code})  {fault.id or ''}".rstrip(),
        ("name", both(fault.name, fault.own)),
        ("printed", listed(text for text in (fault.printed_code, printed) if text)),
        ("bits", "\n".join(bits)),
        ("reported in", where),
        ("causes", "; ".join(each.en for each in fault.causes)),
        ("what to do", "; ".join(each.en for each in fault.remedies)),
        ("note", fault.note),
        ("source", source),
    )
    yield from recorded(drive, kind, fault.code)


def bits_of(drive: Drive, id_: str | None) -> list[tuple[str, Bit]]:
    """Every bit that has a fault's short display, with its place such as `0014H.1`."""
    return [(place, bit) for place, _, bit in all_bits(drive) if id_ is not None and bit.id == id_]


def all_bits(drive: Drive) -> Iterator[tuple[str, Register, Bit]]:
    """Every bit and field of every register, with its place."""
    for _, row in drive.registers():
        for bit in row.bits:
            yield address_text(row.address.first, f".{bits_text(bit.bit)}"), row, bit


def errors(drive: Drive) -> Iterator[RenderableType]:
    """What a refusal looks like on the wire, and every reason."""
    yield heading(f"Error codes: {len(drive.errors.codes)}")
    yield facts(("form", _form(drive)), ("source", drive.errors.source))
    for error in drive.errors.codes:
        yield of_error(drive, error)


def _form(drive: Drive) -> str:
    form = drive.errors.form
    if form is None:
        return "the manual does not say what an error reply looks like"
    if form.kind == "exception":
        text = f"function code + {code_text(form.add or 0)}, then one byte with the code"
    else:
        where = f"function {code_text(form.function or 0)} at {address_text(form.address or 0)}"
        text = f"a reply of {where}, whatever was asked; its word is the code"
    more = corroborated(drive, form.corroborated)
    return f"{text} ({form.source})" + (f"\n{more}" if more else "")


def of_error(drive: Drive, error: ErrorCode) -> RenderableType:
    code = "no code" if error.code is None else code_text(error.code)
    causes = [f"- {both(cause.en, cause.own)}" for cause in error.causes]
    meaning = error.meaning
    return card(
        f"error {code}  {both(error.name, error.own)}",
        ("printed", error.zh if error.zh_used else None),
        ("meaning", both(meaning.en, meaning.own) if meaning else None),
        ("causes", "\n".join(causes)),
        ("note", error.note),
        ("also says", corroborated(drive, error.corroborated)),
    )


def recorded(drive: Drive, kind: str, key: int | str) -> Iterator[RenderableType]:
    """Errata, absences and notices that name an entry."""
    for erratum in drive.errata:
        if references.any_concerns(erratum.about, kind, key):
            yield of_erratum(drive, erratum, "erratum: ")
    for absence in drive.absent:
        if references.any_concerns(absence.about, kind, key):
            yield of_absence(drive, absence, "not said: ")
    for notice in drive.notices:
        if references.any_concerns(notice.about, kind, key):
            yield of_notice(notice)
