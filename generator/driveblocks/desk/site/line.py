"""How fast a line is, how old a status and how late a stop can be: by its block, or by the formula of docs/line.md."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import ceil

from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import REPLY, REQUEST, WORD, Poll, schedule
from driveblocks.meaning.serial import serial
from driveblocks.meaning.watchdog import feeds
from structured_text.engines.embedded import EmbeddedInstance, EmbeddedLibrary

RATES = (1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200)
"""Where no manual on the line names its rates."""
SLOT = (
    "UnitAddress", "SilenceMs", "OtherQuantity", "TurnRoundMs", "LongestMs", "PollEveryMs", "Ask[0].FunctionCode",
    "Ask[0].Quantity", "Ask[3].Quantity", "StatusPolls", "StaleMs", "FeedMs", "Replies", "LongestReplyMs",
)  # fmt: skip
"""What the line computes its figures from, of each slot."""
PINS = ("CommandRetries", "OfflineMs")
"""... and of its own pins, beside those of `Line`."""
LEARNED_AFTER = 20
"""Replies after which a block knows its drive's turn-round."""
BROKEN = {
    "stops": "all stops are sent within {} ms",
    "status": "every status stays within its StaleMs",
    "watchdog": "every watchdog is fed in two thirds of its time",
}
"""What may not hold at a rate -> what is asked for."""


@dataclass(frozen=True)
class Unit:
    name: str
    unit: int
    reads: tuple[Poll, ...]
    """In the plan of its block; the line takes turns through `schedule`."""
    drive: Drive | None = None
    """Its map; None for a device."""
    every_ms: int = 0
    """Its block's pause between two reads, ms."""
    watchdog_ms: int = 0
    """0: not set, ms."""

    @property
    def turns(self) -> int:
        """Rounds of the line from one read of its status to the next, at most; of a device, its words."""
        plan, fast = schedule(self.reads), [at for at, each in enumerate(self.reads) if each.fast]
        places = [[turn for turn, read in enumerate(plan) if read == at] for at in fast]
        return max(
            (
                after - turn
                for each in places
                for turn, after in zip(each, [*each[1:], each[0] + len(plan)], strict=True)
            ),
            default=1,
        )

    @property
    def rest_turns(self) -> int:
        """The same of its other values; 0 where it has none."""
        return len(schedule(self.reads)) if any(not each.fast for each in self.reads) else 0


@dataclass(frozen=True, kw_only=True)
class Line:
    """A line; times in ms."""

    library: EmbeddedLibrary
    size: int
    slots: Mapping[str, int]
    """By the path in the block; turn-round as it is learned from replies of `reply`, or as it is set."""
    unlearned: Mapping[str, int]
    """The same before any reply."""
    pins: Mapping[str, int]
    units: tuple[Unit, ...]
    rate: int
    bits: int
    ascii: bool
    scan: int
    max_scan: int
    keeps: bool
    """The port itself keeps the silence."""
    port_late: int
    reply: int
    """What a drive takes to begin its reply."""
    within: int | None = None
    """A stop has to be on the wire within this time."""

    def rates(self) -> tuple[int, ...]:
        """Bit rates to be tried: the present one, and those that all manuals on the line name."""
        lists = [serial(each.drive).rates for each in self.units if each.drive]
        named = [set(each) for each in lists if each]
        return tuple(sorted({*(set.intersection(*named) if named else RATES), self.rate}))


@dataclass(frozen=True)
class Spent:
    """A read on the wire; times in ms."""

    unit: Unit
    request: float
    reply: float
    open: int
    """Until the line has its reply, in scans."""
    scans: int
    """Until the next request of the line, in scans."""


@dataclass(frozen=True)
class Promised:
    """What the line block computes for one slot; times in ms, 0: it has none."""

    read: int
    """`ReadMs`: age of its status at most, while all drives answer."""
    worst: int
    """`WorstReadMs`: the same whatever other drives do."""
    feed: int
    """`WorstFeedMs`: what feeds a watchdog waits for so long at most."""
    stale: int
    """`StaleMs`: an older status ends a run."""


@dataclass(frozen=True)
class Aged:
    """How often a unit is read; times in ms, all at most."""

    unit: Unit
    every: int
    """Between two reads of its status, where nobody writes."""
    rest: int | None
    """Age of its other values, while written to; None where it has none."""
    promised: Promised

    @property
    def feed(self) -> int | None:
        """How long what feeds its watchdog may wait: a frame of its own, or its reads; None where none is set."""
        drive, own = self.unit.drive, self.promised
        if not (self.unit.watchdog_ms and drive):
            return None
        return own.worst if feeds(drive) == "polls" else own.feed

    @property
    def margin(self) -> int | None:
        """What is left of two thirds of its watchdog's time."""
        return None if self.feed is None else 2 * self.unit.watchdog_ms // 3 - self.feed


