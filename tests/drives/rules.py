"""The rules of a drive block, checked at every scan by somebody who sees its pins and the frames on the wire, no more.

What a frame asks is read from the map alone, as conditions on words. A broken rule raises BrokenRuleError.
"""

from dataclasses import dataclass

from tests.drives.bench import RUNS, Bench, Frame
from tests.drives.station import PINS

from driveblocks.maps.model import Command, Drive
from driveblocks.simulator.pattern import Pattern, of_write
from structured_text.engines.engine import Value

STOPS = ("stop", "quick_stop", "coast_stop", "jog_stop")
MOTIONS = dict(zip(RUNS, ("run_forward", "run_reverse", "jog_forward", "jog_reverse"), strict=True))
FRESH = ("Ready", "Running", "AtSpeed", "ZeroSpeed", "StopConfirmed")
"""What may not be shown without CommOk."""
SEEN_US = 5_500_000
"""How long a motor may turn by itself before the block must show it: StaleMs, and a poll."""
READ_US = 100_000
"""For each drive on the line, how old the frequency can be that proves standstill: somebody may start the motor after
it, and the line stop it."""
UNATTENDED_US = 950_000
"""From then on the line may stop a drive whose block is not called: `AttendMs` is 1 s."""
FINISH_US = 500_000
"""A reset of several writes that is on its way is finished although its fault has gone: a coil has to fall again."""
BACK_US = 500_000
"""For so long a stop that the line has begun without the block may be sent again, or the other one after it."""
LEFT_US = 1_050_000
"""A block that was not called for so long: the line has stopped its drive."""
BOOT_MS = 10_000
"""BootMs where it is 0."""
ONLY_READS = 5
"""The state in which a block has stopped its drive and only reads."""


class BrokenRuleError(AssertionError):
    """A rule of the drive block does not hold."""


class Meaning:
    """What the words of a map mean."""

    def __init__(self, drive: Drive) -> None:
        """Read the commands, each with the writes before its last."""
        self.reference = drive.operation.reference.register
        commands = drive.operation.commands
        self.words: list[tuple[str, Pattern]] = []
        for command in commands:
            self.words += [(command.does, of_write(step)) for step in command.first]
            self.words.append((command.does, of_write(command)))
        self.both = [
            Pattern(a.register, mask, mask)
            for a in commands
            for b in commands
            if (a.does, b.does) == ("run_forward", "run_reverse") and (mask := _both(a, b))
        ]

    def does(self, frame: Frame) -> set[str]:
        """What a write may do; nothing: it is no command."""
        return {does for does, each in self.words if each.register == frame.address and each.holds(frame.word)}


def _both(first: Command, second: Command) -> int:
    """The bits of both directions, where each has its own."""
    one, two = ({bit for span in each.set for bit in span} for each in (first, second))
    return sum(1 << bit for bit in one | two) if one - two and two - one else 0


