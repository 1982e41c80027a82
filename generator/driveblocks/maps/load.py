"""Load a map: file -> text -> nodes -> model -> rules, with every mistake of the file in one MapError."""

import re
from functools import lru_cache
from pathlib import Path

from driveblocks.maps import base, catalog, check, nodes, numbering, older, pair, source
from driveblocks.maps.decode import build, decode
from driveblocks.maps.derived import derived
from driveblocks.maps.form import WORD
from driveblocks.maps.model import Drive
from driveblocks.maps.nodes import Entries, Node
from driveblocks.maps.problem import Report

_STEM = re.compile(
    r"(?!(?:con|prn|aux|nul|com[0-9]|lpt[0-9])(?:\.|$))[A-Za-z0-9][\w-]{0,63}(?:\.[\w-]+)*", re.ASCII | re.I
)
"""What names a folder on every system; the devices of Windows do not."""


def named(name: str) -> tuple[Path, Drive]:
    """The map that a word of the command line names. Raises Refused if it is none, or bad."""
    path = catalog.resolve(name)
    return path, load(path)


def load(path: Path) -> Drive:
    """Load and check the map at `path`. Raises MapError with every mistake, sorted by line and column."""
    report = Report(str(path))
    if not _STEM.fullmatch(path.stem):
        wrong = "the name of this file cannot name the folder of its blocks"
        report.add((1, 1), wrong, "use letters A to Z, digits, _ and -, such as my_drive.yaml")
    text = source.read(path)
    return _shipped(path, text) if path.parent == catalog.folder() else _loaded(text, report, path)


@lru_cache(64)
def _shipped(path: Path, text: str) -> Drive:
    """A map that comes with DriveBlocks, and so does its base: neither changes while a process runs."""
    return _loaded(text, Report(str(path)), path)


def loads(text: str, name: str) -> Drive:
    """Load and check a map from its text; `name` is the one in messages. Raises MapError."""
    return _loaded(text, Report(name))


def _loaded(text: str, report: Report, path: Path | None = None) -> Drive:
    before, parsed = len(report.problems), nodes.parse(text, report)
    root = numbering.wired(numbering.spaced(_based(older.renewed(parsed), report, path)), report)
    drive: Drive | None = decode(Drive, root, report) if root is not None else None
    report.partial = len(report.problems) > before
    if drive is not None:
        drive = pair.apart(derived(drive))
        check.check(drive, report)
    older.renewed(parsed, report)
    report.raise_if_any()
    assert drive is not None  # noqa: S101  (a map that was not built has left a problem)
    return drive


def _based(root: Node | None, report: Report, path: Path | None) -> Node | None:
    """A map with what it takes over from its base. Raises MapError where the base itself has mistakes."""
    asked = base.asked(root)
    if asked is None or not isinstance(root, Entries):
        return root
    name = build(WORD, asked, report, "base")
    if not isinstance(name, str):
        return None
    file = base.find(name, path) if path else None
    if file is None:
        wrong = f"there is no map {name}.yaml beside this one, nor among those that come with DriveBlocks"
        report.add(asked.at, wrong, "name the file of the map of a sister model, without its ending")
        return None
    text = source.read(file)
    taken = _nodes(file, text)
    if base.asked(taken):
        report.add(asked.at, f"{file.name} has a base itself", f"take the base of {file.name}")
        return None
    sister = _sister(file, text)
    assert taken is not None  # noqa: S101  (it was checked)
    return base.whole(root, file, taken, sister, report)


@lru_cache(8)
def _nodes(file: Path, text: str) -> Node | None:
    """What is in the file of a base, of which several maps of a library may be made."""
    return nodes.parse(text, Report(str(file)))


@lru_cache(8)
def _sister(file: Path, text: str) -> Drive:  # noqa: ARG001  (with another text it is another map)
    """The checked map of a base. Raises MapError."""
    return load(file)
