"""The files of a plant for a platform: the library that it needs, and its program in the layer `yours`."""

from collections.abc import Sequence
from importlib import import_module

from driveblocks.maps.collection import Source
from driveblocks.plant import program
from driveblocks.plant.model import Plant
from driveblocks.platforms import CANONICAL, EXPORTS
from driveblocks.platforms.openplc import writer as plain
from driveblocks.platforms.part import YOURS, Own, Part, Shelf, shelf
from driveblocks.platforms.writers import writer
from driveblocks.render import library
from driveblocks.render.library import CHINESE, FRAMES, LINE_SIZES, METER, PARAMETERS
from driveblocks.render.text import Language, told
from structured_text.language.parser import parse

TEXT = "text"
TARGETS = (*(name for name in EXPORTS), TEXT)
"""What a plant is written for; `text` has the bytes of its lines, for any port."""
LADDERS = ("codesys", "beremiz")
"""Where a ladder can be written in a file."""
PORTS = {"openplc": "linux", "beremiz": "linux", TEXT: CANONICAL}
"""The port of a platform, where it is not its own."""
DECLARED = ("openplc", "twincat", TEXT)
"""Where declarations are text, so that the user's own have a place in it."""


def files(plant: Plant, target: str, languages: Sequence[Language]) -> dict[str, str]:
    """Path below the folder of the plant -> text. Raises Refused, and ExportError for what a platform cannot say."""
    stock = stocked(plant, languages)
    own = _own(plant, target)
    if target == TEXT:
        return plain.library(stock) | {f"{YOURS}/{one.name}.st": one.text for one in own.texts}
    made = {path: text for path, text in writer(target)(stock).items() if _is_library(path)}
    written: dict[str, str] = import_module(f"driveblocks.platforms.{target}.writer").own(stock, own)
    return made | written


def codes(plant: Plant) -> list[str]:
    """The languages of the texts of its blocks: English, and the second one where blocks have it."""
    return ["en", *(["zh"] if plant.language == "zh" else [])]


def _is_library(path: str) -> bool:
    return path.startswith(("shared/", "families/")) or path == "Port.md"


def stocked(plant: Plant, languages: Sequence[Language]) -> Shelf:
    """The library that a plant needs."""
    sources = {each.path.resolve(): Source(each.path, told(each.map, [*languages])) for each in plant.drives.values()}
    ordered = sorted(sources.values(), key=lambda one: one.path.stem)
    made = [*library.generic([*languages])]
    for each in ordered:
        made += library.drive(each.path.stem, each.drive, [*languages])
    unneeded = _unneeded(plant)
    kept = [each for each in made if each.extra not in unneeded]
    return shelf(kept, {each.path.stem: each.drive for each in ordered}, [*languages])


def _unneeded(plant: Plant) -> set[str]:
    """Extras of the library that the program does not call."""
    sizes = {program.bus(plant, each).slots for each in plant.lines}
    lines = {extra for slots, extra in LINE_SIZES.items() if extra and slots not in sizes}
    return {
        *lines,
        FRAMES,
        *(() if plant.meters else (METER, PARAMETERS)),
        *(() if plant.language == "zh" else (CHINESE,)),
    }


def _own(plant: Plant, target: str) -> Own:
    platform, name = PORTS.get(target, target), plant.program
    texts = (_part(platform, program.source(plant, platform, own=target in DECLARED)),)
    ladders = (_part(platform, program.source(plant, platform, own=False, name=f"{name}_Ladder")),)
    return Own(texts, ladders if target in LADDERS else (), tuple(plant.lines), plant.scan_ms)


def _part(platform: str, text: str) -> Part:
    return Part(platform, parse(text, f"{platform}/Plant.st"))
