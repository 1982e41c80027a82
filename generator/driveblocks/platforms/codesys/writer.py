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
from driveblocks.platforms.part import SHARED, YOURS, Own, Part, Shelf, Volume
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
    volumes = (*shelf.volumes(), *shelf.port(PLATFORM))
    motors = [shelf.motors(PLATFORM, drive) for drive in shelf.drives.values()]
    masters = shelf.masters(PLATFORM, channels)
    made = {part.name: _written(part, problems) for one in volumes for part in one.parts}
    texts = (*(text for text, _ in motors), *masters.values())
    programs = _programs(volumes, texts, [drawn for _, drawn in motors], problems)
    if problems:
        raise ExportError(problems)
    files = {f"{one.layer}/{one.name}.xml": _file(one.name, one.parts, made) for one in volumes}
    return files | programs | page(PLATFORM, shelf, volumes, bool(masters))


def own(shelf: Shelf, programs: Own) -> dict[str, str]:
    """A file of each program of a user's own. Raises ExportError."""
    problems: list[Problem] = []
    volumes = (*shelf.volumes(), *shelf.port(PLATFORM))
    files = _programs(volumes, programs.texts, programs.ladders, problems)
    if problems:
        raise ExportError(problems)
    return files


def _programs(
    volumes: Sequence[Volume], texts: Sequence[Part], ladders: Sequence[Part], problems: list[Problem]
) -> dict[str, str]:
    made = {one.name: _written(one, problems) for one in (*texts, *ladders)}
    parts = (part for one in volumes for part in one.parts)
    blocks = {part.name: part.element for part in parts if isinstance(part.element, FunctionBlock)}
    made |= {one.name: ladder(made[one.name], diagram(one, blocks)) for one in ladders}
    return {f"{YOURS}/{one.name}.xml": _file(one.name, (one,), made) for one in (*texts, *ladders)}


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
