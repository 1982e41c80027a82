"""The files of the platform: the types and the blocks of each volume, the port, and the programs of each family."""

from collections.abc import Iterable, Iterator, Sequence

from driveblocks.platforms.page import page
from driveblocks.platforms.part import YOURS, Own, Part, Shelf, Volume
from driveblocks.platforms.problem import ExportError
from driveblocks.platforms.siemens.body import body
from driveblocks.platforms.siemens.declaration import head, opening, spelled, type_lines
from driveblocks.platforms.siemens.names import Names
from driveblocks.render.motor import master
from structured_text.language.tree import ArraySpec, Function, Spec, TypeDecl

PLATFORM = "siemens"
_CLOSE = {True: "END_FUNCTION", False: "END_FUNCTION_BLOCK"}


def write(shelf: Shelf) -> dict[str, str]:
    """Every file. Raises ExportError with everything that SCL cannot say."""
    volumes = (*shelf.volumes(), *shelf.port(PLATFORM))
    masters = shelf.masters(PLATFORM, master)
    programs = [*(shelf.motor(PLATFORM, drive) for drive in shelf.drives.values()), *masters.values()]
    names = _names(volumes)
    made: dict[str, str] = {}
    for one in volumes:
        arrays, structures = _arrays(one.types, names), _structures(one.types, names)
        path = f"{one.layer}/{one.name}"
        made |= {f"{path}.udt": _text([*arrays, *structures])} if structures else {}
        made[f"{path}.scl"] = _text([*([] if structures else arrays), *_blocks(one.blocks, names)])
    made |= {f"{YOURS}/{one.name}.scl": _text(_blocks([one], names)) for one in programs}
    if names.problems:
        raise ExportError(sorted(names.problems))
    return made | page(PLATFORM, shelf, volumes, bool(masters))


def own(shelf: Shelf, programs: Own) -> dict[str, str]:
    """A file of each program of a user's own; SCL has no ladder. Raises ExportError."""
    names = _names((*shelf.volumes(), *shelf.port(PLATFORM)))
    made = {f"{YOURS}/{one.name}.scl": _text(_blocks([one], names)) for one in programs.texts}
    if names.problems:
        raise ExportError(sorted(names.problems))
    return made


def _names(volumes: Iterable[Volume]) -> Names:
    return Names({part.name.upper(): part for one in volumes for part in one.parts})


def _arrays(parts: Sequence[Part], names: Names) -> list[str]:
    """What each array is, as comments at the top of a file, since SCL gives them no name."""
    made: list[str] = []
    for part, spec in _specs(parts):
        if isinstance(spec, ArraySpec):
            made += [*head(part), f"// {part.name} is {spelled(part, spec, names)} wherever it is used", ""]
    return made


def _structures(parts: Sequence[Part], names: Names) -> list[str]:
    return [line for part, spec in _specs(parts) if not isinstance(spec, ArraySpec) for line in type_lines(part, names)]


def _specs(parts: Iterable[Part]) -> Iterator[tuple[Part, Spec]]:
    for part in parts:
        if isinstance(part.element, TypeDecl):
            yield part, part.element.spec


def _blocks(parts: Iterable[Part], names: Names) -> list[str]:
    made: list[str] = []
    for part in parts:
        made += [*opening(part, names), *body(part, names).splitlines()]
        made += [_CLOSE[isinstance(part.element, Function)], ""]
    return made


def _text(lines: list[str]) -> str:
    """As TIA Portal itself writes sources: UTF-8 with byte order mark, lines ending with CR LF."""
    return "\ufeff" + "".join(f"{line}\r\n" for line in lines)
