"""What a person does about a fault: how it is shown, what may have caused it, what helps, and what clears it."""

import difflib
import re
from dataclasses import dataclass

from driveblocks.maps.model import Drive, Fault
from driveblocks.meaning.words import words

_HEXADECIMAL = re.compile(r"(?:0X([0-9A-F]+)|([0-9A-F]+)H)")


@dataclass(frozen=True)
class Advice:
    """Of one fault code."""

    code: int
    keypad: str
    """As the keypad shows it; empty where nobody says."""
    name: str
    causes: tuple[str, ...]
    remedies: tuple[str, ...]
    clears: str
    note: str


def advice(drive: Drive) -> list[Advice]:
    """Of every fault of a drive, in the manual's order."""
    return [_advice(drive, one) for one in drive.faults.codes]


def _advice(drive: Drive, fault: Fault) -> Advice:
    shown = fault.id or (drive.faults.help.shown(fault.code) if drive.faults.help else "")
    causes, remedies = (tuple(each.en for each in some) for some in (fault.causes, fault.remedies))
    return Advice(fault.code, shown, fault.name, causes, remedies, _clears(drive, fault), fault.note or "")


def _clears(drive: Drive, fault: Fault) -> str:
    if fault.power_cycle:
        return "switch the drive off and on"
    return "`FaultReset`" if "fault_reset" in words(drive).named else "nothing on the bus; reset it at the drive"


def of_code(drive: Drive, code: int) -> Advice | None:
    """Of the fault with this code; None where the map has none such."""
    return next((_advice(drive, one) for one in drive.faults.codes if one.code == code), None)


def asked(drive: Drive, word: str) -> list[Advice]:
    """What a word means: a display, or a code in decimal, or in hexadecimal with H or 0x; all that fit."""
    upper = word.strip().upper()
    number = int(upper) if upper.isdecimal() else None
    if found := _HEXADECIMAL.fullmatch(upper):
        number = int(found[1] or found[2], 16)
    return [one for one in advice(drive) if one.keypad.upper() == upper or one.code == number]


def nearest(drive: Drive, word: str, most: int = 4) -> list[Advice]:
    """The codes nearest to a word that means none: those whose display or name is like it, then by number."""
    known, upper = advice(drive), word.strip().upper()
    shown = {one.keypad.upper(): one for one in known if one.keypad}
    like = [shown[one] for one in difflib.get_close_matches(upper, shown, most, 0.6)]
    like += [one for one in known if upper in one.name.upper()]
    number = int(re.sub(r"[^0-9]", "", word) or 0)
    by_number = sorted(known, key=lambda one: abs(one.code - number))
    return list(dict.fromkeys(by_number if upper.isdecimal() else [*like, *by_number]))[:most]
