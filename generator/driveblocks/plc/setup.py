"""From the words of the command line to a run: program, port, drives, what is recorded and shown."""

import difflib
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from driveblocks import console
from driveblocks.host.engine import BuildError, ScanError
from driveblocks.maps import catalog, collection
from driveblocks.maps.collection import Source as Map
from driveblocks.maps.problem import MapError
from driveblocks.plc import demo, live, port, script, source, wiring
from driveblocks.plc.clock import Clock, RealClock, VirtualClock
from driveblocks.plc.controller import Controller
from driveblocks.plc.ending import Ending
from driveblocks.plc.keyboard import Keyboard
from driveblocks.plc.port import Port, WirePort
from driveblocks.plc.record import Timing, Trace
from driveblocks.plc.screen import Lines, LiveTable, Screen
from driveblocks.plc.session import Result, Session
from driveblocks.plc.simulated import Simulation, Wanted
from driveblocks.plc.wire import Wire
from driveblocks.plc.wiring import DriveBlock
from driveblocks.simulator.drive import SimulatedDrive

LOOPBACK = ("", "127.0.0.1", "localhost")
LONGEST_SCAN_US = 60_000_000
SCALES = {
    "output_frequency": "FrequencyScale", "output_current": "CurrentScale", "output_voltage": "VoltageScale",
    "dc_bus_voltage": "DcVoltageScale", "output_power": "PowerScale",
}  # fmt: skip
"""The pin of a drive block that says what the manual does not."""
RECORDED = ("Running", "Fault", "StopConfirmed", "OutputFrequencyHz")
"""Outputs of each drive block that are recorded where nobody names others."""
WIRED = "WIRED"


