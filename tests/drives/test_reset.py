"""A fault reset: of the fault that was there when it was asked for, a few times and no more, and no start after it."""

import pytest
from tests.drives.words import edge, motions, sent
from tests.second.line import Bench
from tests.second.station import MADE_UP, maps

CAN = [
    kind
    for kind in ("CHF", *MADE_UP)
    if any(command.does == "fault_reset" for command in maps()[kind].operation.commands)
]


def tripped(kind: str = "CHF") -> Bench:
    """A drive with a fault, whose cause is gone and whose motor is at standstill."""
    bench = Bench(kind).running()
    bench.put(RunForward=False)
    bench.drives[0].trip(3)
    bench.drives[0].clear_cause()
    bench.run(6000)
    assert bench.shows("Fault")
    return bench


@pytest.mark.parametrize("kind", CAN)
def test_a_reset_ends_the_fault_and_starts_nothing(kind: str) -> None:
    bench = tripped(kind).put(FaultReset=True)
    frames = bench.run(3000)
    assert sent(bench, frames, "fault_reset")
    assert not bench.shows("Fault")
    assert not motions(bench, [each for each in frames if each not in sent(bench, frames, "fault_reset")])
    bench.put(FaultReset=False).stopped().running()


def test_a_reset_that_nobody_answers_is_tried_three_times() -> None:
    bench = tripped()
    bench.drives[0].cause = True
    bench.spoil = lambda frame, reply: None if sent(bench, [frame], "fault_reset") else reply
    bench.put(FaultReset=True)
    assert len(sent(bench, bench.run(9000), "fault_reset")) == 3
    assert bench.reason() == "NO_RESET"


def test_another_fault_is_not_reset_by_a_repetition() -> None:
    """The attempt is refused; meanwhile another fault has come, which nobody has seen."""
    bench = tripped()
    bench.spoil = lambda frame, reply: None if sent(bench, [frame], "fault_reset") else reply
    bench.drives[0].cause = True
    bench.put(FaultReset=True)
    bench.until(lambda: sent(bench, bench.frames, "fault_reset"))
    bench.drives[0].fault = 9
    bench.drives[0].clear_cause()
    frames = bench.run(8000)
    assert not sent(bench, frames, "fault_reset")
    assert bench.out("FaultCode") == 9


@pytest.mark.parametrize("gone", ["SupplyOff", "communication", "MonitorOnly", "SpeedOnly", "Restart"])
def test_a_reset_does_not_outlive_what_it_was_asked_for(gone: str) -> None:
    bench = tripped()
    bench.spoil = lambda frame, reply: None if not frame.read else reply
    bench.put(FaultReset=True)
    bench.run(200)
    if gone == "communication":
        bench.deaf = {1}
    elif gone == "Restart":
        bench.line(Restart=True)
    else:
        bench.put(**{gone: True})
    bench.run(3000)
    bench.spoil = lambda _, reply: reply
    bench.deaf = set()
    bench.line(Restart=False).put(SupplyOff=False, MonitorOnly=False, SpeedOnly=False)
    frames = bench.run(5000)
    assert not sent(bench, frames, "fault_reset")
    assert bench.shows("Fault")


def test_a_reset_that_waits_is_taken_back_for_reading_only_though_its_pin_rises_anew() -> None:
    """The edge kept it in hand for one scan more, in which the line sent it."""
    bench = tripped().put(FaultReset=True)
    bench.scan()
    bench.put(FaultReset=False).until(lambda: bench.out("Control.Reset.OnItsWay"))
    assert not sent(bench, bench.frames, "fault_reset")
    bench.put(FaultReset=True, MonitorOnly=True)
    assert not sent(bench, bench.run(1000), "fault_reset")
    assert not bench.out("Control.Resetting")


def test_a_run_pin_held_through_a_reset_starts_nothing() -> None:
    bench = tripped().put(FaultReset=True)
    bench.scan()
    bench.put(RunForward=True)
    frames = bench.run(5000)
    assert not motions(bench, frames)
    assert not bench.shows("Fault")
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def test_a_reset_is_sent_after_a_stop() -> None:
    bench = tripped().put(FaultReset=True)
    frames = [each for each in bench.run(2000) if not each.read]
    first = frames.index(sent(bench, frames, "fault_reset")[0])
    assert sent(bench, frames[:first], "stop")
    assert sent(bench, frames[first:], "stop")


def test_silence_neither_ends_a_fault_nor_gives_it_a_code() -> None:
    """A trip whose relay drops the contactor: the drive is silent before its code is read, and comes back with it."""
    bench = Bench().running()
    bench.drives[0].trip(5)
    bench.until(lambda: bench.shows("Fault"))
    for _ in range(3):
        bench.deaf = {1}
        bench.run(4000)
        bench.deaf = set()
        bench.run(12_000)
    shown = [bench.out(name) for name in ("FaultCode", "FirstFaultCode", "FaultBack1", "FaultBack2")]
    assert shown == [5, 5, 5, 0]


def test_a_press_without_a_fault_says_so_while_it_lasts() -> None:
    """It bars nothing."""
    bench = Bench("CHF").stopped().put(FaultReset=True)
    bench.run(500)
    assert (bench.reason(), bench.shows("Ready")) == ("NO_FAULT", True)
    bench.put(FaultReset=False).run(60)
    assert bench.reason() == "READY"
    bench.put(FaultReset=True).running()


def test_a_reset_that_a_run_pin_forbids_is_refused() -> None:
    bench = tripped().put(RunForward=True)
    bench.run(60)
    bench.put(FaultReset=True).run(500)
    assert bench.reason() == "NO_RESET"


def test_a_fault_that_a_reset_does_not_end_is_there_again() -> None:
    bench = tripped()
    bench.spoil = lambda _, reply: reply
    bench.drives[0].cause = True
    bench.put(FaultReset=True).run(12_000)
    assert bench.reason() in {"FAULT_BACK", "NO_RESET"}
    assert bench.shows("Fault")


def test_a_fault_that_comes_back_after_its_reset_is_there_again() -> None:
    bench = tripped().put(FaultReset=True)
    bench.until(lambda: not bench.shows("Fault"))
    bench.put(FaultReset=False).run(1000)
    bench.drives[0].trip(3)
    bench.run(1000)
    assert bench.reason() == "FAULT_BACK"
    bench.drives[0].clear_cause()
    bench.run(5000)
    bench.put(FaultReset=True).run(3000)
    assert not bench.shows("Fault")
    bench.put(FaultReset=False).stopped()
    assert bench.reason() == "READY"
