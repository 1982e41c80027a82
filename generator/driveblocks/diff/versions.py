"""Two versions as a person names them, two maps or two folders of Structured Text, and what differs between them."""

from dataclasses import dataclass
from pathlib import Path

from driveblocks.diff import facts, interface
from driveblocks.diff.change import Change, Kind
from driveblocks.maps import catalog, view
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.revision import revision
from driveblocks.render import library
from driveblocks.render.text import languages
from structured_text import files
from structured_text.language.problems import SourceError


@dataclass(frozen=True)
class Version:
    """A map, or without one a folder: what it declares and what it says."""

    title: str
    faces: dict[str, interface.Face]
    drive: Drive | None = None
    stem: str = ""


def version(name: str) -> Version:
    """What a word of the command line names: a folder, or a map. Raises MapError, UnknownDrive, OSError, ValueError."""
    if Path(name).is_dir():
        return Version(name, _folder(Path(name)))
    path = catalog.resolve(name)
    drive = load(path)
    made = library.drive(path.stem, drive, languages(["en", "zh"], "utf-8"))
    faces = interface.faces((file.path, file.text) for file in made)
    return Version(f"{view.title(drive)}, map revision {revision(drive):08X}", faces, drive, path.stem)


def _folder(folder: Path) -> dict[str, interface.Face]:
    sources, bad = files.sources([folder])
    if bad:
        raise ValueError("\n".join([*bad, "name two maps, or two folders with blocks as text"]))
    try:
        return interface.faces(sources)
    except SourceError as error:
        raise ValueError(str(error)) from error


def compared(old: Version, new: Version) -> list[Change]:
    """All that differs, the worst first. Raises ValueError for a map and a folder."""
    if (old.drive is None) != (new.drive is None):
        raise ValueError("one is a map and the other a folder of blocks; name two of a kind")
    changes = [*interface.compared(old.faces, new.faces)]
    if old.drive is not None and new.drive is not None:
        changes += facts.compared(view.of_drive(old.drive, old.stem), view.of_drive(new.drive, new.stem))
    order = list(Kind)
    return sorted(dict.fromkeys(changes), key=lambda each: order.index(each.kind))
