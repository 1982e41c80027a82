"""A scene: what a user does and what happens to the drive, step by step, and what the pins must show."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple

from driveblocks.bench import kit
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import counts_per_hertz, environment, name
from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.script import SCAN_MS, Item, Probe, Script, Span, Stage
from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.model import Drive
from driveblocks.maps.revision import checked
from driveblocks.meaning.serial import serial
from structured_text.language.writing import flag, real

Value = bool | int | float | str | tuple[int, int]
"""What a pin is given or must show: of a check, two numbers are the lowest and the highest; text is an expression."""

Shows = dict[str, Value]
"""Pins and their values."""

RULES = (
    "without CommOk nothing is shown", "no StopConfirmed while the motor turns", "no run without a pin",
    "a motor that nobody asks for is stopped", "Error with ErrorID", "no faster than MaximumHz", "no broadcast",
    "nothing stored unasked", "no register written unasked", "not Running and StopConfirmed", "the right way round",
    "Reason 0 only while it runs", "FaultCode only with Fault", "no closed contact while a stop is overdue",
    "an answer to each command", "no StopConfirmed without its proof", "no fewer registers than are shown",
    "no request that a line cannot send", "a stop after a fault reset",
)  # fmt: skip
"""What VFD_TestWatch sees broken, by bit."""

HERTZ = 0.2
"""How near a speed must be."""


class Step(NamedTuple):
    """What is set, until when it lasts, and what must be so then.

    Names without a dot are pins: `sets` of Pins, `shows` of the drive block. Without `until` it lasts `ms`; with it,
    it must come true within them.
    """

    words: str
    sets: Mapping[str, Value] = MappingProxyType({})
    until: str = ""
    ms: int = 3000
    shows: Mapping[str, Value] = MappingProxyType({})
    brisk: bool | None = None
    """In scans twice as long, of which it takes fewer. None: where it is long, and nothing counts its scans."""


WAIT_MS, LONG_MS = 400, 3000
"""A step that just lasts so long, and one that may take so long, are brisk."""


USUAL_TURNS, ROUND_MS = 4, 500
"""A drive with more reads in turn than that shows some things so much later for each."""


@dataclass(frozen=True)
class Scene:
    """Steps with a name; it begins with a restart of everything, and all rules must hold in every scan of it."""

    words: str
    steps: tuple[Step, ...]


def scene(words: str, *steps: Step | Iterable[Step]) -> Scene:
    """A scene of steps and of runs of steps."""
    flat = [one for each in steps for one in ([each] if isinstance(each, Step) else each)]
    own = any(key == "Pins.ElapsedMs" for step in flat for key in step.sets)
    return Scene(words, tuple(_paced(flat if own else map(_hastened, flat))))


def _hastened(step: Step) -> Step:
    """The step in long scans, where it is long; one that just waits takes half as many of them."""
    if step.brisk is not None:
        return step
    if step.until:
        counts = any("WaitedMs" in each for each in (step.until, *step.shows))
        return step._replace(brisk=step.ms >= LONG_MS and not counts)
    return step if step.ms < WAIT_MS else step._replace(brisk=True, ms=step.ms // 2)


def _paced(steps: Iterable[Step]) -> Iterator[Step]:
    """The steps, with the length of a scan where it changes."""
    brisk = False
    for step in steps:
        if bool(step.brisk) != brisk:
            pace = {"Pins.ElapsedMs": 2 * SCAN_MS if step.brisk else SCAN_MS}
            yield step._replace(sets=pace | dict(step.sets))
        else:
            yield step
        brisk = bool(step.brisk)


@dataclass(frozen=True)
class More:
    """What a program has beside one motor: a second one; blocks, as name -> type and comment, and their calls.

    `calls` come before that of the line, `after` come after it.
    """

    other: bool = False
    blocks: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    calls: tuple[str, ...] = ()
    after: tuple[str, ...] = ()


def script(  # noqa: PLR0913, PLR0917 - what the head of a program says, its scenes, and what more it has
    drive: Drive, stem: str, subject: str, title: str, scenes: Iterable[Scene], more: More = More()
) -> Script:
    program = kit.script(drive, stem, subject, title)
    program.variables |= _variables(drive, other=more.other) | dict(more.blocks)
    program.plant = _plant(drive, more)
    can = Ability(drive)
    for one in scenes:
        for index, step in enumerate(one.steps, 1):
            program.stages.append(_stage(can, one, index, step))
    return program


def _stage(can: Ability, one: Scene, index: int, step: Step) -> Stage:
    first, last, absent = index == 1, index == len(one.steps), can.absent
    items: list[Item] = [*_BEGIN, f"Fate.Unit := {serial(can.drive).lowest};"] if first else []
    items += statements(step.sets)
    until = step.until if can.measures("output_frequency") else step.until.replace("Motor.AtSpeed", _FAST)
    most = step.ms + ROUND_MS * max(0, can.turns - USUAL_TURNS) * bool(step.until)
    if step.until:
        items.append(kit.is_flag(until, True, f"within {most} ms: {step.until}"))
    items += checks({key: value for key, value in step.shows.items() if key not in absent})
    if last or not (step.until or step.shows):
        pins = "Expected := DWORD#16#00000000, Actual := Watch.Broken"
        items.append(Probe("Bytes", pins, "no rule broken", 4, RULES))
    span = Span(until, most, BEGIN_MS if first else SCAN_MS)
    return Stage(f"{one.words}, {index}: {step.words}", "", items, span, one.words)


def statements(sets: Mapping[str, Value]) -> list[Item]:
    return [f"{_path(key, 'Pins')} := {_literal(value)};" for key, value in sets.items()]


def checks(shows: Mapping[str, Value]) -> list[Item]:
    return [_check(key, value) for key, value in shows.items()]


_BEGIN = (
    "Begins := TRUE;", "Pins := Usual;", "Fate := Calm;", "Seen := Blank;", "Fate.Anew := TRUE;", "TxCount := 0;",
)  # fmt: skip
"""What begins a scene: the drive is new, line and drive block restart."""
BEGIN_MS = 3 * SCAN_MS
"""After so long the pins show nothing of the scene before."""
_FAST = "(Motor.Running AND (Seen.Milli = Seen.AskedMilli) AND (Seen.Milli <> 0))"
"""AtSpeed of a drive that shows no frequency."""


def _path(name_: str, where: str) -> str:
    """A variable of the program: with a dot as it is, one before it means the program's own."""
    return name_.removeprefix(".") if "." in name_ else f"{where}.{name_}"


