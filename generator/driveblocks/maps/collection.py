"""Maps of one library: each with its file, and what prevents having the blocks of all of them together."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError, Problem


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
            sources.append(Source(path, load(path)))
        except MapError as error:
            problems.extend(error.problems)
    problems.extend(clashes(sources))
    if problems:
        raise MapError(problems)
    return sources


def clashes(sources: list[Source]) -> list[Problem]:
    """What prevents one library for all of these maps."""
    return [*_shared_prefixes(sources), *_shared_folders(sources), *_shared_plates(sources)]


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
    """A drive's folder has the name of its map's file; some names belong to the library itself.

    The case of letters makes no difference, as on Windows.
    """
    problems = []
    taken = dict.fromkeys(("modbus", "line", "vfd", "types", "harness"), "the library's own folder")
    for source in sources:
        stem = source.path.stem.lower()
        if stem in taken:
            wrong = f"the folder {source.path.stem}/ is taken by {taken[stem]}"
            problems.append(Problem(str(source.path), 1, 1, wrong, "give the file of this map another name"))
        taken[stem] = str(source.path)
    return problems


def _shared_plates(sources: list[Source]) -> list[Problem]:
    """A nameplate is that of one drive; a copy of a shipped map, in another folder, may have its."""
    return [
        Problem(
            str(source.path),
            *one.place("plate"),
            f"a model number that fits {one.plate} may fit {each.plate} of {other.path}, too",
            "write what tells the two apart",
        )
        for index, source in enumerate(sources)
        for one in source.drive.models
        for other in sources[:index]
        if other.path.parent == source.path.parent
        for each in other.drive.models
        if one.plate.meets(each.plate)
    ]
