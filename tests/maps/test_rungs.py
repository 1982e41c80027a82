"""What is said of trust in the shipped maps: each fact by its cell, README and catalogue by the rungs alone."""

import re
from pathlib import Path

import pytest
from tests import families
from tests.shipped import drives

from driveblocks.docs import evidence
from driveblocks.maps import catalog, inventory, trust
from driveblocks.maps.load import load
from driveblocks.maps.model import Cited
from driveblocks.render.environment import render

README = Path(__file__).parents[2] / "README.md"
SAYS = re.compile(
    r"\bread off\b|second.hand|transcribed|\bsister|\bin use\b|\brung|\bderived|ManualChecked|\btrust", re.I
)
"""Words by which a text tells how far a map can be trusted."""


@pytest.mark.parametrize("family", drives())
def test_nothing_that_moves_a_motor_is_read_without_a_printed_cell(family: str) -> None:
    wanted = [one for one in trust.facts(drives()[family]) if one.part in (*trust.CONTROL, "watchdog")]
    bare = [
        (one.part, one.name)
        for one in wanted
        if one.trust == "read" and not any(isinstance(each, Cited) and each.printed for each in one.said)
    ]
    assert bare == []


def test_what_could_not_be_opened_again_is_not_read() -> None:
    held = {family: trust.shown(drive) for family, drive in drives().items()}
    assert held["GD200A"]["watchdog"] == held["PF525"]["watchdog"] == "transcribed"
    assert (held["MX2"]["control"], held["SN300G5"]["faults"]) == ("derived", "derived")
    typed = families.own("CONTROL")
    assert {family: said["control"] for family, said in held.items()} == {
        each: typed.get(each, "read") for each in held
    }
    derived = [one.name for one in trust.facts(drives()["SN300G5"]) if one.trust == "derived"]
    assert derived == ["33H", "34H", "35H", "36H", "37H", "41H", "42H", "43H", "44H"]


def test_the_readme_says_of_trust_what_the_rungs_say_and_no_more() -> None:
    text = README.read_text(encoding="utf-8")
    before, _, rest = text.partition(inventory.TRUST_BEGIN)
    table, _, after = rest.partition(inventory.TRUST_END)
    assert table.strip() == inventory.trusted({path: load(path) for path in catalog.shipped()}, README.parent).strip()
    told = [line for line in (before + after).splitlines() if SAYS.search(line)]
    assert len(told) == 1, told
    assert told[0].startswith("[How far each map can be trusted](blocks/docs/Families.md")


def test_the_catalogue_says_of_trust_what_the_rungs_say_and_no_more() -> None:
    rest = dict.fromkeys(("maker", "title", "able", "turns_on", "reports", "shows", "unscaled"), "")
    rows = [
        rest | {"prefix": family, "trust": trust.shown(one), "checked": "yes" * trust.second_hand(one), "data": 0}
        for family, one in drives().items()
    ]
    text = render(
        "docs/Families.md.j2", families=rows, platforms=[], files=[], plates=[], wide=False, trusted=list(trust.SHOWN)
    )
    before, _, rest_of_it = text.partition("## How far each map can be trusted\n")
    section, _, after = rest_of_it.partition("\n## ")
    assert [line for line in (before + after).splitlines() if SAYS.search(line)] == []
    said = {cells[1].strip(" `"): cells[2:-2] for line in section.splitlines() if (cells := line.split("|"))[2:]}
    wanted = {family: [f" {each} " for each in trust.shown(one).values()] for family, one in drives().items()}
    assert {family: said[family] for family in wanted} == wanted
    assert all(f"`{trust.words(rung)}`" in section for rung in trust.RUNGS), "the legend has every rung"


def test_the_page_says_of_every_fact_where_it_is_from() -> None:
    for drive in drives().values():
        places, found = evidence.places(drive), trust.facts(drive)
        assert all(one.where and one.trust for one in places)
        assert len(places) <= len(found)
        assert {one.part for one in places} == {one.part for one in found}
        said = {(one.part, name) for one in places for name in one.names}
        assert said >= {(one.part, one.name.replace("_", " ")) for one in found if one.part != "faults"}
        assert all(
            f"[{number}]" in "".join(one.note for one in places)
            for number in range(1, len(evidence.documents(drive)) + 1)
        )
