"""What pins and line claim, against what truly is: a start shown as possible starts, a stop is sent in its time.

Part of the judge: it looks at pins of blocks, true models and frames, in quiet times and at edges.
"""

from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from tests.second.figures import (
    AGE_MS,
    ASTRAY,
    ATTEND_US,
    AWAY,
    CALM_US,
    CHAR_US,
    CODE_MOST,
    EVERY_US,
    FOREIGN,
    JOG_ENDS,
    JOG_US,
    MAX_SCAN_US,
    QUARTER,
    SEEN_US,
    TAKEN,
    UNHURRIED_MS,
    UNLEARNED_MS,
    path_us,
    ramp_us,
    round_us,
)
from tests.second.frames import runs
from tests.second.observer import MOVES, RUN, STOPPING, Pins, Seen, any_of, both, wish
from tests.second.pf4 import VARIANTS
from tests.second.profiles import FAMILIES as PROFILES
from tests.second.trips import ABLE, Trips

if TYPE_CHECKING:
    from tests.second.judge import Judge

ONE_WORD = ("PF4", *VARIANTS, *PROFILES)
"""Families with a read as long as that of the status: a copy of a reply passes for the next, as docs/line.md says."""
READS_FEED = ("MX2",)
"""Drives whose watchdog any good frame feeds, so that no reference is sent for it alone (SJ700, page 4-129)."""
FEEDS_AT_REST = {"PF525": bytes.fromhex("06 2001 0000"), "V20": bytes.fromhex("06 0064 0000")}
"""Drives whose watchdog counts at standstill, too, and what feeds it there: a reference of 0 (520-UM001O, C125)."""
QUIET_US = 2_000_000
"""A drive that has been stopped for so long is written to no more."""
START_US = 3_000_000
"""From the edge to the first turn: reference, run, and attempts."""
AT_ONCE_US, AT_ONCE_ROUNDS = 700_000, 3
"""The same where no reply is late: and some rounds of the line, for other drives' turns and the answers; what feeds a
watchdog has every second turn of those that are no reads."""
SPEED_US = 6_000_000
"""From an edge or another reference to that speed: 25 Hz at 10 Hz/s, in scans of 50 ms with 8 drives."""
BARS = ("STOPPING", "FOREIGN", "UNREAD", "SETTING", "REFERENCE", "NOT_READY", "WRITE_WAITS", "STARTING", "RUNS")
"""Reasons with which nothing can be started."""
UNANSWERED = ("NO_REFERENCE", "NO_RUN", "REFUSED")
FOLLOW_US = 7_500_000
"""FollowWithinMs is 5 s, from the answer to run."""
LATE_US = 600_000
"""A stop that meets a late reply is sent again."""
RESTART_US = 2_500_000
"""Stops of a restart wait out what may still be answered."""
COUNTS_US = 10_000_000
"""How long a frame of another master counts, by the pin ForeignFrames."""
FOREIGN_US = 45_000_000
"""Doubled replies may pass for frames of others; it takes half a minute until they are forgotten."""
PROBE_US = 12_000_000
NEVER_MS = 65535
"""The age of words that were not read."""
USUAL_MS, OFF = 1000, 65535
"""RefreshMs that is not set, and switched off."""
REFRESH_US = 1_500_000
"""How much later a refresh may be sent."""
CHANGED_US = 100_000
"""For so long a change of pins is young: the scans in which its stop waits for the wire."""
RESETS_US = 3_000_000
"""From the end of a fault until a reset has seen it: its status and its code are read again, and standstill."""
SPEEDING = 6
"""State: the block gives the reference alone."""
SHARED_US = 4_000_000
"""Within this time the line has stopped a drive whose slot two blocks use."""
STANDS_US, STANDS_ROUNDS = 600_000, 4
"""From standstill, or a pin that stops, to StopConfirmed: some rounds in which all that proves it is read."""
SILENT_US = 6_000_000
"""A drive that does not answer is stopped again within this time: each second, in turn with others and its identity."""
UNLINKED_CALLS = 100
"""Calls of a drive block without one of the line, after which it says that there is none."""
BUSY_MOST_US = 900_000
"""Ten attempts at a busy drive end a start."""
BUSY_US = 200_000
"""A busy drive gets a write again 100 ms later at the earliest, or once at once: four take longer than this."""
RARELY_US, HASTY = 2_100_000, 4
"""A dead drive gets a stop every second once its first attempts are over: four take longer than this. Attempts begin
anew when what excused its silence ends, as the trip of a drive does, so that a few may come sooner."""
SAME_US = 400_000
"""An acknowledged stop is sent again 500 ms after its acknowledgement."""
ASKS = 3
"""A stop, a probe and a read of a dead drive each wait for its reply."""
RUNS = 4
"""Orders to run that an edge is worth: one, and three more while nobody knows whether it was heard."""
LATE_ECHOES = 4
"""A late reply that meets the echo of the next request may pass for a frame of others; the line bears five."""
USUAL_SCAN_MS = 20
TAKEN_BACK = 100
"""Requests that a slow port can find in the mailbox no longer, in a whole walk."""
LINE_ERRORS = (0, 61)
"""None, and a stop that is overdue."""


