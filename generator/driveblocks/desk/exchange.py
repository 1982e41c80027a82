"""What is said on a line: who asks whom, which reply belongs to which request, and what is still owed."""

from collections import Counter, deque
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Literal

from driveblocks.desk.frames import Frame
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect
from driveblocks.modbus.envelope import mode_of
from driveblocks.modbus.frame import Mode, opened
from driveblocks.modbus.layout import Dialect, Layout, bytes_of, take
from driveblocks.modbus.request import Asked, asked_by

Role = Literal[
    "request", "broadcast", "reply", "refusal", "echo", "late", "twice", "late or twice", "unasked", "unclear",
    "strange", "damaged",
]  # fmt: skip
"""`echo`: a request once more, too soon for its master; `late`: another request was sent since; `twice`: a second reply
to one request; `unasked`: no request was heard; `unclear`: a reply to either of two requests; `strange`: one that has
not the form of a reply to ours."""

HASTY_US = 20_000
"""A request so soon after another that has no reply: hardly a master gives up that fast."""
ECHO_US = 25_000
"""The same request so soon again: hardly a master sends it, and an adapter may be 16 ms late."""
ECHOED = (5, 6, 8)
"""Functions whose reply is the request once more."""
FORGOTTEN_US = 3_000_000
"""A reply that comes later belongs to no request."""
LATE_US = 1_500_000
"""What replies later than a gateway would is silent."""


@dataclass
class Poll:
    """What is asked of a unit again and again: a function with an address and a quantity."""

    count: int = 0
    first_us: int = 0
    last_us: int = 0
    replies: int = 0
    refusals: int = 0
    unanswered: int = 0
    damaged: int = 0
    """Requests after which bytes came that made no frame."""
    shortest_us: int = 0
    longest_us: int = 0
    words: tuple[int, ...] = ()
    """The last ones, read or written."""

    @property
    def every_us(self) -> int:
        """The mean time between two requests; 0 for one alone."""
        return (self.last_us - self.first_us) // (self.count - 1) if self.count > 1 else 0


Key = tuple[int, int, int]
"""Function, address, quantity."""


@dataclass
class Unit:
    """What one address was asked and has said."""

    polls: dict[Key, Poll] = field(default_factory=dict)
    odd: Counter[Role] = field(default_factory=Counter)
    """Replies that are late, twice, unasked."""
    unclear: int = 0
    """Frames that are a reply sent twice, or a request that nobody has answered: they look the same."""


@dataclass(frozen=True)
class Request:
    """A request."""

    body: bytes
    asked: Asked
    end_us: int
    unsure: bool = False
    """It may be the reply to what was not heard."""
    mode: Mode = "rtu"
    spoilt: bool = False
    """Damaged bytes came after it, which may have been its reply."""

    def may_be_taken_for(self, other: "Request") -> bool:
        """Whether the reply to it could be one to another request as well; a refusal always could."""
        one, two = self.asked, other.asked
        if self.body == other.body or (one.unit, one.function) != (two.unit, two.function):
            return False
        counts = (
            (one.quantity, two.quantity) if one.function in (3, 4) else (bytes_of(one.quantity), bytes_of(two.quantity))
        )
        return one.function in (1, 2, 3, 4) and counts[0] == counts[1]

    def answered_by(self, reply: Layout) -> bool:
        """Whether a layout is the reply to it."""
        if not reply.fits or reply.body[0] != self.asked.unit:
            return False
        if reply.refusal:  # one by an address of its own does not say what was asked
            return reply.number("refused function") is None or reply.function == self.asked.function
        return reply.function == self.asked.function and self._granted_by(reply)

    def _granted_by(self, reply: Layout) -> bool:
        if self.asked.function in (3, 4):
            return len(reply.words) == self.asked.quantity
        if self.asked.function in (1, 2):
            return reply.number("byte count") == bytes_of(self.asked.quantity)
        if self.asked.function in (15, 16):
            return reply.body == self.body[:6]
        return self.asked.function not in ECHOED or reply.body == self.body


@dataclass(frozen=True)
class Said:
    """A frame, and what it is on this line; `asked`: the request that it is or answers."""

    frame: Frame
    role: Role
    layout: Layout | None = None
    asked: Asked | None = None


