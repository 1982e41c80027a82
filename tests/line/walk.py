"""Random walks over all that can happen to a line, its rules checked at every scan: `python -m tests.line.walk SEED`.

A seed is a walk; a failure names it, and the command above walks it again.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from tests.line.drives import KINDS
from tests.line.vline import COMMAND, PARAMETER, POLL, STOP, Bench, Config

from structured_text.engines.engine import Instance

SCANS = 1500


class BrokenRuleError(AssertionError):
    """A rule of the line does not hold."""


def config_of(seed: int) -> Config:
    """The line of a seed: the first seeds go through modes, kinds and echo in turn."""
    chance = Random(seed)
    faults = {name: chance.choice([0, 0, 3000]) for name in ("loss", "garble", "truncate", "duplicate", "late")}
    return Config(
        drives=chance.choice([1, 3, 8]),
        rate=chance.choice([4800, 19200, 57600]),
        bits=chance.choice([10, 11]),
        ascii=seed % 2 == 1,
        keeps=seed % 3 != 0,
        echo=seed % 4 == 2,
        kind=seed // 2 % len(KINDS),
        words=chance.choice([1, 6, 15]),
        tx_late=chance.choice([0, 0, 2]),
        rx_late=chance.choice([0, 0, 2]),
        whole=chance.random() < 0.2,
        turn_low=0,
        longest_ms=chance.choice([5, 60]),
        **faults,
    )


@dataclass
class Walk:
    """A bench and what its rules need to know."""

    bench: Bench
    chance: Random
    seed: int

    def __post_init__(self) -> None:
        """Nothing is open yet."""
        self.clean = not (self.bench.config.duplicate or (self.bench.config.late and self.bench.config.longest_ms <= 5))
        self.stops_heard = dict.fromkeys(range(self.bench.config.drives), 0)
        self.odd = dict.fromkeys(range(self.bench.config.drives), 0)
        self.took: int | None = None
        self.elapsed: int | None = None

    def go(self, scans: int = SCANS) -> None:
        """Walk. Raises BrokenRuleError."""
        actions: list[Callable[[int], None]] = [
            self.stop, self.stop, self.again, self.command, self.command, self.reset, self.parameter, self.invalid,
            self.polls, self.die, self.die, self.refuse, self.busy, self.pins, self.port, self.foreign, self.noise,
            self.neglect, self.address, self.shared, self.stall, self.supply, self.claims, self.clear, self.clear,
        ]  # fmt: skip
        for number in range(scans):
            if self.chance.random() < 0.08:
                self.chance.choice(actions)(self.chance.randrange(self.bench.config.drives))
            waiting = {slot for slot in range(self.bench.config.drives) if not self.bench.answer(slot, STOP)}
            fresh = [(self.bench.slot(slot, "Fresh"), drive.reads) for slot, drive in enumerate(self.bench.drives)]
            before = len(self.bench.sent)
            self.bench.scan(self.took, self.elapsed)
            self.took = None
            self._check(number, waiting, fresh, before)
            if not self.bench["Scan.Asks"] and any(map(self._asks, range(len(self.bench.drives)))):
                raise BrokenRuleError(f"seed {self.seed}, scan {number}: a slot asks, and the line looks for none")

    def _check(self, number: int, waiting: set[int], fresh: list[tuple[int, int]], before: int) -> None:
        bench = self.bench
        for slot, drive in enumerate(bench.drives):
            own = drive.unit == bench.slot(slot, "UnitAddress")
            if slot in waiting and own and bench.answer(slot, STOP) == "OK":
                heard = sum(self._stops(frame) for frame in drive.heard)
                if heard <= self.stops_heard[slot]:
                    raise BrokenRuleError(f"seed {self.seed}, scan {number}: a stop of slot {slot} was not heard")
            if drive.answer is not None:
                self.odd[slot] = bench.now + 1_000_000
            mask = (1 << bench.slot(slot, "PollCount")) - 1 if bench.kind.read_function <= 2 else 0xFFFF
            shown, reads = bench.slot(slot, "PollWords[0]"), fresh[slot][1] & mask
            told = self.clean and bench.slot(slot, "Fresh") != fresh[slot][0] and bench.now > self.odd[slot]
            if told and shown != reads:
                raise BrokenRuleError(f"seed {self.seed}, scan {number}: slot {slot} shows an old reading")
            passes = not bench.answer(slot, PARAMETER) and bench.slot(slot, "ParameterCleared") == 0
            if passes and bench["Phase"] == 1 and (bench["Slot"], bench["Box"]) == (slot, PARAMETER):
                raise BrokenRuleError(f"seed {self.seed}, scan {number}: slot {slot} sends a parameter unasked")
        for sent in bench.sent[before:]:
            if sent.unit == 0:
                raise BrokenRuleError(f"seed {self.seed}, scan {number}: a broadcast")
            slots = [slot for slot in range(bench.config.drives) if bench[f"Track[{slot}].UnitAddress"] == sent.unit]
            barred = bench["ErrorID"] == 58 or any(bench.slot(slot, "LineErrorID") in (55, 56) for slot in slots)
            if barred and not sent.stop and not bench.config.tx_late:
                raise BrokenRuleError(
                    f"seed {self.seed}, scan {number}: {sent} leaves though ErrorID {bench['ErrorID']}"
                )

    def _asks(self, slot: int) -> bool:
        track = f"Track[{slot}]."
        own = any(self.bench[f"{track}Stop.{name}"] for name in ("Unsent", "Forced"))
        waits = not all(self.bench.answer(slot, box) for box in (STOP, COMMAND, PARAMETER))
        return bool(self.bench[f"{track}UnitAddress"]) and (own or waits or self.bench[f"{track}PauseMs"] == 0)

    def _stops(self, frame: bytes) -> bool:
        return frame[1] == self.bench.kind.stop_function and frame[2:4] == self.bench.kind.stop_address.to_bytes(
            2, "big"
        )

    # ------------------------------------------------------------ what may happen

    def stop(self, slot: int) -> None:
        if self.bench.answer(slot, STOP):
            self.bench.put(slot, StopAgain=False, StopConfirmed=False, StopWithinMs=self.chance.choice([0, 500]))
            self.stops_heard[slot] = sum(self._stops(frame) for frame in self.bench.drives[slot].heard)
            self.bench.stop(slot)

    def again(self, slot: int) -> None:
        if self.bench.answer(slot, STOP):
            self.stop(slot)
            self.bench.put(slot, StopAgain=True)
            self.reset(slot)

    def command(self, slot: int) -> None:
        self.bench.put(slot, ResetAsked=False, Begins=False)
        self.bench.command(slot, self.chance.randrange(65536))

    def reset(self, slot: int) -> None:
        self.bench.put(slot, ResetAsked=True, Begins=True)
        self.bench.command(slot, 7)

    def parameter(self, slot: int) -> None:
        function, quantity = self.chance.choice(
            [(3, 1), (3, 4), (4, 2), (6, 1), (8, 1), (16, 2), (16, 4), (1, 3), (2, 4), (5, 1)]
        )
        address, word = self.chance.choice([0, 0x0123, 0xFFFF]), self.chance.randrange(65536)
        self.bench.ask(slot, PARAMETER, function, address, quantity=quantity, word=word)
        if word < 20_000:
            self.bench.put(slot, ParameterCleared=0)

    def invalid(self, slot: int) -> None:
        box, function, quantity = self.chance.choice(
            [(1, 15, 1), (2, 3, 5), (2, 16, 0), (3, 3, 17), (0, 15, 1), (3, 16, 2), (2, 3, 0), (2, 1, 5), (3, 5, 1)]
        )
        if self.bench.answer(slot, STOP) or box:
            self.bench.ask(slot, box, function, 0x2000, quantity=quantity)

    def polls(self, slot: int) -> None:
        kind, chance = self.bench.kind, self.chance
        double = self.chance.random() < 0.3
        self.bench.put(
            slot,
            PollEveryMs=chance.choice([0, 0, 200]),
            OtherQuantity=chance.choice([0, 7]),
            SilenceMs=chance.choice([0, 0, 25]),
        )
        self.bench.put(slot, TwoByteCount=double)
        self.bench.drives[slot].answer = self._double if double else None
        words, address = chance.choice([(1, 2), (6, kind.read_address), (12, kind.read_address)])
        self.bench.ask(slot, POLL, kind.read_function, address if double else kind.read_address, quantity=words)

    def _double(self, request: bytes) -> bytes:
        """The reply of a drive whose byte count is a word."""
        if request[1] > 4:
            return request[:6]
        data = (request[5] + 7) // 8 if request[1] <= 2 else 2 * request[5]
        return request[:2] + data.to_bytes(2, "big") + bytes(data - 1) + b"\x01"

    def die(self, slot: int) -> None:
        self.bench.drives[slot].alive = not self.bench.drives[slot].alive

    def refuse(self, slot: int) -> None:
        kind = self.bench.kind
        if kind.error_function:
            told = bytes([kind.error_function]) + kind.error_address.to_bytes(2, "big") + b"\x00\x05"
            self.bench.drives[slot].answer = lambda request: request[:1] + told
        else:
            self.bench.drives[slot].answer = lambda request: bytes([request[0], request[1] + 0x80, 5])

    def busy(self, slot: int) -> None:
        self.bench.put(slot, BusyReason=5)
        self.refuse(slot)
        self.command(slot)

    def pins(self, slot: int) -> None:
        del slot
        name = self.chance.choice(["StopAll", "Restart", "Acknowledge"])
        self.bench.set(**{name: not self.bench[name]})

    def port(self, slot: int) -> None:
        del slot
        what = self.chance.randrange(3)
        if what == 0:
            self.bench.block["Port.ErrorID"] = 0 if self.bench["Port.ErrorID"] else 3
        elif what == 1:
            self.bench.port_takes = not self.bench.port_takes
        else:
            self.bench.echoes = not self.bench.echoes
            self.bench.block["Port.ErrorID"] = 4  # after an error it is decided anew; nothing else could tell

    def foreign(self, slot: int) -> None:
        frames = [
            bytes([99, 3, 0, 0, 0, 2]),
            bytes([slot + 1, 6, 0, 1, 0, 2]),
            bytes([99, 16, 0, 0, 0, 1, 2, 3, 4]),
            bytes([99, 0x83, 2]),
        ]
        for frame in self.chance.sample(frames, 2):
            self.bench.foreign(frame)

    def noise(self, slot: int) -> None:
        odd = [
            b":0G\r\n",
            b":01\n",
            bytes([slot + 1, 3, 3]),
            bytes([slot + 1]) * 5,
            self.chance.randbytes(40),
            b":" + b"01" * 60,
        ]
        self.bench.transmit(self.chance.choice(odd), self.bench.now)

    def neglect(self, slot: int) -> None:
        self.bench.attended ^= {slot}

    def address(self, slot: int) -> None:
        unit = self.chance.choice([slot + 1, slot + 1, 0, 1, 50])
        self.bench.put(slot, StopConfirmed=self.chance.random() < 0.7)
        self.bench.scan()
        self.bench.put(slot, UnitAddress=unit)
        if unit not in [each.unit for each in self.bench.drives] and unit:
            self.bench.drives[slot].unit = unit

    def shared(self, slot: int) -> None:
        self.bench.put(slot, Shared=not self.bench.slot(slot, "Shared"))

    def stall(self, slot: int) -> None:
        del slot
        if self.chance.random() < 0.3:
            self.elapsed = None if self.elapsed == 0 else 0
        else:
            self.took = self.chance.choice([100_000, 1_500_000])

    def supply(self, slot: int) -> None:
        self.bench.put(slot, SupplyOff=not self.bench.slot(slot, "SupplyOff"), StopConfirmed=self.chance.random() < 0.5)

    def claims(self, slot: int) -> None:
        """What a drive block says of its motor and its stops."""
        chance, kind = self.chance, self.bench.kind
        names = ("EndsByAnswer", "ProvedStill", "Tripped", "StopConfirmed")
        self.bench.put(slot, **{name: chance.random() < 0.5 for name in names})
        jog = {"JogStopRegister": kind.stop_address, "JogStopWord": kind.stop_word + 1}
        self.bench.put(slot, JogStop=chance.choice([0, 1, 2]), **jog)

    def clear(self, slot: int) -> None:
        """All is well again, so that the next trouble finds a line that works."""
        del slot
        bench = self.bench
        bench.set(StopAll=False, Restart=False, Acknowledge=not bench["Acknowledge"])
        bench.block["Port.ErrorID"] = 0
        bench.port_takes, bench.echoes, self.elapsed = True, bench.config.echo, None
        bench.attended = set(range(bench.config.drives))
        for slot, drive in enumerate(bench.drives):
            drive.alive, drive.answer, drive.unit = True, None, slot + 1
            bench.put(slot, UnitAddress=slot + 1, Shared=False, SupplyOff=False, BusyReason=0, TwoByteCount=False)
            bench.fill_as_kind(slot)


def walk(seed: int, scans: int = SCANS, block: Instance | None = None) -> Bench:
    """Walk a seed. Raises BrokenRuleError with the seed."""
    bench = Bench(config_of(seed), seed, block)
    Walk(bench, Random(f"walk {seed}"), seed).go(scans)
    return bench


if __name__ == "__main__":
    walk(int(sys.argv[1]))
    print("every rule has held")
