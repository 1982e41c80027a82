"""The shipped library as writers get it, and its canonical texts as they are checked in."""

import functools
from dataclasses import dataclass

from tests.blocks import library as blocks
from tests.shipped import BOTH, sources

from driveblocks.export.part import Shelf, shelf
from driveblocks.render import library
from driveblocks.render.library import File


@functools.cache
def made() -> Shelf:
    """All shipped families in both languages."""
    files: list[File] = [*library.generic(BOTH)]
    for source in sources():
        files.extend(library.drive(source.path.stem, source.drive, BOTH))
    return shelf(files, {source.path.stem: source.drive for source in sources()}, BOTH)


@dataclass(frozen=True)
class Canon:
    """A checked-in file, cut into what stands before its body, and its body."""

    folder: str
    name: str
    text: str

    @property
    def body(self) -> str:
        """From the line after the last END_VAR to the line before the end; empty for a type."""
        lines = self.text.split("\n")
        if "END_VAR" not in lines:
            return ""
        last = len(lines) - 1 - lines[::-1].index("END_VAR")
        end = next(at for at in range(last, len(lines)) if lines[at].startswith("END_") and at > last)
        return "\n".join(lines[last + 1 : end]).strip("\n")

    @property
    def before(self) -> str:
        """The head and the declaration; all of a type."""
        if not self.body:
            return self.text.rstrip("\n")
        return self.text[: self.text.index("END_VAR\n" + "\n" + self.body) + len("END_VAR")]


@functools.cache
def canon() -> dict[str, Canon]:
    """Every part of the library by its name, in the order of use."""
    made = {}
    for source in blocks.sources():
        folder, _, name = source.path.removesuffix(".st").partition("/")
        made[name] = Canon(folder, name, source.text)
    return made
