"""What a status can say: numbers below and above others, signs, several bits, what forbids a start."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from tests.shapes import signs

from driveblocks.bench import runner
from driveblocks.bench.scenes.motor import POWER
from driveblocks.bench.scenes.scene import Shows, Step, scene, script
from driveblocks.bench.script import Program
from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.unit import Unit
from driveblocks.desk.run.look import _state
from driveblocks.desk.scenario import _code
from driveblocks.maps import check
from driveblocks.maps.collection import Source
from driveblocks.maps.load import loads
from driveblocks.maps.lookup import find
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError, Report
from driveblocks.meaning.roles import roles
from driveblocks.meaning.status import status
from driveblocks.output.units import units
from driveblocks.prove.facts import facts
from driveblocks.reference import text
from driveblocks.render.drive import drive_block
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Value

NAMES = tuple(signs())
RUNNING = 4
"""State of a block whose drive runs."""


@cache
def drive(name: str) -> Drive:
    """A drive by its name."""
    return loads(signs()[name], f"{name}.yaml")


def wrong(said: str) -> list[str]:
    """What the rules say of a map, without places."""
    report = Report("")
    check.check(loads(said, "map.yaml"), report)
    return [problem.wrong for problem in report.problems]


def running(name: str, *, reverse: bool = False, ms: int = 20_000) -> SimulatedDrive:
    """A drive that its keypad has started."""
    made = SimulatedDrive(drive(name), 1, Habits(coast_shows_zero=False))
    made.keypad_run(20.0, reverse=reverse)
    made.step(ms)
    return made


def shows(made: SimulatedDrive, name: str, pin: str) -> bool:
    """Whether a drive shows something."""
    return any(one.holds(made.word(one.register)) for one in status(drive(name)).shows(pin))


def rests(made: SimulatedDrive, name: str) -> bool:
    """Whether its words prove standstill."""
    return all(one.holds(made.word(one.register)) for one in status(drive(name)).standstill.patterns)


@pytest.mark.parametrize("name", NAMES)
def test_a_motor_that_runs_coasts_and_stands_is_shown_so(name: str) -> None:
    made = running(name)
    assert shows(made, name, "running")
    assert not rests(made, name)
    made.trip(1)
    made.step(1)
    assert shows(made, name, "running") == (name == "no_bit")
    made.step(60_000)
    assert not shows(made, name, "running")
    made.clear_cause()
    made.reset()
    assert rests(made, name)


def test_two_bits_are_one_run_and_names_are_not_judged() -> None:
    whole = signs()["two_bits"]
    assert wrong(whole.replace("Forward run", "Standby").replace("Reverse run", "No fault")) == []
    forgot = whole.replace("{register: 2000H, bit: 2, equals: 0}, ", "")
    with pytest.raises(MapError, match="`running` is shown by 2000H bit 2 = 1, which may be while standstill"):
        loads(forgot, "map.yaml")


@pytest.mark.parametrize(("reverse", "hertz"), [(False, 2000), (True, 0x10000 - 2000)])
def test_a_direction_is_the_sign_of_a_frequency(reverse: bool, hertz: int) -> None:
    made = running("sign", reverse=reverse)
    assert made.word(0x2001) == hertz
    assert shows(made, "sign", "reverse") == reverse


def test_a_sign_says_no_direction_at_0() -> None:
    told = {name: drive_block(drive(name)).showing for name in NAMES}
    assert told["sign"].says["reverse"] == ["(WORD_TO_INT(Reads.OutputFrequencyWord) < 0)"]
    known = {name: one.knows_direction for name, one in told.items()}
    assert known.pop("sign") == "(Reads.OutputFrequencyWord <> WORD#16#0000)"
    assert known.pop("elsewhere") == "Reads.DirectionRead"
    assert known == dict.fromkeys(known, "FALSE") | {"two_bits": "TRUE"}


@pytest.mark.parametrize(
    ("knows", "back", "state"), [(True, True, "reverse"), (True, False, "forward"), (False, False, "running")]
)
def test_a_drive_that_shows_no_direction_runs(knows: bool, back: bool, state: str) -> None:
    pin: dict[str, Value] = {"CommOk": True, "Fault": False, "StopOverdue": False, "Running": True, "AtSpeed": False}
    pin["Control.State"] = RUNNING
    assert _state(pin | {"Reverse": back, "Control.KnowsDirection": knows}, drive("sign")) == state


def test_standstill_is_below_a_frequency_of_the_map() -> None:
    tests = {name: facts(drive(name))["standstill"] for name in ("sign", "no_bit")}
    assert tests["no_bit"] == "(WORD_TO_UINT(Reads.OutputFrequencyWord) < 20)"
    assert tests["sign"].endswith(
        "(WORD_TO_UINT(Reads.OutputFrequencyWord XOR WORD#16#8000) < 32778) "
        "AND (WORD_TO_UINT(Reads.OutputFrequencyWord XOR WORD#16#8000) > 32758)"
    )
    assert status(drive("sign")).standstill.patterns[2].value == 0x10000 - 10


def test_what_forbids_a_start_is_read_before_it() -> None:
    block = drive_block(drive("forbidden"))
    assert block.showing.forbids == ["ExtendedControlBits.NoMonitoringOfTheLine", "NOT DriveStatusBits.Enabled"]
    assert roles(drive("forbidden")).verify
    assert facts(drive("forbidden"))["forbidden"] == (
        "((Reads.ExtendedControlWord AND WORD#16#4000) = WORD#16#4000) "
        "OR ((Reads.DriveStatusWord AND WORD#16#0002) = WORD#16#0000)"
    )


def test_a_simulated_drive_forbids_nothing_by_itself() -> None:
    made, forbids = running("forbidden"), status(drive("forbidden")).forbids
    assert not any(one.holds(made.word(one.register)) for each in forbids for one in each.patterns)
    assert made.hertz == 20.0


def test_one_display_stands_for_several_codes() -> None:
    one = "{code: 01H, id: OC, name: Overcurrent}"
    made = loads(signs()["sign"].replace(one, f"{one}, {{code: 02H, id: OC, name: Overcurrent in a ramp}}"), "map.yaml")
    assert [each.shown for each in find(made, "OC")] == [
        "01H  OC  fault  Overcurrent",
        "02H  OC  fault  Overcurrent in a ramp",
    ]
    assert text.fault(made, 2) == text.Texts("OC Overcurrent in a ramp", "OC Overcurrent in a ramp")
    assert _code(made, "OC") == 1


@cache
def built(name: str) -> Unit:
    """The shared blocks, and the blocks and programs of a drive."""
    return units([Source(Path(f"{name}.yaml"), drive(name))], languages(["en"], "utf-8"))[1]


def bad(unit: Unit, *programs: Program) -> list[str]:
    """What of the checks of some programs fails."""
    own = replace(unit, suite=replace(unit.suite, programs=programs))
    done = runner.run([own], [EmbeddedEngine()])
    assert done.results
    return [outcome.words for result in done.results for outcome in result.bad]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.thorough
def test_their_programs_pass(name: str) -> None:
    assert bad(built(name), *built(name).suite.programs) == []


@pytest.mark.thorough
def test_a_reverse_run_at_0_hz_goes_on() -> None:
    still: Shows = {"SpeedReferenceHz": 0.0, "RunReverse": True}
    steps = (
        Step("at 0 Hz", still, "Motor.Running", 2000, {"Reverse": False, "Seen.Starts": 1}),
        Step("it goes on", ms=1000, shows={"Running": True, "Reverse": False, "Seen.Starts": 1}),
        Step("it turns", {"SpeedReferenceHz": 20.0}, "Motor.AtSpeed", 2000, {"Reverse": True, "Seen.Starts": 1}),
    )
    made = script(drive("sign"), "sign", "MotorSign", "a sign at 0 Hz", [scene("in reverse", POWER, *steps)])
    assert bad(built("sign"), *made.programs()) == []
