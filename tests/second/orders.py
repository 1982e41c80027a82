"""What is ordered on the wire, against what the pins have asked for and what the block shows of it."""

from typing import TYPE_CHECKING

from tests.second.figures import ASTRAY, ATTEND_US, BOOT_US, JOG_ENDS, JOG_US, TAKEN, round_us
from tests.second.frames import runs
from tests.second.observer import MOVES, STOPPING, any_of, both, spoilt
from tests.second.pf4 import alike

if TYPE_CHECKING:
    from tests.second.judge import Judge
    from tests.second.line import Frame

REFERENCE = alike({
    "ATV312": b"\x06\x21\x36", "CHF": b"\x06\x20\0", "GD200A": b"\x06\x20\1", "JSCC": b"\x06\x10\1",
    "MX2": b"\x10\0\0", "PF4": b"\x06\x20\1", "SN300G5": b"\x10\0\1", "V20": b"\x06\0\x64",
    "ACS355": b"\x06\0\1",
})  # fmt: skip
"""How a write of the reference begins, by the manuals' tables of control data."""
RESETS = alike({
    "ATV312": (b"\x06\x21\x35", 0x80), "CHF": (b"\x06\x10\0\0\7", 0xFF), "GD200A": (b"\x06\x20\0\0\7", 0xFF),
    "MX2": (b"\x05\0\3\xff", 0xFF), "PF4": (b"\x06\x20\0", 8), "V20": (b"\x06\0\x63", 0x80),
    "ACS355": (b"\x06\0\0", 0x80),
})  # fmt: skip
"""How a reset begins, and a bit of its last byte; of the others there is none."""
WAYS = alike({"PF4": 0x30, "SN300G5": 3})
"""Bits of the run word for both directions, where each has its own."""
FINISH_US = 500_000
"""A reset of several writes is finished although its fault has gone; a stop that is over may be followed by another."""
AGAIN_US = 4_000_000
"""Within this time after a second block has left its slot a drive gets its own block's stop again."""
OVERDUE_US = 4_000_000
"""After StopWithinMs, until a motor that does not stand is shown as overdue; one that the keypad has started counts
from the next repetition of its stop."""
PROOF_US = 1_000_000
"""From the end of a stop that was overdue to the proof."""
READING = 5
"""State of MonitorOnly."""


def resets(kind: str, data: bytes) -> bool:
    """Whether a request without checksum resets a fault of a drive of this make."""
    head, bit = RESETS.get(kind, (b"\0", 0))
    begins = data[1 : 1 + len(head)] == head
    return begins and (len(head) > 3 or bool(data[5] & bit))


