"""Judges a second bench: the observer's rules, the contact of the hard stop, what the outputs say, who is kept running.

It reads pins of blocks, true models and bytes; no state of a block, no map, and no reply.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import takewhile
from typing import TYPE_CHECKING, Any

from tests.second.claims import Claims
from tests.second.counts import Counts
from tests.second.figures import (
    ASTRAY,
    ATTEND_US,
    BOOT_US,
    CALM_US,
    CODE_MOST,
    EVERY_US,
    FOREIGN,
    JOG_ENDS,
    JOG_US,
    MAX_SCAN_US,
    REFUSED_US,
    STOP_TRIES,
    TAKEN,
    UNHURRIED_MS,
    UNLEARNED_MS,
    crowded,
    round_us,
)
from tests.second.observer import MOVES, RAMP_US, Figures, Observer, Seen, Truth, any_of
from tests.second.orders import Orders
from tests.second.pf4 import alike
from tests.second.shown import LAG_US, Shown
from tests.second.wire import REFUSED, SILENCE, SPEED, STATUS, Exchange, Wire

if TYPE_CHECKING:
    from tests.second.bench import Second

READING = 5
"""State of MonitorOnly: the motor is that of others."""
CUT_US = 2_200_000
"""From the silence of a drive that turns to the open contact: offline, then a stop and retries."""
LATE_US = 1_000_000
"""How much later where replies are late: the line waits longer for each."""
SHARED_SCANS = 3
"""From a second block on a slot to the open contact, in calls of the line."""
MORE_US = 500_000
"""How much later with three drives, again with eight, and again in slow scans: their requests are between."""
SLOW_US = 1_500_000
"""How much later that may be where scans take longer than the program has promised."""
RESTARTED_US = 2_000_000
"""After a restart nothing is written to a drive before it was read."""
PIN_US = 1_000_000
"""In SpeedOnly, from a stop pin to standstill, beside the ramp: attempts."""
RUN_HZ = 25.0
"""What runs ask for: the motor may be on its way to it."""
ATTEMPTS_US = 1_000_000
"""How much longer it takes where each stop is refused first."""
BACK_US = 2_000_000
"""Silence is no alarm for so long once its user says that it has its supply again."""
PAUSE_US = 8_000_000
"""The longest pause between probes of a drive that was dead."""
PROBED_US = 10_500_000
"""So long may it take until the line finds that a drive answers whose user says that it has no supply."""
STORE_US = 60_000_000
"""At most one store of a drive in that time, by the page of VFD_Store."""
ANSWER_US = 2_000_000
"""Within this time a drive that can be reached has answered something."""
WITHIN_US = 5_000_000
"""WithinMs: a parameter block takes its request back then, even while a reply is on its way."""
ASKED_US = 20_000_000
"""A parameter block has ended by then."""
QUIET_US = 2_000_000
"""A drive that can be reached for so long has CommOk, and no reason that says that it does not answer: probes are sent
8 s apart at most."""
GRACE_US = 3_000_000
"""A contact may open so long after its reason has ended, which the block cannot know at once."""
SHAFT = 700
"""Scans of which the frequency is remembered."""
SAYS_RUNNING: dict[str, Callable[[Any, int], bool]] = alike(
    {
        "ATV312": lambda one, now: bool(one.LIVE[3206](one, now) & 16),  # ETI: bit 4
        "CHF": lambda one, now: one.LIVE[0x1001](one, now) in (1, 2),  # 1001H: 1 forward, 2 reverse
        "JSCC": lambda one, now: bool(one.LIVE[0x2001](one, now) & 3),  # 2001H: bits 0 and 1
        "GD200A": lambda one, now: one.LIVE[0x2100](one, now) in (1, 2),  # 2100H: 1 forward, 2 reverse
        "MX2": lambda one, now: one.SHOWN[0x0F](one, now),  # coil 000FH
        "PF4": lambda one, now: bool(one.LIVE[0x2100](one, now) & 2),  # 2100H: bit 1
        "SN300G5": lambda one, now: bool(one.LIVE[0x0010](one, now) & 1),  # 0010H: bit 0
        "V20": lambda one, now: bool(one.LIVE[0x006D](one, now) & 4),  # 40110: bit 2
        "ACS355": lambda one, now: bool(one.LIVE[3](one, now) & 4),  # 40004: bit 2
    }
)
SILENT = {13: "no reply yet", 14: "the drive has stopped answering", 52: "replies come too late"}
"""Reasons that speak of no reply in time, by the table of the drive block's page."""
RAM_ONLY = alike(
    {"ATV312": 0, "CHF": 0x8000, "GD200A": 0x8000, "JSCC": 0, "MX2": 0, "PF4": 0, "SN300G5": 0, "V20": 0, "ACS355": 0}
)
"""The bit of an address that leaves EEPROM alone."""
OFFLINE, NOT_SENT, READ, WRITE = 51, 68, "Reader", "Writer"
VALUES = ("Value", "Value2", "Value3", "Value4")
"""Words of a parameter block."""
TAKEN_BACK, ATTEMPTS, MOVES_NOW = 52, 2, 66
REFUSED_WORDS = (3, 62)
"""What comes of several words: they are too many, or one commands the motor."""
UNPERMITTED = (50, OFFLINE, 65, 66, NOT_SENT, 69, 70)
"""What may come of a write that nobody has permitted: it is not in the map, or it does not come so far."""


