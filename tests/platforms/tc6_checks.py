"""What must be true of every file in a TC6 dialect; each check raises AssertionError where it is not."""

import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from itertools import combinations, product
from pathlib import Path

from lxml import etree
from tests.platforms.stock import volumes
from tests.platforms.tc6_form import Unit, scanned, single
from tests.platforms.tc6_reader import File, Node

from driveblocks.platforms.part import Shelf
from driveblocks.platforms.wide import widened
from driveblocks.platforms.writers import writer
from driveblocks.render.channels import channels
from structured_text.language.fingerprint import fingerprint, stream

DIALECTS = {
    "beremiz": ("http://www.plcopen.org/xml/tc6_0201", "p"),
    "codesys": ("http://www.plcopen.org/xml/tc6_0200", "xhtml"),
}
_CALL = re.compile(r"^  (\w+)\((.*?)\);", re.DOTALL | re.MULTILINE)
_WIRED = re.compile(r"(\w+) := ([^,]+)")
ROOM = 2
"""Pixels between any two things in a ladder."""
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
_ASSIGNED = re.compile(r"^  ([\w.]+) := (.*?);", re.MULTILINE | re.DOTALL)
_NAME = re.compile(r"\b(?!AND\b|OR\b|NOT\b)[A-Za-z][\w.]*")
_DONE = re.compile(r"^  ([\w.]+)(?:\(| :=)", re.MULTILINE)


@dataclass(frozen=True)
class Made:
    """A file of a library, and the texts of what it must hold: the parts, then programs of its own."""

    target: str
    library: str
    file: File
    texts: tuple[str, ...]
    prefixes: tuple[str, ...]

    @cached_property
    def pairs(self) -> list[tuple[Unit, Unit]]:
        """What was read, beside what was meant, in the order of the file."""
        meant = sorted(map(scanned, self.texts), key=lambda each: each.kind != "TYPE")
        assert len(self.file.units) == len(meant)
        return list(zip(self.file.units, meant, strict=True))


def made(shelf: Shelf, target: str) -> Iterator[Made]:
    """Every file of a platform, as written from a shelf: the library, then what is a user's."""
    files = {name: text for name, text in writer(target)(shelf).items() if name.endswith(".xml")}
    meant = list(_project(shelf) if target == "beremiz" else _files(shelf))
    assert sorted(files) == sorted(f"{name}.xml" for name, _, _ in meant)
    for name, texts, prefixes in meant:
        yield Made(target, name, File(files[f"{name}.xml"], *DIALECTS[target]), texts, prefixes)


_Meant = tuple[str, tuple[str, ...], tuple[str, ...]]
"""A file: its name, the texts that it holds, and the prefix of the first motor that it runs."""


def _library(shelf: Shelf, platform: str, base: str) -> dict[str, list[str]]:
    rows = [(part.folder, part.name, part.text) for part in shelf.parts]
    port = [(part.folder, part.name, part.text) for one in shelf.port(platform) for part in one.parts]
    return volumes(shelf, rows) | volumes(replace(shelf, drives={}), port, base)


def _drawn(shelf: Shelf, platform: str) -> Iterator[tuple[str, str, str]]:
    for drive in shelf.drives.values():
        text = shelf.motor(platform, drive).text
        yield drive.prefix, text, text.replace(f"{drive.prefix}_Motor", f"{drive.prefix}_Ladder")


def _files(shelf: Shelf) -> Iterator[_Meant]:
    """Those of CODESYS."""
    for name, texts in _library(widened(shelf), "codesys", "CD_Port").items():
        yield name, tuple(texts), ()
    for prefix, text, drawn in _drawn(shelf, "codesys"):
        yield f"yours/{prefix}_Motor", (text,), ()
        yield f"yours/{prefix}_Ladder", (drawn,), ()
    for prefix, part in shelf.masters("codesys", channels).items():
        yield f"yours/{prefix}_Master", (part.text,), ()


