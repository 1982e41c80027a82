"""TwinCAT 3: a file per type, block and program, as "Add existing item" takes it, and projects of them.

What an update replaces is in `library`; what is the user's is in `motor`, with projects that link the files.

The form is that of files in public projects: TcPlcObject 1.1.0.1, which the oldest builds of them have, UTF-8 with a
byte order mark, CRLF. Ids are made of names, so that a rebuild is no diff.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from uuid import UUID, uuid5

from driveblocks import __version__
from driveblocks.export.element import escaped
from driveblocks.export.part import WHOLE, Library, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.wide import wide
from driveblocks.render.environment import render
from driveblocks.render.library import PLATFORMS
from driveblocks.render.motor import SCAN_MS
from structured_text.language.parser import parse
from structured_text.language.problems import Problem
from structured_text.language.tree import TypeDecl

TARGET = "twincat"
IDS = UUID("6b1f2c0e-2d0f-5a53-9a39-1f0d6c7c6a11")
"""The namespace of all ids: chosen once, and never to be changed."""
LIBRARY, MOTOR = "library", "motor"
"""Folders of what an update replaces, and of what is the user's."""
PORT = "port"
"""Folder of the adapter in the library."""
FAST, FAST_US, LINE_US = "TC_Fast", 1000, 1000 * SCAN_MS
"""The program that serves the terminal, its interval and that of the first motor, us."""
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
        """Path below the folder of its project."""
        return f"{self.folder}/{self.name}.{self.ending}" if self.folder else f"{self.name}.{self.ending}"


def files(shelf: Shelf) -> dict[str, str]:
    """Every file of the target. Raises ExportError for texts that the format cannot hold."""
    port, fast = shelf.adapter(TARGET), _fast()
    motors = {drive.prefix: shelf.motor(TARGET, drive) for drive in shelf.drives.values()}
    texts = wide(shelf)
    _refuse((*shelf.parts, *texts, *port, fast, *motors.values()))
    blocks = {part.name: _item(part, part.folder) for part in (*shelf.parts, *texts)}
    adapter = [_item(part, PORT) for part in port]
    shared = [_item(fast, ""), _globals(), _task("TC_FastTask", FAST, FAST_US, 10)]
    made = {f"{LIBRARY}/{item.path}": item.text for item in (*blocks.values(), *adapter)}
    made |= {f"{MOTOR}/{item.path}": item.text for item in shared} if motors else {}
    for library in shelf.libraries():
        parts = (*library.parts, *library.own(texts))
        items = [*(blocks[part.name] for part in parts), *adapter]
        made[f"{LIBRARY}/{library.name}.plcproj"] = _project(library.name, items)
        for drive in library.drives if library.name != WHOLE else ():
            name = f"{drive.prefix}_Motor"
            own = [_item(motors[drive.prefix], ""), _task(f"{drive.prefix}_Task", name, LINE_US, 20)]
            made |= {f"{MOTOR}/{item.path}": item.text for item in own}
            made[f"{MOTOR}/{name}.plcproj"] = _project(name, [*own, *shared], items)
    made["README.md"] = _page(shelf, adapter, len(shared) + 2)
    return {f"{TARGET}/{path}": text for path, text in made.items()}


def _fast() -> Part:
    """The program that serves the terminal."""
    _, where = PLATFORMS[TARGET]
    return Part(TARGET, parse(render(f"twincat/{FAST}.st.j2", where=where), f"{TARGET}/{FAST}.st"))


def _globals() -> Item:
    """What two tasks share."""
    text = render(f"twincat/{GLOBALS}.gvl.j2").rstrip("\n")
    inner = f'  <GVL Name="{GLOBALS}" Id="{_id(GLOBALS)}">\n{_declared(text)}  </GVL>\n'
    return Item("", GLOBALS, "TcGVL", _object(inner))


