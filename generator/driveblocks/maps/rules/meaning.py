"""Rules on what commands mean: the register's own table must call what a command writes by what the command does."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from driveblocks.maps.form import Span
from driveblocks.maps.model import Bit, Command, Does, Drive, Register, Step, Value
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules import term
from driveblocks.maps.rules.term import COAST, FORWARD, JOG, QUICK, RESET, REVERSE, RUN, STOP, Meaning


def _set(*meanings: str) -> Meaning:
    return frozenset(meanings)


@dataclass(frozen=True)
class _Due:
    """What the table must say of a command."""

    called: str
    """The command in words."""
    needs: tuple[Meaning, ...]
    """It must say all of one of these."""
    never: Meaning
    """It says none of these, whatever the map's reason: a swapped code is a motor that turns the wrong way."""
    only: Meaning
    """If it says anything, something of it is among these."""
    doubts: Meaning = frozenset()
    """It says these only with a reason: another way to stop, or a reset with it."""

    @property
    def right(self) -> str:
        terms = " or ".join(" and ".join(sorted(need)) for need in self.needs)
        return f"correct the command, let the table say {terms}, or give the manual's reason in `because`"


JOGS: tuple[Does, ...] = ("jog_forward", "jog_reverse")
MOVES: tuple[Does, ...] = ("run_forward", "run_reverse", *JOGS)
_MOTION = _set(FORWARD, REVERSE, RUN, JOG)
_STOPS = _set(STOP, COAST, QUICK)
_KINDS: dict[Does, str] = {"quick_stop": QUICK, "coast_stop": COAST}
_STILL = _set(STOP, COAST, RESET)
_TURNING = _set(FORWARD, REVERSE, JOG)
_DUE: dict[Does, _Due] = {
    "run_forward": _Due("a forward run", (_set(FORWARD), _set(RUN)), _set(REVERSE, JOG) | _STILL, _MOTION),
    "run_reverse": _Due("a reverse run", (_set(REVERSE),), _set(FORWARD, JOG) | _STILL, _MOTION),
    "jog_forward": _Due("a jog", (_set(JOG),), _set(REVERSE) | _STILL, _MOTION),
    "jog_reverse": _Due("a reverse jog", (_set(JOG, REVERSE),), _set(FORWARD) | _STILL, _MOTION),
    "jog_stop": _Due("a jog stop", (_set(JOG, STOP),), _set(FORWARD, REVERSE), _STOPS, _set(COAST, QUICK, RESET)),
    "stop": _Due("a stop", (_set(STOP),), _TURNING, _STOPS, _set(COAST, QUICK, RESET)),
    "coast_stop": _Due("a coasting stop", (_set(COAST),), _TURNING, _STOPS, _set(RESET)),
    "quick_stop": _Due("a quick stop", (_set(QUICK, STOP),), _TURNING, _STOPS, _set(COAST, RESET)),
    "fault_reset": _Due("a reset", (_set(RESET),), _MOTION, _set(RESET), _set(STOP, COAST, QUICK)),
}


@dataclass(frozen=True)
class _Said:
    """What the register calls one part of what a command writes."""

    place: Place
    register: int
    name: str
    zh: str
    on: bool
    """Whether any bit of it is set."""
    value: bool = True
    """Whether it is a value, of the word or of a field; else a bit, or bits, without values."""
    bits: tuple[int, ...] = ()
    alone: bool = True
    """FALSE: the name of a register that several commands write, or of a field, which says nothing about one value."""

    @property
    def meaning(self) -> Meaning:
        return term.of(self.name, self.zh)

    @property
    def holds(self) -> bool:
        """Whether the drive is asked for this; else it is asked for the contrary."""
        return (self.on or self.value) != term.negated(self.name, self.zh)

    def __str__(self) -> str:
        return f"`{self.name}` {self.zh}".rstrip()


Write = Command | Step
Image = dict[tuple[int, int], bool]
"""What is in bits of registers: register and bit -> set or not."""


