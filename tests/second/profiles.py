"""Siemens SINAMICS V20 and ABB ACS355: a control word whose bits 0 to 2 are OFF1, OFF2, OFF3, and a chart of states.

V: V20 Operating Instructions 07/2012, pages 111 to 115, and a transcript of the registers of 05/2017. A: ACS355 User's
Manual, pages 313, 319 and 327. G: SINAMICS G120C, pages 189 to 199. H: ACH550-UH, pages 148 to 165.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from tests.second.drive import Drive, Options, Refusal, Source
from tests.second.motor import NEVER

FAMILIES = ("ACS355", "V20")
ON, RUNNING, HOLDS, PASSES, RESET, PLC, TURN = 1, 8, 0x20, 0x40, 0x80, 0x400, 0x800
"""Bits of the control word: OFF1, operation, ramp not held, setpoint enabled; the last two are Siemens' alone."""
OPERATES, OFFS = HOLDS | PASSES, 6  # OFF2 and OFF3 are off at 1
STW, HSW, ZSW, HIW = 0x63, 0x64, 0x6D, 0x6E  # V page 112
P2000, RESERVED, MONITORS, END = 0xF, 0xC, 0x17, 0x3E
CW, REF1, SW, LAST_ACTUAL = 0, 1, 3, 12  # A page 313
SAVE, FAULTS, SIGN = 1606, (400, 411, 412), 0x8000  # 1607; 0401, 0412, 0413: ACS550-02 page 228
PARAMETERS = (1000, 1002, 1101, 1102, 1104, 1603, SAVE, *range(2200, 2210), 3017, 3018)  # their numbers, less one


@dataclass(frozen=True, kw_only=True)
class ProfileOptions(Options):
    """... and what charts and pages leave open."""

    on_in_ramp: bool = True  # bit 0 that rises in the ramp of OFF1 runs the motor on
    key_to: Literal["ready", "inhibited"] = "inhibited"  # the state after the STOP key
    reached_at_rest: bool = False  # bit 8 of the status without output
    signs: bool = True  # what it shows of its speed has a sign
    ready_us: int = 0  # ACS355: "wait at least 100 ms before proceeding", H page 165
    hz_per_count: float = 0.1  # of 0103, as a wind tunnel's program counts
    way_at_rest: Literal["asked", "clockwise", "counterclockwise"] = "asked"  # V20: bit 14 at 0 Hz, G page 199
    before_plc: Literal["kept", "lost"] = "kept"  # a setpoint that came while bit 10 was 0
    serial: Literal["in command", "not local"] = "in command"  # bit 9: 40037 SERIAL, or G page 199
    speed_alone: Literal["acts", "with bits 6 and 10"] = "with bits 6 and 10"  # where terminals run it: G page 195


