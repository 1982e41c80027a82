"""The figures of a plant are those of `driveblocks line`, and what a cut cable does is what the maps say."""

import json

import pytest
from click.testing import CliRunner
from tests.plant.bench import EXAMPLES, PLANTS, example
from tests.plant.test_folder import cells, files, marked

from driveblocks.cli import app
from driveblocks.desk.site import asked
from driveblocks.desk.site.line import figures


@pytest.mark.thorough
def test_a_plant_without_settings_has_the_figures_of_its_drives_by_their_names() -> None:
    words = asked.Words(line=("pf525@1", "atv312@2", "mx2@3"), rate=19200, form="8E1", scan="10ms", max_scan="20ms")
    made = asked.line(words)
    own = figures(made, 19200)
    page = files("small")["figures.md"]
    assert cells(page, "A")[1:] == [
        "19200", *map(str, (own.alone, own.worst, own.unlearned, own.cut, own.round)), f"{own.load} %",
    ]  # fmt: skip
    for name, each in zip(("Mixer", "Pump", "Fan"), own.ages, strict=True):
        one = each.promised
        assert cells(page, name)[2:6] == list(map(str, (each.every, one.read, one.worst, one.stale)))


@pytest.mark.parametrize("plant", marked(PLANTS))
def test_the_figures_are_those_that_the_command_prints(plant: str) -> None:
    printed = json.loads(CliRunner().invoke(app, ["line", str(EXAMPLES / f"{plant}.yaml"), "--json"]).stdout)
    page = files(plant)["figures.md"]
    assert list(printed) == list(example(plant).lines)
    for name, shown in printed.items():
        own = next(each for each in shown["rates"] if each["rate"] == shown["rate"])
        due = [
            own[key] for key in ("rate", "one_stop", "all_stops", "all_stops_before_replies", "cut_to_contact", "round")
        ]
        assert cells(page, name)[1:7] == list(map(str, due))
        for unit in own["units"]:
            assert cells(page, unit["name"])[4] == str(unit["worst_read"] or "-")


@pytest.mark.thorough
def test_a_cut_cable_is_told_drive_by_drive() -> None:
    page = files("pumps")["figures.md"]
    cut = page[page.index("## When the cable") :]
    assert cells(cut, "P1")[1:3] == ["the manual does not say: count on a motor that runs on", "HardStopNorth"]
    assert cells(cut, "P2")[1] == "coasts, ramps down or stops quickly after 5 s of silence, as SLL is set"
    assert cells(cut, "P6")[1:3] == ["as delivered (P14.04 0.0 s) the motor runs on", "HardStopSouth"]
    whole = cells(page, "A")[5]
    assert cells(cut, "P1")[3] == whole
    small = files("small")["figures.md"]
    assert cells(small[small.index("## When") :], "Fan")[1].endswith("**Count on a motor that runs on**")