class Exchanges:
    """Everything that was said on a line."""

    def __init__(self, drives: Mapping[int, Drive], anyone: Drive | None = None, *, own: bool = False) -> None:
        """Drives by their units, and the one that every other unit is taken for; `own`: every request is ours."""
        self._drives, self.anyone, self._own = drives, anyone, own
        self.units: dict[int, Unit] = {}
        self.broadcasts = Counter[tuple[int, int]]()
        """By function and address."""
        self._styles = dict[Dialect, None]()
        self.unlike = 0
        """Second replies to one request that differ from the first."""
        self.frames = self.bytes = self.damaged = self.damaged_bytes = self.requests = self.hasty = self.echoes = 0
        self.begin_us = self.end_us = self.silence_us = 0
        self._open: Request | None = None
        self._unsure = not own
        """At the beginning, and after damaged bytes: what was asked before is not known."""
        self._spoilt = self._echo_came = False
        """Damaged bytes, or the echo, came since our last request."""
        self._given = deque[Request](maxlen=32 if own else 8)
        """Requests without a reply."""
        self._last: tuple[Request, bytes] | None = None
        """The last request that was answered, and its reply."""
        self._before: Request | None = None
        """The one that was answered before it."""

    @property
    def dialects(self) -> list[Dialect]:
        """How units refuse, by their maps; at least the standard's."""
        drives = [*self._drives.values(), *([self.anyone] if self.anyone else [])]
        self._styles |= dict.fromkeys([*map(dialect, drives), Dialect()])
        return [*self._styles]

    @property
    def doubles(self) -> int:
        """Second replies to one request."""
        return sum(unit.odd["twice"] + unit.odd["late or twice"] for unit in self.units.values())

    @property
    def waits(self) -> bool:
        """Whether the last request has no reply yet."""
        return self._open is not None

    def waiting(self, unit: int) -> int:
        """Requests to a unit that were given up just now, and may still be answered."""
        return sum(one.asked.unit == unit and self.end_us - one.end_us < FORGOTTEN_US for one in self._given)

    def drive(self, unit: int) -> Drive | None:
        """The map of a unit, as far as a person has named it."""
        return self._drives.get(unit, self.anyone)

    def hear(self, frame: Frame) -> Said:
        """The next frame of the line."""
        self._count(frame)
        if not frame.good:
            return self._broken(frame)
        body = opened("ascii", frame.data) or opened("rtu", frame.data) or b""
        reply, asking = self._reply(body), take(body, "request", self._style(body))
        given = self._open
        if given is not None and self._own and (self._hears_itself(body) or given.mode != mode_of(frame.data)):
            given = None
        if given is not None and given.answered_by(reply):
            return self._answer(frame, given, reply)
        if asking.fits and not reply.refusal and (said := self._echo(frame, asking) or self._foreign(frame, asking)):
            return said
        return self._stray(frame, reply)

    def _reply(self, body: bytes) -> Layout:
        """A frame as a reply, in the dialect in which it answers our request, if any."""
        reply = take(body, "reply", self._style(body))
        if not self._own or self._open is None or self._open.answered_by(reply):
            return reply
        others = (take(body, "reply", each) for each in self._styles)
        return next((each for each in others if self._open.answered_by(each)), reply)

    def _foreign(self, frame: Frame, asking: Layout) -> Said | None:
        """Somebody else's request; where all are ours, it is none."""
        return None if self._own else self._ask(frame, asking)

    def sent(self, frame: Frame) -> Said:
        """A request of ours."""
        self._count(frame)
        body = opened("ascii", frame.data) or opened("rtu", frame.data) or b""
        return self._ask(frame, take(body, "request", self._style(body)))

    def _style(self, body: bytes) -> Dialect:
        drive = self.drive(body[0])
        return Dialect() if drive is None else dialect(drive)

    def _hears_itself(self, body: bytes) -> bool:
        """Whether this is the echo of a write of ours, whose reply has the same bytes and comes after it."""
        last = self._open
        if last is None or body != last.body:
            return False
        return last.asked.function not in ECHOED or (self.echoes > 0 and not self._echo_came)

    def _echoed(self, frame: Frame, asking: Layout, given: Request) -> Said:
        self.echoes += 1
        self._echo_came = True
        return Said(frame, "echo", asking, given.asked)

    def _is_owed(self, one: Request, reply: Layout, frame: Frame) -> bool:
        """Whether a reply to the open request could be one to a request of ours that was given up."""
        again = self._open is not None and one.body == self._open.body
        return not again and one.answered_by(reply) and frame.end_us - one.end_us < LATE_US

    def owed(self, body: bytes, now_us: int) -> int:
        """How long to wait, in us, until no reply that is still owed could be taken for one to this request."""
        request = Request(body, asked_by(take(body, "request", Dialect())), now_us)
        left = (one.end_us + LATE_US - now_us for one in self._given if one.may_be_taken_for(request))
        return max(0, *left, 0)

    def repeats(self, body: bytes) -> bool:
        """Whether the reply that came last, once more, could be taken for one to this request."""
        request = Request(body, asked_by(take(body, "request", Dialect())), 0)
        return self._last is not None and self._last[0].may_be_taken_for(request)

    def _count(self, frame: Frame) -> None:
        self.begin_us = self.begin_us or frame.begin_us
        if self.end_us:
            self.silence_us = max(self.silence_us, frame.begin_us - self.end_us)
        self.end_us = frame.end_us
        self.frames += frame.good
        self.bytes += len(frame.data)

    def _broken(self, frame: Frame) -> Said:
        """Damaged bytes; what came before the first frame is the rest of one."""
        if self.frames or self._own:
            self.damaged += 1
            self.damaged_bytes += len(frame.data)
        if self._own:
            self._spoilt = True
        else:
            self._unsure = True
            self._given.clear()
        return Said(frame, "damaged")

    def _echo(self, frame: Frame, asking: Layout) -> Said | None:
        """A request that was sent just now, or the late reply to one that is its own reply; else nothing."""
        given = self._open
        if given is None:
            return None
        soon = frame.begin_us - given.end_us < ECHO_US or (self._own and self._hears_itself(asking.body))
        if given.body == asking.body and soon:
            return self._echoed(frame, asking, given)
        late = next((one for one in self._given if one.body == asking.body), None)
        if asking.function not in ECHOED or late is None or frame.begin_us - late.end_us >= FORGOTTEN_US:
            return None
        self._come(late)
        self._unit(late).unclear += 1
        return Said(frame, "late", asking, late.asked)

    def _ask(self, frame: Frame, asking: Layout) -> Said:
        asked = asked_by(asking)
        self._give_up(frame.begin_us, clear=asked.function not in ECHOED)
        one = Request(asking.body, asked, frame.end_us, self._unsure and asked.function in ECHOED, mode_of(frame.data))
        self._unsure = False
        self.requests += 1
        if asked.unit == 0:
            self.broadcasts[asked.function, asked.address] += 1
            return Said(frame, "broadcast", asking, asked)
        poll, self._open, self._spoilt, self._echo_came = self._poll(one), one, False, False
        poll.first_us = poll.first_us if poll.count else frame.begin_us
        poll.count, poll.last_us = poll.count + 1, frame.begin_us
        poll.words = asking.words or poll.words
        return Said(frame, "request", asking, asked)

    def _give_up(self, now_us: int, *, clear: bool) -> None:
        """The open request has no reply, and another one is sent; not `clear`: or somebody's late reply came."""
        given, self._open = self._open, None
        if given is None:
            return
        if self._unsure or self._spoilt:
            self._poll(given).damaged += 1
            if not self._own:
                return
        self._given.append(replace(given, spoilt=self._spoilt))
        if self._own:
            self._poll(given).unanswered += not self._spoilt
            return
        soon = now_us - given.end_us < HASTY_US
        again = self._last is not None and given.body == self._last[0].body == self._last[1]
        if given.unsure or again or (soon and given.asked.function in ECHOED):
            self._unit(given).unclear += 1
            self._poll(given).count -= 1
            return
        self._poll(given).unanswered += 1
        self.hasty += soon and clear

    def _answer(self, frame: Frame, one: Request, reply: Layout) -> Said:
        if self._own and any(self._is_owed(each, reply, frame) for each in self._given):
            self._unit(one).unclear += 1
            return Said(frame, "unclear", reply)
        if self._own:
            self._still_owe(one)
        poll, took = self._poll(one), frame.begin_us - one.end_us
        if not self._unsure:  # else it may be the reply to a request that was damaged
            poll.shortest_us = min(took, poll.shortest_us) if poll.replies + poll.refusals else took
            poll.longest_us = max(took, poll.longest_us)
            if not any(each.answered_by(reply) for each in self._given):  # else it may be the late one to that
                poll.words = reply.words or poll.words
        poll.refusals += reply.refusal
        poll.replies += not reply.refusal
        self._poll(one).damaged += self._spoilt
        self._before = self._last[0] if self._last else None
        self._open, self._last, self._unsure, self._spoilt = None, (one, reply.body), False, False
        return Said(frame, "refusal" if reply.refusal else "reply", reply, one.asked)

    def _still_owe(self, one: Request) -> None:
        """Of two requests with the same bytes the first is the one that is answered first."""
        first = next((each for each in self._given if each.body == one.body and not each.spoilt), None)
        if first is not None and one.end_us - first.end_us < LATE_US:
            self._given.remove(first)
            self._given.append(one)

    def _stray(self, frame: Frame, reply: Layout) -> Said:
        """A reply that answers no open request."""
        late = next((one for one in self._given if one.answered_by(reply)), None)
        if late is not None and frame.begin_us - late.end_us < FORGOTTEN_US:
            self._come(late)
            return self._odd(frame, reply, "late", late)
        last = None if self._last is None or self._unsure else self._last[0]
        if last is not None and self._own and self._before is not None and not last.answered_by(reply):
            last = self._before
        if last is None or not last.answered_by(reply) or frame.begin_us - last.end_us >= FORGOTTEN_US:
            if self._own and self._open is not None and self._open.asked.unit == reply.body[0]:
                return Said(frame, "strange", reply, self._open.asked)
            return self._odd(frame, reply, "unasked", None)
        late = next((one for one in self._given if one.body == last.body), None)
        if late is None or frame.begin_us - late.end_us >= FORGOTTEN_US:
            self.unlike += self._last is not None and last is self._last[0] and reply.body != self._last[1]
            return self._odd(frame, reply, "twice", last)
        self._come(late)
        return self._odd(frame, reply, "late or twice", last)

    def _come(self, late: Request) -> None:
        """The reply to a request that was given up."""
        self._given.remove(late)
        self._poll(late).unanswered -= self._poll(late).unanswered > 0

    def _odd(self, frame: Frame, reply: Layout, role: Role, one: Request | None) -> Said:
        """Note it, unless it may belong to what was asked before anybody listened."""
        if role == "unasked" and not self._own and frame.begin_us - self.begin_us < FORGOTTEN_US:
            return Said(frame, role, reply)
        self.units.setdefault(reply.body[0], Unit()).odd[role] += 1
        return Said(frame, role, reply, None if one is None else one.asked)

    def _unit(self, one: Request) -> Unit:
        return self.units.setdefault(one.asked.unit, Unit())

    def _poll(self, one: Request) -> Poll:
        key = one.asked.function, one.asked.address, one.asked.quantity
        return self._unit(one).polls.setdefault(key, Poll())


