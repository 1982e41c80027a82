"""Which request comes after which, and whose the time on the wire is: by docs/line.md and docs/stop.md."""

from collections import deque
from itertools import accumulate
from typing import TYPE_CHECKING

from tests.second.figures import QUARTER
from tests.second.frames import LAST_READ, runs
from tests.second.pf4 import alike

if TYPE_CHECKING:
    from tests.second.wire import Exchange, Wire

CONTROL = alike(
    {"CHF": 0x1000, "GD200A": 0x2000, "JSCC": 0x1000, "PF4": 0x2000, "SN300G5": 0, "V20": 0x0063, "ACS355": 0}
)
"""Where stops are written."""
SILENCE_US = {True: 10_000, False: 1750}
"""Between a frame and the next request, by whether JSCC is on the line: its manual, and 3.5 characters."""
SECOND_MS, NEAR = 1000, 5
"""What LoadPercent looks at, and how exact it is, in percent."""
DYING_US, LONG_US = 3_000_000, 4_000_000
"""For how long the stop of a drive that is known to be silent is tried again at once; how long it is then looked at."""
LOST_US = 500_000
"""A request that is not on the wire by then never will be."""
KNOWN_US = 6_000_000
"""For so long every reply has been good, and none doubted: after a restart it might be an echo."""


class Turns:
    """Looks at pairs of requests, and at the time that each takes."""

    def __init__(self, wire: "Wire") -> None:
        """Begin at power-up."""
        self.wire, self.judge, self.bench = wire, wire.judge, wire.judge.bench
        self.open, self.posted = False, False
        """Whether a request was open after the last scan; whether one was sent in this one."""
        self.scans: deque[tuple[int, bool]] = deque(maxlen=3 * SECOND_MS)
        """Time of each, in ms, and whether a request was open in it."""
        self.posted_us = self.vain_us = 0
        """When a request was last sent, and when one was last lost, not answered, or refused."""
        self.lost: dict[int, Exchange] = {}
        """Reads that were not answered, by drive, until it is asked again."""
        self.deaf: set[int] = set()
        self.silent_us, self.spent_us, self.longest_us = 0, 0, 0
        """Drives that are silent, while others answer, and since when that is known; how long requests to them have had
        the wire since `DYING_US` after that, and the longest of them."""

    def answered(self, last: "Exchange", now: "Exchange") -> None:
        """A request after another."""
        if not self.wire.plain():
            self.lost.clear()
        if now.index >= len(self.judge.units) or not self.wire.plain():
            return
        free = self._free(last) and self._free(now) and self.wire.somebody()
        self.judge.once(now.index, "reads between", bad=free, seen=(last.data.hex(), now.data.hex()))
        if last.replies:
            start = now.end - 1000 * self.bench.characters_ms(len(now.data) + 2)
            gap_us = start - last.replies[-1][1]
            least = SILENCE_US["JSCC" in self.bench.types]
            self.judge.once(now.index, "silence", bad=gap_us < least, seen=(gap_us, "of", least, "us"))
        elif last.index < len(self.judge.units) and last.data[1] <= LAST_READ and self.slot(last.index, "Online"):
            self.lost[last.index] = last
        self._after_lost(now)

    def _after_lost(self, now: "Exchange") -> None:
        """A unit that owes a reply gets nothing but stops until none can come; then another length, if it has one."""
        index, once = now.index, self.judge.once
        last = self.lost.get(index)
        if last is None or (now.data[1] > LAST_READ and not self._free(now)):
            return
        del self.lost[index]
        if not self.slot(index, "Online"):  # nobody waits for one that counts as dead
            return
        gap_ms = (now.end - last.end) // 1000 - self.bench.characters_ms(len(now.data) + 2)
        least = self.slot(index, "LongestMs")
        once(index, "drains", bad=gap_ms < least, seen=(gap_ms, "of", least, "ms"))
        same = now.data[:4] == last.data[:4]
        other = self.slot(index, "OtherQuantity") not in (0, self.slot(index, "Ask[3].Quantity"))
        once(index, "other length", bad=same and other and now.data[5] == last.data[5], seen=(now.data.hex(),))

    def _free(self, each: "Exchange") -> bool:
        """Whether it is a write, and no stop."""
        if each.index >= len(self.judge.units):
            return False
        kind = self.bench.types[each.index]
        if each.data[1] <= LAST_READ or kind not in CONTROL:
            return False
        return not each.about(each.index + 1, CONTROL[kind]) or runs(kind, each.data)

    def slot(self, index: int, name: str) -> int:
        """A number of a slot."""
        value = self.bench.block[f"Slots[{index}].{name}"]
        assert isinstance(value, int)
        return value

    def posting(self, last: "Exchange | None") -> None:
        """A request is sent: how long the last one has had the wire."""
        took, self.posted, self.posted_us = self.bench.now - self.posted_us, True, self.bench.now
        if last is not None and last.index + 1 in self.deaf and self.bench.now - self.silent_us > DYING_US:
            self.spent_us, self.longest_us = self.spent_us + took, max(self.longest_us, took)

    def scan(self) -> None:
        """In each scan: whether a request was open in it."""
        last, now = self.wire.last, self.bench.now
        self.scans.append((self.bench.elapsed, self.open))
        if self.posted:
            self.open, self.posted = True, False
        if last is not None and last.replies and now >= last.replies[-1][1]:
            self.open = False
        if not last.good if last else now - self.posted_us > LOST_US:
            self.vain_us = now
        deaf = self.bench.deaf if self.bench.deaf and self.wire.plain() and self.wire.somebody() else set()
        slots = [f"Slots[{unit - 1}]" for unit in deaf]
        dying = any(self.bench.block[f"{slot}.Online"] or self.bench.block[f"{slot}.SupplyOff"] for slot in slots)
        if dying or deaf != self.deaf:
            self.deaf, self.silent_us, self.spent_us, self.longest_us = set(deaf), now, 0, 0

    def look(self) -> None:
        """Now and then: the load, and what the dead take of the time."""
        anew_us = max(self.vain_us, *(each.restarted_us for each in self.judge.units))
        if self.wire.plain() and self.bench.now - anew_us > KNOWN_US:
            self._load()
        time_us = self.bench.now - self.silent_us - DYING_US
        if self.deaf and time_us > LONG_US:
            far = self.spent_us - 2 * self.longest_us > time_us // QUARTER
            self.judge.once(0, "quarter", bad=far, seen=(self.spent_us, "of", time_us, "us"))

    def _load(self) -> None:
        """LoadPercent is the share of a second, the end of which is not longer ago than another."""
        times = [0, *accumulate(ms for ms, _ in self.scans)]
        busy = [0, *accumulate(ms * is_open for ms, is_open in self.scans)]
        shares, begin = [], 0
        for end, time in enumerate(times):
            while begin + 1 < end and time - times[begin + 1] >= SECOND_MS:
                begin += 1
            if time - times[begin] >= SECOND_MS and times[-1] - time <= SECOND_MS + 2 * self.bench.ms:
                shares.append(100 * (busy[end] - busy[begin]) // (time - times[begin]))
        shown = self.bench.block["TheLine.LoadPercent"]
        assert isinstance(shown, int)
        off = bool(shares) and not min(shares) - NEAR <= shown <= max(shares) + NEAR
        self.judge.once(0, "load", bad=off, seen=(shown, "of", min(shares, default=0), "to", max(shares, default=0)))
