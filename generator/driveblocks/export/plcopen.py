"""PLCopen's exchange format in its neutral form, TC6 2.01: for Beremiz, OpenPLC's editors and archives."""

from driveblocks import __version__
from driveblocks.export.element import Element, element
from driveblocks.export.ladder import ladder
from driveblocks.export.page import page
from driveblocks.export.part import Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.tc6 import NEUTRAL, project, types, written
from driveblocks.maps.model import Drive
from driveblocks.render.library import BYTES
from driveblocks.render.motor import SCAN_MS
from driveblocks.st.parser import parse
from driveblocks.st.problems import Problem
from driveblocks.st.tree import FunctionBlock


def write(shelf: Shelf) -> dict[str, str]:
    """A file of each library, with a first motor of each drive as text and as a ladder. Raises ExportError."""
    problems: list[Problem] = []
    blocks = {part.name: part.element for part in shelf.parts if isinstance(part.element, FunctionBlock)}
    programs = {drive.prefix: _programs(shelf, drive) for drive in shelf.drives.values()}
    every = (*shelf.parts, *(one for both in programs.values() for one in both))
    made = {part.name: written(part, NEUTRAL, problems) for part in every}
    made |= {twin.name: ladder(made[twin.name], twin, blocks) for _, twin in programs.values()}
    if problems:
        raise ExportError(problems)
    files: dict[str, str] = {}
    for library in shelf.libraries():
        own = [one for drive in library.drives for one in programs[drive.prefix]]
        content = types(made[part.name] for part in (*library.parts, *own))
        names = [drive.prefix for drive in library.drives]
        files[f"plcopen/{library.name}.xml"] = project(NEUTRAL, library.name, __version__, content, _instances(names))
    return files | page(BYTES, shelf, programs)


def _programs(shelf: Shelf, drive: Drive) -> tuple[Part, Part]:
    """The first motor of a drive, and what is to become its ladder."""
    motor = shelf.motor(BYTES, drive)
    name, other = f"{drive.prefix}_Motor", f"{drive.prefix}_Ladder"
    return motor, Part(motor.folder, parse(motor.text.replace(name, other), motor.unit.path.replace(name, other)))


def _instances(prefixes: list[str]) -> Element:
    """One task that runs the first motors."""
    runs = [element("pouInstance", {"name": f"{one}_1", "typeName": f"{one}_Motor"}) for one in prefixes]
    task = element("task", {"name": "Motors", "priority": "0", "interval": f"T#{SCAN_MS}ms"}, *runs)
    resource = element("resource", {"name": "Cpu"}, task)
    return element(
        "instances", {}, element("configurations", {}, element("configuration", {"name": "Config"}, resource))
    )
