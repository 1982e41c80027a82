"""A motor starts by a new edge alone, and by nothing else."""

from collections.abc import Callable

import pytest
from tests.drives.words import edge, meet, motions, sent
from tests.second.line import OFF, Bench
from tests.second.station import MADE_UP

from driveblocks.bench.simulator.habits import Habits
from structured_text.engines.engine import Value

NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize("kind", MADE_UP)
def test_from_power_up_to_a_turning_motor_and_back(kind: str) -> None:
    bench = Bench(kind).running()
    bench.run(300)
    assert abs(bench.drives[0].hertz - 25.0) < 0.2
    assert abs(bench.number("OutputFrequencyHz") - 25.0) < 0.2
    assert bench.out("OutputFrequencyValid")
    bench.put(RunForward=False).stopped()
    assert bench.drives[0].mode == "standstill"
    assert bench.block["TheLine.Timeouts"] == 0
    # LOW differs from CHF and from the MD type in registers that LOW refuses; each is read twice
    assert bench.block["TheLine.Refusals"] == (4 if kind == "LOW" else 0)


def test_run_and_jog_go_through_stop_and_a_new_edge() -> None:
    bench = Bench("CHF").stopped().put(JogForward=True)
    bench.run(1500)
    assert abs(bench.drives[0].hertz - 5.0) < 0.1
    bench.put(RunForward=True, JogForward=False)
    frames = bench.run(3000)
    assert not motions(bench, frames)
    assert sent(bench, frames, "jog_stop")
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def deafen(bench: Bench) -> None:
    bench.deaf = {1}
    bench.until(lambda: not bench.shows("CommOk"), 8000)


def trip(bench: Bench) -> None:
    bench.drives[0].trip(3)
    bench.until(lambda: bench.shows("Fault"))


def mend(bench: Bench) -> None:
    bench.drives[0].clear_cause()
    bench.run(5000)
    bench.drives[0].reset()


def waiting(bench: Bench) -> None:
    """A parameter is to be written, and the drive is deaf to it."""
    bench.spoil = lambda frame, reply: None if not frame.read and frame.address == 0x0100 else reply
    bench.block["Writer.AllowUnknown"] = True
    bench.block["Writer.Address"] = 0x0100
    bench.block["Writer.Execute"] = True
    bench.run(40)


def served(bench: Bench) -> None:
    bench.spoil = lambda _, reply: reply
    bench.run(1000)


def pins(**wanted: Value) -> Callable[[Bench], object]:
    return lambda bench: bench.put(**wanted)


def line(**wanted: bool) -> Callable[[Bench], object]:
    return lambda bench: bench.line(**wanted)


def neglect(bench: Bench) -> None:
    bench.leave("SkipLine")
    bench.run(2200)


def serve(bench: Bench) -> None:
    bench.leave("SkipLine", on=False)


def meaning(word: int) -> Callable[[Bench], object]:
    """What SN300G5's reference means is another thing; its block reads that anew after a stop."""

    def happens(bench: Bench) -> None:
        bench.drives[0].set(0x000F, word)
        bench.restart().run(1000)

    return happens


WHILE = {
    "restarted": (line(Restart=True), line(Restart=False), "RESTARTED"),
    "no supply": (pins(SupplyOff=True), pins(SupplyOff=False), "NO_SUPPLY"),
    "no line": (neglect, serve, "NO_LINE"),
    "offline": (deafen, lambda bench: bench.deaf.clear(), "OFFLINE"),
    "a fault": (trip, mend, "FAULT"),
    "StopAll": (line(StopAll=True), line(StopAll=False), "STOP_ALL"),
    "only speed": (pins(SpeedOnly=True), pins(SpeedOnly=False), "SPEED_ONLY"),
    "only reads": (pins(MonitorOnly=True), pins(MonitorOnly=False), "MONITOR"),
    "Enable": (pins(Enable=False), pins(Enable=True), "DISABLED"),
    "QuickStop": (pins(QuickStop=True), pins(QuickStop=False), "STOP_PIN"),
    "CoastStop": (pins(CoastStop=True), pins(CoastStop=False), "STOP_PIN"),
    "both directions": (pins(RunReverse=True), pins(RunReverse=False), "BOTH"),
    "no maximum": (pins(MaximumHz=0.0), pins(MaximumHz=50.0), "REFERENCE"),
    "no number": (pins(SpeedReferenceHz=NAN), pins(SpeedReferenceHz=25.0), "REFERENCE"),
    "infinite": (pins(SpeedReferenceHz=INFINITE), pins(SpeedReferenceHz=25.0), "REFERENCE"),
    "negative": (pins(SpeedReferenceHz=-0.1), pins(SpeedReferenceHz=25.0), "REFERENCE"),
    "no time to stop": (pins(StopWithinMs=0), pins(StopWithinMs=9000), "MISSING"),
    "a setting that cannot be off": (pins(StaleMs=OFF), pins(StaleMs=0), "MISSING"),
}
"""What stops a motor and keeps it from starting: how it begins, how it ends, and what `Reason` says."""
BEFORE = {
    **WHILE,
    "a foreign master": (meet, line(Acknowledge=True), "FOREIGN"),
    "a parameter waits": (waiting, served, "WRITE_WAITS"),
}
"""What only keeps one from starting, too."""


