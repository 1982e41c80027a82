"""What the line and the blocks count, against what was on the wire."""

from itertools import pairwise
from typing import TYPE_CHECKING

from tests.second.figures import ASTRAY, ATTEND_US, MAX_SCAN_US, STOP_TRIES, UNLEARNED_MS
from tests.second.frames import LAST_READ
from tests.second.observer import any_of

if TYPE_CHECKING:
    from tests.second.judge import Judge
    from tests.second.wire import Exchange

ENDS = ("Good", "Timeouts", "Bad")
"""How a request ends: what a drive has refused it has answered."""
SLOT = (*ENDS, "Refusals", "Requests", "Retries")
"""What slots count, too."""
ROUNDS_MS, CALM_US = 3000, 5_000_000
"""What is looked at of the rounds of reads, where nothing has been lost for so long."""
SCAN_LATE_US = 10_000_000
"""For how long a late scan is shown."""
SILENCE_MS, JSCC_MS = 2, 10
"""Between frames: 3.5 characters, and what JSCC wants."""
READ_BYTES, STOP_BYTES = 38, 19
"""Of a read of twelve registers, the least that the line counts with, and of a stop, each with its reply."""
SURE_US, NEAR_MS = 3_000_000, 3
"""For how long the times that a promise is made of have to be the same; how exact it is, for each request."""
MINUTE_MS, MINUTES_NEAR_MS = 60_000, 1500
OFFLINE_MS = 1000
"""From a drive's silence until it is dead."""
LEARNED, MARGIN_MS, LEAST_MS, HALF_MS = 20, 20, 50, 240
"""TurnRoundMs: replies until it is learned; what is added to twice the longest; the least; where the longest is longer
than the fourth, it is that of a drive whose replies are not learned yet."""
ECHOES = {True: (0, 2), False: (0, 1)}
"""Echo, by whether the port hears what it sends."""


