"""The page of a swap: of two families, each part that an electrician meets, side by side."""

from dataclasses import replace
from itertools import permutations

import pytest
from tests.shipped import drives

from driveblocks.docs import swap
from driveblocks.maps.model import Drive
from driveblocks.meaning.setting import settings

DRIVES = drives()


def told(old: Drive | str, new: Drive | str) -> dict[str, dict[str, tuple[str, str]]]:
    """Section -> row -> both cells."""
    both = (DRIVES[one] if isinstance(one, str) else one for one in (old, new))
    return {one.title: {what: (before, after) for what, before, after in one.rows} for one in swap.sections(*both)}


def test_wires_and_line() -> None:
    found = told("ACS355", "V20")
    assert found["Wiring"]["positive at rest (D1, B)"] == ("not known", "pin 6, P+")
    assert found["Wiring"]["to find out"][1]
    assert found["The line"]["rates of both"] == ("9600, 19200, 38400",) * 2
    assert found["The line"]["as delivered"] == ("9600 bit/s 8N1, address 1", "address 1")


def test_drives_that_share_no_rate_need_two_lines() -> None:
    line = DRIVES["V20"].serial
    assert line.baud
    fast = replace(line.baud, codes=tuple(one for one in line.baud.codes if one.baud == 115200))
    found = told("ACS355", replace(DRIVES["V20"], serial=replace(line, baud=fast)))
    assert found["The line"]["rates of both"] == ("none", "none: it needs a line of its own")


def test_settings_stand_beside_those_that_do_the_same() -> None:
    keypad = told("PF4", "PF525")["Keypad"]
    assert keypad["unit address"] == ("A104, Comm node address: 1 to 247", "C124, RS485 node address: 1 to 247")
    assert [each.split(",")[0] for each in keypad["watchdog time"]] == ["A106", "C126"]
    assert [each.split(": ")[1] for each in keypad["lower limit"]] == [
        "as delivered (0.0 Hz)",
        "as delivered (0.00 Hz)",
    ]
    before, after = (each.splitlines() for each in keypad["who commands"])
    assert before[0] == "P036, Start source: 5 = RS485 (DSI) port"
    assert after[0] == "P046, Start source 1: 3 = Serial/DSI"
    assert told("CHF", "GD200A")["Keypad"]["bit rate"][0] == "the map names none"


def test_pins_scales_and_what_the_new_drive_cannot() -> None:
    pins = told("CHF", "GD200A")["Pins of the block"]
    assert pins["FullScaleHz"] == ("required: what P0.04 says", "no use")
    assert pins["ManualChecked"] == ("no use", "56864")
    assert pins["scales of what it shows"][0].startswith("Settings.FrequencyScale, ")
    assert "Settings.PolePairs" not in pins, "both need none"
    assert pins["a speed on the wire"][1] == "100 for each hertz"
    bus = told("V20", "JSCC")["Over the bus"]
    assert bus["reset a fault"] == bus["quick stop"] == bus["shows output current"] == ("yes", "no")
    assert told("PF4", "PF525")["Over the bus"]["shows output current"] == ("no", "yes")


def test_what_a_cut_cable_does_and_what_a_forgotten_exchange_does() -> None:
    found = told("GD200A", "PF4")
    assert found["By itself"]["the cable is cut, as delivered"][1].endswith(
        "the drive trips after 5.0 s of silence (A106)"
    )
    mistaken = found["If the block is not exchanged"]
    assert mistaken["GD200A_Drive"][0] == mistaken["PF4_Drive"][1] == "-"
    assert mistaken["PF4_Drive"][0].startswith("A stop of PF4 at a GD200A may start the motor; ")


def test_faults_by_number_and_by_name() -> None:
    drive = DRIVES["JSCC"]
    first, second, *rest = drive.faults.codes
    codes = (replace(first, code=second.code), replace(second, code=first.code), *rest)
    other = replace(drive, prefix="OTHER", faults=replace(drive.faults, codes=codes))
    found = told(drive, other)
    numbers = (str(first.code), str(second.code))
    assert found["The same fault, another number"] == {first.name: numbers, second.name: numbers[::-1]}
    assert found["The same number, another fault"] == {
        numbers[0]: (first.name, second.name), numbers[1]: (second.name, first.name)
    }  # fmt: skip


@pytest.mark.parametrize("family", sorted(DRIVES))
def test_every_setting_that_matters_is_in_the_page_of_every_swap(family: str) -> None:
    needed = [one.keypad.code for one in settings(DRIVES[family]) if one.needed]
    for old, new in permutations((family, min({*DRIVES} - {family})), 2):
        cells = "\n".join(cell for row in told(old, new).get("Keypad", {}).values() for cell in row)
        assert [code for code in needed if f"{code}, " not in cells and f"{code} in " not in cells] == []
