"""How far the facts of a map can be trusted, each by the document that it is taken from."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields
from typing import Any, get_args

from driveblocks.maps.model import (
    Command,
    Corroboration,
    Document,
    Drive,
    Entry,
    Reference,
    Standstill,
    State,
    Status,
    Trust,
    Use,
)
from driveblocks.maps.problem import Place

Moving = Command | Reference | Standstill | State | Status
"""What can move the motor, or proves that it is at standstill."""
TRUSTS: tuple[Trust, ...] = get_args(Trust)


def taken(value: Any) -> Iterator[tuple[str, Place]]:
    """Every document that a fact is taken from, in a map or a part of it, and where that is said."""
    if isinstance(value, tuple):
        for each in value:
            yield from taken(each)
    elif isinstance(value, Entry) and not isinstance(value, Corroboration):
        if name := getattr(value, "document", None):
            yield name, value.place("document")
        for one in fields(value):
            if one.metadata:
                yield from taken(getattr(value, one.name))


def rungs(drive: Drive) -> dict[str, dict[str, Document | None]]:
    """The document of each fact by its name, by group; None for the manual itself."""
    run, faults = drive.operation, drive.faults
    motions = {
        str(one.does): _weakest(drive, one, *_rows(drive, [each.register for each in one.writes], "w"))
        for one in run.commands
    }
    shown = {
        str(one.shows): _weakest(drive, one, *_rows(drive, [each.register for each in one.any], "r"))
        for one in run.status
    }
    states = {f"state {one.name}": _weakest(drive, one, *_rows(drive, [one.register], "r")) for one in run.states}
    still = _weakest(drive, run.standstill, *_rows(drive, [each.register for each in run.standstill.all], "r"))
    return {
        "commands": {
            **motions,
            "reference": _weakest(drive, run.reference, *_rows(drive, [run.reference.register], "w")),
        },
        "status": {**shown, **states, "standstill": still},
        "faults": {f"{one.code:02X}H": _named(drive, one.document or faults.document) for one in faults.codes},
    }


def counted(drive: Drive) -> dict[str, dict[Trust, int]]:
    """How many facts of each group can be trusted how far."""
    return {
        group: dict(Counter(sorted((trust(drive, one) for one in facts.values()), key=TRUSTS.index)))
        for group, facts in rungs(drive).items()
    }


def trust(drive: Drive, document: Document | None) -> Trust:
    """How far a document can be trusted; None is the manual itself."""
    if document is not None:
        return document.trust or "transcribed"
    return "transcribed" if drive.manual.second_hand else "read"


def second_hand(drive: Drive) -> bool:
    """Whether something that can move the motor, or proves its standstill, was not read in the maker's own words."""
    groups = counted(drive)
    return any(one != "read" for group in ("commands", "status") for one in groups[group])


def rung(drive: Drive) -> str:
    """How far the weakest command, status and fault can be trusted, in this order."""
    return ", ".join(words(max(found, key=TRUSTS.index)) if found else "none" for found in counted(drive).values())


def heard(drive: Drive) -> list[str]:
    """One line for each group and document whose facts were not read in the maker's own words; all faults are one."""
    lines = []
    settings = {each.id: _named(drive, each.document) for each in drive.settings}
    for group, facts in (rungs(drive) | {"settings": settings}).items():
        for document in dict.fromkeys(facts.values()):
            how = trust(drive, document)
            if how != "read":
                named = [name.replace("_", " ") for name, one in facts.items() if one == document]
                names = f"all {len(facts)}" if group == "faults" and len(named) == len(facts) > 1 else ", ".join(named)
                title = f"{document.title}, {document.publisher}" if document else "the manual as others wrote it down"
                lines.append(f"{group}, {words(how)} ({title}): {names}")
    return lines


def words(how: Trust) -> str:
    """A trust as it is shown."""
    return how.replace("_", " ")


def _rows(drive: Drive, registers: list[int], use: Use) -> Iterator[str | None]:
    """The documents of the rows of some registers, which are read or written."""
    pairs = (drive.row_at(each, use) for each in registers)
    yield from (row.document or section.document for section, row in filter(None, pairs))


def _weakest(drive: Drive, one: Moving, *rows: str | None) -> Document | None:
    """The document to trust least of those of a fact and of the rows of its registers."""
    named = [one.document, *rows]
    return max((_named(drive, each) for each in named), key=lambda each: TRUSTS.index(trust(drive, each)))


def _named(drive: Drive, name: str | None) -> Document | None:
    return next((one for one in drive.documents if one.id == name), None)
