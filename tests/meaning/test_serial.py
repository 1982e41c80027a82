"""The line of a drive: characters, and what of it is the factory's."""

from dataclasses import replace
from typing import Literal

import pytest
from tests import shipped

from driveblocks.desk.site.hunt import ways
from driveblocks.maps.model import Drive, FormatChoice, FormatCode
from driveblocks.meaning.serial import FORMS, character, serial
from driveblocks.platforms import CANONICAL
from driveblocks.platforms.port import first_motor

JSCC = shipped.drives()["JSCC"]


def delivered(parity: Literal["none", "even", "odd"], data: Literal[7, 8], stops: Literal[1, 2] | None) -> Drive:
    """A drive whose characters are so as it leaves the factory."""
    code = FormatCode(code=0, parity=parity, data_bits=data, stop_bits=stops)
    chosen = FormatChoice(source="page 1", default=0, codes=(code,))
    return replace(JSCC, serial=replace(JSCC.serial, format=chosen))


@pytest.mark.parametrize(
    ("form", "bits"),
    [
        ("8N1", 10),
        ("8E1", 11),
        ("8O1", 11),
        ("8N2", 11),
        ("7E1", 10),
        ("7O1", 10),
        ("7N2", 10),
        ("8e1", 11),
        ("7N1", 9),
    ],
)
def test_the_bits_of_a_character(form: str, bits: int) -> None:
    assert character(form).bits == bits
    assert character(form).form == form.upper()


def test_a_line_may_have_characters_of_ten_or_eleven_bits() -> None:
    assert {character(form).bits for form in FORMS} == {10, 11}


def test_of_a_drive_without_formats_the_usual_one_is_taken() -> None:
    has = serial(replace(JSCC, serial=replace(JSCC.serial, format=None, baud=None)))
    assert (has.rate, has.character.form, has.rates, has.known) == (9600, "8N1", (), False)


def test_two_stop_bits_as_delivered_are_eleven_bits_in_the_first_program() -> None:
    text = first_motor(CANONICAL, delivered("none", 8, 2)).text
    assert "CharacterBits := 11" in text
    text = first_motor("codesys", delivered("none", 8, 2)).text
    assert "CharacterBits := 11" in text
    assert "Parity := 0" in text


def test_seven_data_bits_and_parity_are_ten() -> None:
    assert "CharacterBits := 10" in first_motor(CANONICAL, delivered("even", 7, 1)).text


@pytest.mark.parametrize("prefix", shipped.drives())
def test_each_way_that_is_tried_at_a_drive_has_a_time_for_a_character(prefix: str) -> None:
    assert all(each.character_us > 0 for each in ways(shipped.drives()[prefix]))
