"""Outputs of a drive block that must agree with each other, and with the drive."""

import re
from collections import deque
from typing import TYPE_CHECKING, Any

from tests.second.figures import ASTRAY, ATTEND_US, AWAY
from tests.second.line import REASON
from tests.second.observer import MOVES, any_of
from tests.second.station import MIXED

if TYPE_CHECKING:
    from tests.second.judge import Judge

FOLLOW = (
    ("Ready", "StopConfirmed"), ("Running", "CommOk"), ("AtSpeed", "Running"), ("ZeroSpeed", "CommOk"),
    ("StopConfirmed", "CommOk"), ("Fault", "CommOk"),
)  # fmt: skip
"""What the first says, the second has to say, too."""
NEVER = (("Ready", "Fault"), ("Ready", "Running"), ("StopConfirmed", "Running"))
"""What is not shown at the same time."""
JOG_KIND = 4
"""StopKind of the stop that ends a jog, which may come after any other."""
KINDS = {2: "CanQuickStop", 3: "CanCoastStop", 4: "CanJog"}
"""StopKind, and what the drive has to be able to; 1 is the stop that every drive has."""
UNIT = re.compile("(A|V|KW|Rpm|Percent)$")
"""The end of an output's name."""
UNSCALED = {
    "CHF": ("OutputVoltage", "OutputCurrent", "OutputPower"), "SN300G5": ("OutputCurrent", "OutputPower"),
}  # fmt: skip
"""Whose scale the program has not given."""
STOPPING, STARTS, RUNNING = 0, (2, 3), 4
"""States: a stop is sent, or standstill is not proved; a start is sent; it runs."""
YOUNG = 3
"""Scans."""
OWN_MAXIMUM = ("ATV312", "GD200A", "V20")
"""Families that show their maximum frequency."""
WAYLESS = ("ACS355",)
"""Families whose status has no bit of the direction."""
LAG_US = 300_000
"""What an age of words does not say: the reply's way, and the scan in which it is shown."""
LAST, FIRST = tuple(f"FaultBack{i}" for i in range(1, 9)), ("FirstFaultHz", "FirstFaultA", "FirstFaultV")


