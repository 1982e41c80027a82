"""A plant in the hands of a person: `driveblocks run`, with two lines and drives of one address on both."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from tests.plant.bench import EXAMPLES

from driveblocks.cli import app

SCRIPT = """at 5s: Hmi_Reset := TRUE
at 6s: Hmi_Reset := FALSE
at 6.5s: StartNorth := TRUE; South_Start := TRUE
at 15s: StopEverything := FALSE
"""


def run(*words: object) -> Result:
    return CliRunner().invoke(app, ["run", *map(str, words)])


@pytest.mark.thorough
def test_the_motors_of_both_lines_turn_and_are_stopped(tmp_path: Path) -> None:
    script, trace = tmp_path / "script.txt", tmp_path / "trace.csv"
    script.write_text(SCRIPT, encoding="utf-8")
    said = run(EXAMPLES / "pumps.yaml", "--fast", "--for", "22s", "--script", script, "--trace", trace)
    assert said.exit_code == 0, said.stdout
    for name in ("P1", "P2", "P4", "P5"):
        assert f"{name} 40.0 Hz forward, at speed; runs as asked" in said.stdout
    assert "P3 40.0" not in said.stdout
    assert said.stdout.endswith("stopped, and standstill read: P1, P2, P3, P4, P5, P6\n")
    heads = trace.read_text("utf-8").splitlines()[1].split(",")
    assert {"StartNorth", "Level", "HardStopNorth_Closed", "P6.Running"} <= set(heads)
    assert not [each for each in heads if "Members" in each or "_Scale" in each]


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("words", "wrong"),
    [
        (("--simulate", "jscc@1"), "--simulate is for a program; a plant says itself what there is"),
        (("--map", "x.yaml"), "--map is for a program"),
        (("--tcp", "127.0.0.1:1"), "2 lines (A, B): one port can be served; simulate them"),
    ],
)
def test_what_is_not_for_a_plant_is_refused(words: tuple[str, ...], wrong: str) -> None:
    said = run(EXAMPLES / "pumps.yaml", *words)
    assert said.exit_code == 2
    assert wrong in said.stderr


@pytest.mark.thorough
def test_a_scenario_is_for_one_line(tmp_path: Path) -> None:
    scenario = tmp_path / "s.yaml"
    scenario.write_text("- at 3 s: late 20 ms 1\n", encoding="utf-8")
    said = run(EXAMPLES / "pumps.yaml", "--scenario", scenario, "--fast", "--for", "1s")
    assert (said.exit_code, said.stderr) == (
        2, "--scenario is for one line, and this program has 2; type what happens\n",
    )  # fmt: skip
    assert run(EXAMPLES / "small.yaml", "--scenario", scenario, "--fast", "--for", "4s").exit_code == 0