def says_zero(kind: str, one: Any, now: int) -> bool:
    """Whether a drive's registers say that it is at 0 Hz: those of SN300G5 by bit 1 of 0010H, others by a frequency."""
    return bool(one.LIVE[0x0010](one, now) & 2) if kind == "SN300G5" else not one.LIVE[SPEED[kind]](one, now)


@dataclass(slots=True)
class Unit:
    """What is remembered of one drive."""

    says_running: Callable[[Any, int], bool]
    """Whether its status says that it runs."""
    running: list[int] = field(default_factory=lambda: [-1, -1])
    """When it last said that it does not, and that it does."""
    fault: list[int] = field(default_factory=lambda: [-1, -1])
    """The same of a fault."""
    zero: list[int] = field(default_factory=lambda: [-1, -1])
    """The same of a frequency of 0."""
    shaft: deque[tuple[int, float]] = field(default_factory=lambda: deque(maxlen=SHAFT))
    """Frequencies that the drive showed, with their times."""
    away_us: int = 0
    """When it could last not be reached."""
    reachable: bool = False
    """Whether it hears what is sent to the address of its pins."""
    heard_us: int = 0
    """When it could last hear, whatever the address of its pins."""
    unknown_us: int = 0
    """When it could last not be reached, or all began anew."""
    refuses_us: int = 0
    """When it last refused to be read, by its options."""
    reads_us: int = 0
    """When it last did not."""
    pin_us: int | None = None
    pin_hz: float = 0.0
    """Since when a pin asks to stop what terminals run, and how fast that was then."""
    stored_us: int = 0
    silent_since: int | None = None
    shared: bool = False
    """Since when it does not hear, or two blocks use its slot, and which of them."""
    restarted_us: int = 0
    answered_us: int = 0
    """For how long it could be reached since then."""
    turned_us: int = 0
    """When it last stood, or was asked to turn: it turns unasked since then."""
    dark_us: int = -PROBED_US
    """When it was last silent while its user said that it has no supply."""
    back_us: int = 0
    """From when on its silence is an alarm again, after its user has said that it has no supply."""
    off: bool = False
    """Its block was called with SupplyOff."""
    excused_us: int = 0
    """The same, but for a drive without supply on purpose."""
    unasked_us: int = 0
    """When it last turned unasked for long, or by somebody else's hand: the contact may open for it."""
    lied_us: int = -CALM_US
    """When it last was one that acknowledges orders and does not obey them."""
    forgotten: bool = False
    """A restart came while it ignored stops, or just before, into SpeedOnly: it looks like one that terminals run."""
    broken: set[str] = field(default_factory=set)


