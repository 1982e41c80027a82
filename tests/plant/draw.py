"""Plants drawn at random: 2 to 12 drives of at least two makers, good by what `check` asks for.

`draw(seed)` is the text of a file. The same seed gives the same plant as long as the shipped maps are the same.
"""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache

from driveblocks.desk.run.drives import open_scales
from driveblocks.maps import catalog
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.revision import checked
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.watchdog import watchdog
from driveblocks.plant import speech

MOST_DRIVES, MOST_ON_LINE, MANY = 12, 8, 4
"""More than `MANY` units on a line, and each gets a longer StaleMs."""
WAYS = ((9600, "8E1"), (9600, "8N1"), (19200, "8E1"), (19200, "8N1"), (38400, "8N1"), (38400, "8E1"))
TAGS = ("Pump", "Fan", "Mixer", "Belt", "Screw", "Blower")
KINDS = ("together", "sequence", "duty_standby")
CHANGES = ("never", "starts", "hours")
SHOWS = ("running", "fault", "ready", "stopped")


@cache
def families() -> dict[str, Drive]:
    """The shipped maps by their names."""
    return {path.stem: load(path) for path in catalog.shipped()}


@dataclass
class Line:
    name: str
    rate: int
    form: str
    drives: list["Motor"] = field(default_factory=list)
    metered: bool = False


@dataclass
class Motor:
    tag: str
    family: str
    unit: int
    mode: str = "full"
    group: str = ""

    @property
    def map(self) -> Drive:
        return families()[self.family]


def draw(seed: int) -> str:
    """The text of a plant file."""
    chance = random.Random(seed)
    while True:
        lines = _lines(chance)
        drives = [each for line in lines for each in line.drives]
        if len({each.map.vendor.en for each in drives}) > 1:
            return "".join(_text(seed, lines, drives, chance))


def _lines(chance: random.Random) -> list[Line]:
    """Some lines with their drives."""
    left, count = chance.randint(2, MOST_DRIVES), chance.randint(1, 3)
    tags = [f"{chance.choice(TAGS)}{at}" for at in range(1, left + 1)]
    made: list[Line] = []
    for at in range(count):
        line = Line("ABC"[at], *chance.choice(WAYS), metered=chance.random() < 0.3)
        some = min(MOST_ON_LINE, left if at == count - 1 else chance.randint(0, left))
        left -= some
        units = chance.sample(range(1, 30), some)
        suits = [name for name, each in families().items() if _suits(each, line)]
        line.drives = [Motor(tags.pop(), chance.choice(suits), unit) for unit in units]
        made += [line] * bool(line.drives)
    return made


def _suits(drive: Drive, line: Line) -> bool:
    rates = serial(drive).rates
    return (not rates or line.rate in rates) and line.form in speech.forms(drive, "rtu") and not serial(drive).ascii


def _text(seed: int, lines: Sequence[Line], drives: Sequence[Motor], chance: random.Random) -> Iterator[str]:
    groups = list(_groups(drives, chance))
    for each in drives:
        if not each.group and chance.random() < 0.15:
            each.mode = chance.choice(("speed", "monitor"))
    yield f"plant: Drawn {chr(65 + seed % 26)}{seed}\nscan_ms: {chance.choice((5, 10, 10, 20))}\nlines:\n"
    yield from (
        f'  {one.name}: {{port: {at}, rate: {one.rate}, form: "{one.form}"}}\n' for at, one in enumerate(lines, 1)
    )
    yield "drives:\n"
    for line in lines:
        many = len(line.drives) + line.metered > MANY
        for each in line.drives:
            yield f"  {each.tag}: {{{', '.join(_facts(line, each, chance, many=many))}}}\n"
    yield "inputs:\n  Level: {raw: [0, 27648], range: [0, 50], unit: Hz}\n"
    if groups:
        yield "groups:\n" + "".join(f"  {each}\n" for each in groups)
    yield from _panel(drives, chance)
    if chance.random() < 0.5:
        half = len(drives) // 2
        yield f"hard_stops:\n  HardStop1: {_list(drives[:half])}\n  HardStop2: {_list(drives[half:])}\n"
    metered = [line.name for line in lines if line.metered]
    yield from ["meters:\n"] * bool(metered)
    for name in metered:
        yield f"  Energy{name}: {{line: {name}, unit: 40, address: 0, words: {chance.randint(1, 4)}}}\n"


def _facts(line: Line, motor: Motor, chance: random.Random, *, many: bool) -> Iterator[str]:
    """What a drive has to say, and some of what it may."""
    drive, ramp = motor.map, chance.randint(1, 10)
    yield f"drive: {motor.family}, line: {line.name}, unit: {motor.unit}, maximum_hz: {chance.choice((40, 50))}"
    if reference(drive).percent:
        yield f"full_scale_hz: {chance.choice((50, 60))}"
    yield f"stop_within_ms: {1000 * ramp + 20_000}"
    if chance.random() < 0.5:
        yield f"ramp_up_s: {ramp}, ramp_down_s: {ramp}"
    own = watchdog(drive)
    if own and own.time and own.time.most_ms and not many and motor.mode == "full" and chance.random() < 0.4:
        yield "watchdog_ms: 20000"
    if motor.mode != "full":
        yield f"mode: {motor.mode}"
    if motor.mode != "monitor" and (speed := chance.choice(("", "Level", "30"))):
        yield f"speed: {speed}"
    settings = {"StaleMs": 30_000} if many else {}
    settings |= {"ReferenceScale": 100} if "ReferenceScale" in open_scales(drive) else {}
    if settings:
        yield f"settings: {{{', '.join(f'{name}: {value}' for name, value in settings.items())}}}"
    if second_hand(drive):
        yield f"manual_checked: {checked(drive)}"


def _groups(drives: Sequence[Motor], chance: random.Random) -> Iterator[str]:
    """Some groups of two drives or more, each drive in one at most."""
    free = list(drives)
    chance.shuffle(free)
    for at in range(chance.randint(0, 3)):
        some = free[: chance.randint(2, 5)]
        if len(some) < 2:
            return
        del free[: len(some)]
        for each in some:
            each.group = f"Group{at}"
        kind = chance.choice(KINDS)
        duty, change = chance.randint(1, len(some) - 1), chance.choice(CHANGES)
        more = {
            "together": "",
            "sequence": f", delay_ms: {chance.choice((500, 2000))}",
            "duty_standby": f", duty: {duty}, change: {change}",
        }[kind]
        yield f"Group{at}: {{kind: {kind}, drives: [{', '.join(each.tag for each in some)}]{more}}}"


def _panel(drives: Sequence[Motor], chance: random.Random) -> Iterator[str]:
    """Buttons and lamps of what is started and stopped as one."""
    targets = list(dict.fromkeys(each.group or each.tag for each in drives if each.mode == "full"))
    yield "buttons:\n  StopEverything: {stop_all: true}\n"
    for each in targets:
        yield f"  Start{each}: {{start: {each}}}\n  Stop{each}: {{stop: {each}}}\n"
        if chance.random() < 0.5:
            yield f"  Reset{each}: {{reset: {each}}}\n"
    yield "lamps:\n"
    for each in targets:
        shows = chance.choice(SHOWS)
        yield f"  {each}{shows.capitalize()}: {{{shows}: {each}}}\n"
    yield f"  FirstDrive: {{{chance.choice(SHOWS)}: {drives[0].tag}}}\n"


def _list(drives: Sequence[Motor]) -> str:
    return f"{{drives: [{', '.join(each.tag for each in drives)}]}}"