@dataclass
class Observer:
    """Watches one drive block of a bench."""

    bench: Bench
    drive: int = 0
    lies: bool = False
    """The drive does not do what it acknowledges, or shows what is not so: then its motor proves nothing."""
    wish: str | None = None
    """What the pins have started, by an edge; None: nothing may start."""
    free: bool = False
    """All run and jog pins were FALSE since the last thing that stops."""
    referred: bool = False
    """A reference was acknowledged since the edge."""
    commanded: bool = False
    """... and run."""
    ran: bool = False
    resets: bool = False
    """A reset was asked for, and is still of use."""
    parameters: bool = False
    """A parameter block was busy before this scan, or is."""
    stopping_us: int = 0
    skipped_us: int = 0
    back_us: int = -1_000_000
    """When its block was called again after it was not, or a stop of the line was answered."""
    turning_us: int = 0
    stood_us: int = 0
    """When the motor was last seen to stand."""
    acknowledged_us: int = 0
    """When the drive last acknowledged a stop."""
    frames: int = 0
    acknowledged: int = 0
    heard: int = 0
    boots_us: int = 1000 * BOOT_MS
    anew_ms: int = 0
    moved: bool = True
    """It may have moved since standstill was proved."""

    def __post_init__(self) -> None:
        """Begin to watch."""
        self.meaning = Meaning(self.bench.maps[self.drive])
        self.bench.watch.append(lambda _: self.scan())
        self.frames, self.acknowledged = len(self.bench.frames), len(self.bench.acknowledged)
        self.was_confirmed = self.was_busy = self.idle = False
        self.volts = 0.0
        self.shows: dict[str, bool] = dict.fromkeys(PINS, False)
        self.calm = 0
        self.now: tuple[int, ...] = ()
        self.only_reads = self.owed = False
        self.asked_before = self.reset_before = True
        self.fault_us = -FINISH_US

    def fail(self, what: str) -> None:
        """Tell which rule is broken."""
        raise BrokenRuleError(f"drive {self.drive}: {what}; {self.bench.told()}")

    def scan(self) -> None:
        """After each scan. Raises BrokenRuleError."""
        bench, pins = self.bench, self.bench.pins[self.drive]
        now = (bench.seen, bench.changes, len(bench.frames), len(bench.acknowledged), bench.elapsed)
        self.calm = self.calm + 1 if now == self.now else 0
        self.now = now
        skipped = bench.block[f"Skip{self.drive}"]
        if self.calm > 1 and not skipped:  # nothing to be seen but time
            self._time(pins)
            return
        if skipped:
            self.skipped_us += 1000 * bench.ms
            self.turning_us = self.stopping_us = 0
            self.stood_us = self.stood_us if bench.drives[self.drive].motor.output else bench.now
            if self.skipped_us > LEFT_US:
                self.wish, self.free, self.was_confirmed = None, False, False
            self.only_reads &= self.skipped_us < UNATTENDED_US
            self.owed |= LEFT_US < self.skipped_us <= LEFT_US + 1000 * bench.ms  # its stop may stay unanswered for long
            self.idle, self.shows = False, dict.fromkeys(PINS, False)
            self.frames = len(bench.frames)
            self._acknowledge()
            return
        self.back_us = bench.now if self.skipped_us else self.back_us
        self.skipped_us = 0
        shows = {name: bench.shows(name, self.drive) for name in PINS}
        if not shows["CommOk"] and any(shows[name] for name in FRESH):
            self.fail(f"shows {[name for name in FRESH if shows[name]]} without CommOk")
        asked = [MOTIONS[name] for name in RUNS if pins.get(name)]
        self._permit(asked, stops=self._stops(pins, asked, shows), shows=shows)
        self._reset(pins, asked, shows)
        busy = bench.block["Writer.Busy"] or bench.block["Storer.Busy"]
        self.parameters, self.was_busy = bool(busy or self.was_busy), bool(busy)
        for frame in bench.frames[self.frames :]:
            if frame.unit == self.drive + 1 and not frame.read:
                self._frame(frame, shows)
            if not 0 < frame.unit <= len(bench.types):
                self.fail(f"asks unit {frame.unit}")
        self.frames = len(bench.frames)
        volts = bench.number("DcBusVoltageV", self.drive) if len(bench.types) > 1 else 0.0
        if volts not in (0.0, self.volts):
            self.volts = volts
            if abs(self.volts - bench.drives[self.drive].habits.bus_volts) > 1.0:
                self.fail(f"shows {volts} V, which is not its own")
        self.shows = shows
        others = pins.get("MonitorOnly") or pins.get("SpeedOnly") or pins.get("SupplyOff")
        anew = bench.line_pins.get("Restart") or bench.block["SkipLine"] or bench.elapsed > 1000
        self.idle = self.wish is None and not shows["StopConfirmed"] and not others and not anew
        self._time(pins)
        state = self.bench.out("Control.State", self.drive) if pins.get("MonitorOnly") else 0
        self.only_reads = state == ONLY_READS and bench.elapsed <= 1000 and not bench.line_pins.get("Restart")
        self.asked_before, self.was_confirmed = bool(asked), shows["StopConfirmed"]

    # ------------------------------------------------------------ who may start

    def _stops(self, pins: dict[str, Value], asked: list[str], shows: dict[str, bool]) -> bool:
        hz = pins["SpeedReferenceHz"]
        assert isinstance(hz, float)
        forward, reverse = any("forward" in each for each in asked), any("reverse" in each for each in asked)
        return bool(
            not pins["Enable"]
            or any(pins.get(name) for name in ("QuickStop", "CoastStop", "MonitorOnly", "SpeedOnly"))
            or pins.get("SupplyOff")
            or self.bench.line_pins.get("StopAll")
            or self.bench.line_pins.get("Restart")
            or (forward and reverse)
            or (asked and not hz >= 0.0)
            or (asked and hz == float("inf"))
            or not shows["CommOk"]
            or shows["Fault"]
        )

    def _permit(self, asked: list[str], *, stops: bool, shows: dict[str, bool]) -> None:
        wish = asked[0] if asked else None
        rising = bool(asked) and not self.asked_before
        # who has started and runs, and stops without us, needs a new edge
        self.ran = self.ran or (self.commanded and shows["Running"])
        if stops or wish != self.wish or (self.ran and not shows["Running"]):
            self.wish, self.referred, self.commanded, self.ran = None, False, False, False
        if rising and self.free and not stops and self.was_confirmed:
            self.wish, self.referred, self.commanded, self.ran = wish, False, False, False
        self.free = not stops and not asked
        self._acknowledge()

    def _acknowledge(self) -> None:
        """Take note of what the drive has acknowledged, which the line goes on asking while the block is left out."""
        for frame in self.bench.acknowledged[self.acknowledged :]:
            if frame.unit == self.drive + 1 and not frame.read:
                does = self.meaning.does(frame)
                self.referred |= frame.address == self.meaning.reference
                self.commanded |= self.wish in does and not does & set(STOPS)
                if does & set(STOPS):
                    self.back_us = self.bench.now if self.owed else self.back_us
                    self.acknowledged_us, self.owed = self.bench.now, False
        self.owed |= bool(self.bench.line_pins.get("StopAll"))
        self.acknowledged = len(self.bench.acknowledged)

    def _reset(self, pins: dict[str, Value], asked: list[str], shows: dict[str, bool]) -> None:
        self.fault_us = self.bench.now if shows["Fault"] else self.fault_us
        gone = not shows["CommOk"] or pins.get("SupplyOff") or self.bench.line_pins.get("Restart")
        gone = gone or self.bench.now - self.fault_us > FINISH_US
        rising = pins.get("FaultReset") and not self.reset_before
        self.resets = not gone and (self.resets or bool(rising and not asked and shows["Fault"]))
        self.reset_before = bool(pins.get("FaultReset")) or bool(self.bench.line_pins.get("Restart"))

    def _stopped_from_outside(self, pins: dict[str, Value]) -> bool:
        """By the line, which gives no stop up, by a restart, or because the drive is to be more than watched."""
        line = self.bench.line_pins
        restarted = line.get("Restart") or self.bench.elapsed > 1000
        back = self.bench.now - self.back_us < BACK_US
        return bool(restarted or back or self.owed or pins.get("SpeedOnly"))

    def _frame(self, frame: Frame, shows: dict[str, bool]) -> None:
        pins, does = self.bench.pins[self.drive], self.meaning.does(frame)
        if any(each.register == frame.address and each.holds(frame.word) for each in self.meaning.both):
            self.fail(f"{frame} runs both ways")
        if self.only_reads and pins.get("MonitorOnly") and not self._stopped_from_outside(pins):
            self.fail(f"{frame} is written while it only reads")
        if does & set(STOPS):
            return
        if frame.address == self.meaning.reference:
            if self.wish is None and frame.word and not pins.get("SpeedOnly"):
                self.fail(f"{frame}: a reference without an edge")
        elif not does:
            self._parameter(frame)
        elif "fault_reset" in does and self.wish not in does:
            if not self.resets:
                self.fail(f"{frame}: a reset that nobody has asked for")
        else:
            self._motion(frame, does, runs=shows["Running"])

    def _parameter(self, frame: Frame) -> None:
        if not self.parameters or self.drive:
            self.fail(f"{frame}: a write to a register that is neither command nor reference")
        if not self.was_confirmed:
            self.fail(f"{frame}: a parameter while the motor is not known to be at standstill")

    def _motion(self, frame: Frame, does: set[str], *, runs: bool) -> None:
        if self.wish not in does:
            self.fail(f"{frame} ({', '.join(sorted(does))}): no edge has asked for it")
        if not self.referred:
            self.fail(f"{frame}: no reference is acknowledged")
        if self.ran and not runs:
            self.fail(f"{frame}: refreshed though the drive does not run")

    # ------------------------------------------------------------ stops

    def _time(self, pins: dict[str, Value]) -> None:
        """StopConfirmed against the true motor, and the time that a stop takes."""
        motor, shows = self.bench.drives[self.drive].motor, self.shows
        turns = motor.output != 0
        self.stood_us = self.stood_us if turns else self.bench.now
        self.turning_us = self.turning_us + 1000 * self.bench.ms if turns else 0
        if shows["StopConfirmed"] and not self.lies:
            if not self.was_confirmed and self.stood_us < self.acknowledged_us - READ_US * len(self.bench.types):
                self.fail("StopConfirmed, and the motor has not stood since the stop")
            if self.turning_us > SEEN_US:
                self.fail("StopConfirmed, and the motor turns")
        self.stopping_us = self.stopping_us + 1000 * self.bench.ms if self.idle else 0
        within = pins["StopWithinMs"]
        assert isinstance(within, int)
        self.moved = not shows["StopConfirmed"] and (self.moved or shows["Running"] or self.commanded)
        self.moved |= bool(self.bench.line_pins.get("Restart") or self.bench.elapsed > 1000)
        if self._boots(pins) or not self.moved or (shows["Fault"] and shows["ZeroSpeed"]):
            # it counts anew after the boot; proved, and nothing posted since: proof outlives silence; a tripped drive's
            # stop stays open, and is not overdue
            self.stopping_us = 0
        if self.stopping_us > 1000 * within + 1_500_000 and not shows["StopOverdue"]:
            self.fail(f"neither StopConfirmed nor StopOverdue for {self.stopping_us // 1000} ms")

    def _boots(self, pins: dict[str, Value]) -> bool:
        """Whether its silence is no alarm yet: no read was answered since power-up, or since its supply is back."""
        if self.bench.line_pins.get("Restart") or self.bench.elapsed > 1000 or pins.get("SupplyOff"):
            self.boots_us = self.bench.now + 1000 * BOOT_MS
            self.anew_ms = self.bench.now // 1000
        heard = [frame for frame in self.bench.acknowledged[self.heard :] if frame.unit == self.drive + 1]
        believed = self.bench.block[f"Slots[{self.drive}].Replies"]  # one that comes too late is not
        if believed and any(frame.read and frame.ms >= self.anew_ms for frame in heard):
            self.boots_us = 0
        self.heard = len(self.bench.acknowledged)
        return self.bench.now < self.boots_us + 1_500_000


def watched(*types: str, start: bool = True, **options: object) -> Bench:
    """A bench whose blocks are all watched."""
    bench = Bench(*types, start=False, **options)  # type: ignore[arg-type]  # passed on
    for drive in range(len(bench.types)):
        Observer(bench, drive)
    return bench.restart() if start else bench


def sent(bench: Bench, frames: list[Frame], *does: str) -> list[Frame]:
    """Those of these frames that do one of these things; `reference` is one of them."""
    meaning = Meaning(bench.maps[0])
    written = [each for each in frames if not each.read]
    return [
        each
        for each in written
        if meaning.does(each) & set(does) or ("reference" in does and each.address == meaning.reference)
    ]
