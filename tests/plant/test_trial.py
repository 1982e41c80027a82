"""The test of a plant: green for the program that is written for it, red for each fault that is planted into that."""

from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner
from tests.plant.bench import EXAMPLES, PLANTS

from driveblocks.bench import junit
from driveblocks.bench.outcome import ERROR, FAILED, PASSED, Outcome
from driveblocks.cli import app
from driveblocks.plant import check, program, testing
from driveblocks.plant.stand import Stand
from driveblocks.plant.testing import Trial

ONE = """plant: One pump
lines:
  A: {port: "1"}
drives:
  P1: {drive: jscc, line: A, unit: 3, maximum_hz: 50, stop_within_ms: 9000, ramp_up_s: 2, ramp_down_s: 2, speed: 30,
    settings: {ReferenceScale: 100.0}}
buttons:
  Go: {start: P1}
  Halt: {stop: P1}
lamps:
  Bad: {fault: P1}
"""
POWER_UP = "power-up: nothing turns, every drive answers, a reset closes the contacts"


@cache
def judged(name: str) -> check.Judged:
    return check.judged(EXAMPLES / f"{name}.yaml")


@pytest.fixture(scope="module")
def one(tmp_path_factory: pytest.TempPathFactory) -> check.Judged:
    """A plant of one drive."""
    path = tmp_path_factory.mktemp("plant") / "one.yaml"
    path.write_text(ONE, encoding="utf-8")
    return check.judged(path)


def trial(found: check.Judged, before: str = "", after: str = "") -> Trial:
    """A plant with its program, or with one in which something else stands."""
    text = program.text(found.plant)
    assert before in text
    return Trial(found.plant, text.replace(before, after), found.figures)


def played(made: Trial, name: str) -> Outcome:
    """What comes out of one scene."""
    return made.play(next(each for each in made.scenes() if each.name == name))


def test_one_drive_starts_stops_and_trips(one: check.Judged) -> None:
    made = trial(one)
    for name in (POWER_UP, "start and stop of P1", "trip of P1"):
        assert played(made, name).status == PASSED


@pytest.mark.parametrize(
    ("before", "after", "scene", "says"),
    [
        ("Address := 3", "Address := 4", POWER_UP, "P1 answer within 30 s: P1 is at 0.0 Hz, Reason 13: no reply yet"),
        ("AND NOT P1_Stops", "", "start and stop of P1", "P1 at standstill, and StopConfirmed, within 9 s"),
        pytest.param(
            "P1_Starts AND NOT P1_Started", "P1_Starts", "stop of P1 by Halt", "nothing starts without a rising edge",
            marks=pytest.mark.thorough,
        ),
    ],
)  # fmt: skip
def test_a_fault_of_the_program_is_found(one: check.Judged, before: str, after: str, scene: str, says: str) -> None:
    found = played(trial(one, before, after), scene)
    assert found.status == FAILED
    assert found.message.startswith(says)
    assert "P1" in found.actual.splitlines()[-1]


@pytest.mark.thorough
def test_what_a_scene_begins_with_is_no_fault_of_the_scene(one: check.Judged) -> None:
    found = played(trial(one, "Address := 3", "Address := 4"), "start and stop of P1")
    assert found.status == ERROR
    assert found.message.startswith("the plant does not come so far: P1 answer within 30 s")


@pytest.mark.thorough
def test_a_program_that_fails_is_an_error(one: check.Judged) -> None:
    made = trial(one, "  FirstScan := FALSE;", "  FirstScan := FALSE;\n  P1_Stops := 1 / A_RxCount = 1;")
    assert "divi" in played(made, POWER_UP).message


def test_a_copy_of_a_stand_goes_its_own_way(one: check.Judged) -> None:
    first = Stand(one.plant, trial(one)._loaded)
    first.wait(500)
    second = first.copied()
    second.wait(2000)
    assert first.ms == 500
    assert not first.pin("P1.CommOk")
    assert second.pin("P1.CommOk")
    first.wait(2000)
    assert first.controller.instance.state() == second.controller.instance.state()


