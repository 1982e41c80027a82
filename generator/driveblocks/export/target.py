"""The writer of each target that can be built beside the canonical text."""

from collections.abc import Callable, Collection

from driveblocks.export import codesys, openplc, plcopen, twincat
from driveblocks.export.part import Shelf
from driveblocks.export.problem import ExportError
from driveblocks.export.siemens import library as siemens
from structured_text.language.problems import Problem

Writer = Callable[[Shelf], dict[str, str]]
"""From a shelf to every file of a target: path below the output folder, `twincat/CHF.plcproj`, -> text.

A text is written in UTF-8 as it is: with the line ends and the byte order mark that the writer gave it.
"""
WRITERS: dict[str, Writer] = {
    "openplc": openplc.files,
    "plcopen": plcopen.write,
    "codesys": codesys.write,
    "twincat": twincat.files,
    "siemens": siemens.files,
}


def files(shelf: Shelf, targets: Collection[str]) -> dict[str, str]:
    """The files of some targets. Raises ExportError with everything that they cannot say."""
    made: dict[str, str] = {}
    problems: list[Problem] = []
    for writer in (writer for target, writer in WRITERS.items() if target in targets):
        try:
            made |= writer(shelf)
        except ExportError as error:
            problems += error.problems
    if problems:
        raise ExportError(problems)
    return made
