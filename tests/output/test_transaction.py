"""Many files changed as one: the run dies, or the disk is full, at every single step."""

import errno
import functools
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from driveblocks.maps.problem import Refused
from driveblocks.output import transaction
from driveblocks.output.manifest import text_digest
from structured_text import files

OLD = {"page": "old page", "a/kept": "kept", "a/changed": "old", "gone/b/left": "left"}
CHANGES: dict[str, str | None] = {"page": "new page", "a/changed": "new", "gone/b/left": None, "n/e/w": "fresh"}
NEW = {"page": "new page", "a/kept": "kept", "a/changed": "new", "n/e/w": "fresh"}
MINE = {"a/notes": "mine", "gone/notes": "mine, too"}
EMPTIED = ["gone", "gone/b"]
Fail = Callable[[int, Path | int], None]
ON_DISK = ("mkdir", "rename", "replace", "unlink", "rmdir", "fsync", "open")
STEPS: list[tuple[Any, str]] = [*((os, name) for name in ON_DISK), (files.Output, "add")]


class Killed(BaseException):
    """The process is gone: nothing that it would do afterwards happens."""


class Steps:
    """Count what reaches the disk; from step number `last` on, `fail` is called instead."""

    def __init__(self, patch: pytest.MonkeyPatch, last: int, fail: Fail) -> None:
        """Take the place of the functions."""
        self.done, self.last, self.fail = 0, last, fail
        for module, name in STEPS:
            patch.setattr(module, name, self._counted(getattr(module, name)))

    def _counted(self, function: Any) -> Any:
        def step(*arguments: Any, **options: Any) -> Any:
            self.done += 1
            if self.done >= self.last:
                if function.__name__ == "fsync":
                    os.ftruncate(arguments[0], 1)
                self.fail(self.done - self.last, arguments[0])
            return None if function.__name__ == "fsync" else function(*arguments, **options)

        return step


def die(_number: int, _file: Path | int) -> None:
    raise Killed


def full(number: int, file: Path | int) -> None:
    """Once: what is done to clean up finds room again. What has a descriptor only is not named."""
    if number == 0:
        named = () if isinstance(file, int) else (str(file),)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), *named)


def tree(folder: Path) -> dict[str, str]:
    found = folder.rglob("*")
    return {path.relative_to(folder).as_posix(): path.read_text() if path.is_file() else "/" for path in found}


def whole(texts: dict[str, str]) -> dict[str, str]:
    """A tree with these files and mine, and their folders."""
    files = texts | MINE
    return files | {str(parent): "/" for name in files for parent in Path(name).parents if parent != Path()}


def fill(folder: Path) -> Path:
    for name, text in (OLD | MINE).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def attempt(last: int, fail: Fail, action: Callable[[], object]) -> bool:
    """Whether an action came to its end without the failure."""
    with pytest.MonkeyPatch.context() as patch:
        steps = Steps(patch, last, fail)
        try:
            action()
        except Killed:
            return False
    return steps.done < last


def change(folder: Path) -> None:
    transaction.write(folder, CHANGES, EMPTIED)


def test_all_is_changed_and_nothing_else(tmp_path: Path) -> None:
    change(fill(tmp_path))
    assert tree(tmp_path) == whole(NEW)


def test_a_folder_that_holds_something_else_stays(tmp_path: Path) -> None:
    fill(tmp_path)
    transaction.write(tmp_path, {"gone/b/left": None}, EMPTIED)
    assert (tmp_path / "gone/notes").exists()
    assert not (tmp_path / "gone/b").exists()


def test_a_run_killed_at_any_step_leaves_the_old_files_or_the_new(tmp_path: Path) -> None:
    """And so does a run after it that is killed at any step while it takes the first one back."""
    seen = []
    for last in range(1, 100):
        folder = fill(tmp_path / str(last))
        if attempt(last, die, functools.partial(change, folder)):
            break
        for again in range(1, 100):
            if attempt(again, die, functools.partial(transaction.recover, folder)):
                break
        transaction.recover(folder)
        seen.append(tree(folder) == whole(NEW))
        assert tree(folder) == whole(NEW if seen[-1] else OLD), last
        if not seen[-1]:
            change(folder)
        assert tree(folder) == whole(NEW), last
    assert seen == sorted(seen)
    assert seen.count(False) > 20
    assert seen.count(True) > 3


def test_a_full_disk_at_any_step_leaves_the_old_files_at_once_and_is_named(tmp_path: Path) -> None:
    named = set()
    for last in range(1, 100):
        folder = fill(tmp_path / str(last))
        try:
            if attempt(last, full, functools.partial(change, folder)):
                break
        except OSError as error:
            named.add(Path(error.filename).relative_to(folder).as_posix())
            assert tree(folder) == whole(OLD), last
        else:  # what is left over when all is done
            transaction.recover(folder)
            assert tree(folder).items() >= whole(NEW).items()
    assert named == {*CHANGES, f"{transaction.WORK}/journal.json", "."}


def test_what_is_written_after_a_killed_run_is_not_thrown_away(tmp_path: Path) -> None:
    moved = next(last for last in range(1, 100) if killed_with(tmp_path / str(last), last, "a/changed"))
    folder = tmp_path / str(moved)
    (folder / "a/changed").write_text("by hand")
    with pytest.raises(Refused, match=r"a/changed: changed since a build was interrupted; .*old/a/changed is older"):
        transaction.recover(folder)
    assert (folder / "a/changed").read_text() == "by hand"
    assert (folder / transaction.WORK / "old/a/changed").read_text() == "old"
    (folder / "a/changed").unlink()
    assert transaction.recover(folder)
    assert tree(folder) == whole(OLD)