class Profile(Drive):
    """What both have in common. `at` is the state, `then` the one that follows when the motor is released."""

    o: ProfileOptions
    WAY: ClassVar[int] = 0
    SET: ClassVar[tuple[Any, ...]]
    """What is written; process data; the row of 100 %, and its counts per Hz; settings as commissioned."""
    MOST: ClassVar[dict[int, int]] = {3: 125, 6: 1, 16: 123}  # V page 111; the standard
    SHOWN: ClassVar[dict[str, int]] = {"inhibited": 0x40, "ready": 1, "on": 3, "enabled": 3, "fault": 0}
    at, then, run, word, held_hz = "inhibited", "", "", 0, 0.0
    low_us: int | None = None  # since when nothing but OFF1 is asked for

    def __init__(self, unit: int, options: ProfileOptions, at_us: int = 0, **settings: int) -> None:
        """As a drive; what is stored outlasts its supply."""
        self.stored: dict[int, int] = {}
        super().__init__(unit, options, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return dict(zip(self.IDS, self.SET[4:], strict=True))

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        self.word, self.at, self.then, self.low_us = self.word if kept else 0, "inhibited", "", None
        rows, told, full, counts = self.SET[:4]
        words = {each: self.ram.get(each, 0) if kept else 0 for each in told}
        self.ram = dict.fromkeys(rows, 0) | {full: round(counts * self.o.maximum_hz)} | self.stored | words
        super()._power_up(now_us, kept=kept)

    @property
    def mine(self) -> bool:
        """Whether the bus is in command."""
        return self.run_source == "bus" and not self.local

    def _command(self, word: int, now_us: int) -> None:
        """The chart: A page 319, G page 189."""
        self._settle(now_us)
        begun, self.word, self.held_hz = word & ~self.word, word, self.motor.hz(now_us)
        self.run = "run_reverse" if word & self.WAY else "run_forward"
        if begun & RESET and self.fault is not None:
            self._bus("reset", now_us)
        if self.fault is not None or not self.mine:
            self._bus("stop" if word & 15 != 15 or self.mine else self.run, now_us)
        elif not word & 2:
            self._off("coast", "inhibited", now_us)
        elif not word & 4:
            self._off("quick", "inhibited", now_us)
        elif not word & ON:
            self._off("stop", "inhibited" if self.at in ("inhibited", "quick") else "ready", now_us)
        else:
            self._on(word, begun, now_us)
        self._settle(now_us)
        if self.output:
            self._aim(now_us)  # with the bits of the ramp

    def _off(self, how: str, to: str, now_us: int) -> None:
        self.at, self.then = (how, to) if how != "stop" or self.at != "quick" else (self.at, self.then)
        self._bus(how, now_us)
        if not (self.output and self.stopping):
            self.at, self.then = "enabled" if self.output else to, ""  # it may not obey

    def _on(self, word: int, begun: int, now_us: int) -> None:
        if begun & ON and (self.at == "ready" or (self.at == "stop" and self.o.on_in_ramp)):
            self.at, self.then = "on", ""
        if self.at in ("on", "enabled"):
            self._bus(self.run, now_us) if word & RUNNING else self._off("coast", "on", now_us)

    def _settle(self, now_us: int) -> None:
        """Inhibited is left by OFF1 alone, after some time."""
        blocked = self.inhibited and not self.o.resumes_after_inhibit
        if self.word & (ON | OFFS) != OFFS or self.at != "inhibited" or blocked or self.fault is not None:
            self.low_us = None
        else:
            self.low_us = now_us if self.low_us is None else self.low_us
            self.at = "ready" if now_us - self.low_us >= self.o.ready_us else self.at

    def _obey(self, now_us: int, *, itself: bool = False) -> None:
        super()._obey(now_us, itself=itself)
        if self.by == "bus" and self.output and not self.stopping:
            self.at, self.then = "enabled", ""

    def _release(self, now_us: int) -> None:
        super()._release(now_us)
        self.at, self.then = self.then or ("ready" if self.at == "enabled" else self.at), ""
        self._settle(now_us)

    def _trip(self, fault: Any, now_us: int, how: str) -> None:
        super()._trip(fault, now_us, how)
        self.at, self.then = "fault", ""

    def _clear(self, now_us: int, *, resumes: bool, itself: bool = False) -> None:
        """A reset leads to inhibited, whatever stands: A page 319, G page 195."""
        if self.fault is not None and not self.cause:
            self.at, self.low_us = "inhibited", None
            self.commanded = self.commanded if itself else None
        super()._clear(now_us, resumes=resumes and itself, itself=itself)

    def inhibit(self, on: bool, now_us: int) -> None:
        """As a missing enable of operation, or as OFF2."""
        at = "on" if self.at == "enabled" else self.at
        super().inhibit(on, now_us)
        if on and self.fault is None:
            resumes = self.o.resumes_after_inhibit
            self.at, self.commanded = (at, self.commanded) if resumes else ("inhibited", None)

    def press(self, key: Literal["start", "stop", "reset", "local"], now_us: int) -> None:
        """As for every drive; the STOP key ends what the bus runs as OFF1 does."""
        bus = self.output and self.by == "bus"
        super().press(key, now_us)
        if key == "stop" and bus and self.commanded is None:
            self.at, self.then = ("stop", self.o.key_to) if self.output else (self.o.key_to, "")

    def _goal(self) -> float:
        if not self.speed_from_bus or (self.local and self.by == "keypad"):
            return super()._goal()
        held = self.by == "bus" and not self.word & HOLDS
        return 0.0 if not self._passes() else self.held_hz if held else super()._goal()

    def _passes(self) -> bool:
        """Whether the setpoint gets to the ramp."""
        return self.by != "bus" or bool(self.word & PASSES)

    def _speed(self, now_us: int, hz_per_count: float) -> int:
        hz = self.motor.hz(now_us) if self.output or self.o.coast_shows == "shaft" else 0.0
        return int(abs(hz) / hz_per_count + 1e-9) * (-1 if hz < 0 and self.o.signs else 1)

    def _bits(self, now_us: int) -> int:
        """Bits 0 to 8 of the status: A page 319, G page 199."""
        self._settle(now_us)
        at = "enabled" if self.output and self.by != "bus" and self.fault is None else self.at
        operates = self.output and not self.stopping and (self.by != "bus" or self.word & OPERATES == OPERATES)
        reached = self.motor.hz(now_us) == self._goal() if operates else not self.output and self.o.reached_at_rest
        off2 = not self.word & 2 or (self.inhibited and not self.o.resumes_after_inhibit)
        high = (self.runs << 2, (self.fault is not None) << 3, (not off2) << 4, bool(self.word & 4) << 5,
                self.warned << 7, reached << 8)  # fmt: skip
        return self.SHOWN[at] | sum(high)

    def _keep(self, address: int, word: int, now_us: int) -> None:
        if now_us < self.busy_us:
            raise Refusal("busy")
        self.ram[address] = self.stored[address] = word
        self.store(address, word, now_us)


class V20(Profile):
    """A SINAMICS V20 with P2023 = 2."""

    CODES: ClassVar[dict[str, int]] = dict.fromkeys(("read only", "value", "running", "mode", "busy"), 4) | {
        "function": 1, "address": 2, "count": 3,
    }  # fmt: skip  # V page 111
    IDS, SET = ("P2021", "P0700", "P1000"), (range(END), (STW, HSW), P2000, 100, 1, 5, 5)
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "keypad", 2: "terminals", 5: "bus"}
    WAY, SPEED_FROM_BUS, LOW_VOLTAGE, LINE_LOST = TURN, 5, 3, 72
    SHOWN: ClassVar[dict[str, int]] = Profile.SHOWN | {"stop": 3, "quick": 3}  # S5: G page 189
    plc = False
    fed_us: int | None = None  # when process data last came, since power-up: V page 115

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        self.fed_us, self.plc = None, self.plc and kept
        super()._power_up(now_us, kept=kept)

    def _lost_at(self) -> int:
        watched = self.powered and self.fault is None and self.o.comm_us is not None and self.fed_us is not None
        return (self.fed_us or 0) + (self.o.comm_us or 0) if watched else NEVER  # P2014

    def _line_lost(self, now_us: int) -> None:
        self._trip(self.LINE_LOST, now_us, self.o.trip_output)

    def _clear(self, now_us: int, *, resumes: bool, itself: bool = False) -> None:
        self.fed_us = None if self.fed_us is None else now_us
        super()._clear(now_us, resumes=resumes, itself=itself)

    def _write(self, words: dict[int, int], now_us: int) -> None:
        """Where one is refused, the others are written: 10/2019, page 185."""
        self._listed(words)
        refused = [each for each in words if each in self.LIVE or each == RESERVED]
        for address, word in words.items():
            if address not in refused:
                self._put(address, word, now_us)
        if refused:
            raise Refusal("read only")

    def _put(self, address: int, word: int, now_us: int) -> None:
        hz = self.ram[P2000] / 100 / 0x4000
        self.fed_us, self.ram[address] = now_us if address in (STW, HSW) else self.fed_us, word
        if address == STW:
            before, self.plc = self.plc, bool(word & PLC)
            if self.plc > before and self.o.before_plc == "kept":
                self._refer(hz * ((self.ram[HSW] ^ SIGN) - SIGN), now_us)
            if self.plc:  # else the process data are ignored: G page 195
                self._command(word, now_us)
        elif address == HSW and (self.plc or (not self.mine and self.o.speed_alone == "acts")):
            self._refer(hz * ((word ^ SIGN) - SIGN), now_us)
        elif address != HSW:
            self._keep(address, word, now_us)

    def _passes(self) -> bool:
        return (self.by != "bus" and self.o.speed_alone == "acts") or bool(self.word & PASSES)

    def _status(self, now_us: int) -> int:
        hz, rest = self.motor.hz(now_us), self.o.way_at_rest
        clockwise = hz > 0 or (hz == 0 and (rest == "clockwise" or (rest == "asked" and not self.word & TURN)))
        serial = self.mine if self.o.serial == "in command" else not self.local
        return self._bits(now_us) | serial << 9 | clockwise << 14 | 0xA800  # no limit, no overtemperature

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        **dict.fromkeys((0x18, *range(0x1A, 0x36), *range(0x37, END), HIW), lambda _, __: 0),
        0x17: lambda self, now_us: self._speed(now_us, 0.01),
        0x19: lambda self, _: 100 * self.output,
        0x1D: lambda _, __: 540,
        0x36: lambda self, _: self.code or 0,
        ZSW: _status,
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {"OutputCurrentA": (0x19, 0.01)}


