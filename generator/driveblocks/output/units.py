"""What is tested together, made in memory; apart from what builds a folder, which takes long to import."""

from collections.abc import Iterator, Sequence

from driveblocks.bench.runner import Tell
from driveblocks.bench.suite import drive_suite, shared_suite
from driveblocks.bench.unit import Unit
from driveblocks.maps.collection import Source
from driveblocks.platforms import CANONICAL
from driveblocks.render import library
from driveblocks.render.text import Language
from structured_text.engines.engine import Source as Text

OTHERS = tuple(
    f"/MB_{line}{slots}.st" for line in ("Line", "ByteLine") for slots in library.LINE_SIZES if slots != library.USUAL
)
"""Shared blocks that no test of a drive needs: their statements are those of the line for 8 drives."""
MAKING = "making the programs"


def units(sources: Sequence[Source], languages: list[Language], tell: Tell = lambda *_: None) -> list[Unit]:
    """The shared blocks, then each drive with the shared blocks that it needs. Raises ValueError, as rendering does."""
    tell(0, len(sources) + 1, MAKING)
    generic = tuple(_sources(library.generic(languages)))
    made = [Unit(shared_suite(languages), generic)]
    needed = tuple(block for block in generic if not block.path.endswith(OTHERS))
    for at, source in enumerate(sources, 1):
        tell(at, len(sources) + 1, MAKING)
        own = _sources(library.drive(source.path.stem, source.drive, languages))
        made.append(Unit(drive_suite(source, languages), (*needed, *own)))
    return made


def _sources(files: Iterator[library.File]) -> Iterator[Text]:
    for file in files:
        yield Text(f"{CANONICAL}/{file.path}", file.text)
