"""Reads files and projects of TwinCAT 3. It shares nothing with their writer, and refuses what it does not know."""

import xml.etree.ElementTree as Xml
from dataclasses import dataclass
from pathlib import PurePosixPath

BUILD = "{http://schemas.microsoft.com/developer/msbuild/2003}"
KINDS = {"TcPOU": "POU", "TcDUT": "DUT", "TcGVL": "GVL"}
CHILDREN = {"POU": ["Declaration", "Implementation"], "DUT": ["Declaration"], "GVL": ["Declaration"]}


@dataclass(frozen=True)
class Object:
    """What a file holds: line ends are LF here."""

    name: str
    id: str
    declaration: str
    body: str


@dataclass(frozen=True)
class Project:
    """What a project says."""

    name: str
    id: str
    compiled: tuple[str, ...]
    folders: tuple[str, ...]
    libraries: tuple[str, ...]
    links: tuple[str, ...]
    """Of what is compiled, where it is shown, for what lies in another folder."""
    title: tuple[str, ...]
    """Company, title and version."""


@dataclass(frozen=True)
class Task:
    """A task: what it calls, how often."""

    name: str
    id: str
    us: int
    priority: int
    program: str


def root(text: str) -> Xml.Element:
    """The top of a file. Raises xml.etree.ElementTree.ParseError for what is no XML."""
    return Xml.fromstring(text.encode("utf-8"))  # noqa: S314  (the suite's own files)


def read(path: str, text: str) -> Object:
    """The object of a file. Raises AssertionError for anything that TwinCAT would stumble over."""
    top = root(text)
    assert (top.tag, top.get("Version")) == ("TcPlcObject", "1.1.0.1"), path
    assert len(top) == 1, path
    one, kind = top[0], KINDS[PurePosixPath(path).suffix[1:]]
    assert one.tag == kind, path
    assert [child.tag for child in one] == CHILDREN[kind], path
    if kind == "POU":
        assert one.get("SpecialFunc") == "None", path
        assert [child.tag for child in one[1]] == ["ST"], path
    body = one[1][0].text if kind == "POU" else ""
    return Object(one.attrib["Name"], one.attrib["Id"], one[0].text or "", body or "")


def task(text: str) -> Task:
    """A task. Raises AssertionError for what is none."""
    top = root(text)
    assert (top.tag, top.get("Version"), len(top)) == ("TcPlcObject", "1.1.0.1", 1)
    tags = ["CycleTime", "Priority", "PouCall", "TaskFBGuid", "Fb_init", "Fb_exit", "CycleUpdate", "PostCycleUpdate"]
    assert [child.tag for child in top[0]] == tags
    assert len({child.text for child in top[0][3:]}) == len(tags) - 3
    us, priority = (int(top[0].findtext(tag) or "") for tag in tags[:2])
    return Task(top[0].attrib["Name"], top[0].attrib["Id"], us, priority, top[0].findtext("PouCall/Name") or "")


def project(text: str) -> Project:
    """A project. Raises AssertionError for what is none."""
    top = root(text)
    assert top.tag == f"{BUILD}Project"
    assert all(one.findtext(f"{BUILD}SubType") == "Code" for one in top.iter(f"{BUILD}Compile"))

    def included(tag: str) -> tuple[str, ...]:
        return tuple(one.attrib["Include"] for one in top.iter(f"{BUILD}{tag}"))

    properties = top.find(f"{BUILD}PropertyGroup")
    assert properties is not None
    name, id_ = properties.findtext(f"{BUILD}Name"), properties.findtext(f"{BUILD}ProjectGuid")
    assert name
    assert id_
    links = tuple(one.findtext(f"{BUILD}Link") or "" for one in top.iter(f"{BUILD}Compile"))
    title = tuple(properties.findtext(f"{BUILD}{tag}") or "" for tag in ("Company", "Title", "ProjectVersion"))
    compiled, folders, libraries = (included(tag) for tag in ("Compile", "Folder", "PlaceholderReference"))
    return Project(name, id_, compiled, folders, libraries, links, title)