def _task(name: str, program: str, interval_us: int, priority: int) -> Item:
    """A task that calls a program."""
    ids = ("TaskFBGuid", "Fb_init", "Fb_exit", "CycleUpdate", "PostCycleUpdate")
    inner = [
        f'  <Task Name="{name}" Id="{_id(name)}">',
        f"    <CycleTime>{interval_us}</CycleTime>",
        f"    <Priority>{priority}</Priority>",
        f"    <PouCall>\n      <Name>{program}</Name>\n    </PouCall>",
        *(f"    <{each}>{_id(f'{name}.{each}')}</{each}>" for each in ids),
        "  </Task>",
    ]
    return Item("", name, "TcTTO", _object("\n".join(inner) + "\n"))


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


def _project(name: str, items: list[Item], linked: Sequence[Item] = ()) -> str:
    """A project of its own files, and of files of the library that it links."""
    folders = dict.fromkeys(item.folder for item in (*items, *linked) if item.folder)
    lines = [
        '<Project DefaultTargets="Build" xmlns="http://schemas.microsoft.com/developer/msbuild/2003">',
        "  <PropertyGroup>",
        "    <FileVersion>1.0.0.0</FileVersion>",
        "    <SchemaVersion>2.0</SchemaVersion>",
        f"    <ProjectGuid>{_id(f'{name}.plcproj')}</ProjectGuid>",
        "    <SubObjectsSortedByName>True</SubObjectsSortedByName>",
        f"    <Name>{name}</Name>",
        "    <ProgramVersion>3.1.4024.0</ProgramVersion>",
        "    <Company>DriveBlocks</Company>",
        "    <Released>false</Released>",
        f"    <Title>{name}</Title>",
        f"    <ProjectVersion>{__version__}.0</ProjectVersion>",
        "  </PropertyGroup>",
        "  <ItemGroup>",
        *(_compiled(item) for item in items),
        *(_linked(item) for item in linked),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(f'    <Folder Include="{escaped(folder)}" />' for folder in folders),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(_reference(name) for name in LIBRARIES),
        "  </ItemGroup>",
        "</Project>",
    ]
    return _file("\n".join(lines) + "\n")


def _compiled(item: Item) -> str:
    path = item.path.replace("/", "\\")
    return f'    <Compile Include="{escaped(path)}">\n      <SubType>Code</SubType>\n    </Compile>'


def _linked(item: Item) -> str:
    """A file of the library, which stays where it is."""
    path = item.path.replace("/", "\\")
    where = escaped(f"..\\{LIBRARY}\\{path}")
    inner = f"      <SubType>Code</SubType>\n      <Link>{escaped(path)}</Link>\n"
    return f'    <Compile Include="{where}">\n{inner}    </Compile>'


def _reference(name: str) -> str:
    return (
        f'    <PlaceholderReference Include="{name}">\n'
        f"      <DefaultResolution>{name}, * (Beckhoff Automation GmbH)</DefaultResolution>\n"
        f"      <Namespace>{name}</Namespace>\n"
        "    </PlaceholderReference>"
    )


def _refuse(parts: Iterable[Part]) -> None:
    """Raise ExportError with every place of texts that a CDATA section cannot hold."""
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
    return f"the character {ord(found):04X}H cannot be in a file of TwinCAT: leave it out"


def _page(shelf: Shelf, adapter: list[Item], own: int) -> str:
    texts = wide(shelf)
    libraries = [_counted(library, library.own(texts)) for library in shelf.libraries()]
    return render("twincat/README.md.j2", libraries=libraries, adapter=len(adapter), own=own, wide=bool(texts))


def _counted(library: Library, texts: Sequence[Part]) -> dict[str, object]:
    types = sum(isinstance(part.element, TypeDecl) for part in library.parts)
    return {
        "name": library.name,
        "types": types,
        "blocks": len(library.parts) - types + len(texts),
        "drives": [drive.prefix for drive in library.drives],
    }
