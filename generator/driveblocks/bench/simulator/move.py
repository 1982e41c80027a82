"""What a write of the map makes the drive do: commands, and the states on the way to them, as conditions."""

from collections.abc import Iterator
from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.words import KINDS, MOTIONS, Command, Write, words

STATE = "state"
EFFECTS = (*KINDS.values(), "fault_reset", STATE, *MOTIONS)
"""What a move does, those that win over others in the same write first."""


@dataclass(frozen=True)
class Need:
    """What must be there before a move: another register's bits, or this register's own before the write."""

    pattern: Pattern
    before: bool
    """The register's word before the write, as for an edge; otherwise the word as it is now."""
    for_ms: int
    """How long it must have been there."""


@dataclass(frozen=True)
class Move:
    """A word that does something."""

    effect: str
    pattern: Pattern
    needs: tuple[Need, ...] = ()
    guard: str | None = None
    """The state in which alone it acts; None: in any."""
    into: str | None = None
    """The state that it leads to."""


def moves(drive: Drive) -> tuple[Move, ...]:
    """Every move of a map; the states of steps that several commands share only once.

    A step that waits for a state makes the next write act in that state only. Another step that the next write of
    its register contradicts makes an edge or a pulse of it; one that nothing contradicts must still be there.
    A run that a negative reference turns round is no move of its own.
    """
    found = dict.fromkeys(move for command in words(drive).commands if not command.negative for move in _path(command))
    return tuple(sorted(found, key=lambda move: EFFECTS.index(move.effect)))


def _path(command: Command) -> Iterator[Move]:
    guard: str | None = None
    before: list[Write] = []
    for step in command.writes[:-1]:
        if step.until is None:
            before.append(step)
            continue
        pattern = step.pattern
        yield Move(STATE, pattern, _needs(before, pattern), guard, step.until)
        guard, before = step.until, []
    pattern = command.last.pattern
    yield Move(command.does, pattern, _needs(before, pattern), guard)


def _needs(steps: list[Write], pattern: Pattern) -> tuple[Need, ...]:
    """What the last step on each register asks."""
    last = {step.register: step for step in steps}
    patterns = [(step.pattern, step.for_ms) for step in last.values()]
    return tuple(Need(each, each.excludes(pattern), for_ms) for each, for_ms in patterns)
