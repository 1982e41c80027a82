"""Omron 3G3MX2, which is Hitachi's WJ200: from Omron's manuals I570 (appendix B) and I585 (section 6), Hitachi's NT325.

Coils and registers are the manuals' numbers here; on the wire each is one less (I585 page 6-11).
"""

from collections.abc import Callable
from dataclasses import dataclass
from struct import unpack
from typing import Any, ClassVar, Literal

from tests.second.drive import Drive, Options, Refusal, Source

RUN, WAY, TRIP, RESET = 0x01, 0x02, 0x03, 0x04  # coils, I585 page 6-27
INPUTS = range(0x07, 0x0E)
COILS = 0x58  # the last one of the list
HIGH, LOW = 0x0001, 0x0002  # F001, I570 page 283
STATUSES = range(0x0003, 0x0006)
TRIPS = range(0x0011, 0x001C)  # counter and the last trip: I570 page 284
MONITORS = (*range(0x1001, 0x1009), *range(0x1009, 0x1015))  # I570 page 287
ENTER, STORES = 0x0900, 0x0902  # I585 page 6-20
A004 = 0x1204
NAMED = {"A001": 0x1201, "A002": 0x1202, "C072": 0x144C, "C076": 0x1450, "C077": 0x1451, "C102": 0x146A}
PARAMETERS = (0x1103, 0x1104, 0x1105, 0x1106, A004, 0x144B, 0x144E, 0x144F, *NAMED.values())
LOSS = {0: ("coast", True), 1: ("ramp", True), 2: ("goes on", False), 3: ("coast", False), 4: ("ramp", False)}
"""C076: 00 trips, 01 decelerates and trips, 02 ignores, 03 runs free, 04 decelerates; words of SJ700, page 4-129."""


@dataclass(frozen=True, kw_only=True)
class Mx2Options(Options):
    """... and what the manuals leave open: edges of coils, a direction that changes, what a reset does beside that."""

    comm_when: Literal["running", "always"] = "always"  # from the first exchange on: SJ700 page 4-129
    run_acts: Literal["once", "always"] = "always"  # a run coil that is written again starts a drive that has stopped
    way_while_running: Literal["turns", "next start"] = "turns"
    reset_acts: Literal["rise", "fall"] = "rise"  # C102: when the signal goes ON, or OFF
    reset_cuts: bool = True  # a reset of a drive that runs shuts its output off: I585 page 5-100, C102 = 00
    reset_keeps_coils: bool = True
    reset_deaf_us: int = 1_000_000  # software in use waits for so long
    coil_13: Literal["running", "tripped"] = "running"  # I585 page 6-27 prints that it is 1 during a trip
    coast_runs: bool = False  # 000FH says run while the motor coasts
    half_pairs: bool = True  # one register of two can be read alone
    volts: Literal[1, 10] = 10  # counts of the voltage at a trip in a volt: I585 page 6-31; 1 in I570 page 284


