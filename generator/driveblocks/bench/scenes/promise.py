"""How late the stops of a line can be, computed here as docs/stop.md says: what its figures are compared with."""

from dataclasses import dataclass

READ = 8 + 5
"""Characters of a read, request and reply, beside its words (MODBUS Application Protocol V1.1b3, 6.3)."""
STOP_BY_ONE, STOP_BY_MORE = 8 + 8 + 3, 9 + 2 + 8 + 4
"""The same of a stop by function 06 or 10H (6.6, 6.12), with some to spare for other forms of a reply."""
LEAST_WORDS = 12
"""Registers of a poll at least, so that every other request of the slot is shorter."""


@dataclass(frozen=True)
class Promise:
    """A line as its pins say: bits per second, bits of a character, and times in ms."""

    rate: int = 115200
    bits: int = 10
    ascii: bool = False
    keeps: bool = True
    scan: int = 40
    port: int = 0
    retries: int = 3
    offline: int = 1000
    turn_round: int = 30
    longest: int = 60
    silence: int = 0
    drives: int = 1
    by_one: bool = True
    """A stop is a write of one register, function 06."""

    def _wire(self, octets: int) -> int:
        """Time of some bytes, rounded up; in ASCII two characters per byte and two more."""
        characters = 2 * octets + 2 if self.ascii else octets
        each = self.bits * 1_000_000 // self.rate + 1
        return characters * each // 1000 + 1 + self.turn_round

    @property
    def quiet(self) -> int:
        """Silence before a request: 3.5 characters, 1.75 ms above 19200 bit/s, or what the drive asks for."""
        each = self.bits * 1_000_000 // self.rate + 1
        characters = 7 * each // 2000 + 1 if self.rate <= 19200 else 2
        return max(characters, self.silence)

    @property
    def line_keeps(self) -> bool:
        return not self.keeps or self.silence >= self.quiet

    @property
    def _poll(self) -> int:
        return self._wire(READ + 1 + 2 * LEAST_WORDS)

    @property
    def _stop(self) -> int:
        return self._wire(STOP_BY_ONE if self.by_one else STOP_BY_MORE)

    @property
    def _more(self) -> int:
        """What every transaction costs beside wire and turn-round."""
        return self.scan * (2 if self.line_keeps else 1) + self.quiet + 2 * self.port + 2

    @property
    def alone(self) -> int:
        return self._poll + self._more + self.port + self.quiet

    @property
    def worst(self) -> int:
        return self.alone + (self.drives - 1) * (self._stop + self._more)

    @property
    def cut(self) -> int:
        """CutToContactMs: three or four lost polls, a poll and a stop to each drive, all tries of a stop, two scans."""
        asked = (3 if self.drives == 1 else 4) * (self._poll + self._more + self.longest - self.turn_round)
        silent = max(asked, self.offline + self._more)
        each = self.drives * (self._poll + self._stop + 2 * self._more)
        attempts = (self.retries + 1) * (self._stop + self._more)
        return silent + each + max(attempts, self.longest) + 2 * self.scan
