"""A run: scans in time, what is set meanwhile, what is seen of it, and its end."""

import os
import queue
import signal
import threading
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from driveblocks.desk.clock import Clock, VirtualClock
from driveblocks.desk.ending import Ending
from driveblocks.desk.keyboard import is_variable, typed
from driveblocks.desk.port import Port
from driveblocks.desk.recorder import Recorder
from driveblocks.desk.run.controller import Controller, LineEnd
from driveblocks.desk.run.gate import Gate, GivenUp
from driveblocks.desk.run.look import look
from driveblocks.desk.run.pace import Pace
from driveblocks.desk.run.play import Plays
from driveblocks.desk.run.stopper import Stop, Stopper, speech
from driveblocks.desk.run.watchdog import Watchdog
from driveblocks.desk.script import Setting
from driveblocks.desk.seen import View
from driveblocks.maps.model import Drive
from structured_text.engines.engine import ScanError

LOOK_US = 200_000
"""Between two looks for the screen."""
WITHIN_US = 10_000_000
"""Time to standstill of a drive whose block does not give it."""
TAKE_US = 65_000_000
"""How long a port that takes nothing is waited for."""
STUCK = "no stop sent: the port takes nothing, a call of the system for it does not come back"

Step = Callable[[int], None]
"""What happens besides before each scan, at the time since the start."""


@dataclass
class Result:
    """How a run has ended."""

    reason: str
    crashed: bool = False
    unconfirmed: dict[str, str] = field(default_factory=dict)
    """Drives whose standstill could not be proved, and why."""
    stopped: tuple[str, ...] = ()


