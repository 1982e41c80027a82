"""From the words of the command line to a run: program, port, drives, what is recorded and shown."""

import difflib
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from driveblocks import console
from driveblocks.desk import port, recorder, scenario, script
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import Clock, RealClock, VirtualClock
from driveblocks.desk.ending import Ending, listening
from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.port import Port, WirePort
from driveblocks.desk.run import demo, live, probe, source
from driveblocks.desk.run.controller import Controller, LineEnd
from driveblocks.desk.run.departure import Departure
from driveblocks.desk.run.drives import Named, named, of_program, told, words
from driveblocks.desk.run.options import Options
from driveblocks.desk.run.options import wrong as mistakes_of
from driveblocks.desk.run.permission import strangers
from driveblocks.desk.run.picture import Timing
from driveblocks.desk.run.play import Play, Plays
from driveblocks.desk.run.session import Result, Session
from driveblocks.desk.run.simulated import Simulation
from driveblocks.desk.run.watchdog import FIRST_US, LIMIT_US, Watchdog
from driveblocks.desk.screen import Desk, Heading, Lines, LiveTable, Screen
from driveblocks.desk.words import LOOPBACK, opening, time
from driveblocks.maps import catalog
from driveblocks.maps.collection import Source
from driveblocks.maps.problem import Refused
from driveblocks.meaning.serial import USUAL_BITS, USUAL_RATE, delivered
from structured_text import files
from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.engine import Value
from structured_text.visible import file_name

LONGEST_SCAN_US = 60_000_000
USUAL = {"BitRate": USUAL_RATE, "CharacterBits": USUAL_BITS}
"""What a line takes where a pin is 0."""
SHORTEST_WATCHDOG_US, LONGEST_WATCHDOG_US = 10_000, 600_000_000
RECKONED_WATCHDOG_US = 30_000_000
"""With --fast, which keeps no motor waiting; a busy computer must not spoil it."""
LEAVE_S = 1.5
"""How long the process may take to end when it is known whether the drives are at standstill."""
FILES_S = 1.0
"""How much of this its files may take."""
PATIENT = 10
"""With --fast, this many times as long."""
Act = Callable[[scenario.Happening], None]
RECORDED = ("Running", "Fault", "StopConfirmed", "OutputFrequencyHz")
"""Outputs of each drive block that are recorded where nobody names others."""


@dataclass(frozen=True)
class Given:
    """A program that is no file of its own, and what it meets."""

    text: str
    maps: Sequence[Source]
    drives: Mapping[str, Named]
    """To be simulated, by their blocks."""
    inputs: Mapping[str, Value]
    """What they are at first."""
    around: Callable[[EmbeddedInstance], None]
    """What is done to them before each scan."""


