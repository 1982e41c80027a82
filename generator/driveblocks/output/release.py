"""Archives to download: for each platform one of all families, and one of each family with a page of its own."""

from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from driveblocks import __version__
from driveblocks.maps.collection import Source
from driveblocks.output import links
from driveblocks.output.build import files
from driveblocks.platforms import CANONICAL, TARGETS
from driveblocks.render.library import FRAMES
from driveblocks.render.text import Language, languages
from structured_text import files as door

BLOCKS, LICENCE = "blocks", "LICENSE"
DATE = (1980, 1, 1, 0, 0, 0)
"""Of every file: the same files make the same archive on every day."""


def release(root: Path, out: Path, sources: Sequence[Source], targets: Sequence[str] = TARGETS) -> list[Path]:
    """Write the archives of some platforms; `root` is the checkout, whose pages and licence go with them.

    Raises ExportError and OSError.
    """
    both = languages(["en", "zh"], "utf-8")
    out.mkdir(parents=True, exist_ok=True)
    made = []
    for target in targets:
        for name, some in {target: list(sources), **{f"{target}-{one.drive.prefix}": [one] for one in sources}}.items():
            path = out / f"driveblocks-{__version__}-{name}.zip"
            door.put(path, _packed(contents(root, some, target, both)))
            made.append(path)
    return made


def contents(root: Path, sources: list[Source], target: str, both: list[Language]) -> dict[str, str]:
    """The files of an archive by their paths: what is built for a platform, pages, the licence.

    That of one family leaves out the frames without a line, and pages that only others lead to.
    """
    without = () if target == CANONICAL or len(sources) > 1 else (FRAMES,)
    made = files(sources, both, (target,), without=without)
    built = {f"{BLOCKS}/{name}": text for name, text in made.items()}
    own = {name: text for name, text in built.items() if name.startswith((f"{BLOCKS}/{target}/", f"{BLOCKS}/docs/"))}
    page = f"{BLOCKS}/README.md" if target == CANONICAL else f"{BLOCKS}/{target}/README.md"
    own[page] = built[page]
    leading = own if not without else {name: own[name] for name in own if name.startswith(f"{BLOCKS}/{target}/")}
    for link in sorted({link for name in leading if name.endswith(".md") for link in links.targets(name, own[name])}):
        beside = root / link
        if link.startswith("docs/") and beside.suffix == ".md" and beside.is_file():
            own[link] = door.text(beside)
    pages = {name: links.live(name, text, own.__contains__) for name, text in own.items() if name.endswith(".md")}
    return own | pages | {LICENCE: door.text(root / LICENCE)}


def _packed(texts: Mapping[str, str]) -> bytes:
    """An archive whose bytes depend on names and contents alone."""
    with BytesIO() as made, ZipFile(made, "w") as archive:
        for name in sorted(texts):
            entry = ZipInfo(f"driveblocks/{name}", DATE)
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            archive.writestr(entry, texts[name].encode(), ZIP_DEFLATED, 9)
        archive.close()
        return made.getvalue()
