"""The matrix of modes, events and states: a fixed sample in the suite; `make long WHAT=matrix` runs all of it."""

import pytest
from tests.second import pairs
from tests.second.matrix import OPTIONS, STATES, Cell, Outcome, Run, cells, named, rows, run
from tests.second.sample import aimed, least, sample
from tests.second.walk import walk

PARTS = 8
"""Of the sample, for several processes."""
AIMED = sorted({(cell.family, cell.event) for cell, _ in aimed()})
"""What looks at one rule, for each family."""
LEAST = [("ATV312" if ("ATV312", event) in AIMED else "CHF", event) for _, event in AIMED]
"""The least case of each rule: a drive with a path of states where there is one, else one with words."""
WALKS = (6, 8, 9, 10, 13, 14, 18, 21)
"""Seeds."""
LOST = (30_114, 56_923)
"""Seeds of walks in which a request is lost before the wire, and none follows for eight seconds; and a restart sends so
soon that each reply comes in the time of the next request."""


def told(outcome: Outcome) -> str:
    """What to read, and how to see it again."""
    again = f'python -m tests.second.matrix "{outcome.cell}" --seed {outcome.seed}'
    return "\n".join([*outcome.told, f"then {outcome.second or 'nothing more'}; again: {again}"])


@pytest.mark.parametrize(
    ("family", "event"),
    [pytest.param(*each, marks=() if each in LEAST else pytest.mark.thorough) for each in AIMED],
)
def test_an_event_breaks_no_rule(family: str, event: str) -> None:
    for cell, seed in (each for each in aimed() if (each[0].family, each[0].event) == (family, event)):
        outcome = run(cell, seed)
        assert not outcome.rules, told(outcome)


@pytest.mark.parametrize(("cell", "seed"), least(), ids=str)
def test_each_event_breaks_no_rule_of_a_drive_alone(cell: Cell, seed: int) -> None:
    outcome = run(cell, seed)
    assert not outcome.rules, told(outcome)


@pytest.mark.thorough
@pytest.mark.parametrize("part", range(PARTS))
def test_every_rule_holds_in_the_sample(part: int) -> None:
    for cell, seed in sample()[part::PARTS]:
        outcome = run(cell, seed)
        assert not outcome.rules, told(outcome)


def test_a_run_is_the_same_again() -> None:
    one, two = (Run(named("CHF, full control, a trip, at speed"), 1) for _ in range(2))
    assert one.go() == two.go()
    assert one.bench.frames == two.bench.frames


def test_the_sample_reaches_every_state() -> None:
    """Cells that cannot be reached are few, and say why."""
    assert len({str(cell) for cell, _ in sample()}) > 0.9 * len(sample())
    assert {cell.state for cell, _ in sample()} == set(STATES)
    assert {named(str(cell)) for cell in cells()} == set(cells())


def test_pairs_come_together() -> None:
    found = pairs.rows({"a": (1, 2, 3), "b": "xy", "c": (False, True), "d": (0, 1, 2)})
    assert len(found) < 3 * 2 * 2 * 3 / 2
    for one in (1, 2, 3):
        assert {row["d"] for row in found if row["a"] == one} == {0, 1, 2}
        assert {row["b"] for row in found if row["a"] == one} == {"x", "y"}
    for name, values in OPTIONS.items():
        assert {row[name] for row in rows(name.partition(".")[0])} == set(values)


@pytest.mark.parametrize(
    "seed", [WALKS[0], *LOST, *(pytest.param(each, marks=pytest.mark.thorough) for each in WALKS[1:])]
)
def test_a_walk_holds_every_rule(seed: int) -> None:
    outcome = walk(seed)
    assert not outcome.rules, "\n".join(outcome.told)
