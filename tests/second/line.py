"""Drive blocks on a line with simulated drives, in virtual time (microseconds inside, milliseconds outside).

`Bench` knows pins and frames only: it sets inputs, reads outputs, carries frames between the line and the drives, and
breaks what can break on a wire. Characters are the business of tests/line; here a reply comes as a whole, when its last
character is there.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from random import Random

from tests.line.vline import opened, sealed
from tests.second.station import IN_SEEN, PINS, maps, name_of, simulated

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.revision import checked
from driveblocks.render.reasons import REASONS
from structured_text.engines.engine import Library, Value

REASON = {each.code: each.name for each in REASONS}
RING = 255
"""Characters that the port holds between two scans."""
RUNS = ("RunForward", "RunReverse", "JogForward", "JogReverse")
MEMBERS = {
    "Settings": {
        "TurnRoundMs", "LongestMs", "BootMs", "WatchdogMs", "RefreshMs", "FollowWithinMs", "StaleMs", "KeepWord",
        "ReferenceScale", "FrequencyScale", "CurrentScale", "VoltageScale", "DcVoltageScale", "PowerScale",
    },
    "Diagnosis": {
        "State", "StopReason", "StopKind", "CommandNotFollowed", "ReferenceLimited", "StatusAgeMs", "MeasuresAgeMs",
        "LongestReplyMs", "StopAloneMs", "WorstStopMs", "FirstStopMs", "IdentityRead", "IdentityWanted", "OwnMaximumHz",
        "OutputVoltageV", "DcBusVoltageV", "OutputPowerKW",
        "CanReverse", "CanJog", "CanQuickStop", "CanCoastStop", "CanResetFault",
        *(f"{each}Valid" for each in (
            "OutputFrequency", "OutputCurrent", "OutputVoltage", "DcBusVoltage", "OutputPower"
        )),
        *(f"FirstFault{each}" for each in ("Code", "Hz", "A", "V", "State", "Ms")),
        *(f"FaultBack{each}" for each in range(1, 9)),
    },
}  # fmt: skip
"""What lies in a structure of the drive block."""
OFF = 65535
"""Off, in a setting."""
LAST_READ = 4
"""Function codes up to this one read."""
PLACE = {name: 16 + place for place, name in enumerate(PINS)}
"""Bits of `Seen` for the first drive."""
SETTINGS = {
    "Enable": True,
    "SpeedReferenceHz": 25.0,
    "MaximumHz": 50.0,
    "FullScaleHz": 50.0,
    "TurnRoundMs": 20,
    "LongestMs": 60,
    "StopWithinMs": 9000,
    "ReferenceScale": 100.0,
    "FrequencyScale": 0.01,
    "DcVoltageScale": 0.01,
}
"""Pins of a drive that is ready to start. The scales are those of the simulated drives."""


@cache
def path(drive: int, name: str) -> str:
    """Where a pin of a drive block, or a member of its structures, is in a station."""
    inside = next((f"{where}.{name}" for where, names in MEMBERS.items() if name in names), name)
    return f"Drive{drive}.{inside}"


_sealed, _opened = lru_cache(4096)(sealed), lru_cache(4096)(opened)


@dataclass(frozen=True)
class Faults:
    """What goes wrong on the wire, in frames per 1000."""

    lost: int = 0
    unanswered: int = 0
    garbled: int = 0
    truncated: int = 0
    late: int = 0
    twice: int = 0


@dataclass(frozen=True)
class Frame:
    """A request on the wire: when it began, and what it asks; `word` is the first one written, or the quantity read."""

    ms: int
    unit: int
    function: int
    address: int
    word: int
    data: bytes = b""
    """All of it, without checksum."""

    @property
    def read(self) -> bool:
        """Whether it reads, words or bits."""
        return self.function <= LAST_READ


@dataclass(frozen=True)
class Heard:
    """Something on its way to the line: when its last character is there, and what it answers, if it is whole."""

    at: int
    begins: int
    text: bytes
    frame: Frame | None


class Bench:
    """A station and what hangs on its wire. `ms` is the time between two scans."""

    def __init__(
        self,
        *types: str,
        seed: int = 0,
        ms: int = 20,
        ascii_: bool = False,
        stations: Library | None = None,
        habits: Habits | None = None,
        start: bool = True,
    ) -> None:
        """Power up: the first scan is the PLC's first."""
        self.types: Sequence[str] = types or ("CHF",)
        self.block = (stations or simulated()).instance(name_of(self.types))
        self.maps = [maps()[kind] for kind in self.types]
        self.drives = self.simulated(habits or Habits(), ascii_)
        self.now, self.ms, self.rate, self.ascii = 0, ms, 19200, ascii_
        self.chance = Random(seed)
        self.faults = Faults()
        self.deaf: set[int] = set()
        self.echo = False
        self.spoil: Callable[[Frame, bytes | None], bytes | None] = lambda _, reply: reply
        self.frames: list[Frame] = []
        self.acknowledged: list[Frame] = []
        self.pins: list[dict[str, Value]] = [{} for _ in self.types]
        self.line_pins: dict[str, Value] = {}
        self.seen = self.changes = 0
        self.watch: list[Callable[[Bench], None]] = []
        self._wire: list[Heard] = []
        self._free = 0
        self.elapsed = 0
        self._tx = 0
        self.line(BitRate=self.rate, Ascii=ascii_, MaxScanMs=25)
        self.block["Port.KeepsSilence"] = True
        for index in range(len(self.types)):
            self.put(index, Address=index + 1, ManualChecked=checked(self.maps[index]), **SETTINGS)
        if start:
            self.restart()

    def simulated(self, habits: Habits, ascii_: bool) -> list[SimulatedDrive]:
        """What hangs on the wire."""
        return [
            SimulatedDrive(drive, index + 1, replace(habits, bus_volts=540 + index), ascii_mode=ascii_)
            for index, drive in enumerate(self.maps)
        ]

    # ------------------------------------------------------------ pins

    def put(self, drive: int = 0, /, **pins: Value) -> "Bench":
        """Set inputs of a drive block."""
        for name, value in pins.items():
            self.block[path(drive, name)] = value
            self.pins[drive][name] = value
        self.changes += 1
        return self

    def line(self, **pins: Value) -> "Bench":
        """Set inputs of the line."""
        for name, value in pins.items():
            self.block[f"TheLine.{name}"] = value
            self.line_pins[name] = value
        self.changes += 1
        return self

    def leave(self, what: str, *, on: bool = True) -> "Bench":
        """Call a block no longer, `SkipLine` or `Skip0`, or again."""
        self.block[what] = on
        self.changes += 1
        return self

    def out(self, name: str, drive: int = 0) -> Value:
        """An output of a drive block."""
        return self.block[path(drive, name)]

    def number(self, name: str, drive: int = 0) -> float:
        """The same as a number."""
        value = self.out(name, drive)
        assert isinstance(value, (int, float))
        return value

    def shows(self, name: str, drive: int = 0) -> bool:
        """An output that `Seen` holds, as it was at the end of the last scan."""
        return bool(self.seen >> (PLACE[name] + 8 * drive) & 1)

    def reason(self, drive: int = 0) -> str:
        """Why it does not run."""
        code = self.out("Reason", drive)
        assert isinstance(code, int)
        return REASON[code]

    # ------------------------------------------------------------ time

    def restart(self) -> "Bench":
        """The first scan of a PLC program."""
        self.line(Restart=True)
        self.scan()
        self.line(Restart=False)
        return self

    def run(self, ms: int) -> list[Frame]:
        """Scan for so long; the frames that were sent."""
        before, end = len(self.frames), self.now + 1000 * ms
        while self.now < end:
            self.scan()
        return self.frames[before:]

    def wait(self, ms: int) -> list[Frame]:
        """Scan for so long, a fifth as often, where nothing is to happen but time: blocks count what was measured."""
        usual, most = self.ms, self.line_pins["MaxScanMs"]
        self.ms = 5 * usual
        self.line(MaxScanMs=self.ms)
        frames = self.run(ms)
        self.ms = usual
        self.line(MaxScanMs=most)
        return frames

    def until(self, test: Callable[[], object], ms: int = 5000) -> "Bench":
        """Scan until something is so; it must be within a time."""
        end = self.now + 1000 * ms
        while not test():
            assert self.now < end, f"not within {ms} ms; {self.told()}"
            self.scan()
        return self

    def scan(self, ms: int | None = None) -> None:
        """One scan: what has come, the blocks, what is to be sent."""
        ms = self.ms if ms is None else ms
        self.now += 1000 * ms
        for drive in self.drives:
            drive.step(ms)
        if self._wire and self._wire[0].at <= self.now:
            self._receive()
        if ms != self.elapsed:
            self.block["ElapsedMs"] = self.elapsed = ms
        self.block.scan()
        seen, more = self.block["Seen"], self.block["More"]
        assert isinstance(seen, int)
        assert isinstance(more, int)
        self.seen = seen | more << (16 + 8 * IN_SEEN)
        if seen & 0xFFFF != self._tx:
            self._tx = seen & 0xFFFF
            self._send()
        for each in self.watch:
            each(self)

    def told(self) -> str:
        """What the blocks show, for messages."""
        drives = range(len(self.types))
        pins = [" ".join([pin for pin in PINS if self.shows(pin, i)] + [self.reason(i)]) for i in drives]
        states = [f"State {self.out('Control.State', i)!r}, drive {self.drives[i].mode}" for i in drives]
        shown = [f"{pin}, {state}" for pin, state in zip(pins, states, strict=True)]
        return f"{self.now // 1000} ms: {'; '.join(shown)}"

    # ------------------------------------------------------------ wire

    def _us(self, characters: int) -> int:
        return -(-characters * 10_000_000 // self.rate)

    def _receive(self) -> None:
        text = b""
        while self._wire and self._wire[0].at <= self.now and len(text) + len(self._wire[0].text) <= RING:
            heard = self._wire.pop(0)
            text += heard.text
            if heard.frame is not None:
                self.acknowledged.append(heard.frame)
        self.block["Text"] = text
        self.block["Count"] = len(text)

    def mailbox(self, count: int) -> bytes:
        """The first characters of the request there."""
        text = self.block["Port.Tx"]
        assert isinstance(text, list)
        return bytes(text[:count])  # type: ignore[arg-type]  # an array of BYTE

    def _send(self) -> None:
        count = self.block["Port.TxCount"]
        assert isinstance(count, int)
        if not count:
            return
        raw = self.mailbox(count)
        data = _opened(raw, self.ascii)
        start = max(self.now, self._free + self._us(4))
        end = start + self._us(count)
        meets = [each for each in self._wire if each.begins < end and each.at > start]
        place = 7 if data[1] == 16 else 4
        word = data[place] << 8 | data[place + 1]
        frame = Frame(start // 1000, data[0], data[1], data[2] << 8 | data[3], word, data)
        self.frames.append(frame)
        self._free = end
        for each in meets:
            self._wire[self._wire.index(each)] = Heard(each.at, each.begins, self._garbled(each.text), None)
        if self.echo:
            self.transmit(raw, start)
        if not meets and not self._happens(self.faults.lost):
            self._answer(frame, data, end)

    def _answer(self, frame: Frame, data: bytes, end: int) -> None:
        reply: bytes | None = None
        for drive in self.drives:
            if drive.unit == frame.unit and drive.unit not in self.deaf:
                reply = drive.reply(data)
        reply = self.spoil(frame, reply)
        if reply is None or self._happens(self.faults.unanswered):
            return
        faults, turn = self.faults, self.drives[0].turn_us
        if self._happens(faults.late):
            turn = 1000 * self.chance.randint(20, 55)
        good: Frame | None = frame
        text = _sealed(reply, self.ascii)
        if self._happens(faults.garbled):
            text, good = self._garbled(text), None
        if self._happens(faults.truncated):
            text, good = text[: self.chance.randrange(1, len(text))], None
        self.transmit(text, end + turn, good if reply[1] == frame.function else None)
        if self._happens(faults.twice):
            self.transmit(text, self._wire[-1].at + self._us(4), None)

    def transmit(self, text: bytes, begins: int | None = None, frame: Frame | None = None) -> None:
        """Characters of a drive or of somebody else; they are heard when the last one is there."""
        begins = self.now if begins is None else begins
        heard = Heard(begins + self._us(len(text)), begins, text, frame)
        self._wire.append(heard)
        self._wire.sort(key=lambda each: each.at)
        self._free = max(self._free, heard.at) if heard.at < self.now + 100_000 else self._free

    def foreign(self, frame: bytes) -> None:
        """Another master, or a unit that nobody asked."""
        self.transmit(_sealed(frame, self.ascii))

    def _garbled(self, text: bytes) -> bytes:
        place = self.chance.randrange(len(text))
        return text[:place] + bytes([text[place] ^ 1 << self.chance.randrange(7)]) + text[place + 1 :]

    def _happens(self, per_1000: int) -> bool:
        return per_1000 > 0 and self.chance.randrange(1000) < per_1000

    # ------------------------------------------------------------ what tests begin with

    def stopped(self, drive: int = 0) -> "Bench":
        """Scan until the stop is confirmed and a start is possible."""
        return self.until(lambda: self.shows("StopConfirmed", drive) and self.shows("Ready", drive), 12_000)

    def running(self, pin: str = "RunForward", drive: int = 0) -> "Bench":
        """Start, and scan until the motor turns at its reference."""
        self.stopped(drive).put(drive, **{pin: True})
        return self.until(lambda: self.shows("AtSpeed", drive), 9000)
