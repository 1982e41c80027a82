"""From the words of the command line to drives on a line."""

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from driveblocks import console
from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk import scenario
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import Clock, RealClock
from driveblocks.desk.ending import Ending, listening
from driveblocks.desk.explain.trace import Tracer
from driveblocks.desk.port import Port, serial_port
from driveblocks.desk.run.drives import named
from driveblocks.desk.run.drives import words as drives_of
from driveblocks.desk.run.play import Play
from driveblocks.desk.screen import Heading, Lines, LiveTable, Screen
from driveblocks.desk.seen import Seen, View
from driveblocks.desk.simulate.link import HOST, PtyLink, TcpLink, WithoutEcho
from driveblocks.desk.simulate.neighbour import Neighbours
from driveblocks.desk.words import LOOPBACK, NO_PORT, opening, time
from driveblocks.maps.load import named as map_of
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.meaning.serial import character, delivered

LOOK_US = 200_000
"""Between two looks for the screen."""
TICK_US = 1_000


class Stand:
    """Drives on a bus, and a link to a master."""

    def __init__(self, bus: Bus, link: Port, clock: Clock, ending: Ending, play: Play | None = None) -> None:
        self.bus, self.link = bus, link
        self._clock, self._ending = clock, ending
        self._play = play or Play({})
        self._play.act = lambda happening: happening.act(bus.drives, bus.loss)

    def run(self, say: Callable[[str], None], look: Callable[[int], None], for_us: int | None = None) -> None:
        """Serve until the end; `say` takes what happens, `look` the time every now and then."""
        begun = self._clock.now_us()
        looked, error = -LOOK_US, ""
        while not self._ending.reason:
            now = self._clock.now_us() - begun
            if for_us is not None and now >= for_us:
                self._ending.ask(f"{for_us / 1e6:g} s are over")
            for says in self._play.due(now):
                say(f"{now / 1e6:5.1f} s  {says}")
            self._pass_bytes(now)
            if now - looked >= LOOK_US:
                looked = now
                if self.link.error != error:
                    error = self.link.error
                    say(f"the port does not work: {error}" if error else "the port works again")
                look(now)
            self._clock.sleep_until(begun + now + TICK_US)

    def _pass_bytes(self, now_us: int) -> None:
        data = self.link.receive()
        if data:
            self.bus.send(data, now_us)
        reply = self.bus.receive(now_us)
        if reply:
            self.link.send(reply)


def view(bus: Bus, maps: Mapping[int, Drive], at_us: int, *, counted: bool) -> View:
    """How the drives are; `counted`: with what the line has seen."""
    drives = tuple(_seen(drive, maps[drive.unit], bus) for drive in bus.drives)
    loss = bus.loss
    line = {"frames lost": loss.dropped, "damaged": loss.damaged, "characters not understood": bus.strange}
    return View(at_us, drives, dict(line) if counted else {}, {})


def _seen(drive: SimulatedDrive, known: Drive, bus: Bus) -> Seen:
    counts = bus.counts[drive.unit]
    told = f"{counts.heard} requests heard, {counts.replied} answered, {counts.refused} of them refused"
    state, most = _state(drive, known), float(drive.habits.maximum_hz)
    return Seen(known.prefix, drive.unit, state, drive.asked_hertz, drive.hertz, told, most_hz=most)


def _state(drive: SimulatedDrive, known: Drive) -> str:
    if not drive.powered:
        return "no power"
    if drive.fault:
        names = {each.code: each.id or each.name for each in known.faults.codes}
        return f"fault {drive.fault} {names.get(drive.fault) or ''}".strip()
    warnings = known.warning_codes
    return f"{drive.mode}, warning {warnings[0].id or warnings[0].name}" if drive.warning and warnings else drive.mode


LABEL = "SIMULATED"
TCP = 5020
_FORM = re.compile(r"[78][NEO][12]")


@dataclass(frozen=True, kw_only=True)
class Words:
    drives: Sequence[str]
    port: str | None = None
    tcp: str | None = None
    pty: bool = False
    baud: int | None = None
    """None: that of the drives as delivered."""
    form: str | None = None
    """As people write it; None: that of the drives as delivered."""
    ascii: bool = False
    scenario: Path | None = None
    frames: bool = False
    length: str | None = None


