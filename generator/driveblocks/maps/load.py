"""Load a map: file -> text -> nodes -> model -> rules, with every mistake of the file in one MapError."""

import re
from pathlib import Path

from driveblocks.maps import check, nodes, source
from driveblocks.maps.decode import decode
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report

_STEM = re.compile(
    r"(?!(?:con|prn|aux|nul|com[0-9]|lpt[0-9])(?:\.|$))[A-Za-z0-9][\w-]{0,63}(?:\.[\w-]+)*", re.ASCII | re.I
)
"""What names a folder on every system; the devices of Windows do not."""


def load(path: Path) -> Drive:
    """Load and check the map at `path`. Raises MapError with every mistake, sorted by line and column."""
    report = Report(str(path))
    if not _STEM.fullmatch(path.stem):
        wrong = "the name of this file cannot name the folder of its blocks"
        report.add((1, 1), wrong, "use letters A to Z, digits, _ and -, such as my_drive.yaml")
    return _loaded(source.read(path), report)


def loads(text: str, name: str) -> Drive:
    """Load and check a map from its text; `name` is the one in messages. Raises MapError."""
    return _loaded(text, Report(name))


def _loaded(text: str, report: Report) -> Drive:
    before = len(report.problems)
    root = nodes.parse(text, report)
    drive: Drive | None = decode(Drive, root, report) if root is not None else None
    report.partial = len(report.problems) > before
    if drive is not None:
        check.check(drive, report)
    report.raise_if_any()
    assert drive is not None  # noqa: S101  (a map that was not built has left a problem)
    return drive
