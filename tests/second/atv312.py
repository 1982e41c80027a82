"""Schneider Altivar 312, from its manuals of communication variables (BBV51701) and of Modbus (BBV52816: M)."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from tests.second.drive import Drive, Options, Refusal, Source

CMD, LFR, CMI = 8501, 8502, 8504  # pages 19 and 20
ETA, RFR, FRH, LCR, OTR, ETI, ULN = range(3201, 3208)  # pages 21 and 22
HSP, LFT, TSP = 3104, 7121, 3401
NAMED = {
    "LAC": 3006, "FR1": 8413, "CHCF": 8401, "CD1": 8423, "RFC": 8411, "STT": 11201, "PST": 64002, "ADD": 6001,
    "TBR": 6003, "TFO": 6004, "TTO": 6005, "SLL": 7010,
}  # fmt: skip
PARAMETERS = (3102, 3103, HSP, 3105, 9001, 9002, 9003, *NAMED.values())
STOPS = {0: "ramp", 1: "quick", 2: "coast"}  # Stt, page 40
LOSS = {0: ("goes on", False), 1: ("coast", True), 6: ("ramp", True), 7: ("quick", True)}  # SLL, page 53
BITS = {"disabled": 0x40, "ready": 0x21, "on": 0x23, "enabled": 0x27, "quick": 0x07, "fault": 0x08,
        "reacts": 0x0F}  # fmt: skip  # page 13


@dataclass(frozen=True, kw_only=True)
class Atv312Options(Options):
    """... and what the manuals leave open: words while a fault is there, what stops, what a saving drive answers."""

    comm_us: int | None = 10_000_000  # ttO, page 55
    fed_by: Literal["any", "own", "writes"] = "own"
    disable_stops: Literal["Stt", "ramp"] = "Stt"  # transition 5, page 12
    leaves: Literal["at once", "at standstill"] = "at once"  # ... and the STOP key: when operation enabled is left
    reset_to: Literal["disabled", "ready"] = "disabled"  # page 12 says disabled
    code_after_reset: Literal["zero", "last"] = "last"  # LFt stays: page 24
    reached_at_rest: bool = True  # ETA bit 10 at standstill


class Atv312(Drive):
    """An Altivar 312 on its Modbus socket, at LAC = L3."""

    o: Atv312Options
    CODES: ClassVar[dict[str, int]] = {
        "function": 1, "address": 2, "read only": 2, "count": 3, "value": 3, "running": 4, "mode": 4, "busy": 4,
    }  # fmt: skip  # M page 15
    MOST: ClassVar[dict[int, int]] = {3: 29, 6: 1, 16: 27}  # M page 12
    IDS = ("ADD", "CD1", "FR1")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "terminals", 2: "keypad", 10: "bus"}  # page 37
    SPEED_FROM_BUS = 164  # page 35
    LOW_VOLTAGE, LINE_LOST = 22, 5  # page 24

    def __init__(self, unit: int = 1, options: Atv312Options | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; `at` is its state of the chart, `then` the one that follows where the motor stops."""
        o = options or Atv312Options()
        self.at, self.then, self.word = "disabled", "", 0
        self.eeprom = dict.fromkeys(PARAMETERS, 0) | {HSP: round(10 * o.maximum_hz)}
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return {"LAC": 2, "FR1": 164, "CHCF": 1, "CD1": 1, "RFC": 96, "STT": 0, "PST": 1, "ADD": 1, "TBR": 32, "TFO": 3,
                "TTO": 100, "SLL": 1}  # fmt: skip

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        told = {each: self.ram.get(each, 0) if kept else 0 for each in (CMD, LFR)}
        self.eeprom |= {NAMED[name]: word for name, word in self.settings.items()}
        self.ram = self.eeprom | told | {CMI: 0} | dict.fromkeys(range(ETA, ULN + 5), 0)
        self.word, self.at = told[CMD], self.at if kept else "disabled"
        super()._power_up(now_us, kept=kept)

    def _take_up(self, settings: dict[str, int], now_us: int) -> None:
        combined = settings["CHCF"] == 1  # commands come from where the reference comes from, page 36
        super()._take_up(settings | ({"CD1": 10 if settings["FR1"] == 164 else 1} if combined else {}), now_us)

    def _line_watch(self) -> tuple[int | None, str, bool]:
        how, trips = LOSS[self.force["SLL"]]
        if self.force["SLL"] == 1:
            how, trips = self.o.comm_action, True
        return self.o.comm_us, how, trips

    # ------------------------------------------------------------ writing

    def _write(self, words: dict[int, int], now_us: int) -> None:
        self._listed(words)
        if any(address in self.LIVE for address in words):
            raise Refusal("read only")
        for address, word in words.items():
            if address == LFR:
                self._refer_word(word, now_us)
            elif address == CMD:
                self._command(word, now_us)
            else:
                self._parameter(address, word, now_us)
            self.ram[address] = word & ~2 if address == CMI else word

    def _parameter(self, address: int, word: int, now_us: int) -> None:
        if now_us < self.busy_us:
            raise Refusal("busy")
        if self.output and address in NAMED.values():  # R/WS, page 7
            raise Refusal("running")
        if address == CMI and word & 2:
            self.eeprom |= {each: self.ram[each] for each in PARAMETERS}
            self.store(address, word, now_us)
        if address == HSP:
            self.maximum_hz = word / 10
        if address in NAMED.values() and self.at in ("ready", "on", "enabled"):
            self.at, self.commanded = "disabled", None  # transitions 7, 9 and 10, page 10

    def _refer_word(self, word: int, now_us: int) -> None:
        hz = (word - 0x10000 if word >> 15 else word) / 10  # 0.1 Hz, signed: page 19
        if abs(hz) > self.maximum_hz + 1e-9:
            raise Refusal("value")
        self._refer(hz, now_us)

    def _command(self, word: int, now_us: int) -> None:
        """The chart of page 10."""
        begun, self.word = word & ~self.word, word
        if begun & 0x80 and self.fault is not None:
            self.commanded = None
            self._bus("reset", now_us)
            return
        self._settle()
        if self.at == "fault":
            if word & 15 != 15:
                self._bus("stop", now_us)  # no run command stands any more
        elif not word & 2:
            self._go("disabled", "coast", now_us)
        elif not word & 4:
            self._quick(now_us)
        elif self.at != "quick":
            self._switch(word, now_us)

    def _quick(self, now_us: int) -> None:
        if self.at == "enabled":
            self._bus("quick", now_us)
            self.at, self.then = "quick", ""
        elif self.at != "quick":
            self._go("disabled", "coast", now_us)

    def _switch(self, word: int, now_us: int) -> None:
        """Words with voltage, and without a quick stop."""
        if not word & 1:
            self._go("ready", "coast", now_us)  # shutdown, page 10: a freewheel stop
        elif self.at == "ready" and word & 1:
            self.at = "on"
            if word & 8:
                self._enable(word, now_us)  # 3A
        elif self.at in ("on", "enabled"):
            if word & 8:
                self._enable(word, now_us)
            else:
                self._go("on", "Stt", now_us)
        elif not word & 8:
            self._bus("stop", now_us)  # for a drive that others run, whose commands this may end

    def _enable(self, word: int, now_us: int) -> None:
        runs = "run_reverse" if word & 0x800 else "run_forward"
        self._bus("stop" if word & 0x1000 else runs, now_us)
        self.at, self.then = "enabled", ""

    def _go(self, to: str, how: str, now_us: int) -> None:
        if how == "Stt":
            how = STOPS.get(self.force["STT"], "ramp") if self.o.disable_stops == "Stt" else "ramp"
        self._bus({"coast": "coast", "quick": "quick"}.get(how, "stop"), now_us)
        self._leave(to)

    def _leave(self, to: str) -> None:
        """The state after a stop, where the drive is not in operation enabled until its motor is at standstill."""
        if self.o.leaves == "at standstill" and self.at == "enabled" and self.stopping:
            self.then = to
        else:
            self.at, self.then = to, ""

    def _release(self, now_us: int) -> None:
        super()._release(now_us)
        self.at, self.then = self.then or self.at, ""

    def _obey(self, now_us: int, *, itself: bool = False) -> None:
        super()._obey(now_us, itself=itself)
        if self.by == "bus" and not self.stopping:
            self.at, self.then = "enabled", ""

    def _settle(self) -> None:
        """What happens by itself: a fault, its end, a freewheel stop by an input; no run command is left: page 10."""
        if self.fault is not None:
            self.at, self.then = "fault", ""
        elif self.at == "fault":
            self.at, self.commanded = self.o.reset_to, None
        elif self.inhibited:
            self.at, self.commanded = "disabled", None

    def _trip(self, fault: Any, now_us: int, how: str) -> None:
        super()._trip(fault, now_us, how)
        self._settle()

    def _clear(self, now_us: int, *, resumes: bool, itself: bool = False) -> None:
        super()._clear(now_us, resumes=resumes, itself=itself)
        self._settle()

    def inhibit(self, on: bool, now_us: int) -> None:
        """A freewheel stop by an input leads to switch on disabled: page 8."""
        super().inhibit(on, now_us)
        self._settle()

    def press(self, key: Literal["start", "stop", "reset", "local"], now_us: int) -> None:
        """As for every drive; the STOP key leads to switch on disabled: page 8."""
        bus = self.by == "bus"
        super().press(key, now_us)
        if key == "stop" and bus and (self.stopping or not self.output):
            self._leave("disabled")

    # ------------------------------------------------------------ reading

    def _status(self, now_us: int) -> int:
        self._settle()
        hz = self.motor.hz(now_us)
        at = "reacts" if self.at == "fault" and self.output else self.at
        bits = BITS[at] | (0x20 if at in ("disabled", "fault") else 0)
        goal = self.output and not self.stopping and hz == self._goal()
        reached = goal or (not self.output and self.o.reached_at_rest)
        high = (self.warned << 7, (not self.local) << 9, reached << 10, (hz < 0 or self.reverse(now_us)) << 15)
        return bits | sum(high)

    def _extended(self, now_us: int) -> int:
        hz = self.motor.hz(now_us)
        goal = self._goal() if self.output and not self.stopping else 0.0
        who = "keypad" if self.local else self.run_source
        via = {"terminals": 0, "keypad": 1, "bus": 2}[who]
        bits = (
            (now_us < self.busy_us) << 0, 1 << 1, (self.fault is not None and not self.cause) << 2, self.runs << 4,
            (self.output and hz != goal) << 6, (self.output and abs(hz) < abs(goal)) << 9,
            (self.output and abs(hz) > abs(goal)) << 10, via << 13, (self.direction < 0) << 15,
        )  # fmt: skip
        return sum(bits)

    def _signed(self, now_us: int) -> int:
        hz = self.motor.hz(now_us) if self.output or self.o.coast_shows == "shaft" else 0.0
        return int(hz * 10 + (1e-9 if hz >= 0 else -1e-9))

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        ETA: _status,
        RFR: _signed,
        FRH: lambda self, _: int(abs(self.reference_hz) * 10),
        LCR: lambda self, _: 10 * self.output,
        OTR: lambda self, _: 50 * self.output,
        ETI: _extended,
        ULN: lambda _, __: 4000,
        LFT: lambda self, _: self.code or 0,
        TSP: lambda _, __: 128,  # page 26
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {"OutputCurrentA": (LCR, 0.1)}  # page 21


def stores(body: bytes) -> bool:
    """Whether a request without checksum stores something: bit 1 of CMI."""
    return body[1] == 6 and body[2:4] == b"\x21\x38" and bool(body[5] & 2)
