"""PLCopen's exchange format in its neutral form, TC6 2.01: for Beremiz, OpenPLC's editors and archives."""

from driveblocks import __version__
from driveblocks.export.element import Element, element
from driveblocks.export.ladder import diagram, ladder
from driveblocks.export.page import page
from driveblocks.export.part import Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.tc6 import NEUTRAL, project, types, written
from driveblocks.render.library import BYTES
from driveblocks.render.motor import SCAN_MS
from structured_text.language.problems import Problem
from structured_text.language.tree import FunctionBlock


def write(shelf: Shelf) -> dict[str, str]:
    """A file of each library, and a project to begin with for each drive: its library, a first motor as text and as a
    ladder, and a task. Raises ExportError."""
    problems: list[Problem] = []
    motors = {drive.prefix: shelf.motors(BYTES, drive) for drive in shelf.drives.values()}
    files = {library.name: library.parts for library in shelf.libraries()}
    files |= {motor.name: (*files[prefix], motor, drawn) for prefix, (motor, drawn) in motors.items()}
    every = (*shelf.parts, *(one for both in motors.values() for one in both))
    made = {part.name: written(part, NEUTRAL, problems) for part in every}
    blocks = {part.name: part.element for part in shelf.parts if isinstance(part.element, FunctionBlock)}
    made |= {drawn.name: ladder(made[drawn.name], diagram(drawn, blocks)) for _, drawn in motors.values()}
    if problems:
        raise ExportError(problems)
    runs = {motor.name: prefix for prefix, (motor, _) in motors.items()}
    texts = {
        f"plcopen/{name}.xml": project(
            NEUTRAL, name, __version__, types(made[part.name] for part in parts), _instances(runs.get(name))
        )
        for name, parts in files.items()
    }
    return texts | page(BYTES, shelf, files)


def _instances(prefix: str | None) -> Element:
    """One task that runs the first motor; none of a library."""
    configurations = element("configurations")
    if prefix:
        run = element("pouInstance", {"name": f"{prefix}_1", "typeName": f"{prefix}_Motor"})
        task = element("task", {"name": "Motors", "priority": "0", "interval": f"T#{SCAN_MS}ms"}, run)
        resource = element("resource", {"name": "Cpu"}, task)
        configurations = element("configurations", {}, element("configuration", {"name": "Config"}, resource))
    return element("instances", {}, configurations)