class Shown:
    """What one drive block shows, scan by scan."""

    def __init__(self, judge: "Judge", index: int) -> None:
        """Begin at power-up."""
        self.judge, self.bench, self.index = judge, judge.bench, index
        self.kind = self.bench.types[index]
        self.fault = False
        self.state: object = None
        self.faults: list[object] | None = None
        self.causes: deque[list[str]] = deque(maxlen=YOUNG)
        """What pins said against a run in the last scans: what the line tells is a scan old."""
        self.anew = False
        """The scan before was a restart."""
        self.replied: bool | None = None
        """Whether it has been shown to answer since the last restart; None: nobody knows."""
        self.rank = 0
        """Of the stops since the last standstill."""
        self.left_us = 0
        """When its block was last not called, which then does not know the time."""
        self.began_us = 0
        """When it was last started."""
        self.reverse, self.turned_us = False, 0
        """Whether it turns in reverse, and since when it turns as it does."""

    def _out(self, name: str) -> Any:
        return self.bench.block[f"Drive{self.index}.Diagnosis.{name}"]

    def _once(self, rule: str, *, bad: bool, seen: tuple[object, ...]) -> None:
        self.judge.once(self.index, rule, bad=bad, seen=seen)

    def scan(self) -> None:
        """In each scan: what agrees, and the first fault."""
        bench, index = self.bench, self.index
        if bench.pins[index].get("Left"):
            self.left_us, self.anew, self.replied = bench.now, False, None
            return
        self._restarted()
        for one, other in FOLLOW:
            self._once(f"{one} with {other}", bad=bench.shows(one, index) and not bench.shows(other, index), seen=())
        for one, other in NEVER:
            self._once(f"{one} or {other}", bad=bench.shows(one, index) and bench.shows(other, index), seen=())
        hz = bench.models[index].shaft_hz(bench.now)
        if hz == 0 or self.reverse != (hz < 0):
            self.reverse, self.turned_us = hz < 0, bench.now
        fault, trips = bench.shows("Fault", index), self.judge.claims.trips[index]
        alone = trips.first and trips.alone and not self.judge.claims.mistaken(index, bench.now)
        if fault and not self.fault and alone:
            now = (
                bench.out("OutputFrequencyHz", index),
                bench.out("OutputCurrentA", index),
                self._out("DcBusVoltageV"),
            )
            kept = tuple(map(self._out, FIRST))
            self._once("first fault", bad=kept != now, seen=(kept, "of", now))
            was = self._out("FirstFaultState")
            self._once("first fault's state", bad=was != self.state, seen=(was, "of", self.state))
        state = self._out("State")
        self._ended(state)
        if state in STARTS and self.state not in STARTS:
            self.began_us = bench.now
        elif bench.pins[index].get("Address") != index + 1:
            self.began_us = 0  # the block has forgotten it
        known = self.began_us > max(self.left_us, self.judge.units[index].restarted_us)
        if fault and not self.fault and alone and known:
            took, shown = (bench.now - self.began_us) // 1000, self._out("FirstFaultMs")
            self._once("first fault's time", bad=abs(took - shown) > LAG_US // 1000, seen=(shown, "of", took, "ms"))
        self._kinds(stopping=state == self.state == STOPPING)
        self.fault, self.state = fault, state

    def _restarted(self) -> None:
        """In the scan after a restart nothing is left of what was before; then a drive has answered, or it has not."""
        bench, index, unit = self.bench, self.index, self.judge.units[self.index]
        pins, since = bench.pins[index], bench.now - unit.restarted_us
        if pins.get("Restart") or bench.lineless or any_of(ASTRAY, pins) or pins.get("Address") != index + 1:
            self.replied, self.anew = None, bool(pins.get("Restart")) and not bench.lineless
            return
        if self.anew and since == 1000 * bench.elapsed:
            kept = [self._out("Starts"), self._out("RunMinutes"), REASON[self._out("StopReason")]]
            self._once("keeps", bad=kept != [0, 0, "RESTARTED"], seen=(kept, "after a restart"))
            self.replied = False
        self.anew = False
        if self.replied is None:
            return
        self.replied = self.replied or bench.shows("CommOk", index)
        reason = bench.reason(index)
        wrong = reason == ("NO_REPLY" if self.replied else "OFFLINE") and not any_of(MOVES, pins)
        self._once("silent since", bad=wrong, seen=(reason, "has answered" if self.replied else "has not answered"))

    def _kinds(self, *, stopping: bool) -> None:
        """The kind of a stop only rises until the motor is at standstill."""
        bench, index = self.bench, self.index
        kind, confirmed = self._out("StopKind"), bench.shows("StopConfirmed", index)
        pins, now = bench.pins[index], bench.now
        anew = now - self.judge.units[index].restarted_us < ATTEND_US or pins.get("Restart")
        if confirmed or not stopping or anew or any_of(AWAY, pins) or pins.get("Address") != index + 1:
            self.rank = 0
            return
        if kind != JOG_KIND:
            self._once("kind", bad=kind < self.rank, seen=(kind, "after", self.rank))
            self.rank = max(self.rank, kind)

    def _ended(self, state: object) -> None:
        """Why a run has ended, where pins say so."""
        bench, claims, index = self.bench, self.judge.claims, self.index
        pins = bench.pins[index]
        now = [name for name, is_so in claims.told(index) if is_so]
        if now in ([], ["STOP_ALL"]) and not any_of(MOVES, pins):  # the block sees the line's pin a scan later
            now = [*now, "RELEASED"]
        self.causes.append(now)
        ended = self.state == RUNNING != state and bench.shows("CommOk", index) and claims.attended(index)
        if not ended or not self.judge.known(index, ATTEND_US) or bench.shows("Fault", index):
            return
        causes = [each for names in self.causes for each in names]
        shown = REASON[self._out("StopReason")]
        self._once("why it ended", bad=bool(now) and shown not in causes, seen=(shown, "of", causes))

    def look(self) -> None:
        """Now and then: validity, direction, errors, faults of before, the longest reply."""
        if self.bench.pins[self.index].get("Left"):
            self.faults = None
            return
        self._valid()
        self._direction()
        self._faults()
        error = self.bench.out("Error", self.index), self.bench.out("ErrorID", self.index)
        kind = self._out("StopKind")
        able = kind not in KINDS or self._out(KINDS[kind])
        self._once("stop kind", bad=not able or kind > len(KINDS) + 1, seen=(kind,))
        own = self._out("OwnMaximumHz")
        true = self.bench.models[self.index].o.maximum_hz if self.kind in OWN_MAXIMUM else 0.0
        self._once(
            "own maximum",
            bad=own not in (0.0, true) or (own != true and self.bench.shows("Ready", self.index)),
            seen=(own, "of", true),
        )
        self._once("error", bad=error[0] != (error[1] != 0), seen=error)

    def _valid(self) -> None:
        bench, index = self.bench, self.index
        knows, age = bench.shows("CommOk", index), bench.number("MeasuresAgeMs", index)
        fresh = knows and age <= bench.number("StaleMs", index)
        for pin in bench.models[index].MEASURES:
            name = UNIT.sub("", pin.removeprefix("Diagnosis."))
            scaled = name not in UNSCALED.get(self.kind, ())
            shown = self._out(f"{name}Valid")
            may = fresh if self.kind in MIXED else knows  # others read their measures by parts
            wrong = (shown and not (may and scaled)) or (fresh and scaled and not shown)
            self._once(f"{name} valid", bad=wrong, seen=(shown, age, knows))

    def _direction(self) -> None:
        bench, index = self.bench, self.index
        lag = 1000 * int(bench.number("StatusAgeMs", index)) + LAG_US + max(self.judge.late)
        known = bench.shows("Running", index) and not self.judge.claims.mistaken(index, bench.now)
        faulty_us = self.judge.units[index].fault[True]  # the word of a fault may say anything
        if known and bench.now - max(self.turned_us, faulty_us) > lag:
            shown = bench.out("Reverse", index)
            reverse = self.reverse and self.kind not in WAYLESS
            self._once("direction", bad=shown != reverse, seen=(shown, "of", reverse))

    def _faults(self) -> None:
        """The last faults move on by one; more than one in the time between two looks is not looked at."""
        now = list(map(self._out, LAST))
        moved = self.faults is not None and now != self.faults
        if moved and self.faults is not None:
            self._once("faults", bad=now[1:] != self.faults[:-1], seen=(now, "after", self.faults))
        self.faults = now
