"""A short run of the fuzz, and proof that it would notice a loader that fails or looks away."""

import pytest
from tests.maps import fuzz, mutate, pins
from tests.maps.fuzz import Tally

from driveblocks.maps import check
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report

EXAMPLE = fuzz.text(fuzz.EXAMPLE)


@pytest.mark.thorough
def test_no_mutation_makes_the_loader_fail_or_look_away() -> None:
    tally = fuzz.fuzz(fuzz.maps(), seed=7, numbers=range(300))
    assert tally.failures == []
    assert sum(tally.pinned.values()) > 60


def test_the_same_seed_makes_the_same_mutations() -> None:
    assert _said(seed=3) == _said(seed=3) != _said(seed=4)


def _said(seed: int) -> list[str]:
    tally = fuzz.fuzz([EXAMPLE], seed, range(6))
    return [*tally.tried, *tally.survived]


def _without_rules(_: Drive, __: Report) -> None:
    """A loader that looks away."""


def test_a_loader_without_rules_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "check", _without_rules)
    failures = fuzz.fuzz([EXAMPLE], seed=1, numbers=range(60)).failures
    assert any("the map passes, though a relation pins" in failure for failure in failures)


def test_a_loader_that_raises_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise KeyError("address")

    monkeypatch.setattr(check, "check", broken)
    assert any("KeyError" in failure for failure in _failures())


def _failures() -> list[str]:
    tally = Tally()
    for number in range(10):
        tally.failures += fuzz.fuzz([EXAMPLE], 1, [number]).failures
    return tally.failures


@pytest.mark.parametrize("kind", sorted(EXAMPLE.by_kind))
def test_a_fact_is_changed_in_its_place_alone(kind: str) -> None:
    leaf = EXAMPLE.by_kind[kind][0]
    text = mutate.replaced(EXAMPLE, leaf, "CHANGED").data.decode()
    changed = mutate.Text("changed", text)
    old, new = pins.Document(mutate.plain(EXAMPLE.root)), pins.Document(mutate.plain(changed.root))
    assert new.at(leaf.path) == "CHANGED"
    assert old.at(leaf.path) == leaf.scalar.text
    assert len(text) == len(EXAMPLE.text) - len(leaf.scalar.text) + len("CHANGED")


def test_every_pin_speaks_of_a_kind_that_some_map_has() -> None:
    known = {kind for text in fuzz.maps() for kind in text.by_kind}
    rare = {"errors.form.function", "errors.form.address"}
    assert set(pins.PINS) - known - rare == set()
