"""A program on a desk: one or three simulated drives in virtual time, and ports that misbehave."""

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.ending import Ending
from driveblocks.desk.port import WirePort
from driveblocks.desk.run import source, wiring
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.session import Session
from driveblocks.desk.run.watchdog import Watchdog
from driveblocks.maps import catalog
from driveblocks.maps.collection import Source

EXAMPLE = Path(__file__).parents[3] / "examples" / "three_makes.st"
SCAN_US = 10_000
ONE = """PROGRAM One
VAR
  Start : BOOL;
  Hz : REAL := 20.0;
  Elapsed : UINT;
  First : BOOL;
  Received : UINT;
  Rx : MB_Adu;
  Tx : MB_LineFrame;
  Motor : JSCC_Drive;
  Bus : MB_ByteLine8;
  Slots : MB_Slots8;
  Divisor : INT := 1;
  Quotient : INT;
  Setting : VFD_Settings := (ReferenceScale := 100.0, FrequencyScale := 0.01);
END_VAR
  Quotient := 1 / Divisor;
  Motor(Enable := TRUE, RunForward := Start, SpeedReferenceHz := Hz, MaximumHz := 50.0, FullScaleHz := 50.0,
    Address := 7, StopWithinMs := 15000, Settings := Setting, Slot := Slots[0]);
  Bus(ElapsedMs := Elapsed, BitRate := 19200, Restart := First, RxCount := Received, RxChars := Rx, TxChars := Tx,
    Slots := Slots);
END_PROGRAM
"""
BOX = (
    ONE.replace("  Received : UINT;\n  Rx : MB_Adu;\n  Tx : MB_LineFrame;\n", "  Box : MB_Port;\n")
    .replace("MB_ByteLine8", "MB_Line8")
    .replace("RxCount := Received, RxChars := Rx, TxChars := Tx,", "Port := Box,")
)
"""The same with a mailbox of its own."""


@cache
def maps() -> tuple[Source, ...]:
    """The shipped maps, read once."""
    return tuple(Source(path, drive) for path, drive in zip(catalog.shipped(), MAPS.values(), strict=True))


@cache
def loaded(text: str, name: str | None = None) -> source.Loaded:
    """A program, compiled once."""
    return source.load("my.st", text, maps(), name)


def wired(text: str) -> wiring.Wiring:
    """What is found in a program."""
    program = loaded(text)
    return wiring.find(program.program, set(program.drives))


class Line(WirePort):
    """A simulated line that notes what leaves and can fall silent."""

    def __init__(self, wire: Bus, clock: VirtualClock) -> None:
        """As it is."""
        super().__init__(wire, clock)
        self.sent: list[bytes] = []
        self.cut = False

    def send(self, data: bytes) -> None:
        """Bytes onto the line."""
        self.sent.append(data)
        if not self.cut:
            super().send(data)


@dataclass
class Desk:
    """A program, its session, its line and its drives."""

    text: str = ONE
    drives: list[SimulatedDrive] = field(default_factory=lambda: [SimulatedDrive(MAPS["JSCC"], 7)])
    free: frozenset[tuple[int, str]] | None = None
    """As in `Controller.connect`; None: the port is simulated."""
    others: list[SimulatedDrive] = field(default_factory=list)
    """Of a second line, if the program has one."""

    def __post_init__(self) -> None:
        """Wire it."""
        program = loaded(self.text)
        self.clock = VirtualClock()
        self.controller = Controller(program.library, program.program.name, wired(self.text), program.drives, SCAN_US)
        self.line = Line(Bus(self.drives, 19200, 10, ascii_mode="Ascii := TRUE" in self.text), self.clock)
        self.ending = Ending()
        self.session = Session(self.controller, self.clock, self.ending, SCAN_US)
        self.session.watchdog = Watchdog(now_us=lambda: 0)  # the time of this machine is none of its business
        self.session.connect(self.line, self.free, *self._second(self.others, self.clock))
        self.session.known = self._probed(program)
        self.instance = self.controller.instance

    def _second(self, drives: list[SimulatedDrive], clock: VirtualClock) -> list[Line]:
        return [Line(Bus(drives, 9600, 10), clock)] if self.others else []

    def _probed(self, program: source.Loaded) -> Controller:
        """The program after a scan without a port: a run that ends before its first scan stops the drives of this."""
        probe = Controller(program.library, program.program.name, wired(self.text), program.drives, SCAN_US)
        nobody = Line(Bus([], 19200, 10, ascii_mode=False), VirtualClock())
        probe.connect(nobody, None, *self._second([], VirtualClock()))
        probe.scan(SCAN_US)
        return probe

    def scan(self, ms: int) -> "Desk":
        """Scan for so long, without an end."""
        until = self.clock.now_us() + 1000 * ms
        while self.clock.now_us() < until:
            self.controller.scan(self.clock.now_us())
            self.clock.sleep_until(self.clock.now_us() + SCAN_US)
        return self

    def started(self, ms: int = 4000) -> "Desk":
        """Scan until the motor turns."""
        self.scan(2000)
        self.instance["Start"] = True
        return self.scan(ms)

    def told(self) -> list[str]:
        """What the session has said since."""
        lines = []
        while not self.session.told.empty():
            lines.append(self.session.told.get())
        return lines
