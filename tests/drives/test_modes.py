"""What else a drive block may be reported, and what may be wrong around it."""

from contextlib import suppress

import pytest
from tests.drives.words import edge, meet, motions, sent, stops
from tests.second.line import SETTINGS, Bench, Frame
from tests.second.station import maps

from driveblocks.bench.simulator.drive import SimulatedDrive
from structured_text.engines.engine import Value


def test_with_speed_only_it_writes_the_reference_and_starts_nothing() -> None:
    bench = Bench("CHF").stopped().put(SpeedOnly=True, RunForward=True)
    frames = bench.run(3000)
    assert sent(bench, frames, "reference")
    assert not motions(bench, frames)
    assert bench.reason() == "SPEED_ONLY"
    bench.drives[0].keypad_run()
    frames = bench.run(5000)
    assert not motions(bench, frames)
    assert not stops(bench, frames)
    assert abs(bench.drives[0].hertz - 25.0) < 0.2
    bench.put(SpeedReferenceHz=40.0).run(3000)
    assert abs(bench.drives[0].hertz - 40.0) < 0.2
    bench.put(SpeedOnly=False)
    frames = bench.run(7000)
    assert stops(bench, frames)
    assert not motions(bench, frames)
    assert bench.shows("StopConfirmed")


@pytest.mark.parametrize("mode", ["SpeedOnly", "MonitorOnly"])
def test_a_plc_that_starts_warm_in_a_mode_sends_each_stop_once(mode: str) -> None:
    """The bus may have started the motor before; an answer ends the stop, since the block has not."""
    bench = Bench("CHF").stopped().put(**{mode: True})
    bench.run(3000)
    bench.drives[0].keypad_run()
    bench.run(3000)
    frames = bench.restart().run(6000)
    said = {each.word for each in stops(bench, frames)}
    assert said == {5, 8}
    assert bench.drives[0].mode == "standstill"
    bench.drives[0].keypad_run()
    assert not stops(bench, bench.run(6000))
    assert not bench.shows("StopOverdue")


STATUS = 0x2000
"""Its bit 9 says that the bus is in command, on a made-up drive."""


def elsewhere(mode: str) -> Bench:
    """A motor that somebody else has started, before the PLC starts in a mode; the bus is not in command."""
    bench = Bench("CIA", start=False)
    bench.drives[0].set(STATUS, 0)
    bench.drives[0].keypad_run(20.0)
    return bench.put(**{mode: True})


@pytest.mark.parametrize("mode", ["SpeedOnly", "MonitorOnly"])
def test_a_motor_in_other_hands_gets_no_stop_after_a_restart(mode: str) -> None:
    bench = elsewhere(mode).restart()
    assert not stops(bench, bench.run(3000))
    assert bench.out("State") == (6 if mode == "SpeedOnly" else 5)
    assert bench.drives[0].mode == "running"
    assert not bench.shows("StopConfirmed")
    assert not bench.shows("StopOverdue")
    assert not stops(bench, bench.restart().run(3000))
    bench.put(**{mode: False})
    assert stops(bench, bench.run(300))


@pytest.mark.parametrize("mode", ["SpeedOnly", "MonitorOnly"])
def test_where_the_bus_is_in_command_a_restart_sends_its_stop(mode: str) -> None:
    bench = elsewhere(mode)
    bench.drives[0].set(STATUS, 0x0200)
    bench.restart()
    assert stops(bench, bench.run(500))
    assert bench.drives[0].mode != "running"


@pytest.mark.parametrize("spoilt", ["the mode", "a stop pin", "full control"])
def test_a_restart_does_not_wait_for_the_bus_where_a_stop_is_asked_for(spoilt: str) -> None:
    bench = elsewhere("SpeedOnly")
    bench.spoil = lambda frame, reply: None if frame.read and frame.address == STATUS else reply
    if spoilt == "full control":
        bench.put(SpeedOnly=False)
    bench.restart()
    if spoilt != "full control":
        assert not stops(bench, bench.run(2000))
        bench.put(**({"SpeedOnly": False} if spoilt == "the mode" else {"Enable": False}))
    assert stops(bench, bench.run(500))


def test_a_restart_does_not_wait_for_the_bus_for_good() -> None:
    bench = elsewhere("SpeedOnly").put(BootMs=3000)
    bench.spoil = lambda frame, reply: None if frame.read and frame.address == STATUS else reply
    bench.restart()
    assert not stops(bench, bench.run(2900))
    assert stops(bench, bench.run(1500))


