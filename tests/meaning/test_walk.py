"""What a command may pass through, against a walk over every content of two registers, one of which is the direction.

`check` reasons with bits that it knows and bits that it does not; the walk here tries all contents one by one.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

from tests.shapes import shapes

from driveblocks.maps.model import Command, Does, Drive, Step
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import word

DIRECTION, RUN = 0x1000, 0x1002
WRITES = tuple(product((DIRECTION, RUN), (0, 1)))
WAYS = [way for length in (1, 2, 3) for way in product(WRITES, repeat=length)]

Write = tuple[int, int]


def command(does: Does, way: Sequence[Write]) -> Command:
    """A command that makes these writes."""
    *first, (register, value) = way
    steps = tuple(Step(register=each, value=word) for each, word in first)
    return Command(does=does, register=register, value=value, first=steps, source="")


def judged(drive: Drive, one: Command) -> bool:
    """Whether `check` lets a drive have this command."""
    report = Report("")
    word.check(replace(drive, operation=replace(drive.operation, commands=(one,))), {one.does}, report)
    return not report.problems


def walked(does: Does, way: Sequence[Write]) -> bool:
    """Whether from every content a way does what it is called, and nothing else on the way."""
    right = {"run_forward": [0], "run_reverse": [1]}.get(does, [])
    for direction, run in product((0, 1), repeat=2):
        held = {DIRECTION: direction, RUN: run}
        turned = []
        for register, value in way:
            held[register] = value
            turned += [held[DIRECTION]] if register == RUN and value else []
        if turned != right or (does == "stop" and way[-1] != (RUN, 0)):
            return False
    return True


def test_every_way_is_judged_as_a_walk_over_all_contents_finds_it() -> None:
    drive = shapes()["two_registers"]
    good: dict[Does, int] = {"run_forward": 0, "run_reverse": 0, "stop": 0}
    for way, does in product(WAYS, good):
        # a direction that is written first counts only where the registers of commands include it
        one = command(does, way)
        if {DIRECTION, RUN} == {each.register for each in one.writes} or does == "stop":
            found = walked(does, way)
            assert judged(drive, one) == found, (does, way)
            good[does] += found
    assert min(good.values()) > 0
