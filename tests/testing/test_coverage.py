"""What is said to have run: sums over builds, what was missed and where, what is explained, what is required."""

from collections.abc import Mapping
from dataclasses import replace

import pytest

from driveblocks.bench import coverage, runner
from driveblocks.bench.coverage import Coverage, Exemption, counting, result
from driveblocks.bench.unit import Unit
from structured_text.engines.coverage import Branches, Lines, Outcome
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.engine import Engine, EngineError, Source
from structured_text.engines.matiec import Flags, MatiecEngine

from .conftest import only

TEXT = (
    "FUNCTION A : INT\nVAR_INPUT N : INT; END_VAR\n  IF N > 1 THEN\n    A := 1;\n    A := 2;\n  END_IF;\nEND_FUNCTION\n"
)
BLOCKS = [Source("iec61131/ex/A.st", TEXT)]
TRUE, FALSE = Outcome(3, 6, "IF TRUE"), Outcome(3, 6, "IF FALSE")


class Library:
    """A library whose counters say what the test says."""

    def __init__(self, lines: Mapping[int, int], branches: Mapping[Outcome, int]) -> None:
        self.lines, self.outcomes = dict(lines), dict(branches)

    def coverage(self) -> Lines:
        return {"iec61131/ex/A.st": self.lines, "tests/T.st": {1: 0}}

    def branches(self) -> Branches:
        return {"iec61131/ex/A.st": self.outcomes, "tests/T.st": {TRUE: 0}}


IDLE = Library({3: 4, 4: 0, 5: 0}, {TRUE: 0, FALSE: 4})
BUSY = Library({3: 2, 4: 2, 5: 2}, {TRUE: 2, FALSE: 0})


def measured(*libraries: Library) -> Coverage:
    found = Coverage("embedded")
    for library in libraries:
        found.add(BLOCKS, library)
    return found


def explain(monkeypatch: pytest.MonkeyPatch, *rows: Exemption) -> None:
    monkeypatch.setattr(coverage, "exemptions", lambda: rows)


def test_what_never_ran_is_listed_with_its_place() -> None:
    found = measured(IDLE)
    assert [str(each) for each in found.misses] == [
        "iec61131/ex/A.st:3:6: never IF TRUE",
        "iec61131/ex/A.st:4: never ran",
        "iec61131/ex/A.st:5: never ran",
    ]
    assert str(found.count()) == "lines 1/3, branches 1/2"
    assert [round(each, 2) for each in found.count().percent] == [33.33, 50.0]


def test_what_one_build_has_run_and_what_another_has_is_summed_and_programs_are_left_out() -> None:
    found = measured(IDLE, BUSY, IDLE)
    assert found.lines == {"iec61131/ex/A.st": {3: 10, 4: 2, 5: 2}}
    assert found.branches == {"iec61131/ex/A.st": {TRUE: 2, FALSE: 8}}
    assert found.misses == []
    assert str(found.count()) == "lines 3/3, branches 2/2"


def test_what_is_explained_counts_as_missed_and_is_left_out_of_the_percentage(monkeypatch: pytest.MonkeyPatch) -> None:
    explain(monkeypatch, Exemption("*", "IF N > * THEN", "IF TRUE", "N is small", 2))
    figures = measured(IDLE).count()
    assert str(figures) == "lines 1/3, branches 1/2 (3 explained)"
    assert figures.percent == (100.0, 100.0)
    assert [each.why for each in measured(IDLE).misses] == ["N is small", "see line 3", "see line 3"]
    assert [each.why for each in measured(BUSY).misses] == [""]


@pytest.mark.parametrize(
    ("row", "explained"),
    [
        (Exemption("A", "IF N > 1 THEN", "IF TRUE", "why", 1), 2),
        (Exemption("A", "IF N > 1 THEN", "IF TRUE", "why"), 1),
        (Exemption("A", "IF N > 1 THEN", "IF FALSE", "why", 2), 0),
        (Exemption("B", "IF N > 1 THEN", "IF TRUE", "why", 2), 0),
        (Exemption("A*B", "IF N > 1 THEN", "IF TRUE", "why", 2), 0),
        (Exemption("A", "IF N . 1 THEN", "IF TRUE", "why", 2), 0),
        (Exemption("A", "IF N", "IF TRUE", "why", 2), 0),
    ],
)
def test_an_explanation_holds_for_its_block_its_line_and_its_outcome(
    row: Exemption, explained: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    explain(monkeypatch, row)
    assert measured(IDLE).count().explained == explained


def test_too_little_is_a_failure_that_says_what_was_missed() -> None:
    lines, branches = result(measured(IDLE), 40.0).outcomes
    assert (lines.words, lines.status, branches.status) == ("lines", "failed", "passed")
    assert lines.message == (
        "33.33 % have run, 40 % are required:\niec61131/ex/A.st:4: never ran\niec61131/ex/A.st:5: never ran"
    )
    assert result(measured(IDLE)).passed
    assert result(measured(IDLE, BUSY), 100.0).passed


def test_where_nothing_is_counted_nothing_has_run() -> None:
    assert not result(Coverage("embedded"), 1.0).passed


def test_what_programs_leave_out_is_missed(shared: Unit) -> None:
    """Without the program of a block its lines never run, but for those that others need."""
    found = Coverage("embedded")
    unit = replace(only(shared, "Digits"), blocks=shared.blocks)
    assert runner.run([unit], [EmbeddedEngine(coverage=True)], coverage=[found]).passed
    whole = {
        path for path in found.texts if "/modbus/" in path and not [each for each in found.misses if each.path == path]
    }
    assert whole == {"iec61131/modbus/MB_HexDigit.st", "iec61131/modbus/MB_HexValue.st"}
    assert found.count("iec61131/modbus/MB_Lrc.st").percent == (0.0, 0.0)


def test_figures_of_one_engine_are_not_those_of_another(shared: Unit) -> None:
    class Second(EmbeddedEngine):
        name = "second"

    both = [Coverage("embedded"), Coverage("second")]
    runner.run([only(shared, "Digits")], [EmbeddedEngine(coverage=True), Second()], coverage=both)
    assert [bool(each.count().lines) for each in both] == [True, False]


def test_counters_that_do_not_fit_the_source_are_an_error(shared: Unit, monkeypatch: pytest.MonkeyPatch) -> None:
    def branches(_: EmbeddedLibrary) -> Branches:
        raise EngineError("a.st:3: iec2c has 2 statements here, the source 1")

    monkeypatch.setattr(EmbeddedLibrary, "branches", branches)
    done = runner.run([only(shared, "Digits")], [EmbeddedEngine()], coverage=[Coverage("embedded")])
    (last,) = done.results[-1].outcomes
    assert (done.results[-1].program, last.status) == ("coverage", "error")
    assert "iec2c has 2 statements here" in last.message


def test_counters_are_added_to_an_engine_and_nothing_else_is_changed(matiec: MatiecEngine) -> None:
    made = counting(matiec)
    assert isinstance(made, MatiecEngine)
    assert made.flags == Flags(matiec.flags.optimise, matiec.flags.extra, True)
    assert (made.name, made.installation, made.compiler) == (matiec.name, matiec.installation, matiec.compiler)


def test_counters_are_added_to_the_embedded_engine() -> None:
    made: Engine = counting(EmbeddedEngine(loop_limit=7))
    assert isinstance(made, EmbeddedEngine)
    assert (made.coverage, made.loop_limit) == (True, 7)
