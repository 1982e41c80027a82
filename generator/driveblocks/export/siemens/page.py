"""The page of the target: what to import, what must be there afterwards, and how it was checked."""

from collections.abc import Sequence
from dataclasses import dataclass

from driveblocks.export.part import Part, Shelf
from driveblocks.render.context import identity
from driveblocks.render.environment import ABI, render
from structured_text.language.tree import Function, TypeDecl


@dataclass(frozen=True)
class Source:
    """A file: its name, what it brings, the family that alone needs it, and how many types, FBs and FCs."""

    name: str
    what: str
    family: str
    types: int
    fbs: int
    fcs: int

    @property
    def count(self) -> str:
        """As TIA Portal's project tree shows it."""
        found = ((self.types, "PLC data type"), (self.fbs, "FB"), (self.fcs, "FC"))
        return ", ".join(f"{number} {word}{'s' * (number > 1)}" for number, word in found if number)


def source(name: str, what: str, parts: Sequence[Part], family: str = "") -> Source:
    """A file of these parts, which are all types or all blocks."""
    types = sum(isinstance(part.element, TypeDecl) for part in parts)
    functions = sum(isinstance(part.element, Function) for part in parts)
    return Source(name, what, family, types, len(parts) - functions - types, functions)


def page(shelf: Shelf, files: Sequence[Source], masters: Sequence[str]) -> str:
    """The page's text; `masters` are the families with a program for a Modbus master."""
    families = [
        {
            "name": drive.prefix,
            "title": identity(drive).family,
            "blocks": sum(each.fbs + each.fcs for each in files if each.family in ("", drive.prefix)),
            "master": drive.prefix in masters,
        }
        for drive in shelf.drives.values()
    ]
    return render(
        "siemens/README.md.j2",
        files=files,
        families=families,
        types=sum(each.types for each in files),
        fbs=sum(each.fbs for each in files),
        fcs=sum(each.fcs for each in files),
        blocks=sum(each.fbs + each.fcs for each in files),
        most=256,
        abi=ABI,
    )
