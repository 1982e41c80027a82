"""The sheet of a drive to print: every setting with its value filled in, terminals, what to measure first."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.trust import second_hand
from driveblocks.maps.view import title
from driveblocks.meaning import chosen, conduct
from driveblocks.meaning.plug import plug
from driveblocks.meaning.serial import FORMS, character, serial
from driveblocks.meaning.setting import GROUPS, Setting, in_order, setting
from driveblocks.meaning.watchdog import watchdog
from driveblocks.modbus.frame import Mode
from driveblocks.render.environment import render

BLANK = "______"
"""Where a person writes."""
LONG = 90
"""A longer list of values is not repeated on a sheet."""
DAY_S = 86400
"""No watchdog counts as long."""
TITLES = dict(zip(GROUPS, ("Access level", "Who commands", "Address, rate, format", "When the line is silent",
                           "Limits and ramps", "Leave as delivered"), strict=True))  # fmt: skip


@dataclass(frozen=True)
class Wanted:
    """What a line is to be: unit address, bit rate, characters, how long it may be silent, in s, and framing."""

    unit: int
    rate: int
    form: str
    silence_s: Decimal | None = None
    mode: Mode | None = None
    """None: RTU, where the drive has it."""


@dataclass(frozen=True)
class Row:
    """A setting, what to set it to, and the number on the wire."""

    setting: Setting
    set_to: str
    wire: str


def wanted(  # noqa: PLR0913, PLR0917 - all that is set of a line
    drive: Drive, unit: int, rate: int | None, form: str | None, silence_s: Decimal | None, mode: Mode | None = None
) -> Wanted:
    """A line, as delivered where nothing is said. Raises ValueError with what is allowed."""
    line = serial(drive)
    forms = chosen.forms(drive, mode) or FORMS
    usual = line.character.form
    found = Wanted(unit, rate or line.rate, (form or (usual if usual in forms else forms[0])).upper(), silence_s, mode)
    if not line.lowest <= unit <= line.highest:
        raise ValueError(f"the unit addresses of this drive are {line.lowest} to {line.highest}, not {unit}")
    rates = chosen.rates(drive)
    if found.rate <= 0 or (rates and found.rate not in rates):
        raise ValueError(f"the bit rates of this drive are {', '.join(map(str, rates)) or 'not known'}, not {rate}")
    if found.form not in forms:
        raise ValueError(f"the formats of this drive are {', '.join(forms)}, not {form}")
    if silence_s is not None and (wrong := no_time(drive, silence_s)):
        raise ValueError(wrong)
    return found


def no_time(drive: Drive, silence_s: Decimal) -> str:
    """What is wrong with the time of a watchdog."""
    own = watchdog(drive)
    by = setting(drive, own.time.setting) if own and own.time else None
    if by is None:
        return "the map of this drive names no setting for the time of its watchdog"
    number = by.keypad.number(silence_s) if silence_s.is_finite() and abs(silence_s) < DAY_S else None
    if number is None or number <= 0 or (by.bounds and not by.bounds[0] <= number <= by.bounds[1]):
        steps = f"steps of {by.keypad.factor} {by.keypad.unit}"
        return f"{by.id} takes {by.allowed + ' in ' if by.bounds else ''}{steps}, not {silence_s} s"
    return ""


def rows(drive: Drive, line: Wanted | None = None) -> dict[str, list[Row]]:
    """Title of a group -> its settings in order, filled in for a line; without one, as on the page of every drive."""
    numbers = chosen.chosen(drive, line.unit, line.rate, character(line.form), line.mode) if line else {}
    own = watchdog(drive)
    if line and line.silence_s is not None and own and own.time and (by := setting(drive, own.time.setting)):
        number = by.keypad.number(line.silence_s)
        numbers |= {by.id: number} if number is not None else {}
    found: dict[str, list[Row]] = {}
    for one in in_order(drive):
        found.setdefault(TITLES[one.group], []).append(_row(drive, one, numbers, filled=line is not None))
    return found


def _row(drive: Drive, one: Setting, numbers: dict[str, int], *, filled: bool) -> Row:
    right = one.needed.right if one.needed else ()
    some = right or ((numbers[one.id],) if one.id in numbers else ())
    at = f" at {address_text(one.register)}" if one.register is not None else ""
    if some:
        said = " or ".join(f"**{one.said_of(each)}**" for each in some)
        return Row(one, said, " or ".join(map(str, some)) + at)
    return Row(one, _open(drive, one, filled=filled), at.strip() and f"{_count(one)}{at}".strip())


def _count(one: Setting) -> str:
    """What a number on the wire counts."""
    return f"x {one.keypad.factor:f} {one.keypad.unit}" if one.keypad.factor is not None else ""


def _open(drive: Drive, one: Setting, *, filled: bool) -> str:
    """What a person has to choose: what is allowed, and room for it."""
    if one.needed is None and (one.factory is not None or not one.keypad.unit or not filled):
        return "as delivered"
    own = watchdog(drive)
    said = one.allowed if len(one.allowed) < LONG or not filled else "one of its values"
    if own and own.chosen_by == one.id:
        stops = [value for value, does in own.reactions if value is not None and does != "runs_on"]
        said = " or ".join(map(one.said_of, stops)) or said
    if not filled:
        return said or "to choose"
    return f"{BLANK} {one.keypad.unit}".strip() + (f": {said}" if said else "")


def page(drive: Drive, word: str, line: Wanted) -> str:
    """The sheet as Markdown."""
    return render(
        "docs/Sheet.md.j2",
        title=title(drive),
        prefix=drive.prefix,
        word=word,
        line=line,
        groups=rows(drive, line),
        interface=serial(drive).interface,
        plug=plug(drive),
        known=chosen.rates(drive),
        gaps=list(_gaps(drive)),
        silent=conduct.silent_line(drive),
        trip=conduct.trip(drive),
        limit=conduct.lower_limit(drive),
        checked=second_hand(drive),
        blank=BLANK,
    )


def _gaps(drive: Drive) -> Iterator[tuple[str, str]]:
    """What the map does not know of the line and of its settings, and how a person finds it out."""
    for each in drive.absent:
        if not {"serial", "pins"}.isdisjoint(each.about) or any(one.startswith("setting ") for one in each.about):
            yield each.what, each.find_out
