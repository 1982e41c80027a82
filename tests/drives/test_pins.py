"""What a user wires: the same pins for all families, zero always the safe meaning, limits, learned times."""

from contextlib import suppress
from dataclasses import replace

import pytest
from tests.blocks.compare.comparison import beside
from tests.drives.bench import OFF, Bench
from tests.drives.rules import sent, watched
from tests.drives.station import FAMILIES, MADE_UP, built, library, maps, name_of, texts
from tests.drives.test_stop import stops

from driveblocks.maps.revision import checked
from driveblocks.render import library as blocks
from driveblocks.simulator.habits import Habits
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine, Library
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


def test_every_family_has_the_same_pins_and_none_has_a_default() -> None:
    found = check([parse("\n".join(each.text for each in texts()), "library")]).blocks
    for kind in (*FAMILIES, *MADE_UP):
        pins = [each for group in found[f"{kind}_DRIVE"].blocks for each in group.variables]
        by = {way: tuple(each.name for each in pins if each.kind is way) for way in VarKind}
        assert (by[VarKind.INPUT], by[VarKind.OUTPUT], by[VarKind.IN_OUT]) == (INPUTS, OUTPUTS, ("Slot",))
        assert [each.name for each in pins if each.initial and not each.constant] == []


def test_no_variable_of_line_and_control_has_a_default() -> None:
    found = check([parse("\n".join(each.text for each in texts()), "library")]).blocks
    names = [name for name in found if name.startswith(("VFD_", "MB_LINE", "MB_LISTEN"))]
    pins = [(name, each) for name in names for group in found[name].blocks for each in group.variables]
    given = [f"{name}.{each.name}" for name, each in pins if each.initial and not each.constant]
    assert given == []


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


@pytest.mark.parametrize("kind", FAMILIES)
def test_memory_of_zeros_behaves_like_declared_memory(kind: str) -> None:
    assert_alike(kind, library())


def test_memory_of_zeros_on_matiec(matiec: Engine) -> None:
    for engine in beside(matiec).values():
        stations = built(engine, kinds=FAMILIES)
        for kind in FAMILIES:
            assert_alike(kind, stations)


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


def test_the_turn_round_is_learned_from_replies() -> None:
    bench = Bench("CHF").put(TurnRoundMs=0)
    bench.run(40)
    assert bench.number("Diagnosis.TurnRoundMs") == 500
    bench.run(3000)
    seen = bench.number("LongestReplyMs")
    assert bench.number("Diagnosis.TurnRoundMs") == max(50, 2 * seen + 20) < 100
    bench.drives[0].turn_us = 70_000
    bench.run(3000)
    assert 70 <= bench.number("LongestReplyMs") <= 110
    assert bench.number("Diagnosis.TurnRoundMs") == 2 * bench.number("LongestReplyMs") + 20
    bench.drives[0].turn_us = 400_000
    bench.put(LongestMs=600).run(3000)
    assert bench.number("Diagnosis.TurnRoundMs") == 500
    assert bench.shows("CommOk")


def test_what_is_learned_is_forgotten_with_the_address() -> None:
    bench = Bench("CHF").put(TurnRoundMs=0).stopped()
    bench.run(3000)
    assert bench.number("Diagnosis.TurnRoundMs") < 100
    bench.drives[0].unit = 9
    bench.put(Address=9).run(100)
    assert bench.number("Diagnosis.TurnRoundMs") == 500


def test_a_second_hand_map_wants_its_own_number() -> None:
    """One structure that is copied from drive to drive consents for nobody."""
    drive = replace(maps()["CHF"], manual=replace(maps()["CHF"].manual, second_hand=True))
    files = {each.name: each.text for each in blocks.drive("invt_chf", drive, [])}
    ours = {each.path.split("/")[-1][:-3]: each.text for each in texts()}["CHF_Drive"]
    stations = built(EmbeddedEngine(), lambda text: files["CHF_Drive"] if text == ours else text, ("CHF",))
    bench = Bench("CHF", stations=stations)
    bench.run(1500)
    for wrong in (0, 1, checked(drive) - 1, checked(maps()["JSCC"])):
        bench.put(ManualChecked=wrong, RunForward=True).run(500)
        assert bench.reason() == "UNCHECKED"
        bench.put(RunForward=False).run(200)
    bench.put(ManualChecked=checked(drive)).running()


def test_the_number_of_a_map_is_that_of_what_moves_the_motor() -> None:
    drive = maps()["CHF"]
    other = replace(drive.operation.commands[0], source="elsewhere")
    commands = (other, *drive.operation.commands[1:])
    assert checked(replace(drive, family=drive.family, notices=())) == checked(drive)
    assert checked(replace(drive, operation=replace(drive.operation, commands=commands))) != checked(drive)
    assert 0 < checked(drive) < OFF + 1