class Mx2(Drive):
    """An MX2 on its RS-485 terminals."""

    o: Mx2Options
    CODES: ClassVar[dict[str, int]] = {
        "function": 0x01, "address": 0x02, "count": 0x03, "value": 0x21, "running": 0x22, "mode": 0x22, "busy": 0x22,
        "low voltage": 0x22, "read only": 0x23,
    }  # fmt: skip  # I585 page 6-18
    MOST: ClassVar[dict[int, int]] = {1: 32, 3: 16, 5: 1, 6: 1, 8: 1, 16: 16}  # I585 page 6-5
    IDS = ("C072", "A002", "A001")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "terminals", 2: "keypad", 3: "bus"}
    SPEED_FROM_BUS = 3
    LOW_VOLTAGE, LINE_LOST = 9, 41

    def __init__(self, unit: int = 1, options: Mx2Options | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; `coils` are those that can be written, by number."""
        o = options or Mx2Options()
        self.coils: set[int] = set()
        self.trips = 0
        self.at_trip = (0, 0, 0)
        self.eeprom = dict.fromkeys(PARAMETERS, 0) | {A004: round(100 * o.maximum_hz)}
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"A001": 3, "A002": 3, "C072": 1, "C076": 0, "C077": 0, "C102": 0}

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        told = {each: self.ram.get(each - 1, 0) if kept else 0 for each in (HIGH, LOW)}
        if not kept:
            self.coils.clear()
        self.eeprom |= {NAMED[name]: word for name, word in self.settings.items()}
        rows = dict.fromkeys((*STATUSES, *TRIPS, *MONITORS, ENTER, STORES), 0) | self.eeprom | told
        self.ram = {number - 1: word for number, word in rows.items()}
        super()._power_up(now_us, kept=kept)

    def _line_watch(self) -> tuple[int | None, str, bool]:
        how, trips = LOSS[self.force["C076"]] if self.force["C076"] else (self.o.comm_action, self.o.comm_trips)
        return (10_000 * self.force["C077"] or self.o.comm_us), how, trips

    # ------------------------------------------------------------ coils

    def _serve(self, body: bytes, now_us: int) -> bytes | None:
        if body[1] not in (1, 5):
            return super()._serve(body, now_us)
        if len(body) != 6:
            return None
        first, word = unpack(">HH", body[2:6])
        self._refuse(body, now_us, reads=1)
        if body[1] == 1:
            return body[:2] + self._read_coils(first + 1, word, now_us)
        if word not in (0, 0xFF00):
            raise Refusal("count")
        self._coil(first + 1, word != 0, now_us)
        if self.o.fed_by == "writes":
            self.heard_us = now_us
        return body

    def _read_coils(self, first: int, number: int, now_us: int) -> bytes:
        if not 1 <= number <= self.MOST[1]:
            raise Refusal("count")
        if first > COILS:
            raise Refusal("address")
        on = [self._is_on(each, now_us) for each in range(first, first + number)]  # beyond the list: 0
        size = (number + 7) // 8
        return bytes([size]) + sum(1 << place for place, each in enumerate(on) if each).to_bytes(size, "little")

    def _is_on(self, number: int, now_us: int) -> bool:
        shown = self.SHOWN.get(number)
        return bool(shown(self, now_us)) if shown else number in self.coils

    def _coil(self, number: int, on: bool, now_us: int) -> None:
        if number in (RUN, WAY, TRIP, RESET) or number in INPUTS:
            rose, fell = on and number not in self.coils, not on and number in self.coils
            (self.coils.add if on else self.coils.discard)(number)
            self._act(number, rose=rose, fell=fell, now_us=now_us)
        else:
            raise Refusal("read only" if 0 < number <= COILS else "address")

    def _act(self, number: int, *, rose: bool, fell: bool, now_us: int) -> None:
        turns = number == WAY and (rose or fell) and RUN in self.coils and self.o.way_while_running == "turns"
        starts = number == RUN and RUN in self.coils and (rose or self.o.run_acts == "always")
        if number == RUN and RUN not in self.coils:
            self._bus("stop", now_us)
        elif starts or turns:
            self._bus("run_reverse" if WAY in self.coils else "run_forward", now_us)
        elif number == TRIP and rose:
            self.trip(12, now_us)
        elif number == RESET and (rose if self.o.reset_acts == "rise" else fell):
            self._reset_signal(now_us)

    def _reset_signal(self, now_us: int) -> None:
        self.deaf_us = now_us + self.o.reset_deaf_us  # after its reply
        if not self.o.reset_keeps_coils:
            self.coils.clear()
            self.commanded = None
        if self.fault is None and self.output and self.o.reset_cuts:
            self.commanded = None
            self._release(now_us)
        self._bus("reset", now_us)

    # ------------------------------------------------------------ registers

    def _words(self, first: int, number: int, now_us: int) -> Any:
        pairs = {HIGH - 1, 0x1001 - 1}
        if not self.o.half_pairs and ((number == 1 and first in pairs) or first - 1 in pairs):
            raise Refusal("address")
        return super()._words(first, number, now_us)

    def _write(self, words: dict[int, int], now_us: int) -> None:
        self._listed(words)
        if any(address in self.LIVE for address in words):
            raise Refusal("read only")
        told = {HIGH - 1, LOW - 1} & words.keys()
        if told:
            pair = self.ram | words
            self._refer_word(pair[HIGH - 1] << 16 | pair[LOW - 1], now_us)
        for address, word in words.items():
            if address not in told:
                self._parameter(address + 1, word, now_us)
            self.ram[address] = word

    def _parameter(self, number: int, word: int, now_us: int) -> None:
        if now_us < self.busy_us:
            raise Refusal("busy")
        if self.output and number in (ENTER, A004, *NAMED.values()):
            raise Refusal("running")
        if number == ENTER and word:
            self.eeprom |= {each: self.ram[each - 1] for each in PARAMETERS}
            self.store(number, word, now_us)
        if number == A004:
            self.maximum_hz = word / 100

    def _refer_word(self, counts: int, now_us: int) -> None:
        hz = counts / 100  # 0.01 Hz, I570 page 283
        if hz > self.maximum_hz + 1e-9:
            raise Refusal("value")
        self._refer(min(hz, self.maximum_hz), now_us)

    def _trip(self, fault: Any, now_us: int, how: str) -> None:
        self.trips += 1
        self.at_trip = (self._doing(now_us), self._counts(now_us, 0.01), 100 * self.output)
        super()._trip(fault, now_us, how)

    def _doing(self, now_us: int) -> int:
        """Status C: stopped, deceleration, constant speed, acceleration."""
        hz, goal = abs(self.motor.hz(now_us)), abs(self._goal())
        return 1 if not self.output else 2 if self.stopping or hz > goal else 3 if hz == goal else 4

    def _status(self, now_us: int) -> int:
        """Status A."""
        if self.fault is not None:
            return 8
        if self.runs:
            return 3
        return 4 if not self.output and self.motor.hz(now_us) and self.o.coast_runs else 2

    def _says_run(self, now_us: int) -> bool:
        coasts = self.o.coast_runs and not self.output and self.motor.hz(now_us) != 0
        return self.runs or coasts

    SHOWN: ClassVar[dict[int, Callable[[Any, int], bool]]] = {
        0x0F: _says_run,
        0x10: lambda self, now_us: self.reverse(now_us) or (not self.output and self.motor.hz(now_us) < 0),
        0x11: lambda self, _: self.fault is None and not self.inhibited,
        0x12: lambda _, __: False,
        0x13: lambda self, _: self.runs if self.o.coil_13 == "running" else self.fault is not None,
        0x14: lambda self, now_us: self.output and not self.stopping and self.motor.hz(now_us) == self._goal() != 0,
        0x16: lambda self, _: self.warned,
        0x18: lambda self, _: self.fault is not None,
        0x49: lambda self, now_us: now_us < self.busy_us,
    }
    """Coils that can only be read, by number."""
    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        number - 1: shown
        for number, shown in {
            0x0003: _status,
            0x0004: lambda self, _: 2 if self.fault is not None else int(self.runs),
            0x0005: _doing,
            0x0011: lambda self, _: self.trips,
            0x0012: lambda self, _: self.code or 0,
            0x0013: lambda self, _: self.at_trip[0],
            0x0015: lambda self, _: self.at_trip[1],
            0x0016: lambda self, _: self.at_trip[2],
            0x0017: lambda self, _: 284 * self.o.volts,
            0x1001: lambda _, __: 0,
            0x1002: lambda self, now_us: self._counts(now_us, 0.01),
            0x1003: lambda self, _: 100 * self.output,
            0x1004: lambda self, now_us: (2 if self.reverse(now_us) else 1) if self.runs else 0,
        }.items()
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {"OutputCurrentA": (0x1002, 0.01)}  # 1003H, I570 page 287


def stores(body: bytes) -> bool:
    """Whether a request without checksum stores something: 1 and more at 0900H, or the next write after 0902H."""
    return body[1] == 6 and body[2:4] in (b"\x08\xff", b"\x09\x01") and body[4:6] != b"\0\0"
