"""A drive of a plant in the words of the command line: `plant.yaml:P1`."""

import re
from dataclasses import dataclass
from pathlib import Path

from driveblocks.desk.site.found import Way
from driveblocks.desk.site.kept import LABEL
from driveblocks.maps import catalog
from driveblocks.maps.problem import MapError, Refused, Report
from driveblocks.plant import load
from driveblocks.plant.model import Motor
from structured_text import files
from structured_text.visible import file_name

_PLANT = re.compile(rb"^(plant|lines|drives)[ \t]*:", re.MULTILINE)
_MAP = re.compile(rb"^(format|prefix|base)[ \t]*:", re.MULTILINE)
_WORD = re.compile(rf"(?P<file>.+\.ya?ml):(?P<name>{LABEL.pattern})", re.IGNORECASE)
_HEAD = 1 << 19
"""Bytes of a file that are looked at: all of a plant."""


@dataclass(frozen=True)
class Found:
    """A drive of a plant, and how its line is spoken on."""

    motor: Motor
    way: Way

    @property
    def word(self) -> str:
        """Its map as other commands name it: a shipped one by its name."""
        path = self.motor.path
        return path.stem if catalog.is_shipped(path) else str(path)


def is_plant(path: Path) -> bool:
    """Whether a file is a plant, by its keys; a map is none."""
    try:
        text = files.head(path, _HEAD)
    except files.BadFile:
        return False
    return bool(_PLANT.search(text)) and not _MAP.search(text)


def split(word: str) -> tuple[Path, str] | None:
    """File and drive of a word; None where it names no drive of a plant."""
    match = _WORD.fullmatch(word)
    return (Path(match["file"]), match["name"]) if match and is_plant(Path(match["file"])) else None


def drive(path: Path, name: str) -> Found:
    """A drive of a plant, whatever is wrong with others. Raises Refused."""
    report = Report(file_name(path))
    plant = load.read(path, report)
    if plant is None:
        raise MapError(report.problems)
    motor = plant.drives.get(name)
    if motor is None or motor.line not in plant.lines:
        report.raise_if_any()
        if motor is None:
            raise Refused(f"{file_name(path)} has no drive {name}; it has {', '.join(plant.drives)}")
        raise Refused(f"{file_name(path)} has no line {motor.line}, on which {name} is")
    return Found(motor, plant.lines[motor.line].way)
