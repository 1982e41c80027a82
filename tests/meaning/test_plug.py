"""Which pin is A: every pin as it stands in the documents that were read, typed from them by hand."""

import re

import pytest
from click.testing import CliRunner
from tests import families, shipped
from tests.maps.test_base import BASE

from driveblocks.cli import app
from driveblocks.docs import socket
from driveblocks.maps.load import loads
from driveblocks.maps.revision import checked, revision
from driveblocks.meaning.plug import plug

PINS, TERMINATION = families.own("PLUG"), families.own("TERMINATION")
LABELS = {
    "4": "D1 Modbus signal", "5": "D0 Modbus signal", "6": "Not connected", "7": "VP", "8": "Common Modbus signal",
} | dict.fromkeys("123", "CANopen signal reserved")  # fmt: skip
"""BBV52816, page 8."""


def test_every_pin_is_as_it_was_read() -> None:
    found = {name: drive.serial.pins.pins for name, drive in shipped.drives().items() if drive.serial.pins}
    assert {name: ", ".join(f"{one.pin} {one.wire}" for one in pins) for name, pins in found.items() if pins} == PINS
    assert {one.pin: one.label for one in found["ATV312"]} == LABELS


def test_the_resistors_are_as_they_were_read() -> None:
    said = {name: plug(drive).termination for name, drive in shipped.drives().items() if plug(drive).termination}
    assert said.keys() == TERMINATION.keys()
    assert [(name, word) for name, words in TERMINATION.items() for word in words if word not in said[name]] == []


def test_what_no_text_says_has_a_way_to_find_it_out() -> None:
    for drive in shipped.drives().values():
        assert all(find_out for _, find_out in plug(drive).gaps)


def test_it_is_no_part_of_what_a_motor_does() -> None:
    more = BASE.replace("interface: {en: RS-485}", "interface: {en: RS-485}\n  pins: {connector: rj45, source: page 1}")
    plain, with_ = loads(BASE, "acme.yaml"), loads(more, "acme.yaml")
    assert (revision(plain), checked(plain)) == (revision(with_), checked(with_))
    assert plug(with_).source == f"{with_.manual.title.en}, page 1 (read)"


@pytest.mark.parametrize("name", [name for name, pins in PINS.items() if "4 " in pins])
def test_the_picture_of_a_socket_has_every_pin_with_its_wire(name: str) -> None:
    own = plug(shipped.drives()[name])
    drawn = re.findall(r">([^<]*)</text>", socket.picture(name, own))
    for one in own.pins:
        at = one.pin if one.pin.isdecimal() else "-"
        words = (at, socket.SAYS[one.wire], (one.label or "") if at == one.pin else f"{one.pin}, {one.label}")
        assert words in zip(drawn, drawn[1:], drawn[2:], strict=False)


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("atv312", "RJ45 socket: **+** (D1) at pin 4, D1 Modbus signal, **-** (D0) at pin 5, D0 Modbus signal, common"),
        ("mx2", "Terminals: **+** (D1) at SP, **-** (D0) at SN, common at ______"),
        ("pf4", "**+** (D1) at pin 4, TxRxD+, **-** (D0) at pin 5, TxRxD-, common at I/O terminal 04, Digital Common"),
        ("sn300g5", "RS-485 hardware interface: **+** (D1) at ______, **-** (D0) at ______, common at ______"),
    ],
)  # fmt: skip
def test_the_sheet_has_the_terminals(name: str, line: str) -> None:
    assert line in CliRunner().invoke(app, ["sheet", name]).output
