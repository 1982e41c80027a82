"""The build cache: what is in it is whole and fits its key, whoever writes at the same time."""

import os
import re
import stat
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from structured_text.engines.engine import EngineError, Source
from structured_text.engines.matiec import Flags, MatiecEngine
from structured_text.engines.matiec.cache import SEAL, Cache, cache_folder


def write(text: str) -> Callable[[Path], None]:
    """What fills an entry with one file."""
    return lambda folder: _fill(folder, text)


def _fill(folder: Path, text: str) -> None:
    (folder / "library.so").write_text(text, encoding="utf-8")


def never(_: Path) -> None:
    raise AssertionError("made although it was there")


def test_entry_is_made_once(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    folder = cache.entry("abc", write("text"))
    assert (folder / "library.so").read_text(encoding="utf-8") == "text"
    assert cache.entry("abc", never) == folder
    assert Cache(tmp_path).entry("abc", never) == folder


DAMAGE: dict[str, Callable[[Path], object]] = {
    "truncate": lambda folder: (folder / "library.so").write_text("fir", encoding="utf-8"),
    "change": lambda folder: (folder / "library.so").write_text("other", encoding="utf-8"),
    "remove": lambda folder: (folder / "library.so").unlink(),
    "unseal": lambda folder: (folder / SEAL).unlink(),
    "scribble": lambda folder: (folder / SEAL).write_text("{", encoding="utf-8"),
    "add": lambda folder: (folder / "more").touch(),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_entry_is_made_again(tmp_path: Path, damage: str) -> None:
    cache = Cache(tmp_path)
    DAMAGE[damage](cache.entry("abc", write("first")))
    again = cache.entry("abc", write("second"))
    assert (again / "library.so").read_text(encoding="utf-8") == "second"
    assert sorted(file.name for file in again.iterdir()) == ["library.so", SEAL]


def test_failed_make_leaves_nothing(tmp_path: Path) -> None:
    def fail(folder: Path) -> None:
        (folder / "library.so").touch()
        raise EngineError("no")

    cache = Cache(tmp_path)
    with pytest.raises(EngineError, match="no"):
        cache.entry("abc", fail)
    assert not list(tmp_path.glob("entries/*/*"))
    assert not list(tmp_path.glob("making/*"))
    assert cache.entry("abc", write("text")).is_dir()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows locks otherwise")
def test_nobody_else_makes_it_meanwhile(tmp_path: Path) -> None:
    """However the processes come and go: whoever makes an entry holds its lock."""
    import fcntl

    def make(folder: Path) -> None:
        with (tmp_path / "locks" / "ab").open("wb") as file, pytest.raises(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        write("text")(folder)

    assert Cache(tmp_path).entry("abc", make).is_dir()


def test_without_locks_the_quicker_wins(tmp_path: Path) -> None:
    """As on a network drive: another process may have finished meanwhile."""
    cache = Cache(tmp_path)

    def race(folder: Path) -> None:
        write("mine")(folder)
        other = tmp_path / "entries" / "ab" / "abc"
        Cache(tmp_path)._make(other, write("theirs"))

    folder = cache.entry("abc", race)
    assert (folder / "library.so").read_text(encoding="utf-8") == "theirs"
    assert not list(tmp_path.glob("making/*"))


def test_size_is_bounded_and_the_longest_unused_is_removed(tmp_path: Path) -> None:
    cache = Cache(tmp_path, limit=3500)
    for stamp, key in ((1, "aa1"), (2, "bb2"), (3, "cc3")):
        folder = cache.entry(key, write("x" * 1000))
        os.utime(folder / SEAL, (stamp, stamp))
    cache.entry("aa1", never)  # used now
    cache.entry("dd4", write("x" * 1000))
    kept = {folder.name for folder in tmp_path.glob("entries/*/*")}
    assert kept == {"aa1", "cc3", "dd4"}


def test_what_killed_processes_left_is_removed_after_a_day(tmp_path: Path) -> None:
    left, fresh = tmp_path / "making" / "left", tmp_path / "making" / "fresh"
    left.mkdir(parents=True)
    fresh.mkdir()
    os.utime(left, (1, 1))
    Cache(tmp_path).entry("abc", write("text"))
    assert (left.exists(), fresh.exists()) == (False, True)


def test_check_says_whether_it_can_be_written(tmp_path: Path) -> None:
    assert Cache(tmp_path / "new").check() is None
    (tmp_path / "file").touch()
    assert "DRIVEBLOCKS_CACHE" in str(Cache(tmp_path / "file" / "new").check())


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such modes")
class TestOwner:
    def test_what_is_made_is_the_users_alone(self, tmp_path: Path) -> None:
        before = os.umask(0)
        try:
            Cache(tmp_path / "new" / "cache").entry("abc", write("text"))
        finally:
            os.umask(before)
        folders = [each for each in (tmp_path / "new").rglob("*") if each.is_dir()]
        assert {stat.S_IMODE(each.stat().st_mode) for each in folders} == {0o700}
        assert len(folders) == 6

    @pytest.mark.parametrize("mode", [0o777, 0o720, 0o702])
    def test_a_folder_that_others_may_write_to_is_refused(self, tmp_path: Path, mode: int) -> None:
        cache = Cache(tmp_path / "cache")
        cache.entry("abc", write("text"))
        cache.root.chmod(mode)
        wrong = f"can be written by others .mode {mode:o}.; make it yours .mode 700. or name another folder"
        with pytest.raises(EngineError, match=wrong):
            cache.entry("abc", never)
        assert re.search(wrong, str(cache.check()))
        assert stat.S_IMODE(cache.root.stat().st_mode) == mode, "not ours to change"

    def test_a_folder_of_somebody_else_is_refused(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        cache = Cache(tmp_path / "cache")
        cache.entry("abc", write("text"))
        monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
        with pytest.raises(EngineError, match=f"belongs to another user .number {os.getuid()}.; make it yours"):
            cache.entry("abc", never)
        assert "belongs to another user" in str(cache.check())

    @pytest.mark.parametrize("step", ["entries", "entries/ab"])
    def test_every_step_of_the_way_is_looked_at(self, tmp_path: Path, step: str) -> None:
        cache = Cache(tmp_path / "cache")
        cache.entry("abc", write("text"))
        (cache.root / step).chmod(0o777)
        with pytest.raises(EngineError, match=f"cache/{step} can be written by others .mode 777.; make it yours"):
            cache.entry("abc", never)
        (cache.root / step).chmod(0o700)
        (cache.root / step).rename(tmp_path / "elsewhere")
        (cache.root / step).symlink_to(tmp_path / "elsewhere")
        with pytest.raises(EngineError, match=f"cache/{step} is a link; make it yours"):
            cache.entry("abc", never)

    @pytest.mark.parametrize("step", ["", "library.so", SEAL])
    def test_an_entry_that_others_may_write_or_that_is_a_link_is_made_again(self, tmp_path: Path, step: str) -> None:
        cache = Cache(tmp_path / "cache")
        folder = cache.entry("abc", write("first"))
        (folder / step).chmod(0o777 if not step else 0o666)
        assert cache.entry("abc", write("second")) == folder
        assert (folder / "library.so").read_text(encoding="utf-8") == "second"
        (folder / step).rename(tmp_path / "elsewhere")
        (folder / step).symlink_to(tmp_path / "elsewhere")
        assert cache.entry("abc", write("third")) == folder
        assert [(folder / name).is_symlink() for name in ("", "library.so", SEAL)] == [False] * 3
        assert (folder / "library.so").read_text(encoding="utf-8") == "third"
        assert cache.entry("abc", never) == folder

    def test_what_leads_to_the_cache_may_be_a_link_of_the_users_and_nobody_elses_to_write(self, tmp_path: Path) -> None:
        (tmp_path / "disk").mkdir()
        (tmp_path / "link").symlink_to(tmp_path / "disk")
        cache = Cache(tmp_path / "link" / "cache")
        assert cache.entry("abc", write("text")).is_dir()
        for open_ in (tmp_path / "disk", tmp_path):
            open_.chmod(0o777)
            with pytest.raises(EngineError, match=f"{open_} can be written by others .mode 777."):
                cache.entry("abc", never)
            open_.chmod(0o1777)
            assert cache.entry("abc", never).is_dir()
            open_.chmod(0o700)

    def test_modes_of_files_do_not_hang_on_what_makes_them(self, tmp_path: Path) -> None:
        before = os.umask(0)
        try:
            folder = Cache(tmp_path / "cache").entry("abc", write("text"))
        finally:
            os.umask(before)
        assert {stat.S_IMODE(each.stat().st_mode) for each in folder.iterdir()} == {0o600}
        assert Cache(tmp_path / "cache").entry("abc", never) == folder


def test_folder() -> None:
    assert cache_folder({"DRIVEBLOCKS_CACHE": "a", "XDG_CACHE_HOME": "b"}) == Path("a")
    assert cache_folder({"XDG_CACHE_HOME": "b"}) == Path("b/driveblocks")
    assert cache_folder({}).name in ("driveblocks", "cache")


BLOCK = "FUNCTION_BLOCK Block\n  VAR_OUTPUT\n    X : INT := 1;\n  END_VAR\n  X := X + 1;\nEND_FUNCTION_BLOCK\n"


def test_key_has_all_that_a_build_is_made_of(matiec: MatiecEngine, tmp_path: Path) -> None:
    found = matiec.installation
    other = tmp_path / "iec2c"
    other.write_bytes(found.iec2c.read_bytes() + b"\0")
    keys = [
        matiec.key(BLOCK),
        matiec.key(BLOCK + "\n"),
        replace(matiec, flags=Flags(optimise="0")).key(BLOCK),
        replace(matiec, flags=Flags(extra=("-DX",))).key(BLOCK),
        replace(matiec, compiler=replace(matiec.compiler, version="other")).key(BLOCK),
        replace(matiec, installation=replace(found, iec2c=other)).key(BLOCK),
    ]
    assert len(set(keys)) == len(keys)
    assert replace(matiec, installation=replace(found)).key(BLOCK) == keys[0]


def test_second_build_comes_from_the_cache_and_a_damaged_one_is_made_again(fresh: MatiecEngine) -> None:
    sources = [Source("block.st", BLOCK)]
    folder = fresh.build(sources).folder
    stamp = (folder / "library.so").stat().st_mtime_ns
    assert fresh.build(sources).folder == folder
    assert (folder / "library.so").stat().st_mtime_ns == stamp
    (folder / "library.so").unlink()
    (folder / "library.so").write_bytes(b"rubbish")
    block = fresh.build(sources).instance("Block")
    block.scan(0)
    assert block["X"] == 2
