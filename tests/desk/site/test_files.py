"""What is written at the desk: whole, under no name that somebody can prepare, and whatever the file held before."""

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from driveblocks.desk.site import kept, saved
from driveblocks.desk.site.found import Found, Way
from driveblocks.maps.catalog import resolve
from driveblocks.maps.load import load

ABOUT = kept.About("Pump", "jscc", "12345678", "2026-11-23 10:30", "")
FOUND = Found(Way(9600), 1, "fits")
PREPARED: dict[str, Callable[[Path, Path], object]] = {
    "link": lambda path, victim: path.symlink_to(victim),
    "link to nothing": lambda path, victim: path.symlink_to(victim.with_name("nothing")),
    "file": lambda path, _: path.write_text("mine too", encoding="utf-8"),
    "pipe": lambda path, _: os.mkfifo(path),
}


def site(path: Path) -> None:
    """What `commission` writes, and tries at its start."""
    kept.try_out(path)
    kept.write(path, ABOUT, FOUND)


WRITERS: dict[str, Callable[[Path], object]] = {
    "site.yaml": site,
    "pump.csv": lambda path: saved.write(path, "jscc", load(resolve("jscc")), 1, {0x2103: 5}),
}


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no named pipes in folders and asks for rights to link")
@pytest.mark.parametrize("name", WRITERS)
@pytest.mark.parametrize("kind", PREPARED)
def test_what_is_prepared_beside_a_file_is_neither_written_nor_removed(tmp_path: Path, name: str, kind: str) -> None:
    path, victim, trap = tmp_path / name, tmp_path / "victim", tmp_path / f".{name}.part"
    victim.write_text("mine", encoding="utf-8")
    PREPARED[kind](trap, victim)
    before = trap.lstat()
    WRITERS[name](path)
    assert trap.lstat() == before
    assert victim.read_text("utf-8") == "mine"
    assert {*tmp_path.iterdir()} == {path, victim, trap}


@pytest.mark.skipif(sys.platform == "win32", reason="Windows asks for rights to link")
def test_what_could_not_be_written_at_the_end_is_refused_at_the_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "lost.yaml").symlink_to(tmp_path / "nowhere")
    (tmp_path / "loop.yaml").symlink_to(tmp_path / "loop.yaml")
    (tmp_path / "mine.yaml").write_text("", encoding="utf-8")
    monkeypatch.setattr(os, "access", lambda path, _: Path(path).name != "mine.yaml")
    for name in ("lost", "loop", "mine"):
        with pytest.raises(OSError, match=r"No such file|symbolic links|Permission denied"):
            kept.try_out(tmp_path / f"{name}.yaml")


@pytest.mark.parametrize("end", ["...\n", "...", "... # the end\n", "...\r\n", "...\n# more\n"])
@pytest.mark.parametrize("label", ["Pump", "Fan"])
def test_a_file_that_says_where_it_ends_is_written(tmp_path: Path, end: str, label: str) -> None:
    path = tmp_path / "site.yaml"
    kept.write(path, ABOUT, FOUND)
    path.write_bytes(path.read_bytes() + end.encode())
    assert [*kept.read(path)] == ["Pump"]
    kept.write(path, kept.About(label, "jscc", "12345678", "2026-11-24 10:30", ""), FOUND)
    assert [*kept.read(path)] == list(dict.fromkeys(["Pump", label]))
    assert [each for each in path.read_text("utf-8").splitlines() if each.startswith("# ")][1:] == [
        each.removeprefix("... ") for each in end.split("\n") if "#" in each
    ]
