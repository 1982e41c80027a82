"""Faults and measured values of one drive, against what its block shows of them."""

from typing import TYPE_CHECKING, Any

from tests.second.figures import AGE_MS, CALM_US, CODE_MOST, SEEN_US, round_us
from tests.second.observer import Seen
from tests.second.pf4 import alike

if TYPE_CHECKING:
    from tests.second.judge import Judge

CAN = ("CanReverse", "CanJog", "CanQuickStop", "CanCoastStop", "CanResetFault")
ABLE = alike({
    "ATV312": (True, False, True, True, True),  # CMD, page 12
    "CHF": (True, True, False, True, True),  # 1000H: 1 to 8, lines 319 to 326 of its manual
    "JSCC": (True, False, False, False, False),  # 1000H: 1 to 3, lines 105 to 108
    "GD200A": (True, True, False, True, True),  # 2000H: 1 to 8, page 139
    "MX2": (True, False, False, False, True),  # coils 0001H to 0004H, I585 page 6-27
    "PF4": (True, False, False, False, True),  # 2000H: bits 0 to 5, page C-4; a jog is no command of its map
    "V20": (True, False, True, True, True),  # 40100: bits 11, 2, 1, 7
    "ACS355": (True, False, True, True, True),  # 40001: bits 2, 1, 7; a negative reference
    "SN300G5": (True, False, False, False, False),  # 0000H: bits 0 and 1; the others are terminals
})  # fmt: skip


class Trips:
    """What a drive has, scan by scan."""

    def __init__(self, judge: "Judge", index: int) -> None:
        """Begin at power-up."""
        self.judge, self.bench, self.index = judge, judge.bench, index
        self.current = False
        self.flipped_us = 0
        """Whether its motor has current, and since when it has, or has not."""
        self.words: dict[int, tuple[int, int]] = {}
        """Registers of measured values: the word, and since when it is that."""
        self.fault: Any = None
        self.since_us: int | None = None
        self.faulty_us = 0
        """Its fault, since when it has that, and when it last had one."""
        self.run_us = 0
        """When the bus last ran it, by a start that its block knows of."""
        self.first = False
        """Its fault is the first since then."""
        self.alone = False
        """None was shown when it came, and it was watched since: else it need not be recorded."""

    def scan(self, *, driven: bool, attended: bool) -> None:
        """After a scan."""
        bench, index, now = self.bench, self.index, self.bench.now
        one = bench.models[index]
        if one.output != self.current:
            self.current, self.flipped_us = one.output, now
        if one.fault is None:
            self.since_us = None
            self.run_us = now if driven and not one.itself else self.run_us
            return
        if self.since_us is None or one.fault != self.fault:
            self.alone = not bench.shows("Fault", index)
            self.fault, self.since_us, self.first = one.fault, now, self.run_us > self.faulty_us
        self.alone = self.alone and attended and bench.shows("CommOk", index)
        self.faulty_us = now
        read_us, code = self.judge.wire.read_us[index], bench.out("FaultCode", index)
        shown = self.alone and read_us is not None and read_us > self.since_us and bench.shows("Fault", index)
        wrong = shown and code not in (0, self._number()) and not self.judge.claims.mistaken(index, now)
        self._once("another code", bad=wrong, seen=(code, "of", self._number()))

    def look(self, changed_us: int) -> None:
        """In quiet times, and since when the pins are what they are: what is shown by now."""
        self._code(changed_us)
        if not self.judge.claims.mistaken(self.index, self.bench.now):
            self._measures()
        able = tuple(self.bench.out(each, self.index) for each in CAN)
        self._once("able", bad=able != ABLE[self.bench.types[self.index]], seen=able)

    def _once(self, rule: str, *, bad: bool, seen: Seen) -> None:
        self.judge.once(self.index, rule, bad=bad, seen=seen)

    def _number(self) -> object:
        """Of the fault, as the block has to show it."""
        one = self.bench.models[self.index]
        return getattr(one, "number", lambda fault: fault)(one.fault)

    def _code(self, changed_us: int) -> None:
        """The code of a fault that has been there for some time; without one there is none."""
        bench, index, now = self.bench, self.index, self.bench.now
        code, shown = bench.out("FaultCode", index), bench.shows("Fault", index)
        most = max(CALM_US // 2, CODE_MOST * round_us(bench))
        dead = any(now - each.away_us < most for each in self.judge.units)
        most += 2 * round_us(bench) if dead else 0  # stops that are not answered come first
        most += 2 * round_us(bench) if bench.ascii else 0  # two reads have to agree
        most += CALM_US if 0 < now - self.judge.many_us < 2 * CALM_US else 0  # so do the last reads of those that die
        old = self.since_us is not None and now - max(self.since_us, changed_us) > most and shown
        old = old and self.judge.known(index, CALM_US // 2) and not bench.pins[index].get("SupplyOff")
        old = old and not self.judge.claims.mistaken(index, now)
        number = self._number()
        self._once("code", bad=(old and code != number) or (not shown and code != 0), seen=("code", code))
        recorded = old and self.alone
        for pin, asked in (("FaultBack1", recorded), ("FirstFaultCode", recorded and self.first)):
            kept = bench.out(pin, index)
            self._once(pin, bad=asked and kept != number, seen=(kept, "of", number))

    def _measures(self) -> None:
        """Measured values are what the drive shows, once that has been so for longer than they are old."""
        bench, index, now = self.bench, self.index, self.bench.now
        one, age = bench.models[index], int(bench.number("MeasuresAgeMs", index))
        for pin, (register, unit) in one.MEASURES.items():
            word = one.LIVE[register](one, now)
            if self.words.get(register, (None, 0))[0] != word:
                self.words[register] = word, now
            shown = bench.out(pin, index)
            assert isinstance(shown, float)
            since = max(self.words[register][1], self.flipped_us) + 3 * max(self.judge.late)
            bad = now - since > 1000 * age + SEEN_US and age < AGE_MS and abs(shown - word * unit) > unit / 2
            self._once(pin, bad=bad, seen=(shown, "of", word * unit))
