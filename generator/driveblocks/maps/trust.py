"""How far a map can be trusted: one walk over what a motion depends on, each fact with its document."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from itertools import chain
from typing import Any, get_args

from driveblocks.maps.model import Corroboration, Document, Drive, Entry, Rung, Trust, Trusted, Use, kept
from driveblocks.maps.problem import Place

TRUSTS: tuple[Trust, ...] = get_args(Trust)
RUNGS: tuple[Rung, ...] = get_args(Rung)
CONTROL = ("commands", "reference", "status", "measures")
MOTION = (*CONTROL, "watchdog", "serial", "settings")
"""The parts of a map that a motion depends on."""
PARTS = (*MOTION, "faults", "other settings")
SHOWN = {"control": CONTROL} | {part: (part,) for part in PARTS if part not in CONTROL}
"""What has a rung of its own in a table of drives: its parts."""


@dataclass(frozen=True)
class Fact:
    """What a map says, how far it can be trusted, by which document, None for the manual, and where it names that."""

    part: str
    name: str
    trust: Rung
    document: Document | None
    place: Place
    said: tuple[Any, ...]
    """The entries that say it; of their documents the one to trust least counts."""

    @property
    def rules(self) -> tuple[str, ...]:
        """By what it is derived from others, where it is."""
        return tuple(one.rule for one in self.said if one.rule and one.rung == self.trust)


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


def cited(value: Any) -> Iterator[Trusted]:
    """Every entry of a map, or of a part of it, that has a rung of its own or a rule."""
    if isinstance(value, tuple):
        for each in value:
            yield from cited(each)
    elif isinstance(value, Entry):
        if isinstance(value, Trusted) and (value.rung or value.rule):
            yield value
        for one in fields(value):
            if one.metadata:
                yield from cited(getattr(value, one.name))


@kept
def facts(drive: Drive) -> tuple[Fact, ...]:
    """Every fact that a motion depends on, then those that only a person needs: in the order of `PARTS`."""
    motion = [*_moving(drive), *_shown(drive), *_set(drive)]
    known = {id(one) for *_, said in motion for one in said}
    faults = [
        ("faults", f"{one.code:02X}H", [one, *([] if one.document else [drive.faults])]) for one in drive.faults.codes
    ]
    others = [("other settings", one.id, [one]) for one in drive.settings if id(one) not in known]
    return tuple(_fact(drive, *each) for each in (*motion, *faults, *others))


def counted(drive: Drive) -> dict[str, dict[Rung, int]]:
    """How many facts of each part can be trusted how far."""
    return {
        part: dict(Counter(sorted((one.trust for one in facts(drive) if one.part == part), key=RUNGS.index)))
        for part in PARTS
    }


def second_hand(drive: Drive) -> bool:
    """Whether something that a motion depends on was not read in the maker's own words."""
    return any(one.trust != "read" for one in facts(drive) if one.part in MOTION)


def rung(drive: Drive) -> str:
    """The parts of which not all was read in the maker's own words, each by its weakest fact; `read` if all was."""
    weakest = {part: max(found, key=RUNGS.index) for part, found in counted(drive).items() if found}
    return ", ".join(f"{part} {words(how)}" for part, how in weakest.items() if how != "read") or "read"


def shown(drive: Drive) -> dict[str, str]:
    """The weakest rung of each of `SHOWN`, in words; where the map has nothing of it, a dash."""
    held = counted(drive)
    found = {name: [how for part in parts for how in held[part]] for name, parts in SHOWN.items()}
    return {name: words(max(some, key=RUNGS.index)) if some else "–" for name, some in found.items()}


def heard(drive: Drive) -> list[str]:
    """One line for each part and document whose facts were not read in the maker's own words; all faults are one."""
    found = dict[tuple[str, Rung, str], list[Fact]]()
    for one in (each for each in facts(drive) if each.trust != "read"):
        found.setdefault((one.part, one.trust, _title(one)), []).append(one)
    lines = []
    for (part, how, title), some in found.items():
        whole = part == "faults" and len(some) == len(drive.faults.codes) > 1
        names = f"all {len(some)}" if whole else ", ".join(one.name.replace("_", " ") for one in some)
        lines.append(f"{part}, {words(how)} ({title}): {names}")
    return lines


def _title(fact: Fact) -> str:
    """From what a fact is that was not read."""
    if fact.rules or not fact.document:
        return "; ".join(fact.rules) or "the manual as others wrote it down"
    return f"{fact.document.title}, {fact.document.publisher}"


def words(how: Rung) -> str:
    """A rung as it is shown."""
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
            yield "serial", name, [choice, *_named(drive, choice.setting)]
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
    """A fact by the weakest rung of what says it, its own or that of its document."""
    manual: tuple[Document | None, Rung] = (None, "transcribed" if drive.manual.second_hand else "read")
    documents: dict[str, tuple[Document | None, Rung]] = {
        one.id: (one, one.trust or "transcribed") for one in drive.documents
    }
    named = [(*documents.get(one.document, manual), one.place("document")) for one in said]
    named += [
        (document, one.rung, one.place("rung")) for one, (document, *_) in zip(said, named, strict=True) if one.rung
    ]
    document, trust, place = max(named, key=lambda one: RUNGS.index(one[1]))
    return Fact(part, name, trust, document, place, tuple(said))