def test_a_restart_that_waits_for_the_bus_repeats_no_stop() -> None:
    """Another block has had a stop answered on this slot; that was taken for one of its own to be sent again."""
    bench = elsewhere("SpeedOnly")
    bench.spoil = lambda frame, reply: None if frame.read and frame.address == STATUS else reply
    bench.restart().run(1000)
    for part in ("Ask", "Answer"):
        bench.block[f"Slots[0].{part}[0].Number"] = 77
    assert not stops(bench, bench.run(2000))
    assert bench.out("Control.First.Waits")


def test_running_motors_go_on_beside_a_foreign_master() -> None:
    """Their reference is refreshed, and changes."""
    bench = Bench("CHF").running()
    meet(bench)
    before = len(bench.frames)
    bench.put(SpeedReferenceHz=10.0).run(5000)
    words = {each.word for each in sent(bench, bench.frames[before:], "reference")}
    assert len(words) == 1
    assert len(sent(bench, bench.run(3000), "reference")) >= 2
    assert bench.drives[0].hertz == pytest.approx(10.0, abs=0.1)
    assert bench.reason() == "RUNS"


def test_with_a_foreign_master_one_reading_proves_no_standstill() -> None:
    """Replies that somebody else may have asked for show standstill once; the motor runs on."""
    bench = Bench("CHF").running()
    bench.drives[0].keeps_running = True
    meet(bench)
    standing = SimulatedDrive(maps()["CHF"], 1)
    shown: set[tuple[int, int]] = set()
    bench.put(RunForward=False)
    bench.until(lambda: bench.out("Control.Acknowledged"))

    def once(frame: Frame, reply: bytes | None) -> bytes | None:
        read = frame.address, frame.word
        if not frame.read or read in shown:
            return reply
        shown.add(read)
        return standing.reply(bytes([1, frame.function, *divmod(frame.address, 256), *divmod(frame.word, 256)]))

    bench.spoil = once
    confirmed = []
    bench.watch.append(lambda one: confirmed.append(one.shows("StopConfirmed")))
    bench.run(600)
    assert len(shown) > 1
    assert not any(confirmed)
    bench.drives[0].keeps_running = False
    bench.until(lambda: bench.shows("StopConfirmed"), 9000)
    assert bench.drives[0].mode == "standstill"


def test_an_address_is_kept_for_what_answers_and_taken_for_what_has_no_supply() -> None:
    bench = Bench("CHF").running().put(Address=77)
    assert {each.unit for each in bench.run(2000)} == {1}
    bench.deaf = {1}
    bench.put(SupplyOff=True).run(5000)
    assert {each.unit for each in bench.wait(30_000)} == {77}


def test_a_status_that_grows_old_has_a_reason_before_it_stops_the_motor() -> None:
    bench = Bench("CHF").put(StaleMs=2000).running()
    bench.spoil = lambda frame, reply: None if frame.read else reply
    bench.line(OfflineMs=60_000).run(1500)
    assert bench.shows("Running")
    assert bench.reason() == "SLOW_LINE"
    bench.run(1500)
    assert bench.reason() == "STALE"


def test_a_late_scan_is_flagged_and_starts_all_the_same() -> None:
    bench = Bench("CHF").stopped()
    bench.scan(100)
    bench.run(50)
    assert bench.reason() == "LATE_SCAN"
    bench.running()


@pytest.mark.parametrize("seed", range(3))
def test_stale_memory_starts_nothing(seed: int) -> None:
    """Whatever retained memory, or another program before an online change, has left there."""
    kind = ("CHF", "JSCC", "SN300G5")[seed]
    bench = Bench(kind, start=False, seed=seed)
    for path, value in bench.block.state().items():
        if path.startswith(("DRIVE0.", "SLOTS[0].")) and not path.startswith("DRIVE0.SLOT."):
            _fill(bench, path, value)
    bench.put(**SETTINGS, Address=1, SupplyOff=False, RunForward=True)
    bench.put(**dict.fromkeys(("QuickStop", "CoastStop", "FaultReset", "MonitorOnly", "SpeedOnly"), False))
    bench.put(**dict.fromkeys(("JogForward", "JogReverse", "RunReverse"), False))
    bench.put(RefreshMs=1000, FollowWithinMs=5000, StaleMs=5000, WatchdogMs=0, KeepWord=0, ManualChecked=0, BootMs=0)
    bench.put(FrequencyScale=0.01, ReferenceScale=100.0, LongestMs=60)
    if seed % 2:
        bench.drives[0].keypad_run(20.0)
    bench.restart()
    frames = bench.run(6000)
    assert stops(bench, frames)
    assert not motions(bench, frames)
    assert bench.drives[0].mode == "standstill"
    edge(bench)
    bench.until(lambda: bench.drives[0].hertz > 24.0, 8000)


