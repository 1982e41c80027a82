"""The shipped library as writers get it, and its canonical texts as they are checked in."""

import functools
import re
from collections.abc import Iterable
from dataclasses import dataclass

from tests.blocks import library as blocks
from tests.shipped import BOTH, sources

from driveblocks.platforms.part import Shelf, shelf
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


EXTRAS = {
    "Line2": {"MB_Line2", "MB_ByteLine2", "MB_Slots2", "MB_Tracks2"},
    "Line32": {"MB_Line32", "MB_ByteLine32", "MB_Slots32", "MB_Tracks32"},
    "Parameters": {"VFD_ReadParameter", "VFD_WriteParameter", "VFD_Store"},
    "Meter": {"MB_Device", "MB_Float"},
    "Plant": {
        "VFD_Counted", "VFD_Member", "VFD_Members", "VFD_Hours", "VFD_Scale", "VFD_Place", "VFD_Group", "VFD_Duty",
    },
    "Frames": {"MB_Chars", "MB_Words", "MB_Registers", "MB_Request"},
    "Chinese": set[str](),
}  # fmt: skip
"""What a user of a small PLC leaves out, in the order of the files; to Frames belong blocks of `modbus`, too."""
KEPT = {"MB_HexDigit", "MB_HexValue", "MB_ResultTextEn"}
"""Of the folder `modbus`: the line uses two, and texts in English are for everybody."""


def extra(folder: str, name: str) -> str:
    """The extra that a block is of, as the pages say it; empty: a first motor needs it, or it is a text in English."""
    if name.endswith(("Zh", "ZhW")):
        return "Chinese"
    if (size := re.search(r"Line(2|32)$", name)) is not None:
        return size[0]
    if name.endswith(("_Request", "_Reply")) and folder != "types":
        return "Frames"
    found = next((each for each, names in EXTRAS.items() if name in names), "")
    return found or ("Frames" if folder == "modbus" and name not in KEPT else "")


def volumes(shelf: Shelf, parts: Iterable[tuple[str, str, str]], base: str = "DriveBlocks") -> dict[str, list[str]]:
    """File -> the texts in it, of folder, name and text of each part: what is shared, then each family."""
    found: dict[str, list[str]] = {}
    rows = list(parts)
    prefixes = {folder: drive.prefix for folder, drive in shelf.drives.items()}
    for prefix in (base, *prefixes.values()):
        for each in ("", *EXTRAS):
            name = f"{prefix}_{each}" if each else prefix
            texts = [row[2] for row in rows if (prefixes.get(row[0], base), extra(*row[:2])) == (prefix, each)]
            found |= {f"{'shared' if prefix == base else 'families'}/{name}": texts} if texts else {}
    return found


@functools.cache
def canon() -> dict[str, Canon]:
    """Every part of the library by its name, in the order of use."""
    made = {}
    for source in blocks.sources():
        folder, _, name = source.path.removesuffix(".st").partition("/")
        made[name] = Canon(folder, name, source.text)
    return made
