"""One scan of a program: received bytes of each line in, time in, the body, bytes out."""

import sys
from collections import Counter, deque

from driveblocks.desk.port import Port
from driveblocks.desk.run.guard import READS, Guard, is_stop
from driveblocks.desk.run.wiring import DriveBlock, LineWiring, Wiring
from driveblocks.maps.model import Drive
from driveblocks.modbus.envelope import mode_of
from driveblocks.modbus.frame import opened
from structured_text.engines.embedded import EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.embedded.certainty import known

MOST_MS = 65535
PORT_FAILS = 1
"""What PortErrorID shows while the port does not work."""


class Controller:
    """A program at the ports of its lines. Without a guard everything is sent."""

    def __init__(
        self, library: EmbeddedLibrary, program: str, wiring: Wiring, drives: dict[str, Drive], scan_us: int
    ) -> None:
        """Make an instance of the program; its ports come by `connect`."""
        self.instance: EmbeddedInstance = library.instance(program)
        self._library = library
        self.wiring = wiring
        self._drives = drives
        self._scan_us = scan_us
        self.dropped: Counter[str] = Counter()
        """Frames that the guards let not pass."""
        self.lines = tuple(LineEnd(self, each) for each in wiring.lines)
        self._called_ms: int | None = None
        self._begun_us = 0

    def connect(self, port: Port, free: frozenset[tuple[int, str]] | None, *others: Port) -> None:
        """Take a port for each line; `free` are unit and path of the drives that may run on real ones.

        None: they are not real.
        """
        for line, each in zip(self.lines, (port, *others), strict=True):
            line.connect(each, free)

    def receive(self) -> None:
        """Take what has come; before the time of the scan is taken, so that nothing came after it."""
        for each in self.lines:
            each.receive()

    def scan(self, now_us: int) -> None:
        """Scan once. Raises ScanError."""
        for each in self.lines:
            each.give()
        self._time(now_us)
        self.instance.scan((now_us - self._begun_us) * 1000)
        for each in self.lines:
            each.send()

    def _time(self, now_us: int) -> None:
        first = self._called_ms is None
        if first:
            self._begun_us = now_us
        before = (now_us - self._scan_us) // 1000 if self._called_ms is None else self._called_ms
        self._called_ms = now_us // 1000
        for each in self.lines:
            each.set("ELAPSEDMS", min(self._called_ms - before, MOST_MS))
        for path in self.wiring.restart:
            self.instance[path] = first

    def place(self, thread: int | None) -> str:
        """Where the thread that scans is in the program: the innermost place, and the one in the program itself."""
        found = self._library.running(sys._current_frames().get(thread or 0))
        if not found:
            return "outside the program's text"
        at = [f"{each.path}:{each.line}:{each.column} in {each.text}" for each in (found[0], found[-1])]
        return at[0] if len(found) == 1 else f"{at[0]}, called from {at[1]}"

    # ------------------------------------------------------------ drives

    def number(self, path: str) -> int:
        """A whole number of the program."""
        value = self.instance[path]
        return value if isinstance(value, int) else 0

    def unit(self, block: DriveBlock) -> int:
        """The unit address that a drive block uses; 0 before its first call, or where it has none."""
        return self.number(f"{block.path}.Unit.Served")

    def drive(self, block: DriveBlock) -> Drive:
        """The map of a drive block."""
        return self._drives[block.prefix]


