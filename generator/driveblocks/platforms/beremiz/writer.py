"""PLCopen's exchange format in its neutral form, TC6 2.01, for Beremiz: its editor takes whole projects only.

The project holds all that is shared, every family, and a first motor of each, as text and as a ladder, at a serial port
of Linux; its task runs one of them.
"""

from collections.abc import Sequence

from driveblocks import __version__
from driveblocks.platforms.element import Element, element
from driveblocks.platforms.ladder import diagram, ladder
from driveblocks.platforms.page import page
from driveblocks.platforms.part import SHARED, YOURS, Own, Part, Shelf
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
    motors = [shelf.motors(PORT, drive) for drive in shelf.drives.values()]
    texts, ladders = [text for text, _ in motors], [drawn for _, drawn in motors]
    first = texts[0].name if texts else ""
    whole = _whole(shelf, SHARED, [one for both in motors for one in both], ladders, _instances(first))
    return {PROJECT: whole} | page(PLATFORM, shelf, (*shelf.volumes(), *shelf.port(PORT)))


def own(shelf: Shelf, programs: Own) -> dict[str, str]:
    """A project whose task runs the first program of a user's own. Raises ExportError."""
    name = programs.texts[0].name
    run = _instances(name, programs.scan_ms)
    text = _whole(shelf, name, [*programs.texts, *programs.ladders], programs.ladders, run)
    return {f"{YOURS}/{name}/plc.xml": text}


def _whole(shelf: Shelf, name: str, programs: Sequence[Part], ladders: Sequence[Part], instances: Element) -> str:
    """The file of a project; of the programs, the ladders are drawn."""
    problems: list[Problem] = []
    volumes = tuple(shelf.volumes())
    shared, families = ([one for one in volumes if bool(one.drive) is each] for each in (False, True))
    library = [part for one in (*shared, *shelf.port(PORT), *families) for part in one.parts]
    made = {part.name: written(part, NEUTRAL, problems) for part in (*library, *programs)}
    blocks = {part.name: part.element for part in library if isinstance(part.element, FunctionBlock)}
    for drawn in ladders:
        made[drawn.name] = ladder(made[drawn.name], diagram(drawn, blocks, coils=False))
    if problems:
        raise ExportError(problems)
    return project(NEUTRAL, name, __version__, types(made.values()), instances)


def _instances(program: str, scan_ms: int = SCAN_MS) -> Element:
    """One task that runs a first motor; none where there is no family."""
    configurations = element("configurations")
    if program:
        run = element("pouInstance", {"name": f"{program}1", "typeName": program})
        task = element("task", {"name": "Motors", "priority": "0", "interval": f"T#{scan_ms}ms"}, run)
        resource = element("resource", {"name": "Cpu"}, task)
        configurations = element("configurations", {}, element("configuration", {"name": "Config"}, resource))
    return element("instances", {}, configurations)
