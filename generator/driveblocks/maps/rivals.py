"""What the stop of one family is at a drive of another, and by what a drive block sees which of the two it has.

The stop of one make is the run of another. All of it is taken from the maps: what both say of a register.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

from driveblocks.maps import catalog
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive, Register, Setting, kept
from driveblocks.maps.pair import whole
from driveblocks.maps.plan import dialect, plan, reads_by, writes_by
from driveblocks.meaning.polls import Poll, fast_words, identity_read
from driveblocks.meaning.words import STOPS, Held, Write, words
from driveblocks.modbus.layout import Dialect

Meaning = Literal["motion", "other", "unknown", "stop", "refused"]
"""Of a written word: it may move the motor; it is something else; the map does not say; it stops; it is not taken."""
WORST: tuple[Meaning, ...] = ("motion", "other", "unknown", "stop", "refused")
HARMS: tuple[Meaning, ...] = ("motion", "other")
ALL = 0xFFFF
ADDRESSES = Span(1, 247)
MOST_READS = 3
"""First reads of a drive block: each has an entry of its own among the polls."""


PERCENT_COUNTS = 10000
"""Counts of 100 % of a reference that is a percentage of the maximum."""


@dataclass(frozen=True)
class Stop:
    """A stop of one family at a drive of another."""

    does: str
    register: int
    word: int
    means: Meaning
    says: str
    """What the other map calls it."""


@dataclass(frozen=True)
class First:
    """A read that a drive block sends before its first stop."""

    read: Poll
    shows: Literal["unit", "values", "bits", "any", "refusal"]
    """What is right: the unit address; one of `values`; some of the bits of `values` and no other; words; a refusal."""
    values: tuple[int, ...] = ()
    name: str = ""
    """What the map calls the register."""
    source: str = ""


@dataclass(frozen=True)
class Pair:
    """The block of one family at a drive of another, where its stop does harm."""

    block: Drive
    drive: Drive
    worst: Stop
    told: str
    """What tells the two apart, in words; empty: nothing."""


# ------------------------------------------------------------ what a stop means


def stops_at(drive: Drive, other: Drive) -> list[Stop]:
    """The stops of a family at a drive of another, the worst first; bits that belong to no command are 0."""
    found = [
        Stop(one.does, one.last.register, one.last.word, *_meaning(drive, one.last, other))
        for one in words(drive).commands
        if one.does in STOPS
    ]
    return sorted(found, key=lambda each: WORST.index(each.means))


def _meaning(drive: Drive, write: Write, other: Drive) -> tuple[Meaning, str]:
    register, function = write.register, writes_by(drive, write.register)
    if function not in {each.code for each in other.functions}:
        return "refused", f"it has no function {function:02X}H"
    if words(other).at(register):
        return _command(other, register, write.word)
    if register in whole(other, other.operation.reference.register):
        return "other", "its speed reference"
    return _register(other, register)


def _register(other: Drive, register: int) -> tuple[Meaning, str]:
    """A register that is neither a command nor the reference."""
    found = other.row_at(register, "w")
    areas = (each.addresses for each in other.areas if "w" in each.access)
    if found is not None and "w" not in (found[1].access or found[0].access):
        return "refused", f'its "{found[1].name}", which is only read'
    if found is not None and not found[1].unused:
        return "other", f'its "{found[1].name}"'
    if any(register in span for span in (*areas, *other.ram_only)):
        return "other", "one of its parameters"
    return "unknown", "its map does not list it"


def _command(other: Drive, register: int, word: int) -> tuple[Meaning, str]:
    """A word in a command register, by what its fields do; of a register of values, one that is listed."""
    row, known = other.register_at(register, "w"), words(other)
    listed = [each for each in row.values if each.value == word] if row and not row.masks else []
    if row is not None and row.values and not row.masks and not listed:
        return "unknown", "its map lists no such value"
    told = known.at(register)
    held = Held(ALL, word)
    cause = told.moves(held) if told else None
    means: Meaning = "motion" if cause else "stop" if told and told.stops(held) else "other"
    named = [one for one in known.commands if one.last.register == register and one.last.pattern.holds(word)]
    if named:
        return means, f"its {named[0].does.replace('_', ' ')}"
    return means, f"its {cause or 'command'}"


# ------------------------------------------------------------ what is read before the first stop


@kept
def first_reads(drive: Drive) -> tuple[First, ...]:
    """What the block of a family reads before its first stop; nothing where no shipped family makes that necessary.

    A map with an identity has that one read, which `drive.identity` judges. The shipped families alone decide, so that
    a block is the same whatever is built beside it.
    """
    identity = identity_read(drive)
    if identity is not None:
        return (First(identity, "values"),)
    left = against(drive)
    found: list[First] = []
    for each in _candidates(drive, left):
        if len(found) < MOST_READS and (told := [other for other in left if _serves(each, drive, other)]):
            found.append(each)
            left = [other for other in left if other not in told]
    return tuple(found)


def _serves(first: First, drive: Drive, other: Drive) -> bool:
    """Whether a read tells a drive of another family, at a cost that its harm is worth.

    A refusal is a slow and a weak sign: it is not waited for where the other only crawls.
    """
    if first.shows != "refusal":
        return _tells(first, other)
    return not _crawls(drive, other) and _tells(first, other)


def _crawls(drive: Drive, other: Drive) -> bool:
    """Whether stops ask a drive of another family for a hundredth of its speed at most, and do nothing worse."""
    reference = other.operation.reference
    full = reference.full_scale or (PERCENT_COUNTS if reference.means == "percent_of_maximum" else 0)
    harms = [each for each in stops_at(drive, other) if each.means in HARMS]
    return all(each.register == reference.register and each.word * 100 <= full for each in harms)


def against(drive: Drive) -> list[Drive]:
    """The shipped families from which the block of this one has to be told apart; an identity does it by itself."""
    others = [] if drive.identity else shipped()
    return [other for other in others if other.prefix != drive.prefix and _harms(drive, other)]


def refusals(drive: Drive) -> Dialect:
    """How a family refuses, and where it has to be told from another, that one, too: both may answer a first read."""
    own = dialect(drive)
    function, address, add = own.function or 0, own.address or 0, own.added if own.address is None else 0
    for other in map(dialect, against(drive)):
        if not function and other.address is not None:
            function, address = other.function or 0, other.address
        add = add or (other.added if other.address is None else 0)
    return Dialect(add, function, address, own.two_byte_count)


def shipped() -> list[Drive]:
    """The families that come with DriveBlocks."""
    return [load(path) for path in catalog.shipped()]


def _harms(drive: Drive, other: Drive) -> bool:
    return any(each.means in HARMS for each in stops_at(drive, other))


def _candidates(drive: Drive, others: Iterable[Drive]) -> Iterator[First]:
    """What may tell, what says most first: its own address; a listed status; what it has; what only the other has."""
    setting = _address(drive)
    if setting is not None:
        yield First(_read(drive, setting.register or 0), "unit", (), f"{setting.id}, {setting.name}", setting.source)
    words = sorted(each for each in fast_words(drive) if _readable(drive, each))
    rows = [(each, found) for each in words if (found := drive.row_at(each)) is not None]
    some = [
        First(_read(drive, each), "any", (), row.name or "", row.source or section.source)
        for each, (section, row) in rows
    ]
    for one, (_, (_, row)) in zip(some, rows, strict=True):
        if row.values and row.words is None:
            values = tuple(value.value for value in row.values)
            yield replace(one, shows="bits" if row.masks else "values", values=values)
    yield from some
    for other in others:
        for each in sorted(fast_words(other)):
            section_row = other.row_at(each)
            if section_row and not _readable(drive, each):
                section, row = section_row
                source = f"{other.prefix}: {row.source or section.source}"
                yield First(_read(other, each), "refusal", (), f"{row.name} of {other.prefix}", source)


def _address(drive: Drive) -> Setting | None:
    found = (each for each in drive.settings if each.id == drive.serial.unit.setting and each.register is not None)
    return next((each for each in found if _readable(drive, each.register or 0)), None)


def own_address(drive: Drive) -> int | None:
    """The register in which a drive shows its unit address, where its map has one."""
    setting = _address(drive)
    return setting.register if setting else None


def _read(drive: Drive, register: int) -> Poll:
    words = whole(drive, register)
    return Poll(reads_by(drive, register), min(words), len(words), fast=True)


def _readable(drive: Drive, register: int) -> bool:
    return any(register in span for span in plan(drive).readable)


def _tells(first: First, other: Drive) -> bool:
    """Whether a drive of another family answers a read otherwise, by its map."""
    register = first.read.address
    row = other.register_at(register)
    if first.read.function not in {each.code for each in other.functions}:
        return first.shows != "refusal"
    if first.shows == "refusal":
        return row is not None and not row.unused and _readable(other, register)
    if not _readable(other, register):
        return True
    return row is not None and not row.unused and _differs(first, row)


def _differs(first: First, row: Register) -> bool:
    """Whether a register of another family, which has a row there, cannot hold what is right."""
    listed = {value.value for value in row.values}
    if first.shows == "unit":
        return not any(each in ADDRESSES for each in listed) if listed and not row.masks else _beyond(row)
    return bool(listed) and not row.masks and first.shows == "values" and listed.isdisjoint(first.values)


def _beyond(row: Register) -> bool:
    """Whether the range of a register has no unit address."""
    return row.range is not None and (row.range.min > ADDRESSES.last or row.range.max < ADDRESSES.first)


# ------------------------------------------------------------ the table


def pairs(drives: Iterable[Drive]) -> list[Pair]:
    """Each family at a drive of each other one of these, where its stop is motion, or another register.

    Not where nothing tells the two apart and the other only crawls.
    """
    some = list(drives)
    found = [
        Pair(one, other, stops_at(one, other)[0], told_apart(one, other))
        for one in some
        for other in some
        if one.prefix != other.prefix and _harms(one, other)
    ]
    return [each for each in found if each.told or not _crawls(each.block, each.drive)]


def told_apart(drive: Drive, other: Drive) -> str:
    """By what the block of a family sees that a drive is of another one; empty: by nothing."""
    if drive.identity is not None:
        return "its identity"
    return next((said(each) for each in first_reads(drive) if _tells(each, other)), "")


def warning(pair: Pair) -> str:
    """A pair as a sentence."""
    does = "may start the motor" if pair.worst.means == "motion" else "writes another register"
    told = f"its block sees that by {pair.told}" if pair.told else "nothing tells the two apart: check the addresses"
    return f"A stop of {pair.block.prefix} at a {pair.drive.prefix} {does}; {told}."


def said(first: First) -> str:
    """A first read in words."""
    words = {"unit": "its own unit address", "refusal": "what only the other has", "any": "what only it has"}
    return f"{address_text(first.read.address)}, {words.get(first.shows, 'a value that only it shows')} ({first.name})"


def unknown(drives: Iterable[Drive]) -> list[tuple[Drive, Drive]]:
    """Families whose stop is, at a drive of another, a register or a value that its map does not list."""
    some = list(drives)
    found = [(one, other) for one in some for other in some if one.prefix != other.prefix]
    return [(one, other) for one, other in found if stops_at(one, other)[0].means == "unknown"]