class LineEnd:
    """One line of a program, and its port."""

    def __init__(self, program: Controller, wiring: LineWiring) -> None:
        self.wiring = wiring
        self.program = program
        self._mailbox = Mailbox(program.instance, wiring)
        self._port: Port
        self._free: frozenset[tuple[int, str]] | None = None
        self._guard: Guard | None = None
        self._judged: set[tuple[int, str]] = set()
        self.met: set[int] = set()
        """Units that have answered, or to which anything but a read or a stop was sent."""
        self._came: bytes | None = None
        self._said = self._heard = b""
        """What was sent last, and what has come since."""
        self._asked = 0
        """The unit that was asked last."""

    def connect(self, port: Port, free: frozenset[tuple[int, str]] | None) -> None:
        self._port, self._free = port, free
        self.set("PORTLATEMS", port.late_ms)

    def receive(self) -> None:
        """Take what has come."""
        some = self._port.receive()
        self._heard += some
        reply = self._heard.removeprefix(self._said) if some else b""  # without our own echo
        body = opened(mode_of(reply), reply) if reply else None
        if body is not None and body[0] == self._asked:
            self.met.add(self._asked)
        self._came = (self._came or b"") + some

    def give(self) -> None:
        """Hand to the program what has come."""
        if self._came is None:
            self.receive()
        self._mailbox.give(self._came or b"")
        self._came = None
        self.set("PORTERRORID", PORT_FAILS if self._port.error else 0)

    def send(self) -> None:
        """Send what the program wants to, if it may."""
        frame = self._mailbox.take()
        if frame and self._passes(frame):
            self._asked, self._said, self._heard = self._unit_of(frame), frame, b""
            self._port.send(frame)

    def set(self, pin: str, value: int) -> None:
        """Set an input of the line that the port fills."""
        path = self.wiring.pins[pin]
        if path is not None:
            self.program.instance[path] = value

    def number(self, pin: str) -> int:
        """A whole number of the line."""
        return self.program.number(f"{self.wiring.line}.{pin}")

    def units(self) -> dict[int, Drive]:
        """The drive at each unit address; one that two maps claim is nobody's."""
        found: dict[int, Drive] = {}
        doubted: set[int] = {0}
        for block in self.wiring.drives:
            unit, drive = self.program.unit(block), self.program.drive(block)
            if found.setdefault(unit, drive) is not drive:
                doubted.add(unit)
        return {unit: drive for unit, drive in found.items() if unit not in doubted}

    def names(self) -> dict[int, list[str]]:
        """The drive blocks at each unit address."""
        names: dict[int, list[str]] = {}
        for block in self.wiring.drives:
            names.setdefault(self.program.unit(block), []).append(block.path)
        return names

    @property
    def late_ms(self) -> int:
        """How long the program lets its port keep a request and a reply back."""
        path = self.wiring.pins["PORTLATEMS"]
        return self.program.number(path) if path else self.number("PortLateMs")

    def _unit_of(self, frame: bytes) -> int:
        body = opened("ascii", frame) or opened("rtu", frame) or b"\0\0"
        if body[1] not in READS and not is_stop(body, self.units()):
            self.met.add(body[0])
        return body[0]

    def _passes(self, frame: bytes) -> bool:
        if self._free is None:
            return True
        now = {(self.program.unit(block), block.path) for block in self.wiring.drives}
        if self._guard is None or now != self._judged:
            units = self.units()
            strangers = {unit for unit, _ in now - self._free}
            free = frozenset(unit for unit, _ in now & self._free if unit in units and unit not in strangers)
            self._guard, self._judged = Guard(units, free, self.program.dropped), now
        return self._guard.passes(frame)


MOST_BYTES = 255
"""What a line takes in one scan."""


class Mailbox:
    """Hands received bytes to a program before its scan, and takes what it sends after it."""

    def __init__(self, instance: EmbeddedInstance, wiring: LineWiring) -> None:
        self._instance = instance
        self._wiring = wiring
        self._waiting: deque[int] = deque()

    def give(self, data: bytes) -> None:
        """Put received bytes where the line finds them; what does not fit waits for the next scan."""
        self._waiting.extend(data)
        some = bytes(self._waiting.popleft() for _ in range(min(len(self._waiting), self._room())))
        if self._wiring.port is None:
            self._instance[self._wiring.rx_count] = len(some)
            if some:
                self._instance[self._wiring.rx_chars] = some
            return
        place = self._number(f"{self._wiring.port}.RxIn")
        for byte in some:
            self._instance[f"{self._wiring.port}.Rx[{place % 256}]"] = byte
            place += 1
        self._instance[f"{self._wiring.port}.RxIn"] = place % 256

    def take(self) -> bytes:
        """What the line wants to send now; empty for nothing."""
        if self._wiring.port is None:
            count = self._number(f"{self._wiring.line}.TxCount")
            return self._bytes(self._wiring.tx_chars, count) if count else b""
        port = self._wiring.port
        number, count = self._number(f"{port}.TxNumber"), self._number(f"{port}.TxCount")
        if number == self._number(f"{port}.TxTaken") or not count:
            return b""
        self._instance[f"{port}.TxTaken"] = number
        return self._bytes(f"{port}.Tx", count)

    def _room(self) -> int:
        if self._wiring.port is None:
            return MOST_BYTES
        used = self._number(f"{self._wiring.port}.RxIn") - self._number(f"{self._wiring.port}.RxOut")
        return MOST_BYTES - used % 256

    def _number(self, path: str) -> int:
        return known(self._instance[path], int)

    def _bytes(self, path: str, count: int) -> bytes:
        return bytes(known(self._instance[path], list)[:count])
