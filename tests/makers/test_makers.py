"""Maps of drives that are not shipped, from what their makers print: each is good, builds, lints and turns a motor."""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.bench.scenes import count, motor, others
from driveblocks.bench.scenes.ability import Ability
from driveblocks.bench.scenes.drive import premises, simulated
from driveblocks.bench.scenes.scene import Scene, Step
from driveblocks.bench.simulator.face import awaited
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.machine import Machine
from driveblocks.cli import app
from driveblocks.maps import catalog
from driveblocks.maps.load import load, loads
from driveblocks.maps.model import Drive

FILES = {path.stem: path for path in sorted(Path(__file__).parent.glob("*.yaml"))}
WITH_SHIPPED = FILES | {path.stem: path for path in catalog.shipped()}
FULL_SPEED = {"abb_acs355": {0x0003: 0x0104}, "siemens_v20": {0x006D: 0x0104}, "danfoss_fc51": {0xC417: 0x0900}}
"""The bits that a status word has at full speed, by the tables of the makers: running and at setpoint."""


@cache
def drive(name: str) -> Drive:
    return load(WITH_SHIPPED[name])


def made(name: str, *, printed: str, now: str) -> Drive:
    """A map with other text in it."""
    text = WITH_SHIPPED[name].read_text(encoding="utf-8")
    assert printed in text
    return loads(text.replace(printed, now), name)


@pytest.mark.parametrize("name", FILES)
def test_a_map_is_good(name: str) -> None:
    assert drive(name).frames
    assert drive(name).absent
    assert not premises(drive(name))


# ---------------------------------------------------------------- what scenes expect, from the map alone


def steps(scenes: Callable[[Ability], Iterator[Scene]], name: str, scene: str) -> tuple[Step, ...]:
    return next(each.steps for each in scenes(Ability(drive(name))) if each.words == scene)


@pytest.mark.parametrize("name", FULL_SPEED)
def test_a_chart_that_no_write_waits_for_does_not_bind_the_status(name: str) -> None:
    faces = simulated(drive(name)).faces
    at_speed = [words for (situation, _), words in faces.items() if situation.at_speed]
    ((register, mask),) = FULL_SPEED[name].items()
    assert at_speed
    assert all(words[register] & mask == mask for words in at_speed)


def test_steps_of_a_start_wait_for_three_states() -> None:
    assert [each.name for each in awaited(drive("abb_acs355"))] == [
        "ready_to_switch_on", "ready_to_operate", "operation_enabled",
    ]  # fmt: skip
    assert len(drive("abb_acs355").operation.states) == 3


def test_a_long_path_has_its_time_and_may_show_a_run_before_its_end() -> None:
    can = Ability(drive("abb_acs355"))
    assert can.path_ms("run_forward") == 5 * 300 + 100
    ramps = next(each for each in steps(motor.starts, "abb_acs355", "run forward") if each.words == "it ramps up")
    assert ramps.ms == 2600
    assert "Seen.Starts > 0" in str(ramps.until)


def test_refusals_by_which_a_drive_is_known_are_no_trouble() -> None:
    assert Ability(drive("siemens_v20")).known_by_refusal
    reached = next(
        each
        for each in steps(count.scenes, "siemens_v20", "what the line counts")
        if each.words == "each request reaches the drive"
    )
    assert reached.shows["Bus.LastErrorID"] == 40
    assert not Ability(drive("ls_ig5a")).known_by_refusal


def test_frames_of_another_master_are_in_the_mode_of_the_line() -> None:
    """The factory mode of a Delta is ASCII; its scenes speak RTU."""
    assert drive("delta_vfd_e").serial.mode.modes[0] == "ascii"
    first = next(
        each for each in steps(others.scenes, "delta_vfd_e", "some frames in ten seconds") if ".Inject" in each.sets
    )
    assert first.sets[".Printed[0]"] == "BYTE#16#63"


def test_a_warning_stands_beside_the_code_of_a_fault() -> None:
    machine = Machine(drive("delta_vfd_e"), 1, Habits())
    machine.warning, machine.fault = True, 0x21
    assert machine.word(0x2100) & 0xFF == 0x21
    assert machine.word(0x2100) & 0xFF00


def test_without_a_coast_stop_the_quick_stop_stays() -> None:
    kinds = [each.shows.get("Seen.StopKind") for each in steps(motor.stops, "ls_ig5a", "a stop grows stronger")]
    assert [each for each in kinds if each] == [1, 2, 2, 2]


def test_a_motor_that_coasts_runs_where_its_speed_says_so() -> None:
    printed = "{shows: running, any: [{register: 40110, bit: 2, equals: 1}]"
    other = made(
        "siemens_v20", printed=printed, now="{shows: running, any: [{register: 40024, equals: 0, differs: true}]"
    )
    assert Ability(other).runs_by_speed
    assert not Ability(drive("siemens_v20")).runs_by_speed


def test_what_scenes_suppose_is_named() -> None:
    """Ready would be shown in the states alone through which a start goes."""
    printed = "{shows: ready, any: [{register: 40004, bit: C, equals: 1}]"
    other = made(
        "abb_acs355", printed=printed, now="{shows: ready, any: [{register: 40004, mask: 0049H, equals: 0001H}]"
    )
    assert premises(other) == [
        "no words of its status show `ready` TRUE of a drive that is ready, in none of the states "
        "ready_to_switch_on or ready_to_operate or operation_enabled"
    ]


# ---------------------------------------------------------------- one life of a motor


@pytest.mark.thorough
@pytest.mark.parametrize("name", FILES)
def test_a_map_makes_blocks_that_lint_and_run(name: str, tmp_path: Path) -> None:
    for command in (
        ["check", str(FILES[name])],
        ["build", str(FILES[name]), "-o", str(tmp_path), "--to", "iec61131"],
        ["lint", str(tmp_path / "iec61131")],
        ["test", "--jobs", "1", str(FILES[name])],
    ):
        result = CliRunner().invoke(app, command)
        assert result.exit_code == 0, result.output