@pytest.mark.parametrize(
    ("runs", "what"), [*((False, what) for what in BEFORE), *((True, what) for what in WHILE)], ids=str
)
def test_what_stops_a_motor_needs_a_release_and_a_new_edge(runs: bool, what: str) -> None:
    """Nor is an edge stored that came meanwhile."""
    begins, ends, reason = BEFORE[what]
    bench = Bench("CHF").running() if runs else Bench("CHF").stopped()
    begins(bench)
    bench.scan()
    frames = bench.put(RunForward=True).run(60)
    assert bench.reason() == reason
    assert not bench.shows("Ready")
    ends(bench)
    frames += bench.run(6000)
    assert not motions(bench, frames)
    assert bench.drives[0].mode == "standstill"
    # of a motor that ran, the first request without a reply may have been that of the reference
    assert bench.reason() in ("HELD", reason, *["NO_REFERENCE"] * (what == "offline"))
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def test_no_run_before_its_reference_is_acknowledged() -> None:
    bench = Bench("CHF").stopped()
    bench.spoil = lambda frame, reply: None if sent(bench, [frame], "reference") else reply
    edge(bench)
    frames = bench.run(3000)
    assert sent(bench, frames, "reference")
    assert not motions(bench, frames)
    assert bench.reason() == "NO_REFERENCE"


@pytest.mark.parametrize("does", ["reference", "run_forward"])
def test_what_a_refused_reference_and_run_say(does: str) -> None:
    bench = Bench("SN300G5").stopped()
    bench.spoil = lambda frame, reply: bytes([1, 0x90, 0x21]) if sent(bench, [frame], does) else reply
    edge(bench)
    frames = bench.run(3000)
    assert not motions(bench, frames) or does == "run_forward"
    assert bench.reason() == "REFUSED"
    assert bench.shows("StopConfirmed")


def test_a_run_that_is_obeyed_without_an_answer_runs() -> None:
    """The status says that it was heard, so it is not repeated."""
    bench = Bench("CHF").stopped()
    bench.spoil = lambda frame, reply: None if sent(bench, [frame], "run_forward") else reply
    edge(bench)
    assert len(motions(bench, bench.run(6000))) == 1
    assert bench.shows("AtSpeed")
    assert not motions(bench, bench.run(3000))


def test_what_gives_the_reference_its_meaning_is_read_first() -> None:
    bench = Bench("SN300G5").stopped()
    meaning(1)(bench)
    edge(bench)
    assert not motions(bench, bench.run(2000))
    assert bench.reason() == "SETTING"
    meaning(0)(bench)
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def test_a_setting_that_changes_while_it_runs_stops_it() -> None:
    bench = Bench("SN300G5").running()
    bench.drives[0].set(0x000F, 1)
    bench.run(6000)
    assert bench.shows("StopConfirmed")
    assert bench.reason() == "SETTING"


def test_settings_are_read_again_after_a_run_of_its_own() -> None:
    """A dip of the supply may have brought another setting."""
    bench = Bench("SN300G5").running()
    drive = bench.drives[0]
    drive.power(on=False)
    bench.run(100)
    drive.power(on=True)
    drive.set(0x000F, 1)
    bench.run(8000)
    edge(bench)
    assert not motions(bench, bench.run(2000))
    assert bench.reason() == "SETTING"


def test_a_path_of_states_is_walked_in_its_order() -> None:
    """The drive needs a while from each word to its state."""
    bench = Bench("CIA", habits=Habits(settle_ms=150)).stopped()
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0)
    assert bench.block["TheLine.Refusals"] == 0
    seventh, last = (next(each for each in bench.frames if each.word == word) for word in (0x0007, 0x000F))
    assert last.ms - seventh.ms >= 150


def test_a_pulse_is_as_long_as_the_map_says() -> None:
    bench = Bench("PUL").stopped()
    edge(bench)
    frames = [each for each in bench.run(500) if each.address == 0x1000]
    assert [each.word for each in frames[:2]] == [1, 0]
    assert frames[1].ms - frames[0].ms >= 100
    bench.until(lambda: bench.drives[0].hertz > 24.0)


def test_ready_is_shown_only_where_a_rising_pin_starts_the_motor() -> None:
    """Whatever comes: a pin that rises in the call after a Ready starts, and beside it stands no reason of before."""
    bench = Bench("CHF").running()
    bench.drives[0].keypad_stop()
    bench.until(lambda: bench.reason() == "BY_ITSELF", 9000)
    bench.run(4000)
    assert bench.shows("StopConfirmed")
    assert (bench.reason(), bench.shows("Ready")) == ("BY_ITSELF", False)
    bench.put(RunForward=False).scan()
    assert (bench.reason(), bench.shows("Ready")) == ("READY", True)
    bench.put(RunForward=True).scan()
    assert bench.reason() == "STARTING"
    assert not bench.shows("Ready")


def test_a_held_pin_takes_ready_away() -> None:
    bench = Bench("CHF").put(RunForward=True)
    bench.run(3000)
    assert bench.shows("StopConfirmed")
    assert not bench.shows("Ready")
    bench.put(RunForward=False).scan()
    assert bench.shows("Ready")
    bench.put(JogForward=True).scan()
    assert bench.reason() == "STARTING"
