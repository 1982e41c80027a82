"""Status words show each situation by the map's conditions, and nothing else."""

from dataclasses import replace

import pytest
from tests.shapes import shapes
from tests.shipped import sisters
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.face import Situation, situations
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.table import table
from driveblocks.maps.form import Span
from driveblocks.maps.model import Condition, Drive, State, Status


def holds(condition: Condition | State, words: dict[int, int]) -> bool:
    """Whether a condition is true of some words; a measured register is not asked."""
    word = words.get(condition.register)
    if word is None:
        return True
    if isinstance(condition, Condition) and condition.above is not None:
        return word > condition.above
    if isinstance(condition, Condition) and condition.below is not None:
        return word < condition.below
    if isinstance(condition, Condition) and condition.bit is not None:
        found = word >> condition.bit.first & ((1 << len(condition.bit)) - 1) == condition.equals
    else:
        found = word & (0xFFFF if condition.mask is None else condition.mask) == condition.equals
    return found != bool(getattr(condition, "differs", None))


def shown(drive: Drive, words: dict[int, int]) -> set[str]:
    """The pins that words make TRUE."""
    return {each.shows for each in drive.operation.status if any(holds(one, words) for one in each.any)}


def forced(drive: Drive, name: str | None) -> set[str]:
    """The pins that a state of the chart itself makes TRUE: a drive may show a run before a start is at its end."""
    state = next((one for one in drive.operation.states if one.name == name), None)
    if state is None:
        return set()
    by_it = {each.shows: [one for one in each.any if one.register == state.register] for each in drive.operation.status}
    return {shows for shows, any_ in by_it.items() if any(holds(one, {state.register: state.equals}) for one in any_)}


WAITING = sisters({"ATV312": {"switch_on_disabled"}})
"""The state of a drive after power-up, where its map names it."""


@pytest.mark.parametrize("name", MAPS)
def test_each_situation_is_shown_as_it_is(name: str) -> None:
    drive = MAPS[name]
    able = {status.shows for status in drive.operation.status}
    for (situation, state), words in table(drive, Habits()).faces.items():
        # a measure may show a direction by its sign; the words of a face say nothing of it
        by_words = {each.shows for each in drive.operation.status if any(one.register in words for one in each.any)}
        wanted = {fact for fact in able & by_words if getattr(situation, fact)}
        early = forced(drive, state) | able - by_words
        assert shown(drive, words) - early == wanted - early, (situation, state)
        # the output frequency decides, too; a drive with a bit for zero speed shows it there as well
        if not situation.fault and (situation.zero_speed or "zero_speed" not in able):
            stands = all(holds(one, words) for one in drive.operation.standstill.all)
            assert stands != (situation.running or "running" in early), (situation, state)
        waits = not (state or situation.fault or situation.running)
        here = {state} - {None} or (WAITING.get(name, set()) if waits else set())
        assert {one.name for one in drive.operation.states if holds(one, words)} == here


def test_situations_have_keys_of_their_own() -> None:
    """The numbers by which C finds a face."""
    found = list(situations())
    assert len({each.key for each in found}) == len(found)
    assert Situation(fault=True, zero_speed=False, ready=False, warning=True).key == 0b1000001


def test_a_condition_that_zero_fulfils_is_not_shown_where_it_must_not_be() -> None:
    """Made up: bit 2 is 0 while the motor runs, and the whole word 0 would be a fault."""
    drive = shapes()["two_registers"]
    running, fault = Condition(register=0x2000, bit=Span(2, 2), equals=0), Condition(register=0x2000, equals=0)
    stands = Condition(register=0x2000, bit=Span(2, 2), equals=1)
    status = (
        Status(shows="running", any=(running,), source="made up"),
        Status(shows="fault", any=(fault,), source="made up"),
    )
    standstill = replace(drive.operation.standstill, all=(stands,))
    drive = replace(drive, operation=replace(drive.operation, status=status, standstill=standstill))
    faces = table(drive, Habits()).faces
    assert faces[Situation(), None] == {0x2000: 4}
    assert faces[Situation(running=True), None] == {0x2000: 1}
    # a fault excludes all else here, and goes before it
    assert faces[Situation(fault=True, ready=False), None] == {0x2000: 0}
