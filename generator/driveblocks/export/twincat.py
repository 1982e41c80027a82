"""TwinCAT 3: a file per type, block and program, as "Add existing item" takes it, and projects that list them.

The form is that of files in public projects: TcPlcObject 1.1.0.1, which the oldest builds of them have, UTF-8 with a
byte order mark, CRLF. Ids are made of names, so that a rebuild is no diff.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from uuid import UUID, uuid5
from xml.sax.saxutils import quoteattr

from driveblocks.export.part import Library, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.render.environment import render
from driveblocks.render.library import PLATFORMS
from driveblocks.st.parser import parse
from driveblocks.st.problems import Problem
from driveblocks.st.tree import TypeDecl

TARGET = "twincat"
IDS = UUID("6b1f2c0e-2d0f-5a53-9a39-1f0d6c7c6a11")
"""The namespace of all ids: chosen once, and never to be changed."""
PORT, MOTOR = "port", "motor"
"""Folders of the adapter and of the first motors."""
GLOBALS = "TC_Com"
LIBRARIES = ("Tc2_System", "Tc2_SerialCom")
"""What the adapter uses of Beckhoff's; the blocks use none."""
MARK = "\ufeff"
_UNSPEAKABLE = re.compile(r"\]\]>|[^\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""The end of a CDATA section, and what no XML can hold."""


@dataclass(frozen=True)
class Item:
    """One file of a project: its folder, name, ending, and text."""

    folder: str
    name: str
    ending: str
    text: str

    @property
    def path(self) -> str:
        """Path below the target's folder."""
        return f"{self.folder}/{self.name}.{self.ending}"


def files(shelf: Shelf) -> dict[str, str]:
    """Every file of the target. Raises ExportError for texts that the format cannot hold."""
    port = tuple(_port(shelf))
    motors = {drive.prefix: shelf.motor(TARGET, drive) for drive in shelf.drives.values()}
    _refuse((*shelf.parts, *port, *motors.values()))
    blocks = {part.name: _item(part, part.folder) for part in shelf.parts}
    adapter = [*(_item(part, PORT) for part in port), _globals()]
    made = {item.path: item.text for item in (*blocks.values(), *adapter)}
    for library in shelf.libraries():
        own = [_item(motors[drive.prefix], MOTOR) for drive in library.drives]
        items = [*(blocks[part.name] for part in library.parts), *adapter, *own]
        made |= {item.path: item.text for item in own}
        made[f"{library.name}.plcproj"] = _project(library, items)
    made["README.md"] = _page(shelf, adapter)
    return {f"{TARGET}/{path}": text for path, text in made.items()}


def _port(shelf: Shelf) -> Iterator[Part]:
    """The adapter, and the program that serves the terminal."""
    yield from shelf.adapter(TARGET)
    _, where = PLATFORMS[TARGET]
    yield Part(TARGET, parse(render("twincat/TC_Fast.st.j2", where=where), f"{TARGET}/TC_Fast.st"))


def _globals() -> Item:
    """What two tasks share."""
    text = render(f"twincat/{GLOBALS}.gvl.j2").rstrip("\n")
    inner = f'  <GVL Name="{GLOBALS}" Id="{_id(GLOBALS)}">\n{_declared(text)}  </GVL>\n'
    return Item(PORT, GLOBALS, "TcGVL", _object(inner))


def _item(part: Part, folder: str) -> Item:
    """The file of a part."""
    name, id_ = part.name, _id(part.name)
    if isinstance(part.element, TypeDecl):
        text = part.text.rstrip("\n").replace("\n  END_STRUCT;\n", "\n  END_STRUCT\n")
        inner = f'  <DUT Name="{name}" Id="{id_}">\n{_declared(text)}  </DUT>\n'
        return Item(folder, name, "TcDUT", _object(inner))
    text = part.text[: part.element.at] + part.declaration
    body = f"    <Implementation>\n      <ST><![CDATA[{part.body}]]></ST>\n    </Implementation>\n"
    inner = f'  <POU Name="{name}" Id="{id_}" SpecialFunc="None">\n{_declared(text)}{body}  </POU>\n'
    return Item(folder, name, "TcPOU", _object(inner))


def _declared(text: str) -> str:
    return f"    <Declaration><![CDATA[{text}\n]]></Declaration>\n"


def _object(inner: str) -> str:
    """A file with one object."""
    return _file(f'<TcPlcObject Version="1.1.0.1" ProductVersion="3.1.4024.0">\n{inner}</TcPlcObject>\n')


def _file(text: str) -> str:
    return MARK + f'<?xml version="1.0" encoding="utf-8"?>\n{text}'.replace("\n", "\r\n")


def _id(name: str) -> str:
    return f"{{{uuid5(IDS, name)}}}"


def _project(library: Library, items: list[Item]) -> str:
    """The project of a library."""
    folders = dict.fromkeys(item.folder for item in items)
    lines = [
        '<Project DefaultTargets="Build" xmlns="http://schemas.microsoft.com/developer/msbuild/2003">',
        "  <PropertyGroup>",
        "    <FileVersion>1.0.0.0</FileVersion>",
        "    <SchemaVersion>2.0</SchemaVersion>",
        f"    <ProjectGuid>{_id(f'{library.name}.plcproj')}</ProjectGuid>",
        "    <SubObjectsSortedByName>True</SubObjectsSortedByName>",
        f"    <Name>{library.name}</Name>",
        "    <ProgramVersion>3.1.4024.0</ProgramVersion>",
        "  </PropertyGroup>",
        "  <ItemGroup>",
        *(_compiled(item) for item in items),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(f"    <Folder Include={quoteattr(folder)} />" for folder in folders),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(_reference(name) for name in LIBRARIES),
        "  </ItemGroup>",
        "</Project>",
    ]
    return _file("\n".join(lines) + "\n")


def _compiled(item: Item) -> str:
    path = item.path.replace("/", "\\")
    return f"    <Compile Include={quoteattr(path)}>\n      <SubType>Code</SubType>\n    </Compile>"


def _reference(name: str) -> str:
    return (
        f'    <PlaceholderReference Include="{name}">\n'
        f"      <DefaultResolution>{name}, * (Beckhoff Automation GmbH)</DefaultResolution>\n"
        f"      <Namespace>{name}</Namespace>\n"
        "    </PlaceholderReference>"
    )


def _refuse(parts: Iterable[Part]) -> None:
    """Raise ExportError with every place of texts that cannot stand in a CDATA section."""
    problems = [
        Problem(part.unit.path, *part.unit.place(found.start()), _why(found[0]), "export")
        for part in parts
        for found in _UNSPEAKABLE.finditer(part.text)
    ]
    if problems:
        raise ExportError(problems)


def _why(found: str) -> str:
    if len(found) > 1:
        return f"`{found}` ends the text in a file of TwinCAT: put a blank between the brackets"
    return f"the character {ord(found):04X}H cannot stand in a file of TwinCAT: leave it out"


def _page(shelf: Shelf, adapter: list[Item]) -> str:
    return render("twincat/README.md.j2", libraries=list(map(_counted, shelf.libraries())), adapter=len(adapter))


def _counted(library: Library) -> dict[str, object]:
    types = sum(isinstance(part.element, TypeDecl) for part in library.parts)
    return {
        "name": library.name,
        "types": types,
        "blocks": len(library.parts) - types,
        "drives": [drive.prefix for drive in library.drives],
    }
