"""The end of a soft PLC whose motor turns, over a pseudo-terminal: its last will stops the drive. It needs iec2c.

A simulated drive without a watchdog judges it: nothing else would stop that motor.
"""

import os
import sys
import time
from pathlib import Path

import pytest
from tests.blocks.toolchains import FOUND
from tests.desk.simulate.softplc import WHY_NOT, Desk, SoftPlc, built, plc

pytestmark = [
    pytest.mark.thorough,
    pytest.mark.skipif(bool(WHY_NOT), reason=WHY_NOT),
    pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here"),
]
WITHIN_S = 3
"""From the end to the motor at standstill: 2 s of the port at most, and the ramp."""
LOADER = """#!{python}
import ctypes, _ctypes, os, sys, time
plc = ctypes.CDLL({library!r})
words = (ctypes.c_char_p * 2)(b"plc", sys.argv[1].encode())
plc.main(2, words)
_ctypes.dlclose(plc._handle)
time.sleep(10)
os._exit(0)
"""
"""A runtime that loads the PLC as a library and unloads it, as Beremiz does, and neither ends nor exits then."""


@pytest.fixture(scope="module", params=range(max(1, len(FOUND))))
def program(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The soft PLC by each line of matiec."""
    return built(tmp_path_factory.mktemp("will"), FOUND[request.param])


@pytest.fixture(scope="module", params=range(max(1, len(FOUND))))
def loader(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same as a library, in a process that loads it."""
    folder = tmp_path_factory.mktemp("loaded")
    library = built(folder, FOUND[request.param], "softplc.c", "-shared", "-fPIC")
    loads = folder / "loader"
    loads.write_text(LOADER.format(python=sys.executable, library=str(library)), encoding="utf-8")
    loads.chmod(0o755)
    return loads


def _turns(soft: SoftPlc, desk: Desk) -> None:
    soft.until(lambda seen: seen["confirmed"] == 1 and seen["comm"] == 1)
    soft.set("start", on=True)
    soft.until(lambda seen: seen["running"] == 1 and seen["hertz"] == 20)
    time.sleep(0.5)
    assert desk.drive.hertz == 20


def _stands(desk: Desk) -> bool:
    end = time.monotonic() + WITHIN_S
    while desk.drive.mode != "standstill" and time.monotonic() < end:
        time.sleep(0.01)
    return desk.drive.mode == "standstill" and desk.drive.hertz == 0


def _end(soft: SoftPlc) -> None:
    assert soft.process.stdin is not None
    soft.process.stdin.close()


def test_the_motor_stands_after_the_process_has_ended(program: Path) -> None:
    desk = Desk()
    with plc(program, desk.link.place) as soft:
        _turns(soft, desk)
        _end(soft)
        assert _stands(desk)
    desk.stop()
    desk.link.close()
    assert desk.bus.strange == 0


def test_the_motor_stands_after_the_thread_of_the_plc_has_ended(program: Path) -> None:
    desk = Desk()
    with plc(program, desk.link.place, "thread") as soft:
        _turns(soft, desk)
        _end(soft)
        assert _stands(desk)
        assert soft.process.poll() is None
    desk.stop()
    desk.link.close()


def test_the_motor_stands_after_the_plc_was_unloaded(loader: Path) -> None:
    desk = Desk()
    with plc(loader, desk.link.place) as soft:
        _turns(soft, desk)
        _end(soft)
        assert _stands(desk)
        assert soft.process.poll() is None
    desk.stop()
    desk.link.close()


def test_after_a_kill_it_turns_on(program: Path) -> None:
    desk = Desk()
    with plc(program, desk.link.place) as soft:
        _turns(soft, desk)
        soft.process.kill()
        assert not _stands(desk)
        assert desk.drive.hertz == 20
    desk.stop()
    desk.link.close()
