"""Random lines of real drive blocks: who is read how often, and whom others stop.

`python -m tests.line.budget [--first SEED] [--count N] [--store FILE]` judges lines of 2 to 32 drives of all families,
which start together, are stopped and started again, and of which some fall silent, refuse or go dark at once; `--alike`
judges those of eight drives of one family; `--only NAME` one of them again.
"""

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from random import Random
from statistics import median

from tests.line.crowd import FAMILIES, Crowd, Exchange, Hall, crowd
from tests.line.many import Judged, arguments, judged, summary
from tests.second.drive import Drive
from tests.second.frames import LAST_READ, runs
from tests.second.pf4 import alike

RATES = (9600, 19_200, 38_400, 57_600, 115_200)
STALE_MS = (0, 0, 0, 3000, 10_000, 20_000)
REFRESH_MS = (0, 0, 300, 65_535)
ORDERS = alike({"ATV312": 8501, "CHF": 0x1000, "GD200A": 0x2000, "JSCC": 0x1000, "MX2": 0, "PF4": 0x2000, "SN300G5": 0})
"""Where each takes its runs and stops."""
HOW = ("silent", "refusing", "dark")
READY_US, CALM_US, START_US = 240_000_000, 60_000_000, 60_000_000
"""How long drives may take to be ready: 20 replies of each at the slowest line; how long nothing has changed of those
that are not; how long from an edge to the first turn."""
DYING_US, AFTER_US, END_US = 20_000_000, 40_000_000, 40_000_000
"""From the start to the death of some, from there to the last stop, and then to the end."""
ALIKE = 8
READY, TOO_SLOW = 1, 55
"""Reasons: it may start, and nothing else is to be said; the line reads it too seldom."""
STALE = 5000
"""The usual StaleMs."""
SOME_DEAD = 1.6
"""How much of CutToContactMs it may take while others answer, each of whom has the wire in between."""
NEVER = 99.0
"""Times of what was promised: it did not come."""
SHARE, STARTS = 0.5, 0.6
"""At least so much of WorstReadMs is seen at the median of lines; so many lines may start their drives."""
US = 1000


@dataclass(frozen=True, kw_only=True)
class Draw:
    """What a line is made of. Times in ms, those of replies and scans in us."""

    seed: int
    families: tuple[str, ...]
    rate: int = 19_200
    bits: int = 10
    keeps: bool = True
    scan: int = 10_000
    jitter: int = 0
    reply: tuple[tuple[int, int], ...] = ()
    """Of each drive, the shortest and the longest; usually 5 ms."""
    turn: tuple[int, ...] = ()
    """TurnRoundMs of each; 0: learned, and LongestMs as the map has it."""
    stale: int = 0
    refresh: int = 0
    dead: tuple[int, ...] = ()
    how: str = "silent"
    pulses: bool = False
    wavers: bool = False
    strict: bool = False
    """No motor is excused: its figures have to be within its times."""


