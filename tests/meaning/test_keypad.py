"""What the keypad shows, against a table typed from the documents, and the order in which a person goes."""

from dataclasses import replace
from decimal import Decimal

import pytest
from tests import shipped

from driveblocks.maps.model import Drive
from driveblocks.meaning.setting import GROUPS, Keypad, in_order, setting, settings

ENTRIES = {
    # the extract of 520-UM001O, pages 102 and 103
    "PF525": """
        C121 0 0 = Save|C121 1 1 = RAM only
        C122 0 0 = Velocity|C122 1 1 = Position
        C123 0 0 = 1200 bit/s|C123 1 1 = 2400 bit/s|C123 2 2 = 4800 bit/s
        C123 3 3 = 9600 bit/s|C123 4 4 = 19200 bit/s|C123 5 5 = 38400 bit/s
        C124 1 1|C124 247 247|C124 100 100
        C125 0 0 = Fault|C125 1 1 = Coast stop|C125 2 2 = Stop|C125 3 3 = Continue last
        C126 1 0.1 s|C126 600 60.0 s|C126 50 5.0 s|C126 10 1.0 s
        C127 0 0 = RTU 8-N-1|C127 1 1 = RTU 8-E-1|C127 2 2 = RTU 8-O-1
        C127 3 3 = RTU 8-N-2|C127 4 4 = RTU 8-E-2|C127 5 5 = RTU 8-O-2""",
    # the extract of 22B-UM001J, page 76; 22B-UM001I, page C-3
    "PF4": """
        P036 5 5 = RS485 (DSI) port|P038 5 5 = RS485 (DSI) port
        A105 0 0 = Fault|A105 1 1 = Coast stop|A105 2 2 = Stop|A105 3 3 = Continue last
        A106 1 0.1 s|A106 600 60.0 s|A106 50 5.0 s
        A107 0 0 = RTU 8-N-1|A107 1 1 = RTU 8-E-1|A107 2 2 = RTU 8-O-1|A107 5 5 = RTU 8-O-2""",
    # 22D-UM001, pages C-3 and C-4
    "PF40P": """
        P036 5 5 = Comm port|P038 5 5 = Comm port|E207 0 0 = EEPROM|E207 1 1 = RAM only
        E249 0 0 = Velocity|E249 1 1 = Position""",
    # 2080-UM002L, page 215
    "PF4M": "C302 4 4 = 19200 bit/s|C303 1 1|C303 127 127|C304 0 0 = Fault|C306 0 0 = RTU 8-N-1",
    # section 2, items 1 to 3
    "JSCC": """
        F0.04 1 1 = FWD and REV terminals, no direct start at power-up|F0.04 3 3 = Drive keypad|F0.04 4 4 = RS-485
        F0.08 1 1 = Drive keypad buttons|F0.08 7 7 = PID control of menu F9|F0.08 8 8 = RS-485
        FA.00 1 1|FA.00 247 247
        FA.01 1 1 = 4800 bit/s|FA.01 2 2 = 9600 bit/s|FA.01 3 3 = 19200 bit/s
        FA.01 4 4 = 38400 bit/s|FA.01 5 5 = 57600 bit/s
        FA.02 1 1 = 8 data bits, no parity, 1 stop bit|FA.02 2 2 = 8 data bits, even parity, 1 stop bit
        FA.02 3 3 = 8 data bits, odd parity, 1 stop bit|FA.02 4 4 = 8 data bits, no parity, 2 stop bits
        FA.02 5 5 = 8 data bits, even parity, 2 stop bits|FA.02 6 6 = 8 data bits, odd parity, 2 stop bits
        FA.03 1 1 = ASCII mode|FA.03 2 2 = RTU mode""",
    # table of communication parameters
    "SN300G5": """
        B1-01 0 0 = Keypad|B1-01 1 1 = Control circuit terminals|B1-01 2 2 = Communication|B1-01 3 3 = Reserved
        B1-02 0 0 = Keypad|B1-02 1 1 = Control circuit terminals|B1-02 2 2 = Communication|B1-02 3 3 = Reserved
        H5-01 31 1F|H5-01 32 20|H5-01 0 0|H5-01 10 A
        H5-02 0 0 = 1200 bit/s|H5-02 1 1 = 2400 bit/s|H5-02 2 2 = 4800 bit/s|H5-02 3 3 = 9600 bit/s
        H5-03 0 0 = No parity|H5-03 1 1 = Even parity|H5-03 2 2 = Odd parity
        H5-04 0 0 = Deceleration stop|H5-04 1 1 = Emergency stop|H5-04 2 2 = Coast stop|H5-04 3 3 = Continue operation
        H5-05 0 0 = Disabled|H5-05 1 1 = Enabled""",
    # 9.6.2, example 2
    "GD200A": "P00.03 5000 50.00 Hz|P00.03 10000 100.00 Hz",
    # the successor's page 11-1-1
    "MX2": "A001 3 03|A002 3 03 = Modbus communication",
}
"""Id, number on the wire, what the keypad shows for it and what that means; separated by `|`."""
DELIVERED = {
    "PF525": """
        C121 0 = Save|C122 0 = Velocity|C123 3 = 9600 bit/s|C124 100|C125 0 = Fault|C126 5.0 s
        C127 0 = RTU 8-N-1""",
    "PF4": "A105 0 = Fault|A106 5.0 s|A107 0 = RTU 8-N-1",
    "JSCC": """
        F0.04 1 = FWD and REV terminals, no direct start at power-up|F0.08 1 = Drive keypad buttons
        FA.00 1|FA.01 3 = 19200 bit/s|FA.02 2 = 8 data bits, even parity, 1 stop bit|FA.03 2 = RTU mode""",
    "SN300G5": """
        B1-01 1 = Control circuit terminals|B1-02 1 = Control circuit terminals|H5-01 1F
        H5-02 3 = 9600 bit/s|H5-03 1 = Even parity|H5-04 1 = Emergency stop|H5-05 1 = Enabled""",
    "GD200A": "P00.03 50.00 Hz",
}
"""Id, and what the keypad shows as delivered, from the same pages."""


