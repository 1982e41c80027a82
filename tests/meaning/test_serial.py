"""The line of a drive: characters, and what of it is the factory's."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import pytest
from tests import shipped

from driveblocks.desk.run import setup as run
from driveblocks.desk.run.drives import Named
from driveblocks.desk.simulate import setup as simulate
from driveblocks.desk.site import asked
from driveblocks.desk.site.hunt import ways
from driveblocks.docs.page import _reads
from driveblocks.maps.model import Drive, FormatChoice, FormatCode
from driveblocks.meaning.serial import FORMS, character, delivered, serial
from driveblocks.platforms import CANONICAL
from driveblocks.platforms.port import first_motor

JSCC = shipped.drives()["JSCC"]


def delivered_as(parity: Literal["none", "even", "odd"], data: Literal[7, 8], stops: Literal[1, 2] | None) -> Drive:
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
    text = first_motor(CANONICAL, delivered_as("none", 8, 2)).text
    assert "CharacterBits := 11" in text
    text = first_motor("codesys", delivered_as("none", 8, 2)).text
    assert "CharacterBits := 11" in text
    assert "Parity := 0" in text


def test_seven_data_bits_and_parity_are_ten() -> None:
    assert "CharacterBits := 10" in first_motor(CANONICAL, delivered_as("even", 7, 1)).text


def test_the_page_counts_the_bits_that_the_drive_has_as_delivered() -> None:
    one, two = (next(_reads(delivered_as("none", 8, stops))).ms for stops in (1, 2))
    assert [int(each) for each in two] == [int(one[0]) + 1, int(one[1]) + 1]


def test_drives_that_are_delivered_alike_give_a_line_its_rate_and_characters() -> None:
    alike, other = delivered_as("none", 8, 2), delivered_as("even", 8, 1)
    assert delivered([alike, alike]) == (19200, character("8N2"))
    assert delivered([alike, other]) == (9600, character("8N1"))
    assert delivered([]) == (9600, character("8N1"))


def test_the_program_of_named_drives_has_their_rate_and_characters() -> None:
    named = [Named(Path("jscc.yaml"), delivered_as("none", 8, 2), unit) for unit in (1, 2)]
    sketch = asked._sketch(asked.Words(line=("jscc@1",)), named, 0)
    assert "BitRate := 19200, CharacterBits := 11," in asked.program({"Bus": sketch})


def test_a_run_speaks_as_the_drives_of_its_program_are_delivered(monkeypatch: pytest.MonkeyPatch) -> None:
    named = [Named(Path("jscc.yaml"), delivered_as("none", 8, 2), 1)]
    monkeypatch.setattr(run, "of_program", lambda *_: named)
    bits = {"CharacterBits": 11}
    made: Any = SimpleNamespace(_options=SimpleNamespace(form=None), _line=bits.get, probe=None, _maps=())
    assert run.Setup._form(made) == "8N2"
    made._line = {"CharacterBits": 10, "Ascii": 1}.get
    assert run.Setup._form(made) == "7E1"
    monkeypatch.setattr(run, "of_program", lambda *_: [])
    made._line = {"CharacterBits": 11, "Ascii": 0}.get
    assert run.Setup._form(made) == "8E1"


def test_simulated_drives_speak_as_they_are_delivered_unless_a_person_says_otherwise() -> None:
    assert simulate.Setup(simulate.Words(drives=("jscc",)))._its.form == serial(JSCC).character.form == "8E1"
    assert simulate.Setup(simulate.Words(drives=("jscc", "chf")))._its.form == "8E1"  # of CHF nothing is known
    assert simulate.Setup(simulate.Words(drives=("jscc", "sn300g5")))._its.form == "8N1"
    assert simulate.Setup(simulate.Words(drives=("jscc",), form="7n2"))._its.bits == 10
    rates = [simulate.Setup(simulate.Words(drives=(one,)))._rate for one in ("jscc", "sn300g5", "chf")]
    assert rates == [*(serial(shipped.drives()[one]).rate for one in ("JSCC", "SN300G5")), 9600]
    assert simulate.Setup(simulate.Words(drives=("jscc",), baud=38400))._rate == 38400


def test_a_line_takes_what_is_known_of_its_drives_where_not_all_manuals_say_it() -> None:
    by_prefix = shipped.drives()
    assert delivered([by_prefix["CHF"], by_prefix["JSCC"]]) == (19200, character("8E1"))
    assert delivered([by_prefix["CHF"]]) == (9600, character("8N1"))


def test_a_manual_that_names_rates_and_not_the_factory_s_is_not_said_to() -> None:
    baud = JSCC.serial.baud
    assert baud is not None
    assert not serial(replace(JSCC, serial=replace(JSCC.serial, baud=replace(baud, default=None)))).known


@pytest.mark.parametrize("prefix", shipped.drives())
def test_each_way_that_is_tried_at_a_drive_has_a_time_for_a_character(prefix: str) -> None:
    assert all(each.character_us > 0 for each in ways(shipped.drives()[prefix]))
