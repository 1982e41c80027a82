"""A plant's program on the embedded engine, its drives simulated, in virtual time."""

from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import cache
from pathlib import Path

from tests.examples.port import SCAN_MS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk.bus import Bus
from driveblocks.desk.run import source
from driveblocks.desk.run.drives import REFERENCE, open_scales
from driveblocks.plant import program
from driveblocks.plant.load import load
from driveblocks.plant.model import Motor, Plant
from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.engine import Value

EXAMPLES = Path(__file__).parents[2] / "examples" / "plants"
PLANTS = ("pumps", "conveyor", "small")


@cache
def example(name: str) -> Plant:
    return load(EXAMPLES / f"{name}.yaml")


@cache
def loaded(text: str) -> source.Loaded:
    """A program with what it needs of the library, compiled once."""
    return source.load("plant.st", text, source.known([]))


def simulated(motor: Motor) -> SimulatedDrive:
    """A drive as its plant says that it is."""
    places, given = open_scales(motor.map), motor.values
    scales = {
        at: 1 / given[REFERENCE] if name == REFERENCE else given.get(name, Decimal("0.01"))
        for name, at in places.items()
        if name != REFERENCE or name in given
    }
    habits = Habits(maximum_hz=int(motor.full_scale_hz or motor.maximum_hz), scales=scales, ramp=100)
    return SimulatedDrive(motor.map, motor.unit, habits)


class Bench:
    """A program, its lines and its drives."""

    def __init__(self, plant: Plant, text: str = "", kept: Mapping[str, Value] | None = None) -> None:
        """`text` in place of the program of the plant; `kept` is what outlives a restart."""
        made = loaded(text or program.text(plant))
        self.plant, self.now_ms = plant, 0
        self.program: EmbeddedInstance = made.library.instance(made.program.name)
        self.drives = {name: simulated(each) for name, each in plant.drives.items()}
        self.buses = {
            name: Bus([self.drives[each.name] for each in plant.on(name)], at.rate, at.character.bits)
            for name, at in ((one, program.bus(plant, one)) for one in plant.lines)
        }
        for name, value in (kept or {}).items():
            self.program[name] = value
        self.program["ElapsedMs"] = SCAN_MS
        for each in plant.buttons.values():
            self.program[each.name] = each.does.startswith("stop")  # normally closed
        for name in plant.hard_stops:
            self.program[f"{name}_Closed"] = True

    def __getitem__(self, name: str) -> Value:
        return self.program[name]

    def give(self, **values: Value) -> None:
        for name, value in values.items():
            self.program[name] = value

    def scan(self) -> None:
        self.now_ms += SCAN_MS
        for name, bus in self.buses.items():
            here = bus.receive(1000 * self.now_ms)[:255]
            self.program[f"{name}_RxCount"] = len(here)
            if here:
                self.program[f"{name}_Rx"] = here
        self.program.scan(1_000_000 * self.now_ms)
        for name, bus in self.buses.items():
            count, sent = self.program[f"{name}_TxCount"], self.program[f"{name}_Tx"]
            if count:
                bus.send(bytes(sent[:count]), 1000 * self.now_ms)  # type: ignore[index,arg-type]

    def run(self, ms: int) -> None:
        for _ in range(ms // SCAN_MS):
            self.scan()

    def until(self, holds: Callable[[], bool], within_ms: int = 30_000) -> int:
        """Scan until something is so; how long it took, ms."""
        begun = self.now_ms
        while not holds():
            assert self.now_ms - begun < within_ms, "it did not come so far"
            self.scan()
        return self.now_ms - begun

    def press(self, name: str) -> None:
        """Press a button that is open, and release it."""
        self.program[name] = True
        self.run(50)
        self.program[name] = False

    def turning(self) -> set[str]:
        """The drives whose motors turn, as the drives themselves know."""
        return {name for name, each in self.drives.items() if each.motor.shaft}
