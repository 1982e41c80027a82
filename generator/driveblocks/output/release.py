"""One archive per platform: its files, its page, what that page leads to, and the licence.

`python -m driveblocks.output.release` makes them from blocks/ of the folder where it is run.
"""

import posixpath
import re
from collections.abc import Iterable
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from driveblocks import __version__
from driveblocks.export import CANONICAL, TARGETS
from driveblocks.output import manifest

BLOCKS, LICENCE, OUT = "blocks", "LICENSE", "dist"
BESIDE = {CANONICAL: ("linux",)}
"""Target -> folders that go with its own."""
DATE = (1980, 1, 1, 0, 0, 0)
"""Of every file: the same files make the same archive on every day."""
_LINK = re.compile(r"\]\((?!\w+:)([^)#\s]+)")


def release(root: Path, out: Path) -> list[Path]:
    """Write the archive of each target that was built into root/blocks; the archives. Raises Refused and OSError."""
    listed = manifest.read(root / BLOCKS).files
    made = []
    out.mkdir(parents=True, exist_ok=True)
    for target in TARGETS:
        folders = tuple(f"{folder}/" for folder in (target, *BESIDE.get(target, ())))
        own = [f"{BLOCKS}/{name}" for name in listed if name.startswith(folders)]
        page = f"{BLOCKS}/{target}/README.md"
        if own:
            foreign = tuple(f"{BLOCKS}/{other}/" for other in TARGETS if f"{other}/" not in folders)
            reached = _reached(root, page if page in own else f"{BLOCKS}/README.md", foreign)
            path = out / f"driveblocks-{__version__}-{target}.zip"
            _pack(path, root, {LICENCE, *own, *reached})
            made.append(path)
    return made


def _reached(root: Path, page: str, foreign: tuple[str, ...]) -> set[str]:
    """A page and the files that it links to, and those that these link to, as paths from the root.

    The page of another platform is taken along, since the drives' pages name it, but not what that leads to.
    """
    found: set[str] = set()
    waiting = [page]
    while waiting:
        name = waiting.pop()
        if name in found or not (root / name).is_file():
            continue
        found.add(name)
        if name.endswith(".md") and not name.startswith(foreign):
            links = _LINK.findall((root / name).read_text(encoding="utf-8"))
            waiting += [posixpath.normpath(posixpath.join(posixpath.dirname(name), link)) for link in links]
    return found


def _pack(path: Path, root: Path, names: Iterable[str]) -> None:
    """Write an archive whose bytes depend on names and contents alone."""
    with ZipFile(path, "w") as archive:
        for name in sorted(names):
            entry = ZipInfo(f"{path.stem}/{name}", DATE)
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            archive.writestr(entry, (root / name).read_bytes(), ZIP_DEFLATED, 9)


if __name__ == "__main__":
    for archive in release(Path(), Path(OUT)):
        print(f"{archive}: {archive.stat().st_size // 1024} KiB")
