"""Rules across a map: facts that contradict each other, or that lack their proof."""

from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import line, operation, parameter, record, register, vector


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the map breaks, in every part of it."""
    for part in (register, parameter, line, operation, vector, record):
        part.check(drive, report)
