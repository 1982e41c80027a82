"""The short form of the mutation run, and proof that its judges are awake."""

import pytest
from tests.blocks import judges, mutation
from tests.maps.mutate import Change
from tests.shipped import drives

from driveblocks.maps.model import Drive


@pytest.mark.thorough
def test_changes_of_maps_are_noticed() -> None:
    tally = mutation.run(rounds=1, seed=11, sample=30)
    assert mutation.unexplained(tally) == []
    assert sum(number for name, number in tally.seen.items() if name.endswith("blocks")) >= 5


def test_every_explanation_is_of_a_shipped_drive() -> None:
    assert {drive for drive, _ in mutation.explained()} <= set(drives())


CHANGES = [
    ("JSCC", "address: 1002H", "address: 1003H"),
    ("JSCC", "factor: 0.1,", "factor: 0.01,"),
    ("JSCC", "{does: stop, register: 1000H, value: 3", "{does: stop, register: 1000H, value: 2"),
    ("JSCC", "{register: 2001H, equals: 4}", "{register: 2001H, equals: 8}"),
    ("JSCC", "data_bytes: {value: 25", "data_bytes: {value: 27"),
    ("CHF", "function: 06H\n    address: 5001H", "function: 06H\n    address: 5002H"),
    ("SN300G5", "unit: {min: 1, max: 20H", "unit: {min: 1, max: 1FH"),
]


@pytest.mark.parametrize(("prefix", "old", "new"), CHANGES)
def test_a_changed_fact_turns_the_judges_of_blocks_red(prefix: str, old: str, new: str) -> None:
    original = next(one for one in mutation.originals() if one.drive.prefix == prefix)
    text = original.text.text
    assert old in text
    change = Change(text.replace(old, new, 1).encode(), f"{old} -> {new}", "typed")
    assert mutation.verdict(original, change).endswith("blocks")


@pytest.mark.parametrize("drive", drives().values(), ids=list(drives()))
def test_a_map_as_it_is_passes_every_judge(drive: Drive) -> None:
    original = next(one for one in mutation.originals() if one.drive.prefix == drive.prefix)
    assert not mutation.by_facts(drive)
    judged = [name for name in original.blocks if not mutation.LEFT.search(name)]
    assert not mutation.by_blocks(original, drive, original.blocks, judged)


def test_facts_are_asked_for_every_drive() -> None:
    assert set(judges.NAMES) == set(drives())
