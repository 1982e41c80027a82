"""PLCopen's exchange format in its neutral form, TC6 2.01, for Beremiz: its editor takes whole projects only.

The project holds all that is shared, every family, and a first motor of each, as text and as a ladder, at a serial port
of Linux; its task runs one of them.
"""

from driveblocks import __version__
from driveblocks.platforms.element import Element, element
from driveblocks.platforms.ladder import diagram, ladder
from driveblocks.platforms.page import page
from driveblocks.platforms.part import SHARED, Shelf
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.tc6 import NEUTRAL, project, types, written
from driveblocks.render.motor import SCAN_MS
from structured_text.language.problems import Problem
from structured_text.language.tree import FunctionBlock

PLATFORM, PORT = "beremiz", "linux"
PROJECT = f"{SHARED}/plc.xml"
"""The folder of a project, and the file in it that Beremiz reads."""


def write(shelf: Shelf) -> dict[str, str]:
    """The project. Raises ExportError."""
    problems: list[Problem] = []
    volumes = tuple(shelf.volumes())
    port = shelf.port(PORT)
    shared = [one for one in volumes if not one.drive]
    library = [part for one in (*shared, *port, *(one for one in volumes if one.drive)) for part in one.parts]
    motors = [shelf.motors(PORT, drive) for drive in shelf.drives.values()]
    made = {
        part.name: written(part, NEUTRAL, problems) for part in (*library, *(one for both in motors for one in both))
    }
    blocks = {part.name: part.element for part in library if isinstance(part.element, FunctionBlock)}
    for _, drawn in motors:
        made[drawn.name] = ladder(made[drawn.name], diagram(drawn, blocks, coils=False))
    if problems:
        raise ExportError(problems)
    first = motors[0][0].name if motors else ""
    text = project(NEUTRAL, SHARED, __version__, types(made.values()), _instances(first))
    return {PROJECT: text} | page(PLATFORM, shelf, (*volumes, *port))


def _instances(program: str) -> Element:
    """One task that runs a first motor; none where there is no family."""
    configurations = element("configurations")
    if program:
        run = element("pouInstance", {"name": f"{program}1", "typeName": program})
        task = element("task", {"name": "Motors", "priority": "0", "interval": f"T#{SCAN_MS}ms"}, run)
        resource = element("resource", {"name": "Cpu"}, task)
        configurations = element("configurations", {}, element("configuration", {"name": "Config"}, resource))
    return element("instances", {}, configurations)
