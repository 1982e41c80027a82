"""How often a drive is read: the virtual line beside the formulas, the wire's own limit, and the shipped families."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil

from tests import shipped
from tests.line.cline import CLine

from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import polls

DRIVES, RATES, BITS = (1, 3, 7, 16, 32), (9600, 19200, 38400, 57600, 115200), (10, 11)
SCANS, DELAYS = (5, 10, 20), ((0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (2, 0), (3, 0))
WORDS, TURN_MS = 6, 5
SLACK = 1.12


@dataclass(frozen=True)
class Setup:
    """A line that polls; times in ms, the adapter's delay in scans, to the wire and back."""

    drives: int = 7
    rate: int = 19200
    bits: int = 10
    scan: int = 10
    sent: int = 0
    received: int = 0
    keeps: bool = True
    words: int = WORDS
    silence_ms: float = 0

    def __str__(self) -> str:
        """Name it."""
        what = f"{self.drives} drives, {self.rate} {'8E1' if self.bits == 11 else '8N1'}, {self.scan} ms"
        late = f", {self.sent} scans late there, {self.received} back" if self.sent or self.received else ""
        return f"{what}, silence kept by the {'port' if self.keeps else 'line'}{late}"

    @property
    def wire(self) -> float:
        """Request, turn-round and reply."""
        return (8 + 5 + 2 * self.words) * self.bits * 1000 / self.rate + TURN_MS

    @property
    def silence(self) -> float:
        """What the standard and the drive ask for."""
        return max(1.75 if self.rate > 19200 else 3.5 * self.bits * 1000 / self.rate, self.silence_ms)

    @property
    def coarse(self) -> bool:
        """Whether a line that counts whole ms cannot know, one scan later, that the silence is over."""
        return not self.keeps and self.silence + 1 >= self.scan

    @property
    def limit(self) -> float:
        """What the wire itself takes for a round of all drives."""
        return self.drives * (self.wire + self.silence)

    def formula(self, whole: bool = False, shortest: float = 1) -> float:
        """A round in whole scans; `whole`: the line's silence, too, is counted in ms; `shortest`: of the mean scan."""
        scan = self.scan * shortest
        if self.keeps:
            scans = ceil((self.wire + self.silence) / scan)
        else:
            scans = ceil(self.wire / scan) + 1 + (int((self.silence + 1) / scan) if whole else 0)
        return self.drives * (scans + self.sent + self.received) * self.scan

    def run(self, lines: Callable[[int], CLine], jitter: int = 0) -> float:
        """What the virtual line takes for a round, in ms; scans vary by this many percent."""
        ran = lines(32 if self.drives > 8 else 8).run(
            "run",
            drives=self.drives,
            rate=self.rate,
            bits=self.bits,
            scan=1000 * self.scan,
            max_scan=self.scan + (1 + self.scan * jitter // 100 if jitter else 0),
            jitter=10 * self.scan * jitter,
            keeps=self.keeps,
            words=self.words,
            silence_ms=int(self.silence_ms),
            tx_late=self.sent,
            rx_late=self.received,
            ms=6000 + 20 * int(self.formula(whole=True)),
        )
        return ran["refresh_ms"]


def setups() -> Iterator[Setup]:
    """Every combination."""
    for keeps, drives, rate, bits, scan, (sent, received) in product((True, False), DRIVES, RATES, BITS, SCANS, DELAYS):
        yield Setup(drives, rate, bits, scan, sent, received, keeps)


def seven(found: Mapping[Setup, float]) -> list[str]:
    """Seven drives by rate, format and scan, in ms."""
    heads = [f"{who} keeps silence, {scan} ms" for who in ("port", "line") for scan in SCANS]
    rows = [f"| 7 drives, ms | the wire itself | {' | '.join(heads)} |", "|---|---|" + "---|" * len(heads)]
    for rate, bits in product(RATES, BITS):
        cells = [f"{found[Setup(7, rate, bits, scan, 0, 0, keeps)]:.0f}" for keeps in (True, False) for scan in SCANS]
        limit = Setup(7, rate, bits).limit
        rows.append(f"| {rate} {'8E1' if bits == 11 else '8N1'} | {limit:.0f} | {' | '.join(cells)} |")
    return rows


def families(lines: Callable[[int], CLine]) -> list[str]:
    """Seven drives of each shipped family, at the rates of its manual: how often its status is read, in ms."""
    heads = "7 drives, 10 ms", "words read from status to status", "bit/s, 8E1", "the wire itself, ms"
    rows = [f"| {' | '.join((*heads, 'port keeps silence', 'line keeps it'))} |"]
    rows.append("|---|---|---|---|---|---|")
    for drive in shipped.drives().values():
        reads = _round(drive)
        rates = sorted(code.baud for code in drive.serial.baud.codes) if drive.serial.baud else []
        told = drive.serial.silence
        own = float(told.milliseconds) if told and told.milliseconds else 0.0
        for rate in [each for each in rates if each in RATES] or [9600, 19200]:
            both = [[Setup(7, rate, 11, 10, 0, 0, keeps, words, own) for words in reads] for keeps in (True, False)]
            limit = sum(each.limit for each in both[0])
            port, line = (f"{sum(each.run(lines) for each in some):.0f}" for some in both)
            where = f"{rate}" if rates else f"{rate} (the manual names no rates)"
            port = f"{port} (the drive asks for {own:.0f} ms)" if own else port
            rows.append(f"| {drive.prefix} | {' + '.join(map(str, reads))} | {where} | {limit:.0f} | {port} | {line} |")
    return rows


def _round(drive: Drive) -> list[int]:
    """Words of the reads between two readings of the status: all fast ones, and one of the slow ones."""
    every = polls(drive)
    slow = [each.words for each in every if not each.fast]
    return [*(each.words for each in every if each.fast), *slow[:1]]
