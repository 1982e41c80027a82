"""The keypad settings that a drive's manual names: as delivered, as they must be, as the keypad shows them."""

import re
from dataclasses import dataclass, field
from decimal import Decimal

from driveblocks.maps import model
from driveblocks.maps.model import Drive, kept
from driveblocks.meaning.citation import Citation, cited

GROUPS = ("access", "commands", "line", "silence", "limits", "rest")
"""The order in which a person meets settings: access level; who commands, and how the motor runs; address, rate and
format; what a silent line does; limits and ramps; what need not be changed."""


@dataclass(frozen=True)
class Needed:
    """What it must be: one of these numbers, or what the PLC also uses; for runs by the terminals, another."""

    right: tuple[int, ...]
    by_terminals: int | None
    why: str


@dataclass(frozen=True)
class Keypad:
    """How the keypad shows a setting."""

    code: str
    menu: str = ""
    unit: str = ""
    factor: Decimal | None = None
    """What a count on the wire is in this unit; None: the number itself, or with a unit not known."""
    digits: int = 1
    hexadecimal: bool = False
    texts: tuple[tuple[int, str], ...] = ()
    """Numbers for which it shows a text."""

    def plain(self, number: int) -> str:
        """A number without its unit: 50 as 5.0, 31 as 1F."""
        text = dict(self.texts).get(number)
        if text is not None:
            return text
        if self.factor is not None:
            return f"{number * self.factor:f}"
        return f"{number:0{self.digits}{'X' if self.hexadecimal else 'd'}}"

    def shown(self, number: int) -> str:
        """A number as the keypad shows it: 5.0 s."""
        return f"{self.plain(number)} {self.unit if self.factor is not None else ''}".strip()

    def number(self, amount: Decimal) -> int | None:
        """The number on the wire for an amount in its unit; None where none is."""
        count = amount / self.factor if self.factor else None
        return int(count) if count is not None and count == int(count) else None


@dataclass(frozen=True)
class Setting:
    """One of them; bounds and register only where the manual has them."""

    id: str
    name: str
    said: Citation
    register: int | None
    default: str
    """As printed; of several editions each with its own."""
    editions: bool
    """It differs by edition."""
    bounds: tuple[int, int] | None
    values: tuple[tuple[int, str], ...]
    needed: Needed | None
    """Other settings, and what they are while the keypad shows it."""
    note: str
    keypad: Keypad = field(default_factory=lambda: Keypad(""))
    group: str = "rest"
    """One of `GROUPS`."""
    adjusted: bool = False
    """It is a limit or a ramp that nothing needs, which a PLC may write, too."""

    def named(self, number: int | None) -> str:
        """What the manual calls a value."""
        return next((name for value, name in self.values if value == number), "")

    def said_of(self, number: int) -> str:
        """What the keypad shows for a number, and what that means: 3 = 9600 bit/s."""
        shown, name = self.keypad.shown(number), self.named(number)
        return f"{shown} = {name}" if name and name != shown else shown

    @property
    def factory(self) -> int | None:
        """The number as delivered, where one is printed."""
        if self.editions:
            return None
        if self.keypad.hexadecimal:
            return int(self.default, 16) if re.fullmatch("[0-9A-F]{1,4}", self.default) else None
        said = re.match(r"([0-9]{1,9})(\.[0-9]{1,9})?(?![0-9A-Za-z.])", self.default)
        if said is None or (said[2] and self.keypad.factor is None):
            return None
        amount = said[2] or self.default.endswith(f" {self.keypad.unit}")
        return self.keypad.number(Decimal(said[0])) if amount else int(said[0])

    @property
    def delivered(self) -> str:
        """What the keypad shows as delivered, and what that means; where no number is known, as printed."""
        number = self.factory
        return self.default if number is None else self.said_of(number)

    @property
    def allowed(self) -> str:
        """The numbers that it takes, as the keypad shows them."""
        if self.values:
            return ", ".join(self.said_of(number) for number, _ in self.values)
        return f"{self.keypad.plain(self.bounds[0])} to {self.keypad.shown(self.bounds[1])}" if self.bounds else ""


