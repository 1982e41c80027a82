"""Commands and references of every drive on every engine: stop wins, and no number is converted unchecked."""

from math import inf, nan

import pytest
from tests.blocks import driving
from tests.blocks.library import built, result, scan
from tests.shipped import drives, sisters

from driveblocks.maps.model import Drive
from driveblocks.reference.speed import SpeedReference
from structured_text.engines.engine import Engine

pytestmark = pytest.mark.every_family

DRIVES = pytest.mark.parametrize("drive", drives().values(), ids=list(drives()))
IN_ONE_WORD = {prefix: drive for prefix, drive in drives().items() if drive.operation.in_one_word}
"""Drives with a command block; what takes several writes is the part of their orders."""
COMMANDED = pytest.mark.parametrize("drive", IN_ONE_WORD.values(), ids=list(IN_ONE_WORD))

STOPS = sisters(
    {
        "SN300G5": (0x0000, 0x0000),
        "JSCC": (0x1000, 3),
        "CHF": (0x1000, 5),
        "GD200A": (0x2000, 5),
        "PF4": (0x2000, 1),
    }
)
"""Command register and stop word, typed from the manuals; SN300G5: bits 0 and 1 cleared."""


@COMMANDED
def test_every_combination_of_pins(engine: Engine, drive: Drive) -> None:
    driving.assert_commands(built(engine), drive, driving.all_pins())


@COMMANDED
def test_every_motion_after_every_other(engine: Engine, drive: Drive) -> None:
    driving.assert_commands(built(engine), drive, driving.motions())


@COMMANDED
def test_resets_beside_everything_else(engine: Engine, drive: Drive) -> None:
    driving.assert_commands(built(engine), drive, driving.resets())


@pytest.mark.parametrize("prefix", STOPS)
@pytest.mark.parametrize("pin", ["Stop", "QuickStop", "CoastStop", "Enable"])
def test_stop_wins_over_every_run_and_reset(engine: Engine, prefix: str, pin: str) -> None:
    asked = {"Enable": True, "RunForward": True, "JogForward": True, "FaultReset": True, pin: pin != "Enable"}
    done = built(engine).run(f"{prefix}_Command", asked)
    coasts = pin == "CoastStop" and prefix in ("CHF", "GD20", "GD200A")
    wanted = (STOPS[prefix][0], 6) if coasts else STOPS[prefix]
    assert (done["Address"], done["Value"], done["Stopping"], done["Resetting"]) == (*wanted, True, False)
    assert result(done) == ("OK" if prefix not in ("JSCC", "SN300G5") else "NOT_ABLE"), "which can reset"


@pytest.mark.parametrize("prefix", STOPS)
@pytest.mark.parametrize(
    "both", [("RunForward", "RunReverse"), ("JogForward", "JogReverse"), ("RunForward", "JogReverse")]
)
def test_both_directions_are_a_stop_and_an_error(engine: Engine, prefix: str, both: tuple[str, str]) -> None:
    done = built(engine).run(f"{prefix}_Command", {"Enable": True, **dict.fromkeys(both, True)})
    found = (done["Address"], done["Value"], done["Stopping"], result(done))
    assert found == (*STOPS[prefix], True, "BOTH_DIRECTIONS")


def test_a_fresh_block_holds_the_stop_before_its_first_scan(engine: Engine) -> None:
    for prefix, (address, value) in STOPS.items():
        fresh = built(engine).library.instance(f"{prefix}_Command")
        assert (fresh["Address"], fresh["Value"]) == (address, value)


def test_terminal_bits_of_sn300g5_are_kept(engine: Engine) -> None:
    instance = built(engine).library.instance("SN300G5_Command")
    scan(instance, {"Enable": True, "RunForward": True, "KeepWord": 0x00FC})
    assert instance["Value"] == 0x00FD
    scan(instance, {"RunForward": False, "RunReverse": True})
    assert instance["Value"] == 0x00FE
    scan(instance, {"Stop": True})
    assert instance["Value"] == 0x00FC