def _project(shelf: Shelf) -> Iterator[_Meant]:
    """That of Beremiz: what is shared, the port, the families, and the motors, of which the first runs."""
    found = _library(shelf, "linux", "LX_Port")
    families = [text for name, texts in found.items() if name.startswith("families") for text in texts]
    shared = [text for name, texts in found.items() if name.startswith("shared") for text in texts]
    own = [text for _, *both in _drawn(shelf, "linux") for text in both]
    yield "DriveBlocks/plc", (*shared, *families, *own), tuple(drive.prefix for drive in shelf.drives.values())[:1]


def assert_names(one: Made) -> None:
    """Every type and unit is there once, in the order of its use."""
    assert one.file.named() == [meant.name for _, meant in one.pairs]
    assert max(Counter(name.upper() for name in one.file.named()).values()) == 1


def assert_declarations(one: Made) -> None:
    """Kinds, sections, types and initial values are those of the canonical text."""
    for read, meant in one.pairs:
        assert (read.kind, read.name, read.returns) == (meant.kind, meant.name, meant.returns)
        assert [replace(row, comment="") for row in read.rows] == [replace(row, comment="") for row in meant.rows]


def assert_comments(one: Made) -> None:
    """Each declaration has its comment, and each unit its head."""
    for read, meant in one.pairs:
        assert [(row.name, row.comment) for row in read.rows] == [(row.name, row.comment) for row in meant.rows]
        assert read.head == meant.head


def assert_bodies(one: Made) -> None:
    """Each body is untouched, and its tokens have the hash in its head."""
    for read, meant in one.pairs:
        if not meant.name.endswith("_Ladder"):
            assert read.body == meant.body, read.name
        if hashed := re.search(r" Body ([0-9A-F]{8}),", read.head):
            assert _fingerprint(read.body) == hashed[1], read.name


_fingerprint = lru_cache(1024)(lambda body: fingerprint(stream(body)))


@cache
def _schema() -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(Path(__file__).with_name("tc6_xml_v201.xsd")))


def assert_schema(one: Made) -> None:
    """The file is valid by the schema of TC6 2.01; another dialect with its namespace swapped."""
    neutral, own = DIALECTS["beremiz"][0], DIALECTS[one.target][0]
    text = one.file.text.replace(own, neutral) if own != neutral else one.file.text
    _schema().assertValid(etree.fromstring(text.encode("utf-8")))


def assert_marks(one: Made) -> None:
    """Each text of the neutral form is a CDATA section in its tag, as Beremiz's loader looks for it."""
    if one.target == "beremiz":
        sections, text = (
            len(re.findall(r"<xhtml:p><!\[CDATA\[.*?\]\]></xhtml:p>", one.file.text, re.DOTALL)),
            one.file.text,
        )
        assert [text.count(mark) for mark in ("<![CDATA[", "]]>", "<xhtml:p>", "</xhtml:p>")] == [sections] * 4
    assert "\r" not in one.file.text
    assert one.file.text.startswith('<?xml version="1.0" encoding="utf-8"?>\n<project ')


def assert_plain(one: Made) -> None:
    """CODESYS's text of a declaration is the canonical one, and says what the elements say."""
    if one.target != "codesys":
        return
    texts = {scanned(text).name: text for text in one.texts}
    for node, unit in zip(one.file.all("types/pous/pou"), _pous(one), strict=True):
        shown = one.file.data("interfaceasplaintext", node)
        assert len(shown) == 1
        text = one.file.written(shown[0])
        assert texts[unit.name].startswith(text), unit.name
        assert replace(scanned(text), body="") == replace(unit, body="")


def _pous(one: Made) -> list[Unit]:
    return [unit for unit in one.file.units if unit.kind != "TYPE"]