def draw(seed: int) -> Draw:
    """A random line."""
    chance = Random(f"budget {seed}")
    count = chance.randint(2, 32)
    mix = chance.sample(FAMILIES, chance.choice((1, 2, 3, len(FAMILIES), len(FAMILIES))))
    scan = 1000 * chance.randint(1, 50)
    reply, turn = [], []
    set_ = chance.random() < 0.5
    for _ in range(count):
        low = chance.randint(1000, 20_000)
        high = low + chance.choice((0, chance.randint(0, 20_000)))
        reply.append((low, high))
        turn.append(high // 1000 + chance.randint(2, 30) if set_ else 0)
    some = chance.choice((0, 1, chance.randint(0, count - 1), count - 1, chance.randint(0, count)))
    return Draw(
        seed=seed, families=tuple(chance.choice(mix) for _ in range(count)), rate=chance.choice(RATES),
        bits=chance.choice((10, 11)), keeps=chance.random() < 0.5, scan=scan, jitter=chance.choice((0, scan // 2)),
        reply=tuple(reply), turn=tuple(turn), stale=chance.choice(STALE_MS), refresh=chance.choice(REFRESH_MS),
        dead=tuple(chance.sample(range(count), some)), how=chance.choice((*HOW, "mixed")),
        pulses=chance.random() < 0.5, wavers=chance.random() < 0.3,
    )  # fmt: skip


def alike_lines() -> Iterator[str]:
    """Eight drives of each family at 19,200 bit/s, started together; then none to seven die."""
    every = product(FAMILIES, (10, 20, 50), range(ALIKE), ("port", "line"))
    return (",".join(map(str, each)) for each in every)


class Line:
    """One line, from power-up to the last stop."""

    def __init__(self, name: str, one: Draw, library: Crowd) -> None:
        """Power up."""
        self.draw, self.chance = one, Random(f"line {one.seed}")
        self.out = Judged(name)
        self.hall = h = Hall(
            library, one.seed, slots=len(one.families), rate=one.rate, bits=one.bits, keeps=one.keeps,
            scan_us=one.scan, jitter_us=one.jitter,
        )  # fmt: skip
        self.models: list[Drive] = []
        for at, family in enumerate(one.families):
            low_high = one.reply[at] if one.reply else (5000, 5000)
            pins = {"SETTINGS.RefreshMs": one.refresh, "SETTINGS.StaleMs": one.stale}
            turn = one.turn[at] if one.turn else 0
            pins |= {"SETTINGS.TurnRoundMs": turn, "SETTINGS.LongestMs": 2 * turn, "StopWithinMs": 65_000}
            h.drive(family, at + 1, **pins)
            self.models.append(h.model(family, at + 1, reply_us=low_high, seed=one.seed + at))
            comm = self.models[-1].o.comm_us
            if comm is not None:
                h.put(at, SETTINGS__WatchdogMs=comm // US)
        self.kept: set[int] = set()
        """Drives that nobody asks to stop, and that run."""
        self.asked: dict[int, tuple[int, int]] = {}
        """Open stops: when the pin fell, and how late the stop may be, ms."""
        self.gone: set[int] = set()
        """Those that died, and of them those that ran and fell silent."""
        self.dying: set[int] = set()
        self.died_us = 0
        self.cut_ms = 0
        h.watch.append(self._heard)
        h.restart()

    # ------------------------------------------------------------ the judge

    def _heard(self, exchange: Exchange) -> None:
        at = exchange.data[0] - 1
        if exchange.data[1] > LAST_READ and self._stops(at, exchange.data):
            self._stopped(at, exchange)
        if at in self.kept:
            one = self.models[at]
            one.advance(exchange.end)
            if one.stopping or not one.output:
                self.kept.discard(at)
                self._lost(at, exchange)

    def _stops(self, at: int, data: bytes) -> bool:
        family = self.draw.families[at]
        return int.from_bytes(data[2:4], "big") == ORDERS[family] and not runs(family, data)

    def _stopped(self, at: int, exchange: Exchange) -> None:
        """A stop is on the wire: not later than the line has said."""
        if at not in self.asked or self.hall.seen(at).put_at < 0:
            return
        worst = max(self.asked.pop(at)[1], int(self.hall.slots[at]["WorstStopMs"]))
        took = exchange.begins - self.hall.seen(at).put_at
        self.out.figures["stops"] = self.out.figures.get("stops", 0) + 1
        self.out.most("stop", took / (US * worst) if worst else NEVER)
        if took > US * worst:
            self.out.tell("late", f"{self._who(at)}: a stop after {took // US} of {worst} ms")

    def _lost(self, at: int, exchange: Exchange) -> None:
        """A healthy motor was stopped: only where its line had said that it may be read too seldom."""
        seen, slot, d = self.hall.seen(at), self.hall.slots[at], self.hall.drives[at]
        stale, worst = self.stale(at), max(seen.worst, int(slot["WorstReadMs"]))
        by, one = "others" if self.gone else "load", self.models[at]
        if self.slow(at) and (not self.draw.strict or one.fault == one.LINE_LOST):
            return
        self.out.tell(
            f"stopped by {by}",
            f"{self._who(at)} with {exchange.data.hex()}: StopReason {d['DIAGNOSIS.StopReason']:.0f}, "
            f"Reason {d['Reason']:.0f}, age at most {seen.age} of {worst} ms, StaleMs {stale}, fault {one.fault},"
            f" WorstFeedMs {slot['WorstFeedMs']:.0f}",
        )

    def slow(self, at: int) -> bool:
        """Its line has said that it may be read, or its watchdog fed, too seldom."""
        slot, one = self.hall.slots[at], self.models[at]
        worst = max(self.hall.seen(at).worst, int(slot["WorstReadMs"]))
        most = self.stale(at)
        if one.fault == one.LINE_LOST:
            worst, most = min(worst, int(slot["WorstFeedMs"])), (one.o.comm_us or 0) // US
        return bool(worst > most)

    def _who(self, at: int) -> str:
        return f"{self.hall.now // US} ms, {self.draw.families[at]} {at + 1}"

    def stale(self, at: int) -> int:
        """The StaleMs that holds."""
        return int(self.hall.slots[at]["StaleMs"]) or self.draw.stale or STALE

    # ------------------------------------------------------------ what happens

    def ready(self) -> bool:
        """Wait until all may start; why one may not."""
        h, changed, shown = self.hall, self.hall.now, ""
        while h.now < READY_US and h.now - changed < CALM_US:
            h.run(h.now + 500_000)
            now = str([(d["Ready"], d["Reason"], d["DIAGNOSIS.TurnRoundMs"]) for d in h.drives])
            if all(d["Ready"] for d in h.drives) and h.now - changed > 2_000_000:
                break
            changed, shown = (h.now, now) if now != shown else (changed, shown)
        slow = any(s["ReadMs"] > self.stale(at) for at, s in enumerate(h.slots))
        for at, d in enumerate(h.drives):
            read, stale = int(h.slots[at]["ReadMs"]), self.stale(at)
            if not d["Ready"]:
                self.out.figures.setdefault("barred", d["Reason"])
            shown = f"{self._who(at)}: Ready {d['Ready']:.0f}, Reason {d['Reason']:.0f}, ReadMs {read} of {stale}"
            if read <= stale and not d["Ready"] and not slow:
                self.out.tell("ready", shown)
            if read > stale and not d["Ready"] and d["Reason"] != TOO_SLOW:
                self.out.tell("reason", shown)
            if read > stale and d["Ready"] and d["Reason"] == READY:  # it has risen since: a warning
                self.out.tell("warning", shown)
            if not (read and int(h.slots[at]["WorstReadMs"]) >= read):
                self.out.tell(
                    "figures", f"{self._who(at)}: ReadMs {read}, WorstReadMs {h.slots[at]['WorstReadMs']:.0f}"
                )
        return "barred" not in self.out.figures

    def start(self) -> None:
        """All that may, together."""
        h = self.hall
        may = [at for at, d in enumerate(h.drives) if d["Ready"]]
        for at in range(len(h.drives)):
            h.seen(at).watched = 1
        for at in may:
            h.put(at, RunForward=1)
        end = h.now + START_US
        while h.now < end and len(self.kept) < len(may):
            h.run(h.now + 100_000)
            self._keep(may)
        for at in may:
            if at not in self.kept and (self.draw.strict or not self.slow(at)):
                d = h.drives[at]
                self.out.tell(
                    "start", f"{self._who(at)}: Reason {d['Reason']:.0f}, StopReason {d['DIAGNOSIS.StopReason']:.0f}"
                )

    def _keep(self, some: Sequence[int]) -> None:
        for at in some:
            one = self.models[at]
            one.advance(self.hall.now)
            if self.hall.drives[at]["RunForward"] and one.output and not one.stopping and at not in self.gone:
                self.kept.add(at)

    def die(self) -> None:
        """Some at once."""
        h = self.hall
        self.cut_ms, self.died_us = int(h.line["CutToContactMs"]), h.now
        running = set(self.kept)
        for at in self.draw.dead:
            how = self.draw.how if self.draw.how != "mixed" else self.chance.choice(HOW)
            self.gone.add(at)
            self.kept.discard(at)
            self.asked.pop(at, None)
            h.seen(at).watched = 0
            one = self.models[at]
            if how == "silent":
                h.deaf.add(at + 1)
                self.dying |= {at} & running
            elif how == "refusing":
                one.o = replace(one.o, busy_refuses="all")
                one.be_strict(h.now, 10**10)
            else:
                one.power(False, h.now)
                h.put(at, SupplyOff=1)

    def live(self, until: int) -> None:
        """Pulses, references that never rest, or nothing."""
        h, well = self.hall, [at for at in range(len(self.models)) if at not in self.gone]
        while h.now < until:
            h.run(min(until, h.now + self.chance.randint(50_000, 1_000_000)))
            if self.draw.wavers:
                at = self.chance.choice(well or [0])
                h.put(at, SpeedReferenceHz=20.0 + self.chance.randint(0, 10))
            if self.draw.pulses and well:
                self._pulse(self.chance.choice(well))
            self._keep(well)

    def _pulse(self, at: int) -> None:
        d = self.hall.drives[at]
        if d["RunForward"]:
            self.release(at)
        elif d["Ready"]:
            self.hall.put(at, RunForward=1)

    def release(self, at: int) -> None:
        """The run pin falls; of a drive that runs, a stop is owed."""
        if at in self.kept:
            self.kept.discard(at)
            self.asked[at] = self.hall.now, int(self.hall.slots[at]["WorstStopMs"])
        self.hall.put(at, RunForward=0)

    def end(self) -> None:
        """All are stopped at once; nobody healthy turns any more."""
        h = self.hall
        for at in range(len(self.models)):
            self.release(at)
        h.run(h.now + END_US)
        for at, one in enumerate(self.models):
            if at not in self.gone and one.shaft_hz(h.now):
                self.out.tell("lost", f"{self._who(at)} turns")
        for at in set(self.asked) - self.gone:
            self.out.tell("lost", f"{self._who(at)}: no stop was sent")

    def sum_up(self) -> None:
        """What the whole line has shown."""
        h, out = self.hall, self.out
        for at in range(len(self.models)):
            seen = h.seen(at)
            if seen.over:
                out.tell(
                    "older", f"{self.draw.families[at]} {at + 1}: {seen.over_age} of {seen.over_worst} ms at "
                    f"{seen.over_at // US} ms, {seen.over} calls",
                )  # fmt: skip
            if seen.lost_starts:
                out.tell("ready in vain", f"{self.draw.families[at]} {at + 1}: at {seen.lost_at // US} ms")
            if seen.worst and seen.watched:
                out.most("share", seen.age / seen.worst)
        for at in self.dying:
            took = h.seen(at).overdue_at - self.died_us
            part = took / (US * self.cut_ms) if h.seen(at).overdue_at >= 0 else NEVER
            nobody = len(self.gone) == len(self.models) and self.draw.how != "mixed"  # where some refuse, they answer
            out.most("all cut" if nobody else "cut", part)
            if part > (1 if nobody else SOME_DEAD):
                out.tell("cut", f"{self.draw.families[at]} {at + 1}: overdue after {part:.2f} x {self.cut_ms} ms")
        if h.library.short_silences.value:
            out.tell("silence", f"{h.library.short_silences.value} requests too early")
        out.figures["seconds"] = h.now / 1e6

    def go(self) -> Judged:
        """All of it."""
        h = self.hall
        self.out.figures["starts"] = self.ready()
        if any(d["Ready"] for d in h.drives):
            self.start()
            self.live(h.now + DYING_US)
            self.die()
            self.live(h.now + AFTER_US)
            self.end()
        self.sum_up()
        return self.out


def judge(name: str) -> Judged:
    """Judge a line by its name: a seed, or a family, its scan, how many die, and who keeps the silence."""
    return Line(name, named(name), crowd()).go()


def named(name: str) -> Draw:
    """The line of a name."""
    if name.isdecimal():
        return draw(int(name))
    family, scan, dead, who = name.split(",")
    lost = tuple(range(ALIKE - int(dead), ALIKE))
    families = (family,) * ALIKE
    return Draw(seed=int(dead), families=families, keeps=who == "port", scan=US * int(scan), dead=lost, strict=True)


def report(found: Sequence[Judged], *, random: bool) -> int:
    """Figures of all lines; 1 where a bar is not held."""
    bad = summary(found)
    figures = [each.figures for each in found]
    starts = sum(each["starts"] for each in figures) / max(1, len(found))
    shares = [each["share"] for each in figures if each.get("share")]
    share = median(shares) if shares else 0.0
    print(f"{sum(each['seconds'] for each in figures) / 3600:.1f} hours of the bus")
    barred = Counter(each["barred"] for each in figures if each.get("barred"))
    print(f"may start {100 * starts:.1f} %, barred by reason {dict(barred)}")
    print(f"largest age of WorstReadMs: median {share:.2f}, most {max(shares, default=0):.2f}")
    for name, of in (
        ("stop", "WorstStopMs"),
        ("cut", "CutToContactMs, some dead"),
        ("all cut", "CutToContactMs, all dead"),
    ):
        print(f"most of {of}: {max((each.get(name, 0) for each in figures), default=0):.2f}")
    print(f"{sum(each.get('stops', 0) for each in figures):.0f} stops")
    return 1 if bad or (random and (starts < STARTS or share < SHARE)) else 0


def main() -> int:
    """Judge lines."""
    parser = arguments(__doc__, 10_000)
    parser.add_argument("--alike", action="store_true", help="eight drives of one family, also while some die")
    parser.add_argument("--only", help="one of them")
    options = parser.parse_args()
    crowd()  # compiled once, for all processes
    names = list(alike_lines()) if options.alike else [str(options.first + at) for at in range(options.count)]
    found = judged([options.only] if options.only else names, judge, options.jobs, options.store)
    return report(found, random=not options.alike and not options.only)


if __name__ == "__main__":
    sys.exit(main())
