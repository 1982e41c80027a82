"""What the status words show: for each situation of the drive, words in which just the map's right conditions hold."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from itertools import product

from driveblocks.maps.model import Drive
from driveblocks.meaning.pattern import WORD, Pattern
from driveblocks.meaning.status import State, registers, status
from driveblocks.meaning.words import words


@dataclass(frozen=True, order=True)
class Situation:
    """What a drive is doing, as far as status words can show it."""

    fault: bool = False
    running: bool = False
    reverse: bool = False
    at_speed: bool = False
    zero_speed: bool = True
    ready: bool = True
    warning: bool = False

    @property
    def key(self) -> int:
        """The facts as the bits of a number, the first one lowest."""
        return sum(getattr(self, field.name) << place for place, field in enumerate(fields(self)))


@dataclass(frozen=True)
class Fact:
    """Something that words show while one of these alternatives holds whole."""

    wanted: bool
    any: tuple[tuple[Pattern, ...], ...]
    pin: str = ""
    """The pin that shows it; empty: none does."""

    def shown(self, words: dict[int, int]) -> bool:
        """Whether the words show it."""
        return any(all(each.holds(words[each.register]) for each in all_) for all_ in self.any)


Words = dict[int, int]
_DISABLED = re.compile(r"switch(ing|ed)?[ -]on (disabled|inhibited)", re.IGNORECASE)
"""How manuals name the bit of CiA 402 and PROFIdrive."""


def situations() -> Iterator[Situation]:
    """Every situation that a drive can be in."""
    for warning, zero in product((False, True), (False, True)):
        yield Situation(zero_speed=zero, warning=warning)
        yield Situation(zero_speed=zero, ready=False, warning=warning)
        yield Situation(fault=True, zero_speed=zero, ready=False, warning=warning)
        for reverse, at_speed in product((False, True), (False, True)):
            if not (zero and at_speed):
                yield Situation(running=True, reverse=reverse, at_speed=at_speed, zero_speed=zero, warning=warning)


def awaited(drive: Drive) -> tuple[State, ...]:
    """The states that a write waits for; the others of a map's chart follow from what else is shown."""
    names = {write.until for command in words(drive).commands for write in command.writes}
    return tuple(each for each in status(drive).states if each.name in names)


def named_bits(drive: Drive, measured: frozenset[int]) -> Words:
    """The bits of status words that conditions name."""
    facts = _facts(drive, measured, Situation(), None)
    bits: Words = {}
    for pattern in (each for fact in facts for all_ in fact.any for each in all_):
        bits[pattern.register] = bits.get(pattern.register, 0) | pattern.mask
    return bits


def face(drive: Drive, measured: frozenset[int], situation: Situation, state: str | None) -> Words:
    """The status words of a situation, but for bits that no condition names, which are 0.

    Where a map's conditions exclude each other, the earlier fact of `_facts` is shown: a fault before all.
    """
    facts = _facts(drive, measured, situation, state)
    options = [_options(fact) for fact in facts]
    registers = {each.register for fact in facts for all_ in fact.any for each in all_}
    candidates = [words for chosen in product(*options) if (words := _together(chosen, registers)) is not None]
    shown = max(candidates, key=lambda words: ([fact.shown(words) == fact.wanted for fact in facts], _least(words)))
    if state is None and awaited(drive) and not situation.fault and not situation.running:
        return _waiting(drive, shown, facts)
    return shown


def misshown(drive: Drive, measured: frozenset[int]) -> Iterator[str]:
    """Pins that no words of the status show as they should be: scenes do not hold for such a map. In words."""
    found: dict[tuple[str, bool], Situation] = {}
    for situation in situations():
        words_ = face(drive, measured, situation, None)
        for fact in _facts(drive, measured, situation, None):
            if fact.pin and fact.shown(words_) != fact.wanted:
                found.setdefault((fact.pin, fact.wanted), situation)
    states = " or ".join(each.name for each in awaited(drive))
    for (pin, wanted), situation in found.items():
        told = [field.name.replace("_", " ") for field in fields(situation) if getattr(situation, field.name)]
        none = f", in none of the states {states}" if states and not situation.running and not situation.fault else ""
        yield f"no words of its status show `{pin}` {str(wanted).upper()} of a drive that is {' and '.join(told)}{none}"


