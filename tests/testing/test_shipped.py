"""The programs of the shipped maps, all run once, on the engine that counts: they are green, reach every reason, and
every line and outcome of a decision of the blocks, but for what is explained.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest
from tests import shipped
from tests.blocks.library import BLOCKS

from driveblocks.bench import runner
from driveblocks.bench.coverage import Coverage, exemptions
from driveblocks.bench.outcome import Run
from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.unit import Unit
from driveblocks.maps import collection
from driveblocks.output.units import units
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedInstance, EmbeddedLibrary
from structured_text.engines.engine import Value

FOURTH = sorted((Path(__file__).parents[1] / "blocks/fourth_drive").glob("*.yaml"))
TWINS = {f"line/MB_{line}{slots}.st" for line in ("ByteLine", "Line") for slots in (2, 32)}
"""The line for 32 drives has the statements of that for 8."""
PARTS = ("Drive", "Identity", "Orders", "ParameterGate", "Reads")
"""What a drive block of a family is made of."""
IN_TIME = (
    *(f"line/{path.name}" for path in sorted((BLOCKS / "line").glob("*.st"))),
    *(f"vfd/{path.name}" for path in sorted((BLOCKS / "vfd").glob("*.st")) if "Text" not in path.name),
    *(f"{family}_{part}.st" for family in ("invt_chf/CHF", "jscc/JSCC", "shuen_sn300g5/SN300G5") for part in PARTS),
)
"""What runs in time: scenes reach most of it, tests/line and tests/drives the rest."""
ELSEWHERE = ("/MB_Device.st", "/MB_Float.st")
"""What only scenes of a meter call: tests/line reaches all of it."""
MOST_LINES, MOST_BRANCHES = 93.0, 88.0
"""What the scenes of the shipped maps reach of that, at least."""

Record = Callable[[str, object], None]
Seen = dict[str, set[Value]]
"""Program -> each Reason that its drive block has shown at the end of a scan."""


def noting(seen: Seen) -> Callable[[EmbeddedLibrary, str], EmbeddedInstance]:
    """How instances are made, of which every scan notes the Reason."""
    plain = EmbeddedLibrary.instance

    def instance(library: EmbeddedLibrary, name: str) -> EmbeddedInstance:
        made = plain(library, name)
        scan, reasons = made.scan, seen.setdefault(name, set())

        def noted(now_ns: int | None = None) -> None:
            scan(now_ns)
            reasons.add(made["Motor.Reason"])

        with suppress(KeyError):  # not every program has a drive block
            made["Motor.Reason"]
            made.scan = noted
        return made

    return instance


def covered(made: list[Unit]) -> tuple[Coverage, Run]:
    """What the programs of some units have run on the embedded engine, and what came of it."""
    measured = Coverage("embedded")
    return measured, runner.run(made, [EmbeddedEngine(coverage=True)], coverage=[measured])


def assert_green(done: Run) -> None:
    """No check of a run is red, or lost."""
    assert [(result.program, outcome.words, outcome.message) for result in done.results for outcome in result.bad] == []
    assert done.passed


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
def seen() -> Seen:
    """Filled by `whole`."""
    return {}


@pytest.fixture(scope="module")
def whole(seen: Seen) -> tuple[Coverage, Run]:
    """What the programs of the shipped maps have run, and what came of it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(EmbeddedLibrary, "instance", noting(seen))
        return covered(shipped.units())


@pytest.mark.parametrize(
    "stem",
    [  # by default the family with the most: a path of states
        pytest.param(each.path.stem, marks=() if each.drive.prefix == "ATV312" else pytest.mark.thorough)
        for each in shipped.sources()
    ],
)
def test_the_programs_of_a_family_are_green(stem: str) -> None:
    assert_green(runner.run([each for each in shipped.units() if each.suite.name == stem], [EmbeddedEngine()]))


@pytest.mark.thorough
def test_they_are_green(whole: tuple[Coverage, Run]) -> None:
    assert_green(whole[1])
    assert {result.unit for result in whole[1].results} == {"modbus", *(each.path.stem for each in shipped.sources())}


@pytest.mark.thorough
@pytest.mark.parametrize("stem", [each.path.stem for each in shipped.sources()])
@pytest.mark.usefixtures("whole")
def test_every_reason_is_reached_or_it_is_said_why_not(seen: Seen, stem: str) -> None:
    suite = next(unit.suite for unit in shipped.units() if unit.suite.name == stem)
    reached = set().union(*(seen[program.name] for program in suite.programs))
    names = {name for name, number in REASONS.items() if number in reached}
    assert names == REASONS.keys() - suite.unreached.keys()


@pytest.mark.thorough
def test_the_programs_of_the_shipped_maps_reach_all_that_does_not_run_in_time(
    whole: tuple[Coverage, Run], record_property: Record
) -> None:
    """Prints a line below the results; an explanation that no longer holds is as wrong as a line that never ran."""
    measured, _ = whole
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


@pytest.mark.thorough
def test_the_scenes_of_the_shipped_maps_reach_most_of_the_line_and_the_drive_blocks(
    whole: tuple[Coverage, Run],
) -> None:
    measured, _ = whole
    figures = [measured.count(path) for path in measured.texts if timed(path)]
    lines = sum(each.lines for each in figures), sum(len(each.missed_lines) for each in figures)
    branches = sum(each.branches for each in figures), sum(len(each.missed_branches) for each in figures)
    assert 100.0 * (1 - lines[1] / lines[0]) >= MOST_LINES, lines
    assert 100.0 * (1 - branches[1] / branches[0]) >= MOST_BRANCHES, branches


@pytest.mark.thorough
def test_the_programs_of_drives_that_only_maps_describe_do_and_are_green() -> None:
    """Scenes run without counters: what they reach runs in time."""
    made = units(collection.read(FOURTH), shipped.BOTH)
    measured, done = covered([some(unit, scenes=False) for unit in made])
    assert_green(done)
    assert unexplained(measured) == []
    assert_green(runner.run([some(unit, scenes=True) for unit in made], [EmbeddedEngine()]))


def some(unit: Unit, *, scenes: bool) -> Unit:
    """A unit with those of its programs that are scenes, or with the others."""
    chosen = [each for each in unit.suite.programs if any(check.scene for check in each.checks) is scenes]
    return replace(unit, suite=replace(unit.suite, programs=tuple(chosen)))
