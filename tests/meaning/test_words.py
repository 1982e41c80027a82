"""Which words may move a motor, which stop it: typed from the tables of makers, and a walk over every content."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from itertools import product
from typing import Any

import pytest
from tests.shapes import shapes

from driveblocks.maps import catalog
from driveblocks.maps.form import Span
from driveblocks.maps.load import load, loads
from driveblocks.maps.model import Bit, By, Command, Does, Drive, Step, Value
from driveblocks.maps.page import skeleton
from driveblocks.maps.problem import Report
from driveblocks.maps.rules import word
from driveblocks.meaning.words import Held, words

CONTROL = 0x1000


def bit(
    at: int | tuple[int, int], does: str, at_0: str = "", *, name: str = "", by: By | None = None, holds: bool = False
) -> Bit:
    """A row of a control word: what the bit does at 1, and at 0."""
    span = Span(*at) if isinstance(at, tuple) else Span(at, at)
    acts: Any = (tuple(does.split()), tuple(at_0.split()))
    return Bit(bit=span, name=name or None, does=acts[0], at_0=acts[1], by=by, holds=holds)


STARTS = bit(0, "starts", "stops", name="ON/OFF1", by="edge")
V20 = (
    STARTS, bit(1, "enables", "coasts", name="OFF2", holds=True),
    bit(2, "enables", "quick_stops", name="OFF3", holds=True),
    bit(3, "enables", "coasts", name="Pulse enable", holds=True), bit(4, "enables", name="RFG enable"),
    bit(5, "enables", name="RFG start"), bit(6, "enables", name="Setpoint enable"),
    bit(7, "resets", name="Fault acknowledge", by="edge"), bit(8, "jogs", name="Jog right"),
    bit(9, "jogs reverses", name="Jog left"), bit(10, "enables", "hands_over", name="Control from PLC"),
    bit(11, "reverses", name="Reverse"), bit(13, "nothing", name="MOP up"), bit(14, "nothing", name="MOP down"),
)  # fmt: skip
"""Siemens' names of its control word."""
ABB = (
    STARTS, bit(1, "enables", "coasts", name="OFF2 CONTROL", holds=True),
    bit(2, "enables", "quick_stops", name="OFF3 CONTROL", holds=True),
    bit(3, "starts", "coasts", name="INHIBIT OPERATION", holds=True),
    bit(4, "enables", "stops", name="RAMP_OUT_ZERO", holds=True), bit(5, "enables", name="RAMP_HOLD"),
    bit(6, "enables", "stops", name="RAMP_IN_ZERO", holds=True), bit(7, "resets", name="RESET", by="edge"),
    bit(10, "enables", name="REMOTE_CMD"),
)  # fmt: skip
"""ABB drives profile: OFF1 does not win over bit 3, whose start is a level, unless the map says so."""
ABB_OFF1 = (replace(STARTS, holds=True), *ABB[1:])
CIA402 = (
    bit(0, "enables", name="Switch on"), bit(1, "enables", "coasts", name="Enable voltage", holds=True),
    bit(2, "enables", "quick_stops", name="Quick stop", holds=True), bit(3, "starts", "stops", name="Enable operation"),
    bit(7, "resets", name="Fault reset", by="edge"), bit(8, "stops", name="Halt", holds=True),
)  # fmt: skip
POWERFLEX = (
    bit(0, "stops", name="Stop"), bit(1, "starts", name="Start"), bit(2, "jogs", name="Jog"),
    bit(3, "resets", name="Clear faults"),
    replace(bit((4, 5), "reverses", name="Direction"), values=(Value(value=1, name="Forward", does=("forward",)),)),
)  # fmt: skip
POWERFLEX_STOP = (replace(POWERFLEX[0], holds=True), *POWERFLEX[1:])
"""A PowerFlex whose manual would say that its stop wins."""


def drive(bits: tuple[Bit, ...], *commands: Command) -> Drive:
    """The drive of the skeleton with another control word."""
    plain = loads(skeleton(), "acme.yaml")
    first, *others = plain.sections
    row = replace(first.registers[0], values=(), bits=bits)
    sections = (replace(first, registers=(row, *first.registers[1:])), *others)
    known = commands or plain.operation.commands
    return replace(plain, sections=sections, operation=replace(plain.operation, commands=known))


def command(does: Does, *values: int) -> Command:
    """A command that writes these words, one after the other."""
    *first, last = values
    return Command(
        does=does,
        register=CONTROL,
        value=last,
        first=tuple(Step(register=CONTROL, value=each) for each in first),
        source="",
    )


