"""TwinCAT 3: a file per type, block and program, as "Add existing item" takes it, and projects of them.

What an update replaces is in `shared` and `families`, a library project each; what is the user's is in `yours`, with
projects that link the files.

The form is that of files in public projects: TcPlcObject 1.1.0.1, which the oldest builds of them have, UTF-8 with a
byte order mark, CRLF. Ids are made of names, so that a rebuild is no diff.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from uuid import UUID, uuid5

from driveblocks import __version__
from driveblocks.platforms import PLATFORMS
from driveblocks.platforms.element import escaped
from driveblocks.platforms.page import page
from driveblocks.platforms.part import SHARED, YOURS, Own, Part, Shelf, Volume
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.wide import widened
from driveblocks.render.environment import render
from driveblocks.render.motor import SCAN_MS
from structured_text.language.parser import parse
from structured_text.language.problems import Problem
from structured_text.language.tree import TypeDecl

PLATFORM = "twincat"
IDS = UUID("6b1f2c0e-2d0f-5a53-9a39-1f0d6c7c6a11")
"""The namespace of all ids: chosen once, and never to be changed."""
PORT = "port"
"""Folder of the serial port in what is shared."""
FAST, FAST_US, LINE_US = "TC_Fast", 1000, 1000 * SCAN_MS
"""The program that serves the terminal, its interval and that of the first motor, us."""
GLOBALS = "TC_Com"
BECKHOFF = ("Tc2_System", "Tc2_SerialCom")
"""What the port uses of Beckhoff's; the blocks use none."""
MARK = "\ufeff"
_IMPLICIT = (
    "Application",
    "TypeSystem",
    "Implicit_Task_Info",
    "Implicit_KindOfTask",
    "Implicit_Jitter_Distribution",
    "LibraryReferences",
)
"""Ids of what every project has without showing it, as public projects name them."""
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


@dataclass(frozen=True)
class Project:
    """A library project: the folder where it lies, its name and its files; what a first motor needs of them."""

    layer: str
    name: str
    items: list[Item]
    needed: list[Item]


def write(shelf: Shelf) -> dict[str, str]:
    """Every file. Raises ExportError for texts that the format cannot hold."""
    shelf = widened(shelf)
    volumes, port, fast = tuple(shelf.volumes()), shelf.port(PLATFORM), _fast()
    motors = {drive.prefix: shelf.motor(PLATFORM, drive) for drive in shelf.drives.values()}
    _refuse((*(part for one in (*volumes, *port) for part in one.parts), fast, *motors.values()))
    shared = _library("shared", SHARED, [one for one in (*volumes, *port) if not one.drive])
    families = [_library("families", each, [one for one in volumes if one.base == each]) for each in motors]
    made = {f"{one.layer}/{item.path}": item.text for one in (shared, *families) for item in one.items}
    made[f"shared/{SHARED}.plcproj"] = _project(SHARED, shared.items, libraries=BECKHOFF)
    served = _terminal()
    made |= {f"{YOURS}/{item.path}": item.text for item in served} if motors else {}
    for family in families:
        made[f"families/{family.name}.plcproj"] = _project(family.name, family.items, libraries=(SHARED,))
        name = f"{family.name}_Motor"
        program = [_item(motors[family.name], ""), _task(f"{family.name}_Task", name, LINE_US, 20)]
        made |= {f"{YOURS}/{item.path}": item.text for item in program}
        made[f"{YOURS}/{name}.plcproj"] = _project(name, [*program, *served], [shared, family], BECKHOFF)
    return made | page(PLATFORM, shelf, (*volumes, *port))


def own(shelf: Shelf, programs: Own) -> dict[str, str]:
    """A project for each program of a user's own, with a terminal for each line; a ladder is drawn in TwinCAT.

    Raises ExportError.
    """
    volumes, port = tuple(shelf.volumes()), shelf.port(PLATFORM)
    _refuse(programs.texts)
    linked = [_library("shared", SHARED, [one for one in (*volumes, *port) if not one.drive])]
    linked += [
        _library("families", each.prefix, [one for one in volumes if one.base == each.prefix])
        for each in shelf.drives.values()
    ]
    linked = [replace(each, needed=each.items) for each in linked]
    fast = [item for line in programs.lines for item in _terminal(f"_{line}")]
    made = {f"{YOURS}/{item.path}": item.text for item in fast}
    for one in programs.texts:
        program = [_item(one, ""), _task(f"{one.name}_Task", one.name, 1000 * programs.scan_ms, 20)]
        made |= {f"{YOURS}/{item.path}": item.text for item in program}
        made[f"{YOURS}/{one.name}.plcproj"] = _project(one.name, [*program, *fast], linked, BECKHOFF)
    return made


