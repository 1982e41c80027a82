"""The dialect of PLCopen's XML that CODESYS and its relatives import: declarations also as text, and folders.

Imports go by name, so that what is replaced by an update and what belongs to the user are in files of their own.
"""

from collections.abc import Iterable
from uuid import NAMESPACE_URL, uuid5

from driveblocks import __version__
from driveblocks.export.element import Element, element
from driveblocks.export.ladder import ladder
from driveblocks.export.page import page
from driveblocks.export.part import WHOLE, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.rungs import diagram
from driveblocks.export.tc6 import CODESYS, project, types, vendor, written
from driveblocks.export.wide import wide
from structured_text.language.problems import Problem
from structured_text.language.tree import FunctionBlock, Program, TypeDecl

_PLATFORM = "codesys"
_SERIAL = {
    "Name": "#CAA SerialCom", "Namespace": "COM", "HideWhenReferencedAsDependency": "false",
    "PublishSymbolsInContainer": "false", "SystemLibrary": "false", "LinkAllContent": "false",
    "DefaultResolution": "CAA SerialCom, * (CAA Technical Workgroup)",
}  # fmt: skip
"""The library that the serial port needs, as exports name one."""


def write(shelf: Shelf) -> dict[str, str]:
    """A file of each library with the serial port, and one of each program of a drive. Raises ExportError."""
    problems: list[Problem] = []
    port = shelf.adapter(_PLATFORM)
    drives = tuple(shelf.drives.values())
    drawn = {drive.prefix: shelf.motors(_PLATFORM, drive)[1] for drive in drives}
    programs = [one for drive in drives for one in (*shelf.programs(_PLATFORM, drive), drawn[drive.prefix])]
    texts = wide(shelf)
    files = {library.name: (*library.parts, *library.own(texts), *port) for library in shelf.libraries()}
    files |= {one.name: (one,) for one in programs}
    made = {part.name: _written(part, problems) for part in (*shelf.parts, *texts, *port, *programs)}
    blocks = {part.name: part.element for part in (*shelf.parts, *port) if isinstance(part.element, FunctionBlock)}
    for one in drawn.values():
        made[one.name] = ladder(made[one.name], diagram(one, blocks))
    if problems:
        raise ExportError(problems)
    whole = {f"codesys/{name}.xml": _file(name, parts, made) for name, parts in files.items()}
    return whole | page(_PLATFORM, shelf, files)


def _file(name: str, parts: Iterable[Part], made: dict[str, Element]) -> str:
    parts = tuple(parts)
    data = [vendor("projectstructure", _structure(parts))]
    if any(part.folder == _PLATFORM and isinstance(part.element, FunctionBlock) for part in parts):
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


def _structure(parts: tuple[Part, ...]) -> Element:
    """One folder for each of the canonical text's, in one for all; a user's program is outside of it."""
    if all(isinstance(part.element, Program) for part in parts):
        own = (element("Object", {"Name": part.name, "ObjectId": _identity(part)}) for part in parts)
        return element("ProjectStructure", {}, *own)
    folders: dict[str, list[Element]] = {}
    for part in parts:
        one = element("Object", {"Name": part.name, "ObjectId": _identity(part)})
        folders.setdefault(part.folder, []).append(one)
    inner = [element("Folder", {"Name": name}, *objects) for name, objects in folders.items()]
    return element("ProjectStructure", {}, element("Folder", {"Name": WHOLE}, *inner))