@dataclass(slots=True)
class Claim:
    """What is remembered of one drive."""

    changed_us: int = 0
    """When its pins last changed."""
    pins: Pins = field(default_factory=lambda: Pins({}))
    permitted: bool = False
    """It was permitted to run in the last scan."""
    ready: bool = False
    """Ready of the last scan."""
    edge_us: int | None = None
    """When a start was asked for that the block has shown as possible."""
    crowd_us: int = 0
    """When stops of many others, each sent again every second, last had the line before a start."""
    replaced: bool = False
    """Another block has had its slot since nobody calls its own, which has said that there is no supply."""
    off_us: int = 0
    """When SupplyOff was last TRUE while it was to be stopped."""
    stop_us: int | None = None
    armed_us: int | None = None
    """When a pin has asked for a stop that is not sent yet."""
    still_us: int | None = None
    """Since when the block shows that it stands, ready for a start."""
    sent_us: int = 0
    """When a frame was last sent to it."""
    driven_us: int | None = None
    far_us: int = 0
    """When it was last not at the speed that it is asked for."""
    runs: int = 0
    """Orders to run since the last edge, or since it last turned."""
    written_us: int = 0
    writes: deque[int] = field(default_factory=lambda: deque([0] * 6, maxlen=6))
    """When it was last written to."""
    orders: deque[tuple[int, bytes]] = field(default_factory=lambda: deque([(0, b"")] * 4, maxlen=4))
    """The last writes."""
    heard_us: int = 0
    """When it could last hear."""
    idle_us: int | None = None
    """Since when it stands, and nobody runs it."""
    unwilling_us: int = 0
    """When it last did not obey the bus."""
    output: bool = False
    begun_us: int = 0
    """Whether its motor is driven, and since when, by whoever: it gets its reference then."""
    unlinked: int = 0
    """Calls of its block without one of the line."""
    early: int = 0
    """Looks in a row with the reason that it is ready, and it is not."""
    odd: int = 0
    """Looks in a row with a wrong reason."""
    hasty: int = 0
    """Stops in a row that came too soon after those before."""
    ran: bool = False
    """The bus has run it since it was last shown at standstill, or all began anew."""
    bound: bool = False
    """It has been started, has another address since, and is not shown at standstill: it still is its block's."""
    handed_over: bool = False
    """Its terminals were to run it from now on, and nothing has begun anew since."""


