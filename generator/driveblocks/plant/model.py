"""What a plant file says, as frozen data. Each class is one kind of entry; each field's text is its documentation."""

import re
from dataclasses import dataclass, field
from decimal import Decimal
from pathlib import Path
from typing import Annotated, Any, Literal

from driveblocks.desk.site.found import Way
from driveblocks.desk.site.kept import LABEL, Kept, Ms
from driveblocks.maps import model
from driveblocks.maps.form import Form
from driveblocks.maps.model import Count, Entry, Factor, Number, Str, fact, option
from driveblocks.maps.problem import Place
from driveblocks.modbus.frame import Mode

_NUMBER = r"(0|[1-9][0-9]{0,5})(\.[0-9]{1,6})?"
Label = Annotated[str, Form("name", LABEL, str, "write up to 24 letters and digits, a letter first")]
Port = Annotated[
    str,
    Form(
        "port",
        re.compile("[1-9][0-9]{0,4}|[A-Za-z/][A-Za-z0-9/_.:-]{0,39}"),
        str,
        "write its number, or a name such as COM3 or /dev/ttyUSB0",
        numeric=True,
    ),
]
Amount = Annotated[
    Decimal, Form("amount", re.compile(_NUMBER), Decimal, "write a number such as 50 or 2.5", numeric=True)
]
Named = Annotated[str, Form("drive", re.compile(r"\S(.*\S)?"), str, "write a family, or a map file", numeric=True)]
CharacterForm = Annotated[
    str, Form("format", re.compile("[78][NnEeOo][12]"), str.upper, 'write 8N1, 8N2, 8O1 or "8E1", with its quotes')
]
Speed = Annotated[
    Decimal | str,
    Form(
        "speed",
        re.compile(f"{_NUMBER}|{LABEL.pattern}"),
        lambda text: Decimal(text) if text[0].isdigit() else text,
        "write Hz such as 40, or the name of an input",
        numeric=True,
    ),
]
Yes = Annotated[bool, Form("true", re.compile("true"), lambda _: True, "write true, or leave the key out")]
Does = Literal["start", "stop", "reset", "stop_all"]
Shows = Literal["running", "fault", "ready", "stopped"]
DOES: tuple[Does, ...] = ("start", "stop", "reset", "stop_all")
SHOWS: tuple[Shows, ...] = ("running", "fault", "ready", "stopped")


@dataclass(frozen=True, kw_only=True)
class Called(Entry):
    """Base of what has a name of its own: its key in the file."""

    name: str = field(default="")
    name_at: Place = field(default=(0, 0), compare=False, repr=False)
    text: Str | None = option("what it is, for people; else its name", "Pump 1")

    @property
    def title(self) -> str:
        """What a person calls it."""
        return self.text or self.name


@dataclass(frozen=True, kw_only=True)
class Gathered(Called):
    """Base of what names drives."""

    drives: tuple[Label, ...] = fact("its drives, in their order", "[P1, P2, P3]")
    drives_at: dict[str, Place] = field(default_factory=dict, compare=False, repr=False)
    """Where each is named first."""

    def drive_at(self, drive: str) -> Place:
        """Where a drive is named."""
        return self.drives_at.get(drive, self.place("drives"))


@dataclass(frozen=True, kw_only=True)
class Line(Called):
    """An RS-485 line."""

    port: Port = fact("the port of the PLC: its number, or a name such as COM3 or /dev/ttyUSB0", "1")
    rate: Count | None = option("bits per second; else what its drives have as delivered", "19200")
    form: CharacterForm | None = option("data bits, parity, stop bits; else likewise", '"8E1"')
    mode: Mode | None = option("framing; else rtu where all its drives have it", "rtu")

    way: Way = field(default=Way(9600))
    """How it is spoken on: as given, else as its drives are delivered."""


