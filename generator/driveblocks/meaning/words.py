"""What the words of commands do to a motor: which may move it, which stop it, which reset a fault.

The rule has its home here. **A word may move the motor** if, from any state in which it can be sent, one of its fields
starts, by its level or by its edge, and no field of the same word holds the motor still by its level. A field is a bit,
a group of bits, or the whole value; what it does at each value is what the row of its register declares, and what is
not declared counts as starting where it is not 0. Names are shown, and decide nothing.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from driveblocks.maps.form import Span, bits_text, is_bit
from driveblocks.maps.model import Act, By, Does, Drive, Register, Value, kept
from driveblocks.maps.model import Bit as Row
from driveblocks.maps.model import Command as Asked
from driveblocks.maps.model import Step as Before
from driveblocks.maps.problem import Place
from driveblocks.meaning.pattern import WORD, Pattern, bits_of

MOTIONS: tuple[Does, ...] = ("run_forward", "run_reverse", "jog_forward", "jog_reverse")
STOPS: tuple[Does, ...] = ("stop", "quick_stop", "coast_stop", "jog_stop")
MOVES: frozenset[Act] = frozenset({"starts", "jogs"})
DOES: dict[Act, str] = {
    "starts": "starts the motor", "jogs": "starts a jog", "forward": "turns the motor forward",
    "reverses": "turns the motor in reverse", "stops": "stops the motor", "quick_stops": "stops the motor quickly",
    "coasts": "lets the motor coast", "ends_jog": "ends a jog", "resets": "resets a fault",
    "hands_over": "gives the drive to somebody else",
}  # fmt: skip
"""What each act is, in words."""
KINDS: dict[Act, Does] = {
    "coasts": "coast_stop", "quick_stops": "quick_stop", "stops": "stop", "ends_jog": "jog_stop",
}  # fmt: skip
"""How a word stops the motor, and the command that does; of several at once, what comes first wins."""


class Held(NamedTuple):
    """What is known of a register: the bits that are known, and their value in their place."""

    known: int
    word: int


UNKNOWN = Held(0, 0)


@dataclass(frozen=True)
class Effect:
    """What a field does at a value."""

    acts: frozenset[Act] = frozenset()
    by: By | None = None
    """Whether its edge or its level counts; None where nobody says: both may."""
    holds: bool = False
    """It keeps the motor still by its level, whatever the others of the word say."""
    name: str = ""
    """What the manual calls the value."""
    declared: bool = True

    @property
    def moves(self) -> bool:
        """Whether it starts the motor, if nothing holds it."""
        return bool(self.acts & MOVES)


NOTHING = Effect(frozenset({"nothing"}))
UNDECLARED = Effect(frozenset({"starts"}), declared=False)


@dataclass(frozen=True)
class Field:
    """A bit, a group of bits, or the whole of a command register."""

    first: int
    last: int
    name: str
    effects: tuple[tuple[int, Effect], ...]
    """What it does at each value that the map lists."""
    rest: Effect = UNDECLARED
    """What it does at any other value but 0."""

    @property
    def ones(self) -> int:
        """Its greatest value."""
        return (1 << self.last - self.first + 1) - 1

    def at(self, word: int) -> Effect:
        """What it does in a word."""
        value = word >> self.first & self.ones
        return dict(self.effects).get(value, self.rest if value else NOTHING)

    def may(self, held: Held) -> list[tuple[int | None, Effect]]:
        """What it may do in a word that is known in part, each with its value; None for any that is not listed."""
        known, word = held.known >> self.first & self.ones, held.word >> self.first & self.ones
        if known == self.ones:
            return [(word, self.at(held.word))]
        listed = {0: NOTHING} | dict(self.effects)
        found: list[tuple[int | None, Effect]] = [each for each in listed.items() if (each[0] ^ word) & known == 0]
        return [*found, *([(None, self.rest)] if 1 << (self.ones & ~known).bit_count() > len(found) else [])]


class Cause(NamedTuple):
    """A field of a word, its value, None for one that is not known, and what it does."""

    field: Field
    value: int | None
    effect: Effect

    def __str__(self) -> str:
        """Name it: ``bit 1 `Start` at 1``, ``value 5 `Stop```."""
        span, name, number = (
            Span(self.field.first, self.field.last),
            self.field.name,
            "" if self.value is None else self.value,
        )
        told = [f"bit{'s' * (len(span) > 1)} {bits_text(span)}", name and f"`{name}`", number != "" and f"at {number}"]
        if self.field.ones == WORD:
            told = ["value", str(number)]
        return " ".join(each for each in (*told, self.effect.name and f"`{self.effect.name}`") if each)


@dataclass(frozen=True)
class CommandWord:
    """A register that commands are written to."""

    register: int
    fields: tuple[Field, ...]
    declared: bool
    """Whether the map says anything of what its bits or values do."""
    source: str
    document: str | None

    def causes(self, held: Held) -> Iterator[Cause]:
        """What each field may do in a word that is known in part."""
        return (Cause(field, *each) for field in self.fields for each in field.may(held))

    def certain(self, held: Held) -> list[Cause]:
        """What fields do in it for certain."""
        return [Cause(field, *may[0]) for field in self.fields if len(may := field.may(held)) == 1]

    def moves(self, now: Held, before: Held = UNKNOWN) -> Cause | None:
        """What of a word may move the motor, where the register held `before`: any word unless something is known."""
        if any(each.effect.holds for each in self.certain(now)):
            return None
        return next((one for one in self.causes(now) if one.effect.moves and _comes(one, now, before)), None)

    def stops(self, held: Held) -> Act | None:
        """How a word stops a motor: those that hold it still win, then coasting over a quick stop over a ramp."""
        found = [one.effect for one in self.certain(held) if one.effect.acts.intersection(KINDS)]
        found = [one for one in found if one.holds] or found
        return next((kind for kind in KINDS if any(kind in one.acts for one in found)), None)

    def says(self, word: int) -> str:
        """What a word does to the motor, in words; empty where nothing that matters."""
        held = Held(WORD, word)
        moved, stops = self.moves(held), self.stops(held)
        if moved:
            return f"{DOES['jogs' if 'jogs' in moved.effect.acts else 'starts']}, by {moved}"
        acts = [act for act in (stops, "resets", "hands_over") if act and self.gives(act, held)]
        return " and ".join(DOES[act] for act in acts)

    def gives(self, act: Act, held: Held) -> Cause | None:
        """The field that does something in a word for certain."""
        return next((one for one in self.certain(held) if act in one.effect.acts), None)


def _comes(one: Cause, now: Held, before: Held) -> bool:
    """Whether a field can act: by its edge alone it acts only where its value may not have been there before."""
    bits = one.field.ones << one.field.first
    there = now.known & before.known & bits == bits and (now.word ^ before.word) & bits == 0
    return one.effect.by != "edge" or not there


@dataclass(frozen=True)
class Write:
    """One write of a command: what is sent, and what the next one waits for."""

    register: int
    word: int
    """The word that is sent, or the value of a coil; bits that are kept are 0 in it."""
    names: int
    """The bits that the map gives a value, in this write."""
    keeps: int
    """Bits of no command, which are as the user of the block sets them."""
    until: str | None
    for_ms: int
    """For how long a pulse has to last."""
    silent_ms: int
    """For how long the drive answers nothing after it."""
    stays_ms: int
    """How long its word stays before the next write, at least."""
    at: Place

    @property
    def held(self) -> Held:
        """What is known of the register after it."""
        return Held(~self.keeps & WORD, self.word)

    @property
    def pattern(self) -> Pattern:
        """What is in its register after it; bits that it keeps do not count."""
        return Pattern(self.register, WORD & ~self.keeps, self.word)


@dataclass(frozen=True)
class Command:
    """A command as the writes that are sent for it."""

    does: Does
    writes: tuple[Write, ...]
    negative: bool
    """It writes what a run forward does, and the reference is negative."""
    source: str
    document: str | None
    at: Place

    @property
    def last(self) -> Write:
        """The write that stays."""
        return self.writes[-1]


@dataclass(frozen=True)
class Words:
    """All that a family is commanded by."""

    commands: tuple[Command, ...]
    registers: tuple[CommandWord, ...]

    @property
    def named(self) -> dict[str, Command]:
        """Each by what it does."""
        return {one.does: one for one in self.commands}

    @property
    def stop(self) -> Command:
        """The stop by the ramp, which every family has."""
        return self.named["stop"]

    def at(self, register: int) -> CommandWord | None:
        """A command register."""
        return next((one for one in self.registers if one.register == register), None)

    def of(self, write: Write) -> CommandWord:
        """The register of a write."""
        return next(one for one in self.registers if one.register == write.register)

    def moving(self, command: Command) -> list[tuple[int, Write, Cause]]:
        """The writes of a command that may move the motor, by their number from 0."""
        before: dict[int, Held] = {}
        found = []
        for number, write in enumerate(command.writes):
            cause = self.of(write).moves(write.held, before.get(write.register, UNKNOWN))
            found += [(number, write, cause)] if cause else []
            before[write.register] = write.held
        return found


@kept
def words(drive: Drive) -> Words:
    """The commands of a map, whether they are good or not."""
    asked = drive.operation.commands
    registers = dict.fromkeys(one.register for each in asked for one in each.writes)
    keeps = {register: _keeps(drive, register) for register in registers}
    stop = next((one for one in asked if one.does == "stop"), None)
    return Words(
        tuple(_command(one, stop, keeps) for one in asked), tuple(_register(drive, each) for each in registers)
    )


def _keeps(drive: Drive, register: int) -> int:
    """The bits of a register that are in use and belong to no command, and that may be sent."""
    row = drive.register_at(register, "w")
    used = sum(1 << bit for entry in (row.bits if row else ()) if not entry.unused for bit in entry.bit)
    writes = [one for each in drive.operation.commands for one in each.writes if one.register == register]
    named = [_names(one) for one in writes if one.value is None]
    for each in named:
        used &= ~each
    return used & ~(row.barred if row else 0) if named else 0


def _names(one: Asked | Before) -> int:
    return WORD if one.value is not None else bits_of((*one.set, *one.clear))


def _command(one: Asked, stop: Asked | None, keeps: Mapping[int, int]) -> Command:
    """Bits that a write does not name stay as the write before has left them; a reset begins as a stop."""
    image = {stop.register: bits_of(stop.set)} if stop and one.does == "fault_reset" else {}
    writes = []
    for each in one.writes:
        if each.value is not None:
            image[each.register] = each.value & WORD
        else:
            image[each.register] = image.get(each.register, 0) & ~bits_of(each.clear) | bits_of(each.set)
        key = next((key for key in ("value", "set", "clear") if key in each.keys), "register")
        writes.append(
            Write(
                each.register,
                image[each.register],
                _names(each),
                0 if each.value is not None else keeps[each.register],
                each.until if isinstance(each, Before) else None,
                each.for_ms or 0 if isinstance(each, Before) else 0,
                each.silent_ms or 0,
                max(each.for_ms or 0, each.silent_ms or 0) if isinstance(each, Before) else 0,
                each.place(key),
            )
        )
    return Command(one.does, tuple(writes), one.negative, one.source, one.document, one.at)


def _register(drive: Drive, register: int) -> CommandWord:
    found = drive.row_at(register, "w")
    if found is None:
        return CommandWord(register, (Field(0, 15, "", ()),), False, "", None)
    section, row = found
    fields = tuple(_fields(row, 0 if is_bit(register) else 15))
    effects = [each for one in fields for each in (one.rest, *dict(one.effects).values())]
    declared = any(each.declared and each != replace(NOTHING, name=each.name) for each in effects)
    return CommandWord(register, fields, declared, row.source or section.source, row.document or section.document)


def _fields(row: Register, last: int) -> Iterator[Field]:
    if not row.bits and not row.masks:
        yield _field(Row(bit=Span(0, last), name=row.name, does=row.does, values=row.values))
        return
    singles = [(one, one.value.bit_length() - 1) for one in row.values if row.masks]
    listed = [*row.bits, *(Row(bit=Span(at, at), name=one.name, does=one.does) for one, at in singles)]
    yield from map(_field, listed)
    there = {at for one in listed for at in one.bit}
    yield from (Field(at, at, "", ()) for at in range(last + 1) if at not in there)


def _field(row: Row) -> Field:
    """A row of a word; a value that does not say itself what it does is as its row says of any value but 0."""
    first, last, name = row.bit.first, row.bit.last, row.name or ""
    if row.unused:
        return Field(first, last, name, (), NOTHING)
    rest, zero = _effect(row.does, row, UNDECLARED), _effect(row.at_0, row, NOTHING, by="level")
    effects = {0: zero} if first == last or row.at_0 else {}
    for one in row.values:
        effects[one.value] = replace(_effect(one.does, one, rest if one.value else zero), name=one.name)
    if first == last:
        effects.setdefault(1, rest)
    return Field(first, last, name, tuple(effects.items()), rest)


def _effect(acts: tuple[Act, ...], said: Row | Value, else_: Effect, by: By | None = None) -> Effect:
    """What a row or a value says that it does, if it says so; only a stop holds."""
    found = frozenset(acts)
    return Effect(found, by or said.by, said.holds and bool(found.intersection(KINDS))) if found else else_
