"""A run beside its screen, keyboard and prompts; the clock of the scans is virtual here, too."""

import os
from collections.abc import Callable, Iterator

import pytest
from tests.desk.run.desk import EXAMPLE, Desk

from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.run import live, permission
from driveblocks.desk.run.session import Result
from driveblocks.desk.seen import View


class Noted:
    """A screen that notes what it is reported, or is gone."""

    def __init__(self, fails: BaseException | None = None) -> None:
        self.lines: list[str] = []
        self.shown = 0
        self._fails = fails

    def say(self, text: str) -> None:
        self.lines.append(text)

    def show(self, _: View) -> None:
        self.shown += 1
        if self._fails is not None:
            raise self._fails

    def close(self) -> None:
        if self._fails is not None:
            raise OSError(5, "Input/output error")


@pytest.fixture
def keys() -> Iterator[Callable[[str], Keyboard]]:
    """A keyboard at which somebody types a text, and then leaves."""
    opened = []

    def made(text: str) -> Keyboard:
        reader, writer = os.pipe()
        os.write(writer, text.encode())
        os.close(writer)
        opened.append(reader)
        return Keyboard(reader)

    yield made
    for each in opened:
        os.close(each)


def run(desk: Desk, screen: Noted, keyboard: Keyboard | None = None, *, end_of_input: bool = False) -> Result:
    """For ten virtual seconds at most."""
    return live.run(desk.session, screen, keyboard, None if end_of_input else 10_000_000, end_of_input=end_of_input)


def test_the_end_of_the_input_stops_every_drive(keys: Callable[[str], Keyboard]) -> None:
    desk, screen = Desk(), Noted()
    result = run(desk, screen, keys("Hz := 10\nfoo\n\n"), end_of_input=True)
    assert (result.reason, result.unconfirmed, result.stopped) == ("the input has ended", {}, ("Motor",))
    assert {"the program has no variable foo", "the input has ended: stopping every drive"} <= set(screen.lines)


def test_q_stops_every_drive_and_help_says_what_may_be_typed(keys: Callable[[str], Keyboard]) -> None:
    desk, screen = Desk(), Noted()
    result = run(desk, screen, keys("help\nq\n"), end_of_input=True)
    assert (result.reason, result.unconfirmed, result.stopped) == ("q", {}, ("Motor",))
    assert screen.lines[:3] == list(live.HELP[:3])
    assert live.HELP[-1] not in screen.lines, "nobody can trip a drive that is not simulated here"


def test_a_pipe_that_has_ended_does_not_end_a_simulation(keys: Callable[[str], Keyboard]) -> None:
    desk = Desk()
    assert run(desk, Noted(), keys("Hz := 10")).reason == "10 s are over"
    assert desk.instance["Hz"] == 10.0


@pytest.mark.parametrize("fails", [BrokenPipeError(32, "Broken pipe"), ValueError("no"), KeyboardInterrupt()])
def test_a_lost_terminal_stops_every_drive(fails: BaseException) -> None:
    desk = Desk()
    desk.session.script = ()
    result = live.run(desk.session, Noted(fails), None, None, end_of_input=False)
    assert result.reason.startswith("the screen has failed: ")
    assert result.stopped == ("Motor",)


# ------------------------------------------------------------ who may run


@pytest.mark.parametrize(
    ("typed", "allowed"),
    [
        ("Pump1 1\nWIRED\nPump2 2\nWIRED\nFan 3\nWIRED\n", {(1, "Pump1"), (2, "Pump2"), (3, "Fan")}),
        ("Pump1 1\nwired\nPump2 3\nFan 3\nWIRED\n", {(3, "Fan")}),
        ("\n\n\n", set()),
        ("", set()),
        ("y\nyes\nFan\n", set()),
    ],
)
def test_a_drive_runs_where_its_name_and_unit_and_the_hard_stop_are_typed(
    typed: str, allowed: set[tuple[int, str]], keys: Callable[[str], Keyboard], capsys: pytest.CaptureFixture[str]
) -> None:
    desk = Desk(EXAMPLE.read_text(encoding="utf-8")).scan(10)
    assert permission.ask(desk.controller, keys(typed)) == allowed
    said = capsys.readouterr().out
    assert (
        said.count("REAL PORT. To let") == sum(line.startswith("REAL PORT. To let") for line in said.split("\n")) == 3
    )
    assert said.count("reads and stops only") == 3 - len(allowed)


@pytest.mark.parametrize(("watchdog_ms", "allowed"), [(1500, {(1, "Pump1")}), (65535, set()), (0, set())])
def test_a_watchdog_takes_the_place_of_the_typed_hard_stop(
    watchdog_ms: int, allowed: set[tuple[int, str]], keys: Callable[[str], Keyboard]
) -> None:
    text = EXAMPLE.read_text(encoding="utf-8").replace("Address := 1,", "Address := 1, Settings := Fed,")
    text = text.replace("  HardStop :", f"  Fed : VFD_Settings := (WatchdogMs := {watchdog_ms});\n  HardStop :")
    assert permission.ask(Desk(text).scan(10).controller, keys("Pump1 1\n")) == allowed