class Counts:
    """Looks at counters. After a restart, or while a request may be taken back, they are counted anew."""

    def __init__(self, judge: "Judge") -> None:
        """Begin at power-up."""
        self.judge, self.bench = judge, judge.bench
        self.scans = self.longest_ms = self.late = self.worst_ms = 0
        self.late_us = -SCAN_LATE_US
        """When a scan was last late."""
        self.turns: list[int] = []
        """LateMs of the port, and TurnRoundMs of each drive."""
        self.turns_us = 0
        """Since when."""
        self.before: dict[str, dict[str, int]] = {}
        """Counters, since when they are compared."""
        self.unclean_us = self.refused = self.unanswered = 0
        """When something was last lost or doubled; requests that a drive has refused, and that none has answered."""
        self.doubts = 0
        """Writes whose replies may not have been believed, since they may be copies of what was sent."""
        self.asked_us = 0
        """When a parameter block was last at work, whose reads are none of the rounds."""
        self.mute_us = 0
        """When a drive was last not known to answer, and so is only probed."""
        self.starts: list[int | None] = [None] * len(judge.units)
        self.ran = [True] * len(judge.units)
        self.run_ms = [0] * len(judge.units)
        self.run_known = [False] * len(judge.units)
        """How long each has been shown to run since the last restart, and whether its block was always called."""
        self.learned: list[object] = [None] * len(judge.units)
        """What TurnRoundMs had to be at the last look, and of which address."""

    def answered(self, exchange: "Exchange") -> None:
        """A request was on the wire; it may be that nobody has answered it."""
        self.unanswered += not exchange.replies
        self.refused += exchange.refused
        unclean = self.bench.now - self.unclean_us < ATTEND_US or not self._line("Echo")
        self.doubts += unclean and exchange.data[1] > LAST_READ

    def scan(self) -> None:
        """In each scan: times, and starts that are shown."""
        bench = self.bench
        if self.judge.asked:
            self.asked_us = bench.now
        if not bench.lineless:
            self._figures()
            if self.scans:
                self.longest_ms = max(self.longest_ms, bench.elapsed)
                self.late += 1000 * bench.elapsed > MAX_SCAN_US
            self.scans += 1
        for index, count in enumerate(self.starts):
            runs, knows = bench.shows("Running", index), bench.shows("CommOk", index)
            self.mute_us = self.mute_us if knows else bench.now
            if count is not None and knows and runs and not self.ran[index]:
                self.starts[index] = count + 1
            self.ran[index] = runs if knows else self.ran[index]
            anew, pins = self.judge.units[index].restarted_us == bench.now, bench.pins[index]
            known = self.run_known[index] or anew
            self.run_known[index] = known and not any_of(ASTRAY, pins) and pins.get("Address") == index + 1
            self.run_ms[index] = 0 if anew else self.run_ms[index] + bench.elapsed * (runs and knows)

    def _figures(self) -> None:
        """What the line shows of its rounds and of its scans."""
        cycle, worst = self._line("CycleMs"), self._line("WorstCycleMs")
        self.worst_ms = worst if self._anew() else max(self.worst_ms, cycle)
        self._once("worst round", bad=worst != self.worst_ms, seen=(worst, "of", self.worst_ms, "ms"))
        if any(each.restarted_us == self.bench.now for each in self.judge.units):
            self.late_us = -SCAN_LATE_US
        elif 1000 * self.bench.elapsed > MAX_SCAN_US:
            self.late_us = self.bench.now
        since_us, late = self.bench.now - self.late_us, self.bench.block["Slots[0].ScanLate"]
        near = abs(since_us - SCAN_LATE_US) <= max(self.judge.late)
        wrong = late != (since_us < SCAN_LATE_US) and not near and not self._anew()
        self._once("scan late", bad=bool(wrong), seen=(late, since_us // 1000, "ms"))

    def _anew(self) -> bool:
        """A restart is just over."""
        return any(self.bench.now - each.restarted_us < ATTEND_US for each in self.judge.units)

    def look(self) -> None:
        """What is shown by now."""
        self._times()
        self._ends()
        self._sums()
        self._rounds()
        self._promises()
        for index in range(len(self.starts)):
            self._starts(index)
            self._learned(index)
            self._minutes(index)

    def _count(self, name: str) -> int:
        value = self.bench.block[name]
        assert isinstance(value, int)
        return value

    def _line(self, name: str) -> int:
        return self._count(f"TheLine.{name}")

    def _once(self, rule: str, *, bad: bool, seen: tuple[object, ...], index: int = 0) -> None:
        self.judge.once(index, rule, bad=bad, seen=seen)

    def _times(self) -> None:
        seen = self._line("LongestScanMs"), self._line("LateScans"), self.longest_ms, self.late
        self._once("scans", bad=seen[:2] != seen[2:], seen=seen)
        echo, load = self._line("Echo"), self._line("LoadPercent")
        # a copy may pass for a reply, and a panel that asks for the same for the port's own characters
        copied = self.bench.now - self.judge.claims.doubled_us < ATTEND_US or self.bench.strangely
        copied = copied or not any(self.bench.shows("CommOk", index) for index in range(len(self.starts)))
        self._once("echo", bad=echo not in ECHOES[self.bench.echo] and not copied, seen=("Echo", echo))
        self._once("load", bad=load > 100, seen=("LoadPercent", load))

    def _steady(self) -> bool:
        """Nothing has begun anew, and no request is taken back or given up unseen."""
        bench, now = self.bench, self.bench.now
        units = self.judge.units
        anew = any(now - each.unknown_us < 2 * ATTEND_US for each in units)
        left = any(each.get("SupplyOff") or each.get("Address") != i + 1 for i, each in enumerate(bench.pins))
        return not (anew or left or bench.was_slow_port or bench.lineless or now - self.judge.slow_us < ATTEND_US)

    def _ends(self) -> None:
        """Each request ends in one way; where nothing is lost or doubled, in the one that the wire shows."""
        shown = {name: self._line(name) for name in (*ENDS, "Refusals", "Requests", "LateReplies")}
        shown |= {"unanswered": self.unanswered, "refused": self.refused, "doubts": self.doubts}
        steady, faults = self._steady(), self.bench.faults
        late = any(one.o.late_per_1000 for one in self.bench.models)
        if late or faults.lost or self.bench.damages or faults.twice or self.bench.strangely or not steady:
            self.unclean_us = self.bench.now
        grown = self._grown("steady", shown, well=steady)
        ended = sum(grown[name] for name in ENDS)
        most = 1 + grown["doubts"] + grown["LateReplies"]  # one may have been open while nothing was counted
        self._once("ends", bad=not -1 <= grown["Requests"] - ended <= most, seen=(grown,))
        grown = self._grown("clean", shown, well=self.bench.now - self.unclean_us > ATTEND_US)
        wrong = abs(grown["Timeouts"] - grown["unanswered"]) > 1 or abs(grown["Refusals"] - grown["refused"]) > 1
        self._once("ends as", bad=wrong or grown["Bad"] > 0 or grown["LateReplies"] > 0, seen=(grown,))

    def _grown(self, since: str, shown: dict[str, int], *, well: bool) -> dict[str, int]:
        """By how much counters have grown since all has been well for the last time."""
        if not well or since not in self.before:
            self.before[since] = shown
        return {name: count - self.before[since][name] for name, count in shown.items()}

    def _sums(self) -> None:
        """The slots have no more and no less than the line."""
        for name in SLOT:
            parts = [self._count(f"Slots[{i}].{name}") for i in range(8)]
            self._once(f"sum of {name}", bad=sum(parts) != self._line(name), seen=(name, parts, self._line(name)))

    def _rounds(self) -> None:
        """Each drive has its turn to be read, and a round takes as long as the line says."""
        bench, units, now = self.bench, self.judge.units, self.bench.now
        faults = bench.faults.lost or bench.damages or bench.faults.unanswered or bench.deaf
        late = any(one.o.late_per_1000 for one in bench.models) or now - self.unclean_us < 1000 * ROUNDS_MS
        well = all(now - max(each.unknown_us, each.away_us, self.asked_us) > CALM_US for each in units)
        well = well and now - self.mute_us > 1000 * ROUNDS_MS
        # one that refuses its stops, or is busy, gets them before it is read
        refused = [each.unwilling_us for each in self.judge.claims.claims] + [each.busy_us for each in bench.models]
        well = well and now - max(refused) > 1000 * ROUNDS_MS
        if faults or late or not (well and self._steady()):
            return
        reads = [
            each for each in bench.frames[-200:] if each.function <= LAST_READ and each.ms > now // 1000 - ROUNDS_MS
        ]
        numbers = [sum(each.unit == i + 1 for each in reads) for i in range(len(units))]
        self._once("turns", bad=max(numbers) - min(numbers) > 2, seen=(numbers, "reads"))
        times = [each.ms for each in reads if each.unit == 1]
        rounds = [two - one for one, two in pairwise(times)][-6:]
        scans_ms, shown = 2 * max(self.judge.late) // 1000, self._line("CycleMs")
        wrong = len(rounds) > 4 and not min(rounds) - scans_ms <= shown <= max(rounds) + scans_ms
        self._once("round", bad=wrong, seen=("CycleMs", shown, "of", rounds))

    def _promises(self) -> None:
        """The figures of docs/stop.md, with its formulas, where the times that they are made of are long known."""
        bench, count = self.bench, len(self.starts)
        turns = [self._count("Port.LateMs"), *(bench.turn_round(index) for index in range(count))]
        away = (
            bench.metered
            or bench.lineless
            or any(any_of(ASTRAY, pins) or pins.get("Address") != index + 1 for index, pins in enumerate(bench.pins))
        )
        if turns != self.turns or away or self._anew():
            self.turns, self.turns_us = turns, bench.now
        if bench.now - self.turns_us < SURE_US:
            return
        (delay, *drives), keeps = turns, "JSCC" in bench.types
        silence = JSCC_MS if keeps else SILENCE_MS
        once = MAX_SCAN_US // 1000 * (1 + keeps) + silence + 2 * delay + 2
        wire = [bench.characters_ms(number) for number in (READ_BYTES, STOP_BYTES)]
        alone = wire[0] + max(drives) + once + delay + silence
        others = [wire[1] + each + once for each in drives]
        poll, stop = wire[0] + max(drives) + once, wire[1] + max(drives) + once
        longest = [self._count(f"Slots[{index}].LongestMs") for index in range(count)]
        waits = max(late - turn for late, turn in zip(longest, drives, strict=True))
        cut = max(min(count + 2, 4) * (poll + waits), OFFLINE_MS + once) + count * (poll + stop)
        cut += max(STOP_TRIES * stop, *longest) + 2 * MAX_SCAN_US // 1000
        worst = alone + sum(others) - min(others)
        promised = ("StopAloneMs", alone, count), ("WorstStopMs", worst, count), ("CutToContactMs", cut, 2 * count + 8)
        for name, true, requests in promised:
            far = abs(self._line(name) - true) > NEAR_MS * requests
            self._once(name, bad=far, seen=(self._line(name), "of", true, "ms"))

    def _minutes(self, index: int) -> None:
        """How long it has been shown to run since all began anew."""
        shown, true = self._count(f"Drive{index}.Diagnosis.RunMinutes"), self.run_ms[index]
        near = abs((true + MINUTE_MS // 2) % MINUTE_MS - MINUTE_MS // 2) < MINUTES_NEAR_MS
        known = self.run_known[index] and not near
        self._once("minutes", bad=known and shown != true // MINUTE_MS, seen=(shown, "of", true, "ms"), index=index)

    def _learned(self, index: int) -> None:
        """TurnRoundMs, as the page of each drive block says: given, or learned from the replies, once both are old."""
        bench = self.bench
        replies, longest = (self._count(f"Slots[{index}].{name}") for name in ("Replies", "LongestReplyMs"))
        learned = max(2 * longest + MARGIN_MS, LEAST_MS) if replies >= LEARNED and longest <= HALF_MS else UNLEARNED_MS
        now, shown = (bench.number("TurnRoundMs", index) or learned), bench.turn_round(index)
        of = now, longest, self._count(f"Slots[{index}].UnitAddress")
        before, self.learned[index] = self.learned[index], of
        wrong = shown != now and before == self.learned[index] and not (bench.pins[index].get("Left") or self._anew())
        self._once("turn-round", bad=wrong, seen=(shown, "of", now, "ms"), index=index)

    def _starts(self, index: int) -> None:
        bench, unit = self.bench, self.judge.units[index]
        shown = self._count(f"Drive{index}.Diagnosis.Starts")
        count = self.starts[index]
        known = bench.now - unit.unknown_us > ATTEND_US and bench.shows("CommOk", index)
        known = known and not bench.pins[index].get("Left")
        if count is None or not known:
            self.starts[index] = shown if known else None
        else:
            self._once("starts shown", bad=shown != count, seen=(shown, "of", count), index=index)