class Setup:
    def __init__(self, options: Options, keyboard: Keyboard, given: Given | None = None) -> None:
        """Prepare everything but the port; `keyboard` is what a person types while it runs. Raises Refused."""
        if mistakes := list(mistakes_of(options)):
            raise Refused("\n".join(mistakes))
        self._options = options
        self._keyboard = keyboard
        self._scan_us = time("--scan", options.scan, 1_000, LONGEST_SCAN_US)
        self._for_us = None if options.length is None else time("--for", options.length, 1, 10**15)
        self._watchdog_us = self._limit()
        self._pause = PATIENT if options.fast else 1
        self._departure = Departure(LEAVE_S * self._pause)
        self._stack = ExitStack()
        self._path = demo.path() if options.demo else options.program or Path()
        self._given = given
        with closing(console.Bar(console.terminal())) as bar:
            bar.show(0, 2, "the maps")
            named = [one.name for one in words(options.simulate)]
            self._maps = given.maps if given else source.asked(options.maps, named)
            self._loaded = self._compiled(
                lambda share: bar.show(1 + share, 2, f"compiling {file_name(self._path.name)}")
            )
        self.probe = probe.probed(self._loaded, self._scan_us, max(FIRST_US, self._watchdog_us))
        """The program after one scan, without a port: what `permission` asks a person about."""
        if len(self.probe.lines) > 1 and (options.tcp or options.port):
            names = ", ".join(each.wiring.line for each in self.probe.lines)
            raise Refused(f"{len(self.probe.lines)} lines ({names}): one port can be served; simulate them")
        self._lines: list[list[Named]] = [] if options.tcp or options.port else self._simulates()
        self._clock: Clock = VirtualClock() if options.fast else RealClock()
        self._demo: demo.Demo | None = None
        self._session = self._made()
        self._session.play = self._play()
        self._records()

    def _compiled(self, tell: Callable[[float], None]) -> source.Loaded:
        text = self._given.text if self._given else files.text(self._path)
        return probe.compiled(file_name(catalog.shown(self._path)), text, self._maps, self._options.name, tell)

    def _limit(self) -> int:
        if self._options.watchdog is None:
            return RECKONED_WATCHDOG_US if self._options.fast else LIMIT_US
        return time("--watchdog", self._options.watchdog, SHORTEST_WATCHDOG_US, LONGEST_WATCHDOG_US)

    def _line(self, pin: str) -> int:
        return _number(self.probe.lines[0], pin)

    # ------------------------------------------------------------ port

    def _ports(self) -> list[Port]:
        """Open the port, or those of simulated lines. Raises Refused."""
        options = self._options
        with opening(options.port or options.tcp or "simulated drives"):
            if options.port is not None:
                return [port.serial_port(options.port, self._line("BitRate"), self._form(), self._clock)]
            if options.tcp is not None:
                host, _, number = options.tcp.rpartition(":")
                return [port.tcp(host or LOOPBACK[1], int(number), self._clock)]
            return self._simulated()

    def _form(self) -> str:
        """Data bits, parity and stop bits. Raises Refused."""
        if self._options.form is not None:
            form = self._options.form.upper()
            if len(form) != 3 or form[0] not in "78" or form[1] not in "NEO" or form[2] not in "12":
                raise Refused(f"--format {self._options.form} is no format; write 8N1, 8E1, 8O1, 8N2 or 7E1")
            return form
        bits, is_ascii = self._line("CharacterBits"), self._line("Ascii")
        _, its = delivered(each.drive for each in of_program(self.probe, self._maps))
        found = {(10, 0): "8N1", (11, 0): "8E1", (10, 1): "7E1"}.get((bits, is_ascii))
        if its.bits == bits and (its.data == 7) == bool(is_ascii):
            return its.form
        if found is None:
            raise Refused(f"CharacterBits = {bits} of the line leaves no format; write --format")
        return found

    def _simulates(self) -> list[list[Named]]:
        """The drives of each line: those that are named, else those of the program. Raises Refused."""
        lines = self.probe.lines
        if self._given:
            return [[self._given.drives[block.path] for block in each.wiring.drives] for each in lines]
        if not self._options.simulate:
            return [list(of_program(self.probe, self._maps, each.wiring.drives)) for each in lines]
        if len(lines) > 1:
            raise Refused(f"--simulate is for one line, and this program has {len(lines)}; leave it out")
        return [named(words(self._options.simulate), lambda name: source.meant(name, self._maps), "--simulate ")]

    def _simulated(self) -> list[Port]:
        """A port for each line."""
        made = [self._bus(*each) for each in zip(self.probe.lines, self._lines, strict=True)]
        self._acts([act for _, act in made])
        return [opened for opened, _ in made]

    def _bus(self, line: LineEnd, named: list[Named]) -> tuple[Port, Act]:
        """One line of simulated drives, and how something happens to them."""
        rate, bits, ascii_mode = _number(line, "BitRate"), _number(line, "CharacterBits"), bool(_number(line, "Ascii"))
        if not (300 <= rate <= 1_000_000 and 8 <= bits <= 12):
            raise Refused(f"{line.wiring.line} has BitRate {rate} and CharacterBits {bits}, which is no line")
        if isinstance(self._clock, VirtualClock) or self._options.demo:
            drives = [one.made(ascii_mode=ascii_mode) for one in named]
            if self._options.demo:
                for drive in drives:
                    drive.habits = replace(drive.habits, ramp=demo.RAMP, coast_ramp=demo.COAST)
                self._demo = demo.Demo(self._session, drives[-1])
                self._session.steps.append(self._demo.step)
            bus = Bus(drives, rate, bits, ascii_mode=ascii_mode)
            return WirePort(bus, self._clock), lambda happening: bus.happen(happening.act, self._clock.now_us())
        process = Simulation(named, rate, bits, ascii_mode=ascii_mode)
        self._stack.callback(process.close)
        return port.tcp(LOOPBACK[1], process.port, self._clock), process.happen

    def _play(self) -> Plays | None:
        """What happens to simulated drives; None where nobody can know what they are. Raises Refused."""
        path = self._options.scenario
        if self._options.tcp or self._options.port or self._options.demo:
            return None
        if path and len(self._lines) > 1:
            raise Refused(f"--scenario is for one line, and this program has {len(self._lines)}; type what happens")
        units = [{one.unit: one.drive for one in each} for each in self._lines]
        plays = [Play(each, scenario.read(path, each) if path else ()) for each in units]
        names = {
            block.path: (play, self.probe.unit(block))
            for play, line in zip(plays, self.probe.lines, strict=True)
            for block in line.wiring.drives
        }
        return Plays(plays, names)

    def _acts(self, acts: Sequence[Act]) -> None:
        if self._session.play is not None:
            for play, act in zip(self._session.play.lines, acts, strict=True):
                play.act = act

    # ------------------------------------------------------------ the session

    @property
    def label(self) -> str:
        return "REAL PORT" if self._options.real else "SIMULATED"

    def _made(self) -> Session:
        controller = probe.controller(self._loaded, self._scan_us)
        session = Session(controller, self._clock, Ending(), self._scan_us)
        session.recorded = self._recorded(controller)
        if given := self._given:
            for name, value in given.inputs.items():
                controller.instance[name] = value
            session.steps.append(lambda _: given.around(controller.instance))
        if path := self._options.script:
            session.script = script.read(file_name(path), files.text(path), controller.instance)
        session.shown = self._options.show
        session.known = self.probe
        session.watchdog = Watchdog(self._watchdog_us)
        session.settled = self._settled
        return session

    def _recorded(self, controller: Controller) -> tuple[str, ...]:
        """Names of what is recorded. Raises Refused for names that are none."""
        for name in self._options.show:
            try:
                value = controller.instance[name]
            except KeyError:
                near = difflib.get_close_matches(name.upper(), controller.instance.state(), 3)
                guess = f"; did you mean {', '.join(near)}?" if near else ""
                raise Refused(f"--show: the program has no variable {name}{guess}") from None
            if isinstance(value, list | dict):
                raise Refused(f"--show: {name} has parts; name one of them")
        drives = [f"{block.path}.{pin}" for block in controller.wiring.drives for pin in RECORDED]
        return self._options.show or (*controller.wiring.inputs, *drives)

    def _records(self) -> None:
        """Open what is to be recorded. Raises Refused."""
        where, session, waits = f"{self.label}, {file_name(self._path.name)}", self._session, self._options.fast
        try:
            if path := self._options.trace:
                session.recorders.append(recorder.trace(path, session.recorded, where, waits=waits))
            if path := self._options.picture:
                program = session.controller
                drives = {each.path: program.drive(each) for each in program.wiring.drives}
                timing = Timing(drives, self._options.show or program.wiring.inputs, where)
                session.recorders.append(recorder.picture(path, timing, session.marks, waits=waits))
                session.recorded = tuple(dict.fromkeys((*session.recorded, *timing.needs)))
        except OSError as error:
            raise Refused(f"{file_name(error.filename)}: {error.strerror}") from None

    # ------------------------------------------------------------ the run

    def run(self, free: frozenset[tuple[int, str]] = frozenset()) -> int:
        """Run to the end; the exit status. Raises Refused if the port cannot be opened.

        `free` are unit and path of the drives that may run on a real port.
        """
        try:
            return self._run(free)
        finally:
            self._departure.done.set()

    def _run(self, free: frozenset[tuple[int, str]]) -> int:
        suspend = self._session.ask_to_suspend if self._options.real else None
        self._session.ending.alone = sys.stdin is None or not sys.stdin.isatty()
        with self._stack, listening(self._session.ending, suspend):
            opened = self._ports()
            for each in opened:
                self._stack.callback(each.close)
            units = {unit for unit, _ in free} if self._options.real else set()
            if wrong := strangers(self.probe.lines[0], opened[0], self._clock, units, self._maps):
                raise Refused("\n".join(wrong))
            self._session.connect(opened[0], free if self._options.real else None, *opened[1:])
            for note in chain.from_iterable(each.notes for each in self._session.controller.wiring.lines):
                console.write(str(note))
            if self._options.real and self._options.loopback and not free:
                self._session.told.put("only reads and stops are sent; if a simulator is there, add --simulated")
            for text in told(list(chain.from_iterable(self._lines))):
                self._session.told.put(text)
            screen = self._screen()
            return self._report(self._fast(screen) if self._options.fast else self._live(screen))

    def _screen(self) -> Screen:
        terminal, title = console.terminal(), file_name(self._path.name)
        drawn = terminal.is_terminal and not terminal.is_dumb_terminal and not terminal.legacy_windows
        if drawn and not self._options.fast:
            heading = Heading(self._head(), title, self._options.real)
            return LiveTable(heading) if self._options.demo else Desk(heading)
        screen = Lines(self.label, brief=self._options.demo)
        screen.say(f"{self._head().removeprefix(self.label)} {title}".strip())
        return screen

    def _head(self) -> str:
        place = self._options.port or self._options.tcp or ""
        return f"{self.label} {place}".strip()

    def _live(self, screen: Screen) -> Result:
        keyboard = None if self._options.demo else self._keyboard
        ends = self._options.real or not self._session.ending.alone
        return live.run(self._session, screen, keyboard, self._for_us, end_of_input=ends)

    def _fast(self, screen: Screen) -> Result:
        session = self._session

        def shown(_: int) -> None:
            try:
                live.tell(session, screen)
                if session.view is not None:
                    screen.show(session.view)
            except (OSError, ValueError) as error:
                session.ending.ask(f"the screen has failed: {error}", alone=True)

        session.steps.append(shown)
        result = session.run(self._for_us)
        with suppress(OSError, ValueError):
            live.tell(session, screen)
        return result

    def _settled(self, result: Result) -> None:
        """It is known how the run has ended: from now on nothing may take long."""
        self._departure.begin(self._status(result), f"{self.label}  {result.reason}\n{self._verdict(result)}")

    def _verdict(self, result: Result) -> str:
        """Which drives are at standstill, and which perhaps are not."""
        return "".join(f"{self.label}  {line}\n" for line in (*_stands(result), *self._untrue()))

    def _untrue(self) -> list[str]:
        return [self._demo.wrong] if self._demo and self._demo.wrong else []

    def _status(self, result: Result) -> int:
        return 1 if result.crashed or result.unconfirmed or self._untrue() else 0

    def _report(self, result: Result) -> int:
        """Say how it went, first whether the drives are at standstill; the exit status."""
        _print(self._verdict(result))
        self._departure.printed = True
        dropped = sorted(self._session.controller.dropped.items())
        lines = [f"not sent {number} times: {what}" for what, number in dropped]
        if not self._options.fast:
            lines.append(str(self._session.pace))
        files = [each.finish(FILES_S * self._pause / 2) for each in self._session.recorders]
        _print("".join(f"{line}\n" for line in (*lines, *filter(None, files))))
        failed = any(each.failed for each in self._session.recorders)
        return self._status(result) or (2 if failed else 0)


def _print(text: str) -> None:
    """On standard output, else on the other stream."""
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except (OSError, ValueError):
        console.give_up_output()
        with suppress(OSError, ValueError):
            sys.stderr.write(text)


def _stands(result: Result) -> Iterator[str]:
    if result.stopped:
        yield f"stopped, and standstill read: {', '.join(result.stopped)}"
    for name, why in result.unconfirmed.items():
        yield f"NOT CONFIRMED: {name}: {why}. Go and look"


def _number(line: LineEnd, pin: str) -> int:
    """A pin of a line, and what the line takes where it is 0."""
    return line.number(pin) or USUAL.get(pin, 0)
