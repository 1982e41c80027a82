"""INVT Goodrive200A, from chapter 9 and groups P00, P07 and P14 of its operation manual, whose pages are given."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from tests.second.drive import Drive, Options, Refusal, Source

COMMANDS = {
    1: "run_forward", 2: "run_reverse", 3: "jog_forward", 4: "jog_reverse", 5: "stop", 6: "coast", 7: "reset",
    8: "jog_stop",
}  # fmt: skip  # 2000H, page 139
CONTROL, FREQUENCY = 0x2000, 0x2001
TOLD = range(0x2000, 0x200F)  # pages 139 and 140
RESERVED = (0x300F, 0x3011)  # page 141
MONITORS = tuple(each for each in range(0x3000, 0x3017) if each not in RESERVED)
PARAMETERS = tuple(256 * group + number for group in range(18) for number in range(40))  # high byte, low byte: 9.5.1
RAM_ONLY = 0x8000  # 9.5.1
LOSS = {0: "coast", 1: "goes on", 2: "ramp", 3: "ramp"}  # P14.05, page 93
IDS = {"P00.01": 0x0001, "P00.06": 0x0006, "P14.00": 0x0E00, "P14.04": 0x0E04, "P14.05": 0x0E05}


@dataclass(frozen=True, kw_only=True)
class Gd200aOptions(Options):
    """... and what chapter 9 leaves open: which stop ends what, refusals that fit two codes, reserved rows."""

    stop_ends_jog: bool = True  # 0005H
    jog_stop_ends_run: bool = False  # 0008H
    jogs_from_run: bool = False  # a jog that is asked for while it runs is carried out
    coast_stopped: bool = True  # 2100H says stop while the motor coasts; else running
    reserved_rows: bool = False
    commands_readable: bool = True  # R/W of 2000H, page 139; the text below the table calls it one that is written


class Gd200a(Drive):
    """A Goodrive200A on its 485 terminals."""

    o: Gd200aOptions
    CODES: ClassVar[dict[str, int]] = {
        "function": 1, "mode": 1, "address": 2, "read only": 2, "count": 3, "value": 4, "busy": 7, "running": 8,
    }  # fmt: skip  # page 143; which of them a busy drive gives is open
    MOST: ClassVar[dict[int, int]] = {3: 16, 6: 1, 8: 1, 16: 16}  # 9.4.1.1, 9.4.1.4
    IDS = ("P14_00", "P00_01", "P00_06")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {0: "keypad", 1: "terminals", 2: "bus"}  # P00.01
    SPEED_FROM_BUS = 8  # P00.06
    LOW_VOLTAGE, LINE_LOST = 10, 18  # UV and CE of P07.27, page 72

    def __init__(self, unit: int = 1, options: Gd200aOptions | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; P00.03 is what the options give as the maximum."""
        o = options or Gd200aOptions()
        self.eeprom = dict.fromkeys(PARAMETERS, 0) | {0x0003: round(100 * o.maximum_hz)}
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"P14_00": 1, "P00_01": 2, "P00_06": 8, "P14_05": 0}

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        told = {each: self.ram.get(each, 0) if kept else 0 for each in TOLD}
        rows = MONITORS + (RESERVED if self.o.reserved_rows else ())
        self.eeprom |= {IDS[name.replace("_", ".")]: word for name, word in self.settings.items()}
        self.ram = self.eeprom | dict.fromkeys(rows, 0) | told
        super()._power_up(now_us, kept=kept)

    def _line_watch(self) -> tuple[int | None, str, bool]:
        action = self.force["P14_05"]
        return self.o.comm_us, LOSS[action], action == 0

    def _words(self, first: int, number: int, now_us: int) -> Any:
        if not self.o.commands_readable and first in TOLD:
            raise Refusal("address")
        return super()._words(first, number, now_us)

    def _write(self, words: dict[int, int], now_us: int) -> None:
        if now_us < self.busy_us and not all(address in TOLD for address in words):
            raise Refusal("busy")
        for address, word in words.items():
            plain = address & ~RAM_ONLY
            if plain not in self.eeprom and address not in TOLD:
                raise Refusal("read only")
            if address in TOLD:
                self._told(address, word, now_us)
            else:
                self._parameter(plain, word, stored=address == plain, now_us=now_us)

    def _parameter(self, address: int, word: int, *, stored: bool, now_us: int) -> None:
        if address == IDS["P00.01"] and word > 2:  # 9.5.4
            raise Refusal("value")
        if self.output and address in (0x0001, 0x0003):  # those that are marked so in chapter 6
            raise Refusal("running")
        self.ram[address] = word
        if stored:
            self.eeprom[address] = word
            self.store(address, word, now_us)
        if address == 0x0003:
            self.maximum_hz = word / 100

    def _told(self, address: int, word: int, now_us: int) -> None:
        if address == FREQUENCY:
            self._refer_word(word, now_us)
        elif address == CONTROL and (what := COMMANDS.get(word)):
            self._command(what, now_us)
        elif address == CONTROL:
            raise Refusal("value")
        self.ram[address] = word

    def _refer_word(self, word: int, now_us: int) -> None:
        hz = word / 100  # 0.01 Hz, 0 to Fmax: page 139
        if hz > self.maximum_hz:
            raise Refusal("value")
        self._refer(min(hz, self.maximum_hz), now_us)

    def _command(self, what: str, now_us: int) -> None:
        if what == "stop" and self.jogging and not self.o.stop_ends_jog:
            return
        if what == "jog_stop" and self.by == "bus" and not self.jogging and not self.o.jog_stop_ends_run:
            return
        jogs = what in ("jog_forward", "jog_reverse")
        if not (jogs and self.output and not self.jogging and not self.o.jogs_from_run):
            self._bus(what, now_us)

    def _status(self, now_us: int) -> int:
        """2100H: 1 and 2 running, 3 stop, 4 fault; page 140 prints 2 as forward, too."""
        if self.fault is not None:
            return 4
        coasts = not self.output and not self.o.coast_stopped and self.motor.hz(now_us) != 0
        if not self.runs and not coasts:
            return 3
        return 2 if self.reverse(now_us) or (coasts and self.motor.hz(now_us) < 0) else 1

    def _more(self, _now_us: int) -> int:
        """2101H: bit 0 the bus voltage, bit 4 an overload, bits 6 and 5 who controls."""
        who = "keypad" if self.local else self.run_source
        return 1 + (self.warned << 4) + ({"keypad": 0, "terminals": 1, "bus": 2}[who] << 5)

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        0x2100: _status,
        0x2101: _more,
        0x2102: lambda self, _: self.code or 0,
        0x2103: lambda _, __: 0x0107,  # page 140; the text on page 142 gives others
        0x3000: lambda self, now_us: self._counts(now_us, 0.01),
        0x3001: lambda self, _: int(100 * (self.reference_hz if self.speed_from_bus else self.o.own_hz)),
        0x3002: lambda _, __: 540,
        0x3003: lambda self, _: 380 * self.output,
        0x3004: lambda self, _: 100 * self.output,
        0x3005: lambda self, _: 1450 * self.output,
        0x3006: lambda self, _: -250 * self.output,
        0x5000: lambda self, _: self.code or 0,
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {
        "Diagnosis.DcBusVoltageV": (0x3002, 1), "Diagnosis.OutputVoltageV": (0x3003, 1),
        "OutputCurrentA": (0x3004, 0.1), "Diagnosis.OutputSpeedRpm": (0x3005, 1),
        "Diagnosis.RelativePowerPercent": (0x3006, 0.1),
    }  # fmt: skip  # page 141


def stores(body: bytes) -> bool:
    """Whether a request without checksum stores something: a function code, groups 0 to 14, without the bit for RAM."""
    return body[1] in (6, 16) and body[2] < 0x10
