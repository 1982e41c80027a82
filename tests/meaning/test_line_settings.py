"""What a manual can say of rate and format: codes, none, two settings, another default by edition."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.maps.load import loads
from driveblocks.maps.page import skeleton
from driveblocks.meaning.serial import Serial, serial
from driveblocks.meaning.setting import setting
from driveblocks.platforms import CANONICAL
from driveblocks.platforms.port import first_motor

FIXED = "  baud: {codes: [{baud: 9600}], source: section 1}\n"
SWITCHES = "  baud: {codes: [{baud: 9600}, {baud: 19200, delivered: true}], source: section 1}\n"
RATE = (
    "  baud: {setting: P1.02, default: 1, codes: [{code: 0, baud: 9600}, {code: 1, baud: 38400}], source: section 1}\n"
)
TWO = """\
  format: {setting: P1.03, default: 2, codes: [{code: 0, parity: none}, {code: 2, parity: even}], source: section 1}
  stop_bits: {setting: P1.04, default: 1, codes: [{code: 1, stop_bits: 1}, {code: 2, stop_bits: 2}], source: section 1}
"""
OPEN = "  baud: {setting: P1.02, codes: [{code: 6, baud: 9600}, {code: 8, baud: 38400}], source: section 1}\n"
ONE = '{id: P1.02, name: Rate, source: section 1, default: "1"}'
PARITY = '{id: P1.03, name: Parity, source: section 1, default: "2"}'
STOPS = '{id: P1.04, name: Stop bits, source: section 1, default: "1"}'
EDITIONS = """{id: P1.02, name: Rate, source: section 1, needed: {why: the rate of the line}, editions: [
  {edition: 07/2012, default: "8", source: page 111}, {edition: 09/2014, default: "6", source: page 97}]}"""


def made(line: str, *settings: str) -> str:
    """The skeleton with these lines of `serial`, and these settings."""
    text = skeleton().replace("  unit: {min: 1", f"{line}  unit: {{min: 1")
    return text.replace("settings: []", f"settings: [{', '.join(settings)}]")


def of(line: str, *settings: str) -> Serial:
    return serial(loads(made(line, *settings), "acme.yaml"))


@pytest.mark.parametrize(
    ("line", "settings", "rate", "form", "known"),
    [
        (FIXED, (), 9600, "8N1", True),
        (SWITCHES, (), 19200, "8N1", True),
        (RATE + TWO, (ONE, PARITY, STOPS), 38400, "8E1", True),
        (OPEN, (EDITIONS,), 9600, "8N1", False),
    ],
)
def test_the_line_as_delivered(line: str, settings: tuple[str, ...], rate: int, form: str, known: bool) -> None:
    has = of(line, *settings)
    assert (has.rate, has.character.form, has.known) == (rate, form, known)


def test_all_that_can_be_chosen_is_known() -> None:
    assert of(SWITCHES).rates == (19200, 9600)
    forms = [each.form for each in of(RATE + TWO, ONE, PARITY, STOPS).characters]
    assert forms == ["8E1", "8N1", "8N2", "8E2"]


def test_what_differs_by_edition_is_for_a_person_to_look_up() -> None:
    drive = loads(made(OPEN, EDITIONS), "acme.yaml")
    one = setting(drive, "P1.02")
    assert one
    assert (one.default, one.factory) == ("8 (07/2012) or 6 (09/2014)", None)
    motor = " ".join(first_motor(CANONICAL, drive).text.split())
    assert "rate and parity as in the drive: as delivered they differ by edition" in motor


@pytest.mark.parametrize(
    ("line", "settings", "says"),
    [
        (FIXED, (), "bit rate 9600 bit/s (section 1)"),
        (SWITCHES, (), "bit rate 9600 bit/s, 19200 bit/s (as delivered) (section 1)"),
        (RATE + TWO, (ONE, PARITY, STOPS), "stop bits by P1.04: 1 = 1, 2 = 2; factory setting 1 (section 1)"),
        (OPEN, (EDITIONS,), "factory 8 (07/2012, page 111) or 6 (09/2014, page 97)"),
    ],
)
def test_show_says_it(line: str, settings: tuple[str, ...], says: str, tmp_path: Path) -> None:
    path = tmp_path / "acme.yaml"
    path.write_text(made(line, *settings), encoding="utf-8")
    shown = CliRunner().invoke(app, ["show", str(path), "serial"], catch_exceptions=False).output
    assert says in " ".join(shown.split())