def _fill(bench: Bench, path: str, value: Value) -> None:
    """Any value that fits; a constant stays."""
    chance = bench.chance
    small = path.endswith(("STATE", "RESETTING", "STEPNUMBER", "KIND", "ORDER", "SENT", "WISH"))
    wanted: Value = chance.randrange(8 if small else 256)
    if isinstance(value, bool):
        wanted = chance.random() < 0.5
    elif isinstance(value, float):
        wanted = chance.choice([0.0, -1.0, 1e30, 49.9])
    with suppress(ValueError):
        bench.block[path] = wanted


def test_a_run_that_was_left_in_retained_slots_is_never_sent() -> None:
    bench = Bench("CHF").stopped()
    slot = "Slots[0]."
    run: dict[str, Value] = {"FunctionCode": 6, "Address": 0x1000, "Quantity": 1, "Words": [1], "Number": 77}
    for name, value in run.items():
        bench.block[f"{slot}Ask[1].{name}"] = value
    bench.restart()
    assert not motions(bench, bench.run(4000))
    assert bench.shows("StopConfirmed")


@pytest.mark.parametrize(("kind", "pin"), [("JSCC", "JogForward"), ("CIA", "RunReverse"), ("SN300G5", "JogReverse")])
def test_what_a_family_cannot_do_is_refused_and_said(kind: str, pin: str) -> None:
    bench = Bench(kind).stopped().put(**{pin: True})
    assert not motions(bench, bench.run(2000))
    assert bench.reason() == "NOT_ABLE"
    assert bench.out("Error")


def parameter(bench: Bench, address: int = 0x0100, value: int = 1, **pins: Value) -> Bench:
    """Ask for a write."""
    bench.block["Writer.Execute"] = False
    bench.run(50)
    wishes: dict[str, Value] = {"Address": address, "Value": value, "Execute": True, **pins}
    for name, wanted in wishes.items():
        bench.block[f"Writer.{name}"] = wanted
    bench.run(200)
    return bench


def test_parameters_and_starts_exclude_each_other() -> None:
    bench = parameter(Bench("CHF").stopped(), AllowUnknown=True)
    assert bench.block["Writer.Done"]
    assert bench.drives[0].stores == 1
    bench.running()
    frames = len(bench.frames)
    parameter(bench, AllowUnknown=True)
    assert bench.block["Writer.Error"]
    assert not [each for each in bench.frames[frames:] if each.address == 0x0100]
    bench.put(RunForward=False).stopped()
    parameter(bench, AllowUnknown=True)
    assert bench.block["Writer.Done"]


@pytest.mark.parametrize("address", [0x1000, 0x2000, 0x1000 + 0x8000, 0x2000 + 0x8000])
def test_no_parameter_passes_the_rules_by(address: int) -> None:
    bench = parameter(Bench("CHF").stopped(), address, AllowUnknown=True)
    assert bench.block["Writer.Error"]
    assert not [each for each in bench.run(500) if not each.read]


@pytest.mark.parametrize("ms", [500, 30_000])
def test_an_address_that_nobody_has_is_corrected_at_standstill_without_an_alarm(ms: int) -> None:
    """The motor was proved to stand, and nothing was posted to anybody since."""
    bench = Bench("CHF").stopped()
    overdue: list[bool] = []
    bench.watch.append(lambda one: overdue.append(one.shows("StopOverdue")))
    bench.put(Address=9).run(ms)
    assert bench.reason() == "NO_REPLY"
    bench.restart().put(Address=1).run(200)
    bench.stopped().running()
    assert not any(overdue)


def test_a_motor_that_runs_at_another_address_is_stopped_and_watched_like_any() -> None:
    bench = Bench("CHF").stopped()
    bench.drives[0].unit = 9
    bench.drives[0].keypad_run(20.0)
    bench.run(900)
    bench.put(Address=9).run(300)
    assert bench.drives[0].hertz > 0
    bench.deaf = {9}
    bench.until(lambda: bench.shows("StopOverdue"), 9000)
