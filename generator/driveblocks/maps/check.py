"""Rules across a map: facts that contradict each other, or that lack their proof."""

from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import (
    area,
    command,
    condition,
    fault,
    identifier,
    identity,
    line,
    name,
    never,
    operation,
    parameter,
    reading,
    record,
    register,
    setting,
    space,
    standstill,
    vector,
    watchdog,
)

_PARTS = (
    *(register, name, identifier, parameter, area, line, setting),
    *(command, never, operation, space, standstill, condition, identity, watchdog, fault, vector, record, reading),
)


def check(drive: Drive, report: Report) -> None:
    for part in _PARTS:
        part.check(drive, report)
