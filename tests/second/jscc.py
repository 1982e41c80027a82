"""JSCC inverters, from the maker's Modbus instructions; lines are those of the manual's text."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from tests.second.drive import Drive, Options, Refusal, Source

COMMANDS = {1: "run_forward", 2: "run_reverse", 3: "stop"}  # 1000H, lines 105 to 108; 0 is no function
FAULTS = range(1, 13)  # 3000H, lines 117 to 130


@dataclass(frozen=True, kw_only=True)
class JsccOptions(Options):
    """... and what this manual leaves open. It prints nothing of broadcasts, resets, a lost line's time or action."""

    silence_us: int = 10_000  # lines 83 and 91
    reply_us: tuple[int, int] = (10_000, 10_000)  # the end of a frame is a silence of more than 10 ms, too
    broadcast: bool = False
    reference_milli_hz: Literal[100, 10] = 100  # a count of 1001H; one of the monitor 2000H is 0.1 Hz (line 216)
    commands_readable: bool = False
    stop_resets: bool = False  # a stop resets a fault
    fault_word: Literal[8, 9, 12] = 8  # 2001H in a fault: alone, with running forward, with stopped


class Jscc(Drive):
    """A JSCC inverter."""

    o: JsccOptions
    CODES: ClassVar[dict[str, int]] = {
        "function": 1, "address": 2, "read only": 2, "count": 3, "value": 3, "busy": 6, "running": 7, "mode": 7,
    }  # fmt: skip  # lines 292 to 299, where the column of numbers is empty: in their order
    MOST: ClassVar[dict[int, int]] = {3: 12, 6: 1, 16: 10}  # lines 88, 95 to 99
    IDS = ("FA_00", "F0_04", "F0_08")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "terminals", 2: "terminals", 3: "keypad", 4: "bus"}  # line 24
    SPEED_FROM_BUS = 8  # line 29
    LOW_VOLTAGE, LINE_LOST = 7, 9  # lines 125, 127

    def __init__(self, unit: int = 1, options: JsccOptions | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive."""
        self.eeprom = dict.fromkeys(range(0x0100), 0)  # 00nnH, line 104
        super().__init__(unit, options or JsccOptions(), at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"F0_04": 4, "F0_08": 8, "FA_00": 1, "FA_01": 3, "FA_02": 2, "FA_03": 2}

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        commands = dict.fromkeys(range(0x1000, 0x1003), 0)
        self.ram = self.eeprom | ({each: self.ram.get(each, 0) for each in commands} if kept else commands)
        super()._power_up(now_us, kept=kept)
        if self.force["F0_04"] == 2 and self.contact:  # a closed terminal starts at power-up: line 24
            self._run(1, False, "terminals", now_us)

    def _words(self, first: int, number: int, now_us: int) -> Iterable[int]:
        if not self.o.commands_readable and first <= 0x1002 and first + number > 0x1000:
            raise Refusal("address")
        return super()._words(first, number, now_us)

    def _write(self, words: dict[int, int], now_us: int) -> None:
        listed = self._listed(words)
        if any(address in self.LIVE for address in listed):
            raise Refusal("read only")
        hz = words.get(0x1001, 0) * self.o.reference_milli_hz / 1000
        if words.get(0x1000, 0) > 3 or (hz > self.maximum_hz):
            raise Refusal("value")
        parameters = [address for address in listed if address < 0x0100]
        if parameters and now_us < self.busy_us:
            raise Refusal("busy")
        if parameters and self.output:
            raise Refusal("running")
        self.ram |= {address: words[address] for address in listed}
        for address in parameters:
            self.eeprom[address] = words[address]
            self.store(address, words[address], now_us)
        if 0x1001 in words:
            self._refer(hz, now_us)
        if what := COMMANDS.get(words.get(0x1000, 0)):
            self._bus(what, now_us)
            if what == "stop" and self.o.stop_resets:
                self.reset(now_us)

    def _status(self, now_us: int) -> int:
        """2001H, lines 112 to 116."""
        if self.fault is not None:
            return self.o.fault_word
        if not self.runs:
            return 4
        return 2 if self.reverse(now_us) else 1

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        0x2000: lambda self, now_us: self._counts(now_us, 0.1),  # 500 is 50.0 Hz: line 216
        0x2001: _status,
        0x3000: lambda self, _: self.code or 0,
    }


def stores(body: bytes) -> bool:
    """Whether a request without checksum may store something: a write to 00nnH."""
    return body[1] in (6, 16) and body[2] == 0
