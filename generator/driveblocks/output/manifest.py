"""What the generator owns in an output folder: a list of the files that it wrote, and what became of each since."""

import hashlib
import json
import os
import stat
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any

from driveblocks.maps.problem import Refused
from structured_text import files

NAME = ".driveblocks.json"
FORMAT = 1
OWN = {".driveblocks.work", ".driveblocks.done", ".driveblocks.lock"}
"""What a build makes in the folder for itself: no name that is read from a file may lead there."""
MALFORMED = (ValueError, TypeError, KeyError, AttributeError, RecursionError)
"""What reading a file raises that holds something else."""
OLDEST = "iec61131"
"""The target of a folder whose manifest names none: there was no other."""


class State(StrEnum):
    """Why a file of the output is not as it should be."""

    MISSING = "missing"
    OUTDATED = "out of date"
    LEFT_OVER = "left over"
    EDITED = "edited since it was built"
    FOREIGN = "in the way, and not written by DriveBlocks"


@dataclass(frozen=True)
class Manifest:
    """The maps and targets that a folder was built from and for, its files with their digests, the folders made."""

    maps: tuple[str, ...] = ()
    targets: tuple[str, ...] = ()
    files: Mapping[str, str] = field(default_factory=dict)
    folders: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The same manifest gives the same text, a line per entry."""
        return json.dumps({"format": FORMAT, **vars(self)}, indent=1, sort_keys=True) + "\n"


def read(folder: Path) -> Manifest:
    """The manifest of a folder; an empty one where there is none. Raises Refused if it is no manifest, and OSError."""
    path = folder / NAME
    if not os.path.lexists(path):
        return Manifest()
    try:
        if path.is_file():  # a pipe would be waited for
            return _parsed(json.loads(files.data(path)))
    except MALFORMED:
        pass
    right = "restore it, or delete it: files that are as they would be written are then taken over again"
    raise Refused(f"{path}: not the list that this version of DriveBlocks writes; {right}")


def _parsed(content: Any) -> Manifest:
    """Raises one of MALFORMED when it is anything but a manifest."""
    listed = dict(content["files"].items())
    maps, targets = words(content["maps"]), words(content.get("targets", [OLDEST]))
    if content["format"] != FORMAT:
        raise ValueError
    words([*maps, *targets, *listed.values()])
    return Manifest(
        tuple(maps), tuple(targets), {name: listed[name] for name in below([*listed])}, tuple(below(content["folders"]))
    )


def words(read: Any) -> list[str]:
    """A list of words that was read from a file. Raises ValueError when it is anything else."""
    if not isinstance(read, list) or not all(isinstance(word, str) and "\0" not in word for word in read):
        raise ValueError
    for word in read:
        os.fsencode(word)
    return read


def below(read: Any) -> list[str]:
    """Names that were read from a file and lead nowhere but into the folder. Raises ValueError for others."""
    for path in map(Path, words(read)):
        if not path.parts or path.anchor or ".." in path.parts or path.parts[0].casefold() in OWN:
            raise ValueError
    return list(read)


def made(
    maps: Iterable[str], targets: Iterable[str], texts: Mapping[str, str], folder: Path, old: Manifest
) -> Manifest:
    """The manifest of what is to be written. A folder that was there before is not the generator's."""
    mine = (name for name in parents(texts) if name in old.folders or not (folder / name).is_dir())
    digests = {name: text_digest(text) for name, text in sorted(texts.items())}
    return Manifest(tuple(maps), tuple(targets), digests, tuple(mine))


def parents(names: Iterable[str]) -> list[str]:
    folders = {PurePosixPath(name.rpartition("/")[0]) for name in names}
    found = {str(each) for folder in folders for each in (folder, *folder.parents)}
    return sorted(found - {"."})


@lru_cache(4096)
def text_digest(text: str) -> str:
    """What `digest` gives for a file with this text."""
    return hashlib.sha256(text.replace("\r\n", "\n").encode("utf-8")).hexdigest()


def digest(path: Path) -> str | None:
    """SHA-256 of a file, None where nothing is, and a word for what is no plain file.

    Line ends count as the generator writes them, since git may have checked the file out with others.
    """
    try:
        mode = path.lstat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return None
    if not stat.S_ISREG(mode):
        return "link" if stat.S_ISLNK(mode) else "folder" if stat.S_ISDIR(mode) else "device"
    return hashlib.sha256(files.data(path).replace(b"\r\n", b"\n")).hexdigest()


def compare(folder: Path, old: Manifest, texts: Mapping[str, str]) -> dict[str, State]:
    """What is not as it should be: path below the folder -> why. Raises OSError for what cannot be read."""
    listed = dict(old.files)
    if (there := digest(folder / NAME)) is not None:
        listed[NAME] = there
    given_up = {name.casefold(): name for name in listed if name not in texts}
    barriers: dict[str, str | None] = {}
    states = {}
    for name in sorted({*texts, *listed}):
        wanted = text_digest(texts[name]) if name in texts else None
        place = name.rpartition("/")[0]
        if place not in barriers:
            barriers[place] = barrier_to(folder, name)
        barrier = barriers[place]
        if barrier is not None and wanted is not None:
            states[barrier] = State.FOREIGN
        elif barrier is None:
            here = digest(folder / name)
            if here is not None and name not in listed and _same(folder, name, given_up.get(name.casefold())):
                here = None
            if state := judged(here, listed.get(name), wanted):
                states[name] = state
    return states


def judged(here: str | None, listed: str | None, wanted: str | None) -> State | None:
    """What the digests of a file there, in the manifest and in the new output say together."""
    if here == wanted or (wanted is None and here in {None, "folder"}):
        return None
    if here is None:
        return State.MISSING
    if listed is None or here == "folder":
        return State.FOREIGN
    if here != listed:
        return State.EDITED
    return State.LEFT_OVER if wanted is None else State.OUTDATED


def barrier_to(folder: Path, name: str) -> str | None:
    """The first part of a file's way that is no folder but a link or a file: nothing is written through it."""
    for parent in parents([name]):
        path = folder / parent
        if path.is_symlink() or (path.exists() and not path.is_dir()):
            return parent
    return None


def _same(folder: Path, name: str, other: str | None) -> bool:
    """Whether two names that differ in case are one file, as they are where case does not count."""
    return other is not None and (folder / other).exists() and (folder / name).samefile(folder / other)
