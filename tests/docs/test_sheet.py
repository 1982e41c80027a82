"""The sheet to print: each setting filled in for a line, and what no drive takes is refused with what it takes."""

from decimal import Decimal

import pytest
from click.testing import CliRunner
from tests import shipped

from driveblocks.cli import app
from driveblocks.docs import keypad
from driveblocks.maps.model import Drive
from driveblocks.meaning import chosen
from driveblocks.meaning.serial import character, serial
from driveblocks.meaning.setting import settings

every = pytest.mark.parametrize("drive", shipped.drives().values(), ids=shipped.drives())


def sheet(*words: str) -> tuple[int, str]:
    """The exit status of the command, and what it prints."""
    run = CliRunner().invoke(app, ["sheet", *words])
    return run.exit_code, run.output


def cells(text: str, id_: str) -> list[str]:
    """What is to be set, what is delivered, and the number on the bus."""
    row = next(each for each in text.splitlines() if each.startswith(f"| [\xa0] | {id_} "))
    return [each.strip() for each in row.split("|")[3:6]]


FILLED = {
    ("pf525", "--address", "3", "--baud", "19200", "--watchdog", "1"): {
        "P046": ["**3 = Serial/DSI**", "1 = Keypad", "3 at 002EH"],
        "C124": ["**3**", "100", "3 at 007CH"],
        "C123": ["**4 = 19200 bit/s**", "3 = 9600 bit/s", "4 at 007BH"],
        "C127": ["**0 = RTU 8-N-1**", "0 = RTU 8-N-1", "0 at 007FH"],
        "C125": ["______: 0 = Fault or 1 = Coast stop or 2 = Stop", "0 = Fault", "at 007DH"],
        "C126": ["**1.0 s**", "5.0 s", "10 at 007EH"],
    },
    ("sn300g5", "--address", "12", "--format", "8o1"): {
        "H5-01": ["**C**", "1F", "12 at 041CH"],
        "H5-03": ["**2 = Odd parity**", "1 = Even parity", "2 at 041EH"],
    },
    ("gd200a", "--format", "8N2", "--baud", "38400"): {
        "P14.01": ["**5 = 38400 bit/s**", "4 = 19200 bit/s", "5 at 0E01H"],
        "P14.02": ["**3 = 8N2, RTU**", "1 = 8E1, RTU", "3 at 0E02H"],
        "P14.04": ["______ s: 0.0 to 60.0 s", "0.0 s", "x 0.1 s at 0E04H"],
        "P00.05": ["as delivered", "0.00 Hz", "x 0.01 Hz at 0005H"],
        "P00.11": ["______ s: 0.0 to 3600.0 s", "depends on the model", "x 0.1 s at 000BH"],
        "P00.03": ["______ Hz", "50.00 Hz", "x 0.01 Hz at 0003H"],
    },
    ("mx2", "--watchdog", "0.5"): {
        "A001": ["**03**", "", "3 at 1201H (wire 1200H)"],
        "C071": ["**05 = 9600 bit/s**", "05 = 9600 bit/s", "5 at 144BH (wire 144AH)"],
        "C077": ["**0.50 s**", "", "50 at 1451H (wire 1450H)"],
    },
    ("altivar_312", "--baud", "9600"): {
        "Fr1": ["**Mdb = Modbus**", "AI1 = Analog input AI1", "164 at 20DDH"],
        "tbr": ["**9.6 = 9600 bit/s**", "19.2 = 19200 bit/s", "28 at 1773H"],
        "ttO": ["______ s: 0.1 to 30.0 s", "10.0 s", "x 0.1 s at 1775H"],
        "dEC": ["______ s", "3 s", "at 232AH"],
        "FLO": ["as delivered", "nO", ""],
    },
    ("jscc", "--baud", "9600"): {
        "FA.01": ["**2 = 9600 bit/s**", "3 = 19200 bit/s", "2"],
        "FA.03": ["**2 = RTU mode**", "2 = RTU mode", "2"],
    },
}


@pytest.mark.parametrize("words", FILLED, ids=" ".join)
def test_every_setting_is_filled_in(words: tuple[str, ...]) -> None:
    status, text = sheet(*words)
    assert status == 0
    assert {id_: cells(text, id_) for id_ in FILLED[words]} == FILLED[words]


@pytest.mark.parametrize(
    ("words", "allowed"),
    [
        (("pf525", "--address", "248"), "1 to 247, not 248"),
        (("pf525", "--baud", "115200"), "1200, 2400, 4800, 9600, 19200, 38400, not 115200"),
        (("pf525", "--baud", "-1"), "not -1"),
        (("gd200a", "--format", "7E1"), "8E1, 8N1, 8O1, 8N2, 8E2, 8O2, not 7E1"),
        (("pf525", "--watchdog", "61"), "C126 takes 0.1 to 60.0 s in steps of 0.1 s, not 61 s"),
        (("pf525", "--watchdog", "0.25"), "not 0.25 s"),
        (("gd200a", "--watchdog", "0"), "P14.04 takes 0.0 to 60.0 s in steps of 0.1 s, not 0 s"),
        (("pf525", "--watchdog", "soon"), "a number of seconds"),
        (("pf525", "--watchdog", "NaN"), "not NaN s"),
        (("pf525", "--watchdog", "1e999999"), "C126 takes 0.1 to 60.0 s"),
        (("jscc", "--watchdog", "1"), "names no setting for the time of its watchdog"),
    ],
    ids=lambda each: " ".join(each) if isinstance(each, tuple) else "",
)
def test_what_a_drive_does_not_take_is_refused_with_what_it_takes(words: tuple[str, ...], allowed: str) -> None:
    status, text = sheet(*words)
    assert (status, allowed in text) == (2, True), text


@every
def test_each_sheet_has_every_setting_once(drive: Drive) -> None:
    line = keypad.wanted(drive, serial(drive).highest, None, None, None)
    text = keypad.page(drive, drive.prefix.lower(), line)
    for one in settings(drive):
        assert text.count(f"| [\xa0] | {one.keypad.code} ") == 1


def test_limits_and_ramps_stand_together_and_what_stays_as_delivered_last() -> None:
    groups = {
        name: [each.setting.id for each in some] for name, some in keypad.rows(shipped.drives()["GD200A"]).items()
    }
    assert groups["Limits and ramps"] == ["P00.03", "P00.04", "P00.05", "P00.11", "P00.12"]
    assert [*groups][-1] == "Leave as delivered"
    assert groups["Leave as delivered"] == ["P01.19", "P07.04", "P08.47"]


@every
def test_each_rate_and_format_can_be_chosen(drive: Drive) -> None:
    asked = {each.setting for each in (drive.serial.baud, drive.serial.format) if each and each.setting}
    for rate in chosen.rates(drive):
        for form in chosen.forms(drive):
            assert asked <= chosen.chosen(drive, 1, rate, character(form)).keys(), (rate, form)


def test_a_line_is_as_delivered_where_nothing_is_said() -> None:
    assert keypad.wanted(shipped.drives()["GD200A"], 1, None, None, Decimal(2)) == keypad.Wanted(
        1, 19200, "8E1", Decimal(2)
    )
