"""What writers of every target get: the library as parts, each a type, function or block with its typed tree."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

from driveblocks.maps.model import Drive
from driveblocks.render import library
from driveblocks.render.library import File
from driveblocks.render.text import Language
from structured_text.language.checker import check
from structured_text.language.fingerprint import body, stream
from structured_text.language.parser import parse
from structured_text.language.tree import Function, FunctionBlock, Program, TypeDecl, Unit

Declared = TypeDecl | Function | FunctionBlock | Program
WHOLE = "DriveBlocks"
"""Name of the library of all families."""


@dataclass(frozen=True)
class Part:
    """One type, function, block or program. `unit` is the tree of its file, which declares nothing else.

    The tree of a part of the library is typed. One of an adapter is parsed only: it names what a platform brings.
    """

    folder: str
    unit: Unit = field(repr=False)

    @cached_property
    def element(self) -> Declared:
        """What it declares."""
        return next(each for each in self.unit.elements if isinstance(each, Declared))

    @property
    def name(self) -> str:
        """`MB_Line8`."""
        return self.element.name

    @property
    def text(self) -> str:
        """The canonical text."""
        return self.unit.text

    @property
    def head(self) -> str:
        """The comment at the top, without its marks."""
        return self.unit.comments[0].text

    @cached_property
    def body(self) -> str:
        """What follows the last END_VAR, as written; empty for a type."""
        return body(self.text).strip("\n")

    @cached_property
    def declaration(self) -> str:
        """From FUNCTION, FUNCTION_BLOCK or PROGRAM to the last END_VAR, as written. Not for types."""
        start = self.element.at
        return self.text[start : self.text.index(body(self.text), start)].rstrip()

    @cached_property
    def tokens(self) -> tuple[str, ...]:
        """The tokens of its body, see `fingerprint`."""
        return stream(self.body)


@dataclass(frozen=True)
class Library:
    """What is imported together: the parts in the order of their use, and the drives that they are for."""

    name: str
    parts: tuple[Part, ...]
    drives: tuple[Drive, ...]

    def own(self, parts: Iterable[Part]) -> tuple[Part, ...]:
        """Of parts that a target adds, those beside parts of this library."""
        folders = {part.folder for part in self.parts}
        return tuple(part for part in parts if part.folder in folders)


@dataclass(frozen=True)
class Shelf:
    """All that was built: the parts in the order of their use, and the drives by the folder of their parts."""

    parts: tuple[Part, ...]
    drives: dict[str, Drive]
    languages: tuple[Language, ...]

    def libraries(self) -> Iterator[Library]:
        """The library of all families, then that of each one with what it shares with others."""
        yield Library(WHOLE, self.parts, tuple(self.drives.values()))
        own: dict[str, list[int]] = {folder: [] for folder in self.drives}
        shared: list[int] = []
        for place, part in enumerate(self.parts):
            own.get(part.folder, shared).append(place)
        for folder, drive in self.drives.items():
            places = sorted([*shared, *own[folder]])
            yield Library(drive.prefix, tuple(self.parts[place] for place in places), (drive,))

    def adapter(self, platform: str) -> tuple[Part, ...]:
        """The blocks of a platform's serial port, in the order of their use: parsed, not typed."""
        return tuple(_read(library.adapter(platform, list(self.languages))))

    def motor(self, platform: str, drive: Drive) -> Part:
        """The first program of a user: one motor at the platform's serial port. Parsed, not typed."""
        return next(_read([library.first_motor(platform, drive)]))

    def motors(self, platform: str, drive: Drive) -> tuple[Part, Part]:
        """The first motor, and the same under the name of what is to become its ladder."""
        motor, name, other = self.motor(platform, drive), f"{drive.prefix}_Motor", f"{drive.prefix}_Ladder"
        return motor, Part(motor.folder, parse(motor.text.replace(name, other), motor.unit.path.replace(name, other)))

    def programs(self, platform: str, drive: Drive) -> tuple[Part, ...]:
        """The first motor, and what else a platform has for a drive that is a program of a user. Parsed, not typed."""
        return (self.motor(platform, drive), *_read(library.programs(platform, drive, list(self.languages))))


def shelf(files: Iterable[File], drives: dict[str, Drive], languages: list[Language]) -> Shelf:
    """Read the canonical files, in the order of their use, into a shelf."""
    parts = tuple(_read(files))
    check([part.unit for part in parts])
    return Shelf(parts, drives, tuple(languages))


def _read(files: Iterable[File]) -> Iterator[Part]:
    for file in files:
        yield Part(file.folder, parse(file.text, file.path))
