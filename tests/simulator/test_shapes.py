"""Commands of every shape: a path of states, an edge, a pulse, two registers, active-low bits."""

from decimal import Decimal

import pytest
from tests.shapes import shapes
from tests.simulator.shapes import shape
from tests.simulator.talk import MAPS, Talk, talk

from driveblocks.simulator.habits import Habits

STATUS = 0x0010
READY, SWITCHED_ON, RUNNING, REVERSE, FAULT = 0x01, 0x03, 0x04, 0x44, 0x08


def write(one: Talk, *words: int) -> int:
    """Words to the control word, one after the other; the status word."""
    for word in words:
        one.write(0x0000, word)
    return one.read(STATUS)


@pytest.mark.parametrize(("run", "running"), [(0x0F, RUNNING), (0x80F, REVERSE)])
def test_a_path_of_states_is_gone_in_its_order(run: int, running: int) -> None:
    one = talk(shape("states"))
    one.hertz(20)
    assert write(one) == 0
    assert write(one, run) == 0
    assert write(one, 0x07) == 0
    assert write(one, 0x06) == READY
    assert write(one, run) == READY
    assert write(one, 0x07) == SWITCHED_ON
    assert write(one, run) == running
    one.drive.step(2000)
    assert abs(one.drive.hertz) == 20


def test_a_stop_leads_where_its_word_leads_once_the_motor_is_at_standstill() -> None:
    one = talk(shape("states"))
    one.hertz(20)
    write(one, 0x06, 0x07, 0x0F)
    one.drive.step(2000)
    assert write(one, 0x06) == RUNNING
    assert write(one, 0x07) == RUNNING
    one.drive.step(1000)
    assert one.drive.mode == "ramping down"
    one.drive.step(1000)
    assert one.read(STATUS) == SWITCHED_ON
    assert write(one, 0x07) == SWITCHED_ON
    # from here the other direction needs no more than its word; taking the voltage off ends all states
    assert write(one, 0x80F) == REVERSE
    assert write(one, 0x00) == 0
    assert write(one, 0x07) == 0
    assert write(one, 0x06, 0x00) == 0


def test_a_running_drive_takes_its_run_word_again_and_another_direction() -> None:
    one = talk(shape("states"))
    one.hertz(20)
    write(one, 0x06, 0x07, 0x0F)
    one.drive.step(2000)
    assert write(one, 0x0F) == RUNNING
    assert one.drive.hertz == 20
    write(one, 0x80F)
    one.drive.step(4000)
    assert one.drive.hertz == -20
    write(one, 0x02)
    one.drive.step(200)
    assert one.drive.hertz == -10


def test_a_state_is_waited_for() -> None:
    one = talk(shape("states"), Habits(settle_ms=50))
    assert write(one, 0x06, 0x07) == 0
    one.drive.step(50)
    assert one.read(STATUS) == READY
    assert write(one, 0x07) == READY
    one.drive.step(50)
    assert one.read(STATUS) == SWITCHED_ON


def test_a_fault_ends_the_states_and_is_reset_by_an_edge() -> None:
    one = talk(shape("states"))
    write(one, 0x06, 0x87)
    write(one, 0x07)
    one.drive.trip(5)
    assert write(one, 0x06, 0x80) == FAULT
    one.drive.clear_cause()
    assert write(one, 0x80) == FAULT
    assert write(one, 0x00) == FAULT
    assert write(one, 0x80) == 0
    one.drive.trip(5)
    one.drive.clear_cause()
    # the bit is still set: no change, no reset
    assert write(one, 0x80) == FAULT


def test_on_is_an_edge_from_its_state() -> None:
    one = talk(shape("edge"))
    one.hertz(10)
    assert write(one, 0x40F) == 0
    assert write(one, 0x40E) == READY
    assert write(one, 0x40F) == RUNNING
    one.drive.step(1000)
    assert write(one, 0x40E) == RUNNING
    one.drive.step(1000)
    assert one.read(STATUS) == READY
    one.drive.trip(1)
    one.drive.clear_cause()
    assert write(one, 0x48E) == 0
    assert write(one, 0x40F) == 0


def test_active_low_bits_stop_though_a_run_bit_is_set() -> None:
    one = talk(shape("active low"))
    one.hertz(20)
    assert write(one, 0x01) == 0
    assert write(one, 0x07) == RUNNING
    one.drive.step(2000)
    assert write(one, 0x06) == RUNNING
    one.drive.step(1000)
    assert one.drive.hertz == 10
    # both directions' words are in it; that which names more is meant
    assert write(one, 0x807) == RUNNING
    one.drive.step(4000)
    assert one.drive.hertz == -20
    assert write(one, 0x803) == REVERSE
    one.drive.step(400)
    assert one.read(STATUS) == 0
    write(one, 0x07)
    assert write(one, 0x05) == 0
    assert one.drive.mode == "standstill"


def test_a_pulse_acts_when_it_ends_and_only_if_it_was_long_enough() -> None:
    one = talk(shape("pulse"))
    one.hertz(10)
    write(one, 1)
    one.drive.step(99)
    assert write(one, 0) == 0
    write(one, 1)
    one.drive.step(100)
    assert write(one, 0) == RUNNING
    one.drive.step(1000)
    write(one, 4)
    one.drive.step(1000)
    write(one, 2)
    one.drive.step(100)
    assert write(one, 0) == REVERSE


def test_a_signed_frequency_is_cut_towards_zero() -> None:
    """0.03 Hz in reverse, in counts of 0.007 Hz."""
    one = talk(shape("two registers"), Habits(scale=Decimal("0.007")))
    one.hertz(10)
    one.write(0x0003, 1)
    one.write(0x0004, 1)
    one.drive.step(3)
    assert one.read(0x0020) == 0x10000 - 4


def test_a_direction_beside_the_start_acts_at_once() -> None:
    """Two registers: the wrong order passes through the wrong direction."""
    one = talk(shape("two registers"))
    one.hertz(10)
    one.write(0x0003, 1)
    assert one.read(STATUS) == 0
    one.write(0x0004, 1)
    assert one.read(STATUS) == REVERSE
    one.drive.step(1000)
    assert one.read(0x0020) == 0x10000 - 1000
    one.write(0x0003, 0)
    one.drive.step(2000)
    assert one.drive.hertz == 10
    one.write(0x0004, 0)
    one.drive.step(1000)
    one.write(0x0003, 1)
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
