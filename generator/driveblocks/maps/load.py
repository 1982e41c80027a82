"""Load a map: file -> text -> nodes -> model -> rules, with every mistake of the file in one MapError."""

from pathlib import Path

from driveblocks.maps import check, nodes, source
from driveblocks.maps.decode import decode
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report


def load(path: Path) -> Drive:
    """Load and check the map at `path`. Raises MapError with every mistake, sorted by line and column."""
    return loads(source.read(path), str(path))


def loads(text: str, name: str) -> Drive:
    """Load and check a map from its text; `name` stands in messages. Raises MapError."""
    report = Report(name)
    root = nodes.parse(text, report)
    drive: Drive | None = decode(Drive, root, report) if root is not None else None
    report.partial = bool(report.problems)
    if drive is not None:
        check.check(drive, report)
    report.raise_if_any()
    assert drive is not None  # noqa: S101  (a map that was not built left a problem behind)
    return drive