class Session:
    """One run of a program at a port."""

    def __init__(self, controller: Controller, clock: Clock, ending: Ending, scan_us: int) -> None:
        """Prepare; `connect` gives it a port, `run` runs."""
        self.controller = controller
        self.known = controller
        """The program as it says what its drives are before its first scan has ended."""
        self.ending = ending
        self.watchdog = Watchdog()
        self.pace = Pace(scan_us)
        self.typed: queue.SimpleQueue[str] = queue.SimpleQueue()
        """Lines of a person, from another thread; what they do happens between two scans."""
        self.play: Plays | None = None
        """What happens to simulated drives."""
        self.script: Sequence[Setting] = ()
        self.shown: tuple[str, ...] = ()
        self.recorders: list[Recorder] = []
        self.recorded: tuple[str, ...] = ()
        self.steps: list[Step] = []
        """What else is done before each scan, in this order."""
        self.halt: Callable[[], None] = _halt
        """Suspends this process."""
        self.view: View | None = None
        self.told: queue.SimpleQueue[str] = queue.SimpleQueue()
        """What is to be said, each in a line."""
        self.result: Result | None = None
        self.settled: Callable[[Result], None] = lambda _: None
        """Called as soon as it is known how the run has ended."""
        self._clock = clock
        self._gates: tuple[Gate, ...] = ()
        self._over = self._suspending = False
        self._crash = ""
        self._done = 0
        self._begun_us = 0
        self._looked_us = -LOOK_US
        self._seen_drops: set[str] = set()
        self._port_error = ""

    def connect(self, port: Port, free: frozenset[tuple[int, str]] | None, *others: Port) -> None:
        """Take a port for each line; see `Controller.connect`."""
        self._gates = tuple(Gate(each, self._clock) for each in (port, *others))
        self.controller.connect(self._gates[0], free, *self._gates[1:])

    def run(self, for_us: int | None = None) -> Result:
        """Scan in a thread of its own until the end, whatever brings it; then stop every drive from this one."""
        scans = threading.Thread(target=self._scans, args=(for_us,), daemon=True)
        scans.start()
        self.watchdog.watch(self.ending, lambda: self._over)
        if not self._over:
            self._give_up(scans)
        if not self.watchdog.scanning:  # what was typed last, where no scan is left to take it
            self._take(self._clock.now_us() - self._begun_us)
        self.result = self._end()
        self.settled(self.result)
        return self.result

    def _give_up(self, scans: threading.Thread) -> None:
        """Say where the scan is that does not end; the port is taken from it next."""
        place = self.controller.place(scans.ident)
        if self.watchdog.bites:
            limit = f"{self.watchdog.may_us / 1000:g} ms"
            self._crash = f"a scan has not ended within {limit} (--watchdog): it was at {place}"
        elif self.watchdog.scanning:
            self.told.put(f"a scan was given up: it was at {place}")

    # ------------------------------------------------------------ scans

    def _scans(self, for_us: int | None) -> None:
        """Scan until the end. No exception of the program comes out of here."""
        crash = ""
        self._begun_us = self._clock.now_us()
        try:
            self._loop(for_us)
        except GivenUp:
            return
        except ScanError as error:
            crash = str(error)
        except Exception as error:  # whatever happens, the drives are stopped
            crash = f"{type(error).__name__}: {error}"
        self._crash = self._crash or crash
        self._over = True
        self.ending.bell.put(None)

    def _loop(self, for_us: int | None) -> None:
        scan_us = self.pace.scan_us
        due = self._begun_us
        while not self.ending.reason:
            if self._suspending:
                self._suspend()
            start = self._clock.now_us()
            if for_us is not None and start - self._begun_us >= for_us:
                self.ending.ask(f"{for_us / 1e6:g} s are over", alone=True)
                break
            self.watchdog.begin()
            self._scan(start)
            self.watchdog.end()
            done = self._clock.now_us()
            due += scan_us
            due += scan_us * self.pace.add(done - start, done - due)
            self._clock.sleep_until(due)

    def _scan(self, now_us: int) -> None:
        since = now_us - self._begun_us
        instance = self.controller.instance
        while self._done < len(self.script) and self.script[self._done].at_us <= since:
            setting = self.script[self._done]
            instance[setting.name] = setting.value
            self._done += 1
        self._take(since)
        if self.play is not None:
            for says in self.play.due(since):
                self.told.put(f"{since / 1e6:5.1f} s  {says}")
        for step in self.steps:
            step(since)
        self.controller.receive()
        self.controller.scan(self._clock.now_us())
        for each in self._gates:
            each.check()
        self._record(since)
        if since - self._looked_us >= LOOK_US:
            self._looked_us = since
            self.view = look(self.controller, self.shown, since, self._error())
            self._tell()

    def _take(self, since: int) -> None:
        """Do what a person has typed."""
        while not self.typed.empty():
            line, program = " ".join(self.typed.get().split()), self.controller
            try:
                if self.play is not None and not is_variable(line, program.instance) and self.play.takes(line):
                    self.play.typed(line, since)
                else:
                    setting = typed(line, program.wiring.inputs, program.instance)
                    program.instance[setting.name] = setting.value
            except ValueError as error:
                self.told.put(str(error))

    def _record(self, since: int) -> None:
        if self.recorders:
            values = {name: self.controller.instance[name] for name in self.recorded}
            for each in self.recorders:
                each.add(since, values)

    def _tell(self) -> None:
        for what in self.controller.dropped.keys() - self._seen_drops:
            self._seen_drops.add(what)
            self.told.put(f"not sent: {what} (needs --allow-run)")
        if self._error() != self._port_error:
            self._port_error = self._error()
            self.told.put(f"the port does not work: {self._port_error}" if self._port_error else "the port works again")
        for each in self.recorders:
            if news := each.news():
                self.told.put(news)

    def _error(self) -> str:
        return next((each.error for each in self._gates if each.error), "")

    def ask_to_suspend(self) -> None:
        """A person wants this process to be suspended; a signal calls this."""
        self._suspending = True

    def _suspend(self) -> None:
        """Suspend this process between two scans, but not while a motor may run."""
        self._suspending = False
        blocks = self.controller.wiring.drives
        moving = [each.path for each in blocks if not self.controller.instance[f"{each.path}.StopConfirmed"]]
        if moving:
            self.told.put(f"not suspended, since {', '.join(moving)} may run; Ctrl-C stops all and ends")
        else:
            self.halt()

    # ------------------------------------------------------------ the end

    def _end(self) -> Result:
        """Stop every drive; the program has no say any more."""
        taken = [gate.take() for gate in self._gates]
        if self._crash:
            self.ending.reason = self.ending.reason or f"the program has failed: {self._crash}"
        for each in self.recorders:
            each.end()
        controller, told = self.controller if self.pace.scans else self.known, self.told
        again = "" if self.ending.alone else "; Ctrl-C again gives them up"
        told.put(f"{self.ending.reason}: stopping every drive{again}")
        if self._crash not in self.ending.reason:
            told.put(f"the program has failed, too: {self._crash}")
        unconfirmed: dict[str, str] = {}
        stopped: list[str] = []
        lines = [*zip(self._gates, controller.lines, (each.met for each in self.controller.lines), taken, strict=True)]
        for (_, line, *_), found in zip(lines, self._all_stopped(lines), strict=True):
            for unit, why in found.items():
                names = ", ".join(line.names()[unit])
                if why:
                    unconfirmed[f"{names} (unit {unit})"] = why
                else:
                    stopped.append(names)
        return Result(self.ending.reason, bool(self._crash), unconfirmed, tuple(stopped))

    def _all_stopped(self, lines: Sequence[tuple[Gate, LineEnd, Collection[int], bool]]) -> list[dict[int, str]]:
        """Stop the drives of all lines at once; in a time that is only computed, one line after the other."""
        if len(lines) == 1 or isinstance(self._clock, VirtualClock):
            return [self._stopped(*each) for each in lines]
        with ThreadPoolExecutor(len(lines)) as side_by_side:
            return list(side_by_side.map(lambda each: self._stopped(*each), lines))

    def _stopped(self, gate: Gate, line: LineEnd, met: Collection[int], free: bool) -> dict[int, str]:
        """Stop the drives of a line; why each is not proved at standstill, by unit."""
        if not free:
            self.told.put("the port takes nothing yet: the stop waits for it; Ctrl-C ends the waiting")
            free = gate.take(TAKE_US, lambda: self.ending.hurry)
        units, names = line.units(), line.names()
        gate.late_ms = max(gate.late_ms, line.late_ms)
        stops = {unit: self._stop_of(line, unit, drive, met) for unit, drive in units.items()}
        shown = {unit: ", ".join(some) for unit, some in names.items()}
        if free:
            Stopper(gate, self._clock, self.ending, speech(line, units), self.told.put, shown).stop(stops)
        found = {unit: one.why if free else STUCK for unit, one in stops.items()}
        return found | dict.fromkeys(
            names.keys() - units.keys(), "no stop sent: its unit address is not its own, or not known"
        )

    def _stop_of(self, line: LineEnd, unit: int, drive: Drive, met: Collection[int]) -> Stop:
        """A drive that is to be stopped, with the longest time that its blocks give it."""
        program = self.controller if self.pace.scans else self.known
        within = max((program.number(f"{each}.StopWithinMs") for each in line.names().get(unit, ())), default=0)
        return Stop(drive, 1000 * within or WITHIN_US, waited_for=unit in met)


def _halt() -> None:
    os.kill(os.getpid(), signal.SIGSTOP)
