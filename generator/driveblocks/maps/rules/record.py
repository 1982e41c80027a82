"""Rules on what is recorded about the manual: misprints, errata, absences, documents."""

from collections.abc import Iterator

from driveblocks.maps import references
from driveblocks.maps.form import address_text, bits_text, said, span_text, written
from driveblocks.maps.model import Bit, Corroboration, Drive, Entry, Erratum, ErrorCode, Register, Section, Text, Value
from driveblocks.maps.plan import plan
from driveblocks.maps.problem import Place, Report, Taken, line
from driveblocks.maps.rules.reference import Known
from driveblocks.maps.rules.unique import unique
from driveblocks.maps.trust import RUNGS, TRUSTS, cited, taken

MOST_ON_SITE, MOST_ASKED = 10, 6
"""Gaps of a map that are for the first hour on site: in all, and those that a person is asked about."""


def check(drive: Drive, report: Report) -> None:
    """Note every misprint without erratum, every reference into nothing, every unused document."""
    covered = _references(drive, report)
    for name, place in _misprints(drive):
        if name not in covered:
            wrong = f"{said(name)} departs from the manual (or lacks its name), but no erratum names it"
            report.miss(place, wrong, f"add an entry to `errata` with `about: [{written(name)}]`")
    _printed(drive, report)
    _errata(drive, report)
    unique(drive.absent, "what", "absence", report)
    _owed(drive, report)
    _on_site(drive, report)
    _documents(drive, report)
    _rungs(drive, report)
    _models(drive, report)


def _models(drive: Drive, report: Report) -> None:
    """Note a pattern of model numbers that no number shows which a text prints."""
    unique(drive.models, "plate", "model", report)
    for one in drive.models:
        if not any(map(one.plate.fits, one.printed)):
            right = "add `printed:` with one as a text prints it, such as [22F-D2P5N103]"
            report.miss(one.place("printed"), f"no printed model number fits {one.plate}", right)


def _rungs(drive: Drive, report: Report) -> None:
    """Note what is derived by no rule, and what is said to be better than its document."""
    trusted = {one.id: one.trust for one in drive.documents if one.trust}
    for one in cited(drive):
        if (one.rung == "derived") != (one.rule is not None):
            right = (
                "add `rule:`, how it follows from other facts" if one.rung else "add `rung: derived`, or remove `rule`"
            )
            report.miss(one.place("rung"), "what is derived has a rule, and nothing else has one", right)
        trust = trusted.get(getattr(one, "document", None) or "", "read")
        own = one.rung if one.rung and not isinstance(one.place("rung"), Taken) else trust
        if RUNGS.index(own) < RUNGS.index(trust):
            wrong = f"`rung: {own}` is better than its document, which is `{trust}`"
            report.add(one.place("rung"), wrong, "remove it, or name another document")


def _owed(drive: Drive, report: Report) -> None:
    """Note what a person looks for on the page, and the map says neither of it nor that it is absent."""
    run = drive.operation
    said = {
        "identity": drive.identity, "watchdog": drive.watchdog, "warnings": drive.warnings,
        "commanded_by": run.commanded_by, "own_maximum": run.own_maximum, "lower_limit": run.lower_limit,
        "trip_output": drive.faults.trip_output,
    }  # fmt: skip
    told = {ref for each in drive.absent for ref in each.about}
    owed = [key for key, one in said.items() if one is None and key not in told]
    if owed:
        right = f"add the key, or entries of `absent` that are `about: [{', '.join(owed)}]`"
        report.miss(drive.place("absent"), f"nothing is said of {', '.join(owed)}", right)


def _on_site(drive: Drive, report: Report) -> None:
    """Note what a person could not be asked on site: too much, or about what cannot be read."""
    marked = [each.on_site for each in drive.absent if each.on_site]
    for each in (*marked[MOST_ON_SITE:], *[one for one in marked if not one.by_run][MOST_ASKED:]):
        report.add(
            each.at, "too many gaps are for the first hour on site", f"{MOST_ON_SITE}, {MOST_ASKED} of them asked"
        )
    for each in marked:
        if each.read is not None and not any(each.read in span for span in plan(drive).readable):
            wrong = f"{address_text(each.read)} cannot be read"
            report.miss(each.place("read"), wrong, "name a register that the map lists as readable")
        row = drive.register_at(each.read) if each.read is not None else None
        if each.gives and (row is None or row.scale):
            report.add(each.place("gives"), "a scale comes of a register without one", "add `read`, or remove `gives`")
        if each.by_run and each.read is not None:
            report.add(each.place("read"), "what only a run shows is not read on site", "remove `read` or `by_run`")


def _references(drive: Drive, report: Report) -> set[str]:
    """Resolve every reference; return the canonical names that the errata cover."""
    known = Known(drive)
    covered: set[str] = set()
    for erratum in drive.errata:
        covered.update(known.resolve(erratum.about, erratum.place("about"), report))
    for notice in drive.notices:
        known.resolve(notice.about, notice.place("about"), report)
    for absence in drive.absent:
        known.resolve(absence.about, absence.place("about"), report)
    about = (("an erratum", drive.errata), ("an absence", drive.absent))
    for what, entries in about:
        for entry in entries:
            if not entry.about:
                right = "name what it is about, or write `[prose]`"
                report.add(entry.place("about"), f"{what} about nothing", right)
    return covered