def assert_folders(one: Made) -> None:
    """CODESYS's tree has every object once, with the identity that the object itself has."""
    if one.target == "codesys":
        (tree,) = one.file.data("projectstructure", one.file.root)
        shown = {each.get("Name"): each.get("ObjectId") for each in one.file.all(".//Object", tree)}
        nodes = one.file.all("types/dataTypes/dataType") + one.file.all("types/pous/pou")
        own = {node.get("name"): one.file.data("objectid", node)[0].text for node in nodes}
        assert shown == own
        assert len(set(own.values())) == len(nodes) == len(one.file.all(".//Object", tree))


def assert_tasks(one: Made) -> None:
    """A project to begin with runs its first motor in one task; a library runs nothing."""
    found = one.file.all("instances/configurations/configuration/resource/task")
    assert len(found) == len(one.prefixes)
    for task in found:
        assert task.get("interval") == "T#10ms"
        runs = [each.get("typeName") for each in one.file.all("pouInstance", task)]
        assert runs == [f"{prefix}_Motor" for prefix in one.prefixes]


def drawings(one: Made) -> list[tuple[Node, str]]:
    """Each ladder of a file, and the body that it means."""
    nodes = {node.get("name"): node for node in one.file.all("types/pous/pou")}
    return [(nodes[unit.name], unit.body) for _, unit in one.pairs if unit.name.endswith("_Ladder")]


def assert_ladders(one: Made) -> None:
    """A ladder calls the same blocks with the same values as the program in text, and its wires meet its pins."""
    for node, body in drawings(one):
        drawn = one.file.ladder(node)
        assert drawn.calls == {
            name: dict(_WIRED.findall(_COMMENT.sub("", given))) for name, given in _CALL.findall(body)
        }
        false = "FALSE" if one.target == "beremiz" else "resetTRUE"
        coils = {name: value.replace("FALSE", false) for name, value in _ASSIGNED.findall(body)}
        if one.target == "beremiz":  # which gives blocks and variables their turn, and all coils the last
            assert not one.file.all("body/LD/coil", node)
        assert {name: truth(value) for name, value in drawn.coils.items()} == {k: truth(v) for k, v in coils.items()}
        assert [drawn.order[number] for number in sorted(drawn.order)] == _DONE.findall(body)
        assert drawn.loose == []
        assert drawn.remarks == (
            [single(each[2:-2]) for each in _COMMENT.findall(body)] if one.target == "beremiz" else []
        )


def truth(value: str) -> str | tuple[tuple[str, ...], list[bool]]:
    """What contacts come to for each state of theirs; a single word is itself."""
    if " " not in value:
        return value
    names = tuple(sorted(set(_NAME.findall(value))))
    said = _NAME.sub(lambda found: f"v[{names.index(found[0])}]", " ".join(value.split()))
    said = re.sub(r"\b(AND|OR|NOT)\b", lambda found: found[0].lower(), said)
    return names, [bool(eval(said, {"v": v})) for v in product((False, True), repeat=len(names))]  # noqa: S307 - made above


def assert_room(one: Made) -> None:
    """No two things of a ladder touch: boxes, contacts and coils with the names above them, rails."""
    for node, _ in drawings(one) if one.target == "beremiz" else ():
        boxes = one.file.boxes(node)
        assert len(boxes) > 20
        close = [(a.what, b.what) for a, b in combinations(boxes, 2) if a.near(b, ROOM)]
        assert not close


def assert_libraries(one: Made) -> None:
    """A file of CODESYS names the library that its serial port needs, and no other does."""
    if one.target == "codesys":
        named = [each.get("Name") for node in one.file.data("libraries", one.file.root) for each in node]
        needs = any("COM.Open" in text for text in one.texts)
        assert named == (["#CAA SerialCom"] if needs else [])


CHECKS: tuple[Callable[[Made], None], ...] = (
    assert_names, assert_declarations, assert_comments, assert_bodies, assert_schema, assert_marks, assert_plain,
    assert_folders, assert_libraries, assert_tasks, assert_ladders, assert_room,
)  # fmt: skip