class Acs355(Profile):
    """An ACS355 with 9802 = 1 and 5305 = 0, ABB DRV LIM."""

    CODES: ClassVar[dict[str, int]] = dict.fromkeys(("count", "read only", "value", "running", "mode", "busy"), 3) | {
        "function": 1, "address": 2,
    }  # fmt: skip  # A page 327
    IDS, SET = ("5302", "1001", "1103"), (PARAMETERS, (CW, REF1, REF1 + 1), 1104, 10, 1, 10, 8)
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "terminals", 8: "keypad", 10: "bus"}  # 1, 8: of this model
    SPEED_FROM_BUS, LOW_VOLTAGE, LINE_LOST = 8, 6, 28  # H pages 148 and 154; ACS550-02 page 259
    SHOWN: ClassVar[dict[str, int]] = Profile.SHOWN | {"stop": 1, "quick": 1}

    def _write(self, words: dict[int, int], now_us: int) -> None:
        self._listed(words)
        for address, word in words.items():
            if address in self.LIVE or (address in PARAMETERS and self.output):
                raise Refusal("read only" if address in self.LIVE else "running")
            if address == SAVE:  # all else is volatile: A page 313
                self._keep(address, word, now_us)
                self.stored = {each: self.ram[each] for each in PARAMETERS}
            self.ram[address] = word
            if address == REF1:
                self._refer(self.o.maximum_hz * ((word ^ SIGN) - SIGN) / 20_000, now_us)  # REF1 MAX: FENA-11 page 92
            elif address == CW:
                self._command(word, now_us)

    def _status(self, now_us: int) -> int:
        return self._bits(now_us) | (not self.local) << 9 | (not self.inhibited) << 12  # remote, external run enable

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        **dict.fromkeys(range(SW, LAST_ACTUAL), lambda self, now_us: self._speed(now_us, self.o.hz_per_count)),
        **dict.fromkeys((0x64, 0x65, 0x68, 0x69, *FAULTS), lambda _, __: 0),
        SW: _status,
        0x66: lambda self, now_us: self._speed(now_us, self.o.hz_per_count),
        0x67: lambda self, _: 10 * self.output,
        0x6A: lambda _, __: 540,
        FAULTS[0]: lambda self, _: self.code or 0,
    }


STORES: dict[str, Callable[[bytes], bool]] = {
    "ACS355": lambda body: (
        body[1] in (6, 16) and 0 <= SAVE - (body[2] << 8 | body[3]) < (1 if body[1] == 6 else body[5])
    ),
    "V20": lambda body: body[1] in (6, 16) and body[2] == 0 and body[3] < MONITORS,
}
"""Whether a request without checksum may store something: in 1607 alone, or in a parameter."""
