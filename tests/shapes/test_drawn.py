"""Maps drawn at random are good, and so are the lives of some of them; tests/shapes/life.py judges many."""

from dataclasses import replace

import pytest
from tests.shapes import life

from driveblocks.bench import runner
from driveblocks.output.units import units
from structured_text.engines.embedded.engine import EmbeddedEngine

FEW = range(12)


def test_a_map_drawn_at_random_is_good() -> None:
    assert len(life.made(FEW)) == len(FEW)


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["0", "45", "60"])
def test_its_drive_lives(name: str) -> None:
    assert life.judge(name).told == []


@pytest.mark.thorough
@pytest.mark.parametrize(("seed", "program"), [
    (280, "MotorStart"),  # a jog has a stop of its own, and the proof is three reads
    (115, "MotorExact"),  # its measures are in two reads
    (205, "MotorSlot"),  # it is ready late
    (196, "MotorSlot"),  # a command of several writes keeps bits
    (209, "MotorSlot"),  # the line learns in the scan in which it is ready
    (122, "MotorSilence"),  # it refuses a stop more than 4 s after the last one
])  # fmt: skip
def test_a_program_passes_for_a_drive_that_is_slow_or_rare(seed: int, program: str) -> None:
    unit = units(life.made([seed]), life.ENGLISH)[1]
    programs = tuple(one for one in unit.suite.programs if one.name.endswith(program))
    unit = replace(unit, suite=replace(unit.suite, programs=programs))
    assert [one.bad for one in runner.run([unit], [EmbeddedEngine()]).results if one.bad] == []


@pytest.mark.thorough
@pytest.mark.parametrize("name", ["1", "2", "3", "4"])
def test_a_drive_that_is_not_as_its_map_says_is_found(name: str) -> None:
    assert life.lie(name).told == []