def written(one: Write) -> dict[int, bool]:
    """The bits that a write gives a value, and which."""
    if one.value is not None:
        return {number: bool(one.value >> number & 1) for number in range(16)}
    ones = {number: True for span in one.set for number in span}
    return {number: False for span in one.clear for number in span} | ones


def image(writes: Iterable[Write]) -> Image:
    """What is in the registers after these writes."""
    return {(one.register, number): on for one in writes for number, on in written(one).items()}


def acting(command: Command) -> tuple[Write, ...]:
    """The writes of a command up to the one that does it: of a pulse the step that sets what is taken back later."""
    end = image(command.writes)
    for count in range(len(command.first), 0, -1):
        step = command.first[count - 1]
        if step.for_ms and any(on and not end[step.register, number] for number, on in written(step).items()):
            return command.first[:count]
    return command.writes


def key(one: Write, on: bool) -> str:
    """The key under which a bit is written."""
    return "value" if one.value is not None else "set" if on else "clear"


def number(field: Bit, bits: dict[int, bool]) -> int:
    """The number in a field of which every bit is written."""
    return sum(bits[place] << place - field.bit.first for place in field.bit)


def field_value(field: Bit, bits: dict[int, bool]) -> Value | None:
    """The listed value of a field, where every bit of it is written."""
    if any(place not in bits for place in field.bit):
        return None
    return next((value for value in field.values if value.value == number(field, bits)), None)


def check(drive: Drive, command: Command, report: Report) -> None:
    """Note a command that the register calls something else, and one that it does not call so without a reason."""
    due, said = _DUE[command.written_as], [part for one in _merged(acting(command)) for part in _said(drive, one)]
    contrary = [one for one in said if _contrary(due, one, said)]
    taken = [one for one in said if _taken(due, one, said)]
    for one in contrary or taken:
        calls = "but the register calls it" if contrary else "but it clears what the register calls"
        wrong = f"`{command.does}`, {calls} {one}"
        report.add(one.place, wrong, "correct the value or bit, or the register's table")
    if contrary or taken or _passed(drive, command, due, report) or _exchanged(drive, command, said, report):
        return
    doubt = _doubt(due, said, _ended(drive, command, said))
    if command.because is not None and doubt is None:
        wrong = f"`because` explains nothing: the register's table calls this {due.called}"
        report.add(command.place("because"), wrong, "remove it")
    elif command.because is None and doubt is not None:
        place = command.place(key(command, bool(command.set)))
        report.miss(place, f"`{command.does}` writes {doubt}, which is not called {due.called}", due.right)


def _merged(some: tuple[Write, ...]) -> Iterator[Write]:
    """One write for each register: the last, with what earlier ones left there."""
    for register in dict.fromkeys(one.register for one in some):
        there = [one for one in some if one.register == register]
        bits = {number: on for (_, number), on in image(there).items()}
        if len(there) == 1:
            yield there[0]
        elif any(one.value is not None for one in there):
            yield replace(there[-1], value=sum(on << number for number, on in bits.items()), set=(), clear=())
        else:
            ones, zeros = (tuple(Span(n, n) for n, on in bits.items() if on is want) for want in (True, False))
            yield replace(there[-1], set=ones, clear=zeros)


def _passed(drive: Drive, command: Command, due: _Due, report: Report) -> bool:
    """Note what writes on the way are called and must not be; whether there was such."""
    found = False
    for one in command.writes if command.first else ():
        for said in _said(drive, one):
            if said.holds and said.alone and said.meaning & due.never & _MOTION:
                wrong = f"on its way `{command.does}` writes what the register calls {said}"
                report.add(said.place, wrong, "correct the value or bit, or the register's table")
                found = True
    return found


def _exchanged(drive: Drive, command: Command, said: list[_Said], report: Report) -> bool:
    """Note a stop that is called by the kind of another, which is not called so itself: no reason excuses that."""
    for other in drive.operation.commands if command.does in ("stop", *_KINDS) else ():
        kind = _KINDS.get(other.does, "")
        words = [part for one in _merged(acting(other)) for part in _said(drive, one)]
        if other.does != command.does and kind in _all(said) - _all(words):
            called = f"what the register calls {_DUE[other.does].called}, and `{other.does}` does not"
            place = command.place(key(command, bool(command.set)))
            report.add(place, f"`{command.does}` writes {called}", "exchange them, or correct the register's table")
            return True
    return False