def test_the_line_counts_who_answers() -> None:
    bench = Bench(*FAMILIES)
    bench.run(1500)
    assert (bench.block["TheLine.OnlineCount"], bench.block["TheLine.AllOnline"]) == (len(FAMILIES), True)
    bench.deaf = {2}
    bench.run(3000)
    assert (bench.block["TheLine.OnlineCount"], bench.block["TheLine.AllOnline"]) == (len(FAMILIES) - 1, False)
    bench.put(1, SupplyOff=True).run(100)
    assert (bench.block["TheLine.OnlineCount"], bench.block["TheLine.AllOnline"]) == (len(FAMILIES) - 1, True)


def test_the_diagnosis_says_why_and_how_it_stopped() -> None:
    bench = Bench("CHF").running()
    assert bench.out("State") == 4
    bench.put(RunForward=False).stopped()
    assert (bench.out("StopReason"), bench.out("StopKind"), bench.out("State")) == (6, 1, 1)
    bench.running().put(CoastStop=True).run(3000)
    assert (bench.out("StopReason"), bench.out("StopKind")) == (21, 3)
    assert bench.number("StatusAgeMs") < 200
    assert bench.number("MeasuresAgeMs") < 200
    assert stops(bench, bench.frames)
    assert name_of(("CHF",)) == "Station_CHF"


@pytest.mark.parametrize("kind", FAMILIES)
def test_ready_is_never_shown_without_stop_confirmed(kind: str) -> None:
    bench = watched(kind)
    alone: list[str] = []

    def look(bench: Bench) -> None:
        if bench.shows("Ready") and not bench.shows("StopConfirmed"):
            alone.append(bench.told())

    bench.watch.append(look)
    bench.running().put(RunForward=False).stopped().running()
    bench.drives[0].keypad_stop()
    bench.put(RunForward=False).run(5000)
    assert not alone


@pytest.mark.parametrize("reference", [25.0, 5.0])
def test_a_jog_runs_as_asked_whatever_the_reference_is(reference: float) -> None:
    """The drive jogs at a speed of its own."""
    bench = watched("CHF").put(SpeedReferenceHz=reference).stopped().put(JogForward=True)
    bench.run(3000)
    assert bench.drives[0].hertz == 5.0
    assert bench.reason() == "RUNS"
    bench.put(JogForward=False).stopped().put(RunForward=True, SpeedReferenceHz=25.0).run(500)
    assert bench.reason() == "RAMPING"


def test_a_time_that_is_off_lets_nothing_pass_that_was_never_read() -> None:
    bench = watched("CHF", start=False).put(StaleMs=OFF)
    bench.spoil = lambda frame, reply: None if frame.address == 0x1001 else reply  # it answers, but no status
    ok: list[bool] = []
    bench.watch.append(lambda one: ok.append(one.shows("CommOk")))
    bench.restart().run(3000)
    assert ok
    assert not any(ok)


@pytest.mark.parametrize("ms", [59_000, 60_000, 61_000, 120_000])
def test_what_was_read_before_minutes_without_a_call_is_old(ms: int) -> None:
    """The clock of the line goes round in 60 s."""
    bench = watched("CHF").stopped()
    assert bench.shows("CommOk")
    bench.leave("Skip0").run(ms - bench.ms)
    bench.leave("Skip0", on=False).scan()
    assert bench.number("StatusAgeMs") == OFF
    assert not bench.shows("CommOk")
    assert not bench.shows("StopConfirmed")


def test_a_changed_keep_word_is_sent_with_the_next_command_and_not_before() -> None:
    """So no bit of it resets a fault: a fault stops, and bars the next command."""
    bench = watched("SN300G5").stopped().put(KeepWord=0x0010)
    assert not [each for each in bench.run(3000) if not each.read]
    bench.put(RunForward=True).run(500)
    assert 0x0011 in [each.word for each in bench.frames if each.address == 0 and not each.read]


@pytest.mark.parametrize("kind", ["CHF", "SN300G5"])
def test_a_reset_that_is_refused_is_not_shown_as_one_on_its_way(kind: str) -> None:
    bench = watched(kind).stopped()
    shown: set[str] = set()
    bench.watch.append(lambda one: shown.add(one.reason()))
    bench.put(FaultReset=True).run(500)
    assert "RESETTING" not in shown
    assert "NO_RESET" in shown


@pytest.mark.parametrize("code", [0x33, 0x44])
def test_a_fault_of_the_control_circuit_has_a_code_of_its_own(code: int) -> None:
    """Bits of 0017H and 0018H, CPF02 to CPF23, which the manual's table of fault numbers does not list."""
    bench = watched("SN300G5").stopped()
    bench.drives[0].trip(code)
    bench.run(1000)
    assert bench.shows("Fault")
    assert bench.out("FaultCode") == code
    assert bench.drives[0].word(0x17 if code < 0x40 else 0x18) == (0x0004 if code < 0x40 else 0x0008)