@dataclass(frozen=True, kw_only=True)
class Members(Entry):
    """`settings` of a drive: what is set of its `VFD_Settings`; times in ms."""

    TurnRoundMs: Ms | None = option("longest time until it answers", "60")
    LongestMs: Ms | None = option("no reply arrives later", "500")
    BootMs: Ms | None = option("silence after power-up that is no alarm", "10000")
    RefreshMs: Ms | None = option("the reference is sent again after it; 65535: as the watchdog asks", "1000")
    FollowWithinMs: Ms | None = option("it has to run within this time of a start", "5000")
    StaleMs: Ms | None = option("an older status is not used", "5000")
    KeepWord: Number | None = option("for experts: bits that no command uses", "0400H")
    ReferenceScale: Factor | None = option("counts per Hz", "20.0")
    FrequencyScale: Factor | None = option("Hz per count", "0.01")
    CurrentScale: Factor | None = option("A per count", "0.01")
    VoltageScale: Factor | None = option("V per count", "0.1")
    DcVoltageScale: Factor | None = option("V per count", "0.1")
    PowerScale: Factor | None = option("kW per count", "0.1")
    PolePairs: Count | None = option("pole pairs of the motor", "2")

    @property
    def given(self) -> dict[str, Decimal]:
        """Those that the file gives."""
        values = {name: getattr(self, name) for name in self.keys}
        return {name: Decimal(each) for name, each in values.items() if each is not None}


@dataclass(frozen=True, kw_only=True)
class Motor(Called):
    """A drive with its motor."""

    drive: Named = fact("a family, a part of its name that no other has, or a map file beside this one", "chf")
    line: Label = fact("its line", "A")
    unit: Number = fact("its unit address", "1")
    maximum_hz: Amount = fact("the highest speed that the machine takes, Hz", "50")
    full_scale_hz: Amount | None = option("what 100 % is in the drive, Hz, where it has the pin `FullScaleHz`", "50")
    stop_within_ms: Count = fact("its longest ramp and a margin, ms", "15000")
    ramp_up_s: Amount | None = option("from standstill to full speed, s, for its keypad", "5")
    ramp_down_s: Amount | None = option("from full speed to standstill, s, for its keypad", "5")
    mode: Literal["full", "speed", "monitor"] = option(
        "`full`: run over the line; `speed`: run by its terminals, speed over the line; `monitor`: only read",
        "full",
        default="full",
    )
    watchdog_ms: Count | None = option("time of the drive's own watchdog, ms; else it has none", "2000")
    speed: Speed | None = option("an analog input, or Hz; else a tag of the panel", "Level")
    settings: Members | None = option(
        "members of `VFD_Settings`, before what commission found", "{ReferenceScale: 20.0}"
    )
    manual_checked: Count | None = option(
        "number on the page of a second-hand map, once somebody has checked it with the manual", "12345"
    )

    map: model.Drive = field(default=None, compare=False, repr=False)  # type: ignore[assignment]  # set by `load`
    """Its map; `load` refuses a plant with a drive that has none."""
    path: Path = field(default=Path(), compare=False, repr=False)
    """The file of its map."""
    values: dict[str, Decimal] = field(default_factory=dict)
    """Members of its `VFD_Settings` that are not 0: as given here, else as commission found; its watchdog, too."""


@dataclass(frozen=True, kw_only=True)
class Group(Gathered):
    """Drives that are started and stopped as one; a stop stops all of it."""

    kind: Literal["together", "sequence", "duty_standby"] = fact(
        "`together`: all at once; `sequence`: one after the other; `duty_standby`: some run, others take their place",
        "sequence",
    )
    duty: Count | None = option("duty_standby: how many run at once; else 1", "1")
    delay_ms: Count | None = option("sequence: time between two starts, ms; else 1000", "2000")
    change: Literal["never", "starts", "hours"] | None = option(
        "duty_standby: who is first at a start: always the first of the list, the one with the fewest starts, or with "
        "the fewest hours; else never",
        "starts",
    )


@dataclass(frozen=True, kw_only=True)
class Input(Called):
    """An analog input. Outside `raw` by more than 5 % of it the wire is broken."""

    raw: tuple[Number, ...] = fact("the counts of the PLC at both ends", "[0, 27648]")
    range: tuple[Factor, ...] = fact("what they mean", "[0, 50]")
    unit: Str = option("its unit", "Hz", default="Hz")


@dataclass(frozen=True, kw_only=True)
class Button(Called):
    """A button: it does one thing."""

    start: Label | None = option("a drive or a group to be started at its rising edge", "Pumps")
    stop: Label | None = option("a drive or a group to be stopped while it is pressed", "Pumps")
    reset: Label | None = option("a drive or a group whose fault is reset", "Pumps")
    stop_all: Yes | None = option("it stops all drives of all lines", "true")

    @property
    def does(self) -> Does:
        """Which of them."""
        return next(each for each in DOES if getattr(self, each) is not None)

    @property
    def of(self) -> str:
        """The drive or group; empty for all."""
        return "" if self.does == "stop_all" else str(getattr(self, self.does))