def _waiting(drive: Drive, words: Words, facts: tuple[Fact, ...]) -> Words:
    """The words of a drive that goes through states and is in none: the bit that says so, unless it says more.

    A map may have that as a state, too, in which a drive is after power-up.
    """
    states = [Fact(False, ((each.pattern,),)) for each in awaited(drive)]
    told = [fact for fact in facts if fact not in states]
    for register in registers(each.pattern for each in awaited(drive)):
        row = drive.register_at(register)
        for bit in (each.bit.first for each in (row.bits if row else ()) if _DISABLED.match(each.name or "")):
            made = {**words, register: words.get(register, 0) | 1 << bit}
            if all(fact.shown(made) == fact.shown(words) for fact in told):
                return made
    return words


def _least(words: Words) -> list[int]:
    return [-word for _, word in sorted(words.items())]


def _facts(drive: Drive, measured: frozenset[int], situation: Situation, state: str | None) -> tuple[Fact, ...]:
    """What must be shown and what must not, what matters most first; measures show themselves."""
    shows = status(drive)
    stands = tuple(each for each in shows.standstill.patterns if each.register not in measured)

    def fact(name: str, *, wanted: bool) -> Fact:
        return Fact(wanted, tuple((each,) for each in shows.shows(name) if each.register not in measured), name)

    named = {each.name: Fact(each.name == state, ((each.pattern,),)) for each in awaited(drive)}
    now = [named.pop(state)] if state in named else []
    facts = (
        fact("fault", wanted=situation.fault),
        *now,
        fact("running", wanted=situation.running),
        fact("reverse", wanted=situation.reverse),
        *([] if situation.running else named.values()),
        fact("zero_speed", wanted=situation.zero_speed),
        Fact(not situation.running, (stands,) if stands else ()),
        fact("at_speed", wanted=situation.at_speed),
        fact("ready", wanted=situation.ready),
        fact("warning", wanted=situation.warning),
        fact("limit", wanted=False),
        *(named.values() if situation.running else []),
    )
    return tuple(each for each in facts if each.any)


def _options(fact: Fact) -> list[tuple[Pattern, ...]]:
    """Ways to help a fact: nothing; an alternative as it is; or a bit that one wants to be 0, turned."""
    if fact.wanted:
        return [(), *(tuple(replace(each, value=each.word, is_="=") for each in all_) for all_ in fact.any)]
    others = (each for all_ in fact.any for each in all_ if each.is_ != "=")
    turned = [(each.other,) for each in others]
    turned += [
        (Pattern(each.register, 1 << bit, 1 << bit),)
        for all_ in fact.any
        for each in all_
        if each.is_ == "="
        for bit in _zeros(each)
    ]
    return [(), *turned]


def _zeros(pattern: Pattern) -> list[int]:
    """Bits that a pattern wants to be 0: of one that 0 fulfils all, of another that which is alone in it."""
    found = [bit for bit in range(16) if (pattern.mask & ~pattern.value) >> bit & 1]
    return found if pattern.value == 0 or len(found) == 1 else []


def _together(chosen: Iterable[tuple[Pattern, ...]], registers: Iterable[int]) -> Words | None:
    """The words that fulfil all patterns, or None where two exclude each other."""
    words, fixed = dict.fromkeys(registers, 0), dict.fromkeys(registers, 0)
    for pattern in (each for patterns in chosen for each in patterns):
        if (words[pattern.register] ^ pattern.value) & pattern.mask & fixed[pattern.register] & WORD:
            return None
        words[pattern.register] |= pattern.value
        fixed[pattern.register] |= pattern.mask
    return words
