"""What is wrong in a manual, what it does not say, and what it forbids or warns of, as cards."""

from collections.abc import Iterator

from rich.console import RenderableType

from driveblocks.maps.form import said
from driveblocks.maps.model import Absence, Corroboration, Drive, Erratum, Notice
from driveblocks.show.layout import both, card, heading, listed, own_head


def errata(drive: Drive) -> Iterator[RenderableType]:
    yield heading(f"Misprints and contradictions of the manual: {len(drive.errata)}")
    for number, erratum in enumerate(drive.errata, 1):
        yield of_erratum(drive, erratum, f"{number}. ")


def of_erratum(drive: Drive, erratum: Erratum, number: str = "") -> RenderableType:
    """One misprint: what is printed, what is used, why, how sure."""
    return card(
        f"{number}{erratum.where}",
        ("about", listed(map(said, erratum.about))),
        ("printed", erratum.printed),
        ("used", erratum.used),
        ("why", erratum.why),
        ("sure", f"{erratum.confidence}, {'' if erratum.measured else 'not '}measured on a drive"),
        ("also says", corroborated(drive, erratum.corroborated)),
    )


def absences(drive: Drive) -> Iterator[RenderableType]:
    """Everything that a person needs and the manual does not say."""
    yield heading(f"What the manual does not say: {len(drive.absent)}")
    for number, absence in enumerate(drive.absent, 1):
        yield of_absence(drive, absence, f"{number}. ")


def of_absence(drive: Drive, absence: Absence, number: str = "") -> RenderableType:
    """One thing that the manual does not say, and how to find it out."""
    return card(
        f"{number}{absence.what}",
        ("about", listed(map(said, absence.about))),
        ("matters", absence.matters),
        ("find out", absence.find_out),
        ("also says", corroborated(drive, absence.corroborated)),
    )


def notices(drive: Drive) -> Iterator[RenderableType]:
    yield heading(f"Prohibitions, warnings, hazards and procedures of the manual: {len(drive.notices)}")
    for notice in drive.notices:
        yield of_notice(notice)


def of_notice(notice: Notice) -> RenderableType:
    """One of them, in English and as printed."""
    return card(
        f"{notice.kind}: {notice.text.en}",
        (own_head([notice.text.own]), notice.text.own),
        ("about", listed(map(said, notice.about))),
        ("note", notice.note),
        ("source", notice.source),
    )


def corroborated(drive: Drive, found: tuple[Corroboration, ...]) -> str:
    """Other documents by title and page, with what they say, one per line."""
    titles = {document.id: both(document.title, document.edition) for document in drive.documents}
    lines = []
    for one in found:
        value = "" if one.value is None else f" (value {one.value})"
        lines.append(f"{titles.get(one.document, one.document)}, {one.page}: {one.reads}{value}")
    return "\n".join(lines)
