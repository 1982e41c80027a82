"""`driveblocks run` as a process, on a real clock, at pymodbus's server: two serial lines, a cable between them.

`python -m tests.desk.simulate.deskplc SECONDS` starts and stops a motor over and over, with 1 % of the frames damaged.
"""

import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from csv import DictReader
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pymodbus.simulator import DataType, SimData, SimDevice
from tests.desk.run.desk import ONE
from tests.desk.simulate.softplc import SoftPlc
from tests.desk.site.test_peer import peer

from driveblocks.desk.bus import Loss
from driveblocks.render.reasons import by_name

UNIT = 7
NET = 600
"""Seconds that no machine needs, for what would hang."""
CHF = ONE.replace("JSCC", "CHF")
ASKED_HZ = 20
COMMAND, STATUS, REFERENCE, FREQUENCY, FAULT = 0x1000, 0x1001, 0x2000, 0x3000, 0x5000
RUN, STOP, JOG_STOP = 1, 5, 8
RUNNING, STANDING = 1, 3
STEP = 500
"""So much nearer to what is asked, in 0.01 Hz, whenever the frequency is read: this motor knows no time."""
COUNTERS = ("Requests", "Good")
HELD = by_name("HELD").code
VALID = "Diagnosis.OutputFrequencyValid"
SHOWN = ("Reason", "CommOk", "StopConfirmed", "AtSpeed", "OutputFrequencyHz", VALID)


class Motor:
    """What pymodbus's registers do not do by themselves: from a command word to status and frequency."""

    def __init__(self) -> None:
        """Stand."""
        self.command, self.reference = STOP, 0
        self.written: set[tuple[int, int]] = set()
        self.frequencies = [0]
        """All that the register has held."""

    @property
    def stands(self) -> bool:
        """Told to stop, and at rest."""
        return self.command != RUN and self.frequencies[-1] == 0

    async def act(self, *access: Any) -> None:
        """Before each access: function, first register of all, address, count, all registers, words that come."""
        _, first, address, _, registers, values = access
        if values is not None:
            self.written |= {(address, values[0])}
            self.command = values[0] if address == COMMAND else self.command
            self.reference = values[0] if address == REFERENCE else self.reference
        elif address == FREQUENCY:
            self._turn()
        registers[STATUS - first] = STANDING if self.stands else RUNNING
        registers[FREQUENCY - first] = self.frequencies[-1]

    def _turn(self) -> None:
        now, wanted = self.frequencies[-1], self.reference // 2 if self.command == RUN else 0
        if now != wanted:
            self.frequencies.append(min(now + STEP, wanted) if now < wanted else max(now - STEP, wanted))


def device(motor: Motor) -> SimDevice:
    """The registers that a drive block reads and writes, with a motor behind them."""
    blocks = [(COMMAND, 2), (REFERENCE, 1), (FREQUENCY, 7), (FAULT, 2)]
    data = [SimData(first, count=count, values=0, datatype=DataType.REGISTERS) for first, count in blocks]
    return SimDevice(id=UNIT, simdata=data, action=motor.act)


def carried(loss: Loss) -> Callable[[bool, bytes], bytes]:
    """A cable that damages frames: a server that gets no good request hears none, a reply comes as it is."""

    def carry(asked: bool, data: bytes) -> bytes:
        return data if not loss.fate() else b"" if asked else loss.spoiled(data)

    return carry


