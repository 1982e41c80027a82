"""A line at a port of this machine, and a person at its terminal."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from rich.console import RenderableType

from driveblocks import console
from driveblocks.desk import port
from driveblocks.desk.clock import Clock
from driveblocks.desk.exchange import Exchanges
from driveblocks.desk.frames import QUIET_US
from driveblocks.desk.master import Master, Speech
from driveblocks.desk.port import Port
from driveblocks.desk.site.found import Way
from driveblocks.desk.site.reader import Reads
from driveblocks.desk.words import LOOPBACK, NO_PORT, is_port, wrong_speech

LOOK_US = 500
MOST_US = 1_000_000


class PortLine:
    """A port that lets reads pass, and nothing else; `opened` makes it for a way, and raises OSError or ValueError."""

    def __init__(self, opened: Callable[[Way], Port], clock: Clock) -> None:
        """Not open before the first `tune`."""
        self._opened, self._clock = opened, clock
        self._port: Port | None = None
        self._way: Way | None = None
        self._master: Master | None = None
        self._said = Exchanges({}, own=True)
        """Everything that was said, at whatever rate."""

    def now_us(self) -> int:
        """The machine's time."""
        return self._clock.now_us()

    def tune(self, way: Way) -> bool:
        """Open the port for a way; whether it can. Raises OSError for a port that is not there at all."""
        if self._way is not None and replace(way, mode=self._way.mode) == self._way:
            self._way = way  # the same port carries both framings
            return True
        self.close()
        return port.takes(lambda: self._open(way))

    def _open(self, way: Way) -> None:
        self._port, self._way = self._opened(way), way
        self._master = None

    def close(self) -> None:
        """Give the port back."""
        if self._port is not None:
            self._port.close()
        self._port = self._way = self._master = None

    @property
    def master(self) -> Master:
        """As `found.Line` says."""
        port = self._working()
        if self._way is None:
            raise OSError("no port is open")
        speech = Speech(self._way.mode, self._way.character_us)
        if self._master is None:
            self._master = Master(Reads(port), self._clock, speech, self._said)
        self._master.speech = speech
        return self._master

    def _working(self) -> Port:
        if self._port is None:
            raise OSError("no port is open")
        if self._port.error:
            raise OSError(self._port.error)
        return self._port

    def hear(self, for_us: int) -> bytes:
        """As `found.Line` says."""
        port, data = self._working(), b""
        begun = last = self.now_us()
        while True:
            now, some = self.now_us(), port.receive()
            self._working()
            if some:
                data, last = data + some, now
            if now >= begun + for_us and (not data or now >= begun + for_us + MOST_US):
                return data
            if data and now - last >= QUIET_US:
                return data
            self._clock.sleep_until(now + LOOK_US)


class Person:
    """Whoever sits at the terminal."""

    def __init__(self, read: Callable[[str], str]) -> None:
        """`read` prints a text and returns a line; it raises EOFError."""
        self._read, self._bar = read, console.Bar(console.terminal())
        self.progress = self._bar.show

    def ask(self, key: str, text: str) -> str:  # noqa: ARG002  (a test answers by it)
        """A question."""
        self._bar.close()
        return self._read(f"{text} ").strip()

    def say(self, what: RenderableType) -> None:
        """A text or a table."""
        self._bar.close()
        console.write(what)


def at(name: str | None, address: str | None, clock: Clock) -> Callable[[Way], Port]:
    """What opens a serial port, or a TCP address whose server has a rate and format of its own."""

    def opened(way: Way) -> Port:
        if name is not None:
            return port.serial_port(name, way.rate, way.form, clock)
        return port.tcp(*host_and_port(address), clock)

    return opened


def host_and_port(address: str | None) -> tuple[str, int]:
    """The two sides of a TCP address; without a host, this machine."""
    host, _, number = (address or "").rpartition(":")
    return host or LOOPBACK[1], int(number)


def wrong(name: str | None, address: str | None, rate: int | None, form: str | None, *, who: str) -> Iterator[str]:
    """What is wrong with the words that say where `who` is, and how it speaks."""
    if (name is None) == (address is None):
        yield f"name the port of {who}, by --port or by --tcp"
    if name == "":
        yield NO_PORT
    if address is not None and not is_port(address.rpartition(":")[2]):
        yield f"--tcp {address} is no address; write HOST:PORT, with a port of 1 to 65535"
    yield from wrong_speech(rate, form)