class Setup:
    """Drives that are ready to be put on a line."""

    def __init__(self, words: Words) -> None:
        """Judge the words. Raises Refused with all that is wrong with them."""
        self._words = words
        if mistakes := list(self._wrong()):
            raise Refused("\n".join(mistakes))
        self._for_us = None if words.length is None else time("--for", words.length, 1, 10**15)
        self._clock, self._ending = RealClock(), Ending()
        wanted = named(drives_of(words.drives), map_of)
        self.maps = {one.unit: one.drive for one in wanted}
        self._play = Play(self.maps, scenario.read(words.scenario, self.maps) if words.scenario else ())
        drives = [one.made(ascii_mode=words.ascii) for one in wanted]
        self._settings = [line for one in wanted for line in (*one.told(), *one.unwritten())]
        rate, its = delivered(self.maps.values())
        self._rate, self._its = words.baud or rate, character(words.form) if words.form else its
        self._bus = Bus(drives, self._rate, self._its.bits, ascii_mode=words.ascii)
        self._tracer = Tracer(self.maps)

    def _wrong(self) -> list[str]:
        words, found = self._words, []
        ways = [name for name, given in (("--port", words.port), ("--tcp", words.tcp), ("--pty", words.pty)) if given]
        if len(ways) > 1:
            found.append(f"{' and '.join(ways)} exclude each other; name one place for the master")
        host, colon, number = (words.tcp or "").rpartition(":")
        good = colon and host in LOOPBACK and re.fullmatch("[0-9]{1,5}", number) and int(number) <= 0xFFFF
        if words.tcp is not None and not good:
            found.append(f"--tcp {words.tcp}: a simulator serves this computer only; write --tcp {HOST}:{TCP}")
        if words.port == "":
            found.append(NO_PORT)
        if words.baud is not None and not 300 <= words.baud <= 1_000_000:
            found.append(f"--baud {words.baud} is no rate; write 300 to 1000000")
        if words.form and not _FORM.fullmatch(words.form.upper()):
            found.append(f"--format {words.form} is no format; write 8N1, 8E1, 8O1, 8N2 or 7E1")
        return found

    # ------------------------------------------------------------ the run

    def run(self) -> None:
        """Serve until the end. Raises Refused if the line cannot be had."""
        with ExitStack() as stack, listening(self._ending):
            link, place = self._link()
            stack.callback(link.close)
            if self._words.port is not None:
                link = self._alone(link)
            screen = self._screen(place)
            stack.callback(screen.close)
            for line in (self._told(place), *self._settings):
                self._sayer(screen)(line)
            Stand(self._bus, link, self._clock, self._ending, self._play).run(
                self._sayer(screen), self._looker(screen), self._for_us
            )
            self._looker(screen)(self._clock.now_us() - self._begun_us)
        console.write(*(f"{LABEL}  {line}" for line in (self._ending.reason, *self._summary())))

    def _link(self) -> tuple[Port, str]:
        words = self._words
        place = words.port or ("--pty" if words.pty else words.tcp or f"{HOST}:{TCP}")
        with opening(place, "; name another place by --tcp, --pty or --port"):
            if words.port is not None:
                return serial_port(words.port, self._rate, self._its.form, self._clock), words.port
            link = PtyLink() if words.pty else TcpLink(int(place.rpartition(":")[2]))
            return link, link.place

    def _alone(self, link: Port) -> Port:
        """The real port, when no real unit is there. Raises Refused."""
        neighbours = Neighbours(link, self._clock, self.maps, ascii_mode=self._words.ascii)
        why = neighbours.found(lambda text: console.write(f"{LABEL} on REAL PORT {self._words.port}  {text}"))
        if why:
            raise Refused(f"{self._words.port}: {why}")
        return WithoutEcho(link) if neighbours.echo else link

    def _screen(self, place: str) -> Screen:
        terminal = console.terminal()
        self._begun_us = self._clock.now_us()
        if terminal.is_terminal and not terminal.is_dumb_terminal:
            title = f"REAL PORT {place}" if self._words.port is not None else place
            return LiveTable(Heading(LABEL, title, real=self._words.port is not None))
        return Lines(LABEL, brief=True)

    def _told(self, place: str) -> str:
        words = self._words
        drives = ", ".join(f"{drive.prefix} at unit {unit}" for unit, drive in self.maps.items())
        real = "REAL PORT " if words.port is not None else ""
        mode = "ASCII" if words.ascii else "RTU"
        return f"{drives}; MODBUS {mode}, {self._rate} bit/s {self._its.form}, on {real}{place}; Ctrl-C ends"

    def _sayer(self, screen: Screen) -> Callable[[str], None]:
        head = "" if isinstance(screen, Lines) else f"{LABEL}  "
        return lambda text: screen.say(f"{head}{text}")

    def _looker(self, screen: Screen) -> Callable[[int], None]:
        say = self._sayer(screen)

        def look(at_us: int) -> None:
            while self._bus.frames:
                frame = self._bus.frames.popleft()
                for line in self._tracer.lines(frame) if self._words.frames else ():
                    say(line)
            screen.show(view(self._bus, self.maps, at_us, counted=isinstance(screen, LiveTable)))

        return look

    def _summary(self) -> list[str]:
        bus, loss = self._bus, self._bus.loss
        lines = [
            f"{drive.prefix} at unit {unit}: {bus.counts[unit].heard} requests, {bus.counts[unit].replied} replies, "
            f"{bus.counts[unit].refused} of them refusals"
            for unit, drive in self.maps.items()
        ]
        return [*lines, f"{loss.dropped} frames lost, {loss.damaged} damaged, {bus.strange} characters not understood"]
