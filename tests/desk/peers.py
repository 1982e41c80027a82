"""Units on a line in virtual time that names what it does to them: it delays, doubles, damages, echoes and mixes up.

Nothing of it is computed by the product: frames are those of `tests.second.frames`, words name their own address, and
tables come from makers' documents, not from maps.
"""

import socket
import threading
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from heapq import heappop, heappush
from random import Random
from typing import Protocol

from tests.second.frames import opened, rtu

from driveblocks.desk.clock import Clock, RealClock, VirtualClock
from driveblocks.desk.site.found import Way

CHAR_US = 1042
"""10 bits at 9,600 bit/s."""


class Peer(Protocol):
    """A unit: what it says to a frame whose last character arrives now, with the time of its first character."""

    def receive(self, frame: bytes, now_us: int) -> list[tuple[int, bytes]]:
        """Replies."""


@dataclass
class Named:
    """A unit whose words and coils name their address, but for those that are given."""

    unit: int = 1
    reply_us: int = 5000
    mark: int = 0
    """Told apart from another unit by it: a bit of each word."""
    given: Mapping[int, int] = field(default_factory=dict)
    refuses: frozenset[int] = frozenset()
    silent: frozenset[int] = frozenset()
    only: frozenset[int] | None = None
    """Registers that there are; None: all."""
    most: int = 125
    functions: tuple[int, ...] = (1, 2, 3, 4)
    refusal: tuple[int, int] | None = None
    """Function and address of its refusals; None: as the standard has them."""
    said: tuple[int, ...] = (1, 2, 3)
    """Its reasons: function, address, value."""

    def word(self, address: int) -> int:
        """What a register holds."""
        return self.given.get(address, address ^ self.mark)

    def coil(self, address: int) -> bool:
        """What a coil is: no pattern that a shift keeps."""
        return bool((address * 0x9E3779B1 >> 13) & 1)

    def receive(self, frame: bytes, now_us: int) -> list[tuple[int, bytes]]:
        """As `Peer`."""
        body = opened(frame)
        if body is None or len(body) < 2 or body[0] != self.unit:
            return []
        reply = self._reply(body)
        return [] if reply is None else [(now_us + self.reply_us, rtu(reply))]

    def _reply(self, body: bytes) -> bytes | None:
        if body[1] not in self.functions or len(body) != 6:
            return self._no(body, self.said[0])
        first, count = int.from_bytes(body[2:4], "big"), int.from_bytes(body[4:6], "big")
        span = range(first, first + count)
        if not self.silent.isdisjoint(span):
            return None
        if count > self.most or body[1] not in (1, 2, 3, 4):
            return self._no(body, self.said[2])
        if not self.refuses.isdisjoint(span) or not (self.only is None or self.only.issuperset(span)):
            return self._no(body, self.said[1])
        if body[1] < 3:
            bits = sum(self.coil(each) << place for place, each in enumerate(span))
            return body[:2] + bytes([-(-count // 8)]) + bits.to_bytes(-(-count // 8), "little")
        return body[:2] + bytes([2 * count]) + b"".join(self.word(each).to_bytes(2, "big") for each in span)

    def _no(self, body: bytes, reason: int) -> bytes:
        if self.refusal is None:
            return bytes([body[0], body[1] | 0x80, reason])
        return bytes([body[0], self.refusal[0], *self.refusal[1].to_bytes(2, "big"), 0, reason])


def table(words: Mapping[int, int], **other: object) -> Named:
    """A drive that has these registers alone."""
    return Named(given=words, only=frozenset(words), **other)  # type: ignore[arg-type]  # fields of Named


def pi500() -> Named:
    """Powtran PI500 (manual, page 157; LinuxCNC's pi500_vfd): monitors at 1001H, state 3000H, fault 8000H, F000H."""
    monitors = {0x1001: 0, 0x1002: 5400, 0x1003: 0, 0x1004: 0, 0x1005: 0, 0x1006: 0, 0x1007: 0}
    groups = {0xF000 + (group << 8) + each: each for group in range(3) for each in range(20)}
    return table({0x1000: 0, **monitors, 0x3000: 3, 0x8000: 0, **groups}, most=12, functions=(3, 6))


def acs355() -> Named:
    """ABB ACS355 (manual, pages 313, 319): control word 0, status word 3, parameter GGII at 100 G + I - 1."""
    process = {0: 0x0476, 1: 0, 2: 0, 3: 0x0231, 4: 0, 5: 0}
    parameters = {100 * group + each - 1: each for group in (1, 4, 10, 11, 20, 22, 53, 99) for each in range(1, 13)}
    return table({**process, **parameters}, most=120, functions=(1, 2, 3, 4, 5, 6, 8, 15, 16))


def vfd_e() -> Named:
    """Delta VFD-E (manual, address list of Pr.09.04): 2100H to 2109H, Pr. GG-nn at GGnnH; 2000H is written only."""
    monitors = dict.fromkeys(range(0x2100, 0x210A), 0) | {0x2101: 0x0500, 0x2102: 5000, 0x2108: 3110}
    parameters = {(group << 8) + each: each for group in (0, 1, 2, 9) for each in range(10)}
    return table({**monitors, **parameters}, most=1, functions=(3, 6))


def pf525() -> Named:
    """PowerFlex 525 (520-UM001, appendix C) with all its parameters: a register is a parameter's number."""
    monitors = {0x2000: 1, 0x2001: 0, 0x2100: 0x060D, 0x2101: 0, 0x2103: 0, 0x2104: 0, 0x2105: 540, 0x2106: 0}
    return table({**dict.fromkeys(range(1, 731), 0), **monitors}, functions=(3, 6, 16))


def everything() -> Named:
    """A gateway that answers every address with 0."""
    return Named(given=dict.fromkeys(range(0x10000), 0))


STRANGERS = {"pi500": pi500, "acs355": acs355, "vfd_e": vfd_e}
"""Drives that no map is made for."""
TABLES = STRANGERS | {"pf525 whole": pf525}


@dataclass(frozen=True, kw_only=True)
class Fate:
    """What a line does; times in us."""

    late_us: int = 0
    once_us: int = 0
    """How much later one reply comes: the `at`th."""
    at: int = 12
    double_us: int | None = None
    """Each reply comes again so long after it has ended."""
    damage: float = 0.0
    """Share of frames that is damaged, in each direction."""
    cut: bool = False
    """Damage takes an end off, else it turns a bit."""
    split_us: int = 0
    """How much later the second half of a reply comes: a network hands it over in pieces."""
    echo_us: int | None = None
    """What is sent comes back so long after each of its characters, and replies come as much later."""


class Strides(VirtualClock):
    """Time that passes in longer steps while nothing comes: a machine that is busy."""

    def __init__(self, line: "Line") -> None:
        """Of a line."""
        super().__init__()
        self.line = line

    def sleep_until(self, us: int) -> None:
        """It is that time, or up to 4 ms later."""
        super().sleep_until(max(us, min(us + 4_000, self.line.due_us)))


class Line:
    """A port with units on it."""

    late_ms, error = 0, ""

    def __init__(self, peers: Iterable[Peer], fate: Fate = Fate(), seed: int = 0) -> None:
        """At 9,600 bit/s 8N1."""
        self.clock: Clock = Strides(self)
        self.peers, self.fate, self.chance = [*peers], fate, Random(seed)
        self.asked = self.hurt = self.replies = 0
        """Requests, those of which request or reply was damaged, and replies."""
        self.bodies: set[int] = set()
        """Functions that were sent."""
        self._come: list[tuple[float, int, int]] = []

    def opened(self, _: Way) -> "Line":
        """For `PortLine`, in any way."""
        return self

    def send(self, data: bytes) -> None:
        """A request."""
        now, fate = self.clock.now_us(), self.fate
        end, self.asked = now + len(data) * CHAR_US, self.asked + 1
        self.bodies.add(data[1])
        if fate.echo_us is not None:
            self._put(now + fate.echo_us, data)
        heard = self._spoilt(data)
        hurt = heard != data
        for peer in self.peers:
            for at, reply in peer.receive(heard, end):
                hurt |= self._said(at, reply)
        self.hurt += hurt

    def _said(self, at: int, reply: bytes) -> bool:
        """Put a reply on the wire; whether it was damaged."""
        fate, said = self.fate, self._spoilt(reply)
        self.replies += 1
        begin = at + fate.late_us + (fate.echo_us or 0) + (fate.once_us if self.replies == fate.at else 0)
        half = len(said) // 2 if fate.split_us else len(said)
        self._put(begin, said[:half])
        self._put(begin + half * CHAR_US + fate.split_us, said[half:])
        if fate.double_us is not None:
            self._put(begin + len(reply) * CHAR_US + fate.double_us, self._spoilt(reply))
        return said != reply

    def _spoilt(self, frame: bytes) -> bytes:
        chance = self.chance
        if chance.random() >= self.fate.damage:
            return frame
        place = chance.randrange(len(frame))
        if self.fate.cut:
            return frame[:place]
        return frame[:place] + bytes([frame[place] ^ 1 << chance.randrange(8)]) + frame[place + 1 :]

    def _put(self, begin: int, data: bytes) -> None:
        for place, byte in enumerate(data, 1):
            heappush(self._come, (begin + place * CHAR_US, len(self._come), byte))

    def receive(self) -> bytes:
        """Characters that have ended."""
        now, found = self.clock.now_us(), bytearray()
        while self._come and self._come[0][0] <= now:
            found.append(heappop(self._come)[2])
        return bytes(found)

    def close(self) -> None:
        """Nothing to give back."""

    @property
    def due_us(self) -> int:
        """When the next character will have ended."""
        return int(self._come[0][0]) + 1 if self._come else 1 << 62

    @property
    def is_whole(self) -> bool:
        """Whether all that is under way has ended."""
        return max(self._come, default=(0,))[0] <= self.clock.now_us()

    @property
    def share(self) -> float:
        """Requests that were damaged, or their replies."""
        return self.hurt / max(1, self.asked)


@contextmanager
def served(peers: Iterable[Peer], fate: Fate, seed: int) -> Iterator[str]:
    """Such a line in real time, where one program may come at a time; its TCP address."""
    line, over, door = Line(peers, fate, seed), threading.Event(), socket.create_server(("127.0.0.1", 0))
    line.clock = RealClock()

    def serve() -> None:
        come, _ = door.accept()
        come.settimeout(0.001)
        while not over.is_set():
            with suppress(TimeoutError, OSError):
                if asked := come.recv(4096):
                    line.send(asked)
            if line.is_whole:
                with suppress(OSError):
                    come.sendall(line.receive())
        come.close()

    threading.Thread(target=serve, daemon=True).start()
    try:
        yield f"127.0.0.1:{door.getsockname()[1]}"
    finally:
        over.set()
        door.close()


LATE = {f"late {ms}": Fate(late_us=1000 * ms) for ms in (0, 35, 85, 245, 895)}
ONCE = {f"once {ms}": Fate(late_us=55_000, once_us=1000 * ms - 60_000) for ms in (340, 1200)}
DOUBLED = {f"doubled {ms}": Fate(double_us=1000 * ms) for ms in (5, 15, 30, 55, 90, 120)}
DAMAGED = {
    f"{'cut' if cut else 'flipped'} {share}": Fate(damage=share / 100, cut=cut)
    for share in (1, 5, 10, 25)
    for cut in (False, True)
}
ECHOES = {f"echo {ms}": Fate(echo_us=1000 * ms) for ms in (0, 16, 40, 200)}
SPLIT = {f"split {ms}": Fate(split_us=1000 * ms) for ms in (10, 40, 100)}
FATES = LATE | ONCE | DOUBLED | DAMAGED | ECHOES | SPLIT
"""Lines by name."""
TWINS = {f"twins {ms}": 1000 * ms for ms in (10, 55, 120, 340)}
"""Lines with two units at one address: how much later the second replies."""


@dataclass
class Later:
    """A unit that takes its time."""

    peer: Peer
    by_us: int

    def receive(self, frame: bytes, now_us: int) -> list[tuple[int, bytes]]:
        """As `Peer`."""
        return [(at + self.by_us, reply) for at, reply in self.peer.receive(frame, now_us)]