@dataclass
class Asked:
    """A parameter block that was asked for something: its name, its drive, and what must come of it."""

    name: str
    index: int
    address: int
    values: tuple[int, ...]
    """What is written, or has to be read."""
    since_us: int
    frames: int
    """Frames before."""
    permitted: bool = True
    """Else it must be refused, and nothing sent."""
    heard: bool = False
    """Its drive answered then: else nobody knows how soon it is asked again."""
    stood: bool = False
    """It was shown at standstill then."""

    @property
    def value(self) -> int:
        """The first."""
        return self.values[0]

    def _kept(self, judge: "Judge") -> list[int | None]:
        """What the drive holds there."""
        one = judge.bench.models[self.index]
        first = self.address if self.name.startswith(READ) else self.address & ~RAM_ONLY[judge.bench.types[self.index]]
        return [one.ram.get(first + at) for at in range(len(self.values))]

    def _refused(self, judge: "Judge", *, sent: bool) -> None:
        """What nobody has permitted is not sent, and its error says so."""
        said = judge.bench.block[f"{self.name}.ErrorID"]
        if sent:
            judge.tell(self.index, "parameter", f"{self.name} writes what no manual has, and nobody has permitted")
        elif said not in (UNPERMITTED if len(self.values) == 1 else (*UNPERMITTED, *REFUSED_WORDS)):
            judge.tell(self.index, "parameter", f"{self.name} says {said!r}")

    def _ended(self, judge: "Judge", said: object, *, known: bool) -> None:
        """It ends as its last request does; one that nobody answers is sent twice."""
        one, now = judge.bench.models[self.index], judge.bench.now
        if not known or one.o.late_per_1000 or now < one.busy_us + ATTEND_US or now >= self.since_us + WITHIN_US:
            return
        if said == OFFLINE and not judge.bench.shows("CommOk", self.index):
            return  # with other requests before, which nobody has answered either
        if said == MOVES_NOW and not judge.bench.shows("StopConfirmed", self.index):
            return  # somebody else has started it between two attempts
        mine = [each for each in judge.wire.since(self.since_us) if each.about(one.unit, self.address)]
        if not self.name.startswith(READ):
            mine = [each for each in mine if each.data[4:6] == self.value.to_bytes(2, "big") or each.data[1] == 16]
        if not mine:
            return
        last = mine[-1]
        right = {0} if last.good else {REFUSED} if last.refused else {SILENCE}
        if not last.good or not (said in UNPERMITTED or said in (0, TAKEN_BACK)):
            wrong = said not in right or (said == SILENCE and len(mine) != ATTEMPTS)
            judge.once(self.index, "ends with", bad=wrong, seen=(self.name, said, "of", right, len(mine)))

    def over(self, judge: "Judge") -> bool:
        """Whether it has ended; what it says is then judged."""
        bench, one = judge.bench, judge.bench.models[self.index]
        done, error = bench.block[f"{self.name}.Done"], bench.block[f"{self.name}.Error"]
        if not (done or error):
            if bench.now - self.since_us <= ASKED_US:
                return False
            judge.tell(self.index, "parameter", f"{self.name} does not end")
            return True
        bench.block[f"{self.name}.Execute"] = False
        mine = [f for f in bench.frames[self.frames :] if (f.unit, f.address) == (one.unit, self.address)]
        if not self.permitted:
            self._refused(judge, sent=bool(done or mine))
        if self.name.startswith(READ):
            read = [bench.block[f"{self.name}.{pin}"] for pin in VALUES[: len(self.values)]]
            wrong = done and read not in (list(self.values), self._kept(judge))
            if wrong and not judge.claims.mistaken(self.index, bench.now):
                judge.tell(self.index, "parameter", f"{self.name} has read {read!r}")
        elif self.name.startswith(WRITE) and done and (self._kept(judge) != list(self.values) or not mine):
            judge.tell(self.index, "parameter", f"{self.name} is done, and nothing was written")
        stood = self.stood and bench.shows("StopConfirmed", self.index) and bench.types[self.index] != "MX2"
        may = self.name.startswith(READ) or (self.name.startswith(WRITE) and stood)
        full = crowded(bench) or (len(bench.models) > 1 and bench.was_slow_port)
        asks = error and self.permitted and may and not full and bench.block[f"{self.name}.ErrorID"] != NOT_SENT
        calm = bench.now - self.since_us + (EVERY_US if self.heard else CALM_US)
        lost = bench.block[f"{self.name}.ErrorID"] == OFFLINE and not bench.shows("CommOk", self.index)
        if asks and judge.known(self.index, calm) and not mine and not lost:
            judge.tell(
                self.index, "parameter", f"{self.name} has sent nothing: {bench.block[f'{self.name}.ErrorID']!r}"
            )
        unsent = error and bench.block[f"{self.name}.ErrorID"] == NOT_SENT and self.permitted
        if unsent and stood and not full and judge.known(self.index, calm):
            judge.tell(self.index, "parameter", f"{self.name} was taken back, and nothing has stopped the drive")
        self._ended(judge, bench.block[f"{self.name}.ErrorID"], known=judge.known(self.index, calm) and not full)
        mine = [each for each in mine if each.word == self.value]  # others may write there, too
        if error and bench.block[f"{self.name}.ErrorID"] == NOT_SENT and mine and not self.name.startswith(READ):
            judge.tell(self.index, "parameter", f"{self.name} was sent, and says that it was not")
        return True