class Claims:
    """Looks after every scan, for the judge."""

    def __init__(self, judge: "Judge") -> None:
        """Watch what the judge watches."""
        self.judge, self.bench = judge, judge.bench
        self.claims = [Claim() for _ in judge.units]
        self.trips = [Trips(judge, index) for index in range(len(judge.units))]
        self.doubled_us = -FOREIGN_US
        self.retries: object = 0
        self.all_us = 0
        """When the line last stopped all drives, or one did not obey: stops count as sent again."""
        self.open_us = 0
        """When a drive was last neither run nor shown at standstill: its stop is repeated."""

    def sent(self, now_us: int, index: int, body: bytes) -> None:
        """A frame to a drive, without checksum.

        One that has been standing for long is written to no more, but in the scan of a restart it gets its stop: right
        after another restart its pins are those of the scan before.
        """
        claim, pins = self.claims[index], self.bench.pins[index]
        writes = body[1] in (5, 6, 16)
        self._kept(index, body)
        taken = self._taken(index) and now_us - claim.changed_us > ATTEND_US and pins == claim.pins
        others = self.bench.metered or any(each.get("Doubled") for each in self.bench.pins[1:2])
        mixed = pins.get("Doubled") and others  # of several families the first is read on
        if taken and not mixed and not writes and index + 1 not in self.bench.deaf:
            self._once(index, "barred", bad=True, seen=(body.hex(),))
        if writes:
            self._again(now_us, index, claim, body)
            self._jog(index, claim, body)
            claim.runs += runs(self.bench.types[index], body)
            self._once(index, "runs again", bad=claim.runs > RUNS, seen=(body.hex(),))
            self._first(now_us, index, claim, len(body))
            self._refreshed(now_us, index, claim)
            claim.written_us = now_us
        claim.sent_us = now_us
        most = QUIET_US * (3 if len(self.claims) > 3 else 1)  # a reference of the ramp may have waited for its turn
        idle = claim.still_us is not None and now_us - max(claim.still_us, claim.changed_us) > most
        asks = any(each.index == index for each in self.judge.asked)
        same = pins == claim.pins
        if (
            writes
            and idle
            and same
            and not asks
            and self.willing(index)
            and now_us - claim.unwilling_us > QUIET_US  # a trip that is over may be seen now
            and self.well(index, QUIET_US)
            and not any_of((*MOVES, "Restart"), pins)
            and not self.mistaken(index, now_us)
            and body[1:6] != FEEDS_AT_REST.get(self.bench.types[index])
        ):
            self.judge.tell(index, "quiet", f"a write to {self.bench.told(index)}")

    def mistaken(self, index: int, now: int) -> bool:
        """Whether it may have taken a copy of a reply for the next one."""
        copied_us = max(self.doubled_us, self.bench.panel_us)  # or what a panel has asked for
        return self.bench.types[index] in ONE_WORD and now - copied_us < CALM_US

    def scan(self, index: int, hz: float, *, driven: bool, looks: bool) -> None:
        """After a scan; the true speed of the shaft."""
        bench, claim, now = self.bench, self.claims[index], self.bench.now
        if bench.faults.twice:
            self.doubled_us = now
        output = bench.models[index].output and not bench.models[index].stopping
        if output and not claim.output:
            claim.begun_us = now
        claim.output = output
        before, pins = claim.pins, bench.pins[index]
        if pins.get("StopAll"):
            self.all_us = now
        self._bound(index, claim, driven=driven)
        if pins != before:
            claim.pins, claim.changed_us = Pins(pins), now
            began = not before.get("SpeedOnly") or claim.handed_over
            claim.handed_over = bool(pins.get("SpeedOnly")) and began and not pins.get("Restart")
        self._stop_all(index, now - claim.changed_us)
        ready = bench.shows("Ready", index)
        settled = ready and bench.shows("StopConfirmed", index)
        claim.still_us = (claim.still_us or now) if settled and self.attended(index) else None
        if driven or not wish(pins).moves:
            claim.edge_us = None
        else:
            self._start(index, claim, before)
        if driven:
            self._stop(index, claim)
        else:
            claim.stop_us = claim.armed_us = None
        claim.ready, claim.permitted = ready, self.judge.observer.watches[index + 1].permitted
        claim.driven_us = (claim.driven_us or now) if driven else None
        self.trips[index].scan(driven=driven, attended=self.attended(index))
        if claim.runs and (driven or not any_of(MOVES, before)):
            claim.runs = 0
        turns = driven or claim.output or hz != 0
        claim.idle_us = None if turns else (claim.idle_us or now)
        claim.unwilling_us = claim.unwilling_us if self.willing(index) else now
        if not (bench.lineless and pins.get("Left")):
            claim.unlinked = claim.unlinked + 1 if bench.lineless else 0
        if looks:
            self._look(index, claim, driven=driven)

    def _bound(self, index: int, claim: Claim, *, driven: bool) -> None:
        """Whether a drive that may move has been given another address, which its block must not take yet."""
        before, pins, confirmed = claim.pins, self.bench.pins[index], self.bench.shows("StopConfirmed", index)
        moved = before.get("Address") == index + 1 != pins.get("Address")
        off = any_of((*ASTRAY, "SupplyOff", "Restart"), pins) or confirmed
        claim.bound = not off and pins.get("Address") != index + 1 and (claim.bound or (moved and claim.ran))
        claim.ran = (claim.ran or driven) and not confirmed and not pins.get("Restart")

    def lies(self, index: int) -> bool:
        """It acknowledges orders that it does not obey, or did so just now: nothing is claimed of what it does."""
        return self.bench.now - self.judge.units[index].lied_us < CALM_US

    def _first(self, now_us: int, index: int, claim: Claim, length: int) -> None:
        """The first bit of a stop, from the call with the changed pin: within WorstStopMs, or alone StopAloneMs."""
        if claim.armed_us is None:
            return
        took = now_us - CHAR_US * (2 * length + 5 if self.bench.ascii else length + 2) - claim.armed_us
        others = [i for i in range(len(self.claims)) if i != index]
        alone = all(self.claims[i].driven_us or self.bench.shows("StopConfirmed", i) for i in others)
        alone = alone and now_us - self.all_us > ATTEND_US and not self.bench.pins[index].get("StopAll")
        most = 1000 * int(self.bench.number("StopAloneMs" if alone else "WorstStopMs", index))
        claim.armed_us = None
        if took > most and max(*self.judge.late, 1000 * self.bench.elapsed) <= MAX_SCAN_US and not self.lies(index):
            self.judge.tell(index, "first stop", f"after {took // 1000} ms, promised in {most // 1000}")

    def _again(self, now_us: int, index: int, claim: Claim, body: bytes) -> None:
        """The same word is not sent again and again to a drive that answers, and that nothing has happened to."""
        claim.orders.append((now_us, body))
        one: Any = self.bench.models[index]
        same = all(each == body for _, each in claim.orders) and now_us - claim.orders[0][0] < SAME_US
        calm = now_us - claim.changed_us > QUIET_US and self.well(index, QUIET_US) and not self.bench.flicker
        answers = one.o.not_in_command == "acknowledges" and not one.o.late_per_1000
        answers = answers and now_us >= one.busy_us + SAME_US and not self.bench.damages
        hurries = (
            one.strict_us < now_us < one.busy_us
            and now_us - claim.orders[0][0] < BUSY_US
            and self.well(index, QUIET_US)
        )
        self._once(index, "floods", bad=same and (hurries or (calm and answers)), seen=(body.hex(),))
        heard, restarted = self.judge.units[index].heard_us, self.judge.units[index].restarted_us
        silent = now_us - max(heard, claim.changed_us, self.judge.lineless_us) > SILENT_US and heard > restarted
        often = silent and all(each == body for _, each in claim.orders) and now_us - claim.orders[0][0] < RARELY_US
        claim.hasty = claim.hasty + 1 if often and self.bench.turn_round(index) < UNLEARNED_MS else 0
        self._once(index, "hurries", bad=claim.hasty > HASTY, seen=(body.hex(),))

    def _taken(self, index: int) -> str:
        """The pin for which a drive whose block is called gets nothing but stops."""
        pins = self.bench.pins[index]
        here = "Doubled" if pins.get("Doubled") and pins.get("Address") == index + 1 else ""
        return "" if pins.get("Left") else "Shared" if pins.get("Shared") else here

    def _stop_all(self, index: int, since_us: int) -> None:
        """A stop of the block's own, for which its pins have changed just now, is none of all drives."""
        if since_us > CHANGED_US:
            return
        calm = self.attended(index) and self.well(index, ATTEND_US) and self.bench.now - self.all_us > ATTEND_US
        ran = self.trips[index].run_us > self.all_us  # else that is still what keeps it from running
        calm = calm and ran and not self.bench.pins[index].get("Restart") and not self.lies(index)
        self._once(index, "stop all", bad=calm and self.bench.reason(index) == "STOP_ALL")

    def _jog(self, index: int, claim: Claim, body: bytes) -> None:
        """The stop of the last order is sent first: after a jog its own, unless it is to coast or a restart came."""
        known = (claim.armed_us or 0) > self.judge.units[index].unknown_us
        armed = known and self.bench.models[index].jogging
        coasts = self.bench.pins[index].get("CoastStop")
        ends = JOG_ENDS.get(self.bench.types[index])
        if armed and ends and not coasts:
            self._once(index, "jog stop", bad=body[1:6] != ends, seen=(body.hex(),))

    def _kept(self, index: int, body: bytes) -> None:
        """Bits that no command uses are as KeepWord has them in every run word of SN300G5."""
        keep = self.bench.pins[index].get("KeepWord", 0)
        if self.bench.types[index] == "SN300G5" and body[1:4] == b"\x10\0\0" and body[8] & 0xFC != keep:
            self.judge.tell(index, "keep", body.hex())

    def _period(self, index: int) -> int:
        """How often the reference is to be sent again, in us; 0: never."""
        refresh = int(self.bench.number("RefreshMs", index)) or USUAL_MS
        watchdog = 0 if self.bench.types[index] in READS_FEED else int(self.bench.number("WatchdogMs", index))
        every = 0 if refresh == OFF else refresh
        return 1000 * (watchdog // 3 if watchdog and (not every or every > watchdog // 3) else every)

    def _steady(self, index: int, claim: Claim) -> bool:
        """It has been running for long, with the same pins."""
        now = self.bench.now
        most = START_US + ramp_us(self.bench, index)
        settled = claim.driven_us is not None and now - max(claim.driven_us, claim.changed_us) > most
        settled = settled and self.judge.observer.watches[index + 1].permitted
        return settled and self.attended(index) and self.willing(index) and self.well(index, START_US)

    def _supplies(self, index: int, claim: Claim) -> bool:
        """It gives its reference to a drive that terminals run, and nothing has happened for long."""
        pins, now = self.bench.pins[index], self.bench.now
        alone = pins.get("SpeedOnly") and not any_of((*ASTRAY, "MonitorOnly"), pins)
        since = CALM_US if len(self.claims) > 3 else CALM_US // 2  # a restart has stopped all drives before
        unit = self.judge.units[index]
        quiet = now - max(claim.changed_us, unit.unknown_us, unit.refuses_us) > since
        # the stop before SpeedOnly is repeated until it is obeyed, or others are proved to be in command
        quiet = quiet and not (self.bench.models[index].local or self.bench.strangely)
        quiet = quiet and not self.bench.shows("StopOverdue", index)
        return bool(alone and quiet and self.bench.shows("CommOk", index) and self.bench.reason(index) == "SPEED_ONLY")

    def _refreshed(self, now_us: int, index: int, claim: Claim) -> None:
        period = self._period(index)
        claim.writes.append(now_us)
        one = self.bench.models[index]
        late = one.o.late_per_1000 or now_us < max(one.busy_us, self.judge.counts.unclean_us) + START_US
        asks = any(each.index == index for each in self.judge.asked) or index + 1 in self.judge.observer.may_store
        if self.bench.pins[index] != claim.pins:  # a stop pin that has just risen
            return
        if late or asks or not (self._steady(index, claim) or self._supplies(index, claim)):
            claim.writes.extend([0] * 6)  # these may be stops
            return
        first = claim.writes[0] if period else claim.writes[-2]
        since = max(claim.changed_us, self.judge.units[index].unknown_us, claim.driven_us or 0, claim.begun_us)
        known = first > since + START_US + ramp_us(self.bench, index)
        if known and now_us - first < (3 * period if period else SPEED_US):
            self.judge.tell(index, "refresh", f"writes at {[each // 1000 for each in claim.writes]} ms")

    # ------------------------------------------------------------ who can be judged

    def attended(self, index: int) -> bool:
        """One block serves the drive, in full control."""
        pins = self.bench.pins[index]
        return not any_of(AWAY, pins)

    def well(self, index: int, since_us: int) -> bool:
        """It could be reached for so long, and nothing was lost."""
        unit = self.judge.units[index]
        return self.bench.now - unit.away_us > since_us and self.bench.now - unit.refuses_us > since_us

    def willing(self, index: int) -> bool:
        """The drive obeys the bus."""
        one: Any = self.bench.models[index]
        mine = one.run_source == "bus" and not one.local and not one.held and not one.inhibited
        return bool(mine and not one.by.strip("bus") and one.fault is None and not one.o.ignores)

    # ------------------------------------------------------------ edges

    def _start(self, index: int, claim: Claim, before: Pins) -> None:
        """What is asked to move, and does not yet."""
        bench, pins, now = self.bench, self.bench.pins[index], self.bench.now
        hz = pins["SpeedReferenceHz"]
        assert isinstance(hz, float)
        stops = not pins["Enable"] or any_of(STOPPING, pins) or hz < 0 or both(pins)
        other = any_of(MOVES, before) and [pins.get(each) for each in MOVES] != [before.get(each) for each in MOVES]
        if stops or other or not self.attended(index) or not self.well(index, QUIET_US):
            claim.edge_us = None  # another direction begins with a stop, and needs an edge of its own
        elif claim.ready and not any_of((*MOVES, "Restart"), before):
            claim.edge_us = now
        ramping = [i for i, each in enumerate(self.claims) if not (each.driven_us or bench.shows("StopConfirmed", i))]
        claim.crowd_us = now if len(ramping) > 3 else claim.crowd_us
        if claim.edge_us is not None:
            ignores = bench.models[index].o.ignores
            one, many = bench.models[index], len(bench.models) > 3
            others = one.local or one.by in ("keypad", "terminals")  # an MX2 does not show by whom it runs
            # attempts at a busy drive and those without a reply are counted as one: it gives up, and says so
            most = 0 if one.o.late_per_1000 else BUSY_MOST_US
            gave_up = one.busy_us > claim.edge_us + most and bench.reason(index) in UNANSWERED
            if others or gave_up or one.fault is not None or (not ignores and not self.willing(index)):
                claim.edge_us = None
            elif not ignores and now - max(claim.edge_us, claim.crowd_us, one.busy_us) > self._start_us(index) * (
                2 if one.o.late_per_1000 and many else 1
            ):
                self._once(index, "starts", bad=True)
            elif ignores and now - max(claim.edge_us, one.busy_us) > FOLLOW_US * (2 if many else 1):
                told = bench.reason(index) == "NOT_FOLLOWED" and bench.out("CommandNotFollowed", index)
                told = told or (bench.unsaid and bench.reason(index) == "NO_RUN") or bench.reason(index) == "BY_ITSELF"
                self._once(index, "follow", bad=not told)

    def _stop(self, index: int, claim: Claim) -> None:
        """The first stop to what is driven is sent within WorstStopMs, and obeyed.

        A restart in the midst of that begins it anew: what was answered so far, and whether the port echoes, is
        forgotten (rule 8 of the line: so is a scan that comes too late, in which nothing can be sent).
        """
        bench, pins, now = self.bench, self.bench.pins[index], self.bench.now
        asked = wish(pins).moves
        all_ = bool(pins.get("StopAll"))
        pin = not asked or not pins["Enable"] or pins.get("QuickStop") or pins.get("CoastStop")
        left = bool(pins.get("Left")) and not all_
        owed = left or all_ or bool(pin or pins.get("Restart") or pins.get("MonitorOnly"))
        late = LATE_US if bench.models[index].o.late_per_1000 else 0
        lossy = bench.faults.lost or bench.faults.unanswered or bench.strangely or any_of(TAKEN, pins)
        hears = bench.reachable(index) and not lossy and not bench.lineless and now >= bench.models[index].busy_us
        watched = pins.get("MonitorOnly") and self.judge.units[index].lied_us > 0  # it had acknowledged its stop before
        # then the slot has the other block's address, and this unit is not asked any more
        claim.replaced = bool(pins.get("Left") and pins.get("SupplyOff") and (claim.replaced or pins.get("Shared")))
        good = self.willing(index) and hears and not self.lies(index) and not watched and not claim.replaced
        if not good or pins.get("SpeedOnly"):
            claim.stop_us = claim.armed_us = None
        elif owed and (claim.stop_us is None or pins.get("Restart")):
            restarted = self.judge.units[index].unknown_us > now - CALM_US // 5 and not pins.get("Left")
            again = now - claim.unwilling_us < ATTEND_US  # it has ignored the last one, and gets the next
            claim.stop_us = now + RESTART_US * restarted + ATTEND_US * (left or again)
            plain = claim.permitted and not restarted and not left and self.attended(index)
            plain = plain and self.well(index, ATTEND_US) and bench.shows("CommOk", index)
            claim.armed_us = now if plain and claim.written_us < now else None
        if claim.stop_us is not None:
            most = 1000 * int(bench.number("WorstStopMs", index)) + 3 * max(self.judge.late) + late + 150_000
            if bench.models[index].jogging and now - self.judge.units[index].unknown_us < CALM_US:
                most += 2 * round_us(bench)  # a restart has forgotten that it jogs: the end of a jog is sent second
            if bench.models[index].jogging and now - bench.models[index].busy_us < CALM_US:
                most += 2 * (JOG_US + round_us(bench))  # both stops come in turn, once one is refused
            most += ATTEND_US if now - bench.models[index].strict_us < CALM_US else 0
            if pins.get("SupplyOff") and (left or not self.well(index, PROBE_US)):
                most += PROBE_US  # the line looks for it from time to time
            claim.off_us = now if pins.get("SupplyOff") else claim.off_us
            since = claim.stop_us if pins.get("SupplyOff") else max(claim.stop_us, claim.off_us)
            self._once(index, "prompt", bad=now - since > most)

    def _once(self, index: int, rule: str, *, bad: bool, seen: Seen = ()) -> None:
        self.judge.once(index, rule, bad=bad, seen=seen)

    # ------------------------------------------------------------ quiet times

    def _look(self, index: int, claim: Claim, *, driven: bool) -> None:
        bench, now = self.bench, self.bench.now
        self._probe(index, claim)
        self._silent(index, claim)
        alone = claim.unlinked > UNLINKED_CALLS + 2 and not bench.pins[index].get("Left")
        told = bench.shows("StopOverdue", index) and not bench.shows("CommOk", index)
        self._once(index, "no line", bad=alone and not told and not bench.pins[index].get("SupplyOff"))
        pins = bench.pins[index]
        # the one before it may hold for two seconds after its end
        taken = self._taken(index) if now - claim.changed_us > 2 * ATTEND_US else ""
        reasons, error = TAKEN.get(taken, ((), None))
        shown = bench.reason(index), bench.out("ErrorID", index)
        told = shown[0] in reasons and error in (None, shown[1])
        self._once(index, "shared", bad=bool(taken) and not told and not pins.get("SupplyOff"), seen=shown)
        runs_on = taken and driven and self.willing(index) and bench.reachable(index) and not self.lies(index)
        runs_on = runs_on and now - claim.changed_us > SHARED_US and not bench.lineless
        self._once(index, "shared stop", bad=bool(runs_on))
        if index == 0:
            self._line()
        heard = self.well(index, CALM_US // 5) and bench.shows("CommOk", index)
        if not heard:
            claim.odd = claim.early = 0
        ours = heard and claim.handed_over and bench.models[index].by == "bus" and self.willing(index)
        ours = ours and not bench.models[index].stopping  # it may ramp down
        self._once(index, "speed only", bad=ours and bench.out("State", index) == SPEEDING)  # it is to be stopped first
        if not self.attended(index) or bench.pins[index].get("Address") != index + 1:
            return
        if heard:
            self._speed(index, claim, driven=driven)
            self._reason(index, claim)
            self.trips[index].look(claim.changed_us)
            self._stands(index, claim)
        period, steady = self._period(index), self._steady(index, claim)
        missed = (
            period
            and steady
            and now - claim.written_us > period + REFRESH_US + 2 * round_us(bench)
            and len(bench.models) < 8
        )
        dead = [i for i, each in enumerate(self.judge.units) if now - each.away_us < CALM_US]
        missed = missed and now - self.judge.slow_us > CALM_US and not dead  # stops that are not answered come first
        missed = missed and now - self.judge.counts.asked_us > REFRESH_US  # parameters have their turn, too
        self._once(index, "refreshes", bad=bool(missed))
        fast = len(bench.models) < 8 and self.well(index, CALM_US) and max(self.judge.late) <= 50_000
        age = bench.number("StatusAgeMs", index)
        busy = bench.models[index].busy_us if bench.models[index].o.busy_refuses == "all" else 0  # its reads, too
        idle = now - max(self.judge.units[index].unknown_us, busy) > CALM_US
        most = AGE_MS * (3 + bench.metered) // 3
        refused = now - self.all_us < QUIET_US or now - bench.models[index].busy_us < CALM_US // 2
        most += ATTEND_US // 1000 if refused or dead else 0  # stops that are refused, or not answered, come first
        most += 2 * ATTEND_US // 1000 if bench.damages else 0  # what is read again, and in the next round
        most += 3 * UNLEARNED_MS if any(bench.turn_round(each) > UNHURRIED_MS for each in dead) else 0
        self._once(index, "age", bad=fast and idle and age > most, seen=(age, "ms"))
        restarted = self.judge.units[index].restarted_us
        known = (
            restarted > max(0, self.judge.lineless_us) and now - restarted > 3 * max(self.judge.late) and age < NEVER_MS
        )
        before = known and 1000 * age > now - restarted + SEEN_US // 3
        self._once(index, "remembers", bad=bool(before), seen=(age, "ms"))  # words of before a restart

    def _stands(self, index: int, claim: Claim) -> None:
        """A drive that has been standing for long, and that nobody starts, is shown so."""
        bench, now = self.bench, self.bench.now
        pins = bench.pins[index]
        begun = self.judge.units[index].unknown_us + RESTART_US
        since = max(claim.idle_us or now, claim.changed_us, claim.unwilling_us, begun)
        # the dead have their turn on the wire, too; in slow scans each exchange takes longer than was promised; a stop
        # of the line's own is sent before that of the block
        late = now - self.judge.slow_us < CALM_US or any(now - each.away_us < CALM_US for each in self.judge.units)
        both_stops = JOG_US * ((bench.types[index] in JOG_ENDS) + (now - self.all_us < CALM_US))
        calm = (
            now - since > (STANDS_US + both_stops + STANDS_ROUNDS * round_us(bench)) * (1 + 4 * late)
            and self.willing(index)
            and not bench.flicker
            and len(bench.models) < 8
        )
        held = any_of(MOVES, pins) and pins["Enable"]
        quiet = calm and not held and not pins.get("SupplyOff") and not bench.strangely and not pins.get("StopAll")
        self._once(index, "stands", bad=bool(quiet and not bench.shows("StopConfirmed", index)))

    def _silent(self, index: int, claim: Claim) -> None:
        """The stop of a drive that does not answer is sent again and again."""
        bench, now = self.bench, self.bench.now
        pins = bench.pins[index]
        elsewhere = pins.get("Address") != index + 1 or pins.get("SupplyOff") or bench.lineless
        elsewhere = elsewhere or bench.strangely  # what it is has to be proved before its stop
        if bench.hears(index) or not self.attended(index) or elsewhere:
            claim.heard_us = now
        deaf = [unit - 1 for unit in bench.deaf]
        slow = len(deaf) > 1 and any(bench.turn_round(each) > UNHURRIED_MS for each in deaf)  # each waits for the other
        silent = now - max(claim.heard_us, claim.written_us) > SILENT_US * (1 + slow) and len(bench.models) < 8
        self._once(index, "silent", bad=silent)

    def _speed(self, index: int, claim: Claim, *, driven: bool) -> None:
        """As fast as it is asked to be, once it had the time; and said to be."""
        bench, pins, now, one = self.bench, self.bench.pins[index], self.bench.now, self.bench.models[index]
        hz, limit = pins["SpeedReferenceHz"], pins["MaximumHz"]
        assert isinstance(hz, float)
        assert isinstance(limit, float)
        asked = min(hz, limit or hz, 50.0)
        began = max(claim.driven_us or now, claim.changed_us) + ramp_us(bench, index)
        steady = driven and claim.driven_us is not None and now - began > SPEED_US
        permitted = self.judge.observer.watches[index + 1].permitted and not one.turned
        runs = steady and any_of(RUN, pins) and permitted and not self.lies(index)
        far = abs(abs(one.motor.hz(now)) - asked) > 0.01 * asked + 0.2
        self._once(index, "reaches", bad=runs and far, seen=(one.motor.hz(now), "Hz of", asked))
        shown = bool(bench.out("OutputFrequencyValid", index)) or bench.types[index] == "SN300G5"
        claim.far_us = now if far else claim.far_us
        age = max(bench.number("StatusAgeMs", index), bench.number("MeasuresAgeMs", index))
        quiet = runs and shown and age < AGE_MS and now - claim.far_us > 1000 * age + SEEN_US
        self._once(
            index, "at speed", bad=quiet and not (bench.shows("AtSpeed", index) and bench.shows("Running", index))
        )
        well = ("RUNS", "SLOW_LINE", *["HEARTBEAT"] * bool(pins.get("WatchdogMs")))
        alone = not any_of(AWAY, pins) and not bench.shows("StopOverdue", index)
        reason = bench.reason(index)
        self._once(index, "says that it runs", bad=quiet and alone and reason not in well, seen=(reason,))
        wrong = (
            bench.shows("AtSpeed", index) and one.by == "bus" and self._was_far(index, asked) and not self.lies(index)
        )
        self._once(index, "at speed already", bad=wrong and now - claim.changed_us > SPEED_US)
        limited = bool(bench.out("ReferenceLimited", index))
        self._once(index, "limited", bad=limited != (hz > min(limit or hz, 50.0)) and now - claim.changed_us > QUIET_US)

    def _was_far(self, index: int, asked: float) -> bool:
        """Whether the drive has shown no such speed for some time."""
        since = self.bench.now - 1000 * int(self.bench.number("StatusAgeMs", index)) - 1_000_000
        for at, hz in reversed(self.judge.units[index].shaft):
            if at < since:
                return True
            if abs(hz - asked) <= 1.0:
                return False
        return True

    def _start_us(self, index: int) -> int:
        bench = self.bench
        late = any(one.o.late_per_1000 for one in bench.models) or max(self.judge.late) > MAX_SCAN_US
        at_once = AT_ONCE_US + AT_ONCE_ROUNDS * round_us(bench)
        return (START_US if late else at_once) + path_us(bench, index)

    def _reason(self, index: int, claim: Claim) -> None:
        """The reason that the pins give, once the block has had time to say it. A pin may be a scan ahead of it."""
        bench, pins, now = self.bench, self.bench.pins[index], self.bench.now
        early = bench.reason(index) == "READY" and not bench.shows("Ready", index)
        same = now - claim.changed_us > EVERY_US  # the last look was at these pins, too
        claim.early = 1 + claim.early * same if early else 0
        self._once(index, "says ready", bad=claim.early > 1 and not bench.flicker)
        if now - claim.changed_us < ATTEND_US or bench.block["TheLine.ErrorID"] not in LINE_ERRORS or bench.flicker:
            claim.odd = 0
            return
        reason, ready = bench.reason(index), bench.shows("Ready", index)
        if bench.shows("Fault", index):
            right = reason in ("FAULT", "NO_RESET") or bool(pins.get("SupplyOff"))
        elif reason == "RESETTING":
            refuses = not self.willing(index) and self.bench.models[index].o.not_in_command == "refuses"
            most = CALM_US if refuses else RESETS_US + CODE_MOST * round_us(bench)  # no stop of it is acknowledged
            right = now - self.judge.units[index].fault[True] < most
        else:
            first = next((name for name, is_so in self.told(index) if is_so), None)
            held = any_of(MOVES, pins)  # then nothing starts until it is released
            right = reason == first if first else reason != "READY" or (ready and not held)
        refused = claim.pins.get("FaultReset") and not ABLE[bench.types[index]][-1] and bench.shows("Fault", index)
        right = right and (not refused or bool(pins.get("SupplyOff")) or reason == "NO_RESET")
        claim.odd = 0 if right else claim.odd + 1
        self._once(index, "why", bad=claim.odd > 1, seen=(reason,))
        few = bench.unsaid and not index and reason == "NO_RUN" and 0 < claim.runs < RUNS
        self._once(index, "attempts", bad=few, seen=(claim.runs, "of", RUNS))
        running = bench.shows("Running", index)
        self._once(index, "runs", bad=reason == "RUNS" and not running, seen=(reason,))
        idle = bench.shows("StopConfirmed", index) or not ready
        self._once(index, "ready", bad=not idle, seen=("Ready without StopConfirmed",))
        barred = ready and reason in BARS and not any_of(MOVES, pins)  # else it says why the last edge was lost
        barred = barred and (
            reason != "FOREIGN" or bench.block["TheLine.ErrorID"] == FOREIGN
        )  # else why the last run ended
        self._once(index, "bars", bad=barred, seen=("Ready, and the reason is", reason))

    def told(self, index: int) -> list[tuple[str, bool]]:
        """Reasons that pins give, the first first."""
        pins = self.bench.pins[index]
        return [
            ("NO_SUPPLY", bool(pins.get("SupplyOff"))), ("STOP_ALL", bool(pins.get("StopAll"))),
            ("DISABLED", not pins["Enable"]), ("STOP_PIN", bool(pins.get("QuickStop") or pins.get("CoastStop"))),
            ("BOTH", both(pins)),
        ]  # fmt: skip

    def _probe(self, index: int, claim: Claim) -> None:
        """A drive that does not answer is asked again and again."""
        pins, unit, now = self.bench.pins[index], self.judge.units[index], self.bench.now
        units = enumerate(self.judge.units)
        turns = [self.bench.turn_round(i) for i, each in units if now - each.away_us < CALM_US]
        slow = sum(ASKS * QUARTER * 1000 * turn for turn in turns if turn > UNHURRIED_MS)  # all the dead have a quarter
        forgotten = now - claim.sent_us > PROBE_US * (1 + (len(turns) > 3)) + slow and now - unit.unknown_us > 0
        elsewhere = any_of((*ASTRAY, "SupplyOff"), pins) or pins.get("Address") != index + 1
        if elsewhere or self.bench.faults.lost:  # a probe that is lost is not seen here
            claim.sent_us = now
        self._once(index, "probe", bad=forgotten and claim.sent_us < now)

    def _strangers(self, shown: int) -> None:
        """Frames of another master count for ten seconds, and for less than one more."""
        bench, now = self.bench, self.bench.now
        plain = not (bench.faults.twice or bench.damages or any(one.o.late_per_1000 for one in bench.models))
        restarted = max(each.restarted_us for each in self.judge.units)  # what comes at once is waited out, not counted
        began = max(bench.acknowledged_us, restarted + ATTEND_US) + SEEN_US
        heard = [at for at in bench.strangers if at > now - COUNTS_US - ATTEND_US]
        least = len([at for at in heard if max(now - COUNTS_US + SEEN_US, began) < at < now - SEEN_US])
        calm = plain and bench.strangers and not bench.line_pins.get("Acknowledge") and not bench.lineless
        calm = calm and now - max(self.judge.slow_us, self.doubled_us, bench.panel_us) > COUNTS_US + ATTEND_US
        anew = max(*(each.unknown_us for each in self.judge.units), *(each.changed_us for each in self.claims))
        few = now - anew > CALM_US + ATTEND_US  # what was asked for before may be answered to nobody
        wrong = bool(calm) and (shown < least or (few and shown > len(heard)))
        self._once(0, "foreign frames", bad=wrong, seen=(shown, "shown,", least, "to", len(heard), "heard"))

    def _line(self) -> None:
        """What the line says of itself."""
        bench, block, now = self.bench, self.bench.block, self.bench.now
        units = range(len(self.judge.units))
        plain = all(self.attended(i) and bench.pins[i].get("Address") == i + 1 for i in units)
        good = plain and all(now - self.judge.units[i].unknown_us > CALM_US and self.well(i, CALM_US) for i in units)
        good = good and now - max(self.doubled_us + FOREIGN_US, bench.metered_us + CALM_US // 5) > 0
        shown = (block["TheLine.AllOnline"], block["TheLine.OnlineCount"])
        self._once(0, "all online", bad=good and shown != (True, len(units) + bench.metered), seen=shown)
        error = block["TheLine.ErrorID"]
        began = max(self.judge.units[i].unknown_us for i in units)
        old = error == FOREIGN and now - began < FOREIGN_US  # refusals of another make at an address are of nobody
        self._once(0, "line", bad=good and error not in LINE_ERRORS and not old, seen=("ErrorID", error))
        strange = block["TheLine.ForeignFrames"]
        assert isinstance(strange, int)
        slow = bench.ms > USUAL_SCAN_MS  # then a late reply is heard after the next request
        most = LATE_ECHOES * (1 + slow) if any(one.o.late_per_1000 for one in bench.models) else 0
        forgotten = good and now - began > CALM_US + 1_000_000  # echoes that a restart has cut in two
        self._once(0, "strange", bad=forgotten and strange > most, seen=(strange, "foreign frames"))
        self._strangers(strange)
        if not all(self.willing(i) for i in units):
            self.all_us = now
        retries, steady = block["TheLine.Retries"], good and now - self.all_us > ATTEND_US
        plain = steady and not any(one.o.late_per_1000 or now < one.busy_us + ATTEND_US for one in bench.models)
        proved = all(self.claims[i].driven_us or bench.shows("StopConfirmed", i) for i in units)
        self.open_us = self.open_us if proved else now
        plain = plain and now - self.open_us > ATTEND_US and not self.judge.asked
        plain = plain and now - self.judge.counts.unclean_us > ATTEND_US
        self._once(0, "retries", bad=plain and retries != self.retries, seen=(retries, "after", self.retries))
        self.retries = retries
        asked = block["TheLine.Requests"]
        assert isinstance(asked, int)
        taken_back = asked - len(bench.frames)
        wrong = not 0 <= taken_back <= (TAKEN_BACK if bench.was_slow_port else 0)
        self._once(0, "counts", bad=wrong, seen=(asked, "of", len(bench.frames), "requests"))
