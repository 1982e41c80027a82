"""What a command may pass through, against a walk over every content of two registers, one of which is the direction.

`check` reasons with bits that it knows and bits that it does not; the walk here tries all contents one by one.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

from tests.shapes import shapes

from driveblocks.maps.model import Command, Does, Drive, Step
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import path

DIRECTION, RUN = 0x1000, 0x1002
WRITES = tuple(product((DIRECTION, RUN), (0, 1)))
WAYS = [way for length in (1, 2) for way in product(WRITES, repeat=length)]

Write = tuple[int, int]


def command(does: Does, way: Sequence[Write]) -> Command:
    """A command that makes these writes."""
    *first, (register, value) = way
    steps = tuple(Step(register=each, value=word) for each, word in first)
    return Command(does=does, register=register, value=value, first=steps, source="")


def judged(drive: Drive, *commands: Command) -> bool:
    """Whether `check` lets a drive have these commands."""
    report = Report("")
    path.check(replace(drive, operation=replace(drive.operation, commands=commands)), report)
    return not report.problems


def walked(stop: Write, way: Sequence[Write], other: Sequence[Write]) -> bool:
    """Whether from no content a way passes through all that the other writes, by a write to one of its registers."""
    wanted = dict(other)
    for direction, run in product((0, 1), repeat=2):
        held = {DIRECTION: direction, RUN: run, stop[0]: stop[1]}
        for register, value in way:
            held[register] = value
            if register in wanted and all(held[each] == wanted[each] for each in wanted):
                return False
    return True


def test_every_way_is_judged_as_a_walk_over_all_contents_finds_it() -> None:
    drive = shapes()["two_registers"]
    good = 0
    for stop in (RUN, 0), (DIRECTION, 0):
        for forward, reverse in product(WAYS, repeat=2):
            found = walked(stop, forward, reverse) and walked(stop, reverse, forward)
            given = (command("run_forward", forward), command("run_reverse", reverse), command("stop", [stop]))
            assert judged(drive, *given) == found, (stop, forward, reverse)
            good += found
    assert 10 < good < len(WAYS) ** 2
