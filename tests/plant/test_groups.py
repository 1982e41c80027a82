"""Groups of drives: who is started when, call by call, with the pins of the drives typed by hand."""

from collections.abc import Mapping

import pytest

from driveblocks.desk.run import source
from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.engine import Value

PINS = """
PROGRAM Pins
VAR
  Run : BOOL; Restart : BOOL; Chain : BOOL; Count : UINT := 3; Duty : UINT := 1; Change : UINT; DelayMs : UINT;
  ElapsedMs : UINT := 10;
  Members : VFD_Members; Group : {block};
END_VAR
  Group(ElapsedMs := ElapsedMs, {pins}, Run := Run, Restart := Restart, Count := Count, Members := Members);
END_PROGRAM
"""
READY = {"CommOk": True, "Ready": True, "Running": False, "Fault": False, "StopConfirmed": True, "Halted": False}
RUNNING = READY | {"Ready": False, "Running": True, "StopConfirmed": False}
TRIPPED = RUNNING | {"Fault": True, "Running": False}
SILENT = dict.fromkeys(READY, False)
STANDS = READY | {"Ready": False, "Fault": True}


class Group:
    """A group block, and what its drives show."""

    def __init__(self, block: str, count: int = 3, **pins: Value) -> None:
        given = {"VFD_Duty": "Duty := Duty, Change := Change"}.get(block, "Chain := Chain, DelayMs := DelayMs")
        made = source.load("pins.st", PINS.format(block=block, pins=given), source.known([]))
        self.program: EmbeddedInstance = made.library.instance("Pins")
        self.count = count
        for name, value in {"Count": count, **pins}.items():
            self.program[name] = value

    def show(self, *members: Mapping[str, Value]) -> None:
        for number, pins in enumerate(members):
            for name, value in pins.items():
                self.program[f"Members[{number}].{name}"] = value

    def call(self, run: Value | None = None, **pins: Value) -> list[bool]:
        """Call the group; which members it wants to run."""
        for name, value in ({} if run is None else {"Run": run} | pins).items():
            self.program[name] = value
        self.program.scan()
        return [bool(self.program[f"Members[{number}].Run"]) for number in range(self.count)]

    def follow(self) -> None:
        """The drives do what the group wants: they run, or stand."""
        for number in range(self.count):
            wanted, comm = self.program[f"Members[{number}].Run"], self.program[f"Members[{number}].CommOk"]
            if comm and not self.program[f"Members[{number}].Fault"]:
                self.show_one(number, RUNNING if wanted else READY)

    def show_one(self, number: int, pins: Mapping[str, Value]) -> None:
        for name, value in pins.items():
            self.program[f"Members[{number}].{name}"] = value

    def __getitem__(self, pin: str) -> Value:
        return self.program[f"Group.{pin}"]


@pytest.fixture
def pumps() -> Group:
    """Three of which one runs; the first was started by an edge."""
    made = Group("VFD_Duty")
    made.show(READY, READY, READY)
    made.call(False)
    assert made.call(True) == [True, False, False]
    made.follow()
    return made


def test_command_that_was_held_before_starts_nothing() -> None:
    for block in ("VFD_Duty", "VFD_Group"):
        made = Group(block)
        assert made.call(True, Restart=True) == [False] * 3
        made.show(READY, READY, READY)
        assert made.call(True, Restart=False) == [False] * 3
        assert made.call(True) == [False] * 3
        assert made["Ended"]
        assert block == "VFD_Group" or not made["Short"]
        made.call(False)
        assert any(made.call(True))


def test_edge_in_the_scan_of_a_restart_starts_nothing() -> None:
    for block in ("VFD_Duty", "VFD_Group"):
        made = Group(block)
        made.show(READY, READY, READY)
        made.call(False)
        assert made.call(True, Restart=True) == [False] * 3
        assert made.call(True, Restart=False) == [False] * 3


def test_command_of_the_first_call_starts_nothing_where_no_drive_is_known() -> None:
    made = Group("VFD_Duty")
    assert made.call(True) == [False] * 3
    made.show(READY, READY, READY)
    assert made.call(True) == [False] * 3


@pytest.mark.parametrize("block", ["VFD_Duty", "VFD_Group"])
def test_call_that_comes_late_acts_like_a_restart(block: str) -> None:
    made = Group(block)
    made.show(READY, READY, READY)
    made.call(False)
    assert any(made.call(True, ElapsedMs=1000))
    made.follow()
    assert any(made.call(True))
    assert made.call(True, ElapsedMs=1001) == [False] * 3
    made.show(READY, READY, READY)
    assert made.call(True, ElapsedMs=10) == [False] * 3


def test_drive_that_fell_silent_does_not_take_a_place_again() -> None:
    made = Group("VFD_Duty", Duty=2)
    made.show(READY, READY, READY)
    made.call(False)
    assert made.call(True) == [True, True, False]
    made.follow()
    made.show(SILENT, SILENT, SILENT)
    made.call(True)
    made.show(READY, READY, READY)
    assert made.call(True) == [False, False, True]
    made.follow()
    assert made.call(True) == [False, False, True]
    assert made["Short"]
    made.call(False)
    made.follow()
    assert made.call(True) == [True, True, False]


