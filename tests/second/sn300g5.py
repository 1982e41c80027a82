"""SHUEN SN300G5, from its manual V20160418; lines are those of the manual's text."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import chain
from typing import Any, ClassVar, Literal

from tests.second.drive import Drive, Fault, Options, Refusal, Source

RUN, SPEED = 0, 1
COMMANDS = (0x0000, 0x0001, 0x0006, 0x0007, 0x0008, 0x0009, 0x000F)  # table (I), lines 238 to 263
UNUSED = (*range(0x0002, 0x0006), 0x000E, 0x0013)  # rows that say unused: lines 249, 261, 292
READ_ONLY = (
    *range(0x0010, 0x0013), *range(0x0014, 0x001B),  # table (I), lines 271 to 376
    *range(0x0020, 0x0037), *range(0x0039, 0x003C), *range(0x0080, 0x008E), *range(0x0090, 0x0098),  # (II) to (IV)
)  # fmt: skip
PARAMETERS = tuple(
    chain(
        range(0x0100, 0x0126), range(0x0180, 0x01A6), range(0x0200, 0x0243), range(0x0280, 0x0297),
        range(0x0300, 0x030D), range(0x030E, 0x0325), range(0x0380, 0x0398), range(0x0400, 0x0421),
        range(0x0480, 0x04B2), range(0x0500, 0x050E),
    )
)  # fmt: skip
"""Table (V), lines 502 to 819; the second 0210H (line 587) is taken for 0220H."""
ENTER = 0xFFFD  # table (VI), line 824
AFTER_CPF03 = (*range(0x0100, 0x0106), 0x0302, 0x0508)  # what can be written after it: line 863
NAMED = {
    0x0180: ("b1_01", 4), 0x0181: ("b1_02", 4), 0x041C: ("H5_01", 0x20), 0x041D: ("H5_02", 4),
    0x041E: ("H5_03", 2), 0x041F: ("H5_04", 3), 0x0420: ("H5_05", 1),
}  # fmt: skip
"""Settings with their greatest word: table of lines 48 to 55, addresses of lines 509, 510, 744 to 748."""
SERIOUS = (
    "FU UV1 UV2 UV3 SC GF OC OV OH OH1 OL1 OL2 OL3 OL4 RR RH",  # 0014H, lines 293 to 309; numbers 01H to 10H
    "EF3 EF4 EF5 EF6 EF7 EF8 FAN OS DEV PGO PF LF - OPR ERR -",  # 0015H, lines 311 to 327; 11H to 1FH
    "CE - - - CF SVE",  # 0016H, lines 328 to 333; 21H, 25H, 26H
    "- - CPF02 CPF03 CPF04 CPF05 CPF06",  # 0017H, lines 334 to 342, without a number
    "CPF20 CPF21 CPF22 CPF23",  # 0018H, lines 343 to 348
)
MINOR = (
    "UV OV OH OH2 OL3 OL4 EF BB EF3 EF4 EF5 EF6 EF7 EF8 FAN OS",  # 0019H, lines 350 to 366
    "DEV PGO OPR CE - - OL1 OL2",  # 001AH, lines 367 to 376
)
SERIOUS_AT = {name: (row, bit) for row, names in enumerate(SERIOUS) for bit, name in enumerate(names.split())}
MINOR_AT = {name: (row, bit) for row, names in enumerate(MINOR) for bit, name in enumerate(names.split())}
LOSS = {0: "ramp", 1: "quick", 2: "coast", 3: "goes on"}
"""H5-04, line 54: 0 decelerates, 1 emergency stop, 2 coasts, 3 goes on."""
CE_RESET_US = 2_000_000
"""A CE is reset only if a good frame came in the 2 s before: line 869."""


@dataclass(frozen=True, kw_only=True)
class Sn300g5Options(Options):
    """... and what this manual leaves open. H5-04 and H5-05 say what a lost line does; `comm_us` is not printed."""

    settings_act: Literal["power cycle", "at once"] = "power cycle"  # lines 46 and 873
    comm_us: int | None = 2_000_000
    holes: Literal["refused", "refused alone", "zero"] = "refused alone"  # not one of them is registered: line 860
    key_cuts_line: bool = True  # a key pressed while the bus talks ends that until the next power-up: line 874
    run_needs_edge: bool = False  # a run bit acts only when it rises
    zero_speed_of: Literal["output", "shaft"] = "output"
    bus_volts: int = 589


class Sn300g5(Drive):
    """An SN300G5 on RS-485."""

    o: Sn300g5Options
    CODES: ClassVar[dict[str, int]] = {
        "function": 0x01, "address": 0x02, "count": 0x03, "value": 0x21, "running": 0x22, "read only": 0x22,
        "mode": 0x22, "low voltage": 0x23, "busy": 0x24,
    }  # fmt: skip  # lines 858 to 865
    MOST: ClassVar[dict[int, int]] = {3: 16, 8: 1, 16: 16}  # lines 79, 87, 861
    IDS = ("H5_01", "b1_02", "b1_01")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {0: "keypad", 1: "terminals", 2: "bus"}  # line 50
    SPEED_FROM_BUS = 2  # line 49
    BROADCASTS = (0, 1, 2)  # line 860
    LOW_VOLTAGE, LINE_LOST = "UV1", "CE"

    def __init__(self, unit: int = 1, options: Sn300g5Options | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; minor faults are words of `minor`."""
        o = options or Sn300g5Options()
        self.minor: set[str] = set()
        self.at_fault = (0, 0)
        self.eeprom = dict.fromkeys((*COMMANDS, *READ_ONLY, *PARAMETERS, ENTER, *UNUSED), 0)
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"b1_01": 2, "b1_02": 2, "H5_01": 1, "H5_02": 3, "H5_03": 1, "H5_04": 1, "H5_05": 1}

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        words = {each: self.ram[each] for each in (RUN, SPEED)} if kept and self.ram else {}
        self.eeprom |= {address: self.settings[name] for address, (name, _) in NAMED.items()}
        self.ram = self.eeprom | {0x000F: 0} | words
        self.minor.clear()
        super()._power_up(now_us, kept=kept)

    def set(self, name: str, word: int, now_us: int) -> None:
        """As for every drive; the register shows it."""
        address = next(each for each, (known, _) in NAMED.items() if known == name)
        self.ram[address] = self.eeprom[address] = word
        super().set(name, word, now_us)

    def press(self, key: Literal["start", "stop", "reset", "local"], now_us: int) -> None:
        """As for every drive; the line may be deaf from then on: line 874."""
        super().press(key, now_us)
        self.cut |= self.o.key_cuts_line

    def warn(self, name: str, on: bool = True) -> None:
        """A minor fault comes or goes."""
        (self.minor.add if on else self.minor.discard)(name)

    def _trip(self, fault: Fault, now_us: int, how: str) -> None:
        self.at_fault = (self._frequency(self.reference_hz), self._output(now_us))
        super()._trip(fault, now_us, how)

    def _may_reset(self, now_us: int) -> bool:
        return self.fault != "CE" or now_us - self.good_us <= CE_RESET_US

    def _line_watch(self) -> tuple[int | None, str, bool]:
        return (self.o.comm_us if self.force["H5_05"] else None), LOSS[self.force["H5_04"]], True

    def _words(self, first: int, number: int, now_us: int) -> Iterable[int]:
        if first + number > ENTER:
            raise Refusal("address")
        return super()._words(first, number, now_us)

    # ------------------------------------------------------------ writing

    def _write(self, words: dict[int, int], now_us: int) -> None:
        listed = self._listed(words)
        if any(address in READ_ONLY for address in listed):
            raise Refusal("read only")
        parameters = [address for address in listed if address >= 0x0100]
        if parameters:
            self._may_store(parameters, now_us)
        for address in listed:
            self._check(address, words[address])
        was = self.ram[RUN]
        self.ram |= {address: words[address] for address in listed if address not in UNUSED}
        self._settings(parameters, now_us)
        if SPEED in words or 0x000F in words:
            self._refer(self.ram[SPEED] * self.count_hz, now_us)
        if RUN in words:
            self._run_word(words[RUN], was, now_us)

    def _may_store(self, parameters: list[int], now_us: int) -> None:
        """Lines 863 to 865. Raises Refusal."""
        if now_us < self.busy_us:
            raise Refusal("busy")
        low = self.fault in ("UV1", "UV2", "UV3") or "UV" in self.minor
        if self.output or low:
            raise Refusal("running" if self.output else "low voltage")
        if self.fault == "CPF03" and any(address not in AFTER_CPF03 for address in parameters):
            raise Refusal("running")

    def _check(self, address: int, word: int) -> None:
        """Control data or a parameter beyond its limits: line 862. Raises Refusal."""
        above = address == SPEED and word * self.count_hz > self.o.maximum_hz + 1e-9
        volts = address in (0x0007, 0x0008) and 726 < word < 0x10000 - 726  # 11 V is 726: lines 251, 252
        beyond = address in NAMED and word > NAMED[address][1]
        if above or volts or beyond or (address == ENTER and word):
            raise Refusal("value")

    def _settings(self, parameters: list[int], now_us: int) -> None:
        if ENTER in parameters:  # RAM goes to EEPROM: line 826
            self.eeprom |= {address: self.ram[address] for address in PARAMETERS}
            self.settings |= {name: self.eeprom[address] for address, (name, _) in NAMED.items()}
            self.store(ENTER, 0, now_us)
        if self.o.settings_act == "at once" and parameters:
            self._take_up({name: self.ram[address] for address, (name, _) in NAMED.items()}, now_us)

    def _run_word(self, word: int, was: int, now_us: int) -> None:
        rose = word & ~was
        self.warn("EF", on=word & 3 == 3)  # bits 0 and 1 together are a fault of 2-wire input: line 357
        runs = {0: "stop", 1: "run_forward", 2: "run_reverse", 3: "stop"}[word & 3]
        if runs == "stop" or rose & 3 or not self.o.run_needs_edge:
            self._bus(runs, now_us)

    # ------------------------------------------------------------ reading

    @property
    def count_hz(self) -> float:
        """Hz in a count of reference and monitors: line 263."""
        return 0.1 if self.ram[0x000F] & 1 else 0.01

    def _frequency(self, hz: float) -> int:
        return int(hz / self.count_hz + 1e-9)

    def _output(self, now_us: int) -> int:
        return self._counts(now_us, self.count_hz)

    def _status(self, now_us: int) -> int:
        """0010H, lines 271 to 280, and 002BH, line 392."""
        hz = self.motor.hz(now_us)
        zero = not (hz if self.output or self.o.zero_speed_of == "shaft" else 0)
        agrees = self.runs and not self.stopping and hz == self._goal() != 0
        bits = (self.runs, zero, self.reverse(now_us), False, agrees)
        ready = self.fault is None and not self.inhibited
        lights = (ready, bool(self.minor) or self.warned or self.inhibited, self.fault is not None)
        return sum(bit << place for place, bit in enumerate(bits + lights))

    def _serious(self, row: int) -> int:
        at = SERIOUS_AT.get(str(self.fault))
        return 1 << at[1] if at and at[0] == row else 0

    def _minor(self, row: int) -> int:
        names = self.minor | ({"CE"} if self.warned else set()) | ({"BB"} if self.inhibited else set())
        return sum(1 << bit for at, bit in (MINOR_AT[name] for name in names) if at == row)

    @staticmethod
    def number(fault: Fault | None) -> int:
        """The fault's number: lines 459 to 497, where it is 1 + 16 x row + bit; 0: none, and for CPF."""
        row, bit = SERIOUS_AT.get(str(fault), (9, 0))
        return 1 + 16 * row + bit if row < 3 else 0

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        0x0010: _status,
        0x0014: lambda self, _: self._serious(0), 0x0015: lambda self, _: self._serious(1),
        0x0016: lambda self, _: self._serious(2), 0x0017: lambda self, _: self._serious(3),
        0x0018: lambda self, _: self._serious(4),
        0x0019: lambda self, _: self._minor(0), 0x001A: lambda self, _: self._minor(1),
        0x0020: lambda self, _: self._frequency(self.reference_hz if self.speed_from_bus else self.o.own_hz),
        0x0021: _output,
        0x0022: lambda self, _: 100 * self.output,
        0x0026: lambda self, _: self.o.bus_volts,
        0x0027: lambda self, _: 75 * self.output,
        0x002B: _status,
        0x0080: lambda self, _: self.number(self.code), 0x0081: lambda self, _: self.number(self.last_fault),
        0x0082: lambda self, _: self.at_fault[0], 0x0083: lambda self, _: self.at_fault[1],
        0x0090: lambda self, _: self.number(self.last_fault),
    }  # fmt: skip
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {
        "OutputCurrentA": (0x0022, 1), "Diagnosis.DcBusVoltageV": (0x0026, 0.01),
        "Diagnosis.OutputPowerKW": (0x0027, 1),
    }  # fmt: skip  # lines 383, 387 and 388


def stores(body: bytes) -> bool:
    """Whether a request without checksum stores something: ENTER."""
    return body[1] == 16 and body[2:4] == b"\xff\xfd"
