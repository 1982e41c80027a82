"""The dialect of PLCopen's XML that CODESYS and its relatives import: declarations also as text, and folders.

Imports go by name, so that what is replaced by an update and what belongs to the user are in files of their own.
"""

from collections.abc import Sequence
from uuid import NAMESPACE_URL, uuid5

from driveblocks import __version__
from driveblocks.platforms import PLATFORMS
from driveblocks.platforms.element import Element, element
from driveblocks.platforms.ladder import ladder
from driveblocks.platforms.page import page
from driveblocks.platforms.part import SHARED, YOURS, Part, Shelf
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.rungs import diagram
from driveblocks.platforms.tc6 import CODESYS, project, types, vendor, written
from driveblocks.platforms.wide import widened
from driveblocks.render.channels import channels
from structured_text.language.problems import Problem
from structured_text.language.tree import FunctionBlock, Program, TypeDecl

PLATFORM = "codesys"
_SERIAL = {
    "Name": "#CAA SerialCom", "Namespace": "COM", "HideWhenReferencedAsDependency": "false",
    "PublishSymbolsInContainer": "false", "SystemLibrary": "false", "LinkAllContent": "false",
    "DefaultResolution": "CAA SerialCom, * (CAA Technical Workgroup)",
}  # fmt: skip
"""The library that the serial port needs, as exports name one."""


def write(shelf: Shelf) -> dict[str, str]:
    """A file of each volume and of the serial port, and one of each program of a drive. Raises ExportError."""
    problems: list[Problem] = []
    shelf = widened(shelf)
    port = shelf.port(PLATFORM)
    motors = {drive.prefix: shelf.motors(PLATFORM, drive) for drive in shelf.drives.values()}
    masters = shelf.masters(PLATFORM, channels)
    volumes = (*shelf.volumes(), *port)
    programs = [*(one for both in motors.values() for one in both), *masters.values()]
    made = {part.name: _written(part, problems) for one in volumes for part in one.parts}
    made |= {one.name: _written(one, problems) for one in programs}
    blocks = {
        part.name: part.element for one in volumes for part in one.parts if isinstance(part.element, FunctionBlock)
    }
    for _, drawn in motors.values():
        made[drawn.name] = ladder(made[drawn.name], diagram(drawn, blocks))
    if problems:
        raise ExportError(problems)
    files = {f"{one.layer}/{one.name}.xml": _file(one.name, one.parts, made) for one in volumes}
    files |= {f"{YOURS}/{one.name}.xml": _file(one.name, (one,), made) for one in programs}
    return files | page(PLATFORM, shelf, volumes, bool(masters))


def _file(name: str, parts: Sequence[Part], made: dict[str, Element]) -> str:
    data = [vendor("projectstructure", _structure(parts))]
    if any(part.name == f"{PLATFORMS[PLATFORM].prefix}_Port" for part in parts):
        data.insert(0, vendor("libraries", element("Libraries", {}, element("Library", _SERIAL)), keep=True))
    content = types(made[part.name] for part in parts)
    instances = element("instances", {}, element("configurations"))
    return project(CODESYS, name, __version__, content, instances, element("addData", {}, *data))


def _written(part: Part, problems: list[Problem]) -> Element:
    """A part with its identity, by which a second import finds it, and a block's declaration as text."""
    data = [vendor("objectid", Element("ObjectId", {}, text=_identity(part)))]
    if not isinstance(part.element, TypeDecl):
        shown = CODESYS.text(f"(* {part.head} *)\n{part.declaration}\n")
        data.insert(0, vendor("interfaceasplaintext", element("InterfaceAsPlainText", {}, shown), keep=True))
    return written(part, CODESYS, problems, data)


def _identity(part: Part) -> str:
    """The same in every build and in every library."""
    return str(uuid5(NAMESPACE_URL, f"driveblocks:{part.name}"))


def _structure(parts: Sequence[Part]) -> Element:
    """One folder for each of the canonical text's, in one for all; a user's program is outside of it."""
    if all(isinstance(part.element, Program) for part in parts):
        own = (element("Object", {"Name": part.name, "ObjectId": _identity(part)}) for part in parts)
        return element("ProjectStructure", {}, *own)
    folders: dict[str, list[Element]] = {}
    for part in parts:
        one = element("Object", {"Name": part.name, "ObjectId": _identity(part)})
        folders.setdefault(part.folder, []).append(one)
    inner = [element("Folder", {"Name": name}, *objects) for name, objects in folders.items()]
    return element("ProjectStructure", {}, element("Folder", {"Name": SHARED}, *inner))
