"""The first page of a drive: what it is, how one talks to it, how it runs and stops, and how much the map holds."""

from collections.abc import Iterator
from pathlib import Path

from rich.console import RenderableType

from driveblocks.maps import catalog, counts, view
from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import (
    Command,
    Drive,
    Identity,
    InCommand,
    OwnMaximum,
    Reference,
    Step,
    Text,
    TripOutput,
    Watchdog,
)
from driveblocks.maps.revision import revision
from driveblocks.maps.trust import counted, heard, second_hand, words
from driveblocks.meaning import conduct
from driveblocks.meaning.pattern import of_condition
from driveblocks.meaning.status import status
from driveblocks.show.faults import reported
from driveblocks.show.layout import both, facts, heading, listed, table
from driveblocks.show.line import line, settings
from driveblocks.show.register import value_text
from driveblocks.show.registers import tables

Sourced = Watchdog | TripOutput | InCommand | OwnMaximum | Identity
KINDS = ("settings", "faults", "errors", "frames", "errata", "absent", "notices")
"""What a map lists beside registers; each is a topic of `show`."""


def pages(drive: Drive, file: str) -> Iterator[RenderableType]:
    """Everything that one wants to see first, then all register tables."""
    yield from _identity(drive, file)
    yield from line(drive)
    yield from settings(drive)
    yield from operation(drive)
    yield from _counts(drive)
    yield heading("Registers")
    yield from tables(drive)
    word = Path(file).stem if catalog.is_shipped(Path(file)) else file
    yield f"\nMore: `driveblocks show {word} TOPIC`, where TOPIC is one of {listed(KINDS)}, or a register."


def _text(text: Text) -> str:
    return both(text.en, text.own)


def _identity(drive: Drive, file: str) -> Iterator[RenderableType]:
    manual = drive.manual
    yield heading(f"{drive.prefix}  {_text(drive.vendor)}")
    yield facts(
        ("family", _text(drive.family)),
        ("nameplates", listed(one.plate for one in drive.models) or None),
        ("map", f"{file}, revision {revision(drive):08X}"),
        ("manual", _text(manual.title)),
        ("publisher", _text(manual.publisher)),
        ("edition", manual.edition or "none printed"),
        ("covers", manual.covers),
        ("trust", _trust(drive)),
        ("second hand", "runs only when its user has checked the manual" if second_hand(drive) else None),
        ("proof", None if drive.frames else view.UNPROVED),
        ("safety rules", view.PROVABLE),
        ("documents", "\n".join(f"{both(one.title, one.edition)}, {one.publisher}" for one in drive.documents)),
    )


def _trust(drive: Drive) -> str:
    """How many facts were read where, and below it those that were not read in the maker's own words."""
    numbers = {
        group: listed(f"{many} {words(how)}" for how, many in each.items()) for group, each in counted(drive).items()
    }
    said = (f"{group}: {each}" for group, each in numbers.items() if each)
    return "\n".join(("; ".join(said), *heard(drive)))


def operation(drive: Drive) -> Iterator[RenderableType]:
    """Commands, the speed reference, what proves standstill and what pins show, and the storage of parameters."""
    yield heading("Commands")
    made = table("command", "register", "write", "set", "clear", "note", wide=("note",))
    for command in drive.operation.commands:
        for row in _command(drive, command):
            made.add_row(*row)
    yield made
    still = status(drive).standstill
    yield heading("Reference, standstill, storage")
    yield facts(
        ("reference", _reference(drive.operation.reference)),
        ("standstill", f"{' and '.join(map(str, still.patterns))}: {still.why}  ({still.said.source})"),
        ("storage", _storage(drive)),
    )
    yield from _shown(drive)
    yield from _conduct(drive)


def _conduct(drive: Drive) -> Iterator[RenderableType]:
    """What the drive does by itself, and what it says of itself, with the places in the manual."""
    run, faults = drive.operation, drive.faults
    yield heading("What the drive does by itself")
    yield facts(
        ("cable cut", _from(conduct.silent_line(drive), drive.watchdog)),
        ("trip", _from(conduct.trip(drive), faults.trip_output)),
        ("reset", conduct.silenced(drive)),
        ("bus commands", _from(conduct.in_command(drive), run.commanded_by)),
        ("own maximum", _from(conduct.own_maximum(drive), run.own_maximum)),
        ("lower limit", conduct.lower_limit(drive)),
        ("identity", _from(conduct.recognised(drive), drive.identity)),
        ("never sent", "\n".join(conduct.nevers(drive))),
    )