@dataclass(frozen=True)
class Quality:
    """How well a line carries what we ask and what is answered; each is a number of exchanges."""

    exchanges: int = 0
    good: int = 0
    refused: int = 0
    damaged: int = 0
    """No reply but damaged bytes, or both."""
    late: int = 0
    """The reply came when it was not waited for any more."""
    doubled: int = 0
    """A reply came once more, or one that nobody had asked for."""
    silent: int = 0

    def __str__(self) -> str:
        """In one line, for a person."""
        if not self.exchanges:
            return "nothing was asked"
        share = (f"{100 * getattr(self, name) / self.exchanges:.1f} % {name}" for name in PARTS)
        return f"{self.exchanges} exchanges: {', '.join(share)}"

    def __sub__(self, before: "Quality") -> "Quality":
        """What came since."""
        return Quality(**{each.name: getattr(self, each.name) - getattr(before, each.name) for each in fields(self)})

    def share(self, name: str) -> float:
        """One of `PARTS`, as a part of all."""
        count: int = getattr(self, name)
        return count / max(1, self.exchanges)

    @property
    def is_good(self) -> bool:
        """Whether it may be called so: enough was asked, and hardly anything was lost."""
        lost = (self.damaged + self.silent) / max(1, self.exchanges)
        return self.exchanges >= ENOUGH and lost <= MOST_LOST and not self.troubles

    @property
    def verdict(self) -> str:
        """What may be said of the line."""
        if self.troubles:
            return f"too much is {' and '.join(self.troubles)}"
        if self.is_good:
            return "a good line"
        return f"called good after {ENOUGH} exchanges at least" if self.exchanges < ENOUGH else "a fair line"

    @property
    def troubles(self) -> tuple[str, ...]:
        """Which of `PARTS` are more than a line of this length explains."""
        return tuple(name for name, most in MOST.items() if getattr(self, name) > max(1, most * self.exchanges))


PARTS = ("good", "refused", "damaged", "late", "doubled", "silent")
COUNTED = (1, 2, 3, 4, 5, 6, 15, 16)
"""Functions that every drive answers."""
ENOUGH = 200
"""Exchanges from which on a line may be called good."""
MOST_LOST = 0.02
MOST = {"damaged": 0.02, "late": 0.01, "doubled": 0.005, "silent": 0.02}
"""The largest share of each that is no trouble; one alone never is."""


def quality(said: Exchanges) -> Quality:
    """The figures of everything that was said on a line; a drive that never answers a request says nothing of it."""
    every = [poll for unit in said.units.values() for key, poll in unit.polls.items() if key[0] in COUNTED]
    polls = [poll for poll in every if poll.replies + poll.refusals + poll.damaged]
    odd = sum((unit.odd for unit in said.units.values()), Counter[Role]())
    unclear = sum(unit.unclear for unit in said.units.values())
    return Quality(
        sum(each.count for each in polls), sum(each.replies for each in polls), sum(each.refusals for each in polls),
        sum(each.damaged for each in polls), odd["late"] + odd["late or twice"] + unclear,
        odd["twice"] + odd["unasked"], sum(max(0, each.unanswered) for each in polls),
    )  # fmt: skip
