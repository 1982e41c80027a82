"""Commands of every shape: a path of states, an edge, a pulse, two registers, active-low bits."""

from dataclasses import replace
from decimal import Decimal

import pytest
from tests.shapes import shapes
from tests.simulator.talk import MAPS, Talk, talk

from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.model import Drive

COMMAND, DIRECTION, RUN, STATUS, FREQUENCY = 0x1000, 0x1000, 0x1002, 0x2000, 0x2001
READY, SWITCHED_ON, ENABLED, DISABLED, FAULT = 0x21, 0x23, 0x27, 0x40, 0x08
"""The states of CiA 402."""


def write(one: Talk, *words: int, at: int = COMMAND) -> int:
    """Words to a register, one after the other; the low byte of the status word."""
    for word in words:
        one.write(at, word)
    return one.read(STATUS) & 0xFF


def at_20_hz(habits: Habits | None = None) -> Talk:
    """The drive by CiA 402, running."""
    one = talk(shapes()["cia402"], habits)
    one.hertz(20)
    write(one, 0x06, 0x07, 0x0F)
    one.drive.step(2000)
    return one


def test_a_path_of_states_is_gone_in_its_order() -> None:
    one = talk(shapes()["cia402"])
    one.hertz(20)
    words = (0x0F, 0x07, 0x06, 0x0F, 0x07, 0x0F)
    assert [write(one, word) for word in words] == [DISABLED, DISABLED, READY, READY, SWITCHED_ON, ENABLED]
    one.drive.step(2000)
    assert one.drive.hertz == 20
    assert write(one, 0x0F) == ENABLED


def test_a_stop_leads_where_its_word_leads_once_the_motor_is_at_standstill() -> None:
    one = at_20_hz()
    assert write(one, 0x06) == ENABLED
    one.drive.step(1000)
    assert one.drive.mode == "ramping down"
    one.drive.step(1000)
    # from here the run needs no more than the rest of its path; taking the voltage off ends all states
    assert [write(one, word) for word in (0x06, 0x07, 0x00, 0x07, 0x06)] == [
        READY, SWITCHED_ON, DISABLED, DISABLED, READY
    ]  # fmt: skip
    quick = at_20_hz()
    write(quick, 0x02)
    quick.drive.step(200)
    assert quick.drive.hertz == 10


def test_a_state_is_waited_for() -> None:
    one = talk(shapes()["cia402"], Habits(settle_ms=50))
    assert write(one, 0x06, 0x07) == DISABLED
    one.drive.step(50)
    assert write(one, 0x07) == READY
    one.drive.step(50)
    assert write(one) == SWITCHED_ON


def test_a_fault_ends_the_states_and_is_reset_by_an_edge() -> None:
    one = at_20_hz()
    one.drive.trip(5)
    assert write(one, 0x06, 0x80) == FAULT
    one.drive.clear_cause()
    one.drive.step(10_000)
    assert [write(one, word) for word in (0x80, 0x00, 0x80)] == [FAULT, FAULT, DISABLED]
    one.drive.trip(5)
    one.drive.clear_cause()
    # the bit is still set: no change, no reset
    assert write(one, 0x80) == FAULT


def test_on_is_an_edge_from_its_state_and_a_running_drive_takes_another_direction() -> None:
    one = talk(shapes()["profidrive"])
    one.hertz(10)
    assert [write(one, word) for word in (0x47F, 0x47E, 0xC7F)] == [0x40, 0x01, 0x07]
    one.drive.step(1000)
    assert (one.drive.hertz, one.read(STATUS)) == (-10, 0x4107)
    write(one, 0x47F)
    one.drive.step(2000)
    assert one.drive.hertz == 10
    assert write(one, 0x47E) == 0x07
    one.drive.step(1000)
    assert write(one) == 0x01
    one.drive.trip(1)
    one.drive.clear_cause()
    assert [write(one, word) for word in (0x4FE, 0x47F, 0x47E)] == [0x40, 0x40, 0x01]


def test_an_active_low_bit_runs_while_it_is_0() -> None:
    one = talk(shapes()["active_low"])
    one.hertz(20)
    assert [write(one, word) for word in (1, 0)] == [0, 1]
    one.drive.step(2000)
    # both directions' words are in it; that which names more is meant
    assert write(one, 2) == 1
    one.drive.step(4000)
    assert one.drive.hertz == -20
    assert write(one, 1) == 3
    one.drive.step(2000)
    assert one.drive.mode == "standstill"


def test_a_pulse_acts_when_it_ends_and_only_if_it_was_long_enough() -> None:
    one = talk(shapes()["pulse"])
    one.hertz(10)
    write(one, 1)
    one.drive.step(99)
    assert write(one, 0) == 0
    write(one, 1)
    one.drive.step(100)
    assert write(one, 0) == 1
    one.drive.step(1000)
    write(one, 4)
    one.drive.step(1000)
    write(one, 2)
    one.drive.step(100)
    assert write(one, 0) == 3


def signed() -> Drive:
    """Two registers, and a signed output frequency without a scale."""
    drive = shapes()["two_registers"]
    commands, status = drive.sections
    first, frequency, *others = status.registers
    rows = (first, replace(frequency, signed=True, scale=None), *others)
    return replace(drive, sections=(commands, replace(status, registers=rows)))


def test_a_signed_frequency_is_cut_towards_zero() -> None:
    """0.03 Hz in reverse, in counts of 0.007 Hz."""
    one = talk(signed(), Habits(scale=Decimal("0.007")))
    one.hertz(10)
    write(one, 1)
    write(one, 1, at=RUN)
    one.drive.step(3)
    assert one.read(FREQUENCY) == 0x10000 - 4


def test_a_direction_beside_the_start_acts_at_once() -> None:
    """Two registers: the wrong order passes through the wrong direction."""
    one = talk(signed())
    one.hertz(10)
    assert write(one, 1, at=DIRECTION) == 0
    assert write(one, 1, at=RUN) == 3
    one.drive.step(1000)
    assert one.read(FREQUENCY) == 0x10000 - 1000
    write(one, 0, at=DIRECTION)
    one.drive.step(2000)
    assert one.drive.hertz == 10
    write(one, 0, at=RUN)
    one.drive.step(1000)
    write(one, 1, at=DIRECTION)
    assert one.drive.mode == "standstill"


@pytest.mark.parametrize(
    ("name", "word", "mask"), [("cia402", 0x40, 0x6F), ("profidrive", 0x40, 0x47), ("ATV312", 0x40, 0x4F)]
)
def test_a_drive_of_states_that_is_in_none_says_that_switching_on_is_disabled(name: str, word: int, mask: int) -> None:
    drive = (shapes() | MAPS)[name]
    one = talk(drive)
    register = drive.operation.states[0].register
    assert one.drive.word(register) & mask == word
    one.drive.trip(1)
    assert one.drive.word(register) & 0x40 == 0


def test_a_reset_with_the_run_bits_starts_a_drive_that_waits_for_the_edge() -> None:
    one = talk(shapes()["profidrive"])
    one.hertz(10)
    assert [write(one, word) for word in (0x47E, 0x4FE, 0x4FF)] == [0x01, 0x01, 0x07]
    for stop, hz in ((0x47B, 0), (0x47D, 0)):
        write(one, stop)
        one.drive.step(10_000)
        assert one.drive.hertz == hz
