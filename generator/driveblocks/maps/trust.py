"""How far a map can be trusted: one walk over what a motion depends on, each fact with its document."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from itertools import chain
from typing import Any, get_args

from driveblocks.maps.model import Corroboration, Document, Drive, Entry, Trust, Use, kept
from driveblocks.maps.problem import Place

TRUSTS: tuple[Trust, ...] = get_args(Trust)
MOTION = ("commands", "reference", "status", "measures", "watchdog", "settings")
"""The parts of a map that a motion depends on."""
PARTS = (*MOTION, "faults", "other settings")


@dataclass(frozen=True)
class Fact:
    """What a map says, how far it can be trusted, by which document, None for the manual, and where it names that."""

    part: str
    name: str
    trust: Trust
    document: Document | None
    place: Place
    said: tuple[Any, ...]
    """The entries that say it; of their documents the one to trust least counts."""


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


@kept
def facts(drive: Drive) -> tuple[Fact, ...]:
    """Every fact that a motion depends on, then those that only a person needs: in the order of `PARTS`."""
    motion = [*_moving(drive), *_shown(drive), *_set(drive)]
    known = {id(one) for *_, said in motion for one in said}
    faults = [("faults", f"{one.code:02X}H", [one if one.document else drive.faults]) for one in drive.faults.codes]
    others = [("other settings", one.id, [one]) for one in drive.settings if id(one) not in known]
    return tuple(_fact(drive, *each) for each in (*motion, *faults, *others))


def counted(drive: Drive) -> dict[str, dict[Trust, int]]:
    """How many facts of each part can be trusted how far."""
    return {
        part: dict(Counter(sorted((one.trust for one in facts(drive) if one.part == part), key=TRUSTS.index)))
        for part in PARTS
    }


def second_hand(drive: Drive) -> bool:
    """Whether something that a motion depends on was not read in the maker's own words."""
    return any(one.trust != "read" for one in facts(drive) if one.part in MOTION)


def rung(drive: Drive) -> str:
    """The parts of which not all was read in the maker's own words, each by its weakest fact; `read` if all was."""
    weakest = {part: max(found, key=TRUSTS.index) for part, found in counted(drive).items() if found}
    return ", ".join(f"{part} {words(how)}" for part, how in weakest.items() if how != "read") or "read"


def heard(drive: Drive) -> list[str]:
    """One line for each part and document whose facts were not read in the maker's own words; all faults are one."""
    found = dict[tuple[str, Document | None], list[Fact]]()
    for one in (each for each in facts(drive) if each.trust != "read"):
        found.setdefault((one.part, one.document), []).append(one)
    lines = []
    for (part, document), some in found.items():
        whole = part == "faults" and len(some) == len(drive.faults.codes) > 1
        names = f"all {len(some)}" if whole else ", ".join(one.name.replace("_", " ") for one in some)
        title = f"{document.title}, {document.publisher}" if document else "the manual as others wrote it down"
        lines.append(f"{part}, {words(some[0].trust)} ({title}): {names}")
    return lines


def words(how: Trust) -> str:
    """A trust as it is shown."""
    return how.replace("_", " ")


_Said = tuple[str, str, list[Any]]
"""A part, the name of a fact in it, and the entries that say it."""


def _moving(drive: Drive) -> Iterator[_Said]:
    """What is written to move the motor, and what a number there means."""
    run, speed = drive.operation, drive.operation.reference
    if drive.numbering:
        yield "commands", "numbering", [drive.numbering]
    for one in run.commands:
        yield "commands", one.does, [one, *_rows(drive, (each.register for each in one.writes), "w")]
    row, scale = _scaled(drive, speed.register, "w")
    yield "reference", "reference", [speed, *row, *_rows(drive, (each.register for each in speed.verify))]
    full = [each.address.first for _, each in drive.registers() if each.id and each.id == speed.maximum]
    maximum = [*_named(drive, speed.maximum), *_rows(drive, full)]
    own = [run.own_maximum, *chain(*_scaled(drive, run.own_maximum.register))] if run.own_maximum else []
    said = {"scale": scale, "maximum": maximum, "own maximum": own}
    yield from (("reference", name, some) for name, some in said.items() if some)


def _shown(drive: Drive) -> Iterator[_Said]:
    """What a drive block goes by."""
    run = drive.operation
    for shown in run.status:
        yield "status", shown.shows, [shown, *_rows(drive, (each.register for each in shown.any))]
    for forbids in run.forbids:
        yield "status", "no start", [forbids, *_rows(drive, (each.register for each in forbids.any))]
    for state in run.states:
        yield "status", f"state {state.name}", [state, *_rows(drive, [state.register])]
    proofs = {"standstill": run.standstill, "bus in command": run.commanded_by, "identity": drive.identity}
    for name, proof in proofs.items():
        if proof:
            yield "status", name, [proof, *_rows(drive, (each.register for each in proof.all))]
    for measure in run.measures:
        yield "measures", measure.shows, [measure, *chain(*_scaled(drive, measure.register))]


def _set(drive: Drive) -> Iterator[_Said]:
    """What the drive does without the line, how the line is spoken, and all that must be set on the keypad."""
    dog, line = drive.watchdog, drive.serial
    if dog:
        switches = [dog.chosen_by, dog.disabled_by.setting if dog.disabled_by else None]
        yield "watchdog", "reactions", [dog, *_named(drive, *switches)]
    if dog and (time := dog.time):
        yield "watchdog", "time", [time, *_named(drive, time.setting), *_rows(drive, [time.register])]
    for name, choice in {
        "mode": line.mode,
        "bit rate": line.baud,
        "format": line.format,
        "stop bits": line.stop_bits,
    }.items():
        if choice:
            yield "settings", name, [choice, *_named(drive, choice.setting)]
    yield from (("settings", one.id, [one]) for one in drive.settings if one.needed)


def _rows(drive: Drive, registers: Iterable[int | None], use: Use = "r") -> list[Any]:
    """The rows of some registers, each with the document of its section where it names none."""
    pairs = (drive.row_at(each, use) for each in registers if each is not None)
    return [replace(row, document=row.document or section.document) for section, row in filter(None, pairs)]


def _scaled(drive: Drive, register: int, use: Use = "r") -> tuple[list[Any], list[Any]]:
    """The row of a register; its scales and what they depend on."""
    rows = _rows(drive, [register], use)
    scales = [each.scale for each in rows if each.scale]
    meaning = (_rows(drive, (each.register for each in one.conditions)) for one in scales)
    return rows, [*scales, *(other for one in scales for other in one.otherwise), *chain(*meaning)]


def _named(drive: Drive, *settings: str | None) -> list[Any]:
    return [one for one in drive.settings if one.id in settings]


def _fact(drive: Drive, part: str, name: str, said: list[Any]) -> Fact:
    """A fact by the document to trust least of those that it is taken from."""
    manual: tuple[Document | None, Trust] = (None, "transcribed" if drive.manual.second_hand else "read")
    documents = {one.id: (one, one.trust or "transcribed") for one in drive.documents}
    named = [(*documents.get(one.document, manual), one.place("document")) for one in said]
    document, trust, place = max(named, key=lambda one: TRUSTS.index(one[1]))
    return Fact(part, name, trust, document, place, tuple(said))
