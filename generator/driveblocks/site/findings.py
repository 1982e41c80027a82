"""What frames of others say of a line: who is asked what and how often, who answers, and what is wrong."""

from collections import Counter, deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from driveblocks.explain.comparison import compared
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect
from driveblocks.modbus.layout import KNOWN, Dialect, Layout, readings, take
from driveblocks.modbus.request import Asked, asked_by
from driveblocks.site.overheard import Caught

LATE_US = 20_000
"""How far an adapter or a network may shift the time of a frame."""
ALIKE_US = 200_000
"""A reply that repeats its request is taken for one within this time; after it, for another request."""
LATEST_US = 1_000_000
"""No reply comes later than this."""
ALIKE = (5, 6, 8)
"""Functions whose reply repeats the request."""
SOME = 3
"""So often a thing has to happen before it is said of the line."""
SAMPLES = 20
Key = tuple[int, int, int]
"""Function, address, quantity."""


@dataclass
class Ask:
    """A request that is sent again and again."""

    function: int
    address: int
    quantity: int
    writes: bool
    times: int = 0
    first_us: int = 0
    last_us: int = 0
    gap_us: int = 0
    """The longest time between two of them."""
    answered: int = 0
    refused: Counter[int] = field(default_factory=Counter)
    unanswered: int = 0
    spoilt: int = 0
    """Times that something damaged came instead of the reply."""
    words: tuple[int, ...] = ()
    """The last that were read or written."""

    @property
    def every_us(self) -> int | None:
        """The mean time from one to the next; None before there are two."""
        return (self.last_us - self.first_us) // (self.times - 1) if self.times > 1 else None


@dataclass
class Unit:
    """A unit address on the line."""

    asks: dict[Key, Ask] = field(default_factory=dict)
    reply_us: tuple[int, int] | None = None
    """Shortest and longest time from a request to its reply, as the adapter shows them."""
    sure: int = 0
    """Replies that cannot be requests."""
    late: int = 0
    twice: int = 0
    late_or_twice: int = 0
    strays: int = 0
    """Replies that fit no open request."""
    alike: int = 0
    """Frames that may be another request, or the reply once more."""
    echoed: int = 0
    """Requests that came twice at once."""
    hasty: Counter[int] = field(default_factory=Counter)
    """Requests that were followed by another one before a reply: how often after how many ms."""
    others: Counter[int] = field(default_factory=Counter)
    """Frames of functions that are not taken apart."""

    @property
    def asked(self) -> int:
        """How often it was asked."""
        return sum(each.times for each in self.asks.values())

    @property
    def answered(self) -> int:
        """How often it has replied in time, refusals included."""
        return sum(each.answered for each in self.asks.values())

    @property
    def interrupted(self) -> int:
        """How often somebody did not wait for its reply for as long as somebody has waited before."""
        longest = self.reply_us[1] if self.reply_us else 0
        return sum(many for ms, many in self.hasty.items() if 1000 * ms + LATE_US < longest)


@dataclass
class _Open:
    """A request without its reply so far."""

    body: bytes
    asked: Asked
    at_us: int
    end_us: int
    ask: Ask
    unsure: bool = False
    """Whether it may be a reply instead."""
    spoilt: bool = False
    blurred: bool = False
    """Whether another request may have come since."""
    left: bool = False
    """Whether another request came before its reply."""

    def answered_by(self, spoken: Dialect, body: bytes) -> bool:
        return body[0] == self.body[0] and not compared(spoken, self.asked, body)