@dataclass
class DeskPlc(SoftPlc):
    """`driveblocks run` as a process at a real port; its lines, and what they show."""

    lines: list[str] = field(default_factory=list)
    over: bool = False

    def read(self) -> None:
        """Take what it says until its end."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            name, is_set, value = line.rpartition("s  ")[2].strip().partition(" = ")
            with self.changed:
                self.lines.append(line.rstrip())
                if is_set:
                    self.seen[name] = float({"TRUE": "1", "FALSE": "0"}.get(value, value))
                    self.changed.notify_all()
        with self.changed:
            self.over = True
            self.seen.setdefault("over", 1)  # also where it has shown nothing: nobody has to wait for it
            self.changed.notify_all()

    def reach(self, what: Callable[[dict[str, float]], bool]) -> None:
        """Wait for something of the motor's. Raises AssertionError where the soft PLC has ended before."""
        self.until(lambda seen: self.over or what({name: seen.get(f"Motor.{name}", -1) for name in SHOWN}), NET)
        assert not self.over, self.lines

    def stop(self) -> None:
        """Stop, and wait until the motor is at standstill."""
        self.set("Start", on=False)
        self.reach(lambda seen: (seen["StopConfirmed"], seen["AtSpeed"]) == (1, 0) and seen["Reason"] != HELD)

    def start(self) -> int:
        """Start, and wait until the motor turns; how many edges were unanswered."""
        vain = 0
        while True:
            self.set("Start", on=True)
            self.reach(lambda seen: (seen["StopConfirmed"], seen["AtSpeed"]) == (0, 1) or seen["Reason"] == HELD)
            if self.seen["Motor.Reason"] != HELD:
                return vain
            self.stop()
            vain += 1

    def set(self, name: str, *, on: bool) -> None:
        """Set an input."""
        self.say(f"{name} := {'TRUE' if on else 'FALSE'}")

    def say(self, *lines: str) -> None:
        """Type."""
        assert self.process.stdin is not None
        self.process.stdin.write("".join(f"{line}\n" for line in lines))
        self.process.stdin.flush()

    def memory(self) -> float:
        """What it holds, in KiB; 0 where the system does not tell."""
        status = Path(f"/proc/{self.process.pid}/status")
        text = status.read_text(encoding="utf-8") if status.exists() else "VmRSS: 0"
        return float(text.partition("VmRSS:")[2].split()[0])


@contextmanager
def plc(device: str, trace: Path) -> Iterator[DeskPlc]:
    """Run the soft PLC at a device, allowed to run its motor."""
    program = trace.with_name("desk.st")
    program.write_text(CHF, encoding="utf-8")
    names = ",".join([*(f"Motor.{name}" for name in SHOWN), *(f"Bus.{name}" for name in COUNTERS)])
    words = [str(program), "--port", device, "--allow-run", "--show", names, "--trace", str(trace)]
    command = [sys.executable, "-m", "driveblocks", "run", *words, "--watchdog", "600s"]
    made = DeskPlc(subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True))
    reader = threading.Thread(target=made.read)
    reader.start()
    made.say(f"Motor {UNIT}", "WIRED")
    try:
        yield made
    finally:
        assert made.process.stdin is not None
        made.process.stdin.close()  # the end of the input stops every drive
        made.process.wait()
        reader.join()


@dataclass
class Exchange:
    """What was done, in figures, and what the soft PLC said."""

    figures: dict[str, float]
    lines: list[str]


def wrong_values(motor: Motor, rows: list[dict[str, str]]) -> int:
    """How many values of a trace the motor did not have, or not in this order; and words that it must not get."""
    valid = [round(100 * float(row["Motor.OutputFrequencyHz"])) for row in rows if row[f"Motor.{VALID}"] == "1"]
    held = iter(motor.frequencies)
    seen = [value not in held for value, before in zip(valid, [None, *valid], strict=False) if value != before]
    allowed = {(COMMAND, RUN), (COMMAND, STOP), (COMMAND, JOG_STOP), (REFERENCE, 0), (REFERENCE, 200 * ASKED_HZ)}
    return sum(seen) + len(motor.written - allowed)


def exchange(seconds: float, damage: float) -> Exchange:
    """The soft PLC and pymodbus's server, at least one start and stop and then so long, and the end of both."""
    motor, loss, figures = Motor(), Loss(damage=damage), {"rounds": 0.0, "starts held": 0.0, "lost stops": 0.0}
    with peer("pty", device(motor), carried(loss)) as place, tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "trace.csv"
        with plc(place, trace) as soft:
            soft.stop()
            figures["memory at first"] = soft.memory()
            end = time.monotonic() + seconds
            while not figures["rounds"] or time.monotonic() < end:
                figures["starts held"] += soft.start()
                soft.stop()
                figures["lost stops"] += not motor.stands
                figures["rounds"] += 1
            figures["memory"] = soft.memory()
        rows = list(DictReader(trace.read_text(encoding="utf-8").splitlines()[1:]))
    figures |= {name: float(rows[-1][f"Bus.{name}"]) for name in COUNTERS} | {"damaged": loss.damaged}
    figures |= {"wrong values": wrong_values(motor, rows), "exit status": soft.process.returncode}
    return Exchange(figures, soft.lines)


if __name__ == "__main__":
    done = exchange(float(sys.argv[1]), 0.01)
    print("\n".join([*(f"{name:16} {value:g}" for name, value in done.figures.items()), *done.lines[-4:]]))
