"""Rules on what commands mean: the register's own table must call what a command writes by what the command does."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Bit, Command, Does, Drive, Register, Value
from driveblocks.maps.problem import Report
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

    key: str
    name: str
    zh: str
    on: bool
    """Whether any bit of it is set."""
    value: bool = True
    """Whether it is a value, of the word or of a field; else a bit, or bits, without values."""
    bits: tuple[int, ...] = ()
    alone: bool = True
    """FALSE: the name of a register that several commands write, or of a field, which tells nothing of one value."""

    @property
    def meaning(self) -> Meaning:
        return term.of(self.name, self.zh)

    @property
    def holds(self) -> bool:
        """Whether the drive is told this; else it is told the contrary."""
        return (self.on or self.value) != term.negated(self.name, self.zh)

    def __str__(self) -> str:
        return f"`{self.name}` {self.zh}".rstrip()


def written(command: Command) -> dict[int, bool]:
    """The bits that a command writes, and what it writes there."""
    if command.value is not None:
        return {number: bool(command.value >> number & 1) for number in range(16)}
    ones = {number: True for span in command.set for number in span}
    return {number: False for span in command.clear for number in span} | ones


def key(command: Command, one: bool) -> str:
    """The key under which a command writes a bit."""
    return "value" if command.value is not None else "set" if one else "clear"


def number(field: Bit, bits: dict[int, bool]) -> int:
    """The number in a field of which every bit is written."""
    return sum(bits[place] << place - field.bit.first for place in field.bit)


def field_value(field: Bit, bits: dict[int, bool]) -> Value | None:
    """The listed value of a field of which every bit is written."""
    return next((value for value in field.values if value.value == number(field, bits)), None)


def check(drive: Drive, command: Command, row: Register, report: Report) -> None:
    """Note a command that the register calls something else, and one that it does not call so without a reason."""
    due, said = _DUE[command.does], list(_said(drive, command, row))
    contrary = [one for one in said if _contrary(due, one)]
    taken = [one for one in said if _taken(due, one, said)]
    for one in contrary or taken:
        calls = "but the register calls it" if contrary else "but it clears what the register calls"
        wrong = f"`{command.does}`, {calls} {one}"
        report.add(command.place(one.key), wrong, "correct the value or bit, or the register's table")
    if contrary or taken:
        return
    doubt = _doubt(due, said, _ended(drive, command, said))
    if command.because is not None and doubt is None:
        wrong = f"`because` explains nothing: the register's table calls this {due.called}"
        report.add(command.place("because"), wrong, "remove it")
    elif command.because is None and doubt is not None:
        place = command.place(key(command, bool(command.set)))
        report.miss(place, f"`{command.does}` writes {doubt}, which is not called {due.called}", due.right)


def _said(drive: Drive, command: Command, row: Register) -> Iterator[_Said]:
    """What the register calls the parts of what a command writes: a value, values of fields, single bits."""
    for one in row.values:
        if one.value == command.value:
            yield _Said("value", one.name, one.text_zh or "", on=True)
    if not row.values and not row.bits:
        writers = [one for one in drive.operation.commands if one.register == command.register]
        yield _Said("value", row.name or "", row.text_zh or "", on=True, alone=len(writers) == 1)
    bits = written(command)
    for bit in row.bits:
        ours = tuple(place for place in bit.bit if place in bits)
        on = any(bits[place] for place in ours)
        value = field_value(bit, bits) if ours and bit.values else None
        if value is not None:
            yield _Said(key(command, on), value.name, value.text_zh or "", on=on, bits=ours)
        elif ours and not bit.unused:
            yield _Said(
                key(command, on),
                bit.name or "",
                bit.text_zh or "",
                on=on,
                value=False,
                bits=ours,
                alone=not on or len(bit.bit) == 1,
            )


def _contrary(due: _Due, one: _Said) -> bool:
    """Whether the register calls it something else."""
    return one.holds and one.alone and bool(one.meaning & due.never or (one.meaning and not one.meaning & due.only))


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
    """What clearing means: a stop of the motion, or of the jog, that sets these bits of the register."""
    cleared = {place for one in said if not one.holds and not one.value for place in one.bits}
    ended: set[str] = set()
    for other in drive.operation.commands:
        moves = other.does in MOVES and other.register == command.register
        if moves and any(on and place in cleared for place, on in written(other).items()):
            ended |= {STOP, JOG} if other.does in JOGS else {STOP}
    return frozenset(ended)
