"""Where each fact that a page shows is from, as printed there, and how far it can be trusted."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from driveblocks.maps.model import Cited, Document, Drive
from driveblocks.maps.trust import Fact, facts, words


@dataclass
class Place:
    """What one place of a document says."""

    part: str
    where: str
    note: str
    """The number of its document below the table; empty for the manual."""
    trust: str
    names: list[str] = field(default_factory=list)
    cells: dict[str, None] = field(default_factory=dict)


def places(drive: Drive) -> list[Place]:
    """By part, place and trust; all facts of a place are one row."""
    found: dict[tuple[str, str, str, str], Place] = {}
    numbers = {one.id: f" [{number}]" for number, one in enumerate(documents(drive), 1)}
    for fact in facts(drive):
        note = numbers[fact.document.id] if fact.document else ""
        key = (fact.part, "; ".join((_source(fact) or drive.faults.source, *fact.rules)), note, words(fact.trust))
        place = found.setdefault(key, Place(*key))
        place.names.append(fact.name.replace("_", " "))
        place.cells |= dict.fromkeys(_cells(fact))
    for place in found.values():
        if place.part == "faults" and len(place.names) > MOST_CODES:
            place.names = [f"{len(place.names)} codes"]
    return list(found.values())


MOST_CODES = 9
"""More codes of one place are counted, and not named."""


def documents(drive: Drive) -> list[Document]:
    """The documents that facts are from, beside the manual, in the order of the map."""
    used = {fact.document.id for fact in facts(drive) if fact.document}
    return [one for one in drive.documents if one.id in used]


def _source(fact: Fact) -> str:
    return next((one.source for one in fact.said if getattr(one, "source", None)), "")


def _cells(fact: Fact) -> Iterable[str]:
    return (cell for one in fact.said if isinstance(one, Cited) for cell in one.printed)