def killed_with(folder: Path, last: int, missing: str) -> bool:
    """Whether a run killed at a step leaves a file away."""
    attempt(last, die, lambda: change(fill(folder)))
    return (folder / transaction.WORK / "old").exists() and not (folder / missing).exists()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        '{"files": {"../x": [null, "1"]}, "folders": []}',
        '{"files": {"a\\u0000b": [null, "1"]}, "folders": []}',
        '{"files": {"\\ud800": [null, "1"]}, "folders": []}',
        '{"files": {"x": [[], {}]}, "folders": []}',
        '{"files": {"x": [null, "1"]}, "folders": "abc"}',
        '{"files": {".driveblocks.work/old/only": [null, "1"]}, "folders": []}',
        "[" * 100_000,
    ],
)
def test_a_journal_of_someone_else_moves_nothing(tmp_path: Path, text: str) -> None:
    work = tmp_path / transaction.WORK
    (work / "old").mkdir(parents=True)
    (work / "old/only").write_text("the only copy")
    (work / "journal.json").write_text(text)
    with pytest.raises(Refused, match="copy back what you miss from"):
        transaction.recover(tmp_path)
    assert (work / "old/only").exists()


def prepared(tmp_path: Path, link: str, name: str) -> Path:
    """An output folder with a journal that someone else wrote, and a link out of it."""
    fill(tmp_path / "elsewhere")
    folder = tmp_path / "out"
    for part in ("new", "old"):
        (folder / transaction.WORK / part).mkdir(parents=True)
    files = {f"{name}/page": [None, text_digest("old page")], "new": [None, text_digest("fresh")]}
    (folder / transaction.WORK / "journal.json").write_text(json.dumps({"files": files, "folders": [f"{name}/gone"]}))
    if (folder / link).is_dir():
        (folder / link).rmdir()
    (folder / link).symlink_to(tmp_path / "elsewhere")
    return folder


@pytest.mark.parametrize(
    ("link", "name"),
    [
        ("way", "way"),
        (f"{transaction.WORK}/old/way", "way"),
        (f"{transaction.WORK}/new/way", "way"),
        (f"{transaction.WORK}/old", "a"),
        (f"{transaction.WORK}/new", "a"),
        (transaction.DONE, "a"),
    ],
)
def test_a_journal_that_leads_through_a_link_changes_nothing(tmp_path: Path, link: str, name: str) -> None:
    folder = prepared(tmp_path, link, name)
    before = tree(tmp_path)
    with pytest.raises(Refused, match=r"delete or move it, then build again"):
        transaction.recover(folder)
    assert tree(tmp_path) == before


def test_a_work_folder_that_is_a_link_is_not_followed(tmp_path: Path) -> None:
    fill(tmp_path / "elsewhere")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / transaction.WORK).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(Refused, match="in the place of a folder of a build"):
        transaction.recover(tmp_path / "out")
    assert tree(tmp_path / "elsewhere") == whole(OLD)


def test_no_folder_is_removed_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "elsewhere/empty").mkdir(parents=True)
    folder = fill(tmp_path / "out")
    (folder / "way").symlink_to(tmp_path / "elsewhere")
    transaction.write(folder, CHANGES, ["way/empty", *EMPTIED])
    assert (tmp_path / "elsewhere/empty").is_dir()


def test_names_that_are_one_file_where_case_does_not_count_are_put_back_once(tmp_path: Path) -> None:
    """Two hard links stand for the two names."""
    for folder in ("", transaction.WORK + "/old"):
        (tmp_path / folder).mkdir(exist_ok=True, parents=True)
    (tmp_path / "FOO").write_text("new")
    (tmp_path / "Foo").hardlink_to(tmp_path / "FOO")
    (tmp_path / transaction.WORK / "old/Foo").write_text("old")
    files = {"FOO": [None, text_digest("new")], "Foo": [text_digest("old"), None]}
    (tmp_path / transaction.WORK / "journal.json").write_text(
        json.dumps({"files": files, "folders": []}), encoding="utf-8"
    )
    assert transaction.recover(tmp_path)
    assert tree(tmp_path) == {"Foo": "old"}


# ---------------------------------------------------------------- one build at a time


def test_a_folder_has_one_build_at_a_time(tmp_path: Path) -> None:
    folder = tmp_path / "new/out"
    with (
        transaction.locked(folder),
        pytest.raises(Refused, match="another build is at work"),
        transaction.locked(folder),
    ):
        pass
    with transaction.locked(folder):
        pass
    assert list(tmp_path.iterdir()) == []


def test_the_lock_file_of_a_killed_run_is_no_lock(tmp_path: Path) -> None:
    (tmp_path / transaction.LOCK).touch()
    with transaction.locked(tmp_path):
        pass
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("there", [False, True])
def test_a_lock_file_that_is_a_link_is_refused(tmp_path: Path, there: bool) -> None:
    if there:
        (tmp_path / "elsewhere").touch()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / transaction.LOCK).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(Refused, match="in the place of the lock file"), transaction.locked(tmp_path / "out"):
        pass
    assert (tmp_path / "elsewhere").exists() == there


@pytest.mark.parametrize("again", [False, True])
def test_a_lock_file_that_its_owner_removes_meanwhile_is_no_lock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, again: bool
) -> None:
    """Between opening and locking, the run that holds it ends, and perhaps the next one begins."""
    taken = files.lock

    def late(file: files.Output, *, waits: bool) -> None:
        monkeypatch.setattr(files, "lock", taken)
        (tmp_path / transaction.LOCK).unlink()
        if again:
            (tmp_path / transaction.LOCK).touch()
        taken(file, waits=waits)

    monkeypatch.setattr(files, "lock", late)
    with transaction.locked(tmp_path), pytest.raises(Refused), transaction.locked(tmp_path):
        pass
