"""The program of a plant: one PROGRAM in our ST, that of text with the bytes of its lines, or that of a platform.

It is made of calls, assignments and rungs alone, so that it can be drawn as a ladder. What people have named has no
underscore in its name; what is named here has one behind a name of theirs: P1, P1_Run.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal

from driveblocks.maps.model import Drive
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import Character, character
from driveblocks.plant.model import Group, HardStop, Input, Lamp, Motor, Plant
from driveblocks.platforms import CANONICAL, PLATFORMS
from driveblocks.render.drive import drive_block
from driveblocks.render.environment import render
from driveblocks.render.library import LINE_SIZES
from structured_text.language.writing import real, word

CHANGES = {None: 0, "never": 0, "starts": 1, "hours": 2}
"""Who is first: the numbers of VFD_Duty."""
USUAL_DELAY_MS = 1000
FIRST_MODULE = 269
"""Hardware identifier of the first communication module of an S7-1200, as a device configuration gives it."""
PINS = {"running": "Running", "fault": "Fault", "ready": "Ready", "stopped": "Stopped"}
OWN_PINS = {**PINS, "stopped": "StopConfirmed"}
"""What a lamp shows: pins of a group, and of a drive block."""


@dataclass(frozen=True)
class Bus:
    """A line: its block, its slots, and how it is spoken on."""

    name: str
    title: str
    port: str
    number: int
    """From 1 on, in the order of the file."""
    block: str
    slots: int
    rate: int
    character: Character
    ascii: bool
    elapsed: str
    """The variable that holds the time since the last call."""

    @property
    def serial(self) -> int:
        """The number of its port, where ports are counted."""
        return int(self.port) if self.port.isdecimal() else self.number

    @property
    def hardware(self) -> int:
        """The identifier of its module in an S7: the first ones are the PLC's own."""
        return self.serial if self.serial >= FIRST_MODULE else FIRST_MODULE + self.number - 1

    @property
    def device(self) -> str:
        """The name of its port on Linux."""
        return self.port if self.port.startswith("/") else f"/dev/ttyUSB{self.number - 1}"


@dataclass(frozen=True)
class Unit:
    """A drive: what its block is called with."""

    motor: Motor
    block: str
    slot: str
    enable: str
    """The input that says that its hard stop is closed."""
    run: str
    reset: str
    speed: str
    settings: tuple[str, ...]
    at: Bus
    member: str
    """Its element of a group; empty for none."""
    off: tuple[str, ...]
    """Contacts any of which keeps it off, where it is in a group."""

    @property
    def name(self) -> str:
        return self.motor.name

    @property
    def percent(self) -> bool:
        return reference(self.motor.map).percent

    @property
    def unchecked(self) -> bool:
        return second_hand(self.motor.map)


@dataclass(frozen=True)
class Target:
    """What is started and stopped as one: a group, or a drive that is in none and run over the line."""

    name: str
    title: str
    starts: tuple[str, ...]
    """Contacts any of which starts it."""
    stops: tuple[str, ...]
    """... stops it."""
    held: tuple[str, ...]
    """Contacts in series without which its command does not hold."""


@dataclass(frozen=True)
class Team:
    """A group: what its block is called with."""

    group: Group
    elapsed: str
    change: int
    duty: int
    delay_ms: int

    @property
    def name(self) -> str:
        return self.group.name

    @property
    def block(self) -> str:
        return "VFD_Duty" if self.group.kind == "duty_standby" else "VFD_Group"


@dataclass(frozen=True)
class Contact:
    """A hard stop: who is overdue, who resets it."""

    stop: HardStop
    overdue: tuple[str, ...]
    resets: tuple[str, ...]


def text(plant: Plant) -> str:
    """The program with the bytes of its lines, as the embedded engine runs it."""
    return source(plant, CANONICAL)


