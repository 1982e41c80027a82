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
    return Project(name, id_, included("Compile"), included("Folder"), included("PlaceholderReference"))
