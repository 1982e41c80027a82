"""What the drives of a line have in common: bit rates, characters, framing; and what the line is to be."""

from collections.abc import Collection, Iterable
from typing import get_args

from driveblocks.desk.site.found import Way
from driveblocks.maps.model import Drive
from driveblocks.meaning import chosen
from driveblocks.meaning.serial import FORMS, USUAL_RATE, Character, serial
from driveblocks.modbus.frame import Mode
from driveblocks.plant.model import Line


def forms(drive: Drive, mode: Mode) -> tuple[str, ...]:
    """The characters that a drive has in a framing; where its map lists none, all: RTU has 8 data bits."""
    return tuple(each for each in chosen.forms(drive, mode) or FORMS if mode == "ascii" or each[0] == "8")


def modes(drives: Collection[Drive]) -> tuple[Mode, ...]:
    """The framings that all of them have, RTU first."""
    return tuple(each for each in get_args(Mode) if all(each in serial(one).modes for one in drives))


def delivered(drives: Iterable[Drive]) -> tuple[set[int], set[str]]:
    """The bit rates and characters that drives have as delivered, as far as their manuals say."""
    known = [serial(each) for each in drives if serial(each).known]
    return {each.rate for each in known} or {USUAL_RATE}, {each.character.form for each in known} or {Character().form}


def way(line: Line, drives: Collection[Drive]) -> Way:
    """How a line is spoken on: as it says, else as all its drives are delivered; where they differ, any of it."""
    rates, characters = delivered(drives)
    common = modes(drives) or ("rtu",)
    return Way(line.rate or min(rates), line.form or min(characters), line.mode or common[0])
