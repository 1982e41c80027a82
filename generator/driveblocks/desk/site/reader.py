"""Reads the words of a drive, and nothing else: in runs, each run that is refused in halves."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from driveblocks.bench.simulator.refusal import codes
from driveblocks.desk.clock import Clock
from driveblocks.desk.exchange import LATE_US, Exchanges, quality
from driveblocks.desk.master import REPEAT_US, Master, Speech
from driveblocks.desk.port import Port
from driveblocks.desk.run.guard import Guard
from driveblocks.desk.site.family import span_of, stranger
from driveblocks.desk.site.register import rows, spans
from driveblocks.desk.site.saved import Word
from driveblocks.maps.form import Span, address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.pair import whole
from driveblocks.maps.plan import most, read_request
from driveblocks.meaning.polls import identity_read, polls
from driveblocks.meaning.serial import serial

PAUSE_US = 500_000
LISTEN_US = 1_000_000
BELIEVED_US = 300_000
"""After a word, as long as a repeater may take to send a reply once more."""
HEARD = 10
"""Exchanges that show whether anybody else answers."""
STRAYS = "two units with one address, a repeater, another master, or a gateway that is slower than 1.5 s"
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


class StraysError(LostError):
    """Replies come that nobody has asked for: no word can be believed."""


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
    """Reads one drive; `patience_us`: how long it waits for a drive that has fallen silent.

    A word is believed only when so much time has passed after its reply that a reply which nobody had asked for would
    have shown that replies belong to other requests; where one comes, all words of that time are read again.
    """

    def __init__(self, port: Port, clock: Clock, one: One, speech: Speech, patience_us: int) -> None:
        """On a line that nobody else speaks on."""
        self._clock, self._drive, self._unit = clock, one.drive, one.unit
        said, silence_us = Exchanges({}, one.drive, own=True), int(1000 * serial(one.drive).silence_ms)
        self.master = Master(Reads(port), clock, replace(speech, silence_us=silence_us), said)
        self._most = most(one.drive, speech.mode).read
        self._busy = codes(one.drive)["busy"]
        self._patience_us = patience_us
        self._good = span_of(identity_read(one.drive) or polls(one.drive)[0])
        """A run that the drive answers."""
        self._asked = 0
        """Words of the last run that was asked for."""
        self._fresh: list[tuple[int, Span, dict[int, Word]]] = []
        """What is not believed yet: when it came, its run and its words."""
        self._strays = 0
        self.again = Counter[Span]()
        """Runs that were read again because of replies that nobody had asked for."""

    def read(self, words: dict[int, Word], keep: Callable[[], None], wait: Callable[[str], None]) -> None:
        """Add every word that is missing; `keep` is called after words were added, `wait` while the drive is silent.

        Raises LostError, and StraysError where replies come that nobody has asked for, again and again.
        """
        missing = [row.address for row in rows(self._drive) if row.address not in words]
        left = spans(self._drive, missing, self._most)[::-1]
        try:
            self._listen(left)
            self._read(left, words, keep, wait)
        except LostError:
            if self.master.strays == self._strays and self._believe(words):
                keep()
            raise

    def _listen(self, left: list[Span]) -> None:
        """Whether a repeater or a second unit answers, too: it does so from the first reply on."""
        quiet = quality(self.master.said).exchanges >= HEARD and not self.master.strays
        for _ in range(2 if left and not quiet else 0):
            if self._answer(self._good) == SILENT:
                return
            self.master.rest(REPEAT_US)
            if self.master.strays == self._strays:
                return
            self._strays = self.master.strays
        if left and not quiet:
            raise StraysError(f"two replies come to each request to unit {self._unit}: {STRAYS}")

    def _read(
        self, left: list[Span], words: dict[int, Word], keep: Callable[[], None], wait: Callable[[str], None]
    ) -> None:
        while left or self._fresh:
            if not left:
                self.master.rest(self._fresh[-1][0] + self._believed_us - self._clock.now_us())
            else:
                left += self._take(self._next(left), wait)
            left += self._strayed()
            if self._believe(words):
                keep()

    @property
    def _believed_us(self) -> int:
        """How long after a word a stray reply would have come."""
        return BELIEVED_US + 2 * self.master.longest_us

    def _next(self, left: list[Span]) -> Span:
        """The next run: not as long as the last one, so that no reply can be taken for the other's."""
        at = next((at for at in range(len(left) - 1, -1, -1) if len(left[at]) != self._asked), None)
        if at is not None:
            return left.pop(at)
        span = left.pop()
        last = whole(self._drive, span.last)[0]
        if last > span.first:
            left.append(Span(last, span.last))
            return Span(span.first, last - 1)
        if len(self._good) != len(span):
            self._answer(self._good)
        return span

    def _take(self, span: Span, wait: Callable[[str], None]) -> list[Span]:
        """Read a run; what is left of it to be read."""
        answer = self._answer(span)
        if answer == SILENT and self._answers(wait):
            answer = self._answer(span)  # the line was lost, or the drive answers all but this
        if isinstance(answer, str) and len(span) > 1:
            middle = span.first + len(span) // 2
            return [Span(middle, span.last), Span(span.first, middle - 1)]
        found = dict.fromkeys(span, answer) if isinstance(answer, str) else dict(zip(span, answer, strict=True))
        self._fresh.append((self._clock.now_us(), span, dict(found)))
        return []

    def _strayed(self) -> list[Span]:
        """The runs that have to be read again, since a reply came that nobody had asked for. Raises StraysError."""
        if self.master.strays == self._strays:
            return []
        self.master.rest(LATE_US)
        self._strays = self.master.strays
        spans = [span for _, span, _ in self._fresh]
        self._fresh = []
        self.again.update(spans)
        if any(count > 1 for count in self.again.values()):
            raise StraysError(f"replies came that nobody had asked for, twice while the same was read: {STRAYS}")
        return spans

    def _believe(self, words: dict[int, Word]) -> bool:
        """Take over what is old enough; whether there was any."""
        until = self._clock.now_us() - self._believed_us
        old = [each for each in self._fresh if each[0] <= until]
        for _, _, found in old:
            words.update(found)
        self._fresh = self._fresh[len(old) :]
        return bool(old)

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

    def stranger(self, others: Mapping[str, Drive]) -> str:
        """What shows that the unit is another family's; empty where nothing does. Raises LostError, StraysError."""
        for _ in range(2):
            strays = self.master.strays
            why = stranger(self.master, self._drive, self._unit, others)
            if not self.master.answered:
                raise LostError(self.master.error or f"unit {self._unit} does not answer")
            if why and self._answer(self._good) != SILENT:  # a second unit would show now, if it has not before
                self.master.rest(REPEAT_US)
            if not why or self.master.strays == strays:
                return why
        raise StraysError(f"the family of unit {self._unit} cannot be judged, for replies unasked for: {STRAYS}")

    def _answers(self, wait: Callable[[str], None]) -> bool:
        """Wait until a run that was answered before is answered again. Raises LostError."""
        begun = self._clock.now_us()
        while self._answer(self._good) == SILENT:
            waited = self._clock.now_us() - begun
            if waited >= self._patience_us:
                raise LostError(self.master.error or f"unit {self._unit} does not answer")
            wait(f"{self.master.error or 'no reply'}; waiting for {(self._patience_us - waited) // 1_000_000} s more")
            self._clock.sleep_until(self._clock.now_us() + PAUSE_US)
        return True

    def _answer(self, span: Span) -> tuple[int, ...] | str:
        """The words of a run; why there are none."""
        self._asked = len(span)
        reply = self.master.patient(read_request(self._unit, self._drive, span), self._busy)
        if not reply.words and reply.refused is None:
            return SILENT
        self._good = span
        return reply.words or f"refused {reply.refused}"


def heard(port: Port, clock: Clock) -> bool:
    """Whether anybody speaks on a line: another master, whose requests ours would meet."""
    end = clock.now_us() + LISTEN_US
    while clock.now_us() < end:
        if port.receive():
            return True
        clock.sleep_until(clock.now_us() + 2_000)
    return False
