"""A slot whose stop is not known yet (FunctionCode 0): nothing is sent, reads pass, and it is overdue as if unsent."""

import pytest
from tests.line.vline import STOP, Bench, Config


def unknown(config: Config | None = None) -> Bench:
    """A line where the drive block of slot 1 does not know yet whom it talks to."""
    bench = Bench(config).ready()
    bench.fill(1, STOP, 0, 0)
    bench.run(50)
    return bench


def ask_for_it(bench: Bench, how: str) -> None:
    """A stop of slot 1, by its drive block or by the line."""
    if how == "posted":
        bench.stop(1)
    elif how == "StopAll":
        bench.set(StopAll=True)
    else:
        bench.attended.discard(1)
        bench.run(1000)


@pytest.mark.parametrize("how", ["posted", "StopAll", "not called"])
def test_it_is_not_sent_and_overdue_in_time(how: str) -> None:
    bench = unknown()
    ask_for_it(bench, how)
    sent = bench.run(bench["WorstStopMs"] - 20)
    assert not bench.slot(1, "StopOverdue")
    sent += bench.run(5000)
    assert bench.slot(1, "StopOverdue")
    assert not [each for each in sent if each.unit == 2 and not each.read], "the stop of one make is the run of another"
    assert not bench.slot(0, "StopOverdue")


@pytest.mark.parametrize("how", ["posted", "StopAll"])
def test_once_it_is_known_it_is_sent_at_once(how: str) -> None:
    bench = unknown()
    ask_for_it(bench, how)
    bench.run(3000)
    bench.fill_as_kind(1)
    sent = bench.run(60)
    assert [each.unit for each in sent if each.stop and each.unit == 2] == [2]
    bench.run(60)
    assert not bench.slot(1, "StopOverdue")


def test_a_copy_of_before_is_not_sent_either() -> None:
    """The drive was silent for long, and its block asks again whom it talks to; then the block is gone."""
    bench = Bench().ready()
    assert bench["Track[1].Copy.Written"]
    bench.fill(1, STOP, 0, 0)
    bench.run(50)
    bench.attended.discard(1)
    assert not [each for each in bench.run(3000) if each.unit == 2 and not each.read]
    assert bench.slot(1, "StopOverdue")


def test_a_drive_block_that_writes_no_copy_has_what_its_slot_holds_sent() -> None:
    """Not even where StopRegister and StopWord look like a stop."""
    bench = Bench().ready()
    bench.put(1, HasStop=False, StopRegister=0x2000, StopWord=0x0001)
    bench.run(50)
    bench.set(StopAll=True)
    written = [each.pdu for each in bench.run(500) if each.unit == 2 and not each.read]
    assert written == [bytes.fromhex("020610000005")]


def test_the_copy_does_not_stand_in_for_the_stop_of_the_block_itself() -> None:
    """Two calls in one scan may be those of two blocks, so that nothing is copied."""
    bench = Bench().ready()
    bench.fill(1, STOP, 0, 0)
    bench._alive[1] += 1
    bench.stop(1)
    bench.scan()
    assert bench["Track[1].Copy.Written"]
    for _ in range(20):
        bench._alive[1] += bench["Track[1].Owner.AliveStep"]  # more calls each time
        bench.scan()
    assert not [each for each in bench.sent[-10:] if each.unit == 2 and not each.read]
    assert bench.slot(1, "LastErrorID") == 0