def test_drive_that_was_stopped_elsewhere_is_no_standby() -> None:
    made = Group("VFD_Duty", Duty=2)
    made.show(READY, READY)
    made.call(False)
    assert made.call(True) == [True, True, False]
    made.show_one(1, RUNNING)
    assert made.call(True) == [False, True, False]
    made.show_one(1, STANDS)
    assert made.call(True) == [False] * 3


@pytest.mark.parametrize("hand", [STANDS, READY | {"Halted": True, "Ready": False}])
def test_drive_that_a_hand_has_put_right_is_a_standby_again(pumps: Group, hand: dict[str, Value]) -> None:
    pumps.show_one(0, STANDS)
    assert pumps.call(True) == [False, True, False]
    pumps.follow()
    pumps.show_one(0, hand)
    pumps.call(True)
    pumps.show_one(0, READY)
    assert pumps.call(True) == [False, True, False]
    pumps.show_one(1, STANDS)
    assert pumps.call(True) == [True, False, False]


def test_restart_stops_all_until_a_new_edge(pumps: Group) -> None:
    assert pumps.call(True, Restart=True) == [False] * 3
    pumps.show(READY, READY, READY)
    assert pumps.call(True, Restart=False) == [False] * 3
    pumps.call(False)
    assert pumps.call(True) == [True, False, False]


def test_standby_waits_for_the_proof_that_the_other_stands(pumps: Group) -> None:
    pumps.show_one(0, TRIPPED)
    for _ in range(5):
        assert pumps.call(True) == [False] * 3
        assert pumps["Waiting"]
        assert not pumps["Ended"]
    pumps.show_one(0, STANDS)
    assert pumps.call(True) == [False, True, False]
    pumps.follow()
    assert pumps.call(True) == [False, True, False]
    assert not pumps["Waiting"]
    assert not pumps["Short"]


def test_silent_drive_is_not_replaced(pumps: Group) -> None:
    pumps.show_one(0, SILENT)
    for _ in range(5):
        assert pumps.call(True) == [False] * 3
    pumps.show_one(0, RUNNING)
    assert pumps.call(True) == [False] * 3
    pumps.show_one(0, READY | {"Ready": False})
    assert pumps.call(True) == [False, True, False]


def test_silence_of_a_standby_starts_nothing(pumps: Group) -> None:
    pumps.show_one(1, SILENT)
    assert pumps.call(True) == [True, False, False]
    pumps.show_one(0, STANDS)
    assert pumps.call(True) == [False, False, True]


@pytest.mark.parametrize("first", [TRIPPED, SILENT])
def test_reset_before_the_proof_ends_it(pumps: Group, first: Mapping[str, Value]) -> None:
    pumps.show_one(0, first)
    pumps.call(True)
    pumps.show_one(0, TRIPPED)
    pumps.call(True)
    pumps.show_one(0, SILENT)
    pumps.call(True)
    assert pumps["Waiting"]
    pumps.show_one(0, RUNNING | {"Running": False})
    assert pumps.call(True) == [False] * 3
    assert not pumps["Waiting"]
    pumps.show_one(0, READY)
    assert pumps.call(True) == [False] * 3
    pumps.call(False)
    assert pumps.call(True) == [True, False, False]
    pumps.follow()
    pumps.show_one(0, SILENT)
    pumps.call(True)
    pumps.show_one(0, READY | {"Ready": False})
    assert pumps.call(True) == [False, True, False]


def test_stop_while_the_proof_is_waited_for_ends_it(pumps: Group) -> None:
    pumps.show_one(0, TRIPPED)
    pumps.call(True)
    assert pumps.call(False) == [False] * 3
    pumps.show_one(0, STANDS)
    assert pumps.call(False) == [False] * 3
    assert not pumps["Waiting"]


@pytest.mark.parametrize("last", [READY, TRIPPED | {"Halted": True}, STANDS | {"Halted": True}])
def test_drive_that_a_hand_stopped_is_not_replaced(pumps: Group, last: Mapping[str, Value]) -> None:
    pumps.show_one(0, last)
    assert pumps.call(True) == [False] * 3
    pumps.show_one(0, STANDS)
    assert pumps.call(True) == [False] * 3
    assert pumps["Ended"]


def test_hand_between_fault_and_proof_ends_it(pumps: Group) -> None:
    pumps.show_one(0, TRIPPED)
    pumps.call(True)
    pumps.show_one(0, {"Halted": True})
    pumps.call(True)
    pumps.show_one(0, STANDS)
    assert pumps.call(True) == [False] * 3


def test_reset_of_a_fault_starts_nothing(pumps: Group) -> None:
    pumps.show(STANDS, STANDS, STANDS)
    assert pumps.call(True) == [False] * 3
    assert pumps["Short"]
    pumps.show(READY, READY, READY)
    assert pumps.call(True) == [False] * 3
    pumps.call(False)
    assert pumps.call(True) == [True, False, False]