RESETS = {
    "held until it is acknowledged, whatever the line does meanwhile": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset", 7), ("", 7), ("", 7), ("ResetAcknowledged", 5), ("", 5),
    ],
    "with a run held: never 1, 7, 1": [
        ("RunForward", 1), ("RunForward FaultReset", 5), ("RunForward", 5), ("RunForward StopAcknowledged", 7),
        ("RunForward", 7), ("RunForward ResetAcknowledged", 5), ("RunForward", 5), ("", 5), ("RunForward", 1),
    ],
    "all run and jog pins must have been FALSE at once": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset RunForward", 7), ("RunForward ResetAcknowledged", 5),
        ("RunForward RunReverse", 5), ("RunReverse", 5), ("RunReverse JogReverse", 5), ("JogReverse", 5), ("", 5),
        ("JogReverse", 4),
    ],
    "a run that rises before the acknowledgement does not count": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset", 7), ("", 7), ("RunForward", 7),
        ("RunForward ResetAcknowledged", 5), ("RunForward", 5), ("", 5), ("RunForward", 1),
    ],
    "while not enabled": [
        ("-Enable", 5), ("-Enable StopAcknowledged", 5), ("-Enable FaultReset", 7), ("-Enable", 7),
        ("-Enable ResetAcknowledged", 5), ("", 5),
    ],
    "under a stop that stands": [
        ("Stop", 5), ("Stop StopAcknowledged", 5), ("Stop FaultReset", 7), ("Stop ResetAcknowledged", 5), ("", 5),
    ],
    "a stop that rises goes first": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset", 7), ("CoastStop", 6), ("CoastStop", 6),
        ("CoastStop StopAcknowledged", 7), ("CoastStop ResetAcknowledged", 6), ("", 5),
    ],
    "Enable that falls is a stop that rises": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset", 7), ("-Enable", 5), ("-Enable StopAcknowledged", 7),
    ],
    "acknowledged while a stop is sent first: it is not sent twice": [
        ("", 5), ("StopAcknowledged", 5), ("FaultReset", 7), ("Stop ResetAcknowledged", 5), ("StopAcknowledged", 5),
    ],
    "a jog is ended by its own stop before": [
        ("JogForward", 3), ("JogForward FaultReset", 8), ("JogForward StopAcknowledged", 7),
        ("JogForward ResetAcknowledged", 5), ("", 5), ("JogForward", 3),
    ],
}  # fmt: skip
"""CHF: the pins of each call beside Enable (-Enable: without it) and the word, typed from its table of 1000H."""


@pytest.mark.parametrize("name", RESETS)
def test_a_reset_of_chf(engine: Engine, name: str) -> None:
    instance = built(engine).library.instance("CHF_Command")
    pins = ("Stop", "CoastStop", "RunForward", "RunReverse", "JogForward", "JogReverse", "FaultReset")
    words = []
    for step, _ in RESETS[name]:
        asked = step.split()
        flags = {pin: pin in asked for pin in (*pins, "StopAcknowledged", "ResetAcknowledged")}
        scan(instance, {"Enable": "-Enable" not in asked, **flags})
        words.append(instance["Value"])
        assert (instance["Resetting"], instance["Stopping"]) == (words[-1] == 7, words[-1] in (5, 6, 8))
    assert words == [word for _, word in RESETS[name]]


@pytest.mark.parametrize(("prefix", "running"), [("SN300G5", 1), ("JSCC", 1)])
def test_a_reset_that_the_drive_lacks_is_an_error_and_never_touches_the_motion(
    engine: Engine, prefix: str, running: int
) -> None:
    instance = built(engine).library.instance(f"{prefix}_Command")
    for reset in (False, True, True, False):
        scan(instance, {"Enable": True, "RunForward": True, "FaultReset": reset, "StopAcknowledged": True})
        found = (instance["Value"], instance["Stopping"], instance["Resetting"], result(instance))
        assert found == (running, False, False, "NOT_ABLE" if reset else "OK")


def test_a_run_held_over_a_reset_says_why_it_does_not_run(engine: Engine) -> None:
    instance = built(engine).library.instance("CHF_Command")
    run = {"Enable": True, "RunForward": True}
    for more, wanted in (({}, "OK"), ({"FaultReset": True}, "HELD"), ({"Stop": True}, "OK"), ({"Stop": False}, "HELD")):
        scan(instance, {**run, **more})
        assert result(instance) == wanted


def test_a_stop_that_rises_is_to_be_written_though_the_word_stays(engine: Engine) -> None:
    instance = built(engine).library.instance("CHF_Command")
    told = []
    for stop, quick in ((False, False), (False, False), (True, False), (True, False), (True, True), (False, True)):
        scan(instance, {"Enable": True, "Stop": stop, "QuickStop": quick})
        told.append((instance["Value"], instance["Changed"]))
    assert told == [(5, True), (5, False), (5, True), (5, False), (5, True), (5, False)]


def test_chf_ends_a_jog_by_its_own_word(engine: Engine) -> None:
    instance = built(engine).library.instance("CHF_Command")
    for pins, value in (({"Enable": True, "JogForward": True}, 3), ({"JogForward": False}, 8), ({"Stop": True}, 5)):
        scan(instance, pins)
        assert instance["Value"] == value


@DRIVES
def test_references_at_every_limit(engine: Engine, drive: Drive) -> None:
    for given in driving.references(drive):
        driving.assert_reference(built(engine), drive, given)


