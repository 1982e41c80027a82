"""A soft PLC by matiec with the Linux line, as a process of its own, and the simulator as another.

`python -m tests.desk.simulate.softplc SECONDS` runs both over a pseudo-terminal, with 1 % of the frames damaged.
"""

import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from tests.blocks.library import BLOCKS
from tests.blocks.toolchains import COMPILER, FOUND, run, translate
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import RealClock
from driveblocks.desk.ending import Ending
from driveblocks.desk.simulate.link import PtyLink
from driveblocks.desk.simulate.setup import Stand
from structured_text.engines.matiec.installation import Installation

HERE = Path(__file__).parent
WHY_NOT = "" if FOUND and COMPILER else "the Linux line needs iec2c and a C compiler; `driveblocks doctor` tells more"
PATIENCE_S = 30
HELD = 24
"""The reason of a run pin that was held since before: what follows where the machine has held a scan up too long."""
QUICK = Habits(ramp=100, coast_ramp=200)
"""A motor for which nobody has to wait."""


def built(folder: Path, tool: Installation | None = None, driver: str = "softplc.c", *more: str) -> Path:
    """The soft PLC as a program, or what another driver in C or more flags of the compiler make of it."""
    names = (BLOCKS / "order.txt").read_text(encoding="utf-8").split()
    mine = ("types/", "modbus/", "line/", "vfd/", "invt_chf/")
    files = [BLOCKS / name for name in names if name.startswith(mine)]
    linux = [BLOCKS.parent / "openplc/shared" / f"{name}.st" for name in ("LX_Port", "LX_Port_Line2", "LX_Port_Line32")]
    texts = [path.read_text(encoding="utf-8") for path in (*files, *linux, HERE / "softplc.st")]
    tool = tool or FOUND[0]
    translate(tool, texts, folder)
    program = folder / "softplc"
    headers = ["-isystem", str(tool.headers), "-I", "."]
    flags = ["-std=gnu11", "-O1", "-fwrapv", "-fno-strict-aliasing", "-w", *more]
    run([str(COMPILER), *flags, *headers, "-o", str(program), str(HERE / driver), "-lm"], folder)
    return program


@dataclass
class SoftPlc:
    """The process, and what it shows."""

    process: subprocess.Popen[str]
    seen: dict[str, float] = field(default_factory=dict)
    changed: threading.Condition = field(default_factory=threading.Condition)

    def read(self) -> None:
        """Take what it says until its end."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            with self.changed:
                self.seen = {name: float(value) for name, value in (word.split("=") for word in line.split())}
                self.changed.notify_all()

    def set(self, name: str, *, on: bool) -> None:
        """Set an input."""
        assert self.process.stdin is not None
        self.process.stdin.write(f"{name} {int(on)}\n")
        self.process.stdin.flush()

    def until(self, what: Callable[[dict[str, float]], bool], seconds: float = PATIENCE_S) -> dict[str, float]:
        """Wait until something is to be seen. Raises AssertionError where it never is."""
        with self.changed:
            assert self.changed.wait_for(lambda: bool(self.seen) and what(self.seen), seconds), self.seen
            return self.seen


@contextmanager
def plc(program: Path, device: str, *more: str) -> Iterator[SoftPlc]:
    """Run the soft PLC at a device."""
    process = subprocess.Popen([program, device, *more], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    made = SoftPlc(process)
    reader = threading.Thread(target=made.read)
    reader.start()
    try:
        yield made
    finally:
        assert process.stdin is not None
        if not process.stdin.closed:
            process.stdin.close()
        process.wait(PATIENCE_S)
        reader.join()


@dataclass
class Desk:
    """Drives at a pseudo-terminal, served in a thread; `stop` ends it as a killed process would."""

    bus: Bus = field(default_factory=lambda: Bus([SimulatedDrive(MAPS["CHF"], 1, QUICK)], 19200, 10))
    link: PtyLink = field(default_factory=PtyLink)
    ending: Ending = field(default_factory=Ending)

    def __post_init__(self) -> None:
        """Serve."""
        stand = Stand(self.bus, self.link, RealClock(), self.ending)
        self.thread = threading.Thread(target=stand.run, args=(lambda _: None, lambda _: None), daemon=True)
        self.thread.start()

    @property
    def drive(self) -> SimulatedDrive:
        """The only drive."""
        return self.bus.drives[0]

    def stop(self) -> None:
        """Serve no more; the pseudo-terminal stays."""
        self.ending.ask("enough")
        self.thread.join()


def long(seconds: float) -> dict[str, float]:
    """Start, turn and stop over and over on a line that damages 1 % of the frames; the figures of both sides."""
    figures = {"rounds": 0.0, "restarts": 0.0, "lost stops": 0.0, "wrong values": 0.0, "memory at first": 0.0}
    desk = Desk()
    desk.bus.loss.damage = 0.01
    with tempfile.TemporaryDirectory() as folder, plc(built(Path(folder)), desk.link.place) as soft:
        soft.until(lambda seen: seen["confirmed"] == 1)
        figures["memory at first"] = soft.seen["memory"]
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            soft.set("start", on=True)
            before = desk.drive.hertz
            seen = soft.until(lambda seen: (seen["running"] == 1 and seen["hertz"] >= 19.99) or seen["reason"] == HELD)
            if seen["reason"] == HELD:
                figures["restarts"] += 1
                soft.set("start", on=False)
                soft.until(lambda seen: seen["confirmed"] == 1 and seen["reason"] != HELD)
                continue
            figures["wrong values"] += before != 0 or desk.drive.hertz != 20 or soft.seen["hertz"] > 20.01
            soft.set("start", on=False)
            soft.until(lambda seen: seen["confirmed"] == 1)
            figures["lost stops"] += desk.drive.mode != "standstill"
            figures["rounds"] += 1
        last = dict(soft.seen)
    desk.stop()
    counts, loss = desk.bus.counts[1], desk.bus.loss
    desk.link.close()
    return {**figures, **last, "heard": counts.heard, "replied": counts.replied, "damaged": loss.damaged}


if __name__ == "__main__":
    print("\n".join(f"{name:16} {value:g}" for name, value in long(float(sys.argv[1])).items()))
