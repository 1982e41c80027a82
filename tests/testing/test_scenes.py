"""Scenes find what is wrong with a drive block or its line, whatever family it is, on every engine."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from tests import shipped
from tests.shapes import shapes

from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.scenes.scene import RULES
from driveblocks.bench.unit import Unit
from driveblocks.maps import collection
from driveblocks.output.units import units
from driveblocks.render.text import languages
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Library, Source

from .conftest import changed, only, run

PROGRAMS = ("Motor", "Parameters")

FIRST = {
    "Enable is ignored": ("Enable := TRUE;", "MotorStop"),
    "RunForward is ignored": ("RunForward := FALSE;", "MotorStart"),
    "RunReverse is ignored": ("RunReverse := FALSE;", "MotorStart"),
    "RunReverse runs forward": ("RunForward := RunForward OR RunReverse; RunReverse := FALSE;", "MotorStart"),
    "JogForward is ignored": ("JogForward := FALSE;", "MotorStart"),
    "JogReverse is ignored": ("JogReverse := FALSE;", "MotorStart"),
    "QuickStop is ignored": ("QuickStop := FALSE;", "MotorStop"),
    "QuickStop is a stop like any other": ("Enable := Enable AND NOT QuickStop; QuickStop := FALSE;", "MotorStop"),
    "CoastStop is ignored": ("CoastStop := FALSE;", "MotorStop"),
    "CoastStop is a stop like any other": ("Enable := Enable AND NOT CoastStop; CoastStop := FALSE;", "MotorStop"),
    "FaultReset is ignored": ("FaultReset := FALSE;", "MotorFault"),
    "a fault is reset by itself": ("FaultReset := Fault;", "MotorFault"),
    "the reference is another": ("SpeedReferenceHz := SpeedReferenceHz + 0.3;", "MotorStart"),
    "MaximumHz is ignored": ("MaximumHz := 50.0;", "MotorStart"),
    "the unit address never changes": ("Address := 1;", "MotorMode"),
    "a missing StopWithinMs is borne": ("StopWithinMs := 5000;", "MotorMode"),
    "no stop is ever late": ("StopWithinMs := 65000;", "MotorStop"),
    "MonitorOnly is ignored": ("MonitorOnly := FALSE;", "MotorMode"),
    "SpeedOnly is ignored": ("SpeedOnly := FALSE;", "MotorMode"),
    "SupplyOff is ignored": ("SupplyOff := FALSE;", "MotorSilence"),
    "StaleMs is ignored": ("Settings.StaleMs := 0;", "MotorSilence"),
    "WatchdogMs is ignored": ("Settings.WatchdogMs := 0;", "MotorMode"),
    "FollowWithinMs is ignored": ("Settings.FollowWithinMs := 0;", "MotorSilence"),
    "a held pin is an edge again": (f"IF Reason = {REASONS['HELD']} THEN RunForward := FALSE; END_IF;", "MotorStop"),
    "an early edge is kept": (f"IF Reason = {REASONS['NOT_STOPPED']} THEN RunForward := FALSE; END_IF;", "MotorStart"),
    "a lost start is tried again": (
        f"IF Reason = {REASONS['REFUSED']} THEN RunForward := FALSE; END_IF;",
        "MotorSilence",
    ),
}
"""Mistakes before everything else that a drive block does, and the programs that find them."""

LAST = {
    "a new stop never gets its number": ("Slot.Ask[0].Number := Slot.Answer[0].Number;", "MotorStop"),
    "a stop is sent to another register": ("Slot.Ask[0].Address := WORD#16#0003;", "MotorStop"),
    "the word of a stop is another": ("Slot.Ask[0].Words[0] := WORD#16#0100;", "MotorStop"),
    "the line's own stop is another": ("Slot.StopWord := WORD#16#0100;", "MotorLine"),
    "a command is sent to another register": ("Slot.Ask[1].Address := WORD#16#0003;", "MotorStart"),
    "a command is never sent": ("Slot.Ask[1].Number := Slot.Answer[1].Number;", "MotorStart"),
    "the status is ignored": ("Running := CommOk;", "MotorStart"),
    "StopConfirmed without proof": ("StopConfirmed := CommOk;", "MotorStop"),
    "StopConfirmed is not given": ("StopConfirmed := FALSE;", "MotorStart"),
    "StopOverdue is not given": ("StopOverdue := FALSE;", "MotorStop"),
    "StopOverdue is always given": ("StopOverdue := TRUE;", "MotorStart"),
    "CommOk is always TRUE": ("CommOk := TRUE;", "MotorSilence"),
    "Ready is always TRUE": ("Ready := TRUE;", "MotorSilence"),
    "Ready is never TRUE": ("Ready := FALSE;", "MotorStart"),
    "AtSpeed is never TRUE": ("AtSpeed := FALSE;", "MotorStart"),
    "ZeroSpeed is always TRUE": ("ZeroSpeed := TRUE;", "MotorStart"),
    "Fault is not shown": ("Fault := FALSE;", "MotorFault"),
    "the code of a fault is another": ("FaultCode := FaultCode + 1;", "MotorFault"),
    "Reason is another": ("Reason := MAX(Reason, 1);", "MotorStart"),
    "Error is not shown": ("Error := FALSE;", "MotorStart"),
    "ErrorID is not shown": ("ErrorID := 0;", "MotorMode"),
    "the frequency is another": ("OutputFrequencyHz := OutputFrequencyHz + 0.3;", "MotorStart"),
    "the direction is another": ("Reverse := NOT Reverse;", "MotorStart"),
    "the reference is never limited": ("Diagnosis.ReferenceLimited := FALSE;", "MotorStart"),
    "the first fault is forgotten": ("Diagnosis.FirstFaultCode := 0;", "MotorFault"),
    "a disobedient drive is not told": ("Diagnosis.CommandNotFollowed := FALSE;", "MotorSilence"),
    "parameters never pass": ("Slot.ParameterCleared := 0;", "Parameters"),
    "its silence is an alarm at once": ("Slot.BootMs := 0;", "MotorStart"),
}
"""The same after everything else."""

LINE = {
    "StopAll is ignored": ("StopAll := FALSE;", "", "MotorLine"),
    "Acknowledge is ignored": ("Acknowledge := FALSE;", "", "MotorLine"),
    "Restart is ignored": ("Restart := FALSE;", "", "MotorStop"),
    "a port in trouble is not seen": ("PortErrorID := 0;", "", "MotorLine"),
    "a port that is busy loses a frame": ("TxBusy := FALSE;", "", "MotorLine"),
    "ASCII is ignored": ("Ascii := FALSE;", "", "MotorLine"),
    "time goes too slowly": ("ElapsedMs := ElapsedMs / 4;", "", "MotorSilence"),
    "a drive that is dead is online": ("", "AllOnline := TRUE;", "MotorSilence"),
    "StopOverdue is not given": ("", "StopOverdue := FALSE;", "MotorStop"),
    "Error is not given": ("", "Error := FALSE;", "MotorLine"),
    "the port's own characters are not told": ("", "Echo := 1;", "MotorLine"),
    "other masters are not counted": ("", "ForeignFrames := 0;", "MotorLine"),
    "retries are not counted": ("", "Retries := 0;", "MotorStop"),
    "a request is another": ("", "TxChars[3] := TxChars[3] XOR BYTE#16#01;", "MotorFrames"),
    "a reply loses its last character": ("RxCount := RxCount - MIN(RxCount, 1);", "", "MotorFrames"),
    "a checksum is always right": (
        "IF RxCount = 9 THEN RxChars[7] := BYTE#16#FA; RxChars[8] := BYTE#16#33; END_IF;",
        "",
        "MotorFrames",
    ),
}
"""Mistakes before and after everything that a line with its mailbox does."""


CONTACT = {
    "the contact is always closed": ("", "HardStopOk := TRUE;", "MotorStop"),
    "the contact is always open": ("", "HardStopOk := FALSE;", "MotorStop"),
}
"""The same of the contact of the hard stop."""

DEVICE = {
    "Quantity is another": ("Quantity := 2;", "", "MotorMeter"),
    "SwapBytes is ignored": ("SwapBytes := FALSE;", "", "MotorMeter"),
    "SwapWords is ignored": ("SwapWords := FALSE;", "", "MotorMeter"),
    "StaleMs is ignored": ("StaleMs := 0;", "", "MotorMeter"),
    "SupplyOff is ignored": ("SupplyOff := FALSE;", "", "MotorMeter"),
    "Write is ignored": ("Write := FALSE;", "", "MotorMeter"),
    "Valid is always TRUE": ("", "Valid := TRUE;", "MotorMeter"),
    "CommOk is always TRUE": ("", "CommOk := TRUE;", "MotorMeter"),
    "Error is not shown": ("", "Error := FALSE;", "MotorMeter"),
}
"""The same of a meter."""

MISTAKES = {
    "Motor": {
        **{words: (statements, "", program) for words, (statements, program) in FIRST.items()},
        **{words: ("", statements, program) for words, (statements, program) in LAST.items()},
    },
    "Bus": LINE,
    "HardStop": CONTACT,
    "Meter": DEVICE,
}
"""All of them by the instance that makes them."""
BLOCKS = {"Motor": "CHF_Drive.st", "Bus": "MB_ByteLine8.st", "HardStop": "VFD_HardStop.st", "Meter": "MB_Device.st"}


TOKENS = {
    "a reset that is over sends no stop": ("VFD_FaultReset", "Helped OR (Gone", "Helped AND (Gone", "MotorFault"),
    "a reference is sent to a drive that nobody sees": (
        "VFD_Send",
        "IF Seen.CommOk AND Seen.SettingsRead",
        "IF Seen.CommOk OR Seen.SettingsRead",
        "MotorMode",
    ),
    "the wrong way counts only once run is acknowledged": (
        "VFD_Run",
        "(State > REFERRING) AND Seen.Moving AND Knows",
        "(State > COMMANDING) AND Seen.Moving AND Knows",
        "MotorExact",
    ),
    "the reference is refreshed one scan late": (
        "VFD_Send",
        "(RefreshedMs >= RefreshMs)",
        "(RefreshedMs > RefreshMs)",
        "MotorExact",
    ),
}
"""Single tokens that the tests of lines and drives once left standing."""


@pytest.fixture(scope="module")
def chf() -> Unit:
    """The programs of a shipped family that has most of the commands, and what they need."""
    return only(next(unit for unit in shipped.units() if unit.suite.name == "invt_chf"), *PROGRAMS)


def planted(source: Source, mistakes: Mapping[str, tuple[str, str, str]]) -> Source:
    """The block with all mistakes in it, of which it makes that whose number is in `Planted`."""
    head, _, body = source.text.rpartition("END_VAR\n")
    first, last = (
        "\n".join(f"  IF Planted = {number} THEN {row[place]} END_IF;" for number, row in rows if row[place])
        for place in (0, 1)
        for rows in [list(enumerate(mistakes.values(), 1))]
    )
    body = body.replace("END_FUNCTION_BLOCK", f"{last}\nEND_FUNCTION_BLOCK")
    return Source(source.path, f"{head}END_VAR\nVAR\n  Planted : UINT;\nEND_VAR\n{first}\n{body}")


@pytest.fixture(scope="module")
def library(chf: Unit) -> Library:
    """The family with every mistake in it, none of which is made."""
    kinds = {BLOCKS[name]: rows for name, rows in MISTAKES.items()}
    texts = [
        next((planted(source, rows) for block, rows in kinds.items() if source.path.endswith(f"/{block}")), source)
        for source in chf.sources
    ]
    return EmbeddedEngine().build(texts)


def assert_found(chf: Unit, library: Library, name: str, number: int, program: str) -> None:
    """Some check of a program fails where a mistake is made; no more of the program is run."""
    assert any(fails(chf, library, name, number, program))


def fails(chf: Unit, library: Library, name: str, number: int, program: str) -> Iterator[bool]:
    """Of each scan of a program, whether a check fails in it."""
    (chosen,) = only(chf, program).suite.programs
    made = library.instance(chosen.name)
    made[f"{name}.Planted"] = number
    for _ in range(sum(chosen.scans)):
        made.scan()
        yield made["Report.InScan"] != 0
    assert made["Done"]


@pytest.mark.parametrize(("name", "words"), [(name, words) for name, rows in MISTAKES.items() for words in rows])
@pytest.mark.thorough
def test_a_mistake_is_found(chf: Unit, library: Library, name: str, words: str) -> None:
    number = list(MISTAKES[name]).index(words) + 1
    assert_found(chf, library, name, number, MISTAKES[name][words][2])


@pytest.mark.parametrize("words", TOKENS)
@pytest.mark.thorough
def test_a_wrong_token_is_found(chf: Unit, words: str) -> None:
    block, old, new, program = TOKENS[words]
    done = run(changed(only(chf, program), block, old, new))
    assert [outcome for result in done.results for outcome in result.bad]
    assert not any(result.count("error") for result in done.results)


def test_what_makes_no_mistake_passes(chf: Unit, library: Library) -> None:
    assert not any(fails(chf, library, "Motor", 0, "MotorStop"))


def test_a_broken_rule_is_reported_by_its_words(chf: Unit) -> None:
    statement = LAST["StopConfirmed without proof"][0]
    wrong = changed(only(chf, "MotorStop"), "CHF_Drive", "END_FUNCTION_BLOCK", f"{statement}\nEND_FUNCTION_BLOCK")
    assert any(RULES[1] in one.actual for result in run(wrong).results for one in result.bad)


@pytest.mark.parametrize("name", shapes())
@pytest.mark.thorough
def test_scenes_pass_for_every_shape_of_a_command(name: str) -> None:
    source = collection.Source(Path(f"{name}.yaml"), shapes()[name])
    unit = only(units([source], languages(["en"], "utf-8"))[1], *PROGRAMS)
    done = run(unit)
    assert [outcome.words for result in done.results for outcome in result.bad] == []


def test_every_pin_of_a_drive_block_is_wired_and_every_output_looked_at(chf: Unit) -> None:
    block = next(source.text for source in chf.blocks if source.path.endswith("CHF_Drive.st"))
    inputs, outputs = (re.findall(r"^  (\w+) :", part, re.MULTILINE) for part in block.split("END_VAR")[:2])
    text = "\n".join(program.text for program in only(chf, *PROGRAMS).suite.programs)
    wired = re.findall(r"(\w+) := Pins\.", text)
    looked = {name for name in outputs if f"Actual := Motor.{name}," in text or f"Motor.{name}" in text}
    assert set(inputs) <= set(wired)
    assert set(outputs) - looked == {"Warning"}
