"""Scenarios: what they do, what is wrong with them all at once, and their schema."""

import json
import re
from pathlib import Path

import jsonschema
import pytest
import yaml
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk import scenario
from driveblocks.desk.bus import Loss
from driveblocks.maps.problem import MapError

DRIVES = {1: MAPS["JSCC"], 2: MAPS["SN300G5"]}
SCHEMA = Path(__file__).parents[2] / "docs" / "scenario.schema.json"
PAGE = Path(__file__).parents[2] / "docs" / "simulate.md"


def wrong(text: str) -> str:
    """What is said of a scenario."""
    with pytest.raises(MapError) as caught:
        scenario.loads(text, "s.yaml", DRIVES)
    return str(caught.value)


def played(*steps: str) -> tuple[list[SimulatedDrive], Loss]:
    """Drives and line of these steps."""
    drives, loss = [SimulatedDrive(drive, unit) for unit, drive in DRIVES.items()], Loss()
    for happening in scenario.loads("".join(f"- at 1 s: {step}\n" for step in steps), "s.yaml", DRIVES):
        happening.act(drives, loss)
    return drives, loss


def test_steps_happen_in_the_order_of_their_times_and_what_lasts_ends() -> None:
    found = scenario.loads(
        "- at 2 s: drop 10 % for 500 ms\n- at 1.5s: clear\n- at 1 min: power off 2\n", "s.yaml", DRIVES
    )
    assert [(each.at_us, each.says) for each in found] == [
        (1_500_000, "clear"), (2_000_000, "drop 10 % for 500 ms"), (2_500_000, "drop 0 %"), (60_000_000, "power off 2")
    ]  # fmt: skip


def test_a_fault_is_named_by_number_short_display_or_name_at_one_unit_or_all() -> None:
    assert [drive.fault for drive in played("trip OC 2")[0]] == [0, 7]
    assert [drive.fault for drive in played("trip overcurrent")[0]] == [3, 7]
    assert [drive.fault for drive in played("trip 0AH 2", "trip 4 1")[0]] == [4, 10]


@pytest.mark.parametrize(
    ("step", "name", "there", "elsewhere"),
    [
        ("power off 2", "powered", False, True),
        ("inhibit on 2", "inhibited", True, False),
        ("local on 2", "local", True, False),
        ("warning on 2", "warning", True, False),
        ("load 80 % 2", "load", 80, 50),
        ("run 20 Hz 2", "asked_hertz", 20.0, 0.0),
        ("late 80 ms 2", "turn_us", 80_000, 5000),
    ],
)
def test_what_happens_to_one_drive(step: str, name: str, there: object, elsewhere: object) -> None:
    first, second = played(step)[0]
    assert (getattr(second, name), getattr(first, name)) == (there, elsewhere)


def test_what_happens_ends_again() -> None:
    first, _ = played("trip 3 1", "clear 1", "reset 1", "run 20 Hz 1", "stop 1")[0]
    assert (first.fault, first.mode, first.asked_hertz) == (0, "running", 0.0)
    assert played("late 80 ms for 1 s")[0][0].turn_us == 5000


def test_a_line_loses_and_damages() -> None:
    assert vars(played("drop 10 %", "damage 0.5 %")[1]) | {"chance": 0} == vars(Loss(0.1, 0.005)) | {"chance": 0}


def test_everything_that_is_wrong_is_reported_at_once_with_its_place() -> None:
    assert wrong(
        "- at 1 s: tripp 4\n- at 2: clear 1\n- at 2 s: power of 2\n- at 3 s: drop 110 %\n- at 4 s: 'trip OD 2'\n"
        "- at 4 s: clear 9\n- nothing\n- at 5 s: [1]\n- at 6 s: xyz\n- at 7 s: off\n"
    ).splitlines() == [
        "s.yaml:1:11: `tripp` is nothing that happens; did you mean `trip`?",
        "s.yaml:2:3: `at 2` is no time; write `at 3 s`, in ms, s or min",
        "s.yaml:3:17: `power of 2` is not complete, or says too much; write `power off 2`",
        "s.yaml:4:16: 110 % is more than all; write 0 % to 100 %",
        "s.yaml:5:17: SN300G5 at unit 2 has no fault `OD`; did you mean `OV`?",
        "s.yaml:6:17: there is no drive at unit 9; units: 1, 2",
        "s.yaml:7:3: this step has no time; write - at 3 s: trip 4",
        f"s.yaml:8:11: nothing happens here; write one of {', '.join(each.word for each in scenario.VERBS)}",
        f"s.yaml:9:11: `xyz` is nothing that happens; write one of {', '.join(each.word for each in scenario.VERBS)}",
        "s.yaml:10:11: `off` without quotes is a trap: YAML 1.1 reads it as TRUE or FALSE; "
        'write true or false where the key wants that, or "off" for a text',
    ]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "s.yaml:1:1: nothing happens here; write - at 3 s: trip 4"),
        ("# later\n", "s.yaml:1:1: nothing happens here; write - at 3 s: trip 4"),
        ("at 3 s: trip 4\n", "s.yaml:1:1: a scenario is a list; write - at 3 s: trip 4"),
        ("- at 3 s: [\n", "s.yaml:2:1: the text ends in the middle of a `[` or `{`"),
    ],
)
def test_a_text_that_is_no_list(text: str, says: str) -> None:
    assert wrong(text).startswith(says)


def test_the_schema_is_current_and_takes_what_is_read() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == scenario.schema()
    judge = jsonschema.Draft7Validator(json.loads(scenario.schema()))
    good = [{"at 3 s": verb.sample} for verb in scenario.VERBS]
    assert judge.is_valid(good)
    assert not any(judge.is_valid([each]) for each in ({"at 3": "clear"}, {"at 3 s": "clear x"}, {}, "clear"))


def test_the_page_lists_every_word_and_its_example_is_good() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for verb in scenario.VERBS:
        assert f"| `{verb.sample}` | {verb.means} |" in page
    example = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)[0]
    assert len(scenario.loads(example, "s.yaml", DRIVES)) > len(yaml.safe_load(example))
