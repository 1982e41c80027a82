"""A virtual RS-485 line in virtual time around the line block on the embedded engine; times in microseconds.

`Bench` holds the line, its mailbox and slots, the wire, the drives and the least that drive blocks do. A test scans it,
posts requests, breaks things, and reads what was sent.
"""

import heapq
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from random import Random
from typing import Self

from tests.blocks.library import sources
from tests.line.drives import ABI_WORD, KINDS, Kind, check, counted

from driveblocks.reference.checksum import crc16, lrc
from driveblocks.render.results import RESULTS
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, Source

STOP, COMMAND, PARAMETER, POLL = range(4)
"""The compartments of a slot."""
NAMES = {result.code: result.name for result in RESULTS}
RX = [f"Port.Rx[{place}]" for place in range(256)]
ALIVE = [f"Slots[{slot}].Alive" for slot in range(32)]
ABIS = [f"Slots[{slot}].Abi" for slot in range(32)]
CHECKED = ("Number", "Address", "FunctionCode", "Quantity", "Unit", "FamilyCode")
"""Fields of a stop that its check is of, before its word."""
Edit = Callable[[str], str]


@dataclass(frozen=True)
class Config:
    """What a line is made of; the keys of the line in C are the same."""

    drives: int = 3
    rate: int = 19200
    bits: int = 10
    ascii: bool = False
    keeps: bool = True
    echo: bool = False
    words: int = 6
    scan: int = 10_000
    max_scan: int = 12
    tx_late: int = 0
    rx_late: int = 0
    whole: bool = False
    turn_low: int = 5_000
    turn_high: int = 5_000
    turn_ms: int = 5
    longest_ms: int = 30
    loss: int = 0
    garble: int = 0
    truncate: int = 0
    duplicate: int = 0
    late: int = 0
    kind: int = 0
    """Faults are per 100,000 replies."""


def line_sources(edit: Edit = str) -> list[Source]:
    """The files that a line needs, each edited."""
    wanted = ("types/", "modbus/MB_Hex", "line/")
    return [Source(each.path, edit(each.text)) for each in sources() if each.path.startswith(wanted)]


@cache
def library(edit: Edit = str) -> Library:
    """The line on the embedded engine."""
    return EmbeddedEngine().build(line_sources(edit))


@dataclass
class Drive:
    """A drive: what it was asked, and how it answers."""

    unit: int
    kind: Kind
    alive: bool = True
    turn_us: int | None = None
    answer: Callable[[bytes], bytes | None] | None = None
    heard: list[bytes] = field(default_factory=list)
    reads: int = 0

    def reply(self, request: bytes) -> bytes | None:
        """The reply without checksum; None if it keeps silent."""
        if not self.alive:
            return None
        self.heard.append(request)
        if self.answer is not None:
            return self.answer(request)
        if request[1] <= 4:
            self.reads += 1
            return counted(request, self.reads)
        return request[:6]


@dataclass(frozen=True)
class Sent:
    """A request on the wire: when its first character began (ms), without checksum, and whether it is a stop."""

    ms: float
    pdu: bytes
    stop: bool

    @property
    def unit(self) -> int:
        """Who was asked."""
        return self.pdu[0]

    @property
    def read(self) -> bool:
        """Whether it reads."""
        return self.pdu[1] <= 4


def sealed(frame: bytes, ascii_: bool) -> bytes:
    """Bytes with their checksum, as they go onto the wire."""
    if ascii_:
        return b":" + (frame + bytes([lrc(frame)])).hex().upper().encode() + b"\r\n"
    return frame + crc16(frame).to_bytes(2, "little")


def opened(text: bytes, ascii_: bool) -> bytes:
    """A frame of the line without its checksum, which must be right."""
    if ascii_:
        assert text[:1] == b":"
        assert text[-2:] == b"\r\n"
        frame = bytes.fromhex(text[1:-2].decode())
        assert lrc(frame[:-1]) == frame[-1]
        return frame[:-1]
    assert crc16(text[:-2]) == int.from_bytes(text[-2:], "little")
    return text[:-2]


