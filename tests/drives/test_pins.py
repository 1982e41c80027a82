"""What a user wires: the same pins for all families, zero always the safe meaning, limits, learned times."""

from contextlib import suppress
from dataclasses import replace

import pytest
from tests.blocks.compare.comparison import beside
from tests.drives.words import sent
from tests.second.line import OFF, Bench
from tests.second.station import MADE_UP, MIXED, built, maps, simulated, texts

from driveblocks.bench.simulator.habits import Habits
from driveblocks.maps.revision import checked
from driveblocks.render import library as blocks
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library, Source
from structured_text.language.checker import check
from structured_text.language.parser import parse
from structured_text.language.tree import VarKind

INPUTS = (
    "Enable", "RunForward", "RunReverse", "JogForward", "JogReverse", "QuickStop", "CoastStop", "FaultReset",
    "SpeedReferenceHz", "MaximumHz", "FullScaleHz", "Address", "StopWithinMs", "MonitorOnly", "SpeedOnly", "SupplyOff",
    "ManualChecked", "Settings",
)  # fmt: skip
OUTPUTS = (
    "CommOk", "Ready", "Running", "Reverse", "AtSpeed", "ZeroSpeed", "Warning", "Fault", "FaultCode", "Reason",
    "StopConfirmed", "StopOverdue", "OutputFrequencyHz", "OutputCurrentA", "Error", "ErrorID", "Diagnosis",
)  # fmt: skip
WIRED = {"Enable": True, "SpeedReferenceHz": 25.0, "MaximumHz": 50.0, "FullScaleHz": 50.0, "StopWithinMs": 9000}
"""The least that a drive needs beside its address."""
ALL = [(kind,) for kind in (*MIXED, *MADE_UP)]


def test_every_family_has_the_same_pins_and_nothing_has_a_default() -> None:
    found = check([parse("\n".join(each.text for each in texts(ALL)), "library")]).blocks
    for (kind,) in ALL:
        pins = [each for group in found[f"{kind}_DRIVE"].blocks for each in group.variables]
        by = {way: tuple(each.name for each in pins if each.kind is way) for way in VarKind}
        assert (by[VarKind.INPUT], by[VarKind.OUTPUT], by[VarKind.IN_OUT]) == (INPUTS, OUTPUTS, ("Slot",))
    drives = tuple(f"{kind}_DRIVE" for (kind,) in ALL)
    names = [name for name in found if name.startswith(("VFD_", "MB_LINE", "MB_LISTEN")) or name in drives]
    pins = [each for name in names for group in found[name].blocks for each in group.variables]
    assert [each.name for each in pins if each.initial and not each.constant] == []


def zeroed(kind: str, stations: Library) -> Bench:
    """A station whose whole memory is 0, with nothing wired but what a drive needs."""
    bench = Bench(kind, start=False, stations=stations)
    for path, value in bench.block.state().items():
        if path.startswith(("DRIVE0.", "THELINE.", "SLOTS[")):
            with suppress(ValueError):  # a constant stays
                bench.block[path] = type(value)()
    return bench.line(BitRate=19200).put(Address=1, **WIRED)


def assert_alike(kind: str, stations: Library) -> None:
    """What it does is what declared memory does, scan by scan, from power-up to a stop."""
    both = [zeroed(kind, stations), Bench(kind, start=False, stations=stations)]
    both[1].line(BitRate=19200, MaxScanMs=0).put(**dict.fromkeys(("TurnRoundMs", "LongestMs"), 0))
    for bench in both:
        bench.put(**dict.fromkeys(("FrequencyScale", "DcVoltageScale"), 0.0), ReferenceScale=100.0)
        bench.restart()
    for run in (False, True, False):
        for bench in both:
            bench.put(RunForward=run)
        for _ in range(300):
            for bench in both:
                bench.scan()
            assert both[0].seen == both[1].seen
        assert both[0].drives[0].mode == ("running" if run else "standstill")
        assert both[0].frames == both[1].frames


@pytest.mark.parametrize("kind", ["CHF", "CIA"])
def test_memory_of_zeros_behaves_like_declared_memory(kind: str) -> None:
    assert_alike(kind, simulated())


def test_memory_of_zeros_on_matiec(matiec: Engine) -> None:
    for engine in beside(matiec).values():
        assert_alike("CHF", built(engine, [("CHF",)]))


@pytest.mark.parametrize(
    ("full", "maximum", "asked", "turns"),
    [(50.0, 50.0, 30.0, 30.0), (50.0, 40.0, 30.0, 30.0), (50.0, 40.0, 45.0, 40.0), (40.0, 50.0, 45.0, 50.0)],
)
def test_a_limit_is_no_scale(full: float, maximum: float, asked: float, turns: float) -> None:
    """The drive's own 100 % is 50 Hz; only a wrong FullScaleHz turns the motor at another speed than is asked."""
    bench = Bench("CHF", habits=Habits(maximum_hz=50)).put(FullScaleHz=full, MaximumHz=maximum, SpeedReferenceHz=asked)
    bench.stopped().put(RunForward=True).run(6000)
    assert abs(bench.drives[0].hertz - turns) < 0.2
    assert bench.out("ReferenceLimited") is (asked > min(maximum, full))


