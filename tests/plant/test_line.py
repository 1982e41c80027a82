"""How a line is spoken on: the program of a plant has what its file says, or what its drives are delivered with."""

import re
from pathlib import Path

from driveblocks.meaning.serial import character
from driveblocks.plant import load, program

WORKS = Path(__file__).parent / "works.yaml"


def test_the_program_has_the_rate_and_the_format_of_each_line() -> None:
    plant = load.load(WORKS)
    found = re.findall(r"BitRate := (\d+), CharacterBits := (\d+)", program.text(plant))
    ways = [each.way for each in plant.lines.values()]
    assert (
        found
        == [(str(each.rate), str(character(each.form).bits)) for each in ways]
        == [("19200", "11"), ("9600", "11")]
    )