@dataclass(frozen=True, kw_only=True)
class Lamp(Called):
    """A lamp: it shows one thing."""

    running: Label | None = option("a drive that runs, or a group of which one does", "Pumps")
    fault: Label | None = option("a drive that has a fault, or a group of which one has", "Pumps")
    ready: Label | None = option("a drive that can be started, or a group that can", "Pumps")
    stopped: Label | None = option("a drive whose standstill is confirmed, or a group of which all are", "Pumps")

    @property
    def shows(self) -> Shows:
        """Which of them."""
        return next(each for each in SHOWS if getattr(self, each) is not None)

    @property
    def of(self) -> str:
        """The drive or group."""
        return str(getattr(self, self.shows))


@dataclass(frozen=True, kw_only=True)
class HardStop(Gathered):
    """A contact in series with the hard stop of its drives."""


@dataclass(frozen=True, kw_only=True)
class Meter(Called):
    """A meter or a sensor on a line, which is only read."""

    line: Label = fact("its line", "A")
    unit: Number = fact("its unit address", "20")
    address: Number = fact("its first register, zero-based", "0")
    words: Number = option("registers, 1 to 16", "2", default=1)
    function: Literal[3, 4] = option("3 reads holding registers, 4 input registers", "3", default=3)
    every_ms: Count = option("time between two reads, ms", "1000", default=1000)
    unit_text: Str | None = option("the unit of its value", "kWh")


@dataclass(frozen=True, kw_only=True)
class Plant(Entry):
    """The plant as a whole. Its sections hold entries by their names, in the order of the file."""

    plant: Str = fact("its name; the program is called after it", "Pumping station")
    scan_ms: Count = option("time between two scans, ms", "10", default=10)
    max_scan_ms: Count | None = option("the longest, ms; else twice `scan_ms`", "20")
    cpu: Str | None = option("a controller of docs/memory.md, so that its memory is judged", "S7-1217C")
    language: Literal["en", "zh"] | None = option("a second language of alarms, beside English", "zh")

    lines: dict[str, Line] = field(default_factory=dict)
    drives: dict[str, Motor] = field(default_factory=dict)
    groups: dict[str, Group] = field(default_factory=dict)
    inputs: dict[str, Input] = field(default_factory=dict)
    buttons: dict[str, Button] = field(default_factory=dict)
    lamps: dict[str, Lamp] = field(default_factory=dict)
    hard_stops: dict[str, HardStop] = field(default_factory=dict)
    """Each drive is in one; a file without any has one for all, `HardStop`."""
    meters: dict[str, Meter] = field(default_factory=dict)
    found: dict[str, Kept] = field(default_factory=dict)
    """What commission found, by tag."""
    written: dict[str, frozenset[str]] = field(default_factory=dict, compare=False, repr=False)
    """All names of each section, those of entries with mistakes, too."""

    @property
    def longest_scan_ms(self) -> int:
        return self.max_scan_ms or 2 * self.scan_ms

    @property
    def program(self) -> str:
        """Its name as an identifier: Pumping station -> PumpingStation."""
        return identifier(self.plant)

    def on(self, line: str) -> list[Motor]:
        """The drives of a line, in the order of the file: so are their slots."""
        return [each for each in self.drives.values() if each.line == line]

    def meters_on(self, line: str) -> list[Meter]:
        """The meters of a line, whose slots come after those of the drives."""
        return [each for each in self.meters.values() if each.line == line]

    def members(self, name: str) -> list[Motor]:
        """The drives of a group, or the drive of that name."""
        names = self.groups[name].drives if name in self.groups else (name,)
        return [self.drives[each] for each in names if each in self.drives]

    def group_of(self, drive: str) -> Group | None:
        """The group of a drive; it is in one at most."""
        return next((each for each in self.groups.values() if drive in each.drives), None)


SECTIONS: dict[str, type[Called]] = {
    "lines": Line, "drives": Motor, "groups": Group, "inputs": Input, "buttons": Button, "lamps": Lamp,
    "hard_stops": HardStop, "meters": Meter,
}  # fmt: skip
"""The keys of a plant file that hold entries by their names."""


def identifier(text: str) -> str:
    """A text as an identifier: each word begins with a capital letter; what ST does not take is left out."""
    words: Any = re.findall("[A-Za-z0-9]+", text)
    return "".join(each[:1].upper() + each[1:] for each in words)