WORDS = [
    ("SN300G5", (50.0, 0.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (600.0, 0.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (50.0, -50.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (50.0, nan, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (50.0, 1.0e6, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (50.0, 60.0, 0.0, 0.0), ("OK", 5000, False)),
    ("SN300G5", (60.0, 50.0, 0.0, 0.0), ("OK", 5000, True)),
    ("SN300G5", (0.004, 50.0, 0.0, 0.0), ("OK", 0, False)),
    ("SN300G5", (0.006, 50.0, 0.0, 0.0), ("OK", 1, False)),
    ("SN300G5", (nan, 50.0, 0.0, 0.0), ("NOT_A_NUMBER", 0, False)),
    ("SN300G5", (inf, 50.0, 0.0, 0.0), ("NOT_A_NUMBER", 0, False)),
    ("SN300G5", (-0.01, 50.0, 0.0, 0.0), ("NEGATIVE", 0, False)),
    ("SN300G5", (-0.0049, 50.0, 0.0, 0.0), ("OK", 0, False)),
    ("SN300G5", (-0.0051, 50.0, 0.0, 0.0), ("NEGATIVE", 0, False)),
    ("SN300G5", (700.0, 800.0, 0.0, 0.0), ("OK", 65535, True)),
    ("SN300G5", (2.0e30, 0.0, 0.0, 0.0), ("NOT_A_NUMBER", 0, False)),
    ("SN300G5", (1.0, 0.09, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (0.05, 0.1, 0.0, 0.0), ("OK", 5, False)),
    ("SN300G5", (1.0, 10001.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("SN300G5", (45.0, 50.0, 40.0, 0.0), ("OK", 4000, True)),
    ("SN300G5", (45.0, 50.0, -1.0, 0.0), ("NO_FULL_SCALE", 0, False)),
    ("JSCC", (50.0, 60.0, 0.0, 10.0), ("OK", 500, False)),
    ("JSCC", (50.0, 60.0, 0.0, 2.0e6), ("NO_SCALE", 0, False)),
    ("JSCC", (-1.0, 0.0, 0.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("JSCC", (-1.0, 60.0, 0.0, 0.0), ("NO_SCALE", 0, False)),
    ("JSCC", (50.0, 0.0, 0.0, 10.0), ("NO_MAXIMUM", 0, False)),
    ("JSCC", (50.0, 60.0, 0.0, 0.0), ("NO_SCALE", 0, False)),
    ("JSCC", (40000.0, 10000.0, 0.0, 100.0), ("OK", 65535, True)),
    ("JSCC", (-0.5, 50.0, 0.0, 1.0), ("OK", 0, False)),
    ("JSCC", (-0.51, 50.0, 0.0, 1.0), ("NEGATIVE", 0, False)),
    ("JSCC", (-1.0e30, 50.0, 0.0, 1.0e6), ("NEGATIVE", 0, False)),
    ("CHF", (25.0, 50.0, 50.0, 0.0), ("OK", 5000, False)),
    ("CHF", (50.0, 50.0, 50.0, 0.0), ("OK", 10000, False)),
    ("CHF", (400.0, 50.0, 50.0, 0.0), ("OK", 10000, True)),
    ("CHF", (45.0, 50.0, 40.0, 0.0), ("OK", 10000, True)),
    ("CHF", (2.0, 3.0, 3.0, 0.0), ("OK", 6667, False)),
    ("CHF", (25.0, 0.0, 50.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("CHF", (0.0, 0.0, 50.0, 0.0), ("NO_MAXIMUM", 0, False)),
    ("CHF", (30.0, 40.0, 50.0, 0.0), ("OK", 6000, False)),
    ("CHF", (45.0, 40.0, 50.0, 0.0), ("OK", 8000, True)),
    ("CHF", (25.0, 50.0, 0.0, 0.0), ("NO_FULL_SCALE", 0, False)),
    ("CHF", (-0.0024, 50.0, 50.0, 0.0), ("OK", 0, False)),
    ("CHF", (-0.0026, 50.0, 50.0, 0.0), ("NEGATIVE", 0, False)),
    ("CHF", (-1.0e30, 0.1, 0.1, 0.0), ("NEGATIVE", 0, False)),
    ("CHF", (-25.0, 50.0, 50.0, 0.0), ("NEGATIVE", 0, False)),
]


@pytest.mark.parametrize(("prefix", "given", "wanted"), WORDS)
def test_words_of_references(
    engine: Engine, prefix: str, given: driving.References, wanted: tuple[str, int, bool]
) -> None:
    found = driving.encode(built(engine), drives()[prefix], given)
    assert (found.result, found.value, found.limited) == wanted
    assert SpeedReference(drives()[prefix]).encode(*given).near == {wanted[1]}