@kept
def settings(drive: Drive) -> tuple[Setting, ...]:
    """The settings of a map, in its order."""
    return tuple(
        Setting(
            id=one.id,
            name=one.name,
            said=cited(one),
            register=one.register,
            default=one.default or " or ".join(f"{each.default} ({each.edition})" for each in one.editions),
            editions=bool(one.editions),
            bounds=(one.range.min, one.range.max) if one.range else None,
            values=tuple((each.value, each.name) for each in one.values),
            needed=Needed(one.needed.right, one.needed.by_terminals, one.needed.why) if one.needed else None,
            note=one.note or "",
            keypad=keypad_of(drive, one),
            group=_group(drive, one),
            adjusted=drive.adjusts(one),
        )
        for one in drive.settings
    )


def setting(drive: Drive, id_: str | None) -> Setting | None:
    """A setting by its id."""
    return next((one for one in settings(drive) if one.id == id_), None)


def in_order(drive: Drive) -> tuple[Setting, ...]:
    """The settings in the order in which a person meets them: `GROUPS`, and in each that of the map."""
    line = (*_line(drive), *_silence(drive))
    place = {id_: at for at, id_ in reversed([*enumerate(line)])}
    return tuple(sorted(settings(drive), key=lambda one: (GROUPS.index(one.group), place.get(one.id, len(place)))))


def keypad_of(drive: Drive, one: model.Setting) -> Keypad:
    """As the map says; the scale of a time that it does not say as the watchdog has it."""
    own = one.display
    unit, factor = (own.unit or "", own.factor) if own else ("", None)
    if not unit:
        unit, factor = _of_time(drive, one.id)
    texts = tuple((each.value, each.display) for each in one.values if each.display is not None)
    digits = len(one.default or "") if re.fullmatch("0[0-9]+", one.default or "") else 1
    if own is None:
        return Keypad(one.id, unit=unit, factor=factor, digits=digits, texts=texts)
    return Keypad(own.code or one.id, own.menu or "", unit, factor, own.digits or digits, own.hexadecimal, texts)


def _of_time(drive: Drive, id_: str) -> tuple[str, Decimal | None]:
    """Unit and scale of a setting that the watchdog or the delay of replies counts by."""
    time, delay = drive.watchdog.time if drive.watchdog else None, drive.serial.reply_delay
    if time and time.setting == id_:
        return "s", time.milliseconds / 1000
    if delay and delay.setting == id_:
        return "ms", delay.milliseconds
    return "", None


def _group(drive: Drive, one: model.Setting) -> str:
    """Where a setting belongs, by what the rest of the map says of it."""
    run, beside = drive.operation, _menu(one.id) == _menu(drive.serial.unit.setting)
    own = run.own_maximum.register if run.own_maximum else None
    if one.id in _line(drive):
        return "line"
    if one.id in _silence(drive):
        return "silence"
    if one.id == run.reference.maximum or (own is not None and own == one.register) or drive.adjusts(one):
        return "limits"
    return "line" if beside else "commands" if one.needed else "rest"


def _line(drive: Drive) -> tuple[str, ...]:
    """The settings of the line: address, rate, format, mode."""
    line = drive.serial
    found = (line.unit, line.baud, line.format, line.stop_bits, line.mode)
    return tuple(dict.fromkeys(each.setting for each in found if each and each.setting))


def _silence(drive: Drive) -> tuple[str, ...]:
    """The settings of the watchdog: whether, what, after how long."""
    own = drive.watchdog
    if own is None:
        return ()
    off, time = own.disabled_by.setting if own.disabled_by else None, own.time.setting if own.time else None
    return tuple(dict.fromkeys(each for each in (own.chosen_by, off, time) if each))


def _menu(id_: str | None) -> str:
    """What ids of one menu begin with: P14 of P14.00, C12 of C124; the id where it has no number."""
    return re.sub("[.-][0-9]+$|[0-9]$", "", id_ or "")
