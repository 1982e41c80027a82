"""The maps that are at hand: those that DriveBlocks ships, found by name, and any other by its path."""

import difflib
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import driveblocks
from driveblocks.maps.form import PLATE, Plate
from driveblocks.maps.problem import Refused
from structured_text import files

_PREFIX = re.compile(rb"^prefix: *['\"]?([A-Za-z0-9]+)", re.MULTILINE)
_MODELS = re.compile(rb"^models:.*?^(?=[a-z])", re.MULTILINE | re.DOTALL)
_PLATE = re.compile(rb"""\bplate: *['"]?([^'",}\n]+)""")
_HEAD = 8192
"""Bytes at the start of a map in which its `prefix` and `models` are looked for; comments may come before them."""


class UnknownDrive(Refused):
    """A name that means no map, or several."""


def folder() -> Path:
    """Where the shipped maps are: inside an installed package, else beside `generator/` in a checkout."""
    package = Path(driveblocks.__file__).resolve().parent
    packed = package / "vendor_maps"
    return packed if packed.is_dir() else package.parents[1] / "vendor_maps"


def shipped() -> tuple[Path, ...]:
    return tuple(sorted(folder().glob("*.yaml")))


def shown(path: Path) -> str:
    """A path as short as it can be written from the user's folder."""
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)


def is_path(name: str) -> bool:
    """Whether a word of the command line is meant as a file: it has the ending of a map, or a folder.

    A nameplate may have a stroke, too; a file that is there is one.
    """
    if name.lower().endswith((".yaml", ".yml")) or "\\" in name:
        return True
    return "/" in name and (os.path.exists(name) or not _plated(name, shipped()))  # noqa: PTH110 - as in `resolve`


def resolve(name: str) -> Path:
    """The map that a word of the command line names. Raises UnknownDrive.

    A word is a path, or regardless of case the name of a shipped file, the prefix of its blocks, a part of one of them
    that no other shipped map has, or the model number on a nameplate.
    """
    if is_path(name):
        return Path(name)
    maps = {path: _names(path) for path in shipped()}
    for found in _found(name, maps) if name else ():
        if len(found) == 1:
            return found[0]
        if found:
            raise UnknownDrive(f"`{name}` fits several drives; write one of {_list(p.stem for p in found)}")
    if name and os.path.exists(name):  # noqa: PTH110 - Path.exists raises for a name that is too long
        return Path(name)
    raise _unknown(name, maps)


def _found(name: str, maps: dict[Path, tuple[str, ...]]) -> Iterator[list[Path]]:
    """The maps that are called so, then those that have it in their names, then those of such a nameplate."""
    for fits in (str.__eq__, str.__contains__):
        yield [path for path, names in maps.items() if any(fits(known, name.lower()) for known in names)]
    yield _plated(name, maps)


def _plated(name: str, maps: Iterable[Path]) -> list[Path]:
    return [path for path in maps if any(plate.fits(name) for plate in plates(path))]


def is_shipped(path: Path) -> bool:
    return path.resolve() in {each.resolve() for each in shipped()}


def displacing(path: Path, named: Iterable[Path]) -> Path:
    """What takes the place of a shipped map: the named one with its prefix or file name; itself without such."""
    if not is_shipped(path):
        return path
    stem, prefix = _names(path)[0], _names(path)[-1]
    return next((each for each in named if stem == _names(each)[0] or prefix == _names(each)[-1]), path)


def chosen(names: Iterable[str] | None) -> list[Path]:
    """The maps of the words of a command line; all that are shipped without any. Raises UnknownDrive."""
    return list(dict.fromkeys(resolve(name) for name in names)) if names else list(shipped())


def _names(path: Path) -> tuple[str, ...]:
    """Lower-case file stem and block prefix; a map that cannot be read keeps its stem."""
    match = _PREFIX.search(_head(path))
    stem = path.stem.lower()
    return (stem, match[1].decode("ascii").lower()) if match else (stem,)


def plates(path: Path) -> tuple[Plate, ...]:
    """The model numbers of a map; none of one that cannot be read."""
    models = _MODELS.search(_head(path))
    found = (each.decode("utf-8", "replace").strip() for each in _PLATE.findall(models[0] if models else b""))
    return tuple(map(Plate, filter(PLATE.pattern.fullmatch, found)))


def _head(path: Path) -> bytes:
    try:
        return files.head(path, _HEAD)
    except files.BadFile:
        return b""


def _unknown(name: str, maps: dict[Path, tuple[str, ...]]) -> UnknownDrive:
    stems = {known: path.stem for path, names in maps.items() for known in names}
    near = difflib.get_close_matches(name.lower(), stems, 3, 0.5)
    known = (
        f"known drives are {_list(p.stem for p in maps)}; the model number of a nameplate, or the path of a .yaml file"
    )
    guess = f"did you mean {_list(stems[one] for one in near)}? " if near else ""
    return UnknownDrive(f"there is no drive `{name}`; {guess}{known} will do, too")


def _list(names: Iterable[str]) -> str:
    return ", ".join(dict.fromkeys(names))
