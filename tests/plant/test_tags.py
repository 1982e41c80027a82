"""The tags of the example plants: each is a variable of the program, and its alarms have texts."""

import csv
import io

import pytest
from tests.plant.bench import PLANTS, Bench, example

from driveblocks.plant import tags
from driveblocks.render.reasons import REASONS
from driveblocks.render.text import chinese

WIDTHS = {"BOOL": bool, "INT": int, "UINT": int, "UDINT": int, "WORD": int, "REAL": float}


@pytest.mark.parametrize("name", PLANTS)
def test_each_tag_is_a_variable_of_its_type(name: str) -> None:
    made = Bench(example(name))
    made.scan()
    found = list(tags.tags(made.plant))
    plain = [each for each in found if each.type != tags.ALARM]
    assert len({each.name for each in plain}) == len(plain)
    for each in plain:
        assert isinstance(made[each.name], WIDTHS[each.type]), each.name
    assert {each.name for each in found if each.type == tags.ALARM} <= {each.name for each in plain}


@pytest.mark.parametrize("name", PLANTS)
def test_each_input_and_output_of_the_program_is_a_tag(name: str) -> None:
    made = Bench(example(name))
    there = {each.name for each in tags.tags(made.plant)}
    wanted = {*made.plant.buttons, *made.plant.lamps, *made.plant.inputs}
    wanted |= {f"{each}_{pin}" for each in made.plant.hard_stops for pin in ("Closed", "Ok")}
    assert wanted <= there


def test_alarms_have_two_languages() -> None:
    text = tags.table(example("pumps"), chinese())
    rows = list(csv.reader(io.StringIO(text.removeprefix("\ufeff"))))
    assert rows[0] == ["name", "type", "unit", "range", "text", "text zh"]
    assert all(len(row) == 6 for row in rows)
    (offline,) = [row for row in rows if row[0] == "P1.Reason" and row[3] == "14"]
    reason = next(each for each in REASONS if each.code == 14)
    assert offline[4:] == [f"Pump 1: {reason.en}", f"Pump 1: {reason.zh}"]
    faults = {row[3]: row[5] for row in rows if row[0] == "P1.FaultCode" and row[1] == tags.ALARM}
    assert len(faults) == len([each for each in example("pumps").drives["P1"].map.faults.codes if each.code])


def test_alarms_of_other_languages_are_english_alone() -> None:
    rows = list(csv.reader(io.StringIO(tags.table(example("conveyor")).removeprefix("\ufeff"))))
    assert rows[0] == ["name", "type", "unit", "range", "text"]
    assert any(row[:4] == ["Belt1.FaultCode", "alarm", "", "2"] for row in rows)