def source(plant: Plant, platform: str, *, own: bool = True, name: str = "") -> str:
    """The program at the ports of a platform; `own`: with a place for the user's declarations."""
    units = list(_units(plant, platform))
    return render(
        "plant/Program.st.j2",
        plant=plant,
        name=name or plant.program,
        platform=platform,
        where=PLATFORMS[platform].where,
        bytes=platform == CANONICAL,
        own=own,
        buses=[bus(plant, each, platform) for each in plant.lines],
        units=units,
        teams=[_team(plant, each, platform) for each in plant.groups.values()],
        targets=list(_targets(plant)),
        contacts=[_contact(plant, each) for each in plant.hard_stops.values()],
        resets=_resets(plant),
        stops_all=_stops_all(plant),
        scales=[(each, _ends(each)) for each in plant.inputs.values()],
        lamps=[(each, _shown(plant, each)) for each in plant.lamps.values()],
        meters=[(each, _slot(plant, each.name)) for each in plant.meters.values()],
        word=word,
        real=lambda value: real(float(value)),
    )


# ------------------------------------------------------------ lines and drives


def bus(plant: Plant, name: str, platform: str = CANONICAL) -> Bus:
    """A line at the port of a platform."""
    line, number = plant.lines[name], [*plant.lines].index(name) + 1
    units = len(plant.on(name)) + len(plant.meters_on(name))
    slots = next((each for each in sorted(LINE_SIZES) if each >= units), max(LINE_SIZES))
    block = PLATFORMS[platform].line if platform != CANONICAL else "MB_ByteLine"
    return Bus(
        name, line.title, line.port, number, f"{block}{slots}", slots, line.way.rate,
        character(line.way.form), line.way.mode == "ascii",
        elapsed="ElapsedMs" if platform == CANONICAL else f"{name}.ElapsedMs",
    )  # fmt: skip


def _slot(plant: Plant, name: str) -> str:
    """The slot of a drive or a meter."""
    line = (plant.drives | plant.meters)[name].line
    on = [each.name for each in (*plant.on(line), *plant.meters_on(line))]
    return f"{line}_Slots[{on.index(name)}]"


def _units(plant: Plant, platform: str) -> Iterator[Unit]:
    for each in plant.drives.values():
        group = plant.group_of(each.name)
        member = f"{group.name}_Members[{group.drives.index(each.name)}]" if group else ""
        closed = f"{_hard_stop(plant, each).name}_Closed"
        yield Unit(
            each, f"{each.map.prefix}_Drive", _slot(plant, each.name), closed,
            run="" if each.mode != "full" else f"{member}.Run" if member else f"{each.name}_Run",
            reset=_reset_of(plant, each),
            speed=_speed(each),
            settings=tuple(f"{name} := {_value(name, value)}" for name, value in each.values.items()),
            at=bus(plant, each.line, platform),
            member=member,
            off=(f"NOT {closed}", f"{each.name}_Off", *_pressed(plant, "stop", each.name)) if member else (),
        )  # fmt: skip


def _hard_stop(plant: Plant, motor: Motor) -> HardStop:
    return next(each for each in plant.hard_stops.values() if motor.name in each.drives)


def _speed(motor: Motor) -> str:
    if motor.mode == "monitor":
        return ""
    if isinstance(motor.speed, Decimal):
        return real(float(motor.speed))
    return f"{motor.speed}_Scale.Value" if motor.speed else f"{motor.name}_Hertz"


def _value(name: str, value: Decimal) -> str:
    """A member of VFD_Settings as a literal."""
    if name.endswith("Scale"):
        return real(float(value))
    return word(int(value)) if name == "KeepWord" else str(int(value))


def _has_reset(drive: Drive) -> bool:
    return "fault_reset" in drive_block(drive).ordering.can


# ------------------------------------------------------------ commands


