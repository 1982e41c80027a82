"""What happens on the wire, and when: no time is wasted, nobody is interrupted, and ages, errors and the longest reply
are those of the wire."""

from collections import deque
from dataclasses import dataclass
from itertools import takewhile
from typing import TYPE_CHECKING, Any

from tests.second.claims import ONE_WORD
from tests.second.figures import ASTRAY, ATTEND_US, AWAY
from tests.second.frames import LAST_READ, runs
from tests.second.observer import any_of
from tests.second.pf4 import alike
from tests.second.turns import CONTROL, Turns

if TYPE_CHECKING:
    from tests.second.judge import Judge

IDLE_MS = 20
"""How long the wire stays unused after a reply, or one scan, where somebody may be read: a read that might be taken for
the one before waits for its drive block."""
WAITS_SCANS, REPLY_MS = 3, 60
"""How much longer than the drive may take the line waits for a reply: for its characters, in scans that see no more."""
AHEAD_MS = 13
"""By how much a reply may be taken for shorter while the wire is free: the silence that the port keeps, in whole ms."""
SETTLED_US = 3_000_000
"""Since the last restart, or since a drive could be reached again."""
SPEED = alike(
    {"CHF": 0x3000, "GD200A": 0x3000, "JSCC": 0x2000, "PF4": 8451, "SN300G5": 0x0021, "V20": 0x0017, "ACS355": 0x0066}
)
"""Where the output frequency is."""
ENOUGH, MANY, DEAD_US = 3, 4, 1_600_000
"""A drive counts as one that answers after three good replies in a row, and as dead after four requests without one
in this time."""
SEVERAL = 200
"""How many requests are remembered."""
SILENCE, REFUSED = 20, 40
"""Errors of a request."""
COUNTERS = ("Good", "Timeouts", "Refusals", "Bad", "Late", "Fresh", "Replies")
"""Of a slot: how requests have ended, good reads, and all replies, which are counted up to `MOST`."""
MOST = 255
EXCEPTION = 0x80
"""What a refusal adds to the function code, in most families."""
STATUS = alike({
    "ATV312": 3201, "CHF": 0x1001, "GD200A": 0x2100, "JSCC": 0x2001, "MX2": 0x1000, "PF4": 0x2100, "SN300G5": 0x0010,
    "V20": 0x006D, "ACS355": 3,
})  # fmt: skip
"""Where the status begins."""


@dataclass(slots=True)
class Exchange:
    """A request that was on the wire, and what was answered."""

    data: bytes
    """Without checksum."""
    end: int
    """When its last character was there, us."""
    replies: list[tuple[int, int, bytes]]
    """When each began and ended, us, and what it says."""
    waits_ms: int = 0
    """How long its drive might take then."""
    doubted: bool = False
    """Its answer may be its own echo: a write, and nobody knows yet whether the port hears itself."""
    hasty: bool = False
    """It was sent before the last reply had ended, as after a restart: the line hears that reply in its time."""

    def reads(self, register: int) -> bool:
        """Whether it reads a register, among others."""
        first, count = int.from_bytes(self.data[2:4], "big"), int.from_bytes(self.data[4:6], "big")
        return self.data[1] <= LAST_READ and first <= register < first + count

    def about(self, unit: int, register: int) -> bool:
        """Whether it is to this unit, and its first register is this."""
        return self.data[0] == unit and int.from_bytes(self.data[2:4], "big") == register

    @property
    def index(self) -> int:
        """Whose unit it is; a meter comes after all drives."""
        return self.data[0] - 1

    @property
    def good(self) -> bool:
        """It was answered, and not refused."""
        same = 2 if self.data[1] <= LAST_READ else 6  # bytes that repeat the request's
        return bool(self.replies) and self.replies[0][2][:same] == self.data[:same]

    @property
    def refused(self) -> bool:
        """It was answered otherwise."""
        return bool(self.replies) and not self.good


