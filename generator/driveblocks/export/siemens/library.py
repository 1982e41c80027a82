"""The files of the target: all types in one, shared blocks in one, and one per family; libraries share them."""

from collections.abc import Iterable, Iterator, Sequence

from driveblocks.export.part import WHOLE, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.siemens.body import body
from driveblocks.export.siemens.declaration import head, opening, spelled, type_lines
from driveblocks.export.siemens.names import Names
from driveblocks.export.siemens.page import page, source
from driveblocks.render.context import identity
from structured_text.language.tree import ArraySpec, Function, Spec, TypeDecl

PLATFORM = "siemens"
PORT = "SI_Port"
"""The file of the serial port and its lines."""
_CLOSE = {True: "END_FUNCTION", False: "END_FUNCTION_BLOCK"}


def files(shelf: Shelf) -> dict[str, str]:
    """Every file of the target. Raises ExportError with everything that SCL cannot say."""
    port = shelf.adapter(PLATFORM)
    programs = {drive.prefix: shelf.programs(PLATFORM, drive) for drive in shelf.drives.values()}
    names = Names({part.name.upper(): part for part in (*shelf.parts, *port)})
    types = [part for part in shelf.parts if isinstance(part.element, TypeDecl)]
    structures = [part for part, spec in _specs(types) if not isinstance(spec, ArraySpec)]
    made = {f"{WHOLE}.udt": _types(types, names)}
    told = [source(f"{WHOLE}.udt", "types, first of all", structures)]
    for name, what, family, parts in (
        *_shared(shelf),
        (PORT, "a serial module, with lines of 8 and 32 drives", "", port),
    ):
        made[f"{name}.scl"] = _blocks(parts, names)
        told.append(source(f"{name}.scl", what, parts, family))
    for family, some in programs.items():
        for part in some:
            made[f"{part.name}.scl"] = _blocks([part], names)
            told.append(source(f"{part.name}.scl", "a program, see step 4", [part], family))
    if names.problems:
        raise ExportError(sorted(names.problems))
    masters = [prefix for prefix, some in programs.items() if len(some) > 1]
    made["README.md"] = page(shelf, told, masters)
    return {f"{PLATFORM}/{name}": text for name, text in made.items()}


def _shared(shelf: Shelf) -> Iterator[tuple[str, str, str, Sequence[Part]]]:
    """The blocks of all families, then those of each one: name of the file, what it brings, family, parts."""
    blocks = [part for part in shelf.parts if not isinstance(part.element, TypeDecl)]
    yield WHOLE, "what all families share", "", [part for part in blocks if part.folder not in shelf.drives]
    for folder, drive in shelf.drives.items():
        yield drive.prefix, identity(drive).family, drive.prefix, [part for part in blocks if part.folder == folder]


def _types(parts: Iterable[Part], names: Names) -> str:
    """The structures; a list at the top says what each array is, since SCL gives them no name."""
    made: list[str] = []
    for part, spec in _specs(parts):
        if isinstance(spec, ArraySpec):
            made += [*head(part), f"// {part.name} is {spelled(part, spec, names)} wherever it is used", ""]
    for part, spec in _specs(parts):
        if not isinstance(spec, ArraySpec):
            made += type_lines(part, names)
    return _text(made)


def _specs(parts: Iterable[Part]) -> Iterator[tuple[Part, Spec]]:
    for part in parts:
        if isinstance(part.element, TypeDecl):
            yield part, part.element.spec


def _blocks(parts: Iterable[Part], names: Names) -> str:
    made: list[str] = []
    for part in parts:
        made += [*opening(part, names), *body(part, names).splitlines()]
        made += [_CLOSE[isinstance(part.element, Function)], ""]
    return _text(made)


def _text(lines: list[str]) -> str:
    """As TIA Portal itself writes sources: UTF-8 with byte order mark, lines ending with CR LF."""
    return "\ufeff" + "".join(f"{line}\r\n" for line in lines)
