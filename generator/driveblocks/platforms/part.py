"""What writers of every platform get: the library in volumes of parts, each a type, function or block with its tree."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from driveblocks.maps.model import Drive
from driveblocks.platforms import port
from driveblocks.render.library import EXTRAS, File
from driveblocks.render.text import Language
from structured_text.language.checker import check
from structured_text.language.fingerprint import body, stream
from structured_text.language.parser import parse
from structured_text.language.tree import Function, FunctionBlock, Program, TypeDecl, Unit

_PRAGMA = re.compile(r"\{\{.*?\}\}", re.DOTALL)
"""C in ST, as matiec takes it."""
Declared = TypeDecl | Function | FunctionBlock | Program
SHARED = "DriveBlocks"
"""Name of what all families share."""


@dataclass(frozen=True)
class Part:
    """One type, function, block or program. `unit` is the tree of its file, which declares nothing else.

    The tree of a part of the library is typed. One of an adapter is parsed only: it names what a platform brings.
    """

    folder: str
    unit: Unit = field(repr=False)
    extra: str = ""
    """The extra that it belongs to, if to one."""
    source: str = field(default="", repr=False)
    """The text, where it holds C in a pragma, which the tree leaves out."""

    @cached_property
    def element(self) -> Declared:
        return next(each for each in self.unit.elements if isinstance(each, Declared))

    @property
    def name(self) -> str:
        """`MB_Line8`."""
        return self.element.name

    @property
    def text(self) -> str:
        return self.source or self.unit.text

    @property
    def head(self) -> str:
        """The comment at the top, without its marks."""
        return self.unit.comments[0].text

    @cached_property
    def body(self) -> str:
        """What follows the last END_VAR, as written; empty for a type."""
        plain = body(self.unit.text)
        start = self.unit.text.index(plain, self.element.at)
        return self.text[start : start + len(plain)].strip("\n")

    @cached_property
    def declaration(self) -> str:
        """From FUNCTION, FUNCTION_BLOCK or PROGRAM to the last END_VAR, as written. Not for types."""
        start = self.element.at
        return self.text[start : self.unit.text.index(body(self.unit.text), start)].rstrip()

    @cached_property
    def tokens(self) -> tuple[str, ...]:
        """The tokens of its body, see `fingerprint`."""
        return stream(self.body)


@dataclass(frozen=True)
class Volume:
    """What makes one file on a platform, in the order of its use: of what all families share, or of a family.

    `extra` is what a first motor does not need: `DriveBlocks_Line32` is an extra of `DriveBlocks`.
    """

    base: str
    extra: str
    parts: tuple[Part, ...]
    drive: Drive | None = None

    @property
    def name(self) -> str:
        """`DriveBlocks`, `DriveBlocks_Line32`, `CHF`, `CHF_Chinese`."""
        return f"{self.base}_{self.extra}" if self.extra else self.base

    @property
    def layer(self) -> str:
        """The folder of the file: an update replaces the files of both."""
        return "families" if self.drive else "shared"

    @property
    def types(self) -> tuple[Part, ...]:
        return tuple(part for part in self.parts if isinstance(part.element, TypeDecl))

    @property
    def blocks(self) -> tuple[Part, ...]:
        return tuple(part for part in self.parts if not isinstance(part.element, TypeDecl))


@dataclass(frozen=True)
class Own:
    """Programs of a user's own: parsed, not typed."""

    texts: tuple[Part, ...]
    ladders: tuple[Part, ...]
    """What is to be drawn, where the platform has a form for it."""
    lines: tuple[str, ...]
    """Names of their serial lines."""
    scan_ms: int
    """The interval of the task of the first."""


YOURS = "yours"
"""The folder of what is the user's: no update touches it."""


@dataclass(frozen=True)
class Shelf:
    """All that was built: the parts in the order of their use, and the drives by the folder of their parts."""

    parts: tuple[Part, ...]
    drives: dict[str, Drive]
    languages: tuple[Language, ...]

    def volumes(self) -> Iterator[Volume]:
        """What all families share, its extras, then each family with its own; each after what it uses."""
        shared = [part for part in self.parts if part.folder not in self.drives]
        yield from _volumes(SHARED, shared)
        for folder, drive in self.drives.items():
            yield from _volumes(drive.prefix, [part for part in self.parts if part.folder == folder], drive)

    def port(self, platform: str) -> tuple[Volume, ...]:
        """The blocks of a platform's serial port, with the lines that are here: parsed, not typed."""
        extras = {part.extra for part in self.parts} | {""}
        parts = [part for part in _read(port.adapter(platform, list(self.languages))) if part.extra in extras]
        return tuple(_volumes(parts[0].name, parts)) if parts else ()

    def motor(self, platform: str, drive: Drive) -> Part:
        """The first program of a user: one motor at the platform's serial port. Parsed, not typed."""
        return next(_read([port.first_motor(platform, drive)]))

    def motors(self, platform: str, drive: Drive) -> tuple[Part, Part]:
        """The first motor, and the same under the name of what is to become its ladder."""
        motor, name, other = self.motor(platform, drive), f"{drive.prefix}_Motor", f"{drive.prefix}_Ladder"
        return motor, Part(motor.folder, parse(motor.text.replace(name, other), motor.unit.path.replace(name, other)))

    def masters(self, platform: str, values: Callable[[Drive], dict[str, object]]) -> dict[str, Part]:
        """By prefix, a program for a platform whose PLC is itself the master and owns the frames, where that will do.

        `values` is what the platform's template prints of a drive. Parsed, not typed.
        """
        drives = filter(port.by_words, self.drives.values())
        files = {one.prefix: port.master(platform, one, values(one), list(self.languages)) for one in drives}
        return {prefix: next(_read([file])) for prefix, file in files.items()}


def _volumes(base: str, parts: Sequence[Part], drive: Drive | None = None) -> Iterator[Volume]:
    for extra in ("", *EXTRAS):
        own = tuple(part for part in parts if part.extra == extra)
        if own:
            yield Volume(base, extra, own, drive)


def shelf(files: Iterable[File], drives: dict[str, Drive], languages: list[Language]) -> Shelf:
    """Read the canonical files, in the order of their use, into a shelf."""
    parts = tuple(_read(files))
    check([part.unit for part in parts])
    return Shelf(parts, drives, tuple(languages))


def _read(files: Iterable[File]) -> Iterator[Part]:
    for file in files:
        plain = _PRAGMA.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), file.text)
        yield Part(file.folder, parse(plain, file.path), file.extra, file.text if plain != file.text else "")