@pytest.mark.thorough
def test_each_scene_is_a_case_of_its_own(one: check.Judged) -> None:
    made, told = trial(one, "SpeedReferenceHz := 30.0", "SpeedReferenceHz := 20.0"), list[tuple[int, int]]()
    some = [each for each in made.scenes() if each.begins == "off" or each.name == "start and stop of P1"]
    done = testing.run(made, 1, lambda at, of, _: told.append((at, of)), some)
    root = ElementTree.fromstring(junit.text(done))  # noqa: S314 - our own
    cases = [(each.get("classname"), each.get("name"), each.find("failure")) for each in root.iter("testcase")]
    assert [each[:2] for each in cases] == [("OnePump.Plant", POWER_UP), ("OnePump.Plant", "start and stop of P1")]
    assert cases[0][2] is None
    failure = cases[1][2]
    assert failure is not None
    assert str(failure.get("message")).startswith("P1 turns at 30 Hz within 8.4 s: P1 is at 20.0 Hz, Reason 0: runs")
    assert "expected: P1 turns at 30 Hz within 8.4 s" in str(failure.text)
    assert told == [(1, 2), (2, 2)]


@pytest.mark.thorough
def test_two_tests_of_a_plant_find_the_same(one: check.Judged) -> None:
    wrong = trial(one, "SpeedReferenceHz := 30.0", "SpeedReferenceHz := 20.0")
    assert played(wrong, "start and stop of P1") == played(
        trial(one, "SpeedReferenceHz := 30.0", "SpeedReferenceHz := 20.0"), "start and stop of P1"
    )


# ------------------------------------------------------------ at length


@pytest.mark.thorough
@pytest.mark.parametrize("name", PLANTS)
def test_the_examples_do_what_is_expected_of_a_plant(name: str) -> None:
    done = testing.run(trial(judged(name)))
    assert [each.message for each in done.results[0].bad] == []


FAULTS = {
    "StopAll is not wired": ("All_Stop := Hmi_StopAll;", "All_Stop := FALSE;", "stop of all by Hmi_StopAll"),
    "two drives have one address": ("Address := 2,", "Address := 1,", POWER_UP),
    "the contact is always closed": ("HardStop_Ok := HardStop.HardStopOk;", "HardStop_Ok := TRUE;", POWER_UP),
    "no stop is ever overdue": ("Overdue := HardStop_Overdue", "Overdue := FALSE", "cable cut before Mixer"),
    "the hard stop is not read": ("Enable := HardStop_Closed", "Enable := TRUE", "HardStop opened and closed"),
    "another speed": ("SpeedReferenceHz := 45.0", "SpeedReferenceHz := 30.0", "start and stop of Pump"),
    "another scale": ("High := 50.0", "High := 40.0", "start and stop of Fan"),
    "a broken wire stops nothing": (" OR Air_Scale.Broken", "", "broken wire of Air"),
    "a dark lamp": ("MixerFault := Mixer.Fault OR NOT Mixer.CommOk;", "MixerFault := FALSE;", "trip of Mixer"),
    "no reset": ("FaultReset := Mixer_Reset,", "", "trip of Mixer"),
    "another drive's run": ("RunForward := Pump_Run", "RunForward := Mixer_Run", "start and stop of Mixer"),
    "the other way round": ("RunForward := Pump_Run", "RunReverse := Pump_Run", "start and stop of Pump"),
}
"""What is planted into the program of the small plant, and the scene that finds it."""


@pytest.mark.thorough
@pytest.mark.parametrize(("before", "after", "scene"), FAULTS.values(), ids=FAULTS)
def test_a_fault_of_the_small_plant_is_found(before: str, after: str, scene: str) -> None:
    assert played(trial(judged("small")), scene).status == PASSED
    assert played(trial(judged("small"), before, after), scene).status == FAILED


@pytest.mark.thorough
def test_the_command_tests_a_plant(tmp_path: Path) -> None:
    plant, xml = tmp_path / "one.yaml", tmp_path / "one.xml"
    plant.write_text(ONE, encoding="utf-8")
    said = CliRunner().invoke(app, ["test", str(plant), "--junit", str(xml), "--jobs", "2"])
    assert (said.exit_code, said.stderr) == (0, "")
    assert "13 scenes of One pump: all passed in " in said.stdout
    assert ElementTree.parse(xml).getroot().get("tests") == "13"  # noqa: S314 - our own
    wrong = CliRunner().invoke(app, ["test", str(plant), "--engine", "matiec"])
    assert wrong.exit_code == 2
