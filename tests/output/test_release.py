"""What a user downloads: an archive per platform, whole, and the same bytes whenever and wherever it is made."""

import posixpath
import re
import shutil
from pathlib import Path
from zipfile import ZipFile

import pytest

from driveblocks.export import TARGETS
from driveblocks.output import manifest
from driveblocks.output.release import DATE, release

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The archive of each target."""
    return {path.stem.rpartition("-")[2]: path for path in release(ROOT, tmp_path_factory.mktemp("first"))}


def names(path: Path) -> set[str]:
    """What is in an archive, without its outer folder."""
    with ZipFile(path) as archive:
        return {name.removeprefix(f"{path.stem}/") for name in archive.namelist()}


@pytest.mark.thorough
def test_every_target_that_is_built_has_one_with_all_its_files(archives: dict[str, Path]) -> None:
    listed = manifest.read(ROOT / "blocks").files
    built = [target for target in TARGETS if any(name.startswith(f"{target}/") for name in listed)]
    assert list(archives) == built
    for target, path in archives.items():
        own = {f"blocks/{name}" for name in listed if name.startswith(f"{target}/")}
        assert {"LICENSE", *own} <= names(path)
        others = {name for name in names(path) if name.startswith("blocks/") and name.split("/")[1] in TARGETS}
        others -= {name for name in others if name.split("/")[1] in (target, "iec61131")}
        assert all(name.endswith("/README.md") for name in others)


def test_what_a_page_in_it_links_to_is_in_it(archives: dict[str, Path]) -> None:
    for path in archives.values():
        inside = names(path)
        with ZipFile(path) as archive:
            pages = {name: archive.read(f"{path.stem}/{name}").decode() for name in inside if name.endswith(".md")}
        assert any(name.startswith("blocks/") for name in pages)
        target = path.stem.rpartition("-")[2]
        theirs = tuple(f"blocks/{other}/" for other in TARGETS if other != target)
        for name, text in pages.items():
            if name.startswith(theirs):  # the page of another platform, which only a drive's page names
                continue
            links = re.findall(r"\]\((?!\w+:)([^)#\s]+)", text)
            assert {posixpath.normpath(posixpath.join(posixpath.dirname(name), link)) for link in links} <= inside, name


def test_its_files_are_those_of_the_folder_byte_by_byte_with_a_fixed_date(archives: dict[str, Path]) -> None:
    with ZipFile(archives["twincat"]) as archive:
        for entry in archive.infolist():
            assert entry.date_time == DATE
            assert archive.read(entry) == (ROOT / entry.filename.partition("/")[2]).read_bytes()
        assert archive.namelist() == sorted(archive.namelist())


@pytest.mark.thorough
def test_made_twice_they_are_the_same_bytes(archives: dict[str, Path], tmp_path: Path) -> None:
    elsewhere = tmp_path / "copy"
    for name in ("blocks", "docs", "examples"):  # files of another age, in another order
        shutil.copytree(ROOT / name, elsewhere / name, copy_function=shutil.copyfile)
    shutil.copyfile(ROOT / "LICENSE", elsewhere / "LICENSE")
    again = {path.name: path.read_bytes() for path in release(elsewhere, tmp_path / "second")}
    assert again == {path.name: path.read_bytes() for path in archives.values()}


def test_a_folder_without_blocks_makes_none(tmp_path: Path) -> None:
    assert release(tmp_path, tmp_path / "dist") == []
