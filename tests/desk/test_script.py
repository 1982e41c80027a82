"""What a script or a person sets: times, names and values, and every mistake with its place."""

import re
from pathlib import Path
from typing import Any

import pytest
from tests.desk.run.desk import Desk

from driveblocks.desk import script
from driveblocks.desk.keyboard import typed
from driveblocks.desk.script import Setting
from driveblocks.maps.problem import Refused

SCRIPT = """# a run
at 2.5s: Start := TRUE   # up
  AT 500 ms : Hz := 30; Divisor := 16#0F

at 1min: start := false; hz := -1.5e0
"""
WRONG = """at soon: Start := TRUE
Start := TRUE
at 1s: Go := TRUE; Start := 2
at 1s: Hz := fast
  at 1s: Divisor := 99999
at 1s: Divisor := 1.5
at 1s: Start
at 1s: Motor := 1
"""
TOLD = """run.txt:1:4: `soon` is no time; write 10ms, 2.5s or 1min
run.txt:2:1: this is no step; write: at 2.5s: NAME := VALUE
run.txt:3:8: the program has no variable Go
run.txt:4:8: Hz takes a number, not `fast`
run.txt:5:10: Divisor: 99999 does not fit INT, which is -32768..32767
run.txt:6:8: Divisor takes a whole number, not `1.5`
run.txt:7:8: `Start` sets nothing; write NAME := VALUE
run.txt:8:8: Motor is no BOOL and no number; set one of its members"""


def test_a_script_is_read_in_the_order_of_its_times() -> None:
    assert script.read("run.txt", SCRIPT, Desk().instance) == [
        Setting("Hz", 30.0, 500_000), Setting("Divisor", 15, 500_000), Setting("Start", True, 2_500_000),
        Setting("start", False, 60_000_000), Setting("hz", -1.5, 60_000_000),
    ]  # fmt: skip


def test_everything_that_is_wrong_is_reported_with_its_place_and_nothing_is_set() -> None:
    desk = Desk()
    with pytest.raises(Refused) as error:
        script.read("run.txt", WRONG, desk.instance)
    assert str(error.value) == TOLD
    assert (desk.instance["Start"], desk.instance["Divisor"]) == (False, 1)


@pytest.mark.parametrize(("text", "us"), [("10ms", 10_000), ("2.5 s", 2_500_000), ("1min", 60_000_000), (" 0s ", 0)])
def test_a_time(text: str, us: int) -> None:
    assert script.duration_us(text) == us


@pytest.mark.parametrize("text", ["", "10", "-1s", "1h", "1e3s", "s", "1.s", "9" * 400 + "s"])
def test_no_time(text: str) -> None:
    with pytest.raises(ValueError, match="is no time; write 10ms"):
        script.duration_us(text)


def test_a_line_that_is_typed_sets_or_toggles() -> None:
    desk = Desk()
    inputs = desk.controller.wiring.inputs
    assert typed(" 1 ", inputs, desk.instance) == Setting("Start", True)
    desk.instance["Start"] = True
    assert typed("start", inputs, desk.instance) == Setting("start", False)
    assert typed("Hz := 12", inputs, desk.instance) == Setting("Hz", 12.0)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("3", "there is no input 3; write NAME := VALUE"),
        ("0", "there is no input 0"),
        ("2", "Hz is no BOOL; write Hz := VALUE"),
        ("Go", "the program has no variable Go"),
        ("Hz = 3", "the program has no variable Hz = 3"),
        ("Hz := 1e999", "Hz takes a number, not `1e999`"),
        ("Start := 5", "Start is a BOOL; write TRUE or FALSE, not `5`"),
    ],
)
def test_a_line_that_sets_nothing_says_why(line: str, said: str) -> None:
    desk = Desk()
    with pytest.raises(ValueError, match="^" + said.replace(".", r"\.")):
        typed(line, desk.controller.wiring.inputs, desk.instance)


def test_the_script_on_the_page_is_read() -> None:
    page = (Path(__file__).parents[2] / "docs/run.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"with `--script`:\n\n```\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    wanted = [("Hertz", 30.0, 2_000_000), ("Start", True, 2_000_000), ("Start", False, 4_500_000)]
    program: Any = {"Hertz": 0.0, "Start": False}
    assert script.read("run.md", block, program) == [Setting(*each) for each in wanted]