def typed(table: str) -> list[str]:
    """The entries of a table."""
    return [each.strip() for line in table.splitlines() for each in line.split("|") if each.strip()]


@pytest.mark.parametrize("prefix", ENTRIES)
def test_the_keypad_shows_what_the_document_prints(prefix: str) -> None:
    drive, found = shipped.drives()[prefix], []
    for id_, number, _ in (each.split(" ", 2) for each in typed(ENTRIES[prefix])):
        one = setting(drive, id_)
        found.append(f"{id_} {number} {one.said_of(int(number)) if one else 'nothing'}")
    assert found == typed(ENTRIES[prefix])


@pytest.mark.parametrize("prefix", DELIVERED)
def test_it_shows_what_is_delivered(prefix: str) -> None:
    found = {one.id: one.delivered for one in settings(shipped.drives()[prefix])}
    wanted = dict(each.split(" ", 1) for each in typed(DELIVERED[prefix]))
    assert {id_: found[id_] for id_ in wanted} == wanted


@pytest.mark.parametrize(
    ("prefix", "id_"), [("ATV312", "TTO"), ("GD200A", "P14.04"), ("MX2", "C077"), ("PF40P", "A106")]
)
def test_a_time_that_the_watchdog_counts_is_in_seconds(prefix: str, id_: str) -> None:
    one = setting(shipped.drives()[prefix], id_)
    assert one
    assert one.keypad.unit == "s"
    assert one.keypad.number(Decimal(1)) in (10, 100)


def test_a_text_stands_for_its_number() -> None:
    one = replace(settings(shipped.drives()["ATV312"])[7], keypad=Keypad("tbr", texts=((32, "19.2"),)))
    assert (one.said_of(32), one.said_of(28), one.delivered) == (
        "19.2 = 19200 bit/s",
        "28 = 9600 bit/s",
        "19.2 = 19200 bit/s",
    )


def test_an_amount_between_two_counts_has_no_number() -> None:
    assert Keypad("A106", unit="s", factor=Decimal("0.1")).number(Decimal("0.25")) is None
    assert Keypad("C305", unit="s").number(Decimal(5)) is None


@pytest.mark.parametrize("drive", shipped.drives().values(), ids=shipped.drives())
def test_a_person_meets_settings_in_this_order(drive: Drive) -> None:
    found = in_order(drive)
    assert sorted(one.id for one in found) == sorted(one.id for one in settings(drive))
    assert [GROUPS.index(one.group) for one in found] == sorted(GROUPS.index(one.group) for one in found)
    line = [one.id for one in found if one.group == "line"]
    assert line[:1] == [drive.serial.unit.setting] or not line


def test_the_address_comes_before_rate_and_format() -> None:
    ids = [one.id for one in in_order(shipped.drives()["PF525"]) if one.group not in ("limits", "rest")]
    assert ids == ["P046", "P047", "C124", "C123", "C127", "C121", "C122", "C125", "C126"]
