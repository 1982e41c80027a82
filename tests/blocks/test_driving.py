"""Commands and references of every drive on every engine: stop wins, and no number is converted unchecked."""

from math import inf, nan

import pytest
from tests.blocks import driving
from tests.blocks.library import built, result, scan, shipped

from driveblocks.host.engine import Engine
from driveblocks.maps.model import Drive

DRIVES = pytest.mark.parametrize("drive", shipped().values(), ids=list(shipped()))

STOPS = {"SN300G5": (0x0000, 0x0000), "JSCC": (0x1000, 3), "CHF": (0x1000, 5)}
"""Command register and stop word, typed from the manuals; SN300G5: bits 0 and 1 cleared."""


@DRIVES
def test_every_combination_of_pins(engine: Engine, drive: Drive) -> None:
    driving.check_commands(built(engine), drive, driving.all_pins())


@DRIVES
def test_every_motion_after_every_other(engine: Engine, drive: Drive) -> None:
    driving.check_commands(built(engine), drive, driving.motions())


@pytest.mark.parametrize("prefix", STOPS)
@pytest.mark.parametrize("pin", ["Stop", "QuickStop", "CoastStop", "Enable"])
def test_stop_wins_over_every_run_and_reset(engine: Engine, prefix: str, pin: str) -> None:
    asked = {"Enable": True, "RunForward": True, "JogForward": True, "FaultReset": True, pin: pin != "Enable"}
    done = built(engine).run(f"{prefix}_Command", asked)
    wanted = (0x1000, 6) if (prefix, pin) == ("CHF", "CoastStop") else STOPS[prefix]
    assert (done["Address"], done["Value"], done["Stopping"], result(done)) == (*wanted, True, "OK")


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


def test_chf_ends_a_jog_by_its_own_word(engine: Engine) -> None:
    instance = built(engine).library.instance("CHF_Command")
    for pins, value in (({"Enable": True, "JogForward": True}, 3), ({"JogForward": False}, 8), ({"Stop": True}, 5)):
        scan(instance, pins)
        assert instance["Value"] == value


@DRIVES
def test_references_at_every_limit(engine: Engine, drive: Drive) -> None:
    for hertz, maximum, scale in driving.references(drive):
        driving.check_reference(built(engine), drive, hertz, maximum, scale)


WORDS = [
    ("SN300G5", (50.0, 0.0, 0.0), ("OK", 5000, False)),
    ("SN300G5", (60.0, 50.0, 0.0), ("OK", 5000, True)),
    ("SN300G5", (0.004, 0.0, 0.0), ("OK", 0, False)),
    ("SN300G5", (0.006, 0.0, 0.0), ("OK", 1, False)),
    ("SN300G5", (nan, 50.0, 0.0), ("NOT_A_NUMBER", 0, False)),
    ("SN300G5", (inf, 50.0, 0.0), ("NOT_A_NUMBER", 0, False)),
    ("SN300G5", (-0.01, 50.0, 0.0), ("NEGATIVE", 0, False)),
    ("JSCC", (50.0, 0.0, 10.0), ("OK", 500, False)),
    ("JSCC", (50.0, 0.0, 0.0), ("NO_SCALE", 0, False)),
    ("JSCC", (40000.0, 0.0, 100.0), ("OK", 65535, True)),
    ("CHF", (25.0, 50.0, 0.0), ("OK", 5000, False)),
    ("CHF", (50.0, 50.0, 0.0), ("OK", 10000, False)),
    ("CHF", (400.0, 50.0, 0.0), ("OK", 10000, True)),
    ("CHF", (25.0, 0.0, 0.0), ("NO_SCALE", 0, False)),
    ("CHF", (-25.0, 50.0, 0.0), ("NEGATIVE", 0, False)),
]


@pytest.mark.parametrize(("prefix", "given", "wanted"), WORDS)
def test_words_of_references(
    engine: Engine, prefix: str, given: tuple[float, float, float], wanted: tuple[str, int, bool]
) -> None:
    found = driving.encode(built(engine), shipped()[prefix], *given)
    assert (found.result, found.value, found.limited) == wanted
