"""The generated programs reach every line and every outcome of a decision of the blocks, but for what is explained."""

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.blocks.library import BLOCKS

from driveblocks.building.units import units
from driveblocks.maps import catalog, collection
from driveblocks.render.text import languages
from driveblocks.testing import runner
from driveblocks.testing.coverage import Coverage, exemptions
from structured_text.engines.embedded import EmbeddedEngine

FOURTH = sorted((Path(__file__).parent / "fourth_drive").glob("*.yaml"))
BOTH = languages(["en", "zh"], "utf-8")
TWINS = {"line/MB_ByteLine32.st", "line/MB_Line32.st"}
"""The line for 32 drives has the statements of that for 8."""
PARTS = ("Drive", "Identity", "Orders", "ParameterGate", "Reads")
"""What a drive block of a family is made of."""
IN_TIME = (
    *(f"line/{path.name}" for path in sorted((BLOCKS / "line").glob("*.st"))),
    *(f"vfd/{path.name}" for path in sorted((BLOCKS / "vfd").glob("*.st")) if "Text" not in path.name),
    *(f"{family}_{part}.st" for family in ("invt_chf/CHF", "jscc/JSCC", "shuen_sn300g5/SN300G5") for part in PARTS),
)
"""What runs in time: scenes reach most of it, tests/line and tests/drives the rest."""
ELSEWHERE = "/MB_Device.st"
"""What has no program: tests/line reaches all of it."""
MOST_LINES, MOST_BRANCHES = 93.0, 88.0
"""What the scenes of the shipped maps reach of that, at least."""

Record = Callable[[str, object], None]


def covered(maps: list[Path]) -> Coverage:
    """What the programs of some maps have run on the embedded engine, all green."""
    measured = Coverage("embedded")
    done = runner.run(units(collection.read(maps), BOTH), [EmbeddedEngine(coverage=True)], coverage=[measured])
    assert [(result.program, outcome.words, outcome.message) for result in done.results for outcome in result.bad] == []
    assert done.passed
    return measured


def timed(path: str) -> bool:
    """Whether a block runs in time."""
    return path.partition("/")[2] in IN_TIME or path.endswith(tuple(f"_{part}.st" for part in PARTS))


def unexplained(measured: Coverage) -> list[str]:
    """What never ran or came about, without a reason, in blocks that do not run in time."""
    return [
        str(each)
        for each in measured.misses
        if not each.why and not timed(each.path) and not each.path.endswith(ELSEWHERE)
    ]


@pytest.fixture(scope="module")
def whole() -> Coverage:
    """What the programs of the shipped maps have run."""
    return covered(list(catalog.shipped()))


def test_the_programs_of_the_shipped_maps_reach_all_that_does_not_run_in_time(
    whole: Coverage, record_property: Record
) -> None:
    """Prints a line below the results; an explanation that no longer holds is as wrong as a line that never ran."""
    measured = whole
    record_property("summary", f"ST coverage of blocks/iec61131: {measured.count()}")
    assert unexplained(measured) == []
    files = set((BLOCKS / "order.txt").read_text(encoding="utf-8").split())
    assert {path.partition("/")[2] for path in measured.twins} == TWINS
    files -= TWINS
    assert {path.partition("/")[2] for path in measured.texts} == files
    uncounted = files - {path.partition("/")[2] for path in measured.lines}
    assert {file.partition("/")[0] for file in uncounted} == {"types"}, "every file with statements is counted"
    reasons = {each.why for each in measured.misses}
    assert [each for each in exemptions() if each.why not in reasons] == []


def test_the_scenes_of_the_shipped_maps_reach_most_of_the_line_and_the_drive_blocks(whole: Coverage) -> None:
    figures = [whole.count(path) for path in whole.texts if timed(path)]
    lines = sum(each.lines for each in figures), sum(len(each.missed_lines) for each in figures)
    branches = sum(each.branches for each in figures), sum(len(each.missed_branches) for each in figures)
    assert 100.0 * (1 - lines[1] / lines[0]) >= MOST_LINES, lines
    assert 100.0 * (1 - branches[1] / branches[0]) >= MOST_BRANCHES, branches


def test_the_programs_of_drives_that_only_maps_describe_do_and_are_green() -> None:
    assert unexplained(covered(FOURTH)) == []