def _from(said: str, entry: Sourced | None) -> str:
    return f"{said}  ({entry.source})" if entry is not None else said


def _shown(drive: Drive) -> Iterator[RenderableType]:
    """What the pins of the drive block show, and the states that commands wait for."""
    operation = drive.operation
    yield heading("What the pins show")
    made = table("pin", "from", wide=("from",))
    for sign in (*status(drive).shown, *status(drive).forbids):
        why = f": {sign.why}" if sign.why else ""
        made.add_row(_plain(sign.name), f"{' or '.join(map(str, sign.patterns))}{why}  ({sign.said.source})")
    for measured in operation.measures:
        made.add_row(_plain(measured.shows), f"{address_text(measured.register)}  ({measured.source})")
    made.add_row("fault code", _fault_code(drive))
    if drive.warnings is not None:
        made.add_row("warning code", f"{reported(drive.warnings)}  ({drive.warnings.source})")
    for state in operation.states:
        made.add_row(f"state {state.name}", f"{of_condition(state)}  ({state.source})")
    yield made


def _fault_code(drive: Drive) -> str:
    faults = drive.faults
    if faults.present is not None:
        bits_ = f" bits {bits_text(faults.present_bits)}" if faults.present_bits else ""
        return f"{address_text(faults.present)}{bits_}  ({faults.source})"
    bits = faults.bits
    return (
        f"the bits of {address_text(bits.first)} to {address_text(bits.last)}  ({bits.source})" if bits else "not given"
    )


def _plain(word: str) -> str:
    return word.replace("_", " ")


def _reference(reference: Reference) -> str:
    count = f", {address_text(reference.full_scale)} is 100 %" if reference.full_scale is not None else ""
    maximum = f"{count}, 100 % is {reference.maximum}" if reference.maximum else count
    maximum += f", which is {reference.full_scale_hz} Hz" if reference.full_scale_hz else ""
    reverse = ", negative turns the other way" if reference.negative_reverses else ""
    verify = (
        f"; trusted only after reading {listed(map(str, map(of_condition, reference.verify)))}"
        if reference.verify
        else ""
    )
    meaning = _plain(reference.means)
    return f"{address_text(reference.register)}, {meaning}{maximum}{reverse}{verify}  ({reference.source})"


def _command(drive: Drive, command: Command) -> Iterator[tuple[str, ...]]:
    """One row for each write; the writes that go first say what the next one waits for."""
    for number, step in enumerate(command.first, 1):
        yield f"{_plain(command.does)}, {number}", *_written(drive, step), _waits(step)
    name = f"{_plain(command.does)}{f', {len(command.first) + 1}' if command.first else ''}"
    sign = "with a negative reference" if command.negative else None
    yield name, *_written(drive, command), both(both(sign, both(command.because, command.note)), f"({command.source})")


def _written(drive: Drive, one: Command | Step) -> tuple[str, ...]:
    return (
        address_text(one.register),
        value_text(drive, one),
        listed(map(bits_text, one.set)),
        listed(map(bits_text, one.clear)),
    )


def _waits(step: Step) -> str:
    return f"until {step.until}" if step.until else f"for {step.for_ms} ms" if step.for_ms else "then"


def _storage(drive: Drive) -> str:
    storage = drive.storage
    parts = [_plain(storage.method) + ": " + storage.note]
    if storage.register is not None:
        parts.append(f"write {storage.value} to {address_text(storage.register)}")
    if storage.max_writes is not None:
        parts.append(f"at most {storage.max_writes} times")
    parts += [f"{address_text(one.ram)} is {address_text(one.stored)} in RAM" for one in storage.twins]
    if storage.add is not None:
        readable = "may" if storage.readable else "must not"
        parts.append(f"add {address_text(storage.add)} to an address of {storage.area}; it {readable} be read there")
    return "\n".join([*parts, f"({storage.source})"])


def _counts(drive: Drive) -> Iterator[RenderableType]:
    known = counts.of_drive(drive)
    yield heading("What the map holds")
    columns = ("registers", "bits", "enums", "values")
    made = table("section", *columns, wide=("section",), numbers=columns)
    titles = {section.id: _text(section.title) for section in drive.sections}
    for id_, tally in known.sections.items():
        made.add_row(titles[id_], *map(str, vars(tally).values()))
    made.add_row("keypad settings", *map(str, vars(known.setting_values).values()))
    made.add_row("all", *map(str, vars(known.total).values()), style="bold")
    yield made
    yield "\n" + listed(f"{getattr(known, kind)} {kind}" for kind in KINDS)