def test_motors_that_still_turn_hold_their_places() -> None:
    made = Group("VFD_Duty", Duty=2)
    made.show(RUNNING, READY, READY)
    made.call(False)
    assert made.call(True) == [False, True, False]
    assert made["Ready"]


def test_places_that_nobody_could_fill_stay_empty() -> None:
    made = Group("VFD_Duty", Duty=2)
    made.show(READY, SILENT, SILENT)
    made.call(False)
    assert made.call(True) == [True, False, False]
    made.follow()
    assert made["Short"]
    made.show_one(1, READY)
    assert made.call(True) == [True, False, False]


def test_two_that_trip_together_are_both_replaced() -> None:
    made = Group("VFD_Duty", count=4, Duty=2)
    made.show(READY, READY, READY, READY)
    made.call(False)
    assert made.call(True) == [True, True, False, False]
    made.show(STANDS, STANDS)
    assert made.call(True) == [False, False, True, True]


@pytest.mark.parametrize(("change", "first"), [(0, 0), (1, 2), (2, 1)])
def test_first_is_the_one_that_the_change_says(change: int, first: int) -> None:
    made = Group("VFD_Duty", Change=change)
    for number, (starts, run_s) in enumerate([(5, 500), (4, 100), (3, 300)]):
        made.show_one(number, READY | {"Starts": starts, "RunS": run_s})
    made.call(False)
    assert made.call(True).index(True) == first


def test_of_equals_the_first_starts() -> None:
    made = Group("VFD_Duty", Change=1)
    made.show(READY, READY, READY)
    made.call(False)
    assert made.call(True) == [True, False, False]


def test_together_starts_those_that_are_ready_and_one_that_ends_stays_off() -> None:
    made = Group("VFD_Group")
    made.show(READY, STANDS, READY)
    made.call(False)
    assert made.call(True) == [True, False, True]
    made.follow()
    made.show_one(0, TRIPPED)
    assert made.call(True) == [False, False, True]
    made.show_one(0, READY)
    assert made.call(True) == [False, False, True]
    assert made["Running"]
    assert made.call(False) == [False] * 3


def test_sequence_starts_one_after_the_other_and_stops_at_once() -> None:
    made = Group("VFD_Group", Chain=True, DelayMs=30)
    made.show(READY, READY, READY)
    made.call(False)
    steps = []
    for _ in range(8):
        steps.append(sum(made.call(True)))
        made.follow()
    assert steps == [1, 1, 1, 2, 2, 2, 3, 3]
    assert made.call(False) == [False] * 3
    made.follow()
    assert made.call(True) == [True, False, False]


def test_sequence_waits_until_the_one_before_runs() -> None:
    made = Group("VFD_Group", Chain=True, DelayMs=0)
    made.show(READY, READY, READY)
    made.call(False)
    assert made.call(True) == [True, False, False]
    made.show_one(0, RUNNING | {"Running": False})
    assert made.call(True) == [True, False, False]
    made.show_one(0, RUNNING)
    assert made.call(True) == [True, True, False]


@pytest.mark.parametrize("ends", [TRIPPED, SILENT, READY, RUNNING | {"Halted": True}])
@pytest.mark.parametrize("which", [0, 1])
def test_one_that_ends_ends_the_sequence(ends: Mapping[str, Value], which: int) -> None:
    made = Group("VFD_Group", count=2, Chain=True)
    made.show(READY, READY)
    made.call(False)
    for _ in range(3):
        made.call(True)
        made.follow()
    made.show_one(which, ends)
    assert made.call(True) == [False, False]
    made.follow()
    assert made.call(True) == [False, False]
    assert made["Ended"]


def test_sequence_starts_none_unless_each_is_ready() -> None:
    made = Group("VFD_Group", Chain=True)
    made.show(READY, READY, STANDS)
    made.call(False)
    assert made.call(True) == [False] * 3
    assert not made["Ready"]
    made.show_one(2, READY)
    assert made.call(True) == [False] * 3


def test_sequence_ends_where_the_next_is_not_ready_any_more() -> None:
    made = Group("VFD_Group", Chain=True, DelayMs=0)
    made.show(READY, READY, READY)
    made.call(False)
    made.call(True)
    made.follow()
    made.show_one(1, STANDS)
    assert made.call(True) == [False] * 3


def test_reset_counts_for_one_fault() -> None:
    made = Group("VFD_Duty", Duty=2)
    made.show(READY, READY, READY)
    made.call(False)
    made.call(True)
    made.follow()
    made.show_one(0, STANDS)
    assert made.call(True) == [False, True, True]
    made.follow()
    made.show_one(0, READY)
    made.call(True)
    made.show_one(1, STANDS)
    assert made.call(True) == [True, False, True]
    made.follow()
    made.show_one(0, READY)
    assert made.call(True) == [False, False, True]
    made.show_one(2, STANDS)
    assert made.call(True) == [False] * 3