class Wire:
    """Looks at each request."""

    def __init__(self, judge: "Judge") -> None:
        """Begin at power-up."""
        self.judge, self.bench = judge, judge.bench
        self.turns = Turns(self)
        self.last: Exchange | None = None
        self.exchanges: deque[Exchange] = deque(maxlen=SEVERAL)
        self.idle_ms = 0
        """Time of the scans since its reply was there."""
        self.read_us: list[int | None] = [None] * len(judge.units)
        """When the status of each was last read."""
        self.longest_us = [0] * len(judge.units)
        """The longest that each has taken to answer, since all began anew."""
        self.slowest_us = [0] * len(judge.units)
        """The longest scan since then, in which nobody knows when a reply came."""
        self.confirmed = [False] * len(judge.units)
        self.stopped_us: list[tuple[int, int]] = [(0, 0)] * len(judge.units)
        """Since its last order to run: when the first stop that was answered ended, and when its reply did; 0: none."""
        self.number = [0] * len(judge.units)
        """How many requests each has got."""
        self.counters: list[tuple[int, list[Any]]] = [(-1, [])] * len(judge.units)
        """What its slot had counted, after which of them."""
        self.lossy_us = self.spoilt_us = -SETTLED_US
        """When something else than silence was last wrong on the wire, and something else than late replies."""
        self.hasty_us = 0
        """When a request last came so soon after a timeout that a late reply still could, or a drive was dead."""
        self.late = 0, 0
        """Timeouts and LateReplies of the line when the last request was sent."""

    def waits_ms(self, index: int) -> int:
        """How long the line waits for a reply of a drive to begin."""
        return self.bench.turn_round(index) if index < len(self.judge.units) else 0

    def since(self, us: int) -> list[Exchange]:
        """The last requests, those after a time."""
        return [each for each in self.exchanges if each.end > us]

    def posting(self) -> None:
        """A request is in the mailbox: whether that is too soon, or too late, after the last one."""
        last, now, judge = self.last, self.bench.now, self.judge
        self.last = None
        self.turns.posting(last)
        self._echo()
        self._late(last)
        if last is None or not self.plain() or now - last.end > SETTLED_US:
            return
        if last.index < len(judge.units):
            self._shown(last)
        if last.replies:
            least, most = min(judge.late) // 1000, max(judge.late) // 1000
            waits = (
                most if self.bench.metered and self.bench.types[0] in ONE_WORD else 0
            )  # after a meter, for its block
            idle = self.idle_ms > max(IDLE_MS, most) + most - least + waits  # its scans may have been longer
            judge.once(0, "idle", bad=self.somebody() and idle, seen=(self.idle_ms, "ms"))
        elif last.index < len(judge.units):
            waited, least = (now - last.end) // 1000, min(last.waits_ms, self.waits_ms(last.index))
            judge.once(last.index, "interrupts", bad=waited < least, seen=(waited, "of", least, "ms"))
            longer_ms = max(max(judge.late) // 1000, self.bench.elapsed) - self.bench.ms  # a scan may have been
            most = max(last.waits_ms, self.waits_ms(last.index)) + WAITS_SCANS * self.bench.ms + longer_ms + REPLY_MS
            judge.once(last.index, "waits", bad=self.somebody() and waited > most, seen=(waited, "of", most, "ms"))

    def _late(self, last: Exchange | None) -> None:
        """A reply after its timeout is counted as late, where it was waited for before the next request."""
        block: Any = self.bench.block
        shown, was = (block["TheLine.Timeouts"], block["TheLine.LateReplies"]), self.late
        self.late = shown
        anew = max(self.spoilt_us, *(each.restarted_us for each in self.judge.units))
        if last is None or last.index >= len(self.judge.units):
            return
        timeout, now = shown[0] > was[0], self.bench.now
        hasty = timeout and now - last.end < 1000 * self.turns.slot(last.index, "LongestMs")
        dead = any(block[f"Slots[{i}].SupplyOff"] or not block[f"Slots[{i}].Online"] for i in range(len(self.number)))
        if hasty or dead:
            self.hasty_us = now  # a stop does not wait, and may meet the reply
        # with its echo before it, a late one may pass for a frame of others
        if now - self.hasty_us > ATTEND_US and last.end >= anew + SETTLED_US and not self.bench.echo:
            late = timeout and bool(last.replies)
            self.judge.once(0, "late", bad=shown[1] - was[1] != late, seen=(shown, "after", was))

    def _echo(self) -> None:
        """That the port hears nothing of its own is known once three reads have been answered, and not before."""
        since, echo = max(each.restarted_us for each in self.judge.units), self.bench.block["TheLine.Echo"]
        mine = self.since(since)
        reads = [each for each in mine if each.replies and each.data[1] <= LAST_READ]
        least, most = sum(not each.hasty for each in reads), len(reads)  # with nothing heard before the reply
        anew = any(pins.get("Restart") for pins in self.bench.pins)  # in this scan
        if self.lossy_us < since and not (self.bench.echo or anew) and len(mine) < SEVERAL and self._whole():
            bad = most < ENOUGH if echo == 1 else least >= ENOUGH
            self.judge.once(0, "echo known", bad=bad, seen=(echo, least, "to", most, "reads"))

    def somebody(self) -> bool:
        """Whether there is a drive that answers, and may be read at any time."""
        well = [index for index in range(len(self.judge.units)) if self.judge.known(index, SETTLED_US)]
        return any(self.bench.shows("CommOk", index) for index in well)

    def answered(self, exchange: Exchange) -> None:
        """A request was on the wire."""
        if self.exchanges:
            before = self.exchanges[-1]
            self.turns.answered(before, exchange)
            exchange.hasty = bool(before.replies) and before.replies[-1][1] > self.turns.posted_us
        exchange.waits_ms = self.waits_ms(exchange.index)
        exchange.doubted = exchange.data[1] > LAST_READ and not self.bench.block["TheLine.Echo"]
        self.last, self.idle_ms = exchange, 0
        self.exchanges.append(exchange)
        index = exchange.index
        if index < len(self.judge.units):
            self.number[index] += 1
            self._ordered(exchange)
        if index < len(self.judge.units) and exchange.good:
            begins, ends, _ = exchange.replies[0]
            if not self.bench.damages:
                self.longest_us[index] = max(self.longest_us[index], begins - exchange.end)
                waited = exchange.end - self.bench.now - 1000 * self.bench.characters_ms(len(exchange.data) + 2)
                self.slowest_us[index] = max(self.slowest_us[index], waited)  # after a restart the port is not free yet
            if exchange.reads(STATUS[self.bench.types[index]]):
                self.read_us[index] = ends

    def _ordered(self, exchange: Exchange) -> None:
        """An order to run that was answered, or the first stop after it."""
        index, kind = exchange.index, self.bench.types[exchange.index]
        orders = exchange.data[1] > LAST_READ and exchange.about(index + 1, CONTROL.get(kind, -1))
        if not (orders and exchange.replies):
            return
        if runs(kind, exchange.data):
            self.stopped_us[index] = (0, 0)
        elif self.stopped_us[index][0] <= self.judge.units[index].restarted_us:
            self.stopped_us[index] = (exchange.end, exchange.replies[0][1])

    def _shown(self, last: Exchange) -> None:
        """What the slot holds of how it ended."""
        young = self.bench.now - self.judge.claims.claims[last.index].changed_us < ATTEND_US
        dark = self.judge.units[last.index].dark_us >= last.end  # nobody has expected a reply
        if young or dark or self.bench.pins[last.index].get("SupplyOff"):
            return
        block: Any = self.bench.block
        slot = f"Slots[{last.index}]"
        error = block[f"{slot}.LastErrorID"]
        if not (last.good or last.doubted):
            right = REFUSED if last.refused else SILENCE
            shown = block["TheLine.LastErrorID"]
            self.judge.once(last.index, "last error", bad=not error == shown == right, seen=(error, shown, "of", right))
        if last.refused and last.replies[0][2][1] == last.data[1] | EXCEPTION:
            shown = [block[f"{slot}.Refused{name}"] for name in ("Address", "Reason")]
            true = [int.from_bytes(last.data[2:4], "big"), last.replies[0][2][2]]
            self.judge.once(last.index, "refused what", bad=shown != true, seen=(shown, "of", true))
        self._online(last.index, block[f"{slot}.Online"])
        self._counted(last)
        words = last.replies[0][2][3:] if last.good else b""
        if last.data[1] in (3, 4) and len(words) == 2 * last.data[5]:
            shown = block[f"{slot}.PollWords"][: last.data[5]]
            true = [int.from_bytes(words[i : i + 2], "big") for i in range(0, len(words), 2)]
            self.judge.once(last.index, "words", bad=shown != true, seen=(shown, "of", true))

    def _counted(self, last: Exchange) -> None:
        """How the last request of a slot has ended is what its counters have counted since the one before."""
        index, block = last.index, self.bench.block
        shown: list[Any] = [block[f"Slots[{index}].{name}"] for name in COUNTERS]
        number, before = self.counters[index]
        self.counters[index] = self.number[index], shown
        if number == self.number[index] - 1 and block["TheLine.Echo"]:  # else an answer may be the port's own
            grown = [now - was for now, was in zip(shown, before, strict=True)]
            reads = last.good and last.data[1] <= LAST_READ
            replied = bool(last.replies)
            true = [replied, not replied, last.refused, False, False, reads, replied and before[-1] < MOST]
            self.judge.once(index, "counters", bad=grown != list(map(int, true)), seen=(grown, "of", true))
        count = block[f"Slots[{index}].PollCount"]
        if last.good and last.data[1] == LAST_READ - 1:
            self.judge.once(index, "poll count", bad=count != last.data[5], seen=(count, "of", last.data[5]))

    def mine(self, index: int) -> list[Exchange]:
        """Requests to a drive since the last restart, the last one first."""
        since = self.judge.units[index].restarted_us
        return [each for each in reversed(self.exchanges) if each.index == index and each.end > since]

    def _online(self, index: int, online: object) -> None:
        """Whether the line knows that a drive answers, or that it does not."""
        mine = self.mine(index)
        answers = sum(not each.doubted for each in takewhile(lambda each: each.replies, mine))
        silent = list(takewhile(lambda each: not each.replies, mine))
        dead = len(silent) >= MANY and self.bench.now - silent[-1].end > DEAD_US
        believed = answers >= ENOUGH and self.bench.block["TheLine.Echo"]
        wrong = (believed and not online) or (dead and online)
        self.judge.once(index, "online", bad=bool(wrong), seen=(online, answers, len(silent)))

    def _proved(self, index: int) -> None:
        """Standstill that is shown anew was read after the last order: status and frequency."""
        shown, kind, now = self.bench.shows("StopConfirmed", index), self.bench.types[index], self.bench.now
        rises, self.confirmed[index] = shown and not self.confirmed[index], shown
        if not rises or kind not in SPEED or any_of(AWAY, self.bench.pins[index]) or not self.plain():
            return
        mine = [each for each in self.mine(index) if each.replies and each.replies[0][1] <= now]
        stopped_us, acknowledged_us = self.stopped_us[index]  # it is sent again and again
        since = [each for each in mine if each.good and (acknowledged_us > now or each.end > stopped_us)]
        status, speed = ([each.end for each in since if each.reads(place[kind])] for place in (STATUS, SPEED))
        right = status and speed and max(speed) >= min(status)
        self.judge.once(index, "proved", bad=not right, seen=(status, "then", speed))

    def look(self) -> None:
        """Now and then: ages, and the longest reply."""
        self.turns.look()
        plain, now, bench = self.plain(), self.bench.now, self.bench
        for index, unit in enumerate(self.judge.units):
            if now - unit.unknown_us < SETTLED_US:
                self.read_us[index] = None
                continue
            read_us = self.read_us[index]
            if plain and read_us is not None and read_us <= now:
                age, true = bench.number("StatusAgeMs", index), (now - read_us) // 1000
                self.judge.once(index, "younger", bad=age + bench.ms < true, seen=(age, "of", true))
            if plain and self.longest_us[index] and self.lossy_us < unit.restarted_us:
                longest, true = bench.number("LongestReplyMs", index), self.longest_us[index] // 1000
                slowest = self.slowest_us[index] // 1000
                off = not true - slowest - AHEAD_MS <= longest <= true + 2 * slowest
                self.judge.once(index, "longest reply", bad=off, seen=(longest, "of", true))

    def _whole(self) -> bool:
        """Nothing is wrong but that drives do not answer, or that all has just begun."""
        bench, judge, now = self.bench, self.judge, self.bench.now
        faults = bench.faults
        lossy = faults.lost or bench.damages or faults.twice or bench.strangely or bench.flicker or bench.was_slow_port
        late = any(one.o.late_per_1000 for one in bench.models)
        astray = any(any_of(ASTRAY, each) or each.get("Address") != i + 1 for i, each in enumerate(bench.pins))
        if lossy or astray or bench.lineless or judge.asked or now - judge.slow_us < SETTLED_US:
            self.spoilt_us = now
            self.counters = [(-1, [])] * len(judge.units)
        self.lossy_us = now if late else max(self.lossy_us, self.spoilt_us)
        return self.lossy_us < now

    def plain(self) -> bool:
        """The same, since long."""
        now = self.bench.now
        anew = any(
            now - each.restarted_us < SETTLED_US or pins.get("Restart")
            for each, pins in zip(self.judge.units, self.bench.pins, strict=True)
        )
        return self._whole() and now - self.lossy_us > SETTLED_US and not anew

    def scan(self) -> None:
        """In each scan, after what was sent."""
        self.turns.scan()
        last, now = self.last, self.bench.now
        for index in range(len(self.confirmed)):
            self._proved(index)
        for index, unit in enumerate(self.judge.units):
            if unit.restarted_us == now:
                self.longest_us[index] = self.slowest_us[index] = 0
                self.counters[index] = (-1, [])
        self.slowest_us = [max(each, 1000 * self.bench.elapsed) for each in self.slowest_us]
        if last is not None and last.replies and now >= last.replies[-1][1]:
            self.idle_ms += self.bench.elapsed
