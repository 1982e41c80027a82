"""Judges a line of drives by what cannot be argued away: bytes on the wire, true shafts, and the pins of the blocks.

It knows no vendor map, no state of a block, and no reply.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from tests.second.figures import ATTEND_US
from tests.second.frames import ascii_opened, opened

RUN, JOG = ("RunForward", "RunReverse"), ("JogForward", "JogReverse")
MOVES = RUN + JOG
STOPPING = ("QuickStop", "CoastStop", "StopAll", "Restart", "MonitorOnly", "SpeedOnly", "SupplyOff", "Left", "Doubled")
"""Pins that stop while they are TRUE; `Left` is for a block that is not called, `Doubled` for an address that two slots
have. Enable stops while it is FALSE."""

RAMP_US = 100_000
"""What a second model takes for 1 Hz."""
STANDING = {"stop", "confirmed"}
"""Rules that hold where it stands and nobody runs it."""
Seen = tuple[object, ...]
"""What is seen of a broken rule; it becomes words only when one breaks, since rules are asked thousands of times."""
BRIEF_US = 500_000
"""What was driven for less than this may never have been read as running: it is still a start."""
TURNED_US = 1_000_000
"""From the status that shows the other direction to the stop."""


@dataclass(frozen=True, slots=True)
class Wish:
    """What pins ask for."""

    moves: tuple[str, ...]
    """Run and jog pins that are TRUE."""
    runs: bool
    """One of them is a run pin."""
    stops: bool
    """None is, or another pin stops it all the same."""


class Pins(dict[str, Any]):
    """Pins of a block. What they ask for is reckoned when one changes, not in every scan."""

    def __init__(self, pins: Mapping[str, object]) -> None:
        """A copy of pins."""
        super().__init__(pins)
        self.true = {name for name, value in pins.items() if value is True}
        self.known: Wish | None = None
        """What they ask for, once it was reckoned."""

    def __setitem__(self, name: str, value: object) -> None:
        """Set a pin."""
        self.known = None
        (self.true.add if value is True else self.true.discard)(name)
        super().__setitem__(name, value)


@dataclass(frozen=True, kw_only=True)
class Figures:
    """What is promised; times in microseconds."""

    stop_us: int
    """From a pin that stops to standstill, or to the open contact."""
    coast_us: int = 0
    """How much longer it may turn without output."""
    seen_us: int = 0
    """How long StopConfirmed may outlive the start of a motion that the bus has not begun."""
    follow_us: int = 2_000_000
    """How long the motor may be faster than a reference that was lowered, beside its ramp."""
    unseen_us: int = 0
    """A drive that goes on by itself so soon was not seen to stop: a dip of the supply that it rides through."""
    still_hz: float = 0.1
    """What counts as standstill: less than the coarsest monitor shows."""
    coast_counts: bool = False
    """StopConfirmed is wrong, too, while the motor coasts without output."""


@dataclass(slots=True)
class Truth:
    """A motor as it truly is."""

    hz: float
    by: str = ""
    """Who drives it: bus, keypad, terminals; empty: it has no output."""
    stopping: bool = False
    """The drive ramps it down to a stop, whoever has asked."""
    contact_open: bool = False
    """The hard stop has cut its supply."""
    turned: bool = False
    """Somebody else has turned its direction round, which the block must see and stop."""
    itself: bool = False
    """The drive has taken up a command by itself: no start of the block, which must stop it."""
    stood_us: int | None = None
    """When it last showed that it does not run; None: nobody looks."""


def any_of(names: Iterable[str], pins: Mapping[str, object]) -> bool:
    """Whether one of these pins is TRUE; by their set where there is one: this is asked thousands of times a second."""
    return not pins.true.isdisjoint(names) if isinstance(pins, Pins) else any(pins.get(name) for name in names)


def most_hz(pins: Mapping[str, object]) -> float:
    """The reference, within the limit that the pins give."""
    asked, limit = pins.get("SpeedReferenceHz", 0.0), pins.get("MaximumHz", 0.0)
    assert isinstance(asked, float)
    assert isinstance(limit, float)
    return min(asked, limit) if limit else asked


def spoilt(pins: Mapping[str, object]) -> bool:
    """Whether a run is asked for with a negative reference, which stops it."""
    hz = pins.get("SpeedReferenceHz", 0.0)
    return isinstance(hz, float) and hz < 0.0 and any_of(RUN, pins)


def both(pins: Mapping[str, object]) -> bool:
    """Whether both directions are asked for, which is none."""
    return any_of(("RunForward", "JogForward"), pins) and any_of(("RunReverse", "JogReverse"), pins)


def wish(pins: Mapping[str, object]) -> Wish:
    """What pins ask for."""
    if isinstance(pins, Pins) and pins.known is not None:
        return pins.known
    moves = tuple([name for name in MOVES if pins.get(name)])
    stops = spoilt(pins) or not moves or not pins.get("Enable", True) or any_of(STOPPING, pins)
    found = Wish(moves, any_of(RUN, pins), stops)
    if isinstance(pins, Pins):
        pins.known = found
    return found


@dataclass(slots=True)
class Watch:
    """What is remembered of one motor."""

    asked_before: tuple[str, ...] = RUN
    permitted: bool = False
    """A run or jog pin rose after the last stop, and is still TRUE."""
    driven: bool = False
    ours: bool = False
    """It turns because of the bus."""
    stop_since: int | None = None
    others_since: int | None = None
    most_hz: float = 0.0
    before_hz: float = 0.0
    """What that was when it was last driven."""
    lowered_at: int = 0
    asked_hz: float = 0.0
    asked_us: int = 0
    """The largest that was asked for just before it was driven, and when."""
    turned_since: int | None = None
    left_us: int | None = None
    """Since when its block is called no longer, with nothing but that against a run that was permitted."""
    caught: bool = False
    """It was still turning the other way when it was started or its pin rose, and is braked and turned round."""
    interrupted: bool = False
    began_us: int = 0
    ended_us: int = 0
    """When it was last driven, and no longer; and whether it was permitted to be until then."""
    broken: set[str] = field(default_factory=set)
    """Rules that are broken at present: each is reported once."""


class Observer:
    """Watches a line; `found` are broken rules: time, unit, rule, what was seen."""

    def __init__(
        self, stores: Mapping[int, Callable[[bytes], bool]], figures: Figures, *, ascii_: bool = False
    ) -> None:
        """Units of the blocks, each with what says of a request without checksum that it stores."""
        self.stores, self.figures = stores, figures
        self.opened = ascii_opened if ascii_ else opened
        self.watches = {unit: Watch() for unit in stores}
        self.may_store: set[int] = set()
        """Units for which somebody has asked to store."""
        self.found: list[tuple[int, int, str, str]] = []

    def sent(self, now_us: int, frame: bytes) -> None:
        """A frame of the master."""
        body = self.opened(frame)
        if body is None:
            self.found.append((now_us, -1, "frame", frame.hex()))
        elif body[0] not in self.stores:
            self.found.append((now_us, body[0], "unit", body.hex()))
        elif body[0] not in self.may_store and self.stores[body[0]](body):
            self.found.append((now_us, body[0], "store", body.hex()))

    def scan(self, now_us: int, unit: int, pins: Mapping[str, object], *, confirmed: bool, truth: Truth) -> None:
        """A scan: the pins that a block was called with, whether it shows StopConfirmed, and the motor after it."""
        watch, figures = self.watches[unit], self.figures
        wanted = wish(pins)
        asked, stops = wanted.moves, wanted.stops
        self._left(now_us, watch, pins, asked)
        rises = not stops and not watch.asked_before and bool(asked)
        watch.permitted = not stops and (not watch.asked_before or (watch.permitted and asked == watch.asked_before))
        watch.asked_before = asked
        turns = abs(truth.hz) > figures.still_hz
        watch.caught = watch.caught or (rises and turns)
        driven = truth.by == "bus" and not truth.stopping
        if driven and not watch.driven:
            short = now_us - watch.ended_us <= self.figures.unseen_us or watch.ended_us - watch.began_us < BRIEF_US
            unseen = short or (truth.stood_us is not None and truth.stood_us < watch.ended_us)
            if truth.itself and watch.interrupted and unseen and not stops:
                watch.permitted = True
            watch.caught, watch.began_us = turns, now_us
            waited = watch.left_us is not None and now_us - watch.left_us <= ATTEND_US
            self._judge(now_us, unit, "edge", bad=not (watch.permitted or truth.itself or waited), seen=truth)
        elif watch.driven and not driven:
            watch.interrupted, watch.ended_us = watch.permitted, now_us
            watch.permitted = False  # whatever has ended it: the next start needs an edge of its own
        watch.driven = driven
        watch.ours = truth.by == "bus" or (watch.ours and turns and not truth.by)
        if not (turns or driven):  # nothing is owed, and nothing is too fast: most drives in most scans
            watch.stop_since, watch.others_since, watch.most_hz = None, None, 0.0
            watch.broken -= STANDING
            self._asks(now_us, watch, pins)
            return
        owed = (stops or not watch.permitted) and watch.ours and (turns or driven)
        self._stop(now_us, unit, truth, stops=owed)
        self._confirmed(now_us, unit, truth, wrong=confirmed and turns)
        self._speed(now_us, unit, pins, truth)

    def _left(self, now_us: int, watch: Watch, pins: Mapping[str, object], asked: tuple[str, ...]) -> None:
        """Whether its block is called no longer since it was permitted to run, and nothing else has happened."""
        if not pins.get("Left") or asked != watch.asked_before or any_of(("StopAll", "Restart"), pins):
            watch.left_us = None
        elif watch.permitted:
            watch.left_us = now_us

    def _judge(self, now_us: int, unit: int, rule: str, *, bad: bool, seen: Truth) -> None:
        broken = self.watches[unit].broken
        if bad and rule not in broken:
            broken.add(rule)
            self.found.append((now_us, unit, rule, str(seen)))
        elif not bad:
            broken.discard(rule)

    def _stop(self, now_us: int, unit: int, truth: Truth, *, stops: bool) -> None:
        watch = self.watches[unit]
        owed = stops and not truth.contact_open
        watch.stop_since = (now_us if watch.stop_since is None else watch.stop_since) if owed else None
        most = self.figures.stop_us + (0 if truth.by else self.figures.coast_us)
        late = watch.stop_since is not None and now_us - watch.stop_since > most
        self._judge(now_us, unit, "stop", bad=late, seen=truth)

    def _confirmed(self, now_us: int, unit: int, truth: Truth, *, wrong: bool) -> None:
        watch, figures = self.watches[unit], self.figures
        if (truth.by in ("", "bus") and not truth.itself) or not wrong:
            watch.others_since = None
        elif watch.others_since is None:
            watch.others_since = now_us
        young = watch.others_since is not None and now_us - watch.others_since <= figures.seen_us
        coasts = not truth.by and not figures.coast_counts
        self._judge(now_us, unit, "confirmed", bad=wrong and not young and not coasts, seen=truth)

    def _asks(self, now_us: int, watch: Watch, pins: Mapping[str, object]) -> None:
        """What a start would ask for, or has just asked for."""
        most = most_hz(pins)
        if most >= watch.asked_hz or now_us - watch.asked_us > self.figures.follow_us:
            watch.asked_hz, watch.asked_us = most, now_us

    def _speed(self, now_us: int, unit: int, pins: Mapping[str, object], truth: Truth) -> None:
        """Not faster than asked, and not the other way round; a jog has a speed of its own."""
        watch, figures = self.watches[unit], self.figures
        most = most_hz(pins)
        if not watch.driven or not wish(pins).runs:
            watch.before_hz, watch.most_hz = watch.most_hz or watch.before_hz, 0.0
            self._asks(now_us, watch, pins)
            return
        if truth.itself and not watch.most_hz:  # without its supply it has heard of no other reference
            watch.most_hz, watch.lowered_at = max(most, watch.before_hz), now_us
        elif not watch.most_hz:  # it may have coasted, or been started with a reference that was lowered just then
            watch.most_hz, watch.lowered_at = max(most, abs(truth.hz), watch.asked_hz), now_us
        elif most >= watch.most_hz:
            watch.most_hz, watch.lowered_at = most, now_us
        elif now_us - watch.lowered_at > self.figures.follow_us + int(RAMP_US * (watch.most_hz - most)):
            watch.most_hz = most
        if not watch.permitted:
            return
        far = abs(truth.hz) > watch.most_hz + 0.01 * watch.most_hz + self.figures.still_hz
        wrong_way = truth.hz * (-1 if pins.get("RunReverse") else 1) < -self.figures.still_hz
        self._judge(now_us, unit, "speed", bad=far, seen=truth)
        others = truth.turned or truth.itself
        watch.turned_since = (watch.turned_since or now_us) if wrong_way and others else None
        watch.caught = watch.caught and wrong_way
        young = watch.turned_since is not None and now_us - watch.turned_since <= figures.unseen_us + TURNED_US
        excused = young or watch.caught or truth.contact_open
        self._judge(now_us, unit, "direction", bad=wrong_way and not excused, seen=truth)
