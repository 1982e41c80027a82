"""What a map says by a rule: twins in RAM, and the profile that it describes."""

from pathlib import Path

import pytest
from tests.maps.test_base import BASE, write

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.maps.load import load, loads
from driveblocks.maps.problem import MapError
from driveblocks.meaning.status import status
from driveblocks.render import library
from driveblocks.render.text import languages
from structured_text.language.lint import lint_sources

PARAMETERS = """  - id: parameters
    title: {en: Parameters}
    source: table 4
    access: rw
    registers:
      - {address: F001H, name: Ramp, unit: s, scale: {factor: 0.1, source: table 4}, range: {min: 0, max: 6000}}
      - {address: A002H, name: Torque limit}
storage:"""
RULE = "{stored: F000H-FEFFH, ram: 0000H-0EFFH}, {stored: A000H-AEFFH, ram: 4000H-4EFFH}"
TWINS = BASE.replace("storage:", PARAMETERS, 1).replace(
    "method: unexplained, source: whole manual, note: nothing is said of written parameters",
    f"method: ram_twin, source: table 4, note: F is 0 in RAM and A is 4, twin_ranges: [{RULE}]",
)
CHOSEN = (
    BASE.replace("settings: []", "settings: [{id: P0.33, name: Profile, source: table 5, register: 2003H, "
        "needed: {value: 1, why: the commands of this map}}]")
    .replace("id_forms:", "profile: {setting: P0.33, value: 1}\nid_forms:")
    .replace("      - {address: 2002H, name: Present fault}\n", "      - {address: 2002H, name: Present fault}\n"
        "      - {address: 2003H, id: P0.33, name: Profile}\n")
)  # fmt: skip


def refused(text: str) -> list[str]:
    """What is wrong with a map."""
    with pytest.raises(MapError) as caught:
        loads(text, "acme.yaml")
    return [each.wrong for each in caught.value.problems]


def test_each_register_of_a_range_has_its_twin() -> None:
    map_ = loads(TWINS, "acme.yaml")
    assert [(one.stored, one.ram) for one in map_.storage.twins] == [(0xF001, 0x0001), (0xA002, 0x4002)]
    row = map_.register_at(0x0001, "w")
    assert row is not None
    assert (row.name, row.access, row.range) == ("Ramp in RAM", "w", map_.sections[2].registers[0].range)
    drive = SimulatedDrive(map_, 1)
    for register, stored in (("00 01", False), ("F0 01", True)):
        before = drive.stores
        drive.reply(bytes.fromhex(f"01 06 {register} 00 64"))
        assert (drive.stores > before) is stored


@pytest.mark.thorough
def test_blocks_of_a_map_with_twins_by_a_rule_are_clean() -> None:
    english = languages(["en"], "utf-8")
    files = [*library.generic(english), *library.drive("acme", loads(TWINS, "acme.yaml"), english)]
    assert [*lint_sources([(file.path, file.text) for file in files])] == []
    may = next(file.text for file in files if file.path.endswith("ACME_MayWrite.st"))
    assert all(f"(* {address}: 0 to 6000 *)" in may for address in ("0001H", "F001H"))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("ram: 4000H-4EFFH", "ram: 4000H-4FFFH", "the two ranges have not one length"),
        ("{stored: A000H-AEFFH", "{stored: B000H-BEFFH", "the map lists no register of this range"),
        ("method: ram_twin", "method: volatile", "`twins` does not belong to `method: volatile`"),
        ("register: 1001H, means", "register: F001H, means", "F001H is written again and again"),
    ],
)
def test_twins_that_are_none(old: str, new: str, told: str) -> None:
    assert old in TWINS
    assert any(told in each for each in refused(TWINS.replace(old, new, 1)))


def test_a_profile_is_read_before_a_start(tmp_path: Path) -> None:
    assert [str(each) for each in status(loads(CHOSEN, "acme.yaml")).verify] == ["2003H = 1"]
    other = "profile: {value: 0}\nsettings: [{id: P0.33, needed: {value: 0}}]\n"
    assert [str(each) for each in status(load(write(tmp_path, other, CHOSEN))).verify] == ["2003H = 0"]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (" register: 2003H,", "", "nobody can read P0.33, which chooses the profile"),
        ("profile: {setting: P0.33, value: 1}", "profile: {setting: P0.33, value: 2}", "it is not `needed` so"),
        ("profile: {setting: P0.33,", "profile: {setting: P0.34,", "there is no setting `P0.34`"),
    ],
)
def test_a_profile_that_nobody_can_see(old: str, new: str, told: str) -> None:
    assert any(told in each for each in refused(CHOSEN.replace(old, new, 1)))
