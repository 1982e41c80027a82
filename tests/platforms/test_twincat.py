"""The files of TwinCAT 3 as an independent reader sees them."""

import functools
import posixpath
import re
from collections import Counter
from collections.abc import Iterable
from pathlib import PurePosixPath

import pytest
from tests.platforms import tc_reader
from tests.platforms.stock import Canon, canon, extra, made

from driveblocks import __version__
from driveblocks.platforms.part import Part, Shelf
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.twincat.writer import write
from structured_text.language.fingerprint import fingerprint, stream
from structured_text.language.parser import parse

ID = re.compile(r"\{[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}\}")
FIXED = {
    "MB_Line8": "{49359740-5e48-5e40-8217-3f1ccf461db5}",
    "CHF_Drive": "{48b3a5c5-5f20-5463-b2db-d8bd40443cd6}",
    "CHF.plcproj": "{149df3a7-cbb4-504f-b33e-30a6534beb5d}",
}
"""Ids of some names. They never change: TwinCAT takes another id for another object."""


@functools.cache
def written() -> dict[str, str]:
    """Path below the folder of the platform -> text."""
    return write(made())


def objects() -> dict[str, tc_reader.Object]:
    """Every object by its path."""
    kinds = (".TcPOU", ".TcDUT", ".TcGVL")
    return {path: tc_reader.read(path, text) for path, text in written().items() if path.endswith(kinds)}


def tasks() -> dict[str, tc_reader.Task]:
    """Every task by its path."""
    return {path: tc_reader.task(text) for path, text in written().items() if path.endswith(".TcTTO")}


def projects() -> dict[str, tc_reader.Project]:
    """Every project by its path."""
    return {path: tc_reader.project(text) for path, text in written().items() if path.endswith(".plcproj")}


def place(part: Canon) -> str:
    """The folder of a part: an extra has one of its own, in that of its family."""
    prefixes = {folder: drive.prefix for folder, drive in made().drives.items()}
    more = extra(part.folder, part.name)
    if part.folder in prefixes:
        return "/".join(["families", prefixes[part.folder], *([more] if more else [])])
    return f"shared/{more or part.folder}"


def test_every_part_is_a_file_in_its_folder_and_under_its_name() -> None:
    for part in canon().values():
        path = f"{place(part)}/{part.name}.{'TcPOU' if part.body else 'TcDUT'}"
        assert tc_reader.read(path, written()[path]).name == part.name


def test_declarations_and_their_comments_are_the_canonical_ones() -> None:
    for part, one in parts():
        wanted = part.before if part.body else part.before.replace("END_STRUCT;", "END_STRUCT")
        assert one.declaration == f"{wanted}\n"


def test_bodies_are_the_canonical_ones_and_have_the_hash_of_the_head() -> None:
    for part, one in parts():
        assert one.body == part.body
        if part.body:
            stated = re.search(r"^   Body     ([0-9A-F]{8}),", one.declaration, re.M)
            assert stated is not None
            assert stated[1] == fingerprint(stream(one.body)) == fingerprint(stream(part.body))


def parts() -> list[tuple[Canon, tc_reader.Object]]:
    """Every part of the library with its file."""
    by_name = {one.name: one for one in objects().values()}
    return [(part, by_name[part.name]) for part in canon().values()]


def test_files_are_utf_8_with_a_mark_at_the_start_and_crlf() -> None:
    for path, text in written().items():
        if not path.endswith(".md"):
            data = text.encode("utf-8")
            assert data.startswith(b'\xef\xbb\xbf<?xml version="1.0" encoding="utf-8"?>\r\n'), path
            assert data.count(b"\xef\xbb\xbf") == 1, path
            assert data.count(b"\n") == data.count(b"\r\n") == data.count(b"\r"), path


def test_ids_are_unique_and_always_the_same() -> None:
    ids = [one.id for one in objects().values()]
    ids += [one.id for one in projects().values()]
    ids += [one.id for one in tasks().values()]
    assert all(ID.fullmatch(each) for each in ids)
    assert max(Counter(ids).values()) == 1
    assert {name: fixed(name) for name in FIXED} == FIXED


def fixed(name: str) -> str:
    """The id of an object or a project."""
    if name.endswith(".plcproj"):
        return projects()[f"families/{name}"].id
    return next(one.id for one in objects().values() if one.name == name)


def listed(path: str) -> list[str]:
    """The files of a project by their paths below the folder of the target."""
    folder = path.split("/", maxsplit=1)[0]
    compiled = (posixpath.normpath(f"{folder}/{each}") for each in slashed(projects()[path].compiled))
    return list(compiled)