def said(bits: tuple[Bit, ...], *commands: Command) -> list[str]:
    """What `check` says of these commands of a control word."""
    report = Report("")
    word.check(drive(bits, *commands), {one.does for one in commands}, report)
    return [problem.wrong for problem in report.problems]


REFUSED = {
    "V20: a reset with the run bits": (V20, command("fault_reset", 0x04FF), "bit 0 `ON/OFF1` at 1 starts"),
    "ABB: a reset with the run bits": (ABB_OFF1, command("fault_reset", 0x04FF), "bit 0 `ON/OFF1` at 1 starts"),
    "V20: the same, after a word without": (V20, command("fault_reset", 0x047E, 0x04FF), "bit 0 `ON/OFF1` at 1"),
    "V20: OFF1 is no stop that holds a jog": (V20, command("stop", 0x057E), "bit 8 `Jog right` at 1 starts a jog"),
    "a stop that is the run of the path": (V20, command("stop", 0x047F), "bit 0 `ON/OFF1` at 1 starts the motor"),
    "PowerFlex: start with clear faults": (POWERFLEX, command("fault_reset", 0x000A), "bit 1 `Start` at 1"),
    "PowerFlex: start with stop": (POWERFLEX, command("fault_reset", 0x000B), "bit 1 `Start` at 1"),
    "PowerFlex: start with stop as a stop": (POWERFLEX, command("stop", 0x0003), "bit 1 `Start` at 1"),
    "CiA 402: the run as a stop": (CIA402, command("stop", 0x000F), "bit 3 `Enable operation` at 1 starts the motor"),
    "CiA 402: a bit that nobody declares": (CIA402, command("stop", 0x0017), "nothing says what bit 4 at 1 does"),
    "V20: command to the keypad": (V20, command("stop", 0x007E), "bit A `Control from PLC` at 0 gives the drive"),
    "a step that starts": (V20, command("run_forward", 0x047F, 0x047E, 0x047F), "before its last write"),
    "ABB: a level left on, where OFF1 does not win": (ABB, command("stop", 0x047E), "bit 3 `INHIBIT OPERATION` at 1"),
}  # fmt: skip
ACCEPTED = {
    "V20: acknowledge": (V20, command("fault_reset", 0x047E, 0x04FE)),
    "ABB: reset": (ABB_OFF1, command("fault_reset", 0x04FE)),
    "V20: OFF1": (V20, command("stop", 0x047E)),
    "V20: OFF3 with ON": (V20, command("quick_stop", 0x047B)),
    "V20: OFF3": (V20, command("quick_stop", 0x047A)),
    "V20: OFF2 with ON": (V20, command("coast_stop", 0x047D)),
    "V20: OFF2": (V20, command("coast_stop", 0x047C)),
    "ABB: OFF1": (ABB_OFF1, command("stop", 0x047E)),
    "ABB: OFF3 with ON": (ABB, command("quick_stop", 0x047B)),
    "ABB: OFF2 with ON": (ABB, command("coast_stop", 0x047D)),
    "ABB: its own path": (ABB_OFF1, command("run_forward", 0x0406, 0x0407, 0x040F, 0x041F, 0x043F, 0x047F)),
    "V20: its own path": (V20, command("run_forward", 0x047E, 0x047F)),
    "V20: reverse": (V20, command("run_reverse", 0x047E, 0x0C7F)),
    "CiA 402: quick stop with operation enabled": (CIA402, command("quick_stop", 0x000B)),
    "CiA 402: halt with operation enabled": (CIA402, command("stop", 0x010F)),
    "CiA 402: disable operation": (CIA402, command("stop", 0x0007)),
    "CiA 402: its own path": (CIA402, command("run_forward", 0x0006, 0x0007, 0x000F)),
    "PowerFlex: clear faults": (POWERFLEX, command("fault_reset", 0x0008)),
    "PowerFlex: start with stop, where the stop wins": (POWERFLEX_STOP, command("fault_reset", 0x000B)),
    "PowerFlex: run": (POWERFLEX, command("run_forward", 0x0012)),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_word_that_may_move_the_motor_is_refused(name: str) -> None:
    bits, one, told = REFUSED[name]
    assert any(told in each for each in said(bits, one)), said(bits, one)


@pytest.mark.parametrize("name", ACCEPTED)
def test_a_word_that_cannot_is_accepted(name: str) -> None:
    assert said(*ACCEPTED[name]) == []


@pytest.mark.parametrize("value", [5, 6, 7, 8])
def test_a_value_command_is_what_it_is_declared_to_be(value: int) -> None:
    chf = words(load(next(path for path in catalog.shipped() if path.stem == "invt_chf")))
    control = chf.at(CONTROL)
    assert control is not None
    assert control.moves(Held(0xFFFF, value)) is None


def test_a_value_that_nobody_lists_counts_as_starting() -> None:
    gd200a = words(load(next(path for path in catalog.shipped() if path.stem == "invt_gd200a")))
    control = gd200a.at(0x2000)
    assert control is not None
    cause = control.moves(Held(0xFFFF, 0x080F))
    assert cause is not None
    assert not cause.effect.declared


def test_a_start_by_its_edge_needs_one() -> None:
    control = words(drive(V20)).at(CONTROL)
    assert control is not None
    assert control.moves(Held(0xFFFF, 0x047F)) is not None
    assert control.moves(Held(0xFFFF, 0x047F), Held(0xFFFF, 0x047E)) is not None
    assert control.moves(Held(0xFFFF, 0x047F), Held(0xFFFF, 0x04FF)) is None


def test_what_a_word_may_do_is_what_some_of_its_contents_do() -> None:
    """Against a walk over every content: a word that is known in part may do what any word does that it may be."""
    control = words(drive(V20)).at(CONTROL)
    assert control is not None
    for known, is_ in product(range(16), repeat=2):
        held = Held(0xFFF0 | known, 0x0470 | is_ & known)
        contents = [0x0470 | each for each in range(16) if (each ^ is_) & known == 0]
        moved = [each for each in contents if control.moves(Held(0xFFFF, each)) is not None]
        assert bool(moved) <= (control.moves(held) is not None), (known, is_)
        if control.moves(held) is not None and not moved:
            assert held.known != 0xFFFF


def _inside(value: Any) -> list[Any]:
    """Everything that a dataclass reaches."""
    if is_dataclass(value) and not isinstance(value, type):
        return [value, *(each for one in fields(value) for each in _inside(getattr(value, one.name)))]
    if isinstance(value, (tuple, list, frozenset, set)):
        return [each for one in value for each in _inside(one)]
    return (
        [value, *(each for one in value.values() for each in _inside(one))] if isinstance(value, Mapping) else [value]
    )


@pytest.mark.every_family
def test_no_object_of_a_map_is_reached_from_what_words_mean() -> None:
    for path in catalog.shipped():
        reached = {type(each).__module__ for each in _inside(words(load(path))) if not isinstance(each, int)}
        assert not [name for name in reached if ".maps" in name], path.stem


@pytest.mark.every_family
def test_every_stop_and_reset_of_a_shipped_map_leaves_the_motor_still() -> None:
    for path in catalog.shipped():
        known = words(load(path))
        for one in known.commands:
            moving = known.moving(one)
            assert bool(moving) == (one.does in ("run_forward", "run_reverse", "jog_forward", "jog_reverse")), one.does


def test_the_shapes_move_by_the_write_that_starts() -> None:
    starts = {
        name: [
            at
            for at, _, _ in words(each).moving(next(one for one in words(each).commands if one.does == "run_forward"))
        ]
        for name, each in shapes().items()
    }
    assert starts == {
        "cia402": [2],
        "profidrive": [1],
        "pulse": [0],
        "two_registers": [1],
        "active_low": [0],
        "packed": [0],
    }


@pytest.mark.parametrize(
    ("value", "says"),
    [
        (0x04FF, "starts the motor, by bit 0 `ON/OFF1` at 1"), (0x04FE, "stops the motor and resets a fault"),
        (0x047D, "lets the motor coast"), (0x057F, "starts the motor, by bit 0 `ON/OFF1` at 1"),
        (0x057E, "starts a jog, by bit 8 `Jog right` at 1"),
        (0x007E, "stops the motor and gives the drive to somebody else"),
    ],
)  # fmt: skip
def test_a_word_is_said_by_what_its_fields_do(value: int, says: str) -> None:
    control = words(drive(V20)).at(CONTROL)
    assert control is not None
    assert control.says(value) == says


def test_a_field_that_is_kept_holds_nothing_for_certain() -> None:
    stop = replace(bit((12, 13), "stops", name="Way to stop"), holds=True)
    control = words(drive((*POWERFLEX, stop))).at(CONTROL)
    assert control is not None
    assert control.moves(Held(0x3FFF, 0x0002)) is not None
    assert control.moves(Held(0xCFFF, 0x0002)) is not None
    assert control.moves(Held(0xFFFF, 0x1002)) is None