def _terminal(mark: str = "") -> list[Item]:
    """What serves one terminal; `mark` tells it from others."""
    fast = f"{FAST}{mark}"
    return [_item(_fast(mark), ""), _globals(mark), _task(f"TC_FastTask{mark}", fast, FAST_US, 10)]


def _library(layer: str, name: str, volumes: Sequence[Volume]) -> Project:
    """Of what is shared, or of a family; an extra has a folder of its own."""
    items = [(one.extra, _item(part, _folder(one, part))) for one in volumes for part in one.parts]
    return Project(layer, name, [item for _, item in items], [item for extra, item in items if not extra])


def _folder(one: Volume, part: Part) -> str:
    inner = PORT if part.folder == PLATFORM else part.folder
    return f"{one.base}/{one.extra}".rstrip("/") if one.drive else one.extra or inner


def _fast(mark: str = "") -> Part:
    """The program that serves a terminal."""
    text = _marked(render(f"{PLATFORM}/{FAST}.st.j2", where=PLATFORMS[PLATFORM].where), mark)
    return Part(PLATFORM, parse(text, f"{PLATFORM}/{FAST}{mark}.st"))


def _globals(mark: str = "") -> Item:
    """What two tasks share."""
    text, name = _marked(render(f"twincat/{GLOBALS}.gvl.j2").rstrip("\n"), mark), f"{GLOBALS}{mark}"
    inner = f'  <GVL Name="{name}" Id="{_id(name)}">\n{_declared(text)}  </GVL>\n'
    return Item("", name, "TcGVL", _object(inner))


def _marked(text: str, mark: str) -> str:
    """With the names of one terminal."""
    return re.sub(rf"\b({FAST}|{GLOBALS})\b", rf"\1{mark}", text)


def _task(name: str, program: str, interval_us: int, priority: int) -> Item:
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
    return _file(f'<TcPlcObject Version="1.1.0.1" ProductVersion="3.1.4024.0">\n{inner}</TcPlcObject>\n')


def _file(text: str) -> str:
    return MARK + f'<?xml version="1.0" encoding="utf-8"?>\n{text}'.replace("\n", "\r\n")


def _id(name: str) -> str:
    return f"{{{uuid5(IDS, name)}}}"


def _project(name: str, items: list[Item], linked: Sequence[Project] = (), libraries: Sequence[str] = ()) -> str:
    """A project of its own files, and of files of library projects that it links."""
    links = [(one.layer, item) for one in linked for item in one.needed]
    folders = dict.fromkeys(item.folder for item in (*items, *(item for _, item in links)) if item.folder)
    above = dict.fromkeys(folder.rpartition("/")[0] for folder in folders)
    lines = [
        '<Project DefaultTargets="Build" xmlns="http://schemas.microsoft.com/developer/msbuild/2003">',
        "  <PropertyGroup>",
        "    <FileVersion>1.0.0.0</FileVersion>",
        "    <SchemaVersion>2.0</SchemaVersion>",
        f"    <ProjectGuid>{_id(f'{name}.plcproj')}</ProjectGuid>",
        "    <SubObjectsSortedByName>True</SubObjectsSortedByName>",
        f"    <Name>{name}</Name>",
        "    <ProgramVersion>3.1.4024.0</ProgramVersion>",
        *(f"    <{each}>{_id(f'{name}.{each}')}</{each}>" for each in _IMPLICIT),
        "    <Company>DriveBlocks</Company>",
        "    <Released>false</Released>",
        f"    <Title>{name}</Title>",
        f"    <ProjectVersion>{__version__}.0</ProjectVersion>",
        "  </PropertyGroup>",
        "  <ItemGroup>",
        *(_compiled(item) for item in items),
        *(_linked(layer, item) for layer, item in links),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(f'    <Folder Include="{escaped(_windows(folder))}" />' for folder in {**above, **folders} if folder),
        "  </ItemGroup>",
        "  <ItemGroup>",
        *(_reference(each) for each in libraries),
        "  </ItemGroup>",
        "</Project>",
    ]
    return _file("\n".join(lines) + "\n")


def _windows(path: str) -> str:
    return path.replace("/", "\\")


def _compiled(item: Item) -> str:
    return f'    <Compile Include="{escaped(_windows(item.path))}">\n      <SubType>Code</SubType>\n    </Compile>'


def _linked(layer: str, item: Item) -> str:
    """A file of a library project, which stays where it is."""
    where, path = (escaped(_windows(each)) for each in (f"../{layer}/{item.path}", item.path))
    inner = f"      <SubType>Code</SubType>\n      <Link>{path}</Link>\n"
    return f'    <Compile Include="{where}">\n{inner}    </Compile>'


def _reference(name: str) -> str:
    maker = "DriveBlocks" if name == SHARED else "Beckhoff Automation GmbH"
    return (
        f'    <PlaceholderReference Include="{name}">\n'
        f"      <DefaultResolution>{name}, * ({maker})</DefaultResolution>\n"
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