def _literal(value: Value) -> str:
    if isinstance(value, bool):
        return flag(value)
    return real(value) if isinstance(value, float) else str(value)


def _check(key: str, value: Value) -> Probe:
    actual = key if " " in key else _path(key, "Motor")
    words = f"{key} {value}" if isinstance(value, str) else key
    if key == "Reason":
        value = REASONS[str(value)]
    if isinstance(value, bool):
        return kit.is_flag(actual, value, words)
    if isinstance(value, tuple):
        return kit.is_between(actual, str(value[0]), str(value[1]), words)
    if isinstance(value, float):
        pins = f"Expected := {real(value)}, Actual := {actual}, Tolerance := {real(HERTZ)}"
        return Probe("Real", pins, words)
    return kit.is_number(actual, value, words)


def why(name_: str) -> str:
    """The condition that Reason has a name."""
    return f"Motor.Reason = {REASONS[name_]}"


# ---------------------------------------------------------------- the program


def _variables(drive: Drive, *, other: bool) -> dict[str, tuple[str, str]]:
    block = f"{drive.prefix}_Drive"
    found = {
        "Motor": (block, "under test: one motor"),
        "Bus": ("MB_ByteLine8", "under test: its line"),
        "HardStop": ("VFD_HardStop", "under test: the contact of the hard stop"),
        "Slots": ("MB_Slots8", "one per drive"),
        "Drive": (name(drive), "the simulated drive"),
        "Watch": ("VFD_TestWatch", "rules that hold in every scan"),
        "Pins": ("VFD_TestPins", "what is wired"),
        "Usual": ("VFD_TestPins", "... as every scene begins"),
        "Prepared": ("BOOL", "Usual is filled in"),
        "Fate": ("VFD_TestFate", "what happens to the drive"),
        "Calm": ("VFD_TestFate", "nothing"),
        "Seen": ("VFD_TestSeen", "what the drive was asked"),
        "Blank": ("VFD_TestSeen", "nothing"),
        "TxChars": ("MB_LineFrame", "what the port sends"),
        "TxCount": ("UINT", "how many characters"),
        "RxChars": ("MB_Adu", "what the port has received"),
        "RxCount": ("UINT", "how many characters"),
        "Begins": ("BOOL", "a scene begins: everything restarts"),
        "WaitedMs": ("UINT", "time of this stage, ms"),
        "Mark": ("UINT", "a count of before"),
        "Next": ("BOOL", "this stage is over"),
    }
    more = {
        "Other": (block, "a second drive block"),
        "OtherDrive": (name(drive), "a second drive"),
        "OtherFate": ("VFD_TestFate", "what happens to it"),
        "OtherSeen": ("VFD_TestSeen", "what it was asked"),
    }
    return found | (more if other else {})


SCALES = {
    "FrequencyScale": 0.01, "CurrentScale": 0.01, "VoltageScale": 0.01,
    "DcVoltageScale": 0.01, "PowerScale": 0.01,
}  # fmt: skip
"""Settings in place of scales that a manual does not give: those of the simulated drive."""


def _plant(drive: Drive, more: More) -> str:
    scales = {"ReferenceScale": counts_per_hertz(drive), **SCALES}
    pairs = [("PolePairs", str(Habits().pole_pairs))]
    return (
        environment()
        .get_template("Plant.st.j2")
        .render(
            unit=serial(drive).lowest,
            other_unit=serial(drive).lowest + 1,
            checked=checked(drive),
            ascii=flag(serial(drive).ascii),
            scan=SCAN_MS,
            scales=[*((key, real(value)) for key, value in scales.items()), *pairs],
            other=more.other,
            calls=more.calls,
            after=more.after,
        )
    )