class Judge:
    """Looks after every scan; `found` are broken rules: time in us, unit, rule, what was seen."""

    def __init__(self, bench: "Second", stores: dict[int, Callable[[bytes], bool]], figures: Figures) -> None:
        """Watch a bench from its power-up."""
        self.bench, self.figures = bench, figures
        self.observer = Observer(stores, figures, ascii_=bench.ascii)
        self.stores = stores
        self.found = self.observer.found
        self.units = [Unit(SAYS_RUNNING[each]) for each in bench.types]
        self.kept: set[int] = set()
        """Drives that nobody asks to stop and that nothing happens to: they run."""
        self.contact = False
        self.open_now = False
        """Whether the contact is open in this scan, or the line is not called, which can do nothing then."""
        self.next_us = 0
        self.late: deque[int] = deque([0] * 100, maxlen=100)
        """How long the last scans were, in us: nobody knows when in them a reply came."""
        self.slow_us = -CUT_US - SLOW_US
        """When a scan last took longer than the program has promised."""
        self.lineless_us = -QUIET_US
        """When the line was last not called."""
        self.many_us = 0
        """When three or fewer were last dead: of more, each has four attempts before it rests with the dead."""
        self.asked: list[Asked] = []
        self.claims = Claims(self)
        self.counts = Counts(self)
        self.wire = Wire(self)
        self.shown = [Shown(self, index) for index in range(len(self.units))]
        self.orders = [Orders(self, index) for index in range(len(self.units))]

    def sent(self, now_us: int, frame: bytes) -> None:
        """A frame of the master."""
        self.observer.sent(now_us, frame)
        body = self.observer.opened(frame)
        if body is not None and 0 < body[0] <= len(self.units):
            self.claims.sent(now_us, body[0] - 1, body)
        pins = self.bench.pins[0]
        strange = body is not None and body[0] == pins.get("Address") != 1 and not pins.get("SupplyOff")
        if strange and self.claims.claims[0].bound and now_us - self.claims.claims[0].changed_us > ATTEND_US:
            self.tell(0, "bound", f"its slot asks another unit, and it may move: {self.bench.told(0)}")
        if body is None or not 0 < body[0] <= len(self.units) or not self.observer.stores[body[0]](body):
            return
        unit = self.units[body[0] - 1]
        place = body[0] - 1, int.from_bytes(body[2:4], "big")
        asked = any(each.name.startswith(WRITE) and (each.index, each.address) == place for each in self.asked)
        if body[1] == 16 and now_us - unit.stored_us < STORE_US and not asked:
            self.tell(body[0] - 1, "stores", f"{(now_us - unit.stored_us) // 1000} ms after the last one")
        unit.stored_us = now_us

    def answered(self, exchange: Exchange) -> None:
        """A request was on the wire, and what was answered."""
        self.counts.answered(exchange)
        self.wire.answered(exchange)

    def tell(self, index: int, rule: str, seen: str) -> None:
        """A broken rule."""
        self.found.append((self.bench.now, index + 1, rule, seen))

    def once(self, index: int, rule: str, *, bad: bool, seen: Seen = ()) -> None:
        """A rule that may be broken at present: told when it breaks, not while it stays so."""
        broken = self.units[index].broken
        if not bad:
            broken.discard(rule)
        elif rule not in broken:
            broken.add(rule)
            self.tell(index, rule, " ".join(map(str, (*seen, self.bench.told(index)))))

    # ------------------------------------------------------------ every scan

    def scan(self) -> None:
        """The models and pins after a scan."""
        bench, now = self.bench, self.bench.now
        looks, contact = now >= self.next_us, bench.contact
        self.late.append(1000 * bench.elapsed)
        if self.late[-1] > MAX_SCAN_US:
            self.slow_us = bench.now
        self.lineless_us = now if bench.lineless else self.lineless_us
        self.many_us = self.many_us if len(bench.deaf) > 3 else now
        opened = self.contact and not contact
        self.open_now = not contact or bench.lineless
        for index in range(len(self.units)):
            self._drive(index, looks=looks)
        self.counts.scan()
        self.wire.scan()
        for index in range(len(self.units)):
            self.shown[index].scan()
            self.orders[index].scan()
        if looks:
            self.next_us = now + EVERY_US
            self.counts.look()
            self.wire.look()
            for each in self.shown:
                each.look()
        if opened and not any(self._excused(index) for index in range(len(self.units))):
            self.tell(-1, "contact", f"opens for nothing; {bench.told()}")
        if contact and not self.contact and not bench.hand:
            self.tell(-1, "hand", "the contact closes by itself")
        self.contact = contact
        if self.asked:
            self.asked = [each for each in self.asked if not each.over(self)]

    def _drive(self, index: int, *, looks: bool) -> None:
        bench, now, one = self.bench, self.bench.now, self.bench.models[index]
        if now >= one.due:
            one.advance(now)
        unit, pins, hz = self.units[index], bench.pins[index], one.motor.hz(now)
        # silence is no alarm yet; a line that is not called can do nothing, which the drive block shows
        unit.lied_us = now if one.o.ignores else unit.lied_us
        off = bool(pins.get("SupplyOff")) and not bench.hears(index)
        unit.dark_us = now if off else unit.dark_us
        off = off or bool(pins.get("SupplyOff") and now - unit.dark_us < PROBED_US)
        anew = pins.get("Restart") or (unit.restarted_us and now - unit.restarted_us < RESTARTED_US)
        unit.forgotten = bool(pins.get("SpeedOnly") and (unit.forgotten or (one.o.ignores and anew)))
        lied = pins.get("MonitorOnly") and unit.lied_us > 0  # it has acknowledged the stop before that
        off = off or bool(lied) or unit.forgotten
        open_now = self.open_now or off or self._boots(index)
        truth = Truth(hz, one.by, bool(one.stopping), open_now, one.turned, one.itself, unit.running[False])
        shows = bench.shows("StopConfirmed", index) and not pins.get("Left")
        self.observer.scan(now, index + 1, pins, confirmed=shows, truth=truth)
        self._reach(index, unit)
        driven = one.by == "bus" and not one.stopping
        stands = abs(hz) <= self.figures.still_hz and not driven  # at 0 Hz by the bus it still has not stopped
        if stands or (driven and self.observer.watches[index + 1].permitted):
            unit.turned_us = now
        watches_only = pins.get("SpeedOnly") or pins.get("MonitorOnly")  # keypad and terminals may move it
        foreign = one.by in ("keypad", "terminals")
        if now - unit.turned_us > (0 if foreign else self.figures.stop_us // 2) and not watches_only:
            unit.unasked_us = now
        self._cut(index, unit, hz)
        if pins.get("SpeedOnly"):
            self._stop_pin(index, unit, hz)
        if bench.deafened(index):
            self.kept = self.kept - {index}
        if self.kept:
            self.once(index, "kept", bad=index in self.kept and not driven)
        unit.running[unit.says_running(one, now)] = now
        unit.fault[one.fault is not None] = now
        if bench.types[index] in SPEED:
            unit.zero[says_zero(bench.types[index], one, now)] = now
        unit.shaft.append((now, one.shown_hz(now)))
        if looks:
            self._outputs(index, unit)
        self.claims.scan(index, hz, driven=driven, looks=looks)

    def _reach(self, index: int, unit: Unit) -> None:
        bench, now, pins = self.bench, self.bench.now, self.bench.pins[index]
        hears = bench.hears(index)
        if hears:
            unit.heard_us = now
        unit.reachable = hears and bench.models[index].unit == pins["Address"]
        reached = unit.reachable and not any_of(ASTRAY, pins)
        lossy = bench.deafened(index) or bench.strangely or bench.lineless
        away = not reached or bool(lossy)  # a stop and its retries may be lost, and the connection with them
        if away:
            unit.away_us = now
        unit.off = bool(pins.get("SupplyOff")) and not hears and (unit.off or not pins.get("Left"))
        if away and (any_of(TAKEN, pins) or not unit.off):  # that excuses silence alone
            unit.excused_us = now
        if away or pins.get("Restart"):
            unit.unknown_us = now
        forbidden = bench.models[index].o.forbidden
        busy = bench.models[index].o.busy_refuses == "all" and now < bench.models[index].busy_us
        if busy or (forbidden and STATUS[bench.types[index]] in forbidden):
            unit.refuses_us = now
        else:
            unit.reads_us = now

    def _stop_pin(self, index: int, unit: Unit, hz: float) -> None:
        """Terminals start and stop it, but a stop pin still sends its stop, and takes the reference back."""
        bench, pins = self.bench, self.bench.pins[index]
        asked = not pins.get("Enable") or pins.get("QuickStop") or pins.get("CoastStop")
        heard = bench.reachable(index) and not pins.get("Left") and bench.models[index].by == "terminals"
        heard = heard and bench.now - unit.unknown_us > RESTARTED_US and bench.now >= bench.models[index].busy_us
        unit.pin_hz = unit.pin_hz if unit.pin_us else max(RUN_HZ, abs(hz))
        unit.pin_us = (unit.pin_us or bench.now) if asked and heard else None
        most = (PIN_US + int(RAMP_US * unit.pin_hz)) * (2 if len(bench.models) > 3 else 1)
        most += ATTEMPTS_US if bench.models[index].o.not_in_command == "refuses" else 0
        most += JOG_US if bench.types[index] in JOG_ENDS else 0
        late = unit.pin_us is not None and bench.now - unit.pin_us > most
        o = bench.models[index].o
        obeys = o.bus_stop_ends_others and o.not_in_command == "acknowledges"  # then the terminals' run is over, too
        follows = abs(hz) > self.figures.still_hz and (
            index or bench.mode != "MonitorOnly"
        )  # else its speed is its own
        self.once(index, "stop pin", bad=bool(late and (obeys or follows)))

    def _cut(self, index: int, unit: Unit, hz: float) -> None:
        """A drive that turns by the bus and does not hear, and a shared slot, open the contact soon."""
        bench, one = self.bench, self.bench.models[index]
        if bench.pins[index].get("Restart"):
            unit.restarted_us, unit.answered_us = bench.now, 0
        elif unit.reachable:
            unit.answered_us += 1000 * bench.elapsed
        silent = index + 1 in bench.deaf or one.cut
        shared, was = bool(bench.pins[index].get("Shared")), unit.shared
        unit.shared, silent = shared, (silent and not self._boots(index)) or shared
        owed = silent and one.by == "bus" and hz != 0 and bench.contact and not bench.pins[index].get("Left")
        if bench.pins[index].get("SupplyOff"):  # its user says that it is off; if it was silent, it boots afterwards
            unit.back_us = bench.now + (BOOT_US if silent else BACK_US)
        owed = owed and not bench.lineless and bench.now > unit.back_us
        owed = owed and bench.out("State", index) != READING  # after a restart whose stop the drive has ignored
        if not owed:
            unit.silent_since = None
            unit.broken.discard("cut")
            return
        unit.silent_since = bench.now if shared > was else unit.silent_since or bench.now
        slow, many = bench.now - self.slow_us < CUT_US + SLOW_US, len(bench.models)
        most = CUT_US + (SLOW_US if slow else 0) + MORE_US * (many > 1) * (1 + (many > 3) + (bench.ms > 20))
        if bench.turn_round(index) >= UNLEARNED_MS:
            beside = self.figures.stop_us + CUT_US if many > 1 else 0  # an attempt costs 0.5 s, then come others
            most = max(most, 1000 * bench.promised_cut, beside)
        deaf = [1000 * bench.turn_round(each - 1) for each in bench.deaf]
        if len(deaf) > 1 and max(deaf) > 1000 * UNHURRIED_MS:
            most += STOP_TRIES * 2 * sum(deaf)  # all attempts of all of them, each with the silence after it
        most += LATE_US if any(each.o.late_per_1000 for each in bench.models) else 0
        if crowded(bench):  # each of the others has its attempts, too
            most = max(most, 1600 * bench.promised_cut)
        if shared:
            most = SHARED_SCANS * max(self.late)
        elif len(self.units) == 1 and not slow:
            most = min(most, 1000 * bench.promised_cut + 3 * max(self.late))
        self.once(index, "cut", bad=bench.now - unit.silent_since > most)

    def known(self, index: int, since_us: int) -> bool:
        """It could be reached for so long, nothing was lost, and nothing has begun anew."""
        return self.claims.well(index, since_us) and self.bench.now - self.units[index].unknown_us > since_us

    def late_us(self, index: int) -> int:
        """How much later one that was away may be found: probes come every 8 s, and it may answer two of them late."""
        unit = self.units[index]
        return 2 * PAUSE_US if self.bench.models[index].o.late_per_1000 and unit.unknown_us == unit.away_us else 0

    def _boots(self, index: int) -> bool:
        """It has not answered since the restart, which nobody can expect yet."""
        unit = self.units[index]
        return unit.answered_us < ANSWER_US and self.bench.now - unit.restarted_us < BOOT_US

    def _excused(self, index: int) -> bool:
        """Whether the contact may open for this drive."""
        now, unit = self.bench.now, self.units[index]
        away = unit.excused_us > 0 and now - unit.excused_us < self.figures.stop_us + 2_000_000
        refuses = unit.refuses_us > 0 and now - unit.refuses_us < self.figures.stop_us  # so nothing can be proved
        one = self.bench.models[index]  # which refuses the stop of a restart or of another mode
        elsewhere = one.local or one.run_source != "bus"
        asked_us = max(unit.unknown_us, self.claims.claims[index].changed_us)
        obstinate = elsewhere and (one.local or one.o.not_in_command == "refuses")
        obstinate = obstinate and now - asked_us < self.figures.stop_us
        lies = now - unit.lied_us < self.figures.stop_us + 2_000_000
        slow = now - self.slow_us < CUT_US + SLOW_US  # a line that scans late promises no time
        # with another master standstill has to be read twice, which a pin that asks for stops all the time prevents
        unread = bool(self.bench.flicker) and self.bench.block["TheLine.ErrorID"] == FOREIGN
        # a read that a busy drive refuses is asked again in its turn: with eight drives in slow scans 6 s later
        busy = crowded(self.bench) and now - one.busy_us < self.figures.stop_us
        busy = busy or now - one.strict_us < self.figures.stop_us  # it has refused its stops
        if self.bench.restarts_contact or refuses or obstinate or lies or slow or unread or busy:
            return True
        return away or (unit.unasked_us > 0 and now - unit.unasked_us < GRACE_US * (2 if len(self.units) > 3 else 1))

    # ------------------------------------------------------------ what outputs say

    def _outputs(self, index: int, unit: Unit) -> None:
        bench, now = self.bench, self.bench.now
        if any_of(ASTRAY, bench.pins[index]):
            return
        # the dead have their turn on the wire, too
        calm = now - unit.unknown_us > CALM_US * (2 if bench.deaf else 1) + self.late_us(index)
        good = bench.shows("CommOk", index)
        since = max(unit.reads_us, unit.unknown_us, self.claims.claims[index].changed_us)
        most = 1000 * int(bench.number("StaleMs", index)) + REFUSED_US + CODE_MOST * round_us(bench)
        refused = now - since > most and not bench.pins[index].get("SupplyOff")
        # a drive that has to prove what it is, and refuses, is taken for another one
        told = bench.reason(index) in {"READ_REFUSED", "OTHER_DRIVE"} or good
        self.once(index, "refused", bad=refused and not told, seen=(bench.reason(index),))
        refuses = unit.refuses_us > 0 and now - unit.refuses_us < CALM_US
        # in slow scans, stops that it refuses leave too few turns to read it
        refused_us = self.claims.claims[index].unwilling_us
        full = crowded(bench) or now - self.slow_us < CALM_US
        starved = (full and now - refused_us < CALM_US // 2) or 0 < now - self.many_us < 2 * CALM_US
        self.once(index, "comm", bad=calm and not good and not refuses and not starved)
        reason = bench.out("Reason", index)
        held = any_of(MOVES, bench.pins[index])  # so the reason is that of a lost edge
        silent = calm and reason in SILENT and not held
        self.once(index, "reason", bad=silent, seen=("Reason", reason, "and it answers"))
        if not good or now - self.lineless_us < CALM_US // 2:  # its clock is that of the line
            return
        self.once(index, "stale", bad=now - unit.heard_us > self.figures.seen_us + 1_000_000)
        if self.claims.mistaken(index, now):
            return
        lag = LAG_US + max(self.late)
        since = now - int(1000 * bench.number("StatusAgeMs", index)) - lag
        for rule, name, seen in (("shows Running", "Running", unit.running), ("shows Fault", "Fault", unit.fault)):
            shown = bench.shows(name, index)
            late = seen[shown] < since
            self.once(index, rule, bad=late and since > 0, seen=(rule, shown))
        if bench.types[index] in SPEED:
            shown = bench.shows("ZeroSpeed", index)
            self.once(index, "shows ZeroSpeed", bad=unit.zero[shown] < since and since > 0, seen=("ZeroSpeed", shown))
        if bench.out("OutputFrequencyValid", index):
            self._frequency(index, unit, now - int(1000 * bench.number("MeasuresAgeMs", index)) - lag)

    def _frequency(self, index: int, unit: Unit, since: int) -> None:
        hz = self.bench.number("OutputFrequencyHz", index)
        window = [each for _, each in takewhile(lambda each: each[0] >= since, reversed(unit.shaft))]
        if window and unit.shaft[0][0] < since:
            far = not min(window) - 0.3 <= hz <= max(window) + 0.3
            self.once(index, "shows Hz", bad=far, seen=(hz, "Hz, was", min(window), "to", max(window)))
