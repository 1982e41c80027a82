"""Random walks over pins, power, PLC restarts and line faults, the rules checked at every scan.

`python -m tests.drives.walk SEED` walks a seed again. A failure names its seed.
"""

import sys
from collections.abc import Callable
from random import Random

from tests.drives.bench import RUNS, Bench, Faults
from tests.drives.rules import BrokenRuleError, Observer
from tests.drives.station import FAMILIES, STATIONS, maps

from driveblocks.simulator.habits import Habits
from structured_text.engines.engine import Library

HERTZ = (25.0, 25.0, 10.0, 50.0, 0.0, 60.0, -1.0, float("nan"), float("inf"))
WIRE = ("lost", "unanswered", "garbled", "truncated", "late", "twice")


class Walk:
    """One walk."""

    def __init__(self, seed: int, stations: Library | None = None) -> None:
        """Choose drives, their habits and the scan by the seed."""
        self.chance = chance = Random(f"drives {seed}")
        types = STATIONS[seed % len(STATIONS)] if seed % 3 else (FAMILIES[seed // 3 % 3],)
        habits = Habits(
            ramp=50,
            coast_ramp=50,
            quick_ramp=200,
            auto_restart=chance.random() < 0.3,
            resumes=chance.random() < 0.3,
            runs_while_stopping=chance.random() < 0.7,
            coast_shows_zero=chance.random() < 0.7,
            settle_ms=chance.choice([0, 0, 60]),
            keeps_fault_code=chance.random() < 0.3,
            watchdog_ms=chance.choice([None, None, 2500]),
        )
        both = all("ascii" in maps()[kind].serial.mode.modes for kind in types)
        self.bench = Bench(
            *types,
            seed=seed,
            ms=chance.choice([10, 20, 20]),
            ascii_=both and chance.random() < 0.3,
            stations=stations,
            habits=habits,
            start=False,
        )
        self.observers = [Observer(self.bench, drive) for drive in range(len(types))]
        for drive in range(len(types)):
            self.bench.put(drive, StopWithinMs=4000, WatchdogMs=habits.watchdog_ms or 0)
        self.trail: list[str] = []

    def go(self, steps: int = 12) -> None:
        """Walk, make all well again, and start. Raises BrokenRuleError."""
        try:
            self.bench.restart()
            actions: list[Callable[[int], object]] = [
                *(self.start,) * 5, *(self.release,) * 3, *(self.pin,) * 3, self.hertz, self.restart, self.stop_all,
                self.wire, self.wire, self.deaf, self.power, self.power, self.trip, self.trip, self.cause, self.reset,
                self.reset, self.keypad, self.keypad_reset, self.interlock, self.lie, self.foreign, self.skip,
                self.late, self.wait, self.wait,
            ]  # fmt: skip
            for _ in range(steps):
                drive = self.chance.randrange(len(self.bench.types))
                action = self.chance.choice(actions)
                self.trail.append(f"{self.bench.now // 1000} {action.__name__} {drive}")
                action(drive)
                self.bench.run(self.chance.choice([0, 20, 60, 200, 500, 1000]))
            self.trail.append(f"{self.bench.now // 1000} heal")
            for observer in self.observers:
                observer.lies = False
            self.bench.heal()
        except AssertionError as error:
            raise BrokenRuleError(f"{error}; {', '.join(self.trail)}") from error

    # ------------------------------------------------------------ what may happen

    def start(self, drive: int) -> None:
        self.bench.put(drive, **dict.fromkeys(RUNS, False)).scan()
        self.bench.put(drive, **{self.chance.choice([*RUNS, "RunForward", "RunForward"]): True})

    def release(self, drive: int) -> None:
        self.bench.put(drive, **dict.fromkeys(RUNS, False))

    def pin(self, drive: int) -> None:
        names = [*RUNS, "Enable", "QuickStop", "CoastStop", "FaultReset", "MonitorOnly", "SpeedOnly", "SupplyOff"]
        name = self.chance.choice(names)
        self.trail[-1] += f" {name}"
        self.bench.put(drive, **{name: not self.bench.pins[drive].get(name)})

    def hertz(self, drive: int) -> None:
        self.bench.put(drive, SpeedReferenceHz=self.chance.choice(HERTZ))

    def restart(self, _: int) -> None:
        """The first scan of a program calls its line."""
        self.bench.leave("SkipLine", on=False).restart()

    def stop_all(self, _: int) -> None:
        self.bench.line(StopAll=not self.bench.line_pins.get("StopAll"))

    def wire(self, _: int) -> None:
        chosen = self.chance.sample(WIRE, self.chance.randrange(3))
        self.bench.faults = Faults(**{name: self.chance.choice([20, 100, 400]) for name in chosen})

    def deaf(self, drive: int) -> None:
        self.bench.deaf ^= {drive + 1}

    def power(self, drive: int) -> None:
        self.bench.drives[drive].power(on=not self.bench.drives[drive].powered)

    def trip(self, drive: int) -> None:
        one = self.bench.drives[drive]
        one.trip(self.chance.choice([1, 2, 3]))
        one.cause = self.chance.random() < 0.5

    def cause(self, drive: int) -> None:
        self.bench.drives[drive].clear_cause()

    def reset(self, drive: int) -> None:
        self.bench.put(drive, **dict.fromkeys((*RUNS, "FaultReset"), False)).scan()
        self.bench.put(drive, FaultReset=True)

    def keypad(self, drive: int) -> None:
        one = self.bench.drives[drive]
        if one.motor.driven:
            one.keypad_stop()
        else:
            one.keypad_run(self.chance.choice([None, 5.0, 30.0]), reverse=self.chance.random() < 0.5)

    def keypad_reset(self, drive: int) -> None:
        self.bench.drives[drive].reset()

    def interlock(self, drive: int) -> None:
        self.bench.drives[drive].inhibit(on=not self.bench.drives[drive].inhibited)

    def lie(self, drive: int) -> None:
        one = self.bench.drives[drive]
        name = self.chance.choice(["local", "follows", "keeps_running"])
        setattr(one, name, not getattr(one, name))
        self.observers[drive].lies = True

    def foreign(self, drive: int) -> None:
        unit = self.chance.choice([drive + 1, 9])
        self.bench.foreign(self.chance.choice([bytes([unit, 3, 0x20, 0, 0, 2]), bytes([unit, 6, 0x10, 0, 0, 1])]))

    def skip(self, drive: int) -> None:
        name = self.chance.choice([f"Skip{drive}", "SkipLine"])
        self.bench.leave(name, on=not self.bench.block[name])

    def late(self, _: int) -> None:
        self.bench.scan(self.chance.choice([40, 150, 900, 1600]))

    def wait(self, _: int) -> None:
        self.bench.run(1500)


def walk(seed: int, stations: Library | None = None, steps: int = 12) -> None:
    """Walk a seed. Raises BrokenRuleError with the seed."""
    try:
        Walk(seed, stations).go(steps)
    except BrokenRuleError as error:
        raise BrokenRuleError(f"seed {seed}: {error}") from error


if __name__ == "__main__":
    walk(int(sys.argv[1]))
    print("every rule has held")
