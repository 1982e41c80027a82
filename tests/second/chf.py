"""INVT CHF, from chapter 11 of its manual; lines are those of the manual's text."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from tests.second.drive import Drive, Options, Refusal, Source

COMMANDS = {
    1: "run_forward", 2: "run_reverse", 3: "jog_forward", 4: "jog_reverse", 5: "stop", 6: "coast", 7: "reset",
    8: "jog_stop",
}  # fmt: skip  # 1000H, lines 319 to 326
RESERVED = (0x300E, 0x300F, 0x3011)  # lines 347, 348, 350
MONITORS = tuple(each for each in range(0x3000, 0x3015) if each not in RESERVED)  # lines 333 to 353
RAM_ONLY = 0x8000  # line 314


@dataclass(frozen=True, kw_only=True)
class ChfOptions(Options):
    """... and what this chapter leaves open: nearly every setting, a lost line, and all scales but that of 2000H."""

    two_byte_count: bool = False  # the CRC of the reply at lines 125 to 134 is that of a byte count of two bytes
    stop_ends_jog: bool = True  # 0005H
    jog_stop_ends_run: bool = False  # 0008H
    jogs_from_run: bool = False  # a jog that is asked for while it runs is carried out
    standby_in_coast: bool = True  # 1001H says standby while the motor coasts; else running
    reserved_rows: bool = True  # reserved rows can be read
    bus_volts: int = 540


class Chf(Drive):
    """A CHF on RS-485. The chapter has no ids for settings: `unit`, `run`, `speed` with codes of this model."""

    o: ChfOptions
    CODES: ClassVar[dict[str, int]] = {
        "function": 2, "address": 4, "read only": 4, "count": 5, "value": 5, "running": 6,
        "mode": 6, "busy": 8,
    }  # fmt: skip  # lines 400 to 407
    MOST: ClassVar[dict[int, int]] = {3: 16, 6: 1}  # lines 81, 106, 179
    IDS = ("unit", "run", "speed")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {0: "keypad", 1: "terminals", 2: "bus"}
    SPEED_FROM_BUS = 2
    LOW_VOLTAGE, LINE_LOST = 9, 18  # numbers of this model: the list of faults is in another chapter

    def __init__(self, unit: int = 1, options: ChfOptions | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; `last_error` is 5001H."""
        o = options or ChfOptions()
        self.last_error = 0
        self.eeprom = dict.fromkeys(range(0x0200), 0)  # function codes: line 310
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"unit": 1, "run": 2, "speed": 2}

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        told = {each: self.ram.get(each, 0) if kept else 0 for each in (0x1000, 0x2000)}
        rows = MONITORS + (RESERVED if self.o.reserved_rows else ())
        self.ram = self.eeprom | dict.fromkeys(rows, 0) | told
        super()._power_up(now_us, kept=kept)

    def _count_bytes(self, length: int) -> bytes:
        return length.to_bytes(2 if self.o.two_byte_count and not self.o.ascii else 1, "big")

    def _refused(self, body: bytes, code: int) -> bytes | None:
        """Always a reply of 06 at 5001H: 11.6.5, line 360."""
        self.last_error = code
        return bytes([body[0], 0x06, 0x50, 0x01, 0x00, code])

    def _write(self, words: dict[int, int], now_us: int) -> None:
        address, word = next(iter(words.items()))
        plain = address & ~RAM_ONLY
        parameter = plain < 0x0200
        if not parameter and address not in (0x1000, 0x2000):
            raise Refusal("read only")
        if parameter and now_us < self.busy_us:
            raise Refusal("busy")
        if parameter and self.output:
            raise Refusal("running")
        if parameter:
            self._parameter(plain, word, stored=address == plain, now_us=now_us)
        else:
            self._told(address, word, now_us)

    def _parameter(self, address: int, word: int, *, stored: bool, now_us: int) -> None:
        self.ram[address] = word
        if stored:
            self.eeprom[address] = word
            self.store(address, word, now_us)

    def _told(self, address: int, word: int, now_us: int) -> None:
        if address == 0x2000:
            self._refer_word(word, now_us)
        elif what := COMMANDS.get(word):
            self._command(what, now_us)
        else:
            raise Refusal("value")
        self.ram[address] = word

    def _refer_word(self, word: int, now_us: int) -> None:
        percent = word - 0x10000 if word & 0x8000 else word
        if abs(percent) > 10_000:
            raise Refusal("value")
        self._refer(percent / 10_000 * self.maximum_hz, now_us)

    def _command(self, what: str, now_us: int) -> None:
        if what == "stop" and self.jogging and not self.o.stop_ends_jog:
            return
        if what == "jog_stop" and self.by == "bus" and not self.jogging and not self.o.jog_stop_ends_run:
            return
        jogs = what in ("jog_forward", "jog_reverse")
        if not (jogs and self.output and not self.jogging and not self.o.jogs_from_run):
            self._bus(what, now_us)

    def _status(self, now_us: int) -> int:
        """1001H, lines 327 to 331."""
        if self.fault is not None:
            return 4
        coasts = not self.output and not self.o.standby_in_coast and self.motor.hz(now_us) != 0
        if not self.runs and not coasts:
            return 3
        return 2 if self.reverse(now_us) or (coasts and self.motor.hz(now_us) < 0) else 1

    def _set_hz(self, _now_us: int) -> int:
        hz = self.reference_hz if self.speed_from_bus else self.o.own_hz
        return int((hz if self.o.signed_monitors else abs(hz)) * 100 + 1e-9)

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        0x1001: _status,
        0x3000: lambda self, now_us: self._counts(now_us, 0.01),
        0x3001: _set_hz,
        0x3002: lambda self, _: self.o.bus_volts,
        0x3003: lambda self, _: 380 * self.output,
        0x3004: lambda self, _: 100 * self.output,
        0x3005: lambda self, _: 1450 * self.output,
        0x3006: lambda self, _: 37 * self.output,
        0x5000: lambda self, _: self.code or 0,
        0x5001: lambda self, _: self.last_error,
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {
        "Diagnosis.DcBusVoltageV": (0x3002, 0.01), "Diagnosis.OutputVoltageV": (0x3003, 1),
        "OutputCurrentA": (0x3004, 1), "Diagnosis.OutputPowerKW": (0x3006, 1),
    }  # fmt: skip  # lines 335 to 339


def stores(body: bytes) -> bool:
    """Whether a request without checksum stores something: a function code without the bit for RAM."""
    return body[1] == 6 and body[2] < 2
