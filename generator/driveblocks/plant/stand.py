"""A plant on a test stand: its very program, scanned in virtual time, at simulated drives of its addresses.

What is around the PLC is there, too: buttons, analog inputs, the circuits of the hard stops with their contacts, and
what they cut, as a safe torque off does.
"""

import copy
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from decimal import Decimal

from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.port import WirePort
from driveblocks.desk.run import wiring
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.source import Loaded
from driveblocks.plant import simulated
from driveblocks.plant.model import Plant
from driveblocks.plant.program import commanded
from driveblocks.plant.wire import Wire
from driveblocks.render.reasons import REASONS
from structured_text.engines.engine import Value

PUSH_MS = 500
"""How long a button is pressed."""
PANEL_MS = 2_000
"""Between two questions of a panel."""
SHARE = Decimal("0.8")
"""Of full speed, what an input or a panel asks for."""
SECOND_MS, SECONDS = 1000, 10
"""How often it is written down what the drives do, and how much of that is kept."""
NORMALLY_CLOSED = ("stop", "stop_all")
NO_REMEDY = "nothing"
_WHY = {each.code: each for each in REASONS}
_COUNTED = ("RunS", "Starts")
"""What is kept over a restart."""


class Broken(Exception):  # noqa: N818 - the plant is at fault, not this program
    """A rule does not hold: what was expected, and what was so instead."""

    def __init__(self, expected: str, actual: str) -> None:
        self.expected, self.actual = expected, actual
        super().__init__(f"{expected}: {actual}")


