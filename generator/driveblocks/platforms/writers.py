"""The files of the platforms that can be built beside the canonical text."""

from collections.abc import Callable, Collection
from importlib import import_module

from driveblocks.platforms import EXPORTS
from driveblocks.platforms.part import Shelf
from driveblocks.platforms.problem import ExportError
from structured_text.language.problems import Problem

Writer = Callable[[Shelf], dict[str, str]]
"""From a shelf to every file of a platform: path below its folder, `shared/DriveBlocks.xml` -> text.

A text is written in UTF-8 as it is: with the line ends and the byte order mark that the writer gave it.
"""


def writer(platform: str) -> Writer:
    made: Writer = import_module(f"driveblocks.platforms.{platform}.writer").write
    return made


def files(shelf: Shelf, targets: Collection[str], tell: Callable[[str], None] = lambda _: None) -> dict[str, str]:
    """The files of some platforms, by their paths; `tell` is called with the name of each.

    Raises ExportError with everything that they cannot say.
    """
    made: dict[str, str] = {}
    problems: list[Problem] = []
    for target in (each for each in EXPORTS if each in targets):
        tell(target)
        try:
            made |= {f"{target}/{path}": text for path, text in writer(target)(shelf).items()}
        except ExportError as error:
            problems += error.problems
    if problems:
        raise ExportError(problems)
    return made