def _targets(plant: Plant) -> Iterator[Target]:
    for name, each in commanded(plant).items():
        inputs = dict.fromkeys(one.speed for one in plant.members(name) if isinstance(one.speed, str))
        starts = (f"{name}_Start", *_pressed(plant, "start", name))
        broken = (f"{one}_Scale.Broken" for one in inputs)
        stops = (f"{name}_Stop", *_pressed(plant, "stop", name), "All_Stop", *broken)
        alone = (f"NOT {name}.StopConfirmed", f"{name}.CommOk", f"NOT {name}.Fault")
        held = (f"NOT {name}.Ended",) if name in plant.groups else alone
        yield Target(name, each.title, starts, stops, held)


def commanded(plant: Plant) -> dict[str, Group | Motor]:
    """What has a command of its own: each group, and each drive that is in none and is run over the line."""
    alone = (each for each in plant.drives.values() if plant.group_of(each.name) is None and each.mode == "full")
    return plant.groups | {each.name: each for each in alone}


def _pressed(plant: Plant, does: str, of: str) -> tuple[str, ...]:
    """Contacts of the buttons that do something to a drive or a group; one that stops is normally closed."""
    found = [each.name for each in plant.buttons.values() if each.does == does and each.of == of]
    return tuple(f"NOT {each}" if does.startswith("stop") else each for each in found)


def _stops_all(plant: Plant) -> tuple[str, ...]:
    return ("Hmi_StopAll", *_pressed(plant, "stop_all", ""))


def _resets_of(plant: Plant, name: str) -> tuple[str, ...]:
    """Buttons that reset a drive: its own, and those of its group."""
    group = plant.group_of(name)
    return (*_pressed(plant, "reset", name), *(_pressed(plant, "reset", group.name) if group else ()))


def _reset_of(plant: Plant, motor: Motor) -> str:
    """What resets the fault of a drive; empty where nothing can."""
    if motor.mode != "full" or not _has_reset(motor.map):
        return ""
    return f"{motor.name}_Reset" if _resets_of(plant, motor.name) else "Hmi_Reset"


def _resets(plant: Plant) -> list[tuple[str, tuple[str, ...]]]:
    """The drives with reset buttons, and the contacts that reset each."""
    named = (each.name for each in plant.drives.values() if _reset_of(plant, each).startswith(f"{each.name}_"))
    return [(each, ("Hmi_Reset", *_resets_of(plant, each))) for each in named]


def _team(plant: Plant, group: Group, platform: str) -> Team:
    at = bus(plant, plant.drives[group.drives[0]].line, platform)
    delay = 0 if group.kind == "together" else USUAL_DELAY_MS if group.delay_ms is None else group.delay_ms
    return Team(group, at.elapsed, CHANGES[group.change], group.duty or 1, delay)


def _contact(plant: Plant, stop: HardStop) -> Contact:
    """A line is watched as a whole where the hard stop cuts all its drives, else drive by drive."""
    lines = dict.fromkeys(plant.drives[each].line for each in stop.drives)
    whole = {each.name for line in lines for each in plant.on(line)} <= set(stop.drives)
    resets = dict.fromkeys(button for each in stop.drives for button in _resets_of(plant, each))
    return Contact(stop, tuple(f"{each}.StopOverdue" for each in (lines if whole else stop.drives)), tuple(resets))


# ------------------------------------------------------------ inputs and outputs


def _ends(one: Input) -> str:
    """The ends of an analog input, as VFD_Scale takes them."""
    low, high = (real(float(each)) for each in one.range)
    return f"RawLow := {one.raw[0]}, RawHigh := {one.raw[1]}, Low := {low}, High := {high}"


def _shown(plant: Plant, lamp: Lamp) -> str:
    """The contacts of a lamp; that of a fault is on while a drive does not answer, too."""
    if lamp.of in plant.groups:
        return f"{lamp.of}.{PINS[lamp.shows]}"
    fault = f" OR NOT {lamp.of}.CommOk" if lamp.shows == "fault" else ""
    return f"{lamp.of}.{OWN_PINS[lamp.shows]}{fault}"