class Refused(Exception):  # noqa: N818  (bad input is no error of the program)
    """What is wrong with the words of the command line, or with what they name."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """The words of the command line."""

    program: Path | None
    name: str | None = None
    maps: tuple[str, ...] = ()
    simulate: tuple[str, ...] = ()
    tcp: str | None = None
    port: str | None = None
    form: str | None = None
    scan: str = "10ms"
    length: str | None = None
    show: tuple[str, ...] = ()
    script: Path | None = None
    trace: Path | None = None
    picture: Path | None = None
    allow_run: bool = False
    demo: bool = False
    fast: bool = False

    @property
    def loopback(self) -> bool:
        """Whether --tcp names this computer."""
        return self.tcp is not None and self.tcp.rpartition(":")[0] in LOOPBACK

    @property
    def real(self) -> bool:
        """Whether real drives may hear it."""
        return self.port is not None or (self.tcp is not None and not self.loopback)


def _wrong(options: Options) -> Iterator[str]:
    """What does not go together."""
    if (options.program is None) != options.demo:
        yield "--demo brings its own program; leave yours out" if options.demo else "name a program, or write --demo"
    ways = [word for word, given in (("--simulate", options.simulate), ("--tcp", options.tcp), ("--port", options.port)) if given]
    if options.demo:
        ways.insert(0, "--demo")
    if len(ways) > 1:
        yield f"{' and '.join(ways)} exclude each other: drives are simulated, or they are real"
    if options.tcp is not None and not options.tcp.rpartition(":")[2].isdigit():
        yield f"--tcp {options.tcp} is no address; write HOST:PORT"
    if options.allow_run and not options.real:
        yield "--allow-run is for a real port; simulated drives may always run"
    if options.fast and (options.tcp or options.port):
        yield "--fast is for simulated drives; a port has its own time"
    if options.fast and not options.demo and options.length is None:
        yield "--fast needs --for: it would never end"


def _time(word: str, text: str, least: int, most: int) -> int:
    """A time of the command line in microseconds. Raises Refused."""
    try:
        us = script.duration_us(text)
    except ValueError as error:
        raise Refused(f"{word}: {error}") from None
    if not least <= us <= most:
        raise Refused(f"{word} {text} is out of range; write {least / 1e6:g}s to {most / 1e6:g}s")
    return us


class Setup:
    """A run that is ready."""

    def __init__(self, options: Options, keyboard: Keyboard) -> None:
        """Prepare everything, and open the port last. Raises Refused."""
        if wrong := list(_wrong(options)):
            raise Refused("\n".join(wrong))
        self._options = options
        self._keyboard = keyboard
        self._scan_us = _time("--scan", options.scan, 1_000, LONGEST_SCAN_US)
        self._for_us = None if options.length is None else _time("--for", options.length, 1, 10**15)
        self._stack = ExitStack()
        self._path = demo.path() if options.demo else options.program or Path()
        self._maps = _maps(options)
        self._loaded = self._load()
        self._probe = self._probed()
        self._clock: Clock = VirtualClock() if options.fast else RealClock()
        self._demo: demo.Demo | None = None
        try:
            self._session = self._made()
        except BaseException:
            self._stack.close()
            raise

    # ------------------------------------------------------------ program

    def _load(self) -> source.Loaded:
        name = console.name(catalog.shown(self._path))
        try:
            text = self._path.read_text(encoding="utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            why = (error.strerror or str(error)) if isinstance(error, OSError) else "it is not UTF-8; save it as such"
            raise Refused(f"{name}:1:1: cannot be read: {why}") from None
        try:
            return source.load(name, text, self._maps, self._options.name)
        except BuildError as error:
            raise Refused(str(error)) from None

    def _controller(self) -> Controller:
        loaded = self._loaded
        try:
            wired = wiring.find(loaded.program, set(loaded.drives))
        except BuildError as error:
            raise Refused(str(error)) from None
        return Controller(loaded.library, loaded.program.name, wired, loaded.drives, self._scan_us)

    def _probed(self) -> Controller:
        """The program behind one scan without a port: what it says of its line and drives. Raises Refused."""
        probe = self._controller()
        probe.connect(_Nowhere(), None)
        try:
            probe.scan(self._scan_us)
        except ScanError as error:
            raise Refused(str(error)) from None
        return probe

    def _line(self, pin: str) -> int:
        return self._probe.number(f"{self._probe.wiring.line}.{pin}")

    # ------------------------------------------------------------ port

    def _port(self) -> Port:
        """Open the port. Raises Refused."""
        options = self._options
        try:
            if options.port is not None:
                return port.serial_port(options.port, self._line("BitRate"), self._form(), self._clock)
            if options.tcp is not None:
                host, _, number = options.tcp.rpartition(":")
                return port.tcp(host or LOOPBACK[1], int(number), self._clock)
            return self._simulated()
        except ImportError as error:
            raise Refused(f"--port needs pyserial, which does not run here: {error}") from None
        except (OSError, ValueError, OverflowError) as error:
            raise Refused(f"{options.port or options.tcp or 'simulated drives'}: {error}") from None

    def _form(self) -> str:
        """Data bits, parity and stop bits. Raises Refused."""
        if self._options.form is not None:
            form = self._options.form.upper()
            if len(form) != 3 or form[0] not in "78" or form[1] not in "NEO" or form[2] not in "12":
                raise Refused(f"--format {self._options.form} is none; write 8N1, 8E1, 8O1, 8N2 or 7E1")
            return form
        bits = self._line("CharacterBits")
        found = {(10, 0): "8N1", (11, 0): "8E1", (10, 1): "7E1"}.get((bits, self._line("Ascii")))
        if found is None:
            raise Refused(f"CharacterBits = {bits} of {self._probe.wiring.line} leaves the format open; write --format")
        return found

    def _simulated(self) -> Port:
        wanted = self._wanted()
        rate, bits, ascii_mode = self._line("BitRate"), self._line("CharacterBits"), bool(self._line("Ascii"))
        if not (300 <= rate <= 1_000_000 and 8 <= bits <= 12):
            raise Refused(f"{self._probe.wiring.line} has BitRate {rate} and CharacterBits {bits}, which is no line")
        if isinstance(self._clock, VirtualClock) or self._options.demo:
            drives = self._demo_drives() if self._options.demo else [one.made(ascii_mode=ascii_mode) for one in wanted]
            self._drives = drives
            begun = _Since(self._clock)
            return WirePort(Wire(drives, rate, bits, ascii_mode=ascii_mode), begun)
        process = Simulation(wanted, rate, bits, ascii_mode=ascii_mode)
        self._stack.callback(process.close)
        return port.tcp(LOOPBACK[1], process.port, self._clock)

    def _demo_drives(self) -> list[SimulatedDrive]:
        known = {each.drive.prefix: each.drive for each in self._maps}
        return [SimulatedDrive(known[name], unit, demo.HABITS[name]) for name, unit in demo.UNITS.items()]

    def _wanted(self) -> list[Wanted]:
        """The drives to simulate: those that are named, else those of the program. Raises Refused."""
        words = [word for each in self._options.simulate for word in each.replace(",", " ").split()]
        if not words:
            blocks = [block for block in self._probe.wiring.drives if self._probe.unit(block)]
            return [self._set(self._map(block.prefix), self._probe.unit(block)) for block in blocks]
        made: list[Wanted] = []
        for word in words:
            name, _, number = word.partition("@")
            taken = {one.unit for one in made}
            unit = next(each for each in range(1, 249) if each not in taken)
            if number:
                unit = int(number) if number.isdigit() and 1 <= int(number) <= 247 else 0
            if unit == 0 or unit in taken or unit > 247:
                raise Refused(f"--simulate {word}: write DRIVE@UNIT with a unit from 1 to 247 that no other has")
            path = catalog.resolve(name).resolve()
            made.append(self._set(next(each for each in self._maps if each.path.resolve() == path), unit))
        return made

    def _map(self, prefix: str) -> Map:
        return next(each for each in self._maps if each.drive.prefix.upper() == prefix)

    def _set(self, known: Map, unit: int) -> Wanted:
        """A drive to simulate, set as the program says where the manual is silent."""
        mine = [
            block
            for block in self._probe.wiring.drives
            if self._probe.unit(block) == unit and self._probe.drive(block) is known.drive
        ]
        if not mine:
            return Wanted(known.path, unit)
        most = self._real(mine[0], "MaximumHz")
        return Wanted(known.path, unit, round(most) if 1 <= most <= 1000 else 50, tuple(self._scales(known, mine[0])))

    def _scales(self, known: Map, block: DriveBlock) -> Iterator[tuple[int, str]]:
        operation = known.drive.operation
        counts = self._real(block, "ReferenceScale")
        if operation.reference.means == "frequency" and counts > 0:
            yield operation.reference.register, f"{1 / counts:.6f}"
        for measure in operation.measures:
            factor = self._real(block, SCALES[measure.shows])
            if factor > 0:
                yield measure.register, f"{factor:.6f}"

    def _real(self, block: DriveBlock, pin: str) -> float:
        value = self._probe.instance[f"{block.path}.{pin}"]
        return value if isinstance(value, float) else 0.0

    # ------------------------------------------------------------ what may run

    def _allowed(self) -> frozenset[tuple[int, str]] | None:
        """Unit and path of the drives that may run on a real port; None: the port is not real."""
        if not self._options.real:
            return None
        if not self._options.allow_run:
            return frozenset()
        blocks = [(self._probe.unit(block), block.path) for block in self._probe.wiring.drives]
        return frozenset(each for each in blocks if self._let_run(*each))

    def _let_run(self, unit: int, path: str) -> bool:
        if self._ask(f"REAL PORT. To let {path} run, type its name and its unit address: ") != f"{path} {unit}":
            console.write(f"{path} is not let run: reads and stops only")
            return False
        if self._probe.number(f"{path}.WatchdogMs"):
            return True
        question = f"{path} has no watchdog (WatchdogMs is 0): it runs on when this computer fails. Type {WIRED} if a hard stop is wired: "
        if self._ask(question) != WIRED:
            console.write(f"{path} is not let run: reads and stops only")
            return False
        return True

    def _ask(self, question: str) -> str:
        sys.stdout.write(question)
        sys.stdout.flush()
        return (self._keyboard.line() or "").strip()

    # ------------------------------------------------------------ the session

    @property
    def label(self) -> str:
        """Whose port it is."""
        return "REAL PORT" if self._options.real else "SIMULATED"

    def _made(self) -> Session:
        controller = self._controller()
        records = self._recorded(controller)
        settings = self._script(controller)
        opened = self._port()
        self._stack.callback(opened.close)
        controller.connect(opened, self._allowed())
        session = Session(controller, opened, self._clock, Ending(), self._scan_us)
        session.script, session.shown = settings, self._options.show
        session.recorded, session.records = records, [*self._records(records)]
        if self._options.demo:
            self._demo = demo.Demo(session, self._drives[-1])
            session.step = self._demo.step
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

    def _records(self, names: tuple[str, ...]) -> Iterator[Trace | Timing]:
        where = f"{self.label}, {console.name(self._path.name)}"
        try:
            if self._options.trace is not None:
                file = self._stack.enter_context(self._options.trace.open("w", encoding="utf-8", newline=""))
                yield Trace(file, names, where)
            if self._options.picture is not None:
                self._options.picture.touch()
                yield Timing(names, where)
        except OSError as error:
            raise Refused(f"{error.filename}: {error.strerror}") from None

    def _script(self, controller: Controller) -> list[script.Setting]:
        path = self._options.script
        if path is None:
            return []
        try:
            return script.read(console.name(path), path.read_text(encoding="utf-8"), controller.instance)
        except (OSError, UnicodeDecodeError) as error:
            raise Refused(f"{console.name(path)}:1:1: cannot be read: {error}") from None
        except script.ScriptError as error:
            raise Refused(str(error)) from None

    # ------------------------------------------------------------ the run

    def run(self) -> int:
        """Run to the end; the exit status."""
        session, terminal = self._session, console.terminal()
        for note in session.controller.wiring.notes:
            console.write(str(note))
        title = console.name(self._path.name)
        if terminal.is_terminal and not terminal.is_dumb_terminal and not self._options.fast:
            screen: Screen = LiveTable(self._head(), title, real=self._options.real, keys=not self._options.demo)
        else:
            screen = Lines(self.label, brief=self._options.demo)
            screen.say(f"{self._head().removeprefix(self.label)} {title}".strip())
        result = self._fast(screen) if self._options.fast else self._live(screen)
        return self._report(result)

    def _head(self) -> str:
        place = self._options.port or (self._options.tcp if self._options.real else "")
        return f"{self.label} {place}".strip()

    def _live(self, screen: Screen) -> Result:
        person = sys.stdin is not None and sys.stdin.isatty()
        keyboard = None if self._options.demo else self._keyboard
        return live.run(self._session, screen, keyboard, self._for_us, end_of_input=self._options.real or person)

    def _fast(self, screen: Screen) -> Result:
        session = self._session
        step = session.step

        def also(at_us: int) -> None:
            step(at_us)
            live.tell(session, screen)
            if session.view is not None:
                screen.show(session.view)

        session.step = also
        with live.listening(session.ending):
            result = session.run(self._for_us)
        live.tell(session, screen)
        return result

    def _report(self, result: Result) -> int:
        """Say how it went; the exit status."""
        wrong = [self._demo.wrong] if self._demo and self._demo.wrong else []
        for record in self._session.records:
            if isinstance(record, Timing) and self._options.picture is not None:
                self._options.picture.write_text(record.svg(), encoding="utf-8")
        lines = [f"{self.label}  {line}" for line in (*_stands(result), *wrong)]
        lines += [f"not sent {number} times: {what}" for what, number in sorted(self._session.controller.dropped.items())]
        if not self._options.fast:
            lines.append(str(self._session.pace))
        console.write(*lines)
        return 1 if result.crashed or result.unconfirmed or wrong else 0

    def close(self) -> None:
        """Give everything back."""
        self._stack.close()


def _stands(result: Result) -> Iterator[str]:
    if result.stopped:
        yield f"stopped, and standstill read: {', '.join(result.stopped)}"
    for name, why in result.unconfirmed.items():
        yield f"NOT CONFIRMED: {name}: {why}. Go and look"


def _maps(options: Options) -> list[Map]:
    """The shipped maps, and those that are named. Raises Refused."""
    named = [*options.maps, *(word.partition("@")[0] for each in options.simulate for word in each.replace(",", " ").split())]
    try:
        paths = [*catalog.shipped(), *(catalog.resolve(name) for name in named)]
        known = {path.resolve(): path for path in reversed(paths)}
        return collection.read(sorted(known.values(), key=lambda path: path.stem))
    except (catalog.UnknownDrive, MapError) as error:
        raise Refused(str(error)) from None


class _Nowhere:
    """A port at which nobody is."""

    late_ms = 0
    error = ""

    def send(self, data: bytes) -> None:
        pass

    def receive(self) -> bytes:
        return b""

    def close(self) -> None:
        pass


class _Since:
    """A clock whose beginning is now."""

    def __init__(self, clock: Clock) -> None:
        self._clock, self._begun = clock, clock.now_us()
        self.sleep_until: Callable[[int], None] = clock.sleep_until

    def now_us(self) -> int:
        return self._clock.now_us() - self._begun
