"""Change many files of a folder as one: after a killed run, a full disk or a second run there is the old or the new.

New files are staged in a work folder and listed in its journal; then the old files move into it and the new ones out
of it. Renaming the work folder is the moment from which the new files count; until then `recover` takes all of it back.
"""

import contextlib
import errno
import json
import os
import shutil
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from driveblocks.maps.problem import Refused
from driveblocks.output.manifest import MALFORMED, barrier_to, below, digest, parents, text_digest, words
from structured_text import files

WORK, DONE, LOCK = ".driveblocks.work", ".driveblocks.done", ".driveblocks.lock"
JOURNAL, NEW, OLD = "journal.json", "new", "old"


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold a folder for one build; make it for that time if need be. Raises Refused while another build has it.

    The operating system drops the lock of a process that dies. What stays empty of what was made is removed.
    """
    above = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        file = _taken(folder)
        try:
            yield
        finally:
            _release(folder / LOCK, file)
    finally:
        for path in above:
            with contextlib.suppress(OSError):
                path.rmdir()


def _taken(folder: Path) -> files.Output:
    """The locked lock file, and of no removed one of the same name. Raises Refused and OSError."""
    path = folder / LOCK
    while True:
        folder.mkdir(parents=True, exist_ok=True)
        _refuse_other(path, stat.S_ISREG, "the lock file of a build")
        file = files.opened(path)
        try:
            files.lock(file, waits=False)
            if os.path.samestat(os.fstat(file.fileno()), path.lstat()):
                return file
        except FileNotFoundError:
            pass  # its last owner has removed it meanwhile
        except OSError as error:
            file.close()
            if error.errno in {errno.EACCES, errno.EAGAIN, errno.EDEADLK}:
                raise Refused(f"{folder}: another build is at work there; build again when it has ended") from None
            error.filename = error.filename or str(path)
            raise
        file.close()


def _refuse_other(path: Path, kind: Callable[[int], bool], wanted: str) -> None:
    """Raises Refused where a link, or what is not of a kind, has the place of something that builds make."""
    with contextlib.suppress(FileNotFoundError):
        if not kind(path.lstat().st_mode):
            raise Refused(f"{path}: in the place of {wanted}, and is none; delete or move it, then build again")


def _release(path: Path, file: files.Output) -> None:
    """Remove the lock file while it is held; where an open file cannot be removed, right after."""
    try:
        with contextlib.suppress(OSError):
            path.unlink()
    finally:
        file.close()
    if sys.platform == "win32":
        with contextlib.suppress(OSError):
            path.unlink()


def interrupted(folder: Path) -> bool:
    """Whether a build ended before it was complete, so that files of the folder may be old, new or away."""
    return os.path.exists(folder / WORK / JOURNAL)  # noqa: PTH110  (what cannot be looked at raises nothing)


def write(folder: Path, texts: Mapping[str, str | None], emptied: list[str]) -> None:
    """Write files and remove those without a text, then the folders that are empty then; all of it or nothing.

    The folder must be locked. Raises OSError with the file that it is about, or whatever interrupts it; the folder is
    then as it was, unless taking it back was interrupted, too: `recover` continues with that.
    """
    work = folder / WORK
    try:
        journal = _staged(folder, texts)
        old = [name for name, (before, _) in journal.files.items() if before is not None]
        new = [name for name, (_, after) in journal.files.items() if after is not None]
        _make_folders(work / OLD, old, folder)
        for name in old:
            _move(folder / name, work / OLD / name, folder / name)
        _make_folders(folder, new, folder)
        for name in new:
            _move(work / NEW / name, folder / name, folder / name)
        _prune(folder, emptied)
        with _about(folder):
            work.rename(folder / DONE)
    except BaseException:
        recover(folder)
        raise
    shutil.rmtree(folder / DONE, ignore_errors=True)


@dataclass(frozen=True)
class _Journal:
    """Digests of each file before and after, None for none, and the folders that have to be made."""

    files: dict[str, tuple[str | None, str | None]]
    folders: list[str]


def _staged(folder: Path, texts: Mapping[str, str | None]) -> _Journal:
    """Stage everything new, then the journal, whole or not at all."""
    work = folder / WORK
    new = {name: text for name, text in texts.items() if text is not None}
    there = {name: digest(folder / name) for name in texts}
    _make_folders(work, [JOURNAL], work)
    _make_folders(work / NEW, new, folder)
    for name, text in new.items():
        with _about(folder / name):  # what replaces nothing need not be waited for: that takes seconds for a library
            files.put(work / NEW / name, text, new=True, sync=there[name] is not None)
    changed = {name: (there[name], text_digest(new[name]) if name in new else None) for name in texts}
    folders = [name for name in parents(new) if not (folder / name).is_dir()]
    files.put(work / JOURNAL, json.dumps({"files": changed, "folders": folders}), sync=any(there.values()))
    return _Journal(changed, folders)


@contextlib.contextmanager
def _about(path: Path) -> Iterator[None]:
    """Let an OSError name the file that the user knows: a full disk names none, a rename one of the work folder."""
    try:
        yield
    except OSError as error:
        error.filename = str(path)
        raise


def _move(source: Path, target: Path, known: Path) -> None:
    """Move a file within the folder. Raises OSError that names it as it is known to the user."""
    with _about(known):
        source.replace(target)


def _make_folders(root: Path, names: Iterable[str], known: Path) -> None:
    """Make the folders of files. Raises OSError that names the first file of a folder as it is known to the user."""
    first = {name.rpartition("/")[0]: name for name in reversed([*names])}
    for inside, name in reversed(first.items()):
        with _about(known / name):
            (root / inside).mkdir(parents=True, exist_ok=True)


def _prune(folder: Path, names: list[str]) -> None:
    """Remove folders that are empty, inner ones first."""
    for name in sorted(names, reverse=True):
        if barrier_to(folder, name) is None:
            with contextlib.suppress(OSError):
                (folder / name).rmdir()


def recover(folder: Path) -> bool:
    """Take back a build that did not come to its end; says whether there was one. Raises Refused and OSError."""
    work = folder / WORK
    for path in (work, folder / DONE, work / NEW, work / OLD):
        _refuse_other(path, stat.S_ISDIR, "a folder of a build")
    if (folder / DONE).is_dir():
        shutil.rmtree(folder / DONE)
    if not work.is_dir():
        return False
    _refuse_other(work / JOURNAL, stat.S_ISREG, "the journal of a build")
    begun = interrupted(folder)
    if begun:
        _undo(folder, _journal(work))
    shutil.rmtree(work)
    return begun


def _journal(work: Path) -> _Journal:
    """What a build was about to do. Raises Refused."""
    try:
        content = json.loads(files.data(work / JOURNAL))
        listed = {name: (before, after) for name, (before, after) in content["files"].items()}
        words([text for pair in listed.values() for text in pair if text is not None])
        return _Journal({name: listed[name] for name in below([*listed])}, below(content["folders"]))
    except MALFORMED:
        right = f"copy back what you miss from {work / OLD}, then delete {work}"
        raise Refused(f"{work / JOURNAL}: not the journal of a build; {right}") from None


def _undo(folder: Path, journal: _Journal) -> None:
    """Take new files away and put old ones back; can be interrupted and done again.

    Raises Refused for files that someone else has written since: neither they nor the old ones are thrown away.
    """
    new, old = folder / WORK / NEW, folder / WORK / OLD
    _refuse_ways_out([folder, new, old], [*journal.files, *journal.folders])
    made = {after for name, (_, after) in journal.files.items() if after and not os.path.lexists(new / name)}
    ours = [name for name in journal.files if digest(folder / name) in made]
    kept = [name for name in journal.files if os.path.lexists(old / name)]
    if strange := [name for name in kept if name not in ours and os.path.lexists(folder / name)]:
        lines = [f"{folder / name}: changed since a build was interrupted; {old / name} is older" for name in strange]
        raise Refused("\n".join([*lines, "delete or move one of the two, then build again"]))
    _make_folders(folder, kept, folder)
    for name in kept:
        if os.path.lexists(old / name):  # where case does not count, two names may have been one file
            _move(old / name, folder / name, folder / name)
    for name in ours:
        if name not in kept and journal.files[name][0] is None:
            (folder / name).unlink()
    _prune(folder, journal.folders)


def _refuse_ways_out(roots: list[Path], names: list[str]) -> None:
    """Raises Refused where a name leads through a link, or through anything else that is no folder."""
    ways = dict.fromkeys(root / part for root in roots for name in names if (part := barrier_to(root, name)))
    if lines := [
        f"{way}: no folder any more, and an interrupted build would put files back through it" for way in ways
    ]:
        raise Refused("\n".join([*lines, "delete or move it, then build again"]))