class Findings:
    """Takes frames one after the other."""

    def __init__(self, drives: Mapping[int, Drive], other: Drive | None = None) -> None:
        """Maps by unit address, and the map of all units that none is named for."""
        self._drives, self._other = drives, other
        self.units: dict[int, Unit] = {}
        self.broadcasts: dict[Key, Ask] = {}
        self.good = self.damaged = self.damaged_bytes = 0
        self.samples: list[bytes] = []
        """The first damaged ones."""
        self.first_us = self.last_us = self.silence_us = 0
        """The first and the last byte, and the longest time between two frames."""
        self._open: _Open | None = None
        self._past: deque[_Open] = deque(maxlen=4)
        """Requests that were answered or given up since the last damage, the newest last."""

    def drive(self, unit: int) -> Drive | None:
        """The map of a unit, or of a broadcast to one family; None without one."""
        every = [*self._drives.values(), *([self._other] if self._other else [])]
        if unit == 0 and every and all(each is every[0] or each.prefix == every[0].prefix for each in every):
            return every[0]  # a broadcast is for all of them
        return self._drives.get(unit, self._other)

    def unit(self, number: int) -> Unit:
        """A unit, from the first time on that it is named."""
        return self.units.setdefault(number, Unit())

    def take(self, one: Caught) -> str:
        """A frame, or what is none; `>` for a request, `<` for a reply, empty where nobody can know."""
        if self.good or self.damaged:
            self.silence_us = max(self.silence_us, one.at_us - self.last_us)
        else:
            self.first_us = one.at_us
        self.last_us = one.end_us
        if one.body is None:
            if self.good:  # before the first good frame: the end of one that had begun earlier
                self._damage(one)
            return ""
        self.good += 1
        drive = self.drive(one.body[0])
        spoken = dialect(drive) if drive is not None else Dialect()
        kinds = {each.direction: each for each in readings(one.body, spoken) if each.fits}
        if one.body[1] not in KNOWN or ("reply" in kinds and kinds["reply"].refusal):
            kinds.pop("request", None)
        if one.body[1] & 0x7F not in KNOWN or not kinds:
            self.unit(one.body[0]).others[one.body[1]] += 1
            self._give_up(None)
            return ""
        if "reply" in kinds and self._reply(one, one.body, spoken):
            return "<"
        if "request" in kinds:
            return self._request(one, one.body, kinds["request"])
        self.unit(one.body[0]).strays += self.good > 1  # the request of the first may have come too early to be heard
        return "<"

    def finish(self) -> None:
        """Nothing more comes; the last request is not counted as unanswered."""
        self._open = None

    def _damage(self, one: Caught) -> None:
        self.damaged += 1
        self.damaged_bytes += len(one.data)
        self.samples += [one.data] if len(self.samples) < SAMPLES else []
        self._past.clear()  # whatever comes now may belong to a request that was damaged
        if self._open is not None:
            self._open.spoilt = True

    def _reply(self, one: Caught, body: bytes, spoken: Dialect) -> bool:
        """Whether a frame is a reply to something that was heard."""
        now = self._open
        past = [each for each in reversed(self._past) if each.answered_by(spoken, body)]
        if now is not None and now.answered_by(spoken, body):
            alike = now.body == body
            if alike and one.at_us - now.end_us > self._patience(body[0]):
                return False
            clear = not now.blurred and not any(each.left for each in past)
            self._answer(now, one, take(body, "reply", spoken), alike=alike, clear=clear)
            return True
        if not past or past[0].body == body:
            return False
        unit = self.unit(body[0])
        if past[0].left:
            unit.late += 1
            self._past.remove(past[0])
        elif any(each.left for each in past):
            unit.late_or_twice += 1
        elif now is None and past[0] is self._past[-1]:
            unit.twice += 1
        else:
            return False
        return True

    def _sure(self, unit: int) -> bool:
        """Whether a unit is known to answer, and how fast."""
        return self.unit(unit).sure > 0

    def _patience(self, unit: int) -> int:
        """Within this time a frame that may be a reply is taken for one."""
        known = self.unit(unit).reply_us
        return max(ALIKE_US, known[1] + LATE_US if known else 0)

    def _answer(self, now: _Open, one: Caught, reply: Layout, *, alike: bool, clear: bool) -> None:
        """A reply in its turn; `clear`: it cannot be that to an earlier request."""
        self._open = None
        unit, ask, took = self.unit(now.body[0]), now.ask, one.at_us - now.end_us
        if now.unsure:
            _count(ask, now.at_us)
        if now.spoilt:
            ask.spoilt += 1
            return
        ask.answered += 1
        self._past.append(now)
        unit.sure += not alike
        if not alike and clear:
            low, high = unit.reply_us or (took, took)
            unit.reply_us = min(low, took), max(high, took)
        if reply.refusal:
            ask.refused[reply.number("reason") or 0] += 1
        elif not ask.writes and clear:
            ask.words = reply.words

    def _request(self, one: Caught, body: bytes, layout: Layout) -> str:
        now, asked = self._open, asked_by(layout)
        if now is not None and now.body == body and one.at_us - now.end_us <= LATE_US and not now.spoilt:
            self.unit(body[0]).echoed += 1
            return ">"
        unsure = asked.function in ALIKE and any(
            each.body == body and one.at_us - each.end_us < LATEST_US for each in self._past
        )
        if unsure and now is not None and now.body != body and not now.spoilt:
            self.unit(body[0]).alike += 1  # perhaps its late reply: somebody else's is still awaited
            now.blurred = True
            return ""
        self._give_up(one)
        writes = asked.function in (5, 6, 15, 16)
        key = asked.function, asked.address, asked.quantity
        asks = self.unit(body[0]).asks if body[0] else self.broadcasts
        ask = asks.setdefault(key, Ask(*key, writes=writes))
        unsure = unsure or (
            now is not None and now.body == body and asked.function in ALIKE and not self._sure(body[0])
        )
        if not unsure:
            _count(ask, one.at_us)
        if writes:
            ask.words = layout.words
        self._open = _Open(body, asked, one.at_us, one.end_us, ask, unsure) if body[0] else None
        return "" if unsure else ">"

    def _give_up(self, one: Caught | None) -> None:
        """The open request gets no reply any more in its turn."""
        now, self._open = self._open, None
        if now is None:
            return
        unit = self.unit(now.body[0])
        now.left = True
        self._past.append(now)
        if now.unsure:
            unit.alike += 1
            return
        if now.spoilt:
            now.ask.spoilt += 1
            return
        now.ask.unanswered += 1
        if one is not None and one.body != now.body and not now.blurred:
            unit.hasty[min(10_000, (one.at_us - now.end_us) // 1000)] += 1


def _count(ask: Ask, at_us: int) -> None:
    if ask.times:
        ask.gap_us = max(ask.gap_us, at_us - ask.last_us)
    else:
        ask.first_us = at_us
    ask.times, ask.last_us = ask.times + 1, at_us


@dataclass(frozen=True)
class Said:
    """One thing that is said of a line, and what may be the reason."""

    kind: str
    unit: int | None
    text: str
    perhaps: str = ""


def said(found: Findings) -> Iterator[Said]:
    """What is unusual on a line, the line's own first."""
    broken = sum(each.interrupted for each in found.units.values())
    if broken >= SOME:
        what = f"{broken} requests came while another one still waited for its reply"
        yield Said("masters", None, what, "two masters speak on this line; or one that does not wait")
    if found.damaged:
        share = found.damaged / (found.damaged + found.good)
        what = f"{found.damaged} damaged, {share:.1%} of all: {found.damaged_bytes} bytes in no good frame"
        yield Said("damaged", None, what, "noise, termination, A and B, two that speak at once; the adapter's own loss")
    for number, unit in sorted(found.units.items()):
        yield from _of_unit(number, unit, interrupted=broken >= SOME)


def _of_unit(number: int, unit: Unit, *, interrupted: bool) -> Iterator[Said]:
    if unit.asked >= SOME and not (unit.answered or unit.alike or unit.late or unit.strays):
        spoilt = sum(each.spoilt for each in unit.asks.values())
        text, why = "never answers", "switched off, another address, its wires"
        yield Said("silent", number, text, why) if not spoilt else Said("spoilt", number, "no whole answer", why)
    if unit.asked + unit.alike >= SOME and unit.answered + unit.alike and not (unit.sure or unit.strays):
        yield Said("unclear", number, "may answer, or be asked again: request and reply look alike")
    if unit.late and not (interrupted and unit.interrupted):
        yield Said(
            "late",
            number,
            f"{unit.late} replies came after the next request",
            "the master waits too short; two masters",
        )
    if unit.twice:
        yield Said("twice", number, f"{unit.twice} replies came twice", "two units at this address; a repeater")
    if unit.late_or_twice:
        yield Said("late or twice", number, f"{unit.late_or_twice} replies came late or twice")
    if unit.strays:
        yield Said("stray", number, f"{unit.strays} replies fit no open request", "damaged requests; late or twice")
    if unit.echoed >= SOME:
        what = f"{unit.echoed} requests came twice at once"
        yield Said("echo", number, what, "an echo; a master that waits less than 20 ms")
    if refused := sum((each.refused for each in unit.asks.values()), Counter[int]()):
        codes = ", ".join(f"{many} with {code}" for code, many in sorted(refused.items()))
        yield Said("refused", number, f"refuses: {codes}", "explain a line of the log with the map of this drive")
