"""What changes where a drive of one family takes the place of one of another, in the order of the work."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import get_args

from driveblocks.docs import brief, keypad
from driveblocks.maps import inventory, rivals, trust
from driveblocks.maps.model import Drive, Shows
from driveblocks.maps.revision import checked
from driveblocks.meaning import chosen, conduct, setting
from driveblocks.meaning.measure import PINS, measures
from driveblocks.meaning.plug import plug
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import Serial, serial
from driveblocks.meaning.status import status
from driveblocks.meaning.words import words

UNKNOWN, NONE, UNNAMED = "not known", "-", "the map names none"
ABILITIES = {
    "run_reverse": "run in reverse", "jog_forward": "jog forward", "jog_reverse": "jog in reverse",
    "quick_stop": "quick stop", "coast_stop": "coast stop", "fault_reset": "reset a fault",
}  # fmt: skip
"""Command -> what a drive can do over the bus if it has it."""
_LEFT = keypad.TITLES["rest"]
_ORDER = (
    "access level", "who commands", "unit address", "bit rate", "format", "stop bits", "framing", "delay of replies",
    "address, rate, format", "a silent line", "watchdog off", "watchdog time", "when the line is silent",
    "100 % of the speed", "lower limit", "limits and ramps",
)  # fmt: skip
"""What settings do, in the order in which a person meets them; of those that only share a group, its title."""

Row = tuple[str, str, str]
"""What it is, at the old drive, at the new one."""


@dataclass(frozen=True)
class Section:
    """A part of the work; a row that is the same for both is in it where a person looks for it."""

    title: str
    rows: tuple[Row, ...]


def sections(old: Drive, new: Drive) -> Iterator[Section]:
    """All parts that have something to say."""
    parts: dict[str, Callable[[Drive, Drive], Iterable[Row]]] = {
        "If the block is not exchanged": _mistaken,
        "Wiring": _wiring,
        "The line": _line,
        "Keypad": _keypad,
        "Pins of the block": _pins,
        "Over the bus": _bus,
        "By itself": _conduct,
        "The same fault, another number": _renumbered,
        "The same number, another fault": _confused,
    }
    for title, rows in parts.items():
        if found := tuple(rows(old, new)):
            yield Section(title, found)


def pins(drive: Drive) -> dict[str, str]:
    """What a block of this family wants otherwise than that of another."""
    line, speed, able = serial(drive), reference(drive), words(drive).named
    return {
        "prefix": drive.prefix,
        "full": f"required: what {speed.maximum} says" if speed.percent else "no use",
        "scale": "no use" if speed.scaled else "required",
        "pairs": "required" if speed.in_rpm else "no use",
        "checked": "required" if trust.second_hand(drive) else "no use",
        "reset": "yes" if "fault_reset" in able else "no",
        "cannot": ", ".join(said for does, said in ABILITIES.items() if does not in able) or "nothing",
        "units": f"{line.lowest} to {line.highest}",
    }


def _told(old: Drive, new: Drive, said: dict[str, Callable[[Drive], str]], *, same: bool = True) -> Iterator[Row]:
    """Rows that are known of one of them; `same`: also those that do not differ."""
    for what, of in said.items():
        row = (of(old), of(new))
        if set(row) - {"", UNKNOWN} and (same or row[0] != row[1]):
            yield what, row[0] or UNKNOWN, row[1] or UNKNOWN


def _mistaken(old: Drive, new: Drive) -> Iterator[Row]:
    """What a stop of the block of one does at the other."""
    for pair in rivals.pairs([old, new]):
        says = rivals.warning(pair)
        before, after = (NONE, says) if pair.drive.prefix == new.prefix else (says, NONE)
        yield f"{pair.block.prefix}_Drive", before, after


def _wiring(old: Drive, new: Drive) -> Iterator[Row]:
    yield from _told(
        old,
        new,
        {
            "connector": lambda one: plug(one).connector,
            "positive at rest (D1, B)": lambda one: plug(one).at("positive"),
            "negative at rest (D0, A)": lambda one: plug(one).at("negative"),
            "common": lambda one: plug(one).at("common"),
            "termination": lambda one: plug(one).termination,
            "bias": lambda one: plug(one).bias,
            "shield": lambda one: plug(one).shield,
            "never": lambda one: "; ".join(plug(one).never),
        },
    )
    find_out = "; ".join(how for _, how in plug(new).gaps)
    if find_out:
        yield "to find out", NONE, find_out


def _line(old: Drive, new: Drive) -> Iterator[Row]:
    """What the line must be, and what both drives can."""
    yield from _told(
        old,
        new,
        {
            "framing": lambda one: ", ".join(each.upper() for each in serial(one).modes),
            "bit rates": lambda one: ", ".join(map(str, chosen.rates(one))),
            "formats": lambda one: ", ".join(chosen.forms(one)),
            "as delivered": lambda one: _delivered(serial(one)),
            "unit addresses": lambda one: pins(one)["units"],
            "silence around a frame": lambda one: _silence(serial(one)),
            "answers later": lambda one: conduct.reply_delay(one) or "",
        },
    )
    for what, of in (("rates of both", chosen.rates), ("formats of both", chosen.forms)):
        if of(old) and of(new):
            both = ", ".join(str(each) for each in of(old) if each in of(new))
            yield what, both or "none", both or "none: it needs a line of its own"


def _delivered(line: Serial) -> str:
    rate = f"{line.rate} bit/s {line.character.form}" if line.known else ""
    unit = f"address {line.factory}{', at which it answers nobody' * line.silent}" if line.factory is not None else ""
    return ", ".join(filter(None, (rate, unit)))


def _silence(line: Serial) -> str:
    characters = f"{line.silence_characters} characters" if line.silence_characters else ""
    return f"more than {line.silence_ms} ms" if line.silence_ms else characters


def _keypad(old: Drive, new: Drive) -> Iterator[Row]:
    """Each setting of the one beside that of the other which does the same."""
    before, after = _by_job(old), _by_job(new)
    for job in sorted(before | after, key=_ORDER.index):
        yield job, "\n".join(before.get(job, [UNNAMED])), "\n".join(after.get(job, [UNNAMED]))


def _by_job(drive: Drive) -> dict[str, list[str]]:
    """What it does -> settings, each with what it is to be."""
    jobs, found = setting.jobs(drive), dict[str, list[str]]()
    for title, some in keypad.rows(drive).items():
        for row in (one for one in some if title != _LEFT or one.setting.id in jobs):
            found.setdefault(jobs.get(row.setting.id, title.lower()), []).append(_cell(row))
    return found


def _cell(row: keypad.Row) -> str:
    """A setting as the keypad calls it, and what it is to be."""
    one, to = row.setting, row.set_to.replace("**", "")
    as_is = f"{to} ({one.delivered})" if to == "as delivered" and one.delivered else to
    return f"{one.keypad.code}{f' in {one.keypad.menu}' * bool(one.keypad.menu)}, {one.name}: {as_is}"


def _pins(old: Drive, new: Drive) -> Iterator[Row]:
    yield "type of the instance", f"{old.prefix}_Drive", f"{new.prefix}_Drive"
    yield from _told(
        old,
        new,
        {
            "FullScaleHz": lambda one: pins(one)["full"],
            "Settings.ReferenceScale": lambda one: pins(one)["scale"],
            "Settings.PolePairs": lambda one: pins(one)["pairs"],
            "ManualChecked": lambda one: str(checked(one)) if trust.second_hand(one) else "no use",
            "scales of what it shows": lambda one: ", ".join(_open_scales(one)) or "no use",
        },
        same=False,
    )
    yield "StopWithinMs", NONE, "the longest ramp of this drive, and a margin"
    yield from _told(old, new, {"a speed on the wire": lambda one: dict(brief.speeds(one))["counts"]})


def _open_scales(drive: Drive) -> Iterator[str]:
    """Members of `Settings` without which a pin shows the raw count."""
    shown = (PINS[one.name].setting for one in measures(drive) if not one.quantity.factors)
    return (f"Settings.{each}" for each in shown if each)


def _bus(old: Drive, new: Drive) -> Iterator[Row]:
    """What one of them can do, or shows, and the other cannot."""
    both = (old, new)
    can = [inventory.abilities(one)[0].split(", ") for one in both]
    found = {what: [what in each for each in can] for what in (*can[0], *can[1])}
    found |= {f"shows {_plain(one)}": [bool(status(each).shows(one)) for each in both] for one in get_args(Shows)}
    shown = [{one.name for one in measures(each)} for each in both]
    found |= {f"shows {_plain(one)}": [one in each for each in shown] for one in PINS}
    yield from ((what, *_yes_no(*each)) for what, each in found.items() if each[0] != each[1])


def _yes_no(before: object, after: object) -> tuple[str, str]:
    return ("yes" if before else "no", "yes" if after else "no")


def _plain(name: str) -> str:
    return name.replace("_", " ")


def _conduct(old: Drive, new: Drive) -> Iterator[Row]:
    yield from _told(
        old,
        new,
        {
            "the cable is cut, as delivered": conduct.delivered,
            "the cable is cut": conduct.silent_line,
            "the drive trips": conduct.trip,
            "less is asked for than its lower limit": conduct.lower_limit,
            "a fault is reset": lambda one: conduct.silenced(one) or "",
        },
    )


def _renumbered(old: Drive, new: Drive) -> Iterator[Row]:
    known = {one.name.casefold(): one for one in new.faults.codes}
    for one in old.faults.codes:
        other = known.get(one.name.casefold())
        if other and one.code != other.code:
            yield one.name, str(one.code), str(other.code)


def _confused(old: Drive, new: Drive) -> Iterator[Row]:
    known = {one.code: one for one in new.faults.codes}
    for one in old.faults.codes:
        other = known.get(one.code)
        if other and one.name.casefold() != other.name.casefold():
            yield str(one.code), one.name, other.name