class Orders:
    """Watches one drive block: a start is that of an edge, and of nothing else."""

    def __init__(self, judge: "Judge", index: int) -> None:
        """Begin at power-up."""
        self.judge, self.bench, self.index = judge, judge.bench, index
        self.kind = judge.bench.types[index]
        self.wish = ""
        """The pin that has started it by an edge; empty: nothing may start."""
        self.free = self.confirmed = self.referred = self.commanded = self.ran = False
        """Nothing asked or stopped, and StopConfirmed, before this scan; what was answered; whether it has run."""
        self.asked_before = self.reset_before = self.moved = self.owed = True
        self.resets = self.reading = False
        self.fault_us = self.back_us = self.moved_us = -FINISH_US
        self.taken_us = -AGAIN_US
        """When its slot or its address was last another's, too."""
        self.astray_us: int | None = None
        self.idle_us: int | None = None
        self.overdue_us = 0
        """When it was last shown as overdue."""
        """Since when it is to stand, and is not shown so."""
        self.frames = self.acknowledged = 0
        self.before: tuple[int, ...] = ()
        """What there was to be seen after the last scan."""

    def scan(self) -> None:
        """After each scan."""
        bench, pins = self.bench, self.bench.pins[self.index]
        mine = bench.seen >> (16 + 8 * self.index) & 0xFF
        now = mine, bench.changes, bench.elapsed, len(bench.frames), len(bench.acknowledged)
        astray = any_of(ASTRAY, pins) or bench.lineless
        if now == self.before and not astray:  # nothing has happened but time
            self.fault_us = bench.now if self._shows("Fault") else self.fault_us
            self._overdue()
            return
        self.before = now
        sent, self.frames = bench.frames[self.frames :], len(bench.frames)
        self._acknowledge()
        if astray:
            self._astray()
            return
        here = pins.get("Address") == self.index + 1 and not bench.was_slow_port
        self.astray_us, self.back_us = None, self.back_us if here else bench.now
        asked = [name for name in MOVES if pins.get(name)]
        self._permit(asked)
        self._reset(asked)
        for frame in sent:
            if here and frame.unit == self.index + 1 and not frame.read:
                self._order(frame)
        self._overdue()
        self.confirmed = self._shows("StopConfirmed")
        self.reading = bench.out("State", self.index) == READING and not pins.get("Restart")

    def _shows(self, name: str) -> bool:
        return self.bench.shows(name, self.index)

    def _once(self, rule: str, *, bad: bool, seen: tuple[object, ...] = ()) -> None:
        self.judge.once(self.index, rule, bad=bad, seen=seen)

    def _astray(self) -> None:
        """Nobody calls its block alone: soon it has no run any more, and the line owes its stop."""
        now = self.bench.now
        self.astray_us = now if self.astray_us is None else self.astray_us
        self.taken_us = now if any_of(TAKEN, self.bench.pins[self.index]) else self.taken_us
        self.back_us, self.idle_us, self.reading, self.before = now, None, False, ()
        if now - self.astray_us > ATTEND_US:
            self.wish, self.free, self.confirmed, self.owed = "", False, False, True

    def _acknowledge(self) -> None:
        """What the drive has answered."""
        for frame in self.bench.acknowledged[self.acknowledged :]:
            if frame.unit == self.index + 1 and not frame.read:
                reference = frame.data[1:4] == REFERENCE[self.kind]
                run = runs(self.kind, frame.data)
                self.referred, self.commanded = self.referred or reference, self.commanded or run
                alone = self.bench.now - self.taken_us > AGAIN_US // 2
                if self.owed and alone and not (run or reference):
                    self.owed, self.back_us = False, self.bench.now
        self.acknowledged = len(self.bench.acknowledged)
        pins = self.bench.pins[self.index]
        self.owed = self.owed or any_of(("StopAll", "Restart", "SpeedOnly"), pins)

    def _permit(self, asked: list[str]) -> None:
        """An edge of a pin, at proved standstill, with nothing against it; it ends with its pin, or with the run."""
        pins, wish = self.bench.pins[self.index], asked[0] if asked else ""
        stops = not pins["Enable"] or any_of(STOPPING, pins) or spoilt(pins) or both(pins)
        stops = stops or self._shows("Fault") or not self._shows("CommOk")
        self.ran = self.ran or (self.commanded and self._shows("Running"))
        copied = self.judge.claims.mistaken(self.index, self.bench.now)  # a word of another register shows nothing
        if stops or wish != self.wish or (self.ran and not self._shows("Running") and not copied):
            self.wish, self.referred, self.commanded, self.ran = "", False, False, False
        if asked and not self.asked_before and self.free and not stops and self.confirmed:
            self.wish, self.referred, self.commanded, self.ran = wish, False, False, False
        self.free, self.asked_before = not stops and not asked, bool(asked)

    def _reset(self, asked: list[str]) -> None:
        """A reset is asked for by an edge, with no run or jog pin, while a fault is shown."""
        pins, now = self.bench.pins[self.index], self.bench.now
        self.fault_us = now if self._shows("Fault") else self.fault_us
        gone = not self._shows("CommOk") or any_of(("SupplyOff", "Restart"), pins) or now - self.fault_us > FINISH_US
        rises = bool(pins.get("FaultReset")) and not self.reset_before
        self.resets = not gone and (self.resets or (rises and not asked and self._shows("Fault")))
        self.reset_before = any_of(("FaultReset", "Restart"), pins)

    def _order(self, frame: "Frame") -> None:
        """A write: what it orders, and whether anybody has asked for that."""
        data, pins = frame.data, self.bench.pins[self.index]
        run, ways = runs(self.kind, data), WAYS.get(self.kind, 0)
        both_ways = run and bool(ways) and data[-1] & ways == ways
        self._once("both ways", bad=both_ways, seen=(data.hex(),))
        finish_us = FINISH_US + (JOG_US + round_us(self.bench)) * (self.kind in JOG_ENDS)  # which have two stops
        outside = self.owed or self.bench.now - self.back_us < finish_us or bool(self.judge.asked)
        outside = outside or self.bench.now - self.taken_us < AGAIN_US
        reads = self.reading and pins.get("MonitorOnly") and not outside
        self._once("only reads", bad=bool(reads), seen=(data.hex(),))
        if data[1:4] == REFERENCE[self.kind]:
            word = any(data[4:6] if data[1] == 6 else data[7:])
            self._once("reference unasked", bad=word and not (self.wish or pins.get("SpeedOnly")), seen=(data.hex(),))
        elif run:
            self._once("run unasked", bad=not self.wish, seen=(data.hex(),))
            self._once("run unreferred", bad=bool(self.wish) and not self.referred, seen=(data.hex(),))
        elif resets(self.kind, data):
            self._once("reset unasked", bad=not self.resets, seen=(data.hex(),))

    def _overdue(self) -> None:
        """A motor that is to stand is shown at standstill in its time, or as overdue."""
        bench, pins, unit = self.bench, self.bench.pins[self.index], self.judge.units[self.index]
        confirmed = self._shows("StopConfirmed")
        self.moved = bool(pins.get("Restart")) or (
            not confirmed and (self.moved or self._shows("Running") or self.commanded)
        )
        left = bench.now - self.taken_us < AGAIN_US // 2  # another block, perhaps of another unit
        elsewhere = left or pins.get("Address") != self.index + 1
        self.moved_us = bench.now if elsewhere else self.moved_us  # another unit has its time to boot, too
        boots = elsewhere or bench.now < max(max(unit.restarted_us, self.moved_us) + BOOT_US, unit.back_us)
        tripped = self._shows("Fault") and self._shows("ZeroSpeed")  # its stop stays open, and is not overdue
        away = any_of(("MonitorOnly", "SpeedOnly", "SupplyOff", "Restart"), pins) or boots or tripped
        idle = self.moved and not (self.wish or confirmed or away)
        self.idle_us = (self.idle_us or bench.now) if idle else None
        late = (
            self.idle_us is not None
            and bench.now - self.idle_us > 1000 * int(bench.number("StopWithinMs", self.index)) + OVERDUE_US
        )
        rests = not bench.models[self.index].motor.hz(bench.now) and bench.reachable(self.index)  # what lacks is proof
        self.overdue_us = bench.now if self._shows("StopOverdue") else self.overdue_us
        self._once("overdue", bad=late and not rests and bench.now - self.overdue_us > PROOF_US)
