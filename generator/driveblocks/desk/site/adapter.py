"""A line at a port of this machine, and a person at its terminal."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from rich.console import RenderableType
from rich.progress import BarColumn, Progress, TextColumn

from driveblocks import console
from driveblocks.desk import port
from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Port
from driveblocks.desk.site.found import Heard, Way
from driveblocks.desk.site.line import CHARACTER_BITS
from driveblocks.desk.site.reader import Reads
from driveblocks.desk.words import LOOPBACK, NO_PORT, is_port

LOOK_US = 500
GAP_US = 20_000
"""A reply has ended when nothing has come for this time; an adapter may hand it over in pieces."""
MOST_US = 1_000_000


class PortLine:
    """A port that lets reads pass, and nothing else; `opened` makes it for a way, and raises OSError or ValueError."""

    def __init__(self, opened: Callable[[Way], Port], clock: Clock) -> None:
        """Not open before the first `tune`."""
        self._opened, self._clock = opened, clock
        self._port: Port | None = None
        self._way: Way | None = None

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

    def close(self) -> None:
        """Give the port back."""
        if self._port is not None:
            self._port.close()
        self._port = self._way = None

    def exchange(self, request: bytes, timeout_us: int, expect: int = 0) -> Heard:
        """As `found.Line` says."""
        if self._port is None or self._way is None:
            raise OSError("no port is open")
        reads = Reads(self._port)
        if request:
            reads.send(request)
        sent = self.now_us() + int(len(request) * self._way.character_us)
        data, first, last = b"", 0, sent
        while True:
            now, some = self.now_us(), reads.receive()
            if reads.error:
                raise OSError(reads.error)
            if some:
                data, last = data + some, now
                first = first or (now if data != request[: len(data)] else 0)
            if _over(data, request, now - sent, now - last, timeout_us) or (expect and len(data) >= expect):
                return Heard(data, max(0, first - sent - int((len(data) > 0) * self._way.character_us)))
            self._clock.sleep_until(now + LOOK_US)


def _over(data: bytes, request: bytes, waited: int, silent: int, timeout_us: int) -> bool:
    """Whether nothing more is waited for."""
    if not data or data == request[: len(data)]:
        return waited >= timeout_us
    return silent >= GAP_US or waited >= timeout_us + MOST_US


class Person:
    """Whoever sits at the terminal."""

    def __init__(self, read: Callable[[str], str]) -> None:
        """`read` prints a text and returns a line; it raises EOFError."""
        self._read, self._screen = read, console.terminal()
        columns = TextColumn("{task.description}"), BarColumn()
        hidden = not self._screen.is_terminal
        self._bar = Progress(*columns, console=self._screen, disable=hidden, transient=True)
        self._task = self._bar.add_task("")
        self._runs = False

    def ask(self, key: str, text: str) -> str:  # noqa: ARG002  (a test answers by it)
        """A question."""
        self._still()
        return self._read(f"{text} ").strip()

    def say(self, what: RenderableType) -> None:
        """A text or a table."""
        self._still()
        console.write(what)

    def progress(self, done: int, total: int, text: str) -> None:
        """A bar while something takes its time."""
        if not self._runs:
            self._bar.start()
            self._runs = True
        self._bar.update(self._task, completed=done, total=total, description=text)

    def _still(self) -> None:
        if self._runs:
            self._bar.stop()
            self._runs = False


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
    if rate is not None and not 300 <= rate <= 1_000_000:
        yield f"--rate {rate} is out of range; write 300 to 1000000 bit/s"
    if form is not None and form.upper() not in CHARACTER_BITS:
        yield f"--format {form} is no format; write one of {', '.join(CHARACTER_BITS)}"
