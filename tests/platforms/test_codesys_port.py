"""The serial port for CODESYS, with stand-ins for the blocks of its libraries: what they ask is seen
here, and what they answer is set here.
"""

import pytest
from tests.platforms.ports import CODESYS, library

from structured_text.engines.engine import Instance, Value


def _port() -> Instance:
    rig = library(CODESYS).instance("X_Given")
    rig["Port.Parity"] = 2
    return rig


def _scan(rig: Instance, at: int, **given: Value) -> None:
    """Set the clock and some variables, `Port.` in front, and scan."""
    for name, value in {"Port.Clock": at, **{name.replace("__", "."): value for name, value in given.items()}}.items():
        rig[name] = value
    rig.scan()


def _opened(rig: Instance) -> None:
    _scan(rig, 100)
    _scan(rig, 110)
    _scan(rig, 120, Port__Opening__xDone=True)


def test_a_port_opens_with_the_settings_of_its_pins() -> None:
    rig = _port()
    _opened(rig)
    settings = [rig[f"Port.Settings[{number}].udiValue"] for number in (1, 2, 3, 4, 6)]
    assert settings == [1, 9600, 0, 0, 7]
    assert (rig["Port.State"], rig["Port.TxBusy"], rig["Port.Opening.Asked"]) == (2, False, 1)


def test_time_is_measured_and_survives_the_clock_running_over() -> None:
    rig, found = _port(), []
    for at in (2**32 - 15, 2**32 - 5, 6, 6, 200_000):
        _scan(rig, at)
        found.append(rig["Port.ElapsedMs"])
    assert found == [0, 10, 11, 0, 65535]


def test_bytes_that_came_are_given_once_and_reading_goes_on() -> None:
    rig = _port()
    _opened(rig)
    _scan(rig, 130)
    _scan(rig, 140, Port__Reading__Heard=[1, 3, 7], Port__Reading__Came=3, Port__Reading__xDone=True)
    assert [rig["Port.RxCount"], *(rig[f"Rx[{index}]"] for index in range(3))] == [3, 1, 3, 7]
    _scan(rig, 150)
    assert (rig["Port.RxCount"], rig["Port.Reading.Asked"]) == (0, 2)
    _scan(rig, 160, Port__Reading__eError=5001, Port__Reading__xError=True)
    assert (rig["Port.ErrorID"], rig["Port.State"]) == (0, 2)


def test_a_frame_is_sent_once_and_another_waits_for_its_end() -> None:
    rig = _port()
    _scan(rig, 100, Send=8)
    assert rig["Port.Writing.Asked"] == 0, "sent while the port was closed"
    rig = _port()
    _opened(rig)
    _scan(rig, 130, Send=2, Tx=[17, 19])
    assert [rig["Port.Frame[0]"], rig["Port.Frame[1]"], rig["Port.Writing.szSize"]] == [17, 19, 2]
    assert rig["Port.Writing.udiTimeOut"] == 63_000
    _scan(rig, 140, Send=2, Tx=[23, 29])
    assert (rig["Port.TxBusy"], rig["Port.Writing.Asked"], rig["Port.Frame[0]"]) == (True, 1, 17)
    _scan(rig, 150, Send=0, Port__Writing__xDone=True)
    assert rig["Port.TxBusy"] is False
    _scan(rig, 160, Send=2)
    assert (rig["Port.Writing.Asked"], rig["Port.Frame[0]"]) == (2, 23)


def _failing(rig: Instance, at: int, block: str, code: int = 5105) -> None:
    """A scan in which a block fails."""
    _scan(rig, at, **{f"Port__{block}__eError": code, f"Port__{block}__xError": True})


def test_a_port_that_cannot_be_opened_is_tried_once_a_second() -> None:
    rig = _port()
    _scan(rig, 100)
    _scan(rig, 110)
    _failing(rig, 140, "Opening")
    for at in range(200, 1100, 100):
        _scan(rig, at)
        assert (rig["Port.State"], rig["Port.ErrorID"], rig["Port.Opening.Asked"]) == (0, 5105, 1)
    _scan(rig, 1100)
    _scan(rig, 1110)
    assert (rig["Port.State"], rig["Port.Opening.Asked"]) == (1, 2)
    _scan(rig, 1120, Port__Opening__xDone=True)
    assert (rig["Port.ErrorID"], rig["Port.TxBusy"]) == (0, False)


def test_opening_that_does_not_end_is_reported_and_waited_for() -> None:
    rig = _port()
    _scan(rig, 100)
    for at in range(200, 1100, 100):
        _scan(rig, at)
        assert rig["Port.ErrorID"] == 0
    _scan(rig, 1100)
    assert (rig["Port.ErrorID"], rig["Port.TxBusy"], rig["Port.Opening.Asked"]) == (5001, True, 1)
    _scan(rig, 1110, Port__Opening__xDone=True)
    assert (rig["Port.ErrorID"], rig["Port.TxBusy"]) == (0, False)


@pytest.mark.parametrize("block", ["Reading", "Writing"])
def test_a_port_that_fails_again_is_closed_and_opened_again_at_once(block: str) -> None:
    rig = _port()
    _opened(rig)
    for at in (2000, 2010):
        assert rig["Port.State"] == 2
        _scan(rig, at, Send=2 if block == "Writing" else 0)
        rig["Send"] = 0
        _failing(rig, at + 5, block)
        assert rig["Port.ErrorID"] == 5105
    assert (rig["Port.State"], rig["Port.TxBusy"]) == (3, True)
    _scan(rig, 2020)
    assert (rig["Port.Closing.Asked"], rig["Port.Reading.xAbort"]) == (1, True)
    _scan(rig, 2030, Port__Closing__xDone=True)
    _scan(rig, 2040)
    _scan(rig, 2050)
    assert (rig["Port.State"], rig["Port.Opening.Asked"]) == (1, 2)
    _scan(rig, 2060, Port__Opening__xDone=True)
    assert (rig["Port.State"], rig["Port.TxBusy"], rig["Port.Failures"]) == (2, False, 0)
    assert rig["Port.ErrorID"] == 5105, "nothing was read or written since"
    _scan(rig, 2070, Send=2)
    _scan(rig, 2080, Send=0, Port__Writing__xDone=True, Port__Reading__xDone=True)
    assert rig["Port.ErrorID"] == 0


def test_closing_that_does_not_end_is_given_up_after_a_second() -> None:
    rig = _port()
    _opened(rig)
    for at in (2000, 2010):
        _failing(rig, at, "Reading")
    assert rig["Port.State"] == 3
    _scan(rig, 2900)
    assert rig["Port.State"] == 3
    _scan(rig, 3010)
    assert rig["Port.State"] == 0
