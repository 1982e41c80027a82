"""Reads the words of a drive, and nothing else: in runs, each run that is refused in halves."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from driveblocks.desk.clock import Clock
from driveblocks.desk.port import Port
from driveblocks.desk.run.ask import Asker, Speech
from driveblocks.desk.run.guard import Guard
from driveblocks.desk.site.register import rows, spans
from driveblocks.desk.site.saved import Word
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect, most, read_request
from driveblocks.maps.polls import identity_read
from driveblocks.modbus.layout import reply_size, take
from driveblocks.simulator.pattern import of_condition
from driveblocks.simulator.refusal import codes

TRIES = 5
BUSY_US = 200_000
PAUSE_US = 500_000
LISTEN_US = 1_000_000
SILENT = "no reply"


@dataclass(frozen=True)
class One:
    """A drive that is to be read: its map's name, its map, its unit address."""

    stem: str
    drive: Drive
    unit: int

    @property
    def name(self) -> str:
        """For a person."""
        return f"{self.drive.prefix} at unit {self.unit}"


class LostError(Exception):
    """The drive does not answer any more, or never has."""


class Reads:
    """A port that lets reads pass, and nothing else."""

    def __init__(self, port: Port) -> None:
        """Around that one."""
        self._port, self._guard = port, Guard({})
        self.late_ms, self.receive, self.close = port.late_ms, port.receive, port.close

    @property
    def error(self) -> str:
        """Why the port does not work; empty while it does."""
        return self._port.error

    def send(self, data: bytes) -> None:
        """A read onto the line."""
        if self._guard.passes(data):
            self._port.send(data)


class Reader:
    """Reads one drive; `patience_us`: how long it waits for a drive that has fallen silent."""

    def __init__(self, port: Port, clock: Clock, one: One, speech: Speech, patience_us: int) -> None:
        """On a line that nobody else speaks on."""
        self._port, self._clock, self._drive, self._unit = Reads(port), clock, one.drive, one.unit
        told = one.drive.serial.silence
        silence = int(1000 * told.milliseconds) if told and told.milliseconds else 0
        self._asker = Asker(self._port, clock, replace(speech, silence_us=silence))
        self._most = most(one.drive, "ascii" if speech.ascii_mode else "rtu").read
        self._dialect, self._busy = dialect(one.drive), codes(one.drive)["busy"]
        self._patience_us = patience_us
        self._good: Span | None = None
        """A run that the drive has answered."""

    def read(self, words: dict[int, Word], keep: Callable[[], None], wait: Callable[[str], None]) -> None:
        """Add every word that is missing; `keep` is called after each answer, `wait` while the drive is silent.

        Raises LostError.
        """
        left = spans(self._drive, [row.address for row in rows(self._drive) if row.address not in words], self._most)[
            ::-1
        ]
        while left:
            span = left.pop()
            answer = self._answer(span)
            if answer == SILENT and self._answers(wait):
                answer = self._answer(span)  # the line was lost, or the drive answers all but this
            if isinstance(answer, str) and len(span) > 1:
                middle = span.first + len(span) // 2
                left += [Span(middle, span.last), Span(span.first, middle - 1)]
                continue
            found = dict.fromkeys(span, answer) if isinstance(answer, str) else dict(zip(span, answer, strict=True))
            words.update(found)
            keep()

    def changed(self, words: dict[int, Word]) -> str:
        """Which parameter is not as it was read before; empty where none differs. Raises LostError."""
        again: dict[int, Word] = {
            row.address: "" for row in rows(self._drive) if not row.set or row.address not in words
        }
        left_out = {*again}
        self.read(again, lambda: None, lambda _: None)
        for address in again.keys() - left_out:
            if again[address] != words[address]:
                return f"{address_text(address)} was {words[address]} and is {again[address]}"
        return ""

    def stranger(self) -> str:
        """What shows that the unit is another family's; empty where nothing does. Raises LostError."""
        read = identity_read(self._drive)
        if read is None or self._drive.identity is None:
            return ""
        answer = self._answer(Span(read.address, read.address + read.words - 1))
        if answer == SILENT:
            raise LostError(f"unit {self._unit} does not answer")
        if isinstance(answer, str):
            return f"unit {self._unit} does not give the identity of {self._drive.prefix}: {answer}"
        for pattern in map(of_condition, self._drive.identity.all):
            word = answer[pattern.register - read.address]
            if not pattern.holds(word):
                return f"unit {self._unit} is no {self._drive.prefix}: {address_text(pattern.register)} is {word:04X}H"
        return ""

    def _answers(self, wait: Callable[[str], None]) -> bool:
        """Wait until a run that was answered before is answered again. Raises LostError."""
        begun = self._clock.now_us()
        while self._good is None or self._answer(self._good) == SILENT:
            waited = self._clock.now_us() - begun
            if self._good is None or waited >= self._patience_us:
                raise LostError(self._port.error or f"unit {self._unit} does not answer")
            wait(f"{self._port.error or 'no reply'}; waiting for {(self._patience_us - waited) // 1_000_000} s more")
            self._clock.sleep_until(self._clock.now_us() + PAUSE_US)
        return True

    def _answer(self, span: Span) -> tuple[int, ...] | str:
        """The words of a run; why there are none."""
        body, count = read_request(self._unit, self._drive, span), len(span)
        dialect, size = self._dialect, reply_size(body)
        lengths = [size, 3] + [size + 1] * dialect.two_byte_count + [6] * (dialect.address is not None)
        functions = (body[1] + dialect.added & 0xFF, *([dialect.function] if dialect.function is not None else []))
        answer: tuple[int, ...] | str = SILENT
        for _ in range(TRIES):
            reply = self._asker.ask(body, *lengths, functions=functions)
            found = take(reply, "reply", dialect) if reply else None
            if found is not None and found.refusal:
                answer = f"refused {found.number('reason')}"
                if found.number("reason") == self._busy:
                    self._clock.sleep_until(self._clock.now_us() + BUSY_US)
                    continue
            elif found is not None and (carried := found.values(count)):
                answer = carried
            if answer != SILENT:
                self._good = span
                return answer
        return answer


def heard(port: Port, clock: Clock) -> bool:
    """Whether anybody speaks on a line: another master, whose requests ours would meet."""
    end = clock.now_us() + LISTEN_US
    while clock.now_us() < end:
        if port.receive():
            return True
        clock.sleep_until(clock.now_us() + 2_000)
    return False