class Bench:
    """A line with its drives."""

    def __init__(
        self, config: Config | None = None, seed: int = 0, block: Instance | None = None, **pins: int | bool
    ) -> None:
        """Begin a line; `block` in the place of a fresh one on the embedded engine; `pins` are its inputs."""
        self.config = config or Config()
        self.chance = Random(seed)
        self.kind = KINDS[self.config.kind]
        self.block = block or library().instance("MB_Line8")
        self.now = 0
        self.called = 0
        self.sent: list[Sent] = []
        self.late: list[float] = []
        self.short: list[float] = []
        self.attended = set(range(self.config.drives))
        self.drives = [Drive(unit + 1, self.kind) for unit in range(self.config.drives)]
        self._wire: list[tuple[int, int, int]] = []
        self._order = count()
        self._alive = [0] * self.config.drives
        self._last = -1_000_000
        self._busy = (0, 0)
        self._held = 0
        self.port_takes = True
        self.echoes = self.config.echo
        self.set(BitRate=self.config.rate, CharacterBits=self.config.bits, Ascii=self.config.ascii, **pins)
        self.set(MaxScanMs=self.config.max_scan)
        held = (self.config.tx_late + self.config.rx_late) * self.config.max_scan
        self.block["Port.LateMs"] = held + (self._silence // 1000 + 1 if self.config.whole else 0)
        self.block["Port.KeepsSilence"] = self.config.keeps
        for slot in range(self.config.drives):
            self._slot(slot)

    def _slot(self, slot: int) -> None:
        kind, path = self.kind, f"Slots[{slot}]."
        fields = {
            "UnitAddress": slot + 1,
            "FamilyCode": self.config.kind + 1,
            "TurnRoundMs": self.config.turn_ms,
            "LongestMs": self.config.longest_ms,
            "ExceptionAdd": kind.exception_add,
            "ErrorFunction": kind.error_function,
            "ErrorAddress": kind.error_address,
            "OtherQuantity": self.config.words + 1,
        }
        for name, value in fields.items():
            self.block[path + name] = value
        self.fill_as_kind(slot)

    def fill_as_kind(self, slot: int) -> None:
        """The stop and the poll of the drives' kind."""
        kind = self.kind
        self.fill(slot, STOP, kind.stop_function, kind.stop_address, quantity=kind.stop_words, word=kind.stop_word)
        self.put(slot, HasStop=True, StopRegister=kind.stop_address, StopWord=kind.stop_word)
        self.ask(slot, POLL, kind.read_function, kind.read_address, quantity=self.config.words)

    # ------------------------------------------------------------ what a user does

    def set(self, **pins: int | bool) -> None:
        """Set inputs of the block."""
        for name, value in pins.items():
            self.block[name] = value

    def slot(self, slot: int, name: str) -> int:
        """A field of a slot."""
        return self[f"Slots[{slot}].{name}"]

    def __getitem__(self, path: str) -> int:
        """A number of the block."""
        value = self.block[path]
        assert isinstance(value, int)
        return value

    def put(self, slot: int, **fields: int | bool) -> None:
        """Set fields of a slot, as its drive block does."""
        for name, value in fields.items():
            self.block[f"Slots[{slot}].{name}"] = value
        if "UnitAddress" in fields:
            for box in range(4):
                self._own(slot, box)

    def _own(self, slot: int, box: int) -> None:
        """Write whose a request is, as its drive block does."""
        path = f"Slots[{slot}].Ask[{box}]."
        self.block[path + "Unit"], self.block[path + "FamilyCode"] = (
            self.slot(slot, n) for n in ("UnitAddress", "FamilyCode")
        )
        if box == STOP:
            self.block[path + "Check"] = check(*(self[path + name] for name in CHECKED), self[path + "Words[0]"])

    def fill(self, slot: int, box: int, function: int, address: int, *, quantity: int = 1, word: int = 0) -> None:
        """Fill a compartment without asking."""
        path = f"Slots[{slot}].Ask[{box}]."
        self.block[path + "FunctionCode"] = function
        self.block[path + "Address"] = address
        self.block[path + "Quantity"] = quantity
        self.block[path + "Words"] = [word]
        self._own(slot, box)

    def ask(self, slot: int, box: int, function: int, address: int, *, quantity: int = 1, word: int = 0) -> int:
        """Fill a compartment and ask; the Number."""
        self.fill(slot, box, function, address, quantity=quantity, word=word)
        return self.post(slot, box)

    def post(self, slot: int, box: int) -> int:
        """Ask again what the compartment holds; the Number."""
        number = self.slot(slot, f"Ask[{box}].Number") % 65535 + 1
        self.block[f"Slots[{slot}].Ask[{box}].Number"] = number
        self._own(slot, box)
        if box == PARAMETER:
            self.put(slot, ParameterCleared=number)
        return number

    def stop(self, slot: int) -> int:
        """Ask for a stop."""
        return self.post(slot, STOP)

    def command(self, slot: int, word: int = 7) -> int:
        """Ask for a command."""
        return self.ask(slot, COMMAND, self.kind.write_function, self.kind.write_address, word=word)

    def answer(self, slot: int, box: int) -> str:
        """How the last request of a compartment was answered; empty while it was not."""
        path = f"Slots[{slot}]."
        if self[f"{path}Ask[{box}].Number"] != self[f"{path}Answer[{box}].Number"]:
            return ""
        return NAMES[self[f"{path}Answer[{box}].ErrorID"]]

    # ------------------------------------------------------------ time

    def run(self, ms: int) -> list[Sent]:
        """Scan for so long; what was sent meanwhile."""
        before, end = len(self.sent), self.now + 1000 * ms
        while self.now < end:
            self.scan()
        return self.sent[before:]

    def ready(self) -> Self:
        """Scan until every drive that lives is online, may be commanded, and the echo is known."""
        self.run(1000)
        until = self.now + 40 * self.config.scan * self.config.drives
        while self.now < until and not self._online():
            self.scan()
        self.run(self.config.longest_ms)
        assert self._online()
        return self

    def _online(self) -> bool:
        """Whether the drives that live are online, and no others."""
        return all(self.slot(index, "Online") == drive.alive for index, drive in enumerate(self.drives))

    def scan(self, took: int | None = None, elapsed: int | None = None) -> None:
        """One scan: receive, drive blocks, line, send."""
        self.now += self.config.scan if took is None else took
        self._receive()
        for slot in self.attended:
            self._alive[slot] = (self._alive[slot] + 1) % 256
            self.block[ALIVE[slot]] = self._alive[slot]
            self.block[ABIS[slot]] = ABI_WORD
        self.block["ElapsedMs"] = self.now // 1000 - self.called if elapsed is None else elapsed
        self.called = self.now // 1000
        self.block.scan()
        self._send()

    # ------------------------------------------------------------ adapter and wire

    def _us(self, characters: int) -> int:
        return -(-characters * self.config.bits * 1_000_000 // self.config.rate)

    @property
    def _silence(self) -> int:
        return 1750 if self.config.rate > 19200 else self._us(7) // 2

    def _receive(self) -> None:
        until = self.now - self.config.rx_late * self.config.scan
        if not self._wire:
            return
        place = self["Port.RxIn"]
        while self._wire and self._wire[0][0] <= until and not (self.config.whole and self._going_on(until)):
            at, _, octet = heapq.heappop(self._wire)
            self._last = max(self._last, at)
            self.block[RX[place]] = octet
            place = (place + 1) % 256
        self.block["Port.RxIn"] = place

    def _going_on(self, until: int) -> bool:
        """Whether the message that has begun may not have ended yet."""
        last = self._wire[0][0]
        for at, _, _ in sorted(self._wire):
            if at - last > self._silence:
                break
            last = at
        return last + self._silence > until

    def _send(self) -> None:
        number = self["Port.TxNumber"]
        if number == self["Port.TxTaken"] or not self["Port.TxCount"] or not self.port_takes:
            self._held = self.config.tx_late
            return
        if self._held > 0:
            self._held -= 1
            return
        self._held = self.config.tx_late
        self.block["Port.TxTaken"] = number
        value = self.block["Port.Tx"]
        assert isinstance(value, list)
        self._leave(bytes(value[: self["Port.TxCount"]]))  # type: ignore[arg-type]  # an array of BYTE

    def _leave(self, text: bytes) -> None:
        """A request is sent on the wire."""
        start, heard = self.now, max([self._last, *(at for at, _, _ in self._wire if at <= self.now)])
        if self.config.keeps:
            for at, _, _ in sorted(self._wire):
                heard = max(heard, at) if at - self._us(1) < heard + self._silence else heard
            start = max(start, heard + self._silence)
        elif start < heard + self._silence:
            self.short.append(self.now / 1000)
        frame = opened(text, self.config.ascii)
        stop = frame[1] == self.kind.stop_function and frame[2:4] == self.kind.stop_address.to_bytes(2, "big")
        self.sent.append(Sent(start / 1000, frame, stop))
        end = start + self._us(len(text))
        self._last = max(self._last, end)
        collides = start < self._busy[1] and end > self._busy[0]
        if self.echoes:
            self.transmit(text, start, whole=not collides)
        for drive in self.drives:
            if drive.unit == frame[0] and not collides:
                self._reply(drive, frame, end)

    def _reply(self, drive: Drive, frame: bytes, end: int) -> None:
        reply = drive.reply(frame)
        if reply is None or self._happens(self.config.loss):
            return
        turn = self.chance.randint(self.config.turn_low, self.config.turn_high)
        turn = turn if drive.turn_us is None else drive.turn_us
        if self._happens(self.config.late):
            turn = self.chance.randint(self.config.turn_ms, self.config.longest_ms) * 1000
        text = sealed(reply, self.config.ascii)
        if self._happens(self.config.truncate):
            text = text[: self.chance.randrange(len(text))]
        end = self.transmit(text, end + turn, whole=not self._happens(self.config.garble))
        if self._happens(self.config.duplicate):
            self.transmit(text, end + self._silence)

    def _happens(self, per_100_000: int) -> bool:
        return per_100_000 > 0 and self.chance.randrange(100_000) < per_100_000

    def transmit(self, text: bytes, start: int, whole: bool = True) -> int:
        """Characters onto the wire, one of them wrong if not `whole`; when the last has ended."""
        spoilt = self.chance.randrange(len(text)) if text and not whole else -1
        for index, octet in enumerate(text):
            value = octet ^ (1 << self.chance.randrange(7)) if index == spoilt else octet
            heapq.heappush(self._wire, (start + self._us(index + 1), next(self._order), value))
        self._busy = (start, start + self._us(len(text)))
        return self._busy[1]

    def foreign(self, frame: bytes) -> None:
        """Another master, or a unit that nobody asked, sends a frame."""
        self.transmit(sealed(frame, self.config.ascii), self.now)


def units(sent: list[Sent]) -> Iterator[int]:
    """Who was asked, one after the other."""
    return (each.unit for each in sent)
