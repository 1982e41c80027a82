"""Build the library and its tests: maps -> all files in memory -> folders, exchanged as a whole; or compare."""

import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError, Problem, Report
from driveblocks.render import library
from driveblocks.render.overview import overview
from driveblocks.render.text import Language
from driveblocks.render.vet import vet
from driveblocks.testing import programs

PLATFORM = "iec61131"
TREES = (PLATFORM, "tests")
"""Folders that the generator owns: what it does not write there is left over."""


@dataclass(frozen=True)
class Source:
    """A checked map and the file that it came from."""

    path: Path
    drive: Drive


def read(paths: Iterable[Path]) -> list[Source]:
    """Load maps that can become blocks. Raises MapError with the mistakes of all of them."""
    sources: list[Source] = []
    problems: list[Problem] = []
    for path in paths:
        try:
            sources.append(Source(path, _vetted(path)))
        except MapError as error:
            problems.extend(error.problems)
    problems.extend(_shared_prefixes(sources))
    problems.extend(_shared_folders(sources))
    if problems:
        raise MapError(problems)
    return sources


def _vetted(path: Path) -> Drive:
    drive = load(path)
    report = Report(str(path))
    vet(drive, report)
    report.raise_if_any()
    return drive


def _shared_prefixes(sources: list[Source]) -> list[Problem]:
    """Two maps of one prefix would write blocks of one name."""
    problems = []
    first: dict[str, Source] = {}
    for source in sources:
        other = first.setdefault(source.drive.prefix.upper(), source)
        if other is not source:
            line, column = source.drive.place("prefix")
            wrong = f"prefix {source.drive.prefix} is taken by {other.path}"
            problems.append(Problem(str(source.path), line, column, wrong, "give each map a prefix of its own"))
    return problems


def _shared_folders(sources: list[Source]) -> list[Problem]:
    """A drive's folder has the name of its map's file; some names belong to the library itself."""
    problems = []
    taken = dict.fromkeys(("modbus", "line", "types", "harness"), "the library's own folder")
    for source in sources:
        stem = source.path.stem
        if stem in taken:
            wrong = f"the folder {stem}/ is taken by {taken[stem]}"
            problems.append(Problem(str(source.path), 1, 1, wrong, "give the file of this map another name"))
        taken[stem] = str(source.path)
    return problems


def files(sources: list[Source], languages: list[Language]) -> dict[str, str]:
    """Every file of the output, path below the output folder -> text. The same input gives the same text."""
    made = [*library.generic(languages)]
    for source in sources:
        made.extend(library.drive(source.path.stem, source.drive, languages))
    texts = {f"{PLATFORM}/{file.path}": file.text for file in made}
    texts[f"{PLATFORM}/order.txt"] = "".join(f"{file.path}\n" for file in made)
    texts["README.md"] = overview(made, [source.drive for source in sources])
    return texts | programs(sources, languages)


def stale(folder: Path, wanted: dict[str, str]) -> list[str]:
    """Files that differ, are missing or are left over, as paths below the output folder."""
    found = (path for tree in TREES for path in (folder / tree).rglob("*") if path.is_file())
    there = {path.relative_to(folder).as_posix() for path in found}
    wrong = {name for name, text in wanted.items() if _text(folder / name) != text}
    return sorted(wrong | (there - set(wanted)))


def _text(path: Path) -> str | None:
    return path.read_text(encoding="utf-8") if path.is_file() else None


def write(folder: Path, wanted: dict[str, str]) -> None:
    """Write all files. Folders are exchanged as a whole, so that a failure leaves the old ones. Raises OSError."""
    new, old = folder / ".driveblocks.new", folder / ".driveblocks.old"
    for path in (new, old):
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
    for name, text in wanted.items():
        path = new / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    _exchange(folder, new, old)
    for path in (new, old):
        shutil.rmtree(path, ignore_errors=True)


def _exchange(folder: Path, new: Path, old: Path) -> None:
    """Put what is in `new` into the folder, all of it or nothing; what it replaces goes to `old`. Raises OSError."""
    done: list[str] = []
    try:
        for name in sorted(path.name for path in new.iterdir()):
            if (folder / name).exists():
                (folder / name).rename(old / name)
            done.append(name)
            (new / name).rename(folder / name)
    except OSError:
        for name in done:
            if (folder / name).exists():
                (folder / name).rename(new / name)
            if (old / name).exists():
                (old / name).rename(folder / name)
        raise