def _misprints(drive: Drive) -> Iterator[tuple[str, Place]]:
    """Every entry that departs from what is printed, by canonical name."""
    for section in drive.sections:
        yield from _section_misprints(section)
    for kind, codes in (("fault", drive.faults.codes), ("warning", drive.warning_codes)):
        for one in codes:
            if one.printed_code is not None or one.zh_used is not None:
                yield f"{kind} {one.code:02X}H", one.at
    for error in drive.errors.codes:
        yield from _error_misprints(error)
    for frame in drive.frames:
        if frame.printed != frame.correct or (frame.plc is not None and frame.plc.printed):
            yield f"frame {frame.id}", frame.at
    yield from _other_misprints(drive)


def _other_misprints(drive: Drive) -> Iterator[tuple[str, Place]]:
    for setting in drive.settings:
        if setting.zh_used is not None or _any_used(setting.values):
            yield f"setting {setting.id}", setting.at
    for function in drive.functions:
        if function.zh_used is not None or any(sub.zh_used is not None for sub in function.sub_functions):
            yield f"function {function.code:02X}H", function.at
    for area in drive.areas:
        if area.zh_used is not None:
            yield f"area {area.id}", area.at


def _any_used(values: tuple[Value, ...]) -> bool:
    return any(value.zh_used is not None for value in values)


def _section_misprints(section: Section) -> Iterator[tuple[str, Place]]:
    if section.title.zh_used is not None:
        yield f"section {section.id}", section.title.at
    for row in section.registers:
        yield from _row_misprints(row)


def _row_misprints(row: Register) -> Iterator[tuple[str, Place]]:
    address = row.address.first
    nameless = not row.name and not row.unused
    if row.printed is not None or row.zh_used is not None or nameless or _any_used(row.values):
        yield references.of(address), row.at
    for bit in row.bits:
        if bit.printed is not None or bit.zh_used is not None or _any_used(bit.values):
            yield references.of(address, f".{bits_text(bit.bit)}"), bit.at


def _error_misprints(error: ErrorCode) -> Iterator[tuple[str, Place]]:
    texts = (error.meaning, *error.causes)
    if error.zh_used is not None or any(isinstance(text, Text) and text.zh_used is not None for text in texts):
        yield ("errors" if error.code is None else f"error {error.code:02X}H"), error.at


def _printed(drive: Drive, report: Report) -> None:
    """Note what is given as misprinted and is printed as used."""
    for place, printed, used in _pairs(drive):
        if printed is not None and printed == used:
            report.add(place, f"`{printed}` is given as misprinted, but it is what the map uses", "remove the key")


def _pairs(drive: Drive) -> Iterator[tuple[Place, str | None, str | None]]:
    for _, row in drive.registers():
        if row.printed is not None:
            yield row.printed.place("address"), row.printed.address, span_text(row.address).partition(" (")[0]
            yield row.printed.place("id"), row.printed.id, row.id
        for bit in row.bits:
            yield from _bit_pairs(bit)
    for fault in (*drive.faults.codes, *drive.warning_codes):
        if fault.printed_code in (str(fault.code), f"{fault.code:02X}H"):
            yield fault.place("printed_code"), fault.printed_code, fault.printed_code


def _bit_pairs(bit: Bit) -> Iterator[tuple[Place, str | None, str | None]]:
    if bit.printed is not None:
        yield bit.printed.place("bit"), bit.printed.bit, bits_text(bit.bit)
        yield bit.printed.place("id"), bit.printed.id, bit.id


def _errata(drive: Drive, report: Report) -> None:
    seen: dict[tuple[tuple[str, ...], str, str], Erratum] = {}
    for erratum in drive.errata:
        first = seen.setdefault((erratum.about, erratum.where, erratum.printed), erratum)
        if first is not erratum:
            wrong = f"this erratum repeats the one in {line(first.at)}"
            report.add(erratum.at, wrong, "keep one of them")
        if erratum.printed == erratum.used and erratum.confidence == "certain":
            wrong = "this erratum uses what is printed, and is certain of it"
            report.add(erratum.place("used"), wrong, "correct `used`, or write `confidence: open`")


def _corroborations(drive: Drive) -> Iterator[Corroboration]:
    for _, row in drive.registers():
        yield from row.corroborated
    groups: tuple[tuple[Entry, ...], ...] = (drive.settings, drive.errors.codes, drive.errata, drive.absent)
    for group in groups:
        for entry in group:
            yield from getattr(entry, "corroborated", ())
    if drive.errors.form is not None:
        yield from drive.errors.form.corroborated
    if drive.serial.pins is not None:
        yield from drive.serial.pins.corroborated


def _documents(drive: Drive, report: Report) -> None:
    documents = unique(drive.documents, "id", "document", report)
    sources = list(taken(drive))
    for name, place in (*((each.document, each.place("document")) for each in _corroborations(drive)), *sources):
        if name not in documents:
            report.miss(place, f"there is no document `{name}`", "add it to `documents`")
    said, confirmed = {name for name, _ in sources}, {item.document for item in _corroborations(drive)}
    for id_, document in documents.items():
        if id_ not in said | confirmed:
            right = (
                "remove it, or add `corroborated:` where it confirms a fact, `document:` where a fact is taken from it"
            )
            report.miss(document.at, f"nothing refers to document `{id_}`", right)
        elif id_ in said and document.trust is None:
            wrong = f"facts are taken from document `{id_}`, but nothing says how far it can be trusted"
            report.miss(document.at, wrong, f"add `trust:` with one of {', '.join(TRUSTS)}")
        elif id_ not in said and document.trust is not None:
            wrong = f"no fact is taken from document `{id_}`"
            report.add(document.place("trust"), wrong, "remove `trust`, or add `document:` to what it says")
