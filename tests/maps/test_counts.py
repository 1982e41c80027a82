"""Counts of what maps hold, and the tables of drives that are made from them."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from driveblocks.maps import catalog, counts, inventory, view
from driveblocks.maps.counts import Counts, Tally
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive

EXAMPLE = Path(__file__).with_name("example.yaml")
CHECKOUT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def drive() -> Drive:
    """The example map."""
    return load(EXAMPLE)


@pytest.fixture(scope="module")
def held(drive: Drive) -> Counts:
    """What the example map holds."""
    return counts.of_drive(drive)


def test_sections_are_counted_as_one_counts_by_hand(held: Counts) -> None:
    assert held.sections == {
        "commands": Tally(registers=4, bits=6, enums=2, enum_values=5),
        "status": Tally(registers=5, bits=11, enums=2, enum_values=5),
        "monitors": Tally(registers=5),
        "parameters": Tally(registers=13),
    }


def test_kinds_are_counted_as_one_counts_by_hand(held: Counts) -> None:
    assert (held.settings, held.setting_values) == (4, Tally(enums=1, enum_values=3))
    assert (held.faults, held.errors, held.frames) == (4, 4, 9)
    assert (held.errata, held.absent, held.notices) == (8, 3, 2)
    assert held.total == Tally(registers=27, bits=17, enums=5, enum_values=13)


@pytest.mark.parametrize("path", [EXAMPLE, *catalog.shipped()], ids=lambda path: path.stem)
def test_counts_agree_with_the_json(path: Path) -> None:
    drive = load(path)
    held, seen = counts.of_drive(drive), view.of_drive(drive, path.stem)
    for kind in ("settings", "faults", "errors", "frames", "errata", "absent", "notices"):
        assert getattr(held, kind) == len(seen[kind]), kind
    for section, tally in held.sections.items():
        rows = [one for one in seen["registers"] if one["section"] == section and not one["unused"]]
        lists = [*(one["enum"] for one in rows), *(bit.get("values", []) for one in rows for bit in one["bits"])]
        assert tally.registers == len(rows)
        assert tally.bits == sum(len(one["bits"]) for one in rows)
        assert tally.enums == sum(bool(values) for values in lists)
        assert tally.enum_values == sum(map(len, lists))


def test_the_json_of_counts_has_totals_by_kind_and_by_section(held: Counts) -> None:
    seen: dict[str, Any] = counts.plain(held)
    assert (seen["registers"], seen["errata"]) == (27, 8)
    assert seen["sections"]["status"] == {"registers": 5, "bits": 11, "enums": 2, "enum_values": 5}


def test_the_table_has_a_line_for_each_drive_and_register_table(drive: Drive) -> None:
    lines = inventory.table({EXAMPLE: drive}, CHECKOUT).splitlines()
    assert lines[2] == (
        "| [**EX100**](tests/maps/example.yaml) Example Drives EX100 series "
        "| 27 | 17 | 5 | 13 | 4 | 4 | 4 | 9 | 8 | 3 |"
    )  # fmt: skip
    assert lines[3] == "| · Commands | 4 | 6 | 2 | 5 |  |  |  |  |  |  |"
    assert lines[-1] == "| · keypad settings |  |  | 1 | 3 | 4 |  |  |  |  |  |"
    assert {line.count("|") for line in lines} == {12}


def test_the_front_table_has_a_line_for_each_maker_with_its_drives_and_sums(drive: Drive) -> None:
    folder = CHECKOUT / "vendor_maps"
    other = replace(drive, vendor=replace(drive.vendor, en="Another"))
    maps = {folder / f"{name}.yaml": one for name, one in (("a", drive), ("b", other), ("c", drive))}
    link = "[EX100 series](blocks/docs/EX100_Drive.md)"
    assert inventory.front(maps, CHECKOUT).splitlines()[2:] == [
        f"| Another | {link} | 8 | 3 |",
        f"| Example Drives | {link}, {link} | 16 | 6 |",
    ]


def test_what_a_drive_can_be_asked_to_do_is_told_in_words(drive: Drive) -> None:
    able = "run, run in reverse, stop, coast, reset a fault"
    assert inventory.abilities(drive) == (f"{able}, set parameters", "jog, quick stop")
    assert inventory.abilities(replace(drive, sections=(), areas=())) == (able, "jog, quick stop, set parameters")


def test_links_lead_from_the_page_to_the_map(drive: Drive) -> None:
    assert "](example.yaml)" in inventory.table({EXAMPLE: drive}, EXAMPLE.parent)
    assert "](../maps/example.yaml)" in inventory.table({EXAMPLE: drive}, EXAMPLE.parents[1] / "commands")


def test_only_the_part_between_the_markers_is_replaced(drive: Drive) -> None:
    page = f"before\n{inventory.BEGIN}\nold\n{inventory.END}\nafter\n"
    made = inventory.update(page, {EXAMPLE: drive}, CHECKOUT)
    assert made.startswith(f"before\n{inventory.BEGIN}\n| drive")
    assert made.endswith(f"|\n{inventory.END}\nafter\n")
    assert "old" not in made
    assert inventory.update(made, {EXAMPLE: drive}, CHECKOUT) == made


@pytest.mark.parametrize("page", ["", inventory.BEGIN, inventory.END])
def test_a_page_without_markers_is_refused(page: str) -> None:
    with pytest.raises(ValueError, match="drives:begin"):
        inventory.update(page, {}, CHECKOUT)


@pytest.mark.parametrize("name", ["README.md", "vendor_maps/README.md"])
def test_the_tables_of_drives_are_current(name: str) -> None:
    page = CHECKOUT / name
    text = page.read_text(encoding="utf-8")
    maps = {path: load(path) for path in catalog.shipped()}
    current = inventory.update(text, maps, page.parent)
    assert text == current, "run: driveblocks counts README.md vendor_maps/README.md"
