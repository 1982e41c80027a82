"""What the words of a drive show: running and the like, standstill, named states, who commands it, what it is."""

from collections.abc import Iterable
from dataclasses import dataclass

from driveblocks.maps.model import Condition, Drive, kept
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.pattern import Pattern, of_condition

Patterns = tuple[Pattern, ...]


@dataclass(frozen=True)
class Sign:
    """What is shown while one of some patterns holds, or all of them do."""

    name: str
    said: Citation
    patterns: Patterns
    why: str = ""
    """Why this proves it."""


NOTHING = Sign("nothing", Citation(None, ""), ())


@dataclass(frozen=True)
class State:
    """A named state, which writes wait for."""

    name: str
    said: Citation
    pattern: Pattern


@dataclass(frozen=True)
class Status:
    """All that is compared with words of a drive."""

    shown: tuple[Sign, ...]
    """What pins show: each while one of its patterns holds."""
    standstill: Sign
    """It is proved while all hold."""
    states: tuple[State, ...]
    verify: Patterns
    """Settings with which the reference means what the map says, all of them."""
    forbids: tuple[Sign, ...]
    """Nothing starts while one of the patterns of one of these holds."""
    by_bus: Sign
    """The bus commands the drive while all hold; none: nothing shows it."""
    identity: Sign
    """It is of the family if all hold; none: nothing shows it."""

    def shows(self, name: str) -> Patterns:
        """The patterns of a pin; none where the drive does not show it."""
        return next((one.patterns for one in self.shown if one.name == name), ())

    @property
    def settled(self) -> Patterns:
        """What registers of settings and identity hold where all is as it should be, and nothing forbids a start."""
        return (*self.verify, *self.by_bus.patterns, *self.identity.patterns, *self.allowed)

    @property
    def allowed(self) -> Patterns:
        """With these nothing forbids a start."""
        return tuple(each.other for one in self.forbids for each in one.patterns)


@kept
def status(drive: Drive) -> Status:
    """What a map says of the words that are read."""
    run, still = drive.operation, drive.operation.standstill
    bus, identity = run.commanded_by, drive.identity

    def made(conditions: Iterable[Condition]) -> Patterns:
        return tuple(of_condition(one, drive.register_at(one.register)) for one in conditions)

    return Status(
        shown=tuple(Sign(one.shows, cited(one), made(one.any)) for one in run.status),
        standstill=Sign("standstill", cited(still), made(still.all), still.why),
        states=tuple(State(one.name, cited(one), of_condition(one)) for one in run.states),
        verify=made(run.reference.verify),
        forbids=tuple(Sign("no start", cited(one), made(one.any), one.why) for one in run.forbids),
        by_bus=Sign("by bus", cited(bus), made(bus.all)) if bus else NOTHING,
        identity=Sign("identity", cited(identity), made(identity.all), identity.why) if identity else NOTHING,
    )


def registers(patterns: Iterable[Pattern]) -> tuple[int, ...]:
    """The registers of some patterns, each once, in their order."""
    return tuple(dict.fromkeys(each.register for each in patterns))
