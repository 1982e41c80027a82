"""The files of the target: all types in one, shared blocks in one, and one per family; libraries share them."""

from collections.abc import Iterable, Iterator

from driveblocks.export.part import WHOLE, Part, Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.siemens.body import body
from driveblocks.export.siemens.declaration import head, opening, spelled, type_lines
from driveblocks.export.siemens.names import Names
from driveblocks.st.tree import ArraySpec, Function, Spec, TypeDecl

PLATFORM = "siemens"
PORT = "SI_Port"
"""The file of the serial port and its lines."""
_CLOSE = {True: "END_FUNCTION", False: "END_FUNCTION_BLOCK"}


def files(shelf: Shelf) -> dict[str, str]:
    """Every file of the target. Raises ExportError with everything that SCL cannot say."""
    port = shelf.adapter(PLATFORM)
    programs = [part for drive in shelf.drives.values() for part in shelf.programs(PLATFORM, drive)]
    names = Names({part.name.upper(): part for part in (*shelf.parts, *port)})
    types = [part for part in shelf.parts if isinstance(part.element, TypeDecl)]
    blocks = [part for part in shelf.parts if not isinstance(part.element, TypeDecl)]
    made = {f"{WHOLE}.udt": _types(types, names)}
    made[f"{WHOLE}.scl"] = _blocks([part for part in blocks if part.folder not in shelf.drives], names)
    for folder, drive in shelf.drives.items():
        made[f"{drive.prefix}.scl"] = _blocks([part for part in blocks if part.folder == folder], names)
    made[f"{PORT}.scl"] = _blocks(port, names)
    made |= {f"{part.name}.scl": _blocks([part], names) for part in programs}
    if names.problems:
        raise ExportError(sorted(names.problems))
    return {f"{PLATFORM}/{name}": text for name, text in made.items()}


def _types(parts: Iterable[Part], names: Names) -> str:
    """The structures; what arrays stand for is told at the top, since SCL gives them no name."""
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