@dataclass(frozen=True)
class Figures:
    """What a line does at a bit rate; times in ms."""

    line: Line
    rate: int
    spent: tuple[Spent, ...]
    silence: float
    line_keeps: bool
    alone: int
    worst: int
    unlearned: int
    """The worst stop before any reply."""
    cut: int
    promised: tuple[Promised, ...]
    """By unit."""

    @property
    def round(self) -> int:
        """A round of polls, each unit read once, the longest of its reads."""
        return sum(each.scans for each in self.spent) * self.line.scan

    @property
    def load(self) -> int:
        """Percent of the scans in which a request is open, as `LoadPercent` counts them, while the line only polls."""
        return round(100 * sum(each.open for each in self.spent) / sum(each.scans for each in self.spent))

    @property
    def ages(self) -> tuple[Aged, ...]:
        return tuple(self._aged(*each) for each in zip(self.spent, self.promised, strict=True))

    @property
    def slow(self) -> tuple[Aged, ...]:
        """Drives whose status can get older than their StaleMs; if it does while all drives answer, no start passes."""
        return tuple(each for each in self.ages if max(each.promised.read, each.promised.worst) > each.promised.stale)

    @property
    def starved(self) -> tuple[Aged, ...]:
        """Drives whose watchdog may trip."""
        return tuple(each for each in self.ages if each.margin is not None and each.margin < 0)

    @property
    def broken(self) -> list[str]:
        """Keys of `BROKEN`: what does not hold."""
        late = self.line.within is not None and self.worst > self.line.within
        return ["stops"] * late + ["status"] * bool(self.slow) + ["watchdog"] * bool(self.starved)

    def _aged(self, spent: Spent, promised: Promised) -> Aged:
        unit, own = spent.unit, spent.scans * self.line.scan
        rest = 2 * unit.rest_turns * self.round + own if unit.rest_turns else None
        return Aged(unit, unit.turns * self.round + unit.every_ms, rest, promised)


def figures(line: Line, rate: int) -> Figures:
    """The figures at a bit rate; those of stops, silence and ages come from the block itself, after a restart."""
    block, unlearned = (_block(line, rate, slots) for slots in (line.slots, line.unlearned))
    keeps = bool(number(block, "Promise.LineKeeps"))
    # 3.5 characters, 1.75 ms above 19,200 bit/s, or the most that a drive asks for
    own = max(value for path, value in line.slots.items() if path.endswith(".SilenceMs"))
    silence = max(1.75 if rate > 19200 else 3500 * line.bits / rate, own)
    spent = tuple(_spent(line, each, rate, silence, keeps) for each in line.units)
    stops = number(block, "StopAloneMs"), number(block, "WorstStopMs"), number(unlearned, "WorstStopMs")
    cut = number(block, "CutToContactMs")
    return Figures(line, rate, spent, silence, keeps, *stops, cut, tuple(_promised(line, block)))


def number(block: EmbeddedInstance, path: str) -> int:
    """A whole number or a BOOL of an instance."""
    value = block[path]
    return value if isinstance(value, int) else 0


def _block(line: Line, rate: int, slots: Mapping[str, int]) -> EmbeddedInstance:
    """The line block after its first call, with these slots."""
    block = line.library.instance(f"MB_Line{line.size}")
    given = {"BitRate": rate, "CharacterBits": line.bits, "MaxScanMs": line.max_scan, "Port.LateMs": line.port_late}
    for path, value in {**slots, **line.pins, **given, "ElapsedMs": line.scan}.items():
        block[path] = value
    block["Ascii"], block["Port.KeepsSilence"] = line.ascii, line.keeps
    block.scan(0)
    return block


def _promised(line: Line, block: EmbeddedInstance) -> Iterator[Promised]:
    """What a block promises of each unit; a restart forgets the replies, and one round of slots goes by old sums."""
    block["ElapsedMs"] = 0
    for path, value in line.slots.items():
        block[path] = value
    for _ in range(line.size + 1):
        block.scan(0)
    names = "ReadMs", "WorstReadMs", "WorstFeedMs", "StaleMs"
    for at in range(line.size):
        if number(block, f"Slots[{at}].UnitAddress"):
            yield Promised(*(number(block, f"Slots[{at}].{name}") for name in names))


def _spent(line: Line, unit: Unit, rate: int, silence: float, line_keeps: bool) -> Spent:
    """The longest read of a unit."""
    words = max(each.words for each in unit.reads)
    request, reply = (_ms(line, rate, count) for count in (REQUEST, REPLY + WORD * words))
    wire = request + line.reply + reply
    late = ceil(line.port_late / line.scan)
    scans = ceil((wire if line_keeps else wire + silence) / line.scan) + late
    waited = int((silence + 1) / line.scan) + 1 if line_keeps else 0
    return Spent(unit, request, reply, scans, scans + waited)


def _ms(line: Line, rate: int, characters: int) -> float:
    """A frame on the wire; ASCII takes twice the characters of RTU, and one more."""
    count = 2 * (characters - 1) + 3 if line.ascii else characters
    return count * line.bits * 1000 / rate
