"""A panel, a second master that reads what we read: standstill is proved by reads that are ours, and by no others.

`python -m tests.line.panel [--first SEED] [--count N] [--store FILE]` walks so many lines of one to four drives through
a run, a stop beside the panel, a start that must not come, and quiet; `--only SEED` one of them again.
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

from tests.line.crowd import FAMILIES, Crowd, Exchange, Hall, crowd
from tests.line.many import Judged, arguments, judged, summary
from tests.second.drive import Drive
from tests.second.frames import LAST_READ

ONE_WORD = ("PF4", "PF400", "PF40P", "PF4M", "PF525")
"""Families whose reads are all one word."""
PERIODS = (20, 500)
TURNS = (2, 60)
US = 1000
READY_US, SPEED_US, STAND_US = 60_000_000, 10_000_000, 20_000_000
CALM_US = 45_000_000
"""Foreign frames bar starts until 30 s with few have passed."""
WITHIN_US = 10_000_000
"""From standstill to its proof beside a panel that leaves room."""
COUNTED_MS, FOREIGN_MOST = 10_000, 5
"""More foreign frames than these in this time bar starts."""
STALE = 5000
REQUEST, REPLY = 8, 7
"""Characters of a read, and of a reply of one word."""


@dataclass(frozen=True, kw_only=True)
class Draw:
    """What a walk is made of; times in ms."""

    seed: int
    families: tuple[str, ...]
    period: int
    turn: int
    rate: int
    keeps: bool
    scan: int
    given: bool
    """TurnRoundMs is set, not learned."""
    zero: bool
    """The panel reads registers that are 0, too."""
    listens: bool
    """It waits until the wire is free, as far as it can know."""
    others: bool
    """It reads all drives by turns, not the first alone."""
    early: bool
    """It begins before the stop."""
    says: bool
    """The drive says that it runs until its ramp has ended."""


def draw(seed: int) -> Draw:
    """A random walk."""
    chance = Random(f"panel {seed}")
    first = chance.choice(FAMILIES if chance.random() < 0.5 else ONE_WORD)
    others = tuple(chance.choice(FAMILIES) for _ in range(chance.choice((0, 0, 1, 3))))
    return Draw(
        seed=seed, families=(first, *others), period=chance.randint(*PERIODS), turn=chance.randint(*TURNS),
        rate=chance.choice((9600, 19_200, 19_200, 38_400, 115_200)), keeps=chance.random() < 0.5,
        scan=chance.choice((5, 10, 20, 40)), given=chance.random() < 0.5, zero=chance.random() < 0.5,
        listens=chance.random() < 0.3, others=chance.random() < 0.3, early=chance.random() < 0.5,
        says=chance.random() < 0.5,
    )  # fmt: skip


class Panel:
    """The second master: one request after the other, each after its period or when the last one has ended."""

    def __init__(self, hall: Hall, one: Draw, chance: Random) -> None:
        """Know what our blocks read."""
        self.hall, self.draw, self.chance = hall, one, chance
        self.reads: dict[int, list[bytes]] = {}
        self.on, self.last_us, self.number = False, 0, 0
        self.whole: list[int] = []
        """When requests began that nothing of ours ran into: others cannot be heard."""
        self.busy_us = 0
        hall.watch.append(self._heard)

    def _heard(self, exchange: Exchange) -> None:
        data = exchange.data
        if data[1] <= LAST_READ and data not in self.reads.setdefault(data[0], []):
            self.reads[data[0]].append(data)
        self.busy_us = max(self.busy_us, exchange.end, *(each[1] for each in exchange.replies))

    def begin(self) -> None:
        """Speak from now on."""
        self.on = True
        self.hall.at(self.hall.now + self.chance.randint(0, US * self.draw.period), self._asks)

    def end(self) -> None:
        """Fall silent."""
        self.on = False

    def _request(self) -> bytes:
        units = sorted(self.reads) if self.draw.others else [1]
        unit = self.chance.choice(units)
        read = self.chance.choice(self.reads[unit])
        if not self.draw.zero or self.chance.random() < 0.3:
            return read
        one = self.hall.models[unit][0]
        listed = sorted({*one.LIVE, *one.ram})
        zeros = [
            each for each in listed if not (one.LIVE[each](one, self.hall.time) if each in one.LIVE else one.ram[each])
        ]
        return read[:2] + self.chance.choice(zeros or listed).to_bytes(2, "big") + read[4:]

    def _asks(self) -> None:
        """Now."""
        if not self.on or not self.reads.get(1):
            return
        hall, asked = self.hall, self.hall.time
        if self.draw.listens and asked < self.busy_us:
            hall.at(self.busy_us + 4 * hall.char_us, self._asks)
            return
        data = self._request()
        number, end = hall.transmit(data, asked)
        self.last_us = end
        hall.at(end, lambda: self._asked(data, number, asked, end))

    def _asked(self, data: bytes, number: int, asked: int, end: int) -> None:
        spoilt = self.hall.library.c.crowd_spoilt(number)
        replied = 0 if spoilt else self.hall.answer(data, end)
        if not spoilt:
            self.whole.append(asked)
        over = replied or end + US * 100  # its time-out
        self.last_us = max(self.last_us, replied)
        self.number += 1
        self.hall.at(max(asked + US * self.draw.period, over + 4 * self.hall.char_us), self._asks)


class Walk:
    """One walk."""

    def __init__(self, name: str, one: Draw, library: Crowd) -> None:
        """Power up."""
        self.draw, chance = one, Random(f"walk {one.seed}")
        self.out = Judged(name)
        self.hall = h = Hall(
            library, one.seed, slots=len(one.families), rate=one.rate, keeps=one.keeps, scan_us=US * one.scan
        )
        for at, family in enumerate(one.families):
            turn = one.turn + 10 if one.given else 0
            h.drive(family, at + 1, SETTINGS__TurnRoundMs=turn, SETTINGS__LongestMs=2 * turn)
            made = h.model(
                family,
                at + 1,
                reply_us=(US * one.turn, US * one.turn),
                seed=one.seed,
                coast_hz_s=10.0,
                running_in_ramp=one.says,
            )
            if made.o.comm_us is not None:
                h.put(at, SETTINGS__WatchdogMs=made.o.comm_us // US)
        self.panel = Panel(h, one, chance)
        self.chance = chance
        self.one: Drive = h.models[1][0]
        self.panel_us = 0
        h.restart()

    @property
    def room(self) -> bool:
        """The panel's period leaves room for an exchange."""
        exchange = self.draw.turn + self.hall.char_us * (REQUEST + REPLY) / US
        return self.draw.period >= 3 * exchange + 2 * self.draw.scan

    def wait(self, what: str, most_us: int) -> bool:
        """Until an output of the first drive is TRUE."""
        return self.until(lambda: bool(self.hall.drives[0][what]), most_us)

    def until(self, test: object, most_us: int) -> bool:
        """Until something is so; the first drive is watched meanwhile."""
        end = self.hall.now + most_us
        while not test():  # type: ignore[operator]
            if self.hall.now >= end:
                return False
            self.step()
        return True

    def step(self) -> None:
        """A scan, and a look at it."""
        h, d = self.hall, self.hall.drives[0]
        h.run(h.now + US * self.draw.scan)
        hz = self.one.shaft_hz(h.now)
        if hz and d["StopConfirmed"]:
            self.out.tell("turning", f"{self._who()}: StopConfirmed at {hz:.1f} Hz, ErrorID {h.line['ErrorID']:.0f}")
        if self.panel.on and d["StopOverdue"]:
            if self.room:
                self.out.tell("overdue", f"{self._who()}: Reason {d['Reason']:.0f}")
            self.out.figures["overdue, crowded"] = float(not self.room)

    def _who(self) -> str:
        one = self.draw
        return (
            f"{self.hall.now // US} ms, {one.families[0]} in {one.turn} ms, panel {one.period} ms, scan {one.scan} ms"
        )

    # ------------------------------------------------------------ the walk

    def go(self) -> Judged:
        """All of it."""
        if not self.wait("Ready", READY_US):
            self.out.tell("ready", f"{self._who()}: Reason {self.hall.drives[0]['Reason']:.0f}")
            return self.out
        self.hall.put(0, RunForward=1)
        if not self.until(lambda: self.one.motor.hz(self.hall.now) >= 25, SPEED_US):
            self.out.tell("start", f"{self._who()}: Reason {self.hall.drives[0]['Reason']:.0f}")
            return self.out
        self.beside()
        self.start_in_vain()
        self.quiet()
        return self.out

    def beside(self) -> None:
        """A stop beside the panel: no proof while it turns, and then one."""
        h = self.hall
        if self.draw.early:
            self.panel.begin()
            self.pass_(self.chance.randint(0, 4000))
        h.put(0, RunForward=0)
        self.pass_(self.chance.randint(0, 1500))
        if not self.panel.on:
            self.panel.begin()
        if not self.until(lambda: not self.one.motor.hz(h.now), STAND_US):
            if self.room:
                self.out.tell("stop", f"{self._who()}: it turns on")
            return
        self.panel_us = h.now
        came = self.wait("StopConfirmed", WITHIN_US)
        self.out.figures["beside"] = (h.now - self.panel_us) / 1e6 if came else 99.0
        if not came and self.room:
            d = h.drives[0]
            self.out.tell(
                "beside", f"{self._who()}: Reason {d['Reason']:.0f} after 10 s, {self.panel.number} of its requests"
            )

    def start_in_vain(self) -> None:
        """An edge beside it starts nothing, where it has been heard often enough; what no stop reaches runs on."""
        h = self.hall
        self.pass_(COUNTED_MS)
        runs = self.one.output
        heard = sum(each > h.now - US * COUNTED_MS for each in self.panel.whole)
        h.put(0, RunForward=1)
        self.pass_(6000)
        if self.one.output and not runs and heard > FOREIGN_MOST:
            self.out.tell("starts", f"{self._who()}: it runs, {self.panel.number} requests of the panel")
        h.put(0, RunForward=0)

    def quiet(self) -> None:
        """It is gone: the proof comes, and later a start."""
        h, d = self.hall, self.hall.drives[0]
        self.panel.end()
        self.until(lambda: not self.one.motor.hz(h.now), STAND_US)
        begun = max(h.now, self.panel.last_us)
        longest, read = int(h.slots[0]["LongestMs"]), int(h.slots[0]["ReadMs"])
        most = 2 * longest + 2 * read + 3 * self.draw.scan
        if not self.wait("StopConfirmed", begun - h.now + US * most):
            came = self.wait("StopConfirmed", WITHIN_US)
            self.out.tell(
                "quiet",
                f"{self._who()}: after {(h.now - begun) // US if came else 'more than 10,000'} ms of {most},"
                f" LongestMs {longest}, ReadMs {read}",
            )
        self.out.figures["quiet"] = (h.now - begun) / US / most if most else 0.0
        self.pass_(CALM_US // US)
        if d["RunForward"] or not self.wait("Ready", READY_US):
            self.out.tell("again", f"{self._who()}: Reason {d['Reason']:.0f}")

    def pass_(self, ms: int) -> None:
        """Time."""
        end = self.hall.now + US * ms
        while self.hall.now < end:
            self.step()


def judge(name: str) -> Judged:
    """Judge a walk by its seed."""
    return Walk(name, draw(int(name)), crowd()).go()


def report(found: Sequence[Judged]) -> int:
    """What they have shown; 1 where one failed."""
    bad = summary(found)
    beside = sorted(each.figures["beside"] for each in found if "beside" in each.figures)
    if beside:
        late = sum(each > WITHIN_US / 1e6 for each in beside)
        print(f"beside it proved after {beside[len(beside) // 2]:.2f} s at the median, not within 10 s: {late}")
    crowded = sum(each.figures.get("overdue, crowded", 0) for each in found)
    print(f"overdue beside one that leaves no room: {crowded:.0f} walks")
    return bad


def main() -> int:
    """Walk."""
    parser = arguments(__doc__ or "", 2000)
    parser.add_argument("--only", help="one of them")
    options = parser.parse_args()
    crowd()  # compiled once, for all processes
    names = [options.only] if options.only else [str(options.first + at) for at in range(options.count)]
    return report(judged(names, judge, options.jobs, options.store))


if __name__ == "__main__":
    sys.exit(main())