def _said(drive: Drive, one: Write) -> Iterator[_Said]:
    """What the register calls the parts of a write: a value, values of fields, single bits."""
    row = drive.register_at(one.register, "w")
    if row is None:
        return
    where = one.place("value"), one.register
    for each in row.values:
        if each.value == one.value:
            yield _Said(*where, each.name, each.text_zh or "", on=True)
    if not row.values and not row.bits:
        writers = [each for each in drive.operation.commands if one.register in {w.register for w in each.writes}]
        yield _Said(*where, row.name or "", row.text_zh or "", on=True, alone=len(writers) == 1)
    yield from _said_bits(one, row)


def _said_bits(one: Write, row: Register) -> Iterator[_Said]:
    bits = written(one)
    for bit in row.bits:
        ours = tuple(place for place in bit.bit if place in bits)
        on = any(bits[place] for place in ours)
        where = one.place(key(one, on)), one.register
        value = field_value(bit, bits) if ours and bit.values else None
        if value is not None:
            yield _Said(*where, value.name, value.text_zh or "", on=on, bits=ours)
        elif ours and not bit.unused:
            alone = not on or len(bit.bit) == 1
            name = bit.name or ""
            yield _Said(*where, name, bit.text_zh or "", on=on, value=False, bits=ours, alone=alone)


def _contrary(due: _Due, one: _Said, said: list[_Said]) -> bool:
    """Whether the register calls it something else; a stop in the word of a reset is a doubt, if it says reset, too."""
    if not one.holds or not one.alone or not one.meaning:
        return False
    beside = one.meaning <= due.doubts and any(need <= _all(said) for need in due.needs)
    return bool(one.meaning & due.never) or not (one.meaning & due.only or beside)


def _taken(due: _Due, one: _Said, said: list[_Said]) -> bool:
    """Whether the command takes away just what it should give: forward cleared by a forward run."""
    own = due.needs[0] & {FORWARD, REVERSE}
    gone = one.meaning <= own | {RUN} and not one.meaning <= _all(said)
    return bool(own and one.meaning) and not one.holds and gone


def _all(said: list[_Said]) -> Meaning:
    return frozenset(meaning for one in said if one.holds and one.alone for meaning in one.meaning)


def _doubt(due: _Due, said: list[_Said], ended: Meaning) -> str | None:
    """What the command writes that the table does not call so, if it writes such."""
    for one in said:
        if not one.alone:
            return f"an unlisted value of {one}"
        if (one.on and not one.meaning) or (one.holds and one.meaning & due.doubts):
            return str(one)
    if any(need <= _all(said) | ended for need in due.needs):
        return None
    return ", ".join(str(one) for one in said if one.on or one.value) or "only zeros"


def _ended(drive: Drive, command: Command, said: list[_Said]) -> Meaning:
    """What undoing means: a stop of the motion, or of the jog, that writes the contrary to these bits."""
    now = image(acting(command))
    undone = {(one.register, place) for one in said if not one.holds and not one.value for place in one.bits}
    ended: set[str] = set()
    for other in drive.operation.commands:
        moved = image(acting(other)) if other.does in MOVES else {}
        if any(moved.get(place, now[place]) != now[place] for place in undone):
            ended |= {STOP, JOG} if other.does in JOGS else {STOP}
    return frozenset(ended)


def sets_off(drive: Drive, motion: Command) -> frozenset[tuple[int, int]]:
    """The bits that make a motion: those that it sets, and those that it clears where the table calls just that so."""
    found = {place for one in motion.writes for place, on in image([one]).items() if on}
    for one in _merged(acting(motion)):
        for said in _said(drive, one):
            if said.holds and said.alone and not said.on and said.meaning & _MOTION:
                found |= {(said.register, bit) for bit in said.bits}
    return frozenset(found)