def slashed(paths: Iterable[str]) -> list[str]:
    """Paths of Windows as ours."""
    assert not any("/" in each for each in paths)
    return [each.replace("\\", "/") for each in paths]


def owned(name: str) -> list[str]:
    """The files of a library project."""
    folder = "shared/" if name == "DriveBlocks" else f"families/{name}/"
    return [path for path in written() if path.startswith(folder) and ".Tc" in path]


def test_a_library_lists_every_file_of_its_folder_once_and_no_two_own_a_name() -> None:
    names = Counter[str]()
    for name in ("DriveBlocks", *(drive.prefix for drive in made().drives.values())):
        path = f"{'shared' if name == 'DriveBlocks' else 'families'}/{name}.plcproj"
        assert sorted(listed(path)) == sorted(owned(name))
        assert projects()[path].name == name
        assert f"<Title>{name}</Title>" in written()[path]
        assert not any(projects()[path].links)
        names.update(PurePosixPath(each).stem.upper() for each in listed(path))
    assert max(names.values()) == 1


def test_a_project_to_begin_with_has_its_own_files_and_links_what_a_first_motor_needs() -> None:
    more = ["yours/TC_Fast.TcPOU", "yours/TC_Com.TcGVL", "yours/TC_FastTask.TcTTO"]
    extras = re.compile("/(?:Line2|Line32|Frames|Parameters|Meter|Plant|Chinese)/")
    for drive in made().drives.values():
        path = f"yours/{drive.prefix}_Motor.plcproj"
        own = [f"yours/{drive.prefix}_Motor.TcPOU", f"yours/{drive.prefix}_Task.TcTTO", *more]
        needed = [each for each in (*owned("DriveBlocks"), *owned(drive.prefix)) if not extras.search(each)]
        assert listed(path)[: len(own)] == own
        assert sorted(listed(path)[len(own) :]) == sorted(needed)
        links = slashed(projects()[path].links)
        assert links[: len(own)] == [""] * len(own)
        assert [each.split("/", 1)[1] for each in listed(path)[len(own) :]] == links[len(own) :]


def test_nothing_of_the_user_lies_in_the_library() -> None:
    """An update replaces those folders."""
    for path, one in objects().items():
        own = one.name.startswith("TC_") and not one.name.startswith(("TC_Port", "TC_Line"))
        assert path.startswith("yours/") == (own or one.name.endswith("_Motor")), path
    assert all(path.startswith("yours/") for path in tasks())


def test_tasks_call_the_first_motor_and_in_front_of_it_the_terminal() -> None:
    fast = tasks()["yours/TC_FastTask.TcTTO"]
    assert (fast.name, fast.program, fast.us) == ("TC_FastTask", "TC_Fast", 1000)
    for drive in made().drives.values():
        one = tasks()[f"yours/{drive.prefix}_Task.TcTTO"]
        assert (one.name, one.program, one.us) == (f"{drive.prefix}_Task", f"{drive.prefix}_Motor", 10_000)
        assert one.priority > fast.priority
    assert len(tasks()) == 1 + len(made().drives)


def test_projects_name_every_folder_and_the_libraries_that_they_need() -> None:
    for path, one in projects().items():
        shown = [link or each for link, each in zip(slashed(one.links), slashed(one.compiled), strict=True)]
        parents = {str(parent) for each in shown for parent in PurePosixPath(each).parents} - {"."}
        assert set(slashed(one.folders)) == parents, path
        assert one.title == ("DriveBlocks", one.name, f"{__version__}.0")
        assert one.libraries == (("DriveBlocks",) if path.startswith("families") else ("Tc2_System", "Tc2_SerialCom"))


def test_what_the_format_cannot_say_is_refused_with_its_place() -> None:
    text = canon()["MB_Adu"].text.replace("An RTU", "An\fRTU").replace("OF BYTE;", "OF BYTE; (* ]]> *)")
    with pytest.raises(ExportError) as refusal:
        write(Shelf((Part("types", parse(text, "types/MB_Adu.st")),), {}, ()))
    assert [str(problem) for problem in refusal.value.problems] == [
        "types/MB_Adu.st:3:15: the character 000CH cannot be in a file of TwinCAT: leave it out",
        "types/MB_Adu.st:7:38: `]]>` ends the text in a file of TwinCAT: put a blank between the brackets",
    ]
