"""The generated programs reach every line and every outcome of a decision of the blocks, but for what is explained."""

from collections.abc import Callable
from pathlib import Path

from tests.blocks.library import BLOCKS

from driveblocks.building.build import units
from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.maps import catalog, collection
from driveblocks.render.text import languages
from driveblocks.testing import runner
from driveblocks.testing.coverage import Coverage, exemptions

FOURTH = sorted((Path(__file__).parent / "fourth_drive").glob("*.yaml"))
BOTH = languages(["en", "zh"], "utf-8")
IN_TIME = (
    *(f"line/{path.name}" for path in sorted((BLOCKS / "line").glob("*.st"))),
    *(f"vfd/{path.name}" for path in sorted((BLOCKS / "vfd").glob("*.st")) if "Text" not in path.name),
    *(
        f"{family}_{part}.st"
        for family in ("invt_chf/CHF", "jscc/JSCC", "shuen_sn300g5/SN300G5")
        for part in ("Drive", "Orders", "ParameterGate", "Reads")
    ),
)
"""What runs in time alone: tests/line and tests/drives reach it."""

Record = Callable[[str, object], None]


def covered(maps: list[Path]) -> Coverage:
    """What the programs of some maps have run on the embedded engine, all green."""
    measured = Coverage("embedded")
    done = runner.run(units(collection.read(maps), BOTH), [EmbeddedEngine(coverage=True)], coverage=[measured])
    assert [(result.program, outcome.words, outcome.message) for result in done.results for outcome in result.bad] == []
    assert done.passed
    return measured


def unexplained(measured: Coverage) -> list[str]:
    """What never ran or came about, without a reason."""
    return [str(each) for each in measured.misses if not each.why]


def test_the_programs_of_the_shipped_maps_reach_all_of_the_library(record_property: Record) -> None:
    """Prints a line below the results; an explanation that no longer holds is as wrong as a line that never ran."""
    measured = covered(list(catalog.shipped()))
    record_property("summary", f"ST coverage of blocks/iec61131: {measured.count()}")
    assert unexplained(measured) == []
    files = set((BLOCKS / "order.txt").read_text(encoding="utf-8").split())
    assert {path.partition("/")[2] for path in measured.uncounted} == set(IN_TIME)
    files -= set(IN_TIME)
    assert {path.partition("/")[2] for path in measured.texts} == files
    uncounted = files - {path.partition("/")[2] for path in measured.lines}
    assert {file.partition("/")[0] for file in uncounted} == {"types"}, "every file with statements is counted"
    reasons = {each.why for each in measured.misses}
    assert [each for each in exemptions() if each.why not in reasons] == []


def test_the_programs_of_drives_that_only_maps_describe_do_and_are_green() -> None:
    assert unexplained(covered(FOURTH)) == []
