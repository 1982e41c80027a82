"""Rockwell PowerFlex 4, from pages C-3 to C-5 of its manual 22A; settings of the line are those of sister models.

The 40P, 4M, 400 and 525 are variants: each says, from its own manual, what is another parameter, scale or register.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeVar

from tests.second.drive import Drive, Options, Refusal, Source

COMMAND, REFERENCE = 8192, 8193  # pages C-3 and C-4
STOP, START, JOG, CLEAR = 1, 2, 4, 8  # bits 0 to 3 of 8192
WAYS = {1: "forward", 2: "reverse"}  # bits 5 and 4
LOSS = {0: "coast", 1: "coast", 2: "ramp", 3: "goes on"}
"""A105: fault, coast stop, stop, continue last."""
VARIANTS = ("PF400", "PF40P", "PF4M", "PF525")
Row = TypeVar("Row")


def alike(table: Mapping[str, Row]) -> dict[str, Row]:
    """What is so of each family; of a variant, as of the PowerFlex 4 where the table does not say otherwise."""
    return {**dict.fromkeys(VARIANTS, table["PF4"]), **table}


@dataclass(frozen=True, kw_only=True)
class Pf4Options(Options):
    """... and what appendix C leaves open: whether bits act once, refusals, how much one read takes, a lost line."""

    start_acts: Literal["once", "always"] = "once"  # a start bit acts when it rises, or in each write
    both_directions: Literal["toggle", "nothing"] = "toggle"  # bits 5 and 4: another edition prints no command
    stop_resets: bool = False  # a stop clears the fault
    commands_readable: bool = True  # 8192 and 8193
    comm_us: int | None = 5_000_000  # A106, 5.0 s


class Pf4(Drive):
    """A PowerFlex 4 on its RS485 (DSI) port."""

    o: Pf4Options
    CODES: ClassVar[dict[str, int]] = {
        "function": 1, "address": 2, "read only": 2, "count": 3, "value": 3, "running": 4, "mode": 4, "busy": 6,
    }  # fmt: skip  # of the standard: the appendix has none
    IDS = ("A104", "P036", "P038")
    LOSS: ClassVar[str] = "A105"
    SOURCES: ClassVar[tuple[str | None, ...]] = (None, "P036", "A069", "bus", "A070", "A071", "A072", "A073")
    """Bits 14 to 12."""
    PARAMETERS: ClassVar[tuple[int, ...]] = (36, 38, 39, 103, 104, 105, 106, 107)
    """Named on pages C-3 to C-5, and in those of sisters."""
    FACTORY: ClassVar[dict[str, int]] = {
        "A104": 100, "P036": 5, "P038": 5, "A103": 3, "A105": 0, "A106": 50, "A107": 0,
    }  # fmt: skip
    HZ: ClassVar[float] = 0.1
    """Of 8193: xxx.x, page C-4."""
    UNUSED: ClassVar[int] = 0
    """Bits of 8448 that a PowerFlex 4 has."""
    AWAY: ClassVar[int] = 0
    """The bit of 8192 that gives the drive to its keypad."""
    MOST: ClassVar[dict[int, int]] = {3: 1, 6: 1}
    RUN_SOURCES: ClassVar[dict[int, Source]] = {0: "keypad", 1: "terminals", 5: "bus"}  # 0, 1: numbers of this model
    SPEED_FROM_BUS = 5
    LOW_VOLTAGE, LINE_LOST = 4, 81  # page C-5

    def __init__(self, unit: int = 1, options: Pf4Options | None = None, at_us: int = 0, **settings: int) -> None:
        """As a drive; `word` is the last logic command."""
        o = options or Pf4Options()
        self.eeprom = dict.fromkeys(self.PARAMETERS, 0)
        self.word, self.way = 0, "forward"
        super().__init__(unit, o, at_us, **settings)

    def _factory(self) -> dict[str, int]:
        return dict(self.FACTORY)

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        told = {each: self.ram.get(each, 0) if kept else 0 for each in (COMMAND, REFERENCE)}
        self.word = told[COMMAND]
        self.eeprom |= {int(name[1:]): word for name, word in self.settings.items() if name[1:].isdigit()}
        self.ram = self.eeprom | told
        super()._power_up(now_us, kept=kept)

    def _line_watch(self) -> tuple[int | None, str, bool]:
        action = self.force[self.LOSS]
        return self.o.comm_us, self.o.comm_action if action == 0 else LOSS[action], action == 0

    def _words(self, first: int, number: int, now_us: int) -> Iterable[int]:
        if not self.o.commands_readable and first <= REFERENCE and first + number > COMMAND:
            raise Refusal("address")
        return super()._words(first, number, now_us)

    def _write(self, words: dict[int, int], now_us: int) -> None:
        address, word = next(iter(words.items()))
        if address in self.LIVE:
            raise Refusal("read only")
        self._listed([address])
        if address == REFERENCE:
            self._refer_word(word, now_us)
        elif address == COMMAND:
            self._command(word, now_us)
        else:
            self._parameter(address, word, now_us)
        if address in self.ram:
            self.ram[address] = word

    def _parameter(self, address: int, word: int, now_us: int) -> None:
        if now_us < self.busy_us:
            raise Refusal("busy")
        if address in self.eeprom:
            self.eeprom[address] = word
            self.store(address, word, now_us)

    def _refer_word(self, word: int, now_us: int) -> None:
        hz = word * self.HZ
        if hz > self.maximum_hz:
            raise Refusal("value")
        self._refer(hz, now_us)

    def _command(self, word: int, now_us: int) -> None:
        """8192; it says nothing of several at once, so a stop comes first."""
        old, before = self.word, self.way
        self.word, self.way = word, self._way(word >> 4 & 3)
        begun = word & ~old
        if word & self.AWAY:
            self.local = True
        if begun & CLEAR:
            self._bus("reset", now_us)
        if word & STOP:
            self._bus("stop", now_us)
            if self.o.stop_resets:
                self.reset(now_us)
        elif word & START and (begun & START or self.o.start_acts == "always" or self._turns(before)):
            self._bus(f"run_{self.way}", now_us)
        elif begun & JOG and not self.output:
            self._bus(f"jog_{self.way}", now_us)
        elif self.jogging and not word & JOG:
            self._bus("jog_stop", now_us)
        if self.output:
            self._aim(now_us)  # with the source of bits 14 to 12

    def _way(self, field: int) -> str:
        other = "reverse" if self.way == "forward" else "forward"
        return other if field == 3 and self.o.both_directions == "toggle" else WAYS.get(field, self.way)

    def _turns(self, before: str) -> bool:
        return self.by == "bus" and self.way != before

    def _goal(self) -> float:
        source = self.SOURCES[self.word >> 12 & 7]
        if source in (None, "bus") or self.by != "bus" or self.jogging:
            return super()._goal()
        return self.direction * min(self.maximum_hz, self.o.own_hz)

    def _status(self, now_us: int) -> int:
        """8448, page C-4; bits 12 and 13 are inputs of the drive."""
        hz, goal = self.motor.hz(now_us), self._goal() if self.output and not self.stopping else 0.0
        forward = hz > 0 or (hz == 0 and self.direction > 0)
        bits = [
            self.fault is None and not self.inhibited, self.runs, self.way == "forward", forward,
            self.output and abs(hz) < abs(goal), self.output and abs(hz) > abs(goal), self.warned,
            self.fault is not None, self.output and hz == goal, self.speed_from_bus,
            self.run_source == "bus" and not self.local, False, self.contact,
        ]  # fmt: skip
        return sum(1 << place for place, bit in enumerate(bits) if bit) & ~self.UNUSED

    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {
        1: lambda self, now_us: self._counts(now_us, 0.1),  # d001 is what 8451 shows: page C-4
        8448: _status,
        8449: lambda self, _: self.code or 0,
        8451: lambda self, now_us: self._counts(now_us, 0.1),  # 123 is 12.3 Hz
    }


@dataclass(frozen=True, kw_only=True)
class LaterOptions(Pf4Options):
    """Bits 5 and 4 together are no command in these manuals."""

    both_directions: Literal["toggle", "nothing"] = "nothing"


class Pf40p(Pf4):
    """A PowerFlex 40P in velocity mode, from pages C-3 to C-5 and C-7 of its manual 22D."""

    PARAMETERS = (*Pf4.PARAMETERS, 207, 249)
    FACTORY: ClassVar[dict[str, int]] = Pf4.FACTORY | {"E207": 0, "E249": 0}
    HZ = 0.01  # xxx.xx, page C-5; 8451 has xxx.x, page C-7


class Pf4m(Pf4):
    """A PowerFlex 4M, from pages C-4 to C-6 of its manual 22F, and from page 215 of 2080-UM002L."""

    IDS = ("C303", "run", "P108")
    LOSS = "C304"
    SOURCES = (None, "bus", "A409", "bus", "A410", "A411", "A412", "A413")  # 001: the speed reference's own
    PARAMETERS = (108, 302, 303, 304, 305, 306)
    FACTORY: ClassVar[dict[str, int]] = {
        "C303": 100, "run": 5, "P108": 5, "C302": 3, "C304": 0, "C305": 5, "C306": 0,
    }  # fmt: skip


class Pf400(Pf4):
    """A PowerFlex 400, from pages 170 to 173 of edition J of its manual 22C."""

    IDS = ("C104", "P036", "P038")
    LOSS = "C105"
    SOURCES = (None, "bus", "A142", "bus", "A143", "A144", "A145", "A146")
    PARAMETERS = (36, 38, 39, 102, 103, 104, 105)
    FACTORY: ClassVar[dict[str, int]] = {"C104": 100, "P036": 5, "P038": 5, "C102": 0, "C103": 3, "C105": 0}
    HZ = 0.01  # xxx.xx, page 172
    AWAY = 0x40  # bit 6: local control
    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = Pf4.LIVE | dict.fromkeys(
        (1, 8451),
        lambda self, now_us: self._counts(now_us, 0.01),  # 1234 is 12.34 Hz
    )


class Pf525(Pf4):
    """A PowerFlex 523 or 525 in velocity mode, from pages 204 and 205 of 520-UM001I and 207 to 210 of 520-UM001K."""

    IDS = ("C124", "P046", "P047")
    RUN_SOURCES: ClassVar[dict[int, Source]] = {1: "keypad", 2: "terminals", 3: "bus"}
    SPEED_FROM_BUS = 3
    LOSS = "C125"
    SOURCES = (None, "bus", "P049", "P051", "A410", "A411", "A412", "A413")  # 001: P047
    PARAMETERS = (41, 46, 47, *range(121, 128))
    FACTORY: ClassVar[dict[str, int]] = {
        "C124": 100, "P046": 3, "P047": 3, "C121": 0, "C122": 0, "C123": 3, "C125": 0, "C126": 50, "C127": 0,
    }  # fmt: skip
    HZ = 0.01
    UNUSED = AWAY = 0x40  # bit 6: of the status, not used; of the command, force keypad control
    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = Pf4.LIVE | {
        1: lambda self, now_us: self._counts(now_us, 0.01),  # b001
        8450: lambda self, _: round(100 * self.reference_hz),
        8451: lambda self, now_us: self._counts(now_us, 0.01),  # xxx.xx Hz
        8452: lambda self, _: 100 * self.output,  # xxx.xx A
        8453: lambda _, __: 540,  # xxx V
        8454: lambda self, _: 3800 * self.output,  # xxx.x V
    }
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {
        "OutputCurrentA": (8452, 0.01), "Diagnosis.DcBusVoltageV": (8453, 1), "Diagnosis.OutputVoltageV": (8454, 0.1),
    }  # fmt: skip


def stores(body: bytes) -> bool:
    """Whether a request without checksum may store something: a write to a parameter."""
    return body[1] == 6 and body[2] < 4