def test_without_a_full_scale_a_fraction_is_no_reference() -> None:
    bench = Bench("CHF").put(FullScaleHz=0.0, RunForward=False)
    bench.run(1000)
    bench.put(RunForward=True).run(2000)
    assert (bench.reason(), bench.out("ErrorID")) == ("REFERENCE", 19)
    assert bench.drives[0].mode == "standstill"


@pytest.mark.parametrize("name", ["TurnRoundMs", "LongestMs", "BootMs", "FollowWithinMs", "StaleMs", "StopWithinMs"])
def test_what_cannot_be_off_is_refused(name: str) -> None:
    bench = Bench("CHF").put(**{name: OFF})
    bench.run(1500)
    bench.put(RunForward=True).run(500)
    assert (bench.reason(), bench.out("ErrorID")) == ("MISSING", 72)
    assert not sent(bench, bench.frames, "run_forward")
    assert bench.shows("CommOk")


def test_a_second_hand_map_wants_its_own_number() -> None:
    """One structure that is copied from drive to drive consents for nobody."""
    drive = replace(maps()["CHF"], manual=replace(maps()["CHF"].manual, second_hand=True))
    ours = [each for each in texts([("CHF",)]) if not each.path.endswith("CHF_Drive.st")]
    made = [Source(each.path, each.text) for each in blocks.drive("invt_chf", drive, []) if each.name == "CHF_Drive"]
    *others, stations = ours
    bench = Bench("CHF", stations=EmbeddedEngine().build([*others, *made, stations]))
    bench.run(1500)
    for wrong in (0, 1, checked(drive) - 1, checked(maps()["JSCC"])):
        bench.put(ManualChecked=wrong, RunForward=True).run(500)
        assert bench.reason() == "UNCHECKED"
        bench.put(RunForward=False).run(200)
    bench.put(ManualChecked=checked(drive)).running()


@pytest.mark.parametrize("reference", [25.0, 5.0])
def test_a_jog_runs_as_asked_whatever_the_reference_is(reference: float) -> None:
    """The drive jogs at a speed of its own."""
    bench = Bench("CHF").put(SpeedReferenceHz=reference).stopped().put(JogForward=True)
    bench.run(3000)
    assert bench.drives[0].hertz == 5.0
    assert bench.reason() == "RUNS"
    bench.put(JogForward=False).stopped().put(RunForward=True, SpeedReferenceHz=25.0).run(500)
    assert bench.reason() == "RAMPING"


def test_a_time_that_is_off_lets_nothing_pass_that_was_never_read() -> None:
    bench = Bench("CHF", start=False).put(StaleMs=OFF)
    bench.spoil = lambda frame, reply: None if frame.address == 0x1001 else reply  # it answers, but no status
    ok: list[bool] = []
    bench.watch.append(lambda one: ok.append(one.shows("CommOk")))
    bench.restart().run(3000)
    assert ok
    assert not any(ok)


@pytest.mark.parametrize("ms", [59_000, 60_000, 61_000, 120_000])
def test_what_was_read_before_minutes_without_a_call_is_old(ms: int) -> None:
    """The clock of the line goes round in 60 s."""
    bench = Bench("CHF").stopped()
    assert bench.shows("CommOk")
    bench.leave("Skip0").run(ms - bench.ms)
    bench.leave("Skip0", on=False).scan()
    assert bench.number("StatusAgeMs") == OFF
    assert not bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")


def test_a_changed_keep_word_is_sent_with_the_next_command_and_not_before() -> None:
    """So no bit of it resets a fault: a fault stops, and bars the next command."""
    bench = Bench("SN300G5").stopped().put(KeepWord=0x0010)
    assert not [each for each in bench.run(3000) if not each.read]
    bench.put(RunForward=True).run(500)
    assert 0x0011 in [each.word for each in bench.frames if each.address == 0 and not each.read]


@pytest.mark.parametrize("code", [0x33, 0x44])
def test_a_fault_of_the_control_circuit_has_a_code_of_its_own(code: int) -> None:
    """Bits of 0017H and 0018H, CPF02 to CPF23, which the manual's table of fault numbers does not list."""
    bench = Bench("SN300G5").stopped()
    bench.drives[0].trip(code)
    bench.run(1000)
    assert bench.shows("Fault")
    assert bench.out("FaultCode") == code
    assert bench.drives[0].word(0x17 if code < 0x40 else 0x18) == (0x0004 if code < 0x40 else 0x0008)