class Stand:
    """A plant under test, from power-up on."""

    def __init__(self, plant: Plant, loaded: Loaded) -> None:
        """Wire it. `loaded` is its program. Raises BuildError."""
        self.plant, self._loaded = plant, loaded
        self.clock = VirtualClock()
        self.drives = {each.name: simulated.drive(plant, each) for each in plant.drives.values()}
        self.wires = {name: self._wire(name) for name in plant.lines}
        self.open: set[str] = set()
        """Hard stops that somebody has opened."""
        self.may: set[str] = set()
        """Drives that may start: somebody has asked for it."""
        self.panel = ""
        """The line on which a panel asks, now and then."""
        self.seconds: deque[str] = deque(maxlen=SECONDS)
        self._turned: set[str] = set()
        self._overdue: set[str] = set()
        self._pins: dict[str, Value] = dict(at_rest(plant))
        self.controller = self._made()

    def _made(self) -> Controller:
        """The PLC as it is switched on."""
        loaded = self._loaded
        wired = wiring.find(loaded.program, set(loaded.drives))
        made = Controller(loaded.library, loaded.program.name, wired, loaded.drives, self.plant.scan_ms * 1000)
        ports = {name.upper(): WirePort(wire, self.clock) for name, wire in self.wires.items()}
        first, *others = (ports[each.wiring.line.upper()] for each in made.lines)
        made.connect(first, None, *others)
        for name, value in self._pins.items():
            made.instance[name] = value
        return made

    def _wire(self, name: str) -> Wire:
        drives = [self.drives[each.name] for each in self.plant.on(name)]
        return Wire(self.plant.lines[name], drives, [each.unit for each in self.plant.meters_on(name)])

    def copied(self) -> "Stand":
        """Another stand in the same state, which goes its own way from here."""
        shared = (self.plant, self._loaded, *self._loaded.drives.values(), self._loaded.library)
        own = (part for each in self.drives.values() for part in (each.table, each.habits))
        return copy.deepcopy(self, {id(each): each for each in (*shared, *own)})

    # ------------------------------------------------------------ time

    @property
    def ms(self) -> int:
        return self.clock.now_us() // 1000

    def scan(self) -> None:
        """One scan, and what is around it. Raises ScanError, Broken."""
        self.clock.sleep_until(self.clock.now_us() + 1000 * self.plant.scan_ms)
        now = self.clock.now_us()
        if self.panel and self.ms % PANEL_MS < self.plant.scan_ms:
            motor = self.plant.on(self.panel)[0]
            self.wires[self.panel].ask(motor.unit, motor.map, now)
        self.controller.scan(now)
        self._close()
        if self.ms % SECOND_MS < self.plant.scan_ms:
            self.seconds.append(self._row())
        self._judge()

    def _close(self) -> None:
        """The circuits of the hard stops: each is closed by its contact, unless somebody has opened it."""
        for stop in self.plant.hard_stops.values():
            closed = bool(self.pin(f"{stop.name}_Ok")) and stop.name not in self.open
            self.set(f"{stop.name}_Closed", closed)
            for each in stop.drives:
                if self.drives[each].inhibited == closed:
                    self.drives[each].inhibit(on=not closed)

    def _judge(self) -> None:
        """What always has to hold. Raises Broken."""
        for name, drive in self.drives.items():
            turns = drive.motor.driven
            if turns and name not in self._turned and name not in self.may:
                raise Broken("nothing starts without a rising edge of its start", f"{name} starts; {self.state(name)}")
            if drive.motor.output and self.pin(f"{name}.StopConfirmed"):
                raise Broken("StopConfirmed only at standstill", f"{name} shows it at {drive.hertz:.1f} Hz")
        self._turned = {name for name, drive in self.drives.items() if drive.motor.driven}
        overdue = {name for name in self.drives if self.pin(f"{name}.StopOverdue")}
        for stop in self.plant.hard_stops.values():
            late = overdue & self._overdue & set(stop.drives)
            if late and self.pin(f"{stop.name}_Ok"):
                raise Broken(
                    f"the contact of {stop.name} is open while a stop is overdue",
                    f"closed; overdue: {', '.join(sorted(late))}",
                )
        self._overdue = overdue

    def wait(self, ms: int) -> None:
        """Let time pass."""
        for _ in range(max(1, ms // self.plant.scan_ms)):
            self.scan()

    def until(self, holds: Callable[[], bool], within_ms: int, expected: str, actual: Callable[[], str]) -> None:
        """Scan until something holds. Raises Broken where it does not within its time."""
        end = self.ms + within_ms
        while not holds():
            if self.ms >= end:
                raise Broken(f"{expected} within {within_ms / 1000:g} s", actual())
            self.scan()

    # ------------------------------------------------------------ hands

    def pin(self, name: str) -> Value:
        return self.controller.instance[name]

    def number(self, name: str) -> int:
        return self.controller.number(name)

    def set(self, name: str, value: Value) -> None:
        """Set an input; it stays so over a restart of the PLC."""
        self._pins[name] = self.controller.instance[name] = value

    def push(self, name: str, ms: int = PUSH_MS) -> None:
        """Press a button, and release it."""
        self.set(name, not self.rest(name))
        self.wait(ms)
        self.set(name, self.rest(name))

    def rest(self, name: str) -> bool:
        """What a button shows while nobody touches it: TRUE, if it stops."""
        return name in self.plant.buttons and self.plant.buttons[name].does in NORMALLY_CLOSED

    def restart(self) -> None:
        """Switch the PLC off and on: what is retentive stays, and the inputs are as they are."""
        before = self.controller.instance
        kept = {path: before[path] for each in self.drives for path in (f"{each}_Counted.{one}" for one in _COUNTED)}
        self.controller = self._made()
        for path, value in kept.items():
            self.controller.instance[path] = value
        self._overdue.clear()

    # ------------------------------------------------------------ eyes

    def asked(self, name: str) -> float:
        """The speed that is asked of a drive, Hz."""
        motor = self.plant.drives[name]
        if isinstance(motor.speed, Decimal):
            return float(min(motor.speed, motor.maximum_hz))
        if motor.speed is None:
            return float(SHARE * motor.maximum_hz)
        low, high = self.plant.inputs[motor.speed].range
        return float(min(low + SHARE * (high - low), motor.maximum_hz))

    def state(self, name: str) -> str:
        """What a drive does, and why by its block."""
        number, code = self.number(f"{name}.Reason"), self.number(f"{name}.FaultCode")
        reason = _WHY.get(number)
        said = f": {reason.en}" + (f"; {reason.remedy}" if reason.remedy != NO_REMEDY else "") if reason else ""
        fault = f", fault {code}" if self.pin(f"{name}.Fault") else ""
        return f"{name} is at {self.drives[name].hertz:.1f} Hz{fault}, Reason {number}{said}"

    def states(self, names: Iterable[str]) -> str:
        """The same of several."""
        return "; ".join(map(self.state, names))

    def _row(self) -> str:
        """What all drives do at this second."""
        cells = (
            f"{name} {drive.hertz:.1f} Hz, {drive.mode}, {self.number(f'{name}.Reason')}"
            for name, drive in self.drives.items()
        )
        contacts = (f"{each} {'closed' if self.pin(f'{each}_Ok') else 'open'}" for each in self.plant.hard_stops)
        return f"{self.ms / 1000:7.1f} s  {'; '.join((*cells, *contacts))}"

    def members(self, target: str) -> list[str]:
        """The drives that a command is for."""
        return [each.name for each in self.plant.members(target)]

    @property
    def targets(self) -> list[str]:
        """What has a command of its own."""
        return [*commanded(self.plant)]


def at_rest(plant: Plant) -> Iterator[tuple[str, Value]]:
    """What stands at the inputs of a plant's program while nobody touches anything."""
    for button in plant.buttons.values():
        yield button.name, button.does in NORMALLY_CLOSED
    for each in plant.inputs.values():
        yield each.name, int(each.raw[0] + SHARE * (each.raw[1] - each.raw[0]))
    for motor in plant.drives.values():
        if motor.speed is None and motor.mode != "monitor":
            yield f"{motor.name}_Hertz", float(SHARE * motor.maximum_hz)
