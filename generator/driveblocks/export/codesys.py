"""The dialect of PLCopen's XML that CODESYS and its relatives import: declarations also as text, and folders."""

from collections.abc import Iterable
from uuid import NAMESPACE_URL, uuid5

from driveblocks import __version__
from driveblocks.export.element import Element, element
from driveblocks.export.page import page
from driveblocks.export.part import WHOLE, Library, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.tc6 import CODESYS, project, types, vendor, written
from driveblocks.st.problems import Problem
from driveblocks.st.tree import TypeDecl

_PLATFORM = "codesys"


def write(shelf: Shelf) -> dict[str, str]:
    """A file of each library, with the serial port and the first motor of each drive. Raises ExportError."""
    problems: list[Problem] = []
    port = shelf.adapter(_PLATFORM)
    programs = {drive.prefix: shelf.programs(_PLATFORM, drive) for drive in shelf.drives.values()}
    every = (*shelf.parts, *port, *(one for some in programs.values() for one in some))
    made = {part.name: _written(part, problems) for part in every}
    if problems:
        raise ExportError(problems)
    files = {
        f"codesys/{library.name}.xml": _file(library, port, [programs[drive.prefix] for drive in library.drives], made)
        for library in shelf.libraries()
    }
    return files | page(_PLATFORM, shelf, programs, port)


def _file(library: Library, port: Iterable[Part], programs: Iterable[Iterable[Part]], made: dict[str, Element]) -> str:
    parts = (*library.parts, *port, *(one for some in programs for one in some))
    data = element("addData", {}, vendor("projectstructure", _structure(parts)))
    content = types(made[part.name] for part in parts)
    instances = element("instances", {}, element("configurations"))
    return project(CODESYS, library.name, __version__, content, instances, data)


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


def _structure(parts: Iterable[Part]) -> Element:
    """One folder for each of the canonical text's, in one for all."""
    folders: dict[str, list[Element]] = {}
    for part in parts:
        one = element("Object", {"Name": part.name, "ObjectId": _identity(part)})
        folders.setdefault(part.folder, []).append(one)
    inner = [element("Folder", {"Name": name}, *objects) for name, objects in folders.items()]
    return element("ProjectStructure", {}, element("Folder", {"Name": WHOLE}, *inner))
