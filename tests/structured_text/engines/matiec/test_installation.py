"""matiec is found in each layout that editors and people make, and only where it can work."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from structured_text.engines.matiec.installation import (
    NAMES,
    Installation,
    Useless,
    find_installations,
    look_everywhere,
)

NAME = NAMES[0]


def binary(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n# {path}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


def library(folder: Path, headers: str = "C") -> Path:
    (folder / headers).mkdir(parents=True, exist_ok=True)
    (folder / "ieclib.txt").touch()
    (folder / headers / "iec_std_lib.h").touch()
    return folder


def look(**environment: str) -> list[Installation | Useless]:
    """Look, with nothing on PATH unless it is said."""
    return look_everywhere({"PATH": "", **environment})


@pytest.mark.parametrize(
    ("iec2c", "lib", "headers"),
    [
        ("", "lib", "C"),  # a folder of its own, Beremiz on Windows
        ("matiec", "matiec/lib", "C"),  # OpenPLC Editor 1 to 3, Beremiz
        ("editor/arduino/bin", "matiec/lib", "C"),  # the copy of OpenPLC Editor
        ("resources/bin", "resources/sources/MatIEC/lib", "."),  # OpenPLC Editor 4
        ("Contents/Resources/bin", "Contents/Resources/sources/MatIEC/lib", "."),  # the same on macOS
        ("utils/matiec_src", "utils/matiec_src/lib", "C"),  # OpenPLC Runtime 3
        ("webserver", "webserver/lib", "."),  # its copy
        ("bin", "share/matiec/lib", "C"),  # a prefix
        ("bin", "lib/matiec", "C"),
        ("bin", "lib", "C"),
    ],
)
def test_layouts(tmp_path: Path, iec2c: str, lib: str, headers: str) -> None:
    program = binary(tmp_path / iec2c / NAME)
    folder = library(tmp_path / lib, headers)
    assert look(MATIEC_HOME=str(tmp_path)) == [Installation(program, folder, folder / headers)]


def test_home_may_be_the_program_and_several(tmp_path: Path) -> None:
    programs = [binary(tmp_path / name / NAME) for name in "ab"]
    for name in "ab":
        library(tmp_path / name / "lib")
    homes = os.pathsep.join((str(programs[0]), str(tmp_path / "b"), str(tmp_path / "nothing")))
    assert [each.iec2c for each in find_installations({"MATIEC_HOME": homes, "PATH": ""})] == programs


def test_every_folder_of_path_and_links(tmp_path: Path) -> None:
    """Links on PATH, as `/usr/local/bin` has them: the library is where the link leads."""
    for name in "abc":
        binary(tmp_path / name / NAME)
        library(tmp_path / name / "lib")
        (tmp_path / f"bin-{name}").mkdir()
        (tmp_path / f"bin-{name}" / NAME).symlink_to(tmp_path / name / NAME)
    (tmp_path / "bin-c" / "again").mkdir()
    (tmp_path / "bin-c" / "again" / NAME).symlink_to(tmp_path / "a" / NAME)
    path = os.pathsep.join(str(tmp_path / each) for each in ("bin-a", "bin-b", "empty", "bin-c", "bin-c/again"))
    found = look(PATH=path)
    assert [each.iec2c for each in found] == [tmp_path / f"bin-{name}" / NAME for name in "abc"]
    assert [each.library for each in found if isinstance(each, Installation)] == [tmp_path / f"{n}/lib" for n in "abc"]


def test_order_is_home_then_path(tmp_path: Path) -> None:
    folders = [tmp_path / "home", tmp_path / "path"]
    for folder in reversed(folders):
        binary(folder / NAME)
        library(folder / "lib")
    found = look_everywhere({"MATIEC_HOME": str(folders[0]), "PATH": str(folders[1])})
    assert [each.iec2c.parent for each in found] == folders


@pytest.mark.parametrize("name", ["OpenPLC_Editor/matiec", "Beremiz/matiec", "beremiz_workspace/matiec", "matiec", "."])
def test_a_folder_that_nobody_named_is_left_alone(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither below the home folder nor where the command runs: what lies there may be anybody's."""
    binary(tmp_path / name / NAME)
    library(tmp_path / name / "lib")
    monkeypatch.chdir(tmp_path)
    nowhere = {"PATH": os.pathsep, "MATIEC_HOME": os.pathsep}
    assert look_everywhere({**nowhere, "HOME": str(tmp_path), "USERPROFILE": str(tmp_path)}) == []


def test_without_library_or_headers_it_is_useless_and_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("structured_text.engines.matiec.installation._SYSTEM_LIBRARIES", ())
    program = binary(tmp_path / NAME)
    (bare,) = look(PATH=str(tmp_path))
    assert isinstance(bare, Useless)
    assert "ieclib.txt" in bare.why
    library(tmp_path / "lib")
    (tmp_path / "lib" / "C" / "iec_std_lib.h").unlink()
    (headless,) = look(PATH=str(tmp_path))
    assert headless == Useless(program, f"the C headers (iec_std_lib.h) are not in {tmp_path / 'lib'}")


def test_file_that_cannot_be_executed_is_passed_over(tmp_path: Path) -> None:
    binary(tmp_path / NAME).chmod(0o644)
    library(tmp_path / "lib")
    assert look(PATH=str(tmp_path)) == []


def test_digest_follows_the_content(tmp_path: Path) -> None:
    program = binary(tmp_path / NAME)
    library(tmp_path / "lib")
    (found,) = [each for each in find_installations({"MATIEC_HOME": str(tmp_path)}) if each.iec2c == program]
    digests = [found.digest]
    for change in (program, tmp_path / "lib" / "ieclib.txt", tmp_path / "lib" / "C" / "iec_std_lib.h"):
        change.write_text("changed\n", encoding="utf-8")
        digests.append(replace(found).digest)
    assert len(set(digests)) == 4


def test_a_home_without_iec2c_is_reported(tmp_path: Path) -> None:
    """Whoever set it wants to know that it is wrong, even if PATH has another."""
    other = binary(tmp_path / "path" / NAME)
    library(tmp_path / "path" / "lib")
    found = look(MATIEC_HOME=str(tmp_path / "gone"), PATH=str(other.parent))
    assert found == [
        Useless(tmp_path / "gone", "MATIEC_HOME names it, and there is no iec2c in it"),
        Installation(other, tmp_path / "path" / "lib", tmp_path / "path" / "lib" / "C"),
    ]
