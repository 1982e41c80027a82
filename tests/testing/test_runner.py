"""Whole runs: every unit on every engine, all green for the maps as they are, with or without vectors."""

import gc
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest
from tests.shipped import BOTH

from driveblocks.bench import page, runner
from driveblocks.bench.outcome import Outcome, Run
from driveblocks.bench.unit import Unit
from driveblocks.maps import collection
from driveblocks.maps.page import skeleton
from driveblocks.maps.view import UNPROVED
from driveblocks.output.units import units
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, EngineError, Library, Source

from .conftest import EXAMPLE, only, run

FAR_REPLY = "FA 03 02 13 88 50 C6"


def test_the_example_is_green_on_every_engine(engine: Engine, example: Unit) -> None:
    done = runner.run([example], [engine])
    assert [(result.program, outcome.words, outcome.message) for result in done.results for outcome in result.bad] == []
    assert {result.engine for result in done.results} == {engine.name}
    assert done.count() == 2 + sum(len(program.checks) for program in example.suite.programs)


def test_results_come_in_the_order_of_engines_units_and_programs(example: Unit, shared: Unit) -> None:
    class Second(EmbeddedEngine):
        name = "second"

    given = [only(shared, "Digits", "RtuSeal"), only(example, "Scales", "0010H")]
    done = runner.run(given, [EmbeddedEngine(), Second()])
    assert [(result.engine, result.unit, result.program) for result in done.results] == [
        (engine, unit, program)
        for engine in ("embedded", "second")
        for unit, program in (
            ("modbus", "build"),
            ("modbus", "MB_TestDigits"),
            ("modbus", "MB_TestRtuSeal"),
            ("example", "build"),
            ("example", "EX100_Test0010H"),
            ("example", "EX100_TestScales"),
        )
    ]


def plain(done: Run) -> list[tuple[str, str, tuple[Outcome, ...]]]:
    return [(each.unit, each.program, each.outcomes) for each in done.results]


def test_processes_side_by_side_find_what_one_finds(
    example: Unit, shared: Unit, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = [only(shared, "Digits", "RtuSeal"), only(example, "Scales", "0010H", "Frames")]
    bad = [replace(unit, blocks=(*unit.blocks, Source("bad.st", "FUNCTION_BLOCK Bad\n"))) for unit in given]
    for units_ in (given, bad):
        alone = runner.run(units_, [EmbeddedEngine()])
        assert plain(runner.run(units_, [EmbeddedEngine()], jobs=3)) == plain(alone)
    assert [each.program for each in alone.results] == ["build", "build"]

    class Killed(ProcessPoolExecutor):
        def map(self, *_: object, **__: object) -> NoReturn:
            raise BrokenProcessPool

    monkeypatch.setattr(runner, "ProcessPoolExecutor", Killed)
    assert plain(runner.run(bad, [EmbeddedEngine()], jobs=2)) == plain(alone)


def test_a_map_without_vectors_passes_and_says_what_its_tests_rest_on() -> None:
    (source,) = collection.read([EXAMPLE])
    bare = collection.Source(source.path, replace(source.drive, frames=()))
    _, unit = units([bare], BOTH)
    done = run(only(unit, "Scales"))
    assert done.passed
    assert UNPROVED in [outcome.words for outcome in done.results[0].outcomes]
    assert f"{UNPROVED[1:]}." in page.table(unit.suite)


def test_unit_addresses_that_the_standard_reserves_are_sent_where_the_manual_has_them(tmp_path: Path) -> None:
    text = skeleton().replace("max: 247,", "max: 250, above_247: section 1,").replace("unit: 1,", "unit: 250,")
    for frame, far in (("01 03 20 01 00 01 DE 0A", "FA 03 20 01 00 01 CB 81"), ("01 03 02 13 88 B5 12", FAR_REPLY)):
        text = text.replace(frame, far)
    path = tmp_path / "far.yaml"
    path.write_text(text, encoding="utf-8")
    (unit,) = units(collection.read([path]), BOTH)[1:]
    done = run(only(unit, "Frames", "Request"))
    assert [outcome.message for result in done.results for outcome in result.bad] == []
    assert {result.program for result in done.results} >= {"ACME_TestFrames", "ACME_TestRequest1"}


def test_an_engine_that_breaks_down_is_reported_and_the_others_go_on(example: Unit) -> None:
    class Broken:
        name = "broken"

        def build(self, sources: Sequence[Source]) -> Library:
            raise EngineError(f"the compiler crashed on {len(sources)} files")

    done = runner.run([only(example, "Scales")], [Broken(), EmbeddedEngine()])
    assert [(result.engine, result.program, result.passed) for result in done.results] == [
        ("broken", "build", False),
        ("embedded", "build", True),
        ("embedded", "EX100_TestScales", True),
    ]
    assert "the compiler crashed" in done.results[0].bad[0].message


@pytest.mark.parametrize("enabled", [True, False])
def test_garbage_is_collected_afterwards_as_before(example: Unit, enabled: bool) -> None:
    was = gc.isenabled()
    try:
        (gc.enable if enabled else gc.disable)()
        run(only(example, "Scales"))
        assert gc.isenabled() is enabled
    finally:
        (gc.enable if was else gc.disable)()


@pytest.mark.parametrize("jobs", [1, 2])
def test_it_says_how_far_compiling_and_running_have_come(
    jobs: int, example: Unit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "LOOK_S", 0.0)
    told: list[tuple[float, float, str]] = []
    given = [only(example, "Scales", "0010H"), only(example, "Frames")]
    runner.run(given, [EmbeddedEngine()], jobs=jobs, tell=lambda *each: told.append(each))
    come = [done for done, _, _ in told]
    assert (come[0], come == sorted(come), {total for _, total, _ in told}) == (0, True, {2 * jobs})
    assert jobs < come[-1] <= 2 * jobs
    assert any(0 < done < jobs and "compiling" in text for done, _, text in told)
